//! The elements of a foundation: untouched, loaded or free, each with its history variables.
//!
//! ```text
//! w = G_∞ u + η₀ du/dt + Σ e_i                                loaded
//! w = 0,   u = u_∞ − Σ β_k e^(−t/λ_k)                         free
//! ```
//! w is the load of an element and u its displacement. G_∞ is the equilibrium modulus, η₀ the parallel dashpot, e_i the stress of
//! branch i. A free element recovers in modes of the amplitudes β_k and retardation times λ_k to the displacement u_∞.

use crate::branches::{ContactEvent, Foundation, StepWork, TimeStep, n_history};

/// Contact state of an element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ElementState {
    /// The element was never in contact.
    Untouched,
    /// The element is separated from the line and recovers.
    Free {
        /// Displacement u_∞ after complete recovery, \[m].
        limit: f64,
        /// Time to which its amplitudes belong, \[s].
        since: f64,
    },
    /// Element in contact with the line.
    Loaded {
        /// Displacement u, \[m].
        displacement: f64,
    },
}

/// The elements of a foundation, with their history variables.
pub(crate) struct Elements<'a> {
    /// Viscoelastic law of an element.
    foundation: &'a Foundation,
    /// Contact state of each element.
    pub(super) states: Vec<ElementState>,
    /// History variables, element by element: stresses e_i of a loaded one, amplitudes β_k of a free one.
    pub(super) history: Vec<f64>,
    /// Number of history variables of an element.
    pub(super) n_history: usize,
}

/// One step of an element that is loaded for a part of it at least.
pub(crate) struct ElementStep {
    /// Impulse and dissipation in the step.
    pub(crate) work: StepWork,
    /// True if the element was loaded at the beginning of the step.
    pub(crate) was_loaded: bool,
    /// True if the element is loaded at the end of the step.
    pub(crate) is_loaded: bool,
}

impl<'a> Elements<'a> {
    /// A row of undeformed elements of a foundation, none of which was ever in contact.
    pub(crate) fn untouched(foundation: &'a Foundation, n_elements: usize) -> Self {
        let n_history = n_history(foundation);
        Self {
            foundation,
            states: vec![ElementState::Untouched; n_elements],
            history: vec![0.0; n_elements * n_history],
            n_history,
        }
    }

    /// History variables of an element: stresses e_i of a loaded one, amplitudes β_k of a free one.
    pub(super) fn history_of(&mut self, element: usize) -> &mut [f64] {
        &mut self.history[element * self.n_history..(element + 1) * self.n_history]
    }

