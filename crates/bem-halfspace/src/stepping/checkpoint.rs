//! A long run in pieces.

use std::ops::{Range, RangeBounds};

use numerics::{InvalidParameter, finite, in_range};
use rheology::ExponentialStep;

use super::March;
use crate::BemError;
use crate::bounds::Bounds;
use crate::contact::{ContactBox, check_length};

/// The state of a march from which it can be continued, beside its input.
///
/// A march that is resumed makes the same steps to the last bit.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MarchState {
    steps_done: usize,
    /// Rows and columns of the footprint in front of the mirrors.
    footprint: [usize; 2],
    /// Lower and upper ends of the box around the contact, in elements in front of the mirrors.
    contact_box: [[usize; 2]; 2],
    /// Loads in the box.
    load: Vec<f64>,
    /// The memory of the rows that are still needed.
    memory: Vec<f64>,
}

impl MarchState {
    /// Number of steps made.
    pub const fn steps_done(&self) -> usize {
        self.steps_done
    }
}

impl March<'_> {
    /// The state from which a later run can continue.
    pub fn state(&self) -> MarchState {
        let Bounds { lower, upper } = self.contact_box.bounds;
        let rows = self.rows_needed(self.steps_done);
        MarchState {
            steps_done: self.steps_done,
            footprint: self.layout.followed(),
            contact_box: [lower, upper],
            load: self.contact_box.state.pressure().to_vec(),
            memory: self.window.memory(rows).to_vec(),
        }
    }

    /// Continues from the `state` of a march with the same input; the steps are the same to the last bit.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] or [`BemError::LengthMismatch`] for a state that does not fit this march.
    pub fn resume(&mut self, state: &MarchState) -> Result<(), BemError> {
        let (mut contact_box, memory) = self.check(state)?;
        let load = contact_box.state.pressure_mut();
        load.copy_from_slice(&state.load);
        self.contact_box = contact_box;
        self.steps_done = state.steps_done;
        let memory = self.window.memory_mut(memory);
        memory.copy_from_slice(&state.memory);
        let Some(last) = self.steps_done.checked_sub(1) else {
            return Ok(());
        };
        let last = self.route.legs[last];
        self.time_step = last.time_step;
        self.step = ExponentialStep::creep(&self.creep, self.time_step)?;
        self.sample(last.offset)
    }

    /// The empty box of a state, and the rows that it remembers.
    fn check(&self, state: &MarchState) -> Result<(ContactBox, Range<usize>), BemError> {
        let [lower, upper] = state.contact_box;
        let (shape, mirrors) = (self.layout.followed(), self.layout.mirrors);
        within("steps done", state.steps_done, ..=self.route.legs.len())?;
        let parameters = ["rows of the footprint", "columns of the footprint"];
        for (axis, parameter) in parameters.into_iter().enumerate() {
            within(parameter, state.footprint[axis], shape[axis]..=shape[axis])?;
            within("end of the contact box", upper[axis], ..=shape[axis])?;
            // The box begins at a mirror.
            let is_free = mirrors[axis].is_none();
            let last = if is_free { upper[axis] } else { 1 };
            within("start of the contact box", lower[axis], ..last)?;
        }
        let bounds = Bounds { lower, upper };
        let rows = self.rows_needed(state.steps_done);
        let n_values = self.window.memory(rows.clone()).len();
        for (field, values, elements) in [
            ("load", &state.load, bounds.n_elements()),
            ("memory", &state.memory, n_values),
        ] {
            check_length(field, values.len(), elements)?;
            for value in values {
                finite(field, *value)?;
            }
        }
        Ok((ContactBox::of(&self.window.convolution, bounds)?, rows))
    }
}

/// Checks an index of a state against its scene.
fn within(
    parameter: &'static str,
    value: usize,
    range: impl RangeBounds<usize>,
) -> Result<f64, InvalidParameter> {
    let allowed = "inside the scene that is resumed";
    in_range(parameter, value as f64, range.contains(&value), allowed)
}
