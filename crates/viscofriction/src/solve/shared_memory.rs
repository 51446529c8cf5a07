//! Concurrent tasks within one memory limit, with results independent of the number of threads.
//!
//! A method chooses its grids by the memory it may use, so a smaller limit may change its answer. A result found within a part of
//! the memory is therefore kept only if that limit rejected no grid.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Number of threads of the current thread pool.
#[cfg(feature = "rayon")]
pub(super) fn threads() -> usize {
    rayon::current_num_threads()
}

/// Number of threads without a pool.
#[cfg(not(feature = "rayon"))]
pub(super) const fn threads() -> usize {
    1
}

/// Runs tasks concurrently, one per thread of the pool, each with an equal part of the memory.
///
/// `work` receives the task and the number of parts of the memory, and returns `None` if its part was too small. Such tasks are
/// repeated after the others, half as many at a time, finally alone with all of the memory. `take` receives each result as soon
/// as it is known; after it breaks, no further task is started.
pub fn share_memory<T>(
    tasks: Vec<usize>,
    work: impl Fn(usize, u64) -> Option<T> + Sync,
    take: impl Fn(usize, T) -> ControlFlow<()> + Sync,
) {
    share_memory_of((tasks, threads()), work, take);
}

/// Like [`share_memory`], with at most the given number of tasks at a time.
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
        if run_in_turn(&tasks, at_once, one).is_break() || at_once == 1 {
            return;
        }
        tasks = without_memory
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner);
        tasks.sort_unstable();
        at_once /= 2;
    }
}

/// Runs the tasks in turn on `at_once` threads, each of which takes the next one. After a break of one no further task is
/// started, and the result is a break.
fn run_in_turn(
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

/// Runs `work` on `count` threads. A thread that waits inside a task may steal a second copy of `work`. It must not run it,
/// because the waiting task would then wait for all others.
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

/// Runs `work` on the calling thread.
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
        // Task i needs i of 8 units of memory.
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
