//! `fit-friction`: the moduli of a scene's material from measured friction.

mod picture;

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use measurements::MeasurementError;
use measurements::friction::{FrictionNoise, friction_points};
use viscofriction::WrongInput;
use viscofriction::friction_fit::{
    FittedFriction, Free, FrictionFitError, FrictionFitOptions, fit_friction,
};
use viscofriction::scene::Source;
use viscofriction::solve::scene_of;

use crate::indentation::row;
use crate::input::{read_input, read_scene, read_table, wrong_option};
use crate::material::wrong_table;
use crate::output::{Format, OutputFolder, markdown, print_line, print_text, to_csv};
use crate::progress;

/// Arguments of the command.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: viscofriction fit-friction examples/data/friction.csv examples/scenes/ball-on-rubber.toml --out rubber"
)]
pub(crate) struct FitFriction {
    /// Table with a line of names: v and mu (or friction force and normal force), and perhaps T, normal force and standard error,
    /// in any order, with units in the names or in the line below.
    table: PathBuf,
    /// The scene: the body, its load, and a material with the moduli to begin with. Speeds are those of the table.
    scene: PathBuf,
    /// What of the material is sought.
    #[arg(long, value_enum, default_value_t)]
    free: Free,
    /// Errors of friction where the table gives no standard errors.
    #[arg(long, value_enum, default_value_t)]
    noise: FrictionNoise,
    /// Relative spread of the moduli about those of the scene that is known beforehand, of elements that relax within the valid
    /// frequencies of the material.
    #[arg(long, value_name = "RELATIVE")]
    prior: Option<f64>,
    /// How the result is printed.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Where findings.csv, fit.csv, fit.svg, fit.png and material.toml are written [default: a table on the standard output].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace the answer that is in the folder already, all of its files at once.
    #[arg(long, requires = "out")]
    overwrite: bool,
}

const NAMES: &str = "findings.csv fit.csv fit.svg fit.png material.toml";

/// Reads table and scene, fits, and writes what the friction says.
pub(crate) fn fit(options: &FitFriction) -> Result<()> {
    let points = friction_points(&options.table, &read_table(&options.table)?);
    let points = points.map_err(wrong_table)?;
    let source = read_scene(&options.scene)?;
    let scene = scene_of(&source, None)?;
    let open = |out: &PathBuf| OutputFolder::new(out, options.overwrite, NAMES);
    let out = options.out.as_ref().map(open).transpose()?;
    let sought = FrictionFitOptions {
        free: options.free,
        noise: options.noise,
        prior: options.prior,
    };
    let files = (source.folder(), read_input as _);
    let task = format!("fitting {}", options.table.display());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(scene.solve.threads.unwrap_or(0));
    let pool = pool.build()?;
    let found = progress::during(task, |_| {
        pool.install(|| fit_friction(&scene, files, &points, &sought))
    });
    let found = found.map_err(|error| options.refused(&source, error))?;
    // Before anything is printed, because a pipe that is closed ends the program.
    if let Some(out) = &out {
        options.write(&found, out)?;
    }
    match (options.format, &out) {
        (Format::Json, _) => print_line(&serde_json::to_string_pretty(&found)?),
        (Format::Table, None) => print_text(&options.table(&found)),
        (Format::Table, Some(out)) => {
            print_text(&options.table(&found))?;
            print_line(&format!("written into {}", out.path().display()))
        }
    }
}

impl FitFriction {
    /// Wrong input with the file that is wrong; what was not solved or did not converge is none.
    fn refused(&self, scene: &Source, error: FrictionFitError) -> anyhow::Error {
        match error {
            FrictionFitError::Scene(error) => scene.locate(&error).into(),
            FrictionFitError::Points(MeasurementError::InvalidParameter(refused)) => {
                wrong_option(refused).into()
            }
            FrictionFitError::Points(error) => {
                WrongInput(format!("{}: {error}", self.table.display())).into()
            }
            other => anyhow::Error::new(other).context(self.table.display().to_string()),
        }
    }

    fn write(&self, found: &FittedFriction, folder: &OutputFolder) -> Result<()> {
        let out = folder.begin()?;
        let findings = found.fit.findings.iter();
        let findings = findings.map(|one| (&one.name, one.unit, crate::indentation::numbers(one)));
        let header = "quantity unit value standard_error lower upper";
        out.write("findings.csv", &to_csv(header, findings)?)?;
        let points = found.points.iter().zip(&found.shifted_velocities);
        let rows = points
            .zip(&found.fit.fitted)
            .map(|((point, shifted), fitted)| {
                let measured = point.friction_coefficient;
                let of_point = (point.velocity, point.temperature, point.normal_force);
                (
                    of_point,
                    shifted,
                    measured,
                    point.standard_error,
                    fitted,
                    measured - fitted,
                )
            });
        let header = "velocity_m_per_s temperature_c normal_force_n shifted_velocity_m_per_s friction_coefficient \
                      standard_error friction_coefficient_fit residual";
        out.write("fit.csv", &to_csv(header, rows)?)?;
        out.draw("fit", &picture::figure(found))?;
        // Last: with it the others are there. What is not determined is said in front of the numbers.
        let findings = self.table(found).replace('\n', "\n# ");
        let material = found.material_file()?;
        let material = format!("# {}\n#\n# {findings}\n{material}", self.table.display());
        out.write("material.toml", material.as_bytes())?;
        out.finish()
    }

    /// What was found, and what is doubtful.
    fn table(&self, found: &FittedFriction) -> String {
        let fit = &found.fit;
        let mut table = markdown("quantity | value | standard error | 95 % interval | unit");
        for finding in &fit.findings {
            table.add_row(row(&finding.name, 1.0, finding));
        }
        let is_given = found
            .points
            .iter()
            .all(|point| point.standard_error.is_some());
        let of = match (is_given, self.noise) {
            (true, _) => "of the standard errors",
            (false, FrictionNoise::Relative) => "of the friction",
            (false, FrictionNoise::Absolute) => "in the friction coefficient",
        };
        let flags = fit.flags.iter().map(|flag| format!("flag: {flag}\n"));
        format!(
            "{table}\n{} points, {} degrees of freedom; residual {:.3e} {of}; the computed friction is off by {:.1e} of itself \
             at most\n{}",
            found.points.len(),
            fit.freedom,
            fit.residual,
            found.solver_error,
            flags.collect::<String>()
        )
    }
}
