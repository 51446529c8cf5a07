//! Periodic state of a line that returns to the same place again and again, as a ball on a disc does.
//!
//! All passes are equal. The surface ahead of the line has the amplitudes that the pass before leaves in the modes of recovery:
//!
//! ```text
//! x = g(x),   g: one pass over a surface with the amplitude x_k in mode k, then recovery over the remainder of the track
//! u(s) = u₁ e^(−(L − s)/(v λ)) / (1 − e^(−L/(v λ)))        at a distance s ahead of one load that alone gives u₁ behind itself
//! ```
//! A mode with v λ ≫ L follows the mean load of the whole track. It hardly changes under the line, so that it dissipates
//! nothing.

use numerics::{FixedPoint, anderson_fixed_point};

use super::sweep::{SweepSums, sweep};
use crate::MdrError;
use crate::branches::{Foundation, FreeSurface};
use crate::line::{Profile, Range};

/// Largest number of passes of the track in the search for the periodic state. Chosen to limit the time: after them the search
/// ends with [`MdrError::NotPeriodic`]. A state that is found does not depend on it.
const MAX_PASSES: usize = 300;
/// Rounding of one pass, in depths. Multiplied by the number of passes that a mode needs to recover, it is the remaining distance
/// to the periodic state at which the search ends. Chosen: with less, a slow material would end with [`MdrError::NotPeriodic`]
/// because of rounding; with more, its error bar is wider.
const PERIODICITY_ROUNDING: f64 = 1024.0 * f64::EPSILON;

/// Refuses a track \[m] that is not longer than the part of the line below the surface, as [`MdrError::TrackTooShort`].
pub(super) fn check_length(track: f64, range: &Range) -> Result<(), MdrError> {
    let needed = range.ends[1] - range.ends[0];
    if track > needed {
        return Ok(());
    }
    Err(MdrError::TrackTooShort { track, needed })
}

/// Sums over a pass of the periodic state, in which the surface ahead is the one that the pass before has left, on a `track` of
/// a length \[m]. [`MdrError::NotPeriodic`] if this state is not found.
pub(super) fn sweep_until_periodic(
    foundation: &Foundation,
    profile: &Profile,
    track: f64,
    loads: Option<Vec<[f64; 2]>>,
) -> Result<SweepSums, MdrError> {
    // Depths that are too large for the track only occur during the search for a depth, which needs a monotone force.
    let free = (track - profile.length).max(0.0);
    // `slowness` is the number of passes that the slowest mode needs to recover: the distance to the periodic state is as many
    // changes of one pass.
    let slowness = -(-track / foundation.longest_recovery()).exp_m1().recip();
    let tolerance = PERIODICITY_ROUNDING * slowness;
    let mut remaining_change = 0.0;
    let pass = |ahead: &[f64]| {
        let surface = foundation.recovering_surface(ahead);
        let (_, behind) = sweep(foundation, profile, surface, None)?;
        let end = foundation.remaining_amplitudes(&behind, free);
        Ok::<_, MdrError>((end.clone(), end))
    };
    let find_change = |now: &mut Vec<f64>, before: &Vec<f64>| {
        let pairs = now.iter().zip(before.iter());
        let changes = pairs.map(|(now, before)| (now - before).abs());
        remaining_change = slowness * changes.fold(0.0, f64::max);
        remaining_change
    };
    let start = foundation.remaining_amplitudes(&FreeSurface::untouched(), free);
    let ahead = match anderson_fixed_point(start, MAX_PASSES, tolerance, pass, find_change)? {
        FixedPoint::Converged { result, .. } => result,
        FixedPoint::NotConverged {
            remaining_error: change,
        } => {
            return Err(MdrError::NotPeriodic {
                cycles: MAX_PASSES,
                change,
                tolerance,
            });
        }
    };
    let (mut sums, _) = sweep(
        foundation,
        profile,
        foundation.recovering_surface(&ahead),
        loads,
    )?;
    // The remaining change is an error of force and friction, because the whole surface may be higher or lower by it.
    let sensitivity = foundation.sensitivity(profile.length.recip(), profile.length);
    sums.load_error += remaining_change * sensitivity.load;
    sums.work_error += remaining_change * sensitivity.work;
    Ok(sums)
}
