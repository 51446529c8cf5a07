//! Do the error bars of every method hold on random scenes?

mod judge;
mod reference;
mod requests;
mod scene;

use std::collections::BTreeMap;

use anyhow::Result;
use viscofriction::scene::Method;
use viscofriction_plot::{
    Axis, Chart, Colour, Dash, Figure, LegendPlace, Line, Marker, Series, Shape,
};

use super::sample::Options;
use super::{Report, Table};
use crate::meter::median;
use crate::output::markdown_table;
use crate::random::Random;
use crate::tasks::in_parallel;
use judge::{Bar, Refusal, Row, judge};
use requests::{FULL, QUICK, requests};
use scene::Scene;

const SCENES: usize = 300;
const QUICK_SCENES: usize = 40;

/// Judges the bars of every method; a quick run takes fewer scenes, larger errors and fewer elements on the half space.
pub(super) fn report(options: &Options, quick: bool) -> Result<Report> {
    let (usual, extent) = if quick {
        (QUICK_SCENES, QUICK)
    } else {
        (SCENES, FULL)
    };
    let mut random = Random::new(options.seed());
    let mut scenes = Vec::new();
    for number in 1..=options.count(usual)? {
        let scene = Scene::new(number, &mut random, extent.memory)?;
        let requests = requests(&mut random, &scene, &extent);
        scenes.push((scene, requests));
    }
    let judged = in_parallel("calibration", &scenes, |(scene, requests)| {
        judge(scene, requests)
    })?;
    let (mut rows, mut refusals) = (Vec::new(), Vec::new());
    for (label, bar) in judged.into_iter().flatten() {
        match bar {
            Ok(bar) => rows.push((label, bar)),
            Err(reason) => refusals.push((label, reason)),
        }
    }
    Ok(Report {
        name: "calibration",
        tables: vec![
            Table::new("calibration", &rows)?,
            Table::new("calibration_refused", &refusals)?,
        ],
        pictures: vec![("calibration", figure(&rows))],
        summary: table(&rows, &refusals).to_string(),
        failure: None,
    })
}

/// One line per method: how many bars hold, and how wide they are.
fn table(rows: &[Row], refusals: &[Refusal]) -> comfy_table::Table {
    let mut methods: BTreeMap<&str, Vec<&Bar>> = BTreeMap::new();
    for (_, bar) in rows {
        methods.entry(&bar.method).or_default().push(bar);
    }
    let header = "method|results|bars that hold|with a sharp reference|of these within the bar alone|median of bar/deviation|worst deviation/bar|refused";
    let lines = methods.into_iter().map(|(method, bars)| {
        let refused = refusals.iter();
        let refused = refused.filter(|(_, reason)| reason.method == method);
        line(method, &bars, refused.count())
    });
    let all: Vec<&Bar> = rows.iter().map(|(_, bar)| bar).collect();
    markdown_table(
        header.split('|'),
        lines.chain([line("all", &all, refusals.len())]),
    )
}

fn line(method: &str, bars: &[&Bar], refused: usize) -> [String; 8] {
    let held = bars.iter().filter(|bar| bar.holds).count();
    let sharp: Vec<_> = bars.iter().filter(|bar| bar.is_sharply_judged()).collect();
    let held_alone = sharp.iter().filter(|bar| bar.holds_alone).count();
    let worst = bars.iter().map(|bar| bar.part_of_bar()).reduce(f64::max);
    // The friction of an elastic material is known to be zero.
    let unknown = bars.iter().filter(|bar| bar.reference.abs() > 0.0);
    let parts: Vec<f64> = unknown.map(|bar| bar.part_of_bar()).collect();
    let middle = (!parts.is_empty()).then(|| 1.0 / median(parts));
    [
        method.to_owned(),
        bars.len().to_string(),
        percentage(held, bars.len()),
        sharp.len().to_string(),
        percentage(held_alone, sharp.len()),
        middle.map_or_else(String::new, short),
        worst.map_or_else(String::new, short),
        refused.to_string(),
    ]
}

fn percentage(held: usize, all: usize) -> String {
    if all == 0 {
        return String::new();
    }
    format!("{:.1} %", 100.0 * held as f64 / all as f64)
}

/// Two digits, or a power of ten.
fn short(value: f64) -> String {
    match value {
        _ if !value.is_finite() => "∞".to_owned(),
        _ if value == 0.0 || (1e-2..1e4).contains(&value) => format!("{value:.2}"),
        _ => format!("{value:.0e}"),
    }
}

/// Smaller relative errors are drawn here.
const FLOOR: f64 = 1e-16;

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
        let points = points.iter().filter(|(of, _)| *of == method);
        let points: Vec<[f64; 2]> = points.map(|(_, point)| *point).collect();
        let series = Series::markers(points, Marker::open(shape), colour);
        (!series.points.is_empty()).then(|| series.labelled(method.name()))
    });
    let ends = x.range.map(|end| [end; 2]).to_vec();
    let diagonal = Series::line(ends, Line::thin(Dash::Solid), Colour::Black);
    let diagonal = diagonal.labelled("deviation = bar");
    let series = methods.chain([diagonal]).collect();
    Figure::single(Chart {
        title: Some(format!("{} error bars", points.len())),
        legend: LegendPlace::Below,
        ..Chart::new(x, y, series)
    })
}

/// Relative bar and deviation; an elastic body has no friction to which they could be related.
fn point((_, bar): &Row) -> Option<(Method, [f64; 2])> {
    let value = bar.reference.abs();
    let point = [bar.error_bar, bar.deviation].map(|error| (error / value).max(FLOOR));
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
