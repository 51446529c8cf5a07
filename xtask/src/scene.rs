//! One power profile on a viscous half space, solved by the closed form of the one-dimensional model and on the half space.

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

/// A body of profile h = c r^p, pressed into a viscous half space by a normal force F_N and slid at a speed v; all in SI.
pub(crate) struct Scene {
    pub(crate) body: PowerProfile,
    pub(crate) material: Viscous,
    pub(crate) load: SlidingLoad,
}

impl Scene {
    /// The scene of an exponent p in which c, η, v and the depth scale F_N/(4ηv) are 1. By similarity every other scene of this
    /// exponent has the same ratio of half space to one-dimensional model.
    pub(crate) fn unit(exponent: f64) -> Result<Self> {
        Ok(Self {
            body: PowerProfile::new(1.0, exponent)?,
            material: Viscous::new(1.0)?,
            load: SlidingLoad::new(4.0, 1.0)?,
        })
    }

    /// Stationary sliding of this scene by the closed form of the one-dimensional model.
    pub(crate) fn theory(&self) -> Result<StationarySliding> {
        Ok(power_sliding(&self.body, &self.material, &self.load)?)
    }

    /// The half space on square elements of the edge `spacing` \[m], slid step by step from first touch over `lengths` contact
    /// lengths of the one-dimensional model.
    pub(crate) fn half_space(&self, spacing: f64, lengths: f64) -> Result<Transient> {
        let footprint = Footprint::sliding(&self.body, &self.material, &self.load)?;
        let options = GridOptions::new([spacing; 2], footprint);
        let load = self.load.after(lengths * self.theory()?.contact_length())?;
        Ok(slide_on_grid(&self.body, &self.material, &load, &options)?)
    }

    /// The stationary half space, its grid refined until the relative error of `options` is reached.
    pub(crate) fn friction(&self, options: &RefinementOptions) -> Result<SteadyEstimate, BemError> {
        steady_refined(&self.body, &self.material, &self.load, options)
    }

    /// The stationary half space on one grid, not extrapolated. `spacing`: Δx and Δy \[m]; `phase`: shift of the grid against
    /// the body in elements; `tolerance`: largest residual in contact over F_N/(4ηv).
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

/// Default options of the stationary half space with another relative error and elements of the aspect Δy/Δx.
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

/// The coefficient of friction with the error bar that was reached. Where that is wider than what was asked for, the solver
/// reports `NotReached`; its bar is as trustworthy as any other, so that this is no error here. Other errors are passed on.
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
