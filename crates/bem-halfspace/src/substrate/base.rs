//! Elastomers, and the substrates that may lie under a layer of their material.
//!
//! A pressure wave p̂ of the wave vector q displaces the surface by
//!
//! ```text
//! û = 2 p̂ M(|q|t) / (|q| E*)        with M = 1 on a half space.
//! ```
//!
//! t is the thickness of the layer at the surface, E* the plane-strain modulus of its material and M the *compliance ratio*.
//!
//! Every half-space method therefore holds on another substrate when the potential 1/r of a point is replaced by
//!
//! ```text
//! 1/r + c(r/t)/t,        c(ρ) = ∫_0^∞ [M(s) − 1] J₀(sρ) ds.
//! ```
//!
//! s/t is the wave number, ρ = r/t the distance in thicknesses and J₀ a Bessel function. c is analytic for |Im ρ| < 2. On a rigid
//! base the whole potential decays like e^(−0.7 ρ) or faster.
//!
//! Theory: docs/layers.md, "How it is computed" and "Other substrates".

use std::f64::consts::FRAC_PI_4;
use std::fmt::Debug;
use std::sync::{Arc, OnceLock};

use numerics::{InvalidParameter, in_range, positive};
use rheology::{Material, ModulusFactors, check_spectra};

use crate::substrate::correction::{Correction, MAX_WAVE_NUMBER};
use crate::substrate::rectangle::integrate_smooth;
use crate::{BemError, WaveShift, influence};

/// A deformable body with a plane surface: every [`Material`] is a half space, and [`Layer`](crate::Layer) is a layer of a
/// material on a base.
pub trait Elastomer {
    /// Material at the surface.
    fn material(&self) -> Box<dyn Material + '_>;

    /// Base under the material.
    fn base(&self) -> Base;

    /// Factors of storage and loss modulus at the strain amplitude of stationary sliding. Only stationary states have them: all other
    /// functions refuse factors that are not 1.
    fn modulus_factors(&self) -> ModulusFactors {
        ModulusFactors::NONE
    }

    /// Shift of times and moduli by the wavelength of the pressure; `None` for the same material under all waves. Only the stationary
    /// sliding of periodic surfaces has it: all other functions refuse it.
    fn wave_shift(&self) -> Option<WaveShift> {
        None
    }
}

/// Refuses spectra that contradict each other, and moduli that a stationary state has changed: by factors, or by a shift of each wave.
pub(crate) fn check_unchanged_moduli(elastomer: &dyn Elastomer) -> Result<(), BemError> {
    check_spectra(&elastomer.material())?;
    check_no_wave_shift(elastomer)?;
    if elastomer.modulus_factors() == ModulusFactors::NONE {
        Ok(())
    } else {
        Err(BemError::FactorsWithoutStationaryState)
    }
}

/// Refuses a shift by the wavelength, which has a meaning only under the stationary waves of a period.
pub(crate) fn check_no_wave_shift(elastomer: &dyn Elastomer) -> Result<(), BemError> {
    match elastomer.wave_shift() {
        None => Ok(()),
        Some(_) => Err(BemError::WaveShiftWithoutPeriod),
    }
}

impl<M: Material + ?Sized> Elastomer for M {
    /// The material itself.
    fn material(&self) -> Box<dyn Material + '_> {
        Box::new(self)
    }

    /// A half space of the same material.
    fn base(&self) -> Base {
        Base::default()
    }
}

/// Substrate under a layer of the material of the surface: a rigid base, another half space, or several layers.
///
/// The whole substrate creeps and relaxes like the material of the surface. Its compliance to a pressure wave is therefore at
/// all times the same multiple of that of the half space.
pub trait Substrate: Debug + Send + Sync {
    /// Thickness t of the layer of the material of the surface, \[m]. Waves of the length t/4 and less see a half space;
    /// the longer a wave, the more the substrate matters.
    fn thickness(&self) -> f64;

    /// Compliance ratio M(s): ratio of the compliance of the surface to a pressure wave of the wave number s/t, s ≥ 0, to that of
    /// a half space of the material at the surface. It must tend to 1 for short waves like s² e^(−2s) or faster.
    fn compliance_ratio(&self, s: f64, poisson_ratio: f64) -> f64;

    /// Excess M(s) − 1 of the compliance ratio. Implement it if the default, a difference, cancels and displacements are wanted to
    /// better than 1e-12.
    fn compliance_excess(&self, s: f64, poisson_ratio: f64) -> f64 {
        self.compliance_ratio(s, poisson_ratio) - 1.0
    }

