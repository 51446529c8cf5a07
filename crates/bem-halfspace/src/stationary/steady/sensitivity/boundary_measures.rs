//! Measures of a contact that follow from its boundary between the elements, and their derivatives by loads and gaps, see
//! [`crate::elements::contact_boundary`].
//!
//! Theory: docs/sensitivity.md, "What is known of them".

use crate::BemError;
use crate::elements::bounds::Bounds;
use crate::elements::contact_boundary::{
    BoundaryDerivatives, BoundaryField, BoundaryPair, ContactBoundary, LOAD_GAP_RATIO,
};
use crate::stationary::steady::filter::KernelOperator;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::plans::Plans;
use crate::stationary::steady::region::Region;
use crate::stationary::steady::sensitivity::adjoint_solve::{KernelDirection, solve};

/// Elements next to a contact, and the derivatives of two measures of the contact.
#[derive(Debug)]
pub(super) struct BoundaryMeasures {
    /// Elements outside the contact that have an edge or a corner in common with it.
    pub(super) outside: Vec<usize>,
    pub(super) area: MeasureGradient,
    pub(super) boundary_weight: MeasureGradient,
}

/// The derivatives of a measure of the contact.
#[derive(Debug)]
pub(super) struct MeasureGradient {
    /// By the load of each element in contact.
    pub(super) by_loads: Vec<f64>,
    /// By the gap of each element outside the contact.
    pub(super) by_gaps: Vec<f64>,
    /// By the second difference of the kernel along each axis.
    pub(super) by_second_difference: [f64; 2],
}

/// A contact and the elements next to it.
struct BoundaryNeighbourhood<'a> {
    mesh: &'a Mesh,
    contact: &'a [usize],
    outside: Vec<usize>,
    /// The elements in contact, then those outside.
    region: Region,
    operator: KernelOperator,
}

impl BoundaryMeasures {
    pub(super) fn new(
        mesh: &Mesh,
        plans: &mut Plans,
        contact: &[usize],
        loads: &[f64],
        depth: f64,
    ) -> Result<Self, BemError> {
        // Loads inside and gaps outside the boundary.
        let mut neighbourhood = BoundaryNeighbourhood::new(mesh, plans, contact);
        let displacements = neighbourhood.outside_displacements(loads);
        let outside = neighbourhood.outside.iter().zip(displacements);
        let gaps = outside.map(|(&element, moved)| mesh.height(element) + moved - depth);
        let bounds = neighbourhood.bounds();
        let field = neighbourhood.field(&bounds, loads, gaps.collect());

        // The boundary between them, with the ratio κ of loads to gaps.
        let second_difference = [0, 1].map(|axis| mesh.kernel_second_difference(axis));
        let mean_ratio = |pair: BoundaryPair| LOAD_GAP_RATIO / second_difference[pair.axis];
        let boundary = if mesh.loading.is_strip {
            // Each end has one pair of elements only, for which the mean ratio would be wrong: take it from the solution.
            let response = neighbourhood.unit_depth_response(plans, &bounds)?;
            ContactBoundary::new(&field, |pair| {
                let ratio = response[pair.inside] / response[pair.outside];
                if ratio > 0.0 { ratio } else { mean_ratio(pair) }
            })
        } else {
            ContactBoundary::new(&field, mean_ratio)
        };
        let [area, boundary_weight] = [boundary.area, boundary.boundary_weight]
            .map(|measure| neighbourhood.gradient(&bounds, &measure, second_difference));
        Ok(Self {
            outside: neighbourhood.outside,
            area,
            boundary_weight,
        })
    }
}

impl MeasureGradient {
    /// Total derivative by the loads of `elements`, the contact and the elements outside: explicit, and through the gaps.
    pub(super) fn total_by_loads(
        &self,
        mesh: &Mesh,
        plans: &mut Plans,
        elements: &[usize],
    ) -> Vec<f64> {
        let region = mesh.region(elements.iter().copied()).reversed();
        let mut operator = KernelOperator::new(plans.kernel(region.shape), &region);
        let mut by_gaps = vec![0.0; self.by_loads.len()];
        by_gaps.extend(&self.by_gaps);
        let through_gaps = operator.apply(0, &by_gaps, &region);
        let pairs = self.by_loads.iter().zip(through_gaps);
        pairs
            .map(|(explicit, through_gaps)| explicit + through_gaps)
            .collect()
    }
}

