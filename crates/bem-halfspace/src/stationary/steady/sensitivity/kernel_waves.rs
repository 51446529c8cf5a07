//! Derivatives by the complex modulus at each frequency: a correlation contracted with the kernel as a sum of waves.
//!
//! Along x the kernel of an element is a sum of waves `e^(iqx)`. Each oscillates at the frequency `ω = q v` in the material, so that
//! the compliance `1/(G' − i G'')` is a factor of its amplitude. For a column of elements at the distance y
//!
//! ```text
//! k̂(q, y) = sin(q/2)/(q/2) ∫ dy' [2 K₀(q|y'|) + 2 ∫_0^∞ cos(q y' sinh u) (M(q t cosh u) − 1) du]
//! ```
//!
//! with lengths in Δx, and y' over the width of an element around y. A layer has the thickness t, and M is the ratio of its
//! compliance to that of a half space. The modified Bessel function is `K₀(z) = ∫_0^∞ e^(−z cosh u) du`. The integrands in u are
//! analytic and vanish smoothly, so that the trapezoidal rule integrates them to rounding error.
//!
//! Theory: docs/theory/sensitivities.md, "Bands of frequency".

use std::f64::consts::TAU;
use std::iter;

use rustfft::num_complex::Complex;

use crate::Base;
use crate::stationary::steady::sensitivity::kernel_table::KernelTable;

/// Step of the variable u of the trapezoidal rule (head of this file) for an integrand that does not oscillate. Derived: the
/// integrand is analytic for |Im u| < π/2, so that the error is of the order e^(−π²/h) with the step h, or 7e-18. Tests compare
/// with a closed form.
const QUADRATURE_STEP: f64 = 0.25;
/// Steps of the trapezoidal rule per shortest wave of an oscillating integrand. Derived: Nyquist's two. This wave is at the end
/// of the range, where the integrand is negligible.
const STEPS_PER_WAVE: f64 = 2.0;
/// Product x of wave number and thickness above which a layer acts like a half space. Derived: the ratio M of their compliances
/// differs from 1 by the order x² e^(−2x), which is then below 1e-13.
const MAX_LAYER_WAVE_NUMBER: f64 = 18.0;
/// Largest phase difference between the ends of a panel of the integral over a band, at the longest distance of the correlation,
/// in turns of a wave. Chosen: the Gauss rule of two points then errs by at most (0.4 · 2π)⁴/4320, or 1 %, of that wave, and by
/// far less at shorter distances (case of `evidence tuning`).
const WAVES_PER_PANEL: f64 = 0.4;
/// Largest ratio of the upper to the lower end of a panel of the integral over a band, because the integrand varies with the
/// logarithm of the wave number. Chosen: the Gauss rule of two points then errs by (ln 1.25)⁴/4320, or 6e-7, of the fourth
/// derivative by that logarithm (case of `evidence tuning`).
const PANEL_RATIO: f64 = 1.25;
/// The nodes ±1/√3 of the Gauss rule of two points on [−1, 1].
const NODES: [f64; 2] = [-0.577_350_269_189_625_8, 0.577_350_269_189_625_8];

/// The kernel of a unit compliance on a grid, as a sum of waves.
pub(super) struct KernelWaves<'a> {
    /// Base under the elements, with lengths in Δx.
    pub(super) base: &'a Base,
    /// Aspect ratio Δy/Δx of an element.
    pub(super) aspect: f64,
    /// Position of the collocation points, in elements from their centres.
    pub(super) collocation_shift: f64,
    /// Largest offsets along x and y.
    pub(super) max_offsets: [usize; 2],
}

