//! Many items of one task, with a bar on a terminal.

use rayon::prelude::*;

use crate::progress;

/// Runs a task for every item on all threads; results are in the order of the items.
pub(crate) fn in_parallel<T, R, C>(
    task: &'static str,
    items: &[T],
    run: impl Fn(&T) -> R + Sync,
) -> C
where
    T: Sync,
    R: Send,
    C: FromParallelIterator<R>,
{
    let bar = progress::bar(task, items.len());
    let results = items.par_iter().with_max_len(1).map(|item| {
        let result = run(item);
        bar.inc(1);
        result
    });
    let results = results.collect();
    bar.finish_and_clear();
    results
}

/// Runs a task for one item after the other, so that each can be timed.
pub(crate) fn in_turn<T, R, C>(task: &'static str, items: &[T], mut run: impl FnMut(&T) -> R) -> C
where
    C: FromIterator<R>,
{
    let bar = progress::bar(task, items.len());
    let results = items.iter().map(|item| {
        let result = run(item);
        bar.inc(1);
        result
    });
    let results = results.collect();
    bar.finish_and_clear();
    results
}
