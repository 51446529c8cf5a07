//! Drawing of lines, markers, error bars and bands.

use crate::canvas::{Canvas, NO_PEN, Pen, Pixel};
use crate::colour::Colour;
use crate::frame::Frame;
use crate::series::{Dash, Fill, Line, Marker, Series, Shape};

/// Radius of a circular marker, \[px\]; other shapes have about the same area.
pub(crate) const MARKER_RADIUS: f64 = 3.6;
/// Radius of a dot, \[px\].
const DOT_RADIUS: f64 = 1.7;
/// Half width of the cap of an error bar, \[px\].
const CAP_HALF_WIDTH: f64 = 3.5;

/// Draws the bands of all series, then for each series its line, its error bars and its markers.
pub(crate) fn draw_series(canvas: &mut Canvas, frame: &Frame, series: &[Series]) {
    for one in series {
        let band = ends(frame, one, &one.band);
        let [upper, lower] = [0, 1].map(|end: usize| band.iter().map(move |ends| ends[end]));
        let outline = upper
            .chain(lower.rev())
            .map(|[x, y]| format!("{x:.2} {y:.2}"))
            .collect::<Vec<_>>();
        if band.len() > 1 {
            canvas.translucent_shape(&format!("M{}Z", outline.join("L")), one.colour.hex());
        }
    }
    for one in series {
        let pixels = frame.pixels(&one.points);
        if let Some(line) = one.line {
            canvas.polyline(&pixels, &line_pen(line, one.colour));
        }
        let pen = Pen::solid(one.colour.hex(), 1.1);
        for [upper, lower] in ends(frame, one, &one.errors) {
            canvas.line(upper, lower, &pen);
            for [x, y] in [upper, lower] {
                canvas.line([x - CAP_HALF_WIDTH, y], [x + CAP_HALF_WIDTH, y], &pen);
            }
        }
        if let Some(marker) = one.marker {
            for &at in pixels.iter().step_by(marker.every) {
                draw_marker(canvas, at, marker, one.colour.hex());
            }
        }
    }
}

/// Upper and lower ends of the error bars of a series with the given half lengths.
pub(crate) fn ends(frame: &Frame, series: &Series, lengths: &[f64]) -> Vec<[Pixel; 2]> {
    let ends = |sign: f64| {
        let bars = series.points.iter().zip(lengths);
        let ends = bars.map(|([x, y], length)| [*x, y + sign * length]);
        frame.pixels(&ends.collect::<Vec<_>>())
    };
    let bars = ends(1.0).into_iter().zip(ends(-1.0));
    bars.map(|(upper, lower)| [upper, lower]).collect()
}

/// Pen of the line of a series.
pub(crate) fn line_pen(line: Line, colour: Colour) -> Pen {
    // The pattern of thin lines does not shrink further, to remain distinguishable.
    let unit = line.width.max(1.2);
    let pattern: &[f64] = match line.dash {
        Dash::Solid => &[],
        Dash::Dashed => &[4.0, 2.0],
        Dash::DashDot => &[5.0, 1.8, 1.2, 1.8],
        Dash::Dotted => &[1.2, 1.8],
    };
    let lengths = pattern.iter().map(|part| format!("{:.2}", part * unit));
    let lengths: Vec<String> = lengths.collect();
    Pen {
        colour: colour.hex(),
        width: line.width,
        dash: (!lengths.is_empty()).then(|| lengths.join(" ")),
    }
}

/// Draws a marker about a pixel, in a colour as #rrggbb.
pub(crate) fn draw_marker(
    canvas: &mut Canvas,
    [x, y]: Pixel,
    marker: Marker,
    colour: &'static str,
) {
    let radius = MARKER_RADIUS;
    let pen = Pen::solid(colour, 1.2);
    let fill = match marker.fill {
        Fill::Open => "#ffffff",
        Fill::Filled => colour,
    };
    match marker.shape {
        Shape::Dot => canvas.circle([x, y], DOT_RADIUS, colour, &NO_PEN),
        Shape::Circle => canvas.circle([x, y], radius, fill, &pen),
        Shape::Square => {
            let [low, high] = [-0.9 * radius, 0.9 * radius];
            let corners = [[low, low], [high, low], [high, high], [low, high]];
            canvas.shape(&polygon([x, y], corners), fill, &pen);
        }
        Shape::Diamond => {
            let half = 1.25 * radius;
            let corners = [[0.0, -half], [half, 0.0], [0.0, half], [-half, 0.0]];
            canvas.shape(&polygon([x, y], corners), fill, &pen);
        }
        Shape::Plus => {
            let (half, pen) = (1.2 * radius, Pen::solid(colour, 1.5));
            canvas.line([x - half, y], [x + half, y], &pen);
            canvas.line([x, y + half], [x, y - half], &pen);
        }
    }
}

/// Closed path through four corners, given by their distances \[px\] to the right of a pixel and below it.
fn polygon([x, y]: Pixel, corners: [[f64; 2]; 4]) -> String {
    let points = corners.map(|[right, down]| format!("{:.2} {:.2}", x + right, y + down));
    format!("M{}Z", points.join("L"))
}
