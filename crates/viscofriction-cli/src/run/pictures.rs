//! Pictures of one answer.

use anyhow::{Context, Result};
use viscofriction::bem_halfspace::{GapField, Grid};
use viscofriction::solve::TemperatureField;
use viscofriction::{Answer, PressureField};
use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Figure, Line, Marker, Series, Shape};

/// Fraction of the load that is on the elements with the darkest colour of a logarithmic scale. Chosen. Without it single
/// elements at the edge of the contact, many decades below the others, would determine the scale.
const DARKEST_LOAD_FRACTION: f64 = 0.01;

/// What a map of the pressure shows of its field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shown {
    /// A finite body: the contact, the lowest point as a cross, and an arrow along the motion beside the contact.
    Body,
    /// One period of a surface.
    Period,
    /// One quarter of the period of a map with its mirror images: the map itself.
    Quarter,
}

/// Smallest ratio of height to width of a map beside whose colour bar a long label fits. Chosen.
const TALL: f64 = 0.85;
/// Largest ratios of height to width of a map above which a long title fits, and a short one. Chosen.
const WIDE: [f64; 2] = [1.4, 4.0];

/// Largest ratio of the sides of a map that is drawn with true proportions. Chosen. A narrower one has no room for labels, and
/// gets a scale of its own on each axis.
const MAX_SIDE_RATIO: f64 = 6.0;

/// Map of the pressure, on a logarithmic scale if the peak is unbounded.
pub(super) fn pressure(answer: &Answer, field: &PressureField, shown: Shown) -> Result<Figure> {
    let slides = answer.friction_coefficient.is_some();
    let map = Map::of(&field.grid, field.origin, (shown, slides));
    let loaded = field.pressure.iter().filter(|pressure| **pressure > 0.0);
    let mut loaded: Vec<f64> = loaded.copied().collect();
    loaded.sort_by(f64::total_cmp);
    let highest = *loaded.last().context("nothing is loaded")?;
    let lowest = match answer.peak_pressure {
        Some(_) => 0.0,
        None => darkest(&loaded, highest),
    };
    let label = if loaded[0] < lowest && (map.ratio > TALL || !map.is_true) {
        "pressure P, darkest: 1 % of load [Pa]"
    } else {
        "pressure P [Pa]"
    };
    let colours = match answer.peak_pressure {
        Some(_) => Axis::linear(label, [lowest, highest]),
        None => Axis::log10(label, [lowest, highest]),
    };
    let drawn = |element: usize| {
        let pressure = field.pressure[element];
        (pressure > 0.0).then(|| pressure.max(lowest))
    };
    Ok(map.figure(colours, drawn))
}

/// Map of the gap around the contact, or below a period; negative gaps are 0 within the tolerance of the contact solver.
pub(super) fn gap(field: &GapField, (shown, slides): (Shown, bool)) -> Figure {
    let map = Map::of(&field.grid, field.origin, (shown, slides));
    let widest = field.gap.iter().copied().fold(0.0, f64::max);
    // In full contact there is one colour, and its scale needs a length.
    let widest = if widest > 0.0 { widest } else { 1.0 };
    let colours = Axis::linear("gap [m]", [0.0, widest]);
    map.figure(colours, |element| Some(field.gap[element].max(0.0)))
}

/// Map of the temperature rise of the surface, also outside the contact.
pub(super) fn temperature(field: &TemperatureField, shown: Shown) -> Figure {
    let map = Map::of(&field.grid, field.origin, (shown, true));
    let highest = field.rise.iter().copied().fold(0.0, f64::max);
    // Without heat there is one colour, and its scale needs a length.
    let highest = if highest > 0.0 { highest } else { 1.0 };
    let colours = Axis::linear("temperature rise [K]", [0.0, highest]);
    // Ahead of a fast contact the rise is zero within its error, which may be negative.
    map.figure(colours, |element| Some(field.rise[element].max(0.0)))
}

/// A map of a field on the elements of a grid.
struct Map {
    window: Window,
    /// Shape of the grid.
    shape: [usize; 2],
    /// Ends along x and y, \[m].
    ranges: [[f64; 2]; 2],
    /// Ratio of height to width.
    ratio: f64,
    /// True if both axes have the same scale.
    is_true: bool,
    shown: Shown,
    slides: bool,
}

