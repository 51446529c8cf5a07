//! An approximate inverse of the influence.
//!
//! The influence of a half space multiplies waves by `2π/|q|`. The inverse has two parts, both positive: between
//! neighbouring elements a difference that is right for the shortest waves,
//!
//! ```text
//! s(q) = w [ (2 − 2 cos q_x Δx)/Δx + (2 − 2 cos q_y Δy)/Δy ],
//! ```
//!
//! and on blocks of two by two elements, where a convolution costs a quarter and needs no padding, what is missing to
//! `|q|` for the long waves. Restricted to the contact it remains positive definite, as conjugate gradients need it.
//! Of its answer, [`far_loads`](super::far_loads) takes away what belongs to the load of other patches.

use crate::contact::blocks::sum_blocks;
use crate::contact::contact_set::ContactSet;
use crate::contact::far_loads::FarLoads;
use crate::{Convolution, ConvolutionWorkspace};

/// The weight w; π/4 would be right for the shortest wave along an edge, but what counts is the whole spectrum.
const WEIGHT: f64 = 0.7;

#[derive(Debug, Clone)]
pub(super) struct Preconditioner {
    /// Differences along x and along y, \[1/m].
    weights: [f64; 2],
    shape: [usize; 2],
    /// Whether the grid has a mirror at its rear along x and y.
    mirrors: [bool; 2],
    blocks: Convolution,
    workspace: ConvolutionWorkspace,
    /// Means of the residual over the blocks, and what the convolution makes of them.
    means: Vec<f64>,
    images: Vec<f64>,
    far_loads: FarLoads,
}

impl Preconditioner {
    pub(super) fn new(convolution: &Convolution) -> Self {
        let grid = convolution.grid();
        let weights = grid.spacing().map(|edge| WEIGHT / edge);
        let blocks = convolution.on_blocks(|q| {
            let difference =
                |axis: usize| weights[axis] * (2.0 - 2.0 * (q[axis] * grid.spacing()[axis]).cos());
            q[0].hypot(q[1]) - difference(0) - difference(1)
        });
        let n_blocks = blocks.grid().n_elements();
        Self {
            weights,
            shape: grid.shape(),
            mirrors: convolution.mirrors(),
            workspace: blocks.workspace(),
            blocks,
            means: vec![0.0; n_blocks],
            images: vec![0.0; n_blocks],
            far_loads: FarLoads::new(grid),
        }
    }

    /// Prepares for another contact; overwrites the fields, of which the first must vanish outside the contact.
    pub(super) fn prepare(&mut self, contact: &ContactSet, [one, answer]: [&mut [f64]; 2]) {
        let bands = contact.bands();
        bands.for_each([&mut *one], |band, [one]| {
            let first = bands.elements(band).start;
            for run in contact.runs(band) {
                one[run.start - first..run.end - first].fill(1.0);
            }
        });
        self.invert(contact, one, answer);
        self.far_loads.weigh(contact, answer);
    }

    /// Applies the inverse to a residual that vanishes outside the contact; the result is set in the contact only.
    pub(super) fn apply(&mut self, contact: &ContactSet, residual: &[f64], result: &mut [f64]) {
        self.invert(contact, residual, result);
        self.far_loads.take_from(contact, residual, result);
    }

    fn invert(&mut self, contact: &ContactSet, residual: &[f64], result: &mut [f64]) {
        let mean = |element: usize| 0.25 * residual[element];
        sum_blocks(contact, self.shape[1], mean, &mut self.means);
        let [block_rows, block_columns] = self.blocks.grid().shape();
        self.blocks.apply(
            &mut self.workspace,
            (&self.means, 0..block_rows),
            (&mut self.images, 0..block_rows),
        );
        let bands = contact.bands();
        let this = &*self;
        bands.for_each([result], |band, [result]| {
            let first = bands.elements(band).start;
            for run in contact.runs(band) {
                let (row, column) = (run.start / this.shape[1], run.start % this.shape[1]);
                let images = &this.images[row / 2 * block_columns..];
                for (column, element) in (column..).zip(run.clone()) {
                    let differences = this.differences(residual, element, [row, column]);
                    result[element - first] = images[column / 2] + differences;
                }
            }
        });
    }

