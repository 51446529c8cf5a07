//! The steps of a march: where the indenter stands at the end of each, how the load changes within it, and which rows of elements
//! later steps still need.
//!
//! Theory: docs/theory/transient-half-space.md, "Motions".

use std::ops::Range;

use indenters::SlidingLoad;
use numerics::{finite, positive};
use rheology::{CreepSpectrum, ExponentialStep, RheologyError};

use super::Motion;
use crate::BemError;
use crate::contact::check_control;
use crate::elements::grid::whole_elements;
use crate::march::MAX_STEPS;

/// Reason in the error for a load without a sliding distance.
const DISTANCE_NEEDED: &str = "a march over a half space ends after a distance";

/// Coefficients of a step of a duration \[s], on loads that are [held](ExponentialStep::creep) at their value at its end, or
/// [linear](ExponentialStep::creep_linear) from the end of the step before (docs/theory/transient-half-space.md, "Linear loads").
type StepRule = fn(&CreepSpectrum, f64) -> Result<ExponentialStep, RheologyError>;

/// A motion and its duration, which the difference of two times would give with a rounding error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TimedMotion {
    /// Time, position and control at the end.
    pub(crate) end: Motion,
    /// Duration Δt, \[s].
    pub(crate) duration: f64,
}

/// One step in time with the position of the indenter on the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ScheduledStep {
    /// Time, position and control at the end of the step.
    pub(super) end: Motion,
    /// Duration Δt, \[s].
    pub(super) time_step: f64,
    /// Row of elements under the lowest point at the end of the step, counted from the rearmost such row of all steps.
    pub(super) row: usize,
    /// Position of the lowest point relative to the centre of that row, in elements, from −½ to ½.
    pub(super) offset: f64,
    /// Displacement of the indenter during the step, in elements.
    pub(super) advance: f64,
}

/// All steps of a march.
pub(crate) struct Schedule {
    /// Steps in the order of time.
    pub(super) steps: Vec<ScheduledStep>,
    /// Course of the load within a step, held or linear, as the constructor of the coefficients of the creep law.
    pub(super) step_rule: StepRule,
    /// For each step, the rearmost and the foremost row under the lowest point in it and all later ones.
    spans: Vec<[usize; 2]>,
}

impl Schedule {
    /// The steps through `motions`, with loads that are held over each; `spacing` is Δx \[m].
    pub(super) fn from_motions(motions: &[Motion], spacing: f64) -> Result<Self, BemError> {
        // The duration of a step is the difference between its time and that of the step before.
        let mut previous_time = 0.0;
        let timed = motions.iter().map(|&end| {
            let duration = end.time - previous_time;
            previous_time = end.time;
            TimedMotion { end, duration }
        });
        Self::new(timed, ExponentialStep::creep, spacing)
    }

    /// Sliding in steps of a `length` \[m], with loads that are held over each; the last step ends at the sliding distance and is 0.5
    /// to 1.5 of that length.
    pub(super) fn sliding(load: &SlidingLoad, length: f64, spacing: f64) -> Result<Self, BemError> {
        load.require_fresh_ground()?;
        positive("spacing along x", spacing)?;
        // Divide the distance into steps; the last one takes up the remainder.
        let distance = load
            .sliding_distance()
            .ok_or(BemError::SlidingDistanceMissing {
                why: DISTANCE_NEEDED,
            })?;
        let (n_steps, last) = divide_into_steps(distance, length)?;
        let motions = (1..=n_steps).map(|step| {
            let [position, length] = if step == n_steps {
                [distance, last]
            } else {
                [step as f64 * length, length]
            };
            TimedMotion {
                end: Motion {
                    time: position / load.velocity(),
                    position,
                    control: load.control(),
                },
                duration: length / load.velocity(),
            }
        });
        Self::new(motions, ExponentialStep::creep, spacing)
    }

    /// The steps through `motions`, with loads that are linear over each. The steps after the first one may be repeated, as cycles of a
    /// motion, so that the history of every row is needed after every step.
    pub(crate) fn repeated(
        motions: impl Iterator<Item = TimedMotion>,
        spacing: f64,
    ) -> Result<Self, BemError> {
        let mut schedule = Self::new(motions, ExponentialStep::creep_linear, spacing)?;
        if let Some(first) = schedule.spans.first().copied() {
            schedule.spans.fill(first);
        }
        Ok(schedule)
    }

