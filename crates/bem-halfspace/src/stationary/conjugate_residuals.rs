//! Generalised conjugate residuals, GCR (Eisenstat, Elman & Schultz 1983). The method minimises the residual of operators that need not
//! be symmetric; solution and residual are known after every step. The *image* of a direction p is A p.
//!
//! Theory: docs/theory/stationary-half-space.md, "The equations of one contact" and "Periodic surfaces".

use std::collections::VecDeque;

use numerics::transforms::Real;

use crate::parallel::reductions::{add_scaled, sum};
use crate::parallel::row_blocks::{RowBlocks, copies};

/// Relative rounding error of single precision, in which the operators of periodic contacts are applied. If the norm of an image A p
/// falls to this fraction by its orthogonalisation, only rounding error is left and the iteration ends (breakdown). If a step
/// reduces the squared norm ‖r‖² of the residual r by less than this fraction, it stagnates: the next direction is then built from
/// the last image A p instead of r (Young & Jea 1980).
const EPSILON: f64 = f32::EPSILON as f64;

/// Size of the Krylov basis and length of the iteration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GcrLimits {
    /// Largest number of steps.
    pub(crate) max_steps: usize,
    /// Number of directions against whose images A p a new one is orthogonalised; older directions are dropped.
    pub(crate) truncation_depth: usize,
}

/// The state from which the next direction is built.
pub(crate) struct GcrState<'a, T> {
    /// Sum of squares of the residual, ‖r‖².
    pub(crate) residual_square: f64,
    /// Residual r.
    pub(crate) residual: &'a [T],
    /// Vector to which the preconditioner is applied: the residual, or after stagnation the last A p, scaled to the norm of the
    /// residual.
    pub(crate) source: &'a [T],
}

