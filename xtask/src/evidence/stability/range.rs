//! Forces, speeds, viscosities and sizes over many decades in SI, up to the ends of floating-point numbers.

use anyhow::Result;
use bem_halfspace::BemError;
use friction_analytic::{FrictionError, power_sliding};
use indenters::{PowerProfile, SlidingLoad};
use mdr_core::MdrError;
use rheology::Viscous;

use super::case::{Family, Row, compare, decades, families, refused};
use super::half_space::{OPTIONS, beside_table};
use super::line::{self, marched, state};
use crate::scene::Scene;

/// A paraboloid on a dashpot; all four numbers are one unless a case changes one of them.
#[derive(Debug, Clone, Copy)]
struct Numbers {
    force: f64,
    velocity: f64,
    viscosity: f64,
    curvature: f64,
}

const UNIT: Numbers = Numbers {
    force: 1.0,
    velocity: 1.0,
    viscosity: 1.0,
    curvature: 1.0,
};

/// The numbers that belong to the value of a parameter.
type Change = fn(f64) -> Numbers;

/// The parameters that are changed one at a time.
const PARAMETERS: [(&str, Change); 4] = [
    ("force / N", |force| Numbers { force, ..UNIT }),
    ("speed / (m/s)", |velocity| Numbers { velocity, ..UNIT }),
    ("viscosity / (Pa s)", |viscosity| Numbers {
        viscosity,
        ..UNIT
    }),
    ("curvature · m", |curvature| Numbers { curvature, ..UNIT }),
];
/// Forces up to the ends of floating-point numbers; the smallest leaves no depth.
const FORCES: [f64; 9] = [
    5e-324, 1e-310, 1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300, 1.7e308,
];

pub(super) fn families() -> Vec<Family> {
    let scale = |step| decades(-12, 12, step);
    let mut families = Vec::new();
    for (parameter, numbers) in PARAMETERS {
        families.extend(families! {
            Cheap "line, stationary, paraboloid", parameter, scale(1) => move |value| line(numbers(value));
            Cheap "line, march, paraboloid", parameter, scale(3) => move |value| march(numbers(value));
            Costly "half space, stationary, paraboloid", parameter, scale(3) => move |value| half_space(numbers(value));
        });
    }
    let (parameter, numbers) = PARAMETERS[0];
    families.extend(families! {
        Cheap "theorem, ends of numbers", parameter, FORCES => move |force| theorem(numbers(force));
        Cheap "line, ends of numbers", parameter, FORCES => move |force| line(numbers(force));
        Cheap "line, march, ends of numbers", parameter, FORCES => move |force| march(numbers(force));
        Cheap "half space, ends of numbers", parameter, FORCES => move |force| half_space(numbers(force));
    });
    families
}

impl Numbers {
    fn scene(self) -> Result<Scene> {
        Ok(Scene {
            body: PowerProfile::paraboloid(self.curvature)?,
            material: Viscous::new(self.viscosity)?,
            load: SlidingLoad::new(self.force, self.velocity)?,
        })
    }

    /// Eqs. (12) and (22) as the paper prints them, in an order that neither overflows nor underflows.
    fn compared(self, depth: f64, friction: f64, tolerance: f64) -> Result<Row> {
        let expected = 0.25 * self.force / self.viscosity / self.velocity;
        // A depth below the normal numbers has fewer digits.
        let tolerance = tolerance + f64::from_bits(1) / expected;
        compare!(within tolerance;
            "depth" => depth, expected;
            "friction coefficient" => friction, 4.0 / 3.0 * (2.0 * self.curvature).sqrt() * expected.sqrt())
    }
}

/// The smallest force leaves no depth.
fn theorem(numbers: Numbers) -> Result<Row> {
    let scene = numbers.scene()?;
    let got = power_sliding(&scene.body, &scene.material, &scene.load);
    if numbers.force < 1e-320 {
        return refused!(got => FrictionError::OutOfRange { .. });
    }
    let got = got?;
    numbers.compared(got.indentation_depth, got.friction_coefficient, 1e-12)
}

/// Small forces leave a depth with fewer digits than others have.
fn line(numbers: Numbers) -> Result<Row> {
    let scene = numbers.scene()?;
    let got = state(&scene.body, &scene.material, &scene.load);
    if numbers.force < 1e-300 {
        return refused!(got => MdrError::InvalidParameter(_) | MdrError::NonFinite { .. });
    }
    let got = got?;
    let [depth, friction] = [got.indentation_depth, got.friction_coefficient];
    numbers.compared(depth.value, friction.value, line::ASKED)
}

const ELEMENTS: usize = 100;

/// At the largest force the march has no room.
fn march(numbers: Numbers) -> Result<Row> {
    let scene = numbers.scene()?;
    let got = marched(&scene.body, &scene.material, &scene.load, ELEMENTS);
    if !(1e-300..1e308).contains(&numbers.force) {
        return refused!(got => MdrError::InvalidParameter(_) | MdrError::NonFinite { .. });
    }
    let got = got?.last;
    // Second order in the spacing: the mean slope over a step beside the slope.
    let tolerance = 1.0 / (ELEMENTS * ELEMENTS) as f64;
    numbers.compared(got.indentation_depth, got.friction_coefficient, tolerance)
}

fn half_space(numbers: Numbers) -> Result<Row> {
    let scene = numbers.scene()?;
    if numbers.force < 1e-320 {
        return refused!(scene.friction(&OPTIONS) => BemError::InvalidParameter(_));
    }
    beside_table(&scene.body, &scene, 0.0)
}
