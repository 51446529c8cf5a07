//! One power profile on a viscous half space, solved by all three methods.

use anyhow::Result;
use bem_halfspace::slide::{Transient, slide_on_grid};
use bem_halfspace::steady::{
    RefinementOptions, SteadyEstimate, SteadyOptions, SteadySliding, steady_on_grid, steady_refined,
};
use bem_halfspace::{BemError, Footprint, GridOptions};
use friction_analytic::{StationarySliding, power_sliding};
use indenters::{EquivalentLine, PowerProfile, SlidingLoad};
use numerics::Estimate;
use rheology::Viscous;

/// A profile h = c r^p, pressed and slid.
#[derive(Debug, Clone, Copy)]
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

    /// The chain of dashpots.
    pub(crate) fn chain(&self, spacing: f64) -> Result<mdr_core::Transient> {
        let length = self.theory()?.contact_length();
        let options = mdr_core::SlideOptions {
            spacing,
            drift_tolerance: 1e-9,
            max_sliding_distance: 100.0 * length,
        };
        let line = EquivalentLine(&self.body);
        Ok(mdr_core::slide_on_grid(
            &line,
            &self.material,
            &self.load,
            &options,
        )?)
    }

    /// The half space with square elements of the given edge, slid over `lengths` contact lengths of the
    /// one-dimensional model.
    pub(crate) fn half_space(&self, spacing: f64, lengths: f64) -> Result<Transient> {
        let footprint = Footprint::sliding(&self.body, &self.material, &self.load)?;
        let options = GridOptions::new([spacing; 2], footprint);
        let load = self.load.after(lengths * self.theory()?.contact_length())?;
        Ok(slide_on_grid(&self.body, &self.material, &load, &options)?)
    }

    /// The stationary half space to a relative error, with elements of an aspect Δy/Δx.
    pub(crate) fn friction(
        &self,
        relative_error: f64,
        aspect: f64,
    ) -> Result<SteadyEstimate, BemError> {
        let options = RefinementOptions {
            relative_error,
            aspect,
            ..RefinementOptions::default()
        };
        steady_refined(&self.body, &self.material, &self.load, &options)
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

/// Friction of the half space as far as it was computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reached {
    pub(crate) friction: Estimate,
    /// On the finest grid, where the error asked for was reached.
    pub(crate) unknowns: Option<usize>,
}

/// Friction with the error bar that was reached, which is right even where it is wider than what was asked for.
pub(crate) fn as_far_as_reached(
    result: Result<SteadyEstimate, BemError>,
) -> Result<Reached, BemError> {
    match result {
        Ok(estimate) => Ok(Reached {
            friction: estimate.friction_coefficient,
            unknowns: estimate.refinements.last().map(|last| last.unknowns),
        }),
        Err(BemError::FrictionNotReached {
            friction_coefficient: value,
            error,
            ..
        }) => Ok(Reached {
            friction: Estimate { value, error },
            unknowns: None,
        }),
        Err(other) => Err(other),
    }
}

#[cfg(test)]
mod tests {
    use bem_halfspace::indent::{IndentStep, indent_history_on_grid};
    use friction_analytic::power_indentation_after_impulse;
    use indenters::Control;

    use super::*;

    /// Half space and line agree exactly in normal indentation; what is left is their elements.
    #[test]
    fn all_three_methods_agree_on_normal_indentation() {
        for exponent in [1.0, 1.5, 2.0, 4.0] {
            let Scene { body, material, .. } = Scene::unit(exponent).expect("a scene");
            let (force, times) = (3.0, [0.5, 1.0, 2.0, 4.0]);
            let exact = times.map(|time| {
                power_indentation_after_impulse(&body, &material, force * time)
                    .expect("an indentation")
            });
            let radius = exact[3].contact_radius;
            let options = GridOptions::new([radius / 24.0; 2], Footprint::square(1.2 * radius));
            let steps = IndentStep::constant(Control::NormalForce(force), &times);
            let half_space =
                indent_history_on_grid(&body, &material, &steps, &options).expect("an indentation");
            let steps = times.map(|time| mdr_core::IndentStep {
                time,
                control: Control::NormalForce(force),
            });
            let line = EquivalentLine(&body);
            let chain = mdr_core::indent_history(&line, &material, &steps, radius / 500.0);
            let chain = chain.expect("an indentation");
            for (step, exact) in exact.iter().enumerate() {
                let depths = [
                    half_space[step].indentation_depth,
                    chain[step].indentation_depth,
                ];
                for (depth, allowed) in depths.into_iter().zip([2e-3, 1e-4]) {
                    let error = (depth / exact.indentation_depth - 1.0).abs();
                    assert!(
                        error < allowed,
                        "p = {exponent}, step {step}: {depths:?} instead of {exact:?}"
                    );
                }
            }
        }
    }

    /// The statement of the paper: chain and theory coincide, the half space has a constant fraction of them.
    #[test]
    fn the_half_space_has_a_constant_fraction_of_the_friction_of_the_line() {
        let ratios: Vec<f64> = [1e-3, 1e-1]
            .iter()
            .map(|&velocity| {
                let scene = Scene {
                    body: PowerProfile::paraboloid(10.0).expect("a paraboloid"),
                    material: Viscous::new(1e5).expect("a material"),
                    load: SlidingLoad::new(1.0, velocity).expect("a load"),
                };
                let theory = scene.theory().expect("the theory");
                let spacing = theory.contact_length() / 8.0;
                let chain = scene
                    .chain(spacing)
                    .expect("a chain")
                    .last
                    .friction_coefficient;
                assert!(
                    (chain / theory.friction_coefficient - 1.0).abs() < 2e-2,
                    "{chain} and {theory:?}"
                );
                let half_space = scene.half_space(spacing, 24.0).expect("a transient");
                half_space.last().friction_coefficient / theory.friction_coefficient
            })
            .collect();
        assert!((ratios[0] / ratios[1] - 1.0).abs() < 1e-9, "{ratios:?}");
        assert!((ratios[0] - 0.67).abs() < 0.04, "{ratios:?}");
    }
}
