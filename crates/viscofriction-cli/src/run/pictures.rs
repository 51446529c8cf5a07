//! Pictures of one answer.

use anyhow::{Context, Result};
use viscofriction::PressureField;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Figure, Line, Marker, Series, Shape};

/// The pressure over the contact.
pub(super) fn pressure(field: &PressureField) -> Result<Figure> {
    let shape = field.grid.shape();
    let axis = |axis: usize, label: &str| {
        let [origin, spacing] = [field.origin[axis], field.grid.spacing()[axis]];
        let last = origin + (shape[axis] as f64 - 0.5) * spacing;
        Axis::linear(label, [origin - 0.5 * spacing, last])
    };
    let loaded = field.pressure.iter().filter(|pressure| **pressure > 0.0);
    let logarithms = loaded.map(|pressure| pressure.log10());
    let lowest = logarithms.clone().reduce(f64::min);
    let highest = logarithms.reduce(f64::max);
    let (lowest, highest) = lowest.zip(highest).context("nothing is loaded")?;
    let colours = Axis::linear("log₁₀ (P / Pa)", [lowest.min(highest - 1e-3), highest]);
    let logarithms = Field::new(shape, colours, |x, y| {
        let pressure = field.pressure[x * shape[1] + y];
        (pressure > 0.0).then(|| pressure.log10())
    });
    let [x, y] = [axis(0, "x [m]"), axis(1, "y [m]")];
    Ok(Figure::single(Chart::map(x, y, logarithms)))
}

/// One quantity over another, straight between the points.
pub(super) fn curve(x: &str, y: &str, points: Vec<[f64; 2]>) -> Figure {
    let [x, y] = axes([x, y], &points);
    let line = Series::line(points, Line::thick(Dash::Solid), Colour::Blue);
    Figure::single(Chart::new(x, y, vec![line]))
}

/// One quantity over another at points between which nothing is known.
pub(super) fn points(x: &str, y: &str, points: Vec<[f64; 2]>) -> Figure {
    let [x, y] = axes([x, y], &points);
    let markers = Series::markers(points, Marker::filled(Shape::Circle), Colour::Blue);
    Figure::single(Chart::new(x, y, vec![markers]))
}

fn axes([x, y]: [&str; 2], points: &[[f64; 2]]) -> [Axis; 2] {
    [(0, x), (1, y)]
        .map(|(axis, label)| Axis::linear(label, around(points.iter().map(|point| point[axis]))))
}

/// A range that holds zero and all values, with some room.
pub(crate) fn around(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [low, high] = values.fold([0.0_f64; 2], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    let room = if high > low { 0.05 * (high - low) } else { 1.0 };
    [if low < 0.0 { low - room } else { 0.0 }, high + room]
}
