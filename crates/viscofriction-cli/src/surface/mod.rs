//! `surface`: roughness parameters and spectra of a height map.

mod picture;

use std::fmt::Write as _;
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use viscofriction::WrongInput;
use viscofriction::indenters::rough::{PowerSpectrum, Roughness};
use viscofriction::indenters::topography::Topography;
use viscofriction::numerics::{MessageNumber, Rounded};
use viscofriction::scene::{Edges, HeightMapTable, HeightsAre, LengthUnit, SceneError};
use viscofriction::solve::{AdviceOnHeights, warnings_of_heights};

use crate::input::{half_of_free_memory, metres, protect, read_input};
use crate::output::{ABOUT_WARNINGS, OutputFolder, markdown, print_line, print_text, to_csv};

/// Arguments of the command.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: viscofriction surface road.x3p --fill-missing --out road\n\
    Example: viscofriction surface heights.csv --spacing 1e-6 1e-6 --periodic"
)]
pub(crate) struct Surface {
    /// Heights as asc, gsf, sdf, sur, x3p or xyz; or as CSV or npy as in scenes, with --spacing.
    file: PathBuf,
    /// Distances of neighbouring heights along x and y, of CSV and npy, in m or with a unit, as "10 um".
    #[arg(long, num_args = 2, value_names = ["DX", "DY"], value_parser = metres)]
    spacing: Option<Vec<f64>>,
    /// Unit of the heights, in files that do not state it [default: m].
    #[arg(long, value_name = "U")]
    unit: Option<LengthUnit>,
    /// Unit of x and y, in files that have positions and do not state it (xyz, asc) [default: m, and in xyz that of --unit].
    #[arg(long, value_name = "U")]
    lateral_unit: Option<LengthUnit>,
    /// Whether the largest heights touch first, or as gaps the smallest.
    #[arg(long, value_name = "WHAT", default_value = "surface")]
    heights_are: HeightsAre,
    /// Direction in which the body moves, from x towards y in degrees: 0, 90, 180 or 270.
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0)]
    direction: f64,
    /// The map repeats itself: slopes, curvatures and spectra are those of its waves.
    #[arg(long)]
    periodic: bool,
    /// Fill missing heights from their neighbours.
    #[arg(long)]
    fill_missing: bool,
    /// Do not take the mean slope out.
    #[arg(long)]
    keep_tilt: bool,
    /// Where roughness.csv, spectrum.csv, profiles.csv, surface.svg, surface.png and tidied.xyz are written [default: a
    /// table on the standard output].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace the answer that is in the folder already, all of its files at once.
    #[arg(long, requires = "out")]
    overwrite: bool,
}

/// Advice about implausible heights, in the options of this command.
const ADVICE: AdviceOnHeights = AdviceOnHeights {
    unit: "--unit mm, um or nm says another one",
    lateral_unit: "--lateral-unit mm, um or nm says another one of x and y in files, and --spacing takes a unit, as \"10 um\"",
    step: "in a scene edges = \"mirrored\" has no step",
};

/// Names of the files that the command may write.
const NAMES: &str = "roughness.csv spectrum.csv profiles.csv surface.svg surface.png tidied.xyz";

/// Runs the command: reads the map and reports its parameters.
pub(crate) fn describe(options: &Surface) -> Result<()> {
    protect(&options.file);
    let open = |out: &PathBuf| OutputFolder::new(out, options.overwrite, NAMES);
    let out = options.out.as_ref().map(open).transpose()?;
    let (surface, mut notes) = options.tidied()?;
    let wrong = |error| options.wrong(error);
    let map = surface.body().map_err(|error| options.wrong(error))?;
    let roughness = Roughness::of(&map, options.periodic).map_err(wrong)?;
    for warning in warnings_of_heights(&options.table(), &surface, &map, &ADVICE) {
        notes += &format!("warning: {warning}\n");
    }
    if notes.contains("warning: ") {
        notes += &format!("{ABOUT_WARNINGS}\n");
    }
    let rows = rows(&roughness);
    let text = format!("{notes}\n{}\n", table(&rows));
    let Some(folder) = &out else {
        return print_text(&text);
    };
    let out = folder.begin()?;
    let spectrum = PowerSpectrum::of(&map, options.periodic).map_err(wrong)?;
    let roughness = to_csv("quantity symbol value unit", rows)?;
    out.write("roughness.csv", &roughness)?;
    out.write("spectrum.csv", &to_csv("", &spectrum.radial)?)?;
    let axes = spectrum.profiles.iter().zip(["x", "y"]);
    let profiles = axes.flat_map(|(points, axis)| points.iter().map(move |point| (axis, point)));
    let profiles = to_csv("along wave_number density", profiles)?;
    out.write("profiles.csv", &profiles)?;
    out.draw("surface", &picture::figure(&map, &spectrum))?;
    // Write this file last, so that its presence implies the others.
    out.write("tidied.xyz", xyz(&surface)?.as_bytes())?;
    out.finish()?;
    // Print after the files are written, because a closed pipe ends the program.
    print_text(&text)?;
    print_line(&format!("written into {}", folder.path().display()))
}