impl Map {
    /// The map of a field whose first element has its centre at `origin` \[m].
    fn of(grid: &Grid, origin: [f64; 2], (shown, slides): (Shown, bool)) -> Self {
        let shape @ [columns, rows] = grid.shape();
        let window = match shown {
            Shown::Body => Window::around_body(grid, origin, slides),
            Shown::Period => Window::of_elements([0..columns, 0..rows]),
            Shown::Quarter => Window::of_elements([0..columns / 2, 0..rows / 2]),
        };
        let ranges = [0, 1].map(|axis| window.range(axis, origin[axis], grid.spacing()[axis]));
        let [x, y] = ranges;
        let ratio = (y[1] - y[0]) / (x[1] - x[0]);
        Self {
            window,
            shape,
            ranges,
            ratio,
            is_true: ratio.max(ratio.recip()) <= MAX_SIDE_RATIO,
            shown,
            slides,
        }
    }

    /// Draws the value of each element; one without a value is blank.
    fn figure(&self, colours: Axis, value: impl Fn(usize) -> Option<f64>) -> Figure {
        let values = Field::new(self.window.shape(), colours, |column, row| {
            let [x, y] = self.window.element(self.shape, [column, row])?;
            value(x * self.shape[1] + y)
        });
        let values = if self.is_true {
            values
        } else {
            values.stretched()
        };
        let title = match (self.shown, self.slides) {
            _ if !self.is_true => Some("x and y to different scales"),
            (Shown::Body, _) | (Shown::Period, false) => None,
            (Shown::Quarter, true) if self.ratio < WIDE[0] => {
                Some("motion →; one of four mirror images")
            }
            (Shown::Period | Shown::Quarter, true) => Some("motion →"),
            (Shown::Quarter, false) => Some("one of four"),
        };
        let [x, y] = self.ranges;
        let mut series = Vec::new();
        if self.shown == Shown::Body {
            let cross = Marker::filled(Shape::Plus);
            // A contact that has moved far away from the lowest point is drawn without it.
            if [x, y].iter().all(|[from, to]| *from < 0.0 && 0.0 < *to) {
                series.push(Series::markers(vec![[0.0, 0.0]], cross, Colour::Red));
            }
            if self.slides {
                series.push(arrow(x, y, self.is_true));
            }
        }
        let [x, y] = [Axis::linear("x [m]", x), Axis::linear("y [m]", y)];
        Figure::single(Chart {
            title: title
                .filter(|_| self.ratio < WIDE[1] || !self.is_true)
                .map(str::to_owned),
            series,
            ..Chart::map(x, y, values)
        })
    }
}

/// Upper end of the darkest colour of a logarithmic scale; `loaded` are the positive pressures in increasing order.
fn darkest(loaded: &[f64], highest: f64) -> f64 {
    let of_darkest = DARKEST_LOAD_FRACTION * loaded.iter().sum::<f64>();
    let mut load = 0.0;
    let mut above = loaded.iter().skip_while(|pressure| {
        load += **pressure;
        load < of_darkest
    });
    let lowest = above.next();
    lowest.map_or(highest, |lowest| lowest.min(0.4 * highest))
}

/// Elements of a map, and blank ones around them, as half-open ranges along x and y that may begin below 0.
struct Window([std::ops::Range<isize>; 2]);

impl Window {
    /// Some of the elements of a field.
    fn of_elements(elements: [std::ops::Range<usize>; 2]) -> Self {
        Self(elements.map(|range| range.start.cast_signed()..range.end.cast_signed()))
    }

    /// All elements, the lowest point of the body, and below them room for an arrow if the body slides.
    fn around_body(grid: &Grid, origin: [f64; 2], slides: bool) -> Self {
        let spacing = grid.spacing();
        let [x, mut y] = [0, 1].map(|axis| {
            let count = grid.shape()[axis].cast_signed();
            #[expect(clippy::cast_possible_truncation, reason = "a number of elements")]
            let lowest = (-origin[axis] / spacing[axis]).round() as isize;
            // One element beyond the cross keeps it clear of the frame.
            let margin = 1 + count / 20;
            let limit = 2 * count;
            if (-limit..=limit).contains(&lowest) {
                0.min(lowest - margin)..count.max(lowest + 1 + margin)
            } else {
                0..count
            }
        });
        if slides {
            let below = (y.end - y.start) / 8 + 1;
            y.start -= below;
        }
        Self([x, y])
    }

