//! The output files of the command.

use std::f64::consts::LN_10;

use anyhow::Result;
use measurements::moduli::Shifted;
use rheology::fit::{IsothermShift, ModuliCovariance, ModulusPoint, RelaxationPoint};
use rheology::{RelaxationSpectrum, VerticalLaw};
use viscofriction::scene::{Shift, ShiftLaw};

use super::picture::{Comparison, Isotherms, OSCILLATION, RELAXATION, figure};
use super::{Fitted, Points};
use crate::output::{OutputFolder, to_csv};

/// Names of all files that a fit may write.
pub(super) const NAMES: &str = "material.toml fit.csv fit.svg fit.png shifts.csv";

/// Number of points per decade of the drawn curve of the series. Chosen; it changes the picture only.
const POINTS_PER_DECADE: f64 = 30.0;

/// Writes material.toml, fit.csv, fit.svg and fit.png; with several isotherms also shifts.csv.
pub(super) fn write(fitted: &Fitted<'_>, folder: &OutputFolder) -> Result<()> {
    let out = folder.begin()?;
    let comparison = compare(fitted)?;
    let rows = to_csv(comparison.names, &comparison.rows)?;
    out.write("fit.csv", &rows)?;
    out.draw("fit", &figure(&comparison))?;
    if let Some(shifted) = fitted.isotherms() {
        out.write("shifts.csv", &to_csv(SHIFTS, shifts(fitted, shifted))?)?;
    }
    // Write the material file last, so that its presence implies the others.
    out.write("material.toml", material(fitted).as_bytes())?;
    out.finish()
}

/// Names of the columns of shifts.csv, which has one row for each isotherm.
const SHIFTS: &str = "temperature log10_shift_factor log10_shift_factor_error vertical_shift_factor \
    vertical_shift_factor_error placed_by_law";

/// The rows of shifts.csv, one per isotherm, with the columns of [`SHIFTS`]; an unknown error is NaN.
fn shifts(fitted: &Fitted<'_>, shifted: &Shifted) -> Vec<Vec<f64>> {
    let errors = fitted.found.covariance.as_ref();
    let row = |(place, shift): (usize, &IsothermShift)| {
        let [factor_error, modulus_error] =
            errors.map_or([f64::NAN; 2], |known| known.shift_errors[place]);
        vec![
            shift.temperature,
            shift.log10_factor,
            factor_error / LN_10,
            shift.modulus_factor,
            shift.modulus_factor * modulus_error,
            f64::from(u8::from(shift.placed_by_law)),
        ]
    };
    shifted.master.shifts.iter().enumerate().map(row).collect()
}

/// Measured and fitted moduli as rows of fit.csv, and the moduli of the series at frequencies or times that are dense over the
/// measured range.
fn compare(fitted: &Fitted<'_>) -> Result<Comparison> {
    let spectrum = &fitted.found.spectrum;
    let oscillation = |point: &ModulusPoint| {
        let ModulusPoint {
            angular_frequency: omega,
            storage,
            loss,
        } = *point;
        let fit = spectrum.complex_modulus(omega)?;
        let [of_storage, of_loss] = point.sizes();
        let errors = [
            (fit.storage - storage) / of_storage,
            (fit.loss - loss) / of_loss,
        ];
        let moduli = [omega, storage, loss, fit.storage, fit.loss];
        Ok([&moduli[..], &errors[..]].concat())
    };
    let relaxation = |&RelaxationPoint { time, modulus }: &RelaxationPoint| {
        let fit = spectrum.relaxation_modulus(time)?;
        Ok(vec![time, modulus, fit, fit / modulus - 1.0])
    };
    let (names, rows): (_, Vec<_>) = match &fitted.points {
        Points::Oscillation(points) => {
            let rows: Result<_> = points.iter().map(oscillation).collect();
            (OSCILLATION, rows?)
        }
        Points::Relaxation(points) => {
            let rows: Result<_> = points.iter().map(relaxation).collect();
            (RELAXATION, rows?)
        }
    };
    let fit_at = |x: f64| match &fitted.points {
        Points::Oscillation(_) => {
            let fit = spectrum.complex_modulus(x)?;
            Ok(vec![x, fit.storage, fit.loss])
        }
        Points::Relaxation(_) => Ok(vec![x, spectrum.relaxation_modulus(x)?]),
    };
    let series = log_spaced(rows.iter().map(|row| row[0]))
        .map(fit_at)
        .collect::<Result<_>>()?;
    let isotherms = fitted.isotherms().map(|shifted| Isotherms {
        of_rows: shifted.master.isotherms.clone(),
        temperatures: shifted
            .master
            .shifts
            .iter()
            .map(|shift| shift.temperature)
            .collect(),
        unit: fitted.unit,
    });
    Ok(Comparison {
        names,
        rows,
        series,
        isotherms,
    })
}

