//! Contact with a largest pressure, the hardness.
//!
//! ```text
//! g = s + K x − d,      0 ≤ x ≤ X,      g ≥ 0 where x = 0,      g = 0 between,      g ≤ 0 where x = X
//! ```
//!
//! (Almqvist, Sahlin, Larsson & Glavatskih 2007), with the load x = α P/(4π) of an element, the initial gap s and the depth d. The
//! largest load X belongs to the largest pressure. The saturated set, the elements at x = X, is found by an outer primal-dual
//! active-set method. With the loads of the saturated set given, the other elements solve the elastic contact without them.
//! Then elements with x > X join the set, and elements whose gap opens leave it (`exchange_rule.rs`).
//!
//! Theory: docs/theory/contact.md, "A largest pressure".

use crate::contact::exchange_rule::{ExchangeRule, Violation};
use crate::contact::mirror_weights::MirrorWeights;
use crate::contact::problem::{LoadProblem, LoadSolution, StoppingCriterion};
use crate::contact::solve::solve_loads;
use crate::contact::{Control, LoadState, map_force};
use crate::{BemError, ConvolutionWorkspace};

/// Loosest relative tolerance of the elastic contacts while the saturated set still changes. Chosen: a looser one misplaces
/// elements of that set, a tighter one takes more iterations before each exchange. The solution does not depend on it, because
/// the last contact has the tolerance asked for.
const INEXACT_TOLERANCE: f64 = 1e-4;

/// Solves the contact with loads x of at most `largest_load` per element, without unit; infinity means no limit.
pub(super) fn solve_with_largest_load(
    largest_load: f64,
    problem: LoadProblem,
    state: &mut LoadState,
    criterion: &StoppingCriterion,
) -> Result<LoadSolution, BemError> {
    if largest_load.is_infinite() {
        return solve_loads(problem, state, criterion);
    }
    SaturatedSet::new(largest_load, problem, state).run(state, criterion)
}

/// The saturated elements with their loads, and the elastic contact problem that remains for the other elements.
struct SaturatedSet<'a> {
    /// The problem with all elements.
    problem: LoadProblem<'a>,
    /// Largest load X of a whole element, without unit.
    largest_load: f64,
    /// Fraction of each element in the symmetry-reduced domain, by which its largest load is multiplied.
    weights: MirrorWeights,
    /// Flag of each element: true if its load is X.
    is_saturated: Vec<bool>,
    /// Field of the loads of the saturated elements, without unit; zero elsewhere.
    load: Vec<f64>,
    /// Sum of the loads of the saturated elements.
    total: f64,
    /// Displacement K x_X under the loads x_X of the saturated elements, on the whole grid, \[m].
    displacement: Vec<f64>,
    /// Buffers for applying K.
    workspace: ConvolutionWorkspace,
    /// Initial gap s + K x_X of the elastic contact of the other elements, \[m]; infinite on the saturated ones.
    separation: Vec<f64>,
}

/// Condition on the gaps of saturated elements: s + K x − d ≤ `allowed`.
#[derive(Clone, Copy)]
struct GapTest {
    /// Indentation depth d, \[m].
    depth: f64,
    /// Largest positive gap that counts as closed, \[m].
    allowed: f64,
}

impl<'a> SaturatedSet<'a> {
    /// Initial saturated set: the elements whose load in the first guess is at the limit, or none if these bear the whole force or
    /// more.
    fn new(largest_load: f64, problem: LoadProblem<'a>, state: &LoadState) -> Self {
        let weights = MirrorWeights::new(problem.convolution);
        // Elements at the largest load start in the saturated set.
        let elements = state.load.iter().zip(problem.separation).enumerate();
        let is_saturated = elements.map(|(element, (load, height))| {
            *load >= largest_load * weights.of_element(element) && height.is_finite()
        });
        let n = state.load.len();
        let mut saturated = Self {
            problem,
            largest_load,
            weights,
            is_saturated: is_saturated.collect(),
            load: vec![0.0; n],
            total: 0.0,
            displacement: vec![0.0; n],
            workspace: problem.convolution.workspace(),
            separation: vec![0.0; n],
        };
        saturated.update_loads();
        // If the set bears the whole force or more, begin with an empty one, because no force is left for the other elements.
        if matches!(problem.control, Control::NormalForce(total) if saturated.total >= total) {
            saturated.is_saturated.fill(false);
            saturated.update_loads();
        }
        saturated
    }

