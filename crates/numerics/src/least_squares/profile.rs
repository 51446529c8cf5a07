//! Ends of profile-likelihood intervals: how far one parameter may move while all others follow it.

use super::{Minimum, ParameterRange, QuadraticModel, StoppingRule, descend, inverse};

/// One end of the profile-likelihood interval of one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IntervalEnd {
    /// Index of the parameter.
    pub parameter: usize,
    /// Sign of the end: −1 for the lower one, 1 for the upper one.
    pub side: f64,
    /// Rise of the minimal sum from the minimum to the end, in units of the sum.
    pub rise: f64,
    /// Distance from the minimum at which the end is sought first.
    pub initial_step: f64,
    /// Tolerance of √(rise of the minimal sum/`rise`), which is 1 at the end; the end is interpolated then.
    pub relative_tolerance: f64,
}

/// Largest number of trials in the search for one end of an interval. Chosen to limit the computing time: after them the closest
/// trial outside the interval is returned, so that the interval is too wide rather than too narrow.
const MAX_TRIALS: usize = 20;
/// Largest number of evaluations of the sum per trial. Chosen to limit the computing time.
///
/// If it is not enough, the sum after the predicted decrease of the last model is used. In a curved valley that is too small
/// rather than too large, and the interval becomes wider.
const MAX_EVALUATIONS: usize = 12;
/// Ratio of the sufficient decrease of the inner minimisation to the product of `rise` and the relative tolerance. Derived: half
/// of it, 0.15 of the tolerance, is the largest change of √(rise of the minimal sum/`rise`).
const INNER_TOLERANCE: f64 = 0.3;
/// Bounds of the position of the next trial in the bracket, as a fraction of its length. Chosen: each trial shortens the bracket
/// by at least 2 %. It changes the number of trials, not the end.
const INTERPOLATION_RANGE: [f64; 2] = [0.02, 0.98];

/// The value of one parameter at which the minimal sum over all others, within their ranges, has risen as required.
///
/// Returns `None` if the sum has not risen as much up to the bound of the parameter.
pub fn profile_end(
    mut evaluate: impl FnMut(&[f64]) -> Option<QuadraticModel>,
    best: &Minimum,
    ranges: &[ParameterRange],
    end: IntervalEnd,
) -> Option<f64> {
    let IntervalEnd {
        parameter, side, ..
    } = end;
    let value_at = |step: f64| best.parameters[parameter] + side * step;
    let tangent = tangent(best, parameter);
    let range = ranges[parameter];
    let bound = range.bounds[usize::from(side > 0.0)];
    let max_step = side * (bound - best.parameters[parameter]);
    // The bracket of the end consists of the last trial inside the interval and the last one outside it.
    let [mut inner, mut outer] = [0.0, f64::INFINITY].map(|step| Trial {
        step,
        root_rise: step,
    });
    // If no end is expected within the range, its bound is tried first.
    let mut step = if end.initial_step < max_step {
        end.initial_step.min(range.largest_step)
    } else {
        max_step
    };
    for _ in 0..MAX_TRIALS {
        // At the bound it only matters whether the sum has risen enough.
        let target = if step < max_step {
            f64::NEG_INFINITY
        } else {
            best.model.sum + end.rise
        };
        let root_rise = root_rise(&mut evaluate, best, &tangent, ranges, end, step, target);
        let trial = Trial { step, root_rise };
        let is_inside = root_rise < 1.0;
        if is_inside && step >= max_step {
            return None;
        }

        // The trial replaces the inner or the outer end of the bracket.
        let (inner_before, outer_before) = (inner, outer);
        *(if is_inside { &mut inner } else { &mut outer }) = trial;

        // Return the interpolated end when close, otherwise choose the next trial.
        let is_close = (root_rise - 1.0).abs() < end.relative_tolerance;
        step = if is_close && !is_inside {
            return Some(value_at(inner.interpolate_to(outer)));
        } else if is_close {
            match trial.extrapolate(inner_before, outer_before) {
                end if end < max_step => return Some(value_at(end)),
                _ => max_step,
            }
        } else if outer.step.is_infinite() {
            (2.0 * step).min(max_step)
        } else if outer.root_rise.is_infinite() {
            0.5 * (inner.step + outer.step)
        } else {
            inner.interpolate_to(outer)
        };
    }
    // After the last trial the answer is the closest one at which the sum has certainly risen enough.
    Some(value_at(outer.step)).filter(|end| end.is_finite())
}

/// A distance from the minimum, and the root of the relative rise there.
#[derive(Clone, Copy)]
struct Trial {
    /// Distance of the parameter from the minimum.
    step: f64,
    /// Relative root √(rise of the minimal sum/required rise), 1 at the end of the interval and nearly linear in the step.
    root_rise: f64,
}

