//! Many tasks at the same time within one limit of memory, with results that do not depend on how many threads there are.
//!
//! A method chooses its grids by the memory that it has, so that a smaller limit may change its answer. A result that was found
//! within a part of the memory is therefore kept only where the limit has refused nothing.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// The number of threads that compute.
#[cfg(feature = "rayon")]
pub(super) fn threads() -> usize {
    rayon::current_num_threads()
}

#[cfg(not(feature = "rayon"))]
pub(super) const fn threads() -> usize {
    1
}

/// Does tasks at the same time, one on each thread of the pool, each with an equal part of the memory.
///
/// `work` is told the task and in how many parts the memory is divided, and returns `None` if its part was too little. Such tasks
/// are done again when the others are done, half as many at the same time, and in the end alone with all of the memory. `take`
/// gets each result as soon as it is there; no task is begun after it breaks.
pub fn share_memory<T>(
    tasks: Vec<usize>,
    work: impl Fn(usize, u64) -> Option<T> + Sync,
    take: impl Fn(usize, T) -> ControlFlow<()> + Sync,
) {
    share_memory_of((tasks, threads()), work, take);
}

/// As [`share_memory`], of at most so many tasks at the same time.
pub(super) fn share_memory_of<T>(
    (mut tasks, mut at_once): (Vec<usize>, usize),
    work: impl Fn(usize, u64) -> Option<T> + Sync,
    take: impl Fn(usize, T) -> ControlFlow<()> + Sync,
) {
    while !tasks.is_empty() {
        at_once = at_once.clamp(1, tasks.len());
        let without_memory = Mutex::new(Vec::new());
        let one = |task| match work(task, at_once as u64) {
            Some(result) => take(task, result),
            None => {
                let mut waiting = without_memory
                    .lock()
                    .unwrap_or_else(PoisonError::into_inner);
                waiting.push(task);
                ControlFlow::Continue(())
            }
        };
        if each(&tasks, at_once, one).is_break() || at_once == 1 {
            return;
        }
        tasks = without_memory
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner);
        tasks.sort_unstable();
        at_once /= 2;
    }
}

/// Does the tasks one after the other on so many threads.
fn each(
    tasks: &[usize],
    at_once: usize,
    one: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> ControlFlow<()> {
    let next = AtomicUsize::new(0);
    let has_ended = AtomicBool::new(false);
    let tasks_in_turn = || {
        while !has_ended.load(Ordering::Relaxed)
            && let Some(task) = tasks.get(next.fetch_add(1, Ordering::Relaxed))
        {
            if one(*task).is_break() {
                has_ended.store(true, Ordering::Relaxed);
            }
        }
    };
    on_threads(at_once, tasks_in_turn);
    match has_ended.into_inner() {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    }
}

/// A thread that waits for a part of its task may be given the work a second time, and leaves it: the task it is in would wait for
/// all others.
#[cfg(feature = "rayon")]
fn on_threads(count: usize, work: impl Fn() + Sync) {
    if count == 1 {
        return work();
    }
    let is_at_work: Vec<AtomicBool> = (0..threads()).map(|_| AtomicBool::new(false)).collect();
    let once = || {
        let flag = rayon::current_thread_index().and_then(|index| is_at_work.get(index));
        if flag.is_none_or(|flag| !flag.swap(true, Ordering::Relaxed)) {
            work();
        }
    };
    rayon::scope(|scope| (0..count).for_each(|_| scope.spawn(|_| once())));
}

#[cfg(not(feature = "rayon"))]
fn on_threads(_: usize, work: impl Fn()) {
    work();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tasks_that_need_more_than_their_part_are_done_with_more() {
        let most = 8;
        let in_use = AtomicUsize::new(0);
        let found = Mutex::new(Vec::new());
        // The task i needs i of 8 units.
        let work = |task: usize, parts: u64| {
            let part = most / usize::try_from(parts).expect("a count");
            let taken = in_use.fetch_add(part, Ordering::SeqCst) + part;
            assert!(taken <= most, "{taken} units are in use");
            std::thread::yield_now();
            in_use.fetch_sub(part, Ordering::SeqCst);
            (task <= part).then_some((task, part))
        };
        let take = |task, result| {
            found.lock().expect("results").push((task, result));
            ControlFlow::Continue(())
        };
        share_memory_of(((1..=8).collect(), 4), work, take);
        let mut found = found.into_inner().expect("results");
        found.sort_unstable();
        let expected = [2, 2, 4, 4, 8, 8, 8, 8].into_iter().zip(1..);
        let expected: Vec<_> = expected.map(|(part, task)| (task, (task, part))).collect();
        assert_eq!(found, expected, "tasks, and the units that they had");
    }

    #[test]
    fn nothing_is_begun_after_a_break() {
        let begun = AtomicUsize::new(0);
        let work = |_, _| Some(begun.fetch_add(1, Ordering::SeqCst));
        share_memory_of(((0..100).collect(), 1), work, |_, _| ControlFlow::Break(()));
        assert_eq!(begun.into_inner(), 1);
    }
}
