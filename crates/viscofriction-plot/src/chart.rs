//! Charts: series over a pair of axes.

use crate::axis::Axis;
use crate::canvas::{Canvas, Pixel};
use crate::error::PlotError;
use crate::frame::{Frame, TickSide, right_margin, side_margin};
use crate::legend::{Legend, LegendPlace};
use crate::marks::draw_series;
use crate::panel::{Draw, PANEL_WIDTH};
use crate::series::{Series, validate};

/// Series over a pair of axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Text above the frame.
    pub title: Option<String>,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Data, drawn in this order.
    pub series: Vec<Series>,
    /// Place of the legend.
    pub legend: LegendPlace,
}

/// Height of the data rectangle, \[px\].
const HEIGHT: f64 = 280.0;

impl Draw for Chart {
    fn validate(&self) -> Result<(), PlotError> {
        if self.series.is_empty() {
            let what = format!("the list of series over '{}'", self.x.label);
            return Err(PlotError::Empty(what));
        }
        validate(&self.series, &self.x, &self.y)
    }

    fn left_margin(&self) -> Result<f64, PlotError> {
        side_margin(&self.y)
    }

    fn height(&self, left: f64) -> Result<f64, PlotError> {
        let frame = self.frame([left, 0.0], left)?;
        let legend = Legend::new(&self.series, &frame, self.legend)?;
        Ok(frame.bottom() + legend.height_below())
    }

    fn draw(&self, canvas: &mut Canvas, [x, y]: Pixel, left: f64) -> Result<(), PlotError> {
        let frame = self.frame([x + left, y], left)?;
        frame.draw(canvas, TickSide::Inside)?;
        draw_series(canvas, &frame, &self.series);
        Legend::new(&self.series, &frame, self.legend)?.draw(canvas, &frame);
        Ok(())
    }
}

impl Chart {
    fn frame(&self, origin: Pixel, left: f64) -> Result<Frame<'_>, PlotError> {
        let size = [PANEL_WIDTH - left - right_margin(&self.x)?, HEIGHT];
        Ok(Frame::new(&self.title, [&self.x, &self.y], origin, size))
    }
}
