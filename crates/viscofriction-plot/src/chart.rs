//! Charts: series over a pair of axes.

use crate::axis::Axis;
use crate::canvas::{Area, Canvas, Pixel};
use crate::error::PlotError;
use crate::figure::{Draw, PANEL_WIDTH};
use crate::frame::{Frame, TickSide, bottom_margin, right_margin, side_margin, top_margin};
use crate::legend::{Legend, LegendPlace};
use crate::marks::draw_series;
use crate::series::Series;

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
        self.x.validate()?;
        self.y.validate()?;
        if self.series.is_empty() {
            let what = format!("the list of series over '{}'", self.x.label);
            return Err(PlotError::Empty(what));
        }
        let mut series = self.series.iter();
        series.try_for_each(|series| series.validate(&self.x, &self.y))
    }

    fn left_margin(&self) -> Result<f64, PlotError> {
        side_margin(&self.y)
    }

    fn height(&self, left: f64) -> Result<f64, PlotError> {
        let frame = self.frame([0.0, 0.0], left)?;
        let legend = Legend::new(&self.series, &frame, self.legend)?;
        Ok(frame.area.bottom() + bottom_margin() + legend.height_below())
    }

    fn draw(&self, canvas: &mut Canvas, origin: Pixel, left: f64) -> Result<(), PlotError> {
        let frame = self.frame(origin, left)?;
        frame.draw(canvas, self.title.as_deref(), TickSide::Inside)?;
        for series in &self.series {
            draw_series(canvas, &frame, series);
        }
        Legend::new(&self.series, &frame, self.legend)?.draw(canvas, &frame.area);
        Ok(())
    }
}

impl Chart {
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
