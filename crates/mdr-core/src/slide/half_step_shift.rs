//! Error of the step in time, from a material whose creep is shifted by half a step.
//!
//! The load of an element is constant over a step, from the beginning of the step on. Creep is therefore too early, by half a
//! step if all of the load belongs to the end of the step:
//!
//! ```text
//! J(t) → J₀ + [J(t + s Δt/2) − J₀],     s = J₀/α
//! ```
//!
//! with α the compliance of the step, so that s is the share of the load that belongs to its end and not to the motion
//! during it. This is a creep compliance again. A march on this material has the shift twice. Its difference from the march on
//! the material itself is the error of the step, to first order.

use rheology::{Compressible, CreepSpectrum, ExponentialStep, Material, Prony, RetardationElement};

use crate::MdrError;

/// Whether the result depends on the time step: not if the material is elastic, or has no instantaneous compliance.
pub(super) fn depends_on_step(creep: &CreepSpectrum) -> bool {
    !creep.is_elastic() && creep.instantaneous_compliance() > 0.0
}

/// The material whose creep is shifted by the effect of a step \[s]; `None` if the result does not depend on the step.
pub(super) fn half_step_shifted(
    material: &dyn Material,
    time_step: f64,
) -> Result<Option<Compressible>, MdrError> {
    let creep = material.creep();
    let instantaneous = creep.instantaneous_compliance();
    if !depends_on_step(&creep) {
        return Ok(None);
    }
    let share = instantaneous / ExponentialStep::creep(&creep, time_step)?.response();
    let shift = 0.5 * share * time_step;
    let shifted = |element: &RetardationElement| RetardationElement {
        compliance: element.compliance * (-shift / element.retardation_time).exp(),
        ..*element
    };
    let elements = creep.elements().iter().map(shifted).collect();
    let creep = CreepSpectrum::new(creep.creep_compliance(shift)?, creep.fluidity(), elements)?;
    let material_of_creep = Prony::from_creep(creep)?;
    Ok(Some(Compressible::new(
        &material_of_creep,
        material.poisson_ratio(),
    )?))
}
