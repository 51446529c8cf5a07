//! Creep compliance of a material at a sliding speed, as a function of distance instead of time.
//!
//! In the frame of the indenter the material passes an element in the time Δx/v, and the creep compliance
//! `J(t) = J₀ + t/η_f + Σ J_k (1 − e^(−t/λ_k))` becomes a filter along x that looks ahead:
//!
//! ```text
//! u(ξ) = J₀ w(ξ) + (1/v) ∫_ξ^∞ J'((s − ξ)/v) w(s) ds
//! ```
//!
//! J₀ is the instantaneous compliance and η_f the viscosity of the free flow. The retardation elements have the compliances J_k
//! and the retardation times λ_k. The load potential w at the coordinate ξ along x causes the displacement u, and v is the
//! sliding speed. On a track of the length L the load is periodic with L, and the integral runs around the track infinitely
//! often.
//!
//! Moduli that have factors at the strain amplitude of the state have advanced elements, too (`rheology::StationaryCreep`). They are
//! filters that look behind.
//!
//! Theory: docs/theory/stationary-half-space.md, "Any linear viscoelastic material" and "A track".

use std::f64::consts::{FRAC_2_PI, PI};

use indenters::SlidingLoad;
use numerics::{finite, positive};
use rheology::{ComplexCompliance, Material as _, StationaryCreep, check_spectra};

use crate::substrate::base::check_no_wave_shift;
use crate::{Base, BemError, Elastomer};

/// Rate Δx/(v λ) of the retardation element that replaces the free flow of a layer on a rigid base, whose influence radius is
/// finite. Derived: 1 − e^(−rate s) equals rate·s to rounding for all distances s up to 1/ε, in Δx, beyond which positions
/// are not exact.
pub(super) const FLOW_AS_RETARDATION_RATE: f64 = f64::EPSILON * f64::EPSILON;

/// The creep of a material on its base at a sliding speed, on a track if there is one.
#[derive(Debug, Clone)]
pub(super) struct SlidingCreep {
    /// Creep of the material in shear, at the strain amplitude of the state.
    creep: StationaryCreep,
    /// Factor 2 (1 − ν) of the material.
    half_space_factor: f64,
    /// Sliding velocity v, \[m/s].
    velocity: f64,
    /// Length of the track, after which the load returns to the same place, \[m].
    track: Option<f64>,
    /// Base under the material.
    base: Base,
}

/// The creep compliance over one element, as fractions of J(Δx/v). Kernel tables depend on nothing else but the aspect ratio.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct ElementCreep {
    /// Position of the collocation point, where the gap of an element is evaluated, in elements from its centre. −1/2 is the rear edge.
    pub(super) collocation_shift: f64,
    /// Fraction of the instantaneous compliance J₀.
    pub(super) instantaneous: f64,
    /// Fraction of the free flow.
    pub(super) flow: f64,
    /// Retardation elements, with their fractions.
    pub(super) retardations: Vec<RetardationElement>,
    /// Elements that look behind instead of ahead, with fractions of either sign.
    pub(super) advanced: Vec<RetardationElement>,
    /// Length of the track in Δx; `None` without a track.
    pub(super) track: Option<f64>,
    /// The base, with lengths in Δx.
    pub(super) base: Base,
}

/// A retardation element of the material, over the length of one element of the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RetardationElement {
    /// Rate Δx/(v λ) of the exponential over one element of the grid.
    pub(super) rate: f64,
    /// Fraction of J_k (1 − e^(−Δx/(vλ))) in J(Δx/v).
    pub(super) share: f64,
}

/// The creep compliance, times 2 (1 − ν), as a function of the distance that a load has moved.
#[derive(Debug, Clone)]
pub(super) struct CreepOverDistance {
    /// Instantaneous compliance, \[1/Pa].
    pub(super) instantaneous: f64,
    /// Compliance of the free flow per length, [1/(Pa m)].
    pub(super) flow_per_length: f64,
    /// Retardation elements.
    pub(super) retardations: Vec<RetardationOverDistance>,
}

