//! Exponents of power laws: straight lines of least squares through logarithms.

use numerics::Estimate;

/// Smallest number of points of a fit. Derived: one more than its two parameters, without which there is no residual to judge it
/// by.
const MIN_POINTS: usize = 3;
/// Smallest ratio of the largest to the smallest abscissa of a fit. Chosen: over a shorter span the exponent is mostly noise.
const MIN_SPAN: f64 = 2.0;

/// The [`exponent`] of positive points (x, y); `None` for fewer than [`MIN_POINTS`], of a span below [`MIN_SPAN`], and where
/// its standard error is not smaller than itself.
pub(super) fn clear_exponent(points: &[[f64; 2]]) -> Option<Estimate> {
    let abscissae = || points.iter().map(|point| point[0]);
    let span = abscissae().fold(0.0, f64::max) / abscissae().fold(f64::INFINITY, f64::min);
    if points.len() < MIN_POINTS || span < MIN_SPAN {
        return None;
    }
    let exponent = exponent(points);
    (exponent.error < exponent.value.abs()).then_some(exponent)
}

/// The exponent q of y ∼ x^q and its standard error, by unweighted least squares of ln y against ln x; all points (x, y)
/// positive and at least three.
pub(super) fn exponent(points: &[[f64; 2]]) -> Estimate {
    let logarithms: Vec<[f64; 2]> = points.iter().map(|point| point.map(f64::ln)).collect();
    let count = points.len() as f64;
    let mean = |axis: usize| logarithms.iter().map(|point| point[axis]).sum::<f64>() / count;
    let [x, y] = [mean(0), mean(1)];
    let centred = || logarithms.iter().map(|point| [point[0] - x, point[1] - y]);
    let squares: f64 = centred().map(|[x, _]| x * x).sum();
    let value = centred().map(|[x, y]| x * y).sum::<f64>() / squares;
    let misfit: f64 = centred().map(|[x, y]| (y - value * x).powi(2)).sum();
    let error = (misfit / ((count - 2.0) * squares)).sqrt();
    Estimate::new(value, error)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Too few points, too small a span, and mere scatter have no exponent.
    #[test]
    fn exponents_and_their_standard_errors_are_those_of_least_squares() {
        let exact = [1.0, 2.0, 5.0, 20.0].map(|x: f64| [x, 3.0 * x.powf(-1.5)]);
        // In logarithms the points have the slope 5/2 and the misfits 1/2, −1, 1/2. Their variance is 3/2 over one degree of
        // freedom. Divided by 2, the sum of squares of the abscissae, it is the squared error of the slope.
        let bent = [[0.0, 0.0], [1.0, 1.0], [2.0, 5.0]].map(|point| point.map(f64::exp));
        for (points, expected) in [
            (exact.to_vec(), Some([-1.5, 0.0])),
            (bent.to_vec(), Some([2.5, 0.75_f64.sqrt()])),
            (vec![[1.0, 1.0], [4.0, 2.0]], None),
            (vec![[1.0, 1.0], [1.2, 2.0], [1.9, 3.0]], None),
            (vec![[1.0, 1.0], [2.0, 9.0], [4.0, 1.1]], None),
        ] {
            let got = clear_exponent(&points).map(|got| [got.value, got.error]);
            let is_right = match (got, expected) {
                (Some(got), Some(expected)) => {
                    (0..2).all(|part| (got[part] - expected[part]).abs() < 1e-12)
                }
                _ => got.is_none() && expected.is_none(),
            };
            assert!(is_right, "{points:?}: expected {expected:?}, got {got:?}");
        }
    }
}
