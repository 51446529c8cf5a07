//! Fast convolution of a pressure field with the influence coefficients of the elements.
//!
//! ```text
//! (K P)_ij = Σ K(x_i − x_k, y_j − y_l) P_kl
//! ```
//!
//! K(x, y) \[m] is the displacement at the offset (x, y) from an element under unit pressure, times 4π over the compliance
//! ([`influence`](crate::influence)). The kernel is even along both axes, so its spectrum is real and one quarter of it is stored.
//!
//! Theory: docs/theory/transient-half-space.md, "Elements and steps"; mirrors: docs/theory/contact.md, "Mirrors".

mod spectrum;

use std::ops::Range;
use std::sync::Arc;

use crate::elements::mirror::{Mirror, NO_MIRRORS};
use crate::transform::fast_length::fast_length;
use crate::transform::plane_transform::{PlaneTransform, Workspace};
use crate::{Base, Elastomer, Grid};

/// Boundary conditions of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Surroundings {
    /// No load outside the grid.
    Free,
    /// Periodic load, with the edges of the grid as periods.
    Periodic,
}

/// Operator K of the influence coefficients on one grid: spectrum and transform plans. It is immutable and may be shared
/// between threads.
#[derive(Debug, Clone)]
pub struct Convolution {
    /// Grid of the elements; with mirrors, of the symmetry-reduced domain.
    grid: Grid,
    /// Mirrors along x and y, at the first row and column of the grid: pressure and displacement are their own images.
    pub(crate) mirrors: [Mirror; 2],
    /// Boundary conditions of the grid.
    pub(crate) surroundings: Surroundings,
    /// Base of the material under the elements, with lengths in the unit of the grid.
    pub(crate) base: Base,
    /// Plans of the Fourier transforms over the padded period.
    transform: PlaneTransform,
    /// Real spectrum of the kernel over the whole period, [column][0..=padded_x / 2], times the normalisation of the transforms.
    /// A `Vec`, because an `Arc` of a slice would have to be copied into.
    spectrum: Arc<Vec<f64>>,
    /// Diagonal coefficient of K, the displacement of an element under its own unit load, in the unit of the grid's spacing.
    pub(crate) self_influence: f64,
}

/// Buffers of a convolution, one set per caller; made by [`Convolution::workspace`].
#[derive(Debug, Clone)]
pub struct ConvolutionWorkspace(Workspace);

/// Row ranges of a grid to which a product K P is limited.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rows {
    /// Rows that may have a pressure.
    pub loaded: Range<usize>,
    /// Rows in which the displacement is computed.
    pub wanted: Range<usize>,
}

impl Convolution {
    /// Convolution on a half space without load outside the grid.
    ///
    /// Zero padding to at least 2n − 1 elements makes the circular convolution of the Fourier transform equal to the free one.
    pub fn new(grid: &Grid) -> Self {
        Self::new_free(grid, Base::default())
    }

    /// Convolution on an elastomer without load outside the grid, whose spacing is in \[m]. Only thickness and Poisson ratio of
    /// the elastomer matter.
    pub fn for_elastomer(elastomer: &dyn Elastomer, grid: &Grid) -> Self {
        Self::new_free(grid, elastomer.base())
    }

    /// Convolution on a base without load outside the grid; grid and base have the same unit of length.
    pub(crate) fn new_free(grid: &Grid, base: Base) -> Self {
        let padded = grid.shape().map(|n| fast_length(2 * n - 1));
        let mut convolution = Self::with_plans(grid, Surroundings::Free, base, padded);
        convolution.spectrum = Arc::new(convolution.free_spectrum());
        convolution.self_influence = convolution.base.influence([0.0, 0.0], grid.spacing());
        convolution
    }

    /// Convolution on a half space under a periodic load, with the edges of the grid as periods.
    ///
    /// A pressure wave of the wave vector q gives the displacement `2π/|q|` times the same wave (Johnson 1985, eq. 13.7). The
    /// displacement by the mean pressure is infinite on a half space; displacements are measured from their own mean instead.
    pub fn periodic(grid: &Grid) -> Self {
        Self::new_periodic(grid, Base::default())
    }

    /// Convolution on an elastomer under a periodic load; see [`for_elastomer`](Self::for_elastomer). On a layer with a rigid base the
    /// displacement by the mean pressure is finite and included.
    pub fn periodic_for_elastomer(elastomer: &dyn Elastomer, grid: &Grid) -> Self {
        Self::new_periodic(grid, elastomer.base())
    }

