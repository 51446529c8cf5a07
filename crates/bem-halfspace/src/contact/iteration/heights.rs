//! Heights of the deformed surface s + K x, the depth that follows from them, and the violations of the contact conditions.

use std::ops::Range;

use crate::contact::Control;
use crate::contact::active_set::ActiveSet;
use crate::contact::iteration::Iteration;
use crate::parallel::reductions::{add_scaled, larger, reduce, smaller, sum};

/// Extremes and sums of the height s + K x of the deformed surface, \[m].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Heights {
    /// Lowest height outside the active set.
    lowest_outside: f64,
    /// Sum of the heights in the active set, measured from the indentation depth.
    sum_inside: f64,
}

impl Heights {
    /// Heights in a row block: `outside` has separation and displacement of its elements, `inside` of its active ones.
    fn of_row_block(
        active: &ActiveSet,
        row_block: usize,
        outside: [&[f64]; 2],
        inside: [&[f64]; 2],
        depth: f64,
    ) -> Self {
        let first = active.row_blocks.elements(row_block).start;
        let height = |[separation, displacement]: [f64; 2]| separation + displacement;
        let lowest_in = |gap: Range<usize>| {
            let fields = outside.map(|field| &field[gap.start - first..gap.end - first]);
            reduce(fields, f64::INFINITY, height, smaller)
        };
        Self {
            lowest_outside: active
                .inactive_ranges(row_block)
                .map(lowest_in)
                .fold(f64::INFINITY, smaller),
            sum_inside: sum(inside, |heights| height(heights) - depth),
        }
    }

    /// Extremes and sums over two parts of the grid together.
    fn join(self, other: Self) -> Self {
        Self {
            lowest_outside: smaller(self.lowest_outside, other.lowest_outside),
            sum_inside: self.sum_inside + other.sum_inside,
        }
    }
}

impl Iteration<'_> {
    /// Computes the displacement from the load, and restarts the directions.
    pub(super) fn recompute_displacement(&mut self) {
        // Find the displacement on the whole grid.
        self.scatter_load();
        self.convolution
            .apply(self.workspace, self.load, self.displacement);
        // Gather it on the active set, with the height statistics.
        let (active, vectors) = (&self.fields.active, &mut self.fields.vectors);
        let (fields, depth) = ([self.separation, self.displacement], self.indentation_depth);
        let separation = &vectors.separation;
        let in_row_block = |row_block, [displacement]: [&mut [f64]; 1]| {
            active.gather_in(row_block, fields[1], displacement);
            let outside = fields.map(|field| &field[active.row_blocks.elements(row_block)]);
            let inside = [&separation[active.packed_range(row_block)], displacement];
            Heights::of_row_block(active, row_block, outside, inside, depth)
        };
        let displacement = [active.packed(&mut vectors.displacement)];
        self.heights = active
            .row_blocks
            .fold(displacement, in_row_block, Heights::join);
        self.displacement_is_exact = true;
        self.previous_product = 0.0;
    }

    /// Adds `length` times the direction to the load, and its displacement to the displacement.
    pub(super) fn advance(&mut self, length: f64) {
        let (active, image) = (&self.fields.active, &self.fields.direction_displacement);
        let vectors = &mut self.fields.vectors;
        let separation = &vectors.separation;
        let (heights, depth) = (self.separation, self.indentation_depth);
        let in_row_block = |row_block, [field, displacement, load]: [&mut [f64]; 3]| {
            let (elements, range) = (
                active.row_blocks.elements(row_block),
                active.packed_range(row_block),
            );
            add_scaled(field, length, &image[elements.clone()]);
            add_scaled(
                displacement,
                length,
                &vectors.operator_output[range.clone()],
            );
            add_scaled(load, length, &vectors.direction[range.clone()]);
            let outside = [&heights[elements], field];
            let inside = [&separation[range], displacement];
            Heights::of_row_block(active, row_block, outside, inside, depth)
        };
        // Update each row block and evaluate its heights in the same pass over memory.
        let moved = [
            active.field(self.displacement),
            active.packed(&mut vectors.displacement),
            active.packed(&mut vectors.load),
        ];
        self.heights = active.row_blocks.fold(moved, in_row_block, Heights::join);
        self.displacement_is_exact = false;
        self.has_stepped = true;
    }

    /// Updates the depth. At a given force it is the mean height in the active set, so that the gaps there have the mean zero;
    /// without an active element it is the lowest height.
    pub(super) fn update_depth(&mut self) {
        let (active, vectors) = (&self.fields.active, &self.fields.vectors);
        self.indentation_depth = match self.control {
            Control::IndentationDepth(depth) => depth,
            Control::NormalForce(_) if active.len() == 0 => {
                let heights = self.separation.iter().copied();
                heights.fold(f64::INFINITY, f64::min)
            }
            Control::NormalForce(_) => {
                let mean = self.indentation_depth + self.heights.sum_inside / active.len() as f64;
                // The sum of many heights has a rounding error, which no later step removes. After the displacement was computed
                // anew the mean is therefore corrected once.
                let rounding_correction = if self.displacement_is_exact {
                    vectors.mean_height_above(active, mean)
                } else {
                    0.0
                };
                mean + rounding_correction
            }
        };
    }

    /// Computes the residual of the linear equations, minus the gap in the active set, and the violations.
    pub(super) fn measure(&mut self) -> Violations {
        let (active, vectors) = (&self.fields.active, &mut self.fields.vectors);
        let (separation, displacement, load) =
            (&vectors.separation, &vectors.displacement, &vectors.load);
        let self_influence = self.convolution.self_influence;
        let depth = self.indentation_depth;
        // Residual and violations inside each row block.
        let in_row_block = |row_block, [residual]: [&mut [f64]; 1]| {
            let [separation, displacement, load] = [separation, displacement, load]
                .map(|vector| &vector[active.packed_range(row_block)]);
            for (residual, (separation, displacement)) in
                residual.iter_mut().zip(separation.iter().zip(displacement))
            {
                *residual = depth - (separation + displacement);
            }
            Violations::inside(residual, load, displacement, self_influence)
        };
        // Combine the row blocks, and add the penetration outside.
        let residual = [active.packed(&mut vectors.residual)];
        let inside = active
            .row_blocks
            .fold(residual, in_row_block, Violations::worst);
        Violations {
            penetration: (depth - self.heights.lowest_outside).max(0.0),
            deflection: larger(inside.deflection, self.given_deflection),
            ..inside
        }
    }
}

