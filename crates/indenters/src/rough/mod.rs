//! Periodic surfaces as finite sums of waves: the same surface on every grid.
//!
//! ```text
//! h(x, y) = Σ a cos(2π (m x/L_x + n y/L_y) + φ)
//! ```

mod from_map;
mod random;
mod roughness;
mod self_affine;
mod spectrum;
mod tabulated;

use std::borrow::Cow;
use std::f64::consts::TAU;

use numerics::transforms::Real;
use numerics::{InvalidParameter, finite, in_range, positive};
use rustfft::num_complex::Complex;

use crate::IndenterError;
use crate::table::check_min_length;
pub use roughness::Roughness;
pub use self_affine::SelfAffine;
pub use spectrum::{PowerSpectrum, Ring};
pub use tabulated::TabulatedSpectrum;

/// Relative tolerance with which two wavelengths are compared. Chosen; it covers the rounding of whole fractions of a period.
const WAVELENGTH_TOLERANCE: f64 = 1e-12;

/// A wave a cos(2π (m x/L_x + n y/L_y) + φ) of a periodic surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Wave {
    /// Numbers m and n of wave lengths in the periods along x and y, not both 0.
    pub numbers: [i32; 2],
    /// Amplitude a, \[m].
    pub amplitude: f64,
    /// Phase φ at the origin, \[rad].
    pub phase: f64,
}

/// A rigid surface that is periodic along x and y.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PeriodicSurface {
    /// Periods along x and y, \[m].
    period: [f64; 2],
    /// Waves whose sum is the heights.
    waves: Vec<Wave>,
}

impl PeriodicSurface {
    /// The sum of the `waves`, with the `period` [L_x, L_y] \[m].
    ///
    /// # Errors
    /// [`IndenterError::TooFew`] without waves; [`IndenterError::InvalidParameter`] for a period that is not positive, a
    /// wave without length, and an amplitude or a phase that is not finite.
    pub fn new(period: [f64; 2], waves: Vec<Wave>) -> Result<Self, IndenterError> {
        positive("period along x", period[0])?;
        positive("period along y", period[1])?;
        check_min_length(1, "waves", waves.len())?;
        for wave in &waves {
            let allowed = "other than 0 along x or y: a mean height changes nothing";
            in_range("number of waves", 0.0, wave.numbers != [0, 0], allowed)?;
            finite("amplitude", wave.amplitude)?;
            finite("phase", wave.phase)?;
        }
        Ok(Self { period, waves })
    }

    /// The periods along x and y, \[m].
    pub const fn period(&self) -> [f64; 2] {
        self.period
    }

    /// Waves of the surface.
    pub fn waves(&self) -> &[Wave] {
        &self.waves
    }

    /// Largest |m| and |n| of the waves.
    pub fn largest_numbers(&self) -> [usize; 2] {
        [0, 1].map(|axis| {
            let waves = self.waves.iter();
            let numbers = waves.map(|wave| wave.numbers[axis].unsigned_abs());
            numbers.fold(0, u32::max) as usize
        })
    }

    /// Root mean square of |∇h|; waves that are given twice count as independent.
    pub fn rms_slope(&self) -> f64 {
        let square = |wave: &Wave| {
            let [q_x, q_y] = self.wave_vector(wave);
            0.5 * wave.amplitude * wave.amplitude * (q_x * q_x + q_y * q_y)
        };
        self.waves.iter().map(square).sum::<f64>().sqrt()
    }

    /// Root mean square of the height relative to its mean, \[m].
    pub fn rms_height(&self) -> f64 {
        let square = |wave: &Wave| 0.5 * wave.amplitude * wave.amplitude;
        self.waves.iter().map(square).sum::<f64>().sqrt()
    }

    /// The surface without its shortest octave, the waves shorter than twice the shortest; `None` if no wave remains.
    #[must_use]
    pub fn without_shortest_octave(&self) -> Option<Self> {
        self.without_waves_below(2.0 * self.shortest_wavelength())
    }

    /// Length of the shortest wave with an amplitude other than 0, \[m]; infinite if there is none.
    pub fn shortest_wavelength(&self) -> f64 {
        let waves = self.waves.iter().filter(|wave| wave.amplitude != 0.0);
        TAU / waves.map(|wave| self.wave_number(wave)).fold(0.0, f64::max)
    }

