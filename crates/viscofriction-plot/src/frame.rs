//! Frame of a chart: the data rectangle with its axes, their ticks and labels, and the title.

use crate::axis::Axis;
use crate::canvas::{Anchor, Area, Canvas, FRAME_PEN, Pen, Pixel};
use crate::error::PlotError;
use crate::font::{fitting_width, text_width};
use crate::ticks::{Tick, label, ticks};

/// Text size of tick labels, \[px\].
const TICK_SIZE: u32 = 13;
/// Text size of axis labels, \[px\].
const LABEL_SIZE: u32 = 14;
/// Text size of the title, \[px\].
const TITLE_SIZE: u32 = 14;

/// Distance between neighbouring parts of an axis, \[px\].
const GAP: f64 = 6.0;
/// Height of the title above the data rectangle, \[px\].
const TITLE_HEIGHT: f64 = 24.0;
/// Length of a major tick, \[px\].
const MAJOR_TICK_LENGTH: f64 = 6.0;
/// Length of a minor tick, \[px\].
const MINOR_TICK_LENGTH: f64 = 3.5;
/// Largest excess of the length of a text over its edge of the frame, \[px\].
const MAX_OVERHANG: f64 = 24.0;
/// Distance of the baseline from the middle of a digit, relative to the text size.
const HALF_DIGIT_HEIGHT: f64 = 0.365;

/// Pen of grid lines.
const GRID_PEN: Pen = Pen::solid("#e4e4e4", 0.7);

/// Data rectangle, its title and its two axes.
pub(crate) struct Frame<'a> {
    title: Option<&'a str>,
    pub(crate) area: Area,
    axes: [AxisEdge<'a>; 2],
}

/// Direction of the ticks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TickSide {
    /// Into the frame, on all four edges, over a faint grid.
    Inside,
    /// Away from the frame, on the edges with labels.
    Outside,
}

/// Edge of a rectangle that has an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Edge {
    Bottom,
    Left,
    Right,
}

/// Width of the tick labels and the label of a y axis next to the frame, \[px\].
pub(crate) fn side_margin(y: &Axis) -> Result<f64, PlotError> {
    Ok(widest_label(&ticks(y))? + 3.0 * GAP + f64::from(LABEL_SIZE) + 2.0)
}

/// Margin to the right of the frame, \[px\], with space for half of the last tick label.
pub(crate) fn right_margin(x: &Axis) -> Result<f64, PlotError> {
    let last = ticks(x).into_iter().rev().find_map(|tick| tick.label);
    let width = last.map_or(Ok(0.0), |label| text_width(&label, TICK_SIZE))?;
    Ok((width / 2.0 + 4.0).max(18.0))
}

/// Width of the widest label of some ticks, \[px\]; 0 without labels.
fn widest_label(ticks: &[Tick]) -> Result<f64, PlotError> {
    let mut labels = ticks.iter().filter_map(|tick| tick.label.as_deref());
    labels.try_fold(0.0, |widest: f64, label| {
        Ok(widest.max(text_width(label, TICK_SIZE)?))
    })
}

impl<'a> Frame<'a> {
    /// Frame over the axes x and y with a data rectangle of the given size; texts that are too long are refused.
    ///
    /// The pixel is the upper left corner of the panel without its left margin.
    pub(crate) fn new(
        title: Option<&'a str>,
        [x, y]: [&'a Axis; 2],
        [left, top]: Pixel,
        [width, height]: [f64; 2],
    ) -> Result<Self, PlotError> {
        if let Some(title) = title {
            fitting_width(title, TITLE_SIZE, width + MAX_OVERHANG)?;
        }
        let area = Area {
            left,
            top: top + title.map_or(10.0, |_| TITLE_HEIGHT),
            width,
            height,
        };
        let axes = [
            AxisEdge::new(x, area, Edge::Bottom)?,
            AxisEdge::new(y, area, Edge::Left)?,
        ];
        Ok(Self { title, area, axes })
    }

    /// Positions on the canvas of data points (x, y).
    pub(crate) fn pixels(&self, points: &[[f64; 2]]) -> Vec<Pixel> {
        let [across, up] = &self.axes;
        let pixel = |&[x, y]: &[f64; 2]| [across.pixel(x)[0], up.pixel(y)[1]];
        points.iter().map(pixel).collect()
    }

    /// Lower end of the tick labels and the label of the x axis, \[px\].
    pub(crate) fn bottom(&self) -> f64 {
        self.area.bottom() + (4.0 * GAP + f64::from(TICK_SIZE + LABEL_SIZE))
    }

    /// Draws frame, grid lines, ticks and labels; the data are drawn by others.
    pub(crate) fn draw(&self, canvas: &mut Canvas, side: TickSide) {
        let area = self.area;
        if side == TickSide::Inside {
            self.axes.iter().for_each(|axis| axis.draw_grid(canvas));
        }
        canvas.rectangle(area, "none", &FRAME_PEN);
        self.axes.iter().for_each(|axis| axis.draw(canvas, side));
        if let Some(title) = self.title {
            let above = [area.left + area.width / 2.0, area.top - GAP - 2.0];
            canvas.text(above, title, TITLE_SIZE, Anchor::Middle);
        }
    }
}

/// An axis along the edge of a rectangle.
pub(crate) struct AxisEdge<'a> {
    /// The axis.
    axis: &'a Axis,
    /// Label of the axis, with the prefix or power of ten of its ticks.
    label: String,
    /// The rectangle.
    area: Area,
    /// Edge of the rectangle.
    edge: Edge,
    ticks: Vec<Tick>,
    /// Width of the widest label of a tick, \[px\].
    widest: f64,
}

