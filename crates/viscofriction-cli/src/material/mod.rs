//! `fit-material`: a table of measured moduli becomes the material of a scene.

mod output_files;
mod picture;

use std::path::{Path, PathBuf};

use anyhow::Result;
use clap::Args;
use measurements::MeasurementError;
use measurements::moduli::{
    Deformation, MeasuredModuli, Measurements, Shifted, Shifting, TableOptions, master_curve,
    measured_moduli, shear_per_tension,
};
use rheology::RheologyError;
use rheology::fit::{
    Control, Ending, Identification, IdentifyOptions, MeasuredCurve, ModulusPoint, RelativeError,
    RelaxationPoint, identify,
};
use viscofriction::WrongInput;
use viscofriction::scene::ShiftLaw;

use crate::input::{read_table, wrong_option};
use crate::output::{OutputFolder, print_line, print_text};
use crate::progress;
pub(crate) use output_files::prony;
pub(crate) use picture::decades;

/// Arguments of the command.
#[derive(Debug, Args)]
#[command(after_help = "Example: viscofriction fit-material measured.csv --out rubber")]
pub(crate) struct FitMaterial {
    /// Table as an instrument exports it: a line of names (f or ω with two of E', E'' and tan delta, or G' and G'', perhaps
    /// T; or t with E_relax or G_relax) with units (Hz or rad/s, Pa to GPa, C or K, s) in the names or in the line below,
    /// then one line per measurement. Separator, decimal mark and encoding are found; text before the names is not read.
    data: PathBuf,
    /// Where material.toml, fit.csv, fit.svg and fit.png are written [default: material.toml on the standard output].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace the answer that is in the folder already, all of its files at once.
    #[arg(long, requires = "out")]
    overwrite: bool,
    /// Poisson ratio, by which E becomes G = E/(2 (1 + ν)).
    #[arg(long, default_value_t = 0.5, value_name = "NU")]
    poisson_ratio: f64,
    /// What a "storage modulus" is where the table does not say E or G.
    #[arg(long, value_name = "KIND")]
    deformation: Option<Deformation>,
    /// The material flows in the end: no equilibrium modulus.
    #[arg(long)]
    liquid: bool,
    /// Number of branches at most, their times placed where they fit best.
    #[arg(long, value_name = "N")]
    branches: Option<usize>,
    /// Excess error allowed for having few branches, without --branches [default: 0.02].
    #[arg(long, value_name = "FRACTION", conflicts_with = "branches")]
    parsimony: Option<f64>,
    /// Keep --branches times equally spaced and smooth their moduli with this weight (Tikhonov); 1 is moderate.
    #[arg(long, value_name = "WEIGHT", requires = "branches")]
    smoothing: Option<f64>,
    /// Temperature of the master curve, in the unit of the table [default: that of the isotherm in the middle].
    #[arg(long, value_name = "T")]
    reference_temperature: Option<f64>,
    /// Shift by the WLF law with these constants about the reference temperature, instead of automatically.
    #[arg(long, value_names = ["C1", "C2"], num_args = 2, conflicts_with = "arrhenius")]
    wlf: Option<Vec<f64>>,
    /// Shift by the law of Arrhenius with this activation energy in J/mol, instead of automatically.
    #[arg(long, value_name = "ENERGY")]
    arrhenius: Option<f64>,
}

/// Reads the table, fits it, and writes the material and its picture.
pub(crate) fn fit(options: &FitMaterial) -> Result<()> {
    let contents = read_table(&options.data)?;
    let table = options.table()?;
    let moduli = measured_moduli(&options.data, &contents, &table).map_err(wrong_table)?;
    let wrong = |error: RheologyError| match error {
        RheologyError::InvalidParameter(refused) => wrong_option(refused),
        other => WrongInput(format!("{}: {other}", options.data.display())),
    };
    if moduli.celsius.is_none() && options.shifting() != Shifting::default() {
        let problem =
            "the table has no temperatures, from which it could be shifted to another one";
        return Err(WrongInput(format!("{}: {problem}", options.data.display())).into());
    }
    let (points, shifted) = joined(moduli, options).map_err(wrong)?;
    let curve = match &shifted {
        // It knows its isotherms.
        Some(shifted) => shifted.master.curve.clone(),
        None => points.curve().map_err(wrong)?,
    };
    let open = |out: &PathBuf| OutputFolder::new(out, options.overwrite, output_files::NAMES);
    let out = options.out.as_ref().map(open).transpose()?;
    let found = progress::during(format!("fitting {}", options.data.display()), |_| {
        identify(&curve, &options.identification())
    });
    let found = found.map_err(|error| match error {
        RheologyError::FitNotConverged { .. } => {
            anyhow::Error::from(error).context(options.data.display().to_string())
        }
        other => wrong(other).into(),
    })?;
    let fitted = Fitted {
        options,
        points,
        shifted,
        frequencies: curve.frequencies(),
        found,
    };
    let Some(out) = &out else {
        return print_text(&output_files::material(&fitted));
    };
    output_files::write(&fitted, out)?;
    print_line(&fitted.summary())?;
    print_line(&format!("written into {}", out.path().display()))
}

