//! The least sum of squares, or of another loss, over parameters within bounds.
//!
//! Levenberg's and Marquardt's method (Marquardt 1963, DOI 10.1137/0111030) with the damping on the diagonal.

mod profile;
mod student;

use nalgebra::{DMatrix, DVector};

pub use profile::{Profile, profile_end};
pub use student::student_quantile;

/// A sum at one place, and its second-order model: sum(p + s) ≈ sum − 2 descent·s + s·matrix·s.
#[derive(Debug, Clone, PartialEq)]
pub struct Linearised {
    /// The sum of squares.
    pub sum: f64,
    /// Normal matrix, row by row: the sum over all residuals of the products of two of their derivatives.
    pub matrix: Vec<f64>,
    /// The sum over all residuals of minus the residual times its derivatives.
    pub descent: Vec<f64>,
}

/// How far a parameter may go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// The least and the largest value; a parameter between two equal ones stays there.
    pub bounds: [f64; 2],
    /// Largest change in one step.
    pub largest_step: f64,
}

/// Where a search has ended.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct Minimum {
    /// The parameters.
    pub parameters: Vec<f64>,
    /// The sum there, and its model.
    pub linearised: Linearised,
}

const MAX_STEPS: usize = 100;
/// Part of what is enough, below which a step has changed nothing.
const STALLED: f64 = 0.1;
/// Damping that keeps a matrix positive and changes no step that counts.
const UNDAMPED: f64 = 1e-9;

impl Linearised {
    /// By how much the sum falls by its model.
    fn lowered(&self, from: &[f64], to: &[f64]) -> f64 {
        let moved: Vec<f64> = to.iter().zip(from).map(|(to, from)| to - from).collect();
        let rows = self.matrix.chunks(moved.len()).zip(&self.descent);
        let by_row = rows.zip(&moved).map(|((row, descent), step)| {
            let product: f64 = row.iter().zip(&moved).map(|(a, b)| a * b).sum();
            step * (2.0 * descent - product)
        });
        by_row.sum()
    }
}

/// Goes down from a start within the ranges; the last step is the first that lowers the sum by less than `sufficient` of
/// it.
///
/// None where `linearise` has no finite sum at the start; where it has none on the way, steps become shorter.
pub fn minimise(
    linearise: impl FnMut(&[f64]) -> Option<Linearised>,
    start: Vec<f64>,
    ranges: &[Range],
    sufficient: f64,
) -> Option<Minimum> {
    descend(linearise, start, ranges, Ending::Fraction(sufficient))
}

/// The same; a step within the ranges that would lower the sum by less than `enough` by its model is the last one, and is taken
/// by the model alone: the sum that is returned is that of the model. A step that lowers it by less than a tenth of that is the
/// last one, too.
///
/// None where `linearise` has no finite sum at the start.
pub fn minimise_by_model(
    linearise: impl FnMut(&[f64]) -> Option<Linearised>,
    start: Vec<f64>,
    ranges: &[Range],
    enough: f64,
) -> Option<Minimum> {
    let ending = Ending::Model {
        enough,
        below: f64::NEG_INFINITY,
        most: usize::MAX,
    };
    descend(linearise, start, ranges, ending)
}

/// The same, which ends at the first place with a sum below `below`, and after `most` places with the sum to which the model of the
/// last one falls.
pub(super) fn minimise_below(
    linearise: impl FnMut(&[f64]) -> Option<Linearised>,
    start: Vec<f64>,
    ranges: &[Range],
    ([enough, below], most): ([f64; 2], usize),
) -> Option<Minimum> {
    let ending = Ending::Model {
        enough,
        below,
        most,
    };
    descend(linearise, start, ranges, ending)
}

/// When a search ends.
#[derive(Clone, Copy)]
enum Ending {
    /// When a step lowers the sum by less than this part.
    Fraction(f64),
    /// When the model lowers it by less than `enough`, or when it is below `below`, both in units of the sum; or after `most` places.
    Model {
        enough: f64,
        below: f64,
        most: usize,
    },
}

impl Ending {
    const fn most_places(self) -> usize {
        match self {
            Self::Model { most, .. } => most,
            Self::Fraction(_) => usize::MAX,
        }
    }

    const fn is_below(self, sum: f64) -> bool {
        match self {
            Self::Model { below, .. } => sum < below,
            Self::Fraction(_) => false,
        }
    }

    /// The step that is taken by the model alone, and by how much that lowers the sum; none while the sum has to be computed again.
    fn last_step(
        self,
        linearised: &Linearised,
        parameters: &[f64],
        (ranges, places): (&[Range], usize),
    ) -> Option<(Vec<f64>, f64)> {
        let Self::Model { enough, most, .. } = self else {
            return None;
        };
        let moved = step(linearised, parameters, ranges, UNDAMPED)?;
        let lowered = linearised.lowered(parameters, &moved);
        let is_enough = is_whole([parameters, &moved], ranges) && lowered < enough;
        (is_enough || places >= most).then_some((moved, lowered))
    }
}

