//! Random waves, Gaussian and drawn by wave vector, so that they depend on nothing else but the seed.

use std::f64::consts::TAU;

use numerics::{in_range, positive};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::IndenterError;
use crate::rough::{PeriodicSurface, SLACK, Wave};

/// Which waves are drawn.
pub(super) struct RandomWaves {
    /// Periods along x and y, \[m].
    pub(super) period: [f64; 2],
    /// Longest and shortest wave length, \[m].
    pub(super) longest_wavelength: f64,
    pub(super) shortest_wavelength: f64,
    pub(super) seed: u64,
}

/// Waves of a period along an axis are fewer than this.
const LARGEST_NUMBER: u16 = 1 << 15;

impl RandomWaves {
    /// The surface of waves whose amplitudes have the root mean square √2 times a function \[m] of their inverse length.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] for numbers out of range, and wave lengths between which the periods have no wave.
    pub(super) fn surface(
        &self,
        amplitude: impl Fn(f64) -> f64,
    ) -> Result<PeriodicSurface, IndenterError> {
        let shortest = positive("shortest_wavelength", self.shortest_wavelength)?;
        for (axis, name) in ["period along x", "period along y"].into_iter().enumerate() {
            let period = positive(name, self.period[axis])?;
            let holds = period / shortest < f64::from(LARGEST_NUMBER);
            let allowed = "below 32768 of the shortest wave lengths";
            in_range(name, period, holds, allowed)?;
        }
        positive("longest_wavelength", self.longest_wavelength)?;
        let reach = |axis: usize| (self.period[axis] / shortest * (1.0 + SLACK)).floor();
        #[expect(clippy::cast_possible_truncation, reason = "below the largest number")]
        let [along_x, along_y] = [0, 1].map(|axis| reach(axis) as i32);
        // One of two waves with opposite numbers.
        let numbers = (0..=along_x).flat_map(|m| (-along_y..=along_y).map(move |n| [m, n]));
        let numbers = numbers.filter(|[m, n]| *m > 0 || *n > 0);
        let waves = numbers.filter_map(|numbers| {
            let inverse = self.inverse_length(numbers)?;
            Some(self.draw(numbers, amplitude(inverse)))
        });
        let waves: Vec<Wave> = waves.collect();
        let allowed = "such that the periods have a wave not shorter than this and not longer than the longest";
        let holds = !waves.is_empty();
        in_range("shortest_wavelength", shortest, holds, allowed)?;
        PeriodicSurface::new(self.period, waves)
    }

    /// The inverse length of a wave that is drawn.
    fn inverse_length(&self, [m, n]: [i32; 2]) -> Option<f64> {
        let inverse = (f64::from(m) / self.period[0]).hypot(f64::from(n) / self.period[1]);
        let is_part = inverse * self.longest_wavelength >= 1.0 - SLACK
            && inverse * self.shortest_wavelength <= 1.0 + SLACK;
        is_part.then_some(inverse)
    }

    fn draw(&self, numbers: [i32; 2], amplitude: f64) -> Wave {
        let mut generator = ChaCha8Rng::seed_from_u64(self.seed);
        // Every wave vector has a stream of its own.
        let place = |number: i32| (i64::from(number) + i64::from(LARGEST_NUMBER)).unsigned_abs();
        let [row, column] = numbers.map(place);
        generator.set_stream((row << 32) | column);
        let mut uniform = || ((generator.next_u64() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64;
        // The modulus of a complex Gaussian number.
        let modulus = (-2.0 * uniform().ln()).sqrt();
        Wave {
            numbers,
            amplitude: modulus * amplitude,
            phase: TAU * uniform(),
        }
    }
}
