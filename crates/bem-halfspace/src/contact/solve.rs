//! Where to iterate, and from which first guess.

use crate::contact::iteration::Iteration;
use crate::contact::mirror_weights::MirrorWeights;
use crate::contact::problem::{LoadProblem, LoadSolution, StoppingCriterion};
use crate::contact::state::{ContactBox, ContactState};
use crate::contact::{Control, map_force};
use crate::elements::bounds::Bounds;
use crate::parallel::bands::for_each_row;
use crate::parallel::chunks::in_pool;
use crate::transform::convolution::Surroundings;
use crate::{BemError, Rows};

/// A box is used where it has fewer elements than this part of the grid: with its margin and the product on the whole grid
/// at its end, a larger one takes as long as the grid.
const LARGEST_BOX: f64 = 0.6;
/// A grid with fewer elements along an edge is solved without a guess.
const SMALLEST_EDGE: usize = 32;

/// Solves the contact, from the load of the state or, where that is zero, from coarser grids.
pub(super) fn solve_loads(
    problem: LoadProblem,
    state: &mut ContactState,
    criterion: &StoppingCriterion,
) -> Result<LoadSolution, BemError> {
    let shape = problem.convolution.grid().shape();
    let loaded = |load: &[f64]| {
        Bounds::enclosing_where(shape, |[row, column]| load[row * shape[1] + column] > 0.0)
    };
    let mut bounds = loaded(&state.load);
    if bounds.is_none() {
        start_from_coarser(problem, state);
        bounds = loaded(&state.load);
    }
    solve_around(bounds, problem, state, criterion)
}

/// Iterates on a box around the bounds if that saves time, else on the whole grid.
fn solve_around(
    bounds: Option<Bounds>,
    problem: LoadProblem,
    state: &mut ContactState,
    criterion: &StoppingCriterion,
) -> Result<LoadSolution, BemError> {
    let convolution = problem.convolution;
    let grid = convolution.grid();
    let saves_time = |bounds: &Bounds| {
        let part = bounds.n_elements() as f64 / grid.n_elements() as f64;
        convolution.surroundings == Surroundings::Free && part < LARGEST_BOX
    };
    let with_margin = bounds.map(|bounds| bounds.with_margin(grid.shape(), convolution.mirrors));
    let Some((bounds, outer)) = bounds.zip(with_margin.filter(saves_time)) else {
        return Iteration::new(problem, state).run(criterion);
    };
    let mut inner = match state.inner.take() {
        Some(inner) if can_be_reused(&inner, &bounds, &outer) => inner,
        _ => Box::new(ContactBox::of(convolution, outer)?),
    };
    let columns = grid.shape()[1];
    inner.take_from([problem.separation, &state.load], columns);
    let solved = inner.solve(problem.control, criterion);
    inner.give_load_to(&mut state.load, columns);
    let bounds = inner.bounds;
    state.inner = Some(inner);
    check_around(&bounds, problem, (state, solved?), criterion)
}

/// Whether a box can be used again: the bounds are inside, and it is not much larger than a new one.
fn can_be_reused(inner: &ContactBox, bounds: &Bounds, outer: &Bounds) -> bool {
    inner.bounds.union(bounds) == inner.bounds
        && inner.bounds.n_elements() <= 2 * outer.n_elements()
}

/// Computes the displacement of the whole grid; where it penetrates outside the box, the box grows.
fn check_around(
    bounds: &Bounds,
    problem: LoadProblem,
    (state, solved): (&mut ContactState, LoadSolution),
    criterion: &StoppingCriterion,
) -> Result<LoadSolution, BemError> {
    let convolution = problem.convolution;
    let [rows, columns] = convolution.grid().shape();
    let workspace = &mut state.workspace;
    convolution.apply_in(
        &Rows {
            loaded: bounds.rows(),
            wanted: 0..rows,
        },
        workspace.get_or_insert_with(|| convolution.workspace()),
        &state.load,
        &mut state.displacement,
    );
    // The box and the grid round differently, so the tolerance of the box would be too sharp here.
    let highest = solved.indentation_depth - 2.0 * criterion.tolerance * solved.deflection;
    let displacement = &state.displacement;
    let penetrates = |element: [usize; 2]| {
        let index = element[0] * columns + element[1];
        problem.separation[index] + displacement[index] < highest && !bounds.contains(element)
    };
    let Some(outside) = Bounds::enclosing_where([rows, columns], penetrates) else {
        return Ok(solved);
    };
    let bounds = bounds.union(&outside);
    let again = solve_around(Some(bounds), problem, state, criterion)?;
    let iterations = solved.iterations + again.iterations;
    Ok(LoadSolution {
        iterations,
        ..again
    })
}

impl ContactBox {
    /// Solves for the separation set before; the load has the unit of a length.
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

/// Loads the state with the solution for elements of twice the edges; leaves it unloaded where there is none.
fn start_from_coarser(problem: LoadProblem, state: &mut ContactState) {
    let convolution = problem.convolution;
    let grid = convolution.grid();
    let [rows, columns] = grid.shape();
    let whole = grid.unfolded(convolution.mirrors).shape();
    let is_even = rows.is_multiple_of(2) && columns.is_multiple_of(2);
    let has_period = convolution.surroundings == Surroundings::Periodic;
    if whole.into_iter().any(|n| n < SMALLEST_EDGE) || (has_period && !is_even) {
        return;
    }
    let coarse_convolution = convolution.between_blocks();
    let mut coarse = ContactState::new(&coarse_convolution);
    let problem = LoadProblem {
        convolution: &coarse_convolution,
        separation: &mean_of_four(problem.separation, [rows, columns]),
        control: map_force(problem.control, |total| 0.25 * total),
    };
    // What was reached is a guess too; the finer grid decides whether the problem can be solved.
    let _guess = solve_loads(problem, &mut coarse, &StoppingCriterion::GUESS);
    for_each_row(&mut state.load, columns, |row, loads| {
        let coarse = &coarse.load[row / 2 * columns.div_ceil(2)..];
        for (column, load) in loads.iter_mut().enumerate() {
            *load = coarse[column / 2];
        }
    });
    MirrorWeights::of(convolution).apply(&mut state.load);
}

/// Mean of the finite heights of two by two elements; `+∞` where there are none.
fn mean_of_four(heights: &[f64], [rows, columns]: [usize; 2]) -> Vec<f64> {
    let mean = |row: usize, column: usize| {
        let (mut sum, mut count) = (0.0, 0.0);
        for row in row..(row + 2).min(rows) {
            for column in column..(column + 2).min(columns) {
                let height = heights[row * columns + column];
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
    let shape = [rows, columns].map(|n| n.div_ceil(2));
    let mut means = vec![0.0; shape[0] * shape[1]];
    for_each_row(&mut means, shape[1], |row, means| {
        for (column, value) in means.iter_mut().enumerate() {
            *value = mean(2 * row, 2 * column);
        }
    });
    means
}
