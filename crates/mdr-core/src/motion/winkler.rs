//! The chain under a line that moves anyhow: which elements are compressed, which recover.
//!
//! ```text
//! u = d − h̃(X − x),   w = G_∞ u + η₀ du/dt + Σ e_i           an element at X under the line
//! w = 0,   u = u_∞ − Σ β_k e^(−t/λ_k)                         one that nothing touches
//! ```
//! Over a step position and depth are straight in time, and so is the displacement of an element that is compressed. It is
//! touched and let go at times inside the step, so that all work of the line is stored or lost, exactly.

mod saved_recovery;

use indenters::RigidLine;

pub(super) use saved_recovery::SavedRecovery;

use super::contact_history::ContactHistory;
use super::event::ContactEvent;
use super::heights::{HeightRow, HeightTable};
use super::time_step::{StepWork, TimeStep, n_history_variables};
use crate::MdrError;
use crate::element_heights::ElementHeights;
use crate::error::finite;
use crate::force_balance::ForceBalance;
use crate::steady::Foundation;

/// Elements of the foundation beyond each end of the range of the line, because a step moves it by up to one element.
const FOUNDATION_MARGIN: f64 = 2.0;

/// Gap, relative to the depth, up to which an element with a dashpot counts as in contact when the foundation is
/// reloaded. Chosen.
const DASHPOT_CONTACT_TOLERANCE: f64 = 1e-9;
/// Motion in a step, relative to the spacing, up to which the line counts as at rest: rounding of positions.
const REST_DISPLACEMENT: f64 = 1e-7;
/// Height up to which elements are in the window of a step, relative to the depth before it. A deeper step enlarges
/// the window and is repeated.
const WINDOW_HEIGHT_FACTOR: f64 = 1.25;

#[derive(Debug, Clone, Copy, PartialEq)]
enum ElementState {
    Untouched,
    /// Recovers to a displacement at last; its amplitudes are those at a time.
    Free {
        limit: f64,
        since: f64,
    },
    Loaded {
        displacement: f64,
    },
}

/// What is given at the end of a step.
#[derive(Debug, Clone, Copy)]
pub(super) enum Prescribed {
    /// Σ w over the elements.
    Load(f64),
    Depth(f64),
}

/// Where the line is.
#[derive(Debug, Clone, Copy, Default)]
struct BodyState {
    time: f64,
    position: f64,
    depth: f64,
}

/// The elements that a motion can touch, and what they remember.
pub(super) struct WinklerFoundation<'a> {
    line: HeightTable<'a>,
    foundation: &'a Foundation,
    sampled: &'a ElementHeights,
    /// Position of the first element over the spacing.
    first: f64,
    states: Vec<ElementState>,
    /// Stresses of a loaded element, amplitudes of one that recovers.
    history: Vec<f64>,
    n_history_variables: usize,
    step: TimeStep,
    place: BodyState,
    /// Elements that were looked at last, and the heights over them.
    window: [usize; 2],
    heights: Vec<f64>,
    /// Where the line is.
    before: HeightRow,
    /// Displacements at which the elements carry nothing at the end of the step.
    unloaded_displacements: Vec<f64>,
    contact_history: ContactHistory,
}

/// What the elements add up to in a step, in the units of the foundation.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct StepSums {
    /// ∫ Σ w dt.
    pub(super) normal_impulse: f64,
    /// ∫ Σ w h̃' dt.
    pub(super) tangential_impulse: f64,
    /// Energy that dashpots took, also after an element was let go.
    pub(super) lost: f64,
    /// The rearmost and the foremost loaded element at the end.
    ends: Option<[usize; 2]>,
    pub(super) n_loaded: usize,
}

/// The state at the end of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct FoundationStep {
    pub(super) depth: f64,
    pub(super) sums: StepSums,
    /// Rearmost and foremost loaded element relative to the lowest point, \[m].
    pub(super) contact: Option<[f64; 2]>,
}

