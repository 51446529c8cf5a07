//! Transfer of the state of recovery between foundations of different spacing.

use numerics::whole_part;

use super::WinklerFoundation;
use crate::march::elements::ElementState;

/// Amplitudes of recovery of a foundation.
#[derive(Debug, Clone)]
pub(crate) struct SavedRecovery {
    /// Position of its first element, \[m].
    first: f64,
    spacing: f64,
    /// Amplitudes, element by element, \[m].
    history: Vec<f64>,
}

impl WinklerFoundation<'_> {
    /// Saves the amplitudes of recovery for a foundation with another spacing.
    pub(crate) fn save_recovery(&mut self) -> SavedRecovery {
        let spacing = self.sampled.spacing;
        SavedRecovery {
            first: self.first * spacing,
            spacing,
            history: self.recovery_amplitudes().to_vec(),
        }
    }

    /// Sets the amplitudes of recovery by linear interpolation of saved ones.
    pub(crate) fn restore_recovery(&mut self, saved: &SavedRecovery) {
        let (spacing, since) = (self.sampled.spacing, self.body.time);
        let n_history = self.elements.n_history;
        let last = saved.history.len() / n_history;
        for element in 0..self.elements.states.len() {
            let x = (self.first + element as f64) * spacing;
            let place = ((x - saved.first) / saved.spacing).max(0.0);
            let (at, part) = (whole_part(place), place.fract());
            if at + 1 >= last {
                continue;
            }
            let history = self.elements.history_of(element);
            let (rear, front) = saved.history[at * n_history..].split_at(n_history);
            for (slot, (rear, front)) in history.iter_mut().zip(rear.iter().zip(front)) {
                *slot = rear + part * (front - rear);
            }
            if history.iter().any(|slot| *slot != 0.0) {
                self.elements.states[element] = ElementState::Free { limit: 0.0, since };
            }
        }
    }
}