    /// Compliance to uniform pressure, lim t M(s)/s for s → 0: displacement over pressure, times E*/2, in the unit of `thickness`.
    /// Infinite, which is the default, unless the substrate rests on a rigid base.
    fn uniform_compliance(&self, _thickness: f64, _poisson_ratio: f64) -> f64 {
        f64::INFINITY
    }

    /// Influence radius: distance from a load beyond which the displacement is negligible, in thicknesses. The default, infinite,
    /// is always right but slower.
    fn influence_radius(&self) -> f64 {
        f64::INFINITY
    }
}

/// Base of the material at the surface: a half space of the same material, which is the default, or a [`Substrate`].
///
/// Lengths are in \[m]. The table of the substrate's potential is computed at first use and shared by all clones.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Base(Option<LayeredBase>);

/// A substrate with the thickness of the layer on it.
#[derive(Debug, Clone)]
struct LayeredBase {
    /// Thickness of the layer, \[m] or in the unit of [`Base::in_units_of`].
    thickness: f64,
    /// The substrate and its potential, for all clones.
    shared: Arc<TabulatedSubstrate>,
}

/// A substrate with the table of its potential for one Poisson ratio.
#[derive(Debug)]
struct TabulatedSubstrate {
    /// Compliance ratio of the surface.
    substrate: Box<dyn Substrate>,
    /// Poisson ratio ν of the material at the surface.
    poisson_ratio: f64,
    /// Correction c(ρ) of the potential, tabulated at first use.
    correction: OnceLock<Correction>,
}

impl PartialEq for LayeredBase {
    /// True for the same thickness and the same substrate in memory: clones are equal, and substrates made alike are not.
    fn eq(&self, other: &Self) -> bool {
        let has_equal_thickness = self.thickness.total_cmp(&other.thickness).is_eq();
        has_equal_thickness && Arc::ptr_eq(&self.shared, &other.shared)
    }
}

impl LayeredBase {
    /// Compliance ratio M(s) to a pressure wave of the wave number s/t, for the thickness t.
    fn compliance_ratio(&self, s: f64) -> f64 {
        self.shared
            .substrate
            .compliance_ratio(s, self.shared.poisson_ratio)
    }

    /// Compliance to uniform pressure, lim t M(s)/s for s → 0, in the unit of the thickness; infinite without a rigid base.
    fn uniform_compliance(&self) -> f64 {
        let TabulatedSubstrate {
            substrate,
            poisson_ratio,
            ..
        } = &*self.shared;
        substrate.uniform_compliance(self.thickness, *poisson_ratio)
    }
}

impl Base {
    /// A substrate under a layer of a material with the given Poisson ratio.
    ///
    /// # Errors
    /// [`InvalidParameter`] for a thickness or a compliance ratio that is not finite and positive, and for a compliance ratio that
    /// is not 1 for short waves.
    pub fn new(
        substrate: impl Substrate + 'static,
        poisson_ratio: f64,
    ) -> Result<Self, InvalidParameter> {
        // M must be positive for wave numbers s from 2^−20 to 16, and 1 for short waves.
        let thickness = positive("thickness", substrate.thickness())?;
        for power in -20..5 {
            let ratio = substrate.compliance_ratio(f64::from(power).exp2(), poisson_ratio);
            positive("compliance ratio of a wave", ratio)?;
        }
        let short = substrate.compliance_ratio(MAX_WAVE_NUMBER, poisson_ratio);
        let allowed = "1 within 1e-12 for waves of a quarter of the thickness (s = 24)";
        let is_half_space = (short - 1.0).abs() <= 1e-12;
        in_range("compliance ratio of a wave", short, is_half_space, allowed)?;
        let shared = TabulatedSubstrate {
            substrate: Box::new(substrate),
            poisson_ratio,
            correction: OnceLock::new(),
        };
        Ok(Self(Some(LayeredBase {
            thickness,
            shared: Arc::new(shared),
        })))
    }

