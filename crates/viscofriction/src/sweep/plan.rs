//! The points of a sweep, and the scene of each.

use toml::{Table, Value};

use super::row::Row;
use super::vary::{MOST_POINTS, Vary};
use crate::scene::{SceneError, Source, scene_file, split_index};
use crate::solve::{Answer, Problem, choose, not_offered, solve};
use crate::text::{ReadFile, WrongInput};

/// Keys of a scene whose values are names of files.
const FILE_KEYS: [&str; 3] = ["file", "path", "history_file"];

/// The columns before and after the keys that vary.
const BEFORE: [&str; 3] = ["sweep", "point", "points"];

/// A scene and the keys that vary.
#[derive(Debug)]
pub struct Plan {
    source: Source,
    table: Table,
    vary: Vec<Vary>,
    /// Of the scene, the contents of the files that it names, and what varies, whatever comments and order.
    pub fingerprint: String,
    read: ReadFile,
}

impl Plan {
    /// The points of a scene and of what varies in it; `read` reads the files that the scene names.
    ///
    /// # Errors
    /// [`WrongInput`] for a key that varies twice, too many points, or a scene that is no TOML.
    pub fn new(source: Source, vary: &[Vary], read: ReadFile) -> Result<Self, WrongInput> {
        let table = source.table()?;
        for (index, one) in vary.iter().enumerate() {
            if vary[..index].iter().any(|other| other.key == one.key) {
                let problem = "it is varied twice";
                return Err(source.locate(&SceneError::at(&one.key, problem)));
            }
        }
        let points = vary
            .iter()
            .try_fold(1_usize, |n, vary| n.checked_mul(vary.values.len()));
        if points.is_none_or(|points| points > MOST_POINTS) {
            return Err(WrongInput(format!(
                "--vary gives more than {MOST_POINTS} points"
            )));
        }
        let mut scene = table.clone();
        // How many points are computed at the same time does not change them.
        if let Some(Value::Table(solve)) = scene.get_mut("solve") {
            solve.remove("threads");
        }
        let mut text = format!("{scene}\n{vary:?}").into_bytes();
        for file in named_files(&table) {
            // A file that cannot be read is refused with the key that names it, by the first point.
            text.extend(read(&source.folder().join(file)).unwrap_or_default());
        }
        let fingerprint = fingerprint(&text);
        Ok(Self {
            source,
            table,
            vary: vary.to_vec(),
            fingerprint,
            read,
        })
    }

    /// The scene.
    #[must_use]
    pub const fn source(&self) -> &Source {
        &self.source
    }

    /// Number of points, all combinations of the values.
    #[must_use]
    pub fn n_points(&self) -> usize {
        self.vary.iter().map(|vary| vary.values.len()).product()
    }

    /// The keys that vary.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.vary.iter().map(|vary| vary.key.as_str())
    }

    /// The values of a point; the last key is fastest.
    #[must_use]
    pub fn values(&self, point: usize) -> Vec<f64> {
        let mut rest = point;
        let mut values: Vec<f64> = Vec::new();
        for vary in self.vary.iter().rev() {
            let count = vary.values.len();
            values.push(vary.values[rest % count]);
            rest /= count;
        }
        values.reverse();
        values
    }

    /// Checks every point before the first is computed; returns on how many threads, none for all that there are.
    ///
    /// # Errors
    /// [`WrongInput`] with the place in the scene and the values of the point.
    pub fn validate(&self) -> Result<Option<usize>, WrongInput> {
        let mut threads = None;
        for point in 0..self.n_points() {
            let problem = self.problem(point)?;
            choose(&problem).map_err(|error| not_offered(&self.source, &error))?;
            threads = problem.threads;
        }
        Ok(threads)
    }

    /// The row of a point; what a method could not reach is part of it.
    ///
    /// # Errors
    /// [`WrongInput`] as of [`Self::validate`].
    pub fn solve(&self, point: usize) -> Result<Row, WrongInput> {
        let answer = solve(&self.problem(point)?);
        Ok(Row::new(point, identity(self, point), answer))
    }

    fn problem(&self, point: usize) -> Result<Problem, WrongInput> {
        let values = self.values(point);
        let mut table = self.table.clone();
        let build = || {
            for (key, value) in self.keys().zip(&values) {
                set(&mut table, key, *value)?;
            }
            Problem::new(&scene_file(table)?, self.source.folder(), self.read)
        };
        build().map_err(|error| {
            let WrongInput(message) = self.source.locate(&error);
            let settings: Vec<String> = self
                .keys()
                .zip(&values)
                .map(|(key, value)| format!("{key} = {value:?}"))
                .collect();
            let number = point + 1;
            WrongInput(format!(
                "{message} (point {number}: {})",
                settings.join(", ")
            ))
        })
    }
}

/// The names of the columns.
#[must_use]
pub fn header(plan: &Plan) -> Vec<String> {
    let before = BEFORE.into_iter().chain(plan.keys()).map(str::to_owned);
    let names = ["method", "model"].map(str::to_owned);
    let after = ["unknowns", "failure"].map(str::to_owned);
    let columns = Answer::columns();
    before.chain(names).chain(columns).chain(after).collect()
}

/// What tells a row from every other: sweep, point counted from 1, number of points, values.
#[must_use]
pub fn identity(plan: &Plan, point: usize) -> Vec<String> {
    let values = plan.values(point);
    [
        plan.fingerprint.clone(),
        (point + 1).to_string(),
        plan.n_points().to_string(),
    ]
    .into_iter()
    .chain(values.iter().map(|value| format!("{value:?}")))
    .collect()
}

/// Sets a key; the table it is in must be there.
fn set(table: &mut Table, key: &str, value: f64) -> Result<(), SceneError> {
    let missing = || SceneError::at(key, "the scene has no such table to vary a key of");
    let (path, last) = key.rsplit_once('.').ok_or_else(missing)?;
    let mut inner = table;
    for segment in path.split('.') {
        let (name, index) = split_index(segment);
        let mut found = inner.get_mut(name).ok_or_else(missing)?;
        if let Some(index) = index {
            found = found.get_mut(index).ok_or_else(missing)?;
        }
        inner = found.as_table_mut().ok_or_else(missing)?;
    }
    inner.insert(last.to_owned(), number(value));
    Ok(())
}

/// A whole number as an integer, which every key accepts.
fn number(value: f64) -> Value {
    let largest = 2.0_f64.powi(53);
    if value.fract() == 0.0 && value.abs() < largest {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "whole and far inside the range of the integer"
        )]
        return Value::Integer(value as i64);
    }
    Value::Float(value)
}

/// The files that a scene names, wherever it does.
fn named_files(table: &Table) -> Vec<&str> {
    let mut files = Vec::new();
    for (key, value) in table {
        match value {
            Value::Table(inner) => files.extend(named_files(inner)),
            Value::String(file) if FILE_KEYS.contains(&key.as_str()) => files.push(file.as_str()),
            _ => {}
        }
    }
    files
}

/// FNV-1a, 64 bits, as 16 digits.
fn fingerprint(text: &[u8]) -> String {
    let hash = text.iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    format!("{hash:016x}")
}