impl<'a> WinklerFoundation<'a> {
    /// At rest, under the elements of a line that will be between two positions \[m].
    pub(super) fn new(
        line: &'a dyn RigidLine,
        foundation: &'a Foundation,
        sampled: &'a ElementHeights,
        range: [f64; 2],
        place: [f64; 2],
    ) -> Result<Self, MdrError> {
        let spacing = sampled.spacing;
        let [rear, front] = [0, sampled.heights.len() - 1].map(|end| sampled.position(end));
        let first = ((range[0] + rear) / spacing).floor() - FOUNDATION_MARGIN;
        let last = ((range[1] + front) / spacing).ceil() + FOUNDATION_MARGIN;
        let n_elements = whole(last - first) + 1;
        let n_history_variables = n_history_variables(foundation);
        let [time, position] = place;
        Ok(Self {
            line: HeightTable::new(line, sampled)?,
            foundation,
            sampled,
            first,
            states: vec![ElementState::Untouched; n_elements],
            history: vec![0.0; n_elements * n_history_variables],
            n_history_variables,
            step: TimeStep::default(),
            place: BodyState {
                time,
                position,
                depth: 0.0,
            },
            window: [0; 2],
            heights: Vec::new(),
            before: HeightRow::default(),
            unloaded_displacements: Vec::new(),
            contact_history: ContactHistory::default(),
        })
    }

    /// Goes to a position within a time, both from where it is; none where the depth needs more elements.
    pub(super) fn advance(
        &mut self,
        duration: f64,
        position: f64,
        prescribed: Prescribed,
    ) -> Result<Option<FoundationStep>, MdrError> {
        let time = self.place.time + duration;
        if duration.total_cmp(&self.step.duration).is_ne() {
            self.step = TimeStep::new(self.foundation, duration);
        }
        let mut limit = self
            .sampled
            .ceiling
            .min(WINDOW_HEIGHT_FACTOR * self.place.depth);
        let depth = loop {
            self.update_window(position, limit)?;
            self.find_unloaded_displacements();
            let depth = finite("indentation depth", self.solve_depth(prescribed), time)?;
            if depth <= limit {
                break depth;
            }
            if limit >= self.sampled.ceiling {
                return Ok(None);
            }
            limit = self.sampled.ceiling;
        };
        let to = BodyState {
            time,
            position,
            depth,
        };
        let mut sums = StepSums::default();
        for index in 0..self.heights.len() {
            self.advance_element(index, to, &mut sums);
        }
        self.contact_history.end_step(duration);
        self.place = to;
        std::mem::swap(&mut self.heights, &mut self.before.heights);
        self.before.first = self.window[0];
        self.check_edge(&sums)?;
        Ok(Some(FoundationStep {
            depth,
            sums,
            contact: sums
                .ends
                .map(|ends| ends.map(|element| self.along(element))),
        }))
    }

    pub(super) const fn spacing(&self) -> f64 {
        self.sampled.spacing
    }

    /// Where the line is now, \[m].
    pub(super) const fn depth(&self) -> f64 {
        self.place.depth
    }

    /// Position of an element relative to the lowest point, \[m].
    fn along(&self, element: usize) -> f64 {
        (self.first + element as f64) * self.sampled.spacing - self.place.position
    }

    fn check_edge(&self, sums: &StepSums) -> Result<(), MdrError> {
        let Some([rear, front]) = sums.ends else {
            return Ok(());
        };
        let height = |element: usize| {
            let index = element.checked_sub(self.before.first)?;
            self.before.heights.get(index).copied()
        };
        for (end, beyond) in [(rear, rear.wrapping_sub(1)), (front, front + 1)] {
            if height(beyond) == Some(f64::INFINITY) {
                return Err(MdrError::ContactReachesEdge {
                    position: self.along(end),
                    indentation_depth: self.place.depth,
                    time: self.place.time,
                });
            }
        }
        Ok(())
    }

