//! Deviation over bar of every answer; bars that hold are below the diagonal.

use super::judged::Row;
use crate::scene_file::Method;
use viscofriction_plot::{
    Axis, Chart, Colour, Dash, Figure, LegendPlace, Line, Marker, Series, Shape,
};

/// Smaller relative errors are drawn here.
const FLOOR: f64 = 1e-16;

const LOOKS: [(Method, Shape, Colour); 5] = [
    (Method::Analytic, Shape::Diamond, Colour::Black),
    (Method::MdrSteady, Shape::Circle, Colour::Blue),
    (Method::MdrTransient, Shape::Square, Colour::Magenta),
    (Method::BemSteady, Shape::Circle, Colour::Red),
    (Method::BemTransient, Shape::Square, Colour::Green),
];

/// One panel, one point per answer that is not zero.
pub(super) fn figure(rows: &[Row]) -> Figure {
    let points: Vec<(Method, [f64; 2])> = rows.iter().filter_map(point).collect();
    // Both axes show the same decades, so that the diagonal is one.
    let axis = |label| Axis::decades(label, points.iter().flat_map(|(_, point)| *point));
    let [x, y] = ["error bar / value", "deviation / value"].map(axis);
    let methods = LOOKS.into_iter().filter_map(|(method, shape, colour)| {
        let points = points.iter().filter(|(of, _)| *of == method);
        let points: Vec<[f64; 2]> = points.map(|(_, point)| *point).collect();
        (!points.is_empty()).then(|| Series {
            label: Some(method.name().to_owned()),
            ..Series::markers(points, Marker::open(shape), colour)
        })
    });
    let diagonal = Series {
        label: Some("deviation = bar".into()),
        ..Series::line(
            x.range.map(|end| [end; 2]).to_vec(),
            Line::thin(Dash::Solid),
            Colour::Black,
        )
    };
    Figure::single(Chart {
        title: Some(format!("{} error bars", points.len())),
        series: methods.chain([diagonal]).collect(),
        x,
        y,
        legend: LegendPlace::Below,
    })
}

/// Relative bar and deviation; an elastic body has no friction to which they could be related.
fn point(row: &Row) -> Option<(Method, [f64; 2])> {
    let value = row.reference.abs();
    let point = [row.error_bar, row.deviation].map(|error| (error / value).max(FLOOR));
    let drawn = value > row.error_bar && point.iter().all(|error| error.is_finite());
    drawn.then_some((row.solver, point))
}

#[cfg(test)]
mod tests {
    use super::*;
    use viscofriction_plot::draw;

    #[test]
    fn where_every_answer_is_refused_the_picture_has_no_points() {
        let drawing = draw(&figure(&[])).expect("a picture");
        let svg = drawing.svg;
        assert!(svg.contains("0 error bars"), "the title in {svg}");
    }
}
