//! One power profile on a viscous half space, solved by theory, chain and half space.

use anyhow::Result;
use bem_halfspace::slide::{Transient, slide_on_grid};
use bem_halfspace::steady::{
    RefinementOptions, SteadyEstimate, SteadyOptions, SteadySliding, steady_on_grid, steady_refined,
};
use bem_halfspace::{BemError, Footprint, GridOptions};
use casebook::standard_solid;
use friction_analytic::{StationarySliding, power_sliding};
use indenters::{PowerProfile, SlidingLoad};
use numerics::Estimate;
use rheology::{StandardSolid, Viscous};

/// A profile h = c r^p, pressed and slid.
pub(crate) struct Scene {
    pub(crate) body: PowerProfile,
    pub(crate) material: Viscous,
    pub(crate) load: SlidingLoad,
}

impl Scene {
    /// The scene of a given exponent in which the depth scale F_N/(4ηv) and the coefficient are 1: by similarity every
    /// other one has the same ratio of half space to line.
    pub(crate) fn unit(exponent: f64) -> Result<Self> {
        Ok(Self {
            body: PowerProfile::new(1.0, exponent)?,
            material: Viscous::new(1.0)?,
            load: SlidingLoad::new(4.0, 1.0)?,
        })
    }

    /// The closed form of the one-dimensional model.
    pub(crate) fn theory(&self) -> Result<StationarySliding> {
        Ok(power_sliding(&self.body, &self.material, &self.load)?)
    }

    /// The half space with square elements of the given edge, slid over `lengths` contact lengths of the
    /// one-dimensional model.
    pub(crate) fn half_space(&self, spacing: f64, lengths: f64) -> Result<Transient> {
        let footprint = Footprint::sliding(&self.body, &self.material, &self.load)?;
        let options = GridOptions::new([spacing; 2], footprint);
        let load = self.load.after(lengths * self.theory()?.contact_length())?;
        Ok(slide_on_grid(&self.body, &self.material, &load, &options)?)
    }

    /// The stationary half space to a relative error.
    pub(crate) fn friction(&self, options: &RefinementOptions) -> Result<SteadyEstimate, BemError> {
        steady_refined(&self.body, &self.material, &self.load, options)
    }

    /// The stationary half space on one grid; the tolerance is that of the residual over F_N/(4ηv).
    pub(crate) fn on_one_grid(
        &self,
        spacing: [f64; 2],
        phase: [f64; 2],
        tolerance: f64,
    ) -> Result<SteadySliding> {
        let footprint = Footprint::sliding(&self.body, &self.material, &self.load)?;
        let options = SteadyOptions {
            phase,
            tolerance,
            ..SteadyOptions::new(spacing, footprint)
        };
        let state = steady_on_grid(&self.body, &self.material, &self.load, &options);
        Ok(state?)
    }
}

/// The default of the stationary half space with another error and other elements, of an aspect Δy/Δx.
pub(crate) fn refined_to(relative_error: f64, aspect: f64) -> RefinementOptions {
    RefinementOptions {
        relative_error,
        aspect,
        ..RefinementOptions::default()
    }
}

/// The three-element solid of the paper's Fig. 1 with γ = G₁/G₂, G₂ = 1 Pa and τ = 1 s.
pub(crate) fn solid(stiffness_ratio: f64) -> Result<StandardSolid> {
    Ok(standard_solid([stiffness_ratio, 1.0, 1.0])?)
}

/// Friction with the error bar that was reached, which is right even where it is wider than what was asked for.
pub(crate) fn as_far_as_reached(
    result: Result<SteadyEstimate, BemError>,
) -> Result<Estimate, BemError> {
    match result {
        Ok(estimate) => Ok(estimate.friction_coefficient),
        Err(BemError::NotReached {
            quantity: "friction coefficient",
            value,
            error,
            ..
        }) => Ok(Estimate::new(value, error)),
        Err(other) => Err(other),
    }
}
