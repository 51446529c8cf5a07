//! The points of a sweep, the scene of each, and the row of its answer.

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use numerics::{SilentProgress, whole_part};
use toml::{Table, Value};

use super::cache::PartsCache;
use super::row::{BETWEEN_WARNINGS, CHECKS, EMPTY_HASH, SweepRow, canonical, hash_text, hashed};
use super::vary::{MAX_POINTS, SAMPLE, Varied, Vary};
use crate::files::{Files, ReadFile};
use crate::quantity::differentiated;
use crate::scene::{PATH_KEYS, Scene, SceneError, Source, scene_file, value_at};
use crate::solve::{
    Answer, Problem, Warning, check_uncertainties, plan_of, sampled, share_memory, solve,
    with_sensitivity,
};
use crate::text::WrongInput;

/// A scene with its varied keys.
#[derive(Debug)]
pub struct Plan {
    /// The scene file.
    source: Source,
    /// Keys and values of the scene, with a table `solve`.
    table: Table,
    /// The varied keys with their values; the last varies fastest.
    vary: Vec<Vary>,
    /// Hash of the scene, of the contents of its files, and of the varied keys. It ignores comments, the order of keys in the
    /// scene, `solve.threads` and `solve.max_memory`.
    pub fingerprint: String,
    /// True if rows contain the uncertainties from the covariance of the material and from the scene; rows of samples never do.
    pub sensitivity: bool,
    /// Memory limit for all points computed concurrently, if the scene gives none, \[bytes]; `None` for no limit.
    pub max_memory: Option<u64>,
    read: ReadFile,
    /// Bodies and elastomers that points share.
    parts: PartsCache,
}

impl Plan {
    /// Plans the sweep; `read` reads the files that the scene names.
    ///
    /// # Errors
    /// [`WrongInput`] for a key that is varied twice, too many points, or a scene that is not TOML.
    pub fn new(source: Source, vary: &[Vary], read: ReadFile) -> Result<Self, WrongInput> {
        let mut table = source.table()?;
        // The table `solve` is optional, but its keys can be varied.
        let solve = || Value::Table(Table::new());
        table.entry("solve").or_insert_with(solve);
        check_vary(&source, vary)?;
        let mut scene = table.clone();
        // Leave threads and memory out of the hash: they do not change a point.
        if let Some(Value::Table(solve)) = scene.get_mut("solve") {
            solve.remove("threads");
            solve.remove("max_memory");
        }
        let files = Files {
            folder: source.folder(),
            read,
            memory: memory_limit(&table),
        };
        let mut hash = hashed(EMPTY_HASH, format!("{scene}\n{vary:?}").as_bytes());
        let mut names = named_files(&table);
        names.extend(varied_files(vary));
        let mut known = BTreeSet::new();
        names.retain(|name| known.insert(*name));
        for file in names {
            // An unreadable file is reported by the first point, with the key that names it.
            let contents = files.contents(file.as_ref(), files.memory());
            hash = hashed(hash, &contents.unwrap_or_default());
        }
        Ok(Self {
            fingerprint: hash_text(hash),
            source,
            table,
            vary: vary.to_vec(),
            sensitivity: false,
            max_memory: None,
            read,
            parts: PartsCache::default(),
        })
    }

    /// Text of the scene that is varied.
    pub fn scene_text(&self) -> &str {
        self.source.text()
    }

    /// Number of points, the product of the numbers of values.
    pub fn n_points(&self) -> usize {
        self.vary.iter().map(|vary| vary.values.len()).product()
    }