    /// The heights up to a limit over the elements around a position, there and where the line is.
    fn update_window(&mut self, position: f64, limit: f64) -> Result<(), MdrError> {
        let spacing = self.sampled.spacing;
        let heights = &self.sampled.heights;
        let is_low = |height: &f64| *height <= limit;
        let anchor = self.sampled.anchor_index;
        let rear = heights
            .iter()
            .position(is_low)
            .unwrap_or(anchor)
            .saturating_sub(1);
        let front = heights.iter().rposition(is_low).unwrap_or(anchor) + 1;
        let rear = self.sampled.position(rear);
        let front = self.sampled.position(front.min(heights.len() - 1));
        let places = [self.place.position, position];
        let low = (places[0].min(places[1]) + rear) / spacing - self.first;
        let high = (places[0].max(places[1]) + front) / spacing - self.first;
        let last = self.states.len() - 1;
        let window = [whole(low.floor() - 1.0), whole(high.ceil() + 1.0).min(last)];
        let start = (self.first + window[0] as f64) * spacing;
        let count = window[1] + 1 - window[0];
        self.window = window;
        self.line.over(start - position, count, &mut self.heights)?;
        let x = |element: usize| (self.first + element as f64) * spacing - self.place.position;
        self.before.cover(&self.line, window, x)
    }

    /// Displacements at which the elements carry nothing at the end of the step.
    fn find_unloaded_displacements(&mut self) {
        let start = self.window[0];
        self.unloaded_displacements.clear();
        for element in start..=self.window[1] {
            let history =
                element * self.n_history_variables..(element + 1) * self.n_history_variables;
            let history = &mut self.history[history];
            let unloaded_displacements = match &mut self.states[element] {
                ElementState::Untouched => 0.0,
                ElementState::Loaded { displacement } => {
                    *displacement
                        - self.step.relaxed_load(*displacement, history) / self.step.stiffness
                }
                ElementState::Free { limit, since } => {
                    let waited = self.place.time - *since;
                    if waited > 0.0 {
                        for (slot, mode) in history.iter_mut().zip(&self.foundation.modes) {
                            *slot *= (-waited / mode.length).exp();
                        }
                        *since = self.place.time;
                    }
                    *limit - self.step.remaining_recovery(history)
                }
            };
            self.unloaded_displacements.push(unloaded_displacements);
        }
    }

    fn solve_depth(&self, prescribed: Prescribed) -> f64 {
        let balance = ForceBalance {
            heights: &self.heights,
            displacements: &self.unloaded_displacements,
        };
        match prescribed {
            Prescribed::Depth(depth) => depth,
            Prescribed::Load(load) if load > 0.0 => {
                let compression = load / self.step.stiffness;
                balance.solve(compression, self.place.depth).depth
            }
            // Without a force the line touches the first element.
            Prescribed::Load(_) => balance.first_contact_depth(),
        }
    }

    /// Takes one element of the window to the end of the step.
    fn advance_element(&mut self, index: usize, to: BodyState, sums: &mut StepSums) {
        let element = self.window[0] + index;
        let heights = [self.before.over(element), self.heights[index]];
        let under = [self.place.depth - heights[0], to.depth - heights[1]];
        let history = element * self.n_history_variables..(element + 1) * self.n_history_variables;
        let event = ContactEvent {
            foundation: self.foundation,
            duration: self.step.duration,
            history: &mut self.history[history],
        };
        let is_loaded = under[1] > self.unloaded_displacements[index];
        let loaded = ElementState::Loaded {
            displacement: under[1],
        };
        let free = |limit| ElementState::Free {
            limit,
            since: to.time,
        };
        let (state, work) = match self.states[element] {
            ElementState::Loaded { displacement } if is_loaded => {
                let compression = under[1] - displacement;
                let work = self.step.compress(displacement, compression, event.history);
                (loaded, work)
            }
            ElementState::Loaded { displacement } => {
                let (limit, work) = event.separate([displacement, under[1]]);
                (free(limit), work)
            }
            ElementState::Free { limit, .. } if is_loaded => {
                (loaded, event.make_contact(limit, under))
            }
            ElementState::Untouched if is_loaded => (loaded, event.make_contact(0.0, under)),
            ElementState::Free { limit, .. } => {
                self.step.recover(event.history);
                self.states[element] = free(limit);
                return;
            }
            ElementState::Untouched => return,
        };
        let was_loaded = matches!(self.states[element], ElementState::Loaded { .. });
        let prescribed = (work.impulse, self.step.duration);
        self.contact_history
            .note(element, prescribed, [was_loaded, is_loaded]);
        self.states[element] = state;
        sums.add(work, self.slope(element, heights, to.position));
        if is_loaded {
            sums.n_loaded += 1;
            sums.ends = Some([sums.ends.map_or(element, |[rear, _]| rear), element]);
        }
    }

