//! The contact on one grid, and the adjoint loads of its friction and its depth.

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

/// The loads of a contact in the units of the mesh.
pub(super) struct LoadedContact<'mesh> {
    pub(super) mesh: &'mesh Mesh,
    /// Those in contact, and then those beside it, on which a change is felt, too.
    pub(super) elements: Vec<usize>,
    /// Of all of these.
    pub(super) loads: Vec<f64>,
    /// How many are in contact.
    n_touching: usize,
    /// None under a body with edges, at which the contact ends.
    rim: Option<BoundaryMeasures>,
    /// Sum of all loads.
    pub(super) total: f64,
    bounds: Bounds,
}

/// Solutions `Kᵀ y = r` in the units of the mesh.
pub(super) struct AdjointLoads {
    /// For the derivative of the friction by the loads.
    pub(super) friction: Vec<f64>,
    /// For a unit depth.
    pub(super) depth: Vec<f64>,
    /// For the derivatives of the area and of the growth, see [`crate::elements::contact_boundary`]; none under a body with edges.
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
        let rim = (!mesh.loading.has_edges)
            .then(|| BoundaryMeasures::new(mesh, plans, &elements, &loads, solution.depth));
        let rim = rim.transpose()?;
        elements.extend(rim.iter().flat_map(|rim| &rim.outside));
        loads.resize(elements.len(), 0.0);
        let places = elements.iter().flat_map(|&element| mesh.places(element));
        Ok(Self {
            total: mesh.total_load(solution.loads.iter().copied()),
            bounds: Bounds::enclosing(places).unwrap_or(Bounds::EMPTY),
            mesh,
            elements,
            loads,
            n_touching,
            rim,
        })
    }

    /// Unknown pressures.
    pub(super) const fn n_touching(&self) -> usize {
        self.n_touching
    }

    /// The area and the growth, where they are asked for.
    pub(super) fn measures(&self) -> impl Iterator<Item = &MeasureGradient> {
        let rim = self.rim.iter();
        rim.flat_map(|rim| [&rim.area, &rim.boundary_weight])
    }

    /// Sum over the whole contact.
    pub(super) fn sum(&self, loads: &[f64]) -> f64 {
        let elements = self.elements.iter().copied();
        self.mesh.total_load(elements.zip(loads.iter().copied()))
    }

    /// The weights of the kernel for a quantity with these adjoint loads.
    pub(super) fn correlation(&self, adjoint: &[f64]) -> Correlation {
        let pairs = |loads: &[f64]| -> Vec<(usize, f64)> {
            let elements = self.elements.iter().copied();
            elements.zip(loads.iter().copied()).collect()
        };
        // Each stands for its image, too.
        let adjoint = pairs(adjoint).into_iter().map(|(element, load)| {
            let [place, _] = self.mesh.places(element);
            (place, self.mesh.weight(element) * load)
        });
        let loads = self.mesh.loaded_places(&pairs(&self.loads)).into_iter();
        Correlation::of(
            &Field::new(&self.bounds, adjoint),
            &Field::new(&self.bounds, loads),
        )
    }

    /// The same for the mean slope of the displacements under the load.
    pub(super) fn slope_correlation(&self) -> Correlation {
        self.correlation(&self.loads).of_slope(self.total.recip())
    }

    /// The friction, in units of the depth scale over the length of an element, and the adjoint loads.
    pub(super) fn adjoint(
        &self,
        slopes: &Slopes,
        plans: &mut Plans,
    ) -> Result<(f64, AdjointLoads), BemError> {
        let pairs = self.loads.iter().zip(&slopes.at_elements);
        let weights = self
            .elements
            .iter()
            .map(|&element| self.mesh.weight(element));
        let mean = pairs
            .zip(weights)
            .map(|((load, slope), weight)| weight * load * slope);
        let mean = mean.sum::<f64>() / self.total;
        let by_loads = slopes.at_elements.iter().zip(&slopes.by_others);
        let by_loads = by_loads.map(|(here, others)| (here + others - mean) / self.total);
        let n = self.n_touching;
        let mut right = vec![by_loads.take(n).collect(), vec![1.0; n]];
        let measures = self.measures();
        right.extend(measures.map(|one| one.total_by_loads(self.mesh, plans, &self.elements)));
        let touching = &self.elements[..n];
        let mut solved = solve(
            self.mesh,
            plans,
            touching,
            KernelDirection::Reversed,
            &right,
        )?
        .into_iter();
        let mut felt = || {
            let mut loads = solved.next().unwrap_or_default();
            loads.resize(self.elements.len(), 0.0);
            loads
        };
        let [friction, depth] = [felt(), felt()];
        let measures = self.measures().map(|one| {
            let mut loads = felt();
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

    /// The slopes of the body alone.
    pub(super) fn slopes_of_body(&self, own: Vec<f64>) -> Slopes {
        Slopes {
            by_others: vec![0.0; own.len()],
            at_elements: own,
        }
    }

    /// The slopes of the displacements, with what those of the body are over them.
    pub(super) fn slopes_of_surface(&self, own: &[f64], plans: &mut Plans) -> Slopes {
        let n = self.elements.len();
        let places = || {
            self.elements
                .iter()
                .map(|&element| self.mesh.places(element))
        };
        let moved = |step: fn(usize) -> usize| {
            places().map(move |both| both.map(|[row, column]| [step(row), column]))
        };
        // Where two are the same the last one counts.
        let all = moved(|row| row + 1)
            .chain(moved(|row| row - 1))
            .chain(places());
        let region = Region::around(all.collect::<Vec<_>>().iter().copied());
        let loads = [&vec![0.0; 2 * n], &self.loads[..]].concat();
        let mut differences = |region: &Region| -> Vec<f64> {
            let mut operator = KernelOperator::new(plans.kernel(region.shape), region);
            let moved = operator.apply(0, &loads, region);
            (0..n)
                .map(|element| 0.5 * (moved[element] - moved[n + element]))
                .collect()
        };
        let [under, turned] = [differences(&region), differences(&region.reversed())];
        Slopes {
            at_elements: own
                .iter()
                .zip(&under)
                .map(|(own, under)| own - under)
                .collect(),
            by_others: turned,
        }
    }
}

/// The slope under each element, of which the friction is the mean, and its derivative by the load of another one, assemble
/// over the loads of all.
pub(super) struct Slopes {
    at_elements: Vec<f64>,
    by_others: Vec<f64>,
}
