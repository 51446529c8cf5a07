//! Preconditioned conjugate gradients on an active set that changes with the solution.
//!
//! ```text
//! g = s + K x − d,      g = 0 on the active set C,      x = 0 elsewhere,      Σ x or d given
//! ```
//!
//! The unknown is the load x = α P/(4π), a scaled pressure without unit; s is the initial gap, d the depth, K x the displacement.
//!
//! On a fixed set this is a symmetric positive definite system, preconditioned by an approximate inverse of K restricted to C
//! (`preconditioner.rs`), so that the number of iterations hardly depends on the grid. The set is updated as soon as its
//! violations, tension inside and penetration outside, outweigh the linear residual. Then all violating elements are
//! exchanged (primal-dual active set, Hintermüller, Ito & Kunisch 2003, DOI 10.1137/S1052623401383558), which ends on all but
//! contrived problems. Where the number of violations stagnates, only the last violating element is exchanged, after an
//! accurate solution; this always terminates (Júdice & Pires 1994, DOI 10.1016/0305-0548(94)90106-6).
//!
//! Theory: docs/theory/contact.md, "Iteration" and "When it stops".

mod heights;

use crate::contact::active_set::Run;
use crate::contact::exchange_rule::Stagnation;
use crate::contact::fields::Fields;
use crate::contact::mirror_weights::MirrorWeights;
use crate::contact::preconditioner::PreconditionerParameters;
use crate::contact::problem::{LoadProblem, LoadSolution, StoppingCriterion};
use crate::contact::{Control, LoadState};
use crate::parallel::reductions::sum;
use crate::{BemError, Convolution, ConvolutionWorkspace};
use heights::{Heights, Violations};

/// Ratio of the largest violation to the largest linear residual from which the active set is updated. Chosen (case of
/// `evidence tuning`).
///
/// A smaller ratio restarts the conjugate gradients too often, a larger one lets them converge on a wrong set. Only the number of
/// iterations depends on it: with 1 it grows with the number of patches in contact (test
/// `iterations_hardly_depend_on_the_number_of_patches`).
const SET_UPDATE_RATIO: f64 = 2.0;

/// State of the solver on one grid.
pub(super) struct Iteration<'a> {
    /// Operator K.
    convolution: &'a Convolution,
    /// Initial gap s, \[m]; `+∞` where no contact is possible.
    separation: &'a [f64],
    /// Prescribed depth d \[m], or force as the sum of the loads Σ x, without unit.
    control: Control,
    /// Relative residual at which the iteration stops; set after the first residual.
    tolerance: f64,
    /// Largest displacement under given loads, \[m]; see [`StoppingCriterion`].
    given_deflection: f64,
    /// Field of the load x when it was last [scattered](Self::scatter_load); zero outside the active set.
    load: &'a mut [f64],
    /// Displacement K x on the grid, \[m].
    displacement: &'a mut [f64],
    /// Buffers for applying K.
    workspace: &'a mut ConvolutionWorkspace,
    /// Active set, preconditioner and vectors.
    fields: &'a mut Fields,
    /// Depth d of the present iterate, \[m].
    indentation_depth: f64,
    /// Lowest deformed height s + K x outside the active set, and their sum inside.
    heights: Heights,
    /// Inner product of residual and preconditioned residual in the previous iteration; 0 restarts the directions.
    previous_product: f64,
    /// True if the displacement was computed from the load, false if it was updated along a direction.
    displacement_is_exact: bool,
    /// True after the first conjugate-gradient step on the present active set.
    has_stepped: bool,
    /// Count of the updates that did not reduce the number of violations.
    stagnation: Stagnation,
}

