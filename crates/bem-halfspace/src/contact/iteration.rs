//! Preconditioned conjugate gradients on a contact set that follows the solution.
//!
//! On a given set of elements in contact the load solves linear equations, whose matrix is a part of the convolution;
//! the same part of the approximate inverse, `|q|/(2π)`, preconditions it, so that the number of iterations hardly
//! depends on the grid. The set changes when its violations, tension inside and penetration outside, outweigh what is
//! left of the linear equations: all violating elements change sides at once (a primal-dual active set, Hintermüller,
//! Ito & Kunisch 2003, DOI 10.1137/S1052623401383558). Such a method ends on all but contrived problems; where the
//! number of violations does not fall, only the last of them changes sides, after an accurate solution, which ends
//! always (Júdice & Pires 1994, DOI 10.1016/0305-0548(94)90106-6).

use crate::contact::{ContactOptions, ContactState, Control, Outcome, Question};
use crate::{BemError, Convolution, ConvolutionWorkspace};

/// Changes of the set without fewer violations than ever before, after which one element at a time changes.
const PATIENCE: usize = 10;

/// Buffers beside the load and its displacement.
#[derive(Debug, Clone)]
pub(super) struct Fields {
    inverse: Convolution,
    inverse_workspace: ConvolutionWorkspace,
    in_contact: Vec<bool>,
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
}

