//! A rough surface without seam.

use std::f64::consts::PI;

use rustfft::FftPlannerScalar;
use rustfft::num_complex::Complex;

use crate::random::Random;

const HURST_EXPONENT: f64 = 0.8;
/// Longest waves along the side.
const LONGEST: f64 = 4.0;
/// Elements along the shortest wave.
const SHORTEST: f64 = 8.0;

/// A periodic self-affine body over `n` × `n` elements of a side of length 1, with the root of the mean square slope 1.
///
/// White noise of fixed seed, whose waves are weighted with `q^(−1−H)` from the longest to the shortest.
pub(super) fn self_affine(n: usize) -> Vec<f64> {
    let mut planner = FftPlannerScalar::new();
    let mut field = white_noise(n * n);
    planner.plan_fft_forward(n).process(&mut field);
    transpose(&mut field, n);
    planner.plan_fft_forward(n).process(&mut field);
    let wave_number = |index: usize| index.min(n - index) as f64;
    let mut square_slope = 0.0;
    for (index, value) in field.iter_mut().enumerate() {
        let q = wave_number(index / n).hypot(wave_number(index % n));
        let inside = (LONGEST..=n as f64 / SHORTEST).contains(&q);
        *value *= if inside {
            q.powf(-1.0 - HURST_EXPONENT)
        } else {
            0.0
        };
        square_slope += (2.0 * PI * q).powi(2) * value.norm_sqr();
    }
    planner.plan_fft_inverse(n).process(&mut field);
    transpose(&mut field, n);
    planner.plan_fft_inverse(n).process(&mut field);
    // The transforms are not normalised, and by Parseval's theorem the slope has their factor too.
    let scale = 1.0 / square_slope.sqrt();
    field.iter().map(|value| -(value.re * scale)).collect()
}

fn transpose(field: &mut [Complex<f64>], n: usize) {
    for row in 0..n {
        for column in 0..row {
            field.swap(row * n + column, column * n + row);
        }
    }
}

/// Normally distributed numbers (Box & Muller 1958).
fn white_noise(count: usize) -> Vec<Complex<f64>> {
    let mut random = Random::new(0);
    let normal = |_| {
        let radius = (-2.0 * (1.0 - random.uniform()).ln()).sqrt();
        Complex::from(radius * (2.0 * PI * random.uniform()).cos())
    };
    (0..count).map(normal).collect()
}
