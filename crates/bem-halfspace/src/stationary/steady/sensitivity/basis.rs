//! What a quantity asks of the creep: its derivative by the kernel, assemble over each part of the creep once.

use std::f64::consts::PI;

use indenters::IndenterError;
use numerics::InvalidParameter;
use rheology::ComplexCompliance;
use rustfft::num_complex::Complex;

use crate::BemError;
use crate::parallel::reductions::dot;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::retarded_potential::RetardedPotential;
use crate::stationary::steady::sensitivity::correlation::Correlation;
use crate::stationary::steady::sensitivity::correlation_spectrum::CorrelationSpectrum;
use crate::stationary::steady::sliding_creep::{
    CreepOverDistance, ElementCreep, FLOW_AS_RETARDATION_RATE, RetardationElement, SlidingCreep,
};
use crate::stationary::steady::wake_table::WakeTable;

/// Relative step of the differences by the length of a memory or of a track or the thickness of a layer, which is about their error: kernels
/// are smooth to eleven digits.
const STEP: f64 = 1e-6;
/// Wave number of what does not change along x, over the longest of those that do.
const LONGEST_WAVE: f64 = 1e-6;
/// Logarithm of the ratio of two memories that do not change places.
const APART: f64 = 1e-3;

/// Sums of the kernels of all parts of the creep with the weights of a quantity, per compliance of an element.
#[derive(Debug)]
pub(super) struct Basis {
    correlation: Correlation,
    kernel: KernelParameters,
    creep: CreepOverDistance,
    instantaneous: f64,
    flow: f64,
    retardations: Vec<RetardationSums>,
}

/// What is common to all kernels of a grid.
#[derive(Debug, Clone)]
pub(super) struct KernelParameters {
    spacing: f64,
    aspect: f64,
    /// The creep over an element without any of its parts: where gaps are evaluated, the track and the base.
    bare: ElementCreep,
    material: SlidingCreep,
    /// Compliance over the length of an element, \[1/Pa].
    compliance: f64,
}

#[derive(Debug)]
struct RetardationSums {
    by_compliance: f64,
    /// By the logarithm of its memory, per compliance.
    by_log_memory: f64,
}

impl Basis {
    /// One for each quantity; the kernels are computed once for all.
    pub(super) fn of_all(mut quantities: Vec<Correlation>, kernel: &KernelParameters) -> Vec<Self> {
        Correlation::align(&mut quantities);
        let spacing = kernel.spacing;
        let creep = kernel.material.over_distance();
        let steps = [1.0, 1.0 + STEP];
        let memories = creep.retardations.iter().map(|[_, memory]| *memory);
        let rates = memories.flat_map(|memory| steps.map(|step| spacing / (memory * step)));
        let recovering = kernel.recovering(&quantities, &rates.collect::<Vec<f64>>());
        let flows = creep.flow_per_length > 0.0;
        let bases = quantities
            .into_iter()
            .zip(recovering)
            .map(|(correlation, sums)| {
                let retardations = sums[1..].chunks_exact(steps.len());
                let retardations = retardations.map(|sums| RetardationSums {
                    by_compliance: sums[0],
                    by_log_memory: (sums[1] - sums[0]) / STEP,
                });
                Self {
                    instantaneous: sums[0],
                    flow: if flows {
                        kernel.flow(&correlation)
                    } else {
                        0.0
                    },
                    retardations: retardations.collect(),
                    kernel: kernel.clone(),
                    creep: creep.clone(),
                    correlation,
                }
            });
        bases.collect()
    }

    /// The change from one creep to another on the same base, to first order; of as many retardations as here.
    pub(super) fn between_creeps(&self, [from, to]: [&CreepOverDistance; 2]) -> f64 {
        let instantaneous = self.instantaneous * (to.instantaneous - from.instantaneous);
        let flow = self.flow * self.kernel.spacing * (to.flow_per_length - from.flow_per_length);
        let ends = from.retardations.iter().zip(&to.retardations);
        let retardations = ends.zip(&self.creep.retardations).zip(&self.retardations);
        let delayed = retardations.map(|(((from, to), [compliance, _]), of)| {
            of.by_compliance * (to[0] - from[0])
                + of.by_log_memory * compliance * (to[1] / from[1]).ln()
        });
        (instantaneous + flow + delayed.sum::<f64>()) / self.kernel.compliance
    }

    /// The sum with all of the kernel.
    fn whole(&self) -> f64 {
        let retardations = self.creep.retardations.iter().zip(&self.retardations);
        let delayed = retardations.map(|([compliance, _], of)| of.by_compliance * compliance);
        let flow = self.flow * self.kernel.spacing * self.creep.flow_per_length;
        let at_once = self.instantaneous * self.creep.instantaneous;
        (at_once + flow + delayed.sum::<f64>()) / self.kernel.compliance
    }

