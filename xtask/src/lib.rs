//! Commands of the workspace: figures, scaling factors, evidence, dependencies, checks.
//!
//! Exit status: 0 done; 1 the computation could not reach what was asked; 2 the input was wrong.
//!
//! Words in this crate: *the paper* is Kürschner, "Friction between a rigid body and a model elastomer having a linear viscous
//! rheology", ZAMM 94 (2014), whose equations are cited by number. The *line* is its one-dimensional model, the *chain* that
//! model solved element by element, a *bar* the error bar of a number. An *experiment* of `evidence` is a set of computations.
#![cfg_attr(not(test), warn(unused_crate_dependencies))]
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "this crate talks to a person at a terminal"
)]

mod ci;
mod evidence;
mod figures;
mod kinds;
mod meter;
mod output;
mod picture;
mod random;
mod scaling;
mod scene;
mod table;
mod tasks;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

// This crate is a dependency only to choose its features: see Cargo.toml.
use measurements as _;

pub use output::WrongInput;

/// Friction of rigid indenters on viscous half spaces.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Recompute every figure of the paper and the table of scaling factors: CSV, SVG and PNG.
    ReproduceFigures {
        /// Where the files are written.
        #[arg(long, default_value = "target/figures", conflicts_with = "check")]
        out: PathBuf,
        /// Write nothing; recompute a part of the data and compare it with docs/figures.
        #[arg(long)]
        check: bool,
    },
    /// Compute the converged scaling factor s_p between the half space and the one-dimensional model.
    ScalingFactors {
        /// Exponent p > 1/2 of the profile c r^p; may be given several times.
        #[arg(long = "exponent", value_name = "P", default_values_t = [1.0, 2.0])]
        exponents: Vec<f64>,
        /// Relative error asked for, between 1e-6 and 0.1; where 100 000 unknown pressures do not reach it, the command
        /// says how far it came.
        #[arg(long, default_value_t = 1e-3, value_name = "E")]
        relative_error: f64,
        /// How the factors are printed.
        #[arg(long, value_enum, default_value_t)]
        format: scaling::Format,
    },
    /// Compute the function s(p) that friction-analytic interpolates; takes long, and goes on where it was interrupted.
    ScalingTable {
        /// Where the source file is written; what is there already is not computed again.
        #[arg(long, default_value = "target/scaling-table")]
        out: PathBuf,
    },
    /// Measure anew how stable, accurate and expensive the methods are: CSV, SVG, PNG and Markdown.
    Evidence(evidence::Evidence),
    /// Count what each library crate pulls in when it is built alone. Markdown.
    Dependencies(ci::Dependencies),
    /// Write the files that list all bodies and materials: the schema of the scene, tables of keys in docs, Python classes.
    Kinds,
    /// Make everything that is published, and try each part where nothing of the workspace is installed.
    Release {
        /// A new folder for packed crates, wheel, source distribution and book.
        #[arg(long, default_value = "target/published")]
        out: PathBuf,
    },
    /// Run everything that CI checks.
    Ci,
}

/// Parses the command line and runs its command; the exit code is 0 if it succeeds.
pub fn execute() -> ExitCode {
    if let Some(code) = ci::as_rustdoc() {
        return code;
    }
    let outcome = match CommandLine::parse().command {
        Command::ReproduceFigures { check: true, .. } => figures::check(),
        Command::ReproduceFigures { out, .. } => figures::reproduce(&out),
        Command::ScalingFactors {
            exponents,
            relative_error,
            format,
        } => scaling::print(&exponents, relative_error, format),
        Command::ScalingTable { out } => scaling::generate_table(&out),
        Command::Evidence(options) => evidence::evidence(options),
        Command::Dependencies(options) => ci::write_dependencies(&options),
        Command::Kinds => kinds::write(),
        Command::Release { out } => ci::release(&out),
        Command::Ci => ci::run(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            let wrong_input = error.downcast_ref::<WrongInput>().is_some();
            ExitCode::from(if wrong_input { 2 } else { 1 })
        }
    }
}
