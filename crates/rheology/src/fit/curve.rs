//! Measured curves of moduli over frequency or over time.

use super::superposition::{Link, LinkedBy};
use super::system::{MIN_RELATIVE_SIZE, Measurement, Quantity};
use crate::RheologyError;
use crate::error::with_list_index;
use numerics::{InvalidParameter, in_range, not_negative, positive};

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

impl ModulusPoint {
    /// Scales of the relative errors of storage and loss modulus, \[Pa]: the modulus, but at least a thousandth of |G*|.
    pub fn sizes(&self) -> [f64; 2] {
        let least = MIN_RELATIVE_SIZE * self.storage.hypot(self.loss);
        [self.storage, self.loss].map(|modulus| modulus.max(least))
    }
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
pub struct MeasuredCurve {
    /// Measured numbers; two per frequency, one per time.
    pub(super) rows: Vec<Measurement>,
    /// Shortest and longest time of the curve, 1/ω or t, \[s].
    pub(super) time_window: [f64; 2],
    /// Isotherms of a master curve; `None` for a single curve.
    pub(super) joined: Option<JoinedIsotherms>,
}

/// Isotherms of a master curve, in any order.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct JoinedIsotherms {
    /// Temperatures in the unit of the table.
    pub(super) temperatures: Vec<f64>,
    /// Shifts ln a of the frequencies, in the order of the temperatures.
    pub(super) log_factors: Vec<f64>,
    /// Pairs of isotherms shifted onto each other, from the reference outwards.
    pub(super) links: Vec<Link>,
    /// Shifts ln b of the moduli of an ideal rubber if the data leave them undecided; empty otherwise.
    pub(super) undecided: Vec<f64>,
}

impl JoinedIsotherms {
    /// Reference isotherm, onto which the others were shifted; `None` if all shifts were given.
    pub(super) fn reference(&self) -> Option<usize> {
        let finds_shift = |link: &Link| match link.by {
            LinkedBy::Overlap { finds_shift, .. } => finds_shift,
            LinkedBy::Law(_) => true,
            LinkedBy::Given => false,
        };
        let first = self.links.first()?;
        self.links.iter().any(finds_shift).then_some(first.fixed)
    }

    /// Slope d ln a/dT at every isotherm \[1/K], by central differences over the temperatures, one-sided at both ends; 0 for a
    /// single isotherm.
    pub(super) fn secants(&self) -> Vec<f64> {
        // Compute the slope of the logarithmic shift between the two neighbours of each isotherm by temperature. At both ends the
        // isotherm itself is one of the two.
        let n = self.temperatures.len();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| self.temperatures[*a].total_cmp(&self.temperatures[*b]));
        let mut slopes = vec![0.0; n];
        for place in 0..n {
            let ends = [place.saturating_sub(1), (place + 1).min(n - 1)].map(|end| order[end]);
            let rise = |values: &[f64]| values[ends[1]] - values[ends[0]];
            let width = rise(&self.temperatures);
            if width > 0.0 {
                slopes[order[place]] = rise(&self.log_factors) / width;
            }
        }
        slopes
    }
}

impl MeasuredCurve {
    /// A curve measured in oscillation.
    ///
    /// # Errors
    /// [`RheologyError::TooFewPoints`] below two points; [`RheologyError::InvalidElement`] when a frequency is not
    /// greater than the one before it, or a modulus is not finite, negative, or both of a point are zero.
    pub fn oscillation(points: Vec<ModulusPoint>) -> Result<Self, RheologyError> {
        // Check that a point is in order and its moduli are valid, and return the magnitude |G*| of its complex modulus.
        let magnitude = |point: &ModulusPoint, last: f64| {
            check_increasing("angular_frequency", point.angular_frequency, last)?;
            not_negative("storage", point.storage)?;
            not_negative("loss", point.loss)?;
            positive("modulus", point.storage.hypot(point.loss))
        };
        // Divide both moduli of a point by |G*|, so that errors are relative to it.
        let mut rows = Vec::new();
        let mut last = 0.0;
        for (index, point) in points.iter().enumerate() {
            let magnitude = magnitude(point, last).map_err(with_list_index("points", index))?;
            last = point.angular_frequency;
            let row = |quantity, value| Measurement {
                quantity,
                at: last,
                value,
                size: value.max(MIN_RELATIVE_SIZE * magnitude),
                weight: magnitude.recip(),
                isotherm: 0,
            };
            let [storage, loss] = [point.storage, point.loss];
            rows.extend([row(Quantity::Storage, storage), row(Quantity::Loss, loss)]);
        }
        let [first, last] = ends(&rows, points.len())?;
        let time_window = [last.recip(), first.recip()];
        Ok(Self {
            rows,
            time_window,
            joined: None,
        })
    }

