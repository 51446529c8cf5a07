//! `run`: the answer of one scene.

mod files;
mod pictures;
mod report;
mod spectrum;
mod table;

use std::path::PathBuf;
use std::time::Instant;

use anyhow::Result;
use clap::Args;
use serde::Serialize;
use viscofriction::scene::{Method, Source};
use viscofriction::solve::{
    Answer, Omission, Plan, Problem, SolveError, check_derivatives, plan_of, problem_of, scene_of,
    spectral_sensitivity, with_fields, with_sensitivity,
};
use viscofriction::{Progress, WrongInput};

use crate::input::{half_of_free_memory, read_input, read_scene};
use crate::output::{ABOUT_WARNINGS, Format, OutputFolder, eprint_line, print_line};
use crate::progress;
pub(crate) use pictures::{arrow, range_with_zero};

/// Arguments of the command.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: viscofriction run examples/scenes/sphere-standard-solid.toml --out result"
)]
pub(crate) struct Run {
    /// The scene file, or - for the standard input; docs/scenes.md describes it.
    scene: PathBuf,
    /// Take this method instead of that of the scene.
    #[arg(long, value_enum)]
    method: Option<Method>,
    /// How the result is printed.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Say which parts of the method the scene did not need, why, and what leaving them out saves.
    #[arg(long)]
    explain: bool,
    /// Say how much the answer depends on every modulus, time, ratio, load, speed and length of the scene: d ln(quantity) by
    /// d ln(number), with error bars.
    #[arg(long)]
    sensitivity: bool,
    /// Say how much the answer depends on the storage and the loss modulus at each frequency; into the folder of --out as a
    /// picture under the master curve.
    #[arg(long)]
    spectral_sensitivity: bool,
    /// Also write result.json, fields (NPY and CSV) and pictures (SVG and PNG) into this folder.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace the answer that is in the folder already, all of its files at once.
    #[arg(long, requires = "out")]
    overwrite: bool,
}

/// An answer with its computing time.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Timed<'a> {
    #[serde(flatten)]
    answer: &'a Answer,
    /// Wall time, \[s].
    seconds: f64,
}

/// Runs the command: reads the scene, solves it, and reports the answer.
pub(crate) fn run(options: &Run) -> Result<()> {
    let source = read_scene(&options.scene)?;
    let mut problem =
        problem_of(&source, options.method, read_input)?.or_max_memory(half_of_free_memory());
    if options.out.is_some() {
        problem = problem.with_gap();
    }
    // Choose the method, and refuse derivatives that it cannot compute and an output folder that cannot be written, before the
    // computation.
    let plan = plan_of(&source, &problem)?;
    let by_numbers = options.sensitivity.then_some("--sensitivity");
    let by_moduli = options
        .spectral_sensitivity
        .then_some("--spectral-sensitivity");
    let offered = check_derivatives(&problem, plan.method(), by_numbers, by_moduli);
    offered.map_err(|error| source.locate(&error))?;
    let open = |out: &PathBuf| OutputFolder::new(out, options.overwrite, files::NAMES);
    let out = options.out.as_ref().map(open).transpose()?;
    let path = source.path().display();
    let task = format!("{path} by {}", plan.method().name());
    // Solve the problem. If the requested error is missed, the error may still contain an answer, which is kept.
    let started = Instant::now();
    let answer = progress::during(task, |watch| in_pool(plan, problem.threads(), watch));
    let seconds = started.elapsed().as_secs_f64();
    let (mut answer, mut missed) = match answer {
        Ok(answer) => (answer, None),
        Err(error) => match error.downcast_ref::<SolveError>() {
            Some(SolveError::Scene(refused)) => return Err(source.locate(refused).into()),
            Some(wrong) if wrong.is_wrong_input() => {
                return Err(WrongInput(format!("{path}: {error}")).into());
            }
            other => match other.and_then(SolveError::reached) {
                Some(reached) => (reached.clone(), Some(error)),
                None => return Err(error.context(path.to_string())),
            },
        },
    };
    // Add the derivatives that are requested, and the fields if files are written.
    if missed.is_none() {
        (answer, missed) = with_derivatives(options, (&source, &problem), answer)?;
    }
    if out.is_some() {
        let task = format!("fields of {path}");
        answer = progress::during(task, |_| with_fields(&problem, answer));
    } else {
        answer.left_out.push(Omission::Files);
    }
    let answer = &answer;
    let answer = Timed { answer, seconds };
    // Write the files before printing, because a closed pipe ends the program.
    if let Some(out) = &out {
        files::write((&source, &problem), &answer, out)?;
    }
    print(&problem, &answer, options.format)?;
    if let (Some(out), Format::Table) = (&out, options.format) {
        print_line(&format!("written into {}", out.path().display()))?;
    }
    if options.explain {
        explain(&problem, answer.answer, options.format)?;
    }
    missed.map_or(Ok(()), |error| Err(error.context(path.to_string())))
}

