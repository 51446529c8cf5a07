//! Pictures of one answer.

use anyhow::{Context, Result};
use viscofriction::{Answer, PressureField};
use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Figure, Line, Marker, Series, Shape};

/// Fraction of the load on the elements that have the darkest colour of a logarithmic scale (chosen). Without it single
/// elements at the edge of the contact, many decades below the others, would determine the scale.
const DARKEST_LOAD_FRACTION: f64 = 0.01;

/// Map of the pressure, on a logarithmic scale if the peak is unbounded; with an arrow along the motion if the body slides.
pub(super) fn pressure(answer: &Answer, field: &PressureField) -> Result<Figure> {
    let shape = field.grid.shape();
    let range = |axis: usize| {
        let [origin, spacing] = [field.origin[axis], field.grid.spacing()[axis]];
        let last = origin + (shape[axis] as f64 - 0.5) * spacing;
        [origin - 0.5 * spacing, last]
    };
    let loaded = field.pressure.iter().filter(|pressure| **pressure > 0.0);
    let mut loaded: Vec<f64> = loaded.copied().collect();
    loaded.sort_by(f64::total_cmp);
    let highest = *loaded.last().context("nothing is loaded")?;
    let (colours, lowest) = if answer.peak_pressure.is_some() {
        (Axis::linear("pressure P [Pa]", [0.0, highest]), 0.0)
    } else {
        let of_darkest = DARKEST_LOAD_FRACTION * loaded.iter().sum::<f64>();
        let mut load = 0.0;
        let mut above = loaded.iter().skip_while(|pressure| {
            load += **pressure;
            load < of_darkest
        });
        let lowest = above
            .next()
            .map_or(highest, |lowest| lowest.min(0.4 * highest));
        (Axis::log10("pressure P [Pa]", [lowest, highest]), lowest)
    };
    let is_cut = loaded[0] < lowest;
    let pressures = Field::new(shape, colours, |x, y| {
        let pressure = field.pressure[x * shape[1] + y];
        (pressure > 0.0).then(|| pressure.max(lowest))
    });
    let [x, y] = [range(0), range(1)];
    let motion = answer.friction_coefficient.map(|_| arrow(x, y, true));
    // The title does not fit above narrow maps.
    let has_room = x[1] - x[0] > 0.5 * (y[1] - y[0]);
    let title = (is_cut && has_room).then(|| "darkest: 1 % of the load".to_owned());
    let [x, y] = [Axis::linear("x [m]", x), Axis::linear("y [m]", y)];
    Ok(Figure::single(Chart {
        title,
        series: motion.into_iter().collect(),
        ..Chart::map(x, y, pressures)
    }))
}

/// Arrow along +x, the motion, in the lower left corner of a chart with the ranges `x` and `y`; `is_true` if both axes have the
/// same scale.
pub(crate) fn arrow(x: [f64; 2], y: [f64; 2], is_true: bool) -> Series {
    let spans = [x, y].map(|[from, to]| 0.03 * (to - from));
    let shorter = spans[0].min(spans[1]);
    let [along, across] = if is_true { [shorter; 2] } else { spans };
    let (end, y) = (x[0] + 9.0 * along, y[0] + 2.0 * across);
    let head = [
        [end, y],
        [end - along, y + 0.6 * across],
        [end, y],
        [end - along, y - 0.6 * across],
    ];
    let points = std::iter::once([x[0] + along, y]).chain(head).collect();
    Series::line(points, Line::thick(Dash::Solid), Colour::Black)
}

/// A figure of a quantity over another as a line; `x` and `y` are the axis labels.
pub(super) fn curve(x: &str, y: &str, points: Vec<[f64; 2]>) -> Figure {
    let line = Line::thick(Dash::Solid);
    single_series(x, y, Series::line(points, line, Colour::Blue))
}

/// A figure of a quantity over another as separate points; `x` and `y` are the axis labels.
pub(super) fn points(x: &str, y: &str, points: Vec<[f64; 2]>) -> Figure {
    let marker = Marker::filled(Shape::Circle);
    single_series(x, y, Series::markers(points, marker, Colour::Blue))
}

/// A figure of one series.
fn single_series(x: &str, y: &str, series: Series) -> Figure {
    let range = |axis: usize| range_with_zero(series.points.iter().map(|point| point[axis]));
    let [x, y] = [Axis::linear(x, range(0)), Axis::linear(y, range(1))];
    Figure::single(Chart::new(x, y, vec![series]))
}

/// A range that includes 0 and all values, with a margin of 5 % of its length; [−1, 1] if all are 0.
pub(crate) fn range_with_zero(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [low, high] = values.fold([0.0_f64; 2], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    let room = if high > low { 0.05 * (high - low) } else { 1.0 };
    // The margin keeps markers inside the frame.
    [low - room, high + room]
}