    /// The curve as a master curve, with the isotherm of every point.
    pub(super) fn with_isotherms(mut self, places: &[usize], joined: JoinedIsotherms) -> Self {
        for (row, isotherm) in self
            .rows
            .iter_mut()
            .zip(places.iter().flat_map(|one| [*one; 2]))
        {
            row.isotherm = isotherm;
        }
        self.joined = Some(joined);
        self
    }

    /// A curve measured in relaxation.
    ///
    /// # Errors
    /// [`RheologyError::TooFewPoints`] below two points; [`RheologyError::InvalidElement`] when a time is not greater
    /// than the one before it, or a modulus is not finite and greater than zero.
    pub fn relaxation(points: Vec<RelaxationPoint>) -> Result<Self, RheologyError> {
        Self::relaxation_with_sizes(&points, |point| point.modulus)
    }

    /// A curve measured in relaxation, with errors relative to a `size` > 0 \[Pa] of each point.
    pub(super) fn relaxation_with_sizes(
        points: &[RelaxationPoint],
        size: impl Fn(&RelaxationPoint) -> f64,
    ) -> Result<Self, RheologyError> {
        let checked = |point: &RelaxationPoint, last: f64| {
            check_increasing("time", point.time, last)?;
            not_negative("modulus", point.modulus)?;
            positive("modulus", size(point))
        };
        let mut rows = Vec::new();
        let mut last = 0.0;
        for (index, point) in points.iter().enumerate() {
            let size = checked(point, last).map_err(with_list_index("points", index))?;
            last = point.time;
            rows.push(Measurement {
                quantity: Quantity::Relaxation,
                at: last,
                value: point.modulus,
                size,
                weight: size.recip(),
                isotherm: 0,
            });
        }
        let time_window = ends(&rows, points.len())?;
        Ok(Self {
            rows,
            time_window,
            joined: None,
        })
    }

    /// Lowest and highest angular frequency of the curve, \[rad/s]; 1/t for a relaxation.
    pub fn frequencies(&self) -> [f64; 2] {
        let [shortest, longest] = self.time_window;
        [longest.recip(), shortest.recip()]
    }

    /// The curve with storage and loss modulus exchanged; `None` for a relaxation.
    pub(super) fn swapped(&self) -> Option<Self> {
        let swapped = |row: &Measurement| {
            let quantity = match row.quantity {
                Quantity::Storage => Quantity::Loss,
                Quantity::Loss => Quantity::Storage,
                Quantity::Relaxation => return None,
            };
            Some(Measurement { quantity, ..*row })
        };
        Some(Self {
            rows: self.rows.iter().map(swapped).collect::<Option<_>>()?,
            time_window: self.time_window,
            joined: self.joined.clone(),
        })
    }
}

/// Checks that a frequency or time is finite and greater than the one before.
fn check_increasing(
    parameter: &'static str,
    value: f64,
    last: f64,
) -> Result<f64, InvalidParameter> {
    let is_increasing = value.is_finite() && value > last;
    let allowed = "finite, greater than 0 and greater than the one before";
    in_range(parameter, value, is_increasing, allowed)
}

/// First and last frequency \[rad/s] or time \[s] of at least two points; `given` is the number of points, for the error.
fn ends(rows: &[Measurement], given: usize) -> Result<[f64; 2], RheologyError> {
    match rows {
        [first, .., last] if given >= 2 => Ok([first.at, last.at]),
        _ => Err(RheologyError::TooFewPoints { needed: 2, given }),
    }
}
