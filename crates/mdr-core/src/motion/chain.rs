//! The chain under a line that moves anyhow: which elements are compressed, which recover.
//!
//! ```text
//! u = d − h̃(X − x),   w = G_∞ u + η₀ du/dt + Σ e_i           an element at X under the line
//! w = 0,   u = u_∞ − Σ β_k e^(−t/λ_k)                         one that nothing touches
//! ```
//! Over a step position and depth are straight in time, and so is the displacement of an element that is compressed. It is
//! touched and let go at times inside the step, so that all work of the line is stored or lost, exactly.

mod kept;

use indenters::RigidLine;

pub(super) use kept::Kept;

use super::contacts::Contacts;
use super::event::Event;
use super::heights::{Heights, Row};
use super::time_step::{Driven, TimeStep, n_slots};
use crate::MdrError;
use crate::contact::Instant;
use crate::element_heights::ElementHeights;
use crate::error::finite;
use crate::steady::Foundation;

/// Elements beyond the footprint that are looked at, because a step takes it on by up to one.
const MARGIN: f64 = 2.0;

/// Distance at which what a dashpot holds is taken to be touched still, relative to the depth.
const TOUCHING: f64 = 1e-9;
/// Motion in a step that is none but for rounding, relative to an element.
const AT_REST: f64 = 1e-7;
/// Height up to which elements are looked at, relative to the depth.
const LOOKOUT: f64 = 1.25;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Touch {
    Never,
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
pub(super) enum Given {
    /// Σ w over the elements.
    Load(f64),
    Depth(f64),
}

/// Where the line is.
#[derive(Debug, Clone, Copy, Default)]
struct Place {
    time: f64,
    position: f64,
    depth: f64,
}

/// The elements that a motion can touch, and what they remember.
pub(super) struct Chain<'a> {
    line: Heights<'a>,
    foundation: &'a Foundation,
    sampled: &'a ElementHeights,
    /// Position of the first element over the spacing.
    first: f64,
    touches: Vec<Touch>,
    /// Stresses of a loaded element, amplitudes of one that recovers.
    slots: Vec<f64>,
    n_slots: usize,
    step: TimeStep,
    place: Place,
    /// Elements that were looked at last, and the heights over them.
    window: [usize; 2],
    heights: Vec<f64>,
    /// Where the line is.
    before: Row,
    /// Displacements at which the elements carry nothing at the end of the step.
    at_rest: Vec<f64>,
    contacts: Contacts,
}

/// What the elements add up to in a step, in the units of the foundation.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sums {
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
pub(super) struct Stepped {
    pub(super) depth: f64,
    pub(super) sums: Sums,
    /// Rearmost and foremost loaded element relative to the lowest point, \[m].
    pub(super) contact: Option<[f64; 2]>,
}

