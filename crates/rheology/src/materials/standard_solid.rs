//! The three-element solid of the paper's Fig. 1: a spring parallel to a spring and a dashpot in series.
//!
//! ```text
//! G'(ω) = G₂ (γ + Ω²/(1 + Ω²))    G''(ω) = G₂ Ω/(1 + Ω²)    tan δ = Ω/(Ω² + γ (1 + Ω²))        (2)
//! γ = G₁/G₂    Ω = ω η/G₂
//! ```
//!
//! The paper defines Ω as ω G₂/η, which has the dimension 1/s². Its formulas and its figure are right with
//! Ω = ω η/G₂ = ω τ, the definition of this module.

use std::f64::consts::SQRT_2;

use crate::{
    CreepSpectrum, Material, RelaxationBranch, RelaxationSpectrum, RetardationElement,
    RheologyError,
};
use numerics::positive;

/// Parameters of a [`StandardSolid`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StandardSolidParameters {
    /// Equilibrium shear modulus G₁ of the parallel spring, \[Pa].
    pub equilibrium_modulus: f64,
    /// Shear modulus G₂ of the spring in series with the dashpot, \[Pa].
    pub maxwell_modulus: f64,
    /// Shear viscosity η of the dashpot, [Pa s].
    pub viscosity: f64,
}

/// The standard linear solid, incompressible.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StandardSolid {
    /// Parameters in SI units.
    parameters: StandardSolidParameters,
}

/// The maximum of the loss tangent over all frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LossPeak {
    /// Angular frequency of the maximum, \[rad/s].
    pub angular_frequency: f64,
    /// Loss tangent at the maximum.
    pub loss_tangent: f64,
}

impl StandardSolid {
    /// Largest stiffness ratio γ below which the loss tangent exceeds one anywhere, (√2 − 1)/2.
    pub const LARGEST_VISCOUS_RATIO: f64 = 0.5 * (SQRT_2 - 1.0);

    /// The solid with these parameters, all greater than zero.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when a parameter, or a time, ratio or sum that follows from them, is not
    /// finite and greater than zero.
    pub fn new(parameters: StandardSolidParameters) -> Result<Self, RheologyError> {
        positive("equilibrium_modulus", parameters.equilibrium_modulus)?;
        positive("maxwell_modulus", parameters.maxwell_modulus)?;
        positive("viscosity", parameters.viscosity)?;
        let solid = Self { parameters };
        // Quotients of valid parameters may still overflow or underflow.
        positive("glass_modulus", solid.glass_modulus())?;
        positive("stiffness_ratio", solid.stiffness_ratio())?;
        positive("relaxation_time", solid.relaxation_time())?;
        positive("retardation_time", solid.retardation_time())?;
        positive(
            "retardation_compliance",
            solid.retardation_element().compliance,
        )?;
        Ok(solid)
    }

    /// Moduli and viscosity of the solid.
    pub const fn parameters(&self) -> StandardSolidParameters {
        self.parameters
    }

    /// Instantaneous modulus G₁ + G₂, \[Pa].
    pub fn glass_modulus(&self) -> f64 {
        self.parameters.equilibrium_modulus + self.parameters.maxwell_modulus
    }

    /// Stiffness ratio γ = G₁/G₂.
    pub fn stiffness_ratio(&self) -> f64 {
        self.parameters.equilibrium_modulus / self.parameters.maxwell_modulus
    }

    /// Relaxation time τ = η/G₂, \[s].
    pub fn relaxation_time(&self) -> f64 {
        self.parameters.viscosity / self.parameters.maxwell_modulus
    }

    /// Retardation time λ = η/G₁ + η/G₂, \[s].
    pub fn retardation_time(&self) -> f64 {
        self.parameters.viscosity / self.parameters.equilibrium_modulus + self.relaxation_time()
    }

    /// Retardation element with the compliance G₂/(G₁ (G₁ + G₂)) and the time λ.
    fn retardation_element(&self) -> RetardationElement {
        let maxwell_share = self.parameters.maxwell_modulus / self.glass_modulus();
        RetardationElement {
            compliance: maxwell_share / self.parameters.equilibrium_modulus,
            retardation_time: self.retardation_time(),
        }
    }

    /// Maximum of the loss tangent, 1/(2 √(γ (1 + γ))) at Ω² = γ/(1 + γ).
    pub fn loss_peak(&self) -> LossPeak {
        let gamma = self.stiffness_ratio();
        LossPeak {
            angular_frequency: (gamma / (1.0 + gamma)).sqrt() / self.relaxation_time(),
            loss_tangent: 0.5 / (gamma.sqrt() * (1.0 + gamma).sqrt()),
        }
    }

    /// Lower and upper angular frequency between which tan δ > 1, \[rad/s], the viscosity dominated range of the
    /// paper; `None` from γ = [`Self::LARGEST_VISCOUS_RATIO`] up.
    ///
    /// The bounds are the roots of (1 + γ) Ω² − Ω + γ = 0.
    pub fn viscous_window(&self) -> Option<[f64; 2]> {
        let gamma = self.stiffness_ratio();
        let margin = Self::LARGEST_VISCOUS_RATIO - gamma;
        if margin <= 0.0 {
            return None;
        }
        // Compute the discriminant 1 − 4 γ (1 + γ) with the stiffness ratio γ, factored against cancellation for a narrow window.
        let discriminant = 4.0 * margin * (margin + 2.0 * gamma + 1.0);
        let sum = 1.0 + discriminant.sqrt();
        let tau = self.relaxation_time();
        // The lower root follows from the product of both, without cancellation.
        Some([2.0 * gamma / sum / tau, 0.5 * sum / (1.0 + gamma) / tau])
    }
}

impl Material for StandardSolid {
    fn relaxation(&self) -> RelaxationSpectrum {
        let branch = RelaxationBranch::new(self.parameters.maxwell_modulus, self.relaxation_time());
        RelaxationSpectrum::from_valid(self.parameters.equilibrium_modulus, 0.0, vec![branch])
    }

    /// J(t) = 1/(G₁ + G₂) + G₂/(G₁ (G₁ + G₂)) (1 − e^(−t/λ)).
    fn creep(&self) -> CreepSpectrum {
        CreepSpectrum::from_valid(
            self.glass_modulus().recip(),
            0.0,
            vec![self.retardation_element()],
        )
    }
}
