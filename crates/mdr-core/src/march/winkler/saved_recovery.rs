//! Transfer of the state of recovery between foundations of different spacing.

use numerics::whole_part;

use super::WinklerFoundation;
use crate::march::elements::ElementState;

/// Amplitudes of recovery of a foundation, from which one of another spacing begins.
#[derive(Debug, Clone)]
pub(crate) struct SavedRecovery {
    /// Position of its first element, \[m].
    first: f64,
    /// Spacing of the elements, \[m].
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
            // Find the two saved elements around this one.
            let x = (self.first + element as f64) * spacing;
            let position = ((x - saved.first) / saved.spacing).max(0.0);
            let (index, part) = (whole_part(position), position.fract());
            if index + 1 >= last {
                continue;
            }
            // Interpolate their history, and mark an element with any as free.
            let history = self.elements.history_of(element);
            let (rear, front) = saved.history[index * n_history..].split_at(n_history);
            for (amplitude, (rear, front)) in history.iter_mut().zip(rear.iter().zip(front)) {
                *amplitude = rear + part * (front - rear);
            }
            if history.iter().any(|amplitude| *amplitude != 0.0) {
                self.elements.states[element] = ElementState::Free { limit: 0.0, since };
            }
        }
    }
}
