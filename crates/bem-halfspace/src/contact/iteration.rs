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
use crate::contact::problem::{Accuracy, LoadProblem, Solved};
use crate::contact::{ContactState, Control};
use crate::parallel::reductions::sum;
use crate::{BemError, Convolution, ConvolutionWorkspace};
use heights::{Heights, Violations};

/// Changes of the set without fewer violations than ever before, after which one element at a time changes.
pub(super) const PATIENCE: usize = 10;

/// The active set changes when its violations are this many times the residual: earlier, the directions start anew too
/// often, and later, they converge on a wrong set. The number of iterations alone depends on it.
const PRIORITY: f64 = 2.0;

pub(super) struct Iteration<'a> {
    convolution: &'a Convolution,
    separation: &'a [f64],
    control: Control,
    tolerance: f64,
    /// See [`Accuracy`].
    given_deflection: f64,
    /// That of the list when it was last [written](Self::write_load); zero outside the contact.
    load: &'a mut [f64],
    displacement: &'a mut [f64],
    workspace: &'a mut ConvolutionWorkspace,
    fields: &'a mut Fields,
    indentation_depth: f64,
    heights: Heights,
    /// Residual times preconditioned residual in the previous iteration; 0 starts a new set of directions.
    previous_product: f64,
    /// Whether the displacement was computed from the load, and not updated along a direction.
    fresh: bool,
    /// Whether the load has been improved on the present active set.
    improved: bool,
    fewest_wrong: usize,
    patience: usize,
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
            fresh: false,
            improved: false,
            fewest_wrong: usize::MAX,
            patience: PATIENCE,
        }
    }

    pub(super) fn run(mut self, accuracy: &Accuracy) -> Result<Solved, BemError> {
        self.given_deflection = accuracy.given_deflection;
        self.start();
        let mut iterations = 0;
        loop {
            self.find_depth();
            let violations = self.measure();
            let residual = violations.relative();
            if iterations == 0 {
                self.tolerance = accuracy.target(residual);
            }
            if residual <= self.tolerance && violations.tension <= 0.0 {
                if self.fresh {
                    return Ok(self.solved(iterations, &violations));
                }
                self.refresh();
                continue;
            }
            // The numbers have overflowed.
            if iterations >= accuracy.max_iterations || residual.is_nan() {
                self.write_load();
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

    fn solved(&self, iterations: usize, violations: &Violations) -> Solved {
        Solved {
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
        let (contact, spread) = (&mut self.fields.contact, &mut self.fields.spread);
        let load = &*self.load;
        contact.assign(|element| {
            let guessed = load[element] > 0.0 && separation[element].is_finite();
            !vanishes && (guessed || (!loaded && separation[element] < below))
        });
        let weights = MirrorWeights::of(self.convolution);
        let bands = contact.bands;
        bands.for_each([&mut *self.load, spread], |band, [load, spread]| {
            spread.fill(0.0);
            for (load, element) in load.iter_mut().zip(bands.elements(band)) {
                *load = match (contact.contains(element), loaded) {
                    (true, true) => *load,
                    (true, false) => uniform * weights.of_element(element),
                    (false, _) => 0.0,
                };
            }
        });
        self.list_contact();
        self.match_force();
        self.refresh();
    }

    fn list_contact(&mut self) {
        let (contact, listed) = (&mut self.fields.contact, &mut self.fields.listed);
        contact.find_runs();
        listed.take(contact, [self.separation, self.load]);
    }

    /// Scales the load to the prescribed force.
    fn match_force(&mut self) {
        let Control::NormalForce(total) = self.control else {
            return;
        };
        let sum = self.total_load();
        let (contact, listed) = (&mut self.fields.contact, &mut self.fields.listed);
        let load = [contact.packed(&mut listed.load)];
        contact.bands.for_each_part(load, |_, [load]| {
            for load in load {
                // Multiplied last, because the quotient of extreme forces may overflow.
                *load = if sum > 0.0 { *load / sum * total } else { 0.0 };
            }
        });
    }

    fn total_load(&self) -> f64 {
        let (contact, listed) = (&self.fields.contact, &self.fields.listed);
        contact.sum(|range| sum([&listed.load[range]], |[load]| load))
    }

    fn write_load(&mut self) {
        let (contact, listed) = (&self.fields.contact, &self.fields.listed);
        contact.scatter(&listed.load, self.load);
    }

    fn active_set_is_due(&self, violations: &Violations) -> bool {
        let allowed = self.tolerance * violations.deflection;
        if violations.tension <= 0.0 && violations.penetration <= allowed {
            return false;
        }
        let worst = violations.tension.max(violations.penetration);
        let outweighed = worst >= PRIORITY * violations.gap;
        violations.gap <= allowed || (self.patience > 0 && self.improved && outweighed)
    }

    fn change_active_set(&mut self, violations: &Violations) {
        self.write_load();
        let lowest = self.indentation_depth - self.tolerance * violations.deflection;
        let (load, separation, displacement) = (&*self.load, self.separation, &*self.displacement);
        // Under tension, or outside and below the height at which it penetrates.
        let is_wrong = |element: usize, inside: bool| {
            if inside {
                load[element] < 0.0
            } else {
                separation[element] + displacement[element] < lowest
            }
        };
        let contact = &mut self.fields.contact;
        let (n_wrong, last) = contact.find_last(is_wrong);
        if n_wrong < self.fewest_wrong {
            self.fewest_wrong = n_wrong;
            self.patience = PATIENCE;
        } else {
            self.patience = self.patience.saturating_sub(1);
        }
        let first = if self.patience == 0 { last } else { 0 };
        contact.toggle(|element, inside| element >= first && is_wrong(element, inside));
        self.clear_left();
        self.list_contact();
        self.improved = false;
        self.match_force();
        self.refresh();
    }

    /// Clears what has just left the contact, while the runs are still those before.
    fn clear_left(&mut self) {
        let (contact, spread) = (&mut self.fields.contact, &mut self.fields.spread);
        let bands = contact.bands;
        bands.for_each([&mut *self.load, spread], |band, fields| {
            let first = bands.elements(band).start;
            for field in fields {
                for element in contact.runs(band).iter().flat_map(Run::elements) {
                    if !contact.contains(element) {
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
            let accuracy = Accuracy::from(&ContactOptions::default());
            let solved = Iteration::new(problem, &mut state).run(&accuracy)?;
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
