//! Material functions, and materials fitted to measurements.

use std::cell::OnceCell;
use std::path::PathBuf;

use numpy::{PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rheology::fit::{
    Control, IdentifyOptions, LongTimeLimit, MeasuredCurve, RelativeError, RelaxationPoint, expand,
    identify,
};
use rheology::{RelaxationSpectrum, RheologyError};
use viscofriction::scene::MaterialTable;
use viscofriction::solve::{Expansion, HalfSpace, half_space};
use viscofriction::{Files, friction_analytic};

use crate::moduli::points;
use crate::reading::read_file;
use crate::solving::mapped;
use crate::tables::{table, wrong};

/// Values of one function of a material at angular frequencies or times.
#[pyfunction]
pub(crate) fn material_curve<'py>(
    scene: &Bound<'py, PyDict>,
    folder: PathBuf,
    quantity: &str,
    values: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let material = MaterialTable::try_from(table(scene, "")?).map_err(wrong)?;
    let files = Files {
        folder: &folder,
        read: read_file,
        memory: None,
    };
    let HalfSpace {
        material,
        expansion,
        ..
    } = half_space(&material, &files).map_err(wrong)?;
    let (relaxation, creep) = (material.relaxation(), material.creep());
    let modulus = |omega: f64| relaxation.complex_modulus(omega);
    let is_time = matches!(quantity, "relaxation_modulus" | "creep_compliance");
    mapped(&values, |value| {
        let time = if is_time { value } else { value.recip() };
        if let Some(Expansion {
            time_range: [shortest, longest],
            ..
        }) = expansion
            && !(shortest..=longest).contains(&time)
        {
            let name = if is_time { "time" } else { "angular_frequency" };
            let allowed = "a time within time_range, or 1 over one";
            return Err(wrong(format!("{name} must be {allowed}, but is {value}")));
        }
        let result = match quantity {
            "storage_modulus" => modulus(value).map(|modulus| modulus.storage),
            "loss_modulus" => modulus(value).map(|modulus| modulus.loss),
            "relaxation_modulus" => relaxation.relaxation_modulus(value),
            "creep_compliance" => creep.creep_compliance(value),
            other => return Err(wrong(format!("a material has no {other}"))),
        };
        result.map_err(wrong)
    })
}

/// Scaling factor s(p) of a power profile, and its error.
#[pyfunction]
pub(crate) fn scaling_factor(exponent: f64) -> PyResult<(f64, f64)> {
    let factor = friction_analytic::scaling_factor(exponent).map_err(wrong)?;
    Ok((factor.value, factor.error))
}

/// Options of a fit.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options {
    /// True for a material without an equilibrium modulus.
    liquid: bool,
    /// Largest number of branches.
    branches: Option<usize>,
    /// Excess error allowed for fewer branches.
    tolerance: Option<f64>,
    /// Weight of Tikhonov smoothing of the moduli of equally spaced branches.
    smoothing: Option<f64>,
}

impl Options {
    /// The options of the call, validated.
    fn checked(&self) -> PyResult<IdentifyOptions> {
        let control = match (self.branches, self.tolerance, self.smoothing) {
            (None, None, None) => IdentifyOptions::default().control,
            (None, Some(tolerance), None) => Control::Parsimony { tolerance },
            (Some(n_branches), None, None) => Control::Branches(n_branches),
            (Some(n_branches), None, Some(weight)) => Control::Smooth { n_branches, weight },
            (None, _, Some(_)) => return Err(wrong("smoothing needs branches")),
            (Some(_), Some(_), _) => return Err(wrong("either branches or tolerance, not both")),
        };
        let long_time_limit = if self.liquid {
            LongTimeLimit::Liquid
        } else {
            LongTimeLimit::Solid
        };
        Ok(IdentifyOptions {
            long_time_limit,
            control,
        })
    }
}

