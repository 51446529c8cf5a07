//! Work shared by the threads of a pool.
//!
//! A thread takes the next task when it is done with one, so that the others do what one that is held up leaves. Half of
//! the threads begin with the first task and half with the last: two threads meet the same part of a field again in
//! every loop over it, and find it in their own caches.

use std::hint::spin_loop;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Work on fewer elements would take less time than handing it to another thread.
pub(crate) const MIN_ELEMENTS: usize = 1 << 13;

/// Tasks per thread, so that one may do fewer than another, and most of them, which have one queue.
const TASKS_PER_THREAD: usize = 32;
pub(crate) const MOST_TASKS: usize = 128;

/// Waking a thread takes longer than the short loops of an iteration, so that a thread without a task first looks so many
/// times whether the others are done; for 0.2 ms where a pause takes 60 ns.
const LOOKS: usize = 200;
const PAUSES_PER_LOOK: usize = 16;

/// Into how many tasks to divide work on so many lanes.
pub(crate) fn n_tasks(n_lanes: usize) -> usize {
    match n_lanes {
        1 => 1,
        _ => (TASKS_PER_THREAD * n_lanes).min(MOST_TASKS),
    }
}

/// Does the work of every task on one of the lanes, of which there is at least one; no two threads work on the same one.
pub(crate) fn share<L: Send, T>(
    lanes: &mut [L],
    tasks: impl DoubleEndedIterator<Item = T> + Send,
    work: impl Fn(&mut L, T) + Sync,
) {
    debug_assert!(!lanes.is_empty(), "nobody to work");
    if let [lane] = lanes {
        tasks.for_each(|task| work(lane, task));
        return;
    }
    let n_front = lanes.len().div_ceil(2);
    let (queue, n_under_way) = (Mutex::new(tasks), AtomicUsize::new(0));
    let begin = |number: usize| {
        let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
        let task = if number < n_front {
            queue.next()
        } else {
            queue.next_back()
        };
        n_under_way.fetch_add(usize::from(task.is_some()), Ordering::Relaxed);
        task
    };
    // The end of `on_lanes` publishes the results; the count only says when that is near.
    on_lanes(0, lanes, &|number, lane| {
        let mut has_worked = false;
        while let Some(task) = begin(number) {
            work(lane, task);
            n_under_way.fetch_sub(1, Ordering::Relaxed);
            has_worked = true;
        }
        if has_worked {
            wait_awake(|| n_under_way.load(Ordering::Relaxed) == 0);
        }
    });
}

/// Does the work on lanes, numbered from `first` on, side by side as far as threads are free.
fn on_lanes<L: Send>(first: usize, lanes: &mut [L], work: &(impl Fn(usize, &mut L) + Sync)) {
    match lanes {
        [] => (),
        [lane] => work(first, lane),
        _ => {
            let middle = lanes.len().div_ceil(2);
            let (lower, upper) = lanes.split_at_mut(middle);
            join(
                || on_lanes(first, lower, work),
                || on_lanes(first + middle, upper, work),
            );
        }
    }
}

/// Waits without sleeping until the others are done, but not for long.
fn wait_awake(are_done: impl Fn() -> bool) {
    for _ in 0..LOOKS {
        if are_done() {
            return;
        }
        for _ in 0..PAUSES_PER_LOOK {
            spin_loop();
        }
    }
}

/// Does work on so many elements on a thread of the current pool, if it is not there already: from outside, each of its
/// loops would have to be handed in and waited for.
pub(crate) fn in_pool<R: Send>(n_elements: usize, work: impl FnOnce() -> R + Send) -> R {
    if n_elements < MIN_ELEMENTS {
        return work();
    }
    join(work, || ()).0
}

/// Number of threads of the current pool.
#[cfg(feature = "rayon")]
pub(crate) fn n_threads() -> usize {
    rayon::current_num_threads()
}

/// Number of threads.
#[cfg(not(feature = "rayon"))]
pub(crate) const fn n_threads() -> usize {
    1
}

/// Does both works, side by side where there are threads.
#[cfg(feature = "rayon")]
pub(crate) fn join<L: Send, R: Send>(
    left: impl FnOnce() -> L + Send,
    right: impl FnOnce() -> R + Send,
) -> (L, R) {
    rayon::join(left, right)
}

/// Does both works.
#[cfg(not(feature = "rayon"))]
pub(crate) fn join<L, R>(left: impl FnOnce() -> L, right: impl FnOnce() -> R) -> (L, R) {
    (left(), right())
}

#[cfg(test)]
mod tests {
    use std::thread::sleep;
    use std::time::Duration;

    use super::*;

    #[test]
    fn every_task_is_done_once() {
        // Long enough for the other threads to take some.
        let task = Duration::from_micros(50);
        for n_lanes in 1..=5 {
            for n_tasks in [0, 1, 2, 7, 100] {
                let mut lanes = vec![0; n_lanes];
                let mut done = vec![0; n_tasks];
                let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build();
                let work = || {
                    share(&mut lanes, done.iter_mut(), |in_lane, times| {
                        sleep(task);
                        *in_lane += 1;
                        *times += 1;
                    });
                };
                pool.map(|pool| pool.install(work)).expect("a pool");
                assert_eq!(done, vec![1; n_tasks], "on {n_lanes} lanes");
                assert_eq!(lanes.iter().sum::<usize>(), n_tasks, "on {n_lanes} lanes");
            }
        }
    }
}
