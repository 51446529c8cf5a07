//! A motion with a given number of elements along the contact.
//!
//! The line is pressed at its first position, and then moves by about one element per step.

use std::cell::{Cell, RefCell};

use indenters::{Control, MotionRecord, MotionStep, MovingLoad, MovingStep, RigidLine};
use rheology::Material;

use super::FOUNDATION_PER_CONTACT;
use super::cycle::find_limit_cycle;
use super::element_means::average_tangential_forces;
use super::winkler::{FoundationStep, Prescribed, SavedRecovery, WinklerFoundation};
use crate::MdrError;
use crate::branches::{Foundation, n_history};
use crate::error::enough_elements;
use crate::line::{ElementHeights, MAX_ELEMENTS, has_steep_kinks};

/// Largest number of steps of a motion, or of one cycle. Chosen to limit time and memory: each step is recorded, and a motion
/// with more steps is refused.
const MAX_STEPS: f64 = 4e6;

/// Upper bound of the memory of an element besides its history variables, \[bytes]. Chosen above the sum of its cells in the
/// height table, its contact state and record, and the vectors of conjugate gradients. It decides the stated memory only.
pub(super) const MOTION_BYTES_PER_ELEMENT: f64 = 200.0;
/// Upper bound of the number of copies of all history variables in the search for a limit cycle. Derived: those of the elements;
/// those that are saved after this and the last cycle; state, residual, expected residual and step of the search; and the
/// residual that is replaced.
const N_STORED_STATES: f64 = 8.0;

/// A line, its motion and the foundation under it.
pub(super) struct MotionProblem<'a> {
    /// Rigid line that moves.
    pub(super) line: &'a dyn RigidLine,
    /// Viscoelastic law of an element.
    pub(super) foundation: Foundation,
    /// Motion of the line.
    pub(super) load: &'a MovingLoad,
    /// Length of the contact that is divided into elements, \[m].
    pub(super) length: f64,
    /// Relative tolerance of the limit cycle.
    pub(super) tolerance: f64,
    /// Amplitudes of recovery on the resolution before, with which the next one begins.
    pub(super) saved_recovery: RefCell<Option<SavedRecovery>>,
    /// Height of the foundation that the cycle on the resolution before needed, \[m].
    height: Cell<f64>,
}

impl<'a> MotionProblem<'a> {
    /// A motion whose contact is `length` \[m] long, with a relative `tolerance` of the limit cycle.
    pub(super) fn new(
        line: &'a dyn RigidLine,
        material: &dyn Material,
        load: &'a MovingLoad,
        length: f64,
        tolerance: f64,
    ) -> Result<Self, MdrError> {
        let creep = material.creep();
        if load.is_cycle() && creep.fluidity() > 0.0 {
            return Err(MdrError::NoCycle);
        }
        Ok(Self {
            line,
            foundation: Foundation::new(material, 1.0)?,
            load,
            length,
            tolerance,
            saved_recovery: RefCell::new(None),
            height: Cell::new(0.0),
        })
    }

    /// Computes the motion with a number of elements along the contact. The foundation is made higher, and the motion repeated,
    /// until the contact stays below its largest height.
    pub(super) fn solve_on(
        &self,
        elements: usize,
        report: &dyn Fn(f64),
    ) -> Result<MotionRecord, MdrError> {
        // The motion is divided into steps. The foundation is first as high as a prescribed depth, or as a guess from the shape
        // of the line and the resolution before.
        let spacing = self.length / elements as f64;
        let steps = self.load.steps(elements, spacing, MAX_STEPS)?;
        let mut height = match self.load.largest_control() {
            Control::IndentationDepth(depth) => depth,
            Control::NormalForce(_) => self.rise().max(self.height.get()),
        };
        // Run on ever higher foundations until the contact stays on the elements.
        loop {
            let sampled = ElementHeights::below(self.line, spacing, height)?;
            let range = self.load.range();
            let n_elements = (range[1] - range[0]) / spacing + sampled.heights.len() as f64;
            if n_elements > MAX_ELEMENTS as f64 {
                return Err(MdrError::TooManyElements {
                    allowed: MAX_ELEMENTS,
                    spacing,
                    height,
                });
            }
            if let Some(mut record) = self.run(&sampled, &steps, report)? {
                let contact_history = record.steps.iter().map(|step| step.n_contact);
                enough_elements(contact_history.max().unwrap_or(0), spacing)?;
                if self.load.is_cycle() {
                    self.height.set(height);
                }
                if has_steep_kinks(self.line) {
                    average_tangential_forces(&mut record, &self.step_lengths(&steps));
                }
                return Ok(record);
            }
            height = 2.0 * sampled.max_height;
        }
    }

