//! The adjoint loads of a contact of a periodic surface, and what each quantity asks of its kernel.

use numerics::transforms;
use rustfft::num_complex::Complex;

use crate::elements::spread::measures_of_area;
use crate::parallel::reductions::dot;
use crate::stationary::periodic::equations::Equations;
use crate::stationary::periodic::kernel::Sliding;
use crate::stationary::periodic::waves::Waves;
use crate::{BemError, Grid};

/// Residual of the adjoint equations over their right side, and the part of it that is left after a round of directions.
const TOLERANCE: f64 = 1e-6;
const ROUND: f64 = 3e-7;
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
    pub(super) waves: Waves,
    pub(super) sliding: &'a Sliding,
    pub(super) grid: &'a Grid,
    pub(super) pressure: Vec<f64>,
}

impl Adjoint<'_> {
    pub(super) fn gradients(&mut self) -> Result<[Gradient; 4], BemError> {
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
        let [area, rough_area] = measures_of_area(&self.pressure, |powers| powers.iter().sum());
        let shares: Vec<f64> = self
            .pressure
            .iter()
            .map(|pressure| pressure / total)
            .collect();
        let mut lifted = none();
        let without_mean: Vec<f64> = shares.iter().map(|share| share - 1.0 / n as f64).collect();
        self.waves
            .apply(&without_mean, &mut lifted, |_, [_, q]| q.recip().into());
        let of = |given: [Vec<f64>; 2], adjoint: &mut Self| adjoint.gradient(given, &lifted, total);
        let mut friction = of([none(), by_load], self)?;
        let mut depth = of([shares, none()], self)?;
        depth.by_pressure += self.sliding.mean_compliance()?;
        let [area, rough_area] = [area, rough_area].map(|area| of([none(), area], self));
        self.add_dissipation(&mut friction, total);
        Ok([friction, depth, area?, rough_area?])
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
        let mut by_height = vec![0.0; loads.len()];
        self.equations.kernel.shifted(&loads, &mut by_height);
        let by_height = turned(&by_height, self.grid);
        let sums = row_sums([&by_height, lifted], self.grid);
        let mut by_row: Vec<_> = sums.into_iter().map(|sum| sum * total).collect();
        let n_rows = by_row.len();
        if n_rows.is_multiple_of(2) {
            // The kernel has the absolute value of the compliance there, and the shift its phase.
            let q_x = self.waves.along_x[n_rows / 2];
            let compliance = self.sliding.compliances(&[q_x])?[0];
            by_row[n_rows / 2] *= compliance.conj() / compliance.re;
        }
        Ok(Gradient {
            by_row,
            by_height,
            by_pressure: n * rise,
        })
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
            self.equations.take(&self.contact, &loads, &gap);
            self.equations.iterate(ROUND, f64::INFINITY, 0.0);
            self.equations.give(&mut loads, &mut gap);
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
    let transform = transforms::forward(rows);
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