/// The largest violations of the contact conditions, \[m].
pub(super) struct Violations {
    /// Largest |gap| in the active set; NaN if numbers overflow.
    pub(super) gap: f64,
    /// Largest tension in the active set times the self-influence; half of it for an element on a mirror.
    pub(super) tension: f64,
    /// Largest penetration outside the active set.
    pub(super) penetration: f64,
    /// Largest displacement in the active set, or under given loads: the scale of the tolerance.
    pub(super) deflection: f64,
}

impl Violations {
    /// The largest violation relative to the deflection; zero if both are zero, NaN if numbers overflow.
    pub(super) fn relative(&self) -> f64 {
        let largest = self.gap.max(self.tension).max(self.penetration);
        if self.gap.is_nan() {
            f64::NAN
        } else if largest == 0.0 {
            0.0
        } else {
            largest / self.deflection
        }
    }

    /// The largest violations in two parts of the active set.
    pub(super) fn worst(self, other: Self) -> Self {
        let gap = if self.gap.is_nan() {
            self.gap
        } else {
            larger(self.gap, other.gap)
        };
        Self {
            gap,
            tension: larger(self.tension, other.tension),
            penetration: larger(self.penetration, other.penetration),
            deflection: larger(self.deflection, other.deflection),
        }
    }

    /// Violations of the conditions inside a part of the active set: tensile loads, and residual gaps, which `self_influence`, the displacement
    /// of an element by its own unit load, makes comparable with loads.
    pub(super) fn inside(
        residual: &[f64],
        load: &[f64],
        displacement: &[f64],
        self_influence: f64,
    ) -> Self {
        // Zero if all residuals are finite, else NaN: comparisons would skip a NaN, a sum does not.
        let zero_or_nan = sum([residual], |[residual]| 0.0 * residual);
        let lowest_load = reduce([load], 0.0, |[load]| load, smaller);
        let own_part = self_influence * reduce([load], 0.0, |[load]| load, larger);
        Self {
            gap: zero_or_nan + reduce([residual], 0.0, |[residual]| residual.abs(), larger),
            tension: -self_influence * lowest_load,
            penetration: 0.0,
            deflection: reduce([displacement], own_part, |[displaced]| displaced, larger),
        }
    }
}
