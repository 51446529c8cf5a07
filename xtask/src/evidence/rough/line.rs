//! The one-dimensional model of a rough surface that slides: a line over viscoelastic elements that do not know of each other.
//!
//! Every wave of the surface is turned into the direction of motion. Its spectrum C becomes the spectrum π q C of the line
//! (Geike & Popov 2007), and heights and slopes stay as they are. A length of the line carries the force on the square of that
//! length.
//!
//! Elements of stiffness 4 G under a length are the limit of a thin layer whose Poisson ratio is 0, so that the half-space
//! solver for periodic surfaces answers, bars included.

use anyhow::Result;
use bem_halfspace::{BemError, Layer, PeriodicLoad, periodic};
use indenters::rough::{PeriodicSurface, Wave};
use numerics::{MaxElements, Request};
use rheology::{Compressible, Material};

/// Ratio of the length of the line to the period of the surface. Chosen: each wave must fit a whole number of times, at least 16
/// here, so that rounding changes its length by a thirtieth at most.
const LINE_PERIODS: f64 = 16.0;
/// Ratio of the thickness of the layer to the shortest wavelength. Chosen; the relative error of the limit of a thin layer is its
/// square.
const THICKNESS_OVER_WAVE: f64 = 1e-5;
/// Relative error requested of the friction. Chosen: half of what still counts as a right theory.
const RELATIVE_ERROR: f64 = 0.05;
/// Largest number of elements along the line. Chosen: a power of two, affordable for thousands of lines.
const MAX_LINE_ELEMENTS: MaxElements = MaxElements(1 << 17);

/// The length L of line that carries the force on an area L²: the theory does not say which.
#[derive(Clone, Copy)]
pub(super) enum Carrying {
    /// Longest wavelength of the surface.
    LongestWave,
    /// Period of the surface.
    Period,
}

/// The friction coefficient of the line under a mean pressure \[Pa] at a velocity \[m/s], to [`RELATIVE_ERROR`]; `None` where
/// that is not reached.
pub(super) fn friction(
    surface: &PeriodicSurface,
    material: &dyn Material,
    mean_pressure: f64,
    velocity: f64,
    carrying: Carrying,
) -> Result<Option<f64>> {
    let period = surface.period();
    let length = LINE_PERIODS * period[0];
    let mut waves: Vec<Wave> = surface.waves().to_vec();
    for wave in &mut waves {
        let [q_x, q_y] = surface.wave_vector(wave);
        let number = q_x.hypot(q_y) * length / std::f64::consts::TAU;
        #[expect(clippy::cast_possible_truncation, reason = "less than 1e5")]
        let whole = number.round() as i32;
        // Scale the amplitude with the wavelength, so that the slope of the wave is unchanged.
        wave.amplitude *= number / f64::from(whole);
        wave.numbers = [whole, 0];
    }
    let ends = waves.iter().map(|wave| wave.numbers[0]);
    let [fewest, most] = [ends.clone().min(), ends.max()].map(Option::unwrap_or_default);
    let [longest, shortest] = [fewest, most].map(|number| length / f64::from(number));
    let line = PeriodicSurface::new([length, shortest], waves)?;
    let material = Compressible::new(material, 0.0)?;
    let thickness = THICKNESS_OVER_WAVE * shortest;
    let layer = Layer::new(&material, thickness)?;
    let carrying = match carrying {
        Carrying::LongestWave => longest,
        Carrying::Period => period[0],
    };
    // Choose the mean pressure for the stiffness 2 G/t of the layer, with its shear modulus G and thickness t.
    let load = PeriodicLoad::new(mean_pressure * carrying / (2.0 * thickness), velocity)?;
    let request = Request {
        accuracy: RELATIVE_ERROR.into(),
        watch: &MAX_LINE_ELEMENTS,
    };
    match periodic::steady(&line, &layer, &load, request) {
        Ok(estimate) => Ok(Some(estimate.friction_coefficient.value)),
        Err(BemError::NotReached { .. } | BemError::ContactNotConverged { .. }) => Ok(None),
        Err(error) => Err(error.into()),
    }
}
