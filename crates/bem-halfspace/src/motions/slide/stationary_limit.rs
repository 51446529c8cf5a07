//! Extrapolation of a transient to its stationary state.
//!
//! On a half space that flows the surface ahead of the indenter sinks like ln t. The friction coefficient therefore approaches
//! its limit only like the reciprocal of the sliding distance S:
//!
//! ```text
//! μ(S) = μ_∞ + m₁/S + m₂/S² + …
//! ```
//! On a solid it approaches the limit exponentially, once S is longer than v λ for all retardation times λ.
//!
//! Theory: docs/theory/transient-half-space.md, "Finite sliding distance".

use indenters::{SlidingLoad, Surface};
use numerics::{between_zero_and_one, positive};

use crate::motions::slide::{March, SlideRow, Transient};
use crate::{BemError, Elastomer, GridOptions};

/// Smallest number of steps S that can be extrapolated to infinite distance. Derived: S, S/2 and S/4 must be different steps.
const MIN_STEPS: usize = 4;
/// Smallest number of steps after which the change of extrapolated values is meaningful. Derived: half of them must allow an
/// extrapolation, which takes [`MIN_STEPS`].
const MIN_STEPS_OF_CHANGE: usize = 2 * MIN_STEPS;

/// The limit of the friction coefficient for an infinite sliding distance.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct StationaryFriction {
    /// Friction coefficient μ_∞, extrapolated from the distances S, S/2 and S/4.
    pub friction_coefficient: f64,
    /// Estimated absolute error of the extrapolation: half the spread of the limits extrapolated from each step of the last two
    /// fifths of the distance. A remaining term 1/S³ changes these limits by 3.6 times its size at the end; the contact, and friction
    /// with it, changes by whole elements. The error of the grid is included only as far as that.
    pub distance_error: f64,
    /// Relative change of the friction coefficient over the second half of the distance, which is also, to leading
    /// order, the relative difference between its last value and the limit.
    pub drift: f64,
}

impl Transient {
    /// Row of the last step.
    ///
    /// # Panics
    /// Never for a transient of this crate: it has at least one row.
    pub fn last(&self) -> &SlideRow {
        &self.rows[self.rows.len() - 1]
    }

    /// The stationary friction coefficient, with the slope averaged over each step.
    ///
    /// The state counts as stationary if the friction coefficient changed by at most `drift_tolerance` of its value over the second
    /// half of the sliding distance. The extrapolation assumes a material that flows. On a solid, where friction is stationary
    /// already, `distance_error` covers its effect.
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
        if n < MIN_STEPS {
            return Err(not_stationary(1.0));
        }
        // Compute the relative change of the friction coefficient over the second half of the march.
        let halfway = self.rows[n / 2 - 1].friction_coefficient;
        let drift = ((value - halfway) / value).abs();
        // If this change is within the tolerance, extrapolate the friction to an infinite distance.
        if drift <= drift_tolerance {
            return Ok(StationaryFriction {
                friction_coefficient: extrapolated_limit(&self.rows),
                distance_error: 0.5 * spread_of_limits(&self.rows),
                drift,
            });
        }
        Err(not_stationary(drift))
    }
}

/// Range, largest minus smallest, of the friction coefficients that are extrapolated from each row of the last two fifths.
fn spread_of_limits(rows: &[SlideRow]) -> f64 {
    let [mut lowest, mut highest] = [f64::INFINITY, f64::NEG_INFINITY];
    let first = (3 * rows.len() / 5).max(MIN_STEPS);
    for count in first..=rows.len() {
        let limit = extrapolated_limit(&rows[..count]);
        lowest = limit.min(lowest);
        highest = limit.max(highest);
    }
    highest - lowest
}

/// Friction coefficient for an infinite distance: the value at 1/S = 0 of the polynomial in 1/S through the last row and those at a
/// half and a quarter of their number (Lagrange).
fn extrapolated_limit(rows: &[SlideRow]) -> f64 {
    let n = rows.len();
    let nodes = [n, n / 2, n / 4].map(|count| &rows[count - 1]);
    let term = |row: &SlideRow| {
        let here = 1.0 / row.sliding_distance;
        let factors = nodes
            .iter()
            .map(|other| 1.0 / other.sliding_distance)
            .filter(|other| other.total_cmp(&here).is_ne())
            .map(|other| other / (other - here));
        row.friction_coefficient * factors.product::<f64>()
    };
    nodes.into_iter().map(term).sum()
}

/// Criterion by which a state counts as stationary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StationaryOptions {
    /// Largest change of the friction coefficient relative to its value; on a half space that flows of the extrapolated one.
    pub tolerance: f64,
    /// Sliding distance over which the change is measured, \[m]: several contact lengths, and several v λ of the largest retardation
    /// time λ that matters.
    pub over_distance: f64,
}

