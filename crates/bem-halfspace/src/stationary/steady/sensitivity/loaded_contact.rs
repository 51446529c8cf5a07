//! The contact on one grid, and the adjoint loads of its quantities.
//!
//! Theory: the [module](super).

use crate::BemError;
use crate::elements::contact_boundary::{BoundaryDerivatives, BoundaryField, ContactBoundary};
use crate::stationary::steady::body_contact::Solution;
use crate::stationary::steady::filter::KernelOperator;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::plans::Plans;
use crate::stationary::steady::region::Region;
use crate::stationary::steady::sensitivity::adjoint_solve::{KernelDirection, solve};
use crate::stationary::steady::sensitivity::collocation_points::FrictionSlope;
use crate::stationary::steady::sensitivity::correlation::Correlation;

/// A solved contact and the elements next to it, in the units of the mesh.
pub(super) struct LoadedContact<'a> {
    /// Heights and influence coefficients.
    mesh: &'a Mesh,
    /// Spectra of the kernel and of its inverse factors.
    plans: &'a mut Plans,
    /// Elements in contact, then the elements next to it, whose gaps the measures of the contact depend on; none under a body with
    /// edges.
    pub(super) elements: Vec<usize>,
    /// Number of elements in contact, which is that of the unknown pressures.
    pub(super) n_touching: usize,
    /// Loads of all elements; 0 outside the contact.
    pub(super) loads: Vec<f64>,
    /// Sum of all loads, mirror images included.
    pub(super) total: f64,
    /// Indentation depth, in units of the depth scale.
    depth: f64,
    /// Bounding box of the elements.
    region: Region,
}

/// The mean slope under the load, which is the friction, in units of the depth scale over the length of an element.
pub(super) struct MeanSlope {
    /// Load-weighted mean of the slope, in the unit of the struct.
    pub(super) value: f64,
    /// Derivatives by the loads of all elements; 0 outside the contact.
    pub(super) by_loads: Vec<f64>,
}

impl<'a> LoadedContact<'a> {
    /// The loaded elements of a solution, with their unloaded neighbours unless the body has edges.
    pub(super) fn new(mesh: &'a Mesh, plans: &'a mut Plans, solution: &Solution) -> Self {
        let pairs = solution.loads.iter().copied();
        let (mut elements, mut loads): (Vec<usize>, Vec<f64>) = pairs.unzip();
        let n_touching = elements.len();
        if !mesh.loading.has_edges {
            let mut outside = mesh.with_neighbours(&elements);
            // Both lists are sorted as the mesh is, so that a binary search finds equal elements.
            outside.retain(|element| elements.binary_search(element).is_err());
            elements.extend(outside);
            loads.resize(elements.len(), 0.0);
        }
        Self {
            total: mesh.total_load(solution.loads.iter().copied()),
            depth: solution.depth,
            region: mesh.region(elements.iter().copied()),
            mesh,
            plans,
            elements,
            n_touching,
            loads,
        }
    }

    /// Sum of `loads`, in the order of the elements, with mirror images included.
    pub(super) fn sum(&self, loads: &[f64]) -> f64 {
        let elements = self.elements.iter().copied();
        self.mesh.total_load(elements.zip(loads.iter().copied()))
    }

    /// Products of the load of each element and [`Mesh::n_images`], the number of elements that it represents.
    pub(super) fn weighted_by_images(&self, loads: &[f64]) -> Vec<f64> {
        let pairs = self.elements.iter().zip(loads);
        pairs
            .map(|(&element, load)| self.mesh.n_images(element) * load)
            .collect()
    }

    /// Correlation of adjoint loads with the loads of the contact: its product with the kernel is the derivative by the kernel.
    pub(super) fn correlation(&self, adjoint: &[f64]) -> Correlation {
        let [mut left, mut right] = [0; 2].map(|_| vec![0.0; self.region.n_box_elements()]);
        // Adjoint loads are placed on one of two mirror images, with twice the weight.
        let indices = self.region.indices().iter();
        for ([index, _], load) in indices.zip(self.weighted_by_images(adjoint)) {
            left[*index] = load;
        }
        self.region.scatter(&self.loads, &mut right);
        Correlation::between(&left, &right, self.region.shape)
    }

    /// Adjoint loads of quantities J at a free force, from their derivatives by the loads in contact and by the gaps next to it. In the
    /// contact they solve `Kᵀ y = r`, outside they are −∂J/∂gap.
    pub(super) fn adjoint_loads(
        &mut self,
        derivatives: &[&[f64]],
    ) -> Result<Vec<Vec<f64>>, BemError> {
        // The right sides are the derivatives by the loads: explicit ones, and those through the gaps that the loads change.
        let n = self.n_touching;
        let reversed = self.region.reversed();
        let mut right_side = |by_values: &&[f64]| -> Vec<f64> {
            let mut by_gaps = by_values.to_vec();
            by_gaps[..n].fill(0.0);
            let through_gaps = displacements(self.plans, &reversed, &by_gaps);
            let pairs = by_values[..n].iter().zip(through_gaps);
            pairs
                .map(|(explicit, by_gap_changes)| explicit + by_gap_changes)
                .collect()
        };
        let right_sides: Vec<_> = derivatives.iter().map(&mut right_side).collect();

        // Solve, and extend the loads by the elements outside the contact.
        let (contact, direction) = (&self.elements[..n], KernelDirection::Reversed);
        let mut solutions = solve(self.mesh, self.plans, contact, direction, &right_sides)?;
        for (loads, by_values) in solutions.iter_mut().zip(derivatives) {
            loads.extend(by_values[n..].iter().map(|by_gap| -by_gap));
        }
        Ok(solutions)
    }

