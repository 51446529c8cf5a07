//! `fit-friction`: fit of the moduli of a scene's material, and of its interface, to measured friction.

mod picture;

use std::path::{Path, PathBuf};

use anyhow::Result;
use clap::Args;
use measurements::MeasurementError;
use measurements::friction::{FrictionNoise, FrictionTable, FrictionTableOptions, friction_points};
use viscofriction::WrongInput;
use viscofriction::friction_fit::{
    FitProgress, FittedFriction, Free, FrictionFitError, FrictionFitOptions, FrictionPrior,
    fit_friction,
};
use viscofriction::scene::Source;
use viscofriction::solve::scene_of;

use crate::indentation::{FINDINGS, row};
use crate::input::{metres, read_input, read_scene, read_table, wrong_option};
use crate::material::wrong_table;
use crate::output::{Format, OutputFolder, markdown, print_line, print_text, to_csv};
use crate::progress;

/// Arguments of the command.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: viscofriction fit-friction examples/data/friction.csv examples/scenes/ball-on-rubber.toml --out rubber"
)]
pub(crate) struct FitFriction {
    /// Table with a line of names: v (or rpm) and mu (or friction force and normal force), and perhaps t, T, normal force, track
    /// radius and standard error, in any order, with units in the names or in the line below.
    table: PathBuf,
    /// The scene: the body, its load, a material with the moduli to begin with, and perhaps an interface. Speeds are those of the
    /// table.
    scene: PathBuf,
    /// What is sought, one or several as moduli,interface [default: interface, or moduli in a scene without an interface].
    #[arg(long, value_enum, value_delimiter = ',')]
    free: Vec<Free>,
    /// Errors of friction where the table gives no standard errors.
    #[arg(long, value_enum, default_value_t)]
    noise: FrictionNoise,
    /// What is known of the moduli before the fit: "covariance" of the material, as fit-material writes it (nothing where it has
    /// none); a relative standard deviation of all moduli that relax within its valid frequencies; or "none".
    #[arg(long, default_value = "covariance", allow_negative_numbers = true)]
    prior: FrictionPrior,
    /// Radius of the circular track in m or with a unit, as "30 mm", for rotational speeds in a table without a column of radii.
    #[arg(long, value_name = "RADIUS", value_parser = metres)]
    track_radius: Option<f64>,
    /// Time in s at the beginning of every run at constant speed that is left out of its mean, for a table over time; 0 for none.
    #[arg(long, value_name = "SECONDS")]
    run_in: Option<f64>,
    /// How the result is printed.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Where findings.csv, fit.csv, fit.svg, fit.png, material.toml and, with shear, interface.toml are written [default: a table on the standard output].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace the answer that is in the folder already, all of its files at once.
    #[arg(long, requires = "out")]
    overwrite: bool,
}

/// Names of the files that the command may write.
const NAMES: &str = "findings.csv fit.csv fit.svg fit.png interface.toml material.toml";

/// Runs the command: reads table and scene, fits, and writes the findings.
pub(crate) fn fit(options: &FitFriction) -> Result<()> {
    let read = FrictionTableOptions {
        track_radius: options.track_radius,
        run_in: options.run_in,
    };
    let FrictionTable { points, notes } = read_points(&options.table, &read)?;
    let source = read_scene(&options.scene)?;
    let scene = scene_of(&source, None)?;
    let open = |out: &PathBuf| OutputFolder::new(out, options.overwrite, NAMES);
    let out = options.out.as_ref().map(open).transpose()?;
    let sought = FrictionFitOptions {
        free: options.free.clone(),
        noise: options.noise,
        prior: options.prior,
    };
    let files = (source.folder(), read_input as _);
    let task = format!("fitting {}: ", options.table.display());
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(scene.solve.threads.unwrap_or(0))
        .build()?;
    let found = progress::with_message(|say| {
        let watch = |reached: &FitProgress| say(format!("{task}{reached}"), reached.part());
        pool.install(|| fit_friction(&scene, files, &points, &sought, &watch))
    })
    .map_err(|error| options.refused(&source, error))?;
    // Write the files before printing, because a closed pipe ends the program.
    if let Some(out) = &out {
        let curve = pool.install(|| found.curve(&scene, files));
        options.write((&found, curve), &notes, out)?;
    }
    if options.format == Format::Json {
        let mut json = serde_json::to_value(&found)?;
        json["notes"] = notes.into();
        return print_line(&serde_json::to_string_pretty(&json)?);
    }
    print_text(&options.table(&found, &notes))?;
    match &out {
        Some(out) => print_line(&format!("written into {}", out.path().display())),
        None => Ok(()),
    }
}

/// Reads a table of measured friction and protects its file from being overwritten by outputs.
pub(crate) fn read_points(
    path: &Path,
    options: &FrictionTableOptions,
) -> Result<FrictionTable, WrongInput> {
    friction_points(path, &read_table(path)?, options).map_err(wrong_table)
}

impl FitFriction {
    /// Attributes an error to the table, the scene or an option; a failed solution or fit is not invalid input.
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

    /// Writes all files; material.toml is the last.
    fn write(
        &self,
        (found, curve): (&FittedFriction, Vec<[f64; 2]>),
        notes: &[String],
        folder: &OutputFolder,
    ) -> Result<()> {
        let out = folder.begin()?;
        let findings = found.fit.findings.iter();
        let rows = findings.map(|one| (&one.name, one.unit, crate::indentation::numbers(one)));
        let header = "quantity unit value standard_error lower upper";
        out.write("findings.csv", &to_csv(header, rows)?)?;
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
        out.draw("fit", &picture::figure(found, curve, self.noise))?;
        // Write the material file last, so that its presence implies the others. Flags and findings precede the numbers as
        // comments.
        let findings = self.table(found, notes).replace('\n', "\n# ");
        let with_findings =
            |table: String| format!("# {}\n#\n# {findings}\n{table}", self.table.display());
        if let Some(interface) = found.interface_file()? {
            out.write("interface.toml", with_findings(interface).as_bytes())?;
        }
        let material = with_findings(found.material_file()?);
        out.write("material.toml", material.as_bytes())?;
        out.finish()
    }

    /// Text of the result: notes on the table, findings, and flags.
    fn table(&self, found: &FittedFriction, notes: &[String]) -> String {
        let fit = &found.fit;
        let mut table = markdown(FINDINGS);
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
        let notes: String = notes.iter().map(|note| format!("{note}\n")).collect();
        format!(
            "{notes}{table}\n{} points, {} degrees of freedom; residual {:.3e} {of}; the computed friction is off by {:.1e} of itself \
             at most\n{}\n{}",
            found.points.len(),
            fit.freedom,
            fit.residual,
            found.solver_error,
            known_in_words(found),
            flags.collect::<String>()
        )
    }
}

/// Line of the output that states what of the scene is known or kept.
fn known_in_words(found: &FittedFriction) -> String {
    let is_kept = |free: Free| !found.free.contains(&free);
    let known = match found.prior {
        _ if is_kept(Free::Moduli) => "known before: the moduli of the scene".to_owned(),
        FrictionPrior::Covariance => {
            "known before: the moduli of the scene, with the covariance of its material (--prior none leaves that out)".to_owned()
        }
        FrictionPrior::Relative(spread) => {
            format!("known before: the moduli of the scene, each to {} %", 100.0 * spread)
        }
        FrictionPrior::None => "known before: nothing".to_owned(),
    };
    if found.interface.is_some() && is_kept(Free::Interface) {
        format!("{known}; its shear strength is kept")
    } else {
        known
    }
}
