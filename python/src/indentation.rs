//! Fit of a material to a measured curve of force over depth.

use std::path::PathBuf;

use measurements::indentation::{
    CurveFile, CurveOptions, FitOptions, IndentationCurve, IndentationFit, Rheology, Thickness,
    fit_indentation, indentation_curve,
};
use measurements::{Finding, MeasurementError};
use numpy::{IntoPyArray as _, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Deserialize as _;
use viscofriction::scene::Indenter;
use viscofriction::solve::body;
use viscofriction::{Body, Files, rheology};

use crate::reading::{read_file, read_table};
use crate::tables::{table, wrong};

/// Arguments of [`fit_curve`].
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Curve<'py> {
    body: Bound<'py, PyDict>,
    /// File of the curve; `None` if it is in `columns`: time, depth and force.
    file: Option<PathBuf>,
    columns: Option<[PyReadonlyArray1<'py, f64>; 3]>,
    spring_constant: Option<f64>,
    sensitivity: Option<f64>,
    ramp_rate: Option<f64>,
    material: String,
    branches: Option<usize>,
    poisson_ratio: f64,
    /// Thickness \[m], or "fit"; `None` for a half space.
    thickness: Option<ThicknessOf>,
    tilt: bool,
    before_retraction: bool,
    profile: bool,
}

/// A thickness argument.
#[derive(FromPyObject)]
enum ThicknessOf {
    Known(f64),
    Fitted(String),
}

impl Curve<'_> {
    /// Thickness of the sample as the call gives it: a number, or "fit".
    fn thickness(&self) -> PyResult<Thickness> {
        match &self.thickness {
            None => Ok(Thickness::Infinite),
            Some(ThicknessOf::Known(thickness)) => Ok(Thickness::Known(*thickness)),
            Some(ThicknessOf::Fitted(word)) if word == "fit" => Ok(Thickness::Fitted),
            Some(ThicknessOf::Fitted(other)) => Err(wrong(format!(
                "thickness must be a number [m] or \"fit\", but is {other:?}"
            ))),
        }
    }

    /// The measured curve, from the arrays or from the file of the call.
    fn measured(&self) -> PyResult<CurveFile> {
        if let Some([time, depth, force]) = &self.columns {
            let [time, depth, force] = [time, depth, force].map(|one| one.as_array().to_vec());
            let curve = IndentationCurve { time, depth, force };
            return Ok(CurveFile {
                curve,
                notes: Vec::new(),
            });
        }
        let options = CurveOptions {
            spring_constant: self.spring_constant,
            sensitivity: self.sensitivity,
            ramp_rate: self.ramp_rate,
        };
        let file = self.file.clone().unwrap_or_default();
        let contents = read_table(&file).map_err(wrong)?;
        indentation_curve(&file, &contents, &options).map_err(wrong)
    }

    /// The message of the command-line program, with the file if its contents are wrong.
    fn refused(&self, error: &MeasurementError) -> PyErr {
        match (&self.file, error) {
            (Some(file), other) if !matches!(other, MeasurementError::InvalidParameter(_)) => {
                wrong(format!("{}: {other}", file.display()))
            }
            (_, error) => wrong(error),
        }
    }

    /// The options of the fit; an error names an unknown word.
    fn options(&self) -> PyResult<FitOptions> {
        let rheology = match &self.material[..] {
            "elastic" => Rheology::Elastic,
            "standard-solid" => Rheology::StandardSolid,
            "prony" => Rheology::Prony,
            "power-law" => Rheology::PowerLaw,
            other => {
                let allowed = "\"elastic\", \"standard-solid\", \"prony\" or \"power-law\"";
                return Err(wrong(format!(
                    "material must be {allowed}, but is {other:?}"
                )));
            }
        };
        if self.branches.is_some() && rheology != Rheology::Prony {
            return Err(wrong(
                "branches is for material \"prony\"; the other materials have no branches to choose",
            ));
        }
        Ok(FitOptions {
            rheology,
            branches: self.branches,
            poisson_ratio: self.poisson_ratio,
            thickness: self.thickness()?,
            tilt: self.tilt,
            before_retraction: self.before_retraction,
            profile: self.profile,
        })
    }
}

/// Fits a material to a curve; returns a dictionary.
#[pyfunction]
pub(crate) fn fit_curve<'py>(py: Python<'py>, curve: Curve<'py>) -> PyResult<Bound<'py, PyDict>> {
    let files = Files {
        folder: "".as_ref(),
        read: read_file,
        memory: None,
    };
    let indenter = Indenter::deserialize(table(&curve.body, "")?).map_err(wrong)?;
    let Body::Revolution(body) = body(&indenter, &files).map_err(wrong)?.body else {
        return Err(wrong("body must be a body of revolution"));
    };
    let options = curve.options()?;
    let CurveFile {
        curve: measured,
        notes,
    } = curve.measured()?;
    let mut fit = py
        .detach(|| fit_indentation(&*body, &measured, &options))
        .map_err(|error| curve.refused(&error))?;
    fit.notes.splice(0..0, notes);
    to_python(py, fit)
}

/// Result of a fit as a dictionary.
fn to_python(py: Python<'_>, fit: IndentationFit) -> PyResult<Bound<'_, PyDict>> {
    let finding = |one: &Finding| {
        let estimate = one.estimate.map(|one| (one.value, one.error));
        (one.name.clone(), one.unit, estimate, one.interval)
    };
    let findings: Vec<_> = fit.findings.iter().map(finding).collect();
    let spectrum = rheology::Material::relaxation(&fit.material);
    let branches: Vec<_> = spectrum
        .branches()
        .iter()
        .map(|branch| (branch.modulus, branch.relaxation_time))
        .collect();
    let points = [0, 1, 2, 3].map(|k| {
        let column: Vec<f64> = fit.points.iter().map(|point| point[k]).collect();
        column.into_pyarray(py)
    });
    let flags: Vec<String> = fit.flags.iter().map(ToString::to_string).collect();
    let notes: Vec<String> = fit.notes.iter().map(ToString::to_string).collect();
    let dictionary = PyDict::new(py);
    dictionary.set_item("findings", findings)?;
    dictionary.set_item("correlation", fit.correlation)?;
    dictionary.set_item("equilibrium_modulus", spectrum.equilibrium_modulus())?;
    dictionary.set_item("branches", branches)?;
    let [lowest, highest] = fit.valid_frequencies;
    dictionary.set_item("valid_frequencies", (lowest, highest))?;
    dictionary.set_item("noise", fit.noise)?;
    dictionary.set_item("residual", fit.residual)?;
    dictionary.set_item("correlated_points", fit.correlated_points)?;
    dictionary.set_item("points", points)?;
    dictionary.set_item("flags", flags)?;
    dictionary.set_item("notes", notes)?;
    Ok(dictionary)
}