    fn shape(&self) -> [usize; 2] {
        [&self.0[0], &self.0[1]].map(|range| range.clone().count())
    }

    /// Ends of the window along an axis, on which the first element has its centre at `origin` and edges have the length `spacing`,
    /// \[m].
    fn range(&self, axis: usize, origin: f64, spacing: f64) -> [f64; 2] {
        let place = |element: isize| origin + (element as f64 - 0.5) * spacing;
        [place(self.0[axis].start), place(self.0[axis].end)]
    }

    /// Element of a grid at a column and a row of the window; `None` for a blank one.
    fn element(&self, shape: [usize; 2], [column, row]: [usize; 2]) -> Option<[usize; 2]> {
        let at = |range: &std::ops::Range<isize>, index: usize, count: usize| {
            let element = usize::try_from(range.start + index.cast_signed()).ok()?;
            (element < count).then_some(element)
        };
        let [columns, rows] = shape;
        Some([at(&self.0[0], column, columns)?, at(&self.0[1], row, rows)?])
    }
}

/// Arrow along +x, the motion, in the lower left corner of a chart with the ranges `x` and `y`; `is_true` if both axes have the
/// same scale.
pub(crate) fn arrow(x: [f64; 2], y: [f64; 2], is_true: bool) -> Series {
    let spans = [x, y].map(|[from, to]| 0.03 * (to - from));
    let shorter = spans[0].min(spans[1]);
    let [along, across] = if is_true { [shorter; 2] } else { spans };
    let (end, y) = (x[0] + 9.0 * along, y[0] + 2.0 * across);
    let head = [
        [end, y],
        [end - along, y + 0.6 * across],
        [end, y],
        [end - along, y - 0.6 * across],
    ];
    let points = std::iter::once([x[0] + along, y]).chain(head).collect();
    Series::line(points, Line::thick(Dash::Solid), Colour::Black)
}

/// Number of arrowheads on a curve over another quantity than time. Chosen.
const ARROWS: usize = 4;

/// A quantity over another as a line, with arrowheads that show in which direction it is passed.
pub(super) fn directed_curve(
    x: &str,
    y: &str,
    points: Vec<[f64; 2]>,
    given: Vec<[f64; 2]>,
) -> Figure {
    let line = Series::line(points, Line::thick(Dash::Solid), Colour::Blue);
    let line = Series {
        arrows: ARROWS,
        ..line
    };
    over(x, y, vec![line, of_points(given)])
}

/// A quantity over another as a line, with some of its points as markers.
pub(super) fn curve_through(
    x: &str,
    y: &str,
    points: Vec<[f64; 2]>,
    given: Vec<[f64; 2]>,
) -> Figure {
    let line = Series::line(points, Line::thick(Dash::Solid), Colour::Blue);
    over(x, y, vec![line, of_points(given)])
}

/// A figure of a quantity over another as a line; `x` and `y` are the axis labels.
pub(super) fn curve(x: &str, y: &str, points: Vec<[f64; 2]>) -> Figure {
    let line = Line::thick(Dash::Solid);
    over(x, y, vec![Series::line(points, line, Colour::Blue)])
}

/// A figure of a quantity over another as separate points; `x` and `y` are the axis labels.
pub(super) fn points(x: &str, y: &str, points: Vec<[f64; 2]>) -> Figure {
    over(x, y, vec![of_points(points)])
}

fn of_points(points: Vec<[f64; 2]>) -> Series {
    Series::markers(points, Marker::filled(Shape::Circle), Colour::Blue)
}

/// A figure of those series that have points.
fn over(x: &str, y: &str, mut series: Vec<Series>) -> Figure {
    series.retain(|one| !one.points.is_empty());
    let points = || series.iter().flat_map(|one| &one.points);
    let range = |axis: usize| range_with_zero(points().map(|point| point[axis]));
    let [x, y] = [Axis::linear(x, range(0)), Axis::linear(y, range(1))];
    Figure::single(Chart::new(x, y, series))
}

/// A range that includes 0 and all values, with a margin of 5 % of its length; [−1, 1] if all are 0.
pub(crate) fn range_with_zero(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [low, high] = values.fold([0.0_f64; 2], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    let room = if high > low { 0.05 * (high - low) } else { 1.0 };
    // The margin at both ends keeps markers inside the frame.
    [low - room, high + room]
}
