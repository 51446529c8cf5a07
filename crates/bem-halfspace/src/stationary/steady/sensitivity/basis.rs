//! Derivatives of quantities by the creep: the correlation of adjoint and primal loads, contracted with the kernel of each part of the
//! creep once.
//!
//! Theory: the [module](super) and docs/sensitivity.md, "Which part of a master curve matters".

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
    CreepOverDistance, ElementCreep, FLOW_AS_RETARDATION_RATE, RetardationElement,
    RetardationOverDistance, SlidingCreep,
};
use crate::stationary::steady::wake_table::WakeTable;

/// Relative step of the differences by the memory length of a retardation element, the length of a track or the thickness of a layer;
/// chosen. The error of the derivative is about as large, because kernels are smooth to eleven digits.
const LENGTH_STEP: f64 = 1e-6;
/// Wave number that stands for q = 0, over the upper end of a band from 0 on; chosen.
const UNIFORM_WAVE_NUMBER: f64 = 1e-6;
/// Smallest logarithm of the ratio of two memory lengths in a row for which retardation elements are matched by their order; chosen.
const MIN_LOG_MEMORY_RATIO: f64 = 1e-3;

/// The derivative of a quantity by each part of the creep: contractions of its correlation with the kernels, per unit compliance.
#[derive(Debug)]
pub(super) struct Basis {
    correlation: Correlation,
    kernel: KernelParameters,
    creep: CreepOverDistance,
    instantaneous: f64,
    flow: f64,
    retardations: Vec<RetardationDerivatives>,
}

/// The parameters that all kernels of a grid have in common.
#[derive(Debug, Clone)]
pub(super) struct KernelParameters {
    /// Δx, \[m].
    spacing: f64,
    /// Δy/Δx.
    aspect: f64,
    /// The creep over an element without its compliances: collocation shift, track and base.
    bare: ElementCreep,
    material: SlidingCreep,
    /// Compliance over the length of an element, the unit of the kernel, \[1/Pa].
    compliance: f64,
}

/// The derivatives of a quantity by one retardation element.
#[derive(Debug)]
struct RetardationDerivatives {
    by_compliance: f64,
    /// By the logarithm of the memory length, per compliance.
    by_log_memory: f64,
}

impl Basis {
    /// Contracts the correlations of several quantities; each kernel is computed once for all of them.
    pub(super) fn contract_all(
        mut quantities: Vec<Correlation>,
        kernel: &KernelParameters,
    ) -> Vec<Self> {
        // Contract with kernels that share the potentials at the offsets.
        Correlation::align(&mut quantities);
        let spacing = kernel.spacing;
        let creep = kernel.material.over_distance();
        let steps = [1.0, 1.0 + LENGTH_STEP];
        let lengths = creep.retardations.iter().map(|one| one.memory_length);
        let rates = lengths.flat_map(|length| steps.map(|step| spacing / (length * step)));
        let viscoelastic = kernel.contract_viscoelastic(&quantities, &rates.collect::<Vec<f64>>());
        let flows = creep.flow_per_length > 0.0;

        // The first contraction is that of the instantaneous compliance, then come two memory lengths of each retardation element.
        let pairs = quantities.into_iter().zip(viscoelastic);
        let bases = pairs.map(|(correlation, sums)| {
            let elements = sums[1..].chunks_exact(steps.len());
            let retardations = elements.map(|sums| RetardationDerivatives {
                by_compliance: sums[0],
                by_log_memory: (sums[1] - sums[0]) / LENGTH_STEP,
            });
            let flow = flows.then(|| kernel.contract_flow(&correlation));
            Self {
                instantaneous: sums[0],
                flow: flow.unwrap_or(0.0),
                retardations: retardations.collect(),
                kernel: kernel.clone(),
                creep: creep.clone(),
                correlation,
            }
        });
        bases.collect()
    }

    /// The change from one creep to another on the same base, to first order. Both have as many retardation elements as this one.
    pub(super) fn between_creeps(&self, from: &CreepOverDistance, to: &CreepOverDistance) -> f64 {
        let instantaneous = self.instantaneous * (to.instantaneous - from.instantaneous);
        let flow = self.flow * self.kernel.spacing * (to.flow_per_length - from.flow_per_length);
        let ends = from.retardations.iter().zip(&to.retardations);
        let elements = ends.zip(self.with_derivatives());
        let retarded = elements.map(|((from, to), (compliance, one))| {
            let log_memory_ratio = (to.memory_length / from.memory_length).ln();
            one.by_compliance * (to.compliance - from.compliance)
                + one.by_log_memory * compliance * log_memory_ratio
        });
        (instantaneous + flow + retarded.sum::<f64>()) / self.kernel.compliance
    }

