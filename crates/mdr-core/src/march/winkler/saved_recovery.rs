//! Transfer of the state of recovery between foundations of different spacing.

use super::{ElementState, WinklerFoundation, to_index};

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
        let last = saved.history.len() / self.n_history;
        for (element, state) in self.states.iter_mut().enumerate() {
            let x = (self.first + element as f64) * spacing;
            let place = ((x - saved.first) / saved.spacing).max(0.0);
            let (at, part) = (to_index(place), place.fract());
            if at + 1 >= last {
                continue;
            }
            let history = &mut self.history[element * self.n_history..][..self.n_history];
            let (rear, front) = saved.history[at * self.n_history..].split_at(self.n_history);
            for (slot, (rear, front)) in history.iter_mut().zip(rear.iter().zip(front)) {
                *slot = rear + part * (front - rear);
            }
            if history.iter().any(|slot| *slot != 0.0) {
                *state = ElementState::Free { limit: 0.0, since };
            }
        }
    }
}
