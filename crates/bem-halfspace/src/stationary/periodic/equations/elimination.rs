//! Direct solution of the equations if few elements are in contact, or few are open, whatever the ratio of the moduli is.
//!
//! If few elements are active, the dense matrix of their influence coefficients is factorised. If few elements are open, their
//! gaps are the unknowns (complement solve). The inverse of K on the whole grid then gives the pressure that closes all other
//! gaps. The gaps of the open elements are those that leave no pressure there. The mean pressure, on which the gaps do not
//! depend, is one more unknown.

use super::{Equations, unit_response};
use crate::contact::active_set::Run;
use crate::dense;
use crate::parallel::reductions::mean;
use crate::stationary::periodic::kernel::PeriodicKernel;

impl Equations {
    /// Number of unknowns of a direct solve: elements in contact or open elements, whichever are fewer.
    pub(super) fn n_unknowns(&self) -> f64 {
        self.n_contact().min(self.n_open())
    }

    /// Number of active elements.
    pub(super) fn n_contact(&self) -> f64 {
        self.active.len() as f64
    }

    /// Number of elements outside the active set.
    pub(super) fn n_open(&self) -> f64 {
        self.scattered.len() as f64 - self.n_contact()
    }

    /// Adds the pressures that close the gaps and keep the prescribed quantity, and updates the gaps; does nothing if the matrix is
    /// singular.
    pub(super) fn solve_directly(&mut self) {
        let found = if self.n_contact() <= self.n_open() {
            self.factorise_active_set()
        } else {
            self.solve_complement()
        };
        if let Some(loads) = found {
            self.add_loads(loads);
        }
    }

    /// The packed pressures that close the gaps, in their unit, from the dense influence matrix of the active set; `None` if that is
    /// singular.
    fn factorise_active_set(&mut self) -> Option<Vec<f64>> {
        // List the elements in contact. The response to a unit pressure, over the self-influence, holds all influence coefficients.
        let runs = (0..self.active.row_blocks.n_blocks())
            .flat_map(|row_block| self.active.runs(row_block));
        let elements: Vec<usize> = runs.flat_map(Run::elements).collect();
        let mut image = unit_response(
            &mut self.kernel,
            PeriodicKernel::displace,
            self.scattered.len(),
        );
        image.iter_mut().for_each(|gap| *gap /= self.self_influence);
        // Solve for the pressures under the gaps and under the unit gap. A free depth changes so that the mean pressure stays.
        let gaps = self.gap.iter().map(|gap| f64::from(*gap)).collect();
        let entry = translation_invariant(&image, self.active.columns, &elements);
        let solved = dense::solve(entry, vec![gaps, vec![1.0; elements.len()]])?;
        let depth = if self.depth_is_free() {
            solved[0].iter().sum::<f64>() / solved[1].iter().sum::<f64>()
        } else {
            0.0
        };
        let responses = solved[0].iter().zip(&solved[1]);
        Some(responses.map(|(gap, unit)| depth * unit - gap).collect())
    }

    /// The packed pressures that close the gaps, in their unit, from the inverse of K on the whole grid. The unknowns are the gaps
    /// of the open elements and the mean pressure; `None` if the dense matrix of their equations is singular.
    fn solve_complement(&mut self) -> Option<Vec<f64>> {
        // Compute the loads under the present gaps, as if the open elements had no gap.
        let n = self.scattered.len();
        let open: Vec<usize> = (0..n)
            .filter(|element| !self.active.contains(*element))
            .collect();
        let gaps: Vec<f64> = self.gap.iter().map(|gap| f64::from(*gap)).collect();
        let [mut field, mut loads] = [(); 2].map(|()| vec![0.0; n]);
        self.active.scatter(&gaps, &mut field);
        self.apply_exact_inverse(&field, &mut loads);

        // Solve for the gaps of the open elements and the mean pressure that leave no pressure on the open elements. A prescribed
        // mean pressure does not change. At a prescribed depth the mean of the gaps is the displacement by the mean pressure.
        let mut image = unit_response(&mut self.kernel, PeriodicKernel::invert, n);
        image
            .iter_mut()
            .for_each(|load| *load *= self.self_influence);
        let (last, depth_is_free) = (open.len(), self.depth_is_free());
        let compliance = self.kernel.mean_compliance / self.self_influence;
        let of_open = translation_invariant(&image, self.active.columns, &open);
        let entry = |row: usize, column: usize| match (row < last, column < last) {
            (true, true) => of_open(row, column),
            (true, false) => -1.0,
            (false, true) if depth_is_free => 0.0,
            (false, true) => 1.0 / n as f64,
            (false, false) if depth_is_free => 1.0,
            (false, false) => compliance,
        };
        let change = if depth_is_free { 0.0 } else { mean(&field) };
        let right_side = open.iter().map(|element| loads[*element]);
        let solved = dense::solve(entry, vec![right_side.chain([change]).collect()])?;
        for (element, gap) in open.iter().zip(&solved[0]) {
            field[*element] = -gap;
        }
        self.apply_exact_inverse(&field, &mut loads);
        let mean_pressure = solved[0][last];
        let packed = self.gather(&loads).into_iter();
        Some(packed.map(|load| -load - mean_pressure).collect())
    }