impl<'a> Iteration<'a> {
    /// An iteration that starts from the load in `state` and leaves its solution there; [`run`](Self::run) sets the tolerance.
    pub(super) fn new(problem: LoadProblem<'a>, state: &'a mut LoadState) -> Self {
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
            fields: state.fields.get_or_insert_with(|| {
                Box::new(Fields::new(convolution, PreconditionerParameters::DEFAULT))
            }),
            indentation_depth: 0.0,
            heights: Heights::default(),
            previous_product: 0.0,
            displacement_is_exact: false,
            has_stepped: false,
            stagnation: Stagnation::default(),
        }
    }

    /// Iterates until load, gap and active set satisfy the contact conditions to the tolerance.
    ///
    /// # Errors
    /// [`BemError::ContactNotConverged`] at the iteration limit, and with an infinite residual if numbers overflow.
    pub(super) fn run(mut self, criterion: &StoppingCriterion) -> Result<LoadSolution, BemError> {
        self.given_deflection = criterion.given_deflection;
        self.initialise();
        let mut iterations = 0;
        loop {
            // Evaluate depth, linear residual and violations of the present load.
            self.update_depth();
            let violations = self.update_residual();
            let residual = violations.relative();
            if iterations == 0 {
                self.tolerance = criterion.target_residual(residual);
            }

            // The iteration has converged if that also holds for a displacement computed anew, without the rounding of many
            // updates.
            if residual <= self.tolerance && violations.tension <= 0.0 {
                if !self.displacement_is_exact {
                    self.recompute_displacement();
                    continue;
                }
                return Ok(LoadSolution {
                    indentation_depth: self.indentation_depth,
                    total_load: self.total_load(),
                    iterations,
                    deflection: violations.deflection,
                    residual,
                });
            }

            // Give up at the iteration limit, or when numbers have overflowed.
            if iterations >= criterion.max_iterations || residual.is_nan() {
                self.scatter_load();
                let residual = Some(residual).filter(|residual| !residual.is_nan());
                return Err(BemError::ContactNotConverged {
                    iterations,
                    residual: residual.unwrap_or(f64::INFINITY),
                    tolerance: self.tolerance,
                });
            }

            // Update the set if its violations outweigh the linear residual; otherwise go on with the linear equations.
            let allowed = self.tolerance * violations.deflection;
            let set_is_right = violations.tension <= 0.0 && violations.penetration <= allowed;
            let worst = violations.tension.max(violations.penetration);
            let outweighs = worst >= SET_UPDATE_RATIO * violations.gap;
            let may_be_inexact = self.stagnation.allows_block_updates() && self.has_stepped;
            if !set_is_right && (violations.gap <= allowed || (may_be_inexact && outweighs)) {
                self.update_active_set(&violations);
            } else {
                self.conjugate_gradient_step();
            }
            iterations += 1;
        }
    }

    /// Sets the active set and its loads from the first guess. Without a guess the set has the elements below a given depth, without
    /// load, or all elements under a given force, with equal loads.
    fn initialise(&mut self) {
        // Begin with the loaded elements of the guess if there is one, else with all candidates.
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
        // Take the loads of the guess, or equal ones without a guess, and clear all loads outside the set.
        let weights = MirrorWeights::new(self.convolution);
        let row_blocks = active.row_blocks;
        row_blocks.for_each(
            [&mut *self.load, scattered],
            |row_block, [load, scattered]| {
                scattered.fill(0.0);
                for (load, element) in load.iter_mut().zip(row_blocks.elements(row_block)) {
                    *load = match (active.contains(element), loaded) {
                        (true, true) => *load,
                        (true, false) => uniform * weights.of_element(element),
                        (false, _) => 0.0,
                    };
                }
            },
        );
        self.gather_active();
        self.scale_to_force();
        self.recompute_displacement();
    }

    /// Exchanges the violating elements between the active set and its complement, and restarts the conjugate gradients.
    fn update_active_set(&mut self, violations: &Violations) {
        self.scatter_load();
        let lowest = self.indentation_depth - self.tolerance * violations.deflection;
        let (load, separation, displacement) = (&*self.load, self.separation, &*self.displacement);
        // An element inside the set is violating under tension, one outside if it penetrates by more than the tolerance.
        let is_violating = |element: usize, inside: bool| {
            if inside {
                load[element] < 0.0
            } else {
                separation[element] + displacement[element] < lowest
            }
        };

        // Exchange all violating elements, or only the last one when their number has stagnated.
        let active = &mut self.fields.active;
        let violating = active.find_matches(is_violating);
        let first = if self.stagnation.allows_block_updates() {
            0
        } else {
            violating.last
        };
        self.stagnation.record(violating.count, false);
        active.toggle(|element, inside| element >= first && is_violating(element, inside));

        // Clear the fields on the elements that have left; the runs are still those of the previous set.
        let (active, scattered) = (&self.fields.active, &mut self.fields.scattered);
        let row_blocks = active.row_blocks;
        row_blocks.for_each([&mut *self.load, scattered], |row_block, fields| {
            let first = row_blocks.elements(row_block).start;
            for field in fields {
                for element in active.runs(row_block).iter().flat_map(Run::elements) {
                    if !active.contains(element) {
                        field[element - first] = 0.0;
                    }
                }
            }
        });

        // Restart the conjugate gradients from the remaining load, scaled to the given force, with a displacement computed anew.
        self.gather_active();
        self.has_stepped = false;
        self.scale_to_force();
        self.recompute_displacement();
    }

    /// One step of the conjugate gradients on the active set: z = S r, direction p, step length (r, z)/(p, K p).
    ///
    /// At a given force z loses its mean, so that the directions have the sum zero and the steps leave the force unchanged.
    fn conjugate_gradient_step(&mut self) {
        let fields = &mut *self.fields;
        let (active, preconditioner) = (&fields.active, &mut fields.preconditioner);
        let (scattered, vectors) = (&mut fields.scattered, &mut fields.vectors);
        let (direction, output) = (&mut vectors.direction, &mut vectors.operator_output);
        let residual = &vectors.residual;

        // Precondition the residual; direction and output are free on a new set, whose first direction has no predecessor.
        if !self.has_stepped {
            preconditioner.prepare(active, scattered, direction, output);
        }
        preconditioner.apply(active, residual, scattered, output);
        let preconditioned = &*output;

        // Compute the inner product (r, z) of the residual r and of z = S r without its mean.
        let sums_in_row_block = |row_block| {
            let [r, z] =
                [residual, preconditioned].map(|vector| &vector[active.packed_range(row_block)]);
            [
                sum([r], |[r]| r),
                sum([z], |[z]| z),
                sum([r, z], |[r, z]| r * z),
            ]
        };
        let add = |left: [f64; 3], right: [f64; 3]| [0, 1, 2].map(|k| left[k] + right[k]);
        let [sum_r, sum_z, sum_rz] = active.row_blocks.gather(sums_in_row_block, add);
        let mean = match self.control {
            Control::NormalForce(_) => sum_z / active.len() as f64,
            Control::IndentationDepth(_) => 0.0,
        };
        let product = sum_rz - mean * sum_r;

        // Form the conjugate direction p = z + β p, packed and on the grid. The factor β is the ratio of (r, z) to its value in
        // the previous step (Fletcher & Reeves).
        let conjugation = if self.previous_product > 0.0 {
            product / self.previous_product
        } else {
            0.0
        };
        let targets = [active.field(scattered), active.packed(direction)];
        active
            .row_blocks
            .for_each_part(targets, |row_block, [scattered, direction]| {
                let values = &preconditioned[active.packed_range(row_block)];
                for (direction, value) in direction.iter_mut().zip(values) {
                    *direction = value - mean + conjugation * *direction;
                }
                active.scatter_in(row_block, direction, scattered);
            });
        self.previous_product = product;

        // Apply the operator, and go to the minimum of the energy along the direction.
        let image = &mut fields.direction_displacement;
        self.convolution.apply(self.workspace, scattered, image);
        let direction = &vectors.direction;
        let energy = active.row_blocks.fold(
            [active.packed(&mut vectors.operator_output)],
            |row_block, [output]| {
                active.gather_in(row_block, image, output);
                sum(
                    [&direction[active.packed_range(row_block)], output],
                    |[a, b]| a * b,
                )
            },
            |left, right| left + right,
        );
        // The energy is zero for a single element at a given force, whose load is the force already.
        let length = if energy == 0.0 {
            0.0
        } else {
            self.previous_product / energy
        };
        self.advance(length);
    }

    /// Finds the runs of the active set and gathers separation and load on it.
    fn gather_active(&mut self) {
        let (active, vectors) = (&mut self.fields.active, &mut self.fields.vectors);
        active.find_runs();
        vectors.restrict_to(active, self.separation, self.load);
    }

    /// Scales the packed load so that its sum is the prescribed force; at a given depth nothing changes.
    fn scale_to_force(&mut self) {
        let Control::NormalForce(total) = self.control else {
            return;
        };
        let sum = self.total_load();
        let (active, vectors) = (&mut self.fields.active, &mut self.fields.vectors);
        let load = [active.packed(&mut vectors.load)];
        active.row_blocks.for_each_part(load, |_, [load]| {
            for load in load {
                // The given force is multiplied last, because the quotient of extreme forces may overflow.
                *load = if sum > 0.0 { *load / sum * total } else { 0.0 };
            }
        });
    }

    /// Sum of the loads x on the active set, without unit.
    fn total_load(&self) -> f64 {
        let (active, vectors) = (&self.fields.active, &self.fields.vectors);
        active.sum(|range| sum([&vectors.load[range]], |[load]| load))
    }

    /// Writes the packed load into the field of the grid.
    fn scatter_load(&mut self) {
        let (active, vectors) = (&self.fields.active, &self.fields.vectors);
        active.scatter(&vectors.load, self.load);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ContactOptions, Grid};

    /// Iterations from a uniform load on a Hertz contact and on many patches of many sizes under a periodic load.
    fn iterations(weights: PreconditionerParameters) -> Result<[usize; 2], BemError> {
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
            let mut state = LoadState::new(n * n);
            state.fields = Some(Box::new(Fields::new(&convolution, weights)));
            let criterion = StoppingCriterion::from(&ContactOptions::default());
            let solved = Iteration::new(problem, &mut state).run(&criterion)?;
            *count = solved.iterations;
        }
        Ok(counts)
    }

    #[test]
    fn any_positive_parameters_converge_and_those_near_the_default_as_soon() -> Result<(), BemError>
    {
        let default = iterations(PreconditionerParameters::DEFAULT)?;
        let usual = PreconditionerParameters::DEFAULT;
        let weights =
            [0.01, 0.5, 0.6, 0.8, 0.9, 10.0].map(|weight| [weight, usual.excess_fraction]);
        let fractions =
            [0.001, 0.2, 0.4, 0.5, 3.0].map(|fraction| [usual.neighbour_weight, fraction]);
        for [neighbour_weight, excess_fraction] in weights.into_iter().chain(fractions) {
            let parameters = PreconditionerParameters {
                neighbour_weight,
                excess_fraction,
            };
            let is_near =
                (0.5..=0.9).contains(&neighbour_weight) && (0.2..=0.5).contains(&excess_fraction);
            let most = if is_near { 1.15 } else { 4.0 };
            let actual = iterations(parameters)?;
            let holds = |index: usize| actual[index] as f64 <= most * default[index] as f64;
            assert!(
                holds(0) && holds(1),
                "{parameters:?}: {actual:?}, {default:?}"
            );
        }
        Ok(())
    }
}
