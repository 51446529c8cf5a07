//! Sums and extremes of long vectors, with several accumulators so that an operation need not wait for the one before.

use numerics::transforms::Real;
pub(crate) use numerics::vectors::{add_scaled, dot, mean};

/// Number of accumulators of a reduction. Chosen as the additions in flight in a processor, a latency of four cycles times two
/// additions per cycle; fewer of them wait for each other. Another value changes sums by rounding.
const ACCUMULATORS: usize = 8;

/// Reduction of `term(values)` over all indices of N vectors of equal length by the associative operation `combine`, a sum or an
/// extreme.
///
/// `start` must be the neutral element of `combine`. The order of the operations, and with it the rounding of a sum, depends on the length
/// alone.
pub(crate) fn reduce<const N: usize, T: Copy>(
    lists: [&[T]; N],
    start: T,
    term: impl Fn([T; N]) -> T,
    combine: impl Fn(T, T) -> T,
) -> T {
    let length = lists.first().map_or(0, |list| list.len());
    let parts = lists.map(|list| list[..length].as_chunks::<ACCUMULATORS>());
    // Index i goes to accumulator i mod 8; the remainder of the vectors is added at the end.
    let mut accumulators = [start; ACCUMULATORS];
    for chunk in 0..length / ACCUMULATORS {
        let chunks = parts.map(|(whole, _)| &whole[chunk]);
        for (lane, total) in accumulators.iter_mut().enumerate() {
            *total = combine(*total, term(chunks.map(|chunk| chunk[lane])));
        }
    }
    let rest = (0..length % ACCUMULATORS).map(|index| term(parts.map(|(_, rest)| rest[index])));
    accumulators.into_iter().chain(rest).fold(start, combine)
}

/// Sum of `term(values)` over all indices of N vectors of equal length, in the order of [`reduce`].
pub(crate) fn sum<const N: usize, T: Real>(lists: [&[T]; N], term: impl Fn([T; N]) -> T) -> T {
    reduce(lists, T::default(), term, |sum, term| sum + term)
}

/// Maximum of two numbers that are not NaN; faster than `f64::max`.
pub(crate) fn larger(left: f64, right: f64) -> f64 {
    if left > right { left } else { right }
}

/// Minimum of two numbers; `left` if `right` is NaN. Faster than `f64::min`.
pub(crate) fn smaller(left: f64, right: f64) -> f64 {
    if right < left { right } else { left }
}
