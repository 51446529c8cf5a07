//! What stands in the SVG of a figure.

use resvg::tiny_skia::Pixmap;
use viscofriction_plot::{
    Axis, Chart, Colour, Dash, Field, Figure, LegendPlace, Line, Marker, Series, Shape, draw,
    render_png,
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
fn a_field_is_one_image_of_a_pixel_per_cell() {
    let text = svg(map());
    let images = text.matches("<image ").count();
    assert_eq!(images, 2, "the field and its colour bar in {text}");
    assert!(text.contains(r#"href="data:image/png;base64,"#), "{text}");
    // A rough contact of a million elements stays a small file.
    let pressure = Axis::linear("pressure p [MPa]", [0.0, 2.0]);
    let mut fine = map();
    fine.field = Some(Field::new([2048, 1024], pressure, |column, row| {
        (column / 8 % 2 == row / 8 % 2).then_some(1.0)
    }));
    let size = svg(fine).len();
    assert!(size < 100_000, "expected a small file, got {size} bytes");
}

#[test]
fn cells_without_a_value_stay_white_in_the_png() {
    let drawing = draw(&Figure::single(map())).expect("the figure is sound");
    let text = &drawing.svg;
    let [left, top, width, height] = ["x", "y", "width", "height"].map(|name| {
        let image = text.split("<image ").nth(1).expect("an image");
        number(&format!(" {image}"), name)
    });
    let png = render_png(&drawing, 1000).expect("a picture");
    let pixels = Pixmap::decode_png(&png).expect("a PNG file");
    let scale = 1000.0 / number(text, "width");
    let is_white = |column: u32, row: u32| {
        let x = left + width * (f64::from(column) + 0.6) / 4.0;
        let y = top + height * (1.0 - (f64::from(row) + 0.6) / 2.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a pixel"
        )]
        let [x, y] = [x, y].map(|place| (scale * place) as u32);
        let pixel = pixels.pixel(x, y).expect("a pixel inside");
        [pixel.red(), pixel.green(), pixel.blue()] == [255; 3]
    };
    for (column, row, expected) in [(0, 0, false), (3, 0, true), (0, 1, true), (2, 1, false)] {
        assert_eq!(is_white(column, row), expected, "cell {column}, {row}");
    }
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

#[test]
fn symbols_are_italic_and_their_subscripts_lowered() {
    let mut loop_of_forces = chart();
    loop_of_forces.y.label = "tangential force F_t [N]".into();
    let text = svg(loop_of_forces);
    let expected = concat!(
        r#">tangential force <tspan font-style="italic">F</tspan>"#,
        r#"<tspan dy="2.8" font-size="9.8">t</tspan><tspan dy="-2.8"> [mN]</tspan></text>"#
    );
    assert!(text.contains(expected), "expected '{expected}' in {text}");
    let label = r#"aria-label="tangential force F_t [mN]""#;
    assert!(text.contains(label), "expected '{label}' in {text}");
}

#[test]
fn a_reference_line_is_cut_at_the_frame_and_arrowheads_follow_the_points() {
    // The axis ends at 0.2, half way up the line.
    let steep = vec![[1e-3, 0.0], [1e1, 0.4]];
    let mut cut = chart();
    cut.title = None;
    cut.series = vec![Series::reference(steep, Dash::Dashed, Colour::Grey)];
    let text = svg(cut);
    let points = text.split("points=\"").nth(1).expect("a line");
    let end = points
        .split('"')
        .next()
        .and_then(|all| all.split(' ').next_back());
    let end = end.expect("an end").split(',').map(str::parse::<f64>);
    let end: Vec<f64> = end.map(|place| place.expect("a number")).collect();
    assert!(
        (end[1] - 10.0).abs() < 0.011,
        "the upper end of the frame, got {end:?}"
    );
    let mut directed = chart();
    directed.series.truncate(1);
    directed.series[0].arrows = 3;
    let text = svg(directed);
    let heads = text.matches("stroke=\"none\"").count();
    assert_eq!(heads, 3, "arrowheads in {text}");
}
