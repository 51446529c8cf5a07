//! The program `viscofriction`: scenes, sweeps, and materials and surfaces from measurements.
//!
//! Exit status: 0 success; 1 the computation failed or missed the request; 2 invalid input; 3 the result could not be written.
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

mod check;
mod friction;
mod indentation;
mod input;
mod material;
mod output;
mod page;
mod progress;
mod road;
mod run;
mod surface;
mod sweep;

use std::any::TypeId;
use std::process::ExitCode;

use clap::{Arg, CommandFactory as _, Parser, Subcommand};
use clap_complete::Shell;
pub use viscofriction::WrongInput;

pub use check::{InputKind, check_input};
use output::NotWritten;

/// Friction of rigid bodies that slide over rubber and other viscoelastic materials.
#[derive(Debug, Parser)]
#[command(
    name = "viscofriction",
    version,
    after_help = "Example: viscofriction run scene.toml --out result",
    mut_subcommands(|command| command.mut_args(with_negative_numbers))
)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

/// Lets clap pass negative numbers as values; the range of each option is checked later.
fn with_negative_numbers(option: Arg) -> Arg {
    let takes_values = option.get_action().takes_values();
    let is_number = option.get_value_parser().type_id() == TypeId::of::<f64>();
    // clap does not recognize negative numbers with a signed exponent, so allow any leading hyphen.
    option
        .allow_negative_numbers(takes_values)
        .allow_hyphen_values(is_number)
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Solve one scene.
    Run(run::Run),
    /// Solve a scene for many values of its keys: one CSV row per point, written as it is finished.
    Sweep(sweep::Sweep),
    /// Fit a Prony series to measured moduli: material.toml for a scene, CSV, SVG and PNG of data and fit.
    FitMaterial(material::FitMaterial),
    /// Find the material behind measured curves of force over depth: findings with intervals, CSV, SVG and PNG.
    FitIndentation(indentation::FitIndentation),
    /// Find the moduli of a scene's material from measured friction over speed: findings with intervals, CSV, SVG and PNG.
    FitFriction(friction::FitFriction),
    /// Say what a measured surface is like: roughness parameters, power spectra, pictures, and a tidied copy.
    Surface(surface::Surface),
    /// Solve a rough scene without its shortest waves, octave by octave: does the answer depend on where they are cut off?
    Road(road::Road),
    /// Print the JSON Schema of scene files.
    #[command(after_help = "Example: viscofriction scene-schema > scene.schema.json")]
    SceneSchema,
    /// Print what completes the commands and options of this program in a shell.
    #[command(
        after_help = "Example: viscofriction completions bash > ~/.local/share/bash-completion/completions/viscofriction"
    )]
    Completions {
        /// The shell.
        shell: Shell,
    },
}

/// The command line of the program.
pub fn command_line() -> clap::Command {
    CommandLine::command()
}

/// Parses the command line and runs its command; the exit status is that of docs/output.md, "Exit status".
pub fn execute() -> ExitCode {
    let result = match CommandLine::try_parse() {
        Ok(line) => line.command.execute(),
        // Help and version are ordinary output, which the parser reports as errors; they go to the standard output.
        Err(asked) if !asked.use_stderr() => output::printed(|| asked.print()),
        Err(wrong) => wrong.exit(),
    };
    match result {
        Err(error) if !output::is_closed_pipe(&error) => {
            output::eprint_line(&format!("error: {error:#}"));
            ExitCode::from(status(&error))
        }
        _ => ExitCode::SUCCESS,
    }
}

/// Exit status of an error: 2 for wrong input, 3 for a result that could not be written, 1 for a computation that failed.
fn status(error: &anyhow::Error) -> u8 {
    if error.is::<WrongInput>() {
        2
    } else if error.is::<NotWritten>() {
        3
    } else {
        1
    }
}

impl Command {
    /// Runs the chosen command to its end, including its output.
    fn execute(self) -> anyhow::Result<()> {
        match self {
            Self::Run(options) => run::run(&options),
            Self::Sweep(options) => sweep::sweep(&options),
            Self::FitMaterial(options) => material::fit(&options),
            Self::FitIndentation(options) => indentation::fit(&options),
            Self::FitFriction(options) => friction::fit(&options),
            Self::Surface(options) => surface::describe(&options),
            Self::Road(options) => road::road(&options),
            Self::SceneSchema => scene_schema(),
            Self::Completions { shell } => completions(shell),
        }
    }
}

/// Prints the JSON Schema of scene files.
fn scene_schema() -> anyhow::Result<()> {
    output::print_text(&viscofriction::scene::json_schema()?)
}

/// Prints the completion script of a shell.
fn completions(shell: Shell) -> anyhow::Result<()> {
    let (mut script, mut command) = (Vec::new(), command_line());
    clap_complete::generate(shell, &mut command, "viscofriction", &mut script);
    output::print_text(&String::from_utf8(script)?)
}
