//! The frame of a picture: the rectangle the data live in, with its axes, their ticks and labels, and its title.

use crate::axis::Axis;
use crate::canvas::{Anchor, Area, Canvas, FRAME_PEN, Pen, Pixel};
use crate::error::PlotError;
use crate::font::{check_fit, text_width, widest};
use crate::ticks::{Tick, ticks};

/// Sizes of the texts, \[px\].
pub(crate) const TICK_SIZE: u32 = 13;
const LABEL_SIZE: u32 = 14;
pub(crate) const TITLE_SIZE: u32 = 14;

/// Distances, \[px\].
const GAP: f64 = 6.0;
const TITLE_HEIGHT: f64 = 24.0;
const MAJOR: f64 = 6.0;
const MINOR: f64 = 3.5;
/// By so much a text may be longer than its edge of the frame.
const SPILL: f64 = 24.0;
/// Drop of the baseline from the middle of a digit, as a part of the text size.
const HALF_DIGIT: f64 = 0.365;

const GRID_PEN: Pen<'static> = Pen::solid("#e4e4e4", 0.7);

/// Data rectangle, its title and its two axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame<'a> {
    title: Option<&'a str>,
    pub(crate) area: Area,
    axes: [&'a Axis; 2],
}

/// To which side of their edge the ticks point.
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

/// Room a title takes above the frame, \[px\].
pub(crate) fn top_margin(title: Option<&str>) -> f64 {
    if title.is_some() { TITLE_HEIGHT } else { 10.0 }
}

/// Room the tick labels and the label of a y axis take beside the frame, \[px\].
pub(crate) fn side_margin(y: &Axis) -> Result<f64, PlotError> {
    Ok(widest_label(&ticks(y))? + 3.0 * GAP + f64::from(LABEL_SIZE) + 2.0)
}

/// Room to the right of the frame, \[px\]; half of the last tick label may reach into it.
pub(crate) fn right_margin(x: &Axis) -> Result<f64, PlotError> {
    let last = ticks(x).into_iter().rev().find_map(|tick| tick.label);
    let width = last.map_or(Ok(0.0), |label| text_width(&label, TICK_SIZE))?;
    Ok((width / 2.0 + 4.0).max(18.0))
}

fn widest_label(ticks: &[Tick]) -> Result<f64, PlotError> {
    let labels = ticks.iter().filter_map(|tick| tick.label.as_deref());
    widest(labels, TICK_SIZE)
}

impl<'a> Frame<'a> {
    /// The frame over axes x and y, with data of this size and the panel's upper left corner, less its left margin, at
    /// `origin`.
    pub(crate) fn new(
        title: &'a Option<String>,
        axes: [&'a Axis; 2],
        [left, top]: Pixel,
        [width, height]: [f64; 2],
    ) -> Self {
        let title = title.as_deref();
        let area = Area {
            left,
            top: top + top_margin(title),
            width,
            height,
        };
        Self { title, area, axes }
    }

    /// Pixel of a data point.
    pub(crate) fn pixel(&self, [x, y]: [f64; 2]) -> Pixel {
        let [x, y] = [self.axes[0].fraction(x), self.axes[1].fraction(y)];
        [
            Edge::Bottom.pixel(&self.area, x)[0],
            Edge::Left.pixel(&self.area, y)[1],
        ]
    }

    /// Where the tick labels and the label of the x axis end, \[px\].
    pub(crate) fn bottom(&self) -> f64 {
        self.area.bottom() + (4.0 * GAP + f64::from(TICK_SIZE + LABEL_SIZE))
    }

    /// Draws everything but the data.
    pub(crate) fn draw(&self, canvas: &mut Canvas, side: TickSide) -> Result<(), PlotError> {
        let area = self.area;
        let axes = [
            AxisEdge::new(self.axes[0], area, Edge::Bottom)?,
            AxisEdge::new(self.axes[1], area, Edge::Left)?,
        ];
        if side == TickSide::Inside {
            axes.iter().for_each(|axis| axis.draw_grid(canvas));
        }
        canvas.rectangle(area, "none", &FRAME_PEN);
        axes.iter().for_each(|axis| axis.draw_ticks(canvas, side));
        axes.iter().try_for_each(|axis| axis.draw_label(canvas))?;
        if let Some(title) = self.title {
            check_fit(title, TITLE_SIZE, area.width + SPILL)?;
            let above = [area.left + area.width / 2.0, area.top - GAP - 2.0];
            canvas.text(above, title, TITLE_SIZE, Anchor::Middle);
        }
        Ok(())
    }
}

impl Edge {
    /// Pixel at a fraction of the edge, from the left or from below.
    fn pixel(self, area: &Area, fraction: f64) -> Pixel {
        let x = area.left + area.width * fraction;
        let y = area.bottom() - area.height * fraction;
        match self {
            Self::Bottom => [x, area.bottom()],
            Self::Left => [area.left, y],
            Self::Right => [area.right(), y],
        }
    }

