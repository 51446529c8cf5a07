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
            for piece in visible_pieces(frame, one) {
                canvas.polyline(&piece, &line_pen(line, one.colour));
            }
            for [at, direction] in arrowheads(&pixels, one.arrows) {
                canvas.shape(&arrowhead(at, direction), one.colour.hex(), &NO_PEN);
            }
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

/// Connected pieces of the line of a series that are inside the frame.
pub(crate) fn visible_pieces(frame: &Frame, series: &Series) -> Vec<Vec<Pixel>> {
    let pixels = frame.pixels(&series.points);
    if !series.is_reference {
        return vec![pixels];
    }
    let mut pieces: Vec<Vec<Pixel>> = Vec::new();
    let inside = pixels
        .windows(2)
        .filter_map(|pair| frame.area.clip([pair[0], pair[1]]));
    for [start, end] in inside {
        match pieces.last_mut() {
            Some(piece) if piece.last() == Some(&start) => piece.push(end),
            _ => pieces.push(vec![start, end]),
        }
    }
    pieces
}

/// Positions of arrowheads at equal distances along a line, and the directions there.
fn arrowheads(line: &[Pixel], count: usize) -> Vec<[Pixel; 2]> {
    let steps: Vec<Pixel> = line
        .windows(2)
        .map(|pair| [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]])
        .collect();
    let length: f64 = steps.iter().map(|[x, y]| x.hypot(*y)).sum();
    let (mut found, mut passed) = (Vec::new(), 0.0);
    for (start, step) in line.iter().zip(&steps) {
        let own = step[0].hypot(step[1]);
        while found.len() < count {
            // The first head is half a distance from the start.
            let rest = length * (found.len() as f64 + 0.5) / count as f64 - passed;
            if rest > own || own == 0.0 {
                break;
            }
            let [right, down] = [step[0] / own, step[1] / own];
            let at = [start[0] + rest * right, start[1] + rest * down];
            found.push([at, [right, down]]);
        }
        passed += own;
    }
    found
}

/// Half length of an arrowhead, \[px\].
const ARROW_HALF_LENGTH: f64 = 5.0;

/// Path of an arrowhead around a point, along a direction of length 1.
fn arrowhead([x, y]: Pixel, [right, down]: [f64; 2]) -> String {
    let corners = [[1.0, 0.0], [-1.0, 0.8], [-1.0, -0.8]].map(|[along, across]| {
        let [along, across] = [ARROW_HALF_LENGTH * along, ARROW_HALF_LENGTH * across];
        let corner = [
            x + along * right - across * down,
            y + along * down + across * right,
        ];
        format!("{:.2} {:.2}", corner[0], corner[1])
    });
    format!("M{}Z", corners.join("L"))
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
