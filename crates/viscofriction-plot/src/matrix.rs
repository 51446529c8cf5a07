//! Heat maps of cases: rows with names, and in each row one cell per case.

use std::collections::BTreeMap;

use crate::canvas::{Anchor, Area, Canvas, NO_PEN, Pixel, to_f64};
use crate::colour::{Colour, ColourScale, level_colour};
use crate::error::PlotError;
use crate::font::{check_fit, text_width, widest};
use crate::frame::{TICK_SIZE, TITLE_SIZE, top_margin};
use crate::panel::Draw;

/// Rows of cells; the panel is wider than others because texts stand on both sides of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Matrix {
    /// Text above the cells.
    pub title: Option<String>,
    /// From top to bottom.
    pub rows: Vec<MatrixRow>,
    /// Meaning of the colours of values.
    pub colours: ColourScale,
    /// Meaning of the plain colours, from left to right below the cells.
    pub legend: Vec<(Colour, String)>,
}

/// One row.
#[derive(Debug, Clone, PartialEq)]
pub struct MatrixRow {
    /// Text on the left.
    pub name: String,
    /// From left to right.
    pub cells: Vec<Cell>,
    /// Text on the right.
    pub note: String,
}

/// One cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cell {
    /// A number on the colour scale.
    Value(f64),
    /// Something without a number.
    Plain(Colour),
}

/// Width of the panel, \[px\].
const MATRIX_WIDTH: f64 = 960.0;
/// Distance from cell to cell along and across a row, \[px\].
const STRIDE: [f64; 2] = [12.0, 16.0];
/// Parts of these distances that are coloured.
const FILLED: [f64; 2] = [0.9, 0.8];
const GAP: f64 = 8.0;
const BAR_HEIGHT: f64 = 300.0;
const LEGEND_HEIGHT: f64 = 34.0;
/// Drop of the baseline from the top of a row.
const BASELINE: f64 = 12.0;

impl Draw for Matrix {
    fn validate(&self) -> Result<(), PlotError> {
        if self.columns() == 0 {
            let what = format!("the rows of '{}'", self.colours.label);
            return Err(PlotError::Empty(what));
        }
        let cells = self.rows.iter().flat_map(|row| &row.cells);
        self.colours.validate(cells.map(|cell| match cell {
            Cell::Value(value) => Some(*value),
            Cell::Plain(_) => None,
        }))
    }

    fn width(&self) -> f64 {
        MATRIX_WIDTH
    }

    fn left_margin(&self) -> Result<f64, PlotError> {
        let names = self.rows.iter().map(|row| &*row.name);
        Ok(widest(names, TICK_SIZE)? + 2.0 * GAP)
    }

    fn height(&self, left: f64) -> Result<f64, PlotError> {
        let area = self.area([0.0, 0.0], left);
        Ok((area.bottom() + LEGEND_HEIGHT).max(area.top + BAR_HEIGHT + GAP))
    }

    fn draw(&self, canvas: &mut Canvas, origin: Pixel, left: f64) -> Result<(), PlotError> {
        let area = self.area(origin, left);
        let bar = origin[0] + MATRIX_WIDTH - self.colours.bar_width()?;
        if let Some(title) = &self.title {
            check_fit(title, TITLE_SIZE, MATRIX_WIDTH - left)?;
            let place = [area.left, area.top - GAP];
            canvas.text(place, title, TITLE_SIZE, Anchor::Start);
        }
        for (index, row) in self.rows.iter().enumerate() {
            let baseline = area.top + STRIDE[1] * to_f64(index) + BASELINE;
            let before = [area.left - GAP, baseline];
            canvas.text(before, &row.name, TICK_SIZE, Anchor::End);
            check_fit(&row.note, TICK_SIZE, bar - area.right() - 2.0 * GAP)?;
            let behind = [area.right() + GAP, baseline];
            canvas.text(behind, &row.note, TICK_SIZE, Anchor::Start);
        }
        self.draw_cells(canvas, area);
        self.draw_legend(canvas, area, bar)?;
        self.colours.draw_bar(canvas, bar, [area.top, BAR_HEIGHT])
    }
}

impl Matrix {
    fn columns(&self) -> usize {
        let lengths = self.rows.iter().map(|row| row.cells.len());
        lengths.max().unwrap_or(0)
    }

    fn area(&self, [x, y]: Pixel, left: f64) -> Area {
        Area {
            left: x + left,
            top: y + top_margin(self.title.as_deref()),
            width: STRIDE[0] * to_f64(self.columns()),
            height: STRIDE[1] * to_f64(self.rows.len()),
        }
    }

    /// One path per colour; a cell is a unit square, counted from the lower left corner.
    fn draw_cells(&self, canvas: &mut Canvas, area: Area) {
        let [width, height] = FILLED;
        let mut paths: BTreeMap<String, String> = BTreeMap::new();
        for (row, cells) in self.rows.iter().rev().enumerate() {
            for (column, cell) in cells.cells.iter().enumerate() {
                let colour = match cell {
                    Cell::Value(value) => level_colour(self.colours.level(*value)),
                    Cell::Plain(colour) => colour.hex().to_owned(),
                };
                let square = format!("M{column} {row}h{width}v{height}h-{width}z");
                paths.entry(colour).or_default().push_str(&square);
            }
        }
        canvas.mosaic(area, STRIDE, paths);
    }

    fn draw_legend(&self, canvas: &mut Canvas, area: Area, end: f64) -> Result<(), PlotError> {
        let mut x = area.left;
        let baseline = area.bottom() + GAP + BASELINE;
        for (colour, text) in &self.legend {
            let sample = Area {
                left: x,
                top: baseline - BASELINE + 2.0,
                width: FILLED[0] * STRIDE[0],
                height: FILLED[1] * STRIDE[1],
            };
            canvas.rectangle(sample, colour.hex(), &NO_PEN);
            x = sample.right() + GAP;
            check_fit(text, TICK_SIZE, end - x)?;
            canvas.text([x, baseline], text, TICK_SIZE, Anchor::Start);
            x += text_width(text, TICK_SIZE)? + 3.0 * GAP;
        }
        Ok(())
    }
}
