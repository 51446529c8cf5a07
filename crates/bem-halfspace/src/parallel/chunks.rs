//! Work on chunks of fields, side by side where there are threads.
//!
//! The chunks depend on the fields alone and their results are combined pairwise in a fixed order, so that nothing depends
//! on the number of threads, to the last bit.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Work on fewer elements would take less time than handing it to another thread.
pub(crate) const MIN_ELEMENTS: usize = 1 << 13;

/// Where the chunks of a field begin.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Starts<'a> {
    /// After so many values each.
    Every(usize),
    /// One number per chunk, and the end.
    Listed(&'a [usize]),
}

impl Starts<'_> {
    /// Where a chunk begins.
    fn of(self, chunk: usize) -> usize {
        match self {
            Self::Every(length) => chunk * length,
            Self::Listed(starts) => starts[chunk],
        }
    }
}

/// Fields, and where the chunks of each begin.
pub(crate) type Chunked<'a, T, const N: usize> = [(&'a mut [T], Starts<'a>); N];

/// Does the work of every chunk of a range on its part of the fields.
///
/// The results of the two halves of the range are combined, and those are of their halves: the order is always the same.
pub(crate) fn fold_chunks<const N: usize, T: Send, R: Send>(
    chunks: Range<usize>,
    fields: Chunked<T, N>,
    work: &(dyn Fn(usize, [&mut [T]; N]) -> R + Sync),
    combine: &(dyn Fn(R, R) -> R + Sync),
) -> R {
    if chunks.len() <= 1 {
        return work(chunks.start, fields.map(|(field, _)| field));
    }
    let middle = chunks.start + chunks.len() / 2;
    let (before, behind) = split(fields, chunks.start, middle);
    let (left, right) = join(
        || fold_chunks(chunks.start..middle, before, work, combine),
        || fold_chunks(middle..chunks.end, behind, work, combine),
    );
    combine(left, right)
}

/// The fields, which begin with the chunk `first`, before and behind the beginning of the chunk `middle`.
fn split<'a, T, const N: usize>(
    fields: Chunked<'a, T, N>,
    first: usize,
    middle: usize,
) -> (Chunked<'a, T, N>, Chunked<'a, T, N>) {
    let mut behind = [(); N].map(|()| (<&mut [T]>::default(), Starts::Every(0)));
    let mut slots = behind.iter_mut();
    let before = fields.map(|(field, starts)| {
        let (lower, upper) = field.split_at_mut(starts.of(middle) - starts.of(first));
        if let Some(slot) = slots.next() {
            *slot = (upper, starts);
        }
        (lower, starts)
    });
    (before, behind)
}

/// Buffers of which every thread uses its own.
#[derive(Debug)]
pub(crate) struct PerThread<T>(Vec<Mutex<T>>);

impl<T> PerThread<T> {
    /// For the threads of the current pool, as many of them as fields of so many elements occupy.
    pub(crate) fn new(n_elements: usize, buffers: impl Fn() -> T) -> Self {
        let count = n_threads().min(1 + n_elements / MIN_ELEMENTS);
        Self((0..count).map(|_| Mutex::new(buffers())).collect())
    }

    /// Does work with the buffers of this thread; waits for them where a larger pool shares them.
    pub(crate) fn with<R>(&self, work: impl FnOnce(&mut T) -> R) -> R {
        let own = &self.0[thread_index() % self.0.len()];
        work(&mut own.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl<T: Clone> Clone for PerThread<T> {
    fn clone(&self) -> Self {
        let copy = |buffers: &Mutex<T>| {
            let buffers = buffers.lock().unwrap_or_else(PoisonError::into_inner);
            Mutex::new(buffers.clone())
        };
        Self(self.0.iter().map(copy).collect())
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

#[cfg(feature = "rayon")]
pub(crate) use rayon::join;

#[cfg(feature = "rayon")]
fn n_threads() -> usize {
    rayon::current_num_threads()
}

#[cfg(feature = "rayon")]
fn thread_index() -> usize {
    rayon::current_thread_index().unwrap_or(0)
}

/// Does one after the other.
#[cfg(not(feature = "rayon"))]
pub(crate) fn join<L, R>(left: impl FnOnce() -> L, right: impl FnOnce() -> R) -> (L, R) {
    (left(), right())
}

#[cfg(not(feature = "rayon"))]
const fn n_threads() -> usize {
    1
}

#[cfg(not(feature = "rayon"))]
const fn thread_index() -> usize {
    0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_larger_pool_than_the_buffers_are_for_uses_each_by_one_thread_at_a_time() {
        let counters = PerThread::new(0, || 0_usize);
        let count = |_, []: [&mut [()]; 0]| {
            counters.with(|counter| {
                let before = *counter;
                std::thread::sleep(std::time::Duration::from_micros(20));
                *counter = before + 1;
            });
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build();
        let pool = pool.expect("a pool");
        pool.install(|| fold_chunks(0..100, [], &count, &|(), ()| ()));
        assert_eq!(counters.with(|counter| *counter), 100, "all chunks");
    }
}
