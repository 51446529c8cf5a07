//! Projected conjugate gradients on the contact, for the load x = α P / (4π).

use crate::contact::{ContactOptions, ContactProblem, ContactState, Control};
use crate::{BemError, Convolution, influence};

/// What the iteration found beside the load.
pub(super) struct Outcome {
    pub(super) indentation_depth: f64,
    pub(super) total_load: f64,
    pub(super) iterations: usize,
    pub(super) residual: f64,
}

pub(super) struct Iteration<'a> {
    convolution: &'a Convolution,
    separation: &'a [f64],
    control: Control,
    state: &'a mut ContactState,
    /// Displacement of an element under its own unit load, \[m].
    self_influence: f64,
    indentation_depth: f64,
    /// Squared norm of the gap over the contact in the previous iteration; 0 starts a new set of directions.
    previous_norm: f64,
    /// Whether the displacement was computed from the load, and not updated along a direction.
    fresh: bool,
}

impl<'a> Iteration<'a> {
    pub(super) fn new(
        problem: &ContactProblem<'a>,
        control: Control,
        state: &'a mut ContactState,
    ) -> Self {
        Self {
            convolution: problem.convolution,
            separation: problem.separation,
            control,
            state,
            self_influence: influence([0.0, 0.0], problem.convolution.grid().spacing()),
            indentation_depth: 0.0,
            previous_norm: 0.0,
            fresh: false,
        }
    }

    pub(super) fn run(mut self, options: &ContactOptions) -> Result<Outcome, BemError> {
        self.start();
        let mut iterations = 0;
        loop {
            self.find_contact();
            let residual = self.residual();
            if residual <= options.tolerance {
                if self.fresh {
                    return Ok(self.outcome(iterations, residual));
                }
                self.refresh();
                continue;
            }
            // Where numbers overflow there is no way on.
            if iterations >= options.max_iterations || residual.is_nan() {
                let residual = if residual.is_nan() {
                    f64::INFINITY
                } else {
                    residual
                };
                let tolerance = options.tolerance;
                return Err(BemError::ContactNotConverged {
                    iterations,
                    residual,
                    tolerance,
                });
            }
            self.find_penetrating(options.tolerance);
            self.step();
            iterations += 1;
        }
    }

    fn outcome(&self, iterations: usize, residual: f64) -> Outcome {
        let total_load = self.state.load.iter().sum();
        Outcome {
            indentation_depth: self.indentation_depth,
            total_load,
            iterations,
            residual,
        }
    }

    /// Makes the first guess admissible: no tension, no load where there is no body, the right total.
    fn start(&mut self) {
        for (load, separation) in self.state.load.iter_mut().zip(self.separation) {
            if separation.is_infinite() || *load < 0.0 {
                *load = 0.0;
            }
        }
        self.match_total();
        self.refresh();
    }

    /// Scales the load to the prescribed force; without any load the lowest element carries it.
    fn match_total(&mut self) {
        let Control::NormalForce(total) = self.control else {
            return;
        };
        let sum: f64 = self.state.load.iter().sum();
        if sum > 0.0 {
            self.state.scale_load(total / sum);
            return;
        }
        let by_height = |a: &usize, b: &usize| self.separation[*a].total_cmp(&self.separation[*b]);
        if let Some(lowest) = (0..self.separation.len()).min_by(by_height) {
            self.state.load[lowest] = total;
        }
    }

    /// Computes the displacement from the load.
    fn refresh(&mut self) {
        let rows = self.convolution.grid().shape()[0];
        let ContactState {
            load,
            displacement,
            workspace,
            ..
        } = &mut *self.state;
        self.convolution
            .apply(workspace, (load, 0..rows), (displacement, 0..rows));
        self.fresh = true;
    }

    fn height(&self, element: usize) -> f64 {
        self.separation[element] + self.state.displacement[element]
    }

    fn gap(&self, element: usize) -> f64 {
        self.height(element) - self.indentation_depth
    }

    /// Lists the loaded elements and takes the depth from them, or as prescribed.
    fn find_contact(&mut self) {
        let ContactState { load, contact, .. } = &mut *self.state;
        contact.clear();
        contact.extend((0..load.len()).filter(|&element| load[element] > 0.0));
        self.indentation_depth = match self.control {
            Control::IndentationDepth(depth) => depth,
            Control::NormalForce(_) if self.state.contact.is_empty() => self
                .separation
                .iter()
                .copied()
                .fold(f64::INFINITY, f64::min),
            Control::NormalForce(_) => self.mean_over_contact(|element| self.height(element)),
        };
    }

    fn mean_over_contact(&self, value: impl Fn(usize) -> f64) -> f64 {
        let sum: f64 = self
            .state
            .contact
            .iter()
            .map(|&element| value(element))
            .sum();
        sum / self.state.contact.len() as f64
    }

