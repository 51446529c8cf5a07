//! Preconditioned conjugate gradients on a contact set that follows the solution.
//!
//! On a given set of elements in contact the load solves linear equations, whose matrix is a part of the convolution;
//! the same part of an approximate inverse preconditions it, so that the number of iterations hardly depends on the
//! grid. The set changes when its violations, tension inside and penetration outside, outweigh what is
//! left of the linear equations: all violating elements change sides at once (a primal-dual active set, Hintermüller,
//! Ito & Kunisch 2003, DOI 10.1137/S1052623401383558). Such a method ends on all but contrived problems; where the
//! number of violations does not fall, only the last of them changes sides, after an accurate solution, which ends
//! always (Júdice & Pires 1994, DOI 10.1016/0305-0548(94)90106-6).

use crate::contact::contact_set::ContactSet;
use crate::contact::preconditioner::Preconditioner;
use crate::contact::violations::{Surface, Violations};
use crate::contact::{Accuracy, ContactState, Control, Outcome, Question};
use crate::{BemError, Convolution, ConvolutionWorkspace};

/// Changes of the set without fewer violations than ever before, after which one element at a time changes.
const PATIENCE: usize = 10;

/// The contact changes when its violations are this many times the gaps inside.
const PRIORITY: f64 = 2.0;

/// Buffers beside the load and its displacement.
#[derive(Debug, Clone)]
pub(super) struct Fields {
    preconditioner: Preconditioner,
    contact: ContactSet,
    /// Minus the gap in the contact, zero outside.
    residual: Vec<f64>,
    /// Zero outside the contact.
    direction: Vec<f64>,
    image: Vec<f64>,
}

impl Fields {
    fn new(convolution: &Convolution) -> Self {
        let grid = convolution.grid();
        let n = grid.n_elements();
        Self {
            preconditioner: Preconditioner::new(convolution),
            contact: ContactSet::new(grid.shape()),
            residual: vec![0.0; n],
            direction: vec![0.0; n],
            image: vec![0.0; n],
        }
    }
}

pub(super) struct Iteration<'a> {
    convolution: &'a Convolution,
    separation: &'a [f64],
    control: Control,
    tolerance: f64,
    load: &'a mut [f64],
    displacement: &'a mut [f64],
    workspace: &'a mut ConvolutionWorkspace,
    fields: &'a mut Fields,
    indentation_depth: f64,
    /// Residual times preconditioned residual in the previous iteration; 0 starts a new set of directions.
    previous_product: f64,
    /// Whether the displacement was computed from the load, and not updated along a direction.
    fresh: bool,
    /// Whether the load has been improved on the present contact set.
    improved: bool,
    fewest_wrong: usize,
    patience: usize,
}

impl<'a> Iteration<'a> {
    pub(super) fn new(
        (convolution, separation, control): Question<'a>,
        state: &'a mut ContactState,
    ) -> Self {
        Self {
            convolution,
            separation,
            control,
            tolerance: 0.0,
            load: &mut state.load,
            displacement: &mut state.displacement,
            workspace: state
                .workspace
                .get_or_insert_with(|| convolution.workspace()),
            fields: state
                .fields
                .get_or_insert_with(|| Box::new(Fields::new(convolution))),
            indentation_depth: 0.0,
            previous_product: 0.0,
            fresh: false,
            improved: false,
            fewest_wrong: usize::MAX,
            patience: PATIENCE,
        }
    }

