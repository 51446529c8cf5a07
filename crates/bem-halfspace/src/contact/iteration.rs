//! Preconditioned conjugate gradients on an active set that changes with the solution.
//!
//! On a given set of elements in contact the load solves linear equations, whose matrix is a part of the convolution;
//! the same part of an approximate inverse preconditions it, so that the number of iterations hardly depends on the
//! grid. The set changes when its violations, tension inside and penetration outside, outweigh the
//! residual of the linear equations: all violating elements change sides at once (a primal-dual active set, Hintermüller,
//! Ito & Kunisch 2003, DOI 10.1137/S1052623401383558). Such a method ends on all but contrived problems; where the
//! number of violations does not fall, only the last of them changes sides, after an accurate solution, which ends
//! always (Júdice & Pires 1994, DOI 10.1016/0305-0548(94)90106-6).

mod direction;
mod heights;

use crate::contact::active_set::Run;
use crate::contact::fields::Fields;
use crate::contact::mirror_weights::MirrorWeights;
use crate::contact::preconditioner::Weights;
use crate::contact::problem::{LoadProblem, LoadSolution, StoppingCriterion};
use crate::contact::{ContactState, Control};
use crate::parallel::reductions::sum;
use crate::{BemError, Convolution, ConvolutionWorkspace};
use heights::{Heights, Violations};

/// Changes of the set without fewer violations than ever before, after which one element at a time changes.
pub(super) const MAX_NON_IMPROVING_UPDATES: usize = 10;

/// The active set changes when its violations are this many times the residual: earlier, the directions start anew too
/// often, and later, they converge on a wrong set. The number of iterations alone depends on it.
const SET_UPDATE_RATIO: f64 = 2.0;

pub(super) struct Iteration<'a> {
    convolution: &'a Convolution,
    separation: &'a [f64],
    control: Control,
    tolerance: f64,
    /// See [`StoppingCriterion`].
    given_deflection: f64,
    /// That of the list when it was last [written](Self::scatter_load); zero outside the contact.
    load: &'a mut [f64],
    displacement: &'a mut [f64],
    workspace: &'a mut ConvolutionWorkspace,
    fields: &'a mut Fields,
    indentation_depth: f64,
    heights: Heights,
    /// Residual times preconditioned residual in the previous iteration; 0 starts a new set of directions.
    previous_product: f64,
    /// Whether the displacement was computed from the load, and not updated along a direction.
    displacement_is_exact: bool,
    /// Whether the load has been improved on the present active set.
    improved: bool,
    fewest_violations: usize,
    block_updates_left: usize,
}

impl<'a> Iteration<'a> {
    pub(super) fn new(problem: LoadProblem<'a>, state: &'a mut ContactState) -> Self {
        let convolution = problem.convolution;
        Self {
            convolution,
            separation: problem.separation,
            control: problem.control,
            tolerance: 0.0,
            given_deflection: 0.0,
            load: &mut state.load,
            displacement: &mut state.displacement,
            workspace: state
                .workspace
                .get_or_insert_with(|| convolution.workspace()),
            fields: state
                .fields
                .get_or_insert_with(|| Box::new(Fields::new(convolution, Weights::DEFAULT))),
            indentation_depth: 0.0,
            heights: Heights::default(),
            previous_product: 0.0,
            displacement_is_exact: false,
            improved: false,
            fewest_violations: usize::MAX,
            block_updates_left: MAX_NON_IMPROVING_UPDATES,
        }
    }

    pub(super) fn run(mut self, criterion: &StoppingCriterion) -> Result<LoadSolution, BemError> {
        self.given_deflection = criterion.given_deflection;
        self.start();
        let mut iterations = 0;
        loop {
            self.update_depth();
            let violations = self.measure();
            let residual = violations.relative();
            if iterations == 0 {
                self.tolerance = criterion.target(residual);
            }
            if residual <= self.tolerance && violations.tension <= 0.0 {
                if self.displacement_is_exact {
                    return Ok(self.solved(iterations, &violations));
                }
                self.recompute_displacement();
                continue;
            }
            // The numbers have overflowed.
            if iterations >= criterion.max_iterations || residual.is_nan() {
                self.scatter_load();
                let residual = Some(residual).filter(|residual| !residual.is_nan());
                return Err(BemError::ContactNotConverged {
                    iterations,
                    residual: residual.unwrap_or(f64::INFINITY),
                    tolerance: self.tolerance,
                });
            }
            if self.active_set_is_due(&violations) {
                self.change_active_set(&violations);
            } else {
                self.step();
            }
            iterations += 1;
        }
    }

