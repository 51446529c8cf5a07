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
use crate::contact::{Accuracy, ContactState, Control, Outcome, Question};
use crate::{BemError, Convolution, ConvolutionWorkspace, Grid};

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
    fn new(grid: &Grid) -> Self {
        let n = grid.n_elements();
        Self {
            preconditioner: Preconditioner::new(grid),
            contact: ContactSet::new(grid.shape()),
            residual: vec![0.0; n],
            direction: vec![0.0; n],
            image: vec![0.0; n],
        }
    }
}

/// How far the conditions of contact are violated, as lengths.
#[derive(Debug, Clone, Copy, Default)]
struct Violations {
    /// Largest |gap| in the contact.
    gap: f64,
    /// Largest tension in the contact, as the displacement that it causes at its own element.
    tension: f64,
    /// Largest penetration outside the contact.
    penetration: f64,
    /// Largest displacement in the contact.
    deflection: f64,
}

impl Violations {
    /// The largest relative to the deflection; zero where there is neither, NaN where numbers overflow.
    fn relative(&self) -> f64 {
        let largest = self.gap.max(self.tension).max(self.penetration);
        if self.gap.is_nan() {
            f64::NAN
        } else if largest == 0.0 {
            0.0
        } else {
            largest / self.deflection
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
            workspace: &mut state.workspace,
            fields: state
                .fields
                .get_or_insert_with(|| Box::new(Fields::new(convolution.grid()))),
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
            total_load: self.load.iter().sum(),
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
        for (load, separation) in self.load.iter_mut().zip(self.separation) {
            let guessed = *load > 0.0 && separation.is_finite();
            *load = if guessed { *load } else { 0.0 };
        }
        let (load, separation) = (&*self.load, self.separation);
        let fields = &mut *self.fields;
        fields.contact.assign(|element| {
            !vanishes && (load[element] > 0.0 || (!loaded && separation[element] < below))
        });
        if !loaded {
            for element in fields.contact.elements() {
                self.load[element] = uniform;
            }
        }
        fields.residual.fill(0.0);
        fields.direction.fill(0.0);
        self.match_force();
        self.refresh();
    }

    /// Scales the load to the prescribed force.
    fn match_force(&mut self) {
        let Control::NormalForce(total) = self.control else {
            return;
        };
        let sum: f64 = self.load.iter().sum();
        for load in &mut *self.load {
            // Multiplied last, because the quotient of extreme forces may overflow.
            *load = if sum > 0.0 { *load / sum * total } else { 0.0 };
        }
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
        let height = |element: usize| self.separation[element] + self.displacement[element];
        self.indentation_depth = match self.control {
            Control::IndentationDepth(depth) => depth,
            Control::NormalForce(_) if contact.len() == 0 => {
                let heights = self.separation.iter().copied();
                heights.fold(f64::INFINITY, f64::min)
            }
            Control::NormalForce(_) => {
                let mean_above = |level: f64| {
                    let heights = contact.elements().map(|element| height(element) - level);
                    heights.sum::<f64>() / contact.len() as f64
                };
                // Again from the first mean, because no direction removes what the long sum has rounded.
                let mean = mean_above(0.0);
                mean + mean_above(mean)
            }
        };
    }

    /// Stores the residual of the linear equations, the gap in the contact, and finds what is violated.
    fn measure(&mut self) -> Violations {
        let unit = self.convolution.self_influence();
        let mut found = Violations::default();
        let mut not_a_number = false;
        let Fields {
            contact, residual, ..
        } = &mut *self.fields;
        contact.elements().for_each(|element| {
            let (load, displacement) = (self.load[element], self.displacement[element]);
            let gap = self.separation[element] + displacement - self.indentation_depth;
            not_a_number |= gap.is_nan();
            residual[element] = -gap;
            found.gap = larger(found.gap, gap.abs());
            found.tension = larger(found.tension, -load * unit);
            found.deflection = larger(found.deflection, larger(displacement, load * unit));
        });
        if not_a_number {
            found.gap = f64::NAN;
        }
        found.penetration = larger(0.0, self.indentation_depth - self.lowest_outside());
        found
    }

    fn lowest_outside(&self) -> f64 {
        let ranges = self.fields.contact.outside();
        let lowest = ranges
            .map(|range| lowest_sum(&self.separation[range.clone()], &self.displacement[range]));
        lowest.fold(f64::INFINITY, f64::min)
    }

    /// Whether the element is under tension, or outside and below the height at which it penetrates.
    fn is_wrong(&self, element: usize, lowest: f64) -> bool {
        if self.fields.contact.contains(element) {
            return self.load[element] < 0.0;
        }
        self.separation[element] + self.displacement[element] < lowest
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
        let is_wrong = |&element: &usize| self.is_wrong(element, lowest);
        let n_wrong = (0..self.load.len()).filter(is_wrong).count();
        if n_wrong < self.fewest_wrong {
            self.fewest_wrong = n_wrong;
            self.patience = PATIENCE;
        } else {
            self.patience = self.patience.saturating_sub(1);
        }
        let mut left = if self.patience == 0 { 1 } else { n_wrong };
        for element in (0..self.load.len()).rev() {
            if left > 0 && self.is_wrong(element, lowest) {
                left -= 1;
                let fields = &mut *self.fields;
                fields.contact.flip(element);
                (fields.residual[element], fields.direction[element]) = (0.0, 0.0);
                self.load[element] = 0.0;
            }
        }
        self.fields.contact.find_runs();
        self.improved = false;
        self.match_force();
        self.refresh();
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
        let energy: f64 = contact.elements().map(|k| direction[k] * image[k]).sum();
        // The load of a single element has nowhere to go.
        let length = if energy == 0.0 {
            0.0
        } else {
            self.previous_product / energy
        };
        contact
            .elements()
            .for_each(|k| self.load[k] += length * direction[k]);
        for (displacement, image) in self.displacement.iter_mut().zip(&*image) {
            *displacement += length * image;
        }
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
        preconditioner.apply(contact, residual, preconditioned);
        let mean = match self.control {
            Control::NormalForce(_) => {
                contact.elements().map(|k| preconditioned[k]).sum::<f64>() / contact.len() as f64
            }
            Control::IndentationDepth(_) => 0.0,
        };
        let work = |k: usize| residual[k] * (preconditioned[k] - mean);
        let product: f64 = contact.elements().map(work).sum();
        let conjugation = if self.previous_product > 0.0 {
            product / self.previous_product
        } else {
            0.0
        };
        contact.elements().for_each(|k| {
            direction[k] = preconditioned[k] - mean + conjugation * direction[k];
        });
        self.previous_product = product;
    }
}

/// The larger of two numbers of which none is NaN; faster than `f64::max`.
fn larger(left: f64, right: f64) -> f64 {
    if left > right { left } else { right }
}

/// The lowest sum of two heights each; several at a time, because one comparison would wait for the other.
fn lowest_sum(left: &[f64], right: &[f64]) -> f64 {
    const LANES: usize = 8;
    let (left, left_rest) = left.as_chunks::<LANES>();
    let (right, right_rest) = right.as_chunks::<LANES>();
    let mut lowest = [f64::INFINITY; LANES];
    for (left, right) in left.iter().zip(right) {
        for lane in 0..LANES {
            let sum = left[lane] + right[lane];
            lowest[lane] = if sum < lowest[lane] {
                sum
            } else {
                lowest[lane]
            };
        }
    }
    let rest = left_rest.iter().zip(right_rest).map(|(a, b)| a + b);
    lowest.into_iter().chain(rest).fold(f64::INFINITY, f64::min)
}
