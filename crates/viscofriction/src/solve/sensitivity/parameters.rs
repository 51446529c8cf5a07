//! Numbers of a scene by which an answer can be differentiated.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use numerics::in_range;
use rheology::KELVIN_AT_ZERO_CELSIUS;
use toml::{Table, Value};

use crate::files::{Files, ReadFile};
use crate::scene::{MaterialTable, Scene, SceneError, quoted, split_index, value_at};
use crate::solve::body::body;
use crate::solve::half_space::{half_space, material_of_file};
use crate::solve::problem::Problem;

/// Tables of the scene that contain moduli, times, loads, speeds, lengths and thermal properties.
const TABLES: [&str; 8] = [
    "indenter",
    "material",
    "layer",
    "interface",
    "heat",
    "strain",
    "load",
    "solve",
];
/// Keys in these tables by which answers are not differentiated: ranges of the material, the selection of waves,
/// temperatures in °C, which have no logarithm, and options.
const EXCLUDED_KEYS: [&str; 13] = [
    "ambient_temperature",
    "approximation",
    "covariance",
    "longest_wavelength",
    "period",
    "reference_temperature",
    "relative_error",
    "shortest_wavelength",
    "seed",
    "shift",
    "temperature",
    "time_range",
    "valid_frequencies",
];

/// Path of the temperature of a material file; an answer is differentiated by it only if it is uncertain.
const TEMPERATURE: &str = "material.file.temperature";
/// Path of the temperature of the surroundings, of which the same holds.
const AMBIENT_TEMPERATURE: &str = "heat.ambient_temperature";

/// A scene as a tree of keys, with access to its files.
#[derive(Debug)]
pub(crate) struct Numbers<'a> {
    /// The scene with the file of its material resolved, without uncertainties.
    scene: Table,
    /// The scene as written, with the reference to its material file, and the temperature of the material \[K]. `None` unless
    /// the scene names a file with a shift law.
    of_file: Option<(Table, f64)>,
    /// Stated standard uncertainties by the paths of the numbers: relative, that of the temperature in \[K].
    uncertainty: BTreeMap<String, f64>,
    /// Folder that file names of the scene refer to.
    folder: &'a Path,
    read: ReadFile,
}

/// A number of a scene that is finite and not 0.
#[derive(Debug, Clone)]
pub(crate) struct Number {
    /// Path of the key, such as `material.prony.branches[0].modulus`.
    pub(crate) path: String,
    /// Value of the number in SI units, of a temperature in \[K].
    pub(crate) value: f64,
}

impl<'a> Numbers<'a> {
    /// Reads the material file of a scene, if it names one, and separates its uncertainties.
    pub(crate) fn new(scene: &Scene, folder: &'a Path, read: ReadFile) -> Result<Self, SceneError> {
        let mut scene = scene.clone();
        // Uncertainties refer to the scene as given; changed scenes carry none.
        let uncertainty = std::mem::take(&mut scene.uncertainty);
        let written = as_table(&scene)?;
        let (resolved, celsius) = without_file(scene, folder, read)?;
        Ok(Self {
            scene: resolved,
            of_file: celsius.map(|celsius| (written, celsius + KELVIN_AT_ZERO_CELSIUS)),
            uncertainty,
            folder,
            read,
        })
    }

    /// The scene with the file of its material resolved, without uncertainties.
    pub(super) fn scene(&self) -> Result<Scene, SceneError> {
        Scene::try_from(self.scene.clone())
    }

    /// Standard uncertainty of a number: relative, for a temperature in \[K]; 0 if the scene states none.
    pub(super) fn uncertainty(&self, number: &Number) -> f64 {
        self.uncertainty
            .get(&number.path)
            .copied()
            .unwrap_or_default()
    }

    /// Temperature of the surroundings, or else of the material file, \[K]; `None` unless the scene states its uncertainty.
    pub(super) fn uncertain_temperature(&self) -> Option<Number> {
        let (path, value) = self.temperature()?;
        let path = path.to_owned();
        let is_uncertain = self.uncertainty.contains_key(&path);
        is_uncertain.then_some(Number { path, value })
    }

