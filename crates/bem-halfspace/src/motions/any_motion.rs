//! Refinement of any motion, and search for the limit cycle of a reciprocating one.
//!
//! A motion is followed on finer and finer grids. On each of them a reciprocating one is repeated until its limit cycle is found, by a
//! fixed-point iteration on the history variables.
//!
//! Theory: docs/theory/transient-half-space.md, "Motions".

use std::cell::Cell;

use indenters::{MotionRecord, MotionView, Moved, MovingLoad};
use numerics::{
    Accuracy, ErrorParts, FixedPoint, Goal, ITERATION_SHARE, anderson_fixed_point, refine,
};
use rheology::CreepSpectrum;

use crate::BemError;
use crate::estimate::bars::reached_or_error;
use crate::march::largest_retardation_time;

/// Largest number of cycles in the search for the limit cycle. Chosen to limit the time: the search fails with
/// [`BemError::NotPeriodic`] after this number. A cycle that is found does not depend on it.
const MAX_CYCLES: usize = 100;
/// Smallest relative change per cycle that rounding does not hide. Chosen: 45 units in the last place, the rounding of hundreds
/// of steps. A slower approach is refused as [`BemError::CycleTooShort`].
const CYCLE_ROUNDING: f64 = 1e-14;
/// Remaining relative change of the limit cycle if a number of elements is asked for instead of an error. Chosen; from 1e-5 to
/// 1e-2 bars change by at most 4 %, with 0.1 the remaining change prevails. It has a case of `evidence tuning`.
const CYCLE_TOLERANCE_ON_ONE_GRID: f64 = 1e-3;

/// Refines a motion until the error asked for is reached.
///
/// `solve(elements, report)` follows the motion on a number of elements along the contact. `other_errors` returns the errors that finer
/// elements do not reduce, one per quantity of the `view`.
///
/// # Errors
/// [`BemError::NotReached`] with the result on the finest grid if a quantity misses the error asked for; those of `solve`.
pub(super) fn refine_motion(
    goal: &Goal,
    view: &MotionView,
    solve: impl Fn(usize, &dyn Fn(f64)) -> Result<MotionRecord, BemError>,
    other_errors: impl Fn(&MotionRecord) -> Vec<ErrorParts>,
) -> Result<Moved, BemError> {
    // Follow the motion on finer and finer elements and steps until the error asked for is reached.
    let refined = refine(
        goal,
        solve,
        |record| view.quantities(record),
        |record, _: &dyn Fn(f64)| Ok::<_, BemError>(other_errors(record)),
    )?;
    // Return the result, or an error that contains it.
    let missed = refined.missed;
    reached_or_error(missed, MotionView::quantity_name, view.moved(refined))
}

/// Search for the limit cycle of a repeated motion, and its stopping criterion.
pub(super) struct LimitCycle {
    /// Duration of a cycle, \[s].
    period: f64,
    /// Largest retardation time λ, \[s].
    slowest: f64,
    /// Estimated remaining relative change at which the search stops.
    tolerance: f64,
}

impl LimitCycle {
    /// Parameters of the search for the limit cycle of a reciprocating motion: duration of a cycle, largest retardation time, and
    /// the tolerance for an accuracy. `None` for a motion through points, which is not repeated.
    ///
    /// # Errors
    /// [`BemError::NoCycle`] for a material that flows.
    pub(super) fn new(
        load: &MovingLoad,
        creep: &CreepSpectrum,
        accuracy: Accuracy,
    ) -> Result<Option<Self>, BemError> {
        if !load.is_cycle() {
            return Ok(None);
        }
        if creep.fluidity() > 0.0 {
            return Err(BemError::NoCycle);
        }
        Ok(Some(Self {
            period: load.duration(),
            slowest: largest_retardation_time(creep),
            tolerance: match accuracy {
                Accuracy::RelativeError(asked) => ITERATION_SHARE * asked,
                Accuracy::Elements(_) => CYCLE_TOLERANCE_ON_ONE_GRID,
            },
        }))
    }

    /// Finds the limit cycle by a fixed-point iteration on the history variables, beginning with `first`.
    ///
    /// `follow_cycle` follows one cycle from given history variables. It returns the record of the cycle and the history variables at
    /// its end, and reports the fraction of the cycle that is done.
    ///
    /// # Errors
    /// [`BemError::CycleTooShort`] if the change per cycle is below rounding; [`BemError::NotPeriodic`] after [`MAX_CYCLES`] cycles;
    /// those of `follow_cycle`.
    pub(super) fn find(
        &self,
        first: Vec<f64>,
        mut follow_cycle: impl FnMut(&[f64], &dyn Fn(f64)) -> Result<(MotionRecord, Vec<f64>), BemError>,
        report: &dyn Fn(f64),
    ) -> Result<MotionRecord, BemError> {
        // The total remaining change is the change in one cycle times 1/(1 − e^(−T/λ)), for the duration T of a cycle and the
        // largest retardation time λ.
        let slowness = -(-self.period / self.slowest).exp_m1().recip();
        if slowness * CYCLE_ROUNDING > self.tolerance {
            let (period, slowest) = (self.period, self.slowest);
            return Err(BemError::CycleTooShort { period, slowest });
        }
        // Progress is the larger of two fractions: that of the cycles allowed, and ln(change)/ln(tolerance).
        let (mut n_cycles, convergence) = (0, Cell::new(0.0_f64));
        let next_cycle = |from: &[f64]| {
            let begun = f64::from(n_cycles);
            n_cycles += 1;
            let (mut record, to) = follow_cycle(from, &|part| {
                report(convergence.get().max((begun + part) / MAX_CYCLES as f64));
            })?;
            record.history_change = relative_change(from, &to);
            Ok::<_, BemError>((record, to))
        };
        // This closure returns the remaining change of the record, which decides when the search ends.
        let remaining_change = |now: &mut MotionRecord, before: &MotionRecord| {
            let change = now.update_remaining_changes(before, slowness);
            let part = (change.ln() / self.tolerance.ln()).clamp(0.0, 1.0);
            convergence.set(convergence.get().max(part));
            change
        };
        match anderson_fixed_point(
            first,
            MAX_CYCLES,
            self.tolerance,
            next_cycle,
            remaining_change,
        )? {
            FixedPoint::Converged {
                result,
                evaluations,
            } => Ok(MotionRecord {
                n_cycles: evaluations,
                ..result
            }),
            FixedPoint::NotConverged {
                remaining_error: change,
            } => Err(BemError::NotPeriodic {
                cycles: MAX_CYCLES,
                change,
                tolerance: self.tolerance,
            }),
        }
    }
}

/// Ratio of the maximum norm of the difference of two vectors to that of the larger vector; 0 if both vanish.
fn relative_change(from: &[f64], to: &[f64]) -> f64 {
    let largest = |values: &mut dyn Iterator<Item = f64>| {
        values.fold(0.0, |largest: f64, value| largest.max(value.abs()))
    };
    let change = largest(&mut from.iter().zip(to).map(|(from, to)| to - from));
    change / largest(&mut from.iter().chain(to).copied()).max(f64::MIN_POSITIVE)
}