    /// The base with lengths in units of `edge`, the edge of an element.
    ///
    /// # Errors
    /// [`InvalidParameter`] for a layer thinner than 1/[`MAX_EDGE_OVER_THICKNESS`] of the edge.
    pub(crate) fn in_units_of(&self, edge: f64) -> Result<Self, InvalidParameter> {
        let Some(layered) = self.0.clone() else {
            return Ok(Self(None));
        };
        let is_resolved = layered.thickness >= edge / MAX_EDGE_OVER_THICKNESS;
        let allowed = "at least 1/32 of the edge of an element (below about 1/150 of the contact a layer is a Winkler \
                       foundation, or where it is incompressible a film)";
        in_range("thickness", layered.thickness, is_resolved, allowed)?;
        let thickness = layered.thickness / edge;
        Ok(Self(Some(LayeredBase {
            thickness,
            ..layered
        })))
    }

    /// Refuses a material that flows on a substrate that is neither rigid nor the half space itself: its flow is not known.
    pub(crate) fn check_flow(&self, fluidity: f64) -> Result<(), InvalidParameter> {
        let is_flow_known = fluidity <= 0.0 || self.is_half_space() || self.is_rigid();
        let allowed = "0 on a substrate that is neither rigid nor the half space itself";
        in_range("fluidity", fluidity, is_flow_known, allowed).map(drop)
    }

    /// True without a substrate of another material.
    pub(crate) const fn is_half_space(&self) -> bool {
        self.0.is_none()
    }

    /// True if the substrate rests on a rigid base, so that its compliance to uniform pressure is finite.
    pub(crate) fn is_rigid(&self) -> bool {
        self.0
            .as_ref()
            .is_some_and(|layered| layered.uniform_compliance().is_finite())
    }

    /// Thickness of the layer of the material at the surface; infinite for a half space.
    pub(crate) fn thickness(&self) -> f64 {
        self.0
            .as_ref()
            .map_or(f64::INFINITY, |layered| layered.thickness)
    }

    /// Compliance ratio M(s) for a wave of the wave number s/t; 1 on a half space.
    pub(crate) fn compliance_ratio(&self, s: f64) -> f64 {
        self.0
            .as_ref()
            .map_or(1.0, |layered| layered.compliance_ratio(s))
    }

    /// Reduced wave number |q|/M(|q|t) for |q| > 0: a half space has the stiffness of the layer at this wave number. Times E*/2 it is the
    /// ratio of pressure and displacement of a wave.
    pub(crate) fn reduced_wave_number(&self, wave_number: f64) -> f64 {
        self.0.as_ref().map_or(wave_number, |layered| {
            wave_number / layered.compliance_ratio(wave_number * layered.thickness)
        })
    }

    /// Like [`reduced_wave_number`](Self::reduced_wave_number), with wave numbers below 2/t replaced by 2/t: to longer waves an
    /// incompressible layer is stiff because it must be squeezed aside, which depends on the load around.
    pub(crate) fn local_wave_number(&self, wave_number: f64) -> f64 {
        let longest = self
            .0
            .as_ref()
            .map_or(0.0, |layered| 2.0 / layered.thickness);
        self.reduced_wave_number(wave_number.max(longest))
    }

    /// Compliance to uniform pressure, lim M(|q|t)/|q| for q → 0, in units of 2/E*; 0 without a rigid base, where it would be
    /// infinite and displacements are measured from their mean.
    pub(crate) fn uniform_compliance(&self) -> f64 {
        let mean = self.0.as_ref().map(LayeredBase::uniform_compliance);
        mean.filter(|mean| mean.is_finite()).unwrap_or(0.0)
    }

    /// Estimated compliance ratio M under a load of about the given `length`, which has the unit of the thickness: M at the wave number
    /// 4/(π length).
    pub(crate) fn compliance_ratio_under_punch(&self, length: f64) -> f64 {
        // At this wave number a Winkler foundation has the ratio of a flat punch of the radius `length`.
        let wave_number = FRAC_PI_4.recip() / length;
        wave_number / self.reduced_wave_number(wave_number)
    }

    /// Ratio of the largest height of a body h ∼ r^p that may be in contact to that on a half space; p is the `exponent`.
    ///
    /// A thin, nearly incompressible layer piles up around the contact. If it is incompressible and thin compared with the contact,
    /// it meets the body up to the height (1 + p/2) d at the depth d. `half_length` is half the length of the contact without
    /// pile-up, in the unit of the thickness.
    pub(crate) fn pile_up_factor(&self, half_length: f64, exponent: f64) -> f64 {
        self.0.as_ref().map_or(1.0, |layered| {
            let slenderness = (half_length / layered.thickness / THIN_LAYER_RATIO).min(1.0);
            // The weight of the compressible limit, which has no pile-up, rises from 0 at ν = 0.5 to 1 at ν ≤ 0.4. Chosen.
            let compressibility = (10.0 * (0.5 - layered.shared.poisson_ratio)).clamp(0.0, 1.0);
            1.0 + slenderness * (PILE_UP_MARGIN + 0.5 * exponent * (1.0 - compressibility))
        })
    }