    /// Path and value \[K] of the temperature of the surroundings, or else of the material file; `None` if the scene has neither.
    fn temperature(&self) -> Option<(&'static str, f64)> {
        let heat = self.scene.get("heat");
        let ambient = heat.and_then(|heat| heat.get("ambient_temperature")?.as_float());
        let of_file = || Some((TEMPERATURE, self.of_file.as_ref()?.1));
        ambient.map_or_else(of_file, |celsius| {
            Some((AMBIENT_TEMPERATURE, celsius + KELVIN_AT_ZERO_CELSIUS))
        })
    }

    /// Rejects uncertainties out of range, and those of paths that are not numbers of the scene.
    fn check_uncertainties(&self) -> Result<(), SceneError> {
        let known: Vec<String> = self.all().into_iter().map(|one| one.path).collect();
        let has_covariance = self.scene()?.material.covariance().is_some();
        for (path, value) in &self.uncertainty {
            let key = quoted("uncertainty", path);
            let (most, allowed) = match &path[..] {
                TEMPERATURE | AMBIENT_TEMPERATURE => (f64::MAX, "at least 0, in K"),
                _ => (1.0, "from 0 to 1, a part of the number, as 0.05 is 5 %"),
            };
            let holds = (0.0..=most).contains(value);
            in_range("", *value, holds, allowed)
                .map_err(|refused| SceneError::value(key.clone(), refused))?;
            let problem = match &path[..] {
                TEMPERATURE | AMBIENT_TEMPERATURE => match self.temperature() {
                    Some((known, _)) if known == path => continue,
                    Some((known, _)) => {
                        format!("the contact has the temperature {known}, which may be uncertain")
                    }
                    None => "a temperature is uncertain only of a material of a file with a shift law, and of the surroundings in [heat]"
                        .to_owned(),
                },
                _ if !known.contains(path) => {
                    let quoted: Vec<String> =
                        known.iter().map(|path| format!("{path:?}")).collect();
                    let list = quoted.join(", ");
                    format!(
                        "this is no number of the scene that may be uncertain; these are: {list}"
                    )
                }
                _ if has_covariance
                    && path.starts_with("material.")
                    && path.ends_with("modulus") =>
                {
                    "the covariance of the material says how well its moduli are known".to_owned()
                }
                _ => continue,
            };
            return Err(SceneError::at(key, problem));
        }
        Ok(())
    }

    /// All numbers of the scene that are finite, not 0 and not of [`EXCLUDED_KEYS`], in the order of [`TABLES`].
    pub(crate) fn all(&self) -> Vec<Number> {
        let mut numbers = Vec::new();
        for table in TABLES {
            if let Some(value) = self.scene.get(table) {
                collect_numbers(value, table, &mut numbers);
            }
        }
        numbers
    }

    /// A problem with another value of one of its numbers. It shares the body or the elastomer that the number does not belong to.
    pub(super) fn problem(
        &self,
        problem: &Problem,
        number: &Number,
        value: f64,
    ) -> Result<Problem, SceneError> {
        let scene = self.scene_with(number, value)?;
        let files = Files::of(&scene, self.folder, self.read)?;
        let mut parts = problem.parts().clone();
        match number.ends() {
            ["indenter", _] => parts.body = Arc::new(body(&scene.indenter, &files)?),
            ["material", _] => parts.half_space = Arc::new(half_space(&scene.material, &files)?),
            _ => {}
        }
        Problem::with_parts(&scene, parts, self.folder, self.read)
    }

    /// The scene in which `number` has another value; if it is the temperature of the material file, the scene that still names the file.
    pub(super) fn scene_with(&self, number: &Number, value: f64) -> Result<Scene, SceneError> {
        let mut scene = match &self.of_file {
            Some((written, _)) if number.path == TEMPERATURE => written.clone(),
            _ => self.scene.clone(),
        };
        let zero = if number.is_temperature() {
            KELVIN_AT_ZERO_CELSIUS
        } else {
            0.0
        };
        replace(&mut scene, &number.path, value - zero);
        Scene::try_from(scene)
    }