    /// Lengths of the steps, \[m].
    fn step_lengths(&self, steps: &[MovingStep]) -> Vec<f64> {
        let mut position = self.load.stages()[0].start.position;
        let distance = |step: &MovingStep| {
            (step.end.position - std::mem::replace(&mut position, step.end.position)).abs()
        };
        steps.iter().map(distance).collect()
    }

    /// Memory of all resolutions up to a number of elements along the contact, \[bytes].
    pub(super) fn memory_for(&self, elements: usize) -> Result<f64, MdrError> {
        let spacing = self.length / elements as f64;
        let n_steps = self.load.n_steps(elements, spacing, MAX_STEPS)?;
        let [rear, front] = self.load.range();
        let n_elements = (front - rear) / spacing + FOUNDATION_PER_CONTACT * elements as f64;
        let n_history = n_history(&self.foundation);
        let copies = if self.load.is_cycle() {
            N_STORED_STATES
        } else {
            1.0
        };
        let per_element = copies * (n_history * size_of::<f64>()) as f64 + MOTION_BYTES_PER_ELEMENT;
        // Four records of each step are counted, for the values on four resolutions and for lists that grow by doubling.
        let per_step = 4 * size_of::<MotionStep>() + size_of::<MovingStep>();
        Ok(n_steps * per_step as f64 + n_elements * per_element)
    }

    /// Guess of the height at which the contact ends, above the height of the line at x = 0, \[m]: that at a contact length of the
    /// fastest sliding on the lower side, or this length if that height is not positive and finite. The foundation grows if the
    /// contact goes beyond it.
    fn rise(&self) -> f64 {
        let lowest = self.line.height(0.0);
        let sides = [-self.length, self.length].map(|x| self.line.height(x) - lowest);
        let rise = sides[0].min(sides[1]);
        if rise.is_finite() && rise > 0.0 {
            rise
        } else {
            self.length
        }
    }

    /// The motion on a foundation with the sampled heights, or its limit cycle; `None` if the contact went beyond them.
    fn run(
        &self,
        sampled: &ElementHeights,
        steps: &[MovingStep],
        report: &dyn Fn(f64),
    ) -> Result<Option<MotionRecord>, MdrError> {
        // Press the line first, within a time that is negligible against the first step.
        let start = self.load.stages()[0].start;
        let pressing = f64::EPSILON * steps[0].duration;
        let mut winkler = WinklerFoundation::new(
            self.line,
            &self.foundation,
            sampled,
            self.load.range(),
            start.time - pressing,
            start.position,
        )?;
        let first = self.prescribed(start.control, sampled.spacing);
        let Some(pressed) = winkler.advance(pressing, start.position, first)? else {
            return Ok(None);
        };
        // After the pressing the line follows its limit cycle or its path.
        if self.load.is_cycle() {
            return find_limit_cycle(self, winkler, steps, report);
        }
        self.run_steps(&mut winkler, steps, pressed.depth, report)
    }

    /// The prescribed depth, or the prescribed load in the units of the foundation.
    fn prescribed(&self, control: Control, spacing: f64) -> Prescribed {
        match control {
            Control::IndentationDepth(depth) => Prescribed::Depth(depth),
            // The divisions come in this order so that even forces whose square is out of the range of numbers give a result.
            Control::NormalForce(force) => {
                Prescribed::Load(0.25 * force / spacing / self.foundation.unit)
            }
        }
    }

    /// Force \[N] per unit of the sum of the loads of all elements.
    pub(super) fn force_unit(&self, spacing: f64) -> f64 {
        4.0 * spacing * self.foundation.unit
    }

