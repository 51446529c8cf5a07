//! Exact conversion between relaxation and creep.
//!
//! ```text
//! Q(λ) = s Ĝ(s) at s = −1/λ:    Q(λ)   = G_∞ − η₀/λ − Σ G_i τ_i/(λ − τ_i)
//! s Ĝ(s) · s Ĵ(s) = 1:          1/Q(λ) = J₀ − λ/η_f + Σ J_j λ/(λ − λ_j)
//! ```
//! The retardation times are the zeros of Q, with J_j λ_j = 1/Q'(λ_j). The relaxation times are the poles of Q, with the
//! residues −G_i τ_i. Both follow from the equation of [`super::secular`], in which a lone dashpot, or a lone spring in
//! series, is a pole at zero (Gross 1953, Mathematical Structure of the Theories of Viscoelasticity).

use super::secular::{Pole, roots};
use crate::{
    CreepSpectrum, RelaxationBranch, RelaxationSpectrum, RetardationElement, RheologyError,
};

impl RelaxationSpectrum {
    /// Creep spectrum of the same material.
    ///
    /// # Errors
    /// [`RheologyError`] when a compliance or a retardation time overflows or underflows.
    pub fn to_creep(&self) -> Result<CreepSpectrum, RheologyError> {
        let branches = self.branches().iter();
        let poles_of_branches = branches.map(|branch| Pole {
            position: branch.relaxation_time,
            weight: branch.viscosity(),
        });
        let poles = poles(self.viscosity(), poles_of_branches);
        let roots = roots(&poles, self.equilibrium_modulus());
        let elements = roots.into_iter().map(|root| RetardationElement {
            compliance: root.relative_inverse_slope,
            retardation_time: root.position,
        });
        let fluidity = if self.equilibrium_modulus() > 0.0 {
            0.0
        } else {
            self.zero_shear_viscosity().recip()
        };
        // An infinite instantaneous modulus gives the instantaneous compliance 0.
        let instantaneous = self.glass_modulus().recip();
        CreepSpectrum::new(instantaneous, fluidity, elements.collect())
    }
}

impl CreepSpectrum {
    /// Relaxation spectrum of the same material.
    ///
    /// # Errors
    /// [`RheologyError`] when a modulus or a relaxation time overflows or underflows.
    pub fn to_relaxation(&self) -> Result<RelaxationSpectrum, RheologyError> {
        let elements = self.elements().iter();
        let poles_of_elements = elements.map(|element| Pole {
            position: element.retardation_time,
            weight: element.compliance,
        });
        let poles = poles(self.instantaneous_compliance(), poles_of_elements);
        let roots = roots(&poles, self.fluidity());
        let branches = roots.into_iter().map(|root| {
            RelaxationBranch::new(root.relative_inverse_slope / root.position, root.position)
        });
        let viscosity = if self.instantaneous_compliance() > 0.0 {
            0.0
        } else {
            self.initial_fluidity().recip()
        };
        // An infinite equilibrium compliance gives the equilibrium modulus 0.
        let equilibrium = self.equilibrium_compliance().recip();
        RelaxationSpectrum::new(equilibrium, viscosity, branches.collect())
    }
}

/// Poles of a spectrum; `weight_at_zero` is the weight of the pole at zero, 0 without one.
fn poles(weight_at_zero: f64, others: impl Iterator<Item = Pole>) -> Vec<Pole> {
    let at_zero = (weight_at_zero > 0.0).then_some(Pole {
        position: 0.0,
        weight: weight_at_zero,
    });
    at_zero.into_iter().chain(others).collect()
}
