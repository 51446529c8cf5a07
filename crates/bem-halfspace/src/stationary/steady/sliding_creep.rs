//! How the surface under a load that slides without end creeps, from one element to the next.
//!
//! In the frame of the indenter an element passes in the time Δx/v, and the creep compliance
//! `J(t) = J₀ + t/η_f + Σ J_k (1 − e^(−t/λ_k))` becomes a filter along x that looks ahead:
//!
//! ```text
//! u(ξ) = J₀ w(ξ) + (1/v) ∫_ξ^∞ J'((s − ξ)/v) w(s) ds
//! ```
//! On a track of the length L everything comes back, and the integral goes around again and again.

use std::f64::consts::{FRAC_2_PI, PI};

use indenters::SlidingLoad;
use numerics::positive;
use rheology::{ComplexCompliance, CreepSpectrum, Material as _, check_spectra};

use crate::{Base, BemError, Elastomer};

/// Rate of the retardation element that stands for a flow behind which the load is not felt without end.
pub(super) const FLOW_AS_RETARDATION_RATE: f64 = 1e-100;

/// A material at a sliding speed.
#[derive(Debug, Clone)]
pub(super) struct SlidingCreep {
    spectrum: CreepSpectrum,
    /// 2 (1 − ν).
    half_space_factor: f64,
    velocity: f64,
    /// Length after which the load comes back to the same place, \[m].
    track: Option<f64>,
    base: Base,
}

/// The creep compliance over one element, as parts of J(Δx/v): what the tables of the kernel depend on.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct ElementCreep {
    /// Where the gap of an element is evaluated, in elements from its centre: −1/2 is the rear edge.
    pub(super) collocation_shift: f64,
    /// Part of J₀.
    pub(super) instantaneous: f64,
    /// Part of the free flow.
    pub(super) flow: f64,
    pub(super) retardations: Vec<RetardationElement>,
    /// Length after which the load comes back to the same place, in Δx.
    pub(super) track: Option<f64>,
    /// With lengths in Δx.
    pub(super) base: Base,
}

/// A retardation element over the length of one element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RetardationElement {
    /// Δx/(v λ).
    pub(super) rate: f64,
    /// Part of J (1 − e^(−Δx/(vλ))).
    pub(super) share: f64,
}

/// The creep compliance, times 2 (1 − ν), over the length that a load has moved.
#[derive(Debug, Clone)]
pub(super) struct CreepOverDistance {
    /// At once, \[1/Pa].
    pub(super) instantaneous: f64,
    /// [1/(Pa m)].
    pub(super) flow_per_length: f64,
    /// Compliance \[1/Pa] and memory \[m] of each retardation element.
    pub(super) retardations: Vec<[f64; 2]>,
}

impl RetardationElement {
    /// e^(−Δx/(vλ)).
    pub(super) fn decay(&self) -> f64 {
        (-self.rate).exp()
    }

    /// Part of the whole compliance J.
    pub(super) fn compliance(&self) -> f64 {
        -self.share / (-self.rate).exp_m1()
    }
}

impl SlidingCreep {
    /// On the track of a load, if it has one; refuses a material that flows there.
    pub(super) fn for_load(
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
    ) -> Result<Self, BemError> {
        let creep = Self {
            track: load.track(),
            ..Self::new(elastomer, load.velocity())?
        };
        if creep.track.is_some() && creep.spectrum.fluidity() > 0.0 {
            return Err(BemError::NoCycle);
        }
        Ok(creep)
    }

    pub(super) fn new(elastomer: &dyn Elastomer, velocity: f64) -> Result<Self, BemError> {
        let (material, base) = (elastomer.material(), elastomer.base());
        check_spectra(&material)?;
        let spectrum = material.creep();
        base.check_flow(spectrum.fluidity())?;
        Ok(Self {
            spectrum,
            half_space_factor: positive("half-space factor", material.half_space_factor())?,
            velocity: positive("velocity", velocity)?,
            track: None,
            base,
        })
    }

