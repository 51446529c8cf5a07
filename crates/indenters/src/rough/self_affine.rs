//! Random self-affine surfaces.
//!
//! ```text
//! C(q) ∝ q^(−2 (1 + H))   from the roll-off to the shortest wave,  constant from the longest wave to the roll-off
//! ```
//!
//! with ⟨h²⟩ = ∫ C d²q. Amplitudes are Gaussian and drawn by wave vector, so that they depend on nothing else but the seed.

use std::f64::consts::TAU;

use numerics::{between_zero_and_one, in_range, positive};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::IndenterError;
use crate::rough::{PeriodicSurface, Wave};

/// A random surface with a self-affine isotropic spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SelfAffine {
    /// Periods along x and y, \[m].
    pub period: [f64; 2],
    /// Hurst exponent H, between 0 and 1.
    pub hurst_exponent: f64,
    /// Root mean square of |∇h| > 0, of this surface and not only on average.
    pub rms_slope: f64,
    /// Longest wave length, \[m].
    pub longest_wavelength: f64,
    /// Shortest wave length, \[m].
    pub shortest_wavelength: f64,
    /// Wave length above which the spectrum is constant, \[m]; the longest one for a spectrum without roll-off.
    pub roll_off_wavelength: f64,
    /// Another seed draws another surface.
    pub seed: u64,
}

impl SelfAffine {
    /// Draws the surface.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] for numbers out of range, and wave lengths between which the periods have no wave.
    pub fn surface(&self) -> Result<PeriodicSurface, IndenterError> {
        self.validate()?;
        let reach = |axis: usize| (self.period[axis] / self.shortest_wavelength).floor();
        #[expect(clippy::cast_possible_truncation, reason = "validated")]
        let [along_x, along_y] = [0, 1].map(|axis| reach(axis) as i32);
        // One of two waves with opposite numbers.
        let numbers = (0..=along_x).flat_map(|m| (-along_y..=along_y).map(move |n| [m, n]));
        let numbers = numbers.filter(|[m, n]| *m > 0 || *n > 0);
        let waves: Vec<Wave> = numbers.filter_map(|numbers| self.draw(numbers)).collect();
        let allowed = "such that the periods have a wave not shorter than this and not longer than the longest";
        let (shortest, holds) = (self.shortest_wavelength, !waves.is_empty());
        in_range("shortest_wavelength", shortest, holds, allowed)?;
        let mut surface = PeriodicSurface::new(self.period, waves)?;
        let factor = positive("rms slope", self.rms_slope / surface.rms_slope())?;
        for wave in &mut surface.waves {
            wave.amplitude *= factor;
        }
        Ok(surface)
    }

    fn validate(&self) -> Result<(), IndenterError> {
        between_zero_and_one("hurst_exponent", self.hurst_exponent)?;
        positive("rms_slope", self.rms_slope)?;
        let shortest = positive("shortest_wavelength", self.shortest_wavelength)?;
        for (axis, name) in ["period along x", "period along y"].into_iter().enumerate() {
            let period = positive(name, self.period[axis])?;
            let holds = period / shortest < f64::from(LARGEST_NUMBER);
            let allowed = "below 32768 of the shortest wave lengths";
            in_range(name, period, holds, allowed)?;
        }
        let longest = positive("longest_wavelength", self.longest_wavelength)?;
        let roll_off = self.roll_off_wavelength;
        let holds = roll_off >= shortest && roll_off <= longest;
        let allowed = "between the shortest and the longest wave length";
        in_range("roll_off_wavelength", roll_off, holds, allowed)?;
        Ok(())
    }

    /// The wave with these numbers, if it is part of the spectrum; before the rms slope is right.
    fn draw(&self, [m, n]: [i32; 2]) -> Option<Wave> {
        let inverse = (f64::from(m) / self.period[0]).hypot(f64::from(n) / self.period[1]);
        let is_part = inverse * self.longest_wavelength >= 1.0 - SLACK
            && inverse * self.shortest_wavelength <= 1.0 + SLACK;
        if !is_part {
            return None;
        }
        let ratio = (inverse * self.roll_off_wavelength).max(1.0);
        let mut generator = ChaCha8Rng::seed_from_u64(self.seed);
        // Every wave vector has a stream of its own.
        let [row, column] = [m, n].map(|number| i64::from(number) + i64::from(LARGEST_NUMBER));
        generator.set_stream((row.unsigned_abs() << 32) | column.unsigned_abs());
        let mut uniform = || ((generator.next_u64() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64;
        // The modulus of a complex Gaussian number.
        let modulus = (-2.0 * uniform().ln()).sqrt();
        Some(Wave {
            numbers: [m, n],
            amplitude: modulus * ratio.powf(-1.0 - self.hurst_exponent),
            phase: TAU * uniform(),
        })
    }
}

/// Waves of a period along an axis are fewer than this.
const LARGEST_NUMBER: u16 = 1 << 15;
/// Wave lengths that are a whole part of the period count although they are rounded.
const SLACK: f64 = 1e-12;
