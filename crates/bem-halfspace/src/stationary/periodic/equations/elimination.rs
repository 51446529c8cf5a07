//! Direct solution of the equations if few elements are in contact, or few are open, whatever the ratio of the moduli is.
//!
//! On few active elements the dense matrix of their influence coefficients is factorised. Next to few open elements (complement
//! solve) the pressure that closes all gaps follows from the inverse of K on the whole grid, once the gaps of the open elements
//! are known. These are the gaps that leave no pressure there.

use numerics::transforms::Real as _;

use super::{Equations, unit_response};
use crate::contact::active_set::Run;
use crate::dense;
use crate::parallel::reductions::add_scaled;
use crate::parallel::row_blocks::copies;
use crate::stationary::periodic::kernel::PeriodicKernel;

impl Equations {
    /// Number of unknowns of a direct solve: elements in contact or open elements, whichever are fewer.
    pub(super) fn n_unknowns(&self) -> f64 {
        self.n_contact.min(self.n_open())
    }

    /// Number of elements outside the active set.
    fn n_open(&self) -> f64 {
        self.scattered.len() as f64 - self.n_contact
    }

    /// Adds the pressures without mean that close the gaps; does nothing if the matrix is singular.
    pub(super) fn solve_directly(&mut self) {
        let found = if self.n_contact <= self.n_open() {
            self.factorise_active_set()
        } else {
            self.solve_complement()
        };
        let Some(loads) = found else {
            return;
        };
        let unit = self.unit / self.self_influence;
        for (pressure, load) in self.pressure.iter_mut().zip(&loads) {
            *pressure += unit * load;
        }
        let added: Vec<f32> = loads.into_iter().map(f32::rounded).collect();
        let mut image = copies(0.0, added.len());
        self.apply_influence(&added, &mut image);
        add_scaled(&mut self.gap, 1.0, &image);
    }

    /// The pressures that close the gaps, in their unit, from the dense influence matrix of the active set; `None` if that is
    /// singular.
    fn factorise_active_set(&mut self) -> Option<Vec<f64>> {
        let runs = (0..self.neighbourhood.row_blocks.n_blocks())
            .flat_map(|row_block| self.neighbourhood.runs(row_block));
        let indexed = runs.flat_map(Run::elements).enumerate();
        let (packed, elements): (Vec<usize>, Vec<usize>) = indexed
            .filter(|(index, _)| self.inside[*index] > 0.0)
            .unzip();
        let mut image = unit_response(
            &mut self.kernel,
            PeriodicKernel::displace,
            self.scattered.len(),
        );
        image.iter_mut().for_each(|gap| *gap /= self.self_influence);
        // Responses to the gaps and to the unit gap, combined so that the mean pressure vanishes.
        let right_sides = [&self.gap, &*self.inside].map(|vector| {
            let values = packed.iter().map(|index| f64::from(vector[*index]));
            values.collect()
        });
        let entry = translation_invariant(&image, self.neighbourhood.columns, &elements);
        let solved = dense::solve(entry, right_sides.into())?;
        let depth = solved[0].iter().sum::<f64>() / solved[1].iter().sum::<f64>();
        let mut loads = vec![0.0; self.inside.len()];
        for (index, (gap, unit)) in packed.into_iter().zip(solved[0].iter().zip(&solved[1])) {
            loads[index] = depth * unit - gap;
        }
        Some(loads)
    }

