//! `fit-indentation`: fit of a material to measured curves of force over depth.

mod picture;

use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow};
use clap::Args;
use measurements::indentation::{
    CurveFile, CurveOptions, FitOptions, IndentationFit, Rheology, Thickness, fit_indentation,
    indentation_curve,
};
use measurements::{Finding, MeasurementError};
use rayon::prelude::*;
use rheology::Material as _;
use viscofriction::indenters::{Axisymmetric, FlatPunch, IndenterError, PowerProfile, Sphere};
use viscofriction::numerics::{Rounded, in_range, positive};
use viscofriction::{Estimate, WrongInput};

use crate::input::{check_file, metres, read_table, wrong_option};
use crate::material::{prony, wrong_table};
use crate::output::{OutputFolder, markdown, print_line, print_text, to_csv};
use crate::progress;

/// Arguments of the command.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: viscofriction fit-indentation curve.csv --sphere 5e-6 --out gel\n\
    Example: viscofriction fit-indentation map/*.csv --pyramid 35 --before-retraction --out map"
)]
pub(crate) struct FitIndentation {
    /// Tables with a line of names: t, force and depth, in any order; or piezo (towards the sample) or height (away from
    /// it), and deflection, with --spring-constant. Units are in the names or in the line below. Text exports of JPK,
    /// NanoScope, Asylum, AFM Workshop, afmformats and nanoindenters are such tables; what was guessed about them is
    /// printed. Several are a map: one row each, in curves.csv.
    #[arg(required = true)]
    curves: Vec<PathBuf>,
    #[command(flatten)]
    body: Body,
    /// The material. Where the curve does not determine how it relaxes, the elastic one is given instead.
    #[arg(long, value_enum, default_value = "standard-solid")]
    material: Rheology,
    /// Branches of a Prony series [default: as many as the curve tells apart].
    #[arg(long, value_name = "N")]
    branches: Option<usize>,
    /// Poisson ratio.
    #[arg(long, default_value_t = 0.5, value_name = "NU")]
    poisson_ratio: f64,
    /// Thickness of the sample in m or with a unit, which is bonded to a rigid base, or "fit" to find it with the material
    /// [default: so thick that it is a half space].
    #[arg(long, value_name = "THICKNESS", value_parser = thickness)]
    thickness: Option<Thickness>,
    /// Stiffness of the cantilever in N/m [default: what the table says].
    #[arg(long, value_name = "N/m")]
    spring_constant: Option<f64>,
    /// Deflection per volt in m/V.
    #[arg(long, value_name = "m/V")]
    sensitivity: Option<f64>,
    /// Ramps per second, there and back, where a table has the two halves of a ramp and no times (NanoScope: the columns
    /// that end in _Ex and _Rt; AFM Workshop: Extend and Retract).
    #[arg(long, value_name = "1/s")]
    ramp_rate: Option<f64>,
    /// Fit up to the deepest point only: most bodies stick on the way back.
    #[arg(long)]
    before_retraction: bool,
    /// Keep the force without contact the same at all depths.
    #[arg(long)]
    no_tilt: bool,
    /// Where findings.csv, correlation.csv, fit.csv, fit.svg, fit.png and material.toml are written, of several curves
    /// curves.csv [default: a table on the standard output].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace the answer that is in the folder already, all of its files at once.
    #[arg(long, requires = "out")]
    overwrite: bool,
}

/// The body; angles are in degrees.
#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
struct Body {
    /// Sphere of this radius in m or with a unit, as "5 um".
    #[arg(long, value_name = "RADIUS", value_parser = metres)]
    sphere: Option<f64>,
    /// Paraboloid of this radius of curvature at its tip in m or with a unit.
    #[arg(long, value_name = "RADIUS", value_parser = metres)]
    paraboloid: Option<f64>,
    /// Cone of this angle between axis and flank in degrees.
    #[arg(long, value_name = "ANGLE")]
    cone: Option<f64>,
    /// Four-sided pyramid of this angle between axis and face in degrees, as the cone of the same elastic force.
    #[arg(long, value_name = "ANGLE")]
    pyramid: Option<f64>,
    /// Flat end of this radius in m or with a unit.
    #[arg(long, value_name = "RADIUS", value_parser = metres)]
    flat_punch: Option<f64>,
}

impl Body {
    /// The indenter that the options describe; an error names the option.
    fn shape(&self) -> Result<Box<dyn Axisymmetric>, WrongInput> {
        let slope = |parameter, value: f64| {
            let allowed = "greater than 0 and less than 90 degrees";
            let holds = value > 0.0 && value < 90.0;
            in_range(parameter, value, holds, allowed)?;
            Ok::<f64, IndenterError>(value.to_radians().tan().recip())
        };
        let cone = |angle| PowerProfile::cone(slope("--cone", angle)?);
        let pyramid = |angle| PowerProfile::pyramid(slope("--pyramid", angle)?);
        let paraboloid = |radius| PowerProfile::paraboloid(0.5 / positive("--paraboloid", radius)?);
        let sphere = |radius| Sphere::new(positive("--sphere", radius)?);
        let flat_punch = |radius| FlatPunch::new(positive("--flat-punch", radius)?);
        // clap guarantees that exactly one shape is given.
        let shapes = [
            self.sphere.map(|radius| sphere(radius).map(boxed)),
            self.paraboloid.map(|radius| paraboloid(radius).map(boxed)),
            self.cone.map(|angle| cone(angle).map(boxed)),
            self.pyramid.map(|angle| pyramid(angle).map(boxed)),
        ];
        let punch = || flat_punch(self.flat_punch.unwrap_or_default()).map(boxed);
        let shape = shapes.into_iter().flatten().next().unwrap_or_else(punch);
        shape.map_err(|error| WrongInput(error.to_string()))
    }
}

/// Parses the thickness of the sample: a length, or "fit".
fn thickness(text: &str) -> Result<Thickness, String> {
    if text == "fit" {
        return Ok(Thickness::Fitted);
    }
    let known = metres(text).map(Thickness::Known);
    known.map_err(|needed| format!("{needed}; or \"fit\""))
}

/// Boxes a body, so that bodies of different types can be returned.
fn boxed(shape: impl Axisymmetric + 'static) -> Box<dyn Axisymmetric> {
    Box::new(shape)
}

/// Names of the files that the command may write.
const NAMES: &str = "findings.csv correlation.csv fit.csv fit.svg fit.png material.toml curves.csv";

/// Runs the command: reads and fits the curves, and writes the findings.
pub(crate) fn fit(options: &FitIndentation) -> Result<()> {
    let body = options.body.shape()?;
    if options.branches.is_some() && options.material != Rheology::Prony {
        let problem =
            "--branches is for --material prony; the other materials have no branches to choose";
        return Err(WrongInput(problem.to_owned()).into());
    }
    if options.thickness.is_some() && options.body.pyramid.is_some() {
        let problem = "--thickness needs a body of revolution, and a --pyramid is none; give the --cone that is closest";
        return Err(WrongInput(problem.to_owned()).into());
    }
    let mut curves = options.curves.iter();
    curves.try_for_each(|file| check_file(file))?;
    let open = |out: &PathBuf| OutputFolder::new(out, options.overwrite, NAMES);
    let out = options.out.as_ref().map(open).transpose()?;
    let [file] = &options.curves[..] else {
        return fit_map(options, &*body, out.as_ref());
    };
    let fit = progress::during(format!("fitting {}", file.display()), |_| {
        options.fitted(file, &*body, true)
    })?;
    let Some(folder) = &out else {
        return print_text(&options.table(&fit));
    };
    let out = folder.begin()?;
    let findings = fit.findings.iter();
    let rows = findings.map(|one| (&one.name, one.unit, numbers(one)));
    let header = "quantity unit value standard_error lower upper";
    out.write("findings.csv", &to_csv(header, rows)?)?;
    let header = names(&fit).join(" ");
    out.write("correlation.csv", &to_csv(&header, &fit.correlation)?)?;
    let header = "time_s depth_m force_n force_fit_n";
    out.write("fit.csv", &to_csv(header, &fit.points)?)?;
    out.draw("fit", &picture::figure(&fit))?;
    // Write the material file last, so that its presence implies the others. Flags and findings precede the numbers as comments.
    let findings = options.table(&fit).replace('\n', "\n# ");
    let [lowest, highest] = fit.valid_frequencies;
    let measured = format!("valid_frequencies = [{lowest:?}, {highest:?}]\n");
    let spectrum = fit.material.relaxation();
    let material = prony(&spectrum, options.poisson_ratio, &measured, None);
    let material = format!("# {}\n#\n# {findings}\n{material}", file.display());
    out.write("material.toml", material.as_bytes())?;
    out.finish()?;
    // Print after the files are written, because a closed pipe ends the program.
    print_text(&options.table(&fit))?;
    print_line(&format!("written into {}", folder.path().display()))
}

impl FitIndentation {
    /// Reads and fits one curve; `profile` requests profile-likelihood intervals.
    fn fitted(
        &self,
        file: &Path,
        body: &dyn Axisymmetric,
        profile: bool,
    ) -> Result<IndentationFit, WrongInput> {
        let read = CurveOptions {
            spring_constant: self.spring_constant,
            sensitivity: self.sensitivity,
            ramp_rate: self.ramp_rate,
        };
        let file_contents = indentation_curve(file, &read_table(file)?, &read);
        let CurveFile { curve, notes } = file_contents.map_err(wrong_table)?;
        let options = FitOptions {
            rheology: self.material,
            branches: self.branches,
            poisson_ratio: self.poisson_ratio,
            thickness: self.thickness.unwrap_or_default(),
            tilt: !self.no_tilt,
            before_retraction: self.before_retraction,
            profile,
        };
        let mut fit = fit_indentation(body, &curve, &options).map_err(|error| match error {
            MeasurementError::InvalidParameter(refused) => wrong_option(refused),
            other => WrongInput(format!("{}: {other}", file.display())),
        })?;
        fit.notes.splice(0..0, notes);
        Ok(fit)
    }
}

/// Fits several curves in parallel and writes one CSV row for each; a failed fit has its error in the row and no numbers. An
/// error if all fail.
fn fit_map(
    options: &FitIndentation,
    body: &dyn Axisymmetric,
    out: Option<&OutputFolder>,
) -> Result<()> {
    let bar = progress::bar("curves", options.curves.len());
    let fits = options.curves.par_iter().map(|file| {
        let fit = options.fitted(file, body, false);
        bar.inc(1);
        fit
    });
    let fits: Vec<Result<IndentationFit, WrongInput>> = fits.collect();
    bar.finish_and_clear();
    if fits.iter().all(Result::is_err) {
        // If all fits fail, report the first reason, such as a wrong option.
        let reason = fits.into_iter().find_map(Result::err);
        return Err(reason.map_or(anyhow!("no curves"), Into::into));
    }
    let names = all_names(&fits);
    let ends = ["", "_error", "_lower", "_upper"];
    let columns: Vec<String> = names
        .iter()
        .flat_map(|name| ends.map(|end| format!("{name}{end}")))
        .collect();
    let row = |(path, fit): (&PathBuf, _)| {
        let file = path.display().to_string();
        (file, flags(fit), cells(fit, &names), notes(fit))
    };
    let rows = options.curves.iter().zip(&fits).map(row);
    let csv = to_csv(&format!("file flags {} notes", columns.join(" ")), rows)?;
    let Some(out) = out else {
        return print_text(&String::from_utf8(csv)?);
    };
    let new = out.begin()?;
    new.write("curves.csv", &csv)?;
    new.finish()?;
    let n_fitted = fits.iter().flatten().count();
    print_line(&format!("{n_fitted} of {} curves fitted", fits.len()))?;
    print_line(&format!("written into {}", out.path().display()))
}

/// Names of the findings of a fit, in their order.
fn names(fit: &IndentationFit) -> Vec<&str> {
    fit.findings.iter().map(|one| &one.name[..]).collect()
}

/// Names of all findings: those of the fit with the most findings, preceded by those that only other fits have.
fn all_names(fits: &[Result<IndentationFit, WrongInput>]) -> Vec<&str> {
    let fits = || fits.iter().flatten();
    let longest = fits()
        .max_by_key(|fit| fit.findings.len())
        .map_or(Vec::new(), names);
    let mut others: Vec<&str> = fits().flat_map(names).collect();
    others.retain(|name| !longest.contains(name));
    others.sort_unstable();
    others.dedup();
    [others, longest].concat()
}

/// Notes of a fit, separated by semicolons, as the text of one cell; empty for a curve that was not fitted.
fn notes(fit: &Result<IndentationFit, WrongInput>) -> String {
    let notes = fit.iter().flat_map(|fit| &fit.notes);
    notes
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join("; ")
}

/// Flags of a fit in one cell, or its error.
fn flags(fit: &Result<IndentationFit, WrongInput>) -> String {
    match fit {
        Ok(fit) => {
            let flags = fit.flags.iter().map(ToString::to_string);
            flags.collect::<Vec<_>>().join("; ")
        }
        Err(error) => error.to_string(),
    }
}

/// The [`numbers`] of the finding of each name, in this order; empty if the fit lacks the finding.
fn cells(fit: &Result<IndentationFit, WrongInput>, names: &[&str]) -> Vec<Option<f64>> {
    let findings = fit.as_ref().map_or(&[][..], |fit| &fit.findings);
    let find = |name: &&str| findings.iter().find(|one| one.name == **name);
    names
        .iter()
        .map(find)
        .flat_map(|one| one.map_or([None; 4], numbers))
        .collect()
}

/// Value, standard error, and lower and upper end of the 95 % interval of a finding, in its unit; `None` if not determined.
pub(crate) fn numbers(finding: &Finding) -> [Option<f64>; 4] {
    let [lower, upper] = finding.interval;
    let estimate = finding.estimate.map(|one| [one.value, one.error]);
    let [value, error] = estimate.map_or([None; 2], |pair| pair.map(Some));
    [value, error, lower, upper]
}

impl FitIndentation {
    /// Text that is printed of a fit: findings, residual, notes and flags.
    fn table(&self, fit: &IndentationFit) -> String {
        let mut table = markdown(FINDINGS);
        for finding in &fit.findings {
            table.add_row(row(&finding.name, 1.0, finding));
            if let Some(of) = finding.name.strip_prefix('G') {
                table.add_row(row(
                    &format!("E{of}"),
                    2.0 * (1.0 + self.poisson_ratio),
                    finding,
                ));
            }
        }
        let noise = fit.noise.map_or_else(String::new, |noise| {
            format!(", noise before the contact {noise:.3e} N")
        });
        let [residual, correlated] = [fit.residual, fit.correlated_points];
        let flags = fit.flags.iter().map(|flag| format!("flag: {flag}\n"));
        let notes = fit.notes.iter().map(|note| format!("note: {note}\n"));
        let sentences: String = notes.chain(flags).collect();
        format!(
            "{table}\nresidual {residual:.3e} N{noise}; one independent point in {correlated:.1}\n{sentences}"
        )
    }
}

/// Heads of a printed table of findings, whose rows [`row`] makes.
pub(crate) const FINDINGS: &str = "quantity | value ± standard error | 95 % interval | unit";

/// Row of a printed table of findings, with value, error and interval multiplied by a factor: 1, or 2 (1 + ν) from G to E.
pub(crate) fn row(name: &str, factor: f64, finding: &Finding) -> [String; 4] {
    let digits = |number: f64| Rounded(factor * number).to_string();
    let value = finding.estimate.map_or_else(
        || "not determined".to_owned(),
        |estimate| Estimate::new(factor * estimate.value, factor * estimate.error).to_string(),
    );
    let interval = match finding.interval.map(|end| end.map(digits)) {
        [Some(lower), Some(upper)] => format!("{lower} to {upper}"),
        [Some(lower), None] => format!("more than {lower}"),
        [None, Some(upper)] => format!("less than {upper}"),
        [None, None] => "any".to_owned(),
    };
    [name.to_owned(), value, interval, finding.unit.to_owned()]
}
