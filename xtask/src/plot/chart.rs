//! Charts: series over a pair of axes.

use super::axis::Axis;
use super::canvas::{Area, Canvas, Pixel};
use super::error::PlotError;
use super::figure::PANEL_WIDTH;
use super::frame::{Frame, TickSide, bottom_margin, right_margin, side_margin, top_margin};
use super::legend::{Legend, LegendPlace, plan};
use super::marks::draw_series;
use super::series::Series;

/// Series over a pair of axes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chart {
    /// Text above the frame.
    pub(crate) title: Option<String>,
    /// Horizontal axis.
    pub(crate) x: Axis,
    /// Vertical axis.
    pub(crate) y: Axis,
    /// Data, drawn in this order.
    pub(crate) series: Vec<Series>,
    /// Place of the legend.
    pub(crate) legend: LegendPlace,
}

/// Height of the data rectangle, \[px\].
const HEIGHT: f64 = 280.0;

impl Chart {
    /// Refuses axes and data that cannot be drawn faithfully.
    pub(super) fn validate(&self) -> Result<(), PlotError> {
        self.x.validate()?;
        self.y.validate()?;
        if self.series.is_empty() {
            return Err(PlotError::Empty {
                what: format!("the list of series over '{}'", self.x.label),
            });
        }
        self.series
            .iter()
            .try_for_each(|series| series.validate(&self.x, &self.y))
    }

    /// Room that the left side needs, \[px\].
    pub(super) fn left_margin(&self) -> Result<f64, PlotError> {
        side_margin(&self.y)
    }

    /// Height of the whole panel, \[px\].
    pub(super) fn height(&self, left: f64) -> Result<f64, PlotError> {
        let frame = self.frame([0.0, 0.0], left)?;
        Ok(frame.area.bottom() + bottom_margin() + self.legend(&frame)?.height_below())
    }

    /// Draws the panel with its upper left corner at `origin`.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        origin: Pixel,
        left: f64,
    ) -> Result<(), PlotError> {
        let frame = self.frame(origin, left)?;
        frame.draw(canvas, self.title.as_deref(), TickSide::Inside)?;
        for series in &self.series {
            draw_series(canvas, &frame, series);
        }
        self.legend(&frame)?
            .draw(canvas, &frame, frame.area.bottom() + bottom_margin());
        Ok(())
    }

    fn legend(&self, frame: &Frame) -> Result<Legend<'_>, PlotError> {
        plan(&self.series, frame, self.legend)
    }

    fn frame(&self, [x, y]: Pixel, left: f64) -> Result<Frame<'_>, PlotError> {
        let area = Area {
            left: x + left,
            top: y + top_margin(self.title.as_deref()),
            width: PANEL_WIDTH - left - right_margin(&self.x)?,
            height: HEIGHT,
        };
        Ok(Frame {
            area,
            x: &self.x,
            y: &self.y,
        })
    }
}
