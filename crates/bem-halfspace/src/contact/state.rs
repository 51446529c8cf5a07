//! Pressure, scaled pressure and buffers of a contact solve, on a grid and on a part of it.

use numerics::Estimate;

use crate::contact::fields::Fields;
use crate::elements::area;
use crate::elements::bounds::Bounds;
use crate::elements::contact_boundary::{BoundaryField, root_load_gap_ratios};
use crate::elements::mirror::Mirror;
use crate::parallel::row_blocks::for_each_row;
use crate::transform::convolution::Surroundings;
use crate::{BemError, Convolution, ConvolutionWorkspace, Grid};

/// Mean excess of the polygons around a contact on square elements, in elements, per edge along the boundary. Measured under an elastic
/// paraboloid and an elastic cone, both with this limit.
const SQUARE_EXCESS_PER_EDGE: f64 = 0.1325;
/// Smallest error of the excess per edge that is stated, in elements. Measured: 0.016 on eight elements along an elastic contact, and
/// less on more; the rest is a safety factor. What creep within an element adds is of the first order, which differences between grids
/// show.
const REMAINING_EXCESS: f64 = 0.03;

/// Pressure and buffers of a contact solve.
///
/// The caller keeps it, so that one solution is the first guess of the next. With the feature `rayon`, the buffers are for the
/// threads of the pool of the first solve.
#[derive(Debug, Clone)]
pub struct ContactState {
    /// Pressure, \[Pa], row-major; empty within a solve, which uses its memory for the loads.
    pressure: Vec<f64>,
    /// Row-major indices of the elements in contact, increasing.
    contact: Vec<usize>,
    /// Grid and surroundings for which the buffers below were made; `None` before the first solve.
    buffers_for: Option<(Grid, Surroundings)>,
    /// Displacement and buffers of the last solve; its loads have a meaning within a solve only.
    loads: LoadState,
}

/// Loads, which are scaled pressures x = α P/(4π), and buffers of a solve for them; fields are row-major.
#[derive(Debug, Clone)]
pub(crate) struct LoadState {
    /// Load x of each element, without unit.
    pub(crate) load: Vec<f64>,
    /// Displacement K x under the loads of the last solve, \[m].
    pub(crate) displacement: Vec<f64>,
    /// Buffers for applying the operator on the whole grid.
    pub(super) workspace: Option<ConvolutionWorkspace>,
    /// Buffers of the conjugate gradients on the whole grid.
    pub(super) fields: Option<Box<Fields>>,
    /// The box on which the iteration last ran in place of the grid.
    pub(super) inner: Option<Box<ContactBox>>,
    /// The symmetry-reduced domain of the last problem that had mirrors.
    pub(super) front: Option<Box<ContactBox>>,
}

impl LoadState {
    /// Zero loads and displacements on a number of elements, with buffers that are not allocated yet.
    pub(super) fn new(n_elements: usize) -> Self {
        Self {
            load: vec![0.0; n_elements],
            displacement: vec![0.0; n_elements],
            workspace: None,
            fields: None,
            inner: None,
            front: None,
        }
    }

    /// Replaces every load of a field with `columns` columns by a function of it, in parallel.
    fn map_loads(&mut self, columns: usize, replace: impl Fn(f64) -> f64 + Sync) {
        for_each_row(&mut self.load, columns, |_, row| {
            for load in row {
                *load = replace(*load);
            }
        });
    }
}

impl ContactState {
    /// State with zero pressure on all elements of the grid of `convolution`.
    pub fn new(convolution: &Convolution) -> Self {
        let n_elements = convolution.grid().n_elements();
        Self {
            pressure: vec![0.0; n_elements],
            contact: Vec::new(),
            buffers_for: None,
            loads: LoadState::new(n_elements),
        }
    }

    /// Pressure P ≥ 0, \[Pa], row-major.
    pub fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    /// First guess of the pressure, \[Pa], row-major.
    ///
    /// Anything but a positive finite number is taken as zero. Without any pressure the solver starts from solutions on
    /// coarser grids.
    pub fn pressure_mut(&mut self) -> &mut [f64] {
        &mut self.pressure
    }

