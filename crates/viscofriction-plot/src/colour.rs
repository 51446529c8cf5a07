//! Colours that stay apart for colour-blind readers.

use colorous::VIRIDIS;

use crate::axis::Axis;
use crate::canvas::{Area, Canvas, FRAME_PEN};
use crate::error::PlotError;
use crate::frame::{AxisEdge, Edge, side_margin};

/// Line and marker colours: Okabe and Ito's palette, with a magenta dark enough for thin lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Colour {
    /// #0072B2.
    Blue,
    /// #D55E00 (vermilion).
    Red,
    /// #009E73 (bluish).
    Green,
    /// #AA3377.
    Magenta,
    /// #000000.
    Black,
    /// #b0b0b0, for areas only.
    Grey,
}

impl Colour {
    /// Value as #rrggbb.
    pub(crate) const fn hex(self) -> &'static str {
        match self {
            Self::Blue => "#0072b2",
            Self::Red => "#d55e00",
            Self::Green => "#009e73",
            Self::Magenta => "#aa3377",
            Self::Black => "#000000",
            Self::Grey => "#b0b0b0",
        }
    }
}

/// Linear scale from dark blue to yellow.
#[derive(Debug, Clone, PartialEq)]
pub struct ColourScale {
    /// Quantity and unit.
    pub label: String,
    /// Values of the darkest and the brightest colour.
    pub range: [f64; 2],
}

/// Number of distinct colours: fine enough for the eye, coarse enough for a small file.
const LEVELS: u8 = 100;
const BAR_WIDTH: f64 = 14.0;

impl ColourScale {
    /// Scale of a quantity over a range.
    pub fn new(label: impl Into<String>, range: [f64; 2]) -> Self {
        let label = label.into();
        Self { label, range }
    }

    /// Refuses a range or a value that has no colour.
    pub(crate) fn validate(
        &self,
        values: impl Iterator<Item = Option<f64>>,
    ) -> Result<(), PlotError> {
        let axis = self.axis();
        axis.validate()?;
        for (index, value) in values.enumerate() {
            value.map_or(Ok(()), |value| axis.check(value, &self.label, index))?;
        }
        Ok(())
    }

    /// Colour step of a value on the scale.
    pub(crate) fn level(&self, value: f64) -> u8 {
        let share = self.axis().fraction(value);
        (1..LEVELS)
            .take_while(|&next| f64::from(next) <= share * f64::from(LEVELS))
            .last()
            .unwrap_or(0)
    }

    /// Width of the bar and its axis, \[px\].
    pub(crate) fn bar_width(&self) -> Result<f64, PlotError> {
        Ok(BAR_WIDTH + side_margin(&self.axis())?)
    }

    /// Draws a bar of all colours, with its axis on the right.
    pub(crate) fn draw_bar(
        &self,
        canvas: &mut Canvas,
        left: f64,
        [top, height]: [f64; 2],
    ) -> Result<(), PlotError> {
        let area = Area {
            left,
            top,
            width: BAR_WIDTH,
            height,
        };
        let step = |level| (level_colour(level), format!("M0 {level}h1v1h-1z"));
        let size = [area.width, area.height / f64::from(LEVELS)];
        canvas.mosaic(area, size, (0..LEVELS).map(step));
        canvas.rectangle(area, "none", &FRAME_PEN);
        AxisEdge::new(&self.axis(), area, Edge::Right)?.draw_alone(canvas)
    }

    fn axis(&self) -> Axis {
        Axis::linear(self.label.clone(), self.range)
    }
}

/// Colour step as #rrggbb.
pub(crate) fn level_colour(level: u8) -> String {
    let share = (f64::from(level) + 0.5) / f64::from(LEVELS);
    format!("#{:x}", VIRIDIS.eval_continuous(share))
}