/// A retardation element as a function of distance.
#[derive(Debug, Clone, Copy)]
pub(super) struct RetardationOverDistance {
    /// Compliance 2 (1 − ν) J_k, \[1/Pa].
    pub(super) compliance: f64,
    /// Memory length v λ, \[m].
    pub(super) memory_length: f64,
}

impl RetardationElement {
    /// Factor e^(−Δx/(vλ)) by which the strain relaxes over one element of the grid.
    pub(super) fn decay(&self) -> f64 {
        (-self.rate).exp()
    }

    /// Fraction of the compliance J_k in J(Δx/v).
    pub(super) fn compliance(&self) -> f64 {
        -self.share / (-self.rate).exp_m1()
    }
}

impl SlidingCreep {
    /// The creep at the velocity of a load, on its track if it has one.
    ///
    /// # Errors
    /// [`BemError::NoCycle`] for a material that flows on a track, [`BemError::FactorsOnTrack`] for factors of the moduli on one.
    pub(super) fn for_load(
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
    ) -> Result<Self, BemError> {
        let creep = Self {
            track: load.track(),
            ..Self::new(elastomer, load.velocity())?
        };
        if creep.track.is_some() && creep.creep.retarded().fluidity() > 0.0 {
            return Err(BemError::NoCycle);
        }
        if creep.track.is_some() && !creep.creep.advanced().is_empty() {
            return Err(BemError::FactorsOnTrack);
        }
        Ok(creep)
    }

    /// Creep of the material of an elastomer as a function of the distance at a sliding speed \[m/s], without a track.
    pub(super) fn new(elastomer: &dyn Elastomer, velocity: f64) -> Result<Self, BemError> {
        let (material, base) = (elastomer.material(), elastomer.base());
        check_spectra(&material)?;
        check_no_wave_shift(elastomer)?;
        let creep = StationaryCreep::new(&material, elastomer.modulus_factors())?;
        base.check_flow(creep.retarded().fluidity())?;
        Ok(Self {
            creep,
            half_space_factor: positive("half-space factor", material.half_space_factor())?,
            velocity: positive("velocity", velocity)?,
            track: None,
            base,
        })
    }

    /// This creep law on another base, and on a track of a length \[m] or, with `None`, on fresh ground.
    pub(super) fn on_base(self, base: Base, track: Option<f64>) -> Self {
        Self {
            base,
            track,
            ..self
        }
    }

    /// True for a half space of a dashpot alone. On it, contact is possible only where the body rises.
    pub(super) fn only_flows(&self) -> bool {
        self.fluidity() > 0.0
            && self.creep.retarded().instantaneous_compliance() == 0.0
            && self.creep.retarded().elements().is_empty()
    }

    /// True for an elastic material, which dissipates nothing.
    pub(super) fn is_elastic(&self) -> bool {
        self.creep.is_elastic()
    }

    /// Fluidity 1/η_f of a half space, [1/(Pa s)]; 0 for a layer on a rigid base, whose finite influence radius keeps the depth
    /// finite.
    pub(super) fn fluidity(&self) -> f64 {
        if self.base.is_rigid() {
            0.0
        } else {
            self.creep.retarded().fluidity()
        }
    }

    /// Wave number along x of the waves that the material passes at an angular frequency, [rad/m].
    pub(super) fn wave_number(&self, frequency: f64) -> f64 {
        frequency / self.velocity
    }

    /// Storage and loss compliance J' and J'', times 2 (1 − ν), for a wave number along x [rad/m].
    pub(super) fn compliance_of_wave(
        &self,
        wave_number: f64,
    ) -> Result<ComplexCompliance, BemError> {
        let compliance = self.creep.complex_compliance(wave_number * self.velocity)?;
        Ok(ComplexCompliance {
            storage: self.half_space_factor * compliance.storage,
            loss: self.half_space_factor * compliance.loss,
        })
    }

    /// Base under the material.
    pub(super) const fn base(&self) -> &Base {
        &self.base
    }

    /// Length of the track, \[m]. `None` on fresh ground.
    pub(super) const fn track(&self) -> Option<f64> {
        self.track
    }

