//! Temperature of a periodic surface, wave by wave.
//!
//! ```text
//! k T̂(q) = Q̂(q) S(β)/β,   β² = q² − i q_x v/D,   Re β > 0;       q = 0:  k T̄ = (1/√π) ∫_0^√(4Dt) S ds · Q̄
//! ```
//!
//! with the ratio S of the depth of the sources. A flux that is constant per element also has the aliases q + 2πm/Δ of the
//! resolved wave, weighted with the transform sinc(q_xΔ_x/2) sinc(q_yΔ_y/2) of an element; at the centres of the elements they add up.
//!
//! Theory: docs/theory/heat.md, "Periodic surfaces".

use std::f64::consts::PI;

use rustfft::num_complex::Complex;

use crate::Grid;
use crate::heat::source::SourceDepth;
use crate::parallel::row_blocks::{copies, for_each_row};
use crate::transform::plane_transform::complex_product::{Spectrum, signed_offset};
use crate::transform::plane_transform::{PlaneTransform, ZERO};

/// Number of aliases on either side of a resolved wave. Measured: the largest error of an influence coefficient is 5e-4 of the
/// self-influence, for element Péclet numbers vΔ/(2D) from 0 to 100; with 2 aliases it is 5e-3.
const ALIASES: usize = 3;
/// Weights of the waves m = 0, ±1, ±2, ±3, whose terms alternate in sign: the sum of the others is extrapolated (Cohen, Rodriguez
/// Villegas & Zagier 2000, algorithm 1).
const ALIAS_WEIGHTS: [f64; ALIASES + 1] = [1.0, 98.0 / 99.0, 80.0 / 99.0, 32.0 / 99.0];

/// Multipliers of the waves on one period.
#[derive(Debug, Clone)]
pub(super) struct PeriodicWaves {
    /// One period in elements; lengths in the unit of the grid.
    pub(super) grid: Grid,
    /// Reciprocal v/D of the Péclet length.
    pub(super) velocity_over_diffusivity: f64,
    /// Diffusion length √(4Dt) of the time t for which the mean grows.
    pub(super) mean_length: f64,
}

/// A resolved wave along one axis, or one of its aliases.
#[derive(Debug, Clone, Copy)]
struct Alias {
    /// Wave number along the axis.
    wave_number: f64,
    /// Transform of an element, times the weight of the sum over aliases.
    weight: f64,
}

impl Alias {
    /// Wave number of the resolved wave among its aliases.
    const fn resolved(aliases: &[Self; 2 * ALIASES + 1]) -> f64 {
        aliases[ALIASES].wave_number
    }
}

impl PeriodicWaves {
    /// Multipliers for sources at a `depth`, `[column][row]`, times the normalisation of the transforms; `unit` is the length unit of
    /// the grid, \[m].
    pub(super) fn spectrum(
        &self,
        transform: &PlaneTransform,
        depth: &SourceDepth,
        unit: f64,
    ) -> Spectrum {
        let rows = self.grid.shape()[0];
        let normalisation = transform.normalisation();
        let along: Vec<_> = (0..rows).map(|row| self.aliases(0, row)).collect();
        let mut spectrum = copies(ZERO, transform.n_columns() * rows);
        for_each_row(&mut spectrum, rows, |column, values| {
            let across = self.aliases(1, column);
            for (row, (value, along)) in values.iter_mut().zip(&along).enumerate() {
                // The mean grows in time; a flux constant per element has aliases, too.
                let mut sum = match [row, column] {
                    [0, 0] => Complex::from(depth.uniform_rise(self.mean_length * unit) / unit),
                    _ => match depth {
                        SourceDepth::Plane(_) => {
                            self.multiplier([along, &across].map(Alias::resolved), depth, unit)
                        }
                        _ => self.sum_of_aliases(along, &across, depth, unit),
                    },
                };
                // The shortest wave of an even number of rows stands for both directions.
                if 2 * row == rows {
                    sum.im = 0.0;
                }
                *value = sum * normalisation;
            }
        });
        spectrum
    }

    /// The wave with the index `index` along an axis, and its aliases.
    fn aliases(&self, axis: usize, index: usize) -> [Alias; 2 * ALIASES + 1] {
        let (n, edge) = (self.grid.shape()[axis], self.grid.spacing()[axis]);
        let phase = PI * signed_offset(index, n) as f64 / n as f64;
        std::array::from_fn(|position| {
            let order = position.abs_diff(ALIASES);
            let half_turns = position as f64 - ALIASES as f64;
            let sign = if order.is_multiple_of(2) { 1.0 } else { -1.0 };
            let argument = phase + PI * half_turns;
            let sinc = if order == 0 && index == 0 {
                1.0
            } else {
                sign * phase.sin() / argument
            };
            Alias {
                wave_number: 2.0 * argument / edge,
                weight: sinc * ALIAS_WEIGHTS[order],
            }
        })
    }

    /// Sum of S(β)/β over the aliases of a wave that is not constant.
    fn sum_of_aliases(
        &self,
        along: &[Alias],
        across: &[Alias],
        depth: &SourceDepth,
        unit: f64,
    ) -> Complex<f64> {
        let mut sum = ZERO;
        for x in along.iter().filter(|alias| alias.weight.abs() > 0.0) {
            for y in across.iter().filter(|alias| alias.weight.abs() > 0.0) {
                let q = [x.wave_number, y.wave_number];
                sum += self.multiplier(q, depth, unit) * (x.weight * y.weight);
            }
        }
        sum
    }

    /// Ratio S(β)/β of temperature and flux of a wave. One with crests along x, and at rest every one, stays at its place on the
    /// elastomer, and grows with the time in which the mean grows.
    fn multiplier(&self, q: [f64; 2], depth: &SourceDepth, unit: f64) -> Complex<f64> {
        let beta = decay_constant(q, self.velocity_over_diffusivity, 0.0);
        let stationary = depth.wave_ratio(beta / unit) / beta;
        if q[0] == 0.0 || self.velocity_over_diffusivity == 0.0 {
            let wave_number = q[0].hypot(q[1]) / unit;
            stationary * depth.grown_part(wave_number, self.mean_length * unit)
        } else {
            stationary
        }
    }
}

/// Decay constant β of the temperature of a wave over the depth, with a positive real part, from its wave numbers along x and y, the ratio v/D
/// of velocity and diffusivity, and the rate from 0 to v/(2D) with which it is damped along x, in the same unit.
///
/// β² = (q_x + ia)² + q_y² − i (q_x + ia) v/D with the rate a.
pub(super) fn decay_constant(
    wave_numbers: [f64; 2],
    velocity_over_diffusivity: f64,
    damping: f64,
) -> Complex<f64> {
    let [q_x, q_y] = wave_numbers;
    let square = q_x * q_x + q_y * q_y + damping * (velocity_over_diffusivity - damping);
    let transport = q_x * (velocity_over_diffusivity - 2.0 * damping);
    let real = (0.5 * (square.hypot(transport) + square)).sqrt();
    Complex::new(real, -0.5 * transport / real)
}
