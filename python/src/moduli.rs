//! Tables of measured moduli, and master curves.

use std::path::PathBuf;

use measurements::moduli::{
    self, Deformation, MeasuredModuli, Measurements, Shifting, TableOptions, measured_moduli,
    shear_per_tension,
};
use numpy::{IntoPyArray as _, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rheology::fit::{Isotherm, IsothermShift, ModulusPoint, VerticalChoice, VerticalShift};
use viscofriction::scene::{Shift, ShiftLaw};

use crate::materials::{Options, fitted};
use crate::reading::read_table;
use crate::tables::wrong;

/// An array of numbers.
type Column<'py> = Bound<'py, PyArray1<f64>>;
/// Each isotherm: temperature, and columns of angular frequency, storage and loss modulus; for relaxation `None`, times and
/// moduli.
type Measured<'py> = Vec<(Option<f64>, Vec<Column<'py>>)>;

/// Reads the isotherms or the relaxation curve of a table, in SI units and in shear, and whether temperatures are in °C.
#[pyfunction]
pub(crate) fn read_moduli<'py>(
    py: Python<'py>,
    file: PathBuf,
    poisson_ratio: f64,
    deformation: Option<&str>,
) -> PyResult<(Measured<'py>, Option<bool>)> {
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
    let read = || {
        let contents = read_table(&file).map_err(wrong)?;
        measured_moduli(&file, &contents, &options).map_err(wrong)
    };
    let MeasuredModuli {
        measurements,
        celsius,
    } = py.detach(read)?;
    let measured = match measurements {
        Measurements::Relaxation(points) => {
            let times = points.iter().map(|point| point.time).collect();
            let moduli = points.iter().map(|point| point.modulus).collect();
            vec![(None, columns(py, [times, moduli]))]
        }
        Measurements::Oscillation(isotherms) => {
            let one =
                |isotherm: Isotherm| (Some(isotherm.temperature), columns_of(py, &isotherm.points));
            isotherms.into_iter().map(one).collect()
        }
    };
    Ok((measured, celsius))
}

/// Columns as NumPy arrays.
fn columns<const N: usize>(py: Python<'_>, columns: [Vec<f64>; N]) -> Vec<Column<'_>> {
    columns.map(|column| column.into_pyarray(py)).into()
}

/// Columns of an isotherm as NumPy arrays.
fn columns_of<'py>(py: Python<'py>, points: &[ModulusPoint]) -> Vec<Column<'py>> {
    let numbers: [fn(&ModulusPoint) -> f64; 3] =
        [|p| p.angular_frequency, |p| p.storage, |p| p.loss];
    columns(
        py,
        numbers.map(|number| points.iter().map(number).collect()),
    )
}

/// Points from columns of angular frequency, storage and loss modulus, up to the shortest column.
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

/// One isotherm, as [`read_moduli`] returns it.
type Given<'py> = (f64, [PyReadonlyArray1<'py, f64>; 3]);

/// Options of the superposition of isotherms; temperatures are in the unit of the table.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Superposition {
    /// Temperature about which the constants of the law hold; `None` for that of the middle isotherm.
    reference_temperature: Option<f64>,
    /// Temperature of the material; `None` for the reference temperature.
    temperature: Option<f64>,
    /// C₁ and C₂ \[K] of the law of Williams, Landel and Ferry.
    wlf: Option<[f64; 2]>,
    /// Activation energy of the law of Arrhenius, \[J/mol].
    arrhenius: Option<f64>,
    /// How moduli change with temperature, by the names of the program.
    vertical: Option<String>,
}

impl Superposition {
    /// Options of the superposition in the library, from those of the call.
    fn shifting(&self) -> PyResult<Shifting> {
        let law = match (self.wlf, self.arrhenius) {
            (Some(_), Some(_)) => return Err(wrong("either wlf or arrhenius, not both")),
            (wlf, energy) => wlf.map(ShiftLaw::Wlf).or(energy.map(ShiftLaw::Arrhenius)),
        };
        Ok(Shifting {
            reference_temperature: self.reference_temperature,
            law,
            temperature: self.temperature,
            vertical: self.vertical.as_deref().map(vertical_shift).transpose()?,
        })
    }
}

/// Fits a Prony series to the master curve of isotherms at a temperature, by default at that of the middle isotherm. The
/// dictionary is that of `fit_oscillation` with, for each isotherm, temperature, log₁₀ a_T, b_T, whether the law of the others
/// placed it, and the standard errors of ln a_T and ln b_T. It also has the kind of vertical shift and whether the data show it,
/// the temperature of the curve, and the shift law as JSON.
#[pyfunction]
pub(crate) fn fit_isotherms<'py>(
    py: Python<'py>,
    isotherms: Vec<Given<'py>>,
    celsius: bool,
    superposition: Superposition,
    options: Options,
) -> PyResult<Bound<'py, PyDict>> {
    let isotherm = |(temperature, columns): &Given<'py>| Isotherm {
        temperature: *temperature,
        points: points(columns),
    };
    let isotherms: Vec<Isotherm> = isotherms.iter().map(isotherm).collect();
    let shifting = superposition.shifting()?;
    let found = py
        .detach(|| moduli::master_curve(&isotherms, celsius, shifting))
        .map_err(wrong)?;
    let master = found.master;
    let shift = found.shift.map(|shift| serde_json::to_string(&shift));
    let of_isotherms = master.shifts.len() > 1;
    let dictionary = fitted(py, Ok(master.curve), &options, of_isotherms)?;
    let place = |shift: &IsothermShift| {
        let factors = (shift.log10_factor, shift.modulus_factor);
        (shift.temperature, factors, shift.placed_by_law)
    };
    let places: Vec<_> = master.shifts.iter().map(place).collect();
    dictionary.set_item("shifts", places)?;
    dictionary.set_item("vertical", name_of(master.vertical))?;
    let found_in_data = master.vertical_choice != VerticalChoice::NotInData;
    dictionary.set_item("vertical_is_found", found_in_data)?;
    dictionary.set_item("temperature", master.reference_temperature)?;
    dictionary.set_item("shift", shift.transpose().map_err(wrong)?)?;
    Ok(dictionary)
}

/// The vertical shift with this name; a `ValueError` if there is none.
fn vertical_shift(name: &str) -> PyResult<VerticalShift> {
    let named = VerticalShift::NAMED.into_iter();
    let mut kinds = named.filter_map(|(own, kind)| (own == name).then_some(kind));
    let names = VerticalShift::NAMED
        .map(|(name, _)| format!("{name:?}"))
        .join(", ");
    kinds
        .next()
        .ok_or_else(|| wrong(format!("vertical must be one of {names}, but is {name:?}")))
}

/// Name of a vertical shift; `None` if it has none.
fn name_of(vertical: VerticalShift) -> Option<&'static str> {
    let mut named = VerticalShift::NAMED.into_iter();
    named.find_map(|(name, kind)| (kind == vertical).then_some(name))
}

/// Factors a_T and b_T on all times and moduli at a temperature \[°C], by a shift law as JSON, and the law about this temperature.
#[pyfunction]
pub(crate) fn shifted(shift: &str, temperature: f64) -> PyResult<(f64, f64, String)> {
    let shift: Shift = serde_json::from_str(shift).map_err(wrong)?;
    let log10_factor = shift.log10_factor(temperature).map_err(wrong)?;
    let modulus_factor = shift.modulus_factor(temperature).map_err(wrong)?;
    let law = shift.with_reference(temperature).map_err(wrong)?;
    let law = serde_json::to_string(&law).map_err(wrong)?;
    Ok((10_f64.powf(log10_factor), modulus_factor, law))
}
