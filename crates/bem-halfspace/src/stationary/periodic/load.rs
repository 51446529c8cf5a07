//! Load of a periodic surface: mean pressure or depth, velocity and sliding distance.

use indenters::IndenterError;
use numerics::{InvalidParameter, in_range, not_negative, positive};

use crate::BemError;

/// The prescribed quantity of a periodic contact.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum PeriodicControl {
    /// Mean pressure over the whole period, \[Pa]; the depth follows.
    MeanPressure(f64),
    /// Depth of the mean plane \[m], as in [`PeriodicSliding::mean_depth`](crate::PeriodicSliding::mean_depth); the mean
    /// pressure follows.
    MeanDepth(f64),
}

/// A periodic surface that slides along x, or is pressed without sliding.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PeriodicLoad {
    /// Prescribed mean pressure or depth.
    control: PeriodicControl,
    /// Motion under the prescribed pressure or depth.
    motion: PeriodicMotion,
}

/// Motion of a periodic surface along x.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
enum PeriodicMotion {
    /// Sliding speed \[m/s], and distance from rest \[m]; `None` for the stationary state.
    Sliding {
        velocity: f64,
        distance: Option<f64>,
    },
    /// No sliding for a time since the step of pressure, \[s].
    AtRest { duration: f64 },
}

impl PeriodicLoad {
    /// The stationary state under a mean pressure > 0 \[Pa] over the whole period, at a velocity ≥ 0 \[m/s] towards positive x.
    ///
    /// # Errors
    /// [`InvalidParameter`] for numbers out of these ranges.
    pub fn new(mean_pressure: f64, velocity: f64) -> Result<Self, InvalidParameter> {
        let pressure = positive("mean_pressure", mean_pressure)?;
        Self::stationary(PeriodicControl::MeanPressure(pressure), velocity)
    }

    /// The stationary state with the mean plane at a depth \[m], at a velocity ≥ 0 \[m/s] towards positive x.
    ///
    /// On a half space the depth is measured from the mean of the deformed surface. It lies between minus the height of the mean
    /// plane above the lowest point, at first touch, and 0, where all gaps are closed under any pressure.
    ///
    /// # Errors
    /// [`InvalidParameter`] for numbers that are not finite, and a negative velocity.
    pub fn at_depth(mean_depth: f64, velocity: f64) -> Result<Self, InvalidParameter> {
        in_range("mean_depth", mean_depth, mean_depth.is_finite(), "finite")?;
        Self::stationary(PeriodicControl::MeanDepth(mean_depth), velocity)
    }

    /// A stationary state at a velocity, which is checked.
    fn stationary(control: PeriodicControl, velocity: f64) -> Result<Self, InvalidParameter> {
        let motion = PeriodicMotion::Sliding {
            velocity: not_negative("velocity", velocity)?,
            distance: None,
        };
        Ok(Self { control, motion })
    }

    /// A mean pressure > 0 \[Pa] over the whole period that is held for a time > 0 \[s], without sliding.
    ///
    /// The contact grows everywhere, so that it is that of a spring with the compliance J(t) (Lee & Radok 1960). Its pressure is that
    /// of the spring too, and differs from the pressure on a material that creeps.
    ///
    /// # Errors
    /// [`InvalidParameter`] for numbers out of these ranges.
    pub fn pressed(mean_pressure: f64, duration: f64) -> Result<Self, InvalidParameter> {
        Ok(Self {
            control: PeriodicControl::MeanPressure(positive("mean_pressure", mean_pressure)?),
            motion: PeriodicMotion::AtRest {
                duration: positive("duration", duration)?,
            },
        })
    }

    /// This load after the surface has slid a distance > 0 \[m] from rest.
    ///
    /// # Errors
    /// [`InvalidParameter`] for a distance out of this range.
    pub fn after(self, sliding_distance: f64) -> Result<Self, InvalidParameter> {
        let motion = PeriodicMotion::Sliding {
            velocity: self.velocity(),
            distance: Some(positive("sliding_distance", sliding_distance)?),
        };
        Ok(Self { motion, ..self })
    }

    /// Prescribed mean pressure or depth.
    pub const fn control(&self) -> PeriodicControl {
        self.control
    }

    /// Sliding speed v, \[m/s]; 0 without sliding.
    pub const fn velocity(&self) -> f64 {
        match self.motion {
            PeriodicMotion::Sliding { velocity, .. } => velocity,
            PeriodicMotion::AtRest { .. } => 0.0,
        }
    }

    /// Sliding distance from rest, \[m]; `None` for the stationary state, and without sliding.
    pub const fn sliding_distance(&self) -> Option<f64> {
        match self.motion {
            PeriodicMotion::Sliding { distance, .. } => distance,
            PeriodicMotion::AtRest { .. } => None,
        }
    }

    /// Time since the step of pressure of a surface that does not slide, \[s]; `None` if it slides.
    pub const fn duration(&self) -> Option<f64> {
        match self.motion {
            PeriodicMotion::Sliding { .. } => None,
            PeriodicMotion::AtRest { duration } => Some(duration),
        }
    }

    /// Prescribed mean pressure or depth; fails for a load with a sliding distance.
    pub(super) fn require_stationary(&self) -> Result<PeriodicControl, BemError> {
        let distance = |sliding_distance| IndenterError::OnlyStationary { sliding_distance };
        match self.sliding_distance() {
            None => Ok(self.control),
            Some(sliding_distance) => Err(distance(sliding_distance).into()),
        }
    }

    /// Mean pressure \[Pa] and sliding distance \[m] of a march from rest; fails if one of them is missing.
    pub(crate) fn require_march(&self) -> Result<(f64, f64), BemError> {
        let PeriodicControl::MeanPressure(pressure) = self.control else {
            return Err(BemError::DepthFromRest);
        };
        positive("velocity", self.velocity())?;
        let why = "from rest a periodic surface slides over a distance";
        let distance = self
            .sliding_distance()
            .ok_or(BemError::SlidingDistanceMissing { why })?;
        Ok((pressure, distance))
    }
}
