//! The cycle in which a reciprocating motion ends: what the elements remember at its beginning is what they remember at its end.
//!
//! ```text
//! |x − x*| ≤ |g(x) − x| / (1 − e^(−T/λ))        for a cycle g of the time T and the slowest retardation time λ
//! ```

use indenters::{MotionRecord, MovingStep};
use numerics::{Settled, settle};

use super::chain::Chain;
use super::march::Problem;
use crate::MdrError;

/// Cycles after which the search is given up.
const MOST_CYCLES: usize = 400;

/// The cycle that is like the one before, to the tolerance; nothing when the chain was not high enough.
pub(super) fn cycle(
    problem: &Problem<'_>,
    mut chain: Chain<'_>,
    legs: &[MovingStep],
    tell: &dyn Fn(f64),
) -> Result<Option<MotionRecord>, MdrError> {
    let tolerance = problem.tolerance;
    let slowness = -(-problem.load.duration() / problem.memory).exp_m1().recip();
    let unit = problem.unit(chain.spacing());
    chain.lift(0.0);
    if let Some(kept) = problem.kept.take() {
        chain.recall(&kept);
    }
    let first = chain.memory().to_vec();
    let pass = |from: &[f64]| {
        chain.memory().copy_from_slice(from);
        let returned = chain.lower().map_err(Stop::Failed)?;
        let depth = chain.depth();
        let record = problem.pass(&mut chain, legs, depth, &|_| ());
        let mut record = record.map_err(Stop::Failed)?.ok_or(Stop::TooLow)?;
        let kept = chain.lift(0.0);
        record.imbalance -= unit * (kept - returned);
        problem.kept.replace(Some(chain.kept()));
        Ok((record, chain.memory().to_vec()))
    };
    let left = |now: &mut MotionRecord, before: &MotionRecord| {
        let left = now.rest_after(before, slowness);
        tell((left.ln() / tolerance.ln()).clamp(0.0, 1.0));
        left
    };
    match settle(first, (MOST_CYCLES, tolerance), pass, left) {
        Ok(Settled::Found(record, n_cycles)) => Ok(Some(MotionRecord { n_cycles, ..record })),
        Ok(Settled::Missed(change)) => Err(MdrError::NotPeriodic {
            cycles: MOST_CYCLES,
            change,
            tolerance,
        }),
        Err(Stop::TooLow) => Ok(None),
        Err(Stop::Failed(error)) => Err(error),
    }
}

/// Why a cycle was not followed to its end.
enum Stop {
    /// The chain was not high enough.
    TooLow,
    Failed(MdrError),
}
