//! Gaps that hide between elements which are all in contact.

use std::f64::consts::PI;

use indenters::rough::PeriodicSurface;

use crate::stationary::periodic::fourier_multiplier::FourierMultiplier;
use crate::{Base, PressureField};

/// What opens is larger than the elements that may be under tension: (3/2)^(1/2) times as wide at a round gap, 2^(1/2) times as
/// wide at a long one, with safety.
const SHARE: f64 = 2.0;
/// Places in an element along either axis at which the pressure is looked at where its centre does not tell that no gaps hide: with
/// four elements per shortest wave it only does where no pressure is less than seven tenths of the mean.
const PLACES: usize = 4;

/// What they change at most.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SubgridGapBound {
    pub(super) friction: f64,
    pub(super) area_fraction: f64,
    /// \[Pa].
    pub(super) mean_pressure: f64,
    /// \[m].
    pub(super) mean_depth: f64,
}

impl SubgridGapBound {
    /// Where a pressure of waves is lowest it is at most so much lower than at the nearest of N places along either edge:
    ///
    /// ```text
    /// ½ (π n_x/N_x + π n_y/N_y)² max |p − p̄|
    /// ```
    ///
    /// with the largest numbers n of waves in the period. For its second derivative along a line is at most its amplitude times the
    /// square of the largest wave number along it (Bernstein 1912), and its amplitude at most that of the elements over
    /// cos(π n_x/N_x) cos(π n_y/N_y) (Ehlich & Zeller 1964).
    pub(super) fn of(field: &PressureField, surface: &PeriodicSurface) -> Self {
        let pressure = &field.pressure;
        if pressure.iter().any(|pressure| *pressure <= 0.0) {
            return Self::default();
        }
        let n = pressure.len() as f64;
        let mean = pressure.iter().sum::<f64>() / n;
        let away = pressure.iter().map(|pressure| (pressure - mean).abs());
        let (numbers, shape) = (surface.largest_numbers(), field.grid.shape());
        let [x, y] = [0, 1].map(|axis| PI * numbers[axis] as f64 / shape[axis] as f64);
        let amplitude = away.fold(0.0, f64::max) / (x.cos() * y.cos());
        let lower = |places: usize| 0.5 * ((x + y) / places as f64).powi(2) * amplitude;
        if pressure.iter().all(|pressure| *pressure >= lower(1)) {
            return Self::default();
        }
        let mut waves = FourierMultiplier::new(&field.grid, &Base::default());
        let mut between = vec![0.0; pressure.len()];
        let [mut sum, mut count] = [0.0; 2];
        for place in 0..PLACES * PLACES {
            let parts = [place / PLACES, place % PLACES];
            let parts = parts.map(|part| part as f64 / PLACES as f64);
            waves.beside(pressure, &mut between, parts);
            let tensions = between.iter().map(|pressure| lower(PLACES) - pressure);
            for tension in tensions.filter(|tension| *tension > 0.0) {
                sum += tension;
                count += 1.0;
            }
        }
        let [mean_pressure, area_fraction] =
            [sum, count].map(|total| SHARE * total / (n * (PLACES * PLACES) as f64));
        let part = mean_pressure / mean;
        Self {
            friction: part * surface.rms_slope(),
            area_fraction,
            mean_pressure,
            mean_depth: part * surface.rms_height(),
        }
    }
}