    fn differences(&self, residual: &[f64], element: usize, [row, column]: [usize; 2]) -> f64 {
        let [rows, columns] = self.shape;
        let here = residual[element];
        // Behind a mirror stands the element itself.
        let before = |axis: usize, position: usize, step: usize| match position {
            0 if self.mirrors[axis] => here,
            0 => 0.0,
            _ => residual[element - step],
        };
        let behind = |exists: bool, step: usize| {
            if exists {
                residual[element + step]
            } else {
                0.0
            }
        };
        let [above, below] = [before(0, row, columns), behind(row + 1 < rows, columns)];
        let [left, right] = [before(1, column, 1), behind(column + 1 < columns, 1)];
        let twice = 2.0 * here;
        self.weights[0] * (twice - above - below) + self.weights[1] * (twice - left - right)
    }
}

#[cfg(test)]
mod tests {
    use faer::{Mat, Side};

    use super::*;
    use crate::{BemError, Grid};

    /// Contacts with many diagonal neighbours, ends and gaps: every other element, corners that touch, stripes, crosses,
    /// blocks at a distance, and one by chance.
    fn patterns([rows, columns]: [usize; 2]) -> Vec<Vec<bool>> {
        let at = |is: fn(usize, usize) -> bool| -> Vec<bool> {
            (0..rows * columns)
                .map(|index| is(index / columns, index % columns))
                .collect()
        };
        vec![
            at(|row, column| (row + column) % 2 == 0),
            at(|row, column| (row / 2 + column / 2) % 2 == 0),
            at(|row, column| (row + 2 * column) % 5 < 2),
            at(|row, column| row % 6 == 2 || column % 6 == 3),
            at(|row, column| row % 9 < 3 && column % 9 < 3),
            at(|row, column| (row * row * 7 + column * 13 + row * column * 5) % 11 < 4),
        ]
    }

    /// The matrix of the preconditioner on a contact.
    fn matrix(preconditioner: &mut Preconditioner, contact: &ContactSet, n: usize) -> Mat<f64> {
        let (mut one, mut answer) = (vec![0.0; n], vec![0.0; n]);
        preconditioner.prepare(contact, [&mut one, &mut answer]);
        let inside: Vec<usize> = (0..n)
            .filter(|&element| contact.contains(element))
            .collect();
        let mut matrix = Mat::zeros(inside.len(), inside.len());
        for (column, &element) in inside.iter().enumerate() {
            one.fill(0.0);
            one[element] = 1.0;
            preconditioner.apply(contact, &one, &mut answer);
            for (row, &element) in inside.iter().enumerate() {
                matrix[(row, column)] = answer[element];
            }
        }
        matrix
    }

    #[test]
    fn on_any_contact_it_is_symmetric_and_positive() -> Result<(), BemError> {
        let grid = Grid::new([26, 24], [1.0, 0.7])?;
        for whole in [Convolution::new(&grid), Convolution::periodic(&grid)] {
            for mirrors in [[false, false], [false, true], [true, true]] {
                let convolution = whole.folded(mirrors);
                let shape = convolution.grid().shape();
                for (number, pattern) in patterns(shape).into_iter().enumerate() {
                    let mut contact = ContactSet::new(shape);
                    contact.assign(|element| pattern[element]);
                    let mut preconditioner = Preconditioner::new(&convolution);
                    let matrix = matrix(&mut preconditioner, &contact, pattern.len());
                    let largest = matrix.norm_max();
                    let asymmetry = (&matrix - matrix.transpose()).norm_max() / largest;
                    assert!(asymmetry < 1e-13, "pattern {number}: {asymmetry:e}");
                    let eigenvalues = matrix.self_adjoint_eigenvalues(Side::Lower);
                    let smallest = eigenvalues.map(|values| values[0] / largest);
                    assert!(
                        smallest.is_ok_and(|smallest| smallest > 1e-3),
                        "pattern {number}, mirrors {mirrors:?}: eigenvalue {smallest:?} of the largest entry"
                    );
                }
            }
        }
        Ok(())
    }
}
