//! Roughness parameters and spectra of a surface from an array.

use numpy::{IntoPyArray as _, PyArray2, PyArrayMethods as _, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use viscofriction::indenters::rough::{PowerSpectrum, Roughness};
use viscofriction::indenters::topography::Topography;
use viscofriction::scene::{Edges, HeightMapTable, SceneError};
use viscofriction::solve::{AdviceOnHeights, warnings_of_heights};

use crate::reading::read_file;
use crate::tables::{table, wrong};

/// Roughness parameters and spectra of a surface by name.
#[pyfunction]
pub(crate) fn surface_numbers<'py>(
    py: Python<'py>,
    heights: PyReadonlyArray2<'py, f64>,
    keys: &Bound<'py, PyDict>,
) -> PyResult<Bound<'py, PyDict>> {
    let (table, surface) = prepared(&heights, keys)?;
    let compute = || {
        let map = surface.body().map_err(wrong)?;
        let mut warnings = warnings_of_heights(&table, &surface, &map, &AdviceOnHeights::SCENE);
        warnings.extend(surface.notes);
        let map = match table.edges {
            Edges::Mirrored => map.mirrored(),
            _ => map,
        };
        let repeats = table.edges != Edges::Wall;
        let found = Roughness::of(&map, repeats).map_err(wrong)?;
        let spectrum = PowerSpectrum::of(&map, repeats).map_err(wrong)?;
        Ok::<_, PyErr>((found, spectrum, warnings))
    };
    let (found, spectrum, warnings) = py.detach(compute)?;
    let numbers = PyDict::new(py);
    for (name, number) in [
        ("rms_height", found.rms_height),
        ("mean_deviation", found.mean_deviation),
        ("skewness", found.skewness),
        ("kurtosis", found.kurtosis),
        ("peak", found.peak),
        ("pit", found.pit),
        ("rms_gradient", found.rms_gradient()),
        ("rms_curvature", found.rms_curvature),
        ("nayak", found.nayak),
    ] {
        numbers.set_item(name, number)?;
    }
    let [x, y] = found.rms_slopes;
    numbers.set_item("rms_slopes", (x, y))?;
    let rings = spectrum.radial.iter();
    let rings: Vec<_> = rings.map(|r| vec![r.wave_number, r.density]).collect();
    numbers.set_item("spectrum", PyArray2::from_vec2(py, &rings)?)?;
    let [x, y] = spectrum.profiles.map(|profile| {
        let points: Vec<_> = profile.iter().map(|point| point.to_vec()).collect();
        PyArray2::from_vec2(py, &points)
    });
    numbers.set_item("profile_spectra", (x?, y?))?;
    numbers.set_item("warnings", warnings)?;
    Ok(numbers)
}

/// Heights, their distances along x and y, and notes.
type HeightsOfFile<'py> = (Bound<'py, PyArray2<f64>>, [f64; 2], Vec<String>);

/// The surface in a file of heights as a scene with these keys has it: heights \[m] out of the body with x along the motion, their
/// distances along x and y \[m], and notes on units, holes and what the reader assumed.
#[pyfunction]
pub(crate) fn read_heights<'py>(
    py: Python<'py>,
    keys: &Bound<'py, PyDict>,
) -> PyResult<HeightsOfFile<'py>> {
    let keys = HeightMapTable::try_from(table(keys, "")?).map_err(named)?;
    let read = || {
        let contents = read_file(&keys.file, MAX_FILE_OF_HEIGHTS).map_err(wrong)?;
        let memory = MAX_FILE_OF_HEIGHTS - contents.len() as u64;
        let surface = keys.read(&keys.file, &contents, memory).map_err(named)?;
        let surface = keys.prepared(surface).map_err(named)?;
        let map = surface.body().map_err(wrong)?;
        let mut notes = warnings_of_heights(&keys, &surface, &map, &AdviceOnHeights::SCENE);
        notes.extend(surface.notes.iter().cloned());
        Ok::<_, PyErr>((surface, notes))
    };
    let (surface, notes) = py.detach(read)?;
    let heights = surface.heights.into_pyarray(py).reshape(surface.shape)?;
    Ok((heights, surface.spacing, notes))
}

/// Largest file of heights with what is derived from it, \[bytes]. Chosen: the memory limit of a scene that gives none, 4 GiB.
const MAX_FILE_OF_HEIGHTS: u64 = 1 << 32;

/// Exception for an error of a table of heights, whose keys are arguments without a path in Python, and the heights perhaps no file.
fn named(error: SceneError) -> PyErr {
    let text = error.to_string().replace("indenter.height-map.", "");
    let text = text.strip_prefix("file: ").unwrap_or(&text);
    wrong(text)
}

/// Raises an error for heights that form no surface, and for keys that do not match them.
#[pyfunction]
pub(crate) fn check_height_map(
    heights: PyReadonlyArray2<'_, f64>,
    keys: &Bound<'_, PyDict>,
) -> PyResult<()> {
    prepared(&heights, keys).map(drop)
}

/// The table of the keys, and the surface prepared by it.
fn prepared(
    heights: &PyReadonlyArray2<'_, f64>,
    keys: &Bound<'_, PyDict>,
) -> PyResult<(HeightMapTable, Topography)> {
    let table = HeightMapTable::try_from(table(keys, "")?).map_err(named)?;
    let surface = topography(heights, &table).and_then(|surface| {
        let surface = table.prepared(surface);
        surface.map_err(named)
    })?;
    Ok((table, surface))
}

/// The heights of an array, with the spacing of its table.
pub(crate) fn topography(
    heights: &PyReadonlyArray2<'_, f64>,
    table: &HeightMapTable,
) -> PyResult<Topography> {
    let spacing = table.spacing.ok_or_else(|| wrong("spacing is missing"))?;
    let array = heights.as_array();
    let shape = [array.nrows(), array.ncols()];
    // The iterator yields rows independent of the strides.
    let by_rows = array.iter().copied().collect();
    Ok(Topography::of_rows(shape, spacing, by_rows))
}
