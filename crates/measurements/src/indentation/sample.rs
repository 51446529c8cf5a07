//! The body on its sample: a half space, or a layer of known or fitted thickness.
//!
//! For a fitted thickness, equivalent profiles are tabulated at equal steps of its logarithm and interpolated by cubic
//! polynomials. Each profile is computed when it is first needed.

use std::sync::{Arc, OnceLock};

use friction_analytic::{BondedLayer, FrictionError, LayerProfile};
use indenters::{Axisymmetric, EquivalentProfile, IndenterError, contact_radius};
use numerics::bracketed_root;

use super::depth::min_max;
use super::search::Found;
use super::{FitOptions, Flag, IndentationCurve, Thickness};
use crate::MeasurementError;

/// Step of the natural logarithm of the thickness in a table of profiles. Chosen: the interpolation error is 1e-5 of a radius.
const LOG_THICKNESS_STEP: f64 = 0.1;
/// Ratio of the smallest fitted thickness to the contact radius on a half space at the whole range of depths. Chosen: the
/// contact is then ten times as wide as the sample is thick, and strains are beyond linear theory.
const MIN_THICKNESS_RATIO: f64 = 0.1;
/// Ratio of the largest fitted thickness to the contact radius on a half space at the whole range of depths. Chosen: the sample
/// is then a half space.
const MAX_THICKNESS_RATIO: f64 = 1000.0;
/// Ratio of the largest tabulated depth of a profile to the range of depths of the curve. Chosen: the contact point may precede
/// the curve by half the range.
const DEPTH_MARGIN: f64 = 1.5;
/// Ratio of the indentation depth to the thickness above which strains are not small, and a fit is flagged. Chosen: the same
/// as for the warning about the layer of a scene.
const LARGE_STRAIN_RATIO: f64 = 1.0 / 3.0;

/// A body on a sample.
#[derive(Clone)]
pub(super) struct Sample<'a> {
    /// The rigid body.
    pub(super) body: &'a dyn Axisymmetric,
    /// What is under the surface.
    base: Base<'a>,
}

/// What is under the surface of the sample.
#[derive(Clone)]
enum Base<'a> {
    /// A half space.
    HalfSpace,
    /// The profile on a layer of known thickness, and that thickness \[m].
    Known(Arc<LayerProfile>, f64),
    /// The logarithm of the thickness is the last parameter.
    Fitted(Arc<ProfileTable<'a>>),
}

impl<'a> Sample<'a> {
    /// The half space or the layer of the options, for depths up to the largest one of the curve above its first.
    pub(super) fn new(
        body: &'a dyn Axisymmetric,
        curve: &IndentationCurve,
        options: &FitOptions,
    ) -> Result<Self, MeasurementError> {
        let width = min_max(&curve.depth)[1] - curve.depth[0];
        let base = match options.thickness {
            Thickness::Infinite => Base::HalfSpace,
            Thickness::Known(thickness) => {
                let layer = BondedLayer::new(thickness, options.poisson_ratio)?;
                let profile = LayerProfile::reaching(body, &layer, width, DEPTH_MARGIN * width)?;
                Base::Known(Arc::new(profile), thickness)
            }
            Thickness::Fitted => Base::Fitted(Arc::new(ProfileTable::new(body, width, options)?)),
        };
        Ok(Self { body, base })
    }

    /// True if the thickness is a parameter of the fit.
    pub(super) const fn is_fitted(&self) -> bool {
        matches!(self.base, Base::Fitted(_))
    }

    /// Range of the logarithm of the thickness; `None` if it is not fitted.
    pub(super) fn range(&self) -> Option<[f64; 2]> {
        match &self.base {
            Base::Fitted(steps) => Some(steps.range()),
            _ => None,
        }
    }

    /// Initial values of the logarithm of the thickness, 0.3 to 30 contact radii; a single `None` if it is not fitted.
    pub(super) fn starts(&self) -> Vec<Option<f64>> {
        let Some([first, _]) = self.range() else {
            return vec![None];
        };
        [3.0, 10.0, 30.0, 300.0]
            .map(|times| Some(first + f64::ln(times)))
            .into()
    }

