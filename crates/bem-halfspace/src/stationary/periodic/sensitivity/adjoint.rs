//! The adjoint loads of the contact of a periodic surface, and the gradients of its quantities.
//!
//! Theory: docs/sensitivity.md.

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

/// Tolerance of the residual of the adjoint equations, relative to the initial one; chosen.
const ADJOINT_TOLERANCE: f64 = 1e-7;
/// Tolerance of each single-precision solve of the iterative refinement, relative to its residual; chosen.
const REFINEMENT_REDUCTION: f64 = 1e-3;
/// Maximum number of steps of the iterative refinement; chosen.
const MAX_REFINEMENT_STEPS: usize = 20;
/// The refinement stagnates if a step leaves more than this fraction of the residual; chosen.
const STAGNATION_RATIO: f64 = 0.7;

/// Derivatives of one quantity.
#[derive(Debug)]
pub(super) struct Gradient {
    /// By the height of each element, per metre.
    pub(super) by_height: Vec<f64>,
    /// By the compliance of each row of the transform: the change of the quantity is the real part of the sum of products with the
    /// changes of the compliances.
    pub(super) by_row: Vec<Complex<f64>>,
    /// By the mean pressure, per pascal.
    pub(super) by_pressure: f64,
}

/// The adjoint problem of a contact.
pub(super) struct Adjoint<'a> {
    pub(super) equations: Equations,
    /// The active set, reversed along x.
    pub(super) contact: Vec<bool>,
    pub(super) waves: FourierMultiplier,
    pub(super) sliding: &'a Sliding,
    pub(super) grid: &'a Grid,
    /// Heights at the centres of the elements, \[m].
    pub(super) heights: &'a [f64],
    /// \[Pa].
    pub(super) pressure: Vec<f64>,
}