    /// Memory length v λ_max of the slowest retarded or advanced element, at most the track; for a flowing layer at least its influence
    /// radius, \[m].
    pub(super) fn memory_length(&self) -> f64 {
        let retarded = self.creep.retarded().elements().iter();
        let times = retarded
            .chain(self.creep.advanced())
            .map(|element| element.retardation_time);
        let retarded =
            (self.velocity * times.fold(0.0, f64::max)).min(self.track.unwrap_or(f64::INFINITY));
        if self.creep.retarded().fluidity() > 0.0 && self.base.is_rigid() {
            retarded.max(self.base.influence_radius())
        } else {
            retarded
        }
    }

    /// The creep as a function of distance.
    pub(super) fn over_distance(&self) -> CreepOverDistance {
        let retarded = self.creep.retarded();
        let elements = retarded.elements().iter();
        let retardations = elements.map(|element| RetardationOverDistance {
            compliance: self.half_space_factor * element.compliance,
            memory_length: self.velocity * element.retardation_time,
        });
        CreepOverDistance {
            instantaneous: self.half_space_factor * retarded.instantaneous_compliance(),
            flow_per_length: self.flow_per_length(),
            retardations: retardations.collect(),
        }
    }

    /// Compliance 2 (1 − ν)/(η_f v) of the free flow per length, [1/(Pa m)].
    pub(super) fn flow_per_length(&self) -> f64 {
        self.half_space_factor * self.creep.retarded().fluidity() / self.velocity
    }

    /// Compliance of a contact of about `length` after a sliding distance: 2 (1 − ν) J(length/v), times the ratio of the
    /// compliances of a layer and a half space, \[1/Pa]. On a track a retardation element contributes the fraction `(1 −
    /// e^(−length/(vλ)))/(1 − e^(−L/(vλ)))`, which contains the effect of all passes before.
    pub(super) fn compliance_of_contact(
        &self,
        length: f64,
        sliding_distance: f64,
    ) -> Result<f64, BemError> {
        let passed = length.min(sliding_distance);
        let mut parts = self.contributions(passed)?;
        if let Some(track) = self.track {
            for retardation in &mut parts.retardations {
                retardation.share /= -(-retardation.rate * (track / passed)).exp_m1();
            }
        }
        let total = self.half_space_factor * self.total_compliance(&parts, passed)?;
        let compliance = positive("compliance over a length", total)?;
        Ok(compliance * self.base.compliance_ratio_under_punch(length))
    }

    /// Compliance 2 (1 − ν) J(length/v) \[1/Pa] for the time in which the material passes a `length` \[m].
    pub(super) fn compliance(&self, length: f64) -> Result<f64, BemError> {
        let parts = self.contributions(length)?;
        let total = self.half_space_factor * self.total_compliance(&parts, length)?;
        Ok(positive("compliance over a length", total)?)
    }

    /// The creep over elements of the length `spacing` \[m], as fractions of J(Δx/v), with lengths in Δx.
    pub(super) fn over_element(&self, spacing: f64) -> Result<ElementCreep, BemError> {
        // Divide all parts of the creep by the total compliance over the element.
        let mut parts = self.contributions(spacing)?;
        let total = self.total_compliance(&parts, spacing)?;
        let total = positive("compliance over an element", total)?;
        parts.instantaneous /= total;
        parts.flow /= total;
        for retardation in &mut parts.retardations {
            retardation.share /= total;
            positive(
                "compliance of a retardation element",
                retardation.compliance(),
            )?;
        }
        for advanced in &mut parts.advanced {
            advanced.share /= total;
            finite("compliance of an advanced element", advanced.compliance())?;
        }
        // Convert the collocation point, the track and the base to units of the element.
        parts.collocation_shift = self.collocation_shift(spacing)?;
        parts.track = self.track.map(|track| track / spacing);
        parts.base = self.base.in_units_of(spacing)?;
        // Under a layer on a rigid base the free flow is a very slow retardation element.
        if parts.base.is_rigid() && parts.flow > 0.0 {
            let (rate, share) = (FLOW_AS_RETARDATION_RATE, parts.flow);
            parts.retardations.push(RetardationElement { rate, share });
            parts.flow = 0.0;
        }
        Ok(parts)
    }

