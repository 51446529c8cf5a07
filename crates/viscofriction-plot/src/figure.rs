//! Figures: one panel or several, side by side and in rows.

use crate::canvas::{Canvas, Drawing};
use crate::chart::Chart;
use crate::error::PlotError;
use crate::map::Map;
use crate::matrix::Matrix;
use crate::panel::Draw;

/// One or more panels in one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Panels from left to right, then from top to bottom.
    pub panels: Vec<Panel>,
    /// Number of panels side by side.
    pub columns: usize,
}

/// Part of a figure.
#[derive(Debug, Clone, PartialEq)]
pub enum Panel {
    /// Series over a pair of axes.
    Chart(Chart),
    /// Field on a grid.
    Map(Map),
    /// Rows of cells.
    Matrix(Matrix),
}

impl Panel {
    fn drawn(&self) -> &dyn Draw {
        match self {
            Self::Chart(chart) => chart,
            Self::Map(map) => map,
            Self::Matrix(matrix) => matrix,
        }
    }
}

impl From<Chart> for Panel {
    fn from(chart: Chart) -> Self {
        Self::Chart(chart)
    }
}

impl From<Map> for Panel {
    fn from(map: Map) -> Self {
        Self::Map(map)
    }
}

impl From<Matrix> for Panel {
    fn from(matrix: Matrix) -> Self {
        Self::Matrix(matrix)
    }
}

/// Panels one below the other, whose frames line up, \[px\].
#[derive(Debug, Clone, Copy, Default)]
struct Column {
    width: f64,
    left_margin: f64,
}

impl Figure {
    /// Figure of panels of one kind with so many side by side.
    pub fn new<P: Into<Panel>>(panels: impl IntoIterator<Item = P>, columns: usize) -> Self {
        let panels = panels.into_iter().map(P::into).collect();
        Self { panels, columns }
    }

    /// Figure of a single panel.
    #[must_use]
    pub fn single(panel: impl Into<Panel>) -> Self {
        Self::new([panel], 1)
    }

    fn layout(&self) -> Result<Vec<Column>, PlotError> {
        if self.panels.is_empty() || self.columns == 0 {
            return Err(PlotError::Empty("the list of panels or of columns".into()));
        }
        let mut columns = vec![Column::default(); self.columns.min(self.panels.len())];
        for (index, panel) in self.panels.iter().map(Panel::drawn).enumerate() {
            panel.validate()?;
            let column = &mut columns[index % self.columns];
            column.width = column.width.max(panel.width());
            column.left_margin = column.left_margin.max(panel.left_margin()?);
        }
        Ok(columns)
    }
}

/// Drawing of a figure, 480 px wide per column, or 960 px with a matrix in it.
///
/// # Errors
/// Whatever could not be drawn faithfully: see [`PlotError`].
pub fn draw(figure: &Figure) -> Result<Drawing, PlotError> {
    let columns = figure.layout()?;
    let rows: Vec<&[Panel]> = figure.panels.chunks(figure.columns).collect();
    let height = |row: &&[Panel]| {
        let mut panels = row.iter().map(Panel::drawn).zip(&columns);
        panels.try_fold(0.0, |tallest: f64, (panel, column)| {
            Ok(tallest.max(panel.height(column.left_margin)?))
        })
    };
    let heights = rows.iter().map(height).collect::<Result<Vec<f64>, _>>()?;
    let width = columns.iter().map(|column| column.width).sum();
    let mut canvas = Canvas::new(width, heights.iter().sum());
    let mut top = 0.0;
    for (row, height) in rows.into_iter().zip(heights) {
        let mut left = 0.0;
        for (panel, column) in row.iter().map(Panel::drawn).zip(&columns) {
            panel.draw(&mut canvas, [left, top], column.left_margin)?;
            left += column.width;
        }
        top += height;
    }
    canvas.finish()
}
