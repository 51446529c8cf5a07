//! Symmetry reduction of contacts that are their own mirror images.
//!
//! If the separation is symmetric about a plane, so are load and displacement, which the symmetry-reduced domain on one
//! side of the plane determines. An element through whose centre the plane passes has half of its load in this domain.
//!
//! Theory: docs/theory/contact.md, "Mirrors".

use crate::BemError;
use crate::contact::hardness::solve_with_largest_load;
use crate::contact::mirror_weights::MirrorWeights;
use crate::contact::problem::LoadProblem;
use crate::contact::state::ContactBox;
use crate::contact::{LoadSolution, LoadState, StoppingCriterion, map_force};
use crate::elements::mirror::{Mirror, NO_MIRRORS, n_images};
use crate::parallel::chunks::in_pool;
use crate::parallel::row_blocks::RowBlocks;
use crate::transform::convolution::{Convolution, Surroundings};

/// Solves the contact on the symmetry-reduced domain, if separation and first guess have mirror symmetries; else on the whole
/// grid. `largest_load` is the limit of the load x of an element, without unit; infinite without a hardness.
pub(super) fn solve_symmetry_reduced(
    problem: LoadProblem,
    largest_load: f64,
    state: &mut LoadState,
    criterion: &StoppingCriterion,
) -> Result<LoadSolution, BemError> {
    let convolution = problem.convolution;
    let mirrors = find_mirrors(convolution, [problem.separation, &state.load]);
    if mirrors == NO_MIRRORS {
        return solve_with_largest_load(largest_load, problem, state, criterion);
    }
    // Restrict separation, first guess and force to the symmetry-reduced domain.
    let mut front = match state.front.take() {
        Some(front) if front.convolution.mirrors == mirrors => front,
        _ => Box::new(ContactBox::symmetry_reduced(mirrors, convolution)),
    };
    let whole = convolution.grid().shape();
    front.extract_from(problem.separation, &state.load, whole[1]);
    MirrorWeights::new(&front.convolution).apply(&mut front.state.load);
    let images = n_images(mirrors);
    let control = map_force(problem.control, |total| total / images);
    let ContactBox {
        convolution,
        separation,
        state: part,
        bounds,
    } = &mut *front;
    let problem = LoadProblem {
        convolution,
        separation,
        control,
    };
    // Solve the contact on this domain, and extend the solution to the whole grid by symmetry.
    let solved = in_pool(bounds.n_elements(), || {
        solve_with_largest_load(largest_load, problem, part, criterion)
    });
    front.unfold([&mut state.load, &mut state.displacement], whole);
    state.front = Some(front);
    solved.map(|solved| LoadSolution {
        total_load: images * solved.total_load,
        ..solved
    })
}

/// Mirrors along x and y in the middle of the grid about which both row-major fields are symmetric to the last bit.
///
/// Fields that differ from their mirror images in one bit have no mirror.
fn find_mirrors(convolution: &Convolution, fields: [&[f64]; 2]) -> [Mirror; 2] {
    let shape = convolution.grid().shape();
    let [rows, columns] = shape;
    let lines = |row: usize| fields.map(|field| &field[row * columns..][..columns]);
    // Find the symmetries: about a mirror along x each row equals its image, about one along y each row equals its reverse.
    let row_blocks = RowBlocks::new(shape);
    let in_row_block = |row_block| {
        let mut rows_of_block = row_blocks.rows(row_block);
        let mut rows_behind = rows_of_block.start..rows_of_block.end.min(rows / 2);
        let along_x = rows_behind.all(|row| lines(row) == lines(rows - 1 - row));
        let along_y = rows_of_block.all(|row| lines(row).into_iter().all(is_palindrome));
        [along_x, along_y]
    };
    let both = |left: [bool; 2], right: [bool; 2]| [0, 1].map(|axis| left[axis] && right[axis]);
    let equal = row_blocks.gather(in_row_block, both);
    [0, 1].map(|axis| match convolution.surroundings {
        _ if !equal[axis] || shape[axis] == 1 => Mirror::None,
        Surroundings::Free if shape[axis].is_multiple_of(2) => Mirror::Edge,
        Surroundings::Free => Mirror::Centre,
        // The coarser grid of the preconditioner needs an even number of rows in the symmetry-reduced domain.
        Surroundings::Periodic if shape[axis].is_multiple_of(4) => Mirror::Edge,
        Surroundings::Periodic => Mirror::None,
    })
}

/// True if a line of values equals its reverse to the last bit.
fn is_palindrome(line: &[f64]) -> bool {
    let half = line.len() / 2;
    line[..half].iter().eq(line.iter().rev().take(half))
}

impl ContactBox {
    /// Writes the fields [load, displacement] of the whole grid, of the shape `whole`, from those of this symmetry-reduced domain.
    fn unfold(&self, fields: [&mut [f64]; 2], whole: [usize; 2]) {
        let (mirrors, columns) = (self.convolution.mirrors, self.bounds.shape()[1]);
        let weights = MirrorWeights::new(&self.convolution);
        let row_blocks = RowBlocks::new(whole);
        row_blocks.for_each(fields, |row_block, [loads, displacements]| {
            let rows = loads
                .chunks_exact_mut(whole[1])
                .zip(displacements.chunks_exact_mut(whole[1]));
            for (row, (loads, displacements)) in row_blocks.rows(row_block).zip(rows) {
                // Copy the symmetry-reduced domain, without the weights of elements on the mirror.
                let row = folded_row(row, whole[0], mirrors[0]);
                let part = row * columns..(row + 1) * columns;
                let front = whole[1] - columns;
                displacements[front..].copy_from_slice(&self.state.displacement[part.clone()]);
                loads[front..].copy_from_slice(&self.state.load[part.clone()]);
                for (column, weight) in weights.row_weights(part) {
                    loads[front + column] /= weight;
                }
                // Fill the other half with the image of this one.
                mirror_behind(displacements, columns);
                mirror_behind(loads, columns);
            }
        });
    }
}

/// Row of the symmetry-reduced domain that corresponds to a row of the whole grid, which has `rows` rows: the row itself, or
/// its image.
const fn folded_row(row: usize, rows: usize, mirror: Mirror) -> usize {
    let half = rows / 2;
    match mirror {
        Mirror::None => row,
        Mirror::Centre => row.abs_diff(half),
        Mirror::Edge if row < half => half - 1 - row,
        Mirror::Edge => row - half,
    }
}

/// Fills the rest of a row from its last `n_folded` values, those of the symmetry-reduced domain, by reflection.
fn mirror_behind(line: &mut [f64], n_folded: usize) {
    let (behind, front) = line.split_at_mut(line.len() - n_folded);
    // An element through whose centre the mirror passes has no image.
    let on_mirror = front.len() - behind.len();
    for (value, image) in behind.iter_mut().rev().zip(&front[on_mirror..]) {
        *value = *image;
    }
}
