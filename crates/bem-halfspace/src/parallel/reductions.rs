//! Sums and extremes of long lists, with several accumulators because an operation on one would wait for the last.

use numerics::transforms::Real;

const ACCUMULATORS: usize = 8;

/// Reduces `start` and the terms of all numbers of equally long lists by `pick`; the order, and with it the rounding
/// of a sum, depends on their length alone.
pub(crate) fn reduce<const N: usize, T: Copy>(
    lists: [&[T]; N],
    start: T,
    term: impl Fn([T; N]) -> T,
    pick: impl Fn(T, T) -> T,
) -> T {
    let length = lists.first().map_or(0, |list| list.len());
    let lists = lists.map(|list| list[..length].as_chunks::<ACCUMULATORS>());
    let mut accumulators = [start; ACCUMULATORS];
    for chunk in 0..length / ACCUMULATORS {
        let chunks = lists.map(|(whole, _)| &whole[chunk]);
        for (place, picked) in accumulators.iter_mut().enumerate() {
            *picked = pick(*picked, term(chunks.map(|chunk| chunk[place])));
        }
    }
    let rest = (0..length % ACCUMULATORS).map(|index| term(lists.map(|(_, rest)| rest[index])));
    accumulators.into_iter().chain(rest).fold(start, pick)
}

/// Sum of the terms of all numbers of equally long lists.
pub(crate) fn sum<const N: usize, T: Real>(lists: [&[T]; N], term: impl Fn([T; N]) -> T) -> T {
    reduce(lists, T::default(), term, |sum, term| sum + term)
}

/// The larger of two numbers of which none is NaN; faster than `f64::max`.
pub(crate) fn larger(left: f64, right: f64) -> f64 {
    if left > right { left } else { right }
}

/// The lower of two numbers; the first where the second is NaN.
pub(crate) fn lower(left: f64, right: f64) -> f64 {
    if right < left { right } else { left }
}

/// Sum of products, in the order of the lists.
pub(crate) fn dot(left: &[f64], right: &[f64]) -> f64 {
    let pairs = left.iter().zip(right);
    pairs.map(|(left, right)| left * right).sum()
}

/// Adds a multiple.
pub(crate) fn add_scaled<T: Real>(sum: &mut [T], factor: T, values: &[T]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += factor * *value;
    }
}