    /// By the logarithm of the velocity.
    pub(super) fn by_velocity(&self) -> f64 {
        let retardations = self.creep.retardations.iter().zip(&self.retardations);
        let delayed = retardations.map(|([compliance, _], of)| of.by_log_memory * compliance);
        let flow = self.flow * self.kernel.spacing * self.creep.flow_per_length;
        (delayed.sum::<f64>() - flow) / self.kernel.compliance
    }

    /// Whether each retardation of another creep belongs to one of these; of some that are alike it is not known which.
    pub(super) fn has_same_retardations(&self, creep: &CreepOverDistance) -> bool {
        let differ = |pair: &[[f64; 2]]| (pair[1][1] / pair[0][1]).ln().abs() > APART;
        creep.retardations.len() == self.retardations.len()
            && creep.retardations.windows(2).all(differ)
    }

    /// The derivatives of quantities of one contact by the logarithms of the storage and of the loss modulus in each of the
    /// bands of angular frequencies \[rad/s].
    ///
    /// What flows follows a load that never changes: `∫_x^∞ w ds` is that of all waves but the longest, and half the integral
    /// of w over all x, which is of the frequency 0.
    pub(super) fn by_moduli(
        quantities: &[&Self],
        bands: &[[f64; 2]],
    ) -> Result<Vec<Vec<[f64; 2]>>, BemError> {
        let Some(kernel) = quantities.first().map(|basis| &basis.kernel) else {
            return Ok(Vec::new());
        };
        if let Some(track) = kernel.bare.track {
            let track = track * kernel.spacing;
            return Err(IndenterError::NoTrack { track }.into());
        }
        let waves = CorrelationSpectrum {
            quantities: quantities.iter().map(|basis| &basis.correlation).collect(),
            base: &kernel.bare.base,
            aspect: kernel.aspect,
            collocation_shift: kernel.bare.collocation_shift,
        };
        let of_band = |band: &[f64; 2]| {
            let ends =
                band.map(|frequency| kernel.material.wave_number(frequency) * kernel.spacing);
            let mut sums = vec![[0.0; 2]; quantities.len()];
            let flow = kernel.material.flow_per_length() * kernel.spacing / kernel.compliance;
            if band[0] <= 0.0 && flow > 0.0 {
                for (sums, weights) in sums.iter_mut().zip(waves.at(LONGEST_WAVE * ends[1])) {
                    sums[1] -= 0.5 * flow * weights.re;
                }
            }
            for [wave_number, weight] in waves.nodes(ends) {
                let by_logarithm = kernel.by_logarithm(wave_number)?;
                for (sums, weights) in sums.iter_mut().zip(waves.at(wave_number)) {
                    for (sum, compliance) in sums.iter_mut().zip(by_logarithm) {
                        *sum += weight / PI * (weights * compliance).re;
                    }
                }
            }
            Ok(sums)
        };
        bands.iter().map(of_band).collect()
    }

    /// The change of quantities of one contact from its creep to another on a base of its own.
    pub(super) fn to_elastomer(
        quantities: &[&Self],
        creep: &SlidingCreep,
    ) -> Result<Vec<f64>, BemError> {
        let other = Self::on_other(quantities, creep, |kernel, bare| {
            bare.base = creep.base().in_units_of(kernel.spacing)?;
            Ok(())
        })?;
        let pairs = quantities.iter().zip(other);
        Ok(pairs.map(|(own, other)| other - own.whole()).collect())
    }

    /// By the logarithm of the thickness of the layer.
    pub(super) fn by_thickness(quantities: &[&Self]) -> Result<Vec<f64>, BemError> {
        let is_layer = |bare: &ElementCreep| !bare.base.is_half_space();
        Self::by_length(quantities, is_layer, |bare, factor| {
            bare.base = bare.base.in_units_of(factor.recip())?;
            Ok(())
        })
    }

    /// By the logarithm of the length of the track.
    pub(super) fn by_track(quantities: &[&Self]) -> Result<Vec<f64>, BemError> {
        let has_track = |bare: &ElementCreep| bare.track.is_some();
        Self::by_length(quantities, has_track, |bare, factor| {
            bare.track = bare.track.map(|track| factor * track);
            Ok(())
        })
    }

    /// By the logarithm of a length that some kernels have, by differences of whole kernels.
    fn by_length(
        quantities: &[&Self],
        is_there: impl Fn(&ElementCreep) -> bool,
        scale: impl Fn(&mut ElementCreep, f64) -> Result<(), InvalidParameter>,
    ) -> Result<Vec<f64>, BemError> {
        let kernel = quantities.first().map(|basis| &basis.kernel);
        let Some(kernel) = kernel.filter(|kernel| is_there(&kernel.bare)) else {
            return Ok(vec![0.0; quantities.len()]);
        };
        let longer = Self::on_other(quantities, &kernel.material, |_, bare| {
            scale(bare, 1.0 + STEP)
        });
        let pairs = quantities.iter().zip(longer?);
        Ok(pairs
            .map(|(own, longer)| (longer - own.whole()) / STEP)
            .collect())
    }

