//! Temperature of the surface of a half space under heat sources that move with a body.
//!
//! A heat flux is fixed to the rigid body, which moves along +x over the elastomer; apart from the flux the surface is insulated. In
//! the frame of the body a point source of the power Q at the depth z heats the surface at the distance (x, y) from it by
//!
//! ```text
//! T = Q/(2πkR) exp(−v (R + x)/(2D)),   R² = x² + y² + z²          (Jaeger 1942; Carslaw & Jaeger 1959, § 10.7)
//! ```
//!
//! and the wave of the wave vector q of a flux by `T̂ = Q̂/(kβ)` with `β² = q² − i q_x v/D` (Persson 2006). The surface is hot behind
//! the flux, at smaller x. Fluxes are constant per element, and temperatures are those of the centres of the elements.
//!
//! ```
//! use bem_halfspace::Grid;
//! use bem_halfspace::heat::{ContactKind, Counterface, HeatConductor, HeatSource, SourceDepth};
//! use bem_halfspace::heat::SurfaceTemperature;
//!
//! // A uniform flux on a disc of the radius 1 mm at rest: the largest rise is q a/k.
//! let (rubber, radius, flux) = (HeatConductor::new(0.25, 1.2e-7)?, 1e-3, 1e4);
//! let grid = Grid::new([64; 2], [radius / 32.0; 2])?;
//! let flux_of = |index: usize| {
//!     let [x, y] = [index / 64, index % 64].map(|number| (number as f64 - 31.5) / 32.0);
//!     if x * x + y * y < 1.0 { flux } else { 0.0 }
//! };
//! let disc: Vec<f64> = (0..grid.n_elements()).map(flux_of).collect();
//! let source = HeatSource { flux: &disc, depth: &SourceDepth::Surface };
//! let rise = SurfaceTemperature::new(&grid, ContactKind::Body, &rubber, 0.0)?;
//! let rise = rise.of(&[source], Counterface::Insulating)?;
//! assert!((rise.largest.value / (flux * radius / 0.25) - 1.0).abs() < 3e-3, "{}", rise.largest);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Theory: docs/theory/heat.md.

mod bulk;
mod conductor;
mod contact;
mod contact_kind;
mod depth;
mod depth_below_body;
mod operator;
mod periodic_waves;
mod rise;
mod source;
mod time_rule;

pub use conductor::{HeatCapacity, HeatConductor};
pub use contact::SlidingContact;
pub use contact_kind::ContactKind;
pub use depth::{DepthProfile, DepthRise};
pub use rise::{SurfaceTemperature, TemperatureRise};
pub use source::{Counterface, DissipatingWave, DissipationProfile, HeatSource, SourceDepth};