    /// The mean slope, from the explicit slope terms of the body.
    pub(super) fn mean_slope(&mut self, slope: FrictionSlope, mut slopes: Vec<f64>) -> MeanSlope {
        // Sum over all elements of the load times the derivative of the slope by the load of each element.
        let mut by_others = vec![0.0; slopes.len()];
        if slope != FrictionSlope::Body {
            // Subtract the slopes of the displacements. Their derivatives by the loads are the same differences for the reversed
            // motion.
            let region = self.with_neighbours_along_x();
            for (slope, displacement) in slopes.iter_mut().zip(self.differences_along_x(&region)) {
                *slope -= displacement;
            }
            by_others = self.differences_along_x(&region.reversed());
        }

        let weighted = self
            .weighted_by_images(&self.loads)
            .into_iter()
            .zip(&slopes);
        let value = weighted.map(|(load, slope)| load * slope).sum::<f64>() / self.total;
        let pairs = slopes.iter().zip(by_others);
        let by_loads = pairs.map(|(here, others)| (here + others - value) / self.total);
        let mut by_loads: Vec<f64> = by_loads.collect();
        by_loads[self.n_touching..].fill(0.0);
        MeanSlope { value, by_loads }
    }

    /// A region of the neighbours ahead, the neighbours behind and the elements.
    fn with_neighbours_along_x(&self) -> Region {
        let indices = || {
            let elements = self.elements.iter();
            elements.map(|&element| self.mesh.indices(element))
        };
        let shifted = |step: fn(usize) -> usize| {
            indices().map(move |both| both.map(|[row, column]| [step(row), column]))
        };
        // A field takes the last of several values at one index: that of the element.
        let all = shifted(|row| row + 1)
            .chain(shifted(|row| row - 1))
            .chain(indices());
        Region::around(all.collect::<Vec<_>>().iter().copied())
    }

    /// Central differences of the displacements along x, on a region of the neighbours ahead and behind and the elements.
    fn differences_along_x(&mut self, region: &Region) -> Vec<f64> {
        let n = self.elements.len();
        let loads = [&vec![0.0; 2 * n], &self.loads[..]].concat();
        let displacements = displacements(self.plans, region, &loads);
        let difference = |element| 0.5 * (displacements[element] - displacements[n + element]);
        (0..n).map(difference).collect()
    }

    /// Derivatives of the area and of the boundary weight by the loads in contact and the gaps next to it, element by element.
    pub(super) fn boundary(&mut self) -> Result<ContactBoundary, BemError> {
        // The boundary is found in one field: loads in the contact, and gaps outside it.
        let n = self.n_touching;
        let mut values = self.loads.clone();
        let moved = displacements(self.plans, &self.region, &self.loads);
        let outside = values.iter_mut().zip(&self.elements).zip(moved).skip(n);
        for ((value, &element), displacement) in outside {
            *value = self.mesh.height(element) + displacement - self.depth;
        }

        // Each end of a strip has one pair of elements only, for which the mean ratio of loads to gaps would be wrong.
        let unit_depth_response = if self.mesh.loading.is_strip {
            let response = self.unit_depth_response()?;
            Some(self.over_box(response.into_iter(), f64::NAN))
        } else {
            None
        };
        let boundary = ContactBoundary::new(&BoundaryField {
            shape: self.region.shape,
            is_periodic: false,
            aspect: self.mesh.aspect(),
            inside: self.over_box((0..values.len()).map(|index| index < n), false),
            values: self.over_box(values.into_iter(), f64::NAN),
            second_difference: [0, 1].map(|axis| self.mesh.kernel_second_difference(axis)),
            unit_depth_response,
        });
        let by_element = |measure: BoundaryDerivatives| BoundaryDerivatives {
            by_values: self.region.gather(&measure.by_values),
            ..measure
        };
        Ok(ContactBoundary {
            area: by_element(boundary.area),
            boundary_weight: by_element(boundary.boundary_weight),
        })
    }

    /// Increase of the loads in the contact, and decrease of the gaps outside, per unit of depth.
    fn unit_depth_response(&mut self) -> Result<Vec<f64>, BemError> {
        // Solve for the loads that displace the contact by 1. Outside it the gaps fall by 1 minus the displacement.
        let n = self.n_touching;
        let (contact, direction) = (&self.elements[..n], KernelDirection::Forward);
        let unit_depth = vec![vec![1.0; n]];
        let mut response = solve(self.mesh, self.plans, contact, direction, &unit_depth)?.remove(0);
        response.resize(self.elements.len(), 0.0);
        let moved = displacements(self.plans, &self.region, &response);
        for (value, displacement) in response.iter_mut().zip(moved).skip(n) {
            *value = 1.0 - displacement;
        }
        Ok(response)
    }

    /// A field over the box of the region with the values of all elements and of their mirror images, and `elsewhere` in between.
    fn over_box<T: Copy>(&self, values: impl Iterator<Item = T>, elsewhere: T) -> Vec<T> {
        let mut field = vec![elsewhere; self.region.n_box_elements()];
        for (indices, value) in self.region.indices().iter().zip(values) {
            for index in indices {
                field[*index] = value;
            }
        }
        field
    }
}

/// Displacements of the elements of a region by loads on them, in the units of the mesh.
fn displacements(plans: &mut Plans, region: &Region, loads: &[f64]) -> Vec<f64> {
    KernelOperator::new(plans.kernel(region.shape), region).apply(0, loads, region)
}
