//! What a surface is pressed into, and what lies under its material.
//!
//! A wave of pressure moves the surface by `û = 2 p̂ M(|q|t)/(|q| E*)`, with E* as for the half space of the material, where M
//! is 1. So every half-space method answers for another substrate when the potential 1/r of a point is replaced by
//!
//! ```text
//! 1/r + c(r/t)/t,        c(ρ) = ∫_0^∞ [M(s) − 1] J₀(sρ) ds,
//! ```
//!
//! of which the second part is analytic for |Im ρ| < 2. On a rigid base both together decay like e^(−0.7 ρ) or faster.

use std::f64::consts::FRAC_PI_4;
use std::fmt::Debug;
use std::sync::{Arc, OnceLock};

use numerics::{InvalidParameter, in_range, positive};
use rheology::Material;

use crate::influence;
use crate::substrate::correction::{Correction, MAX_WAVE_NUMBER};
use crate::substrate::rectangle::integrate_smooth;

/// What a surface is pressed into: every [`Material`] stands for a half space, and [`Layer`](crate::Layer) puts a layer of it
/// on a base.
pub trait Elastomer {
    /// What it is made of at the surface.
    fn material(&self) -> Box<dyn Material + '_>;

    /// What that lies on.
    fn base(&self) -> Base;
}

impl<M: Material + ?Sized> Elastomer for M {
    fn material(&self) -> Box<dyn Material + '_> {
        Box::new(self)
    }

    fn base(&self) -> Base {
        Base::default()
    }
}

/// What lies under a layer of the material of the surface: a rigid base, another half space, layers upon layers.
///
/// All of it creeps and relaxes like the material of the surface, so that its compliance to waves is at all times the same
/// multiple of that of the half space.
pub trait Substrate: Debug + Send + Sync {
    /// Thickness t of the layer of the material of the surface, \[m]. The longer waves are than that, the more of them the
    /// substrate feels; those of t/4 and less see a half space.
    fn thickness(&self) -> f64;

    /// Ratio M of the compliance of the surface to that of the half space of its material, for a wave of pressure of the wave
    /// number s/t, with s ≥ 0 and the Poisson ratio of the material. It tends to 1 for short waves, like s² e^(−2s) or faster.
    fn compliance_ratio(&self, s: f64, poisson_ratio: f64) -> f64;

    /// M − 1; to be given where that cancels and more than 1e-12 of the displacement is wanted.
    fn compliance_excess(&self, s: f64, poisson_ratio: f64) -> f64 {
        self.compliance_ratio(s, poisson_ratio) - 1.0
    }

    /// Limit of t M(s)/s for long waves, in the unit in which the thickness t is given here: by how much the mean pressure
    /// moves the surface, times E*/2. Infinite, as it is by default, unless the whole rests on something rigid.
    fn uniform_compliance(&self, _thickness: f64, _poisson_ratio: f64) -> f64 {
        f64::INFINITY
    }

    /// Distance beyond which a load moves nothing, in thicknesses; infinite by default, with which all is right but slower.
    fn influence_radius(&self) -> f64 {
        f64::INFINITY
    }
}

/// What the material of a surface lies on: itself, as a half space, which is the default, or a [`Substrate`], with the
/// table of its potential, which is made when it is first needed and shared by all clones.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Base(Option<LayeredBase>);

/// A substrate, with the thickness of the layer on it in the unit of the lengths of a grid.
#[derive(Debug, Clone)]
struct LayeredBase {
    thickness: f64,
    shared: Arc<TabulatedSubstrate>,
}

#[derive(Debug)]
struct TabulatedSubstrate {
    substrate: Box<dyn Substrate>,
    poisson_ratio: f64,
    correction: OnceLock<Correction>,
}

impl PartialEq for LayeredBase {
    fn eq(&self, other: &Self) -> bool {
        let is_as_thick = self.thickness.total_cmp(&other.thickness).is_eq();
        is_as_thick && Arc::ptr_eq(&self.shared, &other.shared)
    }
}

