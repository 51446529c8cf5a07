//! Fixed point of a slowly converging map x → g(x) by Anderson acceleration.
//!
//! Every second evaluation of the contraction g starts from the combination of previous values g(x_k) that minimises the
//! combined residual (Anderson 1965, J. ACM 12, 547; Walker & Ni 2011, SIAM J. Numer. Anal. 49, 1715):
//!
//! ```text
//! x = g_n − Σ γ_k (g_n − g_k),    |f_n − Σ γ_k (f_n − f_k)| least,    f_k = g(x_k) − x_k
//! ```
//!
//! The next evaluation starts from the plain value g(x). The difference between the results of these two evaluations shows how
//! much still changes. The iteration finds limit cycles of reciprocating motions: docs/tribometer.md, "How it is computed".

use crate::vectors::{add_scaled, dot};

/// Number of evaluations before the first combination: two for a difference, and one that checks it. With any number from 2 to 5,
/// no answer changes by more than 0.2 % of its error bar (case of `evidence tuning`).
const PLAIN_EVALUATIONS: usize = 3;
/// Largest number of evaluations that are combined; older ones are dropped. Chosen to limit the memory, which holds four vectors
/// for each evaluation: point, value, residual, and difference of residuals. A larger number may need fewer evaluations; the
/// fixed point is the same.
const MAX_COMBINED: usize = 8;

/// Outcome of a fixed-point iteration.
#[derive(Debug, Clone, PartialEq)]
pub enum FixedPoint<T> {
    /// The remaining error is at most the tolerance.
    Converged {
        /// Result of the last evaluation.
        result: T,
        /// Number of evaluations.
        evaluations: usize,
    },
    /// The remaining error exceeds the tolerance after the largest number of evaluations.
    NotConverged {
        /// The last known remaining error; infinite if there were fewer than two evaluations.
        remaining_error: f64,
    },
}

/// Upper limit of the number of vectors as long as the state that [`anderson_fixed_point`] keeps. Derived: point, value, residual
/// and difference of residuals of eight evaluations that are combined and of the latest one.
pub const MAX_STORED_STATES: usize = 4 * (MAX_COMBINED + 1);

/// Iterates x → g(x) until the remaining error is at most a tolerance.
///
/// - `map` evaluates g at a state, and returns a result and the new state.
/// - `remaining_error` estimates the distance to the fixed point from two consecutive results, the newer one first, and may
///   write it into the newer one.
///
/// # Errors
/// The first error of `map`.
pub fn anderson_fixed_point<T, E>(
    mut state: Vec<f64>,
    max_evaluations: usize,
    tolerance: f64,
    mut map: impl FnMut(&[f64]) -> Result<(T, Vec<f64>), E>,
    mut remaining_error: impl FnMut(&mut T, &T) -> f64,
) -> Result<FixedPoint<T>, E> {
    let mut evaluated: Vec<Evaluation> = Vec::new();
    let mut previous: Option<T> = None;
    let mut remaining = f64::INFINITY;
    let mut is_combination = false;
    for evaluations in 1..=max_evaluations {
        // The map is evaluated at the state. Its value becomes the state of the next evaluation, unless a combination replaces
        // it.
        let (mut result, value) = map(&state)?;
        let start = std::mem::replace(&mut state, value.clone());
        let evaluation = Evaluation { start, value };

        // A combination that increases the residual is outside the range in which g is nearly linear: return to the last value, and
        // forget the evaluations that were combined.
        let last_residual = evaluated.last().map_or(f64::INFINITY, Evaluation::residual);
        if std::mem::take(&mut is_combination) && evaluation.residual() > last_residual {
            evaluated.drain(..evaluated.len() - 1);
            state.clone_from(&evaluated[0].value);
            previous = None;
            continue;
        }
        evaluated.push(evaluation);
        let Some(last) = previous.take() else {
            previous = Some(result);
            continue;
        };

        // The iteration has converged if the error estimated from the last two results is at most the tolerance.
        remaining = remaining_error(&mut result, &last);
        if remaining <= tolerance {
            return Ok(FixedPoint::Converged {
                result,
                evaluations,
            });
        }

        // Start the next evaluation from a combination; it cannot be compared with this one, hence no previous result.
        if evaluated.len() < PLAIN_EVALUATIONS {
            previous = Some(result);
        } else {
            let excess = evaluated.len().saturating_sub(MAX_COMBINED);
            evaluated.drain(..excess);
            combine(&evaluated, &mut state);
            is_combination = true;
        }
    }
    Ok(FixedPoint::NotConverged {
        remaining_error: remaining,
    })
}

