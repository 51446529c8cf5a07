//! The cycle in which a reciprocating motion ends: what the elements remember at its beginning is what they remember at its end.
//!
//! A material may remember many cycles, which are not followed one by one: what one of them leaves tells the step of Newton's
//! method to the last one. On the way a step goes on by only so many cycles, more of them where the one before did what
//! was expected (pseudo-transient continuation; Kelley & Keyes 1998, SIAM J. Numer. Anal. 35, 508).

use indenters::{Control, MotionRecord, MovingStep};

use super::chain::Chain;
use super::contacts::{Contacts, Response};
use super::march::Problem;
use super::time_step::n_slots;
use crate::MdrError;
use crate::steady::Mode;

/// Cycles that are followed before the search is given up, and those after which what may be left is so much more.
const MOST_CYCLES: usize = 400;
const MANY_CYCLES: usize = 100;
const LENIENCE: f64 = 10.0;

/// Deviation from what was expected, relative to what was missing, at which a step goes on by as many cycles as the one
/// before; and the bounds of what those are multiplied by.
const DEVIATION: f64 = 0.4;
const SLOWER: f64 = 0.3;
const FASTER: f64 = 10.0;
const MOST_AT_ONCE: f64 = 1e16;
/// Part of these cycles with which the next resolution begins.
const CARRIED_OVER: f64 = 1e-3;
/// What may be left relative to the change by a step that did what was expected, and the largest deviation that counts.
const SAFETY: f64 = 2.0;
const WORST: f64 = 0.9;
/// Rounding of what is remembered.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The cycle that comes back, to the tolerance; nothing when the chain was not high enough.
pub(super) fn cycle(
    problem: &Problem<'_>,
    mut chain: Chain<'_>,
    legs: &[MovingStep],
    tell: &dyn Fn(f64),
) -> Result<Option<MotionRecord>, MdrError> {
    let tolerance = problem.tolerance;
    chain.lift(0.0);
    if let Some(kept) = problem.kept.take() {
        chain.recall(&kept);
    }
    let mut search = Search::new(problem, chain.memory().to_vec());
    let mut before: Option<MotionRecord> = None;
    let mut rest = f64::INFINITY;
    for n_cycles in 1..=MOST_CYCLES {
        chain.memory().copy_from_slice(&search.state);
        let Some((mut record, contacts)) = pass(problem, &mut chain, legs)? else {
            return Ok(None);
        };
        let deviation = search.arrive(&contacts, chain.memory());
        if let Some(before) = before {
            rest = record.rest_after(&before, search.left(deviation));
            tell((rest.ln() / tolerance.ln()).clamp(0.0, 1.0));
            let lenience = if n_cycles > MANY_CYCLES {
                LENIENCE
            } else {
                1.0
            };
            if rest <= lenience * tolerance {
                problem.at_once.set(search.at_once);
                return Ok(Some(MotionRecord { n_cycles, ..record }));
            }
            search.adapt(deviation);
        }
        search.go_on(&contacts);
        before = Some(record);
    }
    Err(MdrError::NotPeriodic {
        cycles: MOST_CYCLES,
        change: rest,
        tolerance,
    })
}

/// One cycle from what the chain remembers.
fn pass(
    problem: &Problem<'_>,
    chain: &mut Chain<'_>,
    legs: &[MovingStep],
) -> Result<Option<(MotionRecord, Contacts)>, MdrError> {
    let returned = chain.lower()?;
    let depth = chain.depth();
    chain.note();
    let record = problem.pass(chain, legs, depth, &|_| ())?;
    let contacts = chain.noted();
    let kept = chain.lift(0.0);
    problem.kept.replace(Some(chain.kept()));
    Ok(record.map(|mut record| {
        record.imbalance -= problem.unit(chain.spacing()) * (kept - returned);
        (record, contacts)
    }))
}

/// On the way to what is remembered when a cycle comes back.
struct Search<'a> {
    problem: &'a Problem<'a>,
    state: Vec<f64>,
    /// What is missing at the state.
    residual: Vec<f64>,
    /// What should be missing after the step, and was before.
    expected: Vec<f64>,
    missing: f64,
    /// Cycles by which a step goes on.
    at_once: f64,
}

impl<'a> Search<'a> {
    fn new(problem: &'a Problem<'a>, state: Vec<f64>) -> Self {
        Self {
            problem,
            residual: Vec::new(),
            expected: vec![0.0; state.len()],
            missing: 0.0,
            state,
            at_once: (CARRIED_OVER * problem.at_once.get()).max(1.0),
        }
    }

    fn modes(&self) -> &'a [Mode] {
        &self.problem.foundation.modes
    }

    /// Part of a mode that a cycle forgets.
    fn lost(&self, mode: &Mode) -> f64 {
        mode.recovered(self.problem.load.duration())
    }

    /// Compares the cycle from the state, which has this end, with what was expected.
    fn arrive(&mut self, contacts: &Contacts, end: &[f64]) -> f64 {
        self.residual = contacts.residual(self.modes(), &self.state, end);
        let pairs = self.residual.iter().zip(&self.expected);
        let deviation = norm(pairs.map(|(found, expected)| found - expected));
        let noise = self.rounding();
        if deviation > noise {
            (deviation - noise) / self.missing
        } else {
            0.0
        }
    }

    /// Of what is missing.
    fn rounding(&self) -> f64 {
        let n_slots = n_slots(&self.problem.foundation);
        let weights: Vec<f64> = self
            .modes()
            .iter()
            .map(|mode| ROUNDING / self.lost(mode).max(Contacts::SLOW))
            .collect();
        let rows = self.state.chunks(n_slots);
        norm(rows.flat_map(|row| row.iter().zip(&weights).map(|(slot, weight)| slot * weight)))
    }

    /// How many times the change by the last step may be left: it covers at least these cycles of those that are remembered, and
    /// what it does not cover as expected follows like a geometric series.
    fn left(&self, deviation: f64) -> f64 {
        let remembered = self
            .modes()
            .iter()
            .map(|mode| self.lost(mode).recip() - 1.0);
        let uncovered = remembered.fold(0.0, f64::max) / self.at_once;
        let deviation = deviation.min(WORST);
        SAFETY * (deviation / (1.0 - deviation)).max(1.0) + uncovered
    }

    fn adapt(&mut self, deviation: f64) {
        let factor = (DEVIATION / deviation).clamp(SLOWER, FASTER);
        self.at_once = (factor * self.at_once).clamp(1.0, MOST_AT_ONCE);
    }

    fn go_on(&mut self, contacts: &Contacts) {
        let foundation = &self.problem.foundation;
        let is_force = matches!(self.problem.load.largest_control(), Control::NormalForce(_));
        let response = Response::new(contacts, foundation, is_force);
        let step = response.step(self.modes(), self.at_once, &self.residual);
        let left: Vec<f64> = self
            .modes()
            .iter()
            .map(|mode| {
                let lost = self.lost(mode);
                (1.0 - lost) / lost / self.at_once
            })
            .collect();
        self.missing = norm(self.residual.iter().copied());
        let rows = self
            .expected
            .chunks_mut(n_slots(foundation))
            .zip(step.chunks(n_slots(foundation)));
        for (expected, step) in rows {
            for ((expected, step), left) in expected.iter_mut().zip(step).zip(&left) {
                *expected = left * step;
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
