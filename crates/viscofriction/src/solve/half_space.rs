//! The material of a scene.

use rheology::{
    Compressible, Elastic, KelvinVoigt, Material, Maxwell, Prony, RelaxationBranch,
    RelaxationSpectrum, RheologyError, StandardSolid, StandardSolidParameters, Viscous,
};

use crate::scene::{Branch, MaterialTable, SceneError, not_negative, positive};

/// The material of a table of the scene file.
///
/// # Errors
/// [`SceneError`] for the first number that is out of range.
pub(crate) fn half_space(table: &MaterialTable) -> Result<Box<dyn Material>, SceneError> {
    check_branches(table)?;
    let material = in_shear(table).map_err(|error| refused(table.key(), error))?;
    let ratio = table.poisson_ratio();
    let material = Compressible::new(&*material, ratio);
    Ok(Box::new(
        material.map_err(|error| refused(table.key(), error))?,
    ))
}

fn in_shear(table: &MaterialTable) -> Result<Box<dyn Material>, RheologyError> {
    Ok(match table {
        MaterialTable::Viscous(table) => Box::new(Viscous::new(table.viscosity)?),
        MaterialTable::Elastic(table) => Box::new(Elastic::new(table.shear_modulus)?),
        MaterialTable::KelvinVoigt(table) => {
            Box::new(KelvinVoigt::new(table.shear_modulus, table.viscosity)?)
        }
        MaterialTable::Maxwell(table) => {
            Box::new(Maxwell::new(table.shear_modulus, table.viscosity)?)
        }
        MaterialTable::StandardSolid(table) => {
            Box::new(StandardSolid::new(StandardSolidParameters {
                equilibrium_modulus: table.equilibrium_modulus,
                maxwell_modulus: table.maxwell_modulus,
                viscosity: table.viscosity,
            })?)
        }
        MaterialTable::Prony(table) => {
            let branch = |branch: &Branch| RelaxationBranch {
                modulus: branch.modulus,
                relaxation_time: branch.relaxation_time,
            };
            let branches = table.branches.iter().map(branch).collect();
            let spectrum =
                RelaxationSpectrum::new(table.equilibrium_modulus, table.viscosity, branches)?;
            Box::new(Prony::new(spectrum)?)
        }
    })
}

/// The library names the list; the key of the element is known here.
fn check_branches(table: &MaterialTable) -> Result<(), SceneError> {
    let MaterialTable::Prony(table) = table else {
        return Ok(());
    };
    for (index, branch) in table.branches.iter().enumerate() {
        let key = |name: &str| format!("material.prony.branches[{index}].{name}");
        not_negative(&key("modulus"), branch.modulus)?;
        positive(&key("relaxation_time"), branch.relaxation_time)?;
    }
    Ok(())
}

/// The number that the library refuses; a derived one belongs to the whole table.
fn refused(table: &str, error: RheologyError) -> SceneError {
    match error {
        RheologyError::InvalidParameter {
            parameter,
            value,
            allowed,
        } if KEYS.contains(&parameter) => SceneError::Value {
            key: format!("{table}.{parameter}"),
            value,
            allowed,
        },
        other => SceneError::together(table, other.to_string()),
    }
}

/// Parameters of the library that are keys too.
const KEYS: [&str; 5] = [
    "viscosity",
    "shear_modulus",
    "equilibrium_modulus",
    "maxwell_modulus",
    "poisson_ratio",
];

/// The four materials that have closed forms, reduced to the incompressible one with the same surface.
///
/// A Poisson ratio makes the surface of a half space 2 (1 − ν) times as compliant, which is a division of all moduli.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Simple {
    Viscous(Viscous),
    Elastic,
    KelvinVoigt(KelvinVoigt),
    Maxwell(Maxwell),
}

/// The material as one of the simple ones, or nothing.
///
/// # Errors
/// [`RheologyError::InvalidParameter`] when a reduced modulus is out of range.
pub(crate) fn simple(material: &dyn Material) -> Result<Option<Simple>, RheologyError> {
    let spectrum = material.relaxation();
    let factor = material.half_space_factor();
    let [modulus, viscosity] =
        [spectrum.equilibrium_modulus(), spectrum.viscosity()].map(|value| value / factor);
    Ok(
        match (modulus > 0.0, viscosity > 0.0, spectrum.branches()) {
            (false, true, []) => Some(Simple::Viscous(Viscous::new(viscosity)?)),
            (true, false, []) => Some(Simple::Elastic),
            (true, true, []) => Some(Simple::KelvinVoigt(KelvinVoigt::new(modulus, viscosity)?)),
            (false, false, [branch]) => Some(Simple::Maxwell(Maxwell::new(
                branch.modulus / factor,
                branch.viscosity() / factor,
            )?)),
            _ => None,
        },
    )
}
