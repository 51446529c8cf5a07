//! In which range the constants that steer the solvers and their error bars may change: each is changed in a copy of the
//! checkout, whose program solves a few scenes.
//!
//! The copy and all that is built from it are in `target/tuning`; the checkout itself is only read.

mod cases;
mod checkout;
mod program;
mod summary;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use clap::Args;
use serde::{Deserialize, Serialize};
use viscofriction::Estimate;

use super::Report;
use crate::output::WrongInput;
use crate::table::{GrowingTable, Table};
use cases::{BenchmarkScene, Case, Cases};
use checkout::Checkout;
use program::{Answer, Failure, Program};

/// Which constants.
#[derive(Debug, Default, Args)]
pub(super) struct Options {
    /// Constant of xtask/src/evidence/tuning/cases.toml; may be given several times [default: all, quick three].
    #[arg(long = "constant", value_name = "NAME")]
    constants: Vec<String>,
}

/// One quantity of one scene with a tried value of a constant, next to that with the present value; a row of `tuning.csv`.
/// Values are in SI, errors absolute, times those of one run.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Row {
    constant: String,
    present: String,
    tried: String,
    scene: String,
    quantity: String,
    outcome: Outcome,
    value: Option<f64>,
    value_error: Option<f64>,
    present_value: f64,
    present_value_error: f64,
    reference: f64,
    reference_error: f64,
    /// Deviation from the reference over the sum of the error bar and the error of the reference.
    deviation_over_bar: Option<f64>,
    present_deviation_over_bar: f64,
    unknowns: Option<f64>,
    present_unknowns: Option<f64>,
    iterations: Option<f64>,
    present_iterations: Option<f64>,
    processor_seconds: f64,
    present_processor_seconds: f64,
}

impl Row {
    /// Whether the row belongs to this case and this tried value.
    fn is_of(&self, case: &Case, tried: &str) -> bool {
        self.constant == case.constant && self.present == case.present && self.tried == tried
    }
}

/// Whether the answer with the tried value is still right.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Outcome {
    /// Value and bar have the digits that they have with the present value.
    Same,
    /// The deviation from the reference is within the bar and the error of the reference.
    InsideBar,
    /// It is not.
    OutsideBar,
    /// The program ended with an error.
    Refused,
    /// The program was ended, because it took too long.
    Unfinished,
}

/// Tries the values of the constants asked for, of three of them in a quick run.
pub(super) fn report(options: &Options, out: &Path, quick: bool) -> Result<Report> {
    let cases = Cases::read()?;
    let chosen = chosen_cases(&cases, options, quick)?;
    let rows = measure(&cases, &chosen, out.join("tuning.csv"))?;
    Ok(Report {
        name: "tuning",
        summary: summary::summary(&chosen, &rows),
        tables: vec![Table::new("tuning", &rows)?],
        ..Report::default()
    })
}

/// Rows of the chosen cases and all others that the file has; those that are not in the file are computed and written to it.
fn measure(cases: &Cases, chosen: &[&Case], file: PathBuf) -> Result<Vec<Row>> {
    let mut table = GrowingTable::<Row>::open(file)?;
    let values = chosen
        .iter()
        .flat_map(|case| case.tried().map(move |tried| (*case, tried)));
    let missing: Vec<(&Case, &String)> = values
        .filter(|(case, tried)| {
            let is_there = |scene: &String| {
                let mut rows = table.rows.iter();
                rows.any(|row| row.is_of(case, tried) && row.scene == *scene)
            };
            !case.scenes.iter().all(is_there)
        })
        .collect();
    if missing.is_empty() {
        return Ok(table.rows);
    }
    let is_missing = |row: &Row| missing.iter().any(|(case, tried)| row.is_of(case, tried));
    table.rows.retain(|row| !is_missing(row));

    // Solve all scenes and their references by the unchanged program.
    let checkout = Checkout::new()?;
    checkout.update(None)?;
    let present = checkout.build("present")?;
    let mut baselines = BTreeMap::new();
    for name in missing.iter().flat_map(|(case, _)| &case.scenes) {
        if !baselines.contains_key(name) {
            let baseline = Baseline::new(cases.scene(name)?, &checkout, &present);
            baselines.insert(name, baseline.with_context(|| name.clone())?);
        }
    }

    // Build the program with one value after the other.
    table.extend(&missing, 1, |(case, tried)| {
        checkout.update(Some((case, tried)))?;
        let changed = checkout.build("changed")?;
        let mut rows = Vec::new();
        for name in &case.scenes {
            let baseline = &baselines[name];
            let scene = checkout.copy(&baseline.scene.file);
            let compared = baseline.compare(&scene, &present, &changed);
            let compared = compared.with_context(|| format!("{} = {tried}", case.constant))?;
            rows.extend(baseline.rows(case, tried, &compared));
        }
        Ok(rows)
    })?;
    Ok(table.rows)
}

/// The cases that the command line names; without names all, or those of a quick run. Fails for an unknown name.
fn chosen_cases<'a>(cases: &'a Cases, options: &Options, quick: bool) -> Result<Vec<&'a Case>> {
    let names = &options.constants;
    for name in names {
        let is_known = cases.cases.iter().any(|case| case.constant == *name);
        let wrong = format!("--constant {name} is not in xtask/src/evidence/tuning/cases.toml");
        ensure!(is_known, WrongInput(wrong));
    }
    let is_chosen = |case: &&Case| {
        if names.is_empty() {
            case.is_quick || !quick
        } else {
            names.contains(&case.constant)
        }
    };
    Ok(cases.cases.iter().filter(is_chosen).collect())
}