    /// Influence radius of a load, in the unit of the thickness; infinite for a half space.
    pub(crate) fn influence_radius(&self) -> f64 {
        self.0.as_ref().map_or(f64::INFINITY, |layered| {
            layered.shared.substrate.influence_radius() * layered.thickness
        })
    }

    /// Influence coefficient of a uniformly loaded rectangle, with arguments and unit of [`influence`].
    pub(crate) fn influence(&self, offset: [f64; 2], edges: [f64; 2]) -> f64 {
        let Some(layered) = &self.0 else {
            return influence(offset, edges);
        };
        // Cut off the parts of the rectangle beyond the influence radius, because their loads displace the surface negligibly.
        let radius = self.influence_radius();
        let [mut centre, mut cut_edges] = [offset, edges];
        for axis in 0..2 {
            let half = 0.5 * edges[axis];
            let [first, last] = [
                (offset[axis] - half).max(-radius),
                (offset[axis] + half).min(radius),
            ];
            if first >= last {
                return 0.0;
            }
            if last - first < edges[axis] {
                (centre[axis], cut_edges[axis]) = (0.5 * (first + last), last - first);
            }
        }

        // Add Love's integral of 1/r over the rectangle and the integral of the smooth correction c(r/t)/t.
        let unit = layered.thickness;
        let TabulatedSubstrate {
            substrate,
            poisson_ratio,
            correction,
        } = &*layered.shared;
        let table = correction.get_or_init(|| Correction::new(&**substrate, *poisson_ratio));
        let [offset, edges] =
            [centre, cut_edges].map(|lengths| lengths.map(|length| length / unit));
        let smooth = integrate_smooth(SINGULARITY_DISTANCE, offset, edges, &|x, y| {
            table.value((x * x + y * y).sqrt())
        });
        influence(centre, cut_edges) + unit * smooth
    }
}

/// Largest ratio of the edge of an element to the thickness of the layer. Chosen: on the coarsest grid, five elements along the
/// contact, a thinner layer is below 1/160 of the contact. It is refused, because it acts as a Winkler foundation or, if it is
/// incompressible, as a film.
pub(crate) const MAX_EDGE_OVER_THICKNESS: f64 = 32.0;
/// Ratio of the half length of the contact to the thickness from which on a layer piles up fully in [`Base::pile_up_factor`].
/// Chosen; from 0.5 to 10 nothing changes (case of `evidence tuning`).
const THIN_LAYER_RATIO: f64 = 5.0;
/// Margin that [`Base::pile_up_factor`] adds on a thin layer beyond the pile-up itself, as a fraction of the height. Chosen; with
/// 2 a bar is 5.5 times as wide, with 0.1 half as wide (case of `evidence tuning`).
const PILE_UP_MARGIN: f64 = 0.2;
/// Distance from ρ = 0 to the nearest singularities ρ = ±2i of c(ρ). Derived from 1 − M ∼ s² e^(−2s), whose transform with J₀(sρ) is
/// analytic for |Im ρ| < 2.
pub(super) const SINGULARITY_DISTANCE: f64 = 2.0;

#[cfg(test)]
mod tests {
    use rheology::Elastic;

    use super::*;
    use crate::Layer;

    /// Its parts are integrated by shorter rules.
    #[test]
    fn a_rectangle_moves_the_surface_like_its_parts() {
        let material = Elastic::new(1.0).expect("a modulus");
        for thickness in [0.3, 1.0, 2.6, 4.2, 13.0, 130.0] {
            let base = Layer::new(&material, thickness)
                .expect("a thickness")
                .base();
            for [x, y] in [[0.0, 0.0], [2.0, 1.0], [9.0, 30.0]] {
                let part = |index: u8| {
                    let [row, column] = [index / 4, index % 4].map(|n| f64::from(n) / 4.0 - 0.375);
                    base.influence([x + row, y + 0.5 * column], [0.25, 0.125])
                };
                let whole = base.influence([x, y], [1.0, 0.5]);
                let error = (0..16).map(part).sum::<f64>() - whole;
                assert!(error.abs() < 5e-12, "{error:e} at {x}, {y} on {thickness}");
            }
        }
    }
}
