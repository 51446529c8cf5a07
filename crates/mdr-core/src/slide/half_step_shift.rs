//! What a step in time does to the memory of a material.
//!
//! In a step of a chain the load of an element is constant, and has been so from the beginning of the step on. The part of
//! the compliance that creeps therefore runs ahead, by half a step where all of the load belongs to the end of the step:
//!
//! ```text
//! J(t) → J₀ + [J(t + s Δt/2) − J₀],     s = J₀/α
//! ```
//!
//! with α the compliance of the step, so that s is the share of the load that belongs to its end and not to the motion
//! during it. That is a creep compliance again. A chain of this material is ahead twice, and differs from the chain of the
//! material itself by what the step does, to first order in the step.

use rheology::{Compressible, CreepSpectrum, ExponentialStep, Material, Prony, RetardationElement};

use crate::MdrError;

/// Whether a step changes the memory of a material: not without memory, nor without a spring that acts at once.
pub(super) fn depends_on_step(creep: &CreepSpectrum) -> bool {
    !creep.is_elastic() && creep.instantaneous_compliance() > 0.0
}

/// The material whose memory is ahead by what a step \[s] does; none for one without memory or without a spring.
pub(super) fn half_step_shifted(
    material: &dyn Material,
    time_step: f64,
) -> Result<Option<Compressible>, MdrError> {
    let creep = material.creep();
    let at_once = creep.instantaneous_compliance();
    if !depends_on_step(&creep) {
        return Ok(None);
    }
    let share = at_once / ExponentialStep::creep(&creep, time_step)?.response();
    let by = 0.5 * share * time_step;
    let left = |element: &RetardationElement| RetardationElement {
        compliance: element.compliance * (-by / element.retardation_time).exp(),
        ..*element
    };
    let elements = creep.elements().iter().map(left).collect();
    let creep = CreepSpectrum::new(creep.creep_compliance(by)?, creep.fluidity(), elements)?;
    let chain = Prony::from_creep(creep)?;
    Ok(Some(Compressible::new(&chain, material.poisson_ratio())?))
}
