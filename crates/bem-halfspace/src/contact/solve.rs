//! Nested iteration for the first guess, and a box around the contact in place of a large free grid.
//!
//! Theory: docs/theory/contact.md, "First guess and box".

use crate::contact::iteration::Iteration;
use crate::contact::mirror_weights::MirrorWeights;
use crate::contact::problem::{LoadProblem, LoadSolution, StoppingCriterion};
use crate::contact::state::{ContactBox, LoadState};
use crate::contact::{Control, map_force};
use crate::elements::bounds::Bounds;
use crate::elements::grid::MIN_COARSEST_EDGE;
use crate::parallel::chunks::in_pool;
use crate::parallel::row_blocks::for_each_row;
use crate::transform::convolution::Surroundings;
use crate::{BemError, Rows};

/// Largest box, as a fraction of the elements of the grid, on which the contact is solved in place of the grid. Chosen (case of
/// `evidence tuning`).
///
/// A larger box takes as long as the grid, because of the operator application on the whole grid at its end. Only time and memory
/// depend on it.
const MAX_BOX_FRACTION: f64 = 0.6;

/// Solves the contact from the load in the state, or by nested iteration if that load is zero everywhere; leaves load and displacement
/// in the state.
pub(super) fn solve_loads(
    problem: LoadProblem,
    state: &mut LoadState,
    criterion: &StoppingCriterion,
) -> Result<LoadSolution, BemError> {
    let shape = problem.convolution.grid().shape();
    let loaded = |load: &[f64]| {
        Bounds::enclosing_where(shape, |[row, column]| load[row * shape[1] + column] > 0.0)
    };
    // Without a first guess, prolong one from coarser grids.
    let mut bounds = loaded(&state.load);
    if bounds.is_none() {
        prolong_coarse_solution(problem, state);
        bounds = loaded(&state.load);
    }
    solve_around(bounds, problem, state, criterion)
}

/// Iterates on a box around `bounds`, those of the loaded elements, if that saves time, else on the whole grid.
fn solve_around(
    bounds: Option<Bounds>,
    problem: LoadProblem,
    state: &mut LoadState,
    criterion: &StoppingCriterion,
) -> Result<LoadSolution, BemError> {
    let convolution = problem.convolution;
    let grid = convolution.grid();
    // Iterate on the whole grid, unless a box with a margin is much smaller.
    let saves_time = |bounds: &Bounds| {
        let part = bounds.n_elements() as f64 / grid.n_elements() as f64;
        convolution.surroundings == Surroundings::Free && part < MAX_BOX_FRACTION
    };
    let with_margin = bounds.map(|bounds| bounds.with_margin(grid.shape(), convolution.mirrors));
    let Some((bounds, outer)) = bounds.zip(with_margin.filter(saves_time)) else {
        return Iteration::new(problem, state).run(criterion);
    };
    // Solve on the box, and check the rest of the grid with its solution.
    let mut inner = match state.inner.take() {
        Some(inner) if can_be_reused(&inner, &bounds, &outer) => inner,
        _ => Box::new(ContactBox::cut_from(convolution, outer)?),
    };
    let columns = grid.shape()[1];
    inner.extract_from(problem.separation, &state.load, columns);
    let solved = inner.solve(problem.control, criterion);
    inner.copy_load_to(&mut state.load, columns);
    let bounds = inner.bounds;
    state.inner = Some(inner);
    grow_if_penetrating(&bounds, problem, state, solved?, criterion)
}

/// True if the previous box `inner` encloses `bounds` and has at most twice the elements of the new box `outer`: then its plans and
/// buffers are used again.
fn can_be_reused(inner: &ContactBox, bounds: &Bounds, outer: &Bounds) -> bool {
    inner.bounds.union(bounds) == inner.bounds
        && inner.bounds.n_elements() <= 2 * outer.n_elements()
}

