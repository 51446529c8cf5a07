//! The frame of a picture: the rectangle the data live in, with its ticks, labels and title.

use crate::axis::Axis;
use crate::canvas::{Anchor, Area, Canvas, Pen, Pixel};
use crate::error::PlotError;
use crate::font::{check_fit, text_width};
use crate::ticks::{Tick, ticks};

/// Sizes of the texts, \[px\].
pub(crate) const TICK_SIZE: u32 = 13;
pub(crate) const LABEL_SIZE: u32 = 14;
pub(crate) const TITLE_SIZE: u32 = 14;

/// Distances, \[px\].
const GAP: f64 = 6.0;
const TITLE_HEIGHT: f64 = 24.0;
const MAJOR: f64 = 6.0;
const MINOR: f64 = 3.5;
/// Drop of the baseline from the middle of a digit, as a share of the text size.
const HALF_DIGIT: f64 = 0.365;

const FRAME_PEN: Pen<'static> = Pen {
    colour: "#000000",
    width: 1.0,
    dash: None,
};
const GRID_PEN: Pen<'static> = Pen {
    colour: "#e4e4e4",
    width: 0.7,
    dash: None,
};

/// Data rectangle and its two axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame<'a> {
    pub(crate) area: Area,
    pub(crate) x: &'a Axis,
    pub(crate) y: &'a Axis,
}

/// Which way the ticks point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TickSide {
    /// Into the frame, on all four sides, over a faint grid.
    Inside,
    /// Away from the frame, on the left and below.
    Outside,
}

/// Room a title takes above the frame, \[px\].
pub(crate) fn top_margin(title: Option<&str>) -> f64 {
    if title.is_some() { TITLE_HEIGHT } else { 10.0 }
}

/// Room the tick labels and the label of the x axis take below the frame, \[px\].
pub(crate) fn bottom_margin() -> f64 {
    4.0 * GAP + f64::from(TICK_SIZE + LABEL_SIZE)
}

/// Room the tick labels and the label of a y axis take beside the frame, \[px\].
pub(crate) fn side_margin(y: &Axis) -> Result<f64, PlotError> {
    Ok(tick_label_width(y)? + 3.0 * GAP + f64::from(LABEL_SIZE) + 2.0)
}

/// Room to the right of the frame, \[px\]; half of the last tick label may reach into it.
pub(crate) fn right_margin(x: &Axis) -> Result<f64, PlotError> {
    let last = ticks(x)
        .into_iter()
        .filter_map(|tick| tick.label)
        .next_back();
    let width = last.map_or(Ok(0.0), |label| text_width(&label, TICK_SIZE))?;
    Ok((width / 2.0 + 4.0).max(18.0))
}

fn tick_label_width(axis: &Axis) -> Result<f64, PlotError> {
    let labels = ticks(axis).into_iter().filter_map(|tick| tick.label);
    labels
        .map(|label| text_width(&label, TICK_SIZE))
        .try_fold(0.0, |widest: f64, width| Ok(widest.max(width?)))
}

