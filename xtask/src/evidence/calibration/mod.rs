//! Do the error bars of every method hold on random scenes?
//!
//! Each scene is solved as `requests.toml` asks, and each answer compared with its reference.

mod reference;
mod scene;

use std::cell::LazyCell;

use anyhow::{Result, anyhow};
use serde::Serialize;
use viscofriction::Estimate;
use viscofriction::scene::{Method, Model};
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Shape};

use super::request::{Reference, Request, presses};
use super::sample::Options;
use super::{Outcomes, Report, Share};
use crate::meter::median;
use crate::picture::{chart, guide, markers};
use crate::random::Random;
use crate::table::{group_by, markdown_table};
use crate::tasks::in_parallel;
use reference::{SHARP_REFERENCE_RATIO, closed_form, is_numerical, numerical};
use scene::{Extent, FLAT, Label, Scene};

/// Judges the error bars of every method; a quick run takes fewer scenes, larger errors and fewer elements on the half space.
pub(super) fn report(options: &Options, quick: bool) -> Result<Report> {
    let extent = Extent::new(quick)?;
    let mut random = Random::new(options.seed());
    let mut scenes = Vec::new();
    for number in 1..=options.count(extent.scenes)? {
        let scene = Scene::new(number, &mut random, &extent.memory)?;
        let requests = extent.requests(&mut random, &scene);
        scenes.push((scene, requests));
    }
    let judged = in_parallel("calibration", &scenes, |(scene, requests)| {
        judge(scene, requests)
    })?;
    let judged: Outcomes<Row, Refusal> = judged.into_iter().flatten().collect();
    Ok(Report {
        name: "calibration",
        tables: judged.tables(["calibration", "calibration_refused"])?,
        pictures: vec![("calibration", figure(&judged.rows))],
        summary: table(&judged.rows, &judged.refusals).to_string(),
        failure: None,
    })
}

/// The scene and one error bar of it; a row of `calibration.csv`.
type Row = (Label, Bar);

/// One error bar and the deviation that it should cover. Values and errors are absolute, in the unit of the quantity: a
/// friction coefficient, or a depth \[m] or a force \[N] where the body is only pressed.
#[derive(Debug, Clone, Serialize)]
struct Bar {
    /// Method and kind of scene, as [`name`] has them.
    method: String,
    /// Unit of `asked`.
    asked_kind: &'static str,
    asked: f64,
    value: f64,
    error_bar: f64,
    reference: f64,
    reference_error: f64,
    reference_source: String,
    deviation: f64,
    /// Whether the deviation is within the bar and the error of the reference.
    holds: bool,
    /// Whether the deviation is within the bar alone.
    holds_alone: bool,
    #[serde(skip)]
    solver: Method,
}

/// A result or a reference that could not be computed.
type Refusal = (Label, Reason);

/// What could not be computed, and why.
#[derive(Debug, Clone, Default, Serialize)]
struct Reason {
    method: String,
    reason: String,
}

/// Solves a scene as all `requests` ask that a method offers; a row, a refusal, or nothing, of each.
fn judge(scene: &Scene, requests: &[Request]) -> Result<Vec<Result<Vec<Row>, Refusal>>> {
    let mut judged = Vec::new();
    for of_model in requests.chunk_by(|one, other| one.model == other.model) {
        // Keep the requests that the model accepts; it may refuse a scene.
        let is_offered = |request: &&Request| request.is_offered(&scene.file).unwrap_or(false);
        let offered = of_model.iter().filter(is_offered);
        let known = |request: &Request| Ok(request.solve(&scene.file)?.requested_quantity());
        let solved: Vec<_> = offered.map(|request| (request, known(request))).collect();
        let bars = solved.iter().filter_map(|(request, known)| {
            let is_closed = request.method == Method::Analytic;
            (!is_closed).then_some(known.as_ref().ok()?.relative_error())
        });
        let least = bars.fold(f64::INFINITY, f64::min);
        let shared = LazyCell::new(|| numerical(scene, of_model[0].model, least));
        for (request, known) in solved {
            let bar = known.and_then(|known| bar(scene, request, known, &shared));
            let label = || scene.label.clone();
            judged.push(match bar {
                Ok(bar) => Ok(bar.map(|bar| (label(), bar)).into_iter().collect()),
                Err(error) => {
                    let reason = Reason {
                        method: name(request, scene),
                        reason: format!("{error:#}"),
                    };
                    Err((label(), reason))
                }
            });
        }
    }
    Ok(judged)
}