impl<'a> AxisEdge<'a> {
    /// Axis with as many tick labels as do not overlap; a label that is longer than the edge is refused.
    pub(crate) fn new(axis: &'a Axis, area: Area, edge: Edge) -> Result<Self, PlotError> {
        let length = match edge {
            Edge::Bottom => area.width,
            Edge::Left | Edge::Right => area.height,
        };
        let label = label(axis);
        fitting_width(&label, LABEL_SIZE, length + MAX_OVERHANG)?;
        let ticks = ticks(axis);
        let mut found = Self {
            axis,
            label,
            area,
            edge,
            widest: widest_label(&ticks)?,
            ticks,
        };
        while edge == Edge::Bottom && found.labels_collide()? {
            let labelled = found.ticks.iter_mut().filter(|tick| tick.label.is_some());
            for tick in labelled.skip(1).step_by(2) {
                tick.label = None;
            }
        }
        Ok(found)
    }

    /// Pixel of a value on the edge.
    fn pixel(&self, value: f64) -> Pixel {
        self.pixel_at(self.axis.fraction(value))
    }

    /// Pixel at a fraction of the edge, from the left or from below.
    fn pixel_at(&self, fraction: f64) -> Pixel {
        let area = &self.area;
        let x = area.left + area.width * fraction;
        let y = area.bottom() - area.height * fraction;
        match self.edge {
            Edge::Bottom => [x, area.bottom()],
            Edge::Left => [area.left, y],
            Edge::Right => [area.right(), y],
        }
    }

    /// Pixel at a distance from `pixel` towards the inside of the frame, \[px\].
    fn inwards(&self, [x, y]: Pixel, distance: f64) -> Pixel {
        match self.edge {
            Edge::Bottom => [x, y - distance],
            Edge::Left => [x + distance, y],
            Edge::Right => [x - distance, y],
        }
    }

    /// Pixel opposite to `pixel` on the other side of the data rectangle.
    fn opposite(&self, pixel: Pixel) -> Pixel {
        let across = match self.edge {
            Edge::Bottom => self.area.height,
            Edge::Left | Edge::Right => self.area.width,
        };
        self.inwards(pixel, across)
    }

    /// Whether two labels of ticks are closer than [`GAP`]; for a horizontal axis.
    fn labels_collide(&self) -> Result<bool, PlotError> {
        let mut free = f64::NEG_INFINITY;
        for tick in &self.ticks {
            let Some(label) = &tick.label else { continue };
            let half = text_width(label, TICK_SIZE)? / 2.0;
            let middle = self.pixel(tick.value)[0];
            if middle - half < free {
                return Ok(true);
            }
            free = middle + half + GAP;
        }
        Ok(false)
    }

    /// Draws a line across the rectangle at every major tick.
    fn draw_grid(&self, canvas: &mut Canvas) {
        for tick in self.ticks.iter().filter(|tick| tick.major) {
            let own = self.pixel(tick.value);
            canvas.line(own, self.opposite(own), &GRID_PEN);
        }
    }

    /// Draws ticks and labels.
    pub(crate) fn draw(&self, canvas: &mut Canvas, side: TickSide) {
        // Ticks of a colour bar are shorter.
        let shorter = if self.edge == Edge::Right { 2.0 } else { 0.0 };
        let size = f64::from(TICK_SIZE);
        let ([right, down], anchor) = match self.edge {
            Edge::Bottom => ([0.0, GAP + size], Anchor::Middle),
            Edge::Left => ([-GAP - 2.0, HALF_DIGIT_HEIGHT * size], Anchor::End),
            Edge::Right => ([GAP + 1.0, HALF_DIGIT_HEIGHT * size], Anchor::Start),
        };
        for tick in &self.ticks {
            let length = if tick.major {
                MAJOR_TICK_LENGTH
            } else {
                MINOR_TICK_LENGTH
            } - shorter;
            let own = self.pixel(tick.value);
            let mut mark = |from, inwards| {
                canvas.line(from, self.inwards(from, inwards), &FRAME_PEN);
            };
            match side {
                TickSide::Inside => {
                    mark(own, length);
                    mark(self.opposite(own), -length);
                }
                TickSide::Outside => mark(own, -length),
            }
            if let Some(label) = &tick.label {
                canvas.text([own[0] + right, own[1] + down], label, TICK_SIZE, anchor);
            }
        }
        self.draw_label(canvas);
    }

    /// Draws the label of the axis, at the middle of the edge.
    fn draw_label(&self, canvas: &mut Canvas) {
        let [x, y] = self.pixel_at(0.5);
        let size = f64::from(LABEL_SIZE);
        let below = 2.0 * GAP + f64::from(TICK_SIZE) + size - 2.0;
        let ([right, down], anchor) = match self.edge {
            Edge::Bottom => ([0.0, below], Anchor::Middle),
            Edge::Left => ([-self.widest - 2.5 * GAP, 0.0], Anchor::Upwards),
            Edge::Right => ([self.widest + 2.0 * GAP + size, 0.0], Anchor::Upwards),
        };
        canvas.text([x + right, y + down], &self.label, LABEL_SIZE, anchor);
    }
}
