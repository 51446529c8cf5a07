//! Charts of curves and fields: [`draw`] makes an SVG [`Drawing`] of a [`Figure`], and [`render_png`] a PNG of it.
//!
//! Data are drawn faithfully or refused. A point that is not finite or lies outside its axis is a [`PlotError`]; it is never
//! dropped or clamped, and only a [`Series::reference`] is cut at the frame. The output is reproducible to the byte and does not depend on installed fonts.
//!
//! ```
//! use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Series};
//! use viscofriction_plot::{PNG_WIDTH, draw, render_png};
//!
//! let points = vec![[1e-3, 0.01], [1e-2, 0.1], [1e-1, 0.16]];
//! let curve = Series::line(points, Line::thick(Dash::Solid), Colour::Blue);
//! let x = Axis::log10("sliding speed v [m/s]", [1e-3, 1e-1]);
//! let y = Axis::linear("coefficient of friction μ", [0.0, 0.2]);
//! let chart = Chart::new(x, y, vec![curve.labelled("half space")]);
//! let drawing = draw(&Figure::single(chart))?;
//! assert!(drawing.svg.contains("aria-label=\"sliding speed v [mm/s]\""));
//! assert_eq!(render_png(&drawing, PNG_WIDTH)?[1..4], *b"PNG");
//! # Ok::<(), viscofriction_plot::PlotError>(())
//! ```
//!
//! The crate draws axes, marks and legend itself: chart libraries clamp or clip data outside the axes, or lack legend samples
//! with both line and marker. Texts are laid out letter by letter, because a text-shaping library takes longer to compile
//! than all solvers of the workspace.
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

mod axis;
mod canvas;
mod chart;
mod colour;
mod error;
mod field;
mod figure;
mod font;
mod frame;
mod legend;
mod marks;
mod png;
mod raster;
mod series;
mod symbols;
mod ticks;

/// The example in the README, compiled as a doc test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;

pub use axis::{Axis, Scale};
pub use canvas::Drawing;
pub use chart::Chart;
pub use colour::Colour;
pub use error::PlotError;
pub use field::Field;
pub use figure::{Figure, draw};
pub use legend::LegendPlace;
pub use png::{PNG_WIDTH, render_png};
pub use series::{Dash, Fill, Line, Marker, Series, Shape};
