//! What was measured, over frequency or over time.

use crate::RheologyError;
use crate::error::{in_list, in_range, not_negative, positive};

/// Moduli at one frequency of oscillation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ModulusPoint {
    /// Angular frequency ω, \[rad/s].
    pub angular_frequency: f64,
    /// Storage modulus G', \[Pa].
    pub storage: f64,
    /// Loss modulus G'', \[Pa].
    pub loss: f64,
}

/// Relaxation modulus at one time after a step of strain.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RelaxationPoint {
    /// Time t, \[s].
    pub time: f64,
    /// Relaxation modulus G(t), \[Pa].
    pub modulus: f64,
}

/// A measured curve, at increasing frequencies or times.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MeasuredCurve(Points);

#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) enum Points {
    Oscillation(Vec<ModulusPoint>),
    Relaxation(Vec<RelaxationPoint>),
}

impl MeasuredCurve {
    /// A curve measured in oscillation.
    ///
    /// # Errors
    /// [`RheologyError::TooFewPoints`] below two points; [`RheologyError::InvalidElement`] when a frequency is not
    /// greater than the one before it, or a modulus is not finite, negative, or both of a point are zero.
    pub fn oscillation(points: Vec<ModulusPoint>) -> Result<Self, RheologyError> {
        let mut last = 0.0;
        for (index, point) in points.iter().enumerate() {
            last = increasing("angular_frequency", point.angular_frequency, last)
                .and_then(|frequency| {
                    not_negative("storage", point.storage)?;
                    not_negative("loss", point.loss)?;
                    positive("modulus", point.storage.hypot(point.loss))?;
                    Ok(frequency)
                })
                .map_err(in_list("points", index))?;
        }
        enough(points.len())?;
        Ok(Self(Points::Oscillation(points)))
    }

    /// A curve measured in relaxation.
    ///
    /// # Errors
    /// [`RheologyError::TooFewPoints`] below two points; [`RheologyError::InvalidElement`] when a time is not greater
    /// than the one before it, or a modulus is not finite and greater than zero.
    pub fn relaxation(points: Vec<RelaxationPoint>) -> Result<Self, RheologyError> {
        let mut last = 0.0;
        for (index, point) in points.iter().enumerate() {
            last = increasing("time", point.time, last)
                .and_then(|time| positive("modulus", point.modulus).map(|_| time))
                .map_err(in_list("points", index))?;
        }
        enough(points.len())?;
        Ok(Self(Points::Relaxation(points)))
    }

    pub(super) const fn points(&self) -> &Points {
        &self.0
    }

    /// The shortest and the longest time that the curve covers, 1/ω or t.
    pub(super) fn time_window(&self) -> [f64; 2] {
        let window = match &self.0 {
            Points::Oscillation(points) => [points.last(), points.first()]
                .map(|point| point.map(|p| p.angular_frequency.recip())),
            Points::Relaxation(points) => {
                [points.first(), points.last()].map(|point| point.map(|p| p.time))
            }
        };
        // A curve has at least two points.
        window.map(Option::unwrap_or_default)
    }
}

fn increasing(parameter: &'static str, value: f64, last: f64) -> Result<f64, RheologyError> {
    let holds = value.is_finite() && value > last;
    let allowed = "finite, greater than 0 and greater than the one before";
    in_range(parameter, value, holds, allowed)
}

fn enough(given: usize) -> Result<(), RheologyError> {
    if given < 2 {
        return Err(RheologyError::TooFewPoints { needed: 2, given });
    }
    Ok(())
}
