//! Friction of rigid bodies that slide over rubber and other viscoelastic materials.
//!
//! A [`Scene`] describes the body, the material, the motion and the requested accuracy; as a text it is a scene file of the
//! program `viscofriction`. [`solve`](fn@solve) chooses the cheapest method that answers it and returns an [`Answer`] with its
//! errors. The model is the half space unless the scene requests the one-dimensional model (`model = "line"`). [`sweep`] solves
//! a scene for many values of its keys.
//!
//! The underlying crates can be used alone and are re-exported:
//!
//! * [`indenters`]: rigid bodies, from a cone to measured height maps and rough surfaces;
//! * [`rheology`]: linear viscoelastic materials;
//! * [`friction_analytic`]: closed forms of contact and friction, and theories of rough contact;
//! * [`mdr_core`]: the one-dimensional model, the method of dimensionality reduction;
//! * [`bem_halfspace`]: boundary elements on the half space;
//! * [`numerics`]: estimates with errors, requests of an accuracy, quadrature and roots.
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
//! assert!(friction.is_within(1e-3), "{friction}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Accuracy
//!
//! Every computed quantity is an [`Estimate`]: a `value` and an absolute `error` in the same unit, which is 0 for quantities that
//! are given or exact. It is the sum of the errors of discretisation, iteration and time steps, and of the Prony series if it
//! stands for another law; [`Answer::error_parts`] has the parts. `Display` writes an estimate with the digits that are known, such
//! as `0.0384647 ± 0.0000020`.
//!
//! The error does not say whether linear theory holds, or whether the material was measured at the frequencies that matter: the
//! [`Warning`]s in [`Answer::warnings`] do. [`Answer::not_modelled`] names physical effects that are not computed.
//!
//! # Requests
//!
//! A scene requests an accuracy in its table `solve`, [`scene::Solve`]:
//!
//! * `relative_error`: the error of the friction coefficient relative to its value; without sliding that of the depth, of the
//!   force at a given depth, or of the area of a periodic surface. The default is 1e-3. Grids are refined until the error is
//!   small enough. If memory, time steps or rounding prevent it, [`solve`](fn@solve) returns [`SolveError`] with the answer that
//!   was reached, [`SolveError::reached`].
//! * `elements`: a fixed resolution in place of an error. The answer still has an error.
//!
//! [`plan`](fn@plan) chooses the cheapest method of the model that solves the scene, or checks the requested `method`; no other model
//! is used without a request. The functions of the solver crates take the same requests directly, as
//! [`bem_halfspace::steady`](fn@bem_halfspace::steady) does: a relative error, a number of elements by
//! [`Accuracy`](numerics::Accuracy), or both with a [`Progress`] in a [`Request`](numerics::Request).
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

#[doc(inline)]
pub use bem_halfspace::slide::PressureField;
pub use files::{Files, ReadFile};
#[doc(inline)]
pub use numerics::{ErrorParts, Estimate, Progress};
#[doc(inline)]
pub use quantity::{ByQuantity, QUANTITIES, Quantity};
#[doc(inline)]
pub use scene::Scene;
#[doc(inline)]
pub use solve::{
    Answer, Body, ContactBox, Fields, HistoryRow, Motion, NotOffered, Omission, Plan, Problem,
    Revolution, SolveError, Warning, plan, plan_of, problem_of, solve, with_fields,
};
pub use text::{WrongInput, line_of};
pub use {bem_halfspace, friction_analytic, indenters, mdr_core, numerics, rheology};
