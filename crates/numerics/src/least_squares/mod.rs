//! Minimum of a sum of squares, or of another loss, over parameters within bounds.
//!
//! The method of Levenberg and Marquardt (Marquardt 1963, DOI 10.1137/0111030): each step solves
//!
//! ```text
//! (A + λ diag A) s = b
//! ```
//!
//! with the normal matrix A, the descent b and the damping λ, which falls after a step that lowers the sum and rises after
//! one that does not. Parameters on a bound that the step would cross are held there.

mod profile;
mod student;

use nalgebra::{DMatrix, DVector};

pub use profile::{IntervalEnd, profile_end};
pub use student::student_quantile;

/// A sum at a point p, and its quadratic model there: sum(p + s) ≈ sum − 2 descent·s + s·matrix·s.
#[derive(Debug, Clone, PartialEq)]
pub struct QuadraticModel {
    /// The sum of squares.
    pub sum: f64,
    /// Normal matrix JᵀJ of n × n entries, row by row: the sum over all residuals of products of two derivatives.
    pub matrix: Vec<f64>,
    /// Half the negative gradient −Jᵀr of n entries: minus the sum over all residuals of the residual times its derivatives.
    pub descent: Vec<f64>,
}

/// Bounds of a parameter, and of its change in one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterRange {
    /// Smallest and largest value; a parameter whose bounds are equal is held.
    pub bounds: [f64; 2],
    /// Largest change in one step.
    pub largest_step: f64,
}

/// The point at which a search has ended.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct Minimum {
    /// Parameters at the minimum.
    pub parameters: Vec<f64>,
    /// The sum and its quadratic model; after a last step by the model, the sum is that of the model.
    pub model: QuadraticModel,
}

/// Largest number of steps that lower the sum. Chosen, to limit the computing time: after them the search returns the point
/// that it has reached.
const MAX_STEPS: usize = 100;
/// Damping λ of the first step, relative to the diagonal: the value that Press et al., Numerical Recipes, section "Nonlinear
/// Models", advise. It changes the path to the minimum, not the minimum.
const INITIAL_DAMPING: f64 = 1e-3;
/// Factor on the damping after a step that lowers the sum. Chosen: a smaller one comes closer to Gauss–Newton steps sooner, and
/// is more often followed by a step that has to be repeated. It changes the number of steps, not the minimum.
const DAMPING_DECREASE: f64 = 0.2;
/// Factor on the damping after a step that does not lower the sum. Chosen: a smaller one repeats a step more often, a larger one
/// shortens it more than needed. It changes the number of steps, not the minimum.
const DAMPING_INCREASE: f64 = 4.0;
/// Damping at which the search gives up lowering the sum. Chosen to limit the computing time: a step is then 1e-9 of that without
/// damping along each parameter.
const MAX_DAMPING: f64 = 1e9;
/// Damping of a step by the model alone, relative to the diagonal, which keeps a singular matrix positive definite. Chosen far
/// above the rounding 2e-16 of the matrix; where the smallest eigenvalue of the scaled matrix is far above 1e-9, it does not
/// change the step.
const MODEL_STEP_DAMPING: f64 = 1e-9;
/// Fraction of the sufficient decrease below which a step counts as no decrease, so that the search ends. Chosen: a larger one
/// ends searches earlier.
const STAGNATION_FRACTION: f64 = 0.1;
/// Fraction of the largest step above which a step counts as limited by it. Chosen below 1 because of rounding: a limited step is
/// not the last one, so that a smaller fraction can only add a step.
const LIMITED_STEP_FRACTION: f64 = 0.999;

/// Minimises a sum from a start within the ranges. The last step is the first whose relative decrease is below
/// `sufficient_decrease`.
///
/// Returns `None` if `evaluate` has no finite sum at the start. Where it has none later, steps are shortened.
pub fn minimise(
    evaluate: impl FnMut(&[f64]) -> Option<QuadraticModel>,
    start: Vec<f64>,
    ranges: &[ParameterRange],
    sufficient_decrease: f64,
) -> Option<Minimum> {
    let rule = StoppingRule::RelativeDecrease(sufficient_decrease);
    descend(evaluate, start, ranges, rule)
}

/// Minimises a sum as [`minimise`] does, with a last step by the quadratic model and without another evaluation.
///
/// The last step is the first within the ranges for which the model predicts a decrease below `sufficient_decrease`, in units
/// of the sum; the returned sum is that of the model. The search also ends after a step that lowers the sum by less than a
/// tenth of that.
///
/// Returns `None` if `evaluate` has no finite sum at the start.
pub fn minimise_by_model(
    evaluate: impl FnMut(&[f64]) -> Option<QuadraticModel>,
    start: Vec<f64>,
    ranges: &[ParameterRange],
    sufficient_decrease: f64,
) -> Option<Minimum> {
    let rule = StoppingRule::PredictedDecrease {
        sufficient_decrease,
        target: f64::NEG_INFINITY,
        max_evaluations: usize::MAX,
    };
    descend(evaluate, start, ranges, rule)
}

