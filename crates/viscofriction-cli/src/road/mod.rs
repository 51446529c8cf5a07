//! `road`: friction and contact area of a rough surface over the cut-off wavelength.

mod picture;

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use clap::Args;
use viscofriction::numerics::{InvalidParameter, MessageNumber, Rounded};
use viscofriction::scene::{Indenter, SceneError, Source};
use viscofriction::solve::{Answer, CutOff, Problem, cut_offs, plan_of, scene_of};
use viscofriction::sweep::each_once;
use viscofriction::{Estimate, Warning, WrongInput};

use crate::input::{half_of_free_memory, read_input, read_scene};
use crate::output::{
    ABOUT_WARNINGS, OutputFile, eprint_line, markdown, picture as drawn, print_line, to_csv,
};
use crate::progress;
use crate::sweep::beside;

/// Arguments of the command.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: viscofriction road examples/scenes/rough-road.toml --out cut-off.csv"
)]
pub(crate) struct Road {
    /// The scene file, or - for the standard input; docs/scenes.md describes it.
    scene: PathBuf,
    /// How many cut-offs at most: all waves, then none shorter than twice the shortest, four times and so on, as long as waves
    /// are left; from 1 to 64.
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=64))]
    cut_offs: u32,
    /// Number of random surfaces, self-affine or of a spectrum, instead of the number in the scene.
    #[arg(long, value_name = "N")]
    realisations: Option<u64>,
    /// The CSV file; a picture is written into the same folder as SVG and PNG [default: a table on the standard output].
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
    /// Replace files that are there already.
    #[arg(long, requires = "out")]
    overwrite: bool,
}

/// Columns of the CSV file that are numbers of an answer.
const NUMBERS: [&str; 8] = [
    "friction_coefficient",
    "friction_coefficient_error",
    "friction_coefficient_standard_error",
    "area_fraction",
    "area_fraction_error",
    "area_fraction_standard_error",
    "persson_friction_coefficient_2006",
    "persson_area_fraction_xu",
];

/// One row of the CSV file.
struct Row {
    /// Wavelength \[m] below which waves are left out.
    shortest_wavelength: f64,
    /// Rms slope of the remaining waves.
    rms_slope: f64,
    /// The [`NUMBERS`]; `None` if a number is not known.
    numbers: [Option<f64>; 8],
    /// Estimated friction of the waves that are left out; `None` without theory.
    persson_friction_of_shorter_waves: Option<f64>,
    /// Warnings of the answer, separated by bars.
    warnings: String,
    /// Reason why the request was not met; empty if it was.
    failure: String,
}

impl Row {
    /// Value of the column `name` of the answer to this cut-off; `None` if the answer does not have it.
    fn number(&self, name: &str) -> Option<f64> {
        let place = NUMBERS.iter().position(|known| *known == name);
        place.and_then(|place| self.numbers[place])
    }

    /// A quantity with its error; `None` if it is not known.
    fn quantity(&self, key: &str) -> Option<Estimate> {
        let error = self.number(&format!("{key}_error"))?;
        Some(Estimate::new(self.number(key)?, error))
    }
}

/// Runs the command: solves the cut-off series and reports it.
pub(crate) fn road(options: &Road) -> Result<()> {
    let source = read_scene(&options.scene)?;
    let files = options
        .out
        .as_deref()
        .map(|out| Files::new(out, options.overwrite))
        .transpose()?;
    let problem = options.problem(&source)?;
    plan_of(&source, &problem)?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(problem.threads().unwrap_or(0))
        .build()?;
    let task = format!("cut-offs of {}", source.path().display());
    let count = options.cut_offs as usize;
    let found = progress::during(task, |watch| {
        pool.install(|| cut_offs(problem, count, watch, |_| ()))
    })
    .map_err(|error| source.locate(&error))?;
    let rows: Vec<Row> = found.iter().map(|one| row(one, &found[0])).collect();
    if let Some(files) = &files {
        files.write(&rows, spacing_of_map(&source)?)?;
    }
    print_line(&table(&rows))?;
    let answers = found.iter().filter_map(CutOff::known);
    let warnings = each_once(answers.map(|one| one.warnings.iter().collect()));
    for warning in &warnings {
        eprint_line(&format!("warning: {warning}"));
    }
    if !warnings.is_empty() {
        eprint_line(ABOUT_WARNINGS);
    }
    let mut failures = rows
        .iter()
        .map(|row| &row.failure)
        .filter(|failure| !failure.is_empty());
    if let Some(first) = failures.next() {
        let n_failed = 1 + failures.count();
        bail!(
            "{n_failed} of {} cut-offs were not answered as asked: {first}",
            rows.len()
        );
    }
    Ok(())
}

