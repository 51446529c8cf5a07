//! Iterative solution of the equations of a dense contact: the unknowns are the gaps of the open elements, which are fewer.
//!
//! ```text
//! S (y − r) = 0  on the open elements,   with the inverse S of K on the whole grid, without its mean
//! ```
//!
//! for the present gaps r of the elements in contact and the changes y of the other gaps. The pressure S (y − r) closes the gaps r
//! (Schur complement). On large grids the Krylov basis of these few unknowns fits into the memory, while that of the pressures in
//! contact is truncated: with moduli that differ by some thousand, GCR then stagnates. Measured: a contact of 94 % of 1024² elements
//! whose moduli differ by 2486 was not found in 2044 operator applications and 189 s of processor time, and is in 38 s.

use numerics::transforms::Real as _;

use super::{AllowedGaps, Equations, MAX_STEPS};
use crate::parallel::reductions::{add_scaled, mean};
use crate::parallel::row_blocks::copies;
use crate::stationary::conjugate_residuals::{GcrLimits, gcr, norm};
use crate::stationary::search::FixedSetSolver as _;

/// Ratio of the gaps that a solution leaves to those before it, above which there is no other one. Chosen; it decides the time alone.
const MIN_PROGRESS: f64 = 0.5;

impl Equations {
    /// Whether the gaps of the open elements are fewer unknowns than the pressures in contact, under a mean pressure.
    pub(super) fn has_few_open_elements(&self) -> bool {
        self.depth_is_free() && self.n_open() < self.n_contact()
    }

    /// Iterates by GCR until the gaps are allowed, as long as that makes progress; the unknowns are the gaps of the open elements. A basis
    /// has at most `basis_floats` numbers in single precision.
    pub(super) fn iterate_open_gaps(&mut self, allowed: &AllowedGaps, basis_floats: usize) {
        let n = self.scattered.len();
        let open: Vec<usize> = (0..n)
            .filter(|element| !self.active.contains(*element))
            .collect();
        let max_directions = (basis_floats / (4 * open.len().max(1))).clamp(1, MAX_STEPS);
        let limits = GcrLimits {
            max_steps: MAX_STEPS,
            truncation_depth: max_directions - 1,
        };
        let sqrt_n = (open.len() as f64).sqrt();
        let mut before = self.rms(norm(&self.gap));
        loop {
            // The loads under the present gaps, as if the open elements had no gap.
            let gaps: Vec<f64> = self.gap.iter().map(|gap| f64::from(*gap)).collect();
            let [mut field, mut loads] = [(); 2].map(|()| vec![0.0; n]);
            self.active.scatter(&gaps, &mut field);
            self.apply_exact_inverse(&field, &mut loads);
            // Find the gaps of the open elements that remove the loads on them. The residual is the displacement by the remaining loads,
            // because small loads on the most compliant waves displace the contact far; on the open elements it is as small as an allowed gap.
            let mut of_open = vec![0.0; open.len()];
            let mut remaining: Vec<f64> = open.iter().map(|element| -loads[*element]).collect();
            let mut work = [(); 2].map(|()| vec![0.0; n]);
            self.displace_open(&open, &mut remaining, &mut work);
            gcr(
                &mut of_open,
                &mut remaining,
                limits,
                |state, direction, image| {
                    let rms = state.residual_square.sqrt() / sqrt_n;
                    if allowed.contain(rms, state.residual) {
                        return false;
                    }
                    for (value, residual) in direction.iter_mut().zip(state.source) {
                        *value = -residual;
                    }
                    let [gaps, loads] = &mut work;
                    gaps.fill(0.0);
                    for (element, gap) in open.iter().zip(&*direction) {
                        gaps[*element] = *gap;
                    }
                    self.apply_exact_inverse(gaps, loads);
                    for (element, image) in open.iter().zip(&mut *image) {
                        *image = loads[*element];
                    }
                    self.displace_open(&open, image, &mut work);
                    true
                },
            );
            // Add the loads on the contact, with the mean that they lose on the open elements.
            for (element, gap) in open.iter().zip(&of_open) {
                field[*element] = -gap;
            }
            self.apply_exact_inverse(&field, &mut loads);
            let mut packed = self.gather(&loads);
            let lost = mean(&packed);
            for load in &mut packed {
                *load = lost - *load;
            }
            // Undo the update if it increases the gaps.
            let kept = (self.pressure.clone(), self.gap.clone());
            self.add_loads(packed);
            let after = self.rms(norm(&self.gap));
            if after > before || after.is_nan() {
                (self.pressure, self.gap) = kept;
                return;
            }
            if self.are_allowed(allowed) || after > MIN_PROGRESS * before {
                return;
            }
            before = after;
        }
    }

