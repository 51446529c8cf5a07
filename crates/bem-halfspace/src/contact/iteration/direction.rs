//! Directions of the conjugate gradients.

use crate::contact::Control;
use crate::contact::iteration::Iteration;
use crate::parallel::reductions::sum;

impl Iteration<'_> {
    /// Moves the load along a direction conjugate to the previous ones to where the residual does no work.
    pub(super) fn step(&mut self) {
        self.find_direction();
        let (contact, listed) = (&self.fields.contact, &mut self.fields.listed);
        let image = &mut self.fields.image;
        self.convolution
            .apply(self.workspace, &self.fields.spread, image);
        let direction = &listed.direction;
        let energy = contact.bands.fold(
            [contact.packed(&mut listed.image)],
            |band, [listed]| {
                contact.gather_in(band, image, listed);
                sum(
                    [&direction[contact.packed_range(band)], listed],
                    |[a, b]| a * b,
                )
            },
            |left, right| left + right,
        );
        // The load of a single element is the force.
        let length = if energy == 0.0 {
            0.0
        } else {
            self.previous_product / energy
        };
        self.advance(length);
    }

    fn find_direction(&mut self) {
        let fields = &mut *self.fields;
        let (contact, preconditioner) = (&fields.contact, &mut fields.preconditioner);
        let (spread, listed) = (&mut fields.spread, &mut fields.listed);
        let (direction, preconditioned) = (&mut listed.direction, &mut listed.image);
        let residual = &listed.residual;
        if !self.improved {
            // The first direction on a contact is not conjugate to any before.
            preconditioner.prepare(contact, spread, [direction, preconditioned]);
        }
        preconditioner.apply(contact, (residual, spread), preconditioned);
        let preconditioned = &*preconditioned;
        let by_band = |band| {
            let [r, z] = [residual, preconditioned].map(|list| &list[contact.packed_range(band)]);
            [
                sum([r], |[r]| r),
                sum([z], |[z]| z),
                sum([r, z], |[r, z]| r * z),
            ]
        };
        let both = |left: [f64; 3], right: [f64; 3]| [0, 1, 2].map(|k| left[k] + right[k]);
        let [sum_r, sum_z, sum_rz] = contact.bands.gather(by_band, both);
        let mean = match self.control {
            Control::NormalForce(_) => sum_z / contact.len() as f64,
            Control::IndentationDepth(_) => 0.0,
        };
        // Of the residual and what remains of its image without the mean.
        let product = sum_rz - mean * sum_r;
        let conjugation = if self.previous_product > 0.0 {
            product / self.previous_product
        } else {
            0.0
        };
        let fields = [contact.field(spread), contact.packed(direction)];
        let bands = contact.bands;
        bands.for_each_part(fields, |band, [spread, direction]| {
            let values = &preconditioned[contact.packed_range(band)];
            for (direction, value) in direction.iter_mut().zip(values) {
                *direction = value - mean + conjugation * *direction;
            }
            contact.scatter_in(band, direction, spread);
        });
        self.previous_product = product;
    }
}