fn descend(
    mut linearise: impl FnMut(&[f64]) -> Option<Linearised>,
    start: Vec<f64>,
    ranges: &[Range],
    ending: Ending,
) -> Option<Minimum> {
    let finite = |linearised: &Linearised| linearised.sum.is_finite();
    let mut parameters = start;
    let mut linearised = linearise(&parameters).filter(finite)?;
    let (mut damping, mut places) = (1e-3, 1);
    for _ in 0..MAX_STEPS {
        if ending.is_below(linearised.sum) {
            break;
        }
        if let Some((moved, lowered)) = ending.last_step(&linearised, &parameters, (ranges, places))
        {
            linearised.sum -= lowered.max(0.0);
            parameters = moved;
            break;
        }
        let (mut gained, before) = (None, linearised.sum);
        while gained.is_none() && damping < 1e9 && places < ending.most_places() {
            places += 1;
            let moved = step(&linearised, &parameters, ranges, damping);
            let trial = moved.and_then(|moved| Some((linearise(&moved).filter(finite)?, moved)));
            match trial.filter(|(trial, _)| trial.sum < linearised.sum) {
                Some((trial, moved)) => {
                    gained = Some(1.0 - trial.sum / linearised.sum);
                    (linearised, parameters) = (trial, moved);
                    damping *= 0.2;
                }
                None => damping *= 4.0,
            }
        }
        let is_last = |fraction: f64| match ending {
            Ending::Fraction(sufficient) => fraction < sufficient,
            Ending::Model { enough, .. } => fraction * before < STALLED * enough,
        };
        // After the last place the model takes one more step.
        let goes_on = gained.is_none() && places >= ending.most_places();
        if !goes_on && gained.is_none_or(is_last) {
            break;
        }
    }
    Some(Minimum {
        parameters,
        linearised,
    })
}

/// Whether no parameter was held back by the bounds or the largest step of its range, unless both of its bounds are the same.
fn is_whole([from, to]: [&[f64]; 2], ranges: &[Range]) -> bool {
    let mut pairs = from.iter().zip(to).zip(ranges);
    pairs.all(|((from, to), range)| {
        let [lowest, highest] = range.bounds;
        let is_inside = lowest < *to && *to < highest;
        (is_inside && (to - from).abs() < 0.999 * range.largest_step) || lowest >= highest
    })
}

/// The damped step; none where the damping is too small for the matrix.
fn step(
    linearised: &Linearised,
    parameters: &[f64],
    ranges: &[Range],
    damping: f64,
) -> Option<Vec<f64>> {
    // A parameter on a bound that would go beyond it stays, and the others do not count on it.
    let is_free = |&k: &usize| {
        let [lowest, highest] = ranges[k].bounds;
        let down = linearised.descent[k];
        !(parameters[k] <= lowest && down <= 0.0 || parameters[k] >= highest && down >= 0.0)
    };
    let n = parameters.len();
    let free: Vec<usize> = (0..n).filter(is_free).collect();
    let entry = |row: usize, column: usize| {
        let damping = if row == column { 1.0 + damping } else { 1.0 };
        damping * linearised.matrix[free[row] * n + free[column]]
    };
    let matrix = DMatrix::from_fn(free.len(), free.len(), entry);
    let descent = free.iter().map(|&place| linearised.descent[place]);
    let descent = DVector::from_iterator(free.len(), descent);
    let step = matrix.cholesky()?.solve(&descent);
    let mut moved = parameters.to_vec();
    for (&place, step) in free.iter().zip(step.iter()) {
        let range = &ranges[place];
        let [lowest, highest] = range.bounds;
        let step = step.clamp(-range.largest_step, range.largest_step);
        moved[place] = (moved[place] + step).clamp(lowest, highest);
    }
    Some(moved)
}

/// The inverse of a symmetric positive matrix of `n` rows, row by row; none where it is singular to rounding.
pub fn inverse(matrix: &[f64], n: usize) -> Option<Vec<f64>> {
    let scale: Vec<f64> = (0..n).map(|k| matrix[k * n + k].sqrt().recip()).collect();
    // With a unit diagonal, so that units do not matter.
    let scaled = |row: usize, column: usize| scale[row] * matrix[row * n + column] * scale[column];
    let inverse = DMatrix::from_fn(n, n, scaled).cholesky()?.inverse();
    let entry = |(at, value): (usize, &f64)| scale[at / n] * value * scale[at % n];
    let entries: Vec<f64> = inverse.iter().enumerate().map(entry).collect();
    let is_known = entries.iter().all(|entry| entry.is_finite());
    is_known.then_some(entries)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's valley as residuals 10 (y − x²) and 1 − x.
    fn valley(p: &[f64]) -> Option<Linearised> {
        let residuals = [10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]];
        let slopes = [[-20.0 * p[0], 10.0], [-1.0, 0.0]];
        let product = |j: usize, k: usize| slopes.iter().map(|row| row[j] * row[k]).sum();
        let pairs = residuals.iter().zip(slopes);
        let descent = |k: usize| pairs.clone().map(|(r, row)| -r * row[k]).sum();
        Some(Linearised {
            sum: residuals.iter().map(|r| r * r).sum(),
            matrix: vec![product(0, 0), product(0, 1), product(1, 0), product(1, 1)],
            descent: vec![descent(0), descent(1)],
        })
    }

    #[test]
    fn a_curved_valley_is_followed_to_its_end_or_to_a_bound() {
        let range = |highest| Range {
            bounds: [-2.0, highest],
            largest_step: 0.5,
        };
        let start = || vec![-1.2, 1.0];
        let found = minimise(valley, start(), &[range(2.0); 2], 1e-12).expect("a minimum");
        let off = (found.parameters[0] - 1.0).hypot(found.parameters[1] - 1.0);
        assert!(off < 1e-9, "{:?}", found.parameters);
        // Where the model says that hardly anything is left, it is right.
        let found = minimise_by_model(valley, start(), &[range(2.0); 2], 1e-6).expect("a minimum");
        let off = (found.parameters[0] - 1.0).hypot(found.parameters[1] - 1.0);
        assert!(off < 1e-4 && found.linearised.sum < 1e-7, "{found:?}");
        // On x = 1/2 the least is y = x² with the sum 1/4.
        let ranges = [range(0.5), range(2.0)];
        let found = minimise(valley, start(), &ranges, 1e-12).expect("a minimum");
        assert!((found.linearised.sum - 0.25).abs() < 1e-12, "{found:?}");
    }
}
