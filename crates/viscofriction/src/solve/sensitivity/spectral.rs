//! Derivatives of an answer by the complex modulus at each frequency.

use std::f64::consts::PI;

use bem_halfspace::steady::sensitivity::{ByModuli, Change};
use numerics::{Estimate, Progress, WorkProgress};
use serde::Serialize;

use super::Sensitivity;
use super::adjoint::AnswerChange;
use super::adjoint::{self, Contact, check_surfaces};
use crate::scene::{Method, SceneError};
use crate::solve::answer::Answer;
use crate::solve::error::{Result, SolveError};
use crate::solve::problem::{Motion, Problem};

/// Number of frequency bands per decade. Chosen: it is the resolution of the output, and changes no sum over bands.
const BANDS_PER_DECADE: f64 = 10.0;
/// Number of bands computed between two reports of progress. Chosen: it sets how often progress is reported, and changes no
/// number.
const BANDS_AT_ONCE: usize = 8;
/// Ratio of the lowest resolved frequency to v/a, where v is the velocity and a the contact length. Chosen: friction comes
/// from far shorter waves; a depth depends on longer ones too, which form the first band.
const MIN_FREQUENCY_RATIO: f64 = 0.01;

/// Derivatives of the quantities of an answer by the complex modulus, in frequency bands.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SpectralSensitivity {
    /// Bands of increasing frequency; the first begins at 0.
    pub bands: Vec<ByFrequency>,
    /// Fraction of the sum of the absolute derivatives of friction that lies outside the measured frequencies; `None` if the scene
    /// states no such range.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outside_valid_frequencies: Option<f64>,
}

/// Derivatives by the logarithm of a modulus that changes in one frequency band only.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ByFrequency {
    /// Lower and upper angular frequency of the band, \[rad/s].
    pub frequencies: [f64; 2],
    /// Derivatives by the logarithm of the storage modulus G'.
    pub storage_modulus: Sensitivity,
    /// Derivatives by the logarithm of the loss modulus G''.
    pub loss_modulus: Sensitivity,
}

/// Computes the derivatives by storage and loss modulus at each frequency, for stationary sliding by boundary elements. `watch`
/// receives the progress.
///
/// # Errors
/// [`SolveError::NoSpectralSensitivity`] for other methods and motions.
pub fn spectral_sensitivity(
    problem: &Problem,
    answer: &Answer,
    watch: &dyn Progress,
) -> Result<SpectralSensitivity> {
    check_given_moduli(problem)?;
    let method = answer.method;
    let (Method::BemSteady, Motion::Sliding(load)) = (method, problem.motion()) else {
        return Err(SolveError::NoSpectralSensitivity { method });
    };
    let wave_numbers = wave_numbers(answer).ok_or(SolveError::NoSpectralSensitivity { method })?;
    let ends = wave_numbers.map(|wave_number| load.velocity() * wave_number);
    // The adjoint solutions take about as long as all bands.
    let mut progress = WorkProgress::new(watch, 2.0);
    let contact = Contact::new(problem, load, answer)?;
    progress.add(1.0);
    let edges = band_edges(ends, problem.window());
    let n_bands = edges.len() - 1;
    let mut bands = Vec::with_capacity(n_bands);
    for first in (0..n_bands).step_by(BANDS_AT_ONCE) {
        let last = n_bands.min(first + BANDS_AT_ONCE);
        let found = contact.by_moduli(&edges[first..=last])?;
        bands.extend(
            found
                .into_iter()
                .map(|band| derivatives_in_band(answer, band)),
        );
        progress.add((last - first) as f64 / n_bands as f64);
    }
    Ok(SpectralSensitivity {
        outside_valid_frequencies: problem
            .window()
            .map(|window| fraction_outside(&bands, window)),
        bands,
    })
}

/// Rejects a problem with heat or strain dependence, in which the modulus at each frequency also changes the others.
fn check_given_moduli(problem: &Problem) -> std::result::Result<(), SceneError> {
    let refused = |key: &str, why: &str| Err(SceneError::at(key, why));
    if problem.strain_dependence().is_some() {
        return refused(
            "strain",
            "derivatives by the modulus at each frequency are those at given moduli, and here all change with the strain of the contact; \
             leave [strain] out",
        );
    }
    if problem.heating().is_some() {
        return refused(
            "heat",
            "derivatives by the modulus at each frequency are those at a given temperature, and here that of the contact changes, too; \
             leave [heat] out and give material.file.temperature",
        );
    }
    Ok(())
}