/// The error bar of the result `got`; `None` where there is nothing to compare it with. `shared` is the numerical reference,
/// computed at the first use.
fn bar(
    scene: &Scene,
    request: &Request,
    got: Estimate,
    shared: &Result<Reference>,
) -> Result<Option<Bar>> {
    let own = closed_form(scene, request, got.relative_error())?;
    let reference = match (&own, shared) {
        (Some(own), _) => own,
        (None, _) if !is_numerical(scene, request) => return Ok(None),
        (None, Ok(shared)) => shared,
        (None, Err(error)) => return Err(anyhow!("no reference: {error:#}")),
    };
    let expected = reference.known;
    let (asked_kind, asked) = request.asked();
    let deviation = (got.value - expected.value).abs();
    Ok(Some(Bar {
        method: name(request, scene),
        asked_kind,
        asked,
        value: got.value,
        error_bar: got.error,
        reference: expected.value,
        reference_error: expected.error,
        reference_source: reference.source.clone(),
        deviation,
        holds: deviation <= got.error + expected.error,
        holds_alone: deviation <= got.error,
        solver: request.method,
    }))
}

/// Method, kind of scene and kind of accuracy in words; a line of the table.
fn name(request: &Request, scene: &Scene) -> String {
    let group = match request.method {
        _ if presses(&scene.file) && scene.is_at_depth() => ", pressed to a depth",
        _ if presses(&scene.file) => ", pressed",
        _ if request.model == Model::Line => "",
        _ if scene.is("self-affine") => ", rough",
        _ if scene.is("cylinder") => ", cylinder",
        _ if scene.is(FLAT) => ", flat end",
        _ if scene.is_at_depth() => ", depth",
        Method::Analytic => ", half space",
        _ => "",
    };
    let by_elements = request.is_by_elements();
    let resolution = if by_elements { ", elements" } else { "" };
    format!("{}{group}{resolution}", request.method.name())
}

/// One line per method and kind of scene, as [`line`] makes it, and one of all.
fn table(rows: &[Row], refusals: &[Refusal]) -> comfy_table::Table {
    let bars = rows.iter().map(|(_, bar)| bar);
    let methods = group_by(bars.clone(), |bar| &*bar.method);
    let header = "method|results|bars that hold|with a sharp reference|of these within the bar alone|median of bar/deviation|worst deviation/bar|refused";
    let of_methods = methods.into_iter().map(|(method, bars)| {
        let refused = refusals
            .iter()
            .filter(|(_, reason)| reason.method == method);
        line(method, &bars, refused.count())
    });
    let of_all = line("all", &bars.collect::<Vec<_>>(), refusals.len());
    markdown_table(header.split('|'), of_methods.chain([of_all]))
}

/// Cells of a line: number of results, how many bars hold, how many have a sharp reference and hold by themselves, the
/// median of bar over deviation, the worst deviation over bar, and the number of refusals.
fn line(method: &str, bars: &[&Bar], refused: usize) -> [String; 8] {
    let held: Share = bars.iter().map(|bar| bar.holds).collect();
    // Count the bars whose reference is much more accurate than the bar says of the result.
    let is_sharp = |bar: &&&Bar| bar.reference_error <= SHARP_REFERENCE_RATIO * bar.error_bar;
    let sharp = bars.iter().filter(is_sharp);
    let held_alone: Share = sharp.map(|bar| bar.holds_alone).collect();
    // A bar of zero holds for a deviation of zero only.
    let part_of_bar = |bar: &&Bar| match bar.deviation {
        deviation if deviation > 0.0 => deviation / bar.error_bar,
        _ => 0.0,
    };
    let worst = bars.iter().map(part_of_bar).reduce(f64::max);
    // Leave out references of zero, because the friction of an elastic material is known to be zero.
    let unknown = bars.iter().filter(|bar| bar.reference.abs() > 0.0);
    let parts: Vec<f64> = unknown.map(part_of_bar).collect();
    let middle = (!parts.is_empty()).then(|| 1.0 / median(parts));
    [
        method.to_owned(),
        held.all.to_string(),
        held.percentage(),
        held_alone.all.to_string(),
        held_alone.percentage(),
        middle.map(short).unwrap_or_default(),
        worst.map(short).unwrap_or_default(),
        refused.to_string(),
    ]
}

