//! Construction of the viscoelastic material of a scene.

use std::path::Path;

use numerics::in_range;
use rheology::{
    Compressible, Elastic, FractionalMaxwell, FractionalMaxwellParameters, KelvinVoigt, Material,
    Maxwell, Prony, RelaxationBranch, RelaxationSpectrum, RheologyError, Springpot, StandardSolid,
    StandardSolidParameters, Viscous,
};

use super::expansion::{Expansion, expanded};
use crate::files::Files;
use crate::scene::{Approximation, Branch, MaterialTable, SceneError, Shift, Source};
use crate::text::WrongInput;

/// The material of a scene, with the accuracy and range of its data.
#[derive(Debug)]
pub struct HalfSpace {
    /// The material, or the Prony series that approximates it.
    pub material: Box<dyn Material>,
    /// Accuracy of the series; `None` if the material is exact.
    pub expansion: Option<Expansion>,
    /// Range of angular frequencies covered by measurements, \[rad/s]; `None` if the scene states none.
    pub window: Option<[f64; 2]>,
    /// Table of a material whose shift law gives it at other temperatures; `None` without a shift law.
    pub(crate) shifting: Option<MaterialTable>,
}

impl HalfSpace {
    /// Temperature of the material, \[°C]; `None` unless it has a shift law.
    pub fn temperature(&self) -> Option<f64> {
        self.shift().map(|shift| shift.temperature)
    }

    /// Temperature dependence of the material; `None` if it is not known.
    pub(crate) fn shift(&self) -> Option<&Shift> {
        self.shifting.as_ref().and_then(MaterialTable::shift)
    }

    /// The material at another temperature \[°C]; `None` without a shift law.
    ///
    /// # Errors
    /// [`SceneError`] for a temperature outside the range of the law.
    pub(crate) fn at(&self, celsius: f64) -> Option<Result<Self, SceneError>> {
        let table = self.shifting.clone()?;
        let shifted = table.at(celsius);
        Some(shifted.and_then(|table| half_space(&table, &no_files())))
    }
}

/// The files of a material that names none.
fn no_files() -> Files<'static> {
    Files {
        folder: Path::new(""),
        read: no_file,
        memory: None,
    }
}

/// Builds the material of a `material` table of the scene file.
///
/// # Errors
/// [`SceneError`] for the first number that is out of range.
pub fn half_space(table: &MaterialTable, files: &Files<'_>) -> Result<HalfSpace, SceneError> {
    table.check()?;
    if let MaterialTable::Prony {
        branches,
        covariance: Some(covariance),
        ..
    } = table
    {
        covariance.check(&table.key(), branches.len())?;
    }
    let mut found = shear_material(table, files)?;
    let ratio = table
        .poisson_ratio()
        .unwrap_or_else(|| found.material.poisson_ratio());
    let material = Compressible::new(&*found.material, ratio);
    found.material = Box::new(material.map_err(|error| refused(&table.key(), error))?);
    if let Some([lowest, highest]) = table.valid_frequencies() {
        let key = format!("{}.valid_frequencies[1]", table.key());
        let allowed = "finite and greater than valid_frequencies[0]";
        in_range("", highest, highest > lowest, allowed)
            .map_err(|refused| SceneError::value(key, refused))?;
        found.window = Some([lowest, highest]);
    }
    // The scene may replace numbers of a material file, at other temperatures too.
    if let (MaterialTable::File { .. }, Some(shifting)) = (table, &found.shifting) {
        let shifting = shifting.clone();
        let given = shifting.with_given(table.poisson_ratio(), table.valid_frequencies());
        found.shifting = Some(given?);
    }
    Ok(found)
}

/// The table of a material file, checked and shifted to a temperature \[°C] if one is given. An error if it names another file
/// itself.
pub(super) fn material_of_file(
    file: &Path,
    temperature: Option<f64>,
    files: &Files<'_>,
) -> Result<MaterialTable, SceneError> {
    let none = Files {
        read: no_file,
        ..*files
    };
    let read = |table: MaterialTable| half_space(&table, &none).map(|_| table);
    let table = read_material_file(file, files, read)?;
    match temperature {
        Some(temperature) => table.at(temperature),
        None => Ok(table),
    }
}

/// Parses the table of a material file and applies `read` to it; errors name file and line.
pub(crate) fn read_material_file<T>(
    file: &Path,
    files: &Files<'_>,
    read: impl FnOnce(MaterialTable) -> Result<T, SceneError>,
) -> Result<T, SceneError> {
    let of_table = || {
        let (file, contents) = files.material(file)?;
        let source = Source::new(&file, contents)?;
        let table = MaterialTable::try_from(source.table()?);
        table.and_then(read).map_err(|error| source.locate(&error))
    };
    let wrong = |WrongInput(problem)| SceneError::at("material.file.path", problem);
    of_table().map_err(wrong)
}

/// Rejects a file reference inside the file of a material.
fn no_file(file: &Path, _: u64) -> Result<Vec<u8>, WrongInput> {
    let problem = "the file of a material names no other";
    Err(WrongInput(format!("{}: {problem}", file.display())))
}

