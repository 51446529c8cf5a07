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

impl RelaxationSpectrum {
    /// The same material, described by its creep.
    ///
    /// # Errors
    /// [`RheologyError`] when a compliance or a time of it is outside the range of `f64`.
    pub fn to_creep(&self) -> Result<CreepSpectrum, RheologyError> {
        let branches = self.branches().iter();
        let decays = branches.map(|b| (b.relaxation_time, b.viscosity()));
        let roots = roots(&poles(self.viscosity(), decays), self.equilibrium_modulus());
        let elements = roots.into_iter().map(|root| RetardationElement {
            compliance: root.relative_inverse_slope,
            retardation_time: root.position,
        });
        let fluidity = if self.equilibrium_modulus() > 0.0 {
            0.0
        } else {
            self.zero_shear_viscosity().recip()
        };
        // An infinite glass modulus leaves no compliance to the first instant.
        let instantaneous = self.glass_modulus().recip();
        CreepSpectrum::new(instantaneous, fluidity, elements.collect())
    }
}

impl CreepSpectrum {
    /// The same material, described by its relaxation.
    ///
    /// # Errors
    /// [`RheologyError`] when a modulus or a time of it is outside the range of `f64`.
    pub fn to_relaxation(&self) -> Result<RelaxationSpectrum, RheologyError> {
        let elements = self.elements().iter();
        let decays = elements.map(|e| (e.retardation_time, e.compliance));
        let poles = poles(self.instantaneous_compliance(), decays);
        let roots = roots(&poles, self.fluidity());
        let branches = roots.into_iter().map(|root| {
            RelaxationBranch::new(root.relative_inverse_slope / root.position, root.position)
        });
        let viscosity = if self.instantaneous_compliance() > 0.0 {
            0.0
        } else {
            self.initial_fluidity().recip()
        };
        // An infinite compliance leaves no modulus to the end.
        let equilibrium = self.equilibrium_compliance().recip();
        RelaxationSpectrum::new(equilibrium, viscosity, branches.collect())
    }
}

/// The poles of a spectrum; `at_zero` is the weight of the one at zero, if there is one.
fn poles(at_zero: f64, decays: impl Iterator<Item = (f64, f64)>) -> Vec<Pole> {
    let lone = (at_zero > 0.0).then_some((0.0, at_zero));
    let poles = lone.into_iter().chain(decays);
    let poles = poles.map(|(position, weight)| Pole { position, weight });
    poles.collect()
}
