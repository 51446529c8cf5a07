//! A reciprocating cycle in full contact, in closed form.
//!
//! ```text
//! p(q, t) = p̄ δ_q0 − |q| ĥ(q) σ(q_x, t)/((1 − ν) M),      force/area = Σ_q |q| |ĥ|² Re(i q_x σ u*)/((1 − ν) M)
//! ```
//!
//! for the mean pressure p̄ and a surface of the heights h = Σ ĥ(q) e^(iq·r), which is shifted by the motion: u is the
//! displacement of a unit wave and σ its stress (`stresses.rs`). ν is the Poisson ratio and M the compliance ratio of a layer, 1
//! on a half space.

use std::f64::consts::PI;

use rustfft::num_complex::Complex;

use super::stresses::WaveMotion;
use crate::Grid;
use crate::parallel::reductions::{dot, mean};
use crate::stationary::periodic::fourier_multiplier::{FourierMultiplier, Wave};
use crate::transform::plane_transform::ZERO;

/// A surface on a grid, for the test whether its contact is full and for its closed form.
pub(super) struct FullContactSurface<'a> {
    /// Grid of one period.
    pub(super) grid: &'a Grid,
    /// Heights at the centres of the elements, \[m].
    pub(super) heights: &'a [f64],
    /// Fourier transforms on the grid, with the reduced wave number |q|/M of each wave on the base.
    pub(super) waves: FourierMultiplier,
    /// Factor 1 − ν, for the Poisson ratio ν.
    pub(super) factor: f64,
    /// Mean pressure, \[Pa].
    pub(super) mean_pressure: f64,
    /// Largest numbers of waves in the period along x and y.
    pub(super) largest_numbers: [usize; 2],
}

/// Forces and work of a cycle in full contact.
pub(super) struct FullContact {
    /// Tangential force along −x over the area of the period, at the end of every step, \[Pa].
    pub(super) stresses: Vec<f64>,
    /// Dissipated work of the cycle over the area of the period, \[J/m²].
    pub(super) work: f64,
}

impl FullContactSurface<'_> {
    /// Lower bound, without unit, of the ratio of the largest value of a band-limited field at the centres of the elements to its
    /// maximum everywhere.
    ///
    /// It is cos(πn/N) for n waves along N elements (Ehlich & Zeller 1964), and once more along x, because steps are as long as an
    /// element.
    fn sampling_ratio(&self) -> f64 {
        let (numbers, shape) = (self.largest_numbers, self.grid.shape());
        let [x, y] = [0, 1].map(|axis| (PI * numbers[axis] as f64 / shape[axis] as f64).cos());
        x * x * y
    }

    /// True if the pressure of the motion is positive everywhere, also between elements and between steps.
    pub(super) fn is_full(&mut self, motion: &WaveMotion) -> bool {
        // The deviation of the pressure from its mean must stay below the mean, at all ends of steps.
        let rows = self.grid.shape()[0];
        let allowed = self.sampling_ratio() * self.mean_pressure;
        let mut field = vec![0.0; self.heights.len()];
        motion.states[1..].iter().all(|state| {
            let (heights, factor) = (self.heights, self.factor);
            let stress = |row: usize| value_of_row(&state.stress, row, rows);
            let symbol = |wave: &Wave| -stress(wave.row) * wave.reduced_wave_number / factor;
            self.waves.apply(heights, &mut field, symbol);
            let mean = mean(&field);
            field.iter().all(|p| (p - mean).abs() < allowed)
        })
    }

    /// Forces and work of the cycle, from the waves of the motion; `wave_numbers` are q_x by the number of waves in the period,
    /// \[rad/m].
    pub(super) fn cycle(mut self, motion: &WaveMotion, wave_numbers: &[f64]) -> FullContact {
        let ends = &motion.states[1..];
        let n = self.grid.n_elements() as f64;
        let rows = self.grid.shape()[0];
        let mut field = vec![0.0; self.heights.len()];
        // Compute the weight of each number of waves along x: the sum of |q| |ĥ|²/((1 − ν) M) over all waves with this number
        // (head of this file).
        let weights: Vec<f64> = (0..wave_numbers.len())
            .map(|number| {
                let is_own = |row: usize| row.min(rows - row) == number;
                let symbol = |wave: &Wave| {
                    let own = is_own(wave.row);
                    Complex::from(if own {
                        wave.reduced_wave_number / self.factor
                    } else {
                        0.0
                    })
                };
                self.waves.apply(self.heights, &mut field, symbol);
                dot(&field, self.heights) / n
            })
            .collect();
        // The force over the area at the end of a step is a sum over the waves along x with these weights (head of this file).
        let stress = |state: &super::stresses::WaveStates| {
            let pairs = state.stress.iter().zip(&state.displacement);
            let waves = pairs.zip(wave_numbers.iter().zip(&weights));
            let each = waves.map(|((stress, u), (q, weight))| -weight * q * (stress * u.conj()).im);
            each.sum()
        };
        let work = weights.iter().zip(&motion.work);
        FullContact {
            stresses: ends.iter().map(stress).collect(),
            work: work.map(|(weight, work)| weight * work).sum(),
        }
    }
}

/// Amplitude of the waves of one row of a transform of `rows` rows; `values` has the amplitudes for q_x ≥ 0, by the number of waves
/// in the period. Rows of negative q_x have the complex conjugate, and rows of more waves than `values` has are 0.
pub(super) fn value_of_row(values: &[Complex<f64>], row: usize, rows: usize) -> Complex<f64> {
    let number = row.min(rows - row);
    let value = values.get(number).copied().unwrap_or(ZERO);
    if 2 * row > rows { value.conj() } else { value }
}