/// A scene with its answer at the present values of all constants, and the reference of this answer.
struct Baseline<'a> {
    scene: &'a BenchmarkScene,
    answer: Answer,
    reference: Answer,
    /// Time on the wall after which a run is ended \[s].
    limit: f64,
}

/// Time on the wall clock after which a run is ended, over that with the present value; chosen: such a slow value is useless.
const LIMIT_OVER_PRESENT_TIME: f64 = 20.0;
/// Shortest time on the wall clock after which a run is ended \[s]; a busy machine delays short runs by more than a factor.
const MIN_LIMIT: f64 = 20.0;
/// Runs of a scene are repeated until those with the present value took this processor time \[s], against which the steps of
/// 10 ms, in which it is counted, are 2 %.
const MEASURED_SECONDS: f64 = 0.5;
/// The same where the ratio of both times is not close to 1 \[s], so that a change is not reported by chance.
const DOUBTED_SECONDS: f64 = 2.0;
/// Largest number of runs of a scene, for those too short to be counted at all.
const MAX_RUNS: u32 = 250;

impl<'a> Baseline<'a> {
    /// Solves a scene and its reference by the program with the present values; fails if either is refused.
    fn new(scene: &'a BenchmarkScene, checkout: &Checkout, present: &Program) -> Result<Self> {
        let answer_of = |file: &Path| {
            let run = present.solve(scene, file, f64::INFINITY)?;
            match run.answer {
                Ok(answer) => Ok((answer, run.seconds)),
                Err(failure) => bail!("{}: {failure:?}", file.display()),
            }
        };
        let (answer, seconds) = answer_of(&checkout.copy(&scene.file))?;
        let (reference, _) = answer_of(&checkout.write_reference(scene)?)?;
        Ok(Self {
            scene,
            answer,
            reference,
            limit: (LIMIT_OVER_PRESENT_TIME * seconds).max(MIN_LIMIT),
        })
    }

    /// Solves the scene in `file` with the changed and the present program in turn, so that other work on the machine slows
    /// down both alike.
    fn compare(&self, file: &Path, present: &Program, changed: &Program) -> Result<Comparison> {
        let mut seconds = [0.0; 2];
        let mut n_runs = 0;
        loop {
            n_runs += 1;
            let run = changed.solve(self.scene, file, self.limit)?;
            seconds[0] += run.processor_seconds;
            seconds[1] += present
                .solve(self.scene, file, f64::INFINITY)?
                .processor_seconds;
            // A ratio that looks like a change is averaged longer.
            let is_close = (seconds[0] / seconds[1]).ln().abs() <= summary::MAX_TIME_RATIO.ln();
            let needed = if is_close {
                MEASURED_SECONDS
            } else {
                DOUBTED_SECONDS
            };
            let is_measured = seconds[1] >= needed || n_runs == MAX_RUNS;
            if run.answer.is_err() || is_measured {
                return Ok(Comparison {
                    answer: run.answer,
                    processor_seconds: seconds[0] / f64::from(n_runs),
                    present_processor_seconds: seconds[1] / f64::from(n_runs),
                });
            }
        }
    }

    /// A row for each quantity of the scene: answer with the `tried` value, with the present one, and reference.
    fn rows(&self, case: &Case, tried: &str, compared: &Comparison) -> Vec<Row> {
        let answer = compared.answer.as_ref();
        let row = |(name, present): (&String, &Estimate)| {
            let reference = self.reference.quantities[name];
            let deviation_over_bar = |estimate: &Estimate| {
                let deviation = (estimate.value - reference.value).abs();
                // Exact answers have no bar and no deviation.
                deviation / (estimate.error + reference.error).max(f64::MIN_POSITIVE)
            };
            let found = answer.ok().map(|answer| answer.quantities[name]);
            let deviation = found.as_ref().map(deviation_over_bar);
            let outcome = match answer {
                Err(Failure::Refused(_)) => Outcome::Refused,
                Err(Failure::Unfinished(_)) => Outcome::Unfinished,
                Ok(_) if found == Some(*present) => Outcome::Same,
                Ok(_) if deviation.is_some_and(|deviation| deviation <= 1.0) => Outcome::InsideBar,
                Ok(_) => Outcome::OutsideBar,
            };
            Row {
                constant: case.constant.clone(),
                present: case.present.clone(),
                tried: tried.to_owned(),
                scene: self.scene.name.clone(),
                quantity: name.clone(),
                outcome,
                value: found.map(|found| found.value),
                value_error: found.map(|found| found.error),
                present_value: present.value,
                present_value_error: present.error,
                reference: reference.value,
                reference_error: reference.error,
                deviation_over_bar: deviation,
                present_deviation_over_bar: deviation_over_bar(present),
                unknowns: answer.ok().and_then(|answer| answer.unknowns),
                present_unknowns: self.answer.unknowns,
                iterations: answer.ok().and_then(|answer| answer.iterations),
                present_iterations: self.answer.iterations,
                processor_seconds: compared.processor_seconds,
                present_processor_seconds: compared.present_processor_seconds,
            }
        };
        self.answer.quantities.iter().map(row).collect()
    }
}

/// What the changed program made of a scene, and mean processor times of a run \[s].
struct Comparison {
    answer: Result<Answer, Failure>,
    processor_seconds: f64,
    present_processor_seconds: f64,
}
