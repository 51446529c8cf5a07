//! The path of an indenter over the elements.

use std::ops::Range;

use indenters::Control;
use numerics::{finite, positive};

use super::Motion;
use crate::BemError;
use crate::contact::check_control;
use crate::grid::whole;

/// One step of the path, seen from the elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Leg {
    /// Time at the end, \[s].
    pub(crate) time: f64,
    /// Duration, \[s].
    pub(crate) time_step: f64,
    /// Position of the lowest point at the end, \[m].
    pub(crate) position: f64,
    /// Row under the lowest point at the end, from the rearmost one of the whole path.
    pub(crate) row: usize,
    /// Distance of the lowest point from the centre of that row, in elements, at most a half.
    pub(crate) offset: f64,
    /// Motion during the step, in elements.
    pub(crate) advance: f64,
    /// What is given at the end.
    pub(crate) control: Control,
}

/// All steps, and which rows those to come pass.
#[derive(Debug, Clone)]
pub(crate) struct Route {
    pub(crate) legs: Vec<Leg>,
    /// Lowest and highest row under the lowest point from each leg on.
    spans: Vec<[usize; 2]>,
}

impl Route {
    /// The path through the ends of motions, from a centre of an element at time and position zero.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for no ends, times that do not increase from above zero, or positions and
    /// controls out of range; [`BemError::GridTooLarge`] for a path too long.
    pub(crate) fn through(
        motions: impl Iterator<Item = Motion>,
        spacing: f64,
    ) -> Result<Self, BemError> {
        let mut legs = Vec::new();
        let mut cells = Vec::new();
        let (mut time_before, mut cell_before, mut offset_before) = (0.0, 0.0, 0.0);
        for motion in motions {
            let Motion {
                time,
                position,
                control,
            } = motion;
            let time_step = positive("time step", time - time_before)?;
            let [cell, offset] = place(position, spacing)?;
            check_control(control)?;
            legs.push(Leg {
                time,
                time_step,
                position,
                row: 0,
                offset,
                advance: (cell - cell_before) + (offset - offset_before),
                control,
            });
            cells.push(cell);
            (time_before, cell_before, offset_before) = (time, cell, offset);
        }
        Self::of(legs, &cells)
    }

    /// Whole elements at a constant speed under a constant force.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for a duration or a force out of range, or no steps.
    pub(crate) fn straight(
        n_steps: usize,
        spacing: f64,
        velocity: f64,
        control: Control,
    ) -> Result<Self, BemError> {
        let time_step = positive("time step", spacing / velocity)?;
        check_control(control)?;
        let cells: Vec<f64> = (1..=n_steps).map(|step| step as f64).collect();
        let leg = |&cell: &f64| Leg {
            time: cell * spacing / velocity,
            time_step,
            position: cell * spacing,
            row: 0,
            offset: 0.0,
            advance: 1.0,
            control,
        };
        Self::of(cells.iter().map(leg).collect(), &cells)
    }

    fn of(mut legs: Vec<Leg>, cells: &[f64]) -> Result<Self, BemError> {
        positive("number of steps", legs.len() as f64)?;
        let lowest = cells.iter().copied().fold(f64::INFINITY, f64::min);
        for (leg, cell) in legs.iter_mut().zip(cells) {
            leg.row = whole(cell - lowest)?;
        }
        let mut spans: Vec<[usize; 2]> = legs.iter().map(|leg| [leg.row; 2]).collect();
        for leg in (1..spans.len()).rev() {
            let [low, high] = spans[leg];
            let before = &mut spans[leg - 1];
            *before = [before[0].min(low), before[1].max(high)];
        }
        Ok(Self { legs, spans })
    }

    /// Whether the indenter never moves.
    pub(crate) fn rests(&self) -> bool {
        self.legs
            .iter()
            .all(|leg| leg.advance == 0.0 && leg.offset == 0.0)
    }

    /// The same path over a half space without memory, so that the elements may move with the indenter.
    pub(crate) fn without_memory(mut self) -> Self {
        for leg in &mut self.legs {
            leg.row = 0;
        }
        self.spans.fill([0; 2]);
        self
    }

    /// Rows that footprints of `n_rows` rows cover from leg number `first` on; none after the last.
    pub(crate) fn rows_from(&self, first: usize, n_rows: usize) -> Range<usize> {
        let span = self.spans.get(first);
        span.map_or(0..0, |[low, high]| *low..high + n_rows)
    }
}

/// The nearest element to a position, and the distance from its centre, in elements.
fn place(position: f64, spacing: f64) -> Result<[f64; 2], BemError> {
    let elements = finite("position", position)? / spacing;
    let cell = elements.round();
    let offset = elements - cell;
    // A whole number must not become a fraction by rounding, or results would depend on the unit of length.
    let rounding = 4.0 * f64::EPSILON * elements.abs();
    Ok([
        cell,
        if offset.abs() <= rounding {
            0.0
        } else {
            offset
        },
    ])
}
