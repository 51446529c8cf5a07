//! Parallel work on chunks of fields, with buffers per thread.
//!
//! The chunks depend on the fields alone, and their results are combined pairwise in a fixed order. Results therefore do not
//! depend on the number of threads, to the last bit.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Smallest number of elements per chunk. Chosen: the work on fewer takes about as long as handing them to another thread. Chunks
/// determine the order of summation, so that another value changes results by rounding.
pub(crate) const MIN_ELEMENTS: usize = 1 << 13;

/// Division of a field into chunks.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Starts<'a> {
    /// Chunks of a given number of values.
    Every(usize),
    /// First index of each chunk, and the length of the field.
    Listed(&'a [usize]),
}

impl Starts<'_> {
    /// Index of the first value of a chunk in the field.
    fn first_index(self, chunk: usize) -> usize {
        match self {
            Self::Every(length) => chunk * length,
            Self::Listed(starts) => starts[chunk],
        }
    }
}

/// Mutable fields, each with its division into chunks: an argument of [`fold_chunks`].
pub(crate) type Chunked<'a, T, const N: usize> = [(&'a mut [T], Starts<'a>); N];

/// Calls `work(chunk, parts)` for each chunk of the range `chunks` with its parts of the fields, in parallel, and combines the results.
///
/// The fields begin with the first chunk. The range is halved recursively, so that results are always combined in the same order.
pub(crate) fn fold_chunks<const N: usize, T: Send, R: Send>(
    chunks: Range<usize>,
    fields: Chunked<T, N>,
    work: &(dyn Fn(usize, [&mut [T]; N]) -> R + Sync),
    combine: &(dyn Fn(R, R) -> R + Sync),
) -> R {
    if chunks.len() <= 1 {
        return work(chunks.start, fields.map(|(field, _)| field));
    }
    // Halve the range, and process both halves in parallel.
    let middle = chunks.start + chunks.len() / 2;
    let (before, behind) = split_at_chunk(fields, chunks.start, middle);
    let (left, right) = join(
        || fold_chunks(chunks.start..middle, before, work, combine),
        || fold_chunks(middle..chunks.end, behind, work, combine),
    );
    combine(left, right)
}

/// Splits fields, which begin with chunk `first`, at the beginning of chunk `middle`; returns the parts before and behind it.
fn split_at_chunk<'a, T, const N: usize>(
    fields: Chunked<'a, T, N>,
    first: usize,
    middle: usize,
) -> (Chunked<'a, T, N>, Chunked<'a, T, N>) {
    // `map` cannot return two arrays, so the second one is filled on the way.
    let mut behind = [(); N].map(|()| (<&mut [T]>::default(), Starts::Every(0)));
    let mut slots = behind.iter_mut();
    let before = fields.map(|(field, starts)| {
        let (lower, upper) =
            field.split_at_mut(starts.first_index(middle) - starts.first_index(first));
        if let Some(slot) = slots.next() {
            *slot = (upper, starts);
        }
        (lower, starts)
    });
    (before, behind)
}

/// One set of buffers per thread.
#[derive(Debug)]
pub(crate) struct PerThread<T>(Vec<Mutex<T>>);

impl<T> PerThread<T> {
    /// Buffers for the threads of the current pool, at most as many as can work on fields of `n_elements` elements.
    pub(crate) fn new(n_elements: usize, buffers: impl Fn() -> T) -> Self {
        let count = n_threads().min(1 + n_elements / MIN_ELEMENTS);
        Self((0..count).map(|_| Mutex::new(buffers())).collect())
    }

    /// Calls `work` with the buffers of this thread. If the pool has more threads than there are buffers, threads share them and wait.
    pub(crate) fn with<R>(&self, work: impl FnOnce(&mut T) -> R) -> R {
        let buffers = &self.0[thread_index() % self.0.len()];
        work(&mut buffers.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl<T: Clone> Clone for PerThread<T> {
    /// Copies the buffers of all threads, and waits for those in use.
    fn clone(&self) -> Self {
        let copy = |buffers: &Mutex<T>| {
            let locked = buffers.lock().unwrap_or_else(PoisonError::into_inner);
            Mutex::new(locked.clone())
        };
        Self(self.0.iter().map(copy).collect())
    }
}

/// Runs `work`, which concerns `n_elements` elements, on a thread of the current pool; small work on the calling thread. From outside
/// the pool, each parallel loop would have to be handed in and waited for.
pub(crate) fn in_pool<R: Send>(n_elements: usize, work: impl FnOnce() -> R + Send) -> R {
    if n_elements < MIN_ELEMENTS {
        return work();
    }
    join(work, || ()).0
}

#[cfg(feature = "rayon")]
pub(crate) use rayon::join;

/// Number of threads of the current pool.
#[cfg(feature = "rayon")]
fn n_threads() -> usize {
    rayon::current_num_threads()
}

/// Index of this thread in its pool; 0 outside a pool.
#[cfg(feature = "rayon")]
fn thread_index() -> usize {
    rayon::current_thread_index().unwrap_or(0)
}

/// Runs both closures one after the other, because threads need the feature `rayon`.
#[cfg(not(feature = "rayon"))]
pub(crate) fn join<L, R>(left: impl FnOnce() -> L, right: impl FnOnce() -> R) -> (L, R) {
    (left(), right())
}

/// One thread without a pool.
#[cfg(not(feature = "rayon"))]
const fn n_threads() -> usize {
    1
}

/// The only thread has index 0.
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
                std::thread::yield_now();
                *counter = before + 1;
            });
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build();
        let pool = pool.expect("a pool");
        pool.install(|| fold_chunks(0..100, [], &count, &|(), ()| ()));
        assert_eq!(counters.with(|counter| *counter), 100, "all chunks");
    }
}
