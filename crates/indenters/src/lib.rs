//! Rigid indenters: their profiles, the equivalent lines of the method of dimensionality reduction, and the part of a
//! moving line that touches.
//!
//! A body of revolution `h(r)` ([`Axisymmetric`]) is replaced by a line `h̃(x)` ([`RigidLine`]) that has the same
//! contact in one dimension. All lengths are in metres.
//!
//! The equivalent line of a cone is steeper by κ₁ = π/2, that of a paraboloid by κ₂ = 2 (Kürschner 2014, Eq. 9):
//!
//! ```
//! use indenters::{AnalyticLine, Axisymmetric, PowerProfile, contact_line, contact_radius};
//!
//! # fn main() -> Result<(), indenters::IndenterError> {
//! let cone = PowerProfile::cone(0.1)?;
//! assert!((cone.line_slope(0.02) - 0.1 * std::f64::consts::FRAC_PI_2).abs() < 1e-15);
//!
//! let paraboloid = PowerProfile::paraboloid(50.0)?;
//! let depth = 1e-3;
//! let radius = contact_radius(&paraboloid, depth)?;
//! assert!((radius / (depth / (2.0 * 50.0)).sqrt() - 1.0).abs() < 1e-12);
//!
//! // Definition 2: a line with a dip touches on two intervals, [0, 1/2[ and [2, 5/2].
//! let height = |x: f64| x * (x * (x / 3.0 - 1.5) + 2.0);
//! let line = AnalyticLine::new(height, |x| (x - 1.0) * (x - 2.0), [0.0, 3.0])?;
//! assert_eq!(contact_line(&line, 5.0 / 6.0)?.intervals.len(), 2);
//! # Ok(())
//! # }
//! ```
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

// The code does not use this crate itself; its features choose the backend with which `zip` inflates archives.
#[cfg(feature = "topography")]
use flate2 as _;

mod analytic_line;
mod axisymmetric;
mod contact_radius;
mod cylinder;
mod equivalent_profile;
mod error;
mod extent;
mod flat_ended;
mod height_map;
mod inverse_abel;
mod leading_edge;
mod line;
mod load;
mod motion_shear;
mod moved;
mod moving;
mod moving_steps;
mod piecewise_linear;
mod power;
#[doc(hidden)]
pub mod revolution;
mod right_triangle;
#[cfg(feature = "rough")]
pub mod rough;
mod round_tipped;
mod sampled_line;
mod shape;
mod sphere;
mod spheroid;
mod stretch;
mod superposition;
mod surface;
mod table;
pub mod topography;

/// The example in the README, compiled as a doc test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;

pub use analytic_line::AnalyticLine;
pub use axisymmetric::{Axisymmetric, Kink, LinePoint, ProfilePoint, abel_height, abel_slope};
pub use contact_radius::{contact_radius, line_radius};
pub use cylinder::Cylinder;
pub use equivalent_profile::EquivalentProfile;
pub use error::IndenterError;
pub use flat_ended::{FlatCone, FlatPunch, TruncatedParaboloid};
pub use height_map::HeightMap;
pub use inverse_abel::inverse_abel;
pub use leading_edge::{ContactLine, LeadingEdge, contact_line, leading_edge, leading_edge_with};
pub use line::{EquivalentLine, RigidLine};
pub use load::{Control, HistoryPoint, PressingLoad, SlidingLoad};
pub use motion_shear::FrictionParts;
pub use moved::{MotionRecord, MotionStep, MotionView, Moved, MovedPoint};
pub use moving::{MovingLoad, MovingPoint, Shape, Stage, Stroke};
pub use moving_steps::MovingStep;
pub use numerics::InvalidParameter;
pub use piecewise_linear::PiecewiseLinearProfile;
pub use power::PowerProfile;
pub use round_tipped::{Hyperboloid, RoundTippedCone};
pub use sampled_line::SampledLine;
pub use sphere::Sphere;
pub use spheroid::Spheroid;
pub use stretch::stretch;
pub use superposition::{PowerTerm, Superposition};
pub use surface::{Surface, Unmirrored, check_lowest_point, checked_height};
