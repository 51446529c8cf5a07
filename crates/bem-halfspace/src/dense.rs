//! Dense systems of linear equations, by LU factorisation with partial pivoting.
//!
//! With the feature `dense` faer factorises, else nalgebra. Both work on one thread, so that results do not depend on their number.

/// Largest number of unknowns of a direct solve. Chosen: with 4000 no periodic contact of docs/dependencies.md, "Factorisation or
/// iteration", is solved faster.
pub(crate) const MAX_UNKNOWNS: usize = 2048;
/// Memory of the matrix of the largest direct solve, 32 MiB for [`MAX_UNKNOWNS`], \[bytes].
#[cfg(feature = "rough")]
pub(crate) const MAX_MATRIX_BYTES: usize = size_of::<f64>() * MAX_UNKNOWNS * MAX_UNKNOWNS;

/// Solves A x = b for each right side b, all of the same length n; returns the solutions in their order.
///
/// `entry(row, column)` gives the elements of the n × n matrix A. `None` if A is singular or not finite.
#[cfg(feature = "dense")]
pub(crate) fn solve(
    entry: impl FnMut(usize, usize) -> f64,
    mut right_sides: Vec<Vec<f64>>,
) -> Option<Vec<Vec<f64>>> {
    use faer::dyn_stack::{MemBuffer, MemStack};
    use faer::linalg::lu::partial_pivoting::{factor, solve};
    use faer::{Mat, MatMut, Par};

    let n = right_sides.first().map_or(0, Vec::len);
    // Allocate the memory of the factorisation, and of the solution for one right side at a time.
    let [mut forward, mut backward] = [(); 2].map(|()| vec![0_usize; n]);
    let for_factors = factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Default::default());
    let for_solution = solve::solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq);
    let mut memory = MemBuffer::new(for_factors.or(for_solution));
    let stack = MemStack::new(&mut memory);

    // The factorisation overwrites the matrix by L, without its unit diagonal, and by U.
    let mut matrix = Mat::from_fn(n, n, entry);
    let (_, permutation) = factor::lu_in_place(
        matrix.as_mut(),
        &mut forward,
        &mut backward,
        Par::Seq,
        stack,
        Default::default(),
    );
    // A pivot that is zero or not finite means that the matrix is singular.
    let is_regular = |pivot: usize| {
        let pivot = matrix[(pivot, pivot)];
        pivot.is_finite() && pivot != 0.0
    };
    if !(0..n).all(is_regular) {
        return None;
    }
    for right_side in &mut right_sides {
        solve::solve_in_place(
            matrix.as_ref(),
            matrix.as_ref(),
            permutation,
            MatMut::from_column_major_slice_mut(right_side, n, 1),
            Par::Seq,
            stack,
        );
    }
    Some(right_sides)
}

/// Solves A x = b for each right side b, all of the same length n; returns the solutions in their order.
///
/// `entry(row, column)` gives the elements of the n × n matrix A. `None` if A is singular or not finite.
#[cfg(not(feature = "dense"))]
pub(crate) fn solve(
    entry: impl FnMut(usize, usize) -> f64,
    mut right_sides: Vec<Vec<f64>>,
) -> Option<Vec<Vec<f64>>> {
    use nalgebra::{DMatrix, DVectorViewMut};

    let n = right_sides.first().map_or(0, Vec::len);
    let factors = DMatrix::from_fn(n, n, entry).lu();
    let pivots_are_finite = factors
        .lu_internal()
        .diagonal()
        .iter()
        .all(|pivot| pivot.is_finite());
    let is_regular = pivots_are_finite
        && right_sides
            .iter_mut()
            .all(|right_side| factors.solve_mut(&mut DVectorViewMut::from_slice(right_side, n)));
    is_regular.then_some(right_sides)
}

#[cfg(test)]
mod tests {
    use super::solve;

    #[test]
    fn singular_equations_have_no_solution() {
        let of_rank = |rank: usize| {
            let entry = |row: usize, column: usize| f64::from(row == column && row < rank);
            solve(entry, vec![vec![1.0, 2.0, 3.0]])
        };
        assert_eq!(of_rank(3), Some(vec![vec![1.0, 2.0, 3.0]]));
        assert_eq!(of_rank(2), None, "of rank 2");
        let undefined = solve(|_, _| f64::NAN, vec![vec![1.0, 2.0, 3.0]]);
        assert_eq!(undefined, None, "not a number");
    }

    /// A circulant matrix whose largest elements are off the diagonal, larger than the blocks of a factorisation.
    #[test]
    fn the_product_with_the_solution_is_the_right_side() {
        const N: usize = 150;
        let entry = |row: usize, column: usize| 1.0 / ((row + N + 3 - column) % N + 1) as f64;
        let expected: Vec<Vec<f64>> = [0.3, 0.4]
            .map(|phase| (0..N).map(|row| (row as f64 + phase).cos()).collect())
            .into();
        let solved = solve(entry, expected.clone()).expect("a regular matrix");
        for (solution, right_side) in solved.iter().zip(expected) {
            for (row, right) in right_side.into_iter().enumerate() {
                let terms = solution.iter().enumerate();
                let product: f64 = terms.map(|(column, x)| entry(row, column) * x).sum();
                assert!((product - right).abs() < 1e-9, "{row}: {product} {right}");
            }
        }
    }
}
