//! The contacts of one instant that are timed.

use std::f64::consts::{PI, TAU};

use bem_halfspace::{
    BemError, Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    solve_contact,
};
use casebook::SquareContact;
use indenters::IndenterError;
use indenters::rough::{PeriodicSurface, Wave};

const MAX_ITERATIONS: usize = 500;

/// A contact at a given force.
#[derive(Debug)]
pub struct ContactScene {
    /// The grid and its influence coefficients.
    pub convolution: Convolution,
    /// Body and force.
    pub contact: SquareContact,
}

impl ContactScene {
    /// Hertz contact with the radius 0.3 on the unit square of `n` × `n` elements, free boundary, with the apex so many
    /// elements from the middle along x and y; there are two mirrors where that is zero, and none elsewhere.
    ///
    /// # Errors
    /// [`BemError`] for a number of elements that no grid has.
    pub fn hertz(n: usize, offset: f64) -> Result<Self, BemError> {
        Ok(Self {
            convolution: Convolution::new(&Grid::new([n; 2], [1.0 / n as f64; 2])?),
            contact: SquareContact::hertz(n, offset),
        })
    }

    /// A periodic surface on the unit square, pressed with the mean pressure 0.05.
    ///
    /// # Errors
    /// [`BemError`] for a number of elements that no grid has.
    pub fn periodic(heights: Vec<f64>) -> Result<Self, BemError> {
        let n = heights.len().isqrt();
        Ok(Self {
            convolution: Convolution::periodic(&Grid::new([n; 2], [1.0 / n as f64; 2])?),
            contact: SquareContact::rough(heights),
        })
    }

    /// Solves the contact from a cold start.
    ///
    /// # Errors
    /// Those of [`solve_contact`].
    pub fn solve(&self, tolerance: f64) -> Result<(Contact, ContactState), BemError> {
        let problem = ContactProblem {
            convolution: &self.convolution,
            separation: &self.contact.heights,
            compliance: SquareContact::COMPLIANCE,
            control: Control::NormalForce(self.contact.force),
        };
        let options = ContactOptions {
            tolerance,
            max_iterations: MAX_ITERATIONS,
        };
        let mut state = ContactState::new(&self.convolution);
        Ok((solve_contact(&problem, &mut state, &options)?, state))
    }
}

/// Directions of the waves of each length.
const DIRECTIONS: usize = 16;

/// Periodic self-affine heights over `n` × `n` elements of the unit square, with the root of the mean square slope 1: a
/// sum of waves like that of Weierstrass and Mandelbrot, of the lengths 1/4, 1/5.6, 1/8 … down to eight elements, 16
/// directions each, with amplitudes `q^(−H)` for the Hurst exponent H = 0.8.
///
/// # Errors
/// [`IndenterError`] for a grid without waves.
pub fn rough_heights(n: usize) -> Result<Vec<f64>, IndenterError> {
    let lengths = (4..).map(|step| 2.0_f64.powf(0.5 * f64::from(step)));
    let lengths = lengths.take_while(|number| *number <= n as f64 / 8.0);
    let waves = lengths.flat_map(|number| (0..DIRECTIONS).map(move |index| (number, index)));
    let wave = |(index, (number, direction)): (usize, (f64, usize))| {
        let angle = PI * (direction as f64 + 0.5) / DIRECTIONS as f64;
        let numbers = [angle.cos(), angle.sin()].map(|part| (number * part).round());
        #[expect(clippy::cast_possible_truncation, reason = "whole and small")]
        let whole = numbers.map(|number| number as i32);
        Wave {
            numbers: whole,
            amplitude: (TAU * numbers[0].hypot(numbers[1])).powf(-0.8),
            // Equally distributed (Weyl).
            phase: TAU * (index as f64 * 0.618_033_988_749_894_9).fract(),
        }
    };
    let surface = PeriodicSurface::new([1.0; 2], waves.enumerate().map(wave).collect())?;
    let scale = surface.rms_slope().recip();
    let heights = surface.heights([n; 2])?.into_iter();
    Ok(heights.map(|height| scale * height).collect())
}