    /// The steps through `motions`, from the centre of an element at time and position 0; `spacing` is Δx \[m].
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for no motions, for durations that are not positive, and for positions and controls out of
    /// range.
    fn new(
        motions: impl Iterator<Item = TimedMotion>,
        step_rule: StepRule,
        spacing: f64,
    ) -> Result<Self, BemError> {
        positive("spacing along x", spacing)?;
        let (mut steps, mut cells) = (Vec::new(), Vec::new());
        let (mut cell_before, mut offset_before) = (0.0, 0.0);
        for TimedMotion { end, duration } in motions {
            let time_step = positive("time step", duration)?;
            // Express the position on the grid by the nearest element and the offset from its centre.
            let [cell, offset] = nearest_element(end.position, spacing)?;
            check_control(end.control)?;
            steps.push(ScheduledStep {
                end,
                time_step,
                row: 0,
                offset,
                advance: (cell - cell_before) + (offset - offset_before),
            });
            cells.push(cell);
            (cell_before, offset_before) = (cell, offset);
        }
        positive("number of steps", steps.len() as f64)?;
        // Count the rows from the rearmost one of all steps, so that no number is negative.
        let lowest = cells.iter().copied().fold(f64::INFINITY, f64::min);
        for (step, cell) in steps.iter_mut().zip(cells) {
            step.row = whole_elements(cell - lowest)?;
        }
        let spans = later_spans(&steps);
        Ok(Self {
            steps,
            step_rule,
            spans,
        })
    }

    /// True if the indenter never moves.
    pub(super) fn is_at_rest(&self) -> bool {
        let mut steps = self.steps.iter();
        steps.all(|step| step.advance == 0.0 && step.offset == 0.0)
    }

    /// The schedule on a material without history variables: the elements move with the indenter, which stays over row 0.
    pub(super) fn without_history(mut self) -> Self {
        for step in &mut self.steps {
            step.row = 0;
        }
        self.spans.fill([0; 2]);
        self
    }

    /// Rows of the path that footprints of `n_rows` rows cover in step number `first` and all later ones; empty after the last step.
    pub(super) fn rows_from(&self, first: usize, n_rows: usize) -> Range<usize> {
        let span = self.spans.get(first);
        span.map_or(0..0, |[low, high]| *low..high + n_rows)
    }
}

/// Number of steps of a `length` over a `distance`, and the length of the last one, 0.5 to 1.5 times that of the others; all lengths
/// in \[m]. Fails with [`BemError::TooManySteps`].
fn divide_into_steps(distance: f64, length: f64) -> Result<(usize, f64), BemError> {
    let steps = distance / length;
    if steps > MAX_STEPS {
        return Err(BemError::TooManySteps {
            steps,
            limit: MAX_STEPS,
        });
    }
    // The last step takes up the remainder, so that it is 0.5 to 1.5 times as long as the others.
    let before = (steps - 0.5).ceil().max(1.0) - 1.0;
    let fraction = steps - before;
    // A whole step must not become another one by rounding, or results would depend on the unit of length.
    let is_whole = (fraction - 1.0).abs() <= 4.0 * f64::EPSILON * steps;
    let last = if is_whole { length } else { fraction * length };
    Ok((whole_elements(before)? + 1, last))
}

/// For each step, the rearmost and the foremost row under the lowest point in it and all later ones: running extrema from the end.
fn later_spans(steps: &[ScheduledStep]) -> Vec<[usize; 2]> {
    let mut spans: Vec<[usize; 2]> = steps.iter().map(|step| [step.row; 2]).collect();
    for step in (1..spans.len()).rev() {
        let [low, high] = spans[step];
        let before = &mut spans[step - 1];
        *before = [before[0].min(low), before[1].max(high)];
    }
    spans
}

/// [index of the nearest element, position relative to its centre], both in elements of the edge `spacing` \[m], for a `position` \[m];
/// the index is an integer and may be negative.
fn nearest_element(position: f64, spacing: f64) -> Result<[f64; 2], BemError> {
    let elements = finite("position", position)? / spacing;
    let cell = elements.round();
    let offset = elements - cell;
    // A whole number must not become a fraction by rounding, or results would depend on the unit of length.
    let rounding = 4.0 * f64::EPSILON * elements.abs();
    let is_rounding = offset.abs() <= rounding;
    Ok([cell, if is_rounding { 0.0 } else { offset }])
}
