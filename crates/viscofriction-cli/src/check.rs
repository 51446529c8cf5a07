//! Validation of input files without running a command.

use std::path::Path;

use measurements::friction::{FrictionTableOptions, friction_points};
use measurements::indentation::{CurveOptions, indentation_curve};
use viscofriction::WrongInput;
use viscofriction::indenters::topography::{Topography, TopographyError};
use viscofriction::scene::{Source, in_file, profile};
use viscofriction::solve::{plan_of, problem_of};

use crate::input::read_input;
use crate::material::{check_table, wrong_table};
use crate::sweep::TableFile;

/// A kind of file that the commands read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InputKind {
    /// A scene of `run` and `sweep`.
    Scene,
    /// A table of radii and heights that a scene names.
    Profile,
    /// A height map that a scene names.
    HeightMap,
    /// Measured moduli of `fit-material`.
    Moduli,
    /// Measured force over depth of `fit-indentation`.
    Curve,
    /// Measured friction over speed of `fit-friction`.
    Friction,
    /// Rows of a sweep for `sweep --resume` and `sweep --merge`.
    SweepRows,
}

/// Validates the contents of a `file` like the command that reads it, up to the start of the computation.
///
/// The file need not exist; files that a scene names are read from its folder.
///
/// # Errors
/// [`WrongInput`] with file and line.
pub fn check_input(kind: InputKind, file: &Path, contents: &[u8]) -> Result<(), WrongInput> {
    match kind {
        InputKind::Scene => {
            let source = Source::new(file, contents.to_vec())?;
            let problem = problem_of(&source, None, read_input)?;
            plan_of(&source, &problem).map(drop)
        }
        InputKind::Profile => profile(file, contents).map(drop).map_err(WrongInput),
        InputKind::HeightMap => {
            let extension = file.extension().unwrap_or_default().to_string_lossy();
            let read = |spacing| Topography::read(&extension, contents, spacing, u64::MAX);
            // Read the surface without a given spacing first. Texts may state their size and measured surfaces their spacing;
            // other formats need one, for which any number serves here.
            let surface = match read(None) {
                Err(TopographyError::Spacing { .. }) => read(Some([1.0; 2])),
                other => other,
            }
            .map_err(|error| WrongInput(in_file(file, &error)))?;
            // The error concerns the whole surface, so it names line 1.
            let wrong = |error| WrongInput(format!("{}:1: {error}", file.display()));
            surface.body().map(drop).map_err(wrong)
        }
        InputKind::Moduli => check_table(file, contents),
        InputKind::Curve => {
            // The spring constant may be missing from the table and be given on the command line later; any number serves for the
            // check.
            let options = CurveOptions {
                spring_constant: Some(1.0),
                ..CurveOptions::default()
            };
            let curve = indentation_curve(file, contents, &options);
            curve.map(drop).map_err(wrong_table)
        }
        InputKind::Friction => {
            let points = friction_points(file, contents, &FrictionTableOptions::default());
            points.map(drop).map_err(wrong_table)
        }
        InputKind::SweepRows => TableFile::new(file, contents)?.check(file),
    }
}
