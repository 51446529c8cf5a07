//! Whether moduli are those of a relaxing material.
//!
//! Its G' never falls with frequency, and its G(t) never rises with time. Beyond that a series of many branches is the test: it
//! comes near to the moduli of every relaxing material.

use super::{Ending, Identification, IdentifyOptions, series_of};
use crate::RheologyError;
use crate::fit::curve::MeasuredCurve;
use crate::fit::system::Quantity;

/// A larger error of |G*|, G' or G(t) than this is that of no relaxing material; G'' of a stiff one is mostly noise.
const BAD: f64 = 0.2;
const BAD_LOSS: f64 = 0.5;
/// Swapped moduli fit so much better.
const BETTER: f64 = 3.0;
/// Points, standard errors, and part of the modulus by which it certainly goes the wrong way.
const LEAST_POINTS: usize = 5;
const CERTAIN: f64 = 4.0;
const LEAST_FALL: f64 = 0.05;
/// Moduli that vary by less are all the same.
const SAME: f64 = 1e-6;

/// Refuses moduli that are those of no relaxing material, however many branches it has. A `found` series of few branches may
/// fit badly on purpose.
pub(super) fn check(
    curve: &MeasuredCurve,
    ending: Ending,
    found: Option<&Identification>,
) -> Result<(), RheologyError> {
    let trend = wrong_trend(curve);
    if trend.is_none() && found.is_some_and(|found| !is_bad(found)) {
        return Ok(());
    }
    let options = IdentifyOptions {
        ending,
        ..IdentifyOptions::default()
    };
    let best = |curve: &MeasuredCurve| series_of(curve, &options).ok();
    let given = best(curve);
    let swapped = curve.swapped().and_then(|swapped| best(&swapped));
    if let Some((given, swapped)) = given.as_ref().zip(swapped) {
        let [given, swapped] = [given.rms_relative_error, swapped.rms_relative_error];
        if given > BAD && swapped < given / BETTER {
            return Err(RheologyError::SwappedModuli { given, swapped });
        }
    }
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

fn is_bad(found: &Identification) -> bool {
    let exceeds =
        |error: Option<super::RelativeError>, most| error.is_some_and(|one| one.rms > most);
    found.rms_relative_error > BAD
        || exceeds(found.storage_error, BAD)
        || exceeds(found.loss_error, BAD_LOSS)
}

/// What the moduli do that those of no relaxing material do.
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
    if moduli.iter().all(|points| is_constant(points)) && curve.rows.len() >= LEAST_POINTS {
        return Some("the moduli are the same at all points");
    }
    if rises(storage, -1.0) {
        return Some("the storage modulus falls with frequency");
    }
    rises(relaxation, 1.0).then_some("the relaxation modulus rises with time")
}

fn is_constant(points: &[[f64; 2]]) -> bool {
    let first = points.first().map_or(0.0, |point| point[1]);
    points
        .iter()
        .all(|point| (point[1] - first).abs() <= SAME * first)
}

/// Whether the line of least squares through values over logarithms certainly rises, or with the sign −1 falls.
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
    if points.len() < LEAST_POINTS {
        return false;
    }
    let slope = sign * sum(0, 1) / sum(0, 0);
    let scatter = (sum(1, 1) - slope * slope * sum(0, 0)).max(0.0) / (n - 2.0);
    let width = points[points.len() - 1][0] - points[0][0];
    slope > CERTAIN * (scatter / sum(0, 0)).sqrt() && slope * width > LEAST_FALL * middle[1]
}
