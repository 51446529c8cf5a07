//! Directions of the conjugate gradients.

use crate::contact::Control;
use crate::contact::iteration::Iteration;
use crate::parallel::reductions::sum;

impl Iteration<'_> {
    /// Moves the load along a direction conjugate to the previous ones to where the residual does no work.
    pub(super) fn step(&mut self) {
        self.find_direction();
        let (active, vectors) = (&self.fields.active, &mut self.fields.vectors);
        let image = &mut self.fields.image;
        self.convolution
            .apply(self.workspace, &self.fields.scattered, image);
        let direction = &vectors.direction;
        let energy = active.bands.fold(
            [active.packed(&mut vectors.image)],
            |band, [vectors]| {
                active.gather_in(band, image, vectors);
                sum(
                    [&direction[active.packed_range(band)], vectors],
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
        let (active, preconditioner) = (&fields.active, &mut fields.preconditioner);
        let (scattered, vectors) = (&mut fields.scattered, &mut fields.vectors);
        let (direction, preconditioned) = (&mut vectors.direction, &mut vectors.image);
        let residual = &vectors.residual;
        if !self.improved {
            // The first direction on a contact is not conjugate to any before.
            preconditioner.prepare(active, scattered, [direction, preconditioned]);
        }
        preconditioner.apply(active, (residual, scattered), preconditioned);
        let preconditioned = &*preconditioned;
        let by_band = |band| {
            let [r, z] = [residual, preconditioned].map(|list| &list[active.packed_range(band)]);
            [
                sum([r], |[r]| r),
                sum([z], |[z]| z),
                sum([r, z], |[r, z]| r * z),
            ]
        };
        let both = |left: [f64; 3], right: [f64; 3]| [0, 1, 2].map(|k| left[k] + right[k]);
        let [sum_r, sum_z, sum_rz] = active.bands.gather(by_band, both);
        let mean = match self.control {
            Control::NormalForce(_) => sum_z / active.len() as f64,
            Control::IndentationDepth(_) => 0.0,
        };
        // Of the residual and what remains of its image without the mean.
        let product = sum_rz - mean * sum_r;
        let conjugation = if self.previous_product > 0.0 {
            product / self.previous_product
        } else {
            0.0
        };
        let fields = [active.field(scattered), active.packed(direction)];
        let bands = active.bands;
        bands.for_each_part(fields, |band, [scattered, direction]| {
            let values = &preconditioned[active.packed_range(band)];
            for (direction, value) in direction.iter_mut().zip(values) {
                *direction = value - mean + conjugation * *direction;
            }
            active.scatter_in(band, direction, scattered);
        });
        self.previous_product = product;
    }
}