    /// Indices of the elements in contact after a solve, increasing.
    pub fn contact(&self) -> &[usize] {
        &self.contact
    }

    /// Displacement that the pressure of the last solve adds to the separation, \[m], row-major.
    pub fn displacement(&self) -> &[f64] {
        &self.loads.displacement
    }

    /// Calls `solve` with the loads of the first guess of the pressure, and turns its solution into the pressure, converged or not.
    ///
    /// Loads are pressures times `load_per_pressure` = α/(4π) \[1/Pa]; those that are not positive and finite become zero.
    /// `to_pressure` converts them back. Buffers for another grid or other surroundings are dropped.
    pub(super) fn solve_for_loads<R>(
        &mut self,
        convolution: &Convolution,
        load_per_pressure: f64,
        solve: impl FnOnce(&mut LoadState) -> R,
        to_pressure: impl Fn(f64) -> f64 + Sync,
    ) -> R {
        let [_, columns] = convolution.grid().shape();
        // Buffers of the last solve are used again on the same grid.
        let needed = Some((*convolution.grid(), convolution.surroundings));
        if self.buffers_for != needed {
            self.buffers_for = needed;
            self.loads = LoadState::new(convolution.grid().n_elements());
        }
        // Convert the pressures of the first guess to loads, in place. Tensile ones and those that are not finite become 0.
        self.loads.load = std::mem::take(&mut self.pressure);
        self.loads.map_loads(columns, |pressure| {
            let load = pressure * load_per_pressure;
            let is_load = load > 0.0 && load.is_finite();
            if is_load { load } else { 0.0 }
        });
        let solved = solve(&mut self.loads);
        // Convert the loads of the solution back to pressures, and list the elements in contact.
        self.loads.map_loads(columns, to_pressure);
        self.pressure = std::mem::take(&mut self.loads.load);
        self.contact.clear();
        let elements = self.pressure.iter().enumerate();
        let loaded = elements.filter(|(_, pressure)| **pressure > 0.0);
        self.contact.extend(loaded.map(|(element, _)| element));
        solved
    }
}

/// A rectangular part of a grid, on which the contact is solved in place of the grid; its fields are row-major in the part.
#[derive(Debug, Clone)]
pub(crate) struct ContactBox {
    /// Rows and columns of the part in the whole grid.
    pub(crate) bounds: Bounds,
    /// Operator K on the part.
    pub(super) convolution: Convolution,
    /// Loads and buffers of the part.
    pub(crate) state: LoadState,
    /// Initial gap of its elements, \[m], or in the unit of heights of a march.
    pub(crate) separation: Vec<f64>,
}

impl ContactBox {
    /// Box of elements within `bounds`, without load; `convolution` is the operator on the same elements.
    fn new(convolution: Convolution, bounds: Bounds) -> Self {
        Self {
            bounds,
            state: LoadState::new(bounds.n_elements()),
            separation: vec![0.0; bounds.n_elements()],
            convolution,
        }
    }

    /// The part of the grid of a convolution within `bounds`, with the same mirrors.
    pub(crate) fn cut_from(convolution: &Convolution, bounds: Bounds) -> Result<Self, BemError> {
        let grid = Grid::new(bounds.shape(), convolution.grid().spacing())?;
        Ok(Self::new(convolution.on_grid(&grid), bounds))
    }

    /// The symmetry-reduced domain of the grid of a convolution, for mirrors in its middle.
    pub(super) fn symmetry_reduced(mirrors: [Mirror; 2], convolution: &Convolution) -> Self {
        let folded = convolution.folded(mirrors);
        let (part, upper) = (folded.grid().shape(), convolution.grid().shape());
        let lower = [upper[0] - part[0], upper[1] - part[1]];
        Self::new(folded, Bounds { lower, upper })
    }

