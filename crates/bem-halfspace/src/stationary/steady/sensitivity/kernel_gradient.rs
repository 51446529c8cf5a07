//! Derivatives of quantities by the kernel: correlations of adjoint and primal loads, contracted with the kernel of each part of the
//! creep once.
//!
//! Theory: the [module](super) and docs/theory/sensitivities.md, "Bands of frequency".

use std::f64::consts::PI;

use indenters::IndenterError;
use rheology::ComplexCompliance;
use rustfft::num_complex::Complex;

use crate::BemError;
use crate::parallel::reductions::dot;
use crate::stationary::steady::retarded_potential::RetardedPotential;
use crate::stationary::steady::sensitivity::correlation::Correlation;
use crate::stationary::steady::sensitivity::kernel_table::KernelTable;
use crate::stationary::steady::sensitivity::kernel_waves::KernelWaves;
use crate::stationary::steady::sliding_creep::{
    CreepOverDistance, ElementCreep, FLOW_AS_RETARDATION_RATE, RetardationElement, SlidingCreep,
};
use crate::stationary::steady::wake_table::WakeTable;

/// Relative step of differences by lengths: one-sided by the memory length of a retardation element, the length of a track or the
/// thickness of a layer, central by those of a body. Derived: between the square root 3e-6 of the relative error 1e-11 of kernels
/// and the cube root 6e-6 of the rounding error, where truncation and these errors balance.
pub(super) const LENGTH_STEP: f64 = 4e-6;
/// Ratio of the wave number that stands for a uniform load to the upper end of a band from 0 on. Chosen; any wave that is far
/// longer than the contact and all waves of the band serves.
const UNIFORM_WAVE_NUMBER: f64 = 1e-6;
/// Smallest logarithm of the ratio of successive memory lengths for which the retardation elements of two materials are matched
/// by their order. Chosen as a thousand times the relative change of a memory length in a derivative. If two memory lengths are
/// closer, both whole kernels are computed instead, which takes longer.
const MIN_LOG_MEMORY_RATIO: f64 = 1e-3;

/// The derivatives of a quantity by the kernel: weights of all its values, and their sums over the kernel of each part of the creep.
#[derive(Debug)]
pub(super) struct KernelGradient {
    /// Weight of the kernel at each offset in the derivative.
    pub(super) correlation: Correlation,
    /// Derivatives by the parts of the creep compliance in the order of [`CreepChange`], in the unit of the quantity times \[Pa].
    by_creep: Vec<f64>,
    /// Derivative by the logarithm of the thickness of the layer; 0 on a half space.
    pub(super) by_log_thickness: f64,
    /// Derivative by the logarithm of the length of the track; 0 without one.
    pub(super) by_log_track: f64,
}

/// The change of the creep compliance part by part, \[1/Pa]. The first two entries are the changes of the instantaneous
/// compliance and of the free flow over an element. Each retardation element adds two: the change of its compliance, and that of
/// the logarithm of its memory length times its compliance.
pub(super) struct CreepChange(Vec<f64>);

/// The kernel of a grid: the creep over its elements, and the offsets between them.
#[derive(Debug)]
pub(super) struct GridKernel {
    /// Length Δx of an element, \[m].
    spacing: f64,
    /// Aspect ratio Δy/Δx of an element.
    aspect: f64,
    /// Largest offsets along x and y.
    max_offsets: [usize; 2],
    /// Creep of the material on its base, at its velocity.
    material: SlidingCreep,
    /// Compliances and memory lengths of this creep.
    creep: CreepOverDistance,
    /// The creep over an element without its compliances: collocation shift, track and base.
    bare: ElementCreep,
}

impl KernelGradient {
    /// Gradient of a quantity by the kernel with the given correlation. Its derivatives are 0 until [`GridKernel::contract`]
    /// computes them.
    pub(super) const fn new(correlation: Correlation) -> Self {
        Self {
            correlation,
            by_creep: Vec::new(),
            by_log_thickness: 0.0,
            by_log_track: 0.0,
        }
    }

    /// Change of the quantity by a change of the creep, to first order, in the unit of the quantity.
    pub(super) fn by_creep(&self, change: &CreepChange) -> f64 {
        dot(&self.by_creep, &change.0)
    }
}

impl GridKernel {
    /// Kernel of a creep on elements with the edges [Δx, Δy] \[m], up to the largest offsets along x and y.
    pub(super) fn new(
        creep: &SlidingCreep,
        spacing: [f64; 2],
        max_offsets: [usize; 2],
    ) -> Result<Self, BemError> {
        Ok(Self {
            spacing: spacing[0],
            aspect: spacing[1] / spacing[0],
            max_offsets,
            material: creep.clone(),
            creep: creep.over_distance(),
            bare: ElementCreep {
                instantaneous: 0.0,
                flow: 0.0,
                retardations: Vec::new(),
                ..creep.over_element(spacing[0])?
            },
        })
    }