/// Adds the requested derivatives to the answer, or returns the error.
fn with_derivatives(
    options: &Run,
    (source, problem): (&Source, &Problem),
    mut answer: Answer,
) -> Result<(Answer, Option<anyhow::Error>)> {
    let path = source.path().display();
    if options.sensitivity {
        let scene = scene_of(source, options.method)?;
        let files = (source.folder(), read_input as _);
        let task = format!("derivatives of {path}");
        let alone = answer.clone();
        match progress::during(task, |watch| {
            with_sensitivity(&scene, files, problem, alone, watch)
        }) {
            Ok(found) => answer = found,
            Err(error) => return Ok((answer, Some(error.into()))),
        }
    }
    if options.spectral_sensitivity {
        let task = format!("derivatives of {path} by frequencies");
        match progress::during(task, |watch| spectral_sensitivity(problem, &answer, watch)) {
            Ok(found) => answer.spectral_sensitivity = Some(found),
            Err(error) => return Ok((answer, Some(error.into()))),
        }
    }
    Ok((answer, None))
}

/// Suffix of the name of a method that was chosen automatically.
const AUTOMATIC: &str = " (automatic)";

/// Solves on the number of threads that the scene requests, or on all.
fn in_pool(plan: Plan<'_>, threads: Option<usize>, watch: &dyn Progress) -> Result<Answer> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.unwrap_or(0))
        .build()?;
    Ok(pool.install(|| plan.solve(watch))?)
}

/// Prints the answer as a table or as JSON.
fn print(problem: &Problem, timed: &Timed<'_>, format: Format) -> Result<()> {
    let Timed { answer, seconds } = timed;
    match format {
        Format::Json => print_line(&serde_json::to_string_pretty(timed)?),
        Format::Table => {
            let (method, model) = (answer.method.name(), table::model(problem, answer));
            let is_chosen = problem.method().is_none();
            let automatic = if is_chosen { AUTOMATIC } else { "" };
            print_line(&format!(
                "method {method}{automatic}; {model}; {}\n",
                table::duration(*seconds)
            ))?;
            print_line(&format!("{}\n", table::listed(answer)))?;
            if let Some(parts) = table::parts(&answer.error_parts) {
                print_line(&format!("error bar: {parts}"))?;
            }
            if let Some(scatter) = table::scatter(answer) {
                print_line(&scatter)?;
            }
            if !answer.sensitivity.is_empty() {
                print_line(&format!("\n{}\n", table::sensitivity(answer)))?;
            }
            if !answer.budget.entries.is_empty() {
                print_line(&format!(
                    "standard uncertainties:\n\n{}\n",
                    table::budget(answer)
                ))?;
            }
            if let Some(spectral) = &answer.spectral_sensitivity {
                let (table, words) = spectrum::table(spectral);
                print_line(&format!("\n{table}\n{words}\n"))?;
            }
            if let Some(why) = &answer.not_reached {
                print_line(&format!("not reached: {why}"))?;
            }
            let mut warnings = answer.warnings.iter();
            warnings.try_for_each(|warning| print_line(&format!("warning: {warning}")))?;
            if !answer.warnings.is_empty() {
                print_line(&ABOUT_WARNINGS)?;
            }
            print_line(&format!("not modelled: {}", answer.not_modelled.join(", ")))
        }
    }
}

/// Prints the omissions; with JSON on the standard error, so that the standard output stays valid.
fn explain(problem: &Problem, answer: &Answer, format: Format) -> Result<()> {
    let omissions = table::omissions(problem, answer);
    match format {
        Format::Json => eprint_line(&omissions.to_string()),
        Format::Table => print_line(&format!("\nnot needed, and left out:\n{omissions}"))?,
    }
    Ok(())
}
