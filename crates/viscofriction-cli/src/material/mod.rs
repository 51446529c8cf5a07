//! `fit-material`: fit of a Prony series to a table of measured moduli.

mod output_files;
mod picture;

use std::path::{Path, PathBuf};

use anyhow::Result;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use measurements::MeasurementError;
use measurements::moduli::{
    Deformation, MeasuredModuli, Measurements, Shifted, Shifting, TableOptions, master_curve,
    measured_moduli, shear_per_tension,
};
use rheology::RheologyError;
use rheology::fit::{
    Control, Identification, IdentifyOptions, LongTimeLimit, MeasuredCurve, ModulusPoint,
    RelativeError, RelaxationPoint, VerticalChoice, VerticalShift, identify,
};
use viscofriction::WrongInput;
use viscofriction::scene::ShiftLaw;

use crate::input::{read_table, wrong_option};
use crate::output::{OutputFolder, eprint_line, print_line, print_text};
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
    /// Temperature of the material, in the unit of the table, where the constants of --wlf are those about another one
    /// [default: the reference temperature].
    #[arg(long, value_name = "T")]
    temperature: Option<f64>,
    /// Shift by the WLF law with these constants about the reference temperature, instead of automatically.
    #[arg(long, value_names = ["C1", "C2"], num_args = 2, conflicts_with = "arrhenius")]
    wlf: Option<Vec<f64>>,
    /// Shift by the law of Arrhenius with this activation energy in J/mol, instead of automatically.
    #[arg(long, value_name = "ENERGY")]
    arrhenius: Option<f64>,
    /// How the moduli of the isotherms change with temperature: none, not at all; entropic, with the absolute temperature, as those of
    /// rubber; free, by a factor of each [default: what the isotherms show].
    #[arg(long, value_name = "KIND", value_parser = vertical_shift())]
    vertical: Option<VerticalShift>,
}

/// Parser of the option for the vertical shift, by the names none, entropic and free.
fn vertical_shift() -> impl TypedValueParser<Value = VerticalShift> {
    let names = VerticalShift::NAMED.map(|(name, _)| name);
    PossibleValuesParser::new(names).try_map(|name| {
        let named = VerticalShift::NAMED.into_iter();
        let mut kinds = named.filter_map(|(own, kind)| (own == name).then_some(kind));
        kinds.next().ok_or("none of the names")
    })
}

/// Runs the command: reads the table, fits it, and writes material and picture.
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
    let unit = moduli
        .celsius
        .map_or("", |celsius| if celsius { "°C" } else { "K" });
    let (points, shifted) = joined_points(moduli, options).map_err(wrong)?;
    let curve = match &shifted {
        // Fit the curve of the master curve, which keeps track of the isotherms.
        Some(shifted) => shifted.master.curve.clone(),
        None => points.curve().map_err(wrong)?,
    };
    let open = |out: &PathBuf| OutputFolder::new(out, options.overwrite, output_files::NAMES);
    let out = options.out.as_ref().map(open).transpose()?;
    let found = progress::during(format!("fitting {}", options.data.display()), |_| {
        identify(&curve, &options.identification())
    })
    .map_err(|error| match error {
        RheologyError::FitNotConverged { .. } => {
            anyhow::Error::from(error).context(options.data.display().to_string())
        }
        other => wrong(other).into(),
    })?;
    let fitted = Fitted {
        options,
        points,
        shifted,
        unit,
        frequencies: curve.frequencies(),
        found,
    };
    fitted.report(out.as_ref())
}

/// The measured points as one curve: isotherms are shifted to a master curve, which is returned with their shifts.
fn joined_points(
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

/// Validates a table of moduli for an incompressible material.
pub(crate) fn check_table(file: &Path, contents: &[u8]) -> Result<(), WrongInput> {
    let incompressible = TableOptions {
        shear_per_tension: 1.0 / 3.0,
        deformation: None,
    };
    let moduli = measured_moduli(file, contents, &incompressible);
    moduli.map(drop).map_err(wrong_table)
}

/// Converts an error of a table to invalid input.
pub(crate) fn wrong_table(error: MeasurementError) -> WrongInput {
    match error {
        MeasurementError::InvalidParameter(refused) => wrong_option(refused),
        other => WrongInput(other.to_string()),
    }
}

/// Input and result of a fit, from which all output is made.
struct Fitted<'a> {
    options: &'a FitMaterial,
    /// The points of the curve that was fitted, shifted to the reference temperature.
    points: Points,
    /// The master curve with its shift law; `None` if the table has no temperatures.
    shifted: Option<Shifted>,
    /// Unit of the temperatures.
    unit: &'static str,
    /// Range of measured angular frequencies, \[rad/s].
    frequencies: [f64; 2],
    /// The series with its errors and covariance.
    found: Identification,
}

