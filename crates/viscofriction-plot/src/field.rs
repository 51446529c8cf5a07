//! Fields: values on a rectangular grid as colours, with a colour bar.

use crate::axis::{Axis, Scale};
use crate::canvas::{Area, Canvas, FRAME_PEN};
use crate::colour::{LEVELS, level_at, level_colour};
use crate::error::PlotError;
use crate::frame::{AxisEdge, Edge, TickSide, side_margin};
use crate::raster::Raster;

/// Values on a rectangular grid that fills the ranges of both axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Number of cells along x.
    columns: usize,
    /// Values row by row from the lowest y, each row from the lowest x.
    values: Vec<Option<f64>>,
    /// Colour scale, drawn as the axis of the bar.
    colours: Axis,
    /// True if the cells fill the panel, instead of having the proportions of the axes.
    is_stretched: bool,
}

/// Distance of the colour bar from the data rectangle, \[px\].
const BAR_GAP: f64 = 12.0;
/// Width of the colour bar, \[px\].
const BAR_WIDTH: f64 = 14.0;

/// Largest number of pixels of the image of a field along an axis (chosen: twice those of a picture at its usual size).
const MAX_PIXELS: u32 = 1024;

impl Field {
    /// Field of `[columns, rows]` cells; `value` gets the column from the lowest x and the row from the lowest y.
    ///
    /// Cells without a value stay white. The colours range from dark blue to yellow.
    pub fn new(
        [columns, rows]: [usize; 2],
        colours: Axis,
        value: impl Fn(usize, usize) -> Option<f64>,
    ) -> Self {
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        Self {
            columns,
            values: cells.map(|(column, row)| value(column, row)).collect(),
            colours,
            is_stretched: false,
        }
    }

    /// The field stretched to fill the panel, for axes of different units; otherwise both axes have the same scale.
    #[must_use]
    pub fn stretched(self) -> Self {
        Self {
            is_stretched: true,
            ..self
        }
    }

    /// Refuses a grid without cells, values outside the colour scale, and logarithmic axes of a field that is not stretched.
    pub(crate) fn validate(&self, axes: [&Axis; 2]) -> Result<(), PlotError> {
        let logarithmic = axes.into_iter().find(|axis| axis.scale == Scale::Log10);
        if let Some(axis) = logarithmic.filter(|_| !self.is_stretched) {
            return Err(axis.refused("be linear, because the field has true proportions"));
        }
        let label = &self.colours.label;
        if self.values.is_empty() {
            return Err(PlotError::Empty(format!("the grid of '{label}'")));
        }
        self.colours.validate()?;
        let mut values = self.values.iter().enumerate();
        values.try_for_each(|(index, value)| {
            value.map_or(Ok(()), |value| self.colours.check(value, label, index))
        })
    }

    /// Width of the colour bar with its axis on the right, \[px\].
    pub(crate) fn right_margin(&self) -> Result<f64, PlotError> {
        Ok(BAR_GAP + BAR_WIDTH + side_margin(&self.colours)?)
    }

    /// Width and height of the data rectangle \[px\], at most `largest`, in which both axes have one scale unless the field
    /// is stretched.
    pub(crate) fn size(&self, axes: [&Axis; 2], largest: [f64; 2]) -> [f64; 2] {
        if self.is_stretched {
            return largest;
        }
        let spans = axes.map(|axis| axis.range[1] - axis.range[0]);
        let scale = (largest[0] / spans[0]).min(largest[1] / spans[1]);
        spans.map(|span| scale * span)
    }

    /// Draws the values as an image with a pixel per cell, or per several neighbouring cells where there are more than
    /// [`MAX_PIXELS`] along an axis; such a pixel has the mean of those cells that have a value.
    pub(crate) fn draw(&self, canvas: &mut Canvas, area: Area) -> Result<(), PlotError> {
        let cells = [self.columns, self.values.len() / self.columns];
        let pixels = cells
            .map(|count| u32::try_from(count).map_or(MAX_PIXELS, |count| count.min(MAX_PIXELS)));
        // First cell of a pixel along an axis; that of the next pixel ends it.
        let first = |axis: usize, pixel: u32| pixel as usize * cells[axis] / pixels[axis] as usize;
        let colour = |column: u32, row: u32| {
            let rows = first(1, row)..first(1, row + 1);
            let columns = first(0, column)..first(0, column + 1);
            let values = rows.flat_map(|row| &self.values[row * self.columns..][columns.clone()]);
            let (count, sum) = values
                .flatten()
                .fold((0.0, 0.0), |(count, sum), value| (count + 1.0, sum + value));
            (count > 0.0).then(|| level_colour(level_at(self.colours.fraction(sum / count))))
        };
        canvas.image(Raster::new(area, pixels, colour)?)
    }

    /// Draws the colour bar next to the data rectangle, with its axis on the right.
    pub(crate) fn draw_bar(&self, canvas: &mut Canvas, data_area: Area) -> Result<(), PlotError> {
        let area = Area {
            left: data_area.right() + BAR_GAP,
            width: BAR_WIDTH,
            ..data_area
        };
        let colour = |_, level: u32| u8::try_from(level).ok().map(level_colour);
        canvas.image(Raster::new(area, [1, u32::from(LEVELS)], colour)?)?;
        canvas.rectangle(area, "none", &FRAME_PEN);
        AxisEdge::new(&self.colours, area, Edge::Right)?.draw(canvas, TickSide::Outside);
        Ok(())
    }
}
