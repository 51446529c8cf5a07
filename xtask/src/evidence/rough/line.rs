//! The one-dimensional model of a rough surface that slides: a line over viscoelastic elements that do not know of each other.
//!
//! Every wave of the surface is turned into the direction of motion. Its spectrum C becomes the spectrum π q C of the line
//! (Geike & Popov 2007), and heights and slopes stay as they are. A length of the line as long as the longest wave carries
//! the force on the square of that wave.
//!
//! Elements of stiffness 4 G under a length are the limit of a thin layer whose Poisson ratio is 0, so that the half-space
//! solver for periodic surfaces answers, bars included.

use anyhow::{Context, Result};
use bem_halfspace::{BemError, Layer, PeriodicLoad, periodic};
use indenters::rough::{PeriodicSurface, Wave};
use numerics::{AtMost, Request};
use rheology::Compressible;
use viscofriction::solve::{Body, Motion, Problem};

/// How many periods of the surface the line is long, so that its waves are rounded to whole numbers by a thirtieth at most.
const PERIODS: f64 = 16.0;
/// Thickness of the layer, as a part of the shortest wave; its square is the error that it makes.
const THIN: f64 = 1e-5;
/// Of the friction.
const RELATIVE_ERROR: f64 = 0.05;
/// Along the line.
const MOST_ELEMENTS: AtMost = AtMost(1 << 17);

/// The friction coefficient, to 5 %; none where it is not known as well.
pub(super) fn friction(problem: &Problem) -> Result<Option<f64>> {
    let (Body::Periodic(surface), Motion::Sliding(load)) = (problem.body(), problem.motion())
    else {
        anyhow::bail!("a periodic surface that slides");
    };
    let period = surface.period();
    let length = PERIODS * period[0];
    let mut waves: Vec<Wave> = surface.waves().to_vec();
    for wave in &mut waves {
        let [q_x, q_y] = surface.wave_vector(wave);
        let number = q_x.hypot(q_y) * length / std::f64::consts::TAU;
        #[expect(clippy::cast_possible_truncation, reason = "less than 1e5")]
        let whole = number.round() as i32;
        // The slope stays.
        wave.amplitude *= number / f64::from(whole);
        wave.numbers = [whole, 0];
    }
    let ends = waves.iter().map(|wave| wave.numbers[0]);
    let [fewest, most] = [ends.clone().min(), ends.max()].map(Option::unwrap_or_default);
    let [longest, shortest] = [fewest, most].map(|number| length / f64::from(number));
    let line = PeriodicSurface::new([length, shortest], waves)?;
    let material = Compressible::new(problem.material(), 0.0)?;
    let thickness = THIN * shortest;
    let layer = Layer::new(&material, thickness)?;
    let force = load.normal_force().context("a line under a force")?;
    // The layer has the stiffness 2 G/t.
    let pressure = force / (period[0] * period[1]) * longest / (2.0 * thickness);
    let load = PeriodicLoad::new(pressure, load.velocity())?;
    let request = Request {
        accuracy: RELATIVE_ERROR.into(),
        watch: &MOST_ELEMENTS,
    };
    match periodic::steady(&line, &layer, &load, request) {
        Ok(estimate) => Ok(Some(estimate.friction_coefficient.value)),
        Err(BemError::NotReached { .. } | BemError::ContactNotConverged { .. }) => Ok(None),
        Err(error) => Err(error.into()),
    }
}