    /// Largest violation of the contact conditions relative to the largest displacement.
    fn residual(&self) -> f64 {
        let scale = self.deflection();
        let mut violation: f64 = 0.0;
        for element in 0..self.state.load.len() {
            let gap = self.gap(element);
            if gap.is_nan() {
                return f64::NAN;
            }
            violation = violation.max(if self.state.load[element] > 0.0 {
                gap.abs()
            } else {
                -gap
            });
        }
        // Without load there is nothing to compare with, and any penetration is too much.
        if violation == 0.0 {
            0.0
        } else {
            violation / scale
        }
    }

    fn deflection(&self) -> f64 {
        self.state
            .contact
            .iter()
            .map(|&element| self.state.displacement[element])
            .fold(0.0, f64::max)
    }

    /// Lists the elements outside the contact that penetrate by more than the tolerance.
    fn find_penetrating(&mut self, tolerance: f64) {
        let allowed = -tolerance * self.deflection();
        let mut penetrating = std::mem::take(&mut self.state.penetrating);
        penetrating.clear();
        penetrating.extend(
            (0..self.separation.len())
                .filter(|&element| self.state.load[element] == 0.0 && self.gap(element) < allowed),
        );
        self.state.penetrating = penetrating;
    }

    fn step(&mut self) {
        self.find_direction();
        let length = self.step_length();
        let lost = self.move_along_direction(length);
        let gained = !self.state.penetrating.is_empty();
        if gained {
            self.load_penetrating(length);
            self.previous_norm = 0.0;
        }
        if lost || gained {
            self.match_total();
            self.refresh();
        }
    }

    /// Gap on the contact, conjugate to the previous direction; zero outside.
    fn find_direction(&mut self) {
        let norm: f64 = self
            .state
            .contact
            .iter()
            .map(|&element| self.gap(element).powi(2))
            .sum();
        let conjugation = if self.previous_norm > 0.0 {
            norm / self.previous_norm
        } else {
            0.0
        };
        self.previous_norm = norm;
        for element in 0..self.separation.len() {
            let in_contact = self.state.load[element] > 0.0;
            let gap = if in_contact { self.gap(element) } else { 0.0 };
            let direction = &mut self.state.direction[element];
            *direction = if in_contact {
                gap + conjugation * *direction
            } else {
                0.0
            };
        }
        if let Control::NormalForce(_) = self.control {
            self.balance_direction();
        }
    }

    /// Keeps the total load: elements that left the contact have taken their part of the old direction with them.
    fn balance_direction(&mut self) {
        let mean = self.mean_over_contact(|element| self.state.direction[element]);
        let ContactState {
            direction, contact, ..
        } = &mut *self.state;
        for &element in contact.iter() {
            direction[element] -= mean;
        }
    }

    /// Length of the step to the minimum along the direction; at constant force a common shift of all gaps does no
    /// work.
    fn step_length(&mut self) -> f64 {
        let rows = self.convolution.grid().shape()[0];
        let ContactState {
            direction,
            image,
            workspace,
            ..
        } = &mut *self.state;
        self.convolution
            .apply(workspace, (direction, 0..rows), (image, 0..rows));
        let shift = match self.control {
            Control::NormalForce(_) => self.mean_over_contact(|element| self.state.image[element]),
            Control::IndentationDepth(_) => 0.0,
        };
        let (mut work, mut energy) = (0.0, 0.0);
        for &element in &self.state.contact {
            let direction = self.state.direction[element];
            work += self.gap(element) * direction;
            energy += (self.state.image[element] - shift) * direction;
        }
        // A single element, or none, has no direction: then an element alone sets the scale.
        if energy > 0.0 {
            work / energy
        } else {
            1.0 / self.self_influence
        }
    }

    /// Returns whether elements under tension left the contact.
    fn move_along_direction(&mut self, length: f64) -> bool {
        let mut lost = false;
        let ContactState {
            load,
            direction,
            contact,
            ..
        } = &mut *self.state;
        for &element in contact.iter() {
            load[element] -= length * direction[element];
            if load[element] <= 0.0 {
                load[element] = 0.0;
                lost = true;
            }
        }
        let ContactState {
            displacement,
            image,
            ..
        } = &mut *self.state;
        for (displacement, image) in displacement.iter_mut().zip(image.iter()) {
            *displacement -= length * image;
        }
        self.fresh = false;
        lost
    }

    fn load_penetrating(&mut self, length: f64) {
        let penetrating = std::mem::take(&mut self.state.penetrating);
        for &element in &penetrating {
            // The gap of before the step decided that the element penetrates.
            let gap = self.gap(element) + length * self.state.image[element];
            self.state.load[element] = -length * gap;
        }
        self.state.penetrating = penetrating;
    }
}
