//! Where to iterate, and from which first guess.

use crate::bounds::Bounds;
use crate::contact::coarser::start_from_coarser;
use crate::contact::contact_box::ContactBox;
use crate::contact::iteration::Iteration;
use crate::contact::{Accuracy, ContactState, Control};
use crate::convolution::Surroundings;
use crate::{BemError, Convolution};

/// What is asked on a grid: its convolution, the separation \[m] and the control, a force as the sum of the loads
/// `x = α P / (4π)`.
pub(crate) type Question<'a> = (&'a Convolution, &'a [f64], Control);

/// What a solve found beside the load.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Outcome {
    pub(crate) indentation_depth: f64,
    pub(crate) total_load: f64,
    pub(crate) iterations: usize,
    /// Largest displacement in the contact, \[m].
    pub(crate) deflection: f64,
    pub(crate) residual: f64,
}

/// A box pays when it is smaller than this part of the grid.
const LARGEST_BOX: f64 = 0.6;

/// Solves the contact for the load `x = α P / (4π)`, whose displacement is `K x`.
pub(crate) fn solve_normalised(
    question: Question,
    state: &mut ContactState,
    accuracy: &Accuracy,
) -> Result<Outcome, BemError> {
    let shape = question.0.grid().shape();
    let loaded = |state: &ContactState| {
        let load = state.load.touched()?;
        Bounds::of_field(shape, |[row, column]| load[row * shape[1] + column] > 0.0)
    };
    let mut bounds = loaded(state);
    if bounds.is_none() {
        start_from_coarser(question, state);
        bounds = loaded(state);
    }
    solve_around(bounds, question, state, accuracy)
}

/// Iterates on a box around the bounds if that pays, else on the whole grid.
fn solve_around(
    bounds: Option<Bounds>,
    question: Question,
    state: &mut ContactState,
    accuracy: &Accuracy,
) -> Result<Outcome, BemError> {
    let (convolution, ..) = question;
    let grid = convolution.grid();
    let in_parts = state.in_parts;
    let pays = |bounds: &Bounds| {
        let part = bounds.n_elements() as f64 / grid.n_elements() as f64;
        in_parts && part < LARGEST_BOX && convolution.surroundings() == Surroundings::Free
    };
    let with_margin = bounds.map(|bounds| bounds.with_margin(grid.shape(), convolution.mirrors()));
    let Some((bounds, outer)) = bounds.zip(with_margin.filter(pays)) else {
        return Iteration::new(question, state).run(accuracy);
    };
    let mut inner = match state.inner.take() {
        Some(inner) if suits(&inner, &bounds, &outer) => inner,
        _ => Box::new(ContactBox::of(convolution, outer)?),
    };
    inner.take_from((question.1, state.load.values()), grid.shape()[1]);
    let outcome = inner.solve_to(question.2, accuracy);
    inner.give_to(state.load.values_mut(), grid.shape()[1]);
    let solved = inner.bounds;
    state.inner = Some(inner);
    check_around(&solved, question, (state, outcome?), accuracy)
}

/// Whether a box can serve again: the bounds are inside, and it is not much larger than a new one.
fn suits(inner: &ContactBox, bounds: &Bounds, outer: &Bounds) -> bool {
    inner.bounds.contains_all(bounds) && inner.bounds.n_elements() <= 2 * outer.n_elements()
}

/// Computes the displacement of the whole grid; where it penetrates outside the box, the box grows.
fn check_around(
    solved: &Bounds,
    question: Question,
    (state, outcome): (&mut ContactState, Outcome),
    accuracy: &Accuracy,
) -> Result<Outcome, BemError> {
    let (convolution, separation, _) = question;
    let [rows, columns] = convolution.grid().shape();
    let workspace = state
        .workspace
        .get_or_insert_with(|| convolution.workspace());
    convolution.apply(
        workspace,
        (state.load.values(), solved.rows()),
        (&mut state.displacement, 0..rows),
    );
    // The box and the grid round differently, so the tolerance of the box would be too sharp here.
    let highest = outcome.indentation_depth - 2.0 * accuracy.tolerance * outcome.deflection;
    let displacement = &state.displacement;
    let penetrates = |element: [usize; 2]| {
        let index = element[0] * columns + element[1];
        separation[index] + displacement[index] < highest && !solved.contains(element)
    };
    let Some(outside) = Bounds::of_field([rows, columns], penetrates) else {
        return Ok(outcome);
    };
    let bounds = solved.union(&outside);
    let again = solve_around(Some(bounds), question, state, accuracy)?;
    let iterations = outcome.iterations + again.iterations;
    Ok(Outcome {
        iterations,
        ..again
    })
}
