//! What a quantity asks of the complex modulus at each frequency: its weights of the kernel as a sum of waves.
//!
//! Along x the kernel of an element is a sum of waves `e^(iqx)`, each of which oscillates at the frequency `ω = q v` in the
//! material, so that its compliance `1/(G' − i G'')` is a factor of it. A column of elements at the distance y has
//!
//! ```text
//! k̂(q, y) = sin(q/2)/(q/2) ∫ dy' [2 K₀(q|y'|) + 2 ∫_0^∞ cos(q y' sinh u) (M(q t cosh u) − 1) du]
//! ```
//!
//! with lengths in Δx, y' over the breadth of an element around y, and `K₀(z) = ∫_0^∞ e^(−z cosh u) du`. The integrands by u are
//! analytic and end smoothly: equal steps integrate them to rounding.

use std::f64::consts::TAU;
use std::iter;

use rustfft::num_complex::Complex;

use crate::Base;
use crate::parallel::reductions::dot;
use crate::stationary::steady::sensitivity::correlation::Correlation;

/// Step of u, where an integrand has no waves.
const STEP: f64 = 0.25;
/// Steps in the shortest wave of an integrand, which is at its end, where next to nothing is left of it.
const STEPS_PER_WAVE: f64 = 2.0;
/// Wave number over the thickness from which a base is not felt: M − 1 has ended.
const SHORTEST: f64 = 18.0;
/// CorrelationSpectrum of the weights in a panel of the integral over a band, the ratio of its ends, and the end of the first one over that of
/// a band from 0 on.
const WAVES_PER_PANEL: f64 = 0.4;
const RATIO: f64 = 1.25;
const LOWEST: f64 = 1e-3;
/// The two nodes of a rule by Gauss on [−1, 1].
const NODES: [f64; 2] = [-0.577_350_269_189_625_8, 0.577_350_269_189_625_8];

/// The weights of quantities on elements of one grid over a base; their gaps are felt so far from their centres.
pub(super) struct CorrelationSpectrum<'a> {
    pub(super) quantities: Vec<&'a Correlation>,
    /// With lengths in Δx.
    pub(super) base: &'a Base,
    pub(super) aspect: f64,
    pub(super) collocation_shift: f64,
}

impl CorrelationSpectrum<'_> {
    /// The nodes of the wave number between two, with their weights: fine enough for the waves of the longest distance and for
    /// what varies with the logarithm of the frequency.
    pub(super) fn nodes(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
        let rows = (2 * self.reach()[0] + 1) as f64;
        let widest = WAVES_PER_PANEL * TAU / rows;
        let next = move |from: f64| to.min(from + widest).min(RATIO * from.max(LOWEST * to));
        let ends = iter::successors(Some(from), move |from| Some(next(*from)));
        let panels = ends.take_while(move |from| *from < to);
        panels.flat_map(move |from| {
            let half = 0.5 * (next(from) - from);
            NODES.map(|node| [from + half * (1.0 + node), half])
        })
    }

    fn reach(&self) -> [usize; 2] {
        self.quantities
            .first()
            .map_or([0; 2], |correlation| correlation.reach())
    }

    /// Sums of the weights of each quantity times the waves of the kernel of a unit compliance at one wave number.
    pub(super) fn at(&self, wave_number: f64) -> Vec<Complex<f64>> {
        let [rows, columns] = self.reach();
        let kernel = self.along_y(wave_number, columns);
        let half = 0.5 * wave_number;
        let mean = half.sin() / half;
        let sum = |correlation: &&Correlation| -> Complex<f64> {
            let wave = |row: usize| {
                let x = row as f64 - rows as f64 + self.collocation_shift;
                dot(correlation.row(row), &kernel) * Complex::cis(wave_number * x)
            };
            (0..=2 * rows).map(wave).sum::<Complex<f64>>() * mean
        };
        self.quantities.iter().map(sum).collect()
    }

    /// k̂ without its factor along x, at the distance of each column.
    fn along_y(&self, q: f64, columns: usize) -> Vec<f64> {
        let half = 0.5 * self.aspect;
        if columns == 0 && half >= self.base.influence_radius() {
            // In plane strain elements are longer than anything is felt.
            return vec![TAU / self.base.stiffness(q)];
        }
        let half_space = |column: usize| {
            let y = column as f64 * self.aspect;
            if y < half {
                integral_of_bessel(q, [0.0, half - y]) + integral_of_bessel(q, [0.0, half + y])
            } else {
                integral_of_bessel(q, [y - half, y + half])
            }
        };
        let mut kernel: Vec<f64> = (0..=columns).map(half_space).collect();
        let thickness = self.base.thickness();
        if q * thickness < SHORTEST {
            self.add_base(q, &mut kernel);
        }
        kernel
    }

    /// Adds what the base adds to a half space.
    fn add_base(&self, q: f64, kernel: &mut [f64]) {
        let thickness = self.base.thickness();
        let half = 0.5 * self.aspect;
        let end = (SHORTEST / (q * thickness)).acosh();
        // Per unit of u, at the end and in the farthest column.
        let waves = SHORTEST / thickness * (kernel.len() as f64 * self.aspect) / TAU;
        let step = STEP.min((STEPS_PER_WAVE * waves).recip());
        let nodes = iter::successors(Some(0.0), |u| Some(u + step));
        for u in nodes.take_while(|u| *u < end) {
            let [across, whole] = [q * u.sinh(), q * u.cosh()];
            let breadth = if across > 0.0 {
                2.0 * (across * half).sin() / across
            } else {
                2.0 * half
            };
            let first = if u > 0.0 { 2.0 } else { 1.0 };
            let weight =
                first * step * breadth * (self.base.compliance_ratio(whole * thickness) - 1.0);
            // The cosines of multiples of one angle.
            let twice = 2.0 * (across * self.aspect).cos();
            let [mut before, mut here] = [0.5 * twice, 1.0];
            for value in kernel.iter_mut() {
                *value += weight * here;
                [before, here] = [here, twice * here - before];
            }
        }
    }
}

/// 2 ∫ K₀(q y) dy between two distances.
fn integral_of_bessel(q: f64, [from, to]: [f64; 2]) -> f64 {
    let at = |u: f64| {
        let rate = q * u.cosh();
        let ended = (-rate * from).exp();
        ended * -(-rate * (to - from)).exp_m1() / rate
    };
    let mut sum = 0.5 * at(0.0);
    for index in 1.. {
        let part = at(STEP * f64::from(index));
        sum += part;
        if part <= 1e-15 * sum {
            break;
        }
    }
    2.0 * STEP * sum
}
