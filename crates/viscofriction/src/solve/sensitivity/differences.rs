//! Differences of answers that are exact to rounding.

use numerics::{Estimate, Unwatched};

use super::Sensitivity;
use super::parameters::{Number, Numbers};
use crate::scene::{Method, SceneError};
use crate::solve::answer::Answer;
use crate::solve::error::Result;
use crate::solve::plan::Plan;
use crate::solve::work::work;

/// Relative step of the numbers.
const STEP: f64 = 1e-4;

pub(super) fn sensitivities(
    (numbers, all): (&Numbers, &[Number]),
    method: Method,
    answer: &Answer,
) -> Result<Vec<Sensitivity>> {
    let all = all.iter();
    all.map(|number| sensitivity(numbers, number, method, answer))
        .collect()
}

/// Differences over one and two steps to either side, or from below where a number is the largest allowed one.
fn sensitivity(
    numbers: &Numbers,
    number: &Number,
    method: Method,
    answer: &Answer,
) -> Result<Sensitivity> {
    let at = |factor: f64| solved(numbers, number, method, factor * number.value);
    let (ends, steps) = match at(1.0 + STEP) {
        Ok(above) => {
            let wide = [at(1.0 - 2.0 * STEP)?, at(1.0 + 2.0 * STEP)?];
            ([[at(1.0 - STEP)?, above], wide], [[-1.0, 1.0], [-2.0, 2.0]])
        }
        Err(_) => {
            let [near, far] = [at(1.0 - STEP)?, at(1.0 - 2.0 * STEP)?];
            (
                [[near, answer.clone()], [far, answer.clone()]],
                [[-1.0, 0.0], [-2.0, 0.0]],
            )
        }
    };
    let of = |quantity: fn(&Answer) -> Option<Estimate>| {
        let known = quantity(answer).filter(|known| known.error > 0.0 && known.value != 0.0)?;
        let mut slopes = [Estimate::exact(0.0); 2];
        for (slope, (ends, steps)) in slopes.iter_mut().zip(ends.iter().zip(steps)) {
            let [from, to] = [quantity(&ends[0])?, quantity(&ends[1])?];
            let [low, high] = steps.map(|step| (step * STEP).ln_1p());
            let width = known.value * (high - low);
            let error = (from.error + to.error) / width.abs();
            *slope = Estimate::new((to.value - from.value) / width, error);
        }
        let [near, far] = slopes;
        Some(near.widened((near.value - far.value).abs()))
    };
    Ok(Sensitivity {
        parameter: number.path(),
        friction_coefficient: of(|answer| answer.friction_coefficient),
        normal_force: of(|answer| Some(answer.normal_force)),
        indentation_depth: of(|answer| answer.indentation_depth),
        contact_area: of(|answer| answer.contact_area),
    })
}

fn solved(numbers: &Numbers, number: &Number, method: Method, value: f64) -> Result<Answer> {
    let problem = numbers.problem(number, value)?;
    let work = work(&problem, method);
    let work = work.map_err(|why| SceneError::at(number.path(), why.to_owned()))?;
    Plan {
        problem: &problem,
        method,
        work,
    }
    .solve(&Unwatched)
}