/// Larger spacing of the points of the height map of a scene, \[m]; `None` for other surfaces.
fn spacing_of_map(source: &Source) -> Result<Option<f64>> {
    let Indenter::HeightMap(table) = scene_of(source, None)?.indenter else {
        return Ok(None);
    };
    let memory = half_of_free_memory().unwrap_or(u64::MAX);
    let file = source.folder().join(&table.file);
    let contents = read_input(&file, memory)?;
    let rest = memory.saturating_sub(contents.len() as u64);
    let map = table
        .read(&file, &contents, rest)
        .map_err(|error| source.locate(&error))?;
    Ok(Some(map.spacing[0].max(map.spacing[1])))
}

impl Road {
    /// The problem of the scene, with the number of surfaces of the option.
    fn problem(&self, source: &Source) -> Result<Problem, WrongInput> {
        let mut scene = scene_of(source, None)?;
        if let Some(count) = self.realisations {
            let given = match &mut scene.indenter {
                Indenter::SelfAffine(surface) => &mut surface.realisations,
                Indenter::Spectrum(surface) => &mut surface.realisations,
                _ => {
                    let problem = "only a self-affine surface and one of a spectrum are drawn by a seed; leave --realisations out";
                    return Err(source.locate(&SceneError::at("indenter", problem)));
                }
            };
            *given = Some(count);
            scene.indenter.realisations().map_err(|error| match error {
                SceneError::Value {
                    key,
                    value,
                    allowed,
                } if key.ends_with(".realisations") => {
                    let parameter = "--realisations";
                    WrongInput(
                        InvalidParameter {
                            parameter,
                            value,
                            allowed,
                        }
                        .to_string(),
                    )
                }
                other => source.locate(&other),
            })?;
        }
        let problem = Problem::new(&scene, source.folder(), read_input)
            .map_err(|error| source.locate(&error))?;
        Ok(problem.or_max_memory(half_of_free_memory()))
    }
}

/// The row of a cut-off; `all` is the surface with all its waves.
fn row(one: &CutOff, all: &CutOff) -> Row {
    let known = one.known();
    let numbers = known.map(Answer::numbers).unwrap_or_default();
    let number = |name: &str| numbers.iter().find(|(known, _)| known == name)?.1;
    let failure = one.answer.as_ref().err().map(ToString::to_string);
    Row {
        shortest_wavelength: one.shortest_wavelength,
        rms_slope: one.rms_slope,
        numbers: NUMBERS.map(number),
        persson_friction_of_shorter_waves: one.still_to_come(all),
        warnings: known.map_or_else(String::new, |answer| {
            let sentences = answer.warnings.iter().map(Warning::to_string);
            sentences.collect::<Vec<_>>().join(" | ")
        }),
        failure: failure.unwrap_or_default(),
    }
}

/// The rows, one for each cut-off, as a printed table.
fn table(rows: &[Row]) -> comfy_table::Table {
    let mut table = markdown(
        "shortest wavelength [m] | rms slope | friction coefficient | standard error | area fraction | standard error | \
         friction of shorter waves, estimated",
    );
    for row in rows {
        let quantity = |key| row.quantity(key).map(|known| known.to_string());
        let error = |key: &str| {
            let known = row.number(&format!("{key}_standard_error"));
            known.map(|error| format!("{error:.1e}"))
        };
        let later = row.persson_friction_of_shorter_waves;
        let cells = [
            Some(Rounded(row.shortest_wavelength).to_string()),
            Some(Rounded(row.rms_slope).to_string()),
            quantity("friction_coefficient"),
            error("friction_coefficient"),
            quantity("area_fraction"),
            error("area_fraction"),
            later.map(|friction| format!("{:.1e}", MessageNumber(friction))),
        ];
        table.add_row(cells.map(Option::unwrap_or_default));
    }
    table
}

/// Output files: the rows and their picture.
struct Files {
    csv: OutputFile,
    svg: OutputFile,
    png: OutputFile,
}

impl Files {
    /// Validates the paths of the CSV file and of its two pictures.
    fn new(out: &Path, overwrite: bool) -> Result<Self, WrongInput> {
        let file = |path: &Path| OutputFile::new(path, overwrite);
        Ok(Self {
            csv: file(out)?,
            svg: file(&beside(out, "svg"))?,
            png: file(&beside(out, "png"))?,
        })
    }

    /// Replaces the files in an order that never combines a picture with the rows of another run.
    fn write(&self, rows: &[Row], spacing: Option<f64>) -> Result<()> {
        let (svg, png) = drawn(&picture::figure(rows, spacing))?;
        let names = format!(
            "shortest_wavelength rms_slope {} persson_friction_of_shorter_waves warnings failure",
            NUMBERS.join(" ")
        );
        let records = rows.iter().map(|row| {
            let later = row.persson_friction_of_shorter_waves;
            let lengths = [row.shortest_wavelength, row.rms_slope];
            (lengths, row.numbers, later, &row.warnings, &row.failure)
        });
        let csv = self.csv.part(&to_csv(&names, records)?)?;
        let [svg_part, png_part] = [self.svg.part(svg.as_bytes())?, self.png.part(&png)?];
        self.svg.remove()?;
        self.png.remove()?;
        self.csv.persist(csv)?;
        self.svg.persist(svg_part)?;
        self.png.persist(png_part)
    }
}