/// Derivatives of all quantities of a contact.
#[derive(Debug)]
pub(super) struct Gradients {
    /// Derivatives of friction, depth, and logarithm of the area, in this order.
    pub(super) all: [Gradient; 3],
    /// Derivatives of the logarithm of the area by the displacements of all elements under a unit pressure on the first one.
    pub(super) area_by_unit_response: Vec<f64>,
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
        let lifted = self.unit_compliance_response(&shares);
        let measure = self.area();
        let mut friction = self.gradient(&none(), &by_load, &lifted, total)?;
        let mut depth = self.gradient(&shares, &none(), &lifted, total)?;
        depth.by_pressure += self.sliding.mean_compliance()?;
        let (area, area_by_unit_response) =
            self.area_gradient(&measure, &shares, &lifted, total)?;
        self.add_dissipation(&mut friction, total);
        Ok(Gradients {
            all: [friction, depth, area],
            area_by_unit_response,
        })
    }

    /// Displacements under loads less their mean, for a compliance of 1 in each row.
    fn unit_compliance_response(&mut self, loads: &[f64]) -> Vec<f64> {
        let mut lifted = vec![0.0; loads.len()];
        let mean = loads.iter().sum::<f64>() / loads.len() as f64;
        let without_mean: Vec<f64> = loads.iter().map(|load| load - mean).collect();
        self.waves
            .apply(&without_mean, &mut lifted, |_, [_, q]| q.recip().into());
        lifted
    }

    /// Derivatives of the logarithm of the area by the pressures in contact and the gaps next to it, and by the second difference
    /// of the kernel along each axis.
    fn area(&mut self) -> BoundaryDerivatives {
        let kernel = &mut self.equations.kernel;
        let [mut moved, mut heights] = [0; 2].map(|_| vec![0.0; self.pressure.len()]);
        kernel.displace(&self.pressure, &mut moved);
        kernel.shifted(self.heights, &mut heights);
        let gaps: Vec<f64> = moved.iter().zip(&heights).map(|(u, h)| u + h).collect();
        let inside: Vec<bool> = self.pressure.iter().map(|p| *p > 0.0).collect();
        let touching = gaps.iter().zip(&inside).filter(|(_, inside)| **inside);
        let (sum, n) = touching.fold((0.0, 0.0), |(sum, n), (gap, _)| (sum + gap, n + 1.0));
        let pairs = gaps.iter().zip(&self.pressure);
        let values = pairs.map(|(gap, &pressure)| match pressure {
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
        kernel.displace(&unit_pressure(self.pressure.len()), &mut moved);
        let bend = [0, 1].map(|axis| dot(&moved, &self.second_difference(axis)));
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

    /// Coefficients of the second difference along an axis: displacement of the first element less the mean of its neighbours.
    fn second_difference(&self, axis: usize) -> Vec<f64> {
        let [rows, columns] = self.grid.shape();
        let (next, last) = match axis {
            0 => (columns % (rows * columns), (rows - 1) * columns),
            _ => (1 % columns, columns - 1),
        };
        let mut bend = unit_pressure(rows * columns);
        bend[next] -= 0.5;
        bend[last] -= 0.5;
        bend
    }

    /// The gradient of the logarithm of the area, and its derivatives by the unit response of the kernel.
    fn area_gradient(
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
        // All gaps are measured from the mean height of the contact.
        let sum: f64 = by_gaps.iter().sum();
        for (by_gap, share) in by_gaps.iter_mut().zip(shares) {
            *by_gap -= sum * share;
        }
        let mut area = self.gradient(&by_gaps, &by_pressures, lifted, total)?;
        let [along_x, along_y] = [0, 1].map(|axis| self.second_difference(axis));
        let pairs = along_x.iter().zip(&along_y);
        let [by_x, by_y] = measure.by_second_difference;
        let bend: Vec<f64> = pairs.map(|(x, y)| by_x * x + by_y * y).collect();
        let by_bend = self.by_heights(&reversed(&bend, self.grid));
        let lifted = self.unit_compliance_response(&unit_pressure(bend.len()));
        for (by_row, own) in area.by_row.iter_mut().zip(self.by_rows(&by_bend, &lifted)?) {
            *by_row += own;
        }
        Ok((area, by_bend))
    }

    /// The gradient of a quantity with the derivatives `by_pressures`.
    ///
    /// The adjoint loads start from `start` and keep its sum. `share_response` is the displacement under the share of each element in
    /// the total pressure, for a compliance of 1 in each row.
    fn gradient(
        &mut self,
        start: &[f64],
        by_pressures: &[f64],
        share_response: &[f64],
        total: f64,
    ) -> Result<Gradient, BemError> {
        let n = start.len() as f64;
        let (loads, rise) = self.solve(
            reversed(start, self.grid),
            &reversed(by_pressures, self.grid),
        )?;
        let by_height = self.by_heights(&loads);
        let mut by_row = self.by_rows(&by_height, share_response)?;
        by_row.iter_mut().for_each(|by_row| *by_row *= total);
        Ok(Gradient {
            by_row,
            by_height,
            by_pressure: n * rise,
        })
    }

    /// Derivatives by the heights at the centres, from reversed adjoint loads at the points where the gaps are evaluated.
    fn by_heights(&mut self, loads: &[f64]) -> Vec<f64> {
        let mut by_height = vec![0.0; loads.len()];
        self.equations.kernel.shifted(loads, &mut by_height);
        reversed(&by_height, self.grid)
    }

    /// Derivatives by the compliance of each row: correlation of the adjoint loads with the response.
    fn by_rows(&self, by_height: &[f64], response: &[f64]) -> Result<Vec<Complex<f64>>, BemError> {
        let mut by_row = row_sums(by_height, response, self.grid);
        let n_rows = by_row.len();
        if n_rows.is_multiple_of(2) {
            // The kernel has the absolute value of the compliance there, and the shift its phase.
            let q_x = self.waves.along_x[n_rows / 2];
            let compliance = self.sliding.compliances(&[q_x])?[0];
            by_row[n_rows / 2] *= compliance.conj() / compliance.re;
        }
        Ok(by_row)
    }

    /// The adjoint loads, reversed along x, and η, by iterative refinement of single-precision solutions.
    fn solve(&mut self, mut loads: Vec<f64>, right: &[f64]) -> Result<(Vec<f64>, f64), BemError> {
        let mut gap = vec![0.0; loads.len()];
        let n_contact = self.contact.iter().filter(|inside| **inside).count() as f64;
        let (mut first, mut before) = (None, f64::INFINITY);
        for _ in 0..MAX_REFINEMENT_STEPS {
            // Residual in double precision.
            self.equations.displace(&loads, &mut gap);
            let mean = gap.iter().sum::<f64>() / gap.len() as f64;
            for (gap, right) in gap.iter_mut().zip(right) {
                *gap += right - mean;
            }
            let inside = || {
                let pairs = gap.iter().zip(&self.contact);
                pairs.filter_map(|(gap, inside)| inside.then_some(*gap))
            };
            let rise = inside().sum::<f64>() / n_contact;
            let residual = inside().map(|gap| (gap - rise).powi(2)).sum::<f64>().sqrt();
            let first = *first.get_or_insert(residual);
            if residual <= ADJOINT_TOLERANCE * first {
                return Ok((loads, rise));
            }
            if residual > STAGNATION_RATIO * before {
                break;
            }
            before = residual;

            // Correction in single precision.
            self.equations.set_active_set(&self.contact, &loads, &gap);
            let size = self.equations.residual_rms();
            self.equations.solve(REFINEMENT_REDUCTION * size, 0.0);
            self.equations.copy_pressure_to(&mut loads);
        }
        Err(BemError::ContactNotConverged {
            iterations: self.equations.products,
            residual: before / first.unwrap_or(before),
            tolerance: ADJOINT_TOLERANCE,
        })
    }

    /// Adds the change of the dissipated power at constant pressures to the derivatives of the friction.
    fn add_dissipation(&mut self, friction: &mut Gradient, total: f64) {
        let mut moved = vec![0.0; self.pressure.len()];
        let n_rows = self.grid.shape()[0];
        self.waves
            .apply(&self.pressure, &mut moved, |row, [q_x, q]| {
                // The shortest wave stands for both directions and has no slope.
                Complex::new(0.0, if 2 * row == n_rows { 0.0 } else { q_x / q })
            });
        let sums = row_sums(&self.pressure, &moved, self.grid);
        for (by_row, sum) in friction.by_row.iter_mut().zip(sums) {
            *by_row -= sum / total;
        }
    }
}

/// A unit pressure on the first of `n` elements.
pub(super) fn unit_pressure(n: usize) -> Vec<f64> {
    let mut pressure = vec![0.0; n];
    pressure[0] = 1.0;
    pressure
}

/// A field reversed along x (adjoint).
pub(super) fn reversed(field: &[f64], grid: &Grid) -> Vec<f64> {
    let rows = field.chunks_exact(grid.shape()[1]);
    rows.rev().flatten().copied().collect()
}

/// Cross-spectrum of two fields by rows: for each q_x the sum over q_y of conj(left) right, over the number of rows.
///
/// If each row of the transform of `right` is multiplied by a factor, the sum over the elements of left times right becomes the sum
/// of these values times the factors.
fn row_sums(left: &[f64], right: &[f64], grid: &Grid) -> Vec<Complex<f64>> {
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
