//! The contact on one grid, and the adjoint loads of its friction and its depth.

use std::collections::HashSet;

use crate::BemError;
use crate::elements::bounds::Bounds;
use crate::elements::spread::measures_of_area;
use crate::stationary::steady::filter::Product;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::pivoting::Solution;
use crate::stationary::steady::plans::Plans;
use crate::stationary::steady::region::Region;
use crate::stationary::steady::sensitivity::adjoint::solve_transposed;
use crate::stationary::steady::sensitivity::offsets::{Field, Offsets};

/// The loads of a contact in the units of the mesh.
pub(super) struct Contact<'mesh> {
    pub(super) mesh: &'mesh Mesh,
    pub(super) elements: Vec<usize>,
    pub(super) loads: Vec<f64>,
    /// Sum of all loads.
    pub(super) total: f64,
    bounds: Bounds,
}

/// Solutions `Kᵀ y = r` in the units of the mesh.
pub(super) struct Adjoint {
    /// For the derivative of the friction by the loads.
    pub(super) friction: Vec<f64>,
    /// For a unit depth.
    pub(super) depth: Vec<f64>,
    /// For the derivatives of two measures of the logarithm of the area, see [`measures_of_area`].
    pub(super) areas: [Vec<f64>; 2],
}

impl<'mesh> Contact<'mesh> {
    pub(super) fn new(mesh: &'mesh Mesh, solution: &Solution) -> Self {
        let (elements, loads): (Vec<usize>, Vec<f64>) = solution.loads.iter().copied().unzip();
        let places = elements.iter().flat_map(|&element| mesh.places(element));
        Self {
            total: mesh.total_load(solution.loads.iter().copied()),
            bounds: Bounds::of(places).unwrap_or(Bounds::EMPTY),
            mesh,
            elements,
            loads,
        }
    }

    /// Sum over the whole contact.
    pub(super) fn sum(&self, loads: &[f64]) -> f64 {
        let elements = self.elements.iter().copied();
        self.mesh.total_load(elements.zip(loads.iter().copied()))
    }

    /// Mean load of the elements that nothing touches ahead of, relative to that of all.
    pub(super) fn load_at_front(&self) -> f64 {
        let place = |element: usize| self.mesh.places(element)[0];
        let touched: HashSet<[usize; 2]> = self.elements.iter().map(|&one| place(one)).collect();
        let pairs = self.elements.iter().zip(&self.loads);
        let front = pairs.filter(|(element, _)| {
            let [x, y] = place(**element);
            !touched.contains(&[x + 1, y])
        });
        let (sum, count) = front.fold((0.0, 0.0), |(sum, count), (&element, load)| {
            let weight = self.mesh.weight(element);
            (sum + weight * load, count + weight)
        });
        let ones = vec![1.0; self.loads.len()];
        sum / count * self.sum(&ones) / self.total
    }

    /// The weights of the kernel for a quantity with these adjoint loads.
    pub(super) fn offsets(&self, adjoint: &[f64]) -> Offsets {
        let pairs = |loads: &[f64]| -> Vec<(usize, f64)> {
            let elements = self.elements.iter().copied();
            elements.zip(loads.iter().copied()).collect()
        };
        // Each stands for its image, too.
        let adjoint = pairs(adjoint).into_iter().map(|(element, load)| {
            let [place, _] = self.mesh.places(element);
            (place, self.mesh.weight(element) * load)
        });
        let loads = self.mesh.loaded(&pairs(&self.loads)).into_iter();
        Offsets::of(
            &Field::new(&self.bounds, adjoint),
            &Field::new(&self.bounds, loads),
        )
    }

    /// The same for the mean slope of the displacements under the load.
    pub(super) fn offsets_of_slope(&self) -> Offsets {
        self.offsets(&self.loads).of_slope(self.total.recip())
    }

    /// The friction, in units of the depth scale over the length of an element, and the adjoint loads.
    pub(super) fn adjoint(
        &self,
        slopes: &Slopes,
        plans: &mut Plans,
    ) -> Result<(f64, Adjoint), BemError> {
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
        let [area, rough_area] = measures_of_area(&self.loads, |powers| self.sum(powers));
        let ones = vec![1.0; self.elements.len()];
        let right = [by_loads.collect(), ones, area, rough_area];
        let [friction, depth, area, rough_area] =
            solve_transposed(self.mesh, plans, &self.elements, right)?;
        let adjoint = Adjoint {
            friction,
            depth,
            areas: [area, rough_area],
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
            let mut product = Product::new(plans.kernel(region.shape), region);
            let moved = product.apply(0, &loads, region);
            (0..n)
                .map(|element| 0.5 * (moved[element] - moved[n + element]))
                .collect()
        };
        let [under, turned] = [differences(&region), differences(&region.turned())];
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

/// The slope under each element, of which the friction is the mean, and its derivative by the load of another one, summed
/// over the loads of all.
pub(super) struct Slopes {
    at_elements: Vec<f64>,
    by_others: Vec<f64>,
}
