//! The numbers of a scene that an answer can be differentiated by.

use std::path::Path;

use toml::{Table, Value};

use crate::files::ReadFile;
use crate::scene::{Scene, SceneError};
use crate::solve::problem::Problem;

/// Tables with moduli, times, loads, speeds and lengths.
const TABLES: [&str; 5] = ["indenter", "material", "layer", "load", "solve"];
/// Keys below them that are none of these: ranges of the material, and what chooses rather than describes.
const OTHERS: [&str; 7] = [
    "approximation",
    "relative_error",
    "shortest_wavelength",
    "seed",
    "temperature",
    "time_range",
    "valid_frequencies",
];

/// A scene, and the files that it names.
#[derive(Debug)]
pub(crate) struct Numbers<'a> {
    scene: Table,
    folder: &'a Path,
    read: ReadFile,
}

/// One number of a scene.
#[derive(Debug, Clone)]
pub(crate) struct Number {
    steps: Vec<Step>,
    /// Not 0.
    pub(crate) value: f64,
}

#[derive(Debug, Clone)]
enum Step {
    Key(String),
    Index(usize),
}

impl<'a> Numbers<'a> {
    pub(crate) fn new(scene: &Scene, folder: &'a Path, read: ReadFile) -> Result<Self, SceneError> {
        let scene = Table::try_from(scene);
        let scene = scene.map_err(|error| SceneError::at("scene", error.to_string()))?;
        Ok(Self {
            scene,
            folder,
            read,
        })
    }

    pub(crate) fn all(&self) -> Vec<Number> {
        let mut numbers = Vec::new();
        for table in TABLES {
            if let Some(value) = self.scene.get(table) {
                collect(value, &[Step::Key(table.to_owned())], &mut numbers);
            }
        }
        numbers
    }

    /// The problem with another value of a number.
    pub(super) fn problem(&self, number: &Number, value: f64) -> Result<Problem, SceneError> {
        let scene = self.scene([(number, value)].into_iter())?;
        Problem::new(&scene, self.folder, self.read)
    }

    /// The scene with other values of some numbers.
    pub(crate) fn scene<'n>(
        &self,
        values: impl Iterator<Item = (&'n Number, f64)>,
    ) -> Result<Scene, SceneError> {
        let mut scene = self.scene.clone();
        for (number, value) in values {
            let mut steps = number.steps.iter();
            let first = steps.next().and_then(|step| match step {
                Step::Key(key) => scene.get_mut(key),
                Step::Index(_) => None,
            });
            let place = steps.try_fold(first, |place, step| {
                Some(match (place, step) {
                    (Some(Value::Table(table)), Step::Key(key)) => table.get_mut(key),
                    (Some(Value::Array(list)), Step::Index(index)) => list.get_mut(*index),
                    _ => None,
                })
            });
            if let Some(Some(place)) = place {
                *place = Value::Float(value);
            }
        }
        Scene::try_from(scene)
    }
}

fn collect(value: &Value, steps: &[Step], numbers: &mut Vec<Number>) {
    let below = |step: Step| [steps, &[step]].concat();
    match value {
        Value::Float(value) if *value != 0.0 && value.is_finite() => numbers.push(Number {
            steps: steps.to_vec(),
            value: *value,
        }),
        Value::Table(table) => {
            for (key, value) in table.iter().filter(|(key, _)| !OTHERS.contains(&&key[..])) {
                collect(value, &below(Step::Key(key.clone())), numbers);
            }
        }
        Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                collect(value, &below(Step::Index(index)), numbers);
            }
        }
        _ => {}
    }
}

impl Number {
    /// The path of its key, such as `material.prony.branches[0].modulus`.
    pub(crate) fn path(&self) -> String {
        let mut path = String::new();
        for step in &self.steps {
            match step {
                Step::Key(key) if path.is_empty() => path.push_str(key),
                Step::Key(key) => path = format!("{path}.{key}"),
                Step::Index(index) => path = format!("{path}[{index}]"),
            }
        }
        path
    }

    /// The first and the last key.
    pub(crate) fn ends(&self) -> [&str; 2] {
        let mut keys = self.steps.iter().filter_map(|step| match step {
            Step::Key(key) => Some(&key[..]),
            Step::Index(_) => None,
        });
        let first = keys.next().unwrap_or_default();
        [first, keys.next_back().unwrap_or_default()]
    }
}