/// One evaluation of the map g.
struct Evaluation {
    /// Point x at which the map was evaluated.
    start: Vec<f64>,
    /// Value g(x) at this point.
    value: Vec<f64>,
}

impl Evaluation {
    /// Euclidean norm of g(x) − x.
    fn residual(&self) -> f64 {
        let change = minus(&self.value, &self.start);
        dot(&change, &change).sqrt()
    }
}

/// Replaces the last value g_n, which is the state, by the combination g_n − Σ γ_k (g_n − g_k) with the smallest residual.
fn combine(evaluated: &[Evaluation], state: &mut [f64]) {
    // The combination needs the residuals f_k = g(x_k) − x_k, and the difference f_n − f_k between the last one and each of
    // them.
    let residuals: Vec<Vec<f64>> = evaluated
        .iter()
        .map(|Evaluation { start, value }| minus(value, start))
        .collect();
    let (Some((_, earlier)), Some((residual, earlier_residuals))) =
        (evaluated.split_last(), residuals.split_last())
    else {
        return;
    };
    let differences: Vec<Vec<f64>> = earlier_residuals
        .iter()
        .map(|earlier| minus(residual, earlier))
        .collect();
    // Subtract Σ γ_k (g_n − g_k) from the last value g_n.
    let last = state.to_vec();
    let weights = least_squares_weights(&differences, residual);
    for (weight, Evaluation { value, .. }) in weights.iter().zip(earlier) {
        for (state, (last, value)) in state.iter_mut().zip(last.iter().zip(value)) {
            *state -= weight * (last - value);
        }
    }
}

/// Difference a − b, element by element.
fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// The weights γ_k that minimise |b − Σ γ_k a_k| for the `vectors` a_k and the `target` b, by modified Gram–Schmidt
/// orthogonalisation.
///
/// A vector that depends linearly on later ones has the weight 0.
fn least_squares_weights(vectors: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
    let mut weights = vec![0.0; vectors.len()];
    // `basis` collects orthonormal vectors, each with its coefficients as a combination of the given ones. The latest
    // evaluations come first.
    let mut basis: Vec<[Vec<f64>; 2]> = Vec::new();
    for (index, given) in vectors.iter().enumerate().rev() {
        let mut vector = given.clone();
        let mut coefficients = vec![0.0; vectors.len()];
        coefficients[index] = 1.0;
        // Remove the components along the basis.
        let norm_before = dot(&vector, &vector);
        for [other, other_coefficients] in &basis {
            let component = dot(other, &vector);
            add_scaled(&mut vector, -component, other);
            add_scaled(&mut coefficients, -component, other_coefficients);
        }
        // Normalise the remainder, unless it is rounding: then the difference depends linearly on the others and is left out.
        let norm = dot(&vector, &vector);
        if norm > f64::EPSILON * norm_before {
            let scale = norm.sqrt().recip();
            vector
                .iter_mut()
                .chain(&mut coefficients)
                .for_each(|value| *value *= scale);
            basis.push([vector, coefficients]);
        }
    }
    // The projections of the target on the basis give the weights of the given vectors.
    for [vector, coefficients] in &basis {
        add_scaled(&mut weights, dot(vector, target), coefficients);
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The error components of the map shrink by factors of 0.1 to 0.9999 per evaluation.
    #[test]
    fn slow_components_take_few_evaluations() {
        let rates = [0.1, 0.9, 0.99, 0.999, 0.9999];
        let map = |state: &[f64]| {
            let components = state.iter().zip(rates);
            let value: Vec<f64> = components.map(|(x, rate)| 1.0 + rate * (x - 1.0)).collect();
            Ok::<_, ()>((value.clone(), value))
        };
        let remaining_error = |now: &mut Vec<f64>, before: &Vec<f64>| {
            let changes = now.iter().zip(before).map(|(a, b)| (a - b).abs());
            1e4 * changes.fold(0.0, f64::max)
        };
        let found = anderson_fixed_point(vec![0.0; 5], 100, 1e-6, map, remaining_error);
        let Ok(FixedPoint::Converged {
            result,
            evaluations,
        }) = found
        else {
            panic!("{found:?}");
        };
        let error = result.iter().map(|x| (x - 1.0).abs()).fold(0.0, f64::max);
        assert!(
            error <= 1e-6 && evaluations < 20,
            "{result:?} after {evaluations} evaluations"
        );
    }
}