impl Surface {
    /// The surface with holes filled and tilt removed, relative to its mean height, and notes about these steps.
    fn tidied(&self) -> Result<(Topography, String), WrongInput> {
        let table = self.table();
        let memory = half_of_free_memory().unwrap_or(u64::MAX);
        let contents = read_input(&self.file, memory)?;
        let rest = memory.saturating_sub(contents.len() as u64);
        let wrong = |error| self.wrong_option(&error);
        let read = table.read(&self.file, &contents, rest).map_err(wrong)?;
        let (points, missing) = (read.heights.len(), read.missing());
        let mut surface = table.prepared(read).map_err(wrong)?;
        let [rows, columns] = surface.shape;
        let [dx, dy] = surface.spacing;
        let first = match self.heights_are {
            HeightsAre::Surface => "highest points touch first",
            HeightsAre::Gap => "smallest gaps touch first",
        };
        let mut notes = format!(
            "{columns} × {rows} heights along x and y, {} × {} m apart\n\
             the body moves along x, and its {first}\n",
            MessageNumber(dx),
            MessageNumber(dy)
        );
        for note in &surface.notes {
            notes += &format!("note: {note}\n");
        }
        if missing > 0 {
            notes += &format!("missing, filled from their neighbours: {missing} of {points}\n");
        }
        if !self.keep_tilt {
            let [x, y] = surface.tilt();
            let [x, y] = [x, y].map(Rounded);
            notes += &format!("mean slope, taken out: {x} along x, {y} along y\n");
            surface = surface.levelled();
        }
        let mean = surface.heights.iter().sum::<f64>() / surface.heights.len() as f64;
        surface
            .heights
            .iter_mut()
            .for_each(|height| *height -= mean);
        Ok((surface, notes))
    }

    /// The table `height-map` of a scene that reads the file with these options.
    fn table(&self) -> HeightMapTable {
        let edges = if self.periodic {
            Edges::Periodic
        } else {
            Edges::Wall
        };
        let spacing = self.spacing.as_deref();
        HeightMapTable {
            file: self.file.clone(),
            spacing: spacing.map(|spacing| [spacing[0], spacing[1]]),
            unit: self.unit,
            lateral_unit: self.lateral_unit,
            heights_are: self.heights_are,
            direction: self.direction,
            fill_missing: self.fill_missing,
            level: false,
            edges,
            shortest_wavelength: None,
        }
    }

    /// Converts the keys in an error of the table to options.
    fn wrong_option(&self, error: &SceneError) -> WrongInput {
        let message = error.to_string();
        let text = message.trim_start_matches("indenter.height-map.");
        match (text.strip_prefix("file: "), text.find([' ', ':', '['])) {
            (None, Some(end)) => {
                let option = text[..end].replace('_', "-");
                self.wrong(format!("--{option}{}", &text[end..]))
            }
            (in_file, _) => WrongInput(in_file.unwrap_or(text).to_owned()),
        }
    }

    /// Invalid input in the file of heights, with the name of the file.
    fn wrong(&self, problem: impl std::fmt::Display) -> WrongInput {
        WrongInput(format!("{}: {problem}", self.file.display()))
    }
}

/// A row of roughness.csv: quantity, symbol, value and unit.
type Statistic = (&'static str, &'static str, f64, &'static str);

/// Quantity, symbol (ISO 25178 for S…) and unit of each row, separated by bars, in the order of the values of [`rows`].
const QUANTITIES: &str = "root mean square of the heights|Sq|m\n\
                          mean deviation of the heights|Sa|m\n\
                          highest peak above the mean|Sp|m\n\
                          deepest pit below the mean|Sv|m\n\
                          highest peak above the deepest pit|Sz|m\n\
                          skewness|Ssk|1\n\
                          kurtosis|Sku|1\n\
                          root mean square of the gradient|Sdq|1\n\
                          root mean square of the slope along x||1\n\
                          root mean square of the slope along y||1\n\
                          root mean square of the mean curvature||1/m\n\
                          Nayak's parameter|α|1";

/// Roughness parameters with name, symbol and unit, in the order of [`QUANTITIES`].
fn rows(of: &Roughness) -> Vec<Statistic> {
    let heights = [
        of.rms_height,
        of.mean_deviation,
        of.peak,
        of.pit,
        of.peak + of.pit,
    ];
    let shape = [of.skewness, of.kurtosis, of.rms_gradient()];
    let waves = [
        of.rms_slopes[0],
        of.rms_slopes[1],
        of.rms_curvature,
        of.nayak,
    ];
    let values = heights.into_iter().chain(shape).chain(waves);
    let row = |(of, value): (&'static str, f64)| {
        let of: Vec<&str> = of.split('|').collect();
        (of[0], of[1], value, of[2])
    };
    QUANTITIES.lines().zip(values).map(row).collect()
}

/// Roughness parameters as a printed table.
fn table(rows: &[Statistic]) -> comfy_table::Table {
    let mut table = markdown("quantity | symbol | value | unit");
    for (quantity, symbol, value, unit) in rows {
        table.add_row([quantity, symbol, &&*Rounded(*value).to_string(), unit]);
    }
    table
}

/// The surface as a text with one line of x, y and height \[m] for each point, x fastest.
fn xyz(surface: &Topography) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    let columns = surface.shape[1];
    for (index, height) in surface.heights.iter().enumerate() {
        let place = [index % columns, index / columns];
        let [x, y] = [0, 1].map(|axis| place[axis] as f64 * surface.spacing[axis]);
        writeln!(text, "{x:e} {y:e} {height:e}")?;
    }
    Ok(text)
}
