//! Maps: a field on a rectangular grid in true proportions, with a colour bar.

use std::collections::BTreeMap;

use crate::axis::{Axis, Scale};
use crate::canvas::{Area, Canvas, Pen, Pixel, scale_colour};
use crate::error::PlotError;
use crate::figure::PANEL_WIDTH;
use crate::frame::{Frame, TickSide, bottom_margin, draw_right_axis, side_margin, top_margin};
use crate::marks::draw_series;
use crate::series::Series;

/// Field on a rectangular grid; a unit of length is equally long on both axes.
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
}

/// Linear scale from dark blue to yellow.
#[derive(Debug, Clone, PartialEq)]
pub struct ColourScale {
    /// Quantity and unit.
    pub label: String,
    /// Values of the darkest and the brightest colour.
    pub range: [f64; 2],
}

/// Largest size of the data rectangle, \[px\].
const LARGEST_HEIGHT: f64 = 400.0;
const BAR_GAP: f64 = 12.0;
const BAR_WIDTH: f64 = 14.0;
/// Number of distinct colours: fine enough for the eye, coarse enough for a small file.
const LEVELS: u8 = 100;

impl Map {
    /// Refuses axes, values and overlays that cannot be drawn faithfully.
    pub(crate) fn validate(&self) -> Result<(), PlotError> {
        for axis in [&self.x, &self.y] {
            axis.validate()?;
            if axis.scale == Scale::Log10 {
                return Err(PlotError::LogMap {
                    axis: axis.label.clone(),
                });
            }
        }
        let scale = self.colour_axis();
        scale.validate()?;
        self.validate_size()?;
        for (index, value) in self.values.iter().enumerate() {
            value.map_or(Ok(()), |value| {
                scale.check(value, &self.colours.label, index)
            })?;
        }
        self.overlays
            .iter()
            .try_for_each(|series| series.validate(&self.x, &self.y))
    }

    fn validate_size(&self) -> Result<(), PlotError> {
        if self.columns == 0 || self.values.is_empty() {
            return Err(PlotError::Empty {
                what: format!("the grid of '{}'", self.colours.label),
            });
        }
        let needed = self.values.len().next_multiple_of(self.columns);
        if needed == self.values.len() {
            return Ok(());
        }
        Err(PlotError::Count {
            of: self.colours.label.clone(),
            needed,
            given: self.values.len(),
        })
    }

    /// Room that the left side needs, \[px\].
    pub(crate) fn left_margin(&self) -> Result<f64, PlotError> {
        side_margin(&self.y)
    }

    /// Height of the whole panel, \[px\].
    pub(crate) fn height(&self, left: f64) -> Result<f64, PlotError> {
        Ok(self.frame([0.0, 0.0], left)?.area.bottom() + bottom_margin())
    }

    /// Draws the panel with its upper left corner at `origin`.
    pub(crate) fn draw(
        &self,
        canvas: &mut Canvas,
        origin: Pixel,
        left: f64,
    ) -> Result<(), PlotError> {
        let frame = self.frame(origin, left)?;
        self.draw_field(canvas, &frame);
        frame.draw(canvas, self.title.as_deref(), TickSide::Outside)?;
        for series in &self.overlays {
            draw_series(canvas, &frame, series);
        }
        self.draw_bar(canvas, &frame)
    }

    fn frame(&self, [x, y]: Pixel, left: f64) -> Result<Frame<'_>, PlotError> {
        let right = BAR_GAP + BAR_WIDTH + side_margin(&self.colour_axis())?;
        let [x_span, y_span] = [&self.x, &self.y].map(|axis| axis.range[1] - axis.range[0]);
        let widest = PANEL_WIDTH - left - right;
        let scale = (widest / x_span).min(LARGEST_HEIGHT / y_span);
        let area = Area {
            left: x + left,
            top: y + top_margin(self.title.as_deref()),
            width: scale * x_span,
            height: scale * y_span,
        };
        Ok(Frame {
            area,
            x: &self.x,
            y: &self.y,
        })
    }

    /// One path per colour, neighbours of one colour in a row merged.
    fn draw_field(&self, canvas: &mut Canvas, frame: &Frame) {
        let scale = self.colour_axis();
        let size = [
            frame.area.width / to_f64(self.columns),
            frame.area.height / to_f64(self.values.len() / self.columns),
        ];
        let mut paths: BTreeMap<u8, String> = BTreeMap::new();
        for (row, values) in self.values.chunks(self.columns).enumerate() {
            let levels: Vec<Option<u8>> = values
                .iter()
                .map(|value| value.map(|v| level(scale.fraction(v))))
                .collect();
            for (start, length, level) in runs(&levels) {
                let path = paths.entry(level).or_default();
                path.push_str(&format!("M{start} {row}h{length}v1h-{length}z"));
            }
        }
        canvas.start_mosaic(frame.area, size);
        for (level, path) in paths {
            canvas.shape(&path, &level_colour(level), &Pen::solid("none", 0.0));
        }
        canvas.end_group();
    }

    fn draw_bar(&self, canvas: &mut Canvas, frame: &Frame) -> Result<(), PlotError> {
        let bar = Area {
            left: frame.area.right() + BAR_GAP,
            width: BAR_WIDTH,
            ..frame.area
        };
        draw_colour_bar(canvas, bar, &self.colour_axis())
    }

    fn colour_axis(&self) -> Axis {
        Axis::linear(self.colours.label.clone(), self.colours.range)
    }
}

/// A bar that shows all colours, with its axis on the right.
pub(crate) fn draw_colour_bar(
    canvas: &mut Canvas,
    bar: Area,
    axis: &Axis,
) -> Result<(), PlotError> {
    canvas.start_mosaic(bar, [bar.width, bar.height / f64::from(LEVELS)]);
    for level in 0..LEVELS {
        canvas.shape(
            &format!("M0 {level}h1v1h-1z"),
            &level_colour(level),
            &Pen::solid("none", 0.0),
        );
    }
    canvas.end_group();
    canvas.rectangle(bar, "none", &Pen::solid("#000000", 1.0));
    draw_right_axis(canvas, bar, axis)
}

/// Colour of a share between 0 and 1 of the scale.
pub(crate) fn colour_of(share: f64) -> String {
    level_colour(level(share))
}

/// Runs of equal levels as (start, length, level); cells without a level belong to none.
fn runs(levels: &[Option<u8>]) -> Vec<(usize, usize, u8)> {
    let mut start = 0;
    let mut found = Vec::new();
    for run in levels.chunk_by(|a, b| a == b) {
        if let Some(level) = run[0] {
            found.push((start, run.len(), level));
        }
        start += run.len();
    }
    found
}

/// Colour step of a share between 0 and 1 of the scale.
fn level(share: f64) -> u8 {
    (1..LEVELS)
        .take_while(|&next| f64::from(next) <= share * f64::from(LEVELS))
        .last()
        .unwrap_or(0)
}

fn level_colour(level: u8) -> String {
    scale_colour((f64::from(level) + 0.5) / f64::from(LEVELS))
}

/// Exact for any grid that fits into a picture.
#[allow(clippy::cast_precision_loss, reason = "cell counts are far below 2^52")]
fn to_f64(count: usize) -> f64 {
    count as f64
}
