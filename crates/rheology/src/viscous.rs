//! The linear viscous law of the paper.
//!
//! ```text
//! σ = 2 η dε/dt        (3)
//! ```

use crate::RheologyError;
use crate::error::{not_negative, positive};

/// An incompressible, linearly viscous material.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Viscous {
    viscosity: f64,
}

impl Viscous {
    /// A material of shear `viscosity` η > 0, [Pa s].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the viscosity is not finite and greater than zero.
    pub fn new(viscosity: f64) -> Result<Self, RheologyError> {
        Ok(Self {
            viscosity: positive("viscosity", viscosity)?,
        })
    }

    /// Shear viscosity η, [Pa s].
    #[must_use]
    pub const fn viscosity(&self) -> f64 {
        self.viscosity
    }

    /// Creep compliance J(t) = t/η, \[1/Pa], at a time t ≥ 0 \[s] after the stress was applied.
    #[must_use]
    pub fn creep_compliance(&self, time: f64) -> f64 {
        time / self.viscosity
    }

    /// Compliance α of one step, \[1/Pa]: held at the load potential w over the step, the surface moves to
    /// `u_new = α w + history`, and the history of a dashpot is its displacement before the step.
    #[must_use]
    pub fn step_compliance(&self, time_step: f64) -> f64 {
        self.creep_compliance(time_step)
    }

    /// Loss modulus G'' = ω η, \[Pa], at an angular frequency ω ≥ 0 \[rad/s]; the storage modulus is zero.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the frequency is not finite or below zero.
    pub fn loss_modulus(&self, angular_frequency: f64) -> Result<f64, RheologyError> {
        Ok(not_negative("angular_frequency", angular_frequency)? * self.viscosity)
    }
}
