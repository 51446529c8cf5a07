//! Normal form of a list of decays: times increasing and distinct, no amplitude zero.

use crate::RheologyError;
use crate::error::in_list;
use numerics::{in_range, not_negative, positive};

/// Times closer than this, relatively, are one.
///
/// With the mean time in place of two times that differ by δ every response changes by less than δ²/8, here 1e-17.
const SAME_TIME: f64 = 1e-8;

/// Sorts `(amplitude, time)` pairs by time, drops amplitudes of zero and joins equal times: amplitudes add, times are
/// averaged with the amplitude as weight.
///
/// The names of the list, of amplitudes and of times are those of its errors.
pub(super) fn normal_form(
    [list, amplitude, time]: [&'static str; 3],
    mut decays: Vec<(f64, f64)>,
) -> Result<Vec<(f64, f64)>, RheologyError> {
    for (index, decay) in decays.iter().enumerate() {
        not_negative(amplitude, decay.0)
            .and_then(|_| positive(time, decay.1))
            .and_then(|_| in_range(time, decay.1, decay.1.is_normal(), "at least 3e-308"))
            .map_err(in_list(list, index))?;
    }
    decays.retain(|&(amplitude, _)| amplitude > 0.0);
    decays.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut merged: Vec<(f64, f64)> = Vec::with_capacity(decays.len());
    // The first time of the cluster: compared with the running mean a long row of times would melt into one.
    let mut first = 0.0;
    for (amplitude, time) in decays {
        match merged.last_mut() {
            Some(last) if time - first <= SAME_TIME * first => {
                last.0 += amplitude;
                last.1 += (time - last.1) * (amplitude / last.0);
            }
            _ => {
                first = time;
                merged.push((amplitude, time));
            }
        }
    }
    Ok(merged)
}
