//! Forces, speeds, viscosities and sizes over many decades in SI, up to the ends of floating-point numbers.

use anyhow::Result;
use bem_halfspace::BemError;
use friction_analytic::{FrictionError, power_sliding};
use indenters::{PowerProfile, SlidingLoad};
use mdr_core::MdrError;
use rheology::Viscous;

use super::case::{Case, Cost, Family, Finding, compare, decades, refused};
use super::half_space::{beside_table, refined};
use super::line::{self, Dashpot, marched, state};

/// A paraboloid on a dashpot; all four numbers are one unless a case changes one of them.
#[derive(Debug, Clone, Copy)]
struct Scene {
    force: f64,
    velocity: f64,
    viscosity: f64,
    curvature: f64,
}

const UNIT: Scene = Scene {
    force: 1.0,
    velocity: 1.0,
    viscosity: 1.0,
    curvature: 1.0,
};

/// Solves a scene and compares with the closed form; a scene without a solution must end in the right error.
type Method = fn(Scene, Expected) -> Result<Finding>;

/// The scene that belongs to the value of a parameter.
type Change = fn(f64) -> Scene;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Expected {
    Solution,
    Refusal,
}

/// The parameters that are changed one at a time.
const PARAMETERS: [(&str, Change); 4] = [
    ("force / N", |force| Scene { force, ..UNIT }),
    ("speed / (m/s)", |velocity| Scene { velocity, ..UNIT }),
    ("viscosity / (Pa s)", |viscosity| Scene {
        viscosity,
        ..UNIT
    }),
    ("curvature · m", |curvature| Scene { curvature, ..UNIT }),
];
/// A force that leaves a depth with fewer digits than others have, which the solvers on the line refuse, and one at
/// which the march has no room.
const ENDS: [f64; 2] = [1e-310, 1.7e308];

pub(super) fn families() -> Vec<Family> {
    let mut families = Vec::new();
    let methods: [(_, Method, _, _); 3] = [
        ("line, stationary, paraboloid", line, 1, Cost::Cheap),
        ("line, march, paraboloid", march, 3, Cost::Cheap),
        (
            "half space, stationary, paraboloid",
            half_space,
            3,
            Cost::Costly,
        ),
    ];
    for (name, method, step, cost) in methods {
        families.extend(PARAMETERS.map(|(parameter, scene)| {
            let run = move |value| method(scene(value), Expected::Solution);
            Family::over(cost, name, parameter, decades(-12, 12, step), run)
        }));
    }
    families.extend([
        ends_of_numbers("theorem, ends of numbers", theorem, &[]),
        ends_of_numbers("line, ends of numbers", line, &ENDS[..1]),
        ends_of_numbers("line, march, ends of numbers", march, &ENDS),
        ends_of_numbers("half space, ends of numbers", half_space, &[]),
    ]);
    families
}

/// Forces that a depth can be computed from, the smallest one, which leaves no depth, and those that a method refuses.
fn ends_of_numbers(name: &'static str, method: Method, refused: &[f64]) -> Family {
    let smallest = f64::from_bits(1);
    let forces = [
        smallest, 1e-310, 1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300, 1.7e308,
    ];
    let cases = forces.map(|force: f64| {
        let is = |other: &f64| other.total_cmp(&force).is_eq();
        let expected = if is(&smallest) || refused.iter().any(is) {
            Expected::Refusal
        } else {
            Expected::Solution
        };
        let scene = Scene { force, ..UNIT };
        Case::new(format!("{force:e}"), move || method(scene, expected))
    });
    Family::of(name, "force / N", cases.into())
}

impl Scene {
    fn profile(self) -> Result<PowerProfile> {
        Ok(PowerProfile::paraboloid(self.curvature)?)
    }

    fn dashpot(self) -> Result<Dashpot> {
        Ok(Dashpot {
            material: Viscous::new(self.viscosity)?,
            load: SlidingLoad::new(self.force, self.velocity)?,
        })
    }

    /// Eqs. (12) and (22) as the paper prints them, in an order that neither overflows nor underflows.
    fn compared(self, depth: f64, friction: f64, tolerance: f64) -> Result<Finding> {
        let expected = 0.25 * self.force / self.viscosity / self.velocity;
        // A depth below the normal numbers has fewer digits.
        let tolerance = tolerance + f64::from_bits(1) / expected;
        compare!(within tolerance;
            "depth" => depth, expected;
            "friction coefficient" => friction, 4.0 / 3.0 * (2.0 * self.curvature).sqrt() * expected.sqrt())
    }
}

fn theorem(scene: Scene, expected: Expected) -> Result<Finding> {
    let Dashpot { material, load } = scene.dashpot()?;
    let got = power_sliding(&scene.profile()?, &material, &load);
    if expected == Expected::Refusal {
        return refused!(got => FrictionError::OutOfRange { .. });
    }
    let got = got?;
    scene.compared(got.indentation_depth, got.friction_coefficient, 1e-12)
}

fn line(scene: Scene, expected: Expected) -> Result<Finding> {
    let Dashpot { material, load } = scene.dashpot()?;
    let got = state(&scene.profile()?, &material, &load);
    if expected == Expected::Refusal {
        return refused!(got => MdrError::InvalidParameter(_) | MdrError::NonFinite { .. });
    }
    let got = got?;
    let [depth, friction] = [got.indentation_depth, got.friction_coefficient];
    scene.compared(depth.value, friction.value, line::ASKED)
}

const ELEMENTS: usize = 100;

fn march(scene: Scene, expected: Expected) -> Result<Finding> {
    let Dashpot { material, load } = scene.dashpot()?;
    let got = marched(&scene.profile()?, &material, &load, ELEMENTS);
    if expected == Expected::Refusal {
        return refused!(got => MdrError::InvalidParameter(_) | MdrError::NonFinite { .. });
    }
    let got = got?.last;
    // Second order in the spacing: the mean slope over a step beside the slope.
    let tolerance = 1.0 / (ELEMENTS * ELEMENTS) as f64;
    scene.compared(got.indentation_depth, got.friction_coefficient, tolerance)
}

fn half_space(scene: Scene, expected: Expected) -> Result<Finding> {
    let (profile, dashpot) = (scene.profile()?, scene.dashpot()?);
    if expected == Expected::Refusal {
        let got = refined(&profile, &dashpot);
        return refused!(got => BemError::InvalidParameter(_));
    }
    beside_table(&profile, &profile, &dashpot, 0.0)
}
