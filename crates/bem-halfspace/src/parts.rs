//! Fields in parts, worked on side by side where there are threads.

use std::array::from_fn;
use std::mem::take;
use std::ops::Range;

use crate::sharing::{MOST_TASKS, n_tasks, n_threads, share};

/// Where the parts of a field begin.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Starts<'a> {
    /// After so many values each.
    Every(usize),
    /// One number per part, and the end.
    Listed(&'a [usize]),
}

impl Starts<'_> {
    /// Where a part begins.
    fn of(self, part: usize) -> usize {
        match self {
            Self::Every(unit) => part * unit,
            Self::Listed(starts) => starts[part],
        }
    }
}

/// Fields, and where the parts of each begin.
pub(crate) type Parts<'a, T, const N: usize> = [(&'a mut [T], Starts<'a>); N];

/// A range of parts that one thread works on, and then their result.
struct Leaf<'a, T, R, const N: usize> {
    task: Option<(Range<usize>, Parts<'a, T, N>)>,
    result: R,
}

/// Does the work of every part of a range on its part of the fields.
///
/// The halves of the range are combined, and those are of their halves: the order is always the same.
pub(crate) fn fold_parts<const N: usize, T: Send, R: Default + Send>(
    parts: Range<usize>,
    fields: Parts<T, N>,
    work: &(impl Fn(usize, [&mut [T]; N]) -> R + Sync),
    combine: &(impl Fn(R, R) -> R + Sync),
) -> R {
    let n_lanes = n_threads().min(parts.len()).min(MOST_TASKS);
    if n_lanes <= 1 {
        return fold_alone(parts, fields, work, combine);
    }
    let mut leaves: [Leaf<T, R, N>; MOST_TASKS] = from_fn(|_| Leaf {
        task: None,
        result: R::default(),
    });
    let leaves = &mut leaves[..n_tasks(n_lanes)];
    give_tasks(parts.clone(), fields, leaves);
    let tasks = leaves.iter_mut().filter_map(|leaf| {
        let task = leaf.task.take()?;
        Some((task, &mut leaf.result))
    });
    share(
        &mut [(); MOST_TASKS][..n_lanes],
        tasks,
        |(), ((parts, fields), result)| *result = fold_alone(parts, fields, work, combine),
    );
    combine_results(parts, leaves, combine)
}

/// The same on one thread.
fn fold_alone<const N: usize, T, R>(
    parts: Range<usize>,
    fields: Parts<T, N>,
    work: &impl Fn(usize, [&mut [T]; N]) -> R,
    combine: &impl Fn(R, R) -> R,
) -> R {
    let Some([lower, upper]) = halves(&parts) else {
        return work(parts.start, fields.map(|(field, _)| field));
    };
    let (before, behind) = split(fields, parts.start, upper.start);
    let left = fold_alone(lower, before, work, combine);
    combine(left, fold_alone(upper, behind, work, combine))
}

/// Divides a range among at least one leaf as [`fold_alone`] does.
fn give_tasks<'a, const N: usize, T, R>(
    parts: Range<usize>,
    fields: Parts<'a, T, N>,
    leaves: &mut [Leaf<'a, T, R, N>],
) {
    debug_assert!(!leaves.is_empty(), "no leaf for {parts:?}");
    match (halves(&parts), leaves) {
        (Some([lower, upper]), leaves @ [_, _, ..]) => {
            let (before, behind) = split(fields, parts.start, upper.start);
            let (left, right) = leaves.split_at_mut(leaves.len() / 2);
            give_tasks(lower, before, left);
            give_tasks(upper, behind, right);
        }
        (_, [leaf, ..]) => leaf.task = Some((parts, fields)),
        (_, []) => (),
    }
}

/// Combines the results of at least one leaf as [`fold_alone`] does.
fn combine_results<const N: usize, T, R: Default>(
    parts: Range<usize>,
    leaves: &mut [Leaf<T, R, N>],
    combine: &impl Fn(R, R) -> R,
) -> R {
    debug_assert!(!leaves.is_empty(), "no leaf for {parts:?}");
    match (halves(&parts), leaves) {
        (Some([lower, upper]), leaves @ [_, _, ..]) => {
            let (left, right) = leaves.split_at_mut(leaves.len() / 2);
            let left = combine_results(lower, left, combine);
            combine(left, combine_results(upper, right, combine))
        }
        (_, [leaf, ..]) => take(&mut leaf.result),
        (_, []) => R::default(),
    }
}

/// The halves of a range of at least two parts.
fn halves(parts: &Range<usize>) -> Option<[Range<usize>; 2]> {
    let middle = parts.start + parts.len() / 2;
    (parts.len() > 1).then_some([parts.start..middle, middle..parts.end])
}

/// The fields, which begin with the part `first`, before and behind the beginning of a part in the `middle`.
fn split<'a, T, const N: usize>(
    fields: Parts<'a, T, N>,
    first: usize,
    middle: usize,
) -> (Parts<'a, T, N>, Parts<'a, T, N>) {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_combined_in_the_same_order_on_any_number_of_threads() {
        for n_parts in [0, 1, 2, 3, 5, 63, 64, 65, 200] {
            let starts: Vec<usize> = (0..=n_parts).map(|part| part * part).collect();
            let work = |part: usize, [values]: [&mut [usize]; 1]| {
                values.fill(part);
                format!("{part}")
            };
            let combine = |left: String, right: String| format!("({left} {right})");
            let fold = || {
                let mut values = vec![usize::MAX; n_parts * n_parts];
                let fields = [(&mut values[..], Starts::Listed(&starts))];
                let order = fold_parts(0..n_parts, fields, &work, &combine);
                (values, order)
            };
            let on_threads = |threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
                pool.map(|pool| pool.install(fold)).expect("a pool")
            };
            let alone = on_threads(1);
            assert!(!alone.0.contains(&usize::MAX), "a value of no part");
            for threads in [2, 3] {
                assert_eq!(on_threads(threads), alone, "on {threads} threads");
            }
        }
    }
}
