//! Forces, speeds, viscosities and sizes over many decades in SI, up to the ends of floating-point numbers.

use anyhow::Result;
use bem_halfspace::BemError;
use bem_halfspace::steady::{RefinementOptions, steady_refined};
use friction_analytic::{FrictionError, half_space_power_friction, power_sliding};
use indenters::{EquivalentLine, PowerProfile, SlidingLoad};
use mdr_core::{MdrError, SlideOptions, slide_on_grid, steady};
use rheology::Viscous;

use super::case::{Case, Family, Finding, compare, decades, refused};

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

pub(super) fn families() -> Vec<Family> {
    // The parameters that are changed one at a time.
    let parameters: [(&'static str, Change); 4] = [
        ("force / N", |force| Scene { force, ..UNIT }),
        ("speed / (m/s)", |velocity| Scene { velocity, ..UNIT }),
        ("viscosity / (Pa s)", |viscosity| Scene {
            viscosity,
            ..UNIT
        }),
        ("curvature · m", |curvature| Scene { curvature, ..UNIT }),
    ];
    let mut families = Vec::new();
    for (name, method, step) in [
        ("line, stationary, paraboloid", line as Method, 1),
        ("line, march, paraboloid", march, 3),
        ("half space, stationary, paraboloid", half_space, 3),
    ] {
        for (parameter, scene) in parameters {
            let run = move |value| method(scene(value), Expected::Solution);
            let family = Family::over(name, parameter, decades(-12, 12, step), run);
            let slow = name.starts_with("half space");
            families.push(Family { slow, ..family });
        }
    }
    // 1e-310 N leaves a depth with fewer digits than others have, which the solvers on the line refuse; the march also
    // has no room at 1.7e308 N.
    let (denormal, largest) = (1e-310, 1.7e308);
    families.extend([
        ends_of_numbers("theorem, ends of numbers", theorem, &[]),
        ends_of_numbers("line, ends of numbers", line, &[denormal]),
        ends_of_numbers("line, march, ends of numbers", march, &[denormal, largest]),
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
    fn problem(self) -> Result<(PowerProfile, Viscous, SlidingLoad)> {
        Ok((
            PowerProfile::paraboloid(self.curvature)?,
            Viscous::new(self.viscosity)?,
            SlidingLoad::new(self.force, self.velocity)?,
        ))
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
    let (profile, material, load) = scene.problem()?;
    let got = power_sliding(&profile, &material, &load);
    if expected == Expected::Refusal {
        return refused!(got => FrictionError::OutOfRange { .. });
    }
    let got = got?;
    scene.compared(got.indentation_depth, got.friction_coefficient, 1e-12)
}

fn line(scene: Scene, expected: Expected) -> Result<Finding> {
    let (profile, material, load) = scene.problem()?;
    let got = steady(&EquivalentLine(&profile), &material, &load, ASKED_OF_LINE);
    if expected == Expected::Refusal {
        return refused!(got => MdrError::InvalidParameter { .. } | MdrError::NonFinite { .. });
    }
    let got = got?;
    scene.compared(
        got.indentation_depth.value,
        got.friction_coefficient.value,
        ASKED_OF_LINE,
    )
}

const ELEMENTS: usize = 100;
/// Relative error asked of the stationary state of the line.
const ASKED_OF_LINE: f64 = 1e-8;

fn march(scene: Scene, expected: Expected) -> Result<Finding> {
    let (profile, material, load) = scene.problem()?;
    let line = EquivalentLine(&profile);
    let got = SlideOptions::with_elements(ELEMENTS, &line, &material, &load)
        .and_then(|options| slide_on_grid(&line, &material, &load, &options));
    if expected == Expected::Refusal {
        return refused!(got => MdrError::InvalidParameter { .. } | MdrError::NonFinite { .. });
    }
    let got = got?.last;
    // Second order in the spacing: the mean slope over a step beside the slope.
    let tolerance = 1.0 / (ELEMENTS * ELEMENTS) as f64;
    scene.compared(got.indentation_depth, got.friction_coefficient, tolerance)
}

const ASKED: RefinementOptions = RefinementOptions {
    relative_error: 1e-2,
    aspect: 0.5,
    max_unknowns: 40_000,
};

fn half_space(scene: Scene, expected: Expected) -> Result<Finding> {
    let (profile, material, load) = scene.problem()?;
    let got = steady_refined(&profile, &material, &load, &ASKED);
    if expected == Expected::Refusal {
        return refused!(got => BemError::InvalidParameter { .. });
    }
    let tabulated = half_space_power_friction(&profile, &material, &load)?;
    let tolerance = ASKED.relative_error + tabulated.error / tabulated.value;
    compare!(within tolerance; "friction coefficient" => got?.friction_coefficient.value, tabulated.value)
}
