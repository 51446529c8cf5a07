//! Tables of measured moduli, and master curves.

use std::path::PathBuf;

use numpy::{IntoPyArray as _, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use rheology::fit::{Isotherm, ModulusPoint, automatic_master_curve};
use viscofriction::moduli::{
    Deformation, MeasuredModuli, Measurements, TableOptions, measured_moduli, shear_per_tension,
};

use crate::reading::read_table;
use crate::tables::wrong;

type Column<'py> = Bound<'py, PyArray1<f64>>;
/// Temperature, and angular frequencies, storage and loss moduli; of relaxation times and moduli.
type Measured<'py> = Vec<(Option<f64>, Vec<Column<'py>>)>;

/// The isotherms of a table, or its one relaxation curve, in SI and in shear.
#[pyfunction]
pub(crate) fn read_moduli<'py>(
    py: Python<'py>,
    file: PathBuf,
    poisson_ratio: f64,
    deformation: Option<&str>,
) -> PyResult<Measured<'py>> {
    let deformation = match deformation {
        None => None,
        Some("tension") => Some(Deformation::Tension),
        Some("shear") => Some(Deformation::Shear),
        Some(other) => {
            let allowed = "deformation must be \"tension\" or \"shear\"";
            return Err(wrong(format!("{allowed}, but is {other:?}")));
        }
    };
    let options = TableOptions {
        shear_per_tension: shear_per_tension(poisson_ratio).map_err(wrong)?,
        deformation,
    };
    let contents = read_table(&file).map_err(wrong)?;
    let MeasuredModuli { measurements, .. } =
        measured_moduli(&file, &contents, &options).map_err(wrong)?;
    Ok(match measurements {
        Measurements::Relaxation(points) => {
            let times = points.iter().map(|point| point.time).collect();
            let moduli = points.iter().map(|point| point.modulus).collect();
            vec![(None, columns(py, [times, moduli]))]
        }
        Measurements::Oscillation(isotherms) => {
            let one =
                |isotherm: Isotherm| (Some(isotherm.temperature), moduli(py, &isotherm.points));
            isotherms.into_iter().map(one).collect()
        }
    })
}

fn columns<const N: usize>(py: Python<'_>, columns: [Vec<f64>; N]) -> Vec<Column<'_>> {
    columns.map(|column| column.into_pyarray(py)).into()
}

fn moduli<'py>(py: Python<'py>, points: &[ModulusPoint]) -> Vec<Column<'py>> {
    let numbers: [fn(&ModulusPoint) -> f64; 3] =
        [|p| p.angular_frequency, |p| p.storage, |p| p.loss];
    columns(
        py,
        numbers.map(|number| points.iter().map(number).collect()),
    )
}

/// Points of angular frequencies, storage and loss moduli, as many as of the shortest column.
pub(crate) fn points(columns: &[PyReadonlyArray1<'_, f64>; 3]) -> Vec<ModulusPoint> {
    let [omega, storage, loss] = columns.each_ref().map(PyReadonlyArray1::as_array);
    let moduli = storage.iter().zip(loss.iter());
    let point = |(&angular_frequency, (&storage, &loss))| ModulusPoint {
        angular_frequency,
        storage,
        loss,
    };
    omega.iter().zip(moduli).map(point).collect()
}

/// One isotherm as [`read_moduli`] returns it.
type Given<'py> = (f64, [PyReadonlyArray1<'py, f64>; 3]);

/// Isotherms shifted onto one another: frequencies, storage and loss moduli, and pairs of temperature and log₁₀ of the factor.
#[pyfunction]
pub(crate) fn master_curve<'py>(
    py: Python<'py>,
    isotherms: Vec<Given<'py>>,
    reference_temperature: f64,
) -> PyResult<(Vec<Column<'py>>, Vec<[f64; 2]>)> {
    let isotherm = |(temperature, columns): &Given<'py>| Isotherm {
        temperature: *temperature,
        points: points(columns),
    };
    let isotherms: Vec<Isotherm> = isotherms.iter().map(isotherm).collect();
    let master = automatic_master_curve(&isotherms, reference_temperature).map_err(wrong)?;
    Ok((moduli(py, &master.points), master.log10_factors))
}