    /// Replaces loads on the `open` elements, in their unit, by the displacements of these elements.
    fn displace_open(&mut self, open: &[usize], values: &mut [f64], work: &mut [Vec<f64>; 2]) {
        let [loads, displacements] = work;
        loads.fill(0.0);
        for (element, load) in open.iter().zip(&*values) {
            loads[*element] = load / self.self_influence;
        }
        self.displace(loads, displacements);
        for (element, value) in open.iter().zip(values) {
            *value = displacements[*element];
        }
    }

    /// Adds packed `loads` to the pressure, in its unit, and their image to the gaps.
    pub(super) fn add_loads(&mut self, loads: Vec<f64>) {
        let unit = self.unit / self.self_influence;
        for (pressure, load) in self.pressure.iter_mut().zip(&loads) {
            *pressure += unit * load;
        }
        let added: Vec<f32> = loads.into_iter().map(f32::rounded).collect();
        let mut image = copies(0.0, added.len());
        self.apply_influence(&added, &mut image);
        add_scaled(&mut self.gap, 1.0, &image);
    }
}

#[cfg(test)]
mod tests {
    use crate::Grid;
    use crate::parallel::reductions::mean;
    use crate::stationary::periodic::PeriodicControl;
    use crate::stationary::periodic::equations::elimination::tests::stiffening_solid;
    use crate::stationary::periodic::equations::{AllowedGaps, Equations};
    use crate::stationary::periodic::kernel::MaterialAtSpeed;
    use crate::stationary::search::FixedSetSolver as _;

    const SIDE: usize = 64;

    /// Islands of open elements in a contact on a solid whose moduli differ by 1000: an arbitrary gap falls by four orders, by pressures without a
    /// mean.
    #[test]
    fn the_gaps_of_few_open_elements_close_all_others() {
        let material = stiffening_solid();
        let grid = Grid::new([SIDE; 2], [1.0 / SIDE as f64; 2]).expect("a grid");
        let sliding = MaterialAtSpeed::new(&material, 0.3).expect("a solid");
        let control = PeriodicControl::MeanPressure(1.0);
        let mut equations = Equations::new(&sliding, &grid, control).expect("equations");
        let is_open = |element: usize| {
            let [row, column] = [element / SIDE, element % SIDE];
            (row / 4 + 2 * (column / 4)).is_multiple_of(7) && (row % 4 + column % 4) < 5
        };
        let contact: Vec<bool> = (0..SIDE * SIDE).map(|element| !is_open(element)).collect();
        let before: Vec<f64> = (0..SIDE * SIDE)
            .map(|element| (0.1 * element as f64).sin())
            .collect();
        let mut pressure = vec![0.0; SIDE * SIDE];
        equations.set_active_set(&contact, &pressure, &before);
        assert!(equations.has_few_open_elements(), "most are in contact");
        let allowed = AllowedGaps {
            rms: 1e-5,
            max: 0.0,
        };
        equations.iterate_open_gaps(&allowed, usize::MAX);
        equations.copy_pressure_to(&mut pressure);
        assert!(mean(&pressure).abs() < 1e-9, "{}", mean(&pressure));
        let mut gap = vec![0.0; SIDE * SIDE];
        equations.displace(&pressure, &mut gap);
        let inside = (0..SIDE * SIDE).filter(|element| contact[*element]);
        let gaps: Vec<f64> = inside.map(|one| gap[one] + before[one]).collect();
        let depth = mean(&gaps);
        let squares: f64 = gaps.iter().map(|gap| (gap - depth).powi(2)).sum();
        let rms = (squares / gaps.len() as f64).sqrt();
        assert!(rms < 1e-4, "{rms}");
    }
}
