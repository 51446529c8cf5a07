//! Work shared by the threads of a pool.
//!
//! A thread takes the next task when it is done with one, so that nobody waits long for a thread that the system has
//! held up. Half of the threads begin with the first task and half with the last: two threads meet the same part of a
//! field again in every loop over it, and find it in their own caches.

use std::hint::spin_loop;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// How often a thread looks whether the others are done before it goes to sleep, which takes longer to end than most
/// loops of an iteration last; 0.1 to 0.2 ms.
const LOOKS: usize = 200;
const PAUSES_PER_LOOK: usize = 16;

/// Does the work of every task, each on one of the lanes, which belong to a thread each as long as this lasts.
pub(crate) fn share<L: Send, T>(
    lanes: &mut [L],
    tasks: impl DoubleEndedIterator<Item = T> + Send,
    work: impl Fn(&mut L, T) + Sync,
) {
    if let [lane] = lanes {
        tasks.for_each(|task| work(lane, task));
        return;
    }
    let n_front = lanes.len().div_ceil(2);
    let (queue, n_begun) = (Mutex::new(tasks), AtomicUsize::new(0));
    let begin = |number: usize| {
        let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
        let task = if number < n_front {
            queue.next()
        } else {
            queue.next_back()
        };
        n_begun.fetch_add(usize::from(task.is_some()), Ordering::Relaxed);
        task
    };
    on_lanes(0, lanes, &|number, lane| {
        while let Some(task) = begin(number) {
            work(lane, task);
            n_begun.fetch_sub(1, Ordering::Release);
        }
        wait_awake(|| n_begun.load(Ordering::Acquire) == 0);
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

/// Returns when it is done, or after a while.
fn wait_awake(is_done: impl Fn() -> bool) {
    for _ in 0..LOOKS {
        if is_done() {
            return;
        }
        for _ in 0..PAUSES_PER_LOOK {
            spin_loop();
        }
    }
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
    use super::*;

    #[test]
    fn every_task_is_done_once() {
        for n_lanes in 1..=5 {
            for n_tasks in [0, 1, 2, 7, 100] {
                let mut lanes = vec![0; n_lanes];
                let mut done = vec![0; n_tasks];
                let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build();
                let work = || {
                    share(&mut lanes, done.iter_mut(), |in_lane, times| {
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
