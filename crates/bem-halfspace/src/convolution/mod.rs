//! Fast convolution of a pressure field with the influence of the elements.
//!
//! ```text
//! (K P)_ij = Σ K(x_i − x_k, y_j − y_l) P_kl
//! ```
//!
//! The kernel is even along both axes, so its spectrum is real and one quarter of it is stored.

mod spectrum;

use std::ops::Range;

use rustfft::num_complex::Complex;

use crate::Grid;
use crate::fast_length::fast_length;
use crate::plane_transform::{PlaneTransform, Workspace};

/// What surrounds the elements of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Surroundings {
    /// A half space without load.
    Free,
    /// Copies of the grid without end.
    Periodic,
}

/// What the convolution on one grid needs and no pressure changes; may be shared between threads.
#[derive(Debug, Clone)]
pub struct Convolution {
    grid: Grid,
    surroundings: Surroundings,
    transform: PlaneTransform,
    /// Real spectrum, [column][0..=padded_x / 2], with the normalisation of the transforms folded in.
    spectrum: Vec<f64>,
    /// Displacement of an element under its own unit load, [m].
    self_influence: f64,
}

/// What a convolution overwrites; one per caller, made by [`Convolution::workspace`].
#[derive(Debug, Clone)]
pub struct ConvolutionWorkspace(Workspace);

impl Convolution {
    /// Influence on a half space that is free of load outside the grid.
    ///
    /// Zero padding to at least 2n − 1 makes the circular convolution of the Fourier transform the free one.
    #[must_use]
    pub fn new(grid: &Grid) -> Self {
        let padded = grid.shape().map(|n| fast_length(2 * n - 1));
        let mut convolution = Self::planned(grid, Surroundings::Free, padded);
        convolution.spectrum = convolution.free_spectrum();
        convolution.self_influence = crate::influence([0.0, 0.0], grid.spacing());
        convolution
    }

    /// Influence on a half space whose load repeats itself with the edges of the grid as periods.
    ///
    /// A wave of pressure with the wave vector q moves the surface by the same wave times `2π/|q|`
    /// (Johnson 1985, eq. 13.7). The mean pressure moves an infinite half space by an infinite amount; displacements
    /// are measured from their own mean instead.
    #[must_use]
    pub fn periodic(grid: &Grid) -> Self {
        let mut convolution = Self::planned(grid, Surroundings::Periodic, grid.shape());
        convolution.spectrum = convolution.periodic_spectrum();
        convolution.self_influence = convolution.sum_of_spectrum();
        convolution
    }

    /// A convolution on the blocks of two by two elements of a grid that multiplies a wave by the `symbol` of its wave
    /// vector \[rad/m], and the mean and all waves with a symbol below zero like the longest wave or not at all.
    pub(crate) fn on_blocks(grid: &Grid, symbol: impl Fn([f64; 2]) -> f64 + Sync) -> Self {
        let blocks = grid.blocks();
        let padded = blocks.shape().map(fast_length);
        let mut convolution = Self::planned(&blocks, Surroundings::Periodic, padded);
        convolution.spectrum = convolution.positive_spectrum(symbol);
        convolution
    }

    /// The same influence between elements of another grid.
    pub(crate) fn on_grid(&self, grid: &Grid) -> Self {
        match self.surroundings {
            Surroundings::Free => Self::new(grid),
            Surroundings::Periodic => Self::periodic(grid),
        }
    }

    fn planned(grid: &Grid, surroundings: Surroundings, padded: [usize; 2]) -> Self {
        Self {
            grid: *grid,
            surroundings,
            transform: PlaneTransform::new(padded),
            spectrum: Vec::new(),
            self_influence: 0.0,
        }
    }

    /// The grid of the pressure and of the result.
    #[must_use]
    pub const fn grid(&self) -> &Grid {
        &self.grid
    }

    pub(crate) const fn surroundings(&self) -> Surroundings {
        self.surroundings
    }

    pub(crate) const fn self_influence(&self) -> f64 {
        self.self_influence
    }

    /// Buffers for [`apply`](Self::apply). With the feature `rayon`, one set per thread of the current pool.
    #[must_use]
    pub fn workspace(&self) -> ConvolutionWorkspace {
        ConvolutionWorkspace(Workspace::new(&self.transform, self.grid.shape()))
    }

    /// Computes `K P` in the rows `wanted` of `result` from the rows `loaded` of `pressure`; the pressure outside
    /// these rows counts as zero and the other rows of the result are left as they are.
    ///
    /// Both fields have one value per element of the grid, row-major; the result has the unit of the pressure times
    /// metre. Does not allocate.
    ///
    /// # Panics
    /// When a field or the workspace does not belong to this grid.
    pub fn apply(
        &self,
        workspace: &mut ConvolutionWorkspace,
        (pressure, loaded): (&[f64], Range<usize>),
        (result, wanted): (&mut [f64], Range<usize>),
    ) {
        let elements = self.grid.n_elements();
        assert_eq!(pressure.len(), elements, "one pressure per element");
        assert_eq!(result.len(), elements, "one displacement per element");
        let (transform, workspace) = (&self.transform, &mut workspace.0);
        transform.load(workspace, pressure, &loaded);
        transform.pass(workspace, (&loaded, &wanted), |column, values| {
            self.multiply_column(values, column);
        });
        transform.read(workspace, result, &wanted);
    }

    fn multiply_column(&self, values: &mut [Complex<f64>], column: usize) {
        let half = self.transform.padded()[0] / 2;
        let spectrum = &self.spectrum[column * (half + 1)..][..=half];
        let (lower, upper) = values.split_at_mut(half + 1);
        for (value, factor) in lower.iter_mut().zip(spectrum) {
            *value *= factor;
        }
        for (value, factor) in upper.iter_mut().rev().zip(&spectrum[1..]) {
            *value *= factor;
        }
    }
}