    fn solved(&self, iterations: usize, violations: &Violations) -> LoadSolution {
        LoadSolution {
            indentation_depth: self.indentation_depth,
            total_load: self.total_load(),
            iterations,
            deflection: violations.deflection,
            residual: violations.relative(),
        }
    }

    /// Takes the active set from the first guess; without one, from what lies below the given depth, or everywhere.
    fn start(&mut self) {
        let mut elements = self.load.iter().zip(self.separation);
        let loaded = elements.any(|(load, separation)| *load > 0.0 && separation.is_finite());
        let (below, uniform) = match self.control {
            Control::NormalForce(_) => (f64::INFINITY, 1.0),
            Control::IndentationDepth(depth) => (depth, 0.0),
        };
        let vanishes = self.control == Control::NormalForce(0.0);
        let separation = self.separation;
        let (active, scattered) = (&mut self.fields.active, &mut self.fields.scattered);
        let load = &*self.load;
        active.assign(|element| {
            let guessed = load[element] > 0.0 && separation[element].is_finite();
            !vanishes && (guessed || (!loaded && separation[element] < below))
        });
        let weights = MirrorWeights::of(self.convolution);
        let bands = active.bands;
        bands.for_each([&mut *self.load, scattered], |band, [load, scattered]| {
            scattered.fill(0.0);
            for (load, element) in load.iter_mut().zip(bands.elements(band)) {
                *load = match (active.contains(element), loaded) {
                    (true, true) => *load,
                    (true, false) => uniform * weights.of_element(element),
                    (false, _) => 0.0,
                };
            }
        });
        self.gather_active();
        self.scale_to_force();
        self.recompute_displacement();
    }

    fn gather_active(&mut self) {
        let (active, vectors) = (&mut self.fields.active, &mut self.fields.vectors);
        active.find_runs();
        vectors.take(active, [self.separation, self.load]);
    }

    /// Scales the load to the prescribed force.
    fn scale_to_force(&mut self) {
        let Control::NormalForce(total) = self.control else {
            return;
        };
        let sum = self.total_load();
        let (active, vectors) = (&mut self.fields.active, &mut self.fields.vectors);
        let load = [active.packed(&mut vectors.load)];
        active.bands.for_each_part(load, |_, [load]| {
            for load in load {
                // Multiplied last, because the quotient of extreme forces may overflow.
                *load = if sum > 0.0 { *load / sum * total } else { 0.0 };
            }
        });
    }

    fn total_load(&self) -> f64 {
        let (active, vectors) = (&self.fields.active, &self.fields.vectors);
        active.sum(|range| sum([&vectors.load[range]], |[load]| load))
    }

    fn scatter_load(&mut self) {
        let (active, vectors) = (&self.fields.active, &self.fields.vectors);
        active.scatter(&vectors.load, self.load);
    }

    fn active_set_is_due(&self, violations: &Violations) -> bool {
        let allowed = self.tolerance * violations.deflection;
        if violations.tension <= 0.0 && violations.penetration <= allowed {
            return false;
        }
        let worst = violations.tension.max(violations.penetration);
        let outweighed = worst >= SET_UPDATE_RATIO * violations.gap;
        violations.gap <= allowed || (self.block_updates_left > 0 && self.improved && outweighed)
    }

