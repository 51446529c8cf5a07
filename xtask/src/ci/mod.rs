//! `ci`: everything that CI checks, one step after the other.
//!
//! All builds use the profile `ci`, so that everything is compiled once.

mod book;
mod cargo;
mod dependencies;
mod release;
mod workspace;

use std::process::Command;
use std::time::Instant;

use anyhow::{Context, Result};

use crate::figures;
use cargo::{Cargo, run as run_program};
pub(crate) use cargo::{cargo, output, workspace_root};
pub(crate) use dependencies::{Dependencies, write as write_dependencies};
pub(crate) use release::release;
use workspace::Workspace;

/// Arguments of cargo that select what is published on crates.io.
const PACKAGES: &str = "--workspace --exclude xtask --exclude benches --exclude casebook --exclude viscofriction-python";

/// Runs all steps up to the first that fails; the last line printed counts the tests.
pub(crate) fn run() -> Result<()> {
    let mut cargo = Cargo::default();
    let result = steps(&mut cargo);
    println!("{cargo}");
    result
}

/// Runs one step after the other, up to the first that fails.
fn steps(cargo: &mut Cargo) -> Result<()> {
    let workspace = Workspace::read()?;
    let all = "--profile ci --workspace --all-features";
    step("format", || cargo.run("fmt --all --check"))?;
    step("dependencies", || dependencies::check(&workspace))?;
    step("clippy", || {
        if lints_while_compiling() {
            // What the tests need is compiled anyway, and checked on the way.
            cargo.run(&format!("build {all} --all-targets"))
        } else {
            cargo.run(&format!("clippy {all} --all-targets -- --deny=warnings"))
        }
    })?;
    step("tests", || cargo.test("--workspace --all-features"))?;
    step("benchmarks, once each", || {
        cargo.run(&format!("test {all} --bench=*"))
    })?;
    step("examples", || {
        cargo.run(&format!("build {all} --examples"))?;
        let mut programs = workspace.example_files().map(Command::new);
        programs.try_for_each(|mut program| run_program(&mut program))
    })?;
    step("crates alone, without features", || {
        // Check each library alone, because crates that are built together unite their features.
        workspace.libraries().try_for_each(|library| {
            cargo.run(&format!(
                "check --profile ci --no-default-features --all-targets --package {library}"
            ))
        })
    })?;
    step("documentation", || {
        let deny = "--config=build.rustdocflags=[\"--deny=warnings\"]";
        cargo.run(&format!("doc {all} --no-deps {deny}"))
    })?;
    step("packages", || {
        // Pack what would be published, without compiling it once more.
        cargo.run(&format!(
            "package {PACKAGES} --no-verify --allow-dirty --offline"
        ))
    })?;
    step("figures", figures::check)
}

/// True if every build lints, because cargo calls clippy's compiler for the crates of the workspace (`.ci/run`).
fn lints_while_compiling() -> bool {
    std::env::var_os("RUSTC_WORKSPACE_WRAPPER").is_some_and(|compiler| compiler == "clippy-driver")
}

/// Announces a step, runs it, and says how long it took.
fn step(name: &str, check: impl FnOnce() -> Result<()>) -> Result<()> {
    println!("\n=== {name}");
    let start = Instant::now();
    check().with_context(|| format!("the step `{name}` failed"))?;
    println!("=== {name}: {:.1} s", start.elapsed().as_secs_f64());
    Ok(())
}
