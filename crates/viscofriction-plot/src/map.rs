//! Maps: a field on a rectangular grid, with a colour bar.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::axis::{Axis, Scale};
use crate::canvas::{Area, Canvas, Pixel, to_f64};
use crate::colour::{ColourScale, level_colour};
use crate::error::PlotError;
use crate::frame::{Frame, TickSide, side_margin};
use crate::marks::draw_series;
use crate::panel::{Draw, PANEL_WIDTH};
use crate::series::{Series, validate};

/// Field on a rectangular grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// Text above the frame.
    pub title: Option<String>,
    /// Horizontal axis; the grid fills its range.
    pub x: Axis,
    /// Vertical axis; the grid fills its range.
    pub y: Axis,
    /// Number of cells along x.
    pub columns: usize,
    /// One value per cell, row by row from the lowest y, each from the lowest x; cells without one stay white.
    pub values: Vec<Option<f64>>,
    /// Meaning of the colours.
    pub colours: ColourScale,
    /// Outlines or points drawn over the field; their labels are not shown.
    pub overlays: Vec<Series>,
    /// What the lengths of the axes mean.
    pub proportions: Proportions,
}

/// How long the axes of a map are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Proportions {
    /// A unit of length is equally long on both.
    True,
    /// Both fill the panel, because their units differ.
    Free,
}

/// Largest size of the data rectangle, \[px\].
const LARGEST_HEIGHT: f64 = 400.0;
const BAR_GAP: f64 = 12.0;

impl Draw for Map {
    fn validate(&self) -> Result<(), PlotError> {
        for axis in [&self.x, &self.y] {
            if axis.scale == Scale::Log10 && self.proportions == Proportions::True {
                return Err(axis.refused("be linear, because the map has true proportions"));
            }
        }
        self.validate_size()?;
        self.colours.validate(self.values.iter().copied())?;
        validate(&self.overlays, &self.x, &self.y)
    }

    fn left_margin(&self) -> Result<f64, PlotError> {
        side_margin(&self.y)
    }

    fn height(&self, left: f64) -> Result<f64, PlotError> {
        Ok(self.frame([left, 0.0], left)?.bottom())
    }

    fn draw(&self, canvas: &mut Canvas, [x, y]: Pixel, left: f64) -> Result<(), PlotError> {
        let frame = self.frame([x + left, y], left)?;
        let area = frame.area;
        self.draw_field(canvas, area);
        frame.draw(canvas, TickSide::Outside)?;
        draw_series(canvas, &frame, &self.overlays);
        let bar = area.right() + BAR_GAP;
        self.colours.draw_bar(canvas, bar, [area.top, area.height])
    }
}

impl Map {
    fn validate_size(&self) -> Result<(), PlotError> {
        if self.columns == 0 || self.values.is_empty() {
            let what = format!("the grid of '{}'", self.colours.label);
            return Err(PlotError::Empty(what));
        }
        let given = self.values.len();
        let needed = given.next_multiple_of(self.columns);
        if needed == given {
            return Ok(());
        }
        Err(PlotError::Count {
            of: self.colours.label.clone(),
            needed,
            given,
        })
    }

    fn frame(&self, origin: Pixel, left: f64) -> Result<Frame<'_>, PlotError> {
        let axes = [&self.x, &self.y];
        let right = BAR_GAP + self.colours.bar_width()?;
        let largest = [PANEL_WIDTH - left - right, LARGEST_HEIGHT];
        let spans = axes.map(|axis| axis.range[1] - axis.range[0]);
        let scale = (largest[0] / spans[0]).min(largest[1] / spans[1]);
        let size = match self.proportions {
            Proportions::True => spans.map(|span| scale * span),
            Proportions::Free => largest,
        };
        Ok(Frame::new(&self.title, axes, origin, size))
    }

    /// One path per colour, neighbours of one colour in a row merged.
    fn draw_field(&self, canvas: &mut Canvas, area: Area) {
        let rows = self.values.len() / self.columns;
        let [columns, rows] = [self.columns, rows].map(to_f64);
        let size = [area.width / columns, area.height / rows];
        let mut paths: BTreeMap<u8, String> = BTreeMap::new();
        for (row, values) in self.values.chunks(self.columns).enumerate() {
            let level = |value: &Option<f64>| value.map(|value| self.colours.level(value));
            let levels: Vec<Option<u8>> = values.iter().map(level).collect();
            let mut start = 0;
            for run in levels.chunk_by(|a, b| a == b) {
                let length = run.len();
                if let Some(level) = run[0] {
                    let path = paths.entry(level).or_default();
                    // A text takes all that is written to it.
                    let _always = write!(path, "M{start} {row}h{length}v1h-{length}z");
                }
                start += length;
            }
        }
        let paths = paths.into_iter();
        canvas.mosaic(
            area,
            size,
            paths.map(|(level, path)| (level_colour(level), path)),
        );
    }
}