/// Fits a Prony series to moduli over angular frequency: equilibrium modulus, branches, and rms and largest relative errors.
#[pyfunction]
pub(crate) fn fit_oscillation<'py>(
    py: Python<'py>,
    angular_frequency: PyReadonlyArray1<'py, f64>,
    storage: PyReadonlyArray1<'py, f64>,
    loss: PyReadonlyArray1<'py, f64>,
    options: Options,
) -> PyResult<Bound<'py, PyDict>> {
    let points = points(&[angular_frequency, storage, loss]);
    fitted(py, MeasuredCurve::oscillation(points), &options, false)
}

/// Fits a Prony series to relaxation moduli over time; the result is that of [`fit_oscillation`].
#[pyfunction]
pub(crate) fn fit_relaxation<'py>(
    py: Python<'py>,
    time: PyReadonlyArray1<'py, f64>,
    modulus: PyReadonlyArray1<'py, f64>,
    options: Options,
) -> PyResult<Bound<'py, PyDict>> {
    let (times, moduli) = (time.as_array(), modulus.as_array());
    let point = |(&time, &modulus)| RelaxationPoint { time, modulus };
    let points = times.iter().zip(moduli.iter()).map(point).collect();
    fitted(py, MeasuredCurve::relaxation(points), &options, false)
}

/// Expands a function G(t) in a Prony series with its largest relative error; exceptions of the function are passed on.
#[pyfunction]
pub(crate) fn expand_relaxation<'py>(
    relaxation_modulus: &Bound<'py, PyAny>,
    shortest: f64,
    longest: f64,
    relative_error: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let raised = OnceCell::new();
    let modulus = |time: f64| {
        let returned = relaxation_modulus.call1((time,));
        let value = returned.and_then(|value| value.extract::<f64>());
        // NaN makes the expansion fail; the exception is then raised.
        value.unwrap_or_else(|error| {
            raised.get_or_init(|| error);
            f64::NAN
        })
    };
    let found = expand(&modulus, [shortest, longest], relative_error);
    if let Some(error) = raised.into_inner() {
        return Err(error);
    }
    let found = found.map_err(wrong)?;
    let dictionary = series(relaxation_modulus.py(), &found.spectrum)?;
    dictionary.set_item("relative_error", found.relative_error)?;
    Ok(dictionary)
}

/// Equilibrium modulus, and branches as pairs of modulus and relaxation time.
fn series<'py>(py: Python<'py>, spectrum: &RelaxationSpectrum) -> PyResult<Bound<'py, PyDict>> {
    let branches = spectrum.branches().iter();
    let branches: Vec<[f64; 2]> = branches
        .map(|branch| [branch.modulus, branch.relaxation_time])
        .collect();
    let dictionary = PyDict::new(py);
    dictionary.set_item("equilibrium_modulus", spectrum.equilibrium_modulus())?;
    dictionary.set_item("branches", branches)?;
    Ok(dictionary)
}

/// Fits a series to a curve, which may be one of several isotherms; returns a dictionary.
pub(crate) fn fitted<'py>(
    py: Python<'py>,
    curve: Result<MeasuredCurve, RheologyError>,
    options: &Options,
    of_isotherms: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let options = options.checked()?;
    let curve = curve.map_err(wrong)?;
    let found = py.detach(|| identify(&curve, &options)).map_err(wrong)?;
    let [lowest, highest] = curve.frequencies();
    let dictionary = series(py, &found.spectrum)?;
    dictionary.set_item("valid_frequencies", (lowest, highest))?;
    dictionary.set_item("rms_relative_error", found.rms_relative_error)?;
    let pair = |error: Option<RelativeError>| error.map(|one| (one.rms, one.max));
    dictionary.set_item("warnings", found.systematic_errors(of_isotherms))?;
    dictionary.set_item("storage_error", pair(found.storage_error))?;
    dictionary.set_item("loss_error", pair(found.loss_error))?;
    dictionary.set_item("max_relative_error", found.max_relative_error)?;
    if let Some(covariance) = found.covariance {
        dictionary.set_item("covariance_method", covariance.description())?;
        let relative = PyArray2::from_vec2(py, &covariance.relative).map_err(wrong)?;
        dictionary.set_item("relative_covariance", relative)?;
        dictionary.set_item("shift_errors", covariance.shift_errors)?;
    }
    Ok(dictionary)
}
