//! Orders and exponents of cost: straight lines through logarithms.

use serde::Serialize;

use super::measured::Row;

/// A line needs more points than it has parameters.
const FEWEST: usize = 3;
/// Elements, tolerances or unknowns must span this factor before a power of them means anything.
const LEAST_SPAN: f64 = 2.0;

/// How one method converges on one scene, and what that costs.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Fit {
    pub(super) scene: &'static str,
    pub(super) model: &'static str,
    pub(super) method: String,
    pub(super) resolution_kind: &'static str,
    /// Runs that the order is fitted to, whose errors are larger than that of the reference and than rounding.
    pub(super) runs_fitted: usize,
    /// q of error ∼ (1/elements)^q, or ∼ tolerance^q.
    pub(super) order: Option<f64>,
    /// Standard error of the order.
    pub(super) order_error: Option<f64>,
    /// q of processor time ∼ unknowns^q.
    pub(super) cost_exponent: Option<f64>,
    /// Standard error of this exponent.
    pub(super) cost_exponent_error: Option<f64>,
}

/// A slope and its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Slope {
    value: f64,
    error: f64,
}

/// The fit of rows of one series.
pub(super) fn fit(rows: &[Row]) -> Option<Fit> {
    let first = rows.first()?;
    let resolved = rows.iter().filter(|row| row.is_resolved());
    let errors: Vec<[f64; 2]> = resolved
        .filter_map(|row| Some([row.fineness?, row.error]))
        .collect();
    let costs: Vec<[f64; 2]> = rows
        .iter()
        .filter(|row| row.unknowns > 0)
        .map(|row| [row.unknowns as f64, row.processor_seconds])
        .collect();
    let [order, cost] = [slope(&errors), slope(&costs)];
    Some(Fit {
        scene: first.scene,
        model: first.model,
        method: first.method.clone(),
        resolution_kind: first.resolution_kind,
        runs_fitted: errors.len(),
        order: order.map(|slope| slope.value),
        order_error: order.map(|slope| slope.error),
        cost_exponent: cost.map(|slope| slope.value),
        cost_exponent_error: cost.map(|slope| slope.error),
    })
}

/// The straight line of least squares through the logarithms, where there are points enough and they scatter by less
/// than the line rises.
fn slope(points: &[[f64; 2]]) -> Option<Slope> {
    let logarithms: Vec<[f64; 2]> = points.iter().map(|point| point.map(f64::ln)).collect();
    let abscissae = || logarithms.iter().map(|point| point[0]);
    let span =
        abscissae().fold(f64::NEG_INFINITY, f64::max) - abscissae().fold(f64::INFINITY, f64::min);
    if points.len() < FEWEST || span < LEAST_SPAN.ln() {
        return None;
    }
    let count = points.len() as f64;
    let mean = |axis: usize| logarithms.iter().map(|point| point[axis]).sum::<f64>() / count;
    let [x, y] = [mean(0), mean(1)];
    let centred = || logarithms.iter().map(|point| [point[0] - x, point[1] - y]);
    let squares: f64 = centred().map(|[x, _]| x * x).sum();
    let value = centred().map(|[x, y]| x * y).sum::<f64>() / squares;
    let misfit: f64 = centred().map(|[x, y]| (y - value * x).powi(2)).sum();
    let error = (misfit / ((count - 2.0) * squares)).sqrt();
    (error < value.abs()).then_some(Slope { value, error })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_has_its_exponent_as_slope() {
        let points = [1.0, 2.0, 5.0, 20.0].map(|x: f64| [x, 3.0 * x.powf(-1.5)]);
        let got = slope(&points).expect("a slope");
        assert!(
            (got.value + 1.5).abs() < 1e-12 && got.error < 1e-12,
            "expected -1.5 without error, got {got:?}"
        );
    }

    /// In logarithms y = 0, 1, 5 over x = 0, 1, 2: slope 5/2, misfits 1/2, −1, 1/2, variance 3/2 over one degree of
    /// freedom and a sum of squares of 2.
    #[test]
    fn the_standard_error_is_that_of_least_squares() {
        let points = [[0.0, 0.0], [1.0, 1.0], [2.0, 5.0]].map(|point| point.map(f64::exp));
        let got = slope(&points).expect("a slope");
        let expected = [2.5, 0.75_f64.sqrt()];
        assert!(
            (got.value - expected[0]).abs() < 1e-12 && (got.error - expected[1]).abs() < 1e-12,
            "expected {expected:?}, got {got:?}"
        );
    }

    #[test]
    fn too_few_points_too_small_a_span_or_mere_scatter_have_none() {
        assert_eq!(slope(&[[1.0, 1.0], [4.0, 2.0]]), None, "two points");
        let close = [[1.0, 1.0], [1.2, 2.0], [1.9, 3.0]];
        assert_eq!(slope(&close), None, "{close:?}");
        let scattered = [[1.0, 1.0], [2.0, 9.0], [4.0, 1.1]];
        assert_eq!(slope(&scattered), None, "{scattered:?}");
    }
}