    /// Contraction with the kernel of the whole creep.
    fn contract_full_kernel(&self) -> f64 {
        let elements = self.with_derivatives();
        let retarded = elements.map(|(compliance, one)| one.by_compliance * compliance);
        let flow = self.flow * self.kernel.spacing * self.creep.flow_per_length;
        let instantaneous = self.instantaneous * self.creep.instantaneous;
        (instantaneous + flow + retarded.sum::<f64>()) / self.kernel.compliance
    }

    /// The derivative by the logarithm of the velocity.
    pub(super) fn by_velocity(&self) -> f64 {
        let elements = self.with_derivatives();
        let retarded = elements.map(|(compliance, one)| one.by_log_memory * compliance);
        let flow = self.flow * self.kernel.spacing * self.creep.flow_per_length;
        (retarded.sum::<f64>() - flow) / self.kernel.compliance
    }

    /// The compliance of each retardation element with the derivatives by it.
    fn with_derivatives(&self) -> impl Iterator<Item = (f64, &RetardationDerivatives)> {
        let compliances = self.creep.retardations.iter().map(|one| one.compliance);
        compliances.zip(&self.retardations)
    }

    /// True if the retardation elements of another creep correspond to these one by one: as many, with distinct memory lengths.
    pub(super) fn has_same_retardations(&self, creep: &CreepOverDistance) -> bool {
        let differ = |pair: &[RetardationOverDistance]| {
            let ratio = pair[1].memory_length / pair[0].memory_length;
            ratio.ln().abs() > MIN_LOG_MEMORY_RATIO
        };
        creep.retardations.len() == self.retardations.len()
            && creep.retardations.windows(2).all(differ)
    }