impl Trial {
    /// The distance at which the line through two trials reaches 1, kept between them.
    fn interpolate_to(self, outer: Self) -> f64 {
        let [lowest, highest] = INTERPOLATION_RANGE;
        let fraction = (1.0 - self.root_rise) / (outer.root_rise - self.root_rise);
        self.step + fraction.clamp(lowest, highest) * (outer.step - self.step)
    }

    /// The distance at which the line through this trial and the closest outer one reaches 1.
    ///
    /// If the outer one is not finite, the last inner one takes its place.
    fn extrapolate(self, inner: Self, outer: Self) -> f64 {
        let is_bracketed = outer.root_rise.is_finite();
        let other = if is_bracketed { outer } else { inner };
        self.step
            + (1.0 - self.root_rise) * (other.step - self.step) / (other.root_rise - self.root_rise)
    }
}

/// Relative root √(rise of the minimal sum/required rise) with the parameter held at the distance `step` from the minimum; the
/// others start along the `tangent`. The minimisation ends early at a sum below `target`.
///
/// Infinite if the sum is not finite, or if the required rise is 0: the end of the interval is then sought closer to the minimum.
fn root_rise(
    evaluate: impl FnMut(&[f64]) -> Option<QuadraticModel>,
    best: &Minimum,
    tangent: &[f64],
    ranges: &[ParameterRange],
    end: IntervalEnd,
    step: f64,
    target: f64,
) -> f64 {
    let mut held_ranges = ranges.to_vec();
    held_ranges[end.parameter].bounds = [best.parameters[end.parameter] + end.side * step; 2];
    // Every trial starts from the minimum: the last trial may have led to another minimum.
    let values = best.parameters.iter().zip(tangent).zip(&held_ranges);
    let start = values.map(|((value, slope), range)| {
        let [lowest, highest] = range.bounds;
        (value + end.side * step * slope).clamp(lowest, highest)
    });
    let rule = StoppingRule::PredictedDecrease {
        sufficient_decrease: INNER_TOLERANCE * end.relative_tolerance * end.rise,
        target,
        max_evaluations: MAX_EVALUATIONS,
    };
    let held = descend(evaluate, start.collect(), &held_ranges, rule);
    let sum = held.map_or(f64::INFINITY, |held| held.model.sum);
    // Near the minimum the root of the rise is linear in the step, as the interpolation assumes.
    let relative_rise = (sum - best.model.sum).max(0.0) / end.rise;
    if relative_rise.is_nan() {
        f64::INFINITY
    } else {
        relative_rise.sqrt()
    }
}

/// Derivatives of all parameters with respect to one, 1 for itself, along the minimal sum of the model at the minimum: its column
/// of the inverse normal matrix over the diagonal entry.
fn tangent(best: &Minimum, parameter: usize) -> Vec<f64> {
    let n = best.parameters.len();
    match inverse(&best.model.matrix, n) {
        Some(inverse) => {
            let column = (0..n).map(|k| inverse[k * n + parameter]);
            let diagonal = inverse[parameter * (n + 1)];
            column.map(|entry| entry / diagonal).collect()
        }
        // If the normal matrix has no inverse, the other parameters stay where they are.
        None => (0..n)
            .map(|k| if k == parameter { 1.0 } else { 0.0 })
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::minimise;
    use super::*;

    /// The residuals x + y − 1 and (y − 2)/2 are linear: up to the bound of x the profile is (x + 1)²/5, and 9/5 there.
    #[test]
    fn ends_are_those_of_a_parabola_or_none() {
        let linearise = |p: &[f64]| {
            let residuals = [p[0] + p[1] - 1.0, 0.5 * (p[1] - 2.0)];
            Some(QuadraticModel {
                sum: residuals.iter().map(|r| r * r).sum(),
                matrix: vec![1.0, 1.0, 1.0, 1.25],
                descent: vec![-residuals[0], -residuals[0] - 0.5 * residuals[1]],
            })
        };
        let ranges = [ParameterRange {
            bounds: [-10.0, 2.0],
            largest_step: 1.0,
        }; 2];
        let best = minimise(linearise, vec![0.0, 0.0], &ranges, 1e-14).expect("a minimum");
        let end = |side, initial_step| {
            let interval_end = IntervalEnd {
                parameter: 0,
                side,
                rise: 4.0,
                initial_step,
                relative_tolerance: 0.01,
            };
            profile_end(linearise, &best, &ranges, interval_end)
        };
        for initial_step in [0.1, 0.9] {
            // y stops at its bound 2, where the second residual is 0, so that only the first one rises beyond.
            let found = end(-1.0, initial_step).expect("an end");
            assert!(
                (found + 3.0).abs() < 0.01 * 2.0,
                "{found}, and −3 is the end"
            );
            assert_eq!(end(1.0, initial_step), None, "up to the bound");
        }
    }
}