impl Fields {
    fn new(convolution: &Convolution) -> Self {
        let inverse = Convolution::inverse(convolution.grid());
        let n = convolution.grid().n_elements();
        Self {
            inverse_workspace: inverse.workspace(),
            inverse,
            in_contact: vec![false; n],
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
    /// Number of elements under tension or penetrating by more than the tolerance.
    n_wrong: usize,
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
    n_contact: usize,
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
        options: &ContactOptions,
    ) -> Self {
        Self {
            convolution,
            separation,
            control,
            tolerance: options.tolerance,
            load: &mut state.load,
            displacement: &mut state.displacement,
            workspace: &mut state.workspace,
            fields: state
                .fields
                .get_or_insert_with(|| Box::new(Fields::new(convolution))),
            n_contact: 0,
            indentation_depth: 0.0,
            previous_product: 0.0,
            fresh: false,
            improved: false,
            fewest_wrong: usize::MAX,
            patience: PATIENCE,
        }
    }

    pub(super) fn run(mut self, max_iterations: usize) -> Result<Outcome, BemError> {
        self.start();
        let mut iterations = 0;
        loop {
            self.find_depth();
            let violations = self.measure();
            let residual = violations.relative();
            if residual <= self.tolerance && violations.n_wrong == 0 {
                if self.fresh {
                    return Ok(self.outcome(iterations, &violations));
                }
                self.refresh();
                continue;
            }
            // Where numbers overflow there is no way on.
            if iterations >= max_iterations || residual.is_nan() {
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
        let elements = self.load.iter_mut().zip(self.separation);
        for ((load, separation), in_contact) in elements.zip(&mut self.fields.in_contact) {
            let guessed = *load > 0.0 && separation.is_finite();
            *in_contact = !vanishes && (guessed || (!loaded && *separation < below));
            *load = match (*in_contact, guessed) {
                (true, true) => *load,
                (true, false) => uniform,
                (false, _) => 0.0,
            };
        }
        self.count_contact();
        self.refresh();
    }

    /// Counts the contact and scales its load to the prescribed force.
    fn count_contact(&mut self) {
        self.n_contact = self.fields.in_contact.iter().filter(|is| **is).count();
        if let Control::NormalForce(total) = self.control {
            let sum: f64 = self.load.iter().sum();
            // Divided last, because the quotient of extreme loads may overflow.
            let scaled = |load: f64| if sum > 0.0 { load / sum * total } else { 0.0 };
            self.load.iter_mut().for_each(|load| *load = scaled(*load));
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
        self.indentation_depth = match self.control {
            Control::IndentationDepth(depth) => depth,
            Control::NormalForce(_) if self.n_contact == 0 => {
                let heights = self.separation.iter().copied();
                heights.fold(f64::INFINITY, f64::min)
            }
            Control::NormalForce(_) => {
                let elements = self.separation.iter().zip(&*self.displacement);
                let heights = elements.zip(&self.fields.in_contact);
                let in_contact = heights.filter(|(_, in_contact)| **in_contact);
                let sum: f64 = in_contact.map(|((s, u), _)| s + u).sum();
                sum / self.n_contact as f64
            }
        };
    }

    /// Stores the residual of the linear equations, the gap in the contact, and finds what is violated.
    fn measure(&mut self) -> Violations {
        let unit = self.convolution.self_influence();
        let mut found = Violations::default();
        let mut not_a_number = false;
        let elements = self.separation.iter().zip(&*self.displacement);
        let elements = elements.zip(self.load.iter().zip(&self.fields.in_contact));
        for (((separation, displacement), (load, in_contact)), residual) in
            elements.zip(&mut self.fields.residual)
        {
            let gap = separation + displacement - self.indentation_depth;
            not_a_number |= gap.is_nan();
            if *in_contact {
                *residual = -gap;
                found.gap = found.gap.max(gap.abs());
                found.tension = found.tension.max(-load * unit);
                found.deflection = found.deflection.max(displacement.max(load * unit));
                found.n_wrong += usize::from(*load < 0.0);
            } else {
                *residual = 0.0;
                found.penetration = found.penetration.max(-gap);
            }
        }
        if not_a_number {
            found.gap = f64::NAN;
        } else if found.penetration > self.tolerance * found.deflection {
            let is_wrong = |&element: &usize| self.is_wrong(element, &found);
            found.n_wrong = (0..self.load.len()).filter(is_wrong).count();
        }
        found
    }

    /// Whether the element is under tension, or outside and penetrating by more than the tolerance.
    fn is_wrong(&self, element: usize, violations: &Violations) -> bool {
        if self.fields.in_contact[element] {
            return self.load[element] < 0.0;
        }
        let height = self.separation[element] + self.displacement[element];
        height - self.indentation_depth < -self.tolerance * violations.deflection
    }

    fn set_is_due(&self, violations: &Violations) -> bool {
        if violations.n_wrong == 0 {
            return false;
        }
        let solved = violations.gap <= self.tolerance * violations.deflection;
        let outweighed = violations.tension.max(violations.penetration) >= violations.gap;
        solved || (self.patience > 0 && self.improved && outweighed)
    }

    fn change_contact(&mut self, violations: &Violations) {
        if violations.n_wrong < self.fewest_wrong {
            self.fewest_wrong = violations.n_wrong;
            self.patience = PATIENCE;
        } else {
            self.patience = self.patience.saturating_sub(1);
        }
        for element in (0..self.load.len()).rev() {
            if self.is_wrong(element, violations) {
                self.fields.in_contact[element] ^= true;
                self.load[element] = 0.0;
                if self.patience == 0 {
                    break;
                }
            }
        }
        self.improved = false;
        self.count_contact();
        self.refresh();
    }

    /// Moves the load along a direction conjugate to the previous ones to where the residual does no work.
    fn step(&mut self) {
        self.find_direction();
        let rows = self.convolution.grid().shape()[0];
        let Fields {
            direction, image, ..
        } = &mut *self.fields;
        self.convolution
            .apply(self.workspace, (direction, 0..rows), (image, 0..rows));
        let energy = dot(direction, image);
        // The load of a single element has nowhere to go.
        let length = if energy == 0.0 {
            0.0
        } else {
            self.previous_product / energy
        };
        add_multiple(self.load, length, direction);
        add_multiple(self.displacement, length, image);
        self.fresh = false;
        self.improved = true;
    }

    fn find_direction(&mut self) {
        let rows = self.convolution.grid().shape()[0];
        let Fields {
            inverse,
            inverse_workspace,
            in_contact,
            residual,
            direction,
            image,
        } = &mut *self.fields;
        inverse.apply(inverse_workspace, (residual, 0..rows), (image, 0..rows));
        let preconditioned = image;
        for (value, in_contact) in preconditioned.iter_mut().zip(&*in_contact) {
            *value = if *in_contact { *value } else { 0.0 };
        }
        if let Control::NormalForce(_) = self.control {
            let mean = preconditioned.iter().sum::<f64>() / self.n_contact as f64;
            for (value, in_contact) in preconditioned.iter_mut().zip(&*in_contact) {
                *value -= if *in_contact { mean } else { 0.0 };
            }
        }
        let product = dot(residual, preconditioned);
        let conjugation = if self.previous_product > 0.0 {
            product / self.previous_product
        } else {
            0.0
        };
        for (direction, value) in direction.iter_mut().zip(&*preconditioned) {
            *direction = conjugation.mul_add(*direction, *value);
        }
        self.previous_product = product;
    }
}

fn dot(left: &[f64], right: &[f64]) -> f64 {
    left.iter().zip(right).map(|(a, b)| a * b).sum()
}

fn add_multiple(to: &mut [f64], factor: f64, values: &[f64]) {
    for (to, value) in to.iter_mut().zip(values) {
        *to += factor * value;
    }
}