/// The points of one curve, and where there are temperatures what they were shifted by.
fn joined(
    moduli: MeasuredModuli,
    options: &FitMaterial,
) -> Result<(Points, Option<Shifted>), RheologyError> {
    match (moduli.measurements, moduli.celsius) {
        (Measurements::Relaxation(points), _) => Ok((Points::Relaxation(points), None)),
        (Measurements::Oscillation(isotherms), None) => {
            let points = isotherms.into_iter().flat_map(|only| only.points);
            Ok((Points::Oscillation(points.collect()), None))
        }
        (Measurements::Oscillation(isotherms), Some(celsius)) => {
            let shifted = master_curve(&isotherms, celsius, options.shifting())?;
            let points = shifted.master.points.clone();
            Ok((Points::Oscillation(points), Some(shifted)))
        }
    }
}

/// Checks what would be a table of incompressible material.
pub(crate) fn check_table(file: &Path, contents: &[u8]) -> Result<(), WrongInput> {
    let incompressible = TableOptions {
        shear_per_tension: 1.0 / 3.0,
        deformation: None,
    };
    let moduli = measured_moduli(file, contents, &incompressible);
    moduli.map(drop).map_err(wrong_table)
}

/// What is wrong with a table is the user's.
pub(crate) fn wrong_table(error: MeasurementError) -> WrongInput {
    match error {
        MeasurementError::InvalidParameter(refused) => wrong_option(refused),
        other => WrongInput(other.to_string()),
    }
}

/// What the command found.
struct Fitted<'a> {
    options: &'a FitMaterial,
    points: Points,
    shifted: Option<Shifted>,
    /// At which the material was measured.
    frequencies: [f64; 2],
    found: Identification,
}

/// What is fitted.
enum Points {
    Oscillation(Vec<ModulusPoint>),
    Relaxation(Vec<RelaxationPoint>),
}

impl Points {
    fn curve(&self) -> Result<MeasuredCurve, RheologyError> {
        match self {
            Self::Oscillation(points) => MeasuredCurve::oscillation(points.clone()),
            Self::Relaxation(points) => MeasuredCurve::relaxation(points.clone()),
        }
    }
}

impl FitMaterial {
    fn table(&self) -> Result<TableOptions, WrongInput> {
        Ok(TableOptions {
            shear_per_tension: shear_per_tension(self.poisson_ratio).map_err(wrong_option)?,
            deformation: self.deformation,
        })
    }

    fn shifting(&self) -> Shifting {
        let wlf = match self.wlf.as_deref() {
            Some([c1, c2]) => Some(ShiftLaw::Wlf([*c1, *c2])),
            _ => None,
        };
        Shifting {
            reference_temperature: self.reference_temperature,
            law: wlf.or(self.arrhenius.map(ShiftLaw::Arrhenius)),
        }
    }

    fn identification(&self) -> IdentifyOptions {
        let defaults = IdentifyOptions::default();
        let control = match (self.branches, self.smoothing, self.parsimony) {
            (Some(n_branches), Some(weight), _) => Control::Smooth { n_branches, weight },
            (Some(n_branches), None, _) => Control::Branches(n_branches),
            (None, _, Some(tolerance)) => Control::Parsimony { tolerance },
            (None, _, None) => defaults.control,
        };
        let ending = if self.liquid {
            Ending::Liquid
        } else {
            Ending::Solid
        };
        IdentifyOptions { ending, control }
    }
}

impl Fitted<'_> {
    fn summary(&self) -> String {
        let found = &self.found;
        let n_branches = found.spectrum.branches().len();
        let of_all = RelativeError {
            rms: found.rms_relative_error,
            max: found.max_relative_error,
        };
        let error = |RelativeError { rms, max }| {
            format!("{:.3} % rms, {:.3} % at most", 100.0 * rms, 100.0 * max)
        };
        let errors = match (found.storage_error, found.loss_error) {
            (Some(storage), Some(loss)) => {
                format!("G': {}; of G'': {}", error(storage), error(loss))
            }
            _ => format!("G(t): {}", error(of_all)),
        };
        format!("{n_branches} branches; relative error of {errors}")
    }
}
