//! A Winkler foundation under a line that moves arbitrarily: loaded, free and untouched elements.
//!
//! ```text
//! u = d − h̃(X − x)           a loaded element at X under the line, whose lowest point is at x
//! ```
//! Over a step position and depth are linear in time, and so is the displacement of a loaded element. Contact and separation
//! happen at times inside the step, so that the work of the line is stored or dissipated exactly.
//!
//! Theory: docs/theory/line-viscoelastic.md, "One law".

mod saved_recovery;

use indenters::RigidLine;
use numerics::whole_part;

pub(super) use saved_recovery::SavedRecovery;

use super::contact_history::ContactHistory;
use super::elements::{ElementState, Elements};
use super::force_balance::ForceBalance;
use crate::MdrError;
use crate::branches::{Foundation, TimeStep};
use crate::error::finite;
use crate::line::{ElementHeights, HeightRow, HeightTable};

/// Number of elements of the foundation beyond each end of the range in which the line moves. Derived: a step moves the line by
/// up to one element, and the window of a step has one more on each side.
const FOUNDATION_MARGIN: f64 = 2.0;

/// Motion in a step, relative to the spacing, up to which the line counts as at rest. Chosen as 200 times the rounding of a
/// position four million elements away; a motion that is really so short uses the slope of the line instead of a difference of
/// heights.
const REST_DISPLACEMENT: f64 = 1e-7;

/// The quantity prescribed at the end of a step.
#[derive(Debug, Clone, Copy)]
pub(super) enum Prescribed {
    /// Sum Σ w of the load potentials over the elements, in the units of the foundation.
    Load(f64),
    /// Indentation depth, \[m].
    Depth(f64),
}

/// Time, position and depth of the line.
#[derive(Debug, Clone, Copy, Default)]
struct BodyState {
    /// Time, \[s].
    time: f64,
    /// Position of the lowest point along the surface, \[m].
    position: f64,
    /// Indentation depth, \[m].
    depth: f64,
}

/// The elements that can come into contact in a motion, with their history variables.
pub(super) struct WinklerFoundation<'a> {
    /// Table of the heights of the line, which gives the height at any position.
    line: HeightTable<'a>,
    /// Viscoelastic law of an element.
    foundation: &'a Foundation,
    /// Heights of the line over elements, and their spacing.
    sampled: &'a ElementHeights,
    /// Position of the first element divided by the spacing.
    first: f64,
    /// States and history variables of the elements.
    elements: Elements<'a>,
    /// Coefficients of a step of the present duration.
    step: TimeStep,
    /// Time, position and depth at the end of the last step.
    body: BodyState,
    /// First and last element of the window in which elements can be loaded in the step.
    window: [usize; 2],
    /// Heights of the line over the window at the end of the step, \[m].
    heights: Vec<f64>,
    /// Heights of the line over the window at the beginning of the step, \[m].
    heights_before: HeightRow,
    /// Displacements at which the elements of the window carry nothing at the end of the step, \[m].
    unloaded_displacements: Vec<f64>,
    /// Contacts of the elements in the present cycle; empty unless they are recorded.
    contact_history: ContactHistory,
}

/// Sums over the elements in a step, divided by the unit of stress of the foundation.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct StepSums {
    /// Mean of Σ w over the step, \[m].
    pub(super) normal_load: f64,
    /// Mean of Σ w h̃' over the step, \[m].
    pub(super) tangential_load: f64,
    /// Energy that the dashpots dissipate, with that stored in elements that separate, \[m²].
    pub(super) dissipated: f64,
    /// The rearmost and the foremost loaded element at the end.
    ends: Option<[usize; 2]>,
    /// Number of elements that are loaded at the end.
    pub(super) n_loaded: usize,
}

/// The state at the end of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct FoundationStep {
    /// Indentation depth, \[m].
    pub(super) depth: f64,
    /// Sums over the elements.
    pub(super) sums: StepSums,
    /// Rearmost and foremost loaded element relative to the lowest point, \[m].
    pub(super) contact: Option<[f64; 2]>,
}

