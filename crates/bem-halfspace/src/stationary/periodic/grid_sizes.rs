//! Sizes of the grids of a periodic surface: the first one of a refinement, the smallest ones with error bars, and the largest one that
//! fits into memory.

use indenters::rough::PeriodicSurface;
use numerics::{Accuracy, Request};

use crate::BemError;
use crate::dense::MAX_MATRIX_BYTES;
use crate::elements::grid::{MAX_ELEMENTS, MIN_COARSEST_EDGE};
use crate::stationary::periodic::block_correction::BLOCK_LENGTH;
use crate::stationary::periodic::equations::{
    BASIS_FLOATS_PER_ELEMENT_ON_SMALL_GRID, MAX_BASIS_FLOATS_ON_SMALL_GRID,
};
use crate::transform::fast_length::fast_length;

/// Number of elements per shortest wave along an axis on the first grid. Chosen (case of `evidence tuning`);
/// docs/theory/rough-surfaces.md has how often bars hold with four.
pub(crate) const FIRST_ELEMENTS_PER_WAVE: usize = 4;
/// Largest number of elements of the last of three grids that begin with [`FIRST_ELEMENTS_PER_WAVE`]: 2048². Chosen to limit the
/// time.
///
/// Above it the first grid has one element per shortest wave, and contains only the waves that it resolves.
pub(super) const MAX_USUAL_GRID: f64 = (1_u64 << 22) as f64;
/// Upper bound of the memory per element without the GCR basis, \[bytes]. Measured: a test compares memory stated and taken
/// (tests/it/memory.rs).
const BYTES_PER_ELEMENT: f64 = 186.0;
/// Memory of the GCR basis per element on a small grid, 1 KiB, \[bytes].
const BASIS_BYTES_PER_ELEMENT: f64 =
    (size_of::<f32>() * BASIS_FLOATS_PER_ELEMENT_ON_SMALL_GRID) as f64;
/// Largest memory of the GCR basis on a small grid, 64 MiB, \[bytes].
const MAX_SMALL_BASIS_BYTES: f64 = (size_of::<f32>() * MAX_BASIS_FLOATS_ON_SMALL_GRID) as f64;
/// Ratio of the elements along an edge on the last of three grids to those on the first: two doublings.
pub(super) const FINEST_OVER_COARSEST: usize = 4;

/// The shape [n_x, n_y] of the first of three grids for a request.
///
/// For a number of elements, that of the last grid along its longer edge, the shape is proportional to the smallest first grid of the
/// surface. Fails with [`BemError::PeriodTooCoarse`] for fewer elements.
pub(super) fn first_shape(
    surface: &PeriodicSurface,
    request: &Request,
) -> Result<[usize; 2], BemError> {
    let usual = surface.largest_numbers().map(first_elements);
    let finest_edge = |first: [usize; 2]| FINEST_OVER_COARSEST * first[0].max(first[1]);
    let fits = match request.accuracy {
        Accuracy::RelativeError(_) => {
            finest_elements(usual) <= MAX_USUAL_GRID && request.watch.may_refine(finest_edge(usual))
        }
        Accuracy::Elements(elements) => elements >= finest_edge(usual),
    };
    let first = if fits {
        usual
    } else {
        coarsest_first_shape(surface)
    };
    let Accuracy::Elements(elements) = request.accuracy else {
        return Ok(first);
    };
    let needed = finest_edge(first);
    if elements < needed {
        return Err(BemError::PeriodTooCoarse { elements, needed });
    }
    // A product that overflows is too large for a grid anyway.
    Ok(first.map(|edge| edge.saturating_mul(elements).div_ceil(needed)))
}

/// Number of elements along an edge of the usual first grid, for the largest number of waves along it: a power of two.
fn first_elements(number: usize) -> usize {
    match number {
        0 => 2,
        _ => (FIRST_ELEMENTS_PER_WAVE * number)
            .next_power_of_two()
            .max(MIN_COARSEST_EDGE),
    }
}

