//! The curves and the map as pictures.

use anyhow::{Context, Result};
use rheology::StandardSolid;

use crate::evidence::speed_range::border::Model;
use crate::evidence::speed_range::sliding::{Sliding, plateau};
use crate::evidence::speed_range::{Decades, EXPONENTS, Extent, border, curves, validity};
use viscofriction_plot::{
    Axis, Chart, Colour, ColourScale, Dash, Figure, LegendPlace, Line, Map, Marker, Panel, Series,
    Shape,
};

/// Looks of the stiffness ratios.
const COLOURS: [Colour; 3] = [Colour::Blue, Colour::Green, Colour::Red];
const RATIOS: [f64; 2] = [0.4, 1.1];
/// Steps of the outline of the window tan δ > 1.
const WINDOW_STEPS: i32 = 60;

/// All tables of the command.
type Tables<'a> = (&'a [curves::Row], &'a [validity::Row], &'a [border::Row]);

/// All pictures with their names.
pub(super) fn all(
    (curves, map, borders): Tables,
    extent: &Extent,
) -> Result<Vec<(&'static str, Figure)>> {
    let mut friction = Vec::new();
    let mut ratio = Vec::new();
    let mut maps = Vec::new();
    for exponent in EXPONENTS {
        friction.push(Panel::from(friction_chart(curves, exponent, extent)));
        ratio.push(Panel::from(ratio_chart(curves, exponent, extent)?));
        for model in [Model::Line, Model::HalfSpace] {
            maps.push(Panel::from(validity_map(
                (map, borders),
                (exponent, model),
                extent,
            )?));
        }
    }
    let figure = |panels| Figure { panels, columns: 2 };
    Ok(vec![
        ("friction_over_speed", figure(friction)),
        ("ratio_over_speed", figure(ratio)),
        ("validity", figure(maps)),
    ])
}

fn name(exponent: f64) -> &'static str {
    if exponent < 1.5 { "cone" } else { "paraboloid" }
}

fn range(decades: Decades) -> [f64; 2] {
    [decades.first, decades.last].map(|power| 10_f64.powi(power))
}

/// The rows of one profile and stiffness ratio.
fn rows_of(rows: &[curves::Row], exponent: f64, ratio: f64) -> Vec<&curves::Row> {
    let same = |row: &&curves::Row| {
        row.exponent.total_cmp(&exponent).is_eq() && row.stiffness_ratio.total_cmp(&ratio).is_eq()
    };
    rows.iter().filter(same).collect()
}

fn friction_chart(rows: &[curves::Row], exponent: f64, extent: &Extent) -> Chart {
    let mut series = Vec::new();
    for (&ratio, colour) in extent.curve_ratios.iter().zip(COLOURS) {
        let rows = rows_of(rows, exponent, ratio);
        let points = |value: fn(&curves::Row) -> f64| {
            rows.iter()
                .map(|row| [row.speed, value(row)])
                .collect::<Vec<_>>()
        };
        let line = Line::thick(Dash::Solid);
        series.push(Series {
            label: Some(format!("γ = {ratio:e}, line")),
            ..Series::line(points(|row| row.line), line, colour)
        });
        series.push(Series {
            label: Some(format!("γ = {ratio:e}, half space")),
            errors: Some(rows.iter().map(|row| row.half_space_error).collect()),
            ..Series::markers(
                points(|row| row.half_space),
                Marker::open(Shape::Circle),
                colour,
            )
        });
    }
    let lowest = rows
        .iter()
        .map(|row| row.half_space.min(row.line))
        .fold(1.0, f64::min);
    Chart {
        title: Some(name(exponent).to_owned()),
        x: Axis::log10("speed vτ/a", range(extent.curve_speeds)),
        y: Axis::log10(
            "friction μ / mean slope",
            [10_f64.powf(lowest.log10().floor()), 10.0],
        ),
        series,
        legend: LegendPlace::Below,
    }
}

