//! Relaxation spectrum: the stress after a step of strain.
//!
//! ```text
//! G(t) = G_∞ + η₀ δ(t) + Σ G_k e^(−t/τ_k)
//! G'(ω) = G_∞ + Σ G_k Ω_k²/(1 + Ω_k²)    G''(ω) = ω η₀ + Σ G_k Ω_k/(1 + Ω_k²)    Ω_k = ω τ_k
//! ```

use super::decays::{Decay, DecayNames, normal_form};
use crate::RheologyError;
use crate::complex::{ComplexModulus, debye};
use numerics::not_negative;

/// One Maxwell branch: a spring and a dashpot in series.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RelaxationBranch {
    /// Shear modulus G_k of the spring, \[Pa].
    pub modulus: f64,
    /// Relaxation time τ_k, \[s].
    pub relaxation_time: f64,
}

/// A spring, a dashpot and any number of Maxwell branches in parallel.
///
/// The branches are in increasing order of distinct times, their moduli greater than zero.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RelaxationSpectrum {
    /// Equilibrium modulus, \[Pa].
    equilibrium_modulus: f64,
    /// Viscosity of a parallel dashpot, \[Pa s].
    viscosity: f64,
    /// Relaxing branches by increasing time.
    branches: Vec<RelaxationBranch>,
}

impl RelaxationSpectrum {
    /// The spectrum with a lone spring of modulus G_∞ ≥ 0 \[Pa], a lone dashpot of viscosity η₀ ≥ 0 [Pa s], and
    /// `branches` in any order.
    ///
    /// Branches without modulus are dropped; those whose times differ by less than one part in 10⁸ become one.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] or [`RheologyError::InvalidElement`] when a number, or the glass modulus or
    /// the viscosity of a branch, is not finite or has the wrong sign; [`RheologyError::NoStiffness`] when nothing is
    /// left.
    pub fn new(
        equilibrium_modulus: f64,
        viscosity: f64,
        branches: Vec<RelaxationBranch>,
    ) -> Result<Self, RheologyError> {
        not_negative("equilibrium_modulus", equilibrium_modulus)?;
        not_negative("viscosity", viscosity)?;
        // Order and merge the branches, then check that the sums are representable.
        let decays = branches.iter().map(|branch| Decay {
            amplitude: branch.modulus,
            time: branch.relaxation_time,
        });
        let names = DecayNames {
            list: "branches",
            amplitude: "modulus",
            time: "relaxation_time",
        };
        let branches = normal_form(&names, decays.collect())?
            .into_iter()
            .map(|decay| RelaxationBranch::new(decay.amplitude, decay.time));
        let spectrum = Self::from_valid(equilibrium_modulus, viscosity, branches.collect());
        let sum = spectrum.spring_moduli();
        if sum == 0.0 && viscosity == 0.0 {
            return Err(RheologyError::NoStiffness);
        }
        not_negative("glass_modulus", sum)?;
        not_negative("zero_shear_viscosity", spectrum.zero_shear_viscosity())?;
        Ok(spectrum)
    }

    /// The spectrum of valid numbers, with branches in increasing order of distinct times.
    pub(crate) const fn from_valid(
        equilibrium_modulus: f64,
        viscosity: f64,
        branches: Vec<RelaxationBranch>,
    ) -> Self {
        Self {
            equilibrium_modulus,
            viscosity,
            branches,
        }
    }

    /// Equilibrium modulus G_∞ of the lone spring, \[Pa]; 0 for a fluid.
    pub const fn equilibrium_modulus(&self) -> f64 {
        self.equilibrium_modulus
    }

    /// Viscosity η₀ of the lone dashpot, [Pa s].
    pub const fn viscosity(&self) -> f64 {
        self.viscosity
    }

    /// The Maxwell branches in increasing order of time.
    pub fn branches(&self) -> &[RelaxationBranch] {
        &self.branches
    }

    /// Sum G_∞ + Σ G_k of the moduli, \[Pa].
    fn spring_moduli(&self) -> f64 {
        let branches: f64 = self.branches.iter().map(|b| b.modulus).sum();
        self.equilibrium_modulus + branches
    }

