//! Picture of measured and fitted moduli, and of their relative errors.

use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

/// Columns of fit.csv for oscillation: measured moduli, fitted moduli, and their relative errors.
pub(super) const OSCILLATION: &str = "angular_frequency_rad_per_s storage_pa loss_pa storage_fit_pa loss_fit_pa \
    storage_relative_error loss_relative_error";
/// Columns of fit.csv for relaxation: measured modulus, fitted modulus, and its relative error.
pub(super) const RELAXATION: &str = "time_s modulus_pa modulus_fit_pa relative_error";

/// Measured and fitted values as rows of fit.csv.
pub(super) struct Comparison {
    /// Names of the columns: [`OSCILLATION`] or [`RELAXATION`].
    pub(super) names: &'static str,
    /// Values of the rows, in the order of the columns.
    pub(super) rows: Vec<Vec<f64>>,
    /// Dense frequencies or times over the range of the data, with the moduli of the series.
    pub(super) series: Vec<Vec<f64>>,
    /// Isotherms of the rows; `None` for a single one.
    pub(super) isotherms: Option<Isotherms>,
}

/// Assignment of the rows to isotherms.
pub(super) struct Isotherms {
    /// Index into `temperatures`, by row.
    pub(super) of_rows: Vec<usize>,
    /// Temperatures of the isotherms, in [`unit`](Self::unit).
    pub(super) temperatures: Vec<f64>,
    /// Unit of the temperatures.
    pub(super) unit: &'static str,
}

/// The figure of a fit: measured and fitted moduli, and the relative errors of the fit.
pub(super) fn figure(comparison: &Comparison) -> Figure {
    let (x, moduli) = match comparison.names {
        OSCILLATION => ("angular frequency ω [rad/s]", &["G′", "G″"][..]),
        _ => ("time t [s]", &["G"][..]),
    };
    // Omit zeros on logarithmic axes; the CSV file has all points.
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
    let errors = (0..n).map(|index| {
        let column = 1 + 2 * n + index;
        let of_modulus = residuals(comparison, column);
        let name = format!("{} fitted/measured − 1 [%]", moduli[index]);
        signed_chart(x, &name, of_modulus)
    });
    let moduli = decades(x, "modulus [Pa]", measured.chain(fitted).collect());
    let charts: Vec<Chart> = std::iter::once(moduli).chain(errors).collect();
    let columns = charts.len();
    Figure::new(charts, columns)
}

/// Relative errors of a modulus, in the column `column` of the rows, in \[%], one series per isotherm in order of temperature.
fn residuals(comparison: &Comparison, column: usize) -> Vec<Series> {
    let point = |row: &Vec<f64>| [row[0], 100.0 * row[column]];
    let marker = Marker::open(Shape::Circle);
    let Some(isotherms) = &comparison.isotherms else {
        let points = comparison.rows.iter().map(point).collect();
        return vec![Series::markers(points, marker, Colour::Blue)];
    };
    let mut order: Vec<usize> = (0..isotherms.temperatures.len()).collect();
    order.sort_by(|a, b| isotherms.temperatures[*a].total_cmp(&isotherms.temperatures[*b]));
    let last = order.len() - 1;
    let labelled = order.len().div_ceil(N_LABELLED);
    let of_isotherm = |(place, isotherm): (usize, &usize)| {
        let rows = comparison.rows.iter().zip(&isotherms.of_rows);
        let own = rows.filter(|(_, of_row)| *of_row == isotherm);
        let points = own.map(|(row, _)| point(row)).collect();
        let series = Series::markers(points, marker, Colour::between(place as f64 / last as f64));
        if place == last || place % labelled == 0 {
            let temperature = isotherms.temperatures[*isotherm];
            series.labelled(format!("{temperature} {}", isotherms.unit))
        } else {
            series
        }
    };
    let all = order.iter().enumerate().map(of_isotherm);
    // An isotherm may be empty, because overlapping points are averaged with those of others.
    all.filter(|series| !series.points.is_empty()).collect()
}

/// Approximate number of isotherms in the legend, besides the last one. Chosen.
const N_LABELLED: usize = 6;

/// Smallest half range of the axis of relative errors, \[%]. Chosen: smaller errors are drawn near zero.
const MIN_HALF_RANGE: f64 = 0.01;

/// A chart of signed values over a logarithmic axis, with 0 in the middle and a line there; `x` and `y` are the axis labels.
fn signed_chart(x: &str, y: &str, series: Vec<Series>) -> Chart {
    let points = || series.iter().flat_map(|one| &one.points);
    let most = points().map(|point| point[1].abs()).fold(0.0, f64::max);
    let most = 1.05 * most.max(MIN_HALF_RANGE);
    let x = Axis::decades(x, points().map(|point| point[0]));
    let zero = vec![[x.range[0], 0.0], [x.range[1], 0.0]];
    let zero = Series::line(zero, Line::thin(Dash::Solid), Colour::Black);
    let all = std::iter::once(zero).chain(series).collect();
    Chart::new(x, Axis::linear(y, [-most, most]), all)
}

/// A chart with both axes logarithmic over the decades of the series.
pub(crate) fn decades(x: &str, y: &str, series: Vec<Series>) -> Chart {
    let values = |axis: usize| series.iter().flat_map(|s| &s.points).map(move |p| p[axis]);
    let [x, y] = [Axis::decades(x, values(0)), Axis::decades(y, values(1))];
    Chart::new(x, y, series)
}