impl<'a> Chain<'a> {
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
        let first = ((range[0] + rear) / spacing).floor() - MARGIN;
        let last = ((range[1] + front) / spacing).ceil() + MARGIN;
        let n_elements = whole(last - first) + 1;
        let n_slots = n_slots(foundation);
        let [time, position] = place;
        Ok(Self {
            line: Heights::new(line, sampled)?,
            foundation,
            sampled,
            first,
            touches: vec![Touch::Never; n_elements],
            slots: vec![0.0; n_elements * n_slots],
            n_slots,
            step: TimeStep::default(),
            place: Place {
                time,
                position,
                depth: 0.0,
            },
            window: [0; 2],
            heights: Vec::new(),
            before: Row::default(),
            at_rest: Vec::new(),
            contacts: Contacts::default(),
        })
    }

    /// Goes to a position within a time, both from where it is; none where the depth needs more elements.
    pub(super) fn advance(
        &mut self,
        duration: f64,
        position: f64,
        given: Given,
    ) -> Result<Option<Stepped>, MdrError> {
        let time = self.place.time + duration;
        if duration.total_cmp(&self.step.duration).is_ne() {
            self.step = TimeStep::new(self.foundation, duration);
        }
        let mut limit = self.sampled.ceiling.min(LOOKOUT * self.place.depth);
        let depth = loop {
            self.look(position, limit)?;
            self.find_rest();
            let depth = finite("indentation depth", self.depth_of(given), time)?;
            if depth <= limit {
                break depth;
            }
            if limit >= self.sampled.ceiling {
                return Ok(None);
            }
            limit = self.sampled.ceiling;
        };
        let to = Place {
            time,
            position,
            depth,
        };
        let mut sums = Sums::default();
        for index in 0..self.heights.len() {
            self.settle(index, to, &mut sums);
        }
        self.contacts.end_step(duration);
        self.place = to;
        std::mem::swap(&mut self.heights, &mut self.before.heights);
        self.before.first = self.window[0];
        self.check_edge(&sums)?;
        Ok(Some(Stepped {
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

    fn check_edge(&self, sums: &Sums) -> Result<(), MdrError> {
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
    fn look(&mut self, position: f64, limit: f64) -> Result<(), MdrError> {
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
        let last = self.touches.len() - 1;
        let window = [whole(low.floor() - 1.0), whole(high.ceil() + 1.0).min(last)];
        let start = (self.first + window[0] as f64) * spacing;
        let count = window[1] + 1 - window[0];
        self.window = window;
        self.line.over(start - position, count, &mut self.heights)?;
        let x = |element: usize| (self.first + element as f64) * spacing - self.place.position;
        self.before.cover(&self.line, window, x)
    }

    /// Displacements at which the elements carry nothing at the end of the step.
    fn find_rest(&mut self) {
        let start = self.window[0];
        self.at_rest.clear();
        for element in start..=self.window[1] {
            let slots = element * self.n_slots..(element + 1) * self.n_slots;
            let slots = &mut self.slots[slots];
            let at_rest = match &mut self.touches[element] {
                Touch::Never => 0.0,
                Touch::Loaded { displacement } => {
                    *displacement - self.step.left(*displacement, slots) / self.step.stiffness
                }
                Touch::Free { limit, since } => {
                    let waited = self.place.time - *since;
                    if waited > 0.0 {
                        for (slot, mode) in slots.iter_mut().zip(&self.foundation.modes) {
                            *slot *= (-waited / mode.length).exp();
                        }
                        *since = self.place.time;
                    }
                    *limit - self.step.recovering(slots)
                }
            };
            self.at_rest.push(at_rest);
        }
    }

    fn depth_of(&self, given: Given) -> f64 {
        let instant = Instant {
            heights: &self.heights,
            displacements: &self.at_rest,
        };
        match given {
            Given::Depth(depth) => depth,
            Given::Load(load) if load > 0.0 => {
                let compression = load / self.step.stiffness;
                instant.solve(compression, self.place.depth).depth
            }
            // Without a force the line touches the first element.
            Given::Load(_) => instant.first_touch(),
        }
    }

    /// Takes one element of the window to the end of the step.
    fn settle(&mut self, index: usize, to: Place, sums: &mut Sums) {
        let element = self.window[0] + index;
        let heights = [self.before.over(element), self.heights[index]];
        let under = [self.place.depth - heights[0], to.depth - heights[1]];
        let slots = element * self.n_slots..(element + 1) * self.n_slots;
        let event = Event {
            foundation: self.foundation,
            duration: self.step.duration,
            slots: &mut self.slots[slots],
        };
        let is_loaded = under[1] > self.at_rest[index];
        let loaded = Touch::Loaded {
            displacement: under[1],
        };
        let free = |limit| Touch::Free {
            limit,
            since: to.time,
        };
        let (touch, driven) = match self.touches[element] {
            Touch::Loaded { displacement } if is_loaded => {
                let compression = under[1] - displacement;
                let driven = self.step.drive(displacement, compression, event.slots);
                (loaded, driven)
            }
            Touch::Loaded { displacement } => {
                let (limit, driven) = event.release([displacement, under[1]]);
                (free(limit), driven)
            }
            Touch::Free { limit, .. } if is_loaded => (loaded, event.touch(limit, under)),
            Touch::Never if is_loaded => (loaded, event.touch(0.0, under)),
            Touch::Free { limit, .. } => {
                self.step.recover(event.slots);
                self.touches[element] = free(limit);
                return;
            }
            Touch::Never => return,
        };
        let was_loaded = matches!(self.touches[element], Touch::Loaded { .. });
        let given = (driven.impulse, self.step.duration);
        self.contacts.note(element, given, [was_loaded, is_loaded]);
        self.touches[element] = touch;
        sums.add(driven, self.slope(element, heights, to.position));
        if is_loaded {
            sums.n_loaded += 1;
            sums.ends = Some([sums.ends.map_or(element, |[rear, _]| rear), element]);
        }
    }

    /// Mean slope that an element meets while the line goes to a position.
    fn slope(&self, element: usize, heights: [f64; 2], position: f64) -> f64 {
        let moved = position - self.place.position;
        let spacing = self.sampled.spacing;
        if moved.abs() > AT_REST * spacing {
            return (heights[0] - heights[1]) / moved;
        }
        let x = self.along(element);
        let height = |x: f64| self.line.at(x).unwrap_or(f64::NAN);
        (height(x + 0.5 * spacing) - height(x - 0.5 * spacing)) / spacing
    }

    /// Lets go of everything, so that what recovers is all that is remembered, and the time begins anew.
    ///
    /// Where a spring acts at once, what it gives back is taken again when the line comes back to the same place.
    pub(super) fn lift(&mut self, time: f64) -> f64 {
        let mut lost = 0.0;
        let elapsed = self.place.time - time;
        for (element, touch) in self.touches.iter_mut().enumerate() {
            let slots = element * self.n_slots..(element + 1) * self.n_slots;
            match touch {
                Touch::Never => {}
                Touch::Free { since, .. } => *since -= elapsed,
                Touch::Loaded { displacement } => {
                    let event = Event {
                        foundation: self.foundation,
                        duration: 0.0,
                        slots: &mut self.slots[slots],
                    };
                    let (limit, lent) = event.lift(*displacement);
                    lost += lent;
                    *touch = Touch::Free { limit, since: time };
                }
            }
        }
        self.place.time = time;
        lost
    }

    /// Presses again what was let go, at the place where the line is; gives the energy that comes back.
    pub(super) fn lower(&mut self) -> Result<f64, MdrError> {
        self.look(
            self.place.position,
            self.sampled.ceiling.min(LOOKOUT * self.place.depth),
        )?;
        let noise = if self.foundation.has_dashpot() {
            TOUCHING * self.place.depth
        } else {
            0.0
        };
        let mut stored = 0.0;
        for (element, height) in (self.window[0]..=self.window[1]).zip(&self.heights) {
            let slots = element * self.n_slots..(element + 1) * self.n_slots;
            let slots = &mut self.slots[slots];
            let Touch::Free { limit, .. } = self.touches[element] else {
                continue;
            };
            let under = self.place.depth - height;
            if under + noise > limit - slots.iter().sum::<f64>() {
                let event = Event {
                    foundation: self.foundation,
                    duration: 0.0,
                    slots,
                };
                let (displacement, returned) = event.strike(limit, under);
                self.touches[element] = Touch::Loaded { displacement };
                stored += returned;
            }
        }
        Ok(stored)
    }

    /// Notes what happens to the elements from now on.
    pub(super) fn note(&mut self) {
        self.contacts = Contacts::of(self.touches.len());
    }

    /// What was noted.
    pub(super) fn noted(&mut self) -> Contacts {
        std::mem::take(&mut self.contacts)
    }

    /// What recovers, of all elements one after the other, at one time.
    pub(super) fn memory(&mut self) -> &mut [f64] {
        let time = self.place.time;
        for (element, touch) in self.touches.iter_mut().enumerate() {
            if let Touch::Free { since, .. } = touch {
                let slots = element * self.n_slots..(element + 1) * self.n_slots;
                let slots = self.slots[slots].iter_mut();
                for (slot, mode) in slots.zip(&self.foundation.modes) {
                    *slot *= (-(time - *since) / mode.length).exp();
                }
                *since = time;
            }
        }
        &mut self.slots
    }
}

impl Sums {
    fn add(&mut self, driven: Driven, slope: f64) {
        self.normal_impulse += driven.impulse;
        self.tangential_impulse += driven.impulse * slope;
        self.lost += driven.lost;
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
