//! The curves and the map as pictures.

use anyhow::{Context, Result};
use rheology::StandardSolid;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Figure, Line, Marker, Series, Shape};

use super::{Decades, EXPONENTS, Extent, Friction, MODELS, Point, Prediction, border, plateau};
use crate::output::points;
use crate::picture::{chart as chart_of, guide};
use crate::scene::solid;

/// Colours of the stiffness ratios.
const COLOURS: [Colour; 3] = [Colour::Blue, Colour::Green, Colour::Red];
const RATIOS: [f64; 2] = [0.4, 1.1];
/// Steps of the outline of the window tan δ > 1.
const WINDOW_STEPS: i32 = 60;

fn name(exponent: f64) -> &'static str {
    if exponent < 1.5 { "cone" } else { "paraboloid" }
}

fn range(Decades(first, last, _): Decades) -> [f64; 2] {
    [first, last].map(|power| 10_f64.powi(power))
}

fn same(one: f64, other: f64) -> bool {
    one.total_cmp(&other).is_eq()
}

fn chart(exponent: f64, extent: &Extent, y: Axis, series: Vec<Series>) -> Chart {
    let x = Axis::log10("speed vτ/a", range(extent.curve_speeds));
    Chart {
        title: Some(name(exponent).to_owned()),
        ..chart_of(x, y, series)
    }
}

/// Speeds and values of one profile and stiffness ratio.
struct Curve<'a> {
    points: Vec<&'a Point>,
    colour: Colour,
    label: String,
}

impl Curve<'_> {
    fn values(&self, value: fn(&Friction) -> f64) -> Vec<[f64; 2]> {
        let speed = |(at, _): &&Point| at.speed;
        points(&self.points, speed, |(_, friction)| value(friction))
    }

    /// Circles with error bars.
    fn circles(&self, value: fn(&Friction) -> f64, error: fn(&Friction) -> f64) -> Series {
        let errors = self.points.iter().map(|(_, friction)| error(friction));
        Series {
            errors: errors.collect(),
            ..Series::markers(self.values(value), Marker::open(Shape::Circle), self.colour)
        }
    }
}

/// The curves of one profile.
fn curves<'a>(points: &'a [Point], exponent: f64, extent: &Extent) -> Vec<Curve<'a>> {
    let ratios = extent.curve_ratios.iter().zip(COLOURS);
    let curve = |(&ratio, colour): (&f64, Colour)| Curve {
        points: points
            .iter()
            .filter(|(at, _)| same(at.exponent, exponent) && same(at.stiffness_ratio, ratio))
            .collect(),
        colour,
        label: format!("γ = {ratio:e}"),
    };
    ratios.map(curve).collect()
}

/// Friction over speed, one panel per profile.
pub(super) fn friction(points: &[Point], extent: &Extent) -> Figure {
    let panel = |exponent: f64| {
        let of_profile = points.iter().filter(|(at, _)| same(at.exponent, exponent));
        let lowest = of_profile.map(|(_, friction)| {
            (friction.half_space - friction.half_space_error).min(friction.line)
        });
        let lowest = 10_f64.powf(lowest.fold(1.0, f64::min).log10().floor());
        let y = Axis::log10("friction μ / mean slope", [lowest, 10.0]);
        let mut series = Vec::new();
        for curve in curves(points, exponent, extent) {
            let values = curve.values(|at| at.line);
            let line = Series::line(values, Line::thick(Dash::Solid), curve.colour);
            let circles = curve.circles(|at| at.half_space, |at| at.half_space_error);
            series.extend([
                line.labelled(format!("{}, line", curve.label)),
                circles.labelled(format!("{}, half space", curve.label)),
            ]);
        }
        chart(exponent, extent, y, series)
    };
    Figure::new(EXPONENTS.map(panel), 2)
}

