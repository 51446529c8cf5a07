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
use bem_halfspace::BemError;
use bem_halfspace::steady::{FrictionEstimate, FrictionOptions, steady_friction};
use friction_analytic::{power_sliding, scaling_factor};
use indenters::{EquivalentLine, PowerProfile, SlidingLoad, stretch};
use mdr_core::{SlidingDepth, SteadyOptions, steady_at_depth};
use numerics::bracketed_root;
use rheology::{Material as _, StandardSolid, StandardSolidParameters, Viscous};

/// Relative error asked of the line.
const LINE_ERROR: f64 = 1e-6;
/// Lengths b in which the contact length of the viscous law is looked for; it is about 1 where the law holds.
const LENGTHS: [f64; 2] = [1e-8, 1e12];

/// One contact, by its three numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sliding {
    /// Exponent p of the profile.
    pub(super) exponent: f64,
    /// γ = G₁/G₂.
    pub(super) stiffness_ratio: f64,
    /// vτ/a.
    pub(super) speed: f64,
}

/// A value with its absolute error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Friction {
    pub(super) value: f64,
    pub(super) error: f64,
}

/// The one-dimensional model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    pub(super) normal_force: f64,
    pub(super) friction: Friction,
}

/// G₂ = τ = 1.
fn solid(stiffness_ratio: f64) -> Result<StandardSolid> {
    Ok(StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus: stiffness_ratio,
        maxwell_modulus: 1.0,
        viscosity: 1.0,
    })?)
}

impl Sliding {
    fn body(&self) -> Result<PowerProfile> {
        let coefficient = stretch(self.exponent)?.recip();
        Ok(PowerProfile::new(coefficient, self.exponent)?)
    }

    fn solid(&self) -> Result<StandardSolid> {
        solid(self.stiffness_ratio)
    }

    /// The speeds between which tan δ > 1 at ω = v/a.
    pub(super) fn viscous_window(stiffness_ratio: f64) -> Result<Option<[f64; 2]>> {
        Ok(solid(stiffness_ratio)?.viscous_window())
    }

    /// Loss tangent of the solid at ω = v/a.
    pub(super) fn loss_tangent(&self) -> Result<f64> {
        Ok(self.solid()?.loss_tangent(self.speed)?)
    }

    /// Friction of the line whose contact reaches to a, and the force that this takes.
    pub(super) fn line(&self) -> Result<Line> {
        let motion = SlidingDepth {
            indentation_depth: 1.0,
            velocity: self.speed,
        };
        let options = SteadyOptions {
            relative_error: LINE_ERROR,
        };
        let body = self.body()?;
        let state = steady_at_depth(&EquivalentLine(&body), &self.solid()?, &motion, &options)
            .with_context(|| format!("the line of {self:?}"))?;
        Ok(Line {
            normal_force: state.normal_force,
            friction: Friction {
                value: state.friction_coefficient,
                error: state.friction_coefficient_error,
            },
        })
    }

    /// Friction of the half space under a force.
    pub(super) fn half_space(&self, normal_force: f64, relative_error: f64) -> Result<Friction> {
        let options = FrictionOptions {
            relative_error,
            ..FrictionOptions::default()
        };
        let load = SlidingLoad::new(normal_force, self.speed)?;
        match steady_friction(&self.body()?, &self.solid()?, &load, &options) {
            Ok(FrictionEstimate {
                friction_coefficient,
                error,
                ..
            })
            // What was reached has an honest bar, only a wider one.
            | Err(BemError::FrictionNotReached {
                friction_coefficient,
                error,
                ..
            }) => Ok(Friction {
                value: friction_coefficient,
                error,
            }),
            Err(error) => Err(error).with_context(|| format!("the half space of {self:?}")),
        }
    }

    /// Friction of the line under a force by the viscous law of the same loss modulus.
    pub(super) fn viscous_law(&self, normal_force: f64) -> Result<f64> {
        let (body, material) = (self.body()?, Viscous::new(self.viscosity(normal_force)?)?);
        let load = SlidingLoad::new(normal_force, self.speed)?;
        Ok(power_sliding(&body, &material, &load)?.friction_coefficient)
    }

    /// η = G''(ω)/ω at ω = v/b.
    fn viscosity(&self, normal_force: f64) -> Result<f64> {
        let solid = self.solid()?;
        let loss = |length: f64| solid.loss_modulus(self.speed / length);
        // ln of F_N = 4 G'' b h̃(b), which rises with b: G'' falls at most like 1/b.
        let excess = |logarithm: f64| {
            let length = logarithm.exp();
            loss(length).map_or(f64::NAN, |loss| {
                (4.0 * loss / normal_force).ln() + (1.0 + self.exponent) * logarithm
            })
        };
        let length = bracketed_root(excess, LENGTHS.map(f64::ln))
            .with_context(|| format!("the viscous law of {self:?} has no contact length"))?
            .exp();
        Ok(loss(length)? * length / self.speed)
    }
}

/// s_p, the plateau between 1/2 and 1.
pub(super) fn plateau(exponent: f64) -> Result<f64> {
    Ok(scaling_factor(exponent)?.value)
}
