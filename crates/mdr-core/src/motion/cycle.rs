//! The cycle in which a reciprocating motion ends: what the elements remember at its beginning is what they remember at its end.
//!
//! A material may remember many cycles, which are not followed one by one: what one of them leaves tells the step of Newton's
//! method to the last one. On the way a step goes on by only so many cycles, more of them where the one before did what
//! was expected (pseudo-transient continuation; Kelley & Keyes 1998, SIAM J. Numer. Anal. 35, 508).

use indenters::{Control, MotionRecord, MovingStep};

use super::contact_history::{ContactHistory, CycleJacobian};
use super::march::MotionProblem;
use super::time_step::n_history_variables;
use super::winkler::WinklerFoundation;
use crate::MdrError;
use crate::steady::Mode;

/// Cycles that are computed before the search for the limit cycle is given up.
const MAX_CYCLES: usize = 400;
/// Cycles after which the tolerance is multiplied by [`LENIENT_TOLERANCE_FACTOR`]. Chosen.
const CYCLES_AT_FULL_TOLERANCE: usize = 100;
/// Factor on the tolerance after [`CYCLES_AT_FULL_TOLERANCE`]. Chosen.
const LENIENT_TOLERANCE_FACTOR: f64 = 10.0;

/// Deviation from the expected residual, relative to the residual before the step, at which the next step covers as
/// many cycles. Chosen.
const TARGET_DEVIATION: f64 = 0.4;
/// Smallest factor on the cycles that a step covers. Chosen.
const MIN_CYCLES_FACTOR: f64 = 0.3;
/// Largest factor on the cycles that a step covers. Chosen.
const MAX_CYCLES_FACTOR: f64 = 10.0;
/// Most cycles that a step covers; from there on it is the full step of Newton's method, to rounding.
const MAX_CYCLES_PER_STEP: f64 = 1e16;
/// Cycles per step with which the next resolution begins, as a part of the last ones on the resolution before.
/// Chosen.
const CARRIED_OVER_CYCLES: f64 = 1e-3;
/// Safety factor on the change by a step that did what was expected, as a bound of what remains. Chosen.
const REMAINDER_SAFETY_FACTOR: f64 = 2.0;
/// Largest deviation that enters the geometric series of what remains, so that the series converges.
const MAX_COUNTED_DEVIATION: f64 = 0.9;
/// Rounding of the amplitudes of recovery, relative to them: 64 units in the last place.
const AMPLITUDE_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The cycle that comes back, to the tolerance; nothing when the chain was not high enough.
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
    let mut rest = f64::INFINITY;
    for n_cycles in 1..=MAX_CYCLES {
        winkler.recovery_amplitudes().copy_from_slice(&search.state);
        let Some((mut record, contact_history)) = run_steps(problem, &mut winkler, steps)? else {
            return Ok(None);
        };
        let deviation = search.update_residual(&contact_history, winkler.recovery_amplitudes());
        if let Some(before) = before {
            rest = record.rest_after(&before, search.remaining_change_factor(deviation));
            report((rest.ln() / tolerance.ln()).clamp(0.0, 1.0));
            let lenience = if n_cycles > CYCLES_AT_FULL_TOLERANCE {
                LENIENT_TOLERANCE_FACTOR
            } else {
                1.0
            };
            if rest <= lenience * tolerance {
                problem.cycles_per_step.set(search.cycles_per_step);
                return Ok(Some(MotionRecord { n_cycles, ..record }));
            }
            search.adapt_step_length(deviation);
        }
        search.newton_step(&contact_history);
        before = Some(record);
    }
    Err(MdrError::NotPeriodic {
        cycles: MAX_CYCLES,
        change: rest,
        tolerance,
    })
}

/// One cycle from what the chain remembers.
fn run_steps(
    problem: &MotionProblem<'_>,
    winkler: &mut WinklerFoundation<'_>,
    steps: &[MovingStep],
) -> Result<Option<(MotionRecord, ContactHistory)>, MdrError> {
    let returned = winkler.reload()?;
    let depth = winkler.depth();
    winkler.start_recording();
    let record = problem.run_steps(winkler, steps, depth, &|_| ())?;
    let contact_history = winkler.take_contact_history();
    let released = winkler.unload_all(0.0);
    problem
        .saved_recovery
        .replace(Some(winkler.save_recovery()));
    Ok(record.map(|mut record| {
        record.imbalance -= problem.force_unit(winkler.spacing()) * (released - returned);
        (record, contact_history)
    }))
}