    /// Instantaneous modulus G(0), \[Pa]; infinite with a lone dashpot.
    pub fn glass_modulus(&self) -> f64 {
        if self.viscosity > 0.0 {
            return f64::INFINITY;
        }
        self.spring_moduli()
    }

    /// Limit η₀ + Σ G_k τ_k of G''/ω at low frequency, [Pa s].
    pub fn zero_shear_viscosity(&self) -> f64 {
        let branches = self.branches.iter().map(RelaxationBranch::viscosity);
        self.viscosity + branches.sum::<f64>()
    }

    /// Relaxation modulus G(t), \[Pa], at a time t ≥ 0 \[s] after the strain was applied.
    ///
    /// It is infinite at t = 0 with a lone dashpot, whose impulse does not contribute at later times.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the time is not finite or below zero.
    pub fn relaxation_modulus(&self, time: f64) -> Result<f64, RheologyError> {
        if not_negative("time", time)? == 0.0 {
            return Ok(self.glass_modulus());
        }
        let branches = self.branches.iter();
        let moduli = branches.map(|b| b.modulus * (-time / b.relaxation_time).exp());
        Ok(self.equilibrium_modulus + moduli.sum::<f64>())
    }

    /// Complex modulus at an angular frequency ω ≥ 0 \[rad/s].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the frequency is not finite or below zero.
    pub fn complex_modulus(&self, angular_frequency: f64) -> Result<ComplexModulus, RheologyError> {
        let omega = not_negative("angular_frequency", angular_frequency)?;
        let mut modulus = ComplexModulus {
            storage: self.equilibrium_modulus,
            loss: omega * self.viscosity,
        };
        for branch in &self.branches {
            let [in_phase, out_of_phase] = debye(omega * branch.relaxation_time);
            modulus.storage += branch.modulus * in_phase;
            modulus.loss += branch.modulus * out_of_phase;
        }
        Ok(modulus)
    }

    /// Loss tangent tan δ = G''/G' at an angular frequency ω ≥ 0 \[rad/s]; infinite if G' vanishes.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the frequency is not finite or below zero.
    pub fn loss_tangent(&self, angular_frequency: f64) -> Result<f64, RheologyError> {
        let modulus = self.complex_modulus(angular_frequency)?;
        // Divide only by a storage modulus well above underflow, because a smaller one has lost digits.
        if modulus.storage > f64::MIN_POSITIVE / f64::EPSILON {
            return Ok(modulus.loss / modulus.storage);
        }
        Ok(self.loss_tangent_of_vanishing_storage(angular_frequency))
    }

    /// Loss tangent from G''/ω and G'/ω, which do not underflow for a fluid far below all 1/τ.
    fn loss_tangent_of_vanishing_storage(&self, omega: f64) -> f64 {
        let over_branches = |part: fn([f64; 2]) -> f64| {
            let branches = self.branches.iter();
            let parts = branches.map(|b| b.viscosity() * part(debye(omega * b.relaxation_time)));
            parts.sum::<f64>()
        };
        let per_omega = over_branches(|[_, out_of_phase]| out_of_phase);
        if omega > 0.0 && self.equilibrium_modulus + per_omega > 0.0 {
            let viscous = over_branches(|[in_phase, _]| 1.0 - in_phase);
            return (self.viscosity + viscous) / (self.equilibrium_modulus / omega + per_omega);
        }
        let is_solid = self.equilibrium_modulus > 0.0;
        if is_solid { 0.0 } else { f64::INFINITY }
    }

    /// Parallel connection of two materials, under the same strain.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when a sum overflows.
    pub fn in_parallel_with(&self, other: &Self) -> Result<Self, RheologyError> {
        Self::new(
            self.equilibrium_modulus + other.equilibrium_modulus,
            self.viscosity + other.viscosity,
            [self.branches(), other.branches()].concat(),
        )
    }
}

impl RelaxationBranch {
    /// A branch with a modulus \[Pa] and a relaxation time \[s].
    pub const fn new(modulus: f64, relaxation_time: f64) -> Self {
        Self {
            modulus,
            relaxation_time,
        }
    }

    /// Viscosity G_k τ_k of the dashpot, [Pa s].
    pub fn viscosity(&self) -> f64 {
        self.modulus * self.relaxation_time
    }
}
