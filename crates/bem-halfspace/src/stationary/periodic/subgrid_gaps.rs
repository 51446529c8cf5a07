//! Bound of sub-grid gaps: gaps between the centres of elements that are all in contact.
//!
//! Docs: docs/theory/rough-surfaces.md, "Error bars".

use std::f64::consts::PI;

use indenters::rough::PeriodicSurface;

use crate::parallel::reductions::mean;
use crate::stationary::periodic::fourier_multiplier::FourierMultiplier;
use crate::{Base, PressureField};

/// Upper bound of the ratio of the area of a gap to the area under tension in full contact. Derived: a round gap is (3/2)^(1/2)
/// times as wide as its tensile area, which gives the ratio 3/2; a long one is 2^(1/2) times as wide, which gives this smaller one.
const GAP_TO_TENSION_RATIO: f64 = 1.5;
/// Number of points per element along either axis at which the pressure is evaluated if that at the centres is inconclusive. With
/// four elements per shortest wave the centres exclude gaps only if no pressure is below seven tenths of the mean. Chosen; from 2
/// to 8 no digit of an answer changes (case of `evidence tuning`).
const SUBSAMPLES_PER_AXIS: usize = 4;

/// Upper bounds of the changes by sub-grid gaps; zero if there are none.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SubgridGapBound {
    /// Bound of the change of the friction coefficient.
    pub(super) friction: f64,
    /// Bound of the change of the area fraction.
    pub(super) area_fraction: f64,
    /// Bound of the change of the mean pressure, \[Pa].
    pub(super) mean_pressure: f64,
    /// Bound of the change of the mean depth, \[m].
    pub(super) mean_depth: f64,
}

impl SubgridGapBound {
    /// The bounds for a pressure field under a sum of waves.
    ///
    /// The minimum of a band-limited pressure lies below its value at the nearest of N points along either edge by at most
    ///
    /// ```text
    /// ½ (π n_x/N_x + π n_y/N_y)² max |p − p̄|
    /// ```
    ///
    /// with the largest numbers n of waves in the period and the mean p̄ of the pressure p. The second derivative of the pressure
    /// along a line is at most its amplitude times the square of the largest wave number along the line (Bernstein 1912). The
    /// amplitude is at most that at the centres of the elements over cos(π n_x/N_x) cos(π n_y/N_y) (Ehlich & Zeller 1964).
    pub(super) fn new(field: &PressureField, surface: &PeriodicSurface) -> Self {
        let pressure = &field.pressure;
        if pressure.iter().any(|pressure| *pressure <= 0.0) {
            return Self::default();
        }
        // Bound the amplitude of the pressure between the centres, and the most by which the pressure falls below the nearest sample.
        let n = pressure.len() as f64;
        let mean = mean(pressure);
        let deviations = pressure.iter().map(|pressure| (pressure - mean).abs());
        let (numbers, shape) = (surface.largest_numbers(), field.grid.shape());
        let [x, y] = [0, 1].map(|axis| PI * numbers[axis] as f64 / shape[axis] as f64);
        let amplitude = deviations.fold(0.0, f64::max) / (x.cos() * y.cos());
        let max_drop = |samples: usize| 0.5 * ((x + y) / samples as f64).powi(2) * amplitude;
        if pressure.iter().all(|pressure| *pressure >= max_drop(1)) {
            return Self::default();
        }
        let mut waves = FourierMultiplier::new(&field.grid, &Base::default());

        // Sum and count the points whose pressure may be a tension nearby, on a finer sampling.
        let mut between = vec![0.0; pressure.len()];
        let [mut sum, mut count] = [0.0; 2];
        for sample in 0..SUBSAMPLES_PER_AXIS * SUBSAMPLES_PER_AXIS {
            let offset = [sample / SUBSAMPLES_PER_AXIS, sample % SUBSAMPLES_PER_AXIS]
                .map(|index| index as f64 / SUBSAMPLES_PER_AXIS as f64);
            waves.shift(pressure, &mut between, offset);
            let max_drop = max_drop(SUBSAMPLES_PER_AXIS);
            let tensions = between.iter().map(|pressure| max_drop - pressure);
            for tension in tensions.filter(|tension| *tension > 0.0) {
                sum += tension;
                count += 1.0;
            }
        }
        let n_samples = n * (SUBSAMPLES_PER_AXIS * SUBSAMPLES_PER_AXIS) as f64;
        let [mean_pressure, area_fraction] =
            [sum, count].map(|total| GAP_TO_TENSION_RATIO * total / n_samples);
        let relative = mean_pressure / mean;
        Self {
            friction: relative * surface.rms_slope(),
            area_fraction,
            mean_pressure,
            mean_depth: relative * surface.rms_height(),
        }
    }
}