impl<'a> BoundaryNeighbourhood<'a> {
    fn new(mesh: &'a Mesh, plans: &mut Plans, contact: &'a [usize]) -> Self {
        let mut is_inside = vec![false; mesh.n_elements()];
        for &element in contact {
            is_inside[element] = true;
        }
        let mut outside = mesh.with_neighbours(contact);
        outside.retain(|element| !is_inside[*element]);
        let region = mesh.region(contact.iter().chain(&outside).copied());
        Self {
            mesh,
            contact,
            outside,
            operator: KernelOperator::new(plans.kernel(region.shape), &region),
            region,
        }
    }

    /// Displacements of the elements outside the contact by loads on it.
    fn outside_displacements(&mut self, loads: &[f64]) -> Vec<f64> {
        let n_elements = self.contact.len() + self.outside.len();
        let mut padded = loads.to_vec();
        padded.resize(n_elements, 0.0);
        let displacements = self.operator.apply(0, &padded, &self.region);
        displacements[self.contact.len()..].to_vec()
    }

    /// Box around all elements and their images.
    fn bounds(&self) -> Bounds {
        let elements = self.contact.iter().chain(&self.outside);
        let places = elements.flat_map(|&element| self.mesh.places(element));
        Bounds::enclosing(places).unwrap_or(Bounds::EMPTY)
    }

    /// Loads in the contact and gaps outside it, as a field over the box.
    fn field(&self, bounds: &Bounds, loads: &[f64], gaps: Vec<f64>) -> BoundaryField {
        let mut field = BoundaryField {
            shape: bounds.shape(),
            is_periodic: false,
            aspect: self.mesh.aspect(),
            inside: vec![false; bounds.n_elements()],
            values: vec![f64::NAN; bounds.n_elements()],
        };
        let elements = self.contact.iter().chain(&self.outside);
        let values = loads.iter().copied().chain(gaps);
        for (index, (&element, value)) in elements.zip(values).enumerate() {
            for place in self.mesh.places(element) {
                let place = bounds.index_of(place);
                field.inside[place] = index < self.contact.len();
                field.values[place] = value;
            }
        }
        field
    }

    /// Increase of the loads in the contact, and decrease of the gaps outside, per unit of depth, as a field over the box.
    fn unit_depth_response(
        &mut self,
        plans: &mut Plans,
        bounds: &Bounds,
    ) -> Result<Vec<f64>, BemError> {
        let unit_depth = vec![vec![1.0; self.contact.len()]];
        let forward = KernelDirection::Forward;
        let loads = solve(self.mesh, plans, self.contact, forward, &unit_depth)?.remove(0);
        let displacements = self.outside_displacements(&loads).into_iter();
        let gap_decrease = displacements.map(|moved| 1.0 - moved).collect();
        Ok(self.field(bounds, &loads, gap_decrease).values)
    }

    /// Derivatives by places of the box as derivatives by elements; those by ln of the second difference as those by itself.
    fn gradient(
        &self,
        bounds: &Bounds,
        measure: &BoundaryDerivatives,
        second_difference: [f64; 2],
    ) -> MeasureGradient {
        let by_elements = |elements: &[usize]| -> Vec<f64> {
            let place = |&element: &usize| bounds.index_of(self.mesh.places(element)[0]);
            let values = elements.iter().map(|one| measure.by_values[place(one)]);
            values.collect()
        };
        MeasureGradient {
            by_loads: by_elements(self.contact),
            by_gaps: by_elements(&self.outside),
            by_second_difference: [0, 1]
                .map(|axis| measure.by_second_difference[axis] / second_difference[axis]),
        }
    }
}