    /// The sums of quantities of one contact with the kernel of another creep, track or base, which is computed once.
    fn on_other(
        quantities: &[&Self],
        creep: &SlidingCreep,
        change: impl Fn(&KernelParameters, &mut ElementCreep) -> Result<(), InvalidParameter>,
    ) -> Result<Vec<f64>, BemError> {
        let Some(Self {
            kernel,
            correlation,
            ..
        }) = quantities.first()
        else {
            return Ok(Vec::new());
        };
        let mut bare = kernel.bare.clone();
        change(kernel, &mut bare)?;
        let part = ElementCreep {
            collocation_shift: bare.collocation_shift,
            track: bare.track,
            base: bare.base,
            ..creep.over_element(kernel.spacing)?
        };
        let table = WakeTable::for_creep(&part, kernel.aspect, correlation.reach());
        let unit = creep.compliance(kernel.spacing)? / kernel.compliance;
        let sum = |basis: &&Self| unit * basis.correlation.with_kernel(&table);
        Ok(quantities.iter().map(sum).collect())
    }
}

/// A retardation element of unit compliance.
fn unit_retardation(rate: f64) -> RetardationElement {
    let share = -(-rate).exp_m1();
    RetardationElement { rate, share }
}

impl KernelParameters {
    pub(super) fn new(creep: &SlidingCreep, mesh: &Mesh) -> Result<Self, BemError> {
        let spacing = mesh.options.spacing[0];
        let bare = ElementCreep {
            instantaneous: 0.0,
            flow: 0.0,
            retardations: Vec::new(),
            ..mesh.loading.creep.clone()
        };
        Ok(Self {
            spacing,
            aspect: mesh.aspect(),
            bare,
            material: creep.clone(),
            compliance: creep.compliance(spacing)?,
        })
    }

    /// The sums of each quantity with the kernels of what recovers at once, and of retardation elements of unit compliance.
    fn recovering(&self, quantities: &[Correlation], rates: &[f64]) -> Vec<Vec<f64>> {
        let mut sums = vec![vec![0.0; 1 + rates.len()]; quantities.len()];
        let Some([rows, columns]) = quantities.first().map(Correlation::reach) else {
            return sums;
        };
        if rates.is_empty() {
            let part = ElementCreep {
                instantaneous: 1.0,
                ..self.bare.clone()
            };
            for (sums, correlation) in sums.iter_mut().zip(quantities) {
                sums[0] = self.sum_of(correlation, &part);
            }
            return sums;
        }
        let part = ElementCreep {
            retardations: rates.iter().copied().map(unit_retardation).collect(),
            ..self.bare.clone()
        };
        let offset = |row: usize| row as f64 - rows as f64 + self.bare.collocation_shift;
        let first = [offset(2 * rows), self.aspect];
        let mut retarded = RetardedPotential::new(&part, first, columns + 1);
        for row in (0..=2 * rows).rev() {
            retarded.step(offset(row));
            let at_once: Vec<f64> = (0..=columns)
                .map(|column| retarded.load_potential(column))
                .collect();
            for (sums, correlation) in sums.iter_mut().zip(quantities) {
                sums[0] += dot(correlation.row(row), &at_once);
                for (retardation, sum) in sums[1..].iter_mut().enumerate() {
                    *sum += dot(correlation.row(row), retarded.retardation_part(retardation));
                }
            }
        }
        sums
    }

    /// The derivatives of the compliance 1/(G' − i G'') to a wave by ln G' and ln G'', over that of an element.
    fn by_logarithm(&self, wave_number: f64) -> Result<[Complex<f64>; 2], BemError> {
        let ComplexCompliance { storage, loss } = self
            .material
            .compliance_of_wave(wave_number / self.spacing)?;
        let compliance = Complex::new(storage, loss);
        // G' − i G'' is its reciprocal.
        let moduli = compliance.inv();
        let turned = [-moduli.re, -moduli.im].map(|part| part / self.compliance);
        Ok([
            compliance * compliance * turned[0],
            compliance * compliance * Complex::i() * turned[1],
        ])
    }

    fn flow(&self, correlation: &Correlation) -> f64 {
        let mut part = self.bare.clone();
        if part.base.is_rigid() {
            let (rate, share) = (FLOW_AS_RETARDATION_RATE, 1.0);
            part.retardations.push(RetardationElement { rate, share });
        } else {
            part.flow = 1.0;
        }
        self.sum_of(correlation, &part)
    }

    /// The sum with the kernel of a part of the creep.
    fn sum_of(&self, correlation: &Correlation, part: &ElementCreep) -> f64 {
        correlation.with_kernel(&WakeTable::for_creep(
            part,
            self.aspect,
            correlation.reach(),
        ))
    }
}
