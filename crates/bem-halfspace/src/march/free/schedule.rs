//! The steps of a march: where the indenter stands at the end of each, and which rows of elements later steps still need.
//!
//! Theory: docs/theory/transient-half-space.md, "Motions".

use std::ops::Range;

use numerics::{finite, positive};

use super::Motion;
use crate::BemError;
use crate::contact::check_control;
use crate::elements::grid::whole_elements;

/// One step in time with the position of the indenter on the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ScheduledStep {
    /// Time, position and control at the end of the step.
    pub(crate) end: Motion,
    /// Duration Δt, \[s].
    pub(crate) time_step: f64,
    /// Row under the lowest point at the end, counted from the rearmost such row of all steps.
    pub(crate) row: usize,
    /// Position of the lowest point relative to the centre of that row, in elements, from −½ to ½.
    pub(crate) offset: f64,
    /// Displacement of the indenter during the step, in elements.
    pub(crate) advance: f64,
}

/// All steps of a march.
pub(crate) struct Schedule {
    pub(crate) steps: Vec<ScheduledStep>,
    /// Lowest and highest row under the lowest point, over each step and all later ones.
    spans: Vec<[usize; 2]>,
}

impl Schedule {
    /// The steps to the ends of `motions`, each with its duration \[s], from the centre of an element at time and position 0.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for no motions, for durations that are not positive, and for positions and controls out of
    /// range.
    pub(crate) fn new(
        motions: impl Iterator<Item = (Motion, f64)>,
        spacing: f64,
    ) -> Result<Self, BemError> {
        let (mut steps, mut cells) = (Vec::new(), Vec::new());
        let (mut cell_before, mut offset_before) = (0.0, 0.0);
        for (end, time_step) in motions {
            let time_step = positive("time step", time_step)?;
            // Position on the grid, as an element and the offset from its centre.
            let [cell, offset] = place(end.position, spacing)?;
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
        // Count rows from the rearmost one.
        let lowest = cells.iter().copied().fold(f64::INFINITY, f64::min);
        for (step, cell) in steps.iter_mut().zip(cells) {
            step.row = whole_elements(cell - lowest)?;
        }
        let spans = spans(&steps);
        Ok(Self { steps, spans })
    }

    /// Whether the indenter never moves.
    pub(crate) fn rests(&self) -> bool {
        let mut steps = self.steps.iter();
        steps.all(|step| step.advance == 0.0 && step.offset == 0.0)
    }

    /// The schedule of a motion that is repeated: every row is needed after every step.
    pub(crate) fn repeated(mut self) -> Self {
        if let Some(first) = self.spans.first().copied() {
            self.spans.fill(first);
        }
        self
    }

    /// The schedule on a material without history variables: the elements move with the indenter, which stays over row 0.
    pub(crate) fn without_memory(mut self) -> Self {
        for step in &mut self.steps {
            step.row = 0;
        }
        self.spans.fill([0; 2]);
        self
    }

    /// Rows of the path that footprints of `n_rows` rows cover from step number `first` on; empty after the last step.
    pub(crate) fn rows_from(&self, first: usize, n_rows: usize) -> Range<usize> {
        let span = self.spans.get(first);
        span.map_or(0..0, |[low, high]| *low..high + n_rows)
    }
}

/// Lowest and highest row under the lowest point over each step and all later ones: running extrema from the end.
fn spans(steps: &[ScheduledStep]) -> Vec<[usize; 2]> {
    let mut spans: Vec<[usize; 2]> = steps.iter().map(|step| [step.row; 2]).collect();
    for step in (1..spans.len()).rev() {
        let [low, high] = spans[step];
        let before = &mut spans[step - 1];
        *before = [before[0].min(low), before[1].max(high)];
    }
    spans
}

/// Index of the element nearest to a position \[m], and the position relative to its centre, both in elements.
fn place(position: f64, spacing: f64) -> Result<[f64; 2], BemError> {
    let elements = finite("position", position)? / spacing;
    let cell = elements.round();
    let offset = elements - cell;
    // A whole number must not become a fraction by rounding, or results would depend on the unit of length.
    let rounding = 4.0 * f64::EPSILON * elements.abs();
    let is_rounding = offset.abs() <= rounding;
    Ok([cell, if is_rounding { 0.0 } else { offset }])
}
