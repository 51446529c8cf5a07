//! Storage and loss modulus in each other's column.

use anyhow::{Result, bail};
use rheology::fit::{
    Ending, Identification, IdentifyOptions, MeasuredCurve, ModulusPoint, identify,
};

/// A larger error of the modulus than this is that of no relaxing material.
const BAD: f64 = 0.2;
/// Swapped columns fit so much better; a curve that is only noisy fits neither way.
const BETTER: f64 = 3.0;

/// Whether a fit leaves no doubt about the columns.
pub(super) fn is_good(found: &Identification) -> bool {
    found.rms_relative_error <= BAD
}

/// Refuses moduli that fit a relaxing material when they are swapped, and only then.
pub(super) fn check(points: &[ModulusPoint], ending: Ending) -> Result<()> {
    let swap = |point: &ModulusPoint| ModulusPoint {
        storage: point.loss,
        loss: point.storage,
        ..*point
    };
    // Whatever number of branches was asked for: a few of them may fit badly on purpose.
    let options = IdentifyOptions {
        ending,
        ..IdentifyOptions::default()
    };
    let error = |points: Vec<ModulusPoint>| {
        let found = identify(&MeasuredCurve::oscillation(points).ok()?, &options).ok()?;
        Some(found.rms_relative_error)
    };
    let swapped = points.iter().map(swap).collect();
    if let Some((given, swapped)) = error(points.to_vec()).zip(error(swapped))
        && given > BAD
        && swapped < given / BETTER
    {
        bail!(
            "storage and loss modulus seem to be swapped: as they are, the best fit is off by {:.0} %, and {:.0} % the \
             other way round; exchange the names of their columns",
            100.0 * given,
            100.0 * swapped
        );
    }
    Ok(())
}
