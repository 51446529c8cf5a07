//! Normal indentation without sliding, on any linear viscoelastic half space: constant force, or any history of force
//! or depth.
//!
//! While the contact grows, w at every moment is a sum of elastic contacts at the depths so far (Lee & Radok 1960), on
//! any grid and in any steps. Hence under a constant force steps in time cause no error, on any material; with another
//! history the error is of first order in their lengths, because force and load are held over a step.

mod refined;

use indenters::Surface;
use rheology::Material;

use crate::error::positive;
use crate::slide::MIN_CONTACT_ELEMENTS;
use crate::stepping::{Instant, Route, Stepping};
use crate::{BemError, Control, Resolution};
pub use refined::{IndentHistory, PiecewiseLinear, TimeOptions, indent_history_refined};

/// Resolution of an indentation.
pub type IndentOptions = Resolution;

/// One step of a history; its control holds from the step before, so that a change of it is a jump.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IndentStep {
    /// Time at the end of the step, since first touch, \[s].
    pub time: f64,
    /// What is given there.
    pub control: Control,
}

/// The state at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct IndentRow {
    /// Time since first touch, \[s].
    pub time: f64,
    /// Depth of the lowest point, \[m].
    pub indentation_depth: f64,
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// Area of the elements in contact, \[m²].
    pub contact_area: f64,
    /// Number of elements in contact.
    pub n_contact: usize,
}

/// Presses `surface` into an undeformed half space with the constant `normal_force` \[N]; returns the state at each of
/// the `times` \[s], one step each, which must increase and be greater than zero.
///
/// # Errors
/// [`BemError::InvalidParameter`] for a force that is not positive; otherwise like [`indent_history`].
pub fn indent(
    surface: &(impl Surface + ?Sized),
    material: &(impl Material + ?Sized),
    (normal_force, times): (f64, &[f64]),
    options: &IndentOptions,
) -> Result<Vec<IndentRow>, BemError> {
    positive("normal_force", normal_force)?;
    let step = |time: &f64| IndentStep {
        time: *time,
        control: Control::NormalForce(normal_force),
    };
    let steps: Vec<IndentStep> = times.iter().map(step).collect();
    indent_history(surface, material, &steps, options)
}

/// Presses `surface` into an undeformed half space and lets it go again, step by step.
///
/// # Errors
/// [`BemError::InvalidParameter`] for no steps, times that do not increase from above zero, or numbers out of range;
/// [`BemError::GridTooLarge`]; [`BemError::GridTooCoarse`] when no contact covers three elements along x and y;
/// [`BemError::ContactReachesBoundary`]; [`BemError::ContactNotConverged`]; [`BemError::InvalidHeight`];
/// [`BemError::Material`].
pub fn indent_history(
    surface: &(impl Surface + ?Sized),
    material: &(impl Material + ?Sized),
    steps: &[IndentStep],
    options: &IndentOptions,
) -> Result<Vec<IndentRow>, BemError> {
    let ends = steps.iter().map(|step| (step.time, 0.0, step.control));
    let route = Route::through(ends, positive("spacing along x", options.spacing[0])?)?;
    let mut stepping = Stepping::new(surface, material, route, options)?;
    let mut rows = Vec::with_capacity(steps.len());
    let mut largest = 0;
    while let Some(instant) = stepping.advance()? {
        let size = instant
            .bounds
            .map_or(0, |bounds| bounds.shape()[0].min(bounds.shape()[1]));
        largest = largest.max(size);
        rows.push(row(&instant, options));
    }
    if largest < MIN_CONTACT_ELEMENTS {
        return Err(BemError::GridTooCoarse {
            elements: largest,
            needed: MIN_CONTACT_ELEMENTS,
        });
    }
    Ok(rows)
}

fn row(instant: &Instant, options: &IndentOptions) -> IndentRow {
    IndentRow {
        time: instant.leg.time,
        indentation_depth: instant.indentation_depth,
        normal_force: instant.normal_force,
        contact_area: instant.n_contact as f64 * options.spacing[0] * options.spacing[1],
        n_contact: instant.n_contact,
    }
}