fn ratio_chart(rows: &[curves::Row], exponent: f64, extent: &Extent) -> Result<Chart> {
    let [first, last] = range(extent.curve_speeds);
    let mut series = Vec::new();
    for (value, label) in [(0.5, "1/2"), (plateau(exponent)?, "viscous"), (1.0, "1")] {
        let points = vec![[first, value], [last, value]];
        series.push(Series {
            label: (label == "viscous").then(|| "1/2, viscous s, 1".to_owned()),
            ..Series::line(points, Line::thin(Dash::Dashed), Colour::Black)
        });
    }
    for (&ratio, colour) in extent.curve_ratios.iter().zip(COLOURS) {
        let rows = rows_of(rows, exponent, ratio);
        let points = rows.iter().map(|row| [row.speed, row.ratio]).collect();
        series.push(Series {
            label: Some(format!("γ = {ratio:e}")),
            errors: Some(rows.iter().map(|row| row.ratio_error).collect()),
            line: Some(Line::thin(Dash::Solid)),
            ..Series::markers(points, Marker::open(Shape::Circle), colour)
        });
    }
    Ok(Chart {
        title: Some(name(exponent).to_owned()),
        x: Axis::log10("speed vτ/a", [first, last]),
        y: Axis::linear("friction of half space / line", RATIOS),
        series,
        legend: LegendPlace::Below,
    })
}

/// Friction over its prediction, the border of ten per cent, and the window in which tan δ > 1 at ω = v/a.
fn validity_map(
    (rows, borders): (&[validity::Row], &[border::Row]),
    (exponent, model): (f64, Model),
    extent: &Extent,
) -> Result<Map> {
    let quotient = |row: &validity::Row| match model {
        Model::Line => row.line / row.predicted_line,
        Model::HalfSpace => row.half_space / row.predicted_half_space,
    };
    let same = |row: &&validity::Row| row.exponent.total_cmp(&exponent).is_eq();
    let values: Vec<f64> = rows.iter().filter(same).map(quotient).collect();
    let highest = values.iter().copied().fold(1.0, f64::max);
    let same = |row: &&border::Row| row.exponent.total_cmp(&exponent).is_eq() && row.model == model;
    let borders: Vec<&border::Row> = borders.iter().filter(same).collect();
    let mut overlays = vec![window(extent)?];
    overlays.extend(outline(&borders));
    let model = match model {
        Model::Line => "line",
        Model::HalfSpace => "half space",
    };
    Ok(Map {
        title: Some(format!("{}, {model}", name(exponent))),
        x: map_axis("log₁₀ (vτ/a)", extent.map_speeds),
        y: map_axis("log₁₀ γ", extent.map_ratios),
        columns: extent.map_speeds.values().count(),
        values: values.into_iter().map(Some).collect(),
        colours: ColourScale {
            label: "friction / prediction".into(),
            range: [0.0, highest],
        },
        overlays,
    })
}

/// Every value in the middle of its cell.
fn map_axis(label: &str, decades: Decades) -> Axis {
    let half = 0.5 / f64::from(decades.per_decade);
    Axis::linear(
        label,
        [
            f64::from(decades.first) - half,
            f64::from(decades.last) + half,
        ],
    )
}

/// Up along the lowest speeds and down along the highest.
fn outline(borders: &[&border::Row]) -> Option<Series> {
    let side = |speed: fn(&border::Row) -> Option<f64>| {
        let points = borders
            .iter()
            .filter_map(move |row| Some([speed(row)?.log10(), row.stiffness_ratio.log10()]));
        points.collect::<Vec<_>>()
    };
    let mut points = side(|row| row.lowest_speed);
    points.extend(side(|row| row.highest_speed).into_iter().rev());
    let line = Line::thick(Dash::Solid);
    (points.len() > 1).then(|| Series::line(points, line, Colour::Black))
}

/// The outline of tan δ > 1.
fn window(extent: &Extent) -> Result<Series> {
    let lowest = 10_f64.powi(extent.map_ratios.first);
    let steps = StandardSolid::LARGEST_VISCOUS_RATIO / lowest;
    let mut sides = [Vec::new(), Vec::new()];
    for step in 0..WINDOW_STEPS {
        let ratio = lowest * steps.powf(f64::from(step) / f64::from(WINDOW_STEPS));
        let ends = Sliding::viscous_window(ratio)?.context("tan δ > 1 below the largest ratio")?;
        for (side, end) in sides.iter_mut().zip(ends) {
            side.push([end.log10(), ratio.log10()]);
        }
    }
    let [mut points, right] = sides;
    points.extend(right.into_iter().rev());
    Ok(Series::line(points, Line::thick(Dash::Dashed), Colour::Red))
}