/// Computes the displacement of the whole grid under the solution `solved` of the box `bounds`. If an element outside the box
/// penetrates, solves again on a larger box that encloses it.
fn grow_if_penetrating(
    bounds: &Bounds,
    problem: LoadProblem,
    state: &mut LoadState,
    solved: LoadSolution,
    criterion: &StoppingCriterion,
) -> Result<LoadSolution, BemError> {
    let convolution = problem.convolution;
    let [rows, columns] = convolution.grid().shape();
    let workspace = &mut state.workspace;
    // Displace the whole grid by the loads of the box.
    convolution.apply_in(
        &Rows {
            loaded: bounds.rows(),
            wanted: 0..rows,
        },
        workspace.get_or_insert_with(|| convolution.workspace()),
        &state.load,
        &mut state.displacement,
    );
    // Outside the box, a deformed height below the depth violates the contact condition g ≥ 0.
    let highest = solved.indentation_depth - criterion.tolerance * solved.deflection;
    let displacement = &state.displacement;
    let penetrates = |element: [usize; 2]| {
        let index = element[0] * columns + element[1];
        problem.separation[index] + displacement[index] < highest && !bounds.contains(element)
    };
    let Some(outside) = Bounds::enclosing_where([rows, columns], penetrates) else {
        return Ok(solved);
    };
    let larger = solve_around(Some(bounds.union(&outside)), problem, state, criterion)?;
    let iterations = solved.iterations + larger.iterations;
    Ok(LoadSolution {
        iterations,
        ..larger
    })
}

impl ContactBox {
    /// Solves the contact of the box for its `separation`, starting from the loads in its state. A force is given as the sum of the
    /// loads, a depth in the unit of the separation.
    pub(crate) fn solve(
        &mut self,
        control: Control,
        criterion: &StoppingCriterion,
    ) -> Result<LoadSolution, BemError> {
        let problem = LoadProblem {
            convolution: &self.convolution,
            separation: &self.separation,
            control,
        };
        in_pool(self.bounds.n_elements(), || {
            solve_loads(problem, &mut self.state, criterion)
        })
    }
}

/// Nested iteration: solves on elements of twice the edges, and prolongs the solution to the load of the state as first guess. The load
/// stays zero if the grid cannot be coarsened.
fn prolong_coarse_solution(problem: LoadProblem, state: &mut LoadState) {
    let convolution = problem.convolution;
    let grid = convolution.grid();
    let [rows, columns] = grid.shape();
    let unfolded = grid.unfolded(convolution.mirrors).shape();
    let is_even = rows.is_multiple_of(2) && columns.is_multiple_of(2);
    let is_periodic = convolution.surroundings == Surroundings::Periodic;
    let is_small = unfolded.into_iter().any(|n| n < 2 * MIN_COARSEST_EDGE);
    if is_small || (is_periodic && !is_even) {
        return;
    }
    // Loads are pressures: on a quarter of the elements the same force is a quarter of their sum.
    let coarse_convolution = convolution.between_blocks();
    let mut coarse = LoadState::new(coarse_convolution.grid().n_elements());
    let problem = LoadProblem {
        convolution: &coarse_convolution,
        separation: &restrict_heights(problem.separation, [rows, columns]),
        control: map_force(problem.control, |total| 0.25 * total),
    };
    // An unconverged solution is a guess too; the finer grid decides whether the problem can be solved.
    let _guess = solve_loads(problem, &mut coarse, &StoppingCriterion::GUESS);
    // Each fine element takes the load of its coarse one.
    for_each_row(&mut state.load, columns, |row, loads| {
        let coarse = &coarse.load[row / 2 * columns.div_ceil(2)..];
        for (column, load) in loads.iter_mut().enumerate() {
            *load = coarse[column / 2];
        }
    });
    MirrorWeights::new(convolution).apply(&mut state.load);
}

/// Restriction of row-major heights \[m] to elements of twice the edges: mean of the finite heights of two by two elements, `+∞` if
/// there are none.
fn restrict_heights(heights: &[f64], shape: [usize; 2]) -> Vec<f64> {
    // This closure returns the mean of the finite heights of a block of two by two elements.
    let mean = |row: usize, column: usize| {
        let (mut sum, mut count) = (0.0, 0.0);
        for row in row..(row + 2).min(shape[0]) {
            for column in column..(column + 2).min(shape[1]) {
                let height = heights[row * shape[1] + column];
                if height.is_finite() {
                    sum += height;
                    count += 1.0;
                }
            }
        }
        if count > 0.0 {
            sum / count
        } else {
            f64::INFINITY
        }
    };
    // Compute this mean for all blocks, which are the elements of the coarser grid.
    let coarse = shape.map(|n| n.div_ceil(2));
    let mut means = vec![0.0; coarse[0] * coarse[1]];
    for_each_row(&mut means, coarse[1], |row, means| {
        for (column, value) in means.iter_mut().enumerate() {
            *value = mean(2 * row, 2 * column);
        }
    });
    means
}
