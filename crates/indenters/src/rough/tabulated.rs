//! Random surfaces of a power spectrum that is given as a table.
//!
//! ```text
//! ⟨h²⟩ = ∫ C d²q = 2π ∫ q C dq,    ⟨|∇h|²⟩ = 2π ∫ q³ C dq,    ln C linear in ln q between the rows
//! ```
//!
//! Next to a row with C = 0, as measured spectra have them, C is linear in q instead; at the ends of a table such rows are
//! dropped. The wave vectors q and −q are one wave of the surface, with the mean square amplitude 4 C Δq_x Δq_y.

use std::f64::consts::TAU;

use numerics::{in_range, not_negative, positive};

use super::random::RandomWaves;
use crate::IndenterError;
use crate::rough::PeriodicSurface;
use crate::table::{check_increasing, check_min_length};

/// An isotropic power spectrum C(q) of surfaces, between the first and the last of its wave numbers.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TabulatedSpectrum {
    /// Wave numbers, increasing, \[1/m].
    wave_numbers: Vec<f64>,
    /// Spectral density at each wave number, \[m⁴].
    densities: Vec<f64>,
}

impl TabulatedSpectrum {
    /// The spectrum through the points (`wave_numbers[i]` \[1/m], `densities[i]` \[m⁴]).
    ///
    /// Wave numbers are positive and increase, densities are at least 0. The spectrum extends from the first to the last
    /// positive density.
    ///
    /// # Errors
    /// [`IndenterError`] `LengthMismatch`, `TooFew` (two rows from the first to the last positive density are needed),
    /// `NotIncreasing` or `InvalidParameter`.
    pub fn new(mut wave_numbers: Vec<f64>, mut densities: Vec<f64>) -> Result<Self, IndenterError> {
        if wave_numbers.len() != densities.len() {
            return Err(IndenterError::LengthMismatch {
                first: "wave numbers",
                first_length: wave_numbers.len(),
                second: "densities",
                second_length: densities.len(),
            });
        }
        check_increasing("wave numbers", &wave_numbers)?;
        for (&wave_number, &density) in wave_numbers.iter().zip(&densities) {
            positive("wave number", wave_number)?;
            not_negative("density", density)?;
        }
        // Drop the rows of density 0 at both ends of the table, because they contain no waves.
        let has_waves = |density: &f64| *density > 0.0;
        let last = densities
            .iter()
            .rposition(has_waves)
            .map_or(0, |last| last + 1);
        let first = densities.iter().position(has_waves).unwrap_or(0);
        for column in [&mut wave_numbers, &mut densities] {
            column.truncate(last);
            column.drain(..first);
        }
        check_min_length(2, "wave numbers with a density", wave_numbers.len())?;
        Ok(Self {
            wave_numbers,
            densities,
        })
    }

    /// Longest and shortest wave length of the table, \[m].
    pub fn wavelengths(&self) -> [f64; 2] {
        let last = self.wave_numbers.len() - 1;
        [self.wave_numbers[0], self.wave_numbers[last]].map(|wave_number| TAU / wave_number)
    }

    /// Root mean square slope of an infinite surface with all waves of the table.
    pub fn rms_slope(&self) -> f64 {
        let between = self.wave_numbers.windows(2).zip(self.densities.windows(2));
        let squares = between.map(|(q, c)| {
            // Next to a row without waves the density C is linear in the wave number q, and ∫ q³ C dq is a polynomial.
            if c.contains(&0.0) {
                let slope = (c[1] - c[0]) / (q[1] - q[0]);
                let powers =
                    [4, 5].map(|power| (q[1].powi(power) - q[0].powi(power)) / f64::from(power));
                return TAU * ((c[0] - slope * q[0]) * powers[0] + slope * powers[1]);
            }
            let (range, change) = ((q[1] / q[0]).ln(), (c[1] / c[0]).ln());
            // Between two rows the density C times q⁴ is a power of the wave number q. Hence ∫ q³ C dq = q₀⁴ C₀ ln(q₁/q₀) (e^x −
            // 1)/x with x = ln(q₁⁴C₁/(q₀⁴C₀)).
            let exponent = 4.0 * range + change;
            let growth = if exponent.abs() < f64::EPSILON {
                1.0
            } else {
                exponent.exp_m1() / exponent
            };
            TAU * q[0].powi(4) * c[0] * range * growth
        });
        squares.sum::<f64>().sqrt()
    }

    /// Density C at a wave number within the table, \[m⁴].
    fn density(&self, wave_number: f64) -> f64 {
        let last = self.wave_numbers.len() - 1;
        let to = self
            .wave_numbers
            .partition_point(|q| *q <= wave_number)
            .clamp(1, last);
        let from = to - 1;
        let [below, above] = [self.densities[from], self.densities[to]];
        // The density is linear in q next to a row without waves, otherwise a power of q.
        if below == 0.0 || above == 0.0 {
            let width = self.wave_numbers[to] - self.wave_numbers[from];
            let part = (wave_number - self.wave_numbers[from]) / width;
            return (below + part * (above - below)).max(0.0);
        }
        let range = (self.wave_numbers[to] / self.wave_numbers[from]).ln();
        let part = (wave_number / self.wave_numbers[from]).ln() / range;
        below * (part * (above / below).ln()).exp()
    }

    /// Draws a surface with the `period` \[m] along x and y from the waves of the table down to `shortest_wavelength` \[m].
    ///
    /// The `seed` selects the realisation.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] for numbers out of range, and if the periods have no wave in the range.
    pub fn surface(
        &self,
        period: [f64; 2],
        shortest_wavelength: f64,
        seed: u64,
    ) -> Result<PeriodicSurface, IndenterError> {
        let [longest_wavelength, shortest] = self.wavelengths();
        let allowed = "not shorter than the shortest wave of the table";
        let is_in_table = shortest_wavelength >= shortest;
        in_range(
            "shortest_wavelength",
            shortest_wavelength,
            is_in_table,
            allowed,
        )?;
        let random = RandomWaves {
            period,
            longest_wavelength,
            shortest_wavelength,
            seed,
        };
        // The mean square amplitude of a wave, 4 C Δq_x Δq_y with the density C and the spacings Δq of wave numbers, is twice the
        // square of the given amplitude.
        let cell = TAU / period[0] * (TAU / period[1]);
        random.surface(|inverse| (2.0 * cell * self.density(TAU * inverse)).sqrt())
    }
}
