//! What the kinds of panels have in common.

use crate::PlotError;
use crate::canvas::{Canvas, Pixel};

/// Width of every panel but a matrix, \[px\].
pub(crate) const PANEL_WIDTH: f64 = 480.0;

/// What every kind of panel does; lengths are in \[px\].
pub(crate) trait Draw {
    /// Refuses data that cannot be drawn faithfully.
    fn validate(&self) -> Result<(), PlotError>;

    /// Width of the whole panel.
    fn width(&self) -> f64 {
        PANEL_WIDTH
    }

    /// Room that the left side needs.
    fn left_margin(&self) -> Result<f64, PlotError>;

    /// Height of the whole panel with so much room on its left side.
    fn height(&self, left: f64) -> Result<f64, PlotError>;

    /// Draws the panel with its upper left corner at `origin`.
    fn draw(&self, canvas: &mut Canvas, origin: Pixel, left: f64) -> Result<(), PlotError>;
}