/// A number with two decimals, or, below 0.01 and from 1e4 on, with one digit and a power of ten.
fn short(value: f64) -> String {
    match value {
        _ if !value.is_finite() => "∞".to_owned(),
        _ if value == 0.0 || (1e-2..1e4).contains(&value) => format!("{value:.2}"),
        _ => format!("{value:.0e}"),
    }
}

/// Relative error at which smaller ones are drawn, because zero has no place on a logarithmic axis: the rounding of f64.
const MIN_DRAWN_ERROR: f64 = 1e-16;

/// How the points of a method are drawn.
const STYLES: [(Method, Shape, Colour); 5] = [
    (Method::Analytic, Shape::Diamond, Colour::Black),
    (Method::MdrSteady, Shape::Circle, Colour::Blue),
    (Method::MdrTransient, Shape::Square, Colour::Magenta),
    (Method::BemSteady, Shape::Circle, Colour::Red),
    (Method::BemTransient, Shape::Square, Colour::Green),
];

/// Deviation over bar, one point per result that is not zero; bars that hold are below the diagonal.
fn figure(rows: &[Row]) -> Figure {
    let points: Vec<(Method, [f64; 2])> = rows.iter().filter_map(point).collect();
    // Both axes show the same decades, so that the diagonal is one.
    let axis = |label| Axis::decades(label, points.iter().flat_map(|(_, point)| *point));
    let [x, y] = ["error bar / value", "deviation / value"].map(axis);
    let methods = STYLES.into_iter().filter_map(|(method, shape, colour)| {
        let of_method = points.iter().filter(|(of, _)| *of == method);
        let positions = of_method.map(|(_, position)| *position).collect();
        markers(positions, shape, colour, method.name())
    });
    let diagonal = guide(x.range.map(|end| [end; 2]), Dash::Solid);
    let series = methods
        .chain([diagonal.labelled("deviation = bar")])
        .collect();
    Figure::single(Chart {
        title: Some(format!("{} error bars", points.len())),
        ..chart(x, y, series)
    })
}

/// Method, and error bar and deviation relative to the reference; `None` where the reference is zero within the bar, as the
/// friction of elastic materials is.
fn point((_, bar): &Row) -> Option<(Method, [f64; 2])> {
    let value = bar.reference.abs();
    let point = [bar.error_bar, bar.deviation].map(|error| (error / value).max(MIN_DRAWN_ERROR));
    let drawn = value > bar.error_bar && point.iter().all(|error| error.is_finite());
    drawn.then_some((bar.solver, point))
}

#[cfg(test)]
mod tests {
    use viscofriction_plot::draw;

    use super::*;

    #[test]
    fn where_every_request_is_refused_cells_are_empty_and_the_picture_has_no_points() {
        let printed = table(&[], &[Refusal::default()]).to_string();
        let cells = printed.lines().last().map(|line| line.split('|'));
        let cells: Vec<&str> = cells.into_iter().flatten().map(str::trim).collect();
        let expected = ["", "all", "0", "", "0", "", "", "", "1", ""];
        assert_eq!(cells, expected, "the line of all in\n{printed}");
        let svg = draw(&figure(&[])).expect("a picture").svg;
        assert!(svg.contains("0 error bars"), "the title in {svg}");
    }
}
