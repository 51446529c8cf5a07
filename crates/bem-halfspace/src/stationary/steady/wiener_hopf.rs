//! The preconditioner of the stationary problem: Wiener–Hopf factors of the kernel.
//!
//! Along x the kernel is a creep filter applied to the load potential, which is symmetric and positive. The filter is a running sum
//! for the dashpot, the identity for a spring, and a sum of exponentials otherwise. For every wave number along y the potential
//! factors into a filter that looks ahead only and its mirror image, by the cepstrum of its spectrum (Kolmogorov 1939). The kernel
//! then is the product of a forward factor, which contains the creep filter, and a backward factor. A creep filter with advanced
//! elements, which look behind, factors by its cepstrum, too, and both factors contain their part of it.
//!
//! On a contact that is infinite behind a straight front, the exact inverse consists of the inverses of the factors (Wiener & Hopf
//! 1931). Their order is backward, forward, with the contact cut out in between. On a contact that is infinite ahead of a straight
//! rear, the other order is exact. The preconditioner blends the two along x in proportion to the distance from the two ends.
//!
//! Theory: docs/theory/stationary-half-space.md, "The equations of one contact" and "Any linear viscoelastic material", "The
//! preconditioner".

use std::sync::Arc;

use rustfft::num_complex::Complex;

use crate::stationary::steady::filter::{Filters, RegionFilter};
use crate::stationary::steady::region::Region;
use crate::stationary::steady::sliding_creep::{ElementCreep, RetardationElement};
use crate::stationary::steady::wake_table::WakeTable;
use crate::transform::fast_length::fast_length;
use crate::transform::plane_transform::PlaneTransform;
use crate::transform::plane_transform::complex_product::{Spectrum, signed_offset};

/// Elements by which the period of the filters exceeds the box. Few are enough, because the inverse factors of the preconditioner
/// decay fast. Chosen (case of `evidence tuning`): without it the front of the next image touches the rear, and a hot contact of
/// `evidence derivatives --quick` is not found within minutes.
const FILTER_MARGIN: usize = 4;

/// Index, in the spectra of [`inverse_factors`], of the inverse of the forward factor, which contains the creep filter.
const FORWARD: usize = 0;
/// Index, in the spectra of [`inverse_factors`], of the inverse of the backward factor.
const BACKWARD: usize = 1;

/// Period of the filters for a box of `shape` elements.
pub(super) fn period(shape: [usize; 2]) -> [usize; 2] {
    shape.map(|n| fast_length(n + FILTER_MARGIN))
}

/// Spectra of the inverse factors, at the indices [`FORWARD`] and [`BACKWARD`].
pub(super) fn inverse_factors(table: &WakeTable, transform: &PlaneTransform) -> [Spectrum; 2] {
    let [length, _] = transform.padded;
    let potential =
        |row: usize, column: usize| table.creep_within_element(signed_offset(row, length), column);
    let potential = transform.spectrum(potential, invert_causal_factor);
    let creep = InverseCreep::new(&table.creep, length, transform);
    let forward = product(&creep.ahead, potential.iter().map(Complex::conj));
    let backward = match creep.behind {
        None => potential,
        Some(behind) => product(&behind, potential.iter().copied()),
    };
    [forward, backward]
}

/// An approximate inverse of the stationary kernel on a region.
pub(super) struct WienerHopf {
    /// Convolutions with the inverse factors.
    inverses: RegionFilter<2>,
    /// Weight of the order that is exact at the front, for each element: 0 at the rear, 1 at the front.
    front_weights: Vec<f64>,
}

impl WienerHopf {
    /// The preconditioner on a region, from the [`inverse_factors`] for the shape of its box.
    pub(super) fn new(inverses: Arc<Filters<2>>, region: &Region) -> Self {
        Self {
            inverses: RegionFilter::new(inverses, region),
            front_weights: region.fractions_from_rear(),
        }
    }

    /// Approximate loads that cause the given displacements; both are packed vectors on the elements of `region`.
    pub(super) fn approximate_loads(&mut self, displacements: &[f64], region: &Region) -> Vec<f64> {
        // Apply the inverse factors in both orders. One is exact at a straight front, the other at a straight rear.
        let orders = [[BACKWARD, FORWARD], [FORWARD, BACKWARD]];
        let [at_front, at_rear] = orders.map(|[first, second]| {
            let between = self.inverses.apply(first, displacements, region);
            self.inverses.apply(second, &between, region)
        });
        // Blend the two results in proportion to the distances from rear and front.
        let both = at_front.iter().zip(at_rear).zip(&self.front_weights);
        both.map(|((front, rear), weight)| weight * front + (1.0 - weight) * rear)
            .collect()
    }
}

