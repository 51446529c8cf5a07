//! Figures: one chart or several, side by side and in rows.

use crate::canvas::{Canvas, Drawing};
use crate::chart::{Chart, PANEL_WIDTH};
use crate::error::PlotError;
use crate::frame::side_margin;

/// One or more charts in one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Charts from left to right, then from top to bottom.
    pub charts: Vec<Chart>,
    /// Number of charts side by side.
    pub columns: usize,
}

impl Figure {
    /// Figure of charts in a number of `columns`.
    pub fn new(charts: impl IntoIterator<Item = Chart>, columns: usize) -> Self {
        Self {
            charts: charts.into_iter().collect(),
            columns,
        }
    }

    /// Figure of a single chart.
    pub fn single(chart: Chart) -> Self {
        Self::new([chart], 1)
    }
}

/// Drawing of a figure.
///
/// A column is 480 px wide; the last one may be narrower for maps that are higher than wide. The frames of a column are
/// aligned.
///
/// # Errors
/// [`PlotError`] for data that cannot be drawn faithfully.
pub fn draw(figure: &Figure) -> Result<Drawing, PlotError> {
    let Figure { charts, columns } = figure;
    let columns = (*columns).min(charts.len());
    if columns == 0 {
        return Err(PlotError::Empty("the list of charts or of columns".into()));
    }
    // Find the left margin of each column.
    let mut left_margins = vec![0.0_f64; columns];
    for (index, chart) in charts.iter().enumerate() {
        chart.validate()?;
        let widest = &mut left_margins[index % columns];
        *widest = widest.max(side_margin(&chart.y)?);
    }
    // Lay out the panels row by row.
    let (mut panels, mut right, mut bottom) = (Vec::new(), 0.0_f64, 0.0_f64);
    for row in charts.chunks(columns) {
        let top = bottom;
        for (column, (chart, left_margin)) in row.iter().zip(&left_margins).enumerate() {
            let left = PANEL_WIDTH * column as f64;
            let panel = chart.panel([left, top], *left_margin)?;
            right = right.max(panel.right()?);
            bottom = bottom.max(panel.bottom());
            panels.push(panel);
        }
    }
    let mut canvas = Canvas::new(right, bottom);
    panels
        .iter()
        .try_for_each(|panel| panel.draw(&mut canvas))?;
    Ok(canvas.finish())
}
