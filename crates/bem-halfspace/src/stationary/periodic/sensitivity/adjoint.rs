//! The adjoint loads of a contact of a periodic surface, and what each quantity asks of its kernel.

use numerics::transforms::Real;
use rustfft::num_complex::Complex;

use crate::elements::area;
use crate::elements::contact_boundary::{
    BoundaryDerivatives, BoundaryField, ContactBoundary, LOAD_GAP_RATIO,
};
use crate::parallel::reductions::dot;
use crate::stationary::periodic::equations::Equations;
use crate::stationary::periodic::fourier_multiplier::FourierMultiplier;
use crate::stationary::periodic::kernel::Sliding;
use crate::{BemError, Grid};

/// Residual of the adjoint equations over their right side, and the part of it that is left after a round of directions.
const TOLERANCE: f64 = 1e-7;
const ROUND: f64 = 1e-3;
const MOST_ROUNDS: usize = 20;
/// Rounds that leave more of the residual are the last.
const LEAST_REDUCTION: f64 = 0.7;

#[derive(Debug)]
pub(super) struct Gradient {
    /// By the height of each element, per metre.
    pub(super) by_height: Vec<f64>,
    /// Of which the real part of the product with the change of the compliance of each row is that of the quantity.
    pub(super) by_row: Vec<Complex<f64>>,
    /// By the mean pressure, per pascal.
    pub(super) by_pressure: f64,
}

/// Makes the derivatives of a contact.
pub(super) struct Adjoint<'a> {
    pub(super) equations: Equations,
    /// Turned about.
    pub(super) contact: Vec<bool>,
    pub(super) waves: FourierMultiplier,
    pub(super) sliding: &'a Sliding,
    pub(super) grid: &'a Grid,
    /// \[m].
    pub(super) heights: &'a [f64],
    pub(super) pressure: Vec<f64>,
}

/// What a contact asks of a change.
#[derive(Debug)]
pub(super) struct Gradients {
    /// Of the friction, of the depth, and of the logarithm of the area.
    pub(super) all: [Gradient; 3],
    /// Of the logarithm of the area by the displacements of all elements under the pressure 1 of the first one.
    pub(super) area_by_bend: Vec<f64>,
}

