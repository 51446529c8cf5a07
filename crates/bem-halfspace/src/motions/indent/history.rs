//! Steps in time that become shorter until they do not matter.
//!
//! Between two rows of a history the error of n steps is c₁/n + c₂/n² + …, so that of 2 f_2n − f_n is of second order.

use indenters::{Control, HistoryPoint, Surface};
use numerics::between_zero_and_one;
use rheology::{CreepSpectrum, Material as _};

use super::{MotionRow, indent_history_on_grid};
use crate::{BemError, Elastomer, GridOptions};

/// How exactly a history is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HistoryOptions {
    /// The grid.
    pub grid: GridOptions,
    /// Error of force and depth by the steps in time, relative to the largest of each in the history.
    pub relative_error: f64,
    /// Steps between two rows after which the refinement is given up.
    pub max_steps: usize,
}

impl HistoryOptions {
    /// On a grid, with an error by the steps in time of at most 1e-3 and up to 256 steps between two rows.
    #[must_use]
    pub const fn new(grid: GridOptions) -> Self {
        Self {
            grid,
            relative_error: 1e-3,
            max_steps: 256,
        }
    }
}

/// A history whose steps in time were refined.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct IndentHistory {
    /// One row per time that was asked for; force and depth are extrapolated in the length of the steps.
    pub rows: Vec<MotionRow>,
    /// Estimated error of force and depth by the steps in time, relative to the largest of each in the history: the last
    /// change by halving them, or the largest effect of elements that yield within a step.
    pub time_error: f64,
    /// Steps made between two rows.
    pub steps_per_row: usize,
}

/// Presses `surface` into an undeformed half space by a force or depth that is a function of time \[s], and halves the
/// steps between the `times` at which the state is wanted until the error asked for is met; jumps and kinks of the
/// control belong among these times, which increase from above zero.
///
/// # Errors
/// [`BemError::TimeNotResolved`] when the error asked for is not met with the steps allowed; otherwise like
/// [`indent_history_on_grid`].
pub fn indent_history(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    control: impl Fn(f64) -> Control,
    times: &[f64],
    options: &HistoryOptions,
) -> Result<IndentHistory, BemError> {
    let relative_error = between_zero_and_one("relative_error", options.relative_error)?;
    let history = refined(surface, elastomer, control, times, options)?;
    let (steps, error) = (history.steps_per_row, history.time_error);
    if error <= relative_error {
        return Ok(history);
    }
    Err(BemError::TimeNotResolved {
        steps,
        error,
        relative_error,
    })
}

/// The same with the error that is reached with the steps allowed.
pub(super) fn refined(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    control: impl Fn(f64) -> Control,
    times: &[f64],
    options: &HistoryOptions,
) -> Result<IndentHistory, BemError> {
    let run = |n: usize| -> Result<Vec<MotionRow>, BemError> {
        let steps = subdivided(&control, times, n);
        let rows = indent_history_on_grid(surface, elastomer, &steps, &options.grid)?;
        Ok(rows.into_iter().skip(n - 1).step_by(n).collect())
    };
    let creep = elastomer.material().creep();
    let (mut coarse, mut before): (Option<Vec<MotionRow>>, Option<Vec<MotionRow>>) = (None, None);
    let (mut n, mut error) = (1, 1.0);
    loop {
        let last = 2 * n > options.max_steps;
        match run(n) {
            Ok(fine) => {
                let rows = coarse.map(|coarse| extrapolated(&coarse, &fine));
                if let Some((before, rows)) = before.zip(rows.as_ref()) {
                    error = difference(&before, rows).max(unresolved(&creep, times, n)?);
                }
                (before, coarse) = (rows, Some(fine));
            }
            // A force that is held over long steps presses too deep.
            Err(BemError::ContactReachesBoundary { .. }) if !last => {}
            Err(refused) => return Err(refused),
        }
        if let Some(rows) = before.take_if(|_| last || error <= options.relative_error) {
            return Ok(IndentHistory {
                rows,
                time_error: error,
                steps_per_row: n,
            });
        }
        n *= 2;
    }
}

/// From each of the times, and zero, to the next.
fn intervals(times: &[f64]) -> impl Iterator<Item = [f64; 2]> {
    let starts = std::iter::once(&0.0).chain(times);
    starts.zip(times).map(|(&start, &end)| [start, end])
}

/// `n` equal steps to each of the times.
fn subdivided(control: impl Fn(f64) -> Control, times: &[f64], n: usize) -> Vec<HistoryPoint> {
    let ends = intervals(times).flat_map(|[start, end]| {
        let inner = move |k| start + (end - start) * (k as f64 / n as f64);
        (1..n).map(inner).chain([end])
    });
    let step = |time| HistoryPoint {
        time,
        control: control(time),
    };
    ends.map(step).collect()
}

/// The contact is that of the finer rows, because elements touch or do not, and no force becomes a pull, because the
/// contact is lost at a moment between steps.
fn extrapolated(coarse: &[MotionRow], fine: &[MotionRow]) -> Vec<MotionRow> {
    let row = |(coarse, fine): (&MotionRow, &MotionRow)| MotionRow {
        indentation_depth: 2.0 * fine.indentation_depth - coarse.indentation_depth,
        normal_force: (2.0 * fine.normal_force - coarse.normal_force).max(0.0),
        ..*fine
    };
    coarse.iter().zip(fine).map(row).collect()
}

/// The effect of elements that yield faster than a step: their time relative to that between two rows, by their part of
/// the compliance. No comparison of steps that are all longer would show it.
fn unresolved(creep: &CreepSpectrum, times: &[f64], n: usize) -> Result<f64, BemError> {
    let mut largest = 0.0_f64;
    for [start, end] in intervals(times) {
        let interval = end - start;
        let compliance = creep.creep_compliance(interval)?;
        for element in creep.elements() {
            if element.retardation_time * (n as f64) < interval {
                let part = element.compliance / compliance;
                largest = largest.max(part * (element.retardation_time / interval));
            }
        }
    }
    Ok(largest)
}

/// Largest difference of force and depth relative to the largest of each.
fn difference(before: &[MotionRow], rows: &[MotionRow]) -> f64 {
    let of = |value: fn(&MotionRow) -> f64| {
        let pairs = before.iter().zip(rows);
        let changes = pairs.map(|(a, b)| (value(a) - value(b)).abs());
        let change = changes.fold(0.0, f64::max);
        let largest = rows.iter().map(|row| value(row).abs()).fold(0.0, f64::max);
        if change > 0.0 { change / largest } else { 0.0 }
    };
    of(|row| row.normal_force).max(of(|row| row.indentation_depth))
}
