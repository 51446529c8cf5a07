//! Fit of the moduli of a scene's material, and of its interface, to measured friction.

use std::path::PathBuf;

use measurements::friction::{
    FrictionNoise, FrictionPoint, FrictionTable, FrictionTableOptions, friction_points,
};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use viscofriction::Scene;
use viscofriction::friction_fit::{Free, FrictionFitOptions, fit_friction};

use crate::reading::{read_file, read_table};
use crate::tables::{table, wrong};

/// Arguments of [`fit_points`].
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Measured<'py> {
    scene: Bound<'py, PyDict>,
    /// Folder of the files that the scene names.
    folder: PathBuf,
    /// File of the points; `None` if they are in `columns`: velocity, friction, and optionally standard errors, temperatures
    /// \[°C] and normal forces.
    file: Option<PathBuf>,
    columns: Option<[Option<PyReadonlyArray1<'py, f64>>; 5]>,
    free: Vec<String>,
    noise: String,
    prior: String,
    track_radius: Option<f64>,
    run_in: Option<f64>,
}

impl Measured<'_> {
    /// The measured points, from the file or from the arrays of the call.
    fn table(&self) -> PyResult<FrictionTable> {
        let Some(columns) = &self.columns else {
            let file = self.file.clone().unwrap_or_default();
            let contents = read_table(&file).map_err(wrong)?;
            let options = FrictionTableOptions {
                track_radius: self.track_radius,
                run_in: self.run_in,
            };
            return friction_points(&file, &contents, &options).map_err(wrong);
        };
        let [
            velocity,
            friction,
            standard_error,
            temperature,
            normal_force,
        ] = columns
            .each_ref()
            .map(|one| one.as_ref().map(|one| one.as_array().to_vec()));
        let at = |column: &Option<Vec<f64>>, row: usize| column.as_ref().map(|all| all[row]);
        let pairs = velocity.iter().flatten().zip(friction.iter().flatten());
        let points = pairs
            .enumerate()
            .map(|(row, (velocity, friction))| FrictionPoint {
                velocity: *velocity,
                friction_coefficient: *friction,
                standard_error: at(&standard_error, row),
                temperature: at(&temperature, row),
                normal_force: at(&normal_force, row),
            });
        Ok(FrictionTable {
            points: points.collect(),
            notes: Vec::new(),
        })
    }

    /// The options of the fit; an error names an unknown word.
    fn options(&self) -> PyResult<FrictionFitOptions> {
        let free = |word: &String| match &word[..] {
            "moduli" => Ok(Free::Moduli),
            "shift" => Ok(Free::Shift),
            "interface" => Ok(Free::Interface),
            other => {
                let allowed = "\"moduli\", \"shift\", \"interface\", or a list of them";
                Err(wrong(format!("free must be {allowed}, but is {other:?}")))
            }
        };
        let noise = match &self.noise[..] {
            "relative" => FrictionNoise::Relative,
            "absolute" => FrictionNoise::Absolute,
            other => {
                let allowed = "\"relative\" or \"absolute\"";
                return Err(wrong(format!("noise must be {allowed}, but is {other:?}")));
            }
        };
        Ok(FrictionFitOptions {
            free: self.free.iter().map(free).collect::<PyResult<_>>()?,
            noise,
            prior: self.prior.parse().map_err(wrong)?,
        })
    }
}

/// The points of a table of measured friction, and notes on what the reader assumed, as JSON.
#[pyfunction]
pub(crate) fn read_friction(
    py: Python<'_>,
    file: PathBuf,
    track_radius: Option<f64>,
    run_in: Option<f64>,
) -> PyResult<String> {
    let read = || {
        let options = FrictionTableOptions {
            track_radius,
            run_in,
        };
        let FrictionTable { points, notes } =
            friction_points(&file, &read_table(&file).map_err(wrong)?, &options).map_err(wrong)?;
        let in_file = |error| wrong(format!("{}: {error}", file.display()));
        FrictionPoint::check_all(&points).map_err(in_file)?;
        let found = serde_json::json!({ "points": points, "notes": notes });
        Ok(found.to_string())
    };
    py.detach(read)
}

/// Fits a material to friction; returns JSON.
#[pyfunction]
pub(crate) fn fit_points(py: Python<'_>, measured: Measured<'_>) -> PyResult<String> {
    let scene = Scene::try_from(table(&measured.scene, "")?).map_err(wrong)?;
    let (FrictionTable { points, notes }, options) = (measured.table()?, measured.options()?);
    let folder = measured.folder.clone();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(scene.solve.threads.unwrap_or(0))
        .build()
        .map_err(wrong)?;
    let fit = || fit_friction(&scene, (&folder, read_file), &points, &options, &|_| ());
    let found = py.detach(|| pool.install(fit)).map_err(wrong)?;
    let mut found = serde_json::to_value(&found).map_err(wrong)?;
    found["notes"] = notes.into();
    serde_json::to_string(&found).map_err(wrong)
}