    /// Mean slope that an element meets while the line goes to a position.
    fn slope(&self, element: usize, heights: [f64; 2], position: f64) -> f64 {
        let moved = position - self.place.position;
        let spacing = self.sampled.spacing;
        if moved.abs() > REST_DISPLACEMENT * spacing {
            return (heights[0] - heights[1]) / moved;
        }
        let x = self.along(element);
        let height = |x: f64| self.line.at(x).unwrap_or(f64::NAN);
        (height(x + 0.5 * spacing) - height(x - 0.5 * spacing)) / spacing
    }

    /// Lets go of everything, so that what recovers is all that is remembered, and the time begins anew.
    ///
    /// Where a spring acts at once, what it gives back is taken again when the line comes back to the same place.
    pub(super) fn unload_all(&mut self, time: f64) -> f64 {
        let mut lost = 0.0;
        let elapsed = self.place.time - time;
        for (element, state) in self.states.iter_mut().enumerate() {
            let history =
                element * self.n_history_variables..(element + 1) * self.n_history_variables;
            match state {
                ElementState::Untouched => {}
                ElementState::Free { since, .. } => *since -= elapsed,
                ElementState::Loaded { displacement } => {
                    let event = ContactEvent {
                        foundation: self.foundation,
                        duration: 0.0,
                        history: &mut self.history[history],
                    };
                    let (limit, lent) = event.separate_instantly(*displacement);
                    lost += lent;
                    *state = ElementState::Free { limit, since: time };
                }
            }
        }
        self.place.time = time;
        lost
    }

    /// Presses again what was let go, at the place where the line is; gives the energy that comes back.
    pub(super) fn reload(&mut self) -> Result<f64, MdrError> {
        self.update_window(
            self.place.position,
            self.sampled
                .ceiling
                .min(WINDOW_HEIGHT_FACTOR * self.place.depth),
        )?;
        let noise = if self.foundation.has_dashpot() {
            DASHPOT_CONTACT_TOLERANCE * self.place.depth
        } else {
            0.0
        };
        let mut stored = 0.0;
        for (element, height) in (self.window[0]..=self.window[1]).zip(&self.heights) {
            let history =
                element * self.n_history_variables..(element + 1) * self.n_history_variables;
            let history = &mut self.history[history];
            let ElementState::Free { limit, .. } = self.states[element] else {
                continue;
            };
            let under = self.place.depth - height;
            if under + noise > limit - history.iter().sum::<f64>() {
                let event = ContactEvent {
                    foundation: self.foundation,
                    duration: 0.0,
                    history,
                };
                let (displacement, returned) = event.make_contact_instantly(limit, under);
                self.states[element] = ElementState::Loaded { displacement };
                stored += returned;
            }
        }
        Ok(stored)
    }

    /// Notes what happens to the elements from now on.
    pub(super) fn start_recording(&mut self) {
        self.contact_history = ContactHistory::of(self.states.len());
    }

    /// What was noted.
    pub(super) fn take_contact_history(&mut self) -> ContactHistory {
        std::mem::take(&mut self.contact_history)
    }

    /// What recovers, of all elements one after the other, at one time.
    pub(super) fn recovery_amplitudes(&mut self) -> &mut [f64] {
        let time = self.place.time;
        for (element, state) in self.states.iter_mut().enumerate() {
            if let ElementState::Free { since, .. } = state {
                let history =
                    element * self.n_history_variables..(element + 1) * self.n_history_variables;
                let history = self.history[history].iter_mut();
                for (slot, mode) in history.zip(&self.foundation.modes) {
                    *slot *= (-(time - *since) / mode.length).exp();
                }
                *since = time;
            }
        }
        &mut self.history
    }
}

impl StepSums {
    fn add(&mut self, work: StepWork, slope: f64) {
        self.normal_impulse += work.impulse;
        self.tangential_impulse += work.impulse * slope;
        self.lost += work.lost;
    }
}

/// A whole number that is not negative.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "elements are counted before, and fewer than the most allowed"
)]
const fn whole(number: f64) -> usize {
    number as usize
}
