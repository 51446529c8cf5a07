//! What would mislead is refused, with an error that says why.

use viscofriction_plot::{Axis, Chart, Field, Figure, Marker, Shape, draw};

use crate::{chart, map};

/// The chart cannot be drawn after a change.
#[track_caller]
fn refused_of(mut chart: Chart, why: &str, change: impl FnOnce(&mut Chart)) {
    change(&mut chart);
    let figure = Figure::single(chart);
    let got = draw(&figure).map_err(|error| error.to_string());
    assert!(
        got.as_ref().is_err_and(|got| got.contains(why)),
        "expected '{why}' for {figure:?}, got {got:?}"
    );
}

#[track_caller]
fn refused(why: &str, change: impl FnOnce(&mut Chart)) {
    refused_of(chart(), why, change);
}

#[test]
fn ranges_that_cannot_be_drawn() {
    for range in [
        [1.0, 1.0],
        [2.0, 1.0],
        [f64::NAN, 1.0],
        [0.0, f64::INFINITY],
        [-f64::MAX, f64::MAX],
    ] {
        refused("increase, it is", |chart| chart.y.range = range);
    }
    for range in [[0.0, 1.0], [-1.0, 1.0], [1.0, 1.5]] {
        refused("a factor of 2", |chart| chart.x.range = range);
    }
}

#[test]
fn points_that_would_vanish() {
    for point in [
        [f64::NAN, 0.1],
        [0.1, f64::INFINITY],
        [0.0, 0.1],
        [-1.0, 0.1],
        [0.99e-3, 0.1],
        [0.1, 0.21],
    ] {
        refused("value 1 of 'theory", |chart| {
            chart.series[0].points[1] = point;
        });
    }
    // A reference may leave the frame, but needs a position.
    refused("have a position along", |chart| {
        chart.series[0].is_reference = true;
        chart.series[0].points[1][1] = f64::NAN;
    });
    // Ends that rounding has moved are drawn.
    let mut moved = chart();
    moved.series[0].points[0] = [10_f64.powf(-3.0), 0.2 + 1e-15];
    let got = draw(&Figure::single(moved));
    assert!(got.is_ok(), "expected a picture, got {got:?}");
}

#[test]
fn error_bars_that_do_not_match_or_reach_out() {
    for (errors, why) in [
        (vec![0.1], "needs 2 values"),
        (vec![0.01; 3], "needs 2 values"),
        (vec![0.01, -0.1], "must not be negative"),
        (vec![0.01, f64::NAN], "must lie in"),
        (vec![0.01, 0.091], "it is -0.0"),
        (vec![0.01, 9.5], "must lie in"),
    ] {
        refused(why, |chart| chart.series[1].errors = errors);
    }
}

#[test]
fn series_without_a_trace() {
    refused("list of series", |chart| chart.series.clear());
    refused("list of points", |chart| chart.series[0].points.clear());
    refused("line and markers", |chart| {
        chart.series[0].points.truncate(1);
    });
    refused("line and markers", |chart| chart.series[0].line = None);
    refused("marker spacing", |chart| {
        chart.series[0].marker = Some(Marker {
            every: 0,
            ..Marker::filled(Shape::Plus)
        });
    });
}

#[test]
fn texts_without_glyphs_or_room() {
    let long = "friction of rigid indenters on viscous half spaces after Kürschner, 2014";
    for (title, why) in [
        ("摩擦", "character of '摩擦'"),
        ("", "no glyph"),
        (long, "pixels, "),
    ] {
        refused(why, |chart| chart.title = Some(title.into()));
    }
    refused("label of an axis", |chart| chart.x.label.clear());
    refused("pixels, ", |chart| {
        chart.series[0].label = Some(long.into());
    });
}

#[test]
fn fields_that_would_mislead() {
    let colours = || Axis::linear("pressure", [0.0, 2.0]);
    let field = |shape, value| Field::new(shape, colours(), move |_, _| Some(value));
    for (shape, value, why) in [
        ([4, 2], 2.1, "value 0 of 'pressure'"),
        ([4, 2], f64::NAN, "value 0 of 'pressure'"),
        ([0, 2], 1.0, "the grid of"),
        ([4, 0], 1.0, "the grid of"),
    ] {
        refused_of(map(), why, |map| map.field = Some(field(shape, value)));
    }
    refused("must be linear", |chart| {
        chart.field = Some(field([1, 1], 1.0));
    });
}

#[test]
fn figures_without_panels_or_columns() {
    for (panels, columns) in [(vec![], 1), (vec![chart()], 0)] {
        let error = draw(&Figure::new(panels, columns)).expect_err("a refusal");
        let needed = "the list of charts or of columns";
        assert!(error.to_string().contains(needed), "{error}");
    }
}