    /// The derivatives of quantities of one contact by the logarithms of the storage and of the loss modulus in each of the
    /// bands of angular frequencies \[rad/s].
    ///
    /// The free flow responds to a uniform load too: `∫_x^∞ w ds` consists of all waves with q > 0, and of half the integral of w over
    /// all x, which belongs to the frequency 0.
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
        let spectrum = CorrelationSpectrum {
            quantities: quantities.iter().map(|basis| &basis.correlation).collect(),
            base: &kernel.bare.base,
            aspect: kernel.aspect,
            collocation_shift: kernel.bare.collocation_shift,
        };
        let of_band = |band: &[f64; 2]| {
            let ends =
                band.map(|frequency| kernel.material.wave_number(frequency) * kernel.spacing);
            // The free flow under the uniform part of the load, which belongs to the loss modulus at the frequency 0.
            let mut sums = vec![[0.0; 2]; quantities.len()];
            let flow = kernel.material.flow_per_length() * kernel.spacing / kernel.compliance;
            if band[0] <= 0.0 && flow > 0.0 {
                let uniform = spectrum.at_wave_number(UNIFORM_WAVE_NUMBER * ends[1]);
                for (sums, weights) in sums.iter_mut().zip(uniform) {
                    sums[1] -= 0.5 * flow * weights.re;
                }
            }
            // All other waves.
            for [wave_number, weight] in spectrum.nodes(ends) {
                let by_log_moduli = kernel.by_log_moduli(wave_number)?;
                for (sums, weights) in sums.iter_mut().zip(spectrum.at_wave_number(wave_number)) {
                    for (sum, compliance) in sums.iter_mut().zip(by_log_moduli) {
                        *sum += weight / PI * (weights * compliance).re;
                    }
                }
            }
            Ok(sums)
        };
        bands.iter().map(of_band).collect()
    }

    /// The change of quantities of one contact from its elastomer to another.
    pub(super) fn to_elastomer(
        quantities: &[&Self],
        creep: &SlidingCreep,
    ) -> Result<Vec<f64>, BemError> {
        let other = Self::contract_other_kernel(quantities, creep, |kernel, bare| {
            bare.base = creep.base().in_units_of(kernel.spacing)?;
            Ok(())
        })?;
        let pairs = quantities.iter().zip(other);
        let change = |(own, other): (&&Self, f64)| other - own.contract_full_kernel();
        Ok(pairs.map(change).collect())
    }

    /// The derivatives by the logarithm of the thickness of the layer; 0 on a half space.
    pub(super) fn by_thickness(quantities: &[&Self]) -> Result<Vec<f64>, BemError> {
        let is_layer = |bare: &ElementCreep| !bare.base.is_half_space();
        Self::by_length(quantities, is_layer, |bare, factor| {
            bare.base = bare.base.in_units_of(factor.recip())?;
            Ok(())
        })
    }

    /// The derivatives by the logarithm of the length of the track; 0 without one.
    pub(super) fn by_track(quantities: &[&Self]) -> Result<Vec<f64>, BemError> {
        let has_track = |bare: &ElementCreep| bare.track.is_some();
        Self::by_length(quantities, has_track, |bare, factor| {
            bare.track = bare.track.map(|track| factor * track);
            Ok(())
        })
    }

    /// The derivatives by the logarithm of a length that some kernels have, by differences of whole kernels.
    fn by_length(
        quantities: &[&Self],
        has_length: impl Fn(&ElementCreep) -> bool,
        scale: impl Fn(&mut ElementCreep, f64) -> Result<(), InvalidParameter>,
    ) -> Result<Vec<f64>, BemError> {
        let kernel = quantities.first().map(|basis| &basis.kernel);
        let Some(kernel) = kernel.filter(|kernel| has_length(&kernel.bare)) else {
            return Ok(vec![0.0; quantities.len()]);
        };
        let longer = Self::contract_other_kernel(quantities, &kernel.material, |_, bare| {
            scale(bare, 1.0 + LENGTH_STEP)
        });
        let pairs = quantities.iter().zip(longer?);
        Ok(pairs
            .map(|(own, longer)| (longer - own.contract_full_kernel()) / LENGTH_STEP)
            .collect())
    }

    /// Contractions of quantities of one contact with the kernel of another creep, track or base, which is computed once.
    fn contract_other_kernel(
        quantities: &[&Self],
        creep: &SlidingCreep,
        change: impl Fn(&KernelParameters, &mut ElementCreep) -> Result<(), InvalidParameter>,
    ) -> Result<Vec<f64>, BemError> {
        let Some(first) = quantities.first() else {
            return Ok(Vec::new());
        };
        let kernel = &first.kernel;
        let mut bare = kernel.bare.clone();
        change(kernel, &mut bare)?;
        let part = ElementCreep {
            collocation_shift: bare.collocation_shift,
            track: bare.track,
            base: bare.base,
            ..creep.over_element(kernel.spacing)?
        };
        let table = WakeTable::for_creep(&part, kernel.aspect, first.correlation.max_offsets());
        let unit = creep.compliance(kernel.spacing)? / kernel.compliance;
        let sum = |basis: &&Self| unit * basis.correlation.contract(&table);
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

    /// Contractions of each quantity with the kernels of a unit instantaneous compliance and of retardation elements of unit compliance,
    /// in this order.
    fn contract_viscoelastic(&self, quantities: &[Correlation], rates: &[f64]) -> Vec<Vec<f64>> {
        let mut sums = vec![vec![0.0; 1 + rates.len()]; quantities.len()];
        let Some([rows, columns]) = quantities.first().map(Correlation::max_offsets) else {
            return sums;
        };
        // Without retardation elements a table of the instantaneous compliance is enough.
        if rates.is_empty() {
            let part = ElementCreep {
                instantaneous: 1.0,
                ..self.bare.clone()
            };
            for (sums, correlation) in sums.iter_mut().zip(quantities) {
                sums[0] = self.contract(correlation, &part);
            }
            return sums;
        }

        // With them the recursion along rows gives all kernels at once, row by row from ahead.
        let part = ElementCreep {
            retardations: rates.iter().copied().map(unit_retardation).collect(),
            ..self.bare.clone()
        };
        let offset = |row: usize| row as f64 - rows as f64 + self.bare.collocation_shift;
        let mut retarded =
            RetardedPotential::new(&part, offset(2 * rows), self.aspect, columns + 1);
        for row in (0..=2 * rows).rev() {
            retarded.step(offset(row));
            let load_potential = |column| retarded.load_potential(column);
            let potentials: Vec<f64> = (0..=columns).map(load_potential).collect();
            for (sums, correlation) in sums.iter_mut().zip(quantities) {
                sums[0] += dot(correlation.row(row), &potentials);
                for (retardation, sum) in sums[1..].iter_mut().enumerate() {
                    *sum += dot(correlation.row(row), retarded.retardation_part(retardation));
                }
            }
        }
        sums
    }

    /// The derivatives of the compliance 1/(G' − i G'') at a wave number by ln G' and ln G'', over the unit of the kernel.
    fn by_log_moduli(&self, wave_number: f64) -> Result<[Complex<f64>; 2], BemError> {
        let ComplexCompliance { storage, loss } = self
            .material
            .compliance_of_wave(wave_number / self.spacing)?;
        let compliance = Complex::new(storage, loss);
        // G' − i G'' is the reciprocal.
        let moduli = compliance.inv();
        let negative_moduli = [-moduli.re, -moduli.im].map(|part| part / self.compliance);
        Ok([
            compliance * compliance * negative_moduli[0],
            compliance * compliance * Complex::i() * negative_moduli[1],
        ])
    }

    /// Contraction with the kernel of a unit flow per element.
    fn contract_flow(&self, correlation: &Correlation) -> f64 {
        let mut part = self.bare.clone();
        if part.base.is_rigid() {
            let (rate, share) = (FLOW_AS_RETARDATION_RATE, 1.0);
            part.retardations.push(RetardationElement { rate, share });
        } else {
            part.flow = 1.0;
        }
        self.contract(correlation, &part)
    }

    /// Contraction with the kernel of one part of the creep.
    fn contract(&self, correlation: &Correlation, part: &ElementCreep) -> f64 {
        let table = WakeTable::for_creep(part, self.aspect, correlation.max_offsets());
        correlation.contract(&table)
    }
}
