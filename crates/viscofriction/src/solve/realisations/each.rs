//! Concurrent solution of many surfaces, with answers independent of the number of threads.

use std::ops::{ControlFlow, Range};
use std::sync::{Mutex, PoisonError};

use numerics::{Progress, WorkProgress};
#[cfg(feature = "rayon")]
use rayon::prelude::*;

use crate::solve::answer::Answer;
use crate::solve::error::Result;
use crate::solve::memory::memory_needed;
use crate::solve::plan::plan;
use crate::solve::problem::Problem;
use crate::solve::shared_memory::{share_memory_of, threads};

/// Number of surfaces solved concurrently: limited by the threads, and by the memory if all need as much as the first.
pub(super) fn at_once(problem: &Problem, first: &Answer) -> usize {
    let elements = first.period_grid.map(|[rows, columns]| rows.max(columns));
    let needed =
        elements.and_then(|elements| memory_needed(problem, first.method, elements).ok()?);
    let fits = |count: usize| match (problem.max_memory(), needed) {
        (Some(allowed), Some(needed)) => count as f64 * needed <= allowed as f64,
        _ => true,
    };
    (1..=threads())
        .rev()
        .find(|count| fits(*count))
        .unwrap_or(1)
}

/// The answers of a range of surfaces, counted from 0, in their order.
pub(super) fn solve_each(
    problem: &Problem,
    surfaces: Range<usize>,
    at_once: usize,
    progress: &mut WorkProgress,
) -> Vec<Result<Answer>> {
    let surfaces: Vec<usize> = surfaces.collect();
    // Concurrent surfaces report progress only when they are done.
    let is_alone = at_once.min(surfaces.len()) == 1;
    let known = Mutex::new((progress, Vec::new()));
    let within = |surface, parts| {
        let share = {
            let known = known.lock().unwrap_or_else(PoisonError::into_inner);
            known.0.partial(if is_alone { 1.0 } else { 0.0 })
        };
        solve_one(problem, surface, parts, &share)
    };
    let take = |surface, answer| {
        let mut known = known.lock().unwrap_or_else(PoisonError::into_inner);
        known.0.add(1.0);
        known.1.push((surface, answer));
        ControlFlow::Continue(())
    };
    share_memory_of((surfaces, at_once), within, take);
    let (_, mut answers) = known.into_inner().unwrap_or_else(PoisonError::into_inner);
    answers.sort_by_key(|(surface, _)| *surface);
    answers.into_iter().map(|(_, answer)| answer).collect()
}

/// The answer of a surface within one of `parts` equal parts of the memory; `None` if that is too little.
fn solve_one(
    problem: &Problem,
    surface: usize,
    parts: u64,
    watch: &dyn Progress,
) -> Option<Result<Answer>> {
    let one = match problem.realisation_problem(surface as u64, parts) {
        Ok(one) => one,
        Err(_) if parts > 1 => return None,
        Err(why) => return Some(Err(why.into())),
    };
    let answer = plan(&one)
        .map_err(Into::into)
        .and_then(|plan| plan.solve_one(watch));
    (parts == 1 || !one.is_short_of_memory()).then_some(answer)
}

/// Applies a function to each surface, in parallel; results are in the order of the surfaces.
#[cfg(feature = "rayon")]
pub(super) fn on_threads<T: Send>(
    surfaces: &[u64],
    one: impl Fn(u64) -> T + Sync + Send,
) -> Vec<T> {
    surfaces
        .par_iter()
        .with_max_len(1)
        .map(|surface| one(*surface))
        .collect()
}

/// Applies a function to each surface, on the calling thread.
#[cfg(not(feature = "rayon"))]
pub(super) fn on_threads<T>(surfaces: &[u64], one: impl Fn(u64) -> T) -> Vec<T> {
    surfaces.iter().map(|surface| one(*surface)).collect()
}
