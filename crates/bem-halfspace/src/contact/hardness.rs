//! Contact under a pressure that has a largest value, the hardness.
//!
//! ```text
//! g = s + K x − d,      0 ≤ x ≤ X,      g ≥ 0 where x = 0,      g = 0 between,      g ≤ 0 where x = X
//! ```
//!
//! (Almqvist, Sahlin, Larsson & Glavatskih 2007.) The elements at the limit are found like those in contact, by a
//! primal-dual active set: while their load is given, the others make an elastic contact in which they have no part. Loads
//! above X reach the limit, and an element at the limit whose gap opens leaves it.

use crate::contact::iteration::MAX_NON_IMPROVING_UPDATES;
use crate::contact::mirror_weights::MirrorWeights;
use crate::contact::problem::{LoadProblem, LoadSolution, StoppingCriterion};
use crate::contact::solve::solve_loads;
use crate::contact::{ContactState, Control, map_force};
use crate::{BemError, ConvolutionWorkspace};

/// Largest tolerance of the contacts of all sets of elements at the limit but the last, whose errors then move few elements.
const ROUGH: f64 = 1e-4;

/// Solves the contact with loads of at most `largest_load` per element; infinite where there is no limit.
pub(super) fn solve_below(
    largest_load: f64,
    problem: LoadProblem,
    state: &mut ContactState,
    criterion: &StoppingCriterion,
) -> Result<LoadSolution, BemError> {
    if largest_load.is_infinite() {
        return solve_loads(problem, state, criterion);
    }
    Limited::new(largest_load, problem, state).run(state, criterion)
}

/// The elements at the limit, and what their loads do to the others.
struct Limited<'a> {
    problem: LoadProblem<'a>,
    largest_load: f64,
    weights: MirrorWeights,
    at_limit: Vec<bool>,
    /// Their loads, zero elsewhere, and the sum and the displacement of these.
    load: Vec<f64>,
    total: f64,
    displacement: Vec<f64>,
    workspace: ConvolutionWorkspace,
    /// For the others; infinite at the limit, where these have no part.
    separation: Vec<f64>,
}

/// Elements on the wrong side of the limit.
struct Wrong {
    count: usize,
    last: usize,
    /// Largest of what they violate, as a displacement.
    worst: f64,
}

impl<'a> Limited<'a> {
    /// With the elements at the limit of the first guess, unless they bear more than the whole force.
    fn new(largest_load: f64, problem: LoadProblem<'a>, state: &ContactState) -> Self {
        let weights = MirrorWeights::of(problem.convolution);
        let elements = state.load.iter().zip(problem.separation).enumerate();
        let at_limit = elements.map(|(element, (load, height))| {
            *load >= largest_load * weights.of_element(element) && height.is_finite()
        });
        let n = state.load.len();
        let mut limited = Self {
            problem,
            largest_load,
            weights,
            at_limit: at_limit.collect(),
            load: vec![0.0; n],
            total: 0.0,
            displacement: vec![0.0; n],
            workspace: problem.convolution.workspace(),
            separation: vec![0.0; n],
        };
        limited.give_loads();
        if matches!(problem.control, Control::NormalForce(total) if limited.total >= total) {
            limited.at_limit.fill(false);
            limited.give_loads();
        }
        limited
    }

