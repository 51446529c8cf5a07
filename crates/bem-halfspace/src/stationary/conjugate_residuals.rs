//! Generalised conjugate residuals (Eisenstat, Elman & Schultz 1983), so that solution and residual are known after every
//! step.

use std::collections::VecDeque;
use std::ops::Range;

use rustfft::num_traits::AsPrimitive;

use crate::parallel::bands::{Bands, copies};
use crate::parallel::reductions::{add, sum_with};

/// Part of the sum of squares of the residual below which what a step takes off counts as nothing; up to 0.05 it hardly matters.
const LEAST_REDUCTION: f64 = 0.01;
/// Part of what a direction adds to the residual below which what is left of it beside earlier ones is their rounding.
const ROUNDING: f64 = 1e-7;

/// Moves `solution` by directions until `find` finds none for the `residual`, at most `most` times.
///
/// `find` is given the residual and the list from which it takes a direction: the residual too, or, where the step before took
/// nothing off and the residual would lead to it again, what that step added (Young & Jea 1980). It writes the direction and
/// what this adds to the residual, and says whether there is one; of what they add, so many `earlier` ones are made orthogonal in
/// the product of the `weights`, which are 1 where there are none. They are kept as numbers of the type S: by its rounding,
/// relative to the first residual, the solution misses the residual that is known. A direction that adds nothing new to the
/// residual is the last.
pub(crate) fn minimise<S: Copy + Default + Into<f64> + Send + Sync + 'static>(
    [solution, residual]: [&mut [f64]; 2],
    weights: Option<&[f64]>,
    [most, earlier]: [usize; 2],
    mut find: impl FnMut(&[f64], &[f64], [&mut [f64]; 2]) -> bool,
) where
    f64: AsPrimitive<S>,
{
    let mut kept: VecDeque<Kept<S>> = VecDeque::new();
    let [mut direction, mut image] = [&*solution, residual].map(|list| copies(0.0, list.len()));
    let mut added: Option<Vec<f64>> = None;
    for _ in 0..most {
        let from = added.as_deref().unwrap_or(residual);
        if !find(residual, from, [&mut direction, &mut image]) {
            return;
        }
        let whole = product(weights, &image, &image).sqrt();
        make_orthogonal([&mut direction, &mut image], weights, &kept);
        let length = product(weights, &image, &image).sqrt();
        if length <= ROUNDING * whole || length.is_nan() {
            return;
        }
        let step = -product(weights, &image, residual) / length.powi(2);
        let least = LEAST_REDUCTION * product(weights, residual, residual);
        added = ((step * length).powi(2) < least).then(|| image.clone());
        add_all(solution, step, &direction);
        add_all(residual, step, &image);
        if earlier > 0 {
            let oldest = if kept.len() < earlier {
                None
            } else {
                kept.pop_front()
            };
            kept.push_back(Kept::new(oldest, [&direction, &image], length));
        }
    }
}

/// A direction and what it adds to the residual, both of the length 1, and how much longer the direction is.
struct Kept<S> {
    size: f64,
    direction: Vec<S>,
    image: Vec<S>,
}

impl<S: Copy + Default + Send + Sync + 'static> Kept<S>
where
    f64: AsPrimitive<S>,
{
    /// In the memory of another one, if there is one; `length` is that of the image.
    fn new(memory: Option<Self>, [direction, image]: [&[f64]; 2], length: f64) -> Self {
        let size = norm(direction);
        let mut kept = memory.unwrap_or_else(|| Self {
            size,
            direction: copies(S::default(), direction.len()),
            image: copies(S::default(), image.len()),
        });
        let lists = [
            (&mut kept.direction, direction, size),
            (&mut kept.image, image, length),
        ];
        for (places, list, unit) in lists {
            bands(list).for_each([&mut places[..]], |band, [places]| {
                let values = &list[bands(list).elements(band)];
                for (place, value) in places.iter_mut().zip(values) {
                    *place = (value / unit).as_();
                }
            });
        }
        kept.size = size / length;
        kept
    }
}

/// Takes what earlier directions add out of what a direction adds, one after the other, and with it their parts of the direction.
fn make_orthogonal<S: Copy + Into<f64> + Sync>(
    [direction, image]: [&mut [f64]; 2],
    weights: Option<&[f64]>,
    kept: &VecDeque<Kept<S>>,
) {
    let mut factors = Vec::with_capacity(kept.len());
    let mut before: Option<(f64, &[S])> = None;
    for one in kept {
        let component = subtract(image, before, (weights, &one.image));
        factors.push(-component * one.size);
        before = Some((component, &one.image));
    }
    if let Some((component, last)) = before {
        add_all(image, -component, last);
    }
    let of = bands(direction);
    of.for_each([direction], |band, [part]| {
        let elements = of.elements(band);
        for (factor, one) in factors.iter().zip(kept) {
            add(part, *factor, &one.direction[elements.clone()]);
        }
    });
}

/// Euclidean norm of a list.
pub(crate) fn norm(list: &[f64]) -> f64 {
    product(None, list, list).sqrt()
}

fn product<S: Copy + Into<f64> + Sync>(weights: Option<&[f64]>, left: &[f64], right: &[S]) -> f64 {
    let of = bands(left);
    of.sum(|band| {
        part_of_product(
            weights,
            &left[of.elements(band)],
            (right, of.elements(band)),
        )
    })
}

/// Subtracts a multiple of another list, and returns the product of what is left with a third one.
fn subtract<S: Copy + Into<f64> + Sync>(
    list: &mut [f64],
    other: Option<(f64, &[S])>,
    (weights, third): (Option<&[f64]>, &[S]),
) -> f64 {
    let of = bands(list);
    let of_band = |band, [part]: [&mut [f64]; 1]| {
        if let Some((factor, other)) = other {
            add(part, -factor, &other[of.elements(band)]);
        }
        part_of_product(weights, part, (third, of.elements(band)))
    };
    of.fold([(list, of.starts_of_blocks(1))], of_band, |left, right| {
        left + right
    })
}

fn part_of_product<S: Copy + Into<f64>>(
    weights: Option<&[f64]>,
    left: &[f64],
    (right, elements): (&[S], Range<usize>),
) -> f64 {
    let right = &right[elements.clone()];
    match weights {
        None => sum_with([left], right, |[left], right| left * right),
        Some(weights) => sum_with(
            [left, &weights[elements]],
            right,
            |[left, weight], right| weight * left * right,
        ),
    }
}

fn add_all<S: Copy + Into<f64> + Sync>(target: &mut [f64], factor: f64, other: &[S]) {
    bands(other).for_each([target], |band, [target]| {
        add(target, factor, &other[bands(other).elements(band)]);
    });
}

const fn bands<S>(list: &[S]) -> Bands {
    Bands::new([list.len(), 1])
}

#[cfg(test)]
mod tests {
    use super::minimise;

    /// A quarter turn adds to the residual what is orthogonal to it, so that the residual alone leads nowhere.
    #[test]
    fn a_step_that_takes_nothing_off_is_not_the_last() {
        let [mut solution, mut residual] = [[0.0; 2], [3.0, -4.0]];
        let unknowns = [&mut solution[..], &mut residual[..]];
        minimise::<f64>(unknowns, None, [2, 2], |_, from, [direction, image]| {
            direction.copy_from_slice(from);
            image.copy_from_slice(&[-from[1], from[0]]);
            true
        });
        assert!(
            (solution[0] - 4.0).hypot(solution[1] - 3.0) < 1e-14,
            "{solution:?}"
        );
        assert!(residual[0].hypot(residual[1]) < 1e-14, "{residual:?}");
    }
}