    /// The surface without the waves shorter than a length \[m]; `None` if no wave remains.
    #[must_use]
    pub fn without_waves_below(&self, shortest: f64) -> Option<Self> {
        let largest = TAU / shortest * (1.0 + WAVELENGTH_TOLERANCE);
        let is_long = |wave: &&Wave| wave.amplitude != 0.0 && self.wave_number(wave) <= largest;
        let waves = self.waves.iter().filter(is_long).copied().collect();
        Self::new(self.period, waves).ok()
    }

    /// Magnitude of the wave vector of a wave of this surface, \[1/m].
    fn wave_number(&self, wave: &Wave) -> f64 {
        let [x, y] = self.wave_vector(wave);
        x.hypot(y)
    }

    /// The surface with only the waves that a grid of this shape resolves; `None` if it resolves none.
    ///
    /// A wave is resolved if it has more than two elements per wave length along x and along y.
    pub fn resolved_on(&self, shape: [usize; 2]) -> Option<Cow<'_, Self>> {
        let is_resolved = |wave: &&Wave| {
            let mut numbers = wave.numbers.iter().zip(shape);
            numbers.all(|(number, elements)| elements > 2 * number.unsigned_abs() as usize)
        };
        if self.waves.iter().all(|wave| is_resolved(&wave)) {
            return Some(Cow::Borrowed(self));
        }
        let waves = self.waves.iter().filter(is_resolved).copied().collect();
        Self::new(self.period, waves).ok().map(Cow::Owned)
    }

    /// Wave vector of a wave along x and y, \[1/m].
    pub fn wave_vector(&self, wave: &Wave) -> [f64; 2] {
        [0, 1].map(|axis| TAU * f64::from(wave.numbers[axis]) / self.period[axis])
    }

    /// Heights \[m] on a grid of `[rows, columns]` elements along x and y, row-major with y fastest.
    ///
    /// The first element is at the origin.
    ///
    /// # Errors
    /// [`InvalidParameter`] for a grid with no more than two elements per shortest wave.
    #[expect(
        clippy::missing_panics_doc,
        reason = "the lengths are those of the plan"
    )]
    pub fn heights(&self, [rows, columns]: [usize; 2]) -> Result<Vec<f64>, InvalidParameter> {
        let [along_x, along_y] = self.largest_numbers();
        let allowed = "more than two for each of the shortest waves";
        let (enough_x, enough_y) = (rows > 2 * along_x, columns > 2 * along_y);
        in_range("elements along x", rows as f64, enough_x, allowed)?;
        in_range("elements along y", columns as f64, enough_y, allowed)?;
        // Place the amplitudes of all waves in the spectrum. It has only wave numbers n ≥ 0 along y, and is stored column by
        // column.
        let n_columns = columns / 2 + 1;
        let mut spectrum = vec![Complex::default(); n_columns * rows];
        for wave in &self.waves {
            add_wave(wave, &mut spectrum, rows);
        }
        // Transform the spectrum back along x, then along y, which gives the heights.
        let along_x = f64::inverse(rows);
        along_x.process(&mut spectrum);
        let along_y = f64::real_inverse(columns);
        let mut coefficients = along_y.make_input_vec();
        let mut scratch = along_y.make_scratch_vec();
        let mut heights = vec![0.0; rows * columns];
        for (row, heights) in heights.chunks_exact_mut(columns).enumerate() {
            for (coefficient, column) in coefficients.iter_mut().zip(spectrum.chunks_exact(rows)) {
                *coefficient = column[row];
            }
            // The coefficients of n = 0 and n = columns/2 are their own conjugates, hence real.
            coefficients[0].im = 0.0;
            if columns.is_multiple_of(2) {
                coefficients[n_columns - 1].im = 0.0;
            }
            let done = along_y.process_with_scratch(&mut coefficients, heights, &mut scratch);
            assert!(done.is_ok(), "the lengths are those of the plan");
        }
        Ok(heights)
    }
}

/// Adds half the amplitude of a wave at ±(m, n) to a spectrum with n ≥ 0, stored by n with `rows` numbers m of each; the inverse
/// transform is not normalised.
fn add_wave(wave: &Wave, spectrum: &mut [Complex<f64>], rows: usize) {
    let half = Complex::from_polar(0.5 * wave.amplitude, wave.phase);
    let [m, n] = wave.numbers;
    for (m, n, coefficient) in [(m, n, half), (-m, -n, half.conj())] {
        if n >= 0 {
            let row = i64::from(m).rem_euclid(rows as i64).unsigned_abs();
            let place = i64::from(n).unsigned_abs() * rows as u64 + row;
            #[expect(clippy::cast_possible_truncation, reason = "within the spectrum")]
            let place = place as usize;
            spectrum[place] += coefficient;
        }
    }
}