    /// The varied keys, such as `load.velocity`, in the order given.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.vary.iter().map(|vary| vary.key.as_str())
    }

    /// Values of the varied keys at the point of this index, in the order of the keys; the last key varies fastest.
    pub fn values(&self, point: usize) -> Vec<&Varied> {
        let mut rest = point;
        let mut values = Vec::new();
        for vary in self.vary.iter().rev() {
            let count = vary.values.len();
            values.push(&vary.values[rest % count]);
            rest /= count;
        }
        values.reverse();
        values
    }

    /// Validates points before the first of them is computed. Returns the number of threads; `None` for all.
    ///
    /// # Errors
    /// [`WrongInput`] with the place in the scene and the values of the point.
    pub fn validate(&self, points: &[usize]) -> Result<Option<usize>, WrongInput> {
        let mut threads = None;
        self.check_samples()?;
        for &point in points {
            let problem = self.problem(point)?;
            plan_of(&self.source, &problem)?;
            threads = problem.threads();
        }
        Ok(threads)
    }

    /// Rejects samples of a scene without uncertain numbers.
    fn check_samples(&self) -> Result<(), WrongInput> {
        if self.keys().all(|key| key != SAMPLE) {
            return Ok(());
        }
        let check = || {
            let scene = scene_file(self.table.clone())?;
            let files = (self.source.folder(), self.read);
            check_uncertainties(&scene, files.0, files.1)?;
            let [one, other] = [1, 2].map(|sample| sampled(&scene, files, sample));
            if one? == other? {
                let problem = "samples need a number that is uncertain, as \"load.normal_force\" = 0.05 in [uncertainty], or a material \
                               with a covariance";
                return Err(SceneError::at("uncertainty", problem));
            }
            Ok(())
        };
        check().map_err(|error| self.source.locate(&error))
    }

    /// Sample number of a point; `None` if samples are not varied.
    fn sample(&self, point: usize) -> Option<f64> {
        let values = self.values(point);
        let (_, value) = self.keys().zip(values).find(|(key, _)| *key == SAMPLE)?;
        match value {
            Varied::Number(number) => Some(*number),
            Varied::Text(_) => Some(f64::NAN),
        }
    }

    /// Computes rows on all threads of the pool within one memory limit; `take` receives each row as soon as it is finished.
    pub fn solve_all(
        &self,
        points: &[usize],
        take: impl Fn(Result<SweepRow, WrongInput>) -> ControlFlow<()> + Sync,
    ) {
        let within = |point, parts| self.solve_within(point, parts);
        share_memory(points.to_vec(), within, |_, row| take(row));
    }

    /// The row of a point; a missed request is part of the row.
    ///
    /// # Errors
    /// [`WrongInput`] for a point that [`Self::validate`] refuses.
    pub fn solve(&self, point: usize) -> Result<SweepRow, WrongInput> {
        let (scene, problem) = self.scene_and_problem(point, 1)?;
        self.solve_problem(point, (&scene, &problem))
    }

    /// The row of a point within one of `parts` equal parts of the memory; `None` if that is too little.
    pub fn solve_within(&self, point: usize, parts: u64) -> Option<Result<SweepRow, WrongInput>> {
        if parts == 1 {
            return Some(self.solve(point));
        }
        // An error here may be due to the partial memory; with all of the memory it is reported.
        let (scene, problem) = self.scene_and_problem(point, parts).ok()?;
        let row = self.solve_problem(point, (&scene, &problem));
        (!problem.is_short_of_memory()).then_some(row)
    }

    /// Solves a problem, with uncertainties if requested, and makes the row.
    fn solve_problem(
        &self,
        point: usize,
        (scene, problem): (&Scene, &Problem),
    ) -> Result<SweepRow, WrongInput> {
        let mut answer = solve(problem);
        let is_drawn = self.sample(point).is_some_and(|sample| sample > 0.0);
        if self.sensitivity
            && !is_drawn
            && let Ok(alone) = &mut answer
        {
            let files = (self.source.folder(), self.read);
            match with_sensitivity(scene, files, problem, alone.clone(), &SilentProgress) {
                Ok(found) => *alone = found,
                Err(why) => {
                    let why = Warning::NoUncertainty(why.to_string());
                    alone.warnings.push(why);
                }
            }
        }
        let failure = answer.as_ref().err().map(ToString::to_string);
        let found = match &answer {
            Ok(answer) => Some(answer),
            Err(error) => error.reached(),
        };
        let mut results = self.results(found);
        results.push(failure.map_or(String::new(), |why| one_line(&why)));
        Ok(SweepRow::new(self, point, results))
    }

    /// Cells that identify a row: sweep, point counted from 1, number of points, and values.
    pub fn identity(&self, point: usize) -> Vec<String> {
        let numbers = [point + 1, self.n_points()].map(|number| number.to_string());
        let values = self.values(point).into_iter().map(Varied::to_string);
        let sweep = std::iter::once(self.fingerprint.clone());
        sweep.chain(numbers).chain(values).collect()
    }

    /// True if a row belongs to a point of this sweep.
    pub fn has(&self, row: &SweepRow) -> bool {
        let is_same =
            |(computed, found): (String, &String)| canonical(&computed) == canonical(found);
        row.point < self.n_points() && {
            let identity = self.identity(row.point);
            identity.into_iter().zip(&row.fields).all(is_same)
        }
    }

    /// Names of the columns of results: the numbers of an answer, and with derivatives the uncertainties of each quantity.
    fn columns(&self) -> Vec<String> {
        let uncertainties = differentiated().flat_map(|quantity| {
            let key = quantity.key;
            [
                format!("{key}_material_error"),
                format!("{key}_uncertainty"),
            ]
        });
        let asked = uncertainties.filter(|_| self.sensitivity);
        Answer::columns().into_iter().chain(asked).collect()
    }

    /// Cells of a row from the method to the warnings; empty ones without an answer.
    fn results(&self, found: Option<&Answer>) -> Vec<String> {
        let Some(answer) = found else {
            return vec![String::new(); self.columns().len() + 4];
        };
        let names = [answer.method.name(), answer.model.name()].map(str::to_owned);
        let values = answer.numbers().into_iter().map(|(_, value)| value);
        let [material, total] = [answer.budget.material(), answer.budget.total()];
        let uncertainties =
            differentiated().flat_map(|quantity| [&material, &total].map(|of| of.of(quantity.key)));
        let numbers = values
            .chain(uncertainties.filter(|_| self.sensitivity))
            .map(|value| value.map_or(String::new(), decimal));
        let warnings = answer.warnings.iter().map(Warning::to_string);
        let warnings = one_line(&warnings.collect::<Vec<_>>().join(BETWEEN_WARNINGS));
        let after = [answer.unknowns.to_string(), warnings];
        names.into_iter().chain(numbers).chain(after).collect()
    }

    /// The problem at the point of this index: the scene with the values of the varied keys.
    ///
    /// # Errors
    /// [`WrongInput`] for a point that [`Self::validate`] refuses.
    pub fn problem(&self, point: usize) -> Result<Problem, WrongInput> {
        self.scene_and_problem(point, 1).map(|(_, problem)| problem)
    }

    /// Scene and problem of a point, with one of `parts` equal parts of the memory.
    fn scene_and_problem(&self, point: usize, parts: u64) -> Result<(Scene, Problem), WrongInput> {
        let values = self.values(point);
        let mut table = self.table.clone();
        let build = || {
            for (key, value) in self.keys().zip(&values).filter(|(key, _)| *key != SAMPLE) {
                set_key(&mut table, key, value)?;
            }
            let mut scene = scene_file(table)?;
            if let Some(sample) = self.sample(point) {
                let sample = sample_index(SAMPLE, sample)?;
                scene = sampled(&scene, (self.source.folder(), self.read), sample)?;
            }
            // Body and elastomer are shared, so all of the memory is available to read them.
            scene.solve.limit_memory(self.max_memory, 1)?;
            let (folder, read) = (self.source.folder(), self.read);
            let shared = self
                .parts
                .parts(&scene, &Files::of(&scene, folder, read)?)?;
            scene.solve.limit_memory(None, parts)?;
            let problem = Problem::with_parts(&scene, shared, folder, read)?;
            Ok((scene, problem))
        };
        build().map_err(|error| {
            let WrongInput(message) = self.source.locate(&error);
            let pairs = self.keys().zip(&values);
            let settings: Vec<String> = pairs
                .map(|(key, value)| format!("{key} = {value}"))
                .collect();
            let point_in_words = format!("point {}: {}", point + 1, settings.join(", "));
            WrongInput(format!("{message} ({point_in_words})"))
        })
    }
}