    /// Contact or separation of an element within a step of a `duration` \[s].
    fn event(&mut self, element: usize, duration: f64) -> ContactEvent<'_> {
        ContactEvent {
            foundation: self.foundation,
            duration,
            history: self.history_of(element),
        }
    }

    /// Displacement at which an element carries nothing at the end of a step that begins at `time`, \[m].
    pub(crate) fn unloaded_displacement(
        &mut self,
        element: usize,
        step: &TimeStep,
        time: f64,
    ) -> f64 {
        match self.states[element] {
            ElementState::Untouched => 0.0,
            ElementState::Loaded { displacement } => {
                let history = self.history_of(element);
                // The load after the step is linear in the displacement; find its zero.
                displacement - step.relaxed_load(displacement, history) / step.stiffness
            }
            ElementState::Free { limit, .. } => {
                self.recover_until(element, time);
                limit - step.remaining_recovery(self.history_of(element))
            }
        }
    }

    /// Advances the amplitudes of a free element to a time, \[s].
    pub(super) fn recover_until(&mut self, element: usize, time: f64) {
        let foundation = self.foundation;
        let ElementState::Free { limit, since } = self.states[element] else {
            return;
        };
        let elapsed = time - since;
        if elapsed > 0.0 {
            for (amplitude, mode) in self.history_of(element).iter_mut().zip(&foundation.modes) {
                *amplitude *= (-elapsed / mode.length).exp();
            }
            self.states[element] = ElementState::Free { limit, since: time };
        }
    }

    /// Advances an element to the end of a step, over which the line above it moves linearly from one displacement to another.
    ///
    /// `imposed` are the displacements that the line imposes at both ends of the step, −∞ without a body, and `unloaded` is its
    /// [unloaded displacement](Self::unloaded_displacement), \[m]; `end_time` is in \[s]. `None` if the element is not in contact at
    /// either end of the step.
    pub(crate) fn advance(
        &mut self,
        element: usize,
        imposed: [f64; 2],
        unloaded: f64,
        step: &TimeStep,
        end_time: f64,
    ) -> Option<ElementStep> {
        let state = self.states[element];
        let mut event = self.event(element, step.duration);
        // An element is loaded at the end if the line is below its unloaded displacement.
        let is_loaded = imposed[1] > unloaded;
        let loaded = ElementState::Loaded {
            displacement: imposed[1],
        };
        let free = |limit| ElementState::Free {
            limit,
            since: end_time,
        };
        // Contact goes on, ends, begins, or does not happen; only the last case returns `None`.
        let (end_state, work) = match state {
            ElementState::Loaded { displacement } if is_loaded => {
                let compression = imposed[1] - displacement;
                let work = step.compress(displacement, compression, event.history);
                (loaded, work)
            }
            // The edge of the body has passed the element.
            ElementState::Loaded { .. } if imposed[1] == f64::NEG_INFINITY => {
                let dissipated = self.separate_instantly(element, end_time - step.duration);
                return Some(ElementStep {
                    work: StepWork {
                        impulse: 0.0,
                        dissipated,
                    },
                    was_loaded: true,
                    is_loaded: false,
                });
            }
            ElementState::Loaded { displacement } => {
                let (limit, work) = event.separate([displacement, imposed[1]]);
                (free(limit), work)
            }
            ElementState::Free { limit, .. } if is_loaded => {
                (loaded, event.make_contact(limit, imposed))
            }
            ElementState::Untouched if is_loaded => (loaded, event.make_contact(0.0, imposed)),
            ElementState::Free { limit, .. } => {
                step.recover(event.history);
                self.states[element] = free(limit);
                return None;
            }
            ElementState::Untouched => return None,
        };
        self.states[element] = end_state;
        Some(ElementStep {
            work,
            was_loaded: matches!(state, ElementState::Loaded { .. }),
            is_loaded,
        })
    }

    /// Discards the first element, and appends an undeformed one.
    pub(super) fn replace_rearmost(&mut self) {
        self.states.rotate_left(1);
        self.history.rotate_left(self.n_history);
        let last = self.states.len() - 1;
        self.states[last] = ElementState::Untouched;
        self.history_of(last).fill(0.0);
    }

    /// Separates a loaded element instantaneously at a `time` \[s]; returns the energy that was stored in it, divided by the unit of
    /// stress, \[m²], and 0 if it is not loaded.
    pub(super) fn separate_instantly(&mut self, element: usize, time: f64) -> f64 {
        let ElementState::Loaded { displacement } = self.states[element] else {
            return 0.0;
        };
        let (limit, stored) = self.event(element, 0.0).separate_instantly(displacement);
        self.states[element] = ElementState::Free { limit, since: time };
        stored
    }

    /// Brings an element that recovers to the displacement `limit` into contact instantaneously, with the displacement that the line
    /// imposes, \[m]; returns the energy stored in it, divided by the unit of stress, \[m²].
    pub(crate) fn make_contact_instantly(
        &mut self,
        element: usize,
        limit: f64,
        imposed: f64,
    ) -> f64 {
        let (displacement, stored) = self
            .event(element, 0.0)
            .make_contact_instantly(limit, imposed);
        self.states[element] = ElementState::Loaded { displacement };
        stored
    }
}
