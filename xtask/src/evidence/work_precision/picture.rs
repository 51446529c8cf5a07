//! Error over run time, one panel per scene.

use viscofriction::scene::{Method, Model};

use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

use super::measured::Row;
use crate::picture::{chart as chart_of, guide};

/// Relative error above which the error of a reference is drawn. Chosen; smaller ones are below all curves of interest.
const MIN_DRAWN_FLOOR: f64 = 1e-9;

/// The scenes of one picture; all panels have the same axes.
pub(super) fn figure(rows: &[&Row]) -> Figure {
    let points: Vec<[f64; 2]> = rows.iter().map(|row| point(row)).collect();
    let floors = rows.iter().filter_map(|row| visible_floor(row));
    let errors = points.iter().map(|point| point[1]).chain(floors);
    let axes = [
        Axis::decades("processor time [s]", points.iter().map(|point| point[0])),
        Axis::decades("relative error", errors),
    ];
    let scenes = rows.chunk_by(|one, other| one.scene == other.scene);
    Figure::new(scenes.map(|rows| chart(rows, &axes)), 2)
}

/// Point of a row in the picture: processor time \[s] and relative error.
fn point(row: &Row) -> [f64; 2] {
    [row.processor_seconds, row.visible_error()]
}

/// The panel of one scene: a curve for each method, and the error of the reference of each model.
fn chart(rows: &[&Row], [x, y]: &[Axis; 2]) -> Chart {
    let title = |row: &&Row| format!("{}: {}", row.scene, row.quantity);
    let runs = rows.chunk_by(|one, other| label(one) == label(other));
    let mut series: Vec<Series> = runs.filter_map(curve).collect();
    let models = rows.chunk_by(|one, other| one.model == other.model);
    series.extend(models.filter_map(|rows| floor(rows, x)));
    Chart {
        title: rows.first().map(title),
        ..chart_of(x.clone(), y.clone(), series)
    }
}

/// Method in the legend; closed forms of scenes that slide with their model.
fn label(row: &Row) -> String {
    match row.solver {
        Some(Method::Analytic) if row.slides() => format!("{}, {}", row.method, row.model),
        _ => row.method.clone(),
    }
}

/// The runs of one method, joined by a line; `None` for no runs.
fn curve(rows: &[&Row]) -> Option<Series> {
    let (colour, marker) = style(rows.first()?);
    let points = rows.iter().map(|row| point(row)).collect();
    let series = Series {
        line: (rows.len() > 1).then_some(Line::thick(Dash::Solid)),
        ..Series::markers(points, marker, colour)
    };
    Some(series.labelled(label(rows.first()?)))
}

/// Colour and marker by method. Markers of stationary states to an error, of the closed form of the line and of contacts at one
/// instant are filled; those of time marches, of given elements and of the closed form of the half space are open.
fn style(row: &Row) -> (Colour, Marker) {
    let is_line = row.model == Model::Line.name();
    let by_elements = row.resolution_kind == "elements";
    match row.solver {
        Some(Method::Analytic) if is_line => (Colour::Black, Marker::filled(Shape::Diamond)),
        Some(Method::Analytic) => (Colour::Black, Marker::open(Shape::Diamond)),
        Some(Method::MdrSteady) => (Colour::Blue, Marker::filled(Shape::Circle)),
        Some(Method::MdrTransient) => (Colour::Blue, Marker::open(Shape::Square)),
        Some(Method::BemSteady) if by_elements => (Colour::Red, Marker::open(Shape::Square)),
        Some(Method::BemSteady) => (Colour::Red, Marker::filled(Shape::Circle)),
        Some(Method::BemTransient) => (Colour::Green, Marker::open(Shape::Square)),
        None => (Colour::Magenta, Marker::filled(Shape::Circle)),
    }
}

/// The relative error of the reference, if it is large enough to be drawn: errors below it are not resolved.
fn visible_floor(row: &Row) -> Option<f64> {
    (row.reference_error > MIN_DRAWN_FLOOR).then_some(row.reference_error)
}

/// A horizontal line at the error of the reference of one model.
fn floor(rows: &[&Row], x: &Axis) -> Option<Series> {
    let first = rows.first()?;
    let error = visible_floor(first)?;
    let line = guide(x.range.map(|time| [time, error]), Dash::Dotted);
    Some(line.labelled(format!("reference, {}", first.model)))
}
