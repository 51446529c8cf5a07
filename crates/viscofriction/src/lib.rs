//! Friction of rigid bodies that slide over rubber and other viscoelastic materials.
//!
//! A [`Scene`] describes the body, the material, the motion and the requested accuracy; as a text it is a scene file of the
//! program `viscofriction`. [`solve`](fn@solve) chooses the cheapest method that answers it and returns an [`Answer`] with its
//! errors. The model is the half space unless the scene requests the one-dimensional model (`model = "line"`). [`sweep`] solves
//! a scene for many values of its keys.
//!
//! The five underlying crates can be used alone and are re-exported: [`indenters`] and [`rheology`] for bodies and
//! materials, [`friction_analytic`], [`mdr_core`] and [`bem_halfspace`] for the three methods.
//!
//! Example: a rigid ball on rubber with one relaxation time, on the half space.
//!
//! ```
//! use viscofriction::{Problem, Scene, solve};
//!
//! let scene: Scene = r#"
//!     indenter.sphere = { radius = 5e-3 }
//!     material.prony = { equilibrium_modulus = 1e6, branches = [{ modulus = 1e7, relaxation_time = 1e-3 }] }
//!     load = { normal_force = 2.0, velocity = 0.1 }
//! "#
//! .parse()?;
//! let answer = solve(&Problem::try_from(&scene)?)?;
//! let friction = answer.friction_coefficient.expect("it slides");
//! assert!(friction.is_within(1e-3), "{} ± {}", friction.value, friction.error);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

mod files;
#[cfg(feature = "fit")]
pub mod friction_fit;
pub mod npy;
pub mod quantity;
pub mod scene;
pub mod solve;
pub mod sweep;
mod text;

/// The programs of this page compile and run.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/rust.md")]
struct FromRust;

#[cfg(all(doctest, feature = "fit"))]
#[doc = include_str!("../../../docs/own-material.md")]
struct OwnMaterial;

/// The program of this page compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;

pub use bem_halfspace::slide::PressureField;
pub use files::{Files, ReadFile};
pub use numerics::{ErrorParts, Estimate, Progress};
pub use quantity::{ByQuantity, QUANTITIES, Quantity};
pub use scene::Scene;
pub use solve::{
    Answer, Body, ContactBox, Fields, HistoryRow, Motion, NotOffered, Omission, Plan, Problem,
    Revolution, SolveError, Warning, plan, plan_of, problem_of, solve, with_fields,
};
pub use text::{WrongInput, line_of};
pub use {bem_halfspace, friction_analytic, indenters, mdr_core, numerics, rheology};
