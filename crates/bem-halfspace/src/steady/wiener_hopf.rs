//! The preconditioner of the stationary problem: Wiener–Hopf factors of the kernel.
//!
//! Along x the kernel is a creep filter over the load potential, which is symmetric and positive: a running sum for the
//! dashpot, the identity for a spring, a sum of exponentials for the rest. For every wave number along y the potential
//! factors into a filter that looks ahead only and its mirror image that looks back only (by the cepstrum of its
//! spectrum, Kolmogorov 1939), so that the kernel is the product of a forward factor, which contains the creep filter,
//! and a backward factor. On a contact that extended without end behind a straight front, the inverses of the
//! factors, applied in the order backward, forward with the contact cut out in between, are the exact inverse
//! (Wiener & Hopf 1931); without end ahead of a straight rear, in the other order. The preconditioner goes from the one
//! to the other along x in proportion to the distance from the two ends.

use std::sync::Arc;

use rustfft::num_complex::Complex;

use crate::fast_length::fast_length;
use crate::plane_transform::{PlaneTransform, Workspace};
use crate::steady::filter::Spectrum;
use crate::steady::plans::{Plans, signed_offset};
use crate::steady::region::Region;
use crate::steady::sliding_creep::{Delay, ElementCreep};
use crate::steady::wake_table::WakeTable;

/// Elements beyond the box before the period of the filters repeats it. They need no more: the inverse factors decay
/// fast.
const MARGIN: usize = 4;

/// The inverses of the two factors in Fourier space.
#[derive(Debug)]
pub(super) struct InverseFactors {
    pub(super) transform: PlaneTransform,
    /// Inverse of the factor that contains the creep filter.
    sweep: Spectrum,
    /// Inverse of the other factor.
    counter_sweep: Spectrum,
}

impl InverseFactors {
    /// Period of the filters for a box of `shape` elements.
    pub(super) fn period(shape: [usize; 2]) -> [usize; 2] {
        shape.map(|n| fast_length(n + MARGIN))
    }

    pub(super) fn new(table: &WakeTable, padded: [usize; 2]) -> Self {
        let transform = PlaneTransform::new(padded);
        let potential =
            |row: usize, column: usize| table.potential(signed_offset(row, padded[0]), column);
        let counter_sweep = transform.spectrum(potential, invert_causal_factor);
        Self {
            sweep: with_inverse_creep(&counter_sweep, table.creep(), padded[0]),
            transform,
            counter_sweep,
        }
    }
}

/// An approximate inverse of the product with the stationary kernel on a region.
#[derive(Debug)]
pub(super) struct WienerHopf {
    factors: Arc<InverseFactors>,
    /// Weight of the order that is exact at the front.
    front: Vec<f64>,
    workspace: Workspace,
    field: Vec<f64>,
}

impl WienerHopf {
    pub(super) fn new(plans: &mut Plans, region: &Region) -> Self {
        let factors = plans.inverse_factors(region.shape);
        Self {
            front: region.fractions_from_rear(),
            workspace: Workspace::new(&factors.transform, region.shape),
            field: vec![0.0; region.n_places()],
            factors,
        }
    }

    /// Approximate loads that cause the given displacements.
    pub(super) fn loads(&mut self, displacements: &[f64], region: &Region) -> Vec<f64> {
        let mut at_front = displacements.to_vec();
        let mut at_rear = displacements.to_vec();
        for [front, rear] in [[false, true], [true, false]] {
            self.filter(front, &mut at_front, region);
            self.filter(rear, &mut at_rear, region);
        }
        for ((front, rear), weight) in at_front.iter_mut().zip(at_rear).zip(&self.front) {
            *front = weight * *front + (1.0 - weight) * rear;
        }
        at_front
    }

    /// Applies one inverse factor and cuts out the contact.
    fn filter(&mut self, sweep: bool, vector: &mut Vec<f64>, region: &Region) {
        let InverseFactors {
            transform,
            sweep: with_sum,
            counter_sweep,
        } = &*self.factors;
        let spectrum = if sweep { with_sum } else { counter_sweep };
        region.spread(vector, &mut self.field);
        transform.filter(&mut self.workspace, &mut self.field, spectrum);
        *vector = region.gather(&self.field);
    }
}

/// Replaces a real and positive transform along x by the inverse of its factor that looks towards smaller x only.
fn invert_causal_factor(transform: &PlaneTransform, column: &mut [Complex<f64>]) {
    let length = column.len();
    // A periodic kernel that is cut off may graze zero where it should not.
    let floor = f64::EPSILON * column.iter().map(|value| value.re).fold(0.0, f64::max);
    for value in column.iter_mut() {
        *value = Complex::new(value.re.max(floor).ln(), 0.0);
    }
    transform.column_back(column);
    let half = length / 2;
    for (index, value) in column.iter_mut().enumerate() {
        let share = match index {
            0 => 0.5,
            _ if index == half => 0.5,
            _ if index < half => 1.0,
            _ => 0.0,
        };
        *value *= -share / length as f64;
    }
    transform.column_forward(column);
    for value in column {
        *value = value.exp();
    }
}

/// The mirror image of each factor, together with the inverse of the creep filter
/// `J₀ + 1/(η_f (1 − e^{iα})) + Σ J_k (1 − d_k)/(1 − d_k e^{iα})` over the elements ahead.
fn with_inverse_creep(factors: &Spectrum, creep: &ElementCreep, length: usize) -> Spectrum {
    let inverse = |index: usize| {
        let angle = std::f64::consts::TAU * index as f64 / length as f64;
        // 1 − e^{iα} without cancellation.
        let half_sine = (0.5 * angle).sin();
        let difference = Complex::new(2.0 * half_sine * half_sine, -angle.sin());
        let delayed = |delay: &Delay| {
            let kept = delay.decay();
            difference * kept + -(-delay.rate).exp_m1()
        };
        let recovered = creep
            .delays
            .iter()
            .map(|delay| delayed(delay).inv() * delay.share)
            .sum::<Complex<f64>>()
            + creep.instant;
        if creep.flow > 0.0 {
            difference / (difference * recovered + creep.flow)
        } else {
            recovered.inv()
        }
    };
    let inverses: Vec<Complex<f64>> = (0..length).map(inverse).collect();
    factors
        .iter()
        .enumerate()
        .map(|(index, factor)| inverses[index % length] * factor.conj())
        .collect()
}