/// The fitted points.
enum Points {
    /// Storage and loss modulus over angular frequency.
    Oscillation(Vec<ModulusPoint>),
    /// Relaxation modulus over time.
    Relaxation(Vec<RelaxationPoint>),
}

impl Points {
    /// The measured curve to which the Prony series is fitted.
    fn curve(&self) -> Result<MeasuredCurve, RheologyError> {
        match self {
            Self::Oscillation(points) => MeasuredCurve::oscillation(points.clone()),
            Self::Relaxation(points) => MeasuredCurve::relaxation(points.clone()),
        }
    }
}

impl FitMaterial {
    /// Options for reading the table of moduli.
    fn table(&self) -> Result<TableOptions, WrongInput> {
        Ok(TableOptions {
            shear_per_tension: shear_per_tension(self.poisson_ratio).map_err(wrong_option)?,
            deformation: self.deformation,
        })
    }

    /// Options of the time–temperature superposition.
    fn shifting(&self) -> Shifting {
        let wlf = match self.wlf.as_deref() {
            Some([c1, c2]) => Some(ShiftLaw::Wlf([*c1, *c2])),
            _ => None,
        };
        Shifting {
            reference_temperature: self.reference_temperature,
            law: wlf.or(self.arrhenius.map(ShiftLaw::Arrhenius)),
            temperature: self.temperature,
            vertical: self.vertical,
        }
    }

    /// Options of the identification.
    fn identification(&self) -> IdentifyOptions {
        let defaults = IdentifyOptions::default();
        let control = match (self.branches, self.smoothing, self.parsimony) {
            (Some(n_branches), Some(weight), _) => Control::Smooth { n_branches, weight },
            (Some(n_branches), None, _) => Control::Branches(n_branches),
            (None, _, Some(tolerance)) => Control::Parsimony { tolerance },
            (None, _, None) => defaults.control,
        };
        let long_time_limit = if self.liquid {
            LongTimeLimit::Liquid
        } else {
            LongTimeLimit::Solid
        };
        IdentifyOptions {
            long_time_limit,
            control,
        }
    }
}

impl Fitted<'_> {
    /// Writes the result into a folder, or prints the material.
    fn report(&self, out: Option<&OutputFolder>) -> Result<()> {
        for warning in self.warnings() {
            eprint_line(&format!("warning: {warning}"));
        }
        let Some(out) = out else {
            return print_text(&output_files::material(self));
        };
        output_files::write(self, out)?;
        print_line(&self.summary())?;
        for sentence in self.superposition() {
            print_line(&sentence)?;
        }
        print_line(&format!("written into {}", out.path().display()))
    }

    /// One line about the series: number of branches and relative errors of the moduli.
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

    /// Sentences about the superposition of several isotherms; empty for a single one.
    fn superposition(&self) -> Vec<String> {
        let Some(master) = self.isotherms().map(|shifted| &shifted.master) else {
            return Vec::new();
        };
        let kind = match master.vertical {
            VerticalShift::None => "moduli do not change with temperature, b_T = 1",
            VerticalShift::Entropic => "moduli change with the absolute temperature, b_T = T/T_r",
            VerticalShift::Free => "moduli change by a factor b_T of each isotherm",
        };
        let why = match master.vertical_choice {
            VerticalChoice::Given => "as --vertical says",
            VerticalChoice::FoundInData => "which the isotherms show",
            VerticalChoice::NotInData => {
                "because the isotherms do not show whether they do; --vertical entropic takes that of rubber"
            }
        };
        let mut sentences = vec![format!("{kind}, {why}")];
        let by_law = master.shifts.iter().filter(|shift| shift.placed_by_law);
        let by_law: Vec<String> = by_law.map(|shift| shift.temperature.to_string()).collect();
        if !by_law.is_empty() {
            sentences.push(format!(
                "placed by the law of the other shifts, because they overlap too little with their neighbours or follow such a one: isotherms {} {}",
                by_law.join(", "),
                self.unit
            ));
        }
        sentences
    }

    /// The master curve; `None` for a single isotherm.
    fn isotherms(&self) -> Option<&Shifted> {
        let shifted = self.shifted.as_ref();
        shifted.filter(|shifted| shifted.master.shifts.len() > 1)
    }

    /// A warning for each modulus whose errors matter and are not noise.
    fn warnings(&self) -> Vec<String> {
        let errors = self.found.systematic_errors(self.isotherms().is_some());
        let place = |error| format!("{error}: see the errors in fit.svg");
        errors.into_iter().map(place).collect()
    }
}
