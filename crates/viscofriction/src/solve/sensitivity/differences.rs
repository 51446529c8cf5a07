//! Finite differences of closed forms, which are exact to rounding, and of truncated series.

use numerics::{Estimate, SilentProgress, WorkProgress};

use super::Sensitivity;
use super::parameters::{Number, Numbers};
use crate::quantity::{ByQuantity, Quantity};
use crate::scene::{Method, SceneError};
use crate::solve::answer::Answer;
use crate::solve::error::Result;
use crate::solve::plan::Plan;
use crate::solve::problem::Problem;
use crate::solve::work::work_of_method;

/// Step of the natural logarithm of a number in the finite differences. Chosen: the truncation error of sixth order is then below
/// the effect of rounding, 1e-11 in closed forms.
const LOG_STEP: f64 = 2e-3;
/// A point of a finite difference: its offset in steps, and its weights in the first derivatives of sixth and of fourth order.
type Point = (i32, [f64; 2]);
/// Points and weights of central first differences (Fornberg 1988, table 1).
const CENTRAL: [Point; 6] = [
    (-3, [-1.0 / 60.0, 0.0]),
    (-2, [0.15, 1.0 / 12.0]),
    (-1, [-0.75, -2.0 / 3.0]),
    (1, [0.75, 2.0 / 3.0]),
    (2, [-0.15, -1.0 / 12.0]),
    (3, [1.0 / 60.0, 0.0]),
];
/// One-sided differences for a number at its upper bound; with reversed signs for one at its lower bound (Fornberg 1988).
const FROM_BELOW: [Point; 7] = [
    (0, [2.45, 25.0 / 12.0]),
    (-1, [-6.0, -4.0]),
    (-2, [7.5, 3.0]),
    (-3, [-20.0 / 3.0, -4.0 / 3.0]),
    (-4, [3.75, 0.25]),
    (-5, [-1.2, 0.0]),
    (-6, [1.0 / 6.0, 0.0]),
];

/// Kind of error of the answers, which determines the error of a difference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Values {
    /// Rounding, independent from answer to answer.
    Exact,
    /// Truncation of a series in powers of the speed, which varies as smoothly as the answer.
    TruncatedSeries,
}

/// Bound of the logarithmic derivative of the omitted terms by a number of the scene. Derived: they scale at most with (v τ/a)³,
/// where v is the speed, τ a relaxation time and a the contact radius. The radius scales at most with the third root of a load, a
/// modulus or a length.
const LARGEST_OMITTED_POWER: f64 = 4.0;

/// Derivatives by each number, from differences of answers.
pub(super) fn sensitivities(
    (numbers, all): (&Numbers, &[Number]),
    problem: &Problem,
    values: Values,
    answer: &Answer,
    mut progress: WorkProgress,
) -> Result<Vec<Sensitivity>> {
    let of = |number: &Number| {
        let found = sensitivity(numbers, problem, number, values, answer);
        progress.add(1.0);
        found
    };
    all.iter().map(of).collect()
}

/// Derivatives by one number: central differences, or one-sided ones at the end of its allowed range.
fn sensitivity(
    numbers: &Numbers,
    problem: &Problem,
    number: &Number,
    values: Values,
    answer: &Answer,
) -> Result<Sensitivity> {
    let at = |points: &[Point], side: f64| -> Result<Vec<(Answer, [f64; 2])>> {
        let solved = |&(steps, weights): &Point| {
            let value = number.value * (side * LOG_STEP * f64::from(steps)).exp();
            let signed = weights.map(|weight| side * weight);
            let near = numbers.problem(problem, number, value)?;
            Ok((solved(&near, answer.method, number)?, signed))
        };
        points.iter().rev().map(solved).collect()
    };
    // Use central points; if some are outside the allowed range of the number, use those on one side of it.
    let points = at(&CENTRAL, 1.0)
        .or_else(|_| at(&FROM_BELOW, 1.0))
        .or_else(|_| at(&FROM_BELOW, -1.0))?;
    let derivative = |of: &Quantity| {
        of.log_change?;
        let quantity = of.of;
        let known = quantity(answer).filter(|known| known.error > 0.0 && known.value != 0.0)?;
        match values {
            Values::Exact => log_derivative(&points, quantity),
            Values::TruncatedSeries => {
                let truncation = LARGEST_OMITTED_POWER * known.error / known.value.abs();
                let without_error =
                    |answer: &Answer| Some(Estimate::exact(quantity(answer)?.value));
                Some(log_derivative(&points, without_error)?.widened(truncation))
            }
        }
    };
    Ok(Sensitivity {
        parameter: number.path.clone(),
        derivatives: ByQuantity::new(derivative),
    })
}

/// Logarithmic derivative of a quantity from answers with their weights of sixth and fourth order. Its error is the propagated
/// error of the answers plus the difference between both orders. `None` if an answer lacks the quantity.
fn log_derivative(
    points: &[(Answer, [f64; 2])],
    quantity: impl Fn(&Answer) -> Option<Estimate>,
) -> Option<Estimate> {
    let (mut slopes, mut error) = ([0.0; 2], 0.0);
    for (answer, weights) in points {
        let known = quantity(answer)?;
        for (slope, weight) in slopes.iter_mut().zip(weights) {
            *slope += weight / LOG_STEP * known.value.abs().ln();
        }
        error += (weights[0] / LOG_STEP * known.error / known.value).abs();
    }
    let [sixth, fourth] = slopes;
    Some(Estimate::new(sixth, error + (sixth - fourth).abs()))
}

/// The answer of a method to a problem in which `number` has another value; the error names the path of that number.
fn solved(problem: &Problem, method: Method, number: &Number) -> Result<Answer> {
    let work = work_of_method(problem, method)
        .map_err(|why| SceneError::at(&number.path, why.to_owned()))?;
    Plan {
        problem,
        method,
        work,
    }
    .solve(&SilentProgress)
}