impl Adjoint<'_> {
    pub(super) fn gradients(&mut self) -> Result<Gradients, BemError> {
        let n = self.pressure.len();
        let total: f64 = self.pressure.iter().sum();
        let none = || vec![0.0; n];
        let mut by_load = none();
        self.equations
            .kernel
            .dissipate(&self.pressure, &mut by_load);
        let friction = dot(&by_load, &self.pressure) / total;
        for value in &mut by_load {
            *value = (2.0 * *value - friction) / total;
        }
        let shares: Vec<f64> = self
            .pressure
            .iter()
            .map(|pressure| pressure / total)
            .collect();
        let lifted = self.lifted(&shares);
        let measure = self.area();
        let mut friction = self.gradient([none(), by_load], &lifted, total)?;
        let mut depth = self.gradient([shares.clone(), none()], &lifted, total)?;
        depth.by_pressure += self.sliding.mean_compliance()?;
        let (area, area_by_bend) = self.of_area(&measure, &shares, &lifted, total)?;
        self.add_dissipation(&mut friction, total);
        Ok(Gradients {
            all: [friction, depth, area],
            area_by_bend,
        })
    }

    /// Displacements of a half space of compliance 1 in each row under loads.
    fn lifted(&mut self, loads: &[f64]) -> Vec<f64> {
        let mut lifted = vec![0.0; loads.len()];
        let mean = loads.iter().sum::<f64>() / loads.len() as f64;
        let without_mean: Vec<f64> = loads.iter().map(|load| load - mean).collect();
        self.waves
            .apply(&without_mean, &mut lifted, |_, [_, q]| q.recip().into());
        lifted
    }

    /// The logarithm of the area by the pressures in contact and the gaps beside it, and by the bend of the kernel along each
    /// axis.
    fn area(&mut self) -> BoundaryDerivatives {
        let kernel = &mut self.equations.kernel;
        let [mut moved, mut heights] = [0; 2].map(|_| vec![0.0; self.pressure.len()]);
        kernel.displace(&self.pressure, &mut moved);
        kernel.shifted(self.heights, &mut heights);
        let gaps: Vec<f64> = moved.iter().zip(&heights).map(|(u, h)| u + h).collect();
        let inside: Vec<bool> = self.pressure.iter().map(|p| *p > 0.0).collect();
        let touching = gaps.iter().zip(&inside).filter(|(_, inside)| **inside);
        let (sum, n) = touching.fold((0.0, 0.0), |(sum, n), (gap, _)| (sum + gap, n + 1.0));
        let values = gaps.iter().zip(&self.pressure);
        let values = values.map(|(gap, &pressure)| match pressure {
            pressure if pressure > 0.0 => pressure,
            _ => gap - sum / n,
        });
        let [dx, dy] = self.grid.spacing();
        let field = BoundaryField {
            shape: self.grid.shape(),
            is_periodic: true,
            aspect: dy / dx,
            values: values.collect(),
            inside,
        };
        kernel.displace(&first_of(self.pressure.len()), &mut moved);
        let bend = [0, 1].map(|axis| dot(&moved, &self.bend(axis)));
        let mut measure =
            ContactBoundary::new(&field, |side| LOAD_GAP_RATIO / bend[side.axis]).area;
        let area =
            area::area_fraction(field.shape[1], &self.pressure).area * self.pressure.len() as f64;
        measure
            .by_values
            .iter_mut()
            .for_each(|value| *value /= area);
        measure.by_second_difference =
            [0, 1].map(|axis| measure.by_second_difference[axis] / (area * bend[axis]));
        measure
    }

    /// The displacement of the first element less the mean of its neighbours along an axis, by all displacements.
    fn bend(&self, axis: usize) -> Vec<f64> {
        let [rows, columns] = self.grid.shape();
        let (next, last) = match axis {
            0 => (columns % (rows * columns), (rows - 1) * columns),
            _ => (1 % columns, columns - 1),
        };
        let mut bend = first_of(rows * columns);
        bend[next] -= 0.5;
        bend[last] -= 0.5;
        bend
    }

    /// The derivatives of the area, and those by what the bend of the kernel is made of.
    fn of_area(
        &mut self,
        measure: &BoundaryDerivatives,
        shares: &[f64],
        lifted: &[f64],
        total: f64,
    ) -> Result<(Gradient, Vec<f64>), BemError> {
        let (mut by_gaps, mut by_pressures) =
            (measure.by_values.clone(), measure.by_values.clone());
        for ((by_gap, by_pressure), pressure) in by_gaps
            .iter_mut()
            .zip(&mut by_pressures)
            .zip(&self.pressure)
        {
            *(if *pressure > 0.0 { by_gap } else { by_pressure }) = 0.0;
        }
        // All gaps are measured from the contact.
        let sum: f64 = by_gaps.iter().sum();
        for (by_gap, share) in by_gaps.iter_mut().zip(shares) {
            *by_gap -= sum * share;
        }
        let mut area = self.gradient([by_gaps, by_pressures], lifted, total)?;
        let [along_x, along_y] = [0, 1].map(|axis| self.bend(axis));
        let pairs = along_x.iter().zip(&along_y);
        let [by_x, by_y] = measure.by_second_difference;
        let bend: Vec<f64> = pairs.map(|(x, y)| by_x * x + by_y * y).collect();
        let by_bend = self.by_heights(&turned(&bend, self.grid));
        let lifted = self.lifted(&first_of(bend.len()));
        for (by_row, own) in area.by_row.iter_mut().zip(self.by_rows(&by_bend, &lifted)?) {
            *by_row += own;
        }
        Ok((area, by_bend))
    }

    /// Of a quantity with these derivatives by the pressures, from adjoint loads with the sum of those given; `lifted` is what
    /// the part of each element in the total pressure moves on a half space of compliance 1 in each row.
    fn gradient(
        &mut self,
        [start, by_pressures]: [Vec<f64>; 2],
        lifted: &[f64],
        total: f64,
    ) -> Result<Gradient, BemError> {
        let n = start.len() as f64;
        let (loads, rise) =
            self.solve([&start, &by_pressures].map(|field| turned(field, self.grid)))?;
        let by_height = self.by_heights(&loads);
        let mut by_row = self.by_rows(&by_height, lifted)?;
        by_row.iter_mut().for_each(|by_row| *by_row *= total);
        Ok(Gradient {
            by_row,
            by_height,
            by_pressure: n * rise,
        })
    }

    /// By the heights at the centres, of loads that are turned about where the gaps are evaluated.
    fn by_heights(&mut self, loads: &[f64]) -> Vec<f64> {
        let mut by_height = vec![0.0; loads.len()];
        self.equations.kernel.shifted(loads, &mut by_height);
        turned(&by_height, self.grid)
    }

    /// By the compliance of each row.
    fn by_rows(&self, by_height: &[f64], lifted: &[f64]) -> Result<Vec<Complex<f64>>, BemError> {
        let mut by_row = row_sums([by_height, lifted], self.grid);
        let n_rows = by_row.len();
        if n_rows.is_multiple_of(2) {
            // The kernel has the absolute value of the compliance there, and the shift its phase.
            let q_x = self.waves.along_x[n_rows / 2];
            let compliance = self.sliding.compliances(&[q_x])?[0];
            by_row[n_rows / 2] *= compliance.conj() / compliance.re;
        }
        Ok(by_row)
    }

    /// The adjoint loads, turned about, and η.
    fn solve(&mut self, [mut loads, right]: [Vec<f64>; 2]) -> Result<(Vec<f64>, f64), BemError> {
        let mut gap = vec![0.0; loads.len()];
        let n_contact = self.contact.iter().filter(|inside| **inside).count() as f64;
        let (mut first, mut before) = (None, f64::INFINITY);
        for _ in 0..MOST_ROUNDS {
            self.equations.displace(&loads, &mut gap);
            let mean = gap.iter().sum::<f64>() / gap.len() as f64;
            for (gap, right) in gap.iter_mut().zip(&right) {
                *gap += right - mean;
            }
            let inside = || {
                let pairs = gap.iter().zip(&self.contact);
                pairs.filter_map(|(gap, inside)| inside.then_some(*gap))
            };
            let rise = inside().sum::<f64>() / n_contact;
            let residual = inside().map(|gap| (gap - rise).powi(2)).sum::<f64>().sqrt();
            let first = *first.get_or_insert(residual);
            if residual <= TOLERANCE * first {
                return Ok((loads, rise));
            }
            if residual > LEAST_REDUCTION * before {
                break;
            }
            before = residual;
            self.equations.set_active_set(&self.contact, &loads, &gap);
            let size = self.equations.residual_rms();
            self.equations.solve(ROUND * size, 0.0);
            self.equations.copy_pressure_to(&mut loads);
        }
        Err(BemError::ContactNotConverged {
            iterations: self.equations.products,
            residual: before / first.unwrap_or(before),
            tolerance: TOLERANCE,
        })
    }

    /// Adds what the material dissipates under pressures that do not change.
    fn add_dissipation(&mut self, friction: &mut Gradient, total: f64) {
        let mut moved = vec![0.0; self.pressure.len()];
        let n_rows = self.grid.shape()[0];
        self.waves
            .apply(&self.pressure, &mut moved, |row, [q_x, q]| {
                // Real fields have the slopes of waves; the shortest one goes neither way.
                Complex::new(0.0, if 2 * row == n_rows { 0.0 } else { q_x / q })
            });
        let sums = row_sums([&self.pressure, &moved], self.grid);
        for (by_row, sum) in friction.by_row.iter_mut().zip(sums) {
            *by_row -= sum / total;
        }
    }
}

