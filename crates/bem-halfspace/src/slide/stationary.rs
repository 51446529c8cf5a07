//! The stationary state behind a transient.
//!
//! On a material that flows the surface ahead of the indenter sinks like ln t, so the friction coefficient approaches
//! its limit only like the reciprocal of the sliding distance S:
//!
//! ```text
//! μ(S) = μ_∞ + m₁/S + m₂/S² + …
//! ```

use crate::BemError;
use crate::slide::{SlideRow, Transient};

/// So many have a last quarter.
const FEWEST_STEPS: usize = 4;

/// The limit of the friction coefficient for an infinite sliding distance.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct StationaryFriction {
    /// μ_∞, extrapolated from the distances S, S/2 and S/4.
    pub friction_coefficient: f64,
    /// Estimated absolute error of the extrapolation: what the term 1/S² changes, and by how much the limits differ to
    /// which the steps of the second half of the distance extrapolate, because the contact changes by whole elements, and the
    /// friction with it. Otherwise the error of the grid is not in it.
    pub distance_error: f64,
    /// Relative change of the friction coefficient over the second half of the distance, which is also, to leading
    /// order, the relative difference between its last value and the limit.
    pub drift: f64,
}

impl Transient {
    /// The last step.
    ///
    /// # Panics
    /// Never for a transient of this crate: it has at least one step.
    #[must_use]
    pub fn last(&self) -> &SlideRow {
        &self.rows[self.rows.len() - 1]
    }

    /// The stationary friction coefficient, with the slope averaged over each step.
    ///
    /// The state counts as stationary when the friction coefficient changed by less than `drift_tolerance` of its
    /// value over the second half of the sliding distance. The extrapolation is that of a material that flows; on a
    /// solid its error covers the extrapolation of a friction that is stationary already.
    ///
    /// # Errors
    /// [`BemError::NotStationary`] with the drift reached, also after fewer than four steps.
    pub fn stationary(&self, drift_tolerance: f64) -> Result<StationaryFriction, BemError> {
        let n = self.rows.len();
        let last = self.last();
        let value = last.friction_coefficient;
        let not_stationary = |drift| BemError::NotStationary {
            sliding_distance: last.sliding_distance,
            drift,
            friction_coefficient: value,
            tolerance: drift_tolerance,
        };
        if n < FEWEST_STEPS {
            return Err(not_stationary(1.0));
        }
        let points = halvings(&self.rows);
        let drift = ((value - points[1].1) / value).abs();
        if drift <= drift_tolerance {
            let friction_coefficient = value_at_zero(&points);
            let last_term = (friction_coefficient - value_at_zero(&points[..2])).abs();
            return Ok(StationaryFriction {
                friction_coefficient,
                distance_error: last_term + scatter_of_limits(&self.rows),
                drift,
            });
        }
        Err(not_stationary(drift))
    }
}

/// By how much the limits differ to which the steps of the second half of the distance extrapolate.
fn scatter_of_limits(rows: &[SlideRow]) -> f64 {
    let [mut lowest, mut highest] = [f64::INFINITY, f64::NEG_INFINITY];
    let first = (rows.len() / 2).max(FEWEST_STEPS);
    for count in first..=rows.len() {
        let limit = value_at_zero(&halvings(&rows[..count]));
        lowest = limit.min(lowest);
        highest = limit.max(highest);
    }
    highest - lowest
}

/// The last row and those at a half and a quarter of its distance, as (reciprocal distance, friction coefficient).
pub(super) fn halvings(rows: &[SlideRow]) -> [(f64, f64); 3] {
    let n = rows.len();
    [n, n / 2, n / 4].map(|count| {
        let step = &rows[count - 1];
        (1.0 / step.sliding_distance, step.friction_coefficient)
    })
}

/// Value at zero of the polynomial through the points (Lagrange).
pub(super) fn value_at_zero(points: &[(f64, f64)]) -> f64 {
    let term = |&(position, value): &(f64, f64)| {
        let others = points
            .iter()
            .map(|&(other, _)| other)
            .filter(|other| other.total_cmp(&position).is_ne());
        value
            * others
                .map(|other| other / (other - position))
                .product::<f64>()
    };
    points.iter().map(term).sum()
}
