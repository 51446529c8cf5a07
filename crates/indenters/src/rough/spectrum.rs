//! Power spectra of measured surfaces.
//!
//! ```text
//! ⟨z²⟩ = ∫ C d²q = 2π ∫ q C(q) dq,        C_x(q_x) = ∫ C dq_y,   ⟨z²⟩ = ∫ C_x dq_x  over all q_x, of either sign
//! ```
//!
//! Other programs have other factors: the isotropic spectrum of SurfaceTopography is 4π² C, that of its profiles 2π C_x.

use std::f64::consts::{PI, TAU};

use super::roughness::check_lengths;
use crate::rough::{PeriodicSurface, Wave};
use crate::{HeightMap, IndenterError};

/// Power spectrum of a map.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PowerSpectrum {
    /// The map as a sum of waves, of which [`density`](Self::density) is the two-dimensional spectrum.
    pub waves: PeriodicSurface,
    /// Means over rings of wave vectors, from the longest waves to the shortest that both axes have.
    pub radial: Vec<Ring>,
    /// Wave numbers \[1/m] and the spectra C_x and C_y \[m³] of all profiles along x and along y; of the two wave numbers
    /// with opposite signs, which have the same, one.
    pub profiles: [Vec<[f64; 2]>; 2],
}

/// Mean of a spectrum over a ring of wave vectors.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Ring {
    /// Mean of |q| over the wave vectors, \[1/m].
    pub wave_number: f64,
    /// Mean of C, \[m⁴].
    pub density: f64,
    /// Wave vectors in the ring, of two opposite ones one: the density of a random surface scatters by its part 1/√waves.
    pub waves: usize,
}

impl PowerSpectrum {
    /// Spectrum of a map that `repeats` itself; of any other one it is that of the heights, less their mean, under a Hann
    /// window along both axes with the mean square 1, because the steps at its edges have waves of all lengths.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] as of [`Roughness::of`](super::Roughness::of).
    pub fn of(map: &HeightMap, repeats: bool) -> Result<Self, IndenterError> {
        let waves = if repeats {
            PeriodicSurface::through(map, 0.0)?
        } else {
            PeriodicSurface::through(&windowed(map)?, 0.0)?
        };
        check_lengths(map)?;
        Ok(Self {
            radial: rings(&waves, map.shape()),
            profiles: [0, 1].map(|axis| profiles(&waves, axis, map.shape()[axis])),
            waves,
        })
    }

    /// C at the wave vector of a wave and at the opposite one, \[m⁴].
    pub fn density(&self, wave: &Wave) -> f64 {
        density(&self.waves, wave)
    }
}

fn density(surface: &PeriodicSurface, wave: &Wave) -> f64 {
    let [x, y] = steps(surface);
    0.25 * wave.amplitude * wave.amplitude / (x * y)
}

/// Distances of neighbouring wave vectors along x and y, \[1/m].
fn steps(surface: &PeriodicSurface) -> [f64; 2] {
    surface.period().map(|period| TAU / period)
}

fn windowed(map: &HeightMap) -> Result<HeightMap, IndenterError> {
    let [rows, columns] = map.shape();
    let mean = map.heights().iter().sum::<f64>() / map.heights().len() as f64;
    let window = |at: usize, count: usize| {
        let sine = (PI * (at as f64 + 0.5) / count as f64).sin();
        (8.0_f64 / 3.0).sqrt() * sine * sine
    };
    let places = map.heights().iter().enumerate();
    let heights = places.map(|(at, height)| {
        window(at / columns, rows) * window(at % columns, columns) * (height - mean)
    });
    HeightMap::new(map.shape(), map.spacing(), heights.collect())
}

/// Rings as wide as the larger step; wave vectors that the map does not have count with the density 0.
fn rings(surface: &PeriodicSurface, shape: [usize; 2]) -> Vec<Ring> {
    let [x, y] = steps(surface);
    let width = x.max(y);
    let ring_of = |q: f64| numerics::whole_part((q / width).round());
    let [rows, columns] = shape.map(|count| (count - 1) / 2);
    let n_rings = ring_of((rows as f64 * x).min(columns as f64 * y)) + 1;
    let mut sums = vec![[0.0; 3]; n_rings];
    let half = (0..=rows).flat_map(|m| (0..=columns).map(move |n| [m, n]));
    for [m, n] in half.filter(|numbers| *numbers != [0, 0]) {
        let q = (m as f64 * x).hypot(n as f64 * y);
        // Beside the axes there is one with the opposite number along y, too.
        let times = if m > 0 && n > 0 { 2.0 } else { 1.0 };
        if let Some([waves, length, _]) = sums.get_mut(ring_of(q)) {
            *waves += times;
            *length += times * q;
        }
    }
    for wave in surface.waves() {
        let [q_x, q_y] = surface.wave_vector(wave);
        if let Some([_, _, total]) = sums.get_mut(ring_of(q_x.hypot(q_y))) {
            *total += density(surface, wave);
        }
    }
    let rings = sums.into_iter().filter(|[waves, ..]| *waves > 0.0);
    let ring = |[waves, length, total]: [f64; 3]| Ring {
        wave_number: length / waves,
        density: total / waves,
        waves: numerics::whole_part(waves),
    };
    rings.map(ring).collect()
}

/// The integral over the other axis, by numbers of waves along this one from 0 on.
fn profiles(surface: &PeriodicSurface, axis: usize, count: usize) -> Vec<[f64; 2]> {
    let step = steps(surface);
    let mut spectrum: Vec<[f64; 2]> = (0..count.div_ceil(2))
        .map(|number| [number as f64 * step[axis], 0.0])
        .collect();
    for wave in surface.waves() {
        let number = wave.numbers[axis].unsigned_abs() as usize;
        // Of opposite waves along the other axis both have the wave number 0.
        let times = if number == 0 { 2.0 } else { 1.0 };
        spectrum[number][1] += times * density(surface, wave) * step[1 - axis];
    }
    spectrum
}
