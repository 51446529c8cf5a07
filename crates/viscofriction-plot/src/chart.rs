//! Charts: series over a pair of axes, optionally over a field.

use crate::axis::Axis;
use crate::canvas::{Canvas, Pixel};
use crate::error::PlotError;
use crate::field::Field;
use crate::frame::{Frame, TickSide, right_margin};
use crate::legend::{Legend, LegendPlace};
use crate::marks::draw_series;
use crate::series::Series;

/// Series over a pair of axes, or over a field.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Text above the frame.
    pub title: Option<String>,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Field under the series; the axes then have no grid.
    pub field: Option<Field>,
    /// Data, drawn in this order.
    pub series: Vec<Series>,
    /// Place of the legend.
    pub legend: LegendPlace,
}

/// Width of a chart with its margins, \[px\].
pub(crate) const PANEL_WIDTH: f64 = 480.0;
/// Height of the data rectangle without a field, \[px\].
const CHART_HEIGHT: f64 = 280.0;
/// Largest height of the data rectangle with a field, \[px\].
const MAX_FIELD_HEIGHT: f64 = 400.0;

/// A chart with its layout.
pub(crate) struct Panel<'a> {
    chart: &'a Chart,
    frame: Frame<'a>,
    legend: Legend<'a>,
}

impl Chart {
    /// Chart of series without title; the legend is placed automatically.
    pub fn new(x: Axis, y: Axis, series: Vec<Series>) -> Self {
        Self {
            title: None,
            x,
            y,
            field: None,
            series,
            legend: LegendPlace::Free,
        }
    }

    /// Chart of a field without title and series.
    pub fn map(x: Axis, y: Axis, field: Field) -> Self {
        Self {
            field: Some(field),
            ..Self::new(x, y, Vec::new())
        }
    }

    /// Refuses data that cannot be drawn faithfully.
    pub(crate) fn validate(&self) -> Result<(), PlotError> {
        let Self { x, y, .. } = self;
        x.validate()?;
        y.validate()?;
        match &self.field {
            Some(field) => field.validate([x, y])?,
            None if self.series.is_empty() => {
                let what = format!("the list of series over '{}'", x.label);
                return Err(PlotError::Empty(what));
            }
            None => (),
        }
        self.series.iter().try_for_each(|one| one.validate(x, y))
    }

    /// Layout of the chart with its upper left corner at a pixel and a margin `left` \[px\] of its frame.
    pub(crate) fn panel(&self, [x, y]: Pixel, left: f64) -> Result<Panel<'_>, PlotError> {
        let width = PANEL_WIDTH - left;
        let size = match &self.field {
            None => [width - right_margin(&self.x)?, CHART_HEIGHT],
            Some(field) => {
                let largest = [width - field.right_margin()?, MAX_FIELD_HEIGHT];
                field.size([&self.x, &self.y], largest)
            }
        };
        let title = self.title.as_deref();
        let frame = Frame::new(title, [&self.x, &self.y], [x + left, y], size)?;
        Ok(Panel {
            chart: self,
            legend: Legend::new(&self.series, &frame, self.legend)?,
            frame,
        })
    }
}

impl Panel<'_> {
    /// Right end, \[px\]; a map that is higher than wide does not fill the width.
    pub(crate) fn right(&self) -> Result<f64, PlotError> {
        let margin = match &self.chart.field {
            None => right_margin(&self.chart.x)?,
            Some(field) => field.right_margin()?,
        };
        Ok(self.frame.area.right() + margin)
    }

    /// Lower end, \[px\].
    pub(crate) fn bottom(&self) -> f64 {
        self.frame.bottom() + self.legend.height_below()
    }

    /// Draws the field, frame, series and legend, in this order.
    pub(crate) fn draw(&self, canvas: &mut Canvas) -> Result<(), PlotError> {
        if let Some(field) = &self.chart.field {
            field.draw(canvas, self.frame.area)?;
            self.frame.draw(canvas, TickSide::Outside);
            field.draw_bar(canvas, self.frame.area)?;
        } else {
            self.frame.draw(canvas, TickSide::Inside);
        }
        draw_series(canvas, &self.frame, &self.chart.series);
        self.legend.draw(canvas, &self.frame);
        Ok(())
    }
}
