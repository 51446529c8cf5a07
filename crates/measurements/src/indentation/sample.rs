//! The body on its sample: on a half space, or on a layer of a thickness that is known or sought.
//!
//! A thickness that is sought enters a force by profiles that are known at equal steps of its logarithm, and between them by the
//! cubic polynomials through the four next to it. At each step the table is made when it is first needed.

use std::sync::{Arc, OnceLock};

use friction_analytic::{BondedLayer, FrictionError, LayerProfile};
use indenters::{Axisymmetric, EquivalentProfile, IndenterError, contact_radius};
use numerics::bracketed_root;

use super::depth::ends;
use super::search::Found;
use super::{FitOptions, Flag, IndentationCurve, Thickness};
use crate::MeasurementError;

/// Step of the logarithm of a thickness that is sought: cubic polynomials leave 1e-5 of a radius.
const STEP: f64 = 0.1;
/// The thickness is sought from this part of the radius that the whole range of depths would give on a half space, and up to so
/// many of these radii.
const THINNEST: f64 = 0.1;
const THICKEST: f64 = 1000.0;
/// A contact point may lie before the first point of a curve by half the range of its depths.
const DEEPEST: f64 = 1.5;
/// Depth over the thickness from which on strains are not small, as for scenes.
const LARGE: f64 = 1.0 / 3.0;

/// A body on a sample.
#[derive(Clone)]
pub(super) struct Sample<'a> {
    pub(super) body: &'a dyn Axisymmetric,
    base: Base<'a>,
}

#[derive(Clone)]
enum Base<'a> {
    HalfSpace,
    Known(Arc<LayerProfile>, f64),
    /// The logarithm of the thickness is the last parameter.
    Sought(Arc<Steps<'a>>),
}

impl<'a> Sample<'a> {
    pub(super) fn new(
        body: &'a dyn Axisymmetric,
        curve: &IndentationCurve,
        options: &FitOptions,
    ) -> Result<Self, MeasurementError> {
        let width = ends(&curve.depth)[1] - curve.depth[0];
        let base = match options.thickness {
            Thickness::Infinite => Base::HalfSpace,
            Thickness::Known(thickness) => {
                let layer = BondedLayer::new(thickness, options.poisson_ratio)?;
                let profile = LayerProfile::reaching(body, &layer, width, DEEPEST * width)?;
                Base::Known(Arc::new(profile), thickness)
            }
            Thickness::Fitted => Base::Sought(Arc::new(Steps::new(body, width, options)?)),
        };
        Ok(Self { body, base })
    }

    pub(super) const fn is_sought(&self) -> bool {
        matches!(self.base, Base::Sought(_))
    }

    /// The range of the logarithm of the thickness, where it is sought.
    pub(super) fn range(&self) -> Option<[f64; 2]> {
        match &self.base {
            Base::Sought(steps) => Some(steps.range()),
            _ => None,
        }
    }

    /// The same, which for a search begins with each of a few thicknesses.
    pub(super) fn starts(&self) -> Vec<Option<f64>> {
        let Some([first, _]) = self.range() else {
            return vec![None];
        };
        [3.0, 10.0, 30.0, 300.0]
            .map(|times| Some(first + f64::ln(times)))
            .into()
    }

    /// What has the force of the body, where the thickness is sought for one of its logarithms.
    pub(super) fn profile(
        &self,
        logarithm: f64,
    ) -> Result<Box<dyn EquivalentProfile + '_>, MeasurementError> {
        Ok(match &self.base {
            Base::HalfSpace => Box::new(self.body),
            Base::Known(profile, _) => Box::new(Between(vec![(&**profile, 1.0)])),
            Base::Sought(steps) => Box::new(steps.at(logarithm)?),
        })
    }

    /// A depth at which strains are no longer small.
    pub(super) fn too_deep(&self, found: &Found) -> Option<Flag> {
        let contact_point = found.parameters[found.model.contact_point()];
        let depth = ends(&found.model.curve.depth)[1] - contact_point;
        let thickness = match &self.base {
            Base::HalfSpace => return None,
            Base::Known(_, thickness) => *thickness,
            Base::Sought(_) => found.parameters[found.model.n_parameters() - 1].exp(),
        };
        let part = depth / thickness;
        (part > LARGE).then_some(Flag::DeepInSample(100.0 * part))
    }
}

/// Profiles over the thickness.
struct Steps<'a> {
    body: &'a dyn Axisymmetric,
    poisson_ratio: f64,
    depth: f64,
    /// Logarithm of the thickness of the first.
    first: f64,
    profiles: Vec<OnceLock<Result<LayerProfile, FrictionError>>>,
}

