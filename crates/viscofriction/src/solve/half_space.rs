//! The material of a scene.

use rheology::{
    Compressible, Elastic, KelvinVoigt, Material, Maxwell, Prony, RelaxationBranch,
    RelaxationSpectrum, RheologyError, StandardSolid, StandardSolidParameters, Viscous,
};

use crate::scene::{Branch, MaterialTable, SceneError};

/// The material of a table of the scene file.
///
/// # Errors
/// [`SceneError`] for the first number that is out of range.
pub(crate) fn half_space(table: &MaterialTable) -> Result<Box<dyn Material>, SceneError> {
    in_shear(table)
        .and_then(|material| Compressible::new(&*material, table.poisson_ratio()))
        .map(|material| Box::new(material) as Box<dyn Material>)
        .map_err(|error| refused(&table.key(), error))
}

fn in_shear(table: &MaterialTable) -> Result<Box<dyn Material>, RheologyError> {
    Ok(match table {
        MaterialTable::Viscous { viscosity, .. } => Box::new(Viscous::new(*viscosity)?),
        MaterialTable::Elastic { shear_modulus, .. } => Box::new(Elastic::new(*shear_modulus)?),
        MaterialTable::KelvinVoigt {
            shear_modulus,
            viscosity,
            ..
        } => Box::new(KelvinVoigt::new(*shear_modulus, *viscosity)?),
        MaterialTable::Maxwell {
            shear_modulus,
            viscosity,
            ..
        } => Box::new(Maxwell::new(*shear_modulus, *viscosity)?),
        MaterialTable::StandardSolid {
            equilibrium_modulus,
            maxwell_modulus,
            viscosity,
            ..
        } => Box::new(StandardSolid::new(StandardSolidParameters {
            equilibrium_modulus: *equilibrium_modulus,
            maxwell_modulus: *maxwell_modulus,
            viscosity: *viscosity,
        })?),
        MaterialTable::Prony {
            equilibrium_modulus,
            viscosity,
            branches,
            ..
        } => {
            let branch = |branch: &Branch| RelaxationBranch {
                modulus: branch.modulus,
                relaxation_time: branch.relaxation_time,
            };
            let branches = branches.iter().map(branch).collect();
            let spectrum = RelaxationSpectrum::new(*equilibrium_modulus, *viscosity, branches)?;
            Box::new(Prony::new(spectrum)?)
        }
    })
}

/// The number that the library refuses; a derived one belongs to the whole table.
fn refused(table: &str, error: RheologyError) -> SceneError {
    match error {
        RheologyError::InvalidParameter(refused) if KEYS.contains(&refused.parameter) => {
            SceneError::within(table, refused)
        }
        RheologyError::InvalidElement {
            list,
            index,
            refused,
        } if KEYS.contains(&refused.parameter) => SceneError::Value {
            key: format!("{table}.{list}[{index}].{}", refused.parameter),
            value: refused.value,
            allowed: refused.allowed,
        },
        other => SceneError::at(table, other.to_string()),
    }
}

/// Parameters of the library that are keys too.
const KEYS: [&str; 7] = [
    "viscosity",
    "shear_modulus",
    "equilibrium_modulus",
    "maxwell_modulus",
    "modulus",
    "relaxation_time",
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
