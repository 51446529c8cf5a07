//! A march that stops when its friction is stationary.
//!
//! On a solid the friction coefficient approaches its limit exponentially, once the distance is longer than v λ for
//! every retardation time λ; on a material that flows like the reciprocal of the distance, and is extrapolated.

use indenters::{SlidingLoad, Surface};
use rheology::Material;

use crate::error::{below_one, positive};
use crate::slide::stationary::{halvings, value_at_zero};
use crate::slide::{March, SlideRow, Transient};
use crate::{BemError, GridOptions};

/// When a state counts as stationary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StationaryOptions {
    /// Largest change of the friction coefficient, extrapolated where the material flows, relative to its value.
    pub tolerance: f64,
    /// Distance over which it changes by no more, \[m]: several contact lengths, and several v λ of the slowest
    /// retardation time λ that matters.
    pub over_distance: f64,
}

/// A transient that has come to its end.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct StationarySlide {
    /// The rows from first touch on.
    pub transient: Transient,
    /// Friction coefficient, extrapolated to an infinite distance where the material flows.
    pub friction_coefficient: f64,
    /// Largest change of it over the distance that was asked for, relative to its value.
    pub change: f64,
}

/// Like [`slide_on_grid`](crate::slide::slide_on_grid), but stops as soon as the friction coefficient is stationary; the
/// sliding distance of the load is the longest allowed.
///
/// On an elastic half space, where there is no friction, changes of the order of the contact tolerance count as none.
///
/// # Errors
/// [`BemError::NotStationary`] with the change reached; otherwise like [`slide_on_grid`](crate::slide::slide_on_grid).
pub fn slide_to_stationary(
    surface: &(impl Surface + ?Sized),
    material: &(impl Material + ?Sized),
    load: &SlidingLoad,
    options: &GridOptions,
    stationary: &StationaryOptions,
) -> Result<StationarySlide, BemError> {
    below_one("stationary tolerance", stationary.tolerance)?;
    positive("over_distance", stationary.over_distance)?;
    let mut march = March::sliding(&surface, material, load, options)?;
    let flows = march.material.creep.fluidity() > 0.0;
    let mut rows = Vec::new();
    let mut limits = Limits::default();
    let mut change = 1.0;
    while let Some(row) = march.step()? {
        rows.extend(SlideRow::of(&row));
        let noise = NOISE * options.contact.tolerance * march.steepness();
        limits.push(&rows, flows);
        change = limits.change(stationary.over_distance, noise);
        if change <= stationary.tolerance {
            let friction_coefficient = limits.last();
            let transient = Transient::of(&march, load, rows)?;
            return Ok(StationarySlide {
                transient,
                friction_coefficient,
                change,
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

/// The pressure is accurate to about this many contact tolerances.
const NOISE: f64 = 1e3;

/// The friction coefficients for an infinite distance that the steps so far extrapolate to, with their distances.
#[derive(Debug, Default)]
struct Limits(Vec<[f64; 2]>);

impl Limits {
    fn push(&mut self, rows: &[SlideRow], flows: bool) {
        let Some(last) = rows.last() else {
            return;
        };
        let limit = if !flows || rows.len() < 4 {
            last.friction_coefficient
        } else {
            value_at_zero(&halvings(rows))
        };
        self.0.push([last.sliding_distance, limit]);
    }

    fn last(&self) -> f64 {
        self.0.last().map_or(0.0, |[_, limit]| *limit)
    }

    /// Largest change relative to the last value over the last part of the distance, beyond the noise; 1, as from nothing,
    /// when the distance was not as long.
    fn change(&self, over_distance: f64, noise: f64) -> f64 {
        let Some(&[distance, limit]) = self.0.last() else {
            return 1.0;
        };
        let start = distance - over_distance;
        // As from half the distance on: what is extrapolated looks back that far.
        if start <= 0.0 || self.0.len() < 8 {
            return 1.0;
        }
        let recent = self.0.iter().rev().take_while(|[then, _]| *then >= start);
        let largest = recent
            .map(|[_, then]| (then - limit).abs())
            .fold(0.0, f64::max);
        if largest <= noise {
            return 0.0;
        }
        largest / limit.abs()
    }
}