/// Condition that ends a search.
#[derive(Clone, Copy)]
enum StoppingRule {
    /// A step lowers the sum by less than this fraction.
    RelativeDecrease(f64),
    /// The model predicts a small decrease, the sum is small, or the evaluations are used up.
    PredictedDecrease {
        /// Largest predicted decrease, in units of the sum, that is taken without another evaluation.
        sufficient_decrease: f64,
        /// The search ends at the first point with a sum below this one.
        target: f64,
        /// Largest number of evaluations; after them one more step is taken by the model.
        max_evaluations: usize,
    },
}

impl StoppingRule {
    /// Largest number of evaluations of the sum.
    const fn max_evaluations(self) -> usize {
        match self {
            Self::PredictedDecrease {
                max_evaluations, ..
            } => max_evaluations,
            Self::RelativeDecrease(_) => usize::MAX,
        }
    }
}

/// The loop of Levenberg and Marquardt from a start, whose parameters stay within their `ranges`; `None` if there is no finite sum
/// at the start.
fn descend(
    mut evaluate: impl FnMut(&[f64]) -> Option<QuadraticModel>,
    start: Vec<f64>,
    ranges: &[ParameterRange],
    rule: StoppingRule,
) -> Option<Minimum> {
    let is_finite = |model: &QuadraticModel| model.sum.is_finite();
    let mut parameters = start;
    let mut model = evaluate(&parameters).filter(is_finite)?;
    let (mut damping, mut evaluations) = (INITIAL_DAMPING, 1);
    for _ in 0..MAX_STEPS {
        // The search stops at a sum below the target. It also stops with a step by the model alone, if the model predicts a
        // small decrease or the evaluations are used up.
        if let StoppingRule::PredictedDecrease {
            sufficient_decrease,
            target,
            max_evaluations,
        } = rule
        {
            if model.sum < target {
                break;
            }
            if let Some(next) = damped_step(&model, &parameters, ranges, MODEL_STEP_DAMPING) {
                let decrease = model.predicted_decrease(&parameters, &next);
                let is_small =
                    is_inside(&parameters, &next, ranges) && decrease < sufficient_decrease;
                if is_small || evaluations >= max_evaluations {
                    model.sum -= decrease.max(0.0);
                    parameters = next;
                    break;
                }
            }
        }

        // Raise the damping until a step lowers the sum.
        let (mut relative_decrease, sum_before) = (None, model.sum);
        while relative_decrease.is_none()
            && damping < MAX_DAMPING
            && evaluations < rule.max_evaluations()
        {
            evaluations += 1;
            let trial = damped_step(&model, &parameters, ranges, damping)
                .and_then(|next| Some((evaluate(&next).filter(is_finite)?, next)));
            match trial.filter(|(trial, _)| trial.sum < model.sum) {
                Some((trial, next)) => {
                    relative_decrease = Some(1.0 - trial.sum / model.sum);
                    (model, parameters) = (trial, next);
                    damping *= DAMPING_DECREASE;
                }
                None => damping *= DAMPING_INCREASE,
            }
        }

        // Stop if the sum no longer falls noticeably.
        let is_last = match (relative_decrease, rule) {
            // When the evaluations are used up, the model takes one more step.
            (None, _) => evaluations < rule.max_evaluations(),
            (Some(fraction), StoppingRule::RelativeDecrease(sufficient)) => fraction < sufficient,
            (
                Some(fraction),
                StoppingRule::PredictedDecrease {
                    sufficient_decrease,
                    ..
                },
            ) => fraction * sum_before < STAGNATION_FRACTION * sufficient_decrease,
        };
        if is_last {
            break;
        }
    }
    Some(Minimum { parameters, model })
}

impl QuadraticModel {
    /// Decrease 2 descent·s − s·matrix·s of the sum between two points by the model, with the step s from one `to` the other.
    fn predicted_decrease(&self, from: &[f64], to: &[f64]) -> f64 {
        let step: Vec<f64> = to.iter().zip(from).map(|(to, from)| to - from).collect();
        let rows = self.matrix.chunks(step.len()).zip(&self.descent);
        let by_row = rows.zip(&step).map(|((row, descent), change)| {
            let product: f64 = row.iter().zip(&step).map(|(a, b)| a * b).sum();
            change * (2.0 * descent - product)
        });
        by_row.sum()
    }
}

