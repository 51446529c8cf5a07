//! The contact on one grid, and the adjoint loads of its quantities.
//!
//! Theory: the [module](super).

use crate::BemError;
use crate::elements::bounds::Bounds;
use crate::stationary::steady::body_contact::Solution;
use crate::stationary::steady::filter::KernelOperator;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::plans::Plans;
use crate::stationary::steady::region::Region;
use crate::stationary::steady::sensitivity::adjoint_solve::{KernelDirection, solve};
use crate::stationary::steady::sensitivity::boundary_measures::{
    BoundaryMeasures, MeasureGradient,
};
use crate::stationary::steady::sensitivity::correlation::{Correlation, Field};

/// A solved contact and the elements next to it, in the units of the mesh.
pub(super) struct LoadedContact<'mesh> {
    pub(super) mesh: &'mesh Mesh,
    /// Elements in contact, then the elements next to it, whose gaps the measures depend on.
    pub(super) elements: Vec<usize>,
    /// Loads of all elements; 0 outside the contact.
    pub(super) loads: Vec<f64>,
    /// Number of elements in contact.
    n_touching: usize,
    /// `None` under a body with edges, where the contact ends at the edges.
    boundary: Option<BoundaryMeasures>,
    /// Sum of all loads, mirror images included.
    pub(super) total: f64,
    bounds: Bounds,
}

/// Solutions of `Kᵀ y = r`, in the units of the mesh.
pub(super) struct AdjointLoads {
    /// For r the derivative of the friction by the loads.
    pub(super) friction: Vec<f64>,
    /// For a unit depth, r = 1.
    pub(super) depth: Vec<f64>,
    /// For r the derivatives of area and boundary weight, see [`crate::elements::contact_boundary`]. Empty under a body with edges.
    pub(super) measures: Vec<Vec<f64>>,
}

impl<'mesh> LoadedContact<'mesh> {
    pub(super) fn new(
        mesh: &'mesh Mesh,
        solution: &Solution,
        plans: &mut Plans,
    ) -> Result<Self, BemError> {
        let pairs = solution.loads.iter().copied();
        let (mut elements, mut loads): (Vec<usize>, Vec<f64>) = pairs.unzip();
        let n_touching = elements.len();
        let boundary = (!mesh.loading.has_edges)
            .then(|| BoundaryMeasures::new(mesh, plans, &elements, &loads, solution.depth))
            .transpose()?;
        // The elements outside carry no load.
        elements.extend(boundary.iter().flat_map(|boundary| &boundary.outside));
        loads.resize(elements.len(), 0.0);
        let places = elements.iter().flat_map(|&element| mesh.places(element));
        Ok(Self {
            total: mesh.total_load(solution.loads.iter().copied()),
            bounds: Bounds::enclosing(places).unwrap_or(Bounds::EMPTY),
            mesh,
            elements,
            loads,
            n_touching,
            boundary,
        })
    }

    /// Number of elements in contact, which is that of the unknown pressures.
    pub(super) const fn n_touching(&self) -> usize {
        self.n_touching
    }

    /// Gradients of area and boundary weight; none under a body with edges.
    pub(super) fn measures(&self) -> impl Iterator<Item = &MeasureGradient> {
        let boundary = self.boundary.iter();
        boundary.flat_map(|boundary| [&boundary.area, &boundary.boundary_weight])
    }

    /// Sum of some loads over all elements, mirror images included.
    pub(super) fn sum(&self, loads: &[f64]) -> f64 {
        let elements = self.elements.iter().copied();
        self.mesh.total_load(elements.zip(loads.iter().copied()))
    }

    /// The correlation of adjoint loads with the loads of the contact.
    pub(super) fn correlation(&self, adjoint: &[f64]) -> Correlation {
        let pairs = |loads: &[f64]| -> Vec<(usize, f64)> {
            let elements = self.elements.iter().copied();
            elements.zip(loads.iter().copied()).collect()
        };
        // An element represents its mirror image.
        let adjoint = pairs(adjoint).into_iter().map(|(element, load)| {
            let [place, _] = self.mesh.places(element);
            (place, self.mesh.weight(element) * load)
        });
        let loads = self.mesh.loaded_places(&pairs(&self.loads)).into_iter();
        Correlation::between(
            &Field::new(&self.bounds, adjoint),
            &Field::new(&self.bounds, loads),
        )
    }

