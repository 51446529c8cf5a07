//! Pressure and buffers of a contact solve.

use crate::bands::for_each_row;
use crate::contact::contact_box::ContactBox;
use crate::contact::iteration::Fields;
use crate::convolution::Surroundings;
use crate::{Convolution, ConvolutionWorkspace, Grid};

/// Pressure and buffers of a contact; kept by the caller so that one solution is the first guess of the next. With the
/// feature `rayon`, the buffers are for the threads of the pool of the first solve.
#[derive(Debug, Clone)]
pub struct ContactState {
    /// Pressure, \[Pa]; within a solve the load `x = α P / (4π)`, \[m].
    pub(super) load: Vec<f64>,
    pub(super) displacement: Vec<f64>,
    /// Elements in contact, increasing.
    contact: Vec<usize>,
    /// Whether the iteration may run on a box around the contact.
    pub(crate) may_have_box: bool,
    /// The grid, and what surrounds it, for which everything below was made when it was first needed.
    kind: Option<(Grid, Surroundings)>,
    pub(super) workspace: Option<ConvolutionWorkspace>,
    /// Buffers of the iteration on the whole grid.
    pub(super) fields: Option<Box<Fields>>,
    /// The part of the grid on which the iteration last ran instead.
    pub(super) inner: Option<Box<ContactBox>>,
    /// The part of the grid in front of the mirrors that the last problem had.
    pub(super) front: Option<Box<ContactBox>>,
}

impl ContactState {
    /// A state without pressure for the grid of `convolution`.
    #[must_use]
    pub fn new(convolution: &Convolution) -> Self {
        let n = convolution.grid().n_elements();
        Self {
            load: vec![0.0; n],
            displacement: vec![0.0; n],
            contact: Vec::new(),
            may_have_box: true,
            kind: None,
            workspace: None,
            fields: None,
            inner: None,
            front: None,
        }
    }

    /// Pressure P ≥ 0, \[Pa], row-major.
    #[must_use]
    pub fn pressure(&self) -> &[f64] {
        &self.load
    }

    /// The pressure to start from, \[Pa], row-major. Anything but a positive number is taken as zero; without any
    /// pressure the solver starts from solutions on coarser grids.
    pub fn pressure_mut(&mut self) -> &mut [f64] {
        &mut self.load
    }

    /// Indices of the elements in contact after a solve, increasing.
    #[must_use]
    pub fn contact(&self) -> &[usize] {
        &self.contact
    }

    /// Displacement of the surface under the pressure of the last solve, without what it was before, \[m], row-major.
    #[must_use]
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    /// Drops the buffers that were made for another convolution.
    pub(super) fn prepare_for(&mut self, convolution: &Convolution) {
        let kind = Some((*convolution.grid(), convolution.surroundings));
        if self.kind != kind {
            self.kind = kind;
            (self.workspace, self.fields) = (None, None);
            (self.inner, self.front) = (None, None);
        }
    }

    /// Takes what the caller left as a first guess, times a factor; anything but a positive number is taken as zero.
    pub(super) fn take_guess(&mut self, grid: &Grid, factor: f64) {
        self.for_each_load(grid, |load| {
            let guess = load * factor;
            let is_load = guess > 0.0 && guess.is_finite();
            if is_load { guess } else { 0.0 }
        });
    }

    pub(super) fn scale_load(&mut self, grid: &Grid, factor: f64) {
        self.for_each_load(grid, |load| load * factor);
    }

    fn for_each_load(&mut self, grid: &Grid, replace: impl Fn(f64) -> f64 + Sync) {
        for_each_row(&mut self.load, grid.shape()[1], |_, row| {
            for load in row {
                *load = replace(*load);
            }
        });
    }

    pub(super) fn list_contact(&mut self) {
        self.contact.clear();
        let elements = self.load.iter().enumerate();
        let loaded = elements.filter(|(_, load)| **load > 0.0);
        self.contact.extend(loaded.map(|(element, _)| element));
    }
}
