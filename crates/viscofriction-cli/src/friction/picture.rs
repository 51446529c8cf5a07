//! Picture of measured and fitted friction over the reduced velocity, and of the residuals.

use measurements::friction::FrictionNoise;
use viscofriction::friction_fit::FittedFriction;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

/// Ratio of the margin above and below the values to their range. Chosen.
const MARGIN: f64 = 0.06;

/// Approximate number of temperatures in the legend, besides the last one. Chosen.
const LABELLED: usize = 6;

/// The figure of a fit; `curve` is the computed friction over the reduced velocity, or empty, and `noise` that of the fit.
pub(super) fn figure(found: &FittedFriction, curve: Vec<[f64; 2]>, noise: FrictionNoise) -> Figure {
    let measured = |at: usize| found.points[at].friction_coefficient;
    let fitted = |at: usize| found.fit.fitted[at];
    // Points without standard errors get the scatter around the fit as their bars.
    let error = |at: usize| {
        let scatter = match noise {
            FrictionNoise::Relative => found.fit.residual * fitted(at).abs(),
            FrictionNoise::Absolute => found.fit.residual,
        };
        found.points[at].standard_error.unwrap_or(scatter)
    };
    let groups = by_temperature(found);
    let markers = |value: &dyn Fn(usize) -> f64, error: &dyn Fn(usize) -> f64| -> Vec<Series> {
        let series = groups.iter().map(|(colour, label, rows)| {
            let points = rows
                .iter()
                .map(|&at| [found.shifted_velocities[at], value(at)]);
            Series {
                errors: rows.iter().map(|&at| error(at)).collect(),
                label: label.clone(),
                ..Series::markers(points.collect(), Marker::filled(Shape::Dot), *colour)
            }
        });
        series.collect()
    };
    let of_fit = if curve.len() > 1 {
        Series::line(curve, Line::thick(Dash::Solid), Colour::Red)
    } else {
        let rows = 0..found.points.len();
        let points = rows.map(|at| [found.shifted_velocities[at], fitted(at)]);
        Series::markers(points.collect(), Marker::open(Shape::Circle), Colour::Red)
    };
    let is_shifted = found.points.iter().any(|point| point.temperature.is_some());
    let speeds = if is_shifted {
        "speed v a_T [m/s]"
    } else {
        "speed v [m/s]"
    };
    let mut friction = vec![of_fit.labelled("fit")];
    friction.extend(markers(&measured, &error));
    let mut residuals = markers(&|at| measured(at) / fitted(at) - 1.0, &|at| {
        error(at) / fitted(at).abs()
    });
    // Remove the labels of the residuals, because the legend of the first chart explains the colours.
    residuals.iter_mut().for_each(|one| one.label = None);
    let charts = [
        chart([speeds, "friction coefficient μ"], friction),
        chart([speeds, "measured/fit − 1"], residuals),
    ];
    Figure::new(charts, 2)
}

/// Colour, entry of the legend, and indices of the points of each temperature, in order of temperature; without temperatures one
/// group of all points.
fn by_temperature(found: &FittedFriction) -> Vec<(Colour, Option<String>, Vec<usize>)> {
    let temperature = |at: usize| found.points[at].temperature;
    let mut temperatures: Vec<f64> = (0..found.points.len()).filter_map(temperature).collect();
    temperatures.sort_by(f64::total_cmp);
    temperatures.dedup();
    if temperatures.len() < 2 {
        let all = (0..found.points.len()).collect();
        return vec![(Colour::Blue, Some("measured".to_owned()), all)];
    }
    let last = temperatures.len() - 1;
    let every = temperatures.len().div_ceil(LABELLED);
    let group = |(place, value): (usize, &f64)| {
        let is_same = |at: &usize| temperature(*at).is_some_and(|own| own.total_cmp(value).is_eq());
        let rows = (0..found.points.len()).filter(is_same).collect();
        let label = (place == last || place % every == 0).then(|| format!("measured, {value} °C"));
        (Colour::between(place as f64 / last as f64), label, rows)
    };
    temperatures.iter().enumerate().map(group).collect()
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
