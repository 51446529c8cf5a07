//! How a sliding material answers waves of pressure.
//!
//! ```text
//! û(q) = 2 p̂(q) / (|q| E*(−q_x v)) = (1 − ν) [J'(q_x v) + i J''(q_x v)] p̂(q) / |q|,        q_x ≥ 0
//! ```
//!
//! In the frame that moves with the surface a wave passes with the angular frequency −q_x v. The gap of an element is
//! evaluated at the fraction θ = −δ/π of it, with the loss angle δ at the shortest wave along x: there displacement and
//! pressure are in phase, and less than a quarter period apart for all other waves.

use std::f64::consts::PI;

use numerics::positive;
use rheology::{CreepSpectrum, Material};
use rustfft::num_complex::Complex;

use crate::periodic::waves::{WaveNumbers, Waves};
use crate::{BemError, Grid};

/// A material under a surface that slides.
#[derive(Debug, Clone)]
pub(super) struct Sliding {
    creep: CreepSpectrum,
    /// 1 − ν.
    factor: f64,
    velocity: f64,
}

impl Sliding {
    pub(super) fn new(
        material: &(impl Material + ?Sized),
        velocity: f64,
    ) -> Result<Self, BemError> {
        let creep = material.creep();
        if creep.fluidity() > 0.0 {
            return Err(BemError::FlowsUnderWaves);
        }
        Ok(Self {
            factor: 0.5 * positive("half-space factor", material.half_space_factor())?,
            creep,
            velocity,
        })
    }

    /// (1 − ν) [J' + i J''] of every row, before any shift.
    fn compliances(&self, along_x: &[f64]) -> Result<Vec<Complex<f64>>, BemError> {
        let compliance = |q_x: &f64| {
            let frequency = (q_x * self.velocity).abs();
            let compliance = self.creep.complex_compliance(frequency)?;
            positive("storage compliance", compliance.storage)?;
            let loss = compliance.loss.copysign(*q_x);
            Ok(Complex::new(compliance.storage, loss) * self.factor)
        };
        along_x.iter().map(compliance).collect()
    }
}

/// Symbols of one grid, by row of the transform.
#[derive(Debug)]
pub(super) struct Kernel {
    /// |q| û/p̂ at the centre of an element.
    pub(super) at_centre: Vec<Complex<f64>>,
    /// The shift to the point at which the gap is evaluated.
    shift: Vec<Complex<f64>>,
    /// Their product.
    factors: Vec<Complex<f64>>,
    along_x: Vec<f64>,
}

impl Kernel {
    pub(super) fn new(sliding: &Sliding, grid: &Grid) -> Result<Self, BemError> {
        let dx = grid.spacing()[0];
        let WaveNumbers { along_x, .. } = WaveNumbers::new(grid);
        let mut at_centre = sliding.compliances(&along_x)?;
        let shortest = sliding.compliances(&[PI / dx])?[0];
        let theta = -shortest.arg() / PI;
        let turn = |q_x: &f64| Complex::from_polar(1.0, q_x * theta * dx);
        let mut shift: Vec<_> = along_x.iter().map(turn).collect();
        let mut factors: Vec<_> = at_centre.iter().zip(&shift).map(|(c, s)| c * s).collect();
        let rows = along_x.len();
        if rows.is_multiple_of(2) {
            // The shortest wave stands for both directions, so that its symbols are real.
            let middle = rows / 2;
            factors[middle] = Complex::from(factors[middle].norm());
            for symbols in [&mut at_centre, &mut shift] {
                symbols[middle] = Complex::from(symbols[middle].re);
            }
        }
        Ok(Self {
            at_centre,
            shift,
            factors,
            along_x,
        })
    }

    /// Displacements where the gaps are evaluated.
    pub(super) fn displace(&self, waves: &mut Waves, pressure: &[f64], result: &mut [f64]) {
        waves.apply(pressure, result, |row, q| self.factors[row] / q);
    }

    /// The inverse of [`displace`](Self::displace) on the whole grid.
    pub(super) fn invert(&self, waves: &mut Waves, displacement: &[f64], result: &mut [f64]) {
        waves.apply(displacement, result, |row, q| self.factors[row].inv() * q);
    }

    /// The pressure that displaces the centres of all elements.
    pub(super) fn invert_at_centre(&self, waves: &mut Waves, field: &[f64], result: &mut [f64]) {
        waves.apply(field, result, |row, q| self.at_centre[row].inv() * q);
    }

    /// Heights at the points where the gaps are evaluated, by trigonometric interpolation.
    pub(super) fn shifted(&self, waves: &mut Waves, heights: &[f64], result: &mut [f64]) {
        waves.apply(heights, result, |row, _| self.shift[row]);
    }

    /// Slopes ∂h/∂x at the centres.
    pub(super) fn slopes(&self, waves: &mut Waves, heights: &[f64], result: &mut [f64]) {
        let middle = self.along_x.len();
        waves.apply(heights, result, |row, _| {
            // The slope of the shortest wave vanishes at the centres.
            let q_x = if 2 * row == middle {
                0.0
            } else {
                self.along_x[row]
            };
            Complex::new(0.0, q_x)
        });
    }

    /// The field whose mean product with the pressure is the power dissipated per area and velocity.
    pub(super) fn dissipate(&self, waves: &mut Waves, pressure: &[f64], result: &mut [f64]) {
        waves.apply(pressure, result, |row, q| {
            Complex::from(self.along_x[row] * self.at_centre[row].im / q)
        });
    }
}
