//! Picture of a measured curve, its fit, and the residuals.

use measurements::indentation::IndentationFit;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

/// Largest number of points that are drawn; of more points every n-th is. Chosen: about three for each pixel of the width of
/// a chart.
const MAX_POINTS: usize = 1500;

/// The figure of a fit: force over time, force over the depth from the contact point, and residuals in units of their standard
/// deviation.
pub(super) fn figure(fit: &IndentationFit) -> Figure {
    let step = fit.points.len().div_ceil(MAX_POINTS);
    let mut found = fit.findings.iter();
    let contact = found.find(|one| one.name == "contact_point");
    let contact = contact
        .and_then(|one| one.estimate)
        .map_or(0.0, |one| one.value);
    let points = |x: usize, y: &dyn Fn(&[f64; 4]) -> f64| -> Vec<[f64; 2]> {
        let points = fit.points.iter().step_by(step);
        let from = if x == 1 { contact } else { 0.0 };
        points.map(|point| [point[x] - from, y(point)]).collect()
    };
    let force = |x: usize, label: &str| {
        let marker = Marker::filled(Shape::Dot);
        let measured = Series::markers(points(x, &|point| point[2]), marker, Colour::Blue);
        let line = Line::thick(Dash::Solid);
        let fitted = Series::line(points(x, &|point| point[3]), line, Colour::Red);
        let series = vec![measured.labelled("measured"), fitted.labelled("fit")];
        chart(label, "force F [N]", series)
    };
    let marker = Marker::filled(Shape::Dot);
    let residual = |point: &[f64; 4]| (point[2] - point[3]) / fit.residual;
    let residuals = Series::markers(points(0, &residual), marker, Colour::Black);
    let charts = [
        force(0, "time t [s]"),
        force(1, "depth from the contact [m]"),
        chart("time t [s]", "residual / its spread", vec![residuals]),
    ];
    Figure::new(charts, 3)
}

/// A chart whose range holds all points with a margin.
fn chart(x: &str, y: &str, series: Vec<Series>) -> Chart {
    let range = |axis: usize| {
        let points = series.iter().flat_map(|one| &one.points);
        let values = points.map(|point| point[axis]);
        let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
            [low.min(value), high.max(value)]
        });
        let margin = 0.04 * (high - low);
        [low - margin, high + margin]
    };
    let [x, y] = [Axis::linear(x, range(0)), Axis::linear(y, range(1))];
    Chart::new(x, y, series)
}
