//! Measured and fitted moduli, and the error between them.

use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

/// Columns of fit.csv: what was measured, the same of the series, and the relative error of each.
pub(super) const OSCILLATION: &str = "angular_frequency_rad_per_s storage_pa loss_pa storage_fit_pa loss_fit_pa \
    storage_relative_error loss_relative_error";
pub(super) const RELAXATION: &str = "time_s modulus_pa modulus_fit_pa relative_error";

/// Measured against fitted, as rows of a table.
pub(super) struct Comparison {
    pub(super) names: &'static str,
    pub(super) rows: Vec<Vec<f64>>,
    /// Frequencies or times that are dense between the first and the last one, and the moduli of the series.
    pub(super) series: Vec<Vec<f64>>,
}

pub(super) fn figure(comparison: &Comparison) -> Figure {
    let (x, moduli) = match comparison.names {
        OSCILLATION => ("angular frequency ω [rad/s]", &["G′", "G″"][..]),
        _ => ("time t [s]", &["G"][..]),
    };
    // A logarithm has no zero; the CSV file has all points.
    let points_of = |rows: &[Vec<f64>], column: usize| -> Vec<[f64; 2]> {
        let points = rows.iter().map(|row| [row[0], row[column]]);
        points.filter(|point| point[1] > 0.0).collect()
    };
    let points = |column| points_of(&comparison.rows, column);
    let n = moduli.len();
    let coloured = || moduli.iter().zip([Colour::Blue, Colour::Red]).enumerate();
    let measured = coloured().map(|(index, (name, colour))| {
        let marker = Marker::open(Shape::Circle);
        Series::markers(points(1 + index), marker, colour).labelled(format!("{name} measured"))
    });
    let fitted = coloured().map(|(index, (name, colour))| {
        let line = Line::thick(Dash::Solid);
        let points = points_of(&comparison.series, 1 + index);
        Series::line(points, line, colour).labelled(format!("{name} of the series"))
    });
    let errors = coloured().map(|(index, (name, colour))| {
        let marker = Marker::filled(Shape::Diamond);
        Series::markers(points(1 + 2 * n + index), marker, colour).labelled(*name)
    });
    let charts = [
        decades(x, "modulus [Pa]", measured.chain(fitted).collect()),
        decades(x, "relative error", errors.collect()),
    ];
    Figure::new(charts, 2)
}

/// Series over the decades that they take.
pub(crate) fn decades(x: &str, y: &str, series: Vec<Series>) -> Chart {
    let values = |axis: usize| series.iter().flat_map(|s| &s.points).map(move |p| p[axis]);
    let [x, y] = [Axis::decades(x, values(0)), Axis::decades(y, values(1))];
    Chart::new(x, y, series)
}
