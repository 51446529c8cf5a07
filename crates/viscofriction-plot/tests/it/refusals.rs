//! What would mislead is refused, with an error that says why.

use viscofriction_plot::{
    Axis, Cell, Chart, Colour, Dash, Figure, Line, Map, Marker, Panel, Series, Shape, draw,
};

use crate::{chart, map, matrix, points};

fn assert_refused(cases: impl IntoIterator<Item = (impl Into<Panel>, &'static str)>) {
    for (panel, why) in cases {
        let figure = Figure::single(panel);
        let got = draw(&figure).map_err(|error| error.to_string());
        assert!(
            got.as_ref().is_err_and(|got| got.contains(why)),
            "expected '{why}' for {figure:?}, got {got:?}"
        );
    }
}

fn over(x: Axis) -> Chart {
    Chart { x, ..chart() }
}

/// The first series of a chart, changed.
fn changed(mut chart: Chart, change: impl FnOnce(&mut Series)) -> Chart {
    change(&mut chart.series[0]);
    chart
}

#[test]
fn ranges_that_cannot_be_drawn() {
    let linear = [
        [1.0, 1.0],
        [2.0, 1.0],
        [f64::NAN, 1.0],
        [0.0, f64::INFINITY],
        [-f64::MAX, f64::MAX],
    ];
    let logarithmic = [[0.0, 1.0], [-1.0, 1.0], [1.0, 1.5]];
    assert_refused(linear.map(|range| (over(Axis::linear("x", range)), "increase, it is")));
    assert_refused(logarithmic.map(|range| (over(Axis::log10("x", range)), "a factor of 2")));
}

#[test]
fn points_that_would_vanish() {
    let cases = [
        [f64::NAN, 0.1],
        [0.1, f64::INFINITY],
        [0.0, 0.1],
        [-1.0, 0.1],
        [0.99e-3, 0.1],
        [0.1, 0.21],
    ];
    assert_refused(cases.map(|point| (points(&[[0.1, 0.1], point]), "value 1 of 'a series")));
    // Ends that rounding has moved are drawn.
    let ends = draw(&Figure::single(points(&[[10_f64.powf(-3.0), 0.2 + 1e-15]])));
    assert!(ends.is_ok(), "expected a picture, got {ends:?}");
}

#[test]
fn error_bars_that_do_not_match_or_reach_out() {
    let cases: [(&[f64], _); 6] = [
        (&[], "needs 1 values"),
        (&[0.1, 0.1], "needs 1 values"),
        (&[-0.1], "must not be negative"),
        (&[f64::NAN], "must lie in"),
        (&[0.11], "it is -0.0"),
        (&[9.5], "must lie in"),
    ];
    assert_refused(cases.map(|(errors, why)| {
        let with_bars = |series: &mut Series| series.errors = Some(errors.to_vec());
        (changed(points(&[[0.1, 0.1]]), with_bars), why)
    }));
}

#[test]
fn series_without_a_trace() {
    let line = |points: &[[f64; 2]], change: fn(&mut Series)| {
        let line = Line::thick(Dash::Solid);
        let mut series = Series::line(points.to_vec(), line, Colour::Blue);
        change(&mut series);
        Chart {
            series: vec![series],
            ..chart()
        }
    };
    let bare = |series: &mut Series| series.line = None;
    let without_points = |series: &mut Series| {
        series.marker = Some(Marker {
            every: 0,
            ..Marker::filled(Shape::Plus)
        });
    };
    let thin = |series: &mut Series| {
        series.line = Some(Line {
            dash: Dash::Solid,
            width: 0.0,
        });
    };
    let two = [[0.1, 0.1], [0.2, 0.1]];
    let mut empty = chart();
    empty.series.clear();
    assert_refused([
        (line(&[], |_| ()), "list of points"),
        (line(&two[..1], |_| ()), "line and markers"),
        (line(&two, bare), "line and markers"),
        (line(&two, without_points), "marker spacing"),
        (line(&two, thin), "line width"),
        (empty, "list of series"),
    ]);
}

#[test]
fn texts_without_glyphs_or_room() {
    let titled = |title: &str| Chart {
        title: Some(title.into()),
        ..chart()
    };
    let long = "friction of rigid indenters on viscous half spaces after Kürschner, 2014";
    let labelled = changed(chart(), |series| series.label = Some(long.into()));
    assert_refused([
        (titled("摩擦"), "no glyph for a character of '摩擦'"),
        (titled(""), "no glyph"),
        (titled(long), "pixels, "),
        (over(Axis::log10("", [1e-3, 1e1])), "label of an axis"),
        (labelled, "pixels, "),
    ]);
}

#[test]
fn maps_that_would_mislead() {
    let cells = |columns: usize, value: f64| Map {
        columns,
        values: vec![Some(value); 8],
        ..map()
    };
    let logarithmic = Map {
        x: Axis::log10("x [mm]", [1.0, 10.0]),
        ..map()
    };
    assert_refused([
        (cells(3, 1.0), "needs 9 values"),
        (cells(0, 1.0), "the grid of"),
        (cells(4, 2.1), "value 0 of 'pressure p [MPa]'"),
        (cells(4, f64::NAN), "value 0 of 'pressure p [MPa]'"),
        (logarithmic, "must be linear"),
    ]);
}

#[test]
fn empty_matrices_and_values_off_their_scale() {
    assert_refused([
        (matrix(&[Cell::Value(0.1)]), "must lie in -6 to 0"),
        (matrix(&[Cell::Value(f64::NAN)]), "must lie in -6 to 0"),
        (matrix(&[]), "the rows of"),
    ]);
}

#[test]
fn figures_without_panels_or_columns() {
    for (panels, columns) in [(vec![], 1), (vec![chart().into()], 0)] {
        let got = draw(&Figure { panels, columns });
        assert!(got.is_err(), "expected a refusal, got {got:?}");
    }
}
