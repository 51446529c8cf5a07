//! The equations of a contact of few elements, or of one that leaves few elements open, by elimination: no ratio of moduli slows
//! that down.
//!
//! The pressures of few elements follow from their influence on each other. Beside few open elements the pressures that close all
//! gaps follow from the inverse of K on the whole grid, once the gaps of these few are known; they are those that leave no
//! pressure there.

use nalgebra::DMatrix;
use numerics::transforms::Real as _;

use super::{Equations, of_first};
use crate::contact::active_set::Run;
use crate::parallel::bands::copies;
use crate::parallel::reductions::add;
use crate::stationary::periodic::kernel::PeriodicKernel;

impl Equations {
    /// Elements in contact, or open ones, whichever are fewer.
    pub(super) fn n_unknowns(&self) -> f64 {
        self.n_contact.min(self.n_open())
    }

    fn n_open(&self) -> f64 {
        self.scattered.len() as f64 - self.n_contact
    }

    /// Adds the pressures without mean that close the gaps.
    pub(super) fn eliminate(&mut self) {
        let found = if self.n_contact <= self.n_open() {
            self.of_few_elements()
        } else {
            self.beside_few_open()
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
        self.displaced(&added, &mut image);
        add_scaled(&mut self.gap, 1.0, &image);
    }

    /// The pressures that close the gaps, in their unit, of a contact of few elements.
    fn of_few_elements(&mut self) -> Option<Vec<f64>> {
        let runs =
            (0..self.neighbourhood.bands.n_bands()).flat_map(|band| self.neighbourhood.runs(band));
        let listed = runs.flat_map(Run::elements).enumerate();
        let (places, elements): (Vec<usize>, Vec<usize>) = listed
            .filter(|(place, _)| self.inside[*place] > 0.0)
            .unzip();
        let mut image = of_first(
            &mut self.kernel,
            PeriodicKernel::displace,
            self.scattered.len(),
        );
        image.iter_mut().for_each(|gap| *gap /= self.self_influence);
        let sides = [&self.gap, &*self.inside];
        let sides = DMatrix::from_fn(elements.len(), 2, |place, side| {
            f64::from(sides[side][places[place]])
        });
        let matrix = influence(&image, self.neighbourhood.columns, &elements);
        let solved = matrix.lu().solve(&sides)?;
        let depth = solved.column(0).sum() / solved.column(1).sum();
        let mut loads = vec![0.0; self.inside.len()];
        for (row, place) in places.into_iter().enumerate() {
            loads[place] = depth * solved[(row, 1)] - solved[(row, 0)];
        }
        Some(loads)
    }

    /// Likewise of a contact that leaves few elements open.
    fn beside_few_open(&mut self) -> Option<Vec<f64>> {
        let n = self.scattered.len();
        let mut inside = copies(0.0, n);
        self.neighbourhood.scatter(&self.inside, &mut inside);
        let open: Vec<usize> = (0..n).filter(|element| inside[*element] == 0.0).collect();
        let gaps = self.gap.iter().zip(&*self.inside);
        let gaps: Vec<f64> = gaps.map(|(gap, inside)| f64::from(gap * inside)).collect();
        let [mut field, mut loads] = [(); 2].map(|()| vec![0.0; n]);
        self.neighbourhood.scatter(&gaps, &mut field);
        self.invert_exactly(&field, &mut loads);
        if !open.is_empty() {
            let mut image = of_first(&mut self.kernel, PeriodicKernel::invert, n);
            image
                .iter_mut()
                .for_each(|load| *load *= self.self_influence);
            let side = DMatrix::from_fn(open.len(), 1, |place, _| loads[open[place]]);
            let matrix = influence(&image, self.neighbourhood.columns, &open);
            let opened = matrix.lu().solve(&side)?;
            for (element, gap) in open.iter().zip(&opened) {
                field[*element] = -gap;
            }
            self.invert_exactly(&field, &mut loads);
        }
        let pairs = self.gather(&loads).into_iter().zip(&*self.inside);
        Some(
            pairs
                .map(|(load, inside)| -load * f64::from(*inside))
                .collect(),
        )
    }

    /// The pressures without mean that displace the whole grid by a field, but for its mean, in their unit.
    fn invert_exactly(&mut self, field: &[f64], loads: &mut [f64]) {
        self.products += 1;
        self.kernel.invert(field, loads);
        let own = self.self_influence;
        loads.iter_mut().for_each(|load| *load *= own);
    }
}

/// The dense part, for some elements, of a map that is the same everywhere, from what it makes of the first element of the grid.
fn influence(image: &[f64], columns: usize, elements: &[usize]) -> DMatrix<f64> {
    let rows = image.len() / columns;
    let between = |to: usize, from: usize| {
        let row = (to / columns + rows - from / columns) % rows;
        let column = (to % columns + columns - from % columns) % columns;
        image[row * columns + column]
    };
    DMatrix::from_fn(elements.len(), elements.len(), |to, from| {
        between(elements[to], elements[from])
    })
}

#[cfg(test)]
mod tests {
    use rheology::{Prony, RelaxationBranch, RelaxationSpectrum};

    use crate::Grid;
    use crate::stationary::periodic::equations::Equations;
    use crate::stationary::periodic::kernel::Sliding;

    const SIDE: usize = 24;

    /// Of few elements in contact, and of few open ones; the gap is any.
    #[test]
    fn elimination_closes_all_gaps_of_a_contact() {
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
            equations.eliminate();
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
