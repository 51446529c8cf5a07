//! The generalised minimal residual method (Saad & Schultz 1986), preconditioned from the right.

use crate::reductions::{add, dot};

/// Directions tried before the method gives up; a preconditioned contact needs some tens.
const MAX_DIRECTIONS: usize = 150;

/// Finds the vector that `apply`, the operator after its preconditioner, maps to `residual` up to `tolerance` in the
/// Euclidean norm, or the best one of the last space searched; 0 when the residual is small enough as it is.
pub(super) fn minimal_residual(
    residual: &[f64],
    tolerance: f64,
    mut apply: impl FnMut(&[f64]) -> Vec<f64>,
) -> Vec<f64> {
    let mut problem = LeastSquares::new(norm(residual));
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut next = residual.to_vec();
    let mut length = problem.error();
    while problem.error() > tolerance && length > 0.0 && basis.len() < MAX_DIRECTIONS {
        next.iter_mut().for_each(|value| *value /= length);
        basis.push(next);
        next = apply(&basis[basis.len() - 1]);
        let mut column = orthogonalise(&mut next, &basis);
        length = norm(&next);
        column.push(length);
        problem.push(column);
    }
    let mut vector = vec![0.0; residual.len()];
    for (direction, coefficient) in basis.iter().zip(problem.solve()) {
        add(&mut vector, coefficient, direction);
    }
    vector
}

/// Removes the components along an orthonormal basis (modified Gram–Schmidt) and returns them.
fn orthogonalise(vector: &mut [f64], basis: &[Vec<f64>]) -> Vec<f64> {
    let remove = |direction: &Vec<f64>| {
        let component = dot(vector, direction);
        add(vector, -component, direction);
        component
    };
    basis.iter().map(remove).collect()
}

/// `min ‖H y − β e₁‖` of a growing Hessenberg matrix H, by Givens rotations.
struct LeastSquares {
    /// Columns of the rotated matrix, each up to the diagonal.
    triangle: Vec<Vec<f64>>,
    /// Cosine and sine.
    rotations: Vec<[f64; 2]>,
    right: Vec<f64>,
}

impl LeastSquares {
    fn new(beta: f64) -> Self {
        Self {
            triangle: Vec::new(),
            rotations: Vec::new(),
            right: vec![beta],
        }
    }

    fn error(&self) -> f64 {
        self.right[self.triangle.len()].abs()
    }

    /// Appends a column, one longer than the number of columns with it.
    fn push(&mut self, mut column: Vec<f64>) {
        for (row, rotation) in self.rotations.iter().enumerate() {
            rotate(*rotation, &mut column, row);
        }
        let diagonal = self.triangle.len();
        let hypotenuse = column[diagonal].hypot(column[diagonal + 1]);
        let rotation = if hypotenuse > 0.0 {
            [
                column[diagonal] / hypotenuse,
                column[diagonal + 1] / hypotenuse,
            ]
        } else {
            [1.0, 0.0]
        };
        rotate(rotation, &mut column, diagonal);
        self.right.push(0.0);
        rotate(rotation, &mut self.right, diagonal);
        column.truncate(diagonal + 1);
        self.triangle.push(column);
        self.rotations.push(rotation);
    }

    fn solve(&self) -> Vec<f64> {
        let mut solution = self.right[..self.triangle.len()].to_vec();
        for (index, column) in self.triangle.iter().enumerate().rev() {
            // A direction that the operator annihilates contributes nothing.
            let value = if column[index] == 0.0 {
                0.0
            } else {
                solution[index] / column[index]
            };
            solution[index] = value;
            add(&mut solution[..index], -value, &column[..index]);
        }
        solution
    }
}

/// Rotates the entries `row` and `row + 1`.
fn rotate([cosine, sine]: [f64; 2], column: &mut [f64], row: usize) {
    let [upper, lower] = [column[row], column[row + 1]];
    column[row] = cosine * upper + sine * lower;
    column[row + 1] = cosine * lower - sine * upper;
}

fn norm(vector: &[f64]) -> f64 {
    dot(vector, vector).sqrt()
}