impl<'a> WinklerFoundation<'a> {
    /// An undeformed foundation for a line whose position stays in `range`, \[m].
    ///
    /// The line is at `position` \[m] at `time` \[s], with depth 0.
    pub(super) fn new(
        line: &'a dyn RigidLine,
        foundation: &'a Foundation,
        sampled: &'a ElementHeights,
        range: [f64; 2],
        time: f64,
        position: f64,
    ) -> Result<Self, MdrError> {
        let spacing = sampled.spacing;
        // Cover all positions of the line in the range, with a margin.
        let [rear, front] = [0, sampled.heights.len() - 1].map(|end| sampled.position(end));
        let first = ((range[0] + rear) / spacing).floor() - FOUNDATION_MARGIN;
        let last = ((range[1] + front) / spacing).ceil() + FOUNDATION_MARGIN;
        let n_elements = whole_part(last - first) + 1;
        Ok(Self {
            line: HeightTable::new(line, sampled)?,
            foundation,
            sampled,
            first,
            elements: Elements::untouched(foundation, n_elements),
            step: TimeStep::default(),
            body: BodyState {
                time,
                position,
                depth: 0.0,
            },
            window: [0; 2],
            heights: Vec::new(),
            heights_before: HeightRow::default(),
            unloaded_displacements: Vec::new(),
            contact_history: ContactHistory::default(),
        })
    }

    /// Height up to which elements are in the window of a step, \[m]: twice the depth before it, at most that of the sampled elements.
    /// A deeper step enlarges the window and is repeated.
    fn window_height(&self) -> f64 {
        self.sampled.max_height.min(2.0 * self.body.depth)
    }

    /// Moves the line to a `position` \[m] along the surface within a `duration` \[s], and its elements with it; `None` if the depth
    /// exceeds the heights of the sampled elements.
    pub(super) fn advance(
        &mut self,
        duration: f64,
        position: f64,
        prescribed: Prescribed,
    ) -> Result<Option<FoundationStep>, MdrError> {
        let time = self.body.time + duration;
        if duration.total_cmp(&self.step.duration).is_ne() {
            self.step = TimeStep::new(self.foundation, duration);
        }

        // Find the depth; if it exceeds the height of the window, enlarge the window.
        let mut limit = self.window_height();
        let depth = loop {
            self.update_window(position, limit)?;
            self.find_unloaded_displacements();
            let depth = finite("indentation depth", self.solve_depth(prescribed), time)?;
            if depth <= limit {
                break depth;
            }
            if limit >= self.sampled.max_height {
                return Ok(None);
            }
            limit = self.sampled.max_height;
        };

        // All elements of the window advance to the end of the step, and their loads and energies are summed.
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
        let moved = position - self.body.position;
        self.body = to;
        // Keep the heights as those at the beginning of the next step.
        std::mem::swap(&mut self.heights, &mut self.heights_before.heights);
        self.heights_before.first = self.window[0];
        self.check_edge(&sums, moved)?;
        Ok(Some(FoundationStep {
            depth,
            sums,
            contact: sums
                .ends
                .map(|ends| ends.map(|element| self.relative_position(element))),
        }))
    }

    /// Spacing of the elements, \[m].
    pub(super) const fn spacing(&self) -> f64 {
        self.sampled.spacing
    }

    /// Present indentation depth, \[m].
    pub(super) const fn depth(&self) -> f64 {
        self.body.depth
    }

    /// Position of an element relative to the lowest point, \[m].
    fn relative_position(&self, element: usize) -> f64 {
        (self.first + element as f64) * self.sampled.spacing - self.body.position
    }

    /// Refuses a contact beside an element over which there is no body, after a motion by `moved` \[m].
    ///
    /// At the trailing end elements pass the edge of the body, and are free.
    fn check_edge(&self, sums: &StepSums, moved: f64) -> Result<(), MdrError> {
        let Some([rear, front]) = sums.ends else {
            return Ok(());
        };
        // `height` is that of the line over an element at the end of the step, which the last swap has made the beginning of
        // the next one.
        let height = |element: usize| {
            let index = element.checked_sub(self.heights_before.first)?;
            self.heights_before.heights.get(index).copied()
        };
        let rest = REST_DISPLACEMENT * self.sampled.spacing;
        for (end, beyond, is_trailing) in [
            (rear, rear.wrapping_sub(1), moved > rest),
            (front, front + 1, moved < -rest),
        ] {
            if !is_trailing && height(beyond) == Some(f64::INFINITY) {
                return Err(MdrError::ContactReachesEdge {
                    position: self.relative_position(end),
                    indentation_depth: self.body.depth,
                    time: self.body.time,
                });
            }
        }
        Ok(())
    }