/// The material of a table as an incompressible one with its moduli in shear; the Poisson ratio of the scene is not applied
/// yet, only that of a material file.
fn shear_material(table: &MaterialTable, files: &Files<'_>) -> Result<HalfSpace, SceneError> {
    let found = match table {
        &MaterialTable::Viscous { viscosity, .. } => Viscous::new(viscosity).map(exact),
        &MaterialTable::Elastic { shear_modulus, .. } => Elastic::new(shear_modulus).map(exact),
        &MaterialTable::KelvinVoigt {
            shear_modulus,
            viscosity,
            ..
        } => KelvinVoigt::new(shear_modulus, viscosity).map(exact),
        &MaterialTable::Maxwell {
            shear_modulus,
            viscosity,
            ..
        } => Maxwell::new(shear_modulus, viscosity).map(exact),
        &MaterialTable::StandardSolid {
            equilibrium_modulus,
            maxwell_modulus,
            viscosity,
            ..
        } => StandardSolid::new(StandardSolidParameters {
            equilibrium_modulus,
            maxwell_modulus,
            viscosity,
        })
        .map(exact),
        MaterialTable::Prony {
            equilibrium_modulus,
            viscosity,
            branches,
            approximation,
            shift,
            ..
        } => {
            let branch = |one: &Branch| RelaxationBranch::new(one.modulus, one.relaxation_time);
            let spectrum = RelaxationSpectrum::new(
                *equilibrium_modulus,
                *viscosity,
                branches.iter().map(branch).collect(),
            );
            let found = series(&table.key(), spectrum, *approximation)?;
            return Ok(HalfSpace {
                shifting: shift.is_some().then(|| table.clone()),
                ..found
            });
        }
        &MaterialTable::Springpot {
            coefficient,
            exponent,
            equilibrium_modulus,
            time_range,
            ..
        } => Springpot::new(coefficient, exponent).and_then(|element| {
            let expand = |band, error| element.expand(band, error);
            expanded(expand, exponent, equilibrium_modulus, time_range).map(approximate)
        }),
        &MaterialTable::FractionalMaxwell {
            shear_modulus,
            relaxation_time,
            exponent,
            equilibrium_modulus,
            time_range,
            ..
        } => FractionalMaxwell::new(FractionalMaxwellParameters {
            shear_modulus,
            relaxation_time,
            exponent,
        })
        .and_then(|element| {
            let expand = |band, error| element.expand(band, error);
            expanded(expand, exponent, equilibrium_modulus, time_range).map(approximate)
        }),
        MaterialTable::File {
            path, temperature, ..
        } => return half_space(&material_of_file(path, *temperature, files)?, files),
    };
    found.map_err(|error| refused(&table.key(), error))
}

/// Half space of a material that needs no approximating series and has no range of valid frequencies.
fn exact(material: impl Material + 'static) -> HalfSpace {
    HalfSpace {
        material: Box::new(material),
        expansion: None,
        window: None,
        shifting: None,
    }
}

/// A half space of a Prony series that stands for another law, within the error of `expansion`.
fn approximate((material, expansion): (Prony, Expansion)) -> HalfSpace {
    HalfSpace {
        expansion: Some(expansion),
        ..exact(material)
    }
}

/// A Prony series; with an `approximation` it stands for another law and has an error. `key` is the path of its table for
/// errors.
fn series(
    key: &str,
    spectrum: Result<RelaxationSpectrum, RheologyError>,
    approximation: Option<Approximation>,
) -> Result<HalfSpace, SceneError> {
    let series = spectrum.map_err(|error| refused(key, error))?;
    let expansion = approximation
        .map(|given| given.of(&series))
        .transpose()
        .map_err(|error| refused(&format!("{key}.approximation"), error))?;
    let material = Prony::new(series).map_err(|error| refused(key, error))?;
    Ok(HalfSpace {
        expansion,
        ..exact(material)
    })
}

/// The error of `rheology` at the path `table`, or at the key `time_range` in it if that is out of range.
fn refused(table: &str, error: RheologyError) -> SceneError {
    match error {
        RheologyError::InvalidParameter(refused) if refused.parameter.starts_with("time_range") => {
            SceneError::within(table, refused)
        }
        other => SceneError::at(table, other.to_string()),
    }
}

/// The four materials with closed forms, reduced to the incompressible material with the same surface displacement.
///
/// A half space of Poisson ratio ν is 2 (1 − ν) times as compliant, so all moduli are divided by this factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Simple {
    /// A dashpot.
    Viscous(Viscous),
    /// A spring; its modulus is in the spectrum of the material.
    Elastic,
    /// Spring and dashpot in parallel.
    KelvinVoigt(KelvinVoigt),
    /// Spring and dashpot in series.
    Maxwell(Maxwell),
}

/// Reduces a material to one with closed forms; `None` for other materials. Rejects a reduced modulus out of range.
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
