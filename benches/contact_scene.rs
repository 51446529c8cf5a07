//! The contacts of one instant that are timed.

use std::f64::consts::{PI, TAU};

use bem_halfspace::{
    BemError, Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    solve_contact,
};
use casebook::SquareContact;

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
            ..ContactOptions::default()
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
pub fn rough_heights(n: usize) -> Vec<f64> {
    let mut heights = vec![0.0; n * n];
    let mut square_slope = 0.0;
    let numbers = (4..).map(|step| 2.0_f64.powf(0.5 * f64::from(step)));
    let numbers = numbers.take_while(|number| *number <= n as f64 / 8.0);
    let waves = numbers.flat_map(|number| (0..DIRECTIONS).map(move |index| (number, index)));
    for (index, (number, direction)) in waves.enumerate() {
        let angle = PI * (direction as f64 + 0.5) / DIRECTIONS as f64;
        let wave = [angle.cos(), angle.sin()].map(|part| (number * part).round());
        let q = TAU * wave[0].hypot(wave[1]);
        let amplitude = q.powf(-0.8);
        square_slope += 0.5 * (q * amplitude).powi(2);
        // Equally distributed (Weyl).
        let phase = TAU * (index as f64 * 0.618_033_988_749_894_9).fract();
        add_wave(&mut heights, wave, (amplitude, phase));
    }
    let scale = 1.0 / square_slope.sqrt();
    heights.iter_mut().for_each(|height| *height *= scale);
    heights
}

/// Adds a wave with so many periods along x and y.
fn add_wave(heights: &mut [f64], wave: [f64; 2], (amplitude, phase): (f64, f64)) {
    let n = heights.len().isqrt();
    let angle = |periods: f64, index: usize| TAU * periods * index as f64 / n as f64;
    let along_y: Vec<[f64; 2]> = (0..n)
        .map(|column| angle(wave[1], column).sin_cos().into())
        .collect();
    for (row, heights) in heights.chunks_exact_mut(n).enumerate() {
        let (sine, cosine) = (angle(wave[0], row) + phase).sin_cos();
        for (height, [sine_y, cosine_y]) in heights.iter_mut().zip(&along_y) {
            *height += amplitude * (cosine * cosine_y - sine * sine_y);
        }
    }
}
