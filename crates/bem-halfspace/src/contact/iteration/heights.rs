//! Heights of the deformed surface s + K x, the depth that follows from them, and the violations of the contact conditions.

use std::ops::Range;

use crate::contact::Control;
use crate::contact::active_set::ActiveSet;
use crate::contact::iteration::Iteration;
use crate::parallel::reductions::{add_scaled, larger, reduce, smaller, sum};

/// Minimum and sum of the height s + K x of the deformed surface on parts of the grid, \[m].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Heights {
    /// Lowest height outside the active set; infinite without elements there.
    lowest_outside: f64,
    /// Sum of s + K x − d over the active set, with the depth d of the previous iterate.
    sum_inside: f64,
}

impl Heights {
    /// Statistics of one row block: `outside` holds [separation, displacement] of all its elements, `inside` those of its active
    /// elements, packed. The sum is measured from `depth` \[m].
    fn of_row_block(
        active: &ActiveSet,
        row_block: usize,
        outside: [&[f64]; 2],
        inside: [&[f64]; 2],
        depth: f64,
    ) -> Self {
        // Find the lowest height of the inactive elements between the runs, and the sum of the heights over the runs.
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

    /// Statistics of two parts of the grid together.
    fn join(self, other: Self) -> Self {
        Self {
            lowest_outside: smaller(self.lowest_outside, other.lowest_outside),
            sum_inside: self.sum_inside + other.sum_inside,
        }
    }
}

impl Iteration<'_> {
    /// Computes the displacement K x anew from the load, and restarts the search directions.
    pub(super) fn recompute_displacement(&mut self) {
        // Compute the displacement K x under the present load on the whole grid.
        self.scatter_load();
        self.convolution
            .apply(self.workspace, self.load, self.displacement);
        // Gather the displacement on the active set, and find minimum and sum of the heights in the same pass.
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

    /// Step of the conjugate gradients: adds `length` times the direction p to the load, and `length` K p to the displacement.
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

    /// Updates the depth. At a given force it is the mean of s + K x over the active set, so that the gaps there have the mean zero;
    /// without an active element it is the lowest initial gap.
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

    /// Computes the residual r = d − (s + K x) of the linear equations on the active set, and returns the violations of all contact
    /// conditions.
    pub(super) fn update_residual(&mut self) -> Violations {
        let (active, vectors) = (&self.fields.active, &mut self.fields.vectors);
        let (separation, displacement, load) =
            (&vectors.separation, &vectors.displacement, &vectors.load);
        let self_influence = self.convolution.self_influence;
        let depth = self.indentation_depth;
        // Compute the residual on the active elements of each row block, and the largest violations there.
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
        // Combine the violations of the row blocks, and add the largest penetration outside the active set.
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
    /// Largest tensile load in the active set times the self-influence, the displacement of an element under its own unit load. An
    /// element on a mirror counts with the part of its load in front.
    pub(super) tension: f64,
    /// Largest penetration outside the active set.
    pub(super) penetration: f64,
    /// Largest displacement in the active set, or under given loads: the scale of the tolerance.
    pub(super) deflection: f64,
}

impl Violations {
    /// The largest violation over the deflection, without unit; zero if both are zero, NaN if numbers overflow.
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

    /// Maximum of each violation over two parts of the active set.
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

    /// Violations in a part of the active set, from its packed vectors. `self_influence` \[m], the displacement of an element under
    /// its own unit load, turns tensile loads into lengths that are comparable with gaps.
    pub(super) fn inside(
        residual: &[f64],
        load: &[f64],
        displacement: &[f64],
        self_influence: f64,
    ) -> Self {
        // This sum is zero if all residuals are finite, else NaN. The comparisons below would skip a NaN, a sum does not.
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