    /// Exchanges elements between the saturated set and its complement until both satisfy their conditions.
    ///
    /// # Errors
    /// [`BemError::ContactNotConverged`] if the elastic contacts together need too many iterations.
    fn run(
        mut self,
        state: &mut LoadState,
        criterion: &StoppingCriterion,
    ) -> Result<LoadSolution, BemError> {
        let (mut tolerance, mut iterations) = (criterion.tolerance.max(INEXACT_TOLERANCE), 0);
        let mut rule = ExchangeRule::new(self.problem.convolution.grid().shape());
        loop {
            // Solve the elastic contact of the elements below the limit.
            let problem = LoadProblem {
                separation: &self.separation,
                control: map_force(self.problem.control, |total| total - self.total),
                ..self.problem
            };
            let inner_criterion = StoppingCriterion {
                tolerance,
                given_deflection: self.displacement.iter().copied().fold(0.0, f64::max),
                ..*criterion
            };
            let solved = solve_loads(problem, state, &inner_criterion)?;
            iterations += solved.iterations + 1;

            // Collect the violations. If there are none, solve once more with a smaller tolerance; after that, add the saturated loads
            // to the solution and end.
            let test = GapTest {
                depth: solved.indentation_depth,
                allowed: tolerance * solved.deflection,
            };
            let violations = self.violations(state, test);
            if violations.is_empty() {
                if tolerance <= criterion.tolerance {
                    return Ok(self.with_saturated_set(state, solved, iterations));
                }
                tolerance = criterion.tolerance;
                continue;
            }
            if iterations >= criterion.max_iterations {
                let sizes = violations.iter().map(|violation| violation.size);
                return Err(BemError::ContactNotConverged {
                    iterations,
                    residual: sizes.fold(0.0, f64::max) / solved.deflection,
                    tolerance,
                });
            }

            // Exchange elements between the saturated set and its complement. An element that leaves the set keeps its load as
            // the first guess.
            for element in rule.select(&violations, false) {
                self.is_saturated[element] ^= true;
                state.load[element] = self.load[element];
            }
            self.update_loads();
        }
    }

    /// Recomputes loads, displacement and initial gap from the flags of the saturated set.
    fn update_loads(&mut self) {
        // Give each saturated element the largest load, times its weight on a mirror, and the others no load.
        let flags = self.is_saturated.iter();
        for (element, (load, is_saturated)) in self.load.iter_mut().zip(flags).enumerate() {
            let weight = f64::from(*is_saturated) * self.weights.of_element(element);
            *load = if weight > 0.0 {
                self.largest_load * weight
            } else {
                0.0
            };
        }
        self.total = self.load.iter().sum();
        // Find the displacements by these loads, and the separation that the other elements see.
        let convolution = self.problem.convolution;
        convolution.apply(&mut self.workspace, &self.load, &mut self.displacement);
        let heights = self.problem.separation.iter().zip(&self.displacement);
        let separations = self.separation.iter_mut().zip(&self.is_saturated);
        for ((separation, is_saturated), (height, displacement)) in separations.zip(heights) {
            *separation = if *is_saturated {
                f64::INFINITY
            } else {
                height + displacement
            };
        }
    }

    /// Violations of the saturated set by a solution: saturated elements whose gap opens by more than `test.allowed`, and other
    /// elements whose load exceeds the limit. Sizes are lengths \[m]; an excess of load is multiplied by the self-influence.
    fn violations(&self, state: &LoadState, test: GapTest) -> Vec<Violation> {
        let convolution = self.problem.convolution;
        let columns = convolution.grid().shape()[1];
        // A saturated element violates by an open gap, another one by the excess of its load.
        let violation = |element: usize| {
            let size = if self.is_saturated[element] {
                let displacement = state.displacement[element] + self.displacement[element];
                self.problem.separation[element] + displacement - test.depth - test.allowed
            } else {
                let largest = self.largest_load * self.weights.of_element(element);
                (state.load[element] - largest) * convolution.self_influence
            };
            (size > 0.0).then(|| Violation {
                element,
                place: [element / columns, element % columns],
                size,
            })
        };
        (0..self.is_saturated.len()).filter_map(violation).collect()
    }

    /// Solution on all elements: adds loads and displacement of the saturated set to those in `state`, which lack them, and its
    /// total load to that of `solved`.
    fn with_saturated_set(
        self,
        state: &mut LoadState,
        solved: LoadSolution,
        iterations: usize,
    ) -> LoadSolution {
        for (sum, load) in state.load.iter_mut().zip(&self.load) {
            *sum += load;
        }
        for (sum, displacement) in state.displacement.iter_mut().zip(&self.displacement) {
            *sum += displacement;
        }
        LoadSolution {
            total_load: solved.total_load + self.total,
            iterations,
            ..solved
        }
    }
}
