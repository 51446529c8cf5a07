//! Ranges in which the constants that steer the solvers and their error bars may change: in a copy of the
//! checkout each is read from an environment variable, and the program solves a few scenes with other values.
//!
//! The copy and all that is built from it are in `target/tuning`; the checkout itself is only read.

mod cases;
mod checkout;
mod program;
mod summary;
mod transformation;

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
use program::{Answer, Failure, Program, Tried};

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
    /// Ratio of the deviation from the reference to the sum of the error bar and the error of the reference.
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
    /// Whether the row belongs to this value of a constant.
    fn is_of(&self, tried: &Tried) -> bool {
        let case = tried.case;
        self.constant == case.constant && self.present == case.present && self.tried == tried.value
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
    let (rows, not_measured) = measure(&cases, &chosen, out.join("tuning.csv"))?;
    let mut summary = summary::summary(&chosen, &rows);
    for reason in not_measured {
        summary += &format!("\n\nNot measured: {reason}.");
    }
    Ok(Report {
        name: "tuning",
        summary,
        tables: vec![Table::new("tuning", &rows)?],
        ..Report::default()
    })
}

/// Rows of the chosen cases and all others that the file has; those that are not in the file are computed and written to it.
/// Also the scenes that are not measured, with the reason.
fn measure(cases: &Cases, chosen: &[&Case], file: PathBuf) -> Result<(Vec<Row>, Vec<String>)> {
    let mut table = GrowingTable::<Row>::open(file)?;
    let missing = |scene: &BenchmarkScene, rows: &[Row]| {
        let all = chosen.iter().flat_map(|case| case.tried());
        let missing = all.filter(|tried| {
            let is_there = |row: &Row| row.is_of(tried) && row.scene == scene.name;
            tried.case.scenes.contains(&scene.name) && !rows.iter().any(is_there)
        });
        missing.collect::<Vec<_>>()
    };
    let scenes = cases
        .scenes
        .iter()
        .map(|scene| (scene, missing(scene, &table.rows)));
    let scenes: Vec<_> = scenes.collect();
    let mut not_measured = Vec::new();
    if scenes.iter().all(|(_, tried)| tried.is_empty()) {
        return Ok((table.rows, not_measured));
    }
    let checkout = Checkout::new()?;
    checkout.update(cases)?;
    let [ordinary, adjustable] = checkout.build()?;
    for (scene, tried) in scenes.iter().filter(|(_, tried)| !tried.is_empty()) {
        let baseline = match Baseline::new(scene, &checkout, &ordinary, &adjustable) {
            Ok(baseline) => baseline,
            Err(error) => {
                not_measured.push(format!("{}: {error:#}", scene.name));
                continue;
            }
        };
        table.extend(tried, 1, |tried| {
            let compared = baseline.compare(&adjustable, *tried);
            let compared =
                compared.with_context(|| format!("{} = {}", tried.case.constant, tried.value))?;
            Ok(baseline.rows(*tried, &compared))
        })?;
    }
    Ok((table.rows, not_measured))
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
    /// The scene in the copy.
    file: PathBuf,
    answer: Answer,
    reference: Answer,
    /// Processor time after which a run is ended \[s].
    limit: f64,
}

/// Ratio of the processor time after which a run is ended to that with the present value. Chosen: a value that makes runs so slow
/// is useless.
const LIMIT_OVER_PRESENT_TIME: f64 = 20.0;
/// Shortest processor time after which a run is ended, \[s]. Chosen, so that short runs are ended rarely.
const MIN_LIMIT: f64 = 5.0;
/// Processor time, \[s], up to which runs of a scene are repeated with the present value. Chosen: the steps of 10 ms in which it
/// is counted are 5 % of it.
const MEASURED_SECONDS: f64 = 0.2;
/// Processor time, \[s], up to which runs are repeated where the ratio of both times is not close to 1. Chosen, so that a change
/// is not reported by chance.
const DOUBTED_SECONDS: f64 = 0.6;
/// Largest number of runs of a scene that is too short to be counted at all. Chosen.
const MAX_RUNS: u32 = 250;

impl<'a> Baseline<'a> {
    /// Solves a scene by both programs, whose answers must have the same bits, and its reference by the ordinary one.
    fn new(
        scene: &'a BenchmarkScene,
        checkout: &Checkout,
        ordinary: &Program,
        adjustable: &Program,
    ) -> Result<Self> {
        let answer_of = |program: &Program, file: &Path| {
            let run = program.solve(scene, file, f64::INFINITY, None)?;
            match run.answer {
                Ok(answer) => Ok((answer, run.processor_seconds)),
                Err(failure) => bail!("{}: {failure:?}", file.display()),
            }
        };
        let file = checkout.copy(&scene.file);
        let (expected, _) = answer_of(ordinary, &file)?;
        let (answer, seconds) = answer_of(adjustable, &file)?;
        let is_same = answer == expected;
        ensure!(
            is_same,
            "constants that can be changed give {answer:?} instead of {expected:?}"
        );
        let (reference, _) = answer_of(ordinary, &checkout.write_reference(scene)?)?;
        Ok(Self {
            scene,
            file,
            answer,
            reference,
            limit: (LIMIT_OVER_PRESENT_TIME * seconds).max(MIN_LIMIT),
        })
    }

    /// Solves the scene with another and with the present value in turn, so that other work on the machine slows down both
    /// alike.
    fn compare(&self, program: &Program, tried: Tried) -> Result<Comparison> {
        let mut seconds = [0.0; 2];
        let mut n_runs = 0;
        loop {
            n_runs += 1;
            let run = program.solve(self.scene, &self.file, self.limit, Some(tried))?;
            seconds[0] += run.processor_seconds;
            let present = program.solve(self.scene, &self.file, f64::INFINITY, None)?;
            seconds[1] += present.processor_seconds;
            // Average a ratio of times that looks like a change longer. The same answer in as many iterations is the same work.
            let is_close = (seconds[0] / seconds[1]).ln().abs() <= summary::MAX_TIME_RATIO.ln();
            let needed = if is_close {
                MEASURED_SECONDS
            } else {
                DOUBTED_SECONDS
            };
            let is_measured = seconds[1] >= needed || n_runs == MAX_RUNS;
            let is_same = run.answer.as_ref() == Ok(&self.answer);
            if run.answer.is_err() || is_measured || is_same {
                return Ok(Comparison {
                    answer: run.answer,
                    processor_seconds: seconds[0] / f64::from(n_runs),
                    present_processor_seconds: seconds[1] / f64::from(n_runs),
                });
            }
        }
    }

    /// A row for each quantity.
    fn rows(&self, tried: Tried, compared: &Comparison) -> Vec<Row> {
        let answer = compared.answer.as_ref();
        let row = |(name, present): (&String, &Estimate)| {
            let reference = self.reference.quantities[name];
            let deviation_over_bar = |estimate: &Estimate| {
                let deviation = (estimate.value - reference.value).abs();
                // Avoid 0/0 for exact answers, which have no bar and no deviation.
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
                constant: tried.case.constant.clone(),
                present: tried.case.present.clone(),
                tried: tried.value.to_owned(),
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

/// What became of a scene with another value, and mean processor times of a run \[s].
struct Comparison {
    answer: Result<Answer, Failure>,
    processor_seconds: f64,
    present_processor_seconds: f64,
}