    /// Equivalent profile of the body; the logarithm of the thickness has an effect only if that is fitted.
    pub(super) fn profile(
        &self,
        logarithm: f64,
    ) -> Result<Box<dyn EquivalentProfile + '_>, MeasurementError> {
        Ok(match &self.base {
            Base::HalfSpace => Box::new(self.body),
            Base::Known(profile, _) => Box::new(InterpolatedProfile(vec![(&**profile, 1.0)])),
            Base::Fitted(steps) => Box::new(steps.interpolate(logarithm)?),
        })
    }

    /// Flag for a depth at which strains are not small.
    pub(super) fn too_deep(&self, found: &Found) -> Option<Flag> {
        let contact_point = found.parameters[found.model.contact_point()];
        let depth = min_max(&found.model.curve.depth)[1] - contact_point;
        let thickness = match &self.base {
            Base::HalfSpace => return None,
            Base::Known(_, thickness) => *thickness,
            Base::Fitted(_) => found.parameters[found.model.n_parameters() - 1].exp(),
        };
        let part = depth / thickness;
        (part > LARGE_STRAIN_RATIO).then_some(Flag::DeepInSample(100.0 * part))
    }
}

/// Equivalent profiles, tabulated over the logarithm of the thickness.
struct ProfileTable<'a> {
    body: &'a dyn Axisymmetric,
    poisson_ratio: f64,
    /// Largest depth of the profiles, \[m].
    depth: f64,
    /// Logarithm of the first thickness.
    first: f64,
    /// Profiles at steps of [`LOG_THICKNESS_STEP`]; empty until first needed.
    profiles: Vec<OnceLock<Result<LayerProfile, FrictionError>>>,
}

impl<'a> ProfileTable<'a> {
    /// An empty table for depths up to `width` \[m].
    fn new(
        body: &'a dyn Axisymmetric,
        width: f64,
        options: &FitOptions,
    ) -> Result<Self, MeasurementError> {
        let radius = match contact_radius(body, width) {
            Err(IndenterError::NotHighEnough { .. }) => Ok(body.max_radius()),
            other => other,
        }
        .map_err(FrictionError::from)?;
        let n_steps =
            ((MAX_THICKNESS_RATIO / MIN_THICKNESS_RATIO).ln() / LOG_THICKNESS_STEP).ceil();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "93"
        )]
        let n_steps = n_steps as usize;
        Ok(Self {
            body,
            poisson_ratio: options.poisson_ratio,
            depth: DEPTH_MARGIN * width,
            first: (MIN_THICKNESS_RATIO * radius).ln(),
            profiles: (0..=n_steps).map(|_| OnceLock::new()).collect(),
        })
    }

    /// Natural logarithms of the smallest and the largest thickness.
    fn range(&self) -> [f64; 2] {
        let last = self.profiles.len() - 1;
        [self.first, self.first + LOG_THICKNESS_STEP * last as f64]
    }

    /// The profile for a logarithm of the thickness, by cubic interpolation between four steps.
    fn interpolate(&self, logarithm: f64) -> Result<InterpolatedProfile<'_>, MeasurementError> {
        let place = (logarithm - self.first) / LOG_THICKNESS_STEP;
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
            let known = self.profiles[start + k].get_or_init(|| self.profile_of_step(start + k));
            Ok((known.as_ref().map_err(Clone::clone)?, weight(k)))
        };
        Ok(InterpolatedProfile(
            (0..4).map(one).collect::<Result<_, FrictionError>>()?,
        ))
    }

    /// Computes the profile at a step of the table.
    fn profile_of_step(&self, step: usize) -> Result<LayerProfile, FrictionError> {
        let thickness = (self.first + LOG_THICKNESS_STEP * step as f64).exp();
        let layer = BondedLayer::new(thickness, self.poisson_ratio)?;
        LayerProfile::reaching(self.body, &layer, self.depth / DEPTH_MARGIN, self.depth)
    }
}

/// Weighted geometric mean of profiles, because radii are nearly powers of the thickness.
struct InterpolatedProfile<'a>(Vec<(&'a LayerProfile, f64)>);

impl InterpolatedProfile<'_> {
    /// Largest depth that all interpolated profiles have, \[m].
    fn depth(&self) -> f64 {
        let depths = self.0.iter().map(|(profile, _)| profile.depth());
        depths.fold(f64::INFINITY, f64::min)
    }
}

impl EquivalentProfile for InterpolatedProfile<'_> {
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
        let steps = ProfileTable::new(&body, 1e-6, &options).expect("steps");
        for thickness in [5e-7, 1.03e-6, 2.2e-6, 1e-5, 1e-4] {
            let between = steps.interpolate(f64::ln(thickness)).expect("a profile");
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
