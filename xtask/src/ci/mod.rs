//! `ci`: everything that CI checks.
//!
//! All builds use the profile `ci`, so that everything is compiled once. What is printed by checks that run beside the tests is
//! shown step by step.

mod book;
mod cargo;
mod dependencies;
mod documentation;
mod release;
mod workspace;

use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::Instant;

use anyhow::{Context, Result, anyhow};

use crate::figures;
use cargo::Transcript;
pub(crate) use cargo::{cargo, output, workspace_root};
pub(crate) use dependencies::{Dependencies, write as write_dependencies};
pub(crate) use documentation::as_rustdoc;
pub(crate) use release::release;
use workspace::Workspace;

/// Arguments of cargo that select what is published on crates.io.
const PACKAGES: &str = "--workspace --exclude xtask --exclude benches --exclude casebook --exclude viscofriction-python";

/// Arguments of cargo with which everything is compiled, once for all steps.
const ALL: &str = "--profile ci --workspace --all-features";

/// Runs all steps; the last line printed counts the tests.
pub(crate) fn run() -> Result<()> {
    let mut transcripts = [Transcript::default(), Transcript::held()];
    let result = steps(&mut transcripts);
    let [tests, checks] = transcripts.map(|transcript| transcript.tests);
    println!("{}", tests.plus(checks));
    result
}

/// Compiles everything, then runs the tests and, at the same time, the other checks. Each of the two ends at its first step that
/// fails. The transcripts are those of the tests and of the other checks.
fn steps([shown, held]: &mut [Transcript; 2]) -> Result<()> {
    let workspace = Workspace::read()?;
    compile(shown, &workspace)?;
    // Most of the other checks compile crate after crate on one core, and at the end few tests are left.
    let [tests, checks] = thread::scope(|scope| {
        let checks = scope.spawn(|| other_checks(held, &workspace));
        let tests = tests(shown);
        let panicked = |_| Err(anyhow!("a check panicked"));
        [tests, checks.join().unwrap_or_else(panicked)]
    });
    match (tests, checks) {
        (Err(tests), Err(checks)) => Err(anyhow!("{tests:#}; {checks:#}")),
        (tests, checks) => tests.and(checks),
    }
}

/// Checks the format and the dependencies, and compiles and lints what all later steps need.
fn compile(transcript: &mut Transcript, workspace: &Workspace) -> Result<()> {
    step(transcript, "format", |transcript| {
        transcript.cargo("fmt --all --check")
    })?;
    step(transcript, "dependencies", |_| {
        dependencies::check(workspace)
    })?;
    step(transcript, "clippy", |transcript| {
        if lints_while_compiling() {
            // What the tests need is compiled anyway, and checked on the way.
            transcript.cargo(&format!("build {ALL} --all-targets"))
        } else {
            transcript.cargo(&format!("clippy {ALL} --all-targets -- --deny=warnings"))
        }
    })
}

/// Runs the tests but those of the documentation, by nextest if it is installed; and recomputes figures.
fn tests(transcript: &mut Transcript) -> Result<()> {
    step(transcript, "tests", |transcript| {
        let scope = "--no-fail-fast --workspace --all-features";
        if output(&mut cargo("nextest --version")).is_ok() {
            transcript.cargo(&format!("nextest run --cargo-profile ci {scope}"))
        } else {
            transcript.cargo(&format!("test --profile ci --tests {scope}"))
        }
    })?;
    step(transcript, "figures", |_| figures::check())
}

/// Runs the steps that compile more than the tests need.
fn other_checks(transcript: &mut Transcript, workspace: &Workspace) -> Result<()> {
    step(transcript, "documentation", |transcript| {
        transcript.run(documentation::command(ALL, workspace)?)
    })?;
    step(transcript, "benchmarks, once each", |transcript| {
        transcript.cargo(&format!("test {ALL} --bench=*"))
    })?;
    step(transcript, "examples", |transcript| {
        transcript.cargo(&format!("build {ALL} --examples"))?;
        let mut programs = workspace.example_files().map(Command::new);
        programs.try_for_each(|program| transcript.run(program))
    })?;
    step(transcript, "crates alone, without features", |transcript| {
        // Check each library alone, because crates that are built together unite their features.
        workspace.libraries().try_for_each(|library| {
            transcript.cargo(&format!(
                "check --profile ci --no-default-features --all-targets --package {library}"
            ))
        })
    })?;
    step(transcript, "packages", |transcript| {
        // Pack what would be published, without compiling it once more.
        transcript.cargo(&format!(
            "package {PACKAGES} --no-verify --allow-dirty --offline"
        ))
    })
}

/// True if every build lints, because cargo calls clippy's compiler for the crates of the workspace (`.ci/run`).
fn lints_while_compiling() -> bool {
    let compiler = std::env::var_os("RUSTC_WORKSPACE_WRAPPER");
    compiler.is_some_and(|path| Path::new(&path).file_name() == Some("clippy-driver".as_ref()))
}

/// Announces a step, runs it, and says how long it took.
fn step(
    transcript: &mut Transcript,
    name: &str,
    check: impl FnOnce(&mut Transcript) -> Result<()>,
) -> Result<()> {
    transcript.add(&format!("\n=== {name}"));
    let start = Instant::now();
    let result = check(transcript).with_context(|| format!("the step `{name}` failed"));
    let seconds = start.elapsed().as_secs_f64();
    transcript.add(&format!("=== {name}: {seconds:.1} s"));
    transcript.show();
    result
}
