//! A curve, its fit, and the residuals between them.

use viscofriction::indentation::IndentationFit;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

/// Points of a picture.
const POINTS: usize = 1500;

pub(super) fn figure(fit: &IndentationFit) -> Figure {
    let step = fit.points.len().div_ceil(POINTS);
    let points = |x: usize, y: &dyn Fn(&[f64; 4]) -> f64| -> Vec<[f64; 2]> {
        let points = fit.points.iter().step_by(step);
        points.map(|point| [point[x], y(point)]).collect()
    };
    let force = |x: usize, label: &str| {
        let marker = Marker::open(Shape::Circle);
        let measured = Series::markers(points(x, &|point| point[2]), marker, Colour::Blue);
        let line = Line::thick(Dash::Solid);
        let fitted = Series::line(points(x, &|point| point[3]), line, Colour::Red);
        let series = vec![measured.labelled("measured"), fitted.labelled("fit")];
        chart(label, "force [N]", series)
    };
    let marker = Marker::filled(Shape::Circle);
    let residual = |point: &[f64; 4]| (point[2] - point[3]) / fit.residual;
    let residuals = Series::markers(points(0, &residual), marker, Colour::Black);
    let charts = [
        force(0, "time [s]"),
        force(1, "depth [m]"),
        chart("time [s]", "residual / its spread", vec![residuals]),
    ];
    Figure::new(charts, 3)
}

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