    /// The correlation of the mean slope of the displacements under the load.
    pub(super) fn slope_correlation(&self) -> Correlation {
        self.correlation(&self.loads).slope(self.total.recip())
    }

    /// The mean slope under the load, in units of the depth scale over the length of an element, and the adjoint loads.
    pub(super) fn adjoint(
        &self,
        slopes: &Slopes,
        plans: &mut Plans,
    ) -> Result<(f64, AdjointLoads), BemError> {
        // The mean slope and its derivative by the loads.
        let loads = self.elements.iter().zip(&self.loads);
        let weighted = loads
            .zip(&slopes.at_elements)
            .map(|((&element, load), slope)| self.mesh.weight(element) * load * slope);
        let mean = weighted.sum::<f64>() / self.total;
        let by_loads = slopes.at_elements.iter().zip(&slopes.by_others);
        let by_loads = by_loads.map(|(here, others)| (here + others - mean) / self.total);

        // Right sides: mean slope, unit depth, measures.
        let n = self.n_touching;
        let mut right_sides = vec![by_loads.take(n).collect(), vec![1.0; n]];
        let measures = self.measures();
        right_sides
            .extend(measures.map(|one| one.total_by_loads(self.mesh, plans, &self.elements)));

        // Solve, and extend the loads by the elements outside the contact: by 0, or for the measures by −∂G/∂gap.
        let touching = &self.elements[..n];
        let reversed = KernelDirection::Reversed;
        let mut solutions = solve(self.mesh, plans, touching, reversed, &right_sides)?.into_iter();
        let mut next_padded = || {
            let mut loads = solutions.next().unwrap_or_default();
            loads.resize(self.elements.len(), 0.0);
            loads
        };
        let [friction, depth] = [next_padded(), next_padded()];
        let measures = self.measures().map(|one| {
            let mut loads = next_padded();
            for (load, by_gap) in loads[n..].iter_mut().zip(&one.by_gaps) {
                *load = -by_gap;
            }
            loads
        });
        let adjoint = AdjointLoads {
            friction,
            depth,
            measures: measures.collect(),
        };
        Ok((mean, adjoint))
    }

    /// Slopes of the body over the elements, which do not depend on the loads.
    pub(super) fn slopes_of_body(&self, slope_terms: Vec<f64>) -> Slopes {
        Slopes {
            by_others: vec![0.0; slope_terms.len()],
            at_elements: slope_terms,
        }
    }

    /// Explicit slope terms of the body less the slopes of the displacements between the neighbours of each element along x.
    pub(super) fn slopes_of_surface(&self, slope_terms: &[f64], plans: &mut Plans) -> Slopes {
        // A region of the neighbours ahead, the neighbours behind and the elements, with the loads on the last.
        let n = self.elements.len();
        let places = || {
            let elements = self.elements.iter();
            elements.map(|&element| self.mesh.places(element))
        };
        let moved = |step: fn(usize) -> usize| {
            places().map(move |both| both.map(|[row, column]| [step(row), column]))
        };
        // A field takes the last of several values at one place: that of the element.
        let with_neighbours = moved(|row| row + 1)
            .chain(moved(|row| row - 1))
            .chain(places());
        let region = Region::around(with_neighbours.collect::<Vec<_>>().iter().copied());
        let loads = [&vec![0.0; 2 * n], &self.loads[..]].concat();

        // Central differences for the motion and for the reversed one, which gives the derivative by the other loads.
        let mut differences = |region: &Region| -> Vec<f64> {
            let mut operator = KernelOperator::new(plans.kernel(region.shape), region);
            let displacements = operator.apply(0, &loads, region);
            let difference = |element| 0.5 * (displacements[element] - displacements[n + element]);
            (0..n).map(difference).collect()
        };
        let [slopes, reversed] = [differences(&region), differences(&region.reversed())];
        let at_elements = slope_terms.iter().zip(&slopes);
        Slopes {
            at_elements: at_elements.map(|(term, slope)| term - slope).collect(),
            by_others: reversed,
        }
    }
}

/// The slopes whose mean under the load is the friction.
pub(super) struct Slopes {
    at_elements: Vec<f64>,
    /// Sum over all elements of the load times the derivative of the slope by the load of this element.
    by_others: Vec<f64>,
}
