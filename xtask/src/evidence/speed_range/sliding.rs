//! A power profile that slides over the three-element solid, in units of its contact on the line.
//!
//! ```text
//! h̃ = |x|^p,  a = d = G₂ = τ = 1:   friction in units of the mean slope d/a, force in G₂ a d, speed in a/τ
//! ```
//! The contact of the one-dimensional model reaches from the lowest point forward to a, at every speed and stiffness
//! ratio; its force is then that of the half space too.
//!
//! The viscous law of the paper has the loss modulus of the solid at ω = v/b, where b is the contact length that the law
//! itself gives, Eq. (12):
//!
//! ```text
//! F_N = 4 η v h̃(b),  η = G''(ω)/ω,  ω = v/b:      F_N = 4 G''(v/b) b h̃(b)
//! ```

use anyhow::{Context, Result};
use bem_halfspace::steady::steady_refined;
use friction_analytic::power_sliding;
use indenters::{EquivalentLine, PowerProfile, SlidingLoad, stretch};
use mdr_core::steady;
use numerics::{Estimate, bracketed_root};
use rheology::{Material as _, Viscous};
use serde::Serialize;

use crate::scene::{as_far_as_reached, refined_to, solid};

/// Relative error requested of the one-dimensional model. Chosen far below that of the half space, with which it is compared.
pub(super) const LINE_ERROR: f64 = 1e-6;
/// Range in which the contact length b of the viscous law is sought. Chosen: it is about 1 where the law holds, and may be far
/// from it elsewhere.
const CONTACT_LENGTH_RANGE: [f64; 2] = [1e-8, 1e12];

/// A contact, identified by three numbers without a unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Sliding {
    /// Exponent p of the profile.
    pub(super) exponent: f64,
    /// γ = G₁/G₂.
    pub(super) stiffness_ratio: f64,
    /// vτ/a.
    pub(super) speed: f64,
}

impl Sliding {
    /// This profile and solid at another speed vτ/a.
    pub(super) fn at_speed(self, speed: f64) -> Self {
        Self { speed, ..self }
    }

    /// The three-dimensional profile c r^p whose one-dimensional one is |x|^p.
    fn body(&self) -> Result<PowerProfile> {
        let coefficient = stretch(self.exponent)?.recip();
        Ok(PowerProfile::new(coefficient, self.exponent)?)
    }

    /// Loss tangent of the solid at ω = v/a.
    pub(super) fn loss_tangent(&self) -> Result<f64> {
        Ok(solid(self.stiffness_ratio)?.loss_tangent(self.speed)?)
    }

    /// Friction coefficient of the line at the depth d = 1, so that its contact reaches to a, and the force F_N/(G₂ a d).
    pub(super) fn line(&self) -> Result<(Estimate, f64)> {
        let load = SlidingLoad::at_depth(1.0, self.speed)?;
        let (body, solid) = (self.body()?, solid(self.stiffness_ratio)?);
        let state = steady(&EquivalentLine(&body), &solid, &load, LINE_ERROR)
            .with_context(|| format!("the line of {self:?}"))?;
        Ok((state.friction_coefficient, state.normal_force.value))
    }

    /// Friction coefficient of the half space under a force; if `relative_error` is not reached, with the wider bar that was.
    pub(super) fn half_space(&self, normal_force: f64, relative_error: f64) -> Result<Estimate> {
        let (body, solid) = (self.body()?, solid(self.stiffness_ratio)?);
        let load = SlidingLoad::new(normal_force, self.speed)?;
        let options = refined_to(relative_error, 0.5);
        as_far_as_reached(steady_refined(&body, &solid, &load, &options))
            .with_context(|| format!("the half space of {self:?}"))
    }

    /// Friction coefficient of the line under a force by the viscous law of the same loss modulus.
    pub(super) fn viscous_law(&self, normal_force: f64) -> Result<f64> {
        let (body, material) = (self.body()?, Viscous::new(self.viscosity(normal_force)?)?);
        let load = SlidingLoad::new(normal_force, self.speed)?;
        Ok(power_sliding(&body, &material, &load)?.friction_coefficient)
    }

    /// η = G''(ω)/ω at ω = v/b, with the contact length b that solves F_N = 4 G''(v/b) b h̃(b). Fails where no b in
    /// [`CONTACT_LENGTH_RANGE`] does.
    fn viscosity(&self, normal_force: f64) -> Result<f64> {
        let solid = solid(self.stiffness_ratio)?;
        let modulus = |length: f64| solid.complex_modulus(self.speed / length);
        let loss = |length: f64| modulus(length).map(|modulus| modulus.loss);
        // Find the contact length b by the logarithm of F_N = 4 G'' b h̃(b), with the normal force F_N and the height h̃ of the
        // line. The right side rises with b, because the loss modulus G'' falls at most like 1/b.
        let excess = |logarithm: f64| {
            loss(logarithm.exp()).map_or(f64::NAN, |loss| {
                (4.0 * loss / normal_force).ln() + (1.0 + self.exponent) * logarithm
            })
        };
        let length = bracketed_root(excess, CONTACT_LENGTH_RANGE.map(f64::ln))
            .with_context(|| format!("the viscous law of {self:?} has no contact length"))?
            .exp();
        Ok(loss(length)? * length / self.speed)
    }
}