/// A pressure of 1 on the first element.
pub(super) fn first_of(n: usize) -> Vec<f64> {
    let mut pressure = vec![0.0; n];
    pressure[0] = 1.0;
    pressure
}

/// Turned about across the motion.
pub(super) fn turned(field: &[f64], grid: &Grid) -> Vec<f64> {
    let rows = field.chunks_exact(grid.shape()[1]);
    rows.rev().flatten().copied().collect()
}

/// For each q_x the sum over q_y of the products of the waves of two fields, that of the first conjugate, over the number of
/// rows: the sum over the elements of the product of the first with the second, every row of which has a factor, is that of these
/// with the factors.
fn row_sums([left, right]: [&[f64]; 2], grid: &Grid) -> Vec<Complex<f64>> {
    let [rows, columns] = grid.shape();
    let transform = f64::forward(rows);
    let mut scratch = vec![Complex::default(); transform.get_inplace_scratch_len()];
    let mut sums = vec![Complex::default(); rows];
    let mut column = |field: &[f64], index: usize| {
        let values = field[index..].iter().step_by(columns);
        let mut values: Vec<Complex<f64>> = values.map(|value| Complex::from(*value)).collect();
        transform.process_with_scratch(&mut values, &mut scratch);
        values
    };
    for index in 0..columns {
        let pairs = column(left, index).into_iter().zip(column(right, index));
        for (sum, (left, right)) in sums.iter_mut().zip(pairs) {
            *sum += left.conj() * right / rows as f64;
        }
    }
    sums
}