/// On the way to what is remembered when a cycle comes back.
struct CycleSearch<'a> {
    problem: &'a MotionProblem<'a>,
    state: Vec<f64>,
    /// What is missing at the state.
    residual: Vec<f64>,
    /// What should be missing after the step, and was before.
    expected_residual: Vec<f64>,
    step_residual: f64,
    /// Cycles by which a step goes on.
    cycles_per_step: f64,
}

impl<'a> CycleSearch<'a> {
    fn new(problem: &'a MotionProblem<'a>, state: Vec<f64>) -> Self {
        Self {
            problem,
            residual: Vec::new(),
            expected_residual: vec![0.0; state.len()],
            step_residual: 0.0,
            state,
            cycles_per_step: (CARRIED_OVER_CYCLES * problem.cycles_per_step.get()).max(1.0),
        }
    }

    fn modes(&self) -> &'a [Mode] {
        &self.problem.foundation.modes
    }

    /// Part of a mode that a cycle forgets.
    fn recovered_fraction(&self, mode: &Mode) -> f64 {
        mode.recovered(self.problem.load.duration())
    }

    /// Compares the cycle from the state, which has this end, with what was expected.
    fn update_residual(&mut self, contact_history: &ContactHistory, end: &[f64]) -> f64 {
        self.residual = contact_history.residual(self.modes(), &self.state, end);
        let pairs = self.residual.iter().zip(&self.expected_residual);
        let deviation = norm(pairs.map(|(found, expected_residual)| found - expected_residual));
        let noise = self.rounding();
        if deviation > noise {
            (deviation - noise) / self.step_residual
        } else {
            0.0
        }
    }

    /// Of what is missing.
    fn rounding(&self) -> f64 {
        let n_history_variables = n_history_variables(&self.problem.foundation);
        let weights: Vec<f64> = self
            .modes()
            .iter()
            .map(|mode| {
                AMPLITUDE_ROUNDING
                    / self
                        .recovered_fraction(mode)
                        .max(ContactHistory::MAX_PERIODS_FROM_IMPULSE)
            })
            .collect();
        let rows = self.state.chunks(n_history_variables);
        norm(rows.flat_map(|row| row.iter().zip(&weights).map(|(slot, weight)| slot * weight)))
    }

    /// How many times the change by the last step may be left: it covers at least these cycles of those that are remembered, and
    /// what it does not cover as expected follows like a geometric series.
    fn remaining_change_factor(&self, deviation: f64) -> f64 {
        let remembered = self
            .modes()
            .iter()
            .map(|mode| self.recovered_fraction(mode).recip() - 1.0);
        let uncovered = remembered.fold(0.0, f64::max) / self.cycles_per_step;
        let deviation = deviation.min(MAX_COUNTED_DEVIATION);
        REMAINDER_SAFETY_FACTOR * (deviation / (1.0 - deviation)).max(1.0) + uncovered
    }

    fn adapt_step_length(&mut self, deviation: f64) {
        let factor = (TARGET_DEVIATION / deviation).clamp(MIN_CYCLES_FACTOR, MAX_CYCLES_FACTOR);
        self.cycles_per_step = (factor * self.cycles_per_step).clamp(1.0, MAX_CYCLES_PER_STEP);
    }

    fn newton_step(&mut self, contact_history: &ContactHistory) {
        let foundation = &self.problem.foundation;
        let is_force = matches!(self.problem.load.largest_control(), Control::NormalForce(_));
        let response = CycleJacobian::new(contact_history, foundation, is_force);
        let step = response.step(self.modes(), self.cycles_per_step, &self.residual);
        let left: Vec<f64> = self
            .modes()
            .iter()
            .map(|mode| {
                let lost = self.recovered_fraction(mode);
                (1.0 - lost) / lost / self.cycles_per_step
            })
            .collect();
        self.step_residual = norm(self.residual.iter().copied());
        let rows = self
            .expected_residual
            .chunks_mut(n_history_variables(foundation))
            .zip(step.chunks(n_history_variables(foundation)));
        for (expected_residual, step) in rows {
            for ((expected_residual, step), left) in
                expected_residual.iter_mut().zip(step).zip(&left)
            {
                *expected_residual = left * step;
            }
        }
        self.state
            .iter_mut()
            .zip(&step)
            .for_each(|(state, step)| *state += step);
    }
}

fn norm(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|value| value * value).sum::<f64>().sqrt()
}
