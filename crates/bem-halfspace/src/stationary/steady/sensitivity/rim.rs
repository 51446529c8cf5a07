//! The rim of a contact by its elements, see [`crate::elements::contact_boundary`].

use crate::BemError;
use crate::elements::bounds::Bounds;
use crate::elements::contact_boundary::{
    BoundaryDerivatives, BoundaryField, BoundaryPair, ContactBoundary, LOAD_GAP_RATIO,
};
use crate::stationary::steady::filter::KernelOperator;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::plans::Plans;
use crate::stationary::steady::region::Region;
use crate::stationary::steady::sensitivity::adjoint::{Motion, solve};

/// Elements beside a contact, and two measures of the contact by what is known at its rim.
#[derive(Debug)]
pub(super) struct ContactRim {
    pub(super) beside: Vec<usize>,
    pub(super) area: OfElements,
    pub(super) growth: OfElements,
}

/// The derivatives of a measure.
#[derive(Debug)]
pub(super) struct OfElements {
    /// By the load of each element in contact.
    pub(super) by_loads: Vec<f64>,
    /// By the gap of each element beside it.
    pub(super) by_gaps: Vec<f64>,
    /// By the bend of the kernel along each axis.
    pub(super) by_bend: [f64; 2],
}

/// A contact and the elements beside it.
struct Surroundings<'a> {
    mesh: &'a Mesh,
    contact: &'a [usize],
    beside: Vec<usize>,
    region: Region,
    operator: KernelOperator,
}

impl ContactRim {
    pub(super) fn new(
        mesh: &Mesh,
        plans: &mut Plans,
        (contact, loads): (&[usize], &[f64]),
        depth: f64,
    ) -> Result<Self, BemError> {
        let mut around = Surroundings::new(mesh, plans, contact);
        let moved = around.displacements(loads);
        let gaps = around.beside.iter().zip(moved);
        let gaps = gaps.map(|(&element, moved)| mesh.height(element) + moved - depth);
        let bounds = around.bounds();
        let field = around.field(&bounds, loads, gaps.collect());
        let bend = [0, 1].map(|axis| mesh.bend(axis));
        let usual = |side: BoundaryPair| LOAD_GAP_RATIO / bend[side.axis];
        let rim = if mesh.loading.is_strip {
            // Each end has but one element on either side, which a ratio of others would misplace.
            let lowered = around.lowered(plans, &bounds)?;
            ContactBoundary::new(&field, |side| {
                let ratio = lowered[side.inside] / lowered[side.outside];
                if ratio > 0.0 { ratio } else { usual(side) }
            })
        } else {
            ContactBoundary::new(&field, usual)
        };
        let [area, growth] = [rim.area, rim.boundary_weight]
            .map(|measure| around.of_elements(&bounds, measure, bend));
        Ok(Self {
            beside: around.beside,
            area,
            growth,
        })
    }
}

impl OfElements {
    /// By the loads of the contact with what they do to the gaps; of the elements of the contact and those beside it.
    pub(super) fn by_loads_through_gaps(
        &self,
        mesh: &Mesh,
        plans: &mut Plans,
        elements: &[usize],
    ) -> Vec<f64> {
        let region = mesh.region(elements.iter().copied()).reversed();
        let mut operator = KernelOperator::new(plans.kernel(region.shape), &region);
        let n = self.by_loads.len();
        let mut by_gaps = vec![0.0; n];
        by_gaps.extend(&self.by_gaps);
        let felt = operator.apply(0, &by_gaps, &region);
        let pairs = self.by_loads.iter().zip(felt);
        pairs.map(|(by_load, felt)| by_load + felt).collect()
    }
}

impl<'a> Surroundings<'a> {
    fn new(mesh: &'a Mesh, plans: &mut Plans, contact: &'a [usize]) -> Self {
        let mut is_inside = vec![false; mesh.n_elements()];
        for &element in contact {
            is_inside[element] = true;
        }
        let mut beside = mesh.with_neighbours(contact);
        beside.retain(|element| !is_inside[*element]);
        let region = mesh.region(contact.iter().chain(&beside).copied());
        Self {
            mesh,
            contact,
            beside,
            operator: KernelOperator::new(plans.kernel(region.shape), &region),
            region,
        }
    }

    /// Those of the elements beside the contact.
    fn displacements(&mut self, loads: &[f64]) -> Vec<f64> {
        let mut padded = loads.to_vec();
        padded.resize(self.contact.len() + self.beside.len(), 0.0);
        let moved = self.operator.apply(0, &padded, &self.region);
        moved[self.contact.len()..].to_vec()
    }

    fn bounds(&self) -> Bounds {
        let all = self.contact.iter().chain(&self.beside);
        let places = all.flat_map(|&element| self.mesh.places(element));
        Bounds::enclosing(places).unwrap_or(Bounds::EMPTY)
    }

    fn field(&self, bounds: &Bounds, loads: &[f64], gaps: Vec<f64>) -> BoundaryField {
        let mut field = BoundaryField {
            shape: bounds.shape(),
            is_periodic: false,
            aspect: self.mesh.aspect(),
            inside: vec![false; bounds.n_elements()],
            values: vec![f64::NAN; bounds.n_elements()],
        };
        let all = self.contact.iter().chain(&self.beside);
        let values = loads.iter().copied().chain(gaps);
        for (index, (&element, value)) in all.zip(values).enumerate() {
            for place in self.mesh.places(element) {
                let place = bounds.index_of(place);
                field.inside[place] = index < self.contact.len();
                field.values[place] = value;
            }
        }
        field
    }

    /// How much loads grow in the contact and gaps fall beside it while the body is lowered by a unit depth.
    fn lowered(&mut self, plans: &mut Plans, bounds: &Bounds) -> Result<Vec<f64>, BemError> {
        let ones = vec![vec![1.0; self.contact.len()]];
        let loads = solve(self.mesh, plans, self.contact, Motion::Forward, &ones)?.remove(0);
        let moved = self.displacements(&loads);
        let falls = moved.into_iter().map(|moved| 1.0 - moved).collect();
        Ok(self.field(bounds, &loads, falls).values)
    }

    fn of_elements(
        &self,
        bounds: &Bounds,
        measure: BoundaryDerivatives,
        bend: [f64; 2],
    ) -> OfElements {
        let of = |elements: &[usize]| -> Vec<f64> {
            let place = |&element: &usize| bounds.index_of(self.mesh.places(element)[0]);
            let values = elements.iter().map(|one| measure.by_values[place(one)]);
            values.collect()
        };
        OfElements {
            by_loads: of(self.contact),
            by_gaps: of(&self.beside),
            by_bend: [0, 1].map(|axis| measure.by_second_difference[axis] / bend[axis]),
        }
    }
}