    /// Writes the pressures without mean, in their unit, that displace the whole grid by a `field` less its mean; in double precision.
    pub(super) fn apply_exact_inverse(&mut self, field: &[f64], loads: &mut [f64]) {
        self.applications += 1;
        self.kernel.invert(field, loads);
        let own = self.self_influence;
        loads.iter_mut().for_each(|load| *load *= own);
    }
}

/// Entries (row, column) of the dense matrix of a translation-invariant periodic map with the unit response `image`, a field with
/// `columns` columns. The matrix relates the given `elements` to each other.
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
pub(super) mod tests {
    use rheology::{Compressible, Prony, RelaxationBranch, RelaxationSpectrum};

    use crate::parallel::reductions::mean;
    use crate::stationary::periodic::PeriodicControl;
    use crate::stationary::periodic::equations::Equations;
    use crate::stationary::periodic::kernel::MaterialAtSpeed;
    use crate::stationary::search::FixedSetSolver as _;
    use crate::{Grid, Layer};

    const SIDE: usize = 24;

    /// A solid whose moduli differ by a factor of 1000.
    pub(in crate::stationary::periodic::equations) fn stiffening_solid() -> Prony {
        let branches = vec![RelaxationBranch {
            modulus: 999.0,
            relaxation_time: 1.0,
        }];
        let spectrum = RelaxationSpectrum::new(1.0, 0.0, branches).expect("a spectrum");
        Prony::new(spectrum).expect("a material")
    }

    /// Few elements in contact, then few open ones, with an arbitrary gap, under a mean pressure and at a depth.
    #[test]
    fn a_direct_solve_closes_all_gaps_on_the_active_set() {
        let material = stiffening_solid();
        let grid = Grid::new([SIDE; 2], [1.0 / SIDE as f64; 2]).expect("a grid");
        let solid = Compressible::new(&material, 0.3).expect("a ratio");
        let layer = Layer::new(&solid, 0.1).expect("a thickness");
        let slidings = [
            MaterialAtSpeed::new(&material, 0.3),
            MaterialAtSpeed::new(&layer, 0.3),
        ];
        let slidings = slidings.map(|sliding| sliding.expect("a solid"));
        let controls = [
            PeriodicControl::MeanPressure(1.0),
            PeriodicControl::MeanDepth(-1.0),
        ];
        let cases = slidings.iter().flat_map(|sliding| {
            let with =
                move |control| [false, true].map(|in_contact| (sliding, control, in_contact));
            controls.into_iter().flat_map(with)
        });
        for (sliding, control, in_contact) in cases {
            let mut equations = Equations::new(sliding, &grid, control).expect("equations");
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
            let case = format!("{control:?}, {in_contact}");
            let is_pressed = matches!(control, PeriodicControl::MeanPressure(_));
            let allowed = if is_pressed { mean(&gaps) } else { 0.0 };
            for gap in gaps {
                assert!((gap - allowed).abs() < 1e-6, "{case}: {gap} {allowed}");
            }
            let outside = (0..SIDE * SIDE).filter(|element| !contact[*element]);
            assert!(outside.into_iter().all(|element| pressure[element] == 0.0));
            let largest = pressure.iter().fold(0.0_f64, |top, p| top.max(p.abs()));
            let sum: f64 = pressure.iter().sum();
            let keeps_pressure = sum.abs() < 1e-10 * largest;
            assert_eq!(keeps_pressure, is_pressed, "{case}: {sum} {largest}");
        }
    }
}
