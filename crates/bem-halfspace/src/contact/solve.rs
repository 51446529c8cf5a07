//! Where to iterate, and from which first guess.

use crate::bounds::Bounds;
use crate::contact::coarser::start_from_coarser;
use crate::contact::contact_box::ContactBox;
use crate::contact::iteration::Iteration;
use crate::contact::{ContactOptions, ContactState, Control};
use crate::convolution::Surroundings;
use crate::{BemError, Convolution};

/// A contact problem for the load `x = α P / (4π)`, whose displacement is `K x`.
#[derive(Debug, Clone, Copy)]
pub(super) struct LoadProblem<'a> {
    pub(super) convolution: &'a Convolution,
    /// One value per element, \[m].
    pub(super) separation: &'a [f64],
    /// A force is the sum of the loads.
    pub(super) control: Control,
}

/// The result of a solve beside the load.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Solved {
    pub(crate) indentation_depth: f64,
    pub(crate) total_load: f64,
    pub(crate) iterations: usize,
    /// Largest displacement in the contact, \[m].
    pub(crate) deflection: f64,
    pub(crate) residual: f64,
}

/// A box is used where it has fewer elements than this part of the grid: with its margin and the product on the whole grid
/// at its end, a larger one takes as long as the grid.
const LARGEST_BOX: f64 = 0.6;

/// Solves the contact, from the load of the state or, where that is zero, from coarser grids.
pub(super) fn solve_loads(
    problem: LoadProblem,
    state: &mut ContactState,
    accuracy: &Accuracy,
) -> Result<Solved, BemError> {
    let shape = problem.convolution.grid().shape();
    let loaded =
        |load: &[f64]| Bounds::of_field(shape, |[row, column]| load[row * shape[1] + column] > 0.0);
    let mut bounds = loaded(&state.load);
    if bounds.is_none() {
        start_from_coarser(problem, state);
        bounds = loaded(&state.load);
    }
    solve_around(bounds, problem, state, accuracy)
}

/// Iterates on a box around the bounds if that saves time, else on the whole grid.
fn solve_around(
    bounds: Option<Bounds>,
    problem: LoadProblem,
    state: &mut ContactState,
    accuracy: &Accuracy,
) -> Result<Solved, BemError> {
    let convolution = problem.convolution;
    let grid = convolution.grid();
    let may_have_box = state.may_have_box && convolution.surroundings == Surroundings::Free;
    let saves_time = |bounds: &Bounds| {
        let part = bounds.n_elements() as f64 / grid.n_elements() as f64;
        may_have_box && part < LARGEST_BOX
    };
    let with_margin = bounds.map(|bounds| bounds.with_margin(grid.shape(), convolution.mirrors));
    let Some((bounds, outer)) = bounds.zip(with_margin.filter(saves_time)) else {
        return Iteration::new(problem, state).run(accuracy);
    };
    let mut inner = match state.inner.take() {
        Some(inner) if can_be_reused(&inner, &bounds, &outer) => inner,
        _ => Box::new(ContactBox::of(convolution, outer)?),
    };
    let columns = grid.shape()[1];
    inner.take_from([problem.separation, &state.load], columns);
    let solved = inner.solve_to(problem.control, accuracy);
    inner.give_load_to(&mut state.load, columns);
    let bounds = inner.bounds;
    state.inner = Some(inner);
    check_around(&bounds, problem, (state, solved?), accuracy)
}

/// Whether a box can be used again: the bounds are inside, and it is not much larger than a new one.
fn can_be_reused(inner: &ContactBox, bounds: &Bounds, outer: &Bounds) -> bool {
    inner.bounds.contains_all(bounds) && inner.bounds.n_elements() <= 2 * outer.n_elements()
}

/// Computes the displacement of the whole grid; where it penetrates outside the box, the box grows.
fn check_around(
    bounds: &Bounds,
    problem: LoadProblem,
    (state, solved): (&mut ContactState, Solved),
    accuracy: &Accuracy,
) -> Result<Solved, BemError> {
    let convolution = problem.convolution;
    let [rows, columns] = convolution.grid().shape();
    let workspace = state
        .workspace
        .get_or_insert_with(|| convolution.workspace());
    convolution.apply(
        workspace,
        (&state.load, bounds.rows()),
        (&mut state.displacement, 0..rows),
    );
    // The box and the grid round differently, so the tolerance of the box would be too sharp here.
    let highest = solved.indentation_depth - 2.0 * accuracy.tolerance * solved.deflection;
    let displacement = &state.displacement;
    let penetrates = |element: [usize; 2]| {
        let index = element[0] * columns + element[1];
        problem.separation[index] + displacement[index] < highest && !bounds.contains(element)
    };
    let Some(outside) = Bounds::of_field([rows, columns], penetrates) else {
        return Ok(solved);
    };
    let bounds = bounds.union(&outside);
    let again = solve_around(Some(bounds), problem, state, accuracy)?;
    let iterations = solved.iterations + again.iterations;
    Ok(Solved {
        iterations,
        ..again
    })
}

/// When an iteration ends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Accuracy {
    /// See [`ContactOptions::tolerance`].
    pub(super) tolerance: f64,
    /// The residual must also fall to this part of what the first guess leaves; `∞` where that does not matter.
    pub(super) part_of_first: f64,
    pub(super) max_iterations: usize,
}

impl Accuracy {
    /// For a solution that is the first guess on elements of half the edges.
    ///
    /// The residual of its own first guess measures the error of the larger elements, of which about a third remains
    /// with these; nothing is gained from a solution more accurate than that.
    pub(super) const GUESS: Self = Self {
        tolerance: 1e-3,
        part_of_first: 0.1,
        max_iterations: 100,
    };

    /// The residual at which to end, from that of the first guess.
    pub(super) fn target(&self, first_residual: f64) -> f64 {
        self.tolerance.min(self.part_of_first * first_residual)
    }
}

impl From<&ContactOptions> for Accuracy {
    fn from(options: &ContactOptions) -> Self {
        Self {
            tolerance: options.tolerance,
            part_of_first: f64::INFINITY,
            max_iterations: options.max_iterations,
        }
    }
}