impl LayeredBase {
    fn compliance_ratio(&self, s: f64) -> f64 {
        self.shared
            .substrate
            .compliance_ratio(s, self.shared.poisson_ratio)
    }

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
    /// A substrate under a layer of a material with the Poisson ratio.
    ///
    /// # Errors
    /// [`InvalidParameter`] for a thickness or a compliance ratio that is not finite and positive, and for one that is not 1
    /// for short waves.
    pub fn new(
        substrate: impl Substrate + 'static,
        poisson_ratio: f64,
    ) -> Result<Self, InvalidParameter> {
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

    /// The same with lengths in edges of an element; refuses a layer that is thinner by far.
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

    /// Refuses a material that flows on a substrate that is not rigid below: its flow is known on a half space only.
    pub(crate) fn check_flow(&self, fluidity: f64) -> Result<(), InvalidParameter> {
        let is_known = fluidity <= 0.0 || self.is_half_space() || self.is_rigid();
        let allowed = "0 on a substrate that is neither rigid nor the half space itself";
        in_range("fluidity", fluidity, is_known, allowed).map(drop)
    }

    pub(crate) const fn is_half_space(&self) -> bool {
        self.0.is_none()
    }

    /// Whether there is something rigid below, so that a load is not felt far away.
    pub(crate) fn is_rigid(&self) -> bool {
        self.0
            .as_ref()
            .is_some_and(|layered| layered.uniform_compliance().is_finite())
    }

    /// Thickness of the layer of the material; infinite for a half space.
    pub(crate) fn thickness(&self) -> f64 {
        self.0
            .as_ref()
            .map_or(f64::INFINITY, |layered| layered.thickness)
    }

    /// M(s) for a wave of the wave number s over the thickness.
    pub(crate) fn compliance_ratio(&self, s: f64) -> f64 {
        self.0
            .as_ref()
            .map_or(1.0, |layered| layered.compliance_ratio(s))
    }

    /// |q|/M(|q|t), the |q| > 0 of the wave that a half space would resist as much.
    pub(crate) fn stiffness(&self, wave_number: f64) -> f64 {
        self.0.as_ref().map_or(wave_number, |layered| {
            wave_number / layered.compliance_ratio(wave_number * layered.thickness)
        })
    }

    /// The same, and for waves longer than about the thickness that of a wave as long: what an incompressible layer resists in
    /// longer ones depends on the load around, which it is squeezed out under.
    pub(crate) fn local_stiffness(&self, wave_number: f64) -> f64 {
        let longest = self
            .0
            .as_ref()
            .map_or(0.0, |layered| 2.0 / layered.thickness);
        self.stiffness(wave_number.max(longest))
    }

    /// M/|q| of the mean: by how much a layer on a rigid base gives way under a load that is the same everywhere; 0 where
    /// displacements are measured from their mean because that would be infinite.
    pub(crate) fn uniform_compliance(&self) -> f64 {
        let mean = self.0.as_ref().map(LayeredBase::uniform_compliance);
        mean.filter(|mean| mean.is_finite()).unwrap_or(0.0)
    }

    /// By how much softer than a half space the base is under a load of about that length.
    pub(crate) fn compliance_ratio_under_punch(&self, length: f64) -> f64 {
        // A Winkler foundation gives way under a flat punch of that radius by as much.
        let wave_number = FRAC_PI_4.recip() / length;
        wave_number / self.stiffness(wave_number)
    }

    /// Where contact may occur over about that length from the middle of a body h ∼ r^p, as a multiple of the heights where a
    /// half space may be touched: a thin layer that hardly shrinks rises around the contact, and meets the body up to the
    /// height (1 + p/2) d where it does not shrink at all.
    pub(crate) fn pile_up_factor(&self, half_length: f64, exponent: f64) -> f64 {
        self.0.as_ref().map_or(1.0, |layered| {
            let slenderness = (half_length / layered.thickness / THIN_LAYER_RATIO).min(1.0);
            let shrinks = (10.0 * (0.5 - layered.shared.poisson_ratio)).clamp(0.0, 1.0);
            1.0 + slenderness * (PILE_UP_MARGIN + 0.5 * exponent * (1.0 - shrinks))
        })
    }

    /// Distance beyond which nothing moves.
    pub(crate) fn influence_radius(&self) -> f64 {
        self.0.as_ref().map_or(f64::INFINITY, |layered| {
            layered.shared.substrate.influence_radius() * layered.thickness
        })
    }

    /// Displacement by a uniformly loaded rectangle, as [`influence`].
    pub(crate) fn influence(&self, offset: [f64; 2], edges: [f64; 2]) -> f64 {
        let Some(layered) = &self.0 else {
            return influence(offset, edges);
        };
        // Of the rectangle only what is not too far to move anything.
        let reach = self.influence_radius();
        let [mut centre, mut seen] = [offset, edges];
        for axis in 0..2 {
            let half = 0.5 * edges[axis];
            let [first, last] = [
                (offset[axis] - half).max(-reach),
                (offset[axis] + half).min(reach),
            ];
            if first >= last {
                return 0.0;
            }
            if last - first < edges[axis] {
                (centre[axis], seen[axis]) = (0.5 * (first + last), last - first);
            }
        }
        let unit = layered.thickness;
        let TabulatedSubstrate {
            substrate,
            poisson_ratio,
            correction,
        } = &*layered.shared;
        let table = correction.get_or_init(|| Correction::new(&**substrate, *poisson_ratio));
        let [offset, edges] = [centre, seen].map(|lengths| lengths.map(|length| length / unit));
        let smooth = integrate_smooth(SINGULARITY_DISTANCE, (offset, edges), &|x, y| {
            table.at((x * x + y * y).sqrt())
        });
        influence(centre, seen) + unit * smooth
    }
}

/// Edge of an element in thicknesses, at most.
const MAX_EDGE_OVER_THICKNESS: f64 = 32.0;
/// From how many thicknesses on a layer is thin, and how much more room there is at its rim than that.
const THIN_LAYER_RATIO: f64 = 5.0;
const PILE_UP_MARGIN: f64 = 0.2;
/// Distance from 0 at which c is singular, along the imaginary axis.
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