    fn run(
        mut self,
        state: &mut ContactState,
        criterion: &StoppingCriterion,
    ) -> Result<LoadSolution, BemError> {
        let (mut tolerance, mut iterations) = (criterion.tolerance.max(ROUGH), 0);
        let (mut fewest, mut block_updates_left) = (usize::MAX, MAX_NON_IMPROVING_UPDATES);
        loop {
            let solved = self.solve_others(state, tolerance, criterion)?;
            iterations += solved.iterations + 1;
            let depth = solved.indentation_depth;
            let wrong = self.find_wrong(state, depth, tolerance * solved.deflection);
            if wrong.count == 0 {
                if tolerance <= criterion.tolerance {
                    return Ok(self.finish(state, solved, iterations));
                }
                tolerance = criterion.tolerance;
                continue;
            }
            if iterations >= criterion.max_iterations {
                return Err(BemError::ContactNotConverged {
                    iterations,
                    residual: wrong.worst / solved.deflection,
                    tolerance,
                });
            }
            // As in the contact, one element at a time changes where the number of violations does not fall.
            if wrong.count < fewest {
                (fewest, block_updates_left) = (wrong.count, MAX_NON_IMPROVING_UPDATES);
            } else {
                block_updates_left = block_updates_left.saturating_sub(1);
            }
            let first = if block_updates_left == 0 {
                wrong.last
            } else {
                0
            };
            self.change(state, first, (depth, tolerance * solved.deflection));
        }
    }

    /// Finds loads, displacements and separations from the elements at the limit.
    fn give_loads(&mut self) {
        for (element, (load, at_limit)) in self.load.iter_mut().zip(&self.at_limit).enumerate() {
            let weight = f64::from(*at_limit) * self.weights.of_element(element);
            *load = if weight > 0.0 {
                self.largest_load * weight
            } else {
                0.0
            };
        }
        self.total = self.load.iter().sum();
        let convolution = self.problem.convolution;
        convolution.apply(&mut self.workspace, &self.load, &mut self.displacement);
        let heights = self.problem.separation.iter().zip(&self.displacement);
        let separations = self.separation.iter_mut().zip(&self.at_limit).zip(heights);
        for ((separation, at_limit), (height, displacement)) in separations {
            *separation = if *at_limit {
                f64::INFINITY
            } else {
                height + displacement
            };
        }
    }

    /// Solves the contact of the elements below the limit.
    fn solve_others(
        &self,
        state: &mut ContactState,
        tolerance: f64,
        criterion: &StoppingCriterion,
    ) -> Result<LoadSolution, BemError> {
        let problem = LoadProblem {
            separation: &self.separation,
            control: map_force(self.problem.control, |total| total - self.total),
            ..self.problem
        };
        let criterion = StoppingCriterion {
            tolerance,
            given_deflection: self.displacement.iter().copied().fold(0.0, f64::max),
            ..*criterion
        };
        solve_loads(problem, state, &criterion)
    }

    /// By how much an element is on the wrong side of the limit, as a displacement; not above zero on the right side.
    fn violation(&self, state: &ContactState, element: usize, (depth, allowed): (f64, f64)) -> f64 {
        if self.at_limit[element] {
            let displacement = state.displacement[element] + self.displacement[element];
            self.problem.separation[element] + displacement - depth - allowed
        } else {
            let largest = self.largest_load * self.weights.of_element(element);
            (state.load[element] - largest) * self.problem.convolution.self_influence
        }
    }

    fn find_wrong(&self, state: &ContactState, depth: f64, allowed: f64) -> Wrong {
        let mut wrong = Wrong {
            count: 0,
            last: 0,
            worst: 0.0,
        };
        for element in 0..self.at_limit.len() {
            let violation = self.violation(state, element, (depth, allowed));
            if violation > 0.0 {
                wrong.count += 1;
                wrong.last = element;
                wrong.worst = violation.max(wrong.worst);
            }
        }
        wrong
    }

    /// Moves the elements on the wrong side from the element `first` on to the other side.
    fn change(&mut self, state: &mut ContactState, first: usize, depth_and_allowed: (f64, f64)) {
        for element in first..self.at_limit.len() {
            if self.violation(state, element, depth_and_allowed) > 0.0 {
                self.at_limit[element] = !self.at_limit[element];
                // Where it leaves the limit, the first guess of its load.
                state.load[element] = self.load[element];
            }
        }
        self.give_loads();
    }

    /// Adds the loads at the limit to the others.
    fn finish(
        self,
        state: &mut ContactState,
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