    pub(super) fn run(mut self, accuracy: &Accuracy) -> Result<Outcome, BemError> {
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
                    return Ok(self.outcome(iterations, &violations));
                }
                self.refresh();
                continue;
            }
            // Where numbers overflow there is no way on.
            if iterations >= accuracy.max_iterations || residual.is_nan() {
                let residual = Some(residual).filter(|residual| !residual.is_nan());
                return Err(BemError::ContactNotConverged {
                    iterations,
                    residual: residual.unwrap_or(f64::INFINITY),
                    tolerance: self.tolerance,
                });
            }
            if self.set_is_due(&violations) {
                self.change_contact(&violations);
            } else {
                self.step();
            }
            iterations += 1;
        }
    }

    fn outcome(&self, iterations: usize, violations: &Violations) -> Outcome {
        Outcome {
            indentation_depth: self.indentation_depth,
            total_load: self.total_load(),
            iterations,
            deflection: violations.deflection,
            residual: violations.relative(),
        }
    }

    /// Takes the contact from the first guess; without one, from what lies below the given depth, or everywhere.
    fn start(&mut self) {
        let loaded = self.load.iter().any(|load| *load > 0.0);
        let (below, uniform) = match self.control {
            Control::NormalForce(_) => (f64::INFINITY, 1.0),
            Control::IndentationDepth(depth) => (depth, 0.0),
        };
        let vanishes = self.control == Control::NormalForce(0.0);
        let fields = &mut *self.fields;
        let (separation, bands) = (self.separation, fields.contact.bands());
        let cleared = [&mut *self.load, &mut fields.residual, &mut fields.direction];
        bands.for_each(cleared, |band, [load, residual, direction]| {
            residual.fill(0.0);
            direction.fill(0.0);
            for (load, separation) in load.iter_mut().zip(&separation[bands.elements(band)]) {
                let guessed = *load > 0.0 && separation.is_finite();
                *load = if guessed { *load } else { 0.0 };
            }
        });
        let load = &*self.load;
        fields.contact.assign(|element| {
            !vanishes && (load[element] > 0.0 || (!loaded && separation[element] < below))
        });
        if !loaded {
            for (element, load) in self.load.iter_mut().enumerate() {
                let inside = fields.contact.contains(element);
                *load = if inside { uniform } else { 0.0 };
            }
        }
        self.match_force();
        self.refresh();
    }

    /// Scales the load to the prescribed force.
    fn match_force(&mut self) {
        let Control::NormalForce(total) = self.control else {
            return;
        };
        let sum = self.total_load();
        let bands = self.fields.contact.bands();
        bands.for_each([&mut *self.load], |_, [load]| {
            for load in load {
                // Multiplied last, because the quotient of extreme forces may overflow.
                *load = if sum > 0.0 { *load / sum * total } else { 0.0 };
            }
        });
    }

    fn total_load(&self) -> f64 {
        let bands = self.fields.contact.bands();
        bands.sum(|band| self.load[bands.elements(band)].iter().sum())
    }

    /// Computes the displacement from the load.
    fn refresh(&mut self) {
        let rows = self.convolution.grid().shape()[0];
        let (load, displacement) = (&self.load[..], &mut self.displacement[..]);
        self.convolution
            .apply(self.workspace, (load, 0..rows), (displacement, 0..rows));
        self.fresh = true;
        self.previous_product = 0.0;
    }

    /// At a given force the depth is the mean height of the contact, so that the gaps there have the mean zero.
    fn find_depth(&mut self) {
        let contact = &self.fields.contact;
        self.indentation_depth = match self.control {
            Control::IndentationDepth(depth) => depth,
            Control::NormalForce(_) if contact.len() == 0 => {
                let heights = self.separation.iter().copied();
                heights.fold(f64::INFINITY, f64::min)
            }
            Control::NormalForce(_) => {
                let height = |element: usize| self.separation[element] + self.displacement[element];
                let mean_above = |level: f64| {
                    let sum = contact.sum(|run| run.map(|element| height(element) - level).sum());
                    sum / contact.len() as f64
                };
                // Again from the first mean, because no direction removes what the long sum has rounded.
                let mean = mean_above(0.0);
                mean + mean_above(mean)
            }
        };
    }

    fn measure(&mut self) -> Violations {
        let surface = Surface {
            separation: self.separation,
            displacement: self.displacement,
            load: self.load,
            indentation_depth: self.indentation_depth,
            self_influence: self.convolution.self_influence(),
        };
        surface.measure(&self.fields.contact, &mut self.fields.residual)
    }

    fn set_is_due(&self, violations: &Violations) -> bool {
        let allowed = self.tolerance * violations.deflection;
        if violations.tension <= 0.0 && violations.penetration <= allowed {
            return false;
        }
        let worst = violations.tension.max(violations.penetration);
        let outweighed = worst >= PRIORITY * violations.gap;
        violations.gap <= allowed || (self.patience > 0 && self.improved && outweighed)
    }

    fn change_contact(&mut self, violations: &Violations) {
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
        contact.change(|element, inside| element >= first && is_wrong(element, inside));
        self.unload_left();
        self.fields.contact.find_runs();
        self.improved = false;
        self.match_force();
        self.refresh();
    }

    /// Clears what has just left the contact, while the runs are still those before.
    fn unload_left(&mut self) {
        let Fields {
            contact,
            residual,
            direction,
            ..
        } = &mut *self.fields;
        let bands = contact.bands();
        bands.for_each([&mut *self.load, residual, direction], |band, fields| {
            let first = bands.elements(band).start;
            for field in fields {
                for element in contact.runs(band).iter().flat_map(Clone::clone) {
                    if !contact.contains(element) {
                        field[element - first] = 0.0;
                    }
                }
            }
        });
    }

    /// Moves the load along a direction conjugate to the previous ones to where the residual does no work.
    fn step(&mut self) {
        self.find_direction();
        let rows = self.convolution.grid().shape()[0];
        let Fields {
            contact,
            direction,
            image,
            ..
        } = &mut *self.fields;
        self.convolution
            .apply(self.workspace, (direction, 0..rows), (image, 0..rows));
        let (direction, image) = (&*direction, &*image);
        let energy = contact.sum(|run| dot(&direction[run.clone()], &image[run]));
        // The load of a single element has nowhere to go.
        let length = if energy == 0.0 {
            0.0
        } else {
            self.previous_product / energy
        };
        let bands = contact.bands();
        let fields = [&mut *self.load, &mut *self.displacement];
        bands.for_each(fields, |band, [load, displacement]| {
            let elements = bands.elements(band);
            for run in contact.runs(band) {
                let local = run.start - elements.start..run.end - elements.start;
                add(&mut load[local], length, &direction[run.clone()]);
            }
            add(displacement, length, &image[elements]);
        });
        self.fresh = false;
        self.improved = true;
    }

    fn find_direction(&mut self) {
        let Fields {
            preconditioner,
            contact,
            residual,
            direction,
            image: preconditioned,
        } = &mut *self.fields;
        if !self.improved {
            // The first direction on a contact is not conjugate to any before.
            preconditioner.prepare(contact, [direction, preconditioned]);
        }
        preconditioner.apply(contact, residual, preconditioned);
        let (residual, preconditioned) = (&*residual, &*preconditioned);
        let mean = match self.control {
            Control::NormalForce(_) => {
                contact.sum(|run| preconditioned[run].iter().sum()) / contact.len() as f64
            }
            Control::IndentationDepth(_) => 0.0,
        };
        let work = |k: usize| residual[k] * (preconditioned[k] - mean);
        let product = contact.sum(|run| run.map(work).sum());
        let conjugation = if self.previous_product > 0.0 {
            product / self.previous_product
        } else {
            0.0
        };
        let bands = contact.bands();
        bands.for_each([direction], |band, [direction]| {
            let first = bands.elements(band).start;
            for run in contact.runs(band) {
                let local = run.start - first..run.end - first;
                for (direction, value) in direction[local]
                    .iter_mut()
                    .zip(&preconditioned[run.clone()])
                {
                    *direction = value - mean + conjugation * *direction;
                }
            }
        });
        self.previous_product = product;
    }
}

fn dot(left: &[f64], right: &[f64]) -> f64 {
    left.iter().zip(right).map(|(a, b)| a * b).sum()
}

/// Adds a multiple.
fn add(sum: &mut [f64], factor: f64, values: &[f64]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += factor * value;
    }
}
