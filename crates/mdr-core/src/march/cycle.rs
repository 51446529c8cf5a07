//! Limit cycle of a reciprocating motion: the amplitudes of recovery at its end are those at its beginning.
//!
//! A slow material needs many cycles to settle, which are not computed one by one. The residual of one cycle gives an
//! approximate Newton step to the limit cycle. Far from it a step covers a finite number of cycles, and more of them after
//! a step that did what was expected (pseudo-transient continuation; Kelley & Keyes 1998, SIAM J. Numer. Anal. 35, 508).

use indenters::{Control, MotionRecord, MovingStep};

use super::contact_history::{ContactHistory, CycleJacobian};
use super::motion_problem::MotionProblem;
use super::winkler::WinklerFoundation;
use crate::MdrError;
use crate::branches::{Mode, n_history};
use crate::history::SUM_ROUNDING;

/// Largest number of cycles in the search for the limit cycle. Chosen to limit the time: after them the search ends with
/// [`MdrError::NotPeriodic`]. A cycle that is found does not depend on it.
const MAX_CYCLES: usize = 400;

/// Finds the limit cycle to the tolerance of the problem, from the amplitudes of the resolution before if there is one; `None` if the
/// contact went beyond the sampled heights.
pub(super) fn find_limit_cycle(
    problem: &MotionProblem<'_>,
    mut winkler: WinklerFoundation<'_>,
    steps: &[MovingStep],
    report: &dyn Fn(f64),
) -> Result<Option<MotionRecord>, MdrError> {
    let tolerance = problem.tolerance;
    winkler.unload_all(0.0);
    if let Some(saved_recovery) = problem.saved_recovery.take() {
        winkler.restore_recovery(&saved_recovery);
    }
    let mut search = CycleSearch::new(problem, winkler.recovery_amplitudes().to_vec());
    let mut before: Option<MotionRecord> = None;
    let mut remaining_change = f64::INFINITY;
    for n_cycles in 1..=MAX_CYCLES {
        // Compute one cycle from the present amplitudes; its energy balance includes what the loaded elements store.
        winkler.recovery_amplitudes().copy_from_slice(&search.state);
        let returned = winkler.reload()?;
        let depth = winkler.depth();
        winkler.start_recording();
        let record = problem.run_steps(&mut winkler, steps, depth, &|_| ())?;
        let contact_history = winkler.take_contact_history();
        let released = winkler.unload_all(0.0);
        problem
            .saved_recovery
            .replace(Some(winkler.save_recovery()));
        let Some(mut record) = record else {
            return Ok(None);
        };
        record.imbalance -= problem.force_unit(winkler.spacing()) * (released - returned);

        // Stop when the change that may remain is below the tolerance.
        let deviation = search.update_residual(&contact_history, winkler.recovery_amplitudes());
        if let Some(before) = before {
            remaining_change =
                record.update_remaining_changes(&before, search.remaining_change_factor(deviation));
            report((remaining_change.ln() / tolerance.ln()).clamp(0.0, 1.0));
            if remaining_change <= tolerance {
                return Ok(Some(MotionRecord { n_cycles, ..record }));
            }

            // Cover more cycles by the next step if this one did what was expected, fewer if not, as in the step size control of
            // Hairer, Nørsett & Wanner 1993, Solving Ordinary Differential Equations I, (II.4.13), of first order. A step over the
            // reciprocal of the rounding error is the full Newton step.
            search.cycles_per_step =
                (search.cycles_per_step / deviation).clamp(1.0, f64::EPSILON.recip());
        }
        search.newton_step(&contact_history);
        before = Some(record);
    }
    Err(MdrError::NotPeriodic {
        cycles: MAX_CYCLES,
        change: remaining_change,
        tolerance,
    })
}

/// State of the search for the limit cycle.
struct CycleSearch<'a> {
    /// Line, motion and foundation.
    problem: &'a MotionProblem<'a>,
    /// Amplitudes of recovery at the beginning of the cycle, element by element, \[m].
    state: Vec<f64>,
    /// Residual F at the state, \[m].
    residual: Vec<f64>,
    /// Residual after the last step according to its linear model, \[m].
    expected_residual: Vec<f64>,
    /// Norm of the residual before the last step, \[m].
    residual_before: f64,
    /// Number of cycles that a step covers.
    cycles_per_step: f64,
}

