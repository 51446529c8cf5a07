//! `ci`: everything that CI checks, one step after the other.
//!
//! All builds use the release profile, because `cargo xtask` itself has compiled nearly everything with it. Tests of the
//! whole workspace share that; tests of single crates compile what they use with fewer features and more checks.

mod command;
mod dependencies;
mod invariants;
mod test_counts;

use std::time::Instant;

use anyhow::{Context, Result};

use crate::figures;
use command::{cargo, cargo_test};
pub(crate) use dependencies::{Dependencies, measure};
use test_counts::TestCounts;

/// What can be published.
const LIBRARIES: [&str; 6] = [
    "viscofriction-numerics",
    "indenters",
    "rheology",
    "friction-analytic",
    "mdr-core",
    "bem-halfspace",
];

/// Runs all steps up to the first that fails; the last line printed counts the tests.
pub(crate) fn run() -> Result<()> {
    let mut counts = TestCounts::default();
    let outcome = steps(&mut counts);
    if counts.any() {
        println!("{counts}");
    }
    outcome
}

fn steps(counts: &mut TestCounts) -> Result<()> {
    step("format", || cargo(&["fmt", "--all", "--check"], &[]))?;
    step("clippy", clippy)?;
    step("tests", || all_tests(counts))?;
    step("tests without default features", || lean_tests(counts))?;
    step("documentation", documentation)?;
    step("architecture invariants", invariants::check)?;
    step("dependencies", dependencies::check)?;
    step("packages", package)?;
    step("figures", figures::check)
}

/// Announces a step, runs it, and says how long it took.
fn step(name: &str, check: impl FnOnce() -> Result<()>) -> Result<()> {
    println!("\n=== {name}");
    let start = Instant::now();
    check().with_context(|| format!("the step `{name}` failed"))?;
    println!("=== {name}: {:.1} s", start.elapsed().as_secs_f64());
    Ok(())
}

fn clippy() -> Result<()> {
    let scope = [
        "clippy",
        "--release",
        "--workspace",
        "--all-targets",
        "--all-features",
    ];
    cargo(&[&scope[..], &["--", "--deny=warnings"]].concat(), &[])
}

/// With all targets the benchmarks run too, once each; only then the examples in the documentation need a call of their
/// own.
fn all_tests(counts: &mut TestCounts) -> Result<()> {
    ["--all-targets", "--doc"]
        .iter()
        .try_for_each(|targets| test(&["--workspace", "--all-features", targets], counts))
}

/// The checks that a release build leaves out, in the crates of the workspace, which have to be compiled anew anyway.
const DEBUG_ASSERTIONS: [&str; 2] = [
    "--config=profile.release.debug-assertions=true",
    "--config=profile.release.package.\"*\".debug-assertions=false",
];

/// One crate at a time, because crates that are built together unite their features.
fn lean_tests(counts: &mut TestCounts) -> Result<()> {
    LIBRARIES.iter().try_for_each(|library| {
        let scope = ["--package", library, "--no-default-features"];
        test(&[&scope[..], &DEBUG_ASSERTIONS].concat(), counts)
    })
}

fn test(scope: &[&str], counts: &mut TestCounts) -> Result<()> {
    cargo_test(scope, |line| counts.read(line))
}

fn documentation() -> Result<()> {
    cargo(
        &[
            "doc",
            "--release",
            "--workspace",
            "--no-deps",
            "--all-features",
        ],
        &[("RUSTDOCFLAGS", "--deny=warnings")],
    )
}

/// Packs what would be published, without compiling it once more.
fn package() -> Result<()> {
    let mut arguments = vec!["package", "--no-verify", "--allow-dirty", "--offline"];
    for library in LIBRARIES {
        arguments.extend(["--package", library]);
    }
    cargo(&arguments, &[])
}
