//! A history whose steps in time are halved until their error is the one that is asked for.
//!
//! Between two rows of a history the error of n steps is c₁/n + c₂/n² + …, so that of 2 f_2n − f_n is of second order.

use indenters::{Control, HistoryPoint, Surface};
use numerics::between_zero_and_one;
use rheology::{CreepSpectrum, Material as _};

use super::{MotionRow, indent_history_on_grid};
use crate::{BemError, Elastomer, GridOptions};

/// Smallest ratio of successive changes by halving the steps that an error estimate uses. Derived: it is that of an error of the first
/// order in their length. Changes that fall faster count with this ratio, because two of them may agree by chance.
const FIRST_ORDER_RATIO: f64 = 0.5;
/// Largest ratio r of successive changes that an error estimate uses, with which the error is r/(1 − r) = 9 times the last
/// change. Chosen: changes of the size of the contact tolerance no longer fall, and would give r = 1. It has a case of
/// `evidence tuning`.
const LARGEST_RATIO: f64 = 0.9;

/// How exactly a history is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HistoryOptions {
    /// Grid and stopping criteria.
    pub grid: GridOptions,
    /// Error of force and depth by the steps in time, relative to the largest of each in the history.
    pub relative_error: f64,
    /// Steps between two rows after which the refinement is given up.
    pub max_steps: usize,
}

impl HistoryOptions {
    /// Options for a grid, with an error by the steps in time of at most 1e-3 and up to 256 steps between two rows.
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
    /// Estimated error of force and depth by the steps in time, relative to the largest of each in the history. It is the sum of the
    /// changes by further halvings, or the bound for retardation elements that relax within a step, whichever is larger.
    pub time_error: f64,
    /// Steps made between two rows.
    pub steps_per_row: usize,
}

/// Presses `surface` into an undeformed half space by a force or depth that is a function of time \[s].
///
/// The `times` at which the state is wanted increase from above zero, and include the jumps and kinks of the control. The steps
/// between them are halved until the requested error is met.
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
    let history = refine_time_steps(surface, elastomer, control, times, options)?;
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

/// Halves the steps of a history until the error asked for is met or no more steps are allowed; returns the history with the error
/// reached. Arguments and errors are those of [`indent_history`].
pub(super) fn refine_time_steps(
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
    // Keep the rows of the run with n/2 steps, and the rows extrapolated from the runs with n/4 and n/2 steps.
    let (mut coarse, mut before): (Option<Vec<MotionRow>>, Option<Vec<MotionRow>>) = (None, None);
    let (mut n, mut error, mut change_before) = (1, 1.0, None);
    loop {
        let last = 2 * n > options.max_steps;
        match run(n) {
            Ok(fine) => {
                // Extrapolate, and estimate the error from the change of the extrapolated values.
                let rows = coarse.map(|coarse| extrapolated(&coarse, &fine));
                if let Some((before, rows)) = before.zip(rows.as_ref()) {
                    let change = largest_relative_change(&before, rows);
                    error = remaining_error(change, change_before)
                        .max(unresolved_relaxation(&creep, times, n)?);
                    change_before = Some(change);
                }
                (before, coarse) = (rows, Some(fine));
            }
            // A force that is held over long steps presses too deep, so that the next run has shorter steps.
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

/// Sum of the changes by halving the steps that are still to come after the last one, as a geometric series whose ratio is that of
/// the last change to the one before it. If only one change is known, because a single halving is affordable, the ratio is the
/// geometric mean of the smallest and the largest one, and the sum about twice the change.
///
/// Where a material relaxes over many decades within one interval, changes fall more slowly than the order of the steps says,
/// until its fast elements are resolved.
fn remaining_error(change: f64, before: Option<f64>) -> f64 {
    let ratio = match before {
        Some(before) if before > 0.0 => (change / before).clamp(FIRST_ORDER_RATIO, LARGEST_RATIO),
        Some(_) => FIRST_ORDER_RATIO,
        None => (FIRST_ORDER_RATIO * LARGEST_RATIO).sqrt(),
    };
    change * ratio / (1.0 - ratio)
}

/// Intervals [start, end] between successive times; the first one begins at zero.
fn intervals(times: &[f64]) -> impl Iterator<Item = [f64; 2]> {
    let starts = std::iter::once(&0.0).chain(times);
    starts.zip(times).map(|(&start, &end)| [start, end])
}

/// The points at the ends of all time steps, with `n` equal steps in each interval between the `times`.
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

/// Rows with force and depth extrapolated to steps of length zero, 2 f_2n − f_n (Richardson). The contact is that of the finer rows,
/// because it changes by whole elements. Forces are not negative: the contact opens between two steps.
fn extrapolated(coarse: &[MotionRow], fine: &[MotionRow]) -> Vec<MotionRow> {
    let row = |(coarse, fine): (&MotionRow, &MotionRow)| MotionRow {
        indentation_depth: 2.0 * fine.indentation_depth - coarse.indentation_depth,
        normal_force: (2.0 * fine.normal_force - coarse.normal_force).max(0.0),
        ..*fine
    };
    coarse.iter().zip(fine).map(row).collect()
}

/// Bound of the relative error by retardation elements that are faster than a step, over all intervals between two rows with `n` steps
/// each: the largest ratio of a retardation time to the interval, times the fraction of the element in the compliance. Halving the
/// steps does not reveal this error while they are longer than the retardation time.
fn unresolved_relaxation(creep: &CreepSpectrum, times: &[f64], n: usize) -> Result<f64, BemError> {
    // Only retardation elements that relax within one of the steps cause this error.
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

/// Larger of the relative changes of force and of depth between two solutions: maximum change over all rows, over the maximum value.
fn largest_relative_change(before: &[MotionRow], rows: &[MotionRow]) -> f64 {
    let of = |value: fn(&MotionRow) -> f64| {
        let pairs = before.iter().zip(rows);
        let changes = pairs.map(|(a, b)| (value(a) - value(b)).abs());
        let change = changes.fold(0.0, f64::max);
        let largest = rows.iter().map(|row| value(row).abs()).fold(0.0, f64::max);
        if change > 0.0 { change / largest } else { 0.0 }
    };
    of(|row| row.normal_force).max(of(|row| row.indentation_depth))
}

#[cfg(test)]
mod tests {
    use super::remaining_error;
    use approx::assert_relative_eq;

    /// Changes of errors that are each the same part of the one before add up to the last error; those that fall faster than the
    /// first order count as of the first.
    #[test]
    fn changes_that_fall_slowly_are_summed() {
        let errors = |part: f64| [1.0, part, part * part];
        for (part, expected) in [(0.7, 0.49), (0.5, 0.25), (0.3, 0.21)] {
            let [first, second, third] = errors(part);
            let changes = [first - second, second - third];
            let rest = remaining_error(changes[1], Some(changes[0]));
            assert_relative_eq!(rest, expected, max_relative = 1e-12);
        }
        assert_relative_eq!(remaining_error(1.0, None), 2.0, max_relative = 0.02);
        assert_relative_eq!(remaining_error(1.0, Some(0.5)), 9.0, max_relative = 1e-12);
    }
}
