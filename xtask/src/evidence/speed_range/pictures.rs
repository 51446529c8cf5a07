//! The curves and the map as pictures.

use anyhow::{Context, Result};
use rheology::StandardSolid;
use viscofriction::scene::Model;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Figure, Line, Marker, Series, Shape};

use super::sliding::Sliding;
use super::{Decades, Extent, Friction, MODELS, Point, Prediction, border, plateau};
use crate::output::points;
use crate::picture::{chart as chart_of, guide};
use crate::scene::solid;

/// Colours of the stiffness ratios of the curves, in their order.
const COLOURS: [Colour; 3] = [Colour::Blue, Colour::Green, Colour::Red];
/// Range of the axis of the ratio of half space to line, which is between 1/2 and 1.
const RATIOS: [f64; 2] = [0.4, 1.1];
/// Number of points along each side of the outline of the region with tan δ > 1. Chosen, so that it looks smooth.
const WINDOW_STEPS: i32 = 60;

/// Name of the body whose profile has this exponent of [`super::EXPONENTS`].
fn name(exponent: f64) -> &'static str {
    if exponent < 1.5 { "cone" } else { "paraboloid" }
}

/// Smallest and largest value of a logarithmic scale.
fn range(Decades(first, last, _): Decades) -> [f64; 2] {
    [first, last].map(|power| 10_f64.powi(power))
}

/// Whether two parameters are the same number; they are copies of each other.
fn same(one: f64, other: f64) -> bool {
    one.total_cmp(&other).is_eq()
}

/// A figure with the charts that `panel` makes of each profile from its exponent and its rows, which follow each other.
fn panels<R>(
    rows: &[(Sliding, R)],
    panel: impl Fn(f64, &[(Sliding, R)]) -> Result<Vec<Chart>>,
) -> Result<Figure> {
    let profiles = rows.chunk_by(|(one, _), (other, _)| same(one.exponent, other.exponent));
    let panels = profiles.map(|rows| panel(rows[0].0.exponent, rows));
    Ok(Figure::new(panels.collect::<Result<Vec<_>>>()?.concat(), 2))
}

/// The curves of one profile, one for each stiffness ratio, and their colours and names.
fn curves(rows: &[Point]) -> impl Iterator<Item = (&[Point], Colour, String)> {
    let is_same =
        |(one, _): &Point, (other, _): &Point| same(one.stiffness_ratio, other.stiffness_ratio);
    let named = rows.chunk_by(is_same).zip(COLOURS);
    named.map(|(rows, colour)| (rows, colour, format!("γ = {:e}", rows[0].0.stiffness_ratio)))
}

/// Points of a curve: speed and a value of the friction.
fn values(rows: &[Point], value: fn(&Friction) -> f64) -> Vec<[f64; 2]> {
    points(rows, |(at, _)| at.speed, |(_, friction)| value(friction))
}

/// Circles with error bars at one number of each computed point.
fn circles(
    rows: &[Point],
    colour: Colour,
    value: fn(&Friction) -> f64,
    error: fn(&Friction) -> f64,
) -> Series {
    let errors = rows.iter().map(|(_, friction)| error(friction));
    Series {
        errors: errors.collect(),
        ..Series::markers(values(rows, value), Marker::open(Shape::Circle), colour)
    }
}

/// A chart over the speed, under the name of a profile.
fn chart(exponent: f64, extent: &Extent, y: Axis, series: Vec<Series>) -> Chart {
    let x = Axis::log10("speed vτ/a", range(extent.curve_speeds));
    Chart {
        title: Some(name(exponent).to_owned()),
        ..chart_of(x, y, series)
    }
}

/// Friction over speed, one panel per profile.
pub(super) fn friction(rows: &[Point], extent: &Extent) -> Result<Figure> {
    panels(rows, |exponent, rows| {
        let lowest = rows
            .iter()
            .map(|(_, at)| (at.half_space - at.half_space_error).min(at.line));
        let lowest = 10_f64.powf(lowest.fold(1.0, f64::min).log10().floor());
        let y = Axis::log10("friction μ / mean slope", [lowest, 10.0]);
        let mut series = Vec::new();
        for (rows, colour, name) in curves(rows) {
            let line = values(rows, |at| at.line);
            let line = Series::line(line, Line::thick(Dash::Solid), colour);
            let circles = circles(rows, colour, |at| at.half_space, |at| at.half_space_error);
            series.push(line.labelled(format!("{name}, line")));
            series.push(circles.labelled(format!("{name}, half space")));
        }
        Ok(vec![chart(exponent, extent, y, series)])
    })
}

