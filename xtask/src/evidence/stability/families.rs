//! All families, in the order of the table: `families.toml` holds the values of their parameters; the computations are here.

use anyhow::{Result, bail};
use indenters::{Hyperboloid, PowerProfile, RoundTippedCone, Sphere};
use rheology::{KelvinVoigt, Maxwell};
use serde::Deserialize;

use super::case::{Family, Row};
use super::half_space;
use super::line::{self, sixteen_branches};
use crate::scene::solid;

/// Contents of `families.toml`.
#[derive(Deserialize)]
struct Families {
    /// Families of cases, in the order of the table.
    family: Vec<Family>,
}

/// Computes and judges the case with a value of the parameter.
pub(super) type Run = fn(f64) -> Result<Row>;

/// All families with their computations; fails if one has none.
pub(super) fn all() -> Result<Vec<(Family, Run)>> {
    let Families { family } = toml::from_str(include_str!("families.toml"))?;
    let with_run = |family: Family| {
        let run = run(&family.name)?;
        Ok((family, run))
    };
    family.into_iter().map(with_run).collect()
}

/// The computation of the family with this name. Parameters are described by the functions called.
fn run(family: &str) -> Result<Run> {
    Ok(match family {
        "line, cone with round tip" => |tip| line::both(&RoundTippedCone::new(tip, 1.0)?),
        "line, sphere" => |radius| line::both(&Sphere::new(radius)?),
        "line, hyperboloid" => |radius| line::both(&Hyperboloid::new(radius, 1.0)?),
        "line, cone, any slope" => |slope| line::both(&PowerProfile::cone(slope)?),
        "half space, cone, any slope" => half_space::any_slope,
        "half space, cone with flat end" => half_space::flat_end,
        "half space, cone with round tip" => half_space::round_tip,
        "line, dashpot, stationary" => line::power_profile,
        "line, cone on Kelvin–Voigt" => |ratio| line::kelvin_voigt(&line::cone()?, ratio),
        "line, paraboloid on Kelvin–Voigt" => {
            |ratio| line::kelvin_voigt(&line::paraboloid()?, ratio)
        }
        "line, cone on Maxwell" => |ratio| line::maxwell(&line::cone()?, ratio),
        "line, paraboloid on Maxwell" => |ratio| line::maxwell(&line::paraboloid()?, ratio),
        "line, cone on 16 branches over 15 decades" => {
            |speed| line::cone_at_depth(&sixteen_branches(), speed)
        }
        "line, cone on three elements, vτ = x_r" => {
            |gamma| line::cone_at_depth(&solid(gamma)?, 1.0)
        }
        "line, cone on three elements, slow" => {
            |gamma| line::cone_at_depth(&solid(gamma)?, 1e-3 * gamma)
        }
        "line, pressed, Kelvin–Voigt" => {
            |ratio| line::pressed(&KelvinVoigt::new(1.0, 1.0)?, ratio)
        }
        "line, pressed, Maxwell" => |ratio| line::pressed(&Maxwell::new(1.0, 1.0)?, ratio),
        "line, pressed, 16 branches" => |ratio| line::pressed(&sixteen_branches(), ratio),
        "line, march, cone on Maxwell" => line::march,
        "half space, dashpot, stationary" => half_space::power_profile,
        "half space, three elements, slow" => half_space::slow,
        "half space, three elements, fast" => half_space::fast,
        "half space, slender paraboloid" => half_space::slender,
        "half space, pressed, Kelvin–Voigt" => {
            |ratio| half_space::pressed(&KelvinVoigt::new(1.0, 1.0)?, ratio)
        }
        "half space, pressed, Maxwell" => {
            |ratio| half_space::pressed(&Maxwell::new(1.0, 1.0)?, ratio)
        }
        "half space, pressed, 16 branches" => {
            |ratio| half_space::pressed(&sixteen_branches(), ratio)
        }
        "half space, march on Maxwell" => half_space::march_on_maxwell,
        "half space, march on three elements" => half_space::march_on_solid,
        "theorem, ends of numbers" => line::theorem_under,
        "line, ends of numbers" => line::line_under,
        "half space, ends of numbers" => half_space::half_space_under,
        _ => bail!("nothing is computed of {family}"),
    })
}
