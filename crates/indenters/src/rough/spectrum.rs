//! Power spectra of measured surfaces.
//!
//! ```text
//! ⟨z²⟩ = ∫ C d²q = 2π ∫ q C(q) dq,        C_x(q_x) = ∫ C dq_y,   ⟨z²⟩ = ∫ C_x dq_x  over all q_x, of either sign
//! ```
//!
//! Conventions differ between programs: SurfaceTopography's isotropic spectrum is 4π² C, that of its profiles 2π C_x.

use std::f64::consts::{PI, TAU};

use super::roughness::check_lengths;
use crate::rough::{PeriodicSurface, Wave};
use crate::{HeightMap, IndenterError};

/// Power spectrum of a height map.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PowerSpectrum {
    /// The map as a sum of waves; [`density`](Self::density) is its two-dimensional spectrum.
    pub waves: PeriodicSurface,
    /// Radial average: means over rings of wave vectors, up to the largest wave number that both axes have.
    pub radial: Vec<Ring>,
    /// Spectra of the profiles along x and along y, as wave numbers ≥ 0 \[1/m] with C_x or C_y \[m³].
    ///
    /// The spectra are even in the wave number.
    pub profiles: [Vec<[f64; 2]>; 2],
}

/// Mean of a spectrum over a ring of wave vectors.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Ring {
    /// Mean of |q| over the wave vectors, \[1/m].
    pub wave_number: f64,
    /// Mean of C over the wave vectors, \[m⁴].
    pub density: f64,
    /// Number of pairs ±q of wave vectors; the density of a Gaussian random surface has the relative scatter 1/√waves.
    pub waves: usize,
}

impl PowerSpectrum {
    /// Spectrum of a height map.
    ///
    /// A map that does not repeat itself (`repeats` is false) is multiplied by a Hann window along both axes, because the
    /// steps at its edges have waves of all lengths. The window has the mean square 1 and acts on heights less their mean.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] for the same maps as [`Roughness::of`](super::Roughness::of).
    pub fn of(map: &HeightMap, repeats: bool) -> Result<Self, IndenterError> {
        let waves = if repeats {
            PeriodicSurface::from_map(map, 0.0)?
        } else {
            PeriodicSurface::from_map(&apply_hann_window(map)?, 0.0)?
        };
        check_lengths(map)?;
        Ok(Self {
            radial: radial_average(&waves, map.shape()),
            profiles: [0, 1].map(|axis| profile_spectrum(&waves, axis, map.shape()[axis])),
            waves,
        })
    }

    /// C at the wave vector of a wave and at the opposite one, \[m⁴].
    pub fn density(&self, wave: &Wave) -> f64 {
        density(&self.waves, wave)
    }
}

/// Density C at the wave vector of a wave, \[m⁴].
fn density(surface: &PeriodicSurface, wave: &Wave) -> f64 {
    let [x, y] = wave_vector_steps(surface);
    0.25 * wave.amplitude * wave.amplitude / (x * y)
}

/// Distances Δq of neighbouring wave vectors along x and y, \[1/m].
fn wave_vector_steps(surface: &PeriodicSurface) -> [f64; 2] {
    surface.period().map(|period| TAU / period)
}

/// The map less its mean under a Hann window along both axes; √(8/3) sin² has the mean square 1.
fn apply_hann_window(map: &HeightMap) -> Result<HeightMap, IndenterError> {
    let [rows, columns] = map.shape();
    let mean = map.heights().iter().sum::<f64>() / map.heights().len() as f64;
    let window = |at: usize, count: usize| {
        let sine = (PI * (at as f64 + 0.5) / count as f64).sin();
        (8.0_f64 / 3.0).sqrt() * sine * sine
    };
    let nodes = map.heights().iter().enumerate();
    let heights = nodes.map(|(at, height)| {
        window(at / columns, rows) * window(at % columns, columns) * (height - mean)
    });
    HeightMap::from_gaps(map.shape(), map.spacing(), heights.collect())
}

/// Radial average over rings as wide as the larger Δq; wave vectors without a wave count with the density 0. `shape` is that of
/// the map, whose wave vectors the rings hold.
fn radial_average(surface: &PeriodicSurface, shape: [usize; 2]) -> Vec<Ring> {
    let [x, y] = wave_vector_steps(surface);
    let width = x.max(y);
    let ring_of = |q: f64| numerics::whole_part((q / width).round());
    let [rows, columns] = shape.map(|count| (count - 1) / 2);
    let n_rings = ring_of((rows as f64 * x).min(columns as f64 * y)) + 1;
    // Count the wave vectors ±q of the grid in each ring.
    let mut sums = vec![RingSum::default(); n_rings];
    let half = (0..=rows).flat_map(|m| (0..=columns).map(move |n| [m, n]));
    for [m, n] in half.filter(|numbers| *numbers != [0, 0]) {
        let q = (m as f64 * x).hypot(n as f64 * y);
        // Off the axes (m, n) stands for (m, −n) too, hence counts twice.
        let multiplicity = if m > 0 && n > 0 { 2.0 } else { 1.0 };
        if let Some(sum) = sums.get_mut(ring_of(q)) {
            sum.waves += multiplicity;
            sum.wave_number += multiplicity * q;
        }
    }
    // Add the spectral density of each wave of the surface to the sum of its ring.
    for wave in surface.waves() {
        let [q_x, q_y] = surface.wave_vector(wave);
        if let Some(sum) = sums.get_mut(ring_of(q_x.hypot(q_y))) {
            sum.density += density(surface, wave);
        }
    }
    sums.into_iter()
        .filter(|sum| sum.waves > 0.0)
        .map(|sum| Ring {
            wave_number: sum.wave_number / sum.waves,
            density: sum.density / sum.waves,
            waves: numerics::whole_part(sum.waves),
        })
        .collect()
}

/// Sums over the wave vectors of a ring.
#[derive(Clone, Copy, Default)]
struct RingSum {
    /// Number of wave vectors.
    waves: f64,
    /// Sum of the wave numbers, \[1/m].
    wave_number: f64,
    /// Sum of the densities, \[m⁴].
    density: f64,
}

/// Spectrum of the profiles along an axis, pairs of a wave number \[1/m] from 0 on and a density \[m³]: the density of the surface
/// integrated over the other axis. `count` is the number of heights along the axis.
fn profile_spectrum(surface: &PeriodicSurface, axis: usize, count: usize) -> Vec<[f64; 2]> {
    let step = wave_vector_steps(surface);
    let mut spectrum: Vec<[f64; 2]> = (0..count.div_ceil(2))
        .map(|number| [number as f64 * step[axis], 0.0])
        .collect();
    for wave in surface.waves() {
        let number = wave.numbers[axis].unsigned_abs() as usize;
        // A wave with the wave number 0 along this axis counts twice, because both ±q have it.
        let multiplicity = if number == 0 { 2.0 } else { 1.0 };
        spectrum[number][1] += multiplicity * density(surface, wave) * step[1 - axis];
    }
    spectrum
}