/// Rejects a key that is varied twice, too many points, and texts that do not fit into a cell.
fn check_vary(source: &Source, vary: &[Vary]) -> Result<(), WrongInput> {
    let is_broken =
        |value: &Varied| matches!(value, Varied::Text(text) if text.contains(char::is_control));
    for (index, one) in vary.iter().enumerate() {
        let is_twice = vary[..index].iter().any(|other| other.key == one.key);
        let problem = match one.values.iter().find(|value| is_broken(value)) {
            Some(text) => format!("a text must be one line, but one is {:?}", text.to_string()),
            None if is_twice => "it is varied twice".to_owned(),
            None => continue,
        };
        return Err(source.locate(&SceneError::at(&one.key, problem)));
    }
    let mut counts = vary.iter().map(|vary| vary.values.len());
    let points = counts.try_fold(1_usize, usize::checked_mul);
    if points.is_none_or(|points| points > MAX_POINTS) {
        let problem = format!("--vary gives more than {MAX_POINTS} points");
        return Err(WrongInput(problem));
    }
    Ok(())
}

/// Header of the CSV file of a sweep: identification of the point, varied keys, checksums, method, results, and messages.
pub fn header(plan: &Plan) -> Vec<String> {
    let before = ["sweep", "point", "points"].into_iter().chain(plan.keys());
    let before = before
        .chain(CHECKS)
        .chain(["method", "model"])
        .map(str::to_owned);
    let after = ["unknowns", "warnings", "failure"].map(str::to_owned);
    before.chain(plan.columns()).chain(after).collect()
}