    /// Whether there is nothing but a dashpot half space, under which only rising elements touch.
    pub(super) fn only_flows(&self) -> bool {
        self.fluidity() > 0.0
            && self.spectrum.instantaneous_compliance() == 0.0
            && self.spectrum.elements().is_empty()
    }

    /// Whether nothing is dissipated.
    pub(super) fn is_elastic(&self) -> bool {
        self.spectrum.fluidity() == 0.0 && self.spectrum.elements().is_empty()
    }

    /// Fluidity 1/η_f of a half space, [1/(Pa s)]; 0 on a rigid base, where a load is not felt far ahead, so that the surface does
    /// not sink without limit.
    pub(super) fn fluidity(&self) -> f64 {
        if self.base.is_rigid() {
            0.0
        } else {
            self.spectrum.fluidity()
        }
    }

    /// Wave number along x of what oscillates at an angular frequency in the material.
    pub(super) fn wave_number(&self, frequency: f64) -> f64 {
        frequency / self.velocity
    }

    /// Compliance J' and J'', times 2 (1 − ν), to what varies along x with a wave number.
    pub(super) fn compliance_of_wave(
        &self,
        wave_number: f64,
    ) -> Result<ComplexCompliance, BemError> {
        let compliance = self
            .spectrum
            .complex_compliance(wave_number * self.velocity)?;
        Ok(ComplexCompliance {
            storage: self.half_space_factor * compliance.storage,
            loss: self.half_space_factor * compliance.loss,
        })
    }

    pub(super) const fn base(&self) -> &Base {
        &self.base
    }

    /// Distance in which the slowest retardation element forgets, or is under the load again, or ahead of which a layer that
    /// flows does not feel the load, \[m].
    pub(super) fn memory_length(&self) -> f64 {
        let elements = self.spectrum.elements().iter();
        let times = elements.map(|element| element.retardation_time);
        let memory = self.velocity * times.fold(0.0, f64::max);
        let memory = memory.min(self.track.unwrap_or(f64::INFINITY));
        if self.spectrum.fluidity() > 0.0 && self.base.is_rigid() {
            memory.max(self.base.influence_radius())
        } else {
            memory
        }
    }

    /// The creep over lengths.
    pub(super) fn over_distance(&self) -> CreepOverDistance {
        let elements = self.spectrum.elements().iter();
        let retardations = elements.map(|element| {
            let memory = self.velocity * element.retardation_time;
            [self.half_space_factor * element.compliance, memory]
        });
        CreepOverDistance {
            instantaneous: self.half_space_factor * self.spectrum.instantaneous_compliance(),
            flow_per_length: self.flow_per_length(),
            retardations: retardations.collect(),
        }
    }

    /// Compliance 2 (1 − ν)/(η_f v) of the free flow, by which the surface sinks per length, [1/(Pa m)].
    pub(super) fn flow_per_length(&self) -> f64 {
        self.half_space_factor * self.spectrum.fluidity() / self.velocity
    }

    /// The same under a load of about that length after a sliding distance, by how much less a layer gives way than a half
    /// space; on a track with what the passes before have left, `(1 − e^(−length/(vλ)))/(1 − e^(−L/(vλ)))` of a retardation
    /// element.
    pub(super) fn compliance_of_contact(
        &self,
        length: f64,
        sliding_distance: f64,
    ) -> Result<f64, BemError> {
        let passed = length.min(sliding_distance);
        let mut parts = self.parts(passed)?;
        if let Some(track) = self.track {
            for retardation in &mut parts.retardations {
                retardation.share /= -(-retardation.rate * (track / passed)).exp_m1();
            }
        }
        let compliance = self.half_space_factor * total_compliance(&parts);
        let compliance = positive("compliance over a length", compliance)?;
        Ok(compliance * self.base.compliance_ratio_under_punch(length))
    }

    /// Compliance 2 (1 − ν) J(length/v), \[1/Pa].
    pub(super) fn compliance(&self, length: f64) -> Result<f64, BemError> {
        let parts = self.parts(length)?;
        let compliance = self.half_space_factor * total_compliance(&parts);
        Ok(positive("compliance over a length", compliance)?)
    }

