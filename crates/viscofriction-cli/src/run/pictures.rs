//! Pictures of one answer.

use anyhow::{Context, Result};
use viscofriction::PressureField;
use viscofriction_plot::{
    Axis, Chart, Colour, ColourScale, Dash, Figure, LegendPlace, Line, Map, Proportions, Series,
};

/// The pressure over the contact.
pub(super) fn pressure(field: &PressureField) -> Result<Figure> {
    let [rows, columns] = field.grid.shape();
    let axis = |axis: usize, label: &str| {
        let [origin, spacing] = [field.origin[axis], field.grid.spacing()[axis]];
        let last = origin + (field.grid.shape()[axis] as f64 - 0.5) * spacing;
        Axis::linear(label, [origin - 0.5 * spacing, last])
    };
    let loaded = field.pressure.iter().filter(|pressure| **pressure > 0.0);
    let logarithms = loaded.map(|pressure| pressure.log10());
    let lowest = logarithms.clone().reduce(f64::min);
    let highest = logarithms.reduce(f64::max);
    let (lowest, highest) = lowest.zip(highest).context("nothing is loaded")?;
    // The field is stored with y fastest, a map with x fastest.
    let value = |index: usize| {
        let pressure = field.pressure[(index % rows) * columns + index / rows];
        (pressure > 0.0).then(|| pressure.log10())
    };
    Ok(Figure::single(Map {
        title: None,
        x: axis(0, "x [m]"),
        y: axis(1, "y [m]"),
        columns: rows,
        values: (0..rows * columns).map(value).collect(),
        colours: ColourScale {
            label: "log₁₀ (P / Pa)".into(),
            range: [lowest.min(highest - 1e-3), highest],
        },
        overlays: Vec::new(),
        proportions: Proportions::True,
    }))
}

/// One quantity over another.
pub(super) fn curve(x: &str, y: &str, points: Vec<[f64; 2]>) -> Figure {
    let range = |axis: usize| around(points.iter().map(|point| point[axis]));
    Figure::single(Chart {
        title: None,
        x: Axis::linear(x, range(0)),
        y: Axis::linear(y, range(1)),
        legend: LegendPlace::Free,
        series: vec![Series::line(points, Line::thick(Dash::Solid), Colour::Blue)],
    })
}

/// A range that holds zero and all values, with some room.
pub(crate) fn around(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [low, high] = values.fold([0.0_f64; 2], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    let room = if high > low { 0.05 * (high - low) } else { 1.0 };
    [if low < 0.0 { low - room } else { 0.0 }, high + room]
}
