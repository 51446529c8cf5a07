//! Gaps that hide between elements which are all in contact.

use std::f64::consts::PI;

use indenters::rough::PeriodicSurface;

use crate::PressureField;

/// What opens is larger than the elements that may be under tension: (3/2)^(1/2) times as wide at a round gap, 2^(1/2) times as
/// wide at a long one, with safety.
const SHARE: f64 = 2.0;

/// What they change at most.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Unseen {
    pub(super) friction: f64,
    pub(super) area_fraction: f64,
    /// \[Pa].
    pub(super) mean_pressure: f64,
    /// \[m].
    pub(super) mean_depth: f64,
}

impl Unseen {
    /// Where a pressure of waves is lowest it is at most so much lower than at the nearest element:
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
        let (shape, numbers) = (field.grid.shape(), surface.largest_numbers());
        let [x, y] = [0, 1].map(|axis| PI * numbers[axis] as f64 / shape[axis] as f64);
        let n = pressure.len() as f64;
        let mean = pressure.iter().sum::<f64>() / n;
        let away = pressure.iter().map(|pressure| (pressure - mean).abs());
        let amplitude = away.fold(0.0, f64::max) / (x.cos() * y.cos());
        let lower = 0.5 * (x + y).powi(2) * amplitude;
        let tensions = pressure.iter().map(|pressure| (lower - pressure).max(0.0));
        let mean_pressure = SHARE * tensions.sum::<f64>() / n;
        let part = mean_pressure / mean;
        Self {
            friction: part * surface.rms_slope(),
            area_fraction: SHARE * pressure.iter().filter(|p| **p < lower).count() as f64 / n,
            mean_pressure,
            mean_depth: part * surface.rms_height(),
        }
    }
}