    /// The creep over elements of the length Δx.
    pub(super) fn over_element(&self, spacing: f64) -> Result<ElementCreep, BemError> {
        let mut parts = self.parts(spacing)?;
        let total = positive("compliance over an element", total_compliance(&parts))?;
        parts.instantaneous /= total;
        parts.flow /= total;
        for retardation in &mut parts.retardations {
            retardation.share /= total;
            positive(
                "compliance of a retardation element",
                retardation.compliance(),
            )?;
        }
        parts.collocation_shift = self.collocation_shift(spacing)?;
        parts.track = self.track.map(|track| track / spacing);
        parts.base = self.base.in_units_of(spacing)?;
        if parts.base.is_rigid() && parts.flow > 0.0 {
            // The slowest element there is.
            let (rate, share) = (FLOW_AS_RETARDATION_RATE, parts.flow);
            parts.retardations.push(RetardationElement { rate, share });
            parts.flow = 0.0;
        }
        Ok(parts)
    }

    fn parts(&self, length: f64) -> Result<ElementCreep, BemError> {
        let time = positive("length / velocity", length / self.velocity)?;
        let retardations = self.spectrum.elements().iter().map(|element| {
            let rate = time / element.retardation_time;
            let rate = positive("length / (velocity × retardation time)", rate)?;
            let share = -element.compliance * (-rate).exp_m1();
            Ok(RetardationElement { rate, share })
        });
        Ok(ElementCreep {
            collocation_shift: 0.0,
            instantaneous: self.spectrum.instantaneous_compliance(),
            flow: self.spectrum.fluidity() * time,
            retardations: retardations.collect::<Result<_, BemError>>()?,
            track: None,
            base: Base::default(),
        })
    }

    /// Part of the friction that elements of the length Δx may miss at a contact of half the length a: of a retardation element
    /// that forgets within an element, slow friction falls by up to (4/π) λv/a of itself under a paraboloid, because the rear
    /// of the contact moves and its front stays. Where it forgets in an element or two there is still something of that left,
    /// which falls faster than any power of the elements: cylinders on a Kelvin–Voigt solid err by up to e^(−2.5 λv/Δx) of it.
    ///
    /// Around a kink the pressure grows like ln(1/r) down to r = λv, and the friction like ln(a/λv), of which elements see
    /// ln(a/Δx): under flat cones they miss up to the factor e^(−x) ln(1 + 1/x), x = λv/(2Δx), over ln(1 + a/Δx).
    pub(super) fn subgrid_friction_fraction(
        &self,
        spacing: f64,
        half_length: f64,
        kinks: f64,
    ) -> f64 {
        let (mut sum, mut missed) = (0.0, 0.0);
        for element in self.spectrum.elements() {
            let length = self.velocity * element.retardation_time;
            let ratio = length / half_length;
            // Friction is greatest where both lengths are alike.
            let friction = element.compliance * ratio.min(ratio.recip());
            let x = 0.5 * length / spacing;
            let around_kinks = (-x).exp() * x.recip().ln_1p() / (half_length / spacing).ln_1p();
            sum += friction;
            missed += friction * 2.0 * FRAC_2_PI * ratio * (-5.0 * x).exp();
            missed += friction * kinks * around_kinks;
        }
        if missed > 0.0 { missed / sum } else { 0.0 }
    }

    /// −δ/π with the loss angle δ at the wave number π/Δx, the shortest of the grid: moving the point by that part of an
    /// element turns the phase of this wave back by δ, so that displacement and load are in phase for it and less than a
    /// quarter period apart for all others.
    fn collocation_shift(&self, spacing: f64) -> Result<f64, BemError> {
        let angular_frequency = positive("π × velocity / spacing", PI * (self.velocity / spacing))?;
        let compliance = self.spectrum.complex_compliance(angular_frequency)?;
        Ok(-compliance.loss.atan2(compliance.storage) / PI)
    }
}

fn total_compliance(parts: &ElementCreep) -> f64 {
    let delayed: f64 = parts
        .retardations
        .iter()
        .map(|retardation| retardation.share)
        .sum();
    parts.instantaneous + parts.flow + delayed
}
