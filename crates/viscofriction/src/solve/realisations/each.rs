//! Many surfaces at the same time, with answers that do not depend on how many at once.

use std::ops::Range;

use numerics::{Progress, Watch};
#[cfg(feature = "rayon")]
use rayon::prelude::*;

use crate::solve::answer::Answer;
use crate::solve::error::Result;
use crate::solve::memory::needed;
use crate::solve::plan::plan;
use crate::solve::problem::Problem;

/// How many surfaces are solved at the same time: as many as there are threads and memory for, if all take what the first did.
pub(super) fn at_once(problem: &Problem, first: &Answer) -> usize {
    let elements = first.period_grid.map(|[rows, columns]| rows.max(columns));
    let needed = elements.and_then(|elements| needed(problem, first.method, elements).ok()?);
    let fits = |count: usize| match (problem.max_memory(), needed) {
        (Some(allowed), Some(needed)) => count as f64 * needed <= allowed as f64,
        _ => true,
    };
    (1..=threads())
        .rev()
        .find(|count| fits(*count))
        .unwrap_or(1)
}

#[cfg(feature = "rayon")]
fn threads() -> usize {
    rayon::current_num_threads()
}

#[cfg(not(feature = "rayon"))]
const fn threads() -> usize {
    1
}

/// The answers of some of the surfaces, counted from 0, in their order.
pub(super) fn solve_each(
    problem: &Problem,
    surfaces: Range<u64>,
    at_once: usize,
    progress: &mut Progress,
) -> Vec<Result<Answer>> {
    let surfaces: Vec<u64> = surfaces.collect();
    let mut answers = Vec::new();
    for some in surfaces.chunks(at_once) {
        let count = some.len() as f64;
        // Several cannot tell of parts of themselves.
        let share = progress.share(if some.len() > 1 { 0.0 } else { 1.0 });
        let one = |surface| solve_one(problem, surface, at_once, &share);
        answers.extend(on_threads(some, one));
        progress.add(count);
    }
    answers
}

/// A surface for which a part of the memory was too little has all of it.
fn solve_one(problem: &Problem, surface: u64, at_once: usize, watch: &dyn Watch) -> Result<Answer> {
    let one = problem.of_surface(surface, at_once as u64)?;
    match plan(&one)?.solve_one(watch) {
        Err(why) if at_once > 1 && why.is_of_memory() => solve_one(problem, surface, 1, watch),
        found => found,
    }
}

#[cfg(feature = "rayon")]
pub(super) fn on_threads<T: Send>(
    surfaces: &[u64],
    one: impl Fn(u64) -> T + Sync + Send,
) -> Vec<T> {
    let surfaces = surfaces.par_iter().with_max_len(1);
    surfaces.map(|surface| one(*surface)).collect()
}

#[cfg(not(feature = "rayon"))]
pub(super) fn on_threads<T>(surfaces: &[u64], one: impl Fn(u64) -> T) -> Vec<T> {
    surfaces.iter().map(|surface| one(*surface)).collect()
}