    /// Convolution on a base under a periodic load; grid and base have the same unit of length.
    fn new_periodic(grid: &Grid, base: Base) -> Self {
        let mut convolution = Self::with_plans(grid, Surroundings::Periodic, base, grid.shape());
        convolution.spectrum = Arc::new(convolution.periodic_spectrum());
        convolution.self_influence = convolution.sum_of_spectrum();
        convolution
    }

    /// A periodic convolution on the blocks of two by two elements that multiplies the wave of the wave vector q \[rad/m] by
    /// `symbol(q)`.
    ///
    /// The mean is multiplied by the symbol of the longest wave. Negative symbols are replaced by zero.
    pub(crate) fn on_blocks(&self, symbol: impl Fn([f64; 2]) -> f64 + Sync) -> Self {
        let mirrors = self.mirrors.map(Mirror::of_blocks);
        let blocks = self.grid.blocks().unfolded(mirrors);
        let padded = blocks.shape().map(fast_length);
        let base = self.base.clone();
        let mut convolution = Self::with_plans(&blocks, Surroundings::Periodic, base, padded);
        convolution.spectrum = Arc::new(convolution.positive_spectrum(symbol));
        convolution.folded(mirrors)
    }

    /// A convolution with the kernel, boundary conditions and mirrors of this one on another grid.
    pub(crate) fn on_grid(&self, grid: &Grid) -> Self {
        self.on_folded_grid(self.mirrors, grid)
    }

    /// A convolution with the kernel and boundary conditions of this one on the blocks of two by two elements, which begin at the
    /// mirrors.
    pub(crate) fn between_blocks(&self) -> Self {
        self.on_folded_grid(self.mirrors.map(Mirror::of_blocks), &self.grid.blocks())
    }

    /// A convolution with the kernel and boundary conditions of this one on a `grid` that is the symmetry-reduced
    /// domain for `mirrors`.
    fn on_folded_grid(&self, mirrors: [Mirror; 2], grid: &Grid) -> Self {
        let whole = grid.unfolded(mirrors);
        let convolution = match self.surroundings {
            Surroundings::Free => Self::new_free(&whole, self.base.clone()),
            Surroundings::Periodic => Self::new_periodic(&whole, self.base.clone()),
        };
        convolution.folded(mirrors)
    }

    /// This operator for pressures that are their own images about `mirrors` in the middle of the grid.
    ///
    /// Fields are those of the symmetry-reduced domain. In a row or column through whose centre a mirror passes, half the
    /// pressure is given. `self` must have no mirrors.
    pub(crate) fn folded(&self, mirrors: [Mirror; 2]) -> Self {
        assert_eq!(self.mirrors, NO_MIRRORS, "a whole grid");
        if mirrors == NO_MIRRORS {
            return self.clone();
        }
        Self {
            grid: self.grid.folded(mirrors),
            mirrors,
            transform: PlaneTransform::folded(self.transform.padded, mirrors),
            spectrum: Arc::clone(&self.spectrum),
            base: self.base.clone(),
            ..*self
        }
    }

    /// A convolution with transform plans for a period of `padded` elements, and without a spectrum yet.
    fn with_plans(grid: &Grid, surroundings: Surroundings, base: Base, padded: [usize; 2]) -> Self {
        Self {
            base,
            grid: *grid,
            mirrors: NO_MIRRORS,
            surroundings,
            transform: PlaneTransform::new(padded),
            spectrum: Arc::new(Vec::new()),
            self_influence: 0.0,
        }
    }

    /// Grid of pressure and displacement.
    pub const fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Buffers for [`apply`](Self::apply); with the feature `rayon`, for the threads of the current pool.
    pub fn workspace(&self) -> ConvolutionWorkspace {
        ConvolutionWorkspace(Workspace::new(&self.transform, self.grid.shape()))
    }

    /// Computes `K P` on the whole grid.
    ///
    /// Both fields have one value per element of the grid, row-major; the result has the unit of the pressure times
    /// metre. Does not allocate.
    ///
    /// # Panics
    /// When a field or the workspace does not belong to this grid.
    pub fn apply(
        &self,
        workspace: &mut ConvolutionWorkspace,
        pressure: &[f64],
        result: &mut [f64],
    ) {
        let all = 0..self.grid.shape()[0];
        let rows = Rows {
            loaded: all.clone(),
            wanted: all,
        };
        self.apply_in(&rows, workspace, pressure, result);
    }