/// A transient that has reached the stationary state.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct StationarySlide {
    /// The transient from first touch on.
    pub transient: Transient,
    /// Friction coefficient; extrapolated to an infinite distance on a half space that flows.
    pub friction_coefficient: f64,
    /// Largest change of the friction coefficient over [`StationaryOptions::over_distance`], relative to its value.
    pub change: f64,
    /// Estimated relative error by the finite sliding distance, from the change over the second half of that distance.
    pub truncation_error: f64,
}

/// Like [`slide_on_grid`](crate::motions::slide::slide_on_grid), but stops as soon as the friction coefficient is stationary. The
/// sliding distance of the load is an upper bound.
///
/// On an elastic half space, where there is no friction, changes of the order of the contact tolerance count as zero.
///
/// # Errors
/// [`BemError::NotStationary`] with the change reached; otherwise like [`slide_on_grid`](crate::motions::slide::slide_on_grid).
pub fn slide_to_stationary(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    options: &GridOptions,
    stationary: &StationaryOptions,
) -> Result<StationarySlide, BemError> {
    let march = March::sliding(surface, elastomer, load, options)?;
    slide_until_stationary(march, load, stationary, &|_| ())
}

/// Marches until the friction coefficient is stationary, and reports the fraction of the longest distance that is done.
pub(super) fn slide_until_stationary(
    mut march: March,
    load: &SlidingLoad,
    stationary: &StationaryOptions,
    report: &dyn Fn(f64),
) -> Result<StationarySlide, BemError> {
    between_zero_and_one("stationary tolerance", stationary.tolerance)?;
    positive("over_distance", stationary.over_distance)?;
    let flows = march.sinks_without_limit;
    let mut rows = Vec::new();
    let mut limits = ExtrapolatedFriction::default();
    let mut change = 1.0;
    while let Some(row) = march.step()? {
        rows.extend(SlideRow::in_contact(&row));
        report(march.fraction_done());
        // Changes below the tolerance of the contact count as zero, because its solution is not more accurate.
        let noise = march.tolerance() * march.mean_slope_modulus();
        limits.push(&rows, flows);
        change = limits.largest_change(stationary.over_distance, noise);
        if change <= stationary.tolerance {
            // The state is stationary. Estimate the remaining change from the change over the second half of the distance.
            let friction_coefficient = limits.last();
            let transient = Transient::from_march(&march, load, rows)?;
            return Ok(StationarySlide {
                transient,
                friction_coefficient,
                change,
                truncation_error: limits.largest_change(0.5 * stationary.over_distance, noise)
                    / CHANGE_OVER_REMAINDER,
            });
        }
    }
    Err(BemError::NotStationary {
        sliding_distance: rows.last().map_or(0.0, |row| row.sliding_distance),
        drift: change,
        friction_coefficient: limits.last(),
        tolerance: stationary.tolerance,
    })
}

/// Lower bound √e − 1 of the ratio of two changes of a quantity: that over the second half of a distance, and that which remains
/// at the end. Derived: the deviation from the limit falls at least e-fold over the distance, so at least √e-fold over the half.
const CHANGE_OVER_REMAINDER: f64 = 0.648_721_270_700_128_1;

/// Extrapolated friction coefficient after each step, as [sliding distance \[m], limit].
#[derive(Debug, Default)]
struct ExtrapolatedFriction(Vec<[f64; 2]>);

impl ExtrapolatedFriction {
    /// Appends the value of the last row: its friction coefficient, or on a half space that `flows` that extrapolated to infinite
    /// distance.
    fn push(&mut self, rows: &[SlideRow], flows: bool) {
        let Some(last) = rows.last() else {
            return;
        };
        // On a half space that flows, extrapolate in 1/S from four steps on; otherwise take the last value.
        let limit = match rows.len() {
            MIN_STEPS.. if flows => extrapolated_limit(rows),
            _ => last.friction_coefficient,
        };
        self.0.push([last.sliding_distance, limit]);
    }

    /// The last value; 0 without any.
    fn last(&self) -> f64 {
        self.0.last().map_or(0.0, |[_, limit]| *limit)
    }

    /// Largest change over the last `over_distance` \[m], relative to the last value. It is 0 if the absolute change does not exceed
    /// `noise`, and 1 if the sliding distance is shorter.
    fn largest_change(&self, over_distance: f64, noise: f64) -> f64 {
        let Some(&[distance, limit]) = self.0.last() else {
            return 1.0;
        };
        let start = distance - over_distance;
        if start <= 0.0 || self.0.len() < MIN_STEPS_OF_CHANGE {
            return 1.0;
        }
        let recent = self.0.iter().rev().take_while(|[then, _]| *then >= start);
        let changes = recent.map(|[_, then]| (then - limit).abs());
        let largest = changes.fold(0.0, f64::max);
        if largest <= noise {
            return 0.0;
        }
        largest / limit.abs()
    }
}
