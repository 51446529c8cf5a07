//! Normal indentation without sliding, on any linear viscoelastic half space: constant force, or any history of force
//! or depth.
//!
//! While the contact grows, the load potential w = K P/(4π) at every moment is a sum of elastic contacts at the depths so far
//! (Lee & Radok 1960), on any grid and in any steps. P is the pressure and K the operator of the influence coefficients. Hence
//! under a constant force steps in time cause no error, on any material; with another history the error is of first order in the
//! lengths of the steps, because force and load are held over a step.

mod follow;
mod history;
mod press;

use indenters::{HistoryPoint, Surface};

use crate::error::check_contact_elements;
pub use crate::march::MotionRow;
use crate::march::{March, Motion};
use crate::{BemError, Elastomer, GridOptions};
pub use follow::{IndentCurve, IndentPoint, indent_along, indent_along_memory};
pub use history::{HistoryOptions, IndentHistory, indent_history};
pub(crate) use press::footprint_after;
pub use press::{PressEstimate, PressSolution, indent, indent_memory, press};

/// Presses `surface` into an undeformed half space and lets it go again, step by step, on one grid, and returns the state at the
/// end of each step. The force or depth of a step holds during the whole step, so that a change is a jump between two steps.
///
/// # Errors
/// [`BemError::InvalidParameter`] for no steps, times that do not increase from above zero, or numbers out of range;
/// [`BemError::GridTooLarge`]; [`BemError::GridTooCoarse`] when no contact covers three elements along x and y;
/// [`BemError::ContactReachesBoundary`]; [`BemError::ContactNotConverged`]; [`BemError::Material`];
/// [`BemError::Indenter`] for heights that are NaN or −∞.
pub fn indent_history_on_grid(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    steps: &[HistoryPoint],
    options: &GridOptions,
) -> Result<Vec<MotionRow>, BemError> {
    // Describe each step as a motion that stays over the same element, because the body does not slide.
    let motion = |step: &HistoryPoint| Motion {
        time: step.time,
        position: 0.0,
        control: step.control,
    };
    let motions: Vec<Motion> = steps.iter().map(motion).collect();
    let mut march = March::new(surface, elastomer, &motions, options)?;
    // The largest contact of the history must cover enough elements; others may be small.
    let mut rows = Vec::with_capacity(steps.len());
    let mut largest = 0;
    while let Some(row) = march.advance()? {
        largest = largest.max(march.elements_across());
        rows.push(row);
    }
    check_contact_elements(largest)?;
    Ok(rows)
}
