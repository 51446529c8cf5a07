//! Random self-affine surfaces.
//!
//! ```text
//! C(q) ∝ q^(−2 (1 + H))   from the roll-off to the shortest wave,  constant from the longest wave to the roll-off,
//! ⟨h²⟩ = ∫ C d²q
//! ```

use numerics::{between_zero_and_one, in_range, positive};

use super::random::RandomWaves;
use crate::IndenterError;
use crate::rough::PeriodicSurface;

/// A random surface with a self-affine isotropic spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SelfAffine {
    /// Periods along x and y, \[m].
    pub period: [f64; 2],
    /// Hurst exponent H, between 0 and 1.
    pub hurst_exponent: f64,
    /// Root mean square of |∇h| > 0, exact for each realisation.
    pub rms_slope: f64,
    /// Longest wave length, \[m].
    pub longest_wavelength: f64,
    /// Shortest wave length, \[m].
    pub shortest_wavelength: f64,
    /// Wave length above which the spectrum is constant, \[m]; the longest one for a spectrum without roll-off.
    pub roll_off_wavelength: f64,
    /// Seed of the random numbers, which selects the realisation.
    pub seed: u64,
}

impl SelfAffine {
    /// Draws the surface.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] for numbers out of range, and if the periods have no wave in the range.
    pub fn surface(&self) -> Result<PeriodicSurface, IndenterError> {
        self.validate()?;
        let random = RandomWaves {
            period: self.period,
            longest_wavelength: self.longest_wavelength,
            shortest_wavelength: self.shortest_wavelength,
            seed: self.seed,
        };
        // Draw the waves with amplitudes of the right ratios, then scale them to the rms slope.
        let mut surface = random.surface(|inverse| {
            let ratio = (inverse * self.roll_off_wavelength).max(1.0);
            ratio.powf(-1.0 - self.hurst_exponent)
        })?;
        let factor = positive("rms slope", self.rms_slope / surface.rms_slope())?;
        for wave in &mut surface.waves {
            wave.amplitude *= factor;
        }
        Ok(surface)
    }

    /// Refuses numbers out of their ranges.
    fn validate(&self) -> Result<(), IndenterError> {
        between_zero_and_one("hurst_exponent", self.hurst_exponent)?;
        positive("rms_slope", self.rms_slope)?;
        let shortest = positive("shortest_wavelength", self.shortest_wavelength)?;
        let longest = positive("longest_wavelength", self.longest_wavelength)?;
        let roll_off = self.roll_off_wavelength;
        let is_in_range = roll_off >= shortest && roll_off <= longest;
        let allowed = "between the shortest and the longest wave length";
        in_range("roll_off_wavelength", roll_off, is_in_range, allowed)?;
        Ok(())
    }
}
