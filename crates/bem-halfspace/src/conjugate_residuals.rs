//! Generalised conjugate residuals (Eisenstat, Elman & Schultz 1983), so that solution and residual are known after every
//! step.

use std::collections::VecDeque;

use crate::bands::Bands;
use crate::reductions::{add, sum};

/// Moves `solution` by directions until `find` returns none for the `residual`, at most `most` times.
///
/// `find` returns a direction and what it adds to the residual; of the latter, so many `earlier` ones are made orthogonal
/// in the product of the `weights`. A direction that adds nothing to the residual is the last.
pub(crate) fn minimise(
    [solution, residual]: [&mut [f64]; 2],
    weights: &[f64],
    [most, earlier]: [usize; 2],
    mut find: impl FnMut(&[f64]) -> Option<[Vec<f64>; 2]>,
) {
    let mut kept: VecDeque<[Vec<f64>; 2]> = VecDeque::new();
    for _ in 0..most {
        let Some([mut direction, mut image]) = find(residual) else {
            return;
        };
        for [before, its_image] in &kept {
            let component = product(weights, &image, its_image);
            add_all(&mut direction, -component, before);
            add_all(&mut image, -component, its_image);
        }
        let length = product(weights, &image, &image).sqrt();
        if length == 0.0 || length.is_nan() {
            return;
        }
        for value in direction.iter_mut().chain(&mut image) {
            *value /= length;
        }
        let step = -product(weights, &image, residual);
        add_all(solution, step, &direction);
        add_all(residual, step, &image);
        kept.push_back([direction, image]);
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

fn product(weights: &[f64], left: &[f64], right: &[f64]) -> f64 {
    bands(weights).sum(|band| {
        let lists = [weights, left, right].map(|list| &list[bands(weights).elements(band)]);
        sum(lists, |[weight, left, right]| weight * left * right)
    })
}

fn add_all(target: &mut [f64], factor: f64, other: &[f64]) {
    bands(other).for_each([target], |band, [target]| {
        add(target, factor, &other[bands(other).elements(band)]);
    });
}

const fn bands(list: &[f64]) -> Bands {
    Bands::new([list.len(), 1])
}