    /// The pressures that close the gaps, in their unit, from the inverse of K and the gaps of the open elements; `None` if the
    /// dense matrix of the inverse on the open elements is singular.
    fn solve_complement(&mut self) -> Option<Vec<f64>> {
        let n = self.scattered.len();
        let mut inside = copies(0.0, n);
        self.neighbourhood.scatter(&self.inside, &mut inside);
        let open: Vec<usize> = (0..n).filter(|element| inside[*element] == 0.0).collect();
        let gaps = self.gap.iter().zip(&*self.inside);
        let gaps: Vec<f64> = gaps.map(|(gap, inside)| f64::from(gap * inside)).collect();
        let [mut field, mut loads] = [(); 2].map(|()| vec![0.0; n]);
        self.neighbourhood.scatter(&gaps, &mut field);
        self.apply_exact_inverse(&field, &mut loads);
        // Gaps of the open elements that leave no pressure there.
        if !open.is_empty() {
            let mut image = unit_response(&mut self.kernel, PeriodicKernel::invert, n);
            image
                .iter_mut()
                .for_each(|load| *load *= self.self_influence);
            let right_side = open.iter().map(|element| loads[*element]).collect();
            let entry = translation_invariant(&image, self.neighbourhood.columns, &open);
            let open_gaps = dense::solve(entry, vec![right_side])?;
            for (element, gap) in open.iter().zip(&open_gaps[0]) {
                field[*element] = -gap;
            }
            self.apply_exact_inverse(&field, &mut loads);
        }
        let pairs = self.gather(&loads).into_iter().zip(&*self.inside);
        Some(
            pairs
                .map(|(load, inside)| -load * f64::from(*inside))
                .collect(),
        )
    }

    /// The pressures without mean, in their unit, that displace the whole grid by a field less its mean; in double precision.
    fn apply_exact_inverse(&mut self, field: &[f64], loads: &mut [f64]) {
        self.products += 1;
        self.kernel.invert(field, loads);
        let own = self.self_influence;
        loads.iter_mut().for_each(|load| *load *= own);
    }
}

/// Entry (row, column) of the dense matrix, for some elements, of a translation-invariant map with the unit response `image`.
fn translation_invariant(
    image: &[f64],
    columns: usize,
    elements: &[usize],
) -> impl Fn(usize, usize) -> f64 {
    let rows = image.len() / columns;
    move |to: usize, from: usize| {
        let [to, from] = [elements[to], elements[from]];
        let row = (to / columns + rows - from / columns) % rows;
        let column = (to % columns + columns - from % columns) % columns;
        image[row * columns + column]
    }
}

#[cfg(test)]
mod tests {
    use rheology::{Prony, RelaxationBranch, RelaxationSpectrum};

    use crate::Grid;
    use crate::stationary::periodic::equations::Equations;
    use crate::stationary::periodic::kernel::Sliding;

    const SIDE: usize = 24;

    /// Few elements in contact, then few open ones, with an arbitrary gap.
    #[test]
    fn a_direct_solve_closes_all_gaps_on_the_active_set() {
        let branches = vec![RelaxationBranch {
            modulus: 999.0,
            relaxation_time: 1.0,
        }];
        let spectrum = RelaxationSpectrum::new(1.0, 0.0, branches).expect("a spectrum");
        let material = Prony::new(spectrum).expect("a material");
        let grid = Grid::new([SIDE; 2], [1.0 / SIDE as f64; 2]).expect("a grid");
        let sliding = Sliding::new(&material, 0.3).expect("a solid");
        for in_contact in [false, true] {
            let mut equations = Equations::new(&sliding, &grid).expect("equations");
            let contact: Vec<bool> = (0..SIDE * SIDE)
                .map(|element| (element % 17 == 3) != in_contact)
                .collect();
            let before: Vec<f64> = (0..SIDE * SIDE)
                .map(|element| (element as f64).sin())
                .collect();
            let mut pressure = vec![0.0; SIDE * SIDE];
            equations.set_active_set(&contact, &pressure, &before);
            equations.solve_directly();
            equations.copy_pressure_to(&mut pressure);
            let mut gap = vec![0.0; SIDE * SIDE];
            equations.displace(&pressure, &mut gap);
            let inside = || (0..SIDE * SIDE).filter(|element| contact[*element]);
            let gaps: Vec<f64> = inside().map(|one| gap[one] + before[one]).collect();
            let mean = gaps.iter().sum::<f64>() / gaps.len() as f64;
            for gap in gaps {
                assert!((gap - mean).abs() < 1e-6, "{in_contact}: {gap} {mean}");
            }
            let outside = (0..SIDE * SIDE).filter(|element| !contact[*element]);
            assert!(outside.into_iter().all(|element| pressure[element] == 0.0));
            let largest = pressure.iter().fold(0.0_f64, |top, p| top.max(p.abs()));
            let sum: f64 = pressure.iter().sum();
            assert!(sum.abs() < 1e-10 * largest, "{sum} {largest}");
        }
    }
}