/// Whether no parameter is limited by its bounds or by its largest step; held parameters do not count.
fn is_inside(from: &[f64], to: &[f64], ranges: &[ParameterRange]) -> bool {
    let mut parameters = from.iter().zip(to).zip(ranges);
    parameters.all(|((from, to), range)| {
        let [lowest, highest] = range.bounds;
        let is_between = lowest < *to && *to < highest;
        let is_short = (to - from).abs() < LIMITED_STEP_FRACTION * range.largest_step;
        is_between && is_short || lowest >= highest
    })
}

/// The point after a damped step; `None` if the damped matrix is not positive definite.
fn damped_step(
    model: &QuadraticModel,
    parameters: &[f64],
    ranges: &[ParameterRange],
    damping: f64,
) -> Option<Vec<f64>> {
    // Parameters whose descent points out of their bounds are held, and the other ones are solved for without them.
    let is_free = |&k: &usize| {
        let [lowest, highest] = ranges[k].bounds;
        let descent = model.descent[k];
        !(parameters[k] <= lowest && descent <= 0.0 || parameters[k] >= highest && descent >= 0.0)
    };
    let n = parameters.len();
    let free: Vec<usize> = (0..n).filter(is_free).collect();

    // Solve (A + λ diag A) s = b by a Cholesky factorisation.
    let entry = |row: usize, column: usize| {
        let factor = if row == column { 1.0 + damping } else { 1.0 };
        factor * model.matrix[free[row] * n + free[column]]
    };
    let matrix = DMatrix::from_fn(free.len(), free.len(), entry);
    let descent = DVector::from_iterator(free.len(), free.iter().map(|&k| model.descent[k]));
    let step = matrix.cholesky()?.solve(&descent);

    // Limit the step and keep the point within the bounds.
    let mut next = parameters.to_vec();
    for (&k, change) in free.iter().zip(step.iter()) {
        let ParameterRange {
            bounds: [lowest, highest],
            largest_step,
        } = ranges[k];
        next[k] = (next[k] + change.clamp(-largest_step, largest_step)).clamp(lowest, highest);
    }
    Some(next)
}

/// The inverse of a symmetric positive definite matrix of `n` rows, row by row; `None` if it is singular to rounding.
pub fn inverse(matrix: &[f64], n: usize) -> Option<Vec<f64>> {
    let scale: Vec<f64> = (0..n).map(|k| matrix[k * n + k].sqrt().recip()).collect();
    // The matrix is scaled to a unit diagonal before it is inverted, so that the units of the parameters do not matter.
    let scaled = |row: usize, column: usize| scale[row] * matrix[row * n + column] * scale[column];
    let inverse = DMatrix::from_fn(n, n, scaled).cholesky()?.inverse();
    let entry = |(index, value): (usize, &f64)| scale[index / n] * value * scale[index % n];
    let entries: Vec<f64> = inverse.iter().enumerate().map(entry).collect();
    let is_finite = entries.iter().all(|entry| entry.is_finite());
    is_finite.then_some(entries)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's valley as residuals 10 (y − x²) and 1 − x.
    fn valley(p: &[f64]) -> Option<QuadraticModel> {
        let residuals = [10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]];
        let slopes = [[-20.0 * p[0], 10.0], [-1.0, 0.0]];
        let product = |j: usize, k: usize| slopes.iter().map(|row| row[j] * row[k]).sum();
        let pairs = residuals.iter().zip(slopes);
        let descent = |k: usize| pairs.clone().map(|(r, row)| -r * row[k]).sum();
        Some(QuadraticModel {
            sum: residuals.iter().map(|r| r * r).sum(),
            matrix: vec![product(0, 0), product(0, 1), product(1, 0), product(1, 1)],
            descent: vec![descent(0), descent(1)],
        })
    }

    #[test]
    fn a_curved_valley_is_followed_to_its_end_or_to_a_bound() {
        let range = |highest| ParameterRange {
            bounds: [-2.0, highest],
            largest_step: 0.5,
        };
        let start = || vec![-1.2, 1.0];
        let found = minimise(valley, start(), &[range(2.0); 2], 1e-12).expect("a minimum");
        let off = (found.parameters[0] - 1.0).hypot(found.parameters[1] - 1.0);
        assert!(off < 1e-9, "{:?}", found.parameters);
        // The model is accurate where it predicts a small decrease.
        let found = minimise_by_model(valley, start(), &[range(2.0); 2], 1e-6).expect("a minimum");
        let off = (found.parameters[0] - 1.0).hypot(found.parameters[1] - 1.0);
        assert!(off < 1e-4 && found.model.sum < 1e-7, "{found:?}");
        // On x = 1/2 the minimum is at y = x², with the sum 1/4.
        let ranges = [range(0.5), range(2.0)];
        let found = minimise(valley, start(), &ranges, 1e-12).expect("a minimum");
        assert!((found.model.sum - 0.25).abs() < 1e-12, "{found:?}");
    }
}