    /// Contributions of all parts of the creep to the compliance J(length/v), \[1/Pa], not yet divided by it; `length` is in \[m].
    fn contributions(&self, length: f64) -> Result<ElementCreep, BemError> {
        let time = positive("length / velocity", length / self.velocity)?;
        // Over the time of passage t an element creeps by its compliance times 1 − e^(−t/τ).
        let over_length = |element: &rheology::RetardationElement| {
            let rate = time / element.retardation_time;
            let rate = positive("length / (velocity × retardation time)", rate)?;
            let share = -element.compliance * (-rate).exp_m1();
            Ok(RetardationElement { rate, share })
        };
        let retarded = self.creep.retarded();
        let retardations = retarded.elements().iter().map(over_length);
        let advanced = self.creep.advanced().iter().map(over_length);
        Ok(ElementCreep {
            collocation_shift: 0.0,
            instantaneous: retarded.instantaneous_compliance(),
            flow: retarded.fluidity() * time,
            retardations: retardations.collect::<Result<_, BemError>>()?,
            advanced: advanced.collect::<Result<_, BemError>>()?,
            track: None,
            base: Base::default(),
        })
    }

    /// Compliance that belongs to contributions over a length \[m], in their unit: J(length/v), and for a creep with advanced elements,
    /// which has no creep compliance over time, |J*| at the angular frequency v/length.
    fn total_compliance(&self, parts: &ElementCreep, length: f64) -> Result<f64, BemError> {
        if parts.advanced.is_empty() {
            let retarded: f64 = parts.retardations.iter().map(|one| one.share).sum();
            return Ok(parts.instantaneous + parts.flow + retarded);
        }
        let compliance = self.creep.complex_compliance(self.velocity / length)?;
        Ok(compliance.storage.hypot(compliance.loss))
    }

    /// Fraction of the friction that elements of the length Δx may miss, at a contact of the half length a.
    ///
    /// If the memory length λv of a retardation element is shorter than an element, slow friction falls by up to (4/π) λv/a under a
    /// paraboloid. The rear of the contact moves then, and its front does not. At a memory length of one or two elements some of that
    /// remains, which falls faster than any power of Δx. Cylinders on a Kelvin–Voigt solid err by up to the factor e^(−2.5 λv/Δx).
    ///
    /// Around a kink the pressure grows like ln(1/r) down to r = λv, and the friction like ln(a/λv), of which elements resolve
    /// ln(a/Δx). Under flat cones they miss up to the fraction e^(−x) ln(1 + 1/x) / ln(1 + a/Δx) with x = λv/(2Δx).
    pub(super) fn subgrid_friction_fraction(
        &self,
        spacing: f64,
        half_length: f64,
        kinks: f64,
    ) -> f64 {
        let (mut sum, mut missed) = (0.0, 0.0);
        let advanced = self.creep.advanced();
        for element in self.creep.retarded().elements().iter().chain(advanced) {
            let memory_length = self.velocity * element.retardation_time;
            let ratio = memory_length / half_length;
            // The friction of an element is largest where its memory length equals the half length of the contact.
            let friction = element.compliance.abs() * ratio.min(ratio.recip());
            // The exponent x is the ratio of the memory length to the length of two elements.
            let x = 0.5 * memory_length / spacing;
            let missed_at_kinks = (-x).exp() * x.recip().ln_1p() / (half_length / spacing).ln_1p();
            // Add the friction that is missed because of the moving rear of the contact, then that at the kinks of the body.
            sum += friction;
            missed += friction * 2.0 * FRAC_2_PI * ratio * (-5.0 * x).exp();
            missed += friction * kinks * missed_at_kinks;
        }
        if missed > 0.0 { missed / sum } else { 0.0 }
    }

    /// Collocation shift −δ/π, with the loss angle δ at the wave number π/Δx, the largest of the grid. It turns the phase of this
    /// wave back by δ, so that displacement and load are in phase; all longer waves are less than a quarter period apart.
    fn collocation_shift(&self, spacing: f64) -> Result<f64, BemError> {
        let angular_frequency = positive("π × velocity / spacing", PI * (self.velocity / spacing))?;
        let compliance = self.creep.complex_compliance(angular_frequency)?;
        Ok(-compliance.loss.atan2(compliance.storage) / PI)
    }
}