    /// The scene with other values of some numbers, none of them a temperature.
    #[cfg(feature = "fit")]
    pub(crate) fn scene_with_all<'n>(
        &self,
        values: impl Iterator<Item = (&'n Number, f64)>,
    ) -> Result<Scene, SceneError> {
        let mut scene = self.scene.clone();
        for (number, value) in values {
            replace(&mut scene, &number.path, value);
        }
        Scene::try_from(scene)
    }
}

/// Rejects uncertainties of a scene that are out of range or belong to no number of it.
pub(crate) fn check_uncertainties(
    scene: &Scene,
    folder: &Path,
    read: ReadFile,
) -> Result<(), SceneError> {
    if scene.uncertainty.is_empty() {
        return Ok(());
    }
    Numbers::new(scene, folder, read)?.check_uncertainties()
}

/// A scene as a table with the file of its material resolved, and the temperature \[°C] of a material with a shift law.
fn without_file(
    mut scene: Scene,
    folder: &Path,
    read: ReadFile,
) -> Result<(Table, Option<f64>), SceneError> {
    let MaterialTable::File {
        path,
        temperature,
        poisson_ratio,
        valid_frequencies,
    } = &scene.material
    else {
        return Ok((as_table(&scene)?, None));
    };
    let files = Files::of(&scene, folder, read)?;
    let material = material_of_file(path, *temperature, &files)?;
    scene.material = material.with_given(*poisson_ratio, *valid_frequencies)?;
    let table = as_table(&scene)?;
    let celsius = scene.material.shift().map(|shift| shift.temperature);
    Ok((table, celsius))
}

/// A scene as a table of keys and values.
fn as_table(scene: &Scene) -> Result<Table, SceneError> {
    Table::try_from(scene).map_err(|error| SceneError::at("scene", error.to_string()))
}

/// Writes another value of the number at a path into a scene, also where its key is absent; without its table nothing changes.
fn replace(scene: &mut Table, path: &str, value: f64) {
    if let Some(place) = value_at(scene, path) {
        *place = Value::Float(value);
    } else if let Some((tables, key)) = path.rsplit_once('.')
        && let Some(Value::Table(table)) = value_at(scene, tables)
    {
        // The temperature may be absent from the scene, and then is that of the file.
        table.insert(key.to_owned(), Value::Float(value));
    }
}

/// Appends the numbers within `value`, which is at `path`, depth first.
fn collect_numbers(value: &Value, path: &str, numbers: &mut Vec<Number>) {
    match value {
        Value::Float(value) if *value != 0.0 && value.is_finite() => numbers.push(Number {
            path: path.to_owned(),
            value: *value,
        }),
        Value::Table(table) => {
            for (key, value) in table
                .iter()
                .filter(|(key, _)| !EXCLUDED_KEYS.contains(&&key[..]))
            {
                collect_numbers(value, &format!("{path}.{key}"), numbers);
            }
        }
        Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                collect_numbers(value, &format!("{path}[{index}]"), numbers);
            }
        }
        _ => {}
    }
}

impl Number {
    /// True for the temperature of the material file or of the surroundings.
    pub(super) fn is_temperature(&self) -> bool {
        [TEMPERATURE, AMBIENT_TEMPERATURE].contains(&&self.path[..])
    }

    /// The relative standard uncertainty of this number for the stated one `given`. Both are equal, except for the temperature:
    /// `given` is in kelvins, and is divided by the temperature.
    pub(super) fn relative(&self, given: f64) -> f64 {
        if self.is_temperature() {
            given / self.value
        } else {
            given
        }
    }

    /// First and last key of the path.
    pub(crate) fn ends(&self) -> [&str; 2] {
        let (first, rest) = self.path.split_once('.').unwrap_or_default();
        let last = rest.rsplit('.').next().unwrap_or_default();
        [first, split_index(last).0]
    }
}
