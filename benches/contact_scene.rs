//! The contacts of one instant that are timed.

use bem_halfspace::{
    BemError, Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    solve_contact,
};
use casebook::{COMPLIANCE, HERTZ_FORCE, hertz_heights};
use indenters::IndenterError;
use indenters::rough::SelfAffine;

/// A contact at a given force.
#[derive(Debug)]
pub struct ContactScene {
    /// The grid and its influence coefficients.
    pub convolution: Convolution,
    heights: Vec<f64>,
    force: f64,
}

impl ContactScene {
    /// Hertz contact with the radius 0.3 on the unit square of `n` × `n` elements, free boundary, with the apex shifted
    /// from the middle by `offset` elements along x and y. Without a shift there are two mirrors, otherwise none.
    ///
    /// # Errors
    /// [`BemError`] for a number of elements that no grid has.
    pub fn hertz(n: usize, offset: f64) -> Result<Self, BemError> {
        Ok(Self {
            convolution: Convolution::new(&Grid::new([n; 2], [1.0 / n as f64; 2])?),
            heights: hertz_heights(n, offset),
            force: HERTZ_FORCE,
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
            heights,
            force: 0.05,
        })
    }

    /// Solves the contact from a cold start.
    ///
    /// # Errors
    /// Those of [`solve_contact`].
    pub fn solve(&self, tolerance: f64) -> Result<(Contact, ContactState), BemError> {
        let problem = ContactProblem {
            convolution: &self.convolution,
            separation: &self.heights,
            compliance: COMPLIANCE,
            largest_pressure: f64::INFINITY,
            control: Control::NormalForce(self.force),
        };
        let options = ContactOptions {
            tolerance,
            ..ContactOptions::default()
        };
        let mut state = ContactState::new(&self.convolution);
        Ok((solve_contact(&problem, &mut state, &options)?, state))
    }
}

/// Heights of a periodic self-affine surface over `n` × `n` elements of the unit square, with waves from a quarter of the
/// side to eight elements, the Hurst exponent 0.8 and the root of the mean square slope 1.
///
/// # Errors
/// [`IndenterError`] for a number of elements that has no such waves.
pub fn rough_heights(n: usize, seed: u64) -> Result<Vec<f64>, IndenterError> {
    let surface = SelfAffine {
        period: [1.0; 2],
        hurst_exponent: 0.8,
        rms_slope: 1.0,
        longest_wavelength: 0.25,
        shortest_wavelength: 8.0 / n as f64,
        roll_off_wavelength: 0.25,
        seed,
    };
    Ok(surface.surface()?.heights([n; 2])?)
}