/// The ratio of half space and line over speed, one panel per profile.
pub(super) fn ratio(rows: &[Point], extent: &Extent) -> Result<Figure> {
    panels(rows, |exponent, rows| {
        let y = Axis::linear("friction of half space / line", RATIOS);
        let ends = range(extent.curve_speeds);
        let level = |value: f64| guide(ends.map(|speed| [speed, value]), Dash::Dashed);
        let viscous = level(plateau(exponent)?).labelled("1/2, viscous s, 1");
        let mut series = vec![level(0.5), viscous, level(1.0)];
        series.extend(curves(rows).map(|(rows, colour, name)| {
            let circles = circles(rows, colour, |at| at.ratio, |at| at.ratio_error);
            let line = Some(Line::thin(Dash::Solid));
            Series { line, ..circles }.labelled(name)
        }));
        Ok(vec![chart(exponent, extent, y, series)])
    })
}

/// Friction over its prediction, the border of ten per cent, and the window in which tan δ > 1 at ω = v/a.
pub(super) fn validity(
    map: &[Prediction],
    borders: &[border::Row],
    extent: &Extent,
) -> Result<Figure> {
    let window = window(extent)?;
    let shape = [extent.map_speeds, extent.map_ratios].map(|decades| decades.values().count());
    panels(map, |exponent, map| {
        let panel = |model: Model| {
            let quotients = map.iter().map(|(_, law)| {
                let [friction, predicted] = law.pair(model);
                friction / predicted
            });
            let quotients: Vec<f64> = quotients.collect();
            let highest = quotients.iter().copied().fold(1.0, f64::max);
            let colours = Axis::linear("friction / prediction", [0.0, highest]);
            let value = |speed: usize, ratio: usize| Some(quotients[ratio * shape[0] + speed]);
            let field = Field::new(shape, colours, value);
            let of_panel = borders
                .iter()
                .filter(|at| same(at.exponent, exponent) && at.model == model);
            let x = map_axis("log₁₀ (vτ/a)", extent.map_speeds);
            let y = map_axis("log₁₀ γ", extent.map_ratios);
            let model_in_words = model.name().replace('-', " ");
            let series = std::iter::once(window.clone()).chain(outline(of_panel));
            Chart {
                title: Some(format!("{}, {model_in_words}", name(exponent))),
                series: series.collect(),
                ..Chart::map(x, y, field)
            }
        };
        Ok(MODELS.map(panel).to_vec())
    })
}

/// A linear axis over decimal logarithms, which ends half a step beyond the values, so that each is in the middle of its cell.
fn map_axis(label: &str, decades: Decades) -> Axis {
    let half = 0.5 * decades.step();
    let [first, last] = [decades.0, decades.1].map(f64::from);
    Axis::linear(label, [first - half, last + half])
}

/// Outline of the region where the law is right; `None` where there is no such region.
fn outline<'a>(borders: impl Iterator<Item = &'a border::Row>) -> Option<Series> {
    let ends = borders.filter_map(|row| {
        let (lowest, highest) = row.lowest_speed.zip(row.highest_speed)?;
        Some((row.stiffness_ratio, [lowest, highest]))
    });
    let points = around(ends);
    let line = Line::thick(Dash::Solid);
    (points.len() > 1).then(|| Series::line(points, line, Colour::Black))
}

/// Outline of the region tan δ > 1 at ω = v/a.
fn window(extent: &Extent) -> Result<Series> {
    let lowest = range(extent.map_ratios)[0];
    let steps = StandardSolid::LARGEST_VISCOUS_RATIO / lowest;
    let ends = (0..WINDOW_STEPS).map(|step| {
        let ratio = lowest * steps.powf(f64::from(step) / f64::from(WINDOW_STEPS));
        let window = solid(ratio)?.viscous_window();
        Ok((ratio, window.context("tan δ > 1 below the largest ratio")?))
    });
    let points = around(ends.collect::<Result<Vec<_>>>()?);
    Ok(Series::line(points, Line::thick(Dash::Dashed), Colour::Red))
}

/// Outline of a region, given by stiffness ratios with a lowest and a highest speed each: points (speed, ratio) in decimal
/// logarithms, up along the lowest speeds and down along the highest.
fn around(ends: impl IntoIterator<Item = (f64, [f64; 2])>) -> Vec<[f64; 2]> {
    let side =
        |end: usize| move |(ratio, ends): &(f64, [f64; 2])| [ends[end], *ratio].map(f64::log10);
    let ends: Vec<_> = ends.into_iter().collect();
    let up = ends.iter().map(side(0));
    up.chain(ends.iter().rev().map(side(1))).collect()
}
