//! Generalised conjugate residuals (Eisenstat, Elman & Schultz 1983), so that solution and residual are known after every
//! step.

use std::collections::VecDeque;

use rustfft::num_traits::AsPrimitive;

use crate::parallel::bands::Bands;
use crate::parallel::reductions::{add, sum};

/// Part of the sum of squares of the residual below which what a step takes off counts as nothing; up to 0.05 it hardly matters.
const LEAST_REDUCTION: f64 = 0.01;
/// Part of what a direction adds to the residual below which what is left of it beside earlier ones is their rounding.
const ROUNDING: f64 = 1e-7;

/// Moves `solution` by directions until `find` returns none for the `residual`, at most `most` times.
///
/// `find` is given the residual and the list from which it takes a direction: the residual too, or, where the step before took
/// nothing off and the residual would lead to it again, what that step added (Young & Jea 1980). It returns the direction and
/// what this adds to the residual; of the latter, so many `earlier` ones are made orthogonal in the product of the `weights`. They are kept as numbers of the type S: by its rounding, relative to the first residual,
/// the solution misses the residual that is known. A direction that adds nothing new to the residual is the last.
pub(crate) fn minimise<S: Copy + Into<f64> + Send + Sync + 'static>(
    [solution, residual]: [&mut [f64]; 2],
    weights: &[f64],
    [most, earlier]: [usize; 2],
    mut find: impl FnMut(&[f64], &[f64]) -> Option<[Vec<f64>; 2]>,
) where
    f64: AsPrimitive<S>,
{
    let mut kept: VecDeque<(f64, [Vec<S>; 2])> = VecDeque::new();
    let mut added: Option<Vec<f64>> = None;
    for _ in 0..most {
        let from = added.as_deref().unwrap_or(residual);
        let Some([mut direction, mut image]) = find(residual, from) else {
            return;
        };
        let whole = product(weights, &image, &image).sqrt();
        for (size, [before, its_image]) in &kept {
            let component = product(weights, &image, its_image);
            add_all(&mut direction, -component * size, before);
            add_all(&mut image, -component, its_image);
        }
        let length = product(weights, &image, &image).sqrt();
        if length <= ROUNDING * whole || length.is_nan() {
            return;
        }
        let step = -product(weights, &image, residual) / length.powi(2);
        let least = LEAST_REDUCTION * product(weights, residual, residual);
        added = ((step * length).powi(2) < least).then(|| image.clone());
        add_all(solution, step, &direction);
        add_all(residual, step, &image);
        let size = norm(&direction);
        let lists = [(direction, size), (image, length)];
        let parts =
            lists.map(|(list, unit)| list.iter().map(|value| (value / unit).as_()).collect());
        kept.push_back((size / length, parts));
        if kept.len() > earlier {
            kept.pop_front();
        }
    }
}

/// Euclidean norm of a list.
pub(crate) fn norm(list: &[f64]) -> f64 {
    let square = |band| sum([&list[bands(list).elements(band)]], |[value]| value * value);
    bands(list).sum(square).sqrt()
}

fn product<S: Copy + Into<f64> + Sync>(weights: &[f64], left: &[f64], right: &[S]) -> f64 {
    bands(weights).sum(|band| {
        let places = bands(weights).elements(band);
        let right: Vec<f64> = right[places.clone()].iter().map(|v| (*v).into()).collect();
        let lists = [&weights[places.clone()], &left[places], &right];
        sum(lists, |[weight, left, right]| weight * left * right)
    })
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
        minimise::<f64>(unknowns, &[1.0; 2], [2, 2], |_, from| {
            Some([from.to_vec(), vec![-from[1], from[0]]])
        });
        assert!(
            (solution[0] - 4.0).hypot(solution[1] - 3.0) < 1e-14,
            "{solution:?}"
        );
        assert!(residual[0].hypot(residual[1]) < 1e-14, "{residual:?}");
    }
}
