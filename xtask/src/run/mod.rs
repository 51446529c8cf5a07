//! `run`: one scene, one answer.

mod analytic;
mod answer;
mod bem;
mod body;
mod error_parts;
mod explain;
mod files;
mod fresh_folder;
mod half_space;
mod line_contact;
mod march;
mod mdr;
mod memory;
mod offer;
mod omission;
mod pictures;
mod pressing;
mod question;
mod resolution;
mod same_problem;
mod savings;
mod shape;
mod solve;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};

pub(crate) use answer::Answer;
pub(crate) use body::{Body, Revolution};
pub(crate) use offer::{NotOffered, choose};
use omission::Omission;
pub(crate) use question::Question;
pub(crate) use solve::solve;

use crate::output::{WrongInput, print_line};
use crate::progress;
use crate::scene_file::{Method, SceneError, Source, scene_file};

/// Arguments of the command.
#[derive(Debug, Args)]
pub(crate) struct Run {
    /// The scene file; docs/scenes.md describes it.
    scene: PathBuf,
    /// Take this method instead of that of the scene.
    #[arg(long, value_enum)]
    method: Option<Method>,
    /// How the result is printed.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Say which parts of the method the scene did not need, and measure what that saves by doing them too.
    #[arg(long)]
    explain: bool,
    /// Also write result.json, fields (NPY and CSV) and pictures (SVG and PNG) into this folder.
    #[arg(long)]
    out: Option<PathBuf>,
}

/// How a result is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Table,
    Json,
}

/// Reads the scene, solves it, and prints the answer.
pub(crate) fn run(options: &Run) -> Result<()> {
    let source = Source::read(&options.scene)?;
    let (question, method) = plan(&source, options.method)?;
    let bar = progress::spinner(format!("{} by {}", source.path().display(), method.name()));
    let answer = solve(&question);
    bar.finish_and_clear();
    let mut answer = answer.with_context(|| format!("{}", source.path().display()))?;
    if options.out.is_none() {
        answer.left_out.push(Omission::Files);
    }
    print(&answer, options, question.method.is_none())?;
    if let Some(out) = &options.out {
        files::write(&answer, out)?;
        if options.format == Format::Table {
            print_line(&format!("written into {}", out.display()))?;
        }
    }
    if options.explain {
        explain(&question, &answer, options.format)?;
    }
    Ok(())
}

/// What a scene asks, and the method that answers it: the one given, that of the scene, or the cheapest.
///
/// # Errors
/// [`WrongInput`] with the place where the scene is wrong.
pub(crate) fn plan(
    source: &Source,
    method: Option<Method>,
) -> Result<(Question, Method), WrongInput> {
    let located = |error: SceneError| source.locate(&error);
    let mut scene = scene_file(source.table()?).map_err(located)?;
    scene.solve.method = method.or(scene.solve.method);
    let question = Question::new(&scene, folder(source)).map_err(located)?;
    let method = choose(&question).map_err(|error| not_offered(source, &error))?;
    Ok((question, method))
}

/// Where the files are that a scene names.
pub(crate) fn folder(source: &Source) -> &Path {
    source.path().parent().unwrap_or(Path::new(""))
}

/// A combination that is not offered is wrong input, at the method or at the whole scene.
pub(crate) fn not_offered(source: &Source, error: &NotOffered) -> WrongInput {
    let key = match error {
        NotOffered::Method { .. } => "solve.method",
        NotOffered::AnyMethod { .. } => "indenter",
        NotOffered::Material(_) => "material",
    };
    source.locate(&SceneError::together(key, error.to_string()))
}

fn print(answer: &Answer, options: &Run, chosen: bool) -> Result<()> {
    match options.format {
        Format::Json => {
            print_line(&serde_json::to_string_pretty(answer)?)?;
        }
        Format::Table => {
            let (method, model) = (answer.method.name(), answer.model_name());
            let seconds = answer.seconds;
            let why = if chosen {
                ", the cheapest that answers the scene"
            } else {
                ""
            };
            print_line(&format!("{method}{why}; {model}; {seconds:.3} s"))?;
            print_line(&answer.table())?;
            if let Some(parts) = answer.error_parts.in_words() {
                print_line(&format!("error bar: {parts}"))?;
            }
        }
    }
    Ok(())
}

/// Measures what the scene did not need; a result as JSON stays alone on the standard output.
fn explain(question: &Question, answer: &Answer, format: Format) -> Result<()> {
    let bar = progress::spinner("measuring what was left out".to_owned());
    let omissions = explain::table(question, answer);
    bar.finish_and_clear();
    let omissions = omissions?;
    match format {
        Format::Json => eprintln!("{omissions}"),
        Format::Table => print_line(&format!("\nnot needed, and left out:\n{omissions}"))?,
    }
    Ok(())
}
