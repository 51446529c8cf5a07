//! What stands in the SVG of a figure.

use viscofriction_plot::{
    Axis, Chart, Colour, Dash, Figure, LegendPlace, Line, Marker, Series, Shape, draw,
};

use crate::{chart, map};

fn svg(chart: Chart) -> String {
    let drawing = draw(&Figure::single(chart));
    drawing.expect("the figure is sound").svg
}

/// The number of the first attribute of this name after the n-th mark.
fn number(svg: &str, name: &str) -> f64 {
    let tail = svg.split(&format!(" {name}=\"")).nth(1);
    let digits = tail.and_then(|tail| tail.split('"').next());
    digits.and_then(|digits| digits.parse().ok()).expect(name)
}

#[test]
fn several_panels_line_up_with_all_their_texts_and_are_the_same_every_time() {
    let page = Figure::new([chart(), map(), chart()], 2);
    let got = draw(&page);
    assert_eq!(got, draw(&page), "two pictures of one figure");
    let text = got.expect("the figure is sound").svg;
    for part in [
        r#"width="960""#,
        ">velocity <tspan font-style=\"italic\">v</tspan> [m/s]</text>",
        ">coefficient of friction <tspan font-style=\"italic\">μ</tspan> [1]</text>",
        ">Cone, <tspan font-style=\"italic\">c</tspan>₁ = 0.1</text>",
        ">theory, <tspan font-style=\"italic\">s</tspan> &lt; 1 &amp; more</text>",
        ">simulation</text>",
        ">10⁻³</text>",
        ">0.15</text>",
        "><tspan font-style=\"italic\">x</tspan> [mm]</text>",
        ">pressure <tspan font-style=\"italic\">p</tspan> [MPa]</text>",
    ] {
        assert!(text.contains(part), "expected '{part}' in {text}");
    }
    let single = number(&svg(chart()), "width");
    assert!((single - 480.0).abs() < 0.011, "one column has {single} px");
}

#[test]
fn markers_stand_on_their_points() {
    // The frame is 280 px high and begins 10 px below the upper edge.
    for (y, expected) in [(0.2, 10.0), (0.1, 150.0), (0.0, 290.0)] {
        let mut one = chart();
        one.title = None;
        let circle = Marker::filled(Shape::Circle);
        one.series = vec![Series::markers(vec![[1e-1, y]], circle, Colour::Black)];
        let got = number(&svg(one), "cy");
        let is_there = (got - expected).abs() < 0.011;
        assert!(is_there, "expected μ = {y} at {expected} px, got {got}");
    }
}

#[test]
fn a_legend_that_covers_no_data_stays_inside_and_moves_out_otherwise() {
    let height = |chart: Chart| number(&svg(chart), "height");
    let inside = height(chart());
    let legend = LegendPlace::Below;
    let below = height(Chart { legend, ..chart() });
    let is_lower = below > inside + 17.0;
    assert!(
        is_lower,
        "expected a row more than {inside} px, got {below}"
    );
    let zigzag = (0..40).map(|k| {
        let x = 10_f64.powf(-3.0 + 0.1 * f64::from(k));
        [x, 0.1 + 0.1 * f64::from(k % 3 - 1)]
    });
    let zigzag = Series::line(zigzag.collect(), Line::thin(Dash::Solid), Colour::Black);
    let mut full = chart();
    full.series.push(zigzag);
    let got = height(full);
    let is_below = (got - below).abs() < 0.011;
    assert!(is_below, "expected the legend below, {below} px, got {got}");
}

#[test]
fn cells_without_a_value_stay_white_and_neighbours_of_one_colour_merge() {
    let text = svg(map());
    for start in ["0 0h2", "2 0h1", "1 1h1", "2 1h1"] {
        let path = format!(r#"d="M{start}v1h-"#);
        assert!(text.contains(&path), "expected a cell {path} in {text}");
    }
    let drawn = text.matches("v1h-").count();
    assert_eq!(drawn, 104, "runs of cells, and 100 steps of the colour bar");
}

#[test]
fn labels_of_the_x_axis_stand_clear_of_each_other() {
    let time = Axis::linear("time t [h]", [1e10, 1e10 + 3e4]);
    let rise = vec![[1e10, 0.0], [1e10 + 1e4, 0.1]];
    let rise = Series::line(rise, Line::thin(Dash::Solid), Colour::Black);
    let text = svg(Chart::new(time, chart().y, vec![rise]));
    let mut labels = vec![
        "10000000", "10000005", "10000010", "10000015", "10000020", "10000025", "10000030",
    ];
    labels.retain(|label| text.contains(&format!(">{label}<")));
    // A step of five units is 65 px, less than a label of eight digits, some 66 px, and the gap of 6 px would leave.
    assert_eq!(
        labels,
        ["10000000", "10000010", "10000020", "10000030"],
        "labels in {text}"
    );
}
