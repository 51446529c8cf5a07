//! Forces up to the ends of floating-point numbers.

use anyhow::Result;
use bem_halfspace::BemError;
use friction_analytic::{FrictionError, power_sliding};
use indenters::{PowerProfile, SlidingLoad};
use mdr_core::MdrError;
use rheology::Viscous;

use super::case::{Family, Row, compare, families, refused};
use super::half_space::{OPTIONS, beside_table};
use super::line::{self, state};
use crate::scene::Scene;

/// The smallest leaves no depth.
const FORCES: [f64; 9] = [
    5e-324, 1e-310, 1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300, 1.7e308,
];

pub(super) fn families() -> Vec<Family> {
    let parameter = "force / N";
    families! {
        Cheap "theorem, ends of numbers", parameter, FORCES => theorem;
        Cheap "line, ends of numbers", parameter, FORCES => line;
        Cheap "half space, ends of numbers", parameter, FORCES => half_space;
    }
}

/// A paraboloid on a dashpot; all numbers but the force are one.
fn under(force: f64) -> Result<Scene> {
    Ok(Scene {
        body: PowerProfile::paraboloid(1.0)?,
        material: Viscous::new(1.0)?,
        load: SlidingLoad::new(force, 1.0)?,
    })
}

/// Eqs. (12) and (22) as the paper prints them, in an order that neither overflows nor underflows.
fn compared(force: f64, depth: f64, friction: f64, tolerance: f64) -> Result<Row> {
    let expected = 0.25 * force;
    // A depth below the normal numbers has fewer digits.
    let tolerance = tolerance + f64::from_bits(1) / expected;
    compare!(within tolerance;
        "depth" => depth, expected;
        "friction coefficient" => friction, 4.0 / 3.0 * 2.0_f64.sqrt() * expected.sqrt())
}

/// The smallest force leaves no depth.
fn theorem(force: f64) -> Result<Row> {
    let scene = under(force)?;
    let got = power_sliding(&scene.body, &scene.material, &scene.load);
    if force < 1e-320 {
        return refused!(got => FrictionError::OutOfRange { .. });
    }
    let got = got?;
    compared(
        force,
        got.indentation_depth,
        got.friction_coefficient,
        1e-12,
    )
}

/// Small forces leave a depth with fewer digits than others have.
fn line(force: f64) -> Result<Row> {
    let scene = under(force)?;
    let got = state(&scene.body, &scene.material, &scene.load);
    if force < 1e-300 {
        return refused!(got => MdrError::InvalidParameter(_) | MdrError::NonFinite { .. });
    }
    let got = got?;
    let [depth, friction] = [got.indentation_depth, got.friction_coefficient];
    compared(force, depth.value, friction.value, line::ASKED)
}

fn half_space(force: f64) -> Result<Row> {
    let scene = under(force)?;
    if force < 1e-320 {
        return refused!(scene.friction(&OPTIONS) => BemError::InvalidParameter(_));
    }
    beside_table(&scene.body, &scene, 0.0)
}