    /// Runs all steps once, from a depth \[m]; `None` if the contact went beyond the sampled heights.
    pub(super) fn run_steps(
        &self,
        winkler: &mut WinklerFoundation<'_>,
        steps: &[MovingStep],
        depth: f64,
        report: &dyn Fn(f64),
    ) -> Result<Option<MotionRecord>, MdrError> {
        let spacing = winkler.spacing();
        let force_unit = self.force_unit(spacing);
        let mut record = MotionRecord {
            steps: Vec::with_capacity(steps.len()),
            spacing,
            ..MotionRecord::default()
        };
        // The loop begins with the state before the first step. `force_factor` corrects the prescribed force so that its mean
        // over a step comes closer to it.
        let (mut dissipated, mut force_factor) = (0.0, 1.0);
        let first = self.load.stages()[0].start;
        let mut before = StepEnd {
            position: first.position,
            control: first.control,
            depth,
        };
        for (index, scheduled) in steps.iter().enumerate() {
            // Advance the foundation, and append the step to the record.
            let prescribed = match self.prescribed(scheduled.end.control, spacing) {
                Prescribed::Load(load) => Prescribed::Load(force_factor * load),
                depth @ Prescribed::Depth(_) => depth,
            };
            let Some(result) =
                winkler.advance(scheduled.duration, scheduled.end.position, prescribed)?
            else {
                return Ok(None);
            };
            dissipated += force_unit * result.sums.dissipated;
            let step = motion_step(scheduled, &result, &before, force_unit);
            let mean = force_unit * result.sums.normal_load;
            force_factor += force_correction(1.0 - mean / step.normal_force);
            record.push(step, scheduled.end.position - before.position);
            before = StepEnd {
                position: scheduled.end.position,
                control: scheduled.end.control,
                depth: result.depth,
            };
            report((index + 1) as f64 / steps.len() as f64);
        }
        record.imbalance = record.work - dissipated;
        Ok(Some(record))
    }
}

/// Correction of the relative force at the end of the next step, from the fraction `missing` of the force that the mean over this
/// step lacks; 0 unless the mean is a force, as where the force begins or ends.
///
/// The chord of a step lies below the path of an element under a round body. With the prescribed force at the ends of all
/// steps their mean is therefore too small, by the square of the step. Half of the difference is corrected, because a step
/// of much flow has its mean immediately.
pub(super) fn force_correction(missing: f64) -> f64 {
    if missing.abs() < 1.0 {
        0.5 * missing
    } else {
        0.0
    }
}

/// State of the line at the end of a step.
struct StepEnd {
    /// Position of the lowest point along the surface, \[m].
    position: f64,
    /// Prescribed force \[N] or depth \[m].
    control: Control,
    /// Indentation depth, \[m].
    depth: f64,
}

/// Forces, depth and contact of a step that began at `start`, in SI units.
fn motion_step(
    step: &MovingStep,
    result: &FoundationStep,
    start: &StepEnd,
    force_unit: f64,
) -> MotionStep {
    let normal_force = match start.control {
        Control::NormalForce(force) => force.midpoint(step.end.control.value()),
        Control::IndentationDepth(_) => force_unit * result.sums.normal_load,
    };
    MotionStep {
        stage: step.stage,
        time: step.end.time - 0.5 * step.duration,
        position: start.position.midpoint(step.end.position),
        tangential_force: force_unit * result.sums.tangential_load,
        normal_force,
        indentation_depth: start.depth.midpoint(result.depth),
        contact_area: None,
        contact: result.contact,
        n_contact: result.sums.n_loaded,
    }
}

#[cfg(test)]
mod tests {
    use indenters::{EquivalentLine, Shape, Sphere, Stroke};
    use rheology::{Prony, RelaxationBranch, RelaxationSpectrum};

    use super::*;

    /// ∮ F_t dx is the energy that the elements dissipate, to rounding at a depth. Under a force ∮ F_N dd of the means over steps
    /// is added, which vanishes with the square of the step.
    #[test]
    fn a_cycle_dissipates_its_work() {
        let ball = Sphere::new(5e-3).expect("a sphere");
        let branches = [(1e7, 1e-3), (3e6, 2e-2)].map(|(g, t)| RelaxationBranch::new(g, t));
        let spectrum = RelaxationSpectrum::new(1e6, 0.0, branches.to_vec()).expect("a spectrum");
        let material = Prony::new(spectrum).expect("a material");
        let line = EquivalentLine(&ball);
        for (control, length, elements, allowed) in [
            (Control::IndentationDepth(5e-5), 5e-3, 64, 1e-10),
            (Control::IndentationDepth(5e-5), 5e-5, 64, 1e-10),
            (Control::NormalForce(2.0), 5e-3, 64, 1e-4),
            (Control::NormalForce(2.0), 5e-3, 1024, 1e-6),
        ] {
            let stroke = Stroke {
                length,
                frequency: 5.0,
                shape: Shape::Sinusoidal,
            };
            let load = MovingLoad::reciprocating(control, stroke).expect("a load");
            let problem =
                MotionProblem::new(&line, &material, &load, 2e-3, 1e-9).expect("a problem");
            let record = problem.solve_on(elements, &|_| ()).expect("a cycle");
            let difference = (record.imbalance / record.work).abs();
            assert!(
                record.work > 0.0 && difference < allowed,
                "{control:?}, stroke {length}, {elements} elements: {} and {difference:e}",
                record.work
            );
        }
    }
}
