//! The contact at the end of one step, on a box that follows the contact.
//!
//! Theory: docs/theory/transient-half-space.md, "The contact of one step"; the solver: docs/theory/contact.md.

use std::f64::consts::PI;

use indenters::Control;

use super::{March, MotionRow, ScheduledStep};
use crate::BemError;
use crate::elements::bounds::Bounds;
use crate::elements::mirror::n_images;

impl March<'_> {
    /// Solves the contact at the end of a step on a box that is enlarged until the indenter penetrates nowhere outside it.
    pub(super) fn solve_contact(&mut self, step: &ScheduledStep) -> Result<MotionRow, BemError> {
        let mut enlarged = false;
        loop {
            // Solve the elastic contact on the box, with the pressure of the last step as first guess.
            let columns = self.layout.folded_shape()[1];
            let bounds = self.contact_box.bounds;
            bounds.extract(&self.initial_gap, columns, &mut self.contact_box.separation);
            let control = self.scaled_control(step.end.control);
            let accuracy = (&self.options.contact).into();
            let solved = self.contact_box.solve(control, &accuracy)?;

            // If the indenter penetrates elements outside the box, enlarge the box by these and solve again.
            self.update_increment(step.row);
            let contact = self.loaded_bounds();
            if let Some(outside) = self.penetration_outside_box(step.row, solved.indentation_depth)
            {
                let mut bounds = contact.map_or(outside, |contact| contact.union(&outside));
                bounds = self.with_margin(&bounds);
                if enlarged {
                    bounds = bounds.union(&self.contact_box.bounds);
                }
                self.contact_box = self.contact_box.moved_to(bounds)?;
                enlarged = true;
                continue;
            }

            // Fail if the contact reaches the boundary of the footprint, and shrink a box that is larger than the contact needs.
            if let Some(contact) = contact {
                self.check_footprint(&self.layout.unfolded(&contact), step.end.position)?;
                self.shrink_box(&contact)?;
            }
            return Ok(MotionRow {
                indentation_depth: solved.indentation_depth * self.height_scale,
                normal_force: match step.end.control {
                    Control::NormalForce(force) => force,
                    Control::IndentationDepth(_) => solved.total_load / self.load_per_force(),
                },
                iterations: solved.iterations,
                divided_area: self
                    .contact_box
                    .divided_area(self.layout.mirrors, solved.indentation_depth)
                    * self.options.spacing.iter().product(),
                ..self.motion_row(step)
            });
        }
    }

    /// Sum of the loads of the symmetry-reduced domain per newton of normal force, \[1/N].
    ///
    /// The load of an element is x = 2 (1 − ν) α P / (4π), so that the displacement is K x; its unit is the height scale over Δx.
    fn load_per_force(&self) -> f64 {
        let compliance = self.compliance() / self.height_scale;
        compliance / (4.0 * PI * self.options.spacing[1]) / n_images(self.layout.mirrors)
    }

    /// A control in the units of the contact box: a force as the sum of the loads of the symmetry-reduced domain, a depth over
    /// the height scale.
    fn scaled_control(&self, control: Control) -> Control {
        match control {
            Control::NormalForce(force) => Control::NormalForce(force * self.load_per_force()),
            Control::IndentationDepth(depth) => {
                Control::IndentationDepth(depth / self.height_scale)
            }
        }
    }

    /// Computes the displacement by the load of the contact box in all rows of the path that this and later steps read. The footprint
    /// begins at row `first_row` of the path.
    fn update_increment(&mut self, first_row: usize) {
        // Without load the displacement of the step is zero, and no transform is needed.
        let wanted = self.rows_needed(self.steps_done);
        if self.loaded_bounds().is_none() {
            self.history.clear_increment(wanted);
            return;
        }
        let rows = self.contact_box.bounds.rows();
        let loaded = self.contact_box.loaded_elements();
        self.history.apply_load(loaded, first_row, rows, wanted);
    }

    /// Bounding box of the elements outside the contact box that the indenter penetrates; `None` without any. The footprint begins at
    /// row `first_row` of the path, and `depth` is in units of the height scale.
    fn penetration_outside_box(&self, first_row: usize, depth: f64) -> Option<Bounds> {
        // The tolerance is relative to the largest displacement of the step, as on the box.
        let [rows, columns] = self.layout.folded_shape();
        let increment = self.history.increment(first_row..first_row + rows);
        let deflection = increment.iter().copied().fold(0.0, f64::max);
        let allowed = -self.options.contact.tolerance * deflection;
        let elements = self.initial_gap.iter().zip(increment).enumerate();
        let outside = elements
            .filter(|(_, (gap, increment))| *gap + *increment - depth < allowed)
            .map(|(index, _)| [index / columns, index % columns])
            .filter(|element| !self.contact_box.bounds.contains(*element));
        Bounds::enclosing(outside)
    }

    /// Fails with [`BemError::ContactReachesBoundary`] if the bounding box of the contact, in the whole footprint, touches the boundary
    /// of the footprint; `position` \[m] is for the message.
    fn check_footprint(&self, bounds: &Bounds, position: f64) -> Result<(), BemError> {
        let shape = self.layout.shape;
        let inside = (0..2).all(|axis| bounds.lower[axis] > 0 && bounds.upper[axis] < shape[axis]);
        if inside {
            return Ok(());
        }
        Err(self.options.footprint.boundary_reached(position))
    }

    /// Replaces the contact box by the one around `contact` if that is smaller.
    fn shrink_box(&mut self, contact: &Bounds) -> Result<(), BemError> {
        let needed = self.with_margin(contact);
        if needed.n_elements() < self.contact_box.bounds.n_elements() {
            self.contact_box = self.contact_box.moved_to(needed)?;
        }
        Ok(())
    }
}