/// Replaces line breaks, because a row is one line.
fn one_line(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
}

/// The shortest decimal text that JSON and Rust read back to the same `f64`.
fn decimal(value: f64) -> String {
    format!("{value:?}")
}

/// A sample number as an integer; an error at `key` unless it is whole, not negative and at most [`MAX_POINTS`].
fn sample_index(key: &str, number: f64) -> Result<usize, SceneError> {
    if number.fract() == 0.0 && number >= 0.0 && number <= MAX_POINTS as f64 {
        return Ok(whole_part(number));
    }
    let problem = format!("a whole number is needed, but it is {number}");
    Err(SceneError::at(key, problem))
}

/// Message for a varied key whose table is missing.
const NO_TABLE: &str = "the scene has no such table to vary a key of; a key is given with its tables, as load.velocity";

/// Sets a varied key, given by its path, in the table of a scene. An error if the table of the key does not exist; the key
/// itself need not.
fn set_key(table: &mut Table, key: &str, value: &Varied) -> Result<(), SceneError> {
    let missing = || SceneError::at(key, NO_TABLE);
    let (path, last) = key.rsplit_once('.').ok_or_else(missing)?;
    let found = value_at(table, path).and_then(Value::as_table_mut);
    let inner = found.ok_or_else(missing)?;
    let value = match value {
        Varied::Number(value) => toml_number(*value),
        Varied::Text(text) => match text.parse() {
            Ok(is) => Value::Boolean(is),
            Err(_) => Value::String(text.clone()),
        },
    };
    inner.insert(last.to_owned(), value);
    Ok(())
}

/// A number as a TOML value: a whole one as an integer, which keys of integers and of floats accept.
fn toml_number(value: f64) -> Value {
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

/// The file names in all tables of a scene, in the order of their keys.
fn named_files(table: &Table) -> Vec<&str> {
    let mut files = Vec::new();
    for (key, value) in table {
        match value {
            Value::Table(inner) => files.extend(named_files(inner)),
            Value::String(file) if PATH_KEYS.contains(&key.as_str()) => files.push(file.as_str()),
            _ => {}
        }
    }
    files
}

/// The file names among the values of varied keys.
fn varied_files(vary: &[Vary]) -> impl Iterator<Item = &str> {
    let names_files = |vary: &&Vary| {
        vary.key
            .rsplit('.')
            .next()
            .is_some_and(|last| PATH_KEYS.contains(&last))
    };
    let values = vary
        .iter()
        .filter(names_files)
        .flat_map(|vary| &vary.values);
    values.filter_map(|value| match value {
        Varied::Text(file) => Some(file.as_str()),
        Varied::Number(_) => None,
    })
}

/// Memory limit of the scene, \[bytes]; `None` if it gives none or is invalid.
fn memory_limit(table: &Table) -> Option<u64> {
    let scene = scene_file(table.clone()).ok()?;
    scene.solve.checked_memory().ok()?
}
