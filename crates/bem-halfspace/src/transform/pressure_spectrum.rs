//! Distribution of a stationary, sliding pressure over the frequencies at which it strains the material.
//!
//! At a velocity v along x, the pressure wave of the wave vector q and the amplitude p̂ oscillates in the material at ω = |q_x| v.
//! With J'' the loss compliance and M(|q|t) the compliance ratio of a layer of thickness t, the dissipated power is
//!
//! ```text
//! F_h v = Σ_q |p̂(q)|² M(|q|t)/|q| · ω J''(ω),        M = 1 on a half space.
//! ```
//!
//! The functions return Σ |p̂|² M/|q| per band of frequencies, up to a common factor.

use rheology::{Material as _, StressBand};
use rustfft::num_complex::Complex;

use crate::transform::fast_length::fast_length;
use crate::transform::plane_transform::{PlaneTransform, ZERO};
use crate::{Elastomer, PressureField};

/// Ratios along x and y of the period that replaces the unbounded surface to the edges of the contact's bounding box. A ratio of
/// 2 is enough for the square of the transform. Chosen: with 8 along x, bands are an eighth of the contact's own wave number
/// wide, which is the resolution of the dissipation over frequency.
const PERIOD_OVER_CONTACT: [usize; 2] = [8, 4];

/// Frequency bands of a line contact that slides at a `velocity` \[m/s]; `pressure` has [position \[m], pressure] at increasing
/// positions.
///
/// The compliance 1/|q| gives all octaves of long waves the same weight, down to frequencies at which the material is elastic.
pub fn line_spectrum(
    pressure: &[[f64; 2]],
    elastomer: &dyn Elastomer,
    velocity: f64,
) -> Vec<StressBand> {
    let material = elastomer.material();
    let base = elastomer.base();
    material.creep().bands_along(pressure, velocity, |wave| {
        base.compliance_ratio(wave * base.thickness()) / wave
    })
}

impl PressureField {
    /// Frequency bands of a contact that slides along x at a `velocity` \[m/s].
    pub fn spectrum(&self, elastomer: &dyn Elastomer, velocity: f64) -> Vec<StressBand> {
        let shape = self.grid.shape();
        let period = [0, 1].map(|axis| fast_length(PERIOD_OVER_CONTACT[axis] * shape[axis]));
        let wave_step = self.wave_steps(period)[0];
        // Each wave of the period stands for the band of half a step on both sides; the band at zero has one side only.
        let band = |index: f64| [(index - 0.5).max(0.0), index + 0.5];
        let weights = self.dissipation_weights(period, elastomer);
        weights
            .into_iter()
            .enumerate()
            .map(|(index, weight)| StressBand {
                band: band(index as f64).map(|wave| wave * wave_step * velocity),
                weight,
            })
            .collect()
    }

    /// Frequencies of the pressure on one period of a surface that slides along x at a `velocity` \[m/s]; bands of zero width.
    pub fn periodic_spectrum(&self, elastomer: &dyn Elastomer, velocity: f64) -> Vec<StressBand> {
        let period = self.grid.shape();
        let wave_step = self.wave_steps(period)[0];
        let weights = self.dissipation_weights(period, elastomer);
        // Leave out the waves with crests along x, which do not oscillate in the material.
        let moving = weights.into_iter().enumerate().skip(1);
        let line = |(index, weight)| StressBand {
            band: [index as f64 * wave_step * velocity; 2],
            weight,
        };
        moving.map(line).collect()
    }

    /// Wave numbers of the longest waves along x and y of a period in elements, \[rad/m].
    fn wave_steps(&self, period: [usize; 2]) -> [f64; 2] {
        let spacing = self.grid.spacing();
        [0, 1].map(|axis| std::f64::consts::TAU / (period[axis] as f64 * spacing[axis]))
    }

    /// Sums Σ |p̂|² M/|q| over all waves along y, one for each wave number 0, 1, 2, … along x, in units of the longest wave, of a
    /// period given in elements.
    fn dissipation_weights(&self, period: [usize; 2], elastomer: &dyn Elastomer) -> Vec<f64> {
        let [rows, columns] = self.grid.shape();
        // Transform the rows of the contact along y, padded with zeros to the period.
        let plan = PlaneTransform::new(period);
        let n_waves = plan.n_columns();
        let mut transformed = vec![ZERO; rows * n_waves];
        let mut row = vec![0.0; period[1]];
        for (pressures, waves) in
            (self.pressure.chunks_exact(columns)).zip(transformed.chunks_exact_mut(n_waves))
        {
            row.fill(0.0);
            row[..columns].copy_from_slice(pressures);
            plan.transform_row(&mut row, waves);
        }
        // Transform the columns along x one by one, and add up their squared coefficients times the compliances of the waves.
        let compliance = self.compliance(period, elastomer);
        let mut squares = vec![0.0; period[0] / 2 + 1];
        let mut column = vec![ZERO; period[0]];
        for wave in 0..n_waves {
            column.fill(ZERO);
            let values = transformed[wave..].iter().step_by(n_waves);
            column
                .iter_mut()
                .zip(values)
                .for_each(|(to, from)| *to = *from);
            plan.column_forward(&mut column);
            // The wave (q_x, −q_y) is not stored: it is the conjugate of (−q_x, q_y), which counts twice.
            let is_own_conjugate = wave == 0 || 2 * wave == period[1];
            let multiplicity = if is_own_conjugate { 1.0 } else { 2.0 };
            for (index, value) in column.iter().map(Complex::norm_sqr).enumerate() {
                let along = index.min(period[0] - index);
                squares[along] += multiplicity * value * compliance([along, wave]);
            }
        }
        squares
    }

    /// Compliance M/|q| \[m] as a function of the wave numbers along x and y, in units of the longest waves. At q = 0 the mean of 1/|q|
    /// over the cell of the wave replaces 1/|q|.
    fn compliance(
        &self,
        period: [usize; 2],
        elastomer: &dyn Elastomer,
    ) -> impl Fn([usize; 2]) -> f64 {
        let [a, b] = self.wave_steps(period);
        let base = elastomer.base();
        let inverse_of_longest = 2.0 * (a * (b / a).asinh() + b * (a / b).asinh()) / (a * b);
        move |[along, across]| {
            let length = (along as f64 * a).hypot(across as f64 * b);
            let inverse = if length > 0.0 {
                length.recip()
            } else {
                inverse_of_longest
            };
            base.compliance_ratio(base.thickness() / inverse) * inverse
        }
    }
}
