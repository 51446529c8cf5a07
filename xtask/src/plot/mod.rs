//! Pictures of curves and fields: a [`Figure`] becomes an SVG text, an SVG text a PNG.
//!
//! The module draws what it is given or refuses: a point that is not finite or lies outside its axis is a
//! [`error::PlotError`], never dropped, clamped or clipped.
//! Output is the same byte for byte from run to run and does not depend on installed fonts.
//!
//! kuva supplies the drawing surface, the SVG writer and the colour map; axes, marks and legend are drawn here,
//! because kuva 0.6 clamps logarithmic coordinates at 1e-10, clips markers at the frame, and has neither open
//! markers nor legend samples with line and marker together.

mod axis;
mod canvas;
mod chart;
mod colour;
mod error;
mod figure;
mod font;
mod frame;
mod legend;
mod map;
mod marks;
mod matrix;
mod png;
mod series;
mod ticks;

pub(crate) use axis::Axis;
pub(crate) use chart::Chart;
pub(crate) use colour::Colour;
pub(crate) use figure::{Figure, Panel, render_svg};
pub(crate) use legend::LegendPlace;
pub(crate) use map::{ColourScale, Map};
pub(crate) use matrix::{Cell, Matrix, MatrixRow};
pub(crate) use png::{PNG_WIDTH, render_png};
pub(crate) use series::{Dash, Line, Marker, Series, Shape};