    /// Sets the window to the elements below a height `limit` \[m] at the start or the end of the step, when the line is at `position`
    /// \[m], and its heights.
    fn update_window(&mut self, position: f64, limit: f64) -> Result<(), MdrError> {
        let spacing = self.sampled.spacing;
        let heights = &self.sampled.heights;

        // The window holds all elements below the limit at the positions before and after the step, with one more on each side.
        let is_low = |height: &f64| *height <= limit;
        let anchor = self.sampled.anchor_index;
        let rear = heights
            .iter()
            .position(is_low)
            .unwrap_or(anchor)
            .saturating_sub(1);
        let front = heights.iter().rposition(is_low).unwrap_or(anchor) + 1;
        let rear_x = self.sampled.position(rear);
        let front_x = self.sampled.position(front.min(heights.len() - 1));
        let positions = [self.body.position, position];
        let low = (positions[0].min(positions[1]) + rear_x) / spacing - self.first;
        let high = (positions[0].max(positions[1]) + front_x) / spacing - self.first;
        let last = self.elements.states.len() - 1;
        let window = [
            whole_part(low.floor() - 1.0),
            whole_part(high.ceil() + 1.0).min(last),
        ];

        // The heights of the line over the window are computed at both positions.
        let start = (self.first + window[0] as f64) * spacing;
        let count = window[1] + 1 - window[0];
        self.window = window;
        self.line
            .fill_row(start - position, count, &mut self.heights)?;
        let x = |element: usize| (self.first + element as f64) * spacing - self.body.position;
        self.heights_before.cover(&self.line, window, x)
    }

    /// Computes the displacements at which the elements of the window carry nothing at the end of the step.
    fn find_unloaded_displacements(&mut self) {
        self.unloaded_displacements.clear();
        for element in self.window[0]..=self.window[1] {
            let elements = &mut self.elements;
            let unloaded = elements.unloaded_displacement(element, &self.step, self.body.time);
            self.unloaded_displacements.push(unloaded);
        }
    }

    /// Depth at the end of the step \[m], given or from the balance of forces over the window.
    fn solve_depth(&self, prescribed: Prescribed) -> f64 {
        let balance = ForceBalance {
            heights: &self.heights,
            displacements: &self.unloaded_displacements,
        };
        match prescribed {
            Prescribed::Depth(depth) => depth,
            Prescribed::Load(load) if load > 0.0 => {
                let compression = load / self.step.stiffness;
                balance.solve(compression, self.body.depth).depth
            }
            // Without a force the line just touches the first element.
            Prescribed::Load(_) => balance.first_contact_depth(),
        }
    }

    /// Advances one element of the window to the end of the step, and adds its work to the sums.
    fn advance_element(&mut self, index: usize, to: BodyState, sums: &mut StepSums) {
        let element = self.window[0] + index;
        let heights = [self.heights_before.over(element), self.heights[index]];
        let imposed = [self.body.depth - heights[0], to.depth - heights[1]];
        let unloaded = self.unloaded_displacements[index];
        let Some(step) = self
            .elements
            .advance(element, imposed, unloaded, &self.step, to.time)
        else {
            return;
        };

        // Add its work, and record its contact for the search of a limit cycle.
        self.contact_history
            .record(element, &step, self.step.duration);
        let load = step.work.impulse / self.step.duration;
        sums.normal_load += load;
        sums.tangential_load += load * self.slope(element, heights, to.position);
        sums.dissipated += step.work.dissipated;
        if step.is_loaded {
            sums.n_loaded += 1;
            sums.ends = Some([sums.ends.map_or(element, |[rear, _]| rear), element]);
        }
    }

    /// Mean slope h̃' of the line over an element while the line moves to a position, with the `heights` over the element at the
    /// beginning and the end of the step, \[m]; at rest, the mean slope over the width of the element.
    fn slope(&self, element: usize, heights: [f64; 2], position: f64) -> f64 {
        let moved = position - self.body.position;
        let spacing = self.sampled.spacing;
        if moved.abs() > REST_DISPLACEMENT * spacing {
            let rise = heights[0] - heights[1];
            // An element that passes the edge of the body carries nothing afterwards.
            return if rise.is_finite() { rise / moved } else { 0.0 };
        }
        let x = self.relative_position(element);
        let height = |x: f64| self.line.height_at(x).unwrap_or(f64::NAN);
        (height(x + 0.5 * spacing) - height(x - 0.5 * spacing)) / spacing
    }

