//! Pressure and buffers of a contact solve, on a grid and on a part of it.

use crate::contact::fields::Fields;
use crate::elements::area;
use crate::elements::bounds::Bounds;
use crate::elements::mirror::Mirror;
use crate::parallel::bands::for_each_row;
use crate::transform::convolution::Surroundings;
use crate::{BemError, Convolution, ConvolutionWorkspace, Grid};

/// Pressure and buffers of a contact; kept by the caller so that one solution is the first guess of the next. With the
/// feature `rayon`, the buffers are for the threads of the pool of the first solve.
#[derive(Debug, Clone)]
pub struct ContactState {
    /// Pressure, \[Pa]; within a solve the load `x = α P / (4π)`, \[m].
    pub(super) load: Vec<f64>,
    pub(super) displacement: Vec<f64>,
    /// Elements in contact, increasing.
    contact: Vec<usize>,
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
    pub fn new(convolution: &Convolution) -> Self {
        let n = convolution.grid().n_elements();
        Self {
            load: vec![0.0; n],
            displacement: vec![0.0; n],
            contact: Vec::new(),
            kind: None,
            workspace: None,
            fields: None,
            inner: None,
            front: None,
        }
    }

    /// Pressure P ≥ 0, \[Pa], row-major.
    pub fn pressure(&self) -> &[f64] {
        &self.load
    }

    /// The pressure to start from, \[Pa], row-major. Anything but a positive number is taken as zero; without any
    /// pressure the solver starts from solutions on coarser grids.
    pub fn pressure_mut(&mut self) -> &mut [f64] {
        &mut self.load
    }

    /// Indices of the elements in contact after a solve, increasing.
    pub fn contact(&self) -> &[usize] {
        &self.contact
    }

    /// Displacement of the surface under the pressure of the last solve, without what it was before, \[m], row-major.
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

    pub(super) fn for_each_load(&mut self, grid: &Grid, replace: impl Fn(f64) -> f64 + Sync) {
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

/// A box of elements around the contact, on which the contact is solved in place of the grid.
#[derive(Debug, Clone)]
pub(crate) struct ContactBox {
    pub(crate) bounds: Bounds,
    pub(super) convolution: Convolution,
    pub(crate) state: ContactState,
    pub(crate) separation: Vec<f64>,
}

impl ContactBox {
    fn new(convolution: Convolution, bounds: Bounds) -> Self {
        Self {
            bounds,
            state: ContactState::new(&convolution),
            separation: vec![0.0; bounds.n_elements()],
            convolution,
        }
    }

    /// A box of elements of the grid of a convolution, at the same mirrors.
    pub(crate) fn of(convolution: &Convolution, bounds: Bounds) -> Result<Self, BemError> {
        let grid = Grid::new(bounds.shape(), convolution.grid().spacing())?;
        Ok(Self::new(convolution.on_grid(&grid), bounds))
    }

    /// The part of the grid of a convolution in front of mirrors in its middle.
    pub(super) fn in_front_of(mirrors: [Mirror; 2], convolution: &Convolution) -> Self {
        let folded = convolution.folded(mirrors);
        let (part, upper) = (folded.grid().shape(), convolution.grid().shape());
        let lower = [upper[0] - part[0], upper[1] - part[1]];
        Self::new(folded, Bounds { lower, upper })
    }

    /// A box of other bounds that starts from the load of this one.
    pub(crate) fn moved_to(&self, bounds: Bounds) -> Result<Self, BemError> {
        let mut moved = Self::of(&self.convolution, bounds)?;
        for (element, load) in self.loaded_elements() {
            if bounds.contains(element) {
                moved.state.load[bounds.index_of(element)] = load;
            }
        }
        Ok(moved)
    }

    /// Copies what lies inside the bounds from fields with `columns` columns, the load as a first guess.
    pub(super) fn take_from(&mut self, [separation, load]: [&[f64]; 2], columns: usize) {
        let bounds = self.bounds;
        bounds.extract(separation, columns, &mut self.separation);
        bounds.extract(load, columns, &mut self.state.load);
    }

    pub(super) fn give_load_to(&self, field: &mut [f64], columns: usize) {
        let (rows, width) = (self.bounds.rows(), self.bounds.shape()[1]);
        let field = &mut field[rows.start * columns..rows.end * columns];
        for_each_row(field, columns, |row, values| {
            let load = &self.state.load[row * width..][..width];
            values[self.bounds.columns()].copy_from_slice(load);
        });
    }

    /// Area of the elements with load and of their images, in elements; the field begins at its mirrors.
    pub(crate) fn area(&self, mirrors: [Mirror; 2]) -> f64 {
        area::in_elements(&self.state.load, &self.bounds, mirrors)
    }

    /// Elements with load, as [row, column] of the field in which the box lies, and their load.
    pub(crate) fn loaded_elements(&self) -> impl Iterator<Item = ([usize; 2], f64)> {
        let (lower, columns) = (self.bounds.lower, self.bounds.shape()[1]);
        let loads = self.state.load.iter().enumerate();
        let loaded = loads.filter(|(_, load)| **load > 0.0);
        loaded.map(move |(index, &load)| {
            let element = [lower[0] + index / columns, lower[1] + index % columns];
            (element, load)
        })
    }
}
