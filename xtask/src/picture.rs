//! What the pictures of all experiments have in common.

use viscofriction_plot::{Axis, Chart, Colour, Dash, LegendPlace, Line, Marker, Series, Shape};

/// A chart of `series` whose legend stands below the axes.
pub(crate) fn chart(x: Axis, y: Axis, series: Vec<Series>) -> Chart {
    let legend = LegendPlace::Below;
    Chart {
        legend,
        ..Chart::new(x, y, series)
    }
}

/// A series of open markers without a line; `None` where there are no points, because an empty series is refused.
pub(crate) fn markers(
    points: Vec<[f64; 2]>,
    shape: Shape,
    colour: Colour,
    label: &str,
) -> Option<Series> {
    let is_drawn = !points.is_empty();
    is_drawn.then(|| Series::markers(points, Marker::open(shape), colour).labelled(label))
}

/// A thin black polyline, such as the slope of an order of convergence.
pub(crate) fn guide<const N: usize>(points: [[f64; 2]; N], dash: Dash) -> Series {
    Series::line(points.into(), Line::thin(dash), Colour::Black)
}