impl<'a> CycleSearch<'a> {
    /// A search that starts from the amplitudes `state`, element by element, \[m].
    fn new(problem: &'a MotionProblem<'a>, state: Vec<f64>) -> Self {
        Self {
            problem,
            residual: Vec::new(),
            expected_residual: vec![0.0; state.len()],
            residual_before: 0.0,
            state,
            cycles_per_step: 1.0,
        }
    }

    /// Modes of recovery of the foundation.
    fn modes(&self) -> &'a [Mode] {
        &self.problem.foundation.modes
    }

    /// Fraction 1 − e^(−T/λ) of a mode that recovers in one cycle of the period T.
    fn recovered_fraction(&self, mode: &Mode) -> f64 {
        mode.recovered(self.problem.load.duration())
    }

    /// Computes the residual of a cycle that ends with the amplitudes `end`; returns its deviation from the expected one,
    /// relative to the residual before the step.
    fn update_residual(&mut self, contact_history: &ContactHistory, end: &[f64]) -> f64 {
        self.residual = contact_history.residual(self.modes(), &self.state, end);
        let pairs = self.residual.iter().zip(&self.expected_residual);
        let deviation = norm(pairs.map(|(found, expected_residual)| found - expected_residual));
        let rounding = self.rounding();
        if deviation > rounding {
            (deviation - rounding) / self.residual_before
        } else {
            0.0
        }
    }

    /// Rounding of the norm of the residual, \[m].
    fn rounding(&self) -> f64 {
        let n_history = n_history(&self.problem.foundation);
        let weights: Vec<f64> = self
            .modes()
            .iter()
            .map(|mode| {
                SUM_ROUNDING
                    / self
                        .recovered_fraction(mode)
                        .max(ContactHistory::MAX_PERIODS_FROM_IMPULSE)
            })
            .collect();
        let rows = self.state.chunks(n_history);
        norm(rows.flat_map(|row| row.iter().zip(&weights).map(|(term, weight)| term * weight)))
    }

    /// Bound of the remaining change over the change by the last step.
    ///
    /// Cycles that the step does not cover remain in proportion. The deviation from what was expected remains like a geometric
    /// series, which has no bound for deviations of 1 or more.
    fn remaining_change_factor(&self, deviation: f64) -> f64 {
        let settling_cycles = self
            .modes()
            .iter()
            .map(|mode| self.recovered_fraction(mode).recip() - 1.0);
        let from_uncovered_cycles = settling_cycles.fold(0.0, f64::max) / self.cycles_per_step;
        if deviation >= 1.0 {
            return f64::INFINITY;
        }
        (deviation / (1.0 - deviation)).max(1.0) + from_uncovered_cycles
    }

    /// Takes the approximate Newton step from the state, and predicts the residual after it.
    fn newton_step(&mut self, contact_history: &ContactHistory) {
        let foundation = &self.problem.foundation;
        let is_force = matches!(self.problem.load.largest_control(), Control::NormalForce(_));
        let jacobian = CycleJacobian::new(contact_history, foundation, is_force);
        let step = jacobian.step(self.modes(), self.cycles_per_step, &self.residual);
        // The residual predicted after the step is the share of the cycles that the step does not cover, mode by mode.
        let remaining: Vec<f64> = self
            .modes()
            .iter()
            .map(|mode| {
                let recovered = self.recovered_fraction(mode);
                (1.0 - recovered) / recovered / self.cycles_per_step
            })
            .collect();
        self.residual_before = norm(self.residual.iter().copied());
        let rows = self
            .expected_residual
            .chunks_mut(n_history(foundation))
            .zip(step.chunks(n_history(foundation)));
        for (expected_residual, step) in rows {
            for ((expected_residual, step), factor) in
                expected_residual.iter_mut().zip(step).zip(&remaining)
            {
                *expected_residual = factor * step;
            }
        }
        self.state
            .iter_mut()
            .zip(&step)
            .for_each(|(state, step)| *state += step);
    }
}

/// Euclidean norm.
fn norm(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|value| value * value).sum::<f64>().sqrt()
}
