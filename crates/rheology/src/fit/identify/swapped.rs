//! Storage and loss modulus in each other's place.

use super::{Ending, IdentifyOptions, series_of};
use crate::RheologyError;
use crate::fit::curve::MeasuredCurve;

/// A larger error of the modulus than this is that of no relaxing material.
pub(super) const BAD: f64 = 0.2;
/// Swapped moduli fit so much better; a curve that is only noisy fits neither way.
const BETTER: f64 = 3.0;

/// Refuses moduli that fit a relaxing material when they are swapped, and only then.
pub(super) fn check(curve: &MeasuredCurve, ending: Ending) -> Result<(), RheologyError> {
    // Whatever number of branches was asked for: a few of them may fit badly on purpose.
    let options = IdentifyOptions {
        ending,
        ..IdentifyOptions::default()
    };
    let error = |curve: &MeasuredCurve| Some(series_of(curve, &options).ok()?.rms_relative_error);
    let swapped = curve.swapped();
    match swapped.and_then(|swapped| error(curve).zip(error(&swapped))) {
        Some((given, swapped)) if given > BAD && swapped < given / BETTER => {
            Err(RheologyError::SwappedModuli { given, swapped })
        }
        _ => Ok(()),
    }
}
