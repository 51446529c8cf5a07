//! What a rough surface is like.

use numpy::{PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use viscofriction::indenters::rough::{PowerSpectrum, Roughness};

use crate::solving::height_map;
use crate::tables::wrong;

/// The parameters and spectra of a surface by their names.
#[pyfunction]
pub(crate) fn surface_numbers<'py>(
    py: Python<'py>,
    heights: PyReadonlyArray2<'py, f64>,
    spacing: [f64; 2],
    repeats: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let map = height_map(&heights, spacing)?;
    let found = Roughness::of(&map, repeats).map_err(wrong)?;
    let spectrum = PowerSpectrum::of(&map, repeats).map_err(wrong)?;
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
    Ok(numbers)
}