impl KernelWaves<'_> {
    /// Nodes and weights [q, w] of an integral over an interval of wave numbers, in 1/Δx. The panels resolve the waves
    /// over the longest distance of the correlation, and functions of the logarithm of the frequency.
    pub(super) fn nodes(&self, interval: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
        let [from, to] = interval;
        let rows = (2 * self.max_offsets[0] + 1) as f64;
        let widest = WAVES_PER_PANEL * TAU / rows;
        // Panels cannot grow from a wave number of 0: there the first one is as long as the last.
        let next = move |from: f64| {
            let limit = if from > 0.0 {
                PANEL_RATIO * from
            } else {
                to - to / PANEL_RATIO
            };
            to.min(from + widest).min(limit)
        };
        let ends = iter::successors(Some(from), move |from| Some(next(*from)));
        let panels = ends.take_while(move |from| *from < to);
        panels.flat_map(move |from| {
            let half = 0.5 * (next(from) - from);
            NODES.map(|node| [from + half * (1.0 + node), half])
        })
    }

    /// Adds the wave of a wave number, in 1/Δx, to two kernels, each with its factor of `amplitudes` on the wave of a unit compliance.
    pub(super) fn add_wave(
        &self,
        kernels: &mut [KernelTable; 2],
        wave_number: f64,
        amplitudes: [Complex<f64>; 2],
    ) {
        // The mean of a wave over an element is sin(q/2)/(q/2) times its value at the centre.
        let half = 0.5 * wave_number;
        let mean = half.sin() / half;
        let along_y = self.kernel_at_y_offsets(wave_number, self.max_offsets[1]);
        for (kernel, amplitude) in kernels.iter_mut().zip(amplitudes) {
            let along_x = |offset: isize| {
                let x = offset as f64 + self.collocation_shift;
                mean * (Complex::cis(wave_number * x) * amplitude).re
            };
            kernel.add_product(along_x, &along_y);
        }
    }

    /// The kernel k̂(q, y) (head of this file) without its factor sin(q/2)/(q/2), at the offsets y of the columns 0 to `columns`.
    fn kernel_at_y_offsets(&self, q: f64, columns: usize) -> Vec<f64> {
        let half = 0.5 * self.aspect;
        if columns == 0 && half >= self.base.influence_radius() {
            // In plane strain an element is longer than the influence radius.
            return vec![TAU / self.base.reduced_wave_number(q)];
        }
        // The part of the half space is the integral of the Bessel function 2 K₀ over the width of the element.
        let half_space = |column: usize| {
            let y = column as f64 * self.aspect;
            if y < half {
                integral_of_bessel(q, [0.0, half - y]) + integral_of_bessel(q, [0.0, half + y])
            } else {
                integral_of_bessel(q, [y - half, y + half])
            }
        };
        let mut kernel: Vec<f64> = (0..=columns).map(half_space).collect();
        // Add the difference of the layer from the half space if the wave is long enough for the layer to matter.
        let thickness = self.base.thickness();
        if q * thickness < MAX_LAYER_WAVE_NUMBER {
            self.add_layer_correction(q, &mut kernel);
        }
        kernel
    }

    /// Adds the difference of the layer from a half space, the part ∫ dy' 2 ∫ cos(q y' sinh u) (M(q t cosh u) − 1) du of k̂, to the `kernel`
    /// at the offset of each column.
    fn add_layer_correction(&self, q: f64, kernel: &mut [f64]) {
        let thickness = self.base.thickness();
        let half = 0.5 * self.aspect;
        let end = (MAX_LAYER_WAVE_NUMBER / (q * thickness)).acosh();
        // Count the waves of the integrand per unit of u at the end of the range and in the farthest column, where they are shortest.
        let waves = MAX_LAYER_WAVE_NUMBER / thickness * (kernel.len() as f64 * self.aspect) / TAU;
        let step = QUADRATURE_STEP.min((STEPS_PER_WAVE * waves).recip());

        // Integrate over u by the trapezoidal rule. The integrand is even, so that the node u = 0 counts once and all others twice.
        let nodes = iter::successors(Some(0.0), |u| Some(u + step));
        for u in nodes.take_while(|u| *u < end) {
            let [q_y, q_abs] = [q * u.sinh(), q * u.cosh()];
            let integral_over_width = if q_y > 0.0 {
                2.0 * (q_y * half).sin() / q_y
            } else {
                2.0 * half
            };
            let sides = if u > 0.0 { 2.0 } else { 1.0 };
            let weight = sides
                * step
                * integral_over_width
                * (self.base.compliance_ratio(q_abs * thickness) - 1.0);
            // The columns need the cosines of the multiples of one angle, which follow from each other by recurrence.
            let twice_cosine = 2.0 * (q_y * self.aspect).cos();
            let [mut previous, mut cosine] = [0.5 * twice_cosine, 1.0];
            for value in kernel.iter_mut() {
                *value += weight * cosine;
                [previous, cosine] = [cosine, twice_cosine * cosine - previous];
            }
        }
    }
}

/// 2 ∫ K₀(q y) dy over an interval of distances, by the trapezoidal rule in u (head of this file); the sum ends when terms are below rounding.
fn integral_of_bessel(q: f64, interval: [f64; 2]) -> f64 {
    let [from, to] = interval;
    let integrand = |u: f64| {
        let rate = q * u.cosh();
        let at_start = (-rate * from).exp();
        at_start * -(-rate * (to - from)).exp_m1() / rate
    };
    let mut sum = 0.5 * integrand(0.0);
    for index in 1.. {
        let term = integrand(QUADRATURE_STEP * f64::from(index));
        sum += term;
        if term <= 1e-15 * sum {
            break;
        }
    }
    2.0 * QUADRATURE_STEP * sum
}