/// Minimises the norm of `residual` = A `solution` − b over a Krylov space, and updates both.
///
/// `find_direction(state, direction, image)` writes a direction p and its image A p, or returns `false` to end the iteration. The
/// iteration also ends on breakdown, when A p depends linearly on the basis.
///
/// The residual is updated, not recomputed: relative to the first residual, it drifts from that of the solution by rounding.
pub(crate) fn gcr<T: Real>(
    solution: &mut [T],
    residual: &mut [T],
    limits: GcrLimits,
    mut find_direction: impl FnMut(GcrState<'_, T>, &mut [T], &mut [T]) -> bool,
) {
    let [solution_blocks, residual_blocks] = [blocks_of(solution), blocks_of(residual)];
    let mut basis: VecDeque<BasisVector<T>> = VecDeque::new();
    let mut recycled: Option<BasisVector<T>> = None;
    let mut stagnant_image: Option<Vec<T>> = None;
    let mut residual_square = inner_product(residual, residual);
    for _ in 0..limits.max_steps {
        // Ask the caller for the next direction and its image. They replace the vector that the basis dropped last, if there is one.
        let mut new = recycled
            .take()
            .unwrap_or_else(|| BasisVector::new(solution.len(), residual.len()));
        let state = GcrState {
            residual_square,
            residual,
            source: stagnant_image.as_deref().unwrap_or(residual),
        };
        if !find_direction(state, &mut new.direction, &mut new.image) {
            return;
        }

        // Orthogonalise the image against those of the basis. If nothing but rounding error is left, the iteration ends.
        let (factors, products) = orthogonalise(&mut new.image, residual, &basis);
        new.image_square = products.square;
        let square_before = products.square + products.removed_square;
        if products.square <= EPSILON * EPSILON * square_before || products.square.is_nan() {
            return;
        }

        // Find the step along the direction that minimises the residual. If it hardly reduces the residual, keep the image as the
        // source of the next direction.
        let step = -products.with_residual / products.square;
        let stagnates = step * step * products.square < EPSILON * residual_square;
        stagnant_image = stagnates.then(|| {
            // The image is scaled to the norm of the residual, because a preconditioner that amplifies it in every step would overflow.
            let scale = T::rounded((residual_square / products.square).sqrt());
            new.image.iter().map(|value| scale * *value).collect()
        });

        // Give the direction the same combination of the basis as its image, and move the solution.
        solution_blocks.for_each(
            [&mut *solution, &mut new.direction],
            |row_block, [solution, direction]| {
                let elements = solution_blocks.elements(row_block);
                for (factor, vector) in factors.iter().zip(&basis) {
                    add_scaled(direction, *factor, &vector.direction[elements.clone()]);
                }
                add_scaled(solution, T::rounded(step), direction);
            },
        );

        // Add the step times the image to the residual, and sum the squares of the result in the same pass.
        residual_square = residual_blocks.fold(
            [(&mut *residual, residual_blocks.starts_of_coarse_blocks(1))],
            |row_block, [part]| {
                let elements = residual_blocks.elements(row_block);
                add_scaled(part, T::rounded(step), &new.image[elements.clone()]);
                product_of_parts(part, part)
            },
            |left, right| left + right,
        );

        // Add the new vector to the basis. Beyond the truncation depth the oldest vector is dropped, and its memory is used again.
        basis.push_back(new);
        if basis.len() > limits.truncation_depth {
            recycled = basis.pop_front();
        }
    }
}

/// A direction p and its image A p, orthogonal to the other images of the basis.
struct BasisVector<T> {
    /// Direction p.
    direction: Vec<T>,
    /// Image A p.
    image: Vec<T>,
    /// Sum of squares of the image, ‖A p‖².
    image_square: f64,
}

impl<T: Real> BasisVector<T> {
    /// Direction and image of zeros, for numbers of unknowns and of equations.
    fn new(n_unknowns: usize, n_equations: usize) -> Self {
        Self {
            direction: copies(T::default(), n_unknowns),
            image: copies(T::default(), n_equations),
            image_square: 0.0,
        }
    }
}

/// Inner products of an orthogonalised image A p.
struct ImageProducts {
    /// Sum of squares ‖A p‖².
    square: f64,
    /// Inner product (A p, r) with the residual r.
    with_residual: f64,
    /// Sum of squares of the components that were removed.
    removed_square: f64,
}

/// Orthogonalises an image A p against those of the basis by modified Gram–Schmidt, in place.
///
/// Returns the factors with which the images of the basis were added, and inner products of the result with itself and the residual.
fn orthogonalise<T: Real>(
    image: &mut [T],
    residual: &[T],
    basis: &VecDeque<BasisVector<T>>,
) -> (Vec<T>, ImageProducts) {
    let mut factors = Vec::with_capacity(basis.len());
    let mut removed_square = 0.0;
    let row_blocks = blocks_of(image);
    // Each vector of the basis takes one pass over memory, which removes the component along the vector before and projects onto
    // this one.
    for (index, vector) in basis.iter().enumerate() {
        let before = index
            .checked_sub(1)
            .map(|index| (factors[index], &basis[index].image[..]));
        let projection = row_blocks.fold(
            [(&mut *image, row_blocks.starts_of_coarse_blocks(1))],
            |row_block, [part]| {
                let elements = row_blocks.elements(row_block);
                if let Some((factor, image)) = before {
                    add_scaled(part, factor, &image[elements.clone()]);
                }
                product_of_parts(part, &vector.image[elements])
            },
            |left, right| left + right,
        );
        let component = projection / vector.image_square;
        removed_square += component * projection;
        factors.push(T::rounded(-component));
    }
    // Remove the component along the last vector, and compute the inner products of the result with itself and with the residual.
    let last = factors.last().zip(basis.back());
    let [square, with_residual] = row_blocks.fold(
        [(image, row_blocks.starts_of_coarse_blocks(1))],
        |row_block, [part]| {
            let elements = row_blocks.elements(row_block);
            if let Some((factor, vector)) = last {
                add_scaled(part, *factor, &vector.image[elements.clone()]);
            }
            [&*part, &residual[elements]].map(|other| product_of_parts(part, other))
        },
        |left, right| [left[0] + right[0], left[1] + right[1]],
    );
    let products = ImageProducts {
        square,
        with_residual,
        removed_square,
    };
    (factors, products)
}

/// Euclidean norm of a vector.
pub(crate) fn norm<T: Real>(vector: &[T]) -> f64 {
    inner_product(vector, vector).sqrt()
}

/// Inner product of two vectors of equal length, in parallel with a fixed order of summation.
fn inner_product<T: Real>(left: &[T], right: &[T]) -> f64 {
    let row_blocks = blocks_of(left);
    row_blocks.sum(|row_block| {
        let elements = row_blocks.elements(row_block);
        product_of_parts(&left[elements.clone()], &right[elements])
    })
}

/// The contribution of one row block to an inner product.
fn product_of_parts<T: Real>(left: &[T], right: &[T]) -> f64 {
    sum([left, right], |[left, right]| left * right).into()
}

/// Division of a vector among threads, as the row blocks of a grid with one column.
const fn blocks_of<T>(vector: &[T]) -> RowBlocks {
    RowBlocks::new([vector.len(), 1])
}

#[cfg(test)]
mod tests {
    use super::{GcrLimits, gcr};

    const TWO_STEPS: GcrLimits = GcrLimits {
        max_steps: 2,
        truncation_depth: 2,
    };

    /// For a rotation by a quarter turn, A r is orthogonal to r, so that the residual alone leads nowhere.
    #[test]
    fn a_stagnating_step_is_not_the_last() {
        let [mut solution, mut residual] = [[0.0; 2], [3.0, -4.0]];
        gcr::<f64>(
            &mut solution,
            &mut residual,
            TWO_STEPS,
            |state, direction, image| {
                direction.copy_from_slice(state.source);
                image.copy_from_slice(&[-state.source[1], state.source[0]]);
                true
            },
        );
        assert!(
            (solution[0] - 4.0).hypot(solution[1] - 3.0) < 1e-14,
            "{solution:?}"
        );
        assert!(residual[0].hypot(residual[1]) < 1e-14, "{residual:?}");
    }

    /// A stagnating step leads to a direction that this preconditioner makes 1e15 times as long.
    #[test]
    fn directions_that_grow_do_not_overflow() {
        let [mut solution, mut residual] = [[0.0_f32; 2], [3.0, -4.0]];
        gcr(
            &mut solution,
            &mut residual,
            TWO_STEPS,
            |state, direction, image| {
                let [x, y] = [1e15 * state.source[0], 1e15 * state.source[1]];
                direction.copy_from_slice(&[x, y]);
                image.copy_from_slice(&[-y, x]);
                true
            },
        );
        assert!(residual[0].hypot(residual[1]) < 1e-5, "{residual:?}");
    }
}
