//! What a chain remembers, for a chain of other elements.

use super::{Chain, Touch, whole};

/// What a chain remembers.
#[derive(Debug, Clone)]
pub(crate) struct Kept {
    /// Position of its first element, \[m].
    first: f64,
    spacing: f64,
    slots: Vec<f64>,
}

impl Chain<'_> {
    /// What recovers, for a chain of other elements.
    pub(crate) fn kept(&mut self) -> Kept {
        let spacing = self.sampled.spacing;
        Kept {
            first: self.first * spacing,
            spacing,
            slots: self.memory().to_vec(),
        }
    }

    /// Remembers what other elements do, straight between them.
    pub(crate) fn recall(&mut self, kept: &Kept) {
        let (spacing, since) = (self.sampled.spacing, self.place.time);
        let last = kept.slots.len() / self.n_slots;
        for (element, touch) in self.touches.iter_mut().enumerate() {
            let x = (self.first + element as f64) * spacing;
            let place = ((x - kept.first) / kept.spacing).max(0.0);
            let (at, part) = (whole(place), place.fract());
            if at + 1 >= last {
                continue;
            }
            let slots = &mut self.slots[element * self.n_slots..][..self.n_slots];
            let (rear, front) = kept.slots[at * self.n_slots..].split_at(self.n_slots);
            for (slot, (rear, front)) in slots.iter_mut().zip(rear.iter().zip(front)) {
                *slot = rear + part * (front - rear);
            }
            if slots.iter().any(|slot| *slot != 0.0) {
                *touch = Touch::Free { limit: 0.0, since };
            }
        }
    }
}