    /// Computes `K P` like [`apply`](Self::apply), for a pressure that is zero outside the rows `loaded`, and only in the rows
    /// `wanted`. Other rows of the pressure are not read, and other rows of the result are not changed.
    ///
    /// # Panics
    /// When a field, the rows or the workspace does not belong to this grid.
    pub fn apply_in(
        &self,
        Rows { loaded, wanted }: &Rows,
        workspace: &mut ConvolutionWorkspace,
        pressure: &[f64],
        result: &mut [f64],
    ) {
        let elements = self.grid.n_elements();
        assert_eq!(pressure.len(), elements, "one pressure per element");
        assert_eq!(result.len(), elements, "one displacement per element");
        let (transform, workspace) = (&self.transform, &mut workspace.0);
        // Transform loaded rows; multiply all columns by the spectrum; transform wanted rows back.
        transform.forward_rows(workspace, pressure, loaded);
        transform.filter_columns(workspace, loaded, wanted, |column, values| {
            transform.multiply_even(&self.spectrum, column, values);
        });
        transform.inverse_rows(workspace, result, wanted);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BemError;

    /// A field that is its own image about mirrors in the middle, and otherwise without symmetry.
    fn mirrored([rows, columns]: [usize; 2], mirrors: [Mirror; 2]) -> Vec<f64> {
        let fold = |index: usize, length: usize, mirror: Mirror| match mirror {
            Mirror::None => index,
            Mirror::Centre | Mirror::Edge => index.max(length - 1 - index),
        };
        let value = |index: usize| {
            let row = fold(index / columns, rows, mirrors[0]);
            let column = fold(index % columns, columns, mirrors[1]);
            (1.7 * row as f64).cos() + (0.3 * (row * column) as f64).sin() + 0.1 * column as f64
        };
        (0..rows * columns).map(value).collect()
    }

    /// The last rows and columns of a field, with half the values where mirrors pass through elements if these are loads.
    fn in_front(field: &[f64], folded: &Convolution, columns: usize, are_loads: bool) -> Vec<f64> {
        let [part_rows, part_columns] = folded.grid().shape();
        let [row, column] = [field.len() / columns - part_rows, columns - part_columns];
        let value = |index: usize| {
            let element = [index / part_columns, index % part_columns];
            let is_halved =
                |axis: usize| element[axis] == 0 && folded.mirrors[axis] == Mirror::Centre;
            let halved = (0..2).filter(|&axis| are_loads && is_halved(axis)).count();
            field[(row + element[0]) * columns + column + element[1]] / (1 << halved) as f64
        };
        (0..part_rows * part_columns).map(value).collect()
    }

    fn displacement(convolution: &Convolution, pressure: &[f64]) -> Vec<f64> {
        let mut result = vec![0.0; pressure.len()];
        convolution.apply(&mut convolution.workspace(), pressure, &mut result);
        result
    }

    /// Compares the displacement of the symmetry-reduced domain with that of the whole grid.
    fn check(whole: &Convolution, has_mirror: [bool; 2]) {
        let shape = whole.grid().shape();
        let mirrors = [0, 1].map(|axis| match shape[axis] % 2 {
            _ if !has_mirror[axis] => Mirror::None,
            0 => Mirror::Edge,
            _ => Mirror::Centre,
        });
        let folded = whole.folded(mirrors);
        let pressure = mirrored(shape, mirrors);
        let expected = displacement(whole, &pressure);
        let actual = displacement(&folded, &in_front(&pressure, &folded, shape[1], true));
        let largest = expected.iter().fold(0.0, |top: f64, u| top.max(u.abs()));
        let expected = in_front(&expected, &folded, shape[1], false);
        for (actual, expected) in actual.iter().zip(expected) {
            let error = (actual - expected).abs() / largest;
            // The difference may be as large as the rounding of transforms of a few hundred values.
            assert!(error < 1e-14, "{shape:?}, {mirrors:?}: {error:e}");
        }
    }

    #[test]
    fn half_and_quarter_of_a_mirrored_field_convolve_like_all_of_it() -> Result<(), BemError> {
        let shapes = [[2, 6], [6, 10], [12, 14], [30, 18]];
        let odd = [[1, 1], [3, 2], [4, 5], [9, 7], [29, 17], [18, 31]];
        // These shapes lie on both sides of the largest length for which half a period about a centre is transformed alone.
        let long = [[3, 45], [1, 375], [3, 511], [2, 1125], [1, 4095]];
        for shape in shapes.into_iter().chain(odd).chain(long) {
            let grid = Grid::new(shape, [1.0, 0.6])?;
            for has_mirror in [[true, false], [false, true], [true, true]] {
                check(&Convolution::new(&grid), has_mirror);
                if shape.iter().all(|n| n.is_multiple_of(2)) {
                    check(&Convolution::periodic(&grid), has_mirror);
                }
            }
        }
        Ok(())
    }
}