/// Numbers at equal ratios, [`POINTS_PER_DECADE`], from the smallest to the largest of the positive ones of `numbers`, both
/// included.
fn log_spaced(numbers: impl Iterator<Item = f64>) -> impl Iterator<Item = f64> {
    let positive = numbers.filter(|number| *number > 0.0);
    let [first, last] = positive.fold([f64::INFINITY, 0.0], |[first, last], number| {
        [number.min(first), number.max(last)]
    });
    let step = 10_f64.powf(POINTS_PER_DECADE.recip());
    let inside = std::iter::successors(Some(first), move |number| Some(number * step));
    inside
        .take_while(move |number| *number < last)
        .chain([last])
}

/// The material table with comments on its origin, as part of a scene file.
pub(super) fn material(fitted: &Fitted<'_>) -> String {
    let spectrum = &fitted.found.spectrum;
    let data = fitted.options.data.display();
    let mut text = format!("# {data}: {}\n", fitted.summary());
    let [lowest, highest] = fitted.frequencies;
    let mut measured = format!("valid_frequencies = [{lowest:?}, {highest:?}]\n");
    if let Some(shifted) = &fitted.shifted {
        let reference = shifted.master.reference_temperature;
        text += &format!("# at the temperature {reference}\n");
        for sentence in fitted.superposition() {
            text += &format!("# {sentence}\n");
        }
        if let Some(shift) = &shifted.shift {
            measured += &shift_line(shift);
        }
    }
    let covariance = fitted.found.covariance.as_ref();
    measured += &covariance.map_or_else(String::new, covariance_lines);
    text + &prony(
        spectrum,
        fitted.options.poisson_ratio,
        &measured,
        covariance,
    )
}

/// The covariance of the moduli as keys of the material.
fn covariance_lines(covariance: &ModuliCovariance) -> String {
    let row = |row: &Vec<f64>| format!("    {row:?},\n");
    let rows: String = covariance.relative.iter().map(row).collect();
    let method = covariance.description();
    format!("covariance.method = {method:?}\ncovariance.relative = [\n{rows}]\n")
}

/// The shift law as a key of the material.
fn shift_line(shift: &Shift) -> String {
    let law = match shift.law {
        ShiftLaw::Wlf([c1, c2]) => format!("wlf = [{c1:?}, {c2:?}]"),
        ShiftLaw::Arrhenius(energy) => format!("arrhenius = {energy:?}"),
    };
    let (temperature, [lowest, highest]) = (shift.temperature, shift.temperature_range);
    let range = format!("temperature_range = [{lowest:?}, {highest:?}]");
    let vertical = match &shift.vertical {
        None => String::new(),
        Some(VerticalLaw::Entropic) => ", vertical = \"entropic\"".to_owned(),
        Some(VerticalLaw::Table(table)) => format!(", vertical = {{ table = {table:?} }}"),
    };
    format!("shift = {{ temperature = {temperature:?}, {range}, law = {{ {law} }}{vertical} }}\n")
}

/// The table `[material.prony]` of a scene file, with the `measured` lines, and with the standard errors of the moduli as
/// comments.
pub(crate) fn prony(
    spectrum: &RelaxationSpectrum,
    poisson_ratio: f64,
    measured: &str,
    covariance: Option<&ModuliCovariance>,
) -> String {
    let errors = covariance.map(ModuliCovariance::standard_errors);
    let error = |place: usize| {
        let error = errors.as_ref().map(|errors| 100.0 * errors[place]);
        error.map_or_else(String::new, |error| format!("  # ± {error:.2} %"))
    };
    let branches = spectrum
        .branches()
        .iter()
        .enumerate()
        .map(|(place, branch)| {
            let (modulus, time) = (branch.modulus, branch.relaxation_time);
            let error = error(place + 1);
            format!("    {{ modulus = {modulus:?}, relaxation_time = {time:?} }},{error}\n")
        });
    let viscosity = Some(spectrum.viscosity())
        .filter(|viscosity| *viscosity > 0.0)
        .map(|viscosity| format!("viscosity = {viscosity:?}\n"));
    format!(
        "[material.prony]\nequilibrium_modulus = {:?}{}\n{}poisson_ratio = {poisson_ratio:?}\n{measured}branches = [\n{}]\n",
        spectrum.equilibrium_modulus(),
        error(0),
        viscosity.unwrap_or_default(),
        branches.collect::<String>()
    )
}
