//! Generalised conjugate residuals (Eisenstat, Elman & Schultz 1983), so that solution and residual are known after every
//! step.

use std::collections::VecDeque;

use numerics::transforms::Real;

use crate::parallel::bands::{Bands, copies};
use crate::parallel::reductions::{add, sum};

/// Part of the sum of squares of the residual below which what a step takes off counts as nothing; up to 0.05 it hardly matters.
const LEAST_REDUCTION: f64 = 0.01;
/// Part of what a direction adds to the residual below which what is left of it beside earlier ones is their rounding.
const ROUNDING: f64 = 1e-7;

/// Moves `solution` by directions until `find` finds none for the `residual`, at most `most` times.
///
/// `find` is given the sum of squares of the residual, the residual, and the list from which it takes a direction: the residual
/// too, or, where the step before took nothing off and the residual would lead to it again, what that step added (Young & Jea
/// 1980), made as large as the residual. It writes the direction and what this adds to the residual, and says whether there is
/// one; of what they add, so many `earlier` ones are made orthogonal. Sums of squares and products have the `weights`, which are 1
/// where there are none. By the rounding of its numbers, relative to the first residual, the solution misses the residual that is
/// known. A direction that adds nothing new to the residual is the last.
pub(crate) fn minimise<T: Real>(
    [solution, residual]: [&mut [T]; 2],
    weights: Option<&[T]>,
    [most, earlier]: [usize; 2],
    mut find: impl FnMut(f64, [&[T]; 2], [&mut [T]; 2]) -> bool,
) {
    let mut kept: VecDeque<Kept<T>> = VecDeque::new();
    let mut oldest: Option<Kept<T>> = None;
    let mut added: Option<Vec<T>> = None;
    let mut size = product(weights, residual, residual);
    let lengths = [solution.len(), residual.len()];
    for _ in 0..most {
        let mut found = oldest.take().unwrap_or_else(|| Kept::new(lengths));
        let from = added.as_deref().unwrap_or(residual);
        let places = [&mut found.direction[..], &mut found.image];
        if !find(size, [residual, from], places) {
            return;
        }
        let (factors, [square, along, taken]) =
            make_orthogonal(&mut found.image, (residual, weights), &kept);
        if square <= ROUNDING * ROUNDING * (square + taken) || square.is_nan() {
            return;
        }
        let step = -along / square;
        added = (step * step * square < LEAST_REDUCTION * size).then(|| {
            // What a preconditioner makes larger each time would not be a number in the end.
            let scale = T::of((size / square).sqrt());
            found.image.iter().map(|value| scale * *value).collect()
        });
        advance(
            [&mut *solution, &mut found.direction],
            step,
            (&factors, &kept),
        );
        size = move_on(residual, step, (&found.image, weights));
        found.square = square;
        kept.push_back(found);
        if kept.len() > earlier {
            oldest = kept.pop_front();
        }
    }
}

/// A direction and what it adds to the residual, and the sum of squares of that.
struct Kept<T> {
    direction: Vec<T>,
    image: Vec<T>,
    square: f64,
}

impl<T: Real> Kept<T> {
    fn new([of_solution, of_residual]: [usize; 2]) -> Self {
        Self {
            direction: copies(T::default(), of_solution),
            image: copies(T::default(), of_residual),
            square: 0.0,
        }
    }
}

