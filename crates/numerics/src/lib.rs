//! Numerical methods without physics: quadrature, Fourier transforms, roots, Legendre polynomials, fixed points, least
//! squares, refinement to a requested error, and checks of numbers.
//!
//! ```
//! use numerics::{FIRST_ELEMENTS, Goal, NotReached, Quantity, refine};
//!
//! // The circumference of a circle from polygons, to six digits.
//! let half_perimeter = |corners: usize| -> Result<f64, NotReached> {
//!     let n = corners as f64;
//!     Ok(n * (std::f64::consts::PI / n).sin())
//! };
//! let goal = Goal {
//!     request: 1e-6.into(),
//!     initial_elements: FIRST_ELEMENTS,
//!     max_elements: 100_000,
//!     order: 2.0,
//!     work_exponent: 1.0,
//!     extra_work: 0.0,
//!     selection_factor: 1.0,
//! };
//! let quantities = |value: &f64| vec![Quantity::from(*value)];
//! let pi = refine(&goal, |corners, _| half_perimeter(corners), quantities, |_, _| Ok(vec![]))?;
//! assert!((pi.value - std::f64::consts::PI).abs() < pi.error[0]);
//! assert!(pi.error[0] < 1e-6 * pi.value);
//! # Ok::<(), NotReached>(())
//! ```
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

mod error_parts;
mod estimate;
mod fixed_point;
mod fourier;
mod invalid_parameter;
#[cfg(feature = "least-squares")]
pub mod least_squares;
mod legendre;
mod progress;
mod quadrature;
mod refinement;
mod root;
#[cfg(feature = "transforms")]
pub mod transforms;
pub mod vectors;
mod whole_part;

/// Compiles the program of README.md as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;

pub use error_parts::ErrorParts;
pub use estimate::{Estimate, ValueWithError};
pub use fixed_point::{FixedPoint, MAX_STORED_STATES, anderson_fixed_point};
pub use fourier::fourier_power;
pub use invalid_parameter::{
    InvalidParameter, MessageNumber, Rounded, between_zero_and_one, finite, in_range, not_negative,
    positive,
};
pub use legendre::{LobattoRule, legendre_values, lobatto_rule};
pub use progress::{
    CappedProgress, MaxElements, PartialProgress, Progress, SilentProgress, WorkProgress,
};
pub use quadrature::{NEGLIGIBLE_EXPONENT, integrate, integrate_from_ends};
pub use refinement::{
    Accuracy, FIRST_ELEMENTS, Goal, ITERATION_SHARE, Level, LevelForecast, MIN_CONVERGENCE_ORDER,
    NotReached, Quantity, Refined, Request, SUMMATION_ERROR, refine, refine_levels,
};
pub use root::{bracketed_root, golden_section, try_bracketed_root};
pub use whole_part::whole_part;