    /// Contracts several correlations with all parts of the kernel, each of which is computed once for all of them.
    pub(super) fn contract(&self, gradients: &mut [&mut KernelGradient]) -> Result<(), BemError> {
        self.contract_viscoelastic(gradients);
        // Contract with the kernel of the free flow for a unit compliance, which on a rigid base is a slow retardation element.
        if self.creep.flow_per_length > 0.0 {
            let mut part = self.bare.clone();
            if part.base.is_rigid() {
                let (rate, share) = (FLOW_AS_RETARDATION_RATE, 1.0);
                part.retardations.push(RetardationElement { rate, share });
            } else {
                part.flow = 1.0;
            }
            let flow = self.table(1.0, &part);
            for gradient in &mut *gradients {
                gradient.by_creep[1] = gradient.correlation.contract(&flow);
            }
        }

        // The derivatives by the thickness of a layer and the length of a track are one-sided differences of whole kernels.
        let compliance = self.material.compliance(self.spacing)?;
        let part = self.material.over_element(self.spacing)?;
        let whole = self.whole_creep();
        let by_log_length = |gradient: &KernelGradient, longer: &KernelTable| {
            (gradient.correlation.contract(longer) - gradient.by_creep(&whole)) / LENGTH_STEP
        };
        if !part.base.is_half_space() {
            let base = part.base.in_units_of((1.0 + LENGTH_STEP).recip())?;
            let thicker = ElementCreep {
                base,
                ..part.clone()
            };
            let thicker = self.table(compliance, &thicker);
            for gradient in &mut *gradients {
                gradient.by_log_thickness = by_log_length(gradient, &thicker);
            }
        }
        if let Some(track) = part.track {
            let track = Some((1.0 + LENGTH_STEP) * track);
            let longer = self.table(compliance, &ElementCreep { track, ..part });
            for gradient in gradients {
                gradient.by_log_track = by_log_length(gradient, &longer);
            }
        }
        Ok(())
    }

    /// Contracts the correlations with the kernels of the instantaneous compliance and of all retardation elements.
    fn contract_viscoelastic(&self, gradients: &mut [&mut KernelGradient]) {
        let retardations = self.creep.retardations.iter();
        let memory_lengths = retardations.map(|element| element.memory_length);
        let with_step = memory_lengths.flat_map(|length| [length, length * (1.0 + LENGTH_STEP)]);
        let unit_retardation = |length: f64| {
            let rate = self.spacing / length;
            let share = -(-rate).exp_m1();
            RetardationElement { rate, share }
        };
        let mut part = self.bare.clone();
        part.retardations = with_step.map(unit_retardation).collect();
        // Without retardation elements a table of the instantaneous compliance is enough.
        if part.retardations.is_empty() {
            part.instantaneous = 1.0;
            let instantaneous = self.table(1.0, &part);
            for gradient in gradients {
                gradient.by_creep = vec![gradient.correlation.contract(&instantaneous), 0.0];
            }
            return;
        }

        // With retardations, a single recursion along rows gives all kernels, beginning ahead.
        let rows = self.max_offsets[0].cast_signed();
        let columns = self.max_offsets[1] + 1;
        let position = |offset: isize| offset as f64 + part.collocation_shift;
        let mut retarded = RetardedPotential::new(&part, position(rows), self.aspect, columns);
        for gradient in &mut *gradients {
            gradient.by_creep = vec![0.0; 2 + part.retardations.len()];
        }
        for offset in (-rows..=rows).rev() {
            retarded.step(position(offset));
            let potentials: Vec<f64> = (0..columns)
                .map(|column| retarded.load_potential(column))
                .collect();
            for gradient in &mut *gradients {
                let (correlation, by_creep) = (&gradient.correlation, &mut gradient.by_creep);
                by_creep[0] += correlation.contract_row(offset, &potentials);
                for (index, sum) in by_creep[2..].iter_mut().enumerate() {
                    *sum += correlation.contract_row(offset, retarded.retardation_part(index));
                }
            }
        }
        // Every second sum belongs to a slightly longer memory length. Turn it into the derivative by the logarithm of that length.
        for gradient in gradients {
            for [unchanged, longer] in gradient.by_creep[2..].as_chunks_mut().0 {
                *longer = (*longer - *unchanged) / LENGTH_STEP;
            }
        }
    }

    /// The change from one creep to another on the same base. Both have as many retardation elements as the material.
    pub(super) fn between_creeps(
        &self,
        from: &CreepOverDistance,
        to: &CreepOverDistance,
    ) -> CreepChange {
        let instantaneous = to.instantaneous - from.instantaneous;
        let flow = self.spacing * (to.flow_per_length - from.flow_per_length);
        // Each element adds δJ and J δ ln l with its compliance J and its memory length l.
        let ends = from.retardations.iter().zip(&to.retardations);
        let retarded = ends
            .zip(&self.creep.retardations)
            .flat_map(|((from, to), element)| {
                let log_memory_ratio = (to.memory_length / from.memory_length).ln();
                [
                    to.compliance - from.compliance,
                    element.compliance * log_memory_ratio,
                ]
            });
        CreepChange([instantaneous, flow].into_iter().chain(retarded).collect())
    }

    /// The whole creep of the material as a change from zero creep.
    pub(super) fn whole_creep(&self) -> CreepChange {
        self.scaled_creep(1.0, 1.0, [1.0, 0.0])
    }