/// Takes what earlier directions add out of what a direction adds, one after the other. The factors by which they take part in
/// the direction, and the products of what is left with itself and with the residual, and of what was taken out with itself.
fn make_orthogonal<T: Real>(
    image: &mut [T],
    (residual, weights): (&[T], Option<&[T]>),
    kept: &VecDeque<Kept<T>>,
) -> (Vec<T>, [f64; 3]) {
    let mut factors = Vec::with_capacity(kept.len());
    let mut taken = 0.0;
    let of = bands(image);
    for (index, one) in kept.iter().enumerate() {
        let before = index.checked_sub(1);
        let before = before.map(|index| (factors[index], &kept[index].image[..]));
        let along = of.fold(
            [(&mut *image, of.starts_of_blocks(1))],
            |band, [part]| {
                let elements = of.elements(band);
                if let Some((factor, image)) = before {
                    add(part, factor, &image[elements.clone()]);
                }
                let weights = weights.map(|weights| &weights[elements.clone()]);
                part_of_product(weights, part, &one.image[elements])
            },
            sum_of,
        );
        let component = along / one.square;
        taken += component * along;
        factors.push(T::of(-component));
    }
    let last = factors.last().zip(kept.back());
    let [square, along] = of.fold(
        [(image, of.starts_of_blocks(1))],
        |band, [part]| {
            let elements = of.elements(band);
            if let Some((factor, one)) = last {
                add(part, *factor, &one.image[elements.clone()]);
            }
            let weights = weights.map(|weights| &weights[elements.clone()]);
            [&*part, &residual[elements]].map(|other| part_of_product(weights, part, other))
        },
        |left, right| [left[0] + right[0], left[1] + right[1]],
    );
    (factors, [square, along, taken])
}

/// Takes the parts of earlier directions out of a direction, and moves the solution along it.
fn advance<T: Real>(lists: [&mut [T]; 2], step: f64, (factors, kept): (&[T], &VecDeque<Kept<T>>)) {
    let of = bands(lists[0]);
    of.for_each(lists, |band, [solution, direction]| {
        let elements = of.elements(band);
        for (factor, one) in factors.iter().zip(kept) {
            add(direction, *factor, &one.direction[elements.clone()]);
        }
        add(solution, T::of(step), direction);
    });
}

/// Adds what a step adds to the residual, of which the sum of squares comes back.
fn move_on<T: Real>(residual: &mut [T], step: f64, (image, weights): (&[T], Option<&[T]>)) -> f64 {
    let of = bands(residual);
    of.fold(
        [(residual, of.starts_of_blocks(1))],
        |band, [part]| {
            let elements = of.elements(band);
            add(part, T::of(step), &image[elements.clone()]);
            part_of_product(weights.map(|weights| &weights[elements]), part, part)
        },
        sum_of,
    )
}

/// Euclidean norm of a list.
pub(crate) fn norm<T: Real>(list: &[T]) -> f64 {
    product(None, list, list).sqrt()
}

fn product<T: Real>(weights: Option<&[T]>, left: &[T], right: &[T]) -> f64 {
    let of = bands(left);
    of.sum(|band| {
        let elements = of.elements(band);
        let weights = weights.map(|weights| &weights[elements.clone()]);
        part_of_product(weights, &left[elements.clone()], &right[elements])
    })
}

fn part_of_product<T: Real>(weights: Option<&[T]>, left: &[T], right: &[T]) -> f64 {
    match weights {
        None => sum([left, right], |[left, right]| left * right).into(),
        Some(weights) => {
            let lists = [weights, left, right];
            sum(lists, |[weight, left, right]| weight * left * right).into()
        }
    }
}

fn sum_of(left: f64, right: f64) -> f64 {
    left + right
}

const fn bands<T>(list: &[T]) -> Bands {
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
        minimise::<f64>(
            unknowns,
            None,
            [2, 2],
            |_, [_, from], [direction, image]| {
                direction.copy_from_slice(from);
                image.copy_from_slice(&[-from[1], from[0]]);
                true
            },
        );
        assert!(
            (solution[0] - 4.0).hypot(solution[1] - 3.0) < 1e-14,
            "{solution:?}"
        );
        assert!(residual[0].hypot(residual[1]) < 1e-14, "{residual:?}");
    }

    /// A step that takes nothing off leads to another one, which is then as much longer.
    #[test]
    fn directions_that_grow_remain_numbers() {
        let [mut solution, mut residual] = [[0.0_f32; 2], [3.0, -4.0]];
        let unknowns = [&mut solution[..], &mut residual[..]];
        minimise(
            unknowns,
            None,
            [2, 2],
            |_, [_, from], [direction, image]| {
                direction.copy_from_slice(&[1e15 * from[0], 1e15 * from[1]]);
                image.copy_from_slice(&[-1e15 * from[1], 1e15 * from[0]]);
                true
            },
        );
        assert!(residual[0].hypot(residual[1]) < 1e-5, "{residual:?}");
    }
}