/// Rejects a problem whose answer by a method has no derivatives by the modulus at each frequency.
pub(super) fn check_spectral_sensitivity(
    problem: &Problem,
    method: Method,
) -> std::result::Result<(), SceneError> {
    check_given_moduli(problem)?;
    if !matches!(
        (method, problem.motion()),
        (Method::BemSteady, Motion::Sliding(_))
    ) {
        let none = SolveError::NoSpectralSensitivity { method };
        return Err(SceneError::at("solve.method", none.to_string()));
    }
    if problem.track().is_some() {
        let why = "derivatives by the modulus at each frequency are known on fresh ground only; leave this out";
        return Err(SceneError::at("load.track", why));
    }
    check_surfaces(problem)
}

impl SpectralSensitivity {
    /// Columns of a table: the ends of the bands \[rad/s], then each known derivative by either modulus with its error.
    pub fn columns(&self) -> Vec<(String, Vec<f64>)> {
        let column = |of: &dyn Fn(&ByFrequency) -> f64| self.bands.iter().map(of).collect();
        let mut columns = vec![
            (
                "from_rad_per_s".to_owned(),
                column(&|band| band.frequencies[0]),
            ),
            (
                "to_rad_per_s".to_owned(),
                column(&|band| band.frequencies[1]),
            ),
        ];
        let Some(first) = self.bands.first() else {
            return columns;
        };
        for (key, _) in first.loss_modulus.derivatives.iter() {
            for modulus in ["storage", "loss"] {
                let of = |band: &ByFrequency| match modulus {
                    "storage" => band.storage_modulus.derivatives.of(key),
                    _ => band.loss_modulus.derivatives.of(key),
                };
                let value = column(&|band| of(band).map_or(f64::NAN, |known| known.value));
                let error = column(&|band| of(band).map_or(f64::NAN, |known| known.error));
                columns.push((format!("{key}_by_{modulus}_modulus"), value));
                columns.push((format!("{key}_by_{modulus}_modulus_error"), error));
            }
        }
        columns
    }
}

/// Smallest resolved wave number along x and the largest one of the grid, \[1/m]; `None` without a contact.
fn wave_numbers(answer: &Answer) -> Option<[f64; 2]> {
    match answer.stationary {
        Some(options) => {
            let [rear, front] = answer.contact_box.as_ref()?.x;
            Some([
                MIN_FREQUENCY_RATIO / (front - rear),
                PI / options.spacing[0],
            ])
        }
        None => {
            let grid = answer.fields.pressure.as_ref()?.grid;
            let (rows, spacing) = (grid.shape()[0] as f64, grid.spacing()[0]);
            Some([2.0 * PI / (rows * spacing), PI / spacing])
        }
    }
}

/// Edges of the bands, increasing, \[rad/s]: 0, the powers of 10^(1/10) from below `lowest` to above `highest`, and the ends of
/// the measured window among them.
fn band_edges([lowest, highest]: [f64; 2], window: Option<[f64; 2]>) -> Vec<f64> {
    let [first, last] = [lowest, highest].map(|end| BANDS_PER_DECADE * end.log10());
    let number = |index: i32| 10.0_f64.powf(f64::from(index) / BANDS_PER_DECADE);
    let mut edges = vec![0.0];
    #[expect(clippy::cast_possible_truncation, reason = "logarithms of numbers")]
    edges.extend((first.floor() as i32..=last.ceil() as i32).map(number));
    let within = |end: &f64| *end > edges[1] && *end < edges[edges.len() - 1];
    let ends: Vec<f64> = window.into_iter().flatten().filter(within).collect();
    edges.extend(ends);
    edges.sort_by(f64::total_cmp);
    edges.dedup();
    edges
}

/// Derivatives by both moduli in one band.
fn derivatives_in_band(answer: &Answer, band: ByModuli) -> ByFrequency {
    let of = |name: &str, change: Change<Estimate>| {
        let change = AnswerChange::of_contact(change);
        adjoint::log_derivatives(name.to_owned(), answer, change, 1.0)
    };
    ByFrequency {
        frequencies: band.frequencies,
        storage_modulus: of("storage_modulus", band.storage_modulus),
        loss_modulus: of("loss_modulus", band.loss_modulus),
    }
}

/// Fraction of the sum of the absolute derivatives of friction, by both moduli and over all bands, from bands outside the
/// measured frequencies \[rad/s].
fn fraction_outside(bands: &[ByFrequency], [lowest, highest]: [f64; 2]) -> f64 {
    let size = |band: &ByFrequency| {
        let both = [&band.storage_modulus, &band.loss_modulus];
        let sizes = both.map(|one| {
            let known = one.derivatives.of("friction_coefficient");
            known.map_or(0.0, |known| known.value.abs())
        });
        sizes.iter().sum::<f64>()
    };
    let is_outside =
        |band: &&ByFrequency| band.frequencies[1] <= lowest || band.frequencies[0] >= highest;
    let all: f64 = bands.iter().map(size).sum();
    // `sum` of an empty iterator is -0, which would be printed.
    let outside = bands.iter().filter(is_outside).map(size);
    outside.fold(0.0, |sum, size| sum + size) / all
}