    /// Derivative of the creep over distance by the logarithm of the velocity, to which the memory lengths are proportional.
    pub(super) fn by_velocity(&self) -> CreepChange {
        self.scaled_creep(0.0, -1.0, [0.0, 1.0])
    }

    /// The creep with factors on the instantaneous compliance, on the flow, and on the two entries of each retardation element.
    fn scaled_creep(&self, instantaneous: f64, flow: f64, retarded: [f64; 2]) -> CreepChange {
        let first = [
            instantaneous * self.creep.instantaneous,
            flow * self.spacing * self.creep.flow_per_length,
        ];
        let compliances = self.creep.retardations.iter().map(|one| one.compliance);
        let retardations = compliances.flat_map(|one| retarded.map(|factor| factor * one));
        CreepChange(first.into_iter().chain(retardations).collect())
    }

    /// True if the retardation elements of another creep correspond to those of the material one by one: as many, with distinct memory
    /// lengths.
    pub(super) fn has_same_retardations(&self, creep: &CreepOverDistance) -> bool {
        let are_distinct = creep.retardations.windows(2).all(|pair| {
            let ratio = pair[1].memory_length / pair[0].memory_length;
            ratio.ln().abs() > MIN_LOG_MEMORY_RATIO
        });
        are_distinct && creep.retardations.len() == self.creep.retardations.len()
    }

    /// The kernel of another material on the base and track of this one.
    pub(super) fn of_material(&self, creep: SlidingCreep) -> Result<KernelTable, BemError> {
        let (base, track) = (self.material.base().clone(), self.material.track());
        self.of_creep_with_base(&creep.on_base(base, track))
    }

    /// The kernel of another elastomer on the track of this one.
    pub(super) fn of_elastomer(&self, creep: SlidingCreep) -> Result<KernelTable, BemError> {
        let base = creep.base().clone();
        self.of_creep_with_base(&creep.on_base(base, self.material.track()))
    }

    /// The kernel on the grid for a creep, with the base and the track that belong to this creep.
    fn of_creep_with_base(&self, creep: &SlidingCreep) -> Result<KernelTable, BemError> {
        let compliance = creep.compliance(self.spacing)?;
        Ok(self.table(compliance, &creep.over_element(self.spacing)?))
    }

    /// The kernel of a creep over an element, at the collocation points of the grid.
    fn table(&self, compliance: f64, creep: &ElementCreep) -> KernelTable {
        let creep = ElementCreep {
            collocation_shift: self.bare.collocation_shift,
            ..creep.clone()
        };
        let wake = WakeTable::for_creep(&creep, self.aspect, self.max_offsets);
        KernelTable::of_wake(&wake, compliance, self.max_offsets)
    }

    /// The derivatives of the kernel by the logarithms of storage and loss modulus in a band of angular frequencies \[rad/s].
    ///
    /// The free flow responds to a uniform load too: `∫_x^∞ w ds` consists of all waves with q > 0, and of half the integral of w over
    /// all x, which belongs to the frequency 0.
    pub(super) fn by_moduli(&self, band: [f64; 2]) -> Result<[KernelTable; 2], BemError> {
        if let Some(track) = self.material.track() {
            return Err(IndenterError::NoTrack { track }.into());
        }
        let waves = KernelWaves {
            base: &self.bare.base,
            aspect: self.aspect,
            collocation_shift: self.bare.collocation_shift,
            max_offsets: self.max_offsets,
        };
        let ends = band.map(|frequency| self.material.wave_number(frequency) * self.spacing);
        let mut kernels = [0; 2].map(|_| KernelTable::zero(self.max_offsets));
        // The free flow under the uniform part of the load, which belongs to the loss modulus at the frequency 0.
        let flow = self.creep.flow_per_length * self.spacing;
        if band[0] <= 0.0 && flow > 0.0 {
            let by_log_moduli = [Complex::default(), Complex::from(-0.5 * flow)];
            waves.add_wave(&mut kernels, UNIFORM_WAVE_NUMBER * ends[1], by_log_moduli);
        }
        // Add all other waves of the band, as an integral over the wave number.
        for [wave_number, weight] in waves.nodes(ends) {
            let by_log_moduli = self.by_log_moduli(wave_number)?;
            let amplitudes = by_log_moduli.map(|derivative| derivative * (weight / PI));
            waves.add_wave(&mut kernels, wave_number, amplitudes);
        }
        Ok(kernels)
    }

    /// The derivatives of the compliance 1/(G' − i G'') at a wave number by ln G' and ln G''.
    fn by_log_moduli(&self, wave_number: f64) -> Result<[Complex<f64>; 2], BemError> {
        let ComplexCompliance { storage, loss } = self
            .material
            .compliance_of_wave(wave_number / self.spacing)?;
        let compliance = Complex::new(storage, loss);
        // The complex modulus G' − i G'' is the reciprocal of the compliance.
        let moduli = compliance.inv();
        let square = compliance * compliance;
        Ok([square * -moduli.re, square * Complex::i() * -moduli.im])
    }
}