    /// Separates all elements, so that the amplitudes of recovery are the whole state of the foundation, and sets the time to
    /// `time`, \[s]. Returns the energy that was stored in the loaded elements.
    ///
    /// If the instantaneous modulus is finite, [`reload`](Self::reload) at the same position stores that energy again.
    pub(super) fn unload_all(&mut self, time: f64) -> f64 {
        let mut released = 0.0;
        let elapsed = self.body.time - time;
        for element in 0..self.elements.states.len() {
            if let ElementState::Free { since, .. } = &mut self.elements.states[element] {
                *since -= elapsed;
            }
            released += self.elements.separate_instantly(element, time);
        }
        self.body.time = time;
        released
    }

    /// Brings the elements into contact again that [`unload_all`](Self::unload_all) separated; returns the energy stored in
    /// them.
    pub(super) fn reload(&mut self) -> Result<f64, MdrError> {
        // The window is set to the elements near the line at its present position.
        self.update_window(self.body.position, self.window_height())?;
        // With a dashpot a gap may be rounding of positions and heights.
        let tolerance = if self.foundation.has_dashpot() {
            f64::EPSILON.sqrt() * self.body.depth
        } else {
            0.0
        };
        // Bring each element that the line penetrates into contact instantaneously.
        let mut stored = 0.0;
        for (element, height) in (self.window[0]..=self.window[1]).zip(&self.heights) {
            let ElementState::Free { limit, .. } = self.elements.states[element] else {
                continue;
            };
            let imposed = self.body.depth - height;
            let recovering: f64 = self.elements.history_of(element).iter().sum();
            if imposed + tolerance > limit - recovering {
                stored += self
                    .elements
                    .make_contact_instantly(element, limit, imposed);
            }
        }
        Ok(stored)
    }

    /// Moves the frame with the line by one element, so that the line is at `position` \[m] again: discards the rearmost
    /// element, and adds an undeformed one in front.
    ///
    /// No part of the line may be over the rearmost element.
    pub(super) fn follow(&mut self, position: f64) {
        self.elements.replace_rearmost();
        self.heights_before.first -= 1;
        self.body.position = position;
    }

    /// Positions of the elements from the rearmost loaded one to the foremost \[m], with a free one on each side, and their
    /// loads per length \[N/m] at the end of the last step.
    pub(super) fn loads_per_length(&self) -> Vec<[f64; 2]> {
        let (heights, first) = (&self.heights_before.heights, self.window[0]);
        let unit = 4.0 * self.foundation.unit * self.step.stiffness;
        let rows = heights.iter().zip(&self.unloaded_displacements).enumerate();
        let loads: Vec<[f64; 2]> = rows
            .map(|(index, (height, unloaded))| {
                let compression = self.body.depth - height - unloaded;
                [
                    self.relative_position(first + index),
                    unit * compression.max(0.0),
                ]
            })
            .collect();
        let is_loaded = |[_, load]: &[f64; 2]| *load > 0.0;
        let rear = loads.iter().position(is_loaded).unwrap_or(0);
        let front = loads.iter().rposition(is_loaded).unwrap_or(0);
        loads[rear.saturating_sub(1)..=(front + 1).min(loads.len() - 1)].to_vec()
    }

    /// Begins a new record of the contacts of all elements, for the search for a limit cycle.
    pub(super) fn start_recording(&mut self) {
        self.contact_history = ContactHistory::new(self.elements.states.len());
    }

    /// Contacts of all elements since [`start_recording`](Self::start_recording); ends the record.
    pub(super) fn take_contact_history(&mut self) -> ContactHistory {
        std::mem::take(&mut self.contact_history)
    }

    /// Amplitudes of recovery β_k at the present time, element by element, \[m]; all elements must be free or untouched.
    pub(super) fn recovery_amplitudes(&mut self) -> &mut [f64] {
        for element in 0..self.elements.states.len() {
            self.elements.recover_until(element, self.body.time);
        }
        &mut self.elements.history
    }
}