/// The ratio of half space and line over speed, one panel per profile.
pub(super) fn ratio(points: &[Point], extent: &Extent) -> Result<Figure> {
    let panel = |exponent: f64| {
        let y = Axis::linear("friction of half space / line", RATIOS);
        let ends = range(extent.curve_speeds);
        let level = |value: f64| guide(ends.map(|speed| [speed, value]), Dash::Dashed);
        let viscous = level(plateau(exponent)?).labelled("1/2, viscous s, 1");
        let mut series = vec![level(0.5), viscous, level(1.0)];
        for curve in curves(points, exponent, extent) {
            let circles = Series {
                line: Some(Line::thin(Dash::Solid)),
                ..curve.circles(|at| at.ratio, |at| at.ratio_error)
            };
            series.push(circles.labelled(curve.label));
        }
        Ok(chart(exponent, extent, y, series))
    };
    let panels: Result<Vec<_>> = EXPONENTS.into_iter().map(panel).collect();
    Ok(Figure::new(panels?, 2))
}

/// Friction over its prediction, the border of ten per cent, and the window in which tan δ > 1 at ω = v/a.
pub(super) fn validity(
    map: &[Prediction],
    borders: &[border::Row],
    extent: &Extent,
) -> Result<Figure> {
    let window = window(extent)?;
    let shape = [extent.map_speeds, extent.map_ratios].map(|decades| decades.values().count());
    let mut panels = Vec::new();
    for exponent in EXPONENTS {
        let of_profile = map.iter().filter(|(at, _)| same(at.exponent, exponent));
        for model in MODELS {
            let quotients = of_profile.clone().map(|(_, law)| {
                let [friction, predicted] = law.pair(model);
                friction / predicted
            });
            let quotients: Vec<f64> = quotients.collect();
            let highest = quotients.iter().copied().fold(1.0, f64::max);
            let colours = Axis::linear("friction / prediction", [0.0, highest]);
            let value = |speed: usize, ratio: usize| Some(quotients[ratio * shape[0] + speed]);
            let field = Field::new(shape, colours, value);
            let borders = borders.iter();
            let borders = borders.filter(|at| same(at.exponent, exponent) && at.model == model);
            let x = map_axis("log₁₀ (vτ/a)", extent.map_speeds);
            let y = map_axis("log₁₀ γ", extent.map_ratios);
            let model = model.name().replace('-', " ");
            panels.push(Chart {
                title: Some(format!("{}, {model}", name(exponent))),
                series: [window.clone()]
                    .into_iter()
                    .chain(outline(borders))
                    .collect(),
                ..Chart::map(x, y, field)
            });
        }
    }
    Ok(Figure::new(panels, 2))
}

/// Every value in the middle of its cell.
fn map_axis(label: &str, decades: Decades) -> Axis {
    let Decades(first, last, per_decade) = decades;
    let half = 0.5 / f64::from(per_decade);
    let [first, last] = [first, last].map(f64::from);
    Axis::linear(label, [first - half, last + half])
}

/// Up along the lowest speeds and down along the highest.
fn outline<'a>(borders: impl Iterator<Item = &'a border::Row>) -> Option<Series> {
    let ends = borders.filter_map(|row| {
        let (lowest, highest) = row.lowest_speed.zip(row.highest_speed)?;
        Some((row.stiffness_ratio, [lowest, highest]))
    });
    let points = around(ends);
    let line = Line::thick(Dash::Solid);
    (points.len() > 1).then(|| Series::line(points, line, Colour::Black))
}

/// The outline of tan δ > 1.
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

/// Stiffness ratios with a lowest and a highest speed each: points up along the lowest and down along the highest, in
/// logarithms.
fn around(ends: impl IntoIterator<Item = (f64, [f64; 2])>) -> Vec<[f64; 2]> {
    let side =
        |end: usize| move |(ratio, ends): &(f64, [f64; 2])| [ends[end], *ratio].map(f64::log10);
    let ends: Vec<_> = ends.into_iter().collect();
    let up = ends.iter().map(side(0));
    up.chain(ends.iter().rev().map(side(1))).collect()
}