/// The shape of the coarsest first grid, with one element per shortest wave: its refinement by two resolves all waves. If it
/// resolves no wave itself, the shape is that of this refinement. Its edges are multiples of the length of a block, which the
/// coarse-space correction needs and nested iteration can halve.
fn coarsest_first_shape(surface: &PeriodicSurface) -> [usize; 2] {
    let first = surface.largest_numbers().map(|number| match number {
        0 => 2,
        _ => {
            (BLOCK_LENGTH * fast_length((number + 1).div_ceil(BLOCK_LENGTH))).max(MIN_COARSEST_EDGE)
        }
    });
    match surface.resolved_on(first) {
        Some(_) => first,
        None => first.map(|edge| 2 * edge),
    }
}

/// Smallest number of elements of the finest grid for an error bar.
pub fn elements_for_bars(surface: &PeriodicSurface) -> f64 {
    finest_elements(coarsest_first_shape(surface))
}

/// Smallest number of elements along the longer edge of a period that a request may give: that of the finest grid for an error bar.
pub fn edge_for_bars(surface: &PeriodicSurface) -> usize {
    let [along, across] = coarsest_first_shape(surface);
    FINEST_OVER_COARSEST * along.max(across)
}

/// Smallest number of elements of the finest grid for a surface with waves of these largest numbers along x and y.
pub fn fewest_elements(largest_numbers: [usize; 2]) -> f64 {
    finest_elements(largest_numbers.map(|number| number.max(1)))
}

/// Number of elements of the last of three grids that begin with the shape `first`.
fn finest_elements(first: [usize; 2]) -> f64 {
    let edges = first.map(|edge| (FINEST_OVER_COARSEST * edge) as f64);
    edges[0] * edges[1]
}

/// Number of elements of the largest grid that fits into a memory \[bytes]; of the largest grid of all for `None`.
pub fn largest_grid(memory: Option<f64>) -> f64 {
    memory.map_or(MAX_ELEMENTS, |bytes| {
        // The basis grows with the grid between the memory of a direct solve and that of the largest basis of a small grid.
        let with_direct_solve = (bytes - MAX_MATRIX_BYTES as f64) / BYTES_PER_ELEMENT;
        let with_largest_basis = (bytes - MAX_SMALL_BASIS_BYTES) / BYTES_PER_ELEMENT;
        let with_growing_basis = bytes / (BYTES_PER_ELEMENT + BASIS_BYTES_PER_ELEMENT);
        with_growing_basis
            .max(with_largest_basis)
            .min(with_direct_solve)
            .floor()
            .clamp(0.0, MAX_ELEMENTS)
    })
}

/// Upper bound of the memory of a grid with a number of elements, \[bytes].
fn bytes_on(elements: f64) -> f64 {
    let basis = BASIS_BYTES_PER_ELEMENT * elements;
    basis.clamp(MAX_MATRIX_BYTES as f64, MAX_SMALL_BASIS_BYTES) + BYTES_PER_ELEMENT * elements
}

/// Upper bound of the memory of [`steady`](super::steady) and [`slide`](super::slide), \[bytes], for a number of elements along the edge of
/// the period that has more of them.
///
/// # Errors
/// [`BemError::PeriodTooCoarse`].
pub fn memory(surface: &PeriodicSurface, elements: usize) -> Result<f64, BemError> {
    let first = first_shape(surface, &Accuracy::Elements(elements).into())?;
    Ok(bytes_on(finest_elements(first)))
}

#[cfg(test)]
mod tests {
    use super::{bytes_on, largest_grid};

    /// The memory of the largest grid that fits is no more than is allowed, and that of the next one is.
    #[test]
    fn the_largest_grid_is_the_one_that_fits() {
        for bytes in [4e7, 5e7, 6e7, 7e7, 7.83e7, 1e8, 1e9] {
            let elements = largest_grid(Some(bytes));
            assert!(bytes_on(elements) <= bytes, "{bytes} bytes, {elements}");
            assert!(
                bytes_on(elements + 1.0) > bytes,
                "{bytes} bytes, {elements}"
            );
        }
    }
}