impl<'a> Steps<'a> {
    fn new(
        body: &'a dyn Axisymmetric,
        width: f64,
        options: &FitOptions,
    ) -> Result<Self, MeasurementError> {
        let radius = match contact_radius(body, width) {
            Err(IndenterError::NotHighEnough { .. }) => Ok(body.max_radius()),
            other => other,
        };
        let radius = radius.map_err(FrictionError::from)?;
        let n_steps = ((THICKEST / THINNEST).ln() / STEP).ceil();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "93"
        )]
        let n_steps = n_steps as usize;
        Ok(Self {
            body,
            poisson_ratio: options.poisson_ratio,
            depth: DEEPEST * width,
            first: (THINNEST * radius).ln(),
            profiles: (0..=n_steps).map(|_| OnceLock::new()).collect(),
        })
    }

    fn range(&self) -> [f64; 2] {
        let last = self.profiles.len() - 1;
        [self.first, self.first + STEP * last as f64]
    }

    fn at(&self, logarithm: f64) -> Result<Between<'_>, MeasurementError> {
        let place = (logarithm - self.first) / STEP;
        let last = self.profiles.len() - 4;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "from 0 to 93"
        )]
        let start = ((place - 1.0).max(0.0) as usize).min(last);
        let weight = |k: usize| {
            let others = (0..4).filter(|other| *other != k);
            let factor =
                |other: usize| (place - (start + other) as f64) / (k as f64 - other as f64);
            others.map(factor).product::<f64>()
        };
        let one = |k: usize| {
            let known = self.profiles[start + k].get_or_init(|| self.of_step(start + k));
            Ok((known.as_ref().map_err(Clone::clone)?, weight(k)))
        };
        Ok(Between(
            (0..4).map(one).collect::<Result<_, FrictionError>>()?,
        ))
    }

    fn of_step(&self, step: usize) -> Result<LayerProfile, FrictionError> {
        let thickness = (self.first + STEP * step as f64).exp();
        let layer = BondedLayer::new(thickness, self.poisson_ratio)?;
        LayerProfile::reaching(self.body, &layer, self.depth / DEEPEST, self.depth)
    }
}

/// The geometric mean of profiles, with weights: radii are powers of the thickness, or nearly so.
struct Between<'a>(Vec<(&'a LayerProfile, f64)>);

impl Between<'_> {
    fn depth(&self) -> f64 {
        let depths = self.0.iter().map(|(profile, _)| profile.depth());
        depths.fold(f64::INFINITY, f64::min)
    }
}

impl EquivalentProfile for Between<'_> {
    fn position(&self, height: f64) -> Result<f64, IndenterError> {
        if let [(known, _)] = self.0[..] {
            return known.position(height);
        }
        let mean = |sum: f64, (profile, weight): &(&LayerProfile, f64)| {
            Ok::<f64, IndenterError>(sum + weight * profile.position(height)?.ln())
        };
        Ok(self.0.iter().try_fold(0.0, mean)?.exp())
    }

    fn closed_position(&self, height: f64) -> Option<f64> {
        self.position(height).ok()
    }

    fn height_at(&self, position: f64) -> f64 {
        let excess = |height: f64| self.position(height).unwrap_or(0.0) - position;
        bracketed_root(excess, [0.0, self.depth()]).unwrap_or(f64::INFINITY)
    }

    fn end(&self) -> f64 {
        f64::INFINITY
    }

    fn apex_exponent(&self) -> f64 {
        self.0[0].0.apex_exponent()
    }

    fn is_exact_where_touched_again(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use indenters::Sphere;

    use super::*;

    #[test]
    fn between_two_steps_a_profile_is_that_of_the_thickness() {
        let body = Sphere::new(5e-6).expect("a sphere");
        let options = FitOptions::default();
        let steps = Steps::new(&body, 1e-6, &options).expect("steps");
        for thickness in [5e-7, 1.03e-6, 2.2e-6, 1e-5, 1e-4] {
            let between = steps.at(f64::ln(thickness)).expect("a profile");
            let layer = BondedLayer::new(thickness, 0.5).expect("a layer");
            let exact = LayerProfile::new(&body, &layer, 2e-6).expect("a profile");
            for depth in [1e-9, 1e-7, 1e-6] {
                let [found, expected] = [
                    between.position(depth).expect("a depth"),
                    exact.position(depth).expect("a depth"),
                ];
                let off = found / expected - 1.0;
                assert!(off.abs() < 1e-5, "{off:e} at {depth} m and {thickness} m");
            }
        }
    }
}
