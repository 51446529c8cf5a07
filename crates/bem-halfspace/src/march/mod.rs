//! Contact in time on any linear viscoelastic half space or layer, step by step.
//!
//! ```text
//! u_new = 2 (1 − ν) α w + H,        w = K P / (4π)        at the end of a step
//! gap = h + u_new − d ≥ 0,   P ≥ 0,   P · gap = 0
//! ```
//! P is the pressure, K the operator of the influence coefficients without the compliance of the material, w the load potential and
//! ν the Poisson ratio; h is the height of the indenter and d its depth. α is the compliance of the step, the creep compliance J(Δt)
//! for a load that is held over it, and H the displacement at its end without load. Both are exact for any duration Δt of the step
//! ([`rheology::ExponentialStep`]). H follows from the history variables of each element.
//! Every step is an elastic contact of compliance 2 (1 − ν) α under an indenter of height h + H, after which the history
//! variables are advanced by w.
//!
//! Free bodies ([`free`]) and periodic surfaces ([`periodic`]) differ in the elements that are followed, and in how the heights
//! and slopes of the surface are found at the end of a step.
//!
//! Theory: docs/theory/transient-half-space.md.

pub(crate) mod free;
pub(crate) mod periodic;

use indenters::Surface;
use rheology::CreepSpectrum;

use crate::GridOptions;
pub use free::{March, Motion, MotionRow};

/// Largest number of steps of a march, or of one cycle of it. Chosen to limit the time, which grows in proportion to it: a march
/// of more steps is refused as [`BemError::TooManySteps`](crate::BemError::TooManySteps).
pub(crate) const MAX_STEPS: f64 = 1e5;
/// Upper bound of the memory per followed element without its history variables, \[bytes]. Measured: tests compare the bound of a
/// march with the memory it takes (tests/it/memory.rs).
const BYTES_PER_FOLLOWED_ELEMENT: f64 = 150.0;
/// Upper bound of the memory per step of a march, for its schedule and its row of results, \[bytes]. Measured: tests compare the
/// bound of a march with the memory it takes (tests/it/memory.rs).
const BYTES_PER_STEP: f64 = 600.0;

/// Extent of a march along the surface, for an estimate of its memory.
pub(crate) struct MarchExtent {
    /// Length of the surface behind the footprint whose history is stored, \[m].
    pub(crate) passed_length: f64,
    /// Numbers stored for each element: history variables, and copies of them.
    pub(crate) numbers_per_element: usize,
    /// Number of steps in time.
    pub(crate) n_steps: f64,
}

impl MarchExtent {
    /// Upper bound of the memory of the march on a grid, \[bytes].
    pub(crate) fn memory(&self, surface: &dyn Surface, options: &GridOptions) -> f64 {
        let ([dx, dy], footprint) = (options.spacing, &options.footprint);
        let across = (footprint.y[1] - footprint.y[0]) / dy;
        let n_elements = footprint.n_elements([dx, dy]) + self.passed_length / dx * across;
        // If the surface is its own mirror image about y = 0, only the half y ≥ 0 is followed.
        let followed = if surface.mirrors()[1] { 0.5 } else { 1.0 };
        let history = (self.numbers_per_element * size_of::<f64>()) as f64;
        (BYTES_PER_FOLLOWED_ELEMENT + history) * (followed * n_elements)
            + BYTES_PER_STEP * self.n_steps
    }
}

/// Number of history variables of an element under loads that are held over each step: one per retardation element, and one for free
/// flow.
pub(crate) fn n_history_variables(creep: &CreepSpectrum) -> usize {
    creep.elements().len() + usize::from(creep.fluidity() > 0.0)
}

/// Largest retardation time λ of a creep spectrum, \[s]; 0 for a spectrum without retardation elements.
pub(crate) fn largest_retardation_time(creep: &CreepSpectrum) -> f64 {
    let slowest = creep.elements().last();
    slowest.map_or(0.0, |element| element.retardation_time)
}