impl Frame<'_> {
    /// Pixel of a data point.
    pub(crate) fn pixel(&self, [x, y]: [f64; 2]) -> Pixel {
        [
            self.area.left + self.area.width * self.x.fraction(x),
            self.area.bottom() - self.area.height * self.y.fraction(y),
        ]
    }

    /// Draws everything but the data.
    pub(crate) fn draw(
        &self,
        canvas: &mut Canvas,
        title: Option<&str>,
        side: TickSide,
    ) -> Result<(), PlotError> {
        self.check_texts(title)?;
        let (x_ticks, y_ticks) = (self.x_ticks()?, ticks(self.y));
        if side == TickSide::Inside {
            self.draw_grid(canvas, &x_ticks, &y_ticks);
        }
        canvas.rectangle(self.area, "none", &FRAME_PEN);
        for tick in &x_ticks {
            self.draw_x_tick(canvas, tick, side);
        }
        for tick in &y_ticks {
            self.draw_y_tick(canvas, tick, side);
        }
        self.draw_texts(canvas, title)
    }

    fn check_texts(&self, title: Option<&str>) -> Result<(), PlotError> {
        // A text may reach a little over both ends of the frame.
        let spill = 24.0;
        check_fit(&self.x.label, LABEL_SIZE, self.area.width + spill)?;
        check_fit(&self.y.label, LABEL_SIZE, self.area.height + spill)?;
        title.map_or(Ok(()), |title| {
            check_fit(title, TITLE_SIZE, self.area.width + spill)
        })
    }

    fn draw_grid(&self, canvas: &mut Canvas, x_ticks: &[Tick], y_ticks: &[Tick]) {
        let area = self.area;
        for tick in x_ticks.iter().filter(|tick| tick.major) {
            let x = self.x_pixel(tick);
            canvas.line([x, area.top], [x, area.bottom()], &GRID_PEN);
        }
        for tick in y_ticks.iter().filter(|tick| tick.major) {
            let y = self.y_pixel(tick);
            canvas.line([area.left, y], [area.right(), y], &GRID_PEN);
        }
    }

    fn draw_x_tick(&self, canvas: &mut Canvas, tick: &Tick, side: TickSide) {
        let (x, length) = (self.x_pixel(tick), tick_length(tick));
        let (top, bottom) = (self.area.top, self.area.bottom());
        match side {
            TickSide::Inside => {
                canvas.line([x, bottom], [x, bottom - length], &FRAME_PEN);
                canvas.line([x, top], [x, top + length], &FRAME_PEN);
            }
            TickSide::Outside => canvas.line([x, bottom], [x, bottom + length], &FRAME_PEN),
        }
        if let Some(label) = &tick.label {
            let baseline = bottom + GAP + f64::from(TICK_SIZE);
            canvas.text([x, baseline], label, TICK_SIZE, Anchor::Middle);
        }
    }

    fn draw_y_tick(&self, canvas: &mut Canvas, tick: &Tick, side: TickSide) {
        let (y, length) = (self.y_pixel(tick), tick_length(tick));
        let (left, right) = (self.area.left, self.area.right());
        match side {
            TickSide::Inside => {
                canvas.line([left, y], [left + length, y], &FRAME_PEN);
                canvas.line([right, y], [right - length, y], &FRAME_PEN);
            }
            TickSide::Outside => canvas.line([left, y], [left - length, y], &FRAME_PEN),
        }
        if let Some(label) = &tick.label {
            let baseline = y + HALF_DIGIT * f64::from(TICK_SIZE);
            canvas.text([left - GAP - 2.0, baseline], label, TICK_SIZE, Anchor::End);
        }
    }

    fn draw_texts(&self, canvas: &mut Canvas, title: Option<&str>) -> Result<(), PlotError> {
        let area = self.area;
        let centre = [area.left + area.width / 2.0, area.top + area.height / 2.0];
        let below = area.bottom() + 2.0 * GAP + f64::from(TICK_SIZE + LABEL_SIZE) - 2.0;
        canvas.text(
            [centre[0], below],
            &self.x.label,
            LABEL_SIZE,
            Anchor::Middle,
        );
        let beside = area.left - tick_label_width(self.y)? - 2.5 * GAP;
        canvas.text(
            [beside, centre[1]],
            &self.y.label,
            LABEL_SIZE,
            Anchor::Upwards,
        );
        if let Some(title) = title {
            canvas.text(
                [centre[0], area.top - GAP - 2.0],
                title,
                TITLE_SIZE,
                Anchor::Middle,
            );
        }
        Ok(())
    }

    /// Ticks of the x axis, with as many labels as stand clear of each other.
    fn x_ticks(&self) -> Result<Vec<Tick>, PlotError> {
        let mut ticks = ticks(self.x);
        while self.labels_collide(&ticks)? {
            let labelled = ticks.iter_mut().filter(|tick| tick.label.is_some());
            for tick in labelled.skip(1).step_by(2) {
                tick.label = None;
            }
        }
        Ok(ticks)
    }

    fn labels_collide(&self, ticks: &[Tick]) -> Result<bool, PlotError> {
        let mut free = f64::NEG_INFINITY;
        for tick in ticks {
            let Some(label) = &tick.label else { continue };
            let (middle, half) = (self.x_pixel(tick), text_width(label, TICK_SIZE)? / 2.0);
            if middle - half < free {
                return Ok(true);
            }
            free = middle + half + GAP;
        }
        Ok(false)
    }

    fn x_pixel(&self, tick: &Tick) -> f64 {
        self.area.left + self.area.width * self.x.fraction(tick.value)
    }

    fn y_pixel(&self, tick: &Tick) -> f64 {
        self.area.bottom() - self.area.height * self.y.fraction(tick.value)
    }
}

/// Draws ticks and label of a vertical axis to the right of a rectangle.
pub(crate) fn draw_right_axis(
    canvas: &mut Canvas,
    area: Area,
    axis: &Axis,
) -> Result<(), PlotError> {
    check_fit(&axis.label, LABEL_SIZE, area.height + 24.0)?;
    let right = area.right();
    for tick in ticks(axis) {
        let y = area.bottom() - area.height * axis.fraction(tick.value);
        canvas.line(
            [right, y],
            [right + tick_length(&tick) - 2.0, y],
            &FRAME_PEN,
        );
        if let Some(label) = &tick.label {
            let baseline = y + HALF_DIGIT * f64::from(TICK_SIZE);
            canvas.text(
                [right + GAP + 1.0, baseline],
                label,
                TICK_SIZE,
                Anchor::Start,
            );
        }
    }
    let beside = right + tick_label_width(axis)? + 2.0 * GAP + f64::from(LABEL_SIZE);
    let middle = area.top + area.height / 2.0;
    canvas.text([beside, middle], &axis.label, LABEL_SIZE, Anchor::Upwards);
    Ok(())
}

const fn tick_length(tick: &Tick) -> f64 {
    if tick.major { MAJOR } else { MINOR }
}
