//! Exact conversion between relaxation and creep.
//!
//! ```text
//! Q(λ) = s Ĝ(s) at s = −1/λ:    Q(λ)   = G_∞ − η₀/λ − Σ G_i τ_i/(λ − τ_i)
//! s Ĝ(s) · s Ĵ(s) = 1:          1/Q(λ) = J₀ − λ/η_f + Σ J_j λ/(λ − λ_j)
//! ```
//! The retardation times are the zeros of Q, J_j λ_j = 1/Q'(λ_j); the relaxation times are the zeros of 1/Q, with
//! −G_i τ_i the residues there. Both are the equation of [`super::secular`], where a lone dashpot, or a lone
//! spring in series, is a pole at zero (Gross 1953, Mathematical Structure of the Theories of Viscoelasticity).

use super::secular::{Pole, roots};
use crate::{
    CreepSpectrum, RelaxationBranch, RelaxationSpectrum, RetardationElement, RheologyError,
};

pub(super) fn creep_of(relaxation: &RelaxationSpectrum) -> Result<CreepSpectrum, RheologyError> {
    let decays = relaxation
        .branches()
        .iter()
        .map(|b| (b.relaxation_time, b.viscosity()));
    let poles = poles(relaxation.viscosity(), decays);
    let elements = roots(&poles, relaxation.equilibrium_modulus())
        .into_iter()
        .map(|root| RetardationElement {
            compliance: root.inverse_slope / root.position,
            retardation_time: root.position,
        });
    let fluidity = if relaxation.equilibrium_modulus() > 0.0 {
        0.0
    } else {
        relaxation.zero_shear_viscosity().recip()
    };
    // An infinite glass modulus leaves no compliance to the first instant.
    let instantaneous = relaxation.glass_modulus().recip();
    CreepSpectrum::new(instantaneous, fluidity, elements.collect())
}

pub(super) fn relaxation_of(creep: &CreepSpectrum) -> Result<RelaxationSpectrum, RheologyError> {
    let decays = creep
        .elements()
        .iter()
        .map(|e| (e.retardation_time, e.compliance));
    let poles = poles(creep.instantaneous_compliance(), decays);
    let branches = roots(&poles, creep.fluidity())
        .into_iter()
        .map(|root| RelaxationBranch {
            modulus: root.inverse_slope / root.position / root.position,
            relaxation_time: root.position,
        });
    let viscosity = if creep.instantaneous_compliance() > 0.0 {
        0.0
    } else {
        creep.initial_fluidity().recip()
    };
    // An infinite compliance leaves no modulus to the end.
    let equilibrium = creep.equilibrium_compliance().recip();
    RelaxationSpectrum::new(equilibrium, viscosity, branches.collect())
}

/// The poles of a spectrum; `at_zero` is the weight of the one at zero, if there is one.
fn poles(at_zero: f64, decays: impl Iterator<Item = (f64, f64)>) -> Vec<Pole> {
    let lone = (at_zero > 0.0).then_some((0.0, at_zero));
    lone.into_iter()
        .chain(decays)
        .map(|(position, weight)| Pole { position, weight })
        .collect()
}
