//! Picture of measured and fitted friction over the reduced velocity, and of the residuals.

use viscofriction::friction_fit::FittedFriction;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

/// Margin above and below the values, over their range (chosen).
const MARGIN: f64 = 0.06;

/// The figure of a fit: measured and fitted friction over a_T v, and the relative residuals.
pub(super) fn figure(found: &FittedFriction) -> Figure {
    let mut order: Vec<usize> = (0..found.points.len()).collect();
    let speed = |at: usize| found.shifted_velocities[at];
    order.sort_by(|&one, &other| speed(one).total_cmp(&speed(other)));
    let along = |value: &dyn Fn(usize) -> f64| -> Vec<[f64; 2]> {
        order.iter().map(|&at| [speed(at), value(at)]).collect()
    };
    let error = |at: usize| found.points[at].standard_error.unwrap_or(0.0);
    let measured = |at: usize| found.points[at].friction_coefficient;
    let fitted = |at: usize| found.fit.fitted[at];
    let points = Series {
        errors: order.iter().map(|&at| error(at)).collect(),
        ..Series::markers(along(&measured), Marker::filled(Shape::Dot), Colour::Blue)
    };
    let forces: Vec<Option<f64>> = found
        .points
        .iter()
        .map(|point| point.normal_force)
        .collect();
    // With several forces the fitted friction is not a function of the velocity, so draw markers.
    let of_fit = if forces.windows(2).all(|pair| pair[0] == pair[1]) {
        Series::line(along(&fitted), Line::thick(Dash::Solid), Colour::Red)
    } else {
        Series::markers(along(&fitted), Marker::open(Shape::Circle), Colour::Red)
    };
    let residual = |at: usize| measured(at) / fitted(at) - 1.0;
    let residuals = Series {
        errors: order.iter().map(|&at| error(at) / fitted(at)).collect(),
        ..Series::markers(along(&residual), Marker::filled(Shape::Dot), Colour::Black)
    };
    let is_shifted = found.points.iter().any(|point| point.temperature.is_some());
    let speeds = if is_shifted {
        "speed v a_T [m/s]"
    } else {
        "speed v [m/s]"
    };
    let both = vec![points.labelled("measured"), of_fit.labelled("fit")];
    let charts = [
        chart([speeds, "friction coefficient μ"], both),
        chart([speeds, "residual / fit"], vec![residuals]),
    ];
    Figure::new(charts, 2)
}

/// A chart over the velocity on a logarithmic axis; `along` and `label` are the axis labels. The linear axis includes 0 and the
/// error bars.
fn chart([along, label]: [&str; 2], series: Vec<Series>) -> Chart {
    let points = || series.iter().flat_map(|one| &one.points);
    let speeds = points().map(|point| point[0]);
    let ends = series.iter().flat_map(|one| {
        let error = |at: usize| one.errors.get(at).copied().unwrap_or(0.0);
        let points = one.points.iter().enumerate();
        points.flat_map(move |(at, point)| [point[1] - error(at), point[1] + error(at)])
    });
    let [low, high] = ends.fold([0.0_f64, f64::MIN_POSITIVE], |[low, high], end| {
        [low.min(end), high.max(end)]
    });
    let margin = MARGIN * (high - low);
    let low = if low < 0.0 { low - margin } else { low };
    let y = Axis::linear(label, [low, high + margin]);
    Chart::new(Axis::decades(along, speeds), y, series)
}
