//! Gaussian random waves; each wave vector has its own stream of random numbers, so that it depends on the seed only.

use std::f64::consts::TAU;

use numerics::{in_range, positive};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::IndenterError;
use crate::rough::{PeriodicSurface, WAVELENGTH_TOLERANCE, Wave};

/// Range of the waves that are drawn.
pub(super) struct RandomWaves {
    /// Periods along x and y, \[m].
    pub(super) period: [f64; 2],
    /// Longest wave length, \[m].
    pub(super) longest_wavelength: f64,
    /// Shortest wave length, \[m].
    pub(super) shortest_wavelength: f64,
    /// Seed of the random numbers.
    pub(super) seed: u64,
}

/// Upper bound on the ratio of a period to the shortest wavelength, along an axis. Derived: two wave numbers fit into one stream
/// number.
const MAX_WAVES_PER_PERIOD: u16 = 1 << 15;

impl RandomWaves {
    /// The surface of all waves in the range, whose amplitudes have the root mean square √2 `amplitude` \[m], a function of 1/λ
    /// \[1/m].
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] for numbers out of range, and if the periods have no wave in the range.
    pub(super) fn surface(
        &self,
        amplitude: impl Fn(f64) -> f64,
    ) -> Result<PeriodicSurface, IndenterError> {
        let shortest = positive("shortest_wavelength", self.shortest_wavelength)?;
        for (axis, name) in ["period along x", "period along y"].into_iter().enumerate() {
            let period = positive(name, self.period[axis])?;
            let holds = period / shortest < f64::from(MAX_WAVES_PER_PERIOD);
            let allowed = "below 32768 of the shortest wave lengths";
            in_range(name, period, holds, allowed)?;
        }
        positive("longest_wavelength", self.longest_wavelength)?;
        let largest_number =
            |axis: usize| (self.period[axis] / shortest * (1.0 + WAVELENGTH_TOLERANCE)).floor();
        #[expect(clippy::cast_possible_truncation, reason = "below the largest number")]
        let [along_x, along_y] = [0, 1].map(|axis| largest_number(axis) as i32);
        // Draw only one of the two waves ±(m, n), because both are the same wave.
        let waves: Vec<Wave> = (0..=along_x)
            .flat_map(|m| (-along_y..=along_y).map(move |n| [m, n]))
            .filter(|[m, n]| *m > 0 || *n > 0)
            .filter_map(|numbers| {
                let inverse = self.inverse_length_in_range(numbers)?;
                Some(self.draw(numbers, amplitude(inverse)))
            })
            .collect();
        let allowed = "such that the periods have a wave not shorter than this and not longer than the longest";
        let holds = !waves.is_empty();
        in_range("shortest_wavelength", shortest, holds, allowed)?;
        PeriodicSurface::new(self.period, waves)
    }

    /// Inverse length 1/λ of a wave, \[1/m]; `None` if the wave is out of the range.
    fn inverse_length_in_range(&self, [m, n]: [i32; 2]) -> Option<f64> {
        let inverse = (f64::from(m) / self.period[0]).hypot(f64::from(n) / self.period[1]);
        let is_in_range = inverse * self.longest_wavelength >= 1.0 - WAVELENGTH_TOLERANCE
            && inverse * self.shortest_wavelength <= 1.0 + WAVELENGTH_TOLERANCE;
        is_in_range.then_some(inverse)
    }

    /// Draws amplitude and phase of the wave of two numbers m and n: the modulus of a complex Gaussian number times `amplitude` \[m],
    /// and its angle.
    fn draw(&self, numbers: [i32; 2], amplitude: f64) -> Wave {
        let mut generator = ChaCha8Rng::seed_from_u64(self.seed);
        // Each wave vector has its own stream of random numbers, so that a wave does not depend on which others are drawn.
        let place =
            |number: i32| (i64::from(number) + i64::from(MAX_WAVES_PER_PERIOD)).unsigned_abs();
        let [row, column] = numbers.map(place);
        generator.set_stream((row << 32) | column);
        let mut uniform = || ((generator.next_u64() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64;
        // Draw the modulus of a complex Gaussian number with the mean square 2 (Box & Muller 1958).
        let modulus = (-2.0 * uniform().ln()).sqrt();
        Wave {
            numbers,
            amplitude: modulus * amplitude,
            phase: TAU * uniform(),
        }
    }
}
