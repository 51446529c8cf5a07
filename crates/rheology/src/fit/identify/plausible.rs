//! Tests whether moduli are those of a relaxing material.
//!
//! Its G' never decreases with frequency, and its G(t) never increases with time. Moreover, a series of many branches
//! approximates the moduli of every relaxing material.

use super::{Identification, IdentifyOptions, LongTimeLimit, series_of};
use crate::RheologyError;
use crate::fit::curve::MeasuredCurve;
use crate::fit::system::Quantity;

/// Root mean square relative error of |G*|, G' or G(t) above which the data are refused as those of no relaxing material.
/// Chosen: moduli are measured to some per cent; wrong columns or units make a far larger error.
const MAX_RMS_ERROR: f64 = 0.2;
/// Root mean square relative error of G'' above which the data are refused. Chosen: larger than [`MAX_RMS_ERROR`], because
/// G'' of a stiff material is mostly noise.
const MAX_LOSS_RMS_ERROR: f64 = 0.5;
/// Smallest ratio of the error with the moduli as given to the error with exchanged moduli, which shows that they are
/// swapped. Chosen: for noise alone the ratio is near 1, since a bad series fits neither order.
const SWAP_IMPROVEMENT: f64 = 3.0;
/// Smallest number of points with which a trend counts as significant. Chosen: a line through fewer leaves at most two
/// residuals for its standard error.
const MIN_TREND_POINTS: usize = 5;
/// Smallest slope with which a trend counts as significant, in standard errors. Chosen: in one of 16 000 curves noise alone
/// exceeds it.
const TREND_STANDARD_ERRORS: f64 = 4.0;
/// Smallest ratio of the change over the curve to the mean modulus with which a trend counts as significant. Chosen: a
/// smaller one may be drift of the instrument.
const MIN_RELATIVE_TREND: f64 = 0.05;
/// Largest relative variation with which moduli count as constant. Chosen: it is the rounding of a table, below the noise of
/// any measurement.
const CONSTANCY_TOLERANCE: f64 = 1e-6;

/// Refuses moduli that no series of any number of branches describes.
///
/// A badly fitting `found` series of few branches is no reason: it is compared with a dense one.
pub(super) fn check(
    curve: &MeasuredCurve,
    long_time_limit: LongTimeLimit,
    found: Option<&Identification>,
) -> Result<(), RheologyError> {
    let trend = wrong_trend(curve);
    if trend.is_none() && found.is_some_and(|found| !is_bad(found)) {
        return Ok(());
    }
    // Compare the fit with one of swapped moduli.
    let options = IdentifyOptions {
        long_time_limit,
        ..IdentifyOptions::default()
    };
    let best = |curve: &MeasuredCurve| series_of(curve, &options).ok();
    let given = best(curve);
    let swapped = curve.swapped().and_then(|swapped| best(&swapped));
    if let Some((given, swapped)) = given.as_ref().zip(swapped) {
        let [given, swapped] = [given.rms_relative_error, swapped.rms_relative_error];
        if given > MAX_RMS_ERROR && swapped < given / SWAP_IMPROVEMENT {
            return Err(RheologyError::SwappedModuli { given, swapped });
        }
    }
    // Report a trend that no material has, or an error that is too large.
    if let Some(what) = trend {
        return Err(RheologyError::WrongTrend { what });
    }
    match given {
        Some(given) if is_bad(&given) => {
            let rms = given.rms_relative_error;
            let error = |one: Option<super::RelativeError>| one.map_or(rms, |error| error.rms);
            Err(RheologyError::NoMaterial {
                storage: error(given.storage_error),
                loss: error(given.loss_error),
            })
        }
        _ => Ok(()),
    }
}

/// True if the error of the fit, or that of one modulus, is too large.
fn is_bad(found: &Identification) -> bool {
    let exceeds =
        |error: Option<super::RelativeError>, most| error.is_some_and(|one| one.rms > most);
    found.rms_relative_error > MAX_RMS_ERROR
        || exceeds(found.storage_error, MAX_RMS_ERROR)
        || exceeds(found.loss_error, MAX_LOSS_RMS_ERROR)
}

/// Description of a trend that no relaxing material has; `None` without one.
fn wrong_trend(curve: &MeasuredCurve) -> Option<&'static str> {
    let values = |quantity| {
        let rows = curve
            .rows
            .iter()
            .filter(move |row| row.quantity == quantity);
        rows.map(|row| [row.at.ln(), row.value]).collect::<Vec<_>>()
    };
    let moduli = [Quantity::Storage, Quantity::Loss, Quantity::Relaxation].map(values);
    let [storage, _, relaxation] = &moduli;
    if moduli.iter().all(|points| is_constant(points)) && curve.rows.len() >= MIN_TREND_POINTS {
        return Some("the moduli are the same at all points");
    }
    if rises(storage, -1.0) {
        return Some("the storage modulus falls with frequency");
    }
    rises(relaxation, 1.0).then_some("the relaxation modulus rises with time")
}

/// True if all values are the same, within a tolerance.
fn is_constant(points: &[[f64; 2]]) -> bool {
    let first = points.first().map_or(0.0, |point| point[1]);
    points
        .iter()
        .all(|point| (point[1] - first).abs() <= CONSTANCY_TOLERANCE * first)
}

/// Whether the regression line of values over logarithms rises significantly, or falls for the sign −1.
fn rises(points: &[[f64; 2]], sign: f64) -> bool {
    let n = points.len() as f64;
    let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / n;
    let middle = [0, 1].map(mean);
    let sum = |one: usize, other: usize| -> f64 {
        let products = points
            .iter()
            .map(|point| (point[one] - middle[one]) * (point[other] - middle[other]));
        products.sum()
    };
    if points.len() < MIN_TREND_POINTS {
        return false;
    }
    // The slope must exceed its standard error, and change the modulus noticeably over the curve.
    let slope = sign * sum(0, 1) / sum(0, 0);
    let scatter = (sum(1, 1) - slope * slope * sum(0, 0)).max(0.0) / (n - 2.0);
    let width = points[points.len() - 1][0] - points[0][0];
    slope > TREND_STANDARD_ERRORS * (scatter / sum(0, 0)).sqrt()
        && slope * width > MIN_RELATIVE_TREND * middle[1]
}