    fn change_active_set(&mut self, violations: &Violations) {
        self.scatter_load();
        let lowest = self.indentation_depth - self.tolerance * violations.deflection;
        let (load, separation, displacement) = (&*self.load, self.separation, &*self.displacement);
        // Under tension, or outside and below the height at which it penetrates.
        let is_violating = |element: usize, inside: bool| {
            if inside {
                load[element] < 0.0
            } else {
                separation[element] + displacement[element] < lowest
            }
        };
        let active = &mut self.fields.active;
        let (n_violations, last) = active.find_last(is_violating);
        if n_violations < self.fewest_violations {
            self.fewest_violations = n_violations;
            self.block_updates_left = MAX_NON_IMPROVING_UPDATES;
        } else {
            self.block_updates_left = self.block_updates_left.saturating_sub(1);
        }
        let first = if self.block_updates_left == 0 {
            last
        } else {
            0
        };
        active.toggle(|element, inside| element >= first && is_violating(element, inside));
        self.clear_left();
        self.gather_active();
        self.improved = false;
        self.scale_to_force();
        self.recompute_displacement();
    }

    /// Clears what has just left the contact, while the runs are still those before.
    fn clear_left(&mut self) {
        let (active, scattered) = (&mut self.fields.active, &mut self.fields.scattered);
        let bands = active.bands;
        bands.for_each([&mut *self.load, scattered], |band, fields| {
            let first = bands.elements(band).start;
            for field in fields {
                for element in active.runs(band).iter().flat_map(Run::elements) {
                    if !active.contains(element) {
                        field[element - first] = 0.0;
                    }
                }
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ContactOptions, Grid};

    /// Iterations from a uniform load on a Hertz contact and on many patches of many sizes under a periodic load.
    fn iterations(weights: Weights) -> Result<[usize; 2], BemError> {
        let n = 128;
        let grid = Grid::new([n; 2], [1.0; 2])?;
        let paraboloid = |[x, y]: [f64; 2]| 0.01 * ((x - 60.2).powi(2) + (y - 66.9).powi(2));
        let waves = |[x, y]: [f64; 2]| {
            (0.39 * x).cos() + (0.39 * y).cos() + 0.5 * (0.049 * x + 0.147 * y).sin()
        };
        let bodies: [(_, &dyn Fn([f64; 2]) -> f64); 2] = [
            (Convolution::new(&grid), &paraboloid),
            (Convolution::periodic(&grid), &waves),
        ];
        let mut counts = [0; 2];
        for (count, (convolution, height)) in counts.iter_mut().zip(bodies) {
            let at = |index: usize| height([index / n, index % n].map(|k| k as f64));
            let separation: Vec<f64> = (0..n * n).map(at).collect();
            let problem = LoadProblem {
                convolution: &convolution,
                separation: &separation,
                control: Control::NormalForce(100.0),
            };
            let mut state = ContactState::new(&convolution);
            state.fields = Some(Box::new(Fields::new(&convolution, weights)));
            let criterion = StoppingCriterion::from(&ContactOptions::default());
            let solved = Iteration::new(problem, &mut state).run(&criterion)?;
            *count = solved.iterations;
        }
        Ok(counts)
    }

    #[test]
    fn any_positive_weights_converge_and_those_near_the_default_as_soon() -> Result<(), BemError> {
        let default = iterations(Weights::DEFAULT)?;
        let Weights { neighbours, blocks } = Weights::DEFAULT;
        let others = [0.01, 0.5, 0.6, 0.8, 0.9, 10.0].map(|other| [other, blocks]);
        let other_blocks = [0.001, 0.2, 0.4, 0.5, 3.0].map(|other| [neighbours, other]);
        for [neighbours, blocks] in others.into_iter().chain(other_blocks) {
            let weights = Weights { neighbours, blocks };
            let is_near = (0.5..=0.9).contains(&neighbours) && (0.2..=0.5).contains(&blocks);
            let most = if is_near { 1.15 } else { 4.0 };
            let actual = iterations(weights)?;
            let holds = |index: usize| actual[index] as f64 <= most * default[index] as f64;
            assert!(holds(0) && holds(1), "{weights:?}: {actual:?}, {default:?}");
        }
        Ok(())
    }
}