    /// A box with other bounds, whose load is that of this box where both overlap, and zero elsewhere.
    pub(crate) fn moved_to(&self, bounds: Bounds) -> Result<Self, BemError> {
        let mut moved = Self::cut_from(&self.convolution, bounds)?;
        for (element, load) in self.loaded_elements() {
            if bounds.contains(element) {
                moved.state.load[bounds.index_of(element)] = load;
            }
        }
        Ok(moved)
    }

    /// Copies separation and load, as a first guess, from row-major fields of the whole grid, which has `columns` columns.
    pub(super) fn extract_from(&mut self, separation: &[f64], load: &[f64], columns: usize) {
        let bounds = self.bounds;
        bounds.extract(separation, columns, &mut self.separation);
        bounds.extract(load, columns, &mut self.state.load);
    }

    /// Copies the load into a row-major field of the whole grid, which has `columns` columns.
    pub(super) fn copy_load_to(&self, field: &mut [f64], columns: usize) {
        let (rows, width) = (self.bounds.rows(), self.bounds.shape()[1]);
        let field = &mut field[rows.start * columns..rows.end * columns];
        for_each_row(field, columns, |row, values| {
            let load = &self.state.load[row * width..][..width];
            values[self.bounds.columns()].copy_from_slice(load);
        });
    }

    /// Contact area of the loaded elements and their images behind `mirrors`, with perimeter correction, in areas of an element.
    pub(crate) fn area(&self, mirrors: [Mirror; 2]) -> f64 {
        area::area_in_elements(&self.state.load, &self.bounds, mirrors)
    }

    /// Discretisation error of the contact area, in areas of an element.
    pub(crate) fn area_uncertainty(&self, mirrors: [Mirror; 2]) -> f64 {
        area::boundary_uncertainty(&self.state.load, &self.bounds, mirrors)
    }

    /// Contact area with a boundary that divides elements, of images behind `mirrors` too, in areas of an element, with its discretisation
    /// error. The solution has the indentation `depth` in the unit of heights; lengths of the kernel are in its grid.
    pub(crate) fn divided_area(&self, mirrors: [Mirror; 2], depth: f64) -> Estimate {
        // Unfold the box, with a margin of one element whose gap is not known.
        let [rows, columns] = [0, 1].map(|axis| {
            let range = area::unfolded_range(&self.bounds, mirrors, axis);
            range.start - 1..range.end + 1
        });
        let shape = [rows.len(), columns.len()];
        let (mut inside, mut values) = (Vec::new(), Vec::new());
        for row in rows {
            for column in columns.clone() {
                let index = area::folded_index(&self.bounds, mirrors, [row, column]);
                let load = index.map_or(0.0, |index| self.state.load[index]);
                let gap =
                    |index: usize| self.separation[index] + self.state.displacement[index] - depth;
                inside.push(load > 0.0);
                values.push(if load > 0.0 {
                    load
                } else {
                    index.map_or(f64::NAN, gap)
                });
            }
        }
        // Divide boundary elements where load inside and gap outside place the boundary.
        let edges = self.convolution.grid().spacing();
        let field = BoundaryField {
            shape,
            is_periodic: false,
            aspect: edges[1] / edges[0],
            inside,
            values,
            second_difference: [f64::NAN; 2],
            unit_depth_response: None,
        };
        let polygons = field.polygon_area(root_load_gap_ratios(edges));
        let error = REMAINING_EXCESS * polygons.edges;
        Estimate::new(polygons.corrected(SQUARE_EXCESS_PER_EDGE), error)
    }

    /// Measure of the singularity of the pressure at the contact boundary, from 0 to 1. It is 1 under a flat punch, and of the order
    /// 1/a² for a contact radius of a elements where the pressure vanishes like a root.
    pub(crate) fn edge_singularity(&self, mirrors: [Mirror; 2]) -> f64 {
        area::edge_singularity(&self.state.load, &self.bounds, mirrors)
    }

    /// The loaded elements, as [row, column] of the field in which the box lies, with their loads.
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