    /// A pixel moved into the rectangle.
    fn inwards(self, [x, y]: Pixel, distance: f64) -> Pixel {
        match self {
            Self::Bottom => [x, y - distance],
            Self::Left => [x + distance, y],
            Self::Right => [x - distance, y],
        }
    }
}

/// An axis along the edge of a rectangle.
pub(crate) struct AxisEdge<'a> {
    axis: &'a Axis,
    area: Area,
    edge: Edge,
    ticks: Vec<Tick>,
}

impl<'a> AxisEdge<'a> {
    /// With as many tick labels as stand clear of each other; refuses a label that is longer than the edge.
    pub(crate) fn new(axis: &'a Axis, area: Area, edge: Edge) -> Result<Self, PlotError> {
        let length = match edge {
            Edge::Bottom => area.width,
            Edge::Left | Edge::Right => area.height,
        };
        check_fit(&axis.label, LABEL_SIZE, length + SPILL)?;
        let ticks = ticks(axis);
        let mut found = Self {
            axis,
            area,
            edge,
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

    /// Draws ticks and labels, to the outside.
    pub(crate) fn draw_alone(&self, canvas: &mut Canvas) -> Result<(), PlotError> {
        self.draw_ticks(canvas, TickSide::Outside);
        self.draw_label(canvas)
    }

    fn pixel(&self, tick: &Tick) -> Pixel {
        self.edge.pixel(&self.area, self.axis.fraction(tick.value))
    }

    fn labels_collide(&self) -> Result<bool, PlotError> {
        let mut free = f64::NEG_INFINITY;
        for tick in &self.ticks {
            let Some(label) = &tick.label else { continue };
            let (middle, half) = (self.pixel(tick)[0], text_width(label, TICK_SIZE)? / 2.0);
            if middle - half < free {
                return Ok(true);
            }
            free = middle + half + GAP;
        }
        Ok(false)
    }

    /// The pixel on the other side of the rectangle.
    fn opposite(&self, pixel: Pixel) -> Pixel {
        let across = match self.edge {
            Edge::Bottom => self.area.height,
            Edge::Left | Edge::Right => self.area.width,
        };
        self.edge.inwards(pixel, across)
    }

    fn draw_grid(&self, canvas: &mut Canvas) {
        for tick in self.ticks.iter().filter(|tick| tick.major) {
            let own = self.pixel(tick);
            let mut ends = [own, self.opposite(own)];
            // From the top or from the left.
            if self.edge == Edge::Bottom {
                ends.reverse();
            }
            canvas.line(ends[0], ends[1], &GRID_PEN);
        }
    }

    fn draw_ticks(&self, canvas: &mut Canvas, side: TickSide) {
        // Beside a colour bar there is less room.
        let shorter = if self.edge == Edge::Right { 2.0 } else { 0.0 };
        for tick in &self.ticks {
            let length = if tick.major { MAJOR } else { MINOR } - shorter;
            let own = self.pixel(tick);
            let mut mark = |from, inwards| {
                canvas.line(from, self.edge.inwards(from, inwards), &FRAME_PEN);
            };
            match side {
                TickSide::Inside => {
                    mark(own, length);
                    mark(self.opposite(own), -length);
                }
                TickSide::Outside => mark(own, -length),
            }
            if let Some(label) = &tick.label {
                self.draw_tick_label(canvas, own, label);
            }
        }
    }

    fn draw_tick_label(&self, canvas: &mut Canvas, [x, y]: Pixel, label: &str) {
        let size = f64::from(TICK_SIZE);
        let ([right, down], anchor) = match self.edge {
            Edge::Bottom => ([0.0, GAP + size], Anchor::Middle),
            Edge::Left => ([-GAP - 2.0, HALF_DIGIT * size], Anchor::End),
            Edge::Right => ([GAP + 1.0, HALF_DIGIT * size], Anchor::Start),
        };
        canvas.text([x + right, y + down], label, TICK_SIZE, anchor);
    }

    fn draw_label(&self, canvas: &mut Canvas) -> Result<(), PlotError> {
        let [x, y] = self.edge.pixel(&self.area, 0.5);
        let size = f64::from(LABEL_SIZE);
        let beside = widest_label(&self.ticks)?;
        let ([right, down], anchor) = match self.edge {
            Edge::Bottom => (
                [0.0, 2.0 * GAP + f64::from(TICK_SIZE) + size - 2.0],
                Anchor::Middle,
            ),
            Edge::Left => ([-beside - 2.5 * GAP, 0.0], Anchor::Upwards),
            Edge::Right => ([beside + 2.0 * GAP + size, 0.0], Anchor::Upwards),
        };
        canvas.text([x + right, y + down], &self.axis.label, LABEL_SIZE, anchor);
        Ok(())
    }
}
