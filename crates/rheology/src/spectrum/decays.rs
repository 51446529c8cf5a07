//! Normal form of a list of decays: increasing, distinct times and positive amplitudes.

use crate::RheologyError;
use crate::error::with_list_index;
use numerics::{in_range, not_negative, positive};

/// Relative difference up to which two relaxation or retardation times are merged into their mean.
///
/// Derived: the mean time in place of two times that differ by δ changes every response by less than δ²/8, here 1e-17.
const MERGE_TOLERANCE: f64 = 1e-8;

/// An exponential decay, of a branch in relaxation or an element in creep.
#[derive(Clone, Copy)]
pub(super) struct Decay {
    /// Amplitude, a modulus \[Pa] or a compliance \[1/Pa].
    pub(super) amplitude: f64,
    /// Time constant, \[s].
    pub(super) time: f64,
}

/// Names of a list of decays and of its columns, for messages.
pub(super) struct DecayNames {
    /// Name of the list.
    pub(super) list: &'static str,
    /// Name of the amplitude.
    pub(super) amplitude: &'static str,
    /// Name of the time constant.
    pub(super) time: &'static str,
}

/// Sorts decays by time, drops amplitudes of zero and merges equal times.
///
/// Merged amplitudes are added; merged times are averaged with the amplitudes as weights.
pub(super) fn normal_form(
    names: &DecayNames,
    mut decays: Vec<Decay>,
) -> Result<Vec<Decay>, RheologyError> {
    for (index, &Decay { amplitude, time }) in decays.iter().enumerate() {
        not_negative(names.amplitude, amplitude)
            .and_then(|_| positive(names.time, time))
            .and_then(|_| in_range(names.time, time, time.is_normal(), "at least 3e-308"))
            .map_err(with_list_index(names.list, index))?;
    }
    decays.retain(|decay| decay.amplitude > 0.0);
    decays.sort_by(|a, b| a.time.total_cmp(&b.time));
    let mut merged: Vec<Decay> = Vec::with_capacity(decays.len());
    // Compare with the first time of a cluster: comparison with the running mean could merge a long series of times.
    let mut first = 0.0;
    for decay in decays {
        match merged.last_mut() {
            Some(last) if decay.time - first <= MERGE_TOLERANCE * first => {
                last.amplitude += decay.amplitude;
                last.time += (decay.time - last.time) * (decay.amplitude / last.amplitude);
            }
            _ => {
                first = decay.time;
                merged.push(decay);
            }
        }
    }
    Ok(merged)
}
