//! Contact in time on any linear viscoelastic half space or layer, step by step.
//!
//! ```text
//! u_new = 2 (1 − ν) α w + H,        w = K P / (4π)        at the end of a step
//! gap = h + u_new − d ≥ 0,   P ≥ 0,   P · gap = 0
//! ```
//! α is the compliance of the step and H the displacement that its end would have without load. A material with retardation
//! elements keeps one history variable per element of the grid and retardation element, and both α and H are exact for any Δt
//! ([`rheology::ExponentialStep`]).
//!
//! Theory: docs/theory/transient-half-space.md.

pub(crate) mod free;
pub(crate) mod periodic;

pub(crate) use free::{BYTES_PER_FOLLOWED_ELEMENT, BYTES_PER_STEP, MARCH_WORK_EXPONENT, MAX_STEPS};
pub use free::{March, Motion, MotionRow};
