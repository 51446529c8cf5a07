//! Theories that the program `viscofriction` does not print, evaluated for a scene.

use anyhow::{Context, Result};
use friction_analytic::EnergyFactor;
use viscofriction::solve::{Body, Motion, Problem, persson};

use super::line::{Carrying, friction};

/// Names of the columns of [`solve`], in its order.
pub(super) const COLUMNS: [&str; 4] = [
    "wang_muser_friction_coefficient",
    "line_friction_coefficient",
    "line_friction_coefficient_by_period",
    "xu_area_fraction",
];
/// Parameter γ of the theory of Xu, who finds 0.42 to 0.45. Chosen; with 0.42 the area is at most 4 % larger.
const XU_GAMMA: f64 = 0.45;

/// The numbers of [`COLUMNS`]; `None` where the friction of a line does not reach its error. Fails unless the body is a
/// periodic surface that slides under a force on a half space.
pub(super) fn solve(problem: &Problem) -> Result<[Option<f64>; COLUMNS.len()]> {
    let (Body::Periodic(surface), Motion::Sliding(load)) = (problem.body(), problem.motion())
    else {
        anyhow::bail!("a periodic surface that slides");
    };
    let force = load.normal_force().context("a surface under a force")?;
    let mean_pressure = force / surface.period().iter().product::<f64>();
    let theory = persson(problem)?.context("a surface on a half space")?;
    let (material, velocity) = (problem.material(), load.velocity());
    let line = |carrying| friction(surface, material, mean_pressure, velocity, carrying);
    Ok([
        Some(
            theory
                .friction_coefficient(EnergyFactor::WANG_MUSER_2017)
                .value,
        ),
        line(Carrying::LongestWave)?,
        line(Carrying::Period)?,
        Some(theory.area_fraction_of_xu(XU_GAMMA)?.value),
    ])
}
