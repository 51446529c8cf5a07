//! Pictures of curves and fields: a [`Figure`] becomes a [`Drawing`], which is an SVG text, and that a PNG.
//!
//! The module draws what it is given or refuses: a point that is not finite or lies outside its axis is a
//! [`error::PlotError`], never dropped, clamped or clipped.
//! Output is the same byte for byte from run to run and does not depend on installed fonts.
//!
//! Axes, marks and legend are drawn here, because libraries for charts clamp or clip what lies outside, or have no legend
//! samples with line and marker together. Texts are laid out letter by letter: they are short, and a library that shapes
//! them takes longer to compile than all solvers of the workspace.

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
pub(crate) use canvas::Drawing;
pub(crate) use chart::Chart;
pub(crate) use colour::Colour;
pub(crate) use figure::{Figure, Panel, draw};
pub(crate) use legend::LegendPlace;
pub(crate) use map::{ColourScale, Map};
pub(crate) use matrix::{Cell, Matrix, MatrixRow};
pub(crate) use png::{PNG_WIDTH, render_png};
pub(crate) use series::{Dash, Line, Marker, Series, Shape};