/// Replaces a real and positive transform along x by that of the inverse of its factor that looks towards smaller x only.
fn invert_causal_factor(transform: &PlaneTransform, column: &mut [Complex<f64>]) {
    // The transform of a truncated periodic kernel may be slightly negative where it should be positive.
    let floor = f64::EPSILON * column.iter().map(|value| value.re).fold(0.0, f64::max);
    for value in column.iter_mut() {
        *value = Complex::new(value.re.max(floor).ln(), 0.0);
    }
    invert_half_of_cepstrum(transform, column);
}

/// Replaces the logarithm of a transform along x by the transform of the inverse of its factor that looks towards smaller x only.
fn invert_half_of_cepstrum(transform: &PlaneTransform, column: &mut [Complex<f64>]) {
    // Keep the half of the cepstrum that belongs to one factor, with the opposite sign for the inverse of the factor.
    let length = column.len();
    transform.column_inverse(column);
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

/// Inverses of the factors of the creep filter at the wave numbers α along x, in radians per element.
struct InverseCreep {
    /// Inverse of the factor of the elements ahead; without advanced elements it is the whole filter.
    ahead: Vec<Complex<f64>>,
    /// Inverse of the factor of the elements behind; `None` without advanced elements.
    behind: Option<Vec<Complex<f64>>>,
}

impl InverseCreep {
    /// Factors of the creep filter `J₀ + 1/(η_f (1 − e^{iα})) + Σ J_k (1 − d_k)/(1 − d_k e^{iα})`, in which advanced elements have
    /// e^{−iα} in the place of e^{iα}.
    fn new(creep: &ElementCreep, length: usize, transform: &PlaneTransform) -> Self {
        // The difference 1 − e^{iα} is computed without cancellation, because 1 − cos α = 2 sin²(α/2).
        let differences = (0..length).map(|index| {
            let angle = std::f64::consts::TAU * index as f64 / length as f64;
            let half_sine = (0.5 * angle).sin();
            Complex::new(2.0 * half_sine * half_sine, -angle.sin())
        });
        let differences: Vec<Complex<f64>> = differences.collect();
        // `finv`, because the square of the modulus underflows for memory lengths above 1e154 elements.
        let response = |element: &RetardationElement, difference: Complex<f64>| {
            let decay = element.decay();
            let denominator = difference * decay + -(-element.rate).exp_m1();
            denominator.finv() * element.share
        };
        let filter = |difference: &Complex<f64>| {
            let retarded =
                (creep.retardations.iter()).map(|element| response(element, *difference));
            let advanced =
                (creep.advanced.iter()).map(|element| response(element, difference.conj()));
            retarded.chain(advanced).sum::<Complex<f64>>() + creep.instantaneous
        };
        // Without advanced elements the filter looks ahead only, and is its own factor.
        if creep.advanced.is_empty() {
            let inverse = |difference: &Complex<f64>| {
                if creep.flow > 0.0 {
                    difference / (difference * filter(difference) + creep.flow)
                } else {
                    filter(difference).inv()
                }
            };
            return Self {
                ahead: differences.iter().map(inverse).collect(),
                behind: None,
            };
        }
        // Free flow is a pole of the filter at α = 0, which belongs to the elements ahead.
        let without_pole = |difference: &Complex<f64>| {
            let value = if creep.flow > 0.0 {
                difference * filter(difference) + creep.flow
            } else {
                filter(difference)
            };
            value.ln()
        };
        // Conjugation swaps ahead and behind, so that both factors come from the same half.
        let mut behind: Vec<Complex<f64>> = differences.iter().map(without_pole).collect();
        let mut ahead: Vec<Complex<f64>> = behind.iter().map(Complex::conj).collect();
        invert_half_of_cepstrum(transform, &mut behind);
        invert_half_of_cepstrum(transform, &mut ahead);
        for (value, difference) in ahead.iter_mut().zip(&differences) {
            *value = value.conj();
            if creep.flow > 0.0 {
                *value *= difference;
            }
        }
        Self {
            ahead,
            behind: Some(behind),
        }
    }
}

/// Products of a factor that depends on the wave number along x only with a spectrum, which is stored by column.
fn product(along_x: &[Complex<f64>], spectrum: impl Iterator<Item = Complex<f64>>) -> Spectrum {
    let pairs = along_x.iter().cycle().zip(spectrum);
    pairs.map(|(factor, value)| factor * value).collect()
}
