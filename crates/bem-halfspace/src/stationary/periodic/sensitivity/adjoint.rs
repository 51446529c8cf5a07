//! The adjoint loads λ of the contact of a periodic surface, and the gradients of its quantities; equations in the [module](super).
//!
//! Fields are row-major over one period. A derivative *by row* is one by the complex compliance of all waves with one q_x, that is one
//! row of the Fourier transform.
//!
//! Theory: docs/theory/sensitivities.md.

use numerics::transforms::Real;
use rustfft::num_complex::Complex;

use crate::elements::area;
use crate::elements::contact_boundary::{BoundaryField, ContactBoundary};
use crate::parallel::reductions::{add_scaled, dot, mean};
use crate::stationary::change::Change;
use crate::stationary::periodic::PeriodicControl;
use crate::stationary::periodic::equations::Equations;
use crate::stationary::periodic::fourier_multiplier::FourierMultiplier;
use crate::stationary::periodic::kernel::MaterialAtSpeed;
use crate::stationary::search::FixedSetSolver as _;
use crate::{BemError, Grid};

/// Tolerance of the residual of the adjoint equations, relative to the initial one. Derived: the rounding of single precision, in
/// which each step of the iterative refinement is solved.
const ADJOINT_TOLERANCE: f64 = f32::EPSILON as f64;
/// Largest number of steps of the iterative refinement. Chosen to limit the time: beyond it the solution fails with
/// [`BemError::ContactNotConverged`]. Two or three suffice.
const MAX_REFINEMENT_STEPS: usize = 20;

/// Derivatives of one quantity under a constant mean pressure.
#[derive(Debug)]
pub(super) struct Gradient {
    /// By the height of each element, per metre.
    pub(super) by_height: Vec<f64>,
    /// By the displacement of each element under the pressures, in addition to `by_height`, per metre; empty for none.
    by_displacement: Vec<f64>,
    /// By the displacement of each element under a unit pressure on the first one; empty for none.
    by_unit_response: Vec<f64>,
    /// By a uniform displacement of a layer by the mean pressure, per metre.
    by_uniform_displacement: f64,
    /// By the logarithm of the wave numbers along x, at constant pressures and displacements.
    by_log_wave_numbers: f64,
    /// By the compliance of each row of the transform: the change of the quantity is the real part of the sum of products with the
    /// changes of the compliances.
    by_row: Vec<Complex<f64>>,
    /// Derivative by the mean pressure, per pascal.
    pub(super) by_pressure: f64,
}

/// The change of a kernel, as changes of the displacements of the centres of all elements.
pub(super) struct KernelChange {
    /// Change of the displacements under the pressures less their mean, \[m].
    pub(super) displacement: Vec<f64>,
    /// Change of the displacements under a unit pressure on the first element, \[m/Pa].
    pub(super) unit_response: Vec<f64>,
    /// Change of the displacement of a layer under the mean pressure, \[m].
    pub(super) uniform_displacement: f64,
    /// Change of the logarithm of the wave numbers along x.
    pub(super) log_wave_numbers: f64,
}

/// The adjoint problem of a contact.
pub(super) struct Adjoint<'a> {
    /// Equations of the reversed contact.
    equations: Equations,
    /// The active set, reversed along x.
    contact: Vec<bool>,
    /// Fourier transforms of the grid, with the reduced wave number |q|/M of each wave.
    pub(super) waves: FourierMultiplier,
    /// Material and speed.
    sliding: &'a MaterialAtSpeed,
    /// Grid of one period.
    grid: &'a Grid,
    /// Heights at the centres of the elements, \[m].
    heights: &'a [f64],
    /// Pressure of the elements, \[Pa].
    pressure: &'a [f64],
    /// Sum of the pressures, \[Pa].
    total: f64,
}

impl Gradient {
    /// Change of the quantity by a change of the kernel, to first order, in the unit of the quantity.
    pub(super) fn by_kernel(&self, change: &KernelChange) -> f64 {
        dot(&self.by_height, &change.displacement)
            + dot(&self.by_displacement, &change.displacement)
            + dot(&self.by_unit_response, &change.unit_response)
            + self.by_uniform_displacement * change.uniform_displacement
            + self.by_log_wave_numbers * change.log_wave_numbers
    }

    /// The change of the quantity by changes of the complex compliance of each row \[1/Pa], to first order.
    pub(super) fn by_compliances(&self, changes: &[Complex<f64>]) -> f64 {
        let pairs = self.by_row.iter().zip(changes);
        pairs.map(|(by_row, change)| (by_row * change).re).sum()
    }
}

impl<'a> Adjoint<'a> {
    /// Adjoint problem of a contact with the given heights \[m] and pressures \[Pa]. All its fields are reversed along x, because
    /// the transposed kernel is that of the opposite motion.
    pub(super) fn new(
        sliding: &'a MaterialAtSpeed,
        grid: &'a Grid,
        heights: &'a [f64],
        pressure: &'a [f64],
    ) -> Result<Self, BemError> {
        Ok(Self {
            // The adjoint loads have a prescribed sum.
            equations: Equations::new(sliding, grid, PeriodicControl::MeanPressure(1.0))?,
            contact: reversed(pressure, grid).iter().map(|p| *p > 0.0).collect(),
            waves: FourierMultiplier::new(grid, sliding.base()),
            sliding,
            grid,
            heights,
            pressure,
            total: pressure.iter().sum(),
        })
    }

    /// Gradients of friction, depth, and logarithm of the area, under a constant mean pressure.
    pub(super) fn gradients(&mut self) -> Result<Change<Gradient>, BemError> {
        // Compute what all gradients need: the pressures over their sum, and the displacements under the pressures for a
        // compliance of 1 in each row. The other fields begin with zeros.
        let (pressure, total) = (self.pressure, self.total);
        let shares: Vec<f64> = pressure.iter().map(|pressure| pressure / total).collect();
        let unit_response = self.unit_compliance_response(pressure);
        let [none, mut by_pressures, mut slopes] = [0; 3].map(|_| vec![0.0; pressure.len()]);

        // The friction is the mean dissipation weighted with the pressure: quadratic in the pressures over linear, hence the
        // factor 2. Its derivative by the displacements is the slope of the pressure over the sum of the pressures.
        let kernel = &mut self.equations.kernel;
        kernel.negative_loss_slopes(pressure, &mut by_pressures);
        let mean = dot(&by_pressures, pressure) / total;
        for value in &mut by_pressures {
            *value = (2.0 * *value - mean) / total;
        }
        kernel.slopes(pressure, &mut slopes);
        slopes.iter_mut().for_each(|slope| *slope /= total);
        let mut friction = self.gradient(&none, &by_pressures, slopes, &unit_response)?;
        friction.by_log_wave_numbers = mean;

        // The depth is that of the mean plane, and contains the mean displacement of a layer.
        let mut depth = self.gradient(&shares, &none, Vec::new(), &unit_response)?;
        let n = pressure.len() as f64;
        depth
            .by_height
            .iter_mut()
            .for_each(|value| *value -= n.recip());
        depth.by_uniform_displacement = 1.0;
        depth.by_row[0] += self.sliding.base().uniform_compliance() * (total / n);
        Ok(Change {
            friction_coefficient: friction,
            indentation_depth: Some(depth),
            normal_force: None,
            contact_area: Some(self.area_gradient(&shares, &unit_response)?),
        })
    }

    /// Displacements under loads less their mean, for a compliance of 1 in each row: waves are multiplied by M/|q|.
    fn unit_compliance_response(&mut self, loads: &[f64]) -> Vec<f64> {
        let mut response = vec![0.0; loads.len()];
        let mean = mean(loads);
        let without_mean: Vec<f64> = loads.iter().map(|load| load - mean).collect();
        self.waves.apply(&without_mean, &mut response, |wave| {
            wave.reduced_wave_number.recip().into()
        });
        response
    }

    /// The gradient of the logarithm of the area, from loads and gaps at the contact boundary (`elements/contact_boundary.rs`).
    ///
    /// `shares` are the pressures over their sum, and `unit_response` the displacements under them for a compliance of 1 in each row.
    fn area_gradient(
        &mut self,
        shares: &[f64],
        unit_response: &[f64],
    ) -> Result<Gradient, BemError> {
        // The boundary is found in one field: pressures in contact, and outside it gaps from the mean height of the contact.
        let n = self.pressure.len();
        let [mut moved, mut heights] = [0; 2].map(|_| vec![0.0; n]);
        let kernel = &mut self.equations.kernel;
        kernel.displace(self.pressure, &mut moved);
        kernel.shifted(self.heights, &mut heights);
        let gaps: Vec<f64> = moved.iter().zip(&heights).map(|(u, h)| u + h).collect();
        let inside: Vec<bool> = self.pressure.iter().map(|p| *p > 0.0).collect();
        let touching = gaps.iter().zip(&inside).filter(|(_, inside)| **inside);
        let (sum, count) = touching.fold((0.0, 0.0), |(sum, n), (gap, _)| (sum + gap, n + 1.0));
        let pairs = gaps.iter().zip(self.pressure);
        let values = pairs.map(|(gap, &pressure)| match pressure {
            pressure if pressure > 0.0 => pressure,
            _ => gap - sum / count,
        });

        // Locate the contact boundary in this field, with the second difference of the kernel along both axes.
        kernel.displace(&unit_pressure(n), &mut moved);
        let differences = [0, 1].map(|axis| second_difference(self.grid.shape(), axis));
        let [dx, dy] = self.grid.spacing();
        let field = BoundaryField {
            shape: self.grid.shape(),
            is_periodic: true,
            aspect: dy / dx,
            values: values.collect(),
            inside,
            second_difference: differences.each_ref().map(|one| dot(&moved, one)),
            unit_depth_response: None,
        };
        let measure = ContactBoundary::new(&field).area;
        let area = area::area_fraction(field.shape[1], self.pressure).area * n as f64;

        // Sort the derivatives of the logarithm of the area into those by pressures and those by gaps. Gaps count from the mean
        // height of the contact, so that the sum of their derivatives is subtracted in proportion to the pressures.
        let [mut by_gaps, mut by_pressures] = [0; 2].map(|_| vec![0.0; n]);
        for (element, value) in measure.by_values.iter().enumerate() {
            let by_values = if field.inside[element] {
                &mut by_pressures
            } else {
                &mut by_gaps
            };
            by_values[element] = value / area;
        }
        let sum: f64 = by_gaps.iter().sum();
        add_scaled(&mut by_gaps, -sum, shares);
        let mut gradient = self.gradient(&by_gaps, &by_pressures, Vec::new(), unit_response)?;

        // Add the derivatives by the second difference of the kernel, as derivatives by the displacements under a unit pressure.
        let mut by_kernel = vec![0.0; n];
        for (axis, by_second_difference) in measure.by_second_difference.iter().enumerate() {
            add_scaled(
                &mut by_kernel,
                by_second_difference / area,
                &differences[axis],
            );
        }
        gradient.by_unit_response = self.by_heights(&reversed(&by_kernel, self.grid));
        let unit_response = self.unit_compliance_response(&unit_pressure(n));
        let by_row = self.by_rows(&gradient.by_unit_response, &unit_response)?;
        for (sum, by_row) in gradient.by_row.iter_mut().zip(by_row) {
            *sum += by_row;
        }
        Ok(gradient)
    }

    /// The gradient of a quantity with the derivatives `by_pressures`, and explicit ones `by_displacement`.
    ///
    /// The adjoint loads start from the field `start` and keep its sum. `unit_response` has the displacements under the pressures for a
    /// compliance of 1 in each row.
    fn gradient(
        &mut self,
        start: &[f64],
        by_pressures: &[f64],
        by_displacement: Vec<f64>,
        unit_response: &[f64],
    ) -> Result<Gradient, BemError> {
        // Solve for the adjoint loads of the reversed contact. The derivatives by heights and compliances follow from them.
        let (loads, eta) = self.solve(
            reversed(start, self.grid),
            &reversed(by_pressures, self.grid),
        )?;
        let by_height = self.by_heights(&loads);
        let mut by_centre = by_height.clone();
        add_scaled(&mut by_centre, 1.0, &by_displacement);
        Ok(Gradient {
            by_row: self.by_rows(&by_centre, unit_response)?,
            by_height,
            by_displacement,
            by_unit_response: Vec::new(),
            by_uniform_displacement: 0.0,
            by_log_wave_numbers: 0.0,
            by_pressure: start.len() as f64 * eta,
        })
    }

    /// Derivatives by the heights at the centres of the elements, from adjoint loads at the points where gaps are evaluated, which are
    /// reversed along x.
    fn by_heights(&mut self, loads: &[f64]) -> Vec<f64> {
        let mut by_height = vec![0.0; loads.len()];
        self.equations.kernel.shifted(loads, &mut by_height);
        reversed(&by_height, self.grid)
    }

    /// Derivatives by the complex compliance of each row, from those by the heights and the displacements `response` for a
    /// compliance of 1 in each row: their cross-spectrum.
    fn by_rows(&self, by_height: &[f64], response: &[f64]) -> Result<Vec<Complex<f64>>, BemError> {
        let mut by_row = cross_spectrum(by_height, response, self.grid);
        let n_rows = by_row.len();
        if n_rows.is_multiple_of(2) {
            // For the shortest wave along x the kernel has the absolute value of the compliance, and the shift of the gaps its phase.
            let q_x = self.waves.along_x[n_rows / 2];
            let compliance = self.sliding.compliances(&[q_x])?[0];
            by_row[n_rows / 2] *= compliance.conj() / compliance.re;
        }
        Ok(by_row)
    }

    /// Solves the adjoint equations by iterative refinement of single-precision solutions, from `loads` and with the right side
    /// −`right`; all fields are reversed along x. Returns the adjoint loads and the multiplier η of the [module](super).
    fn solve(&mut self, mut loads: Vec<f64>, right: &[f64]) -> Result<(Vec<f64>, f64), BemError> {
        let mut gap = vec![0.0; loads.len()];
        let n_contact = self.contact.iter().filter(|inside| **inside).count() as f64;
        let (mut first, mut before) = (None, f64::INFINITY);
        for _ in 0..MAX_REFINEMENT_STEPS {
            // Compute the residual of the adjoint equations in double precision. Its mean over the contact is η.
            self.equations.displace(&loads, &mut gap);
            add_scaled(&mut gap, 1.0, right);
            let inside = || {
                let pairs = gap.iter().zip(&self.contact);
                pairs.filter_map(|(gap, inside)| inside.then_some(*gap))
            };
            let eta = inside().sum::<f64>() / n_contact;
            let residual = inside().map(|gap| (gap - eta).powi(2)).sum::<f64>().sqrt();
            let first = *first.get_or_insert(residual);
            if residual <= ADJOINT_TOLERANCE * first {
                return Ok((loads, eta));
            }
            before = residual;

            // Correct the loads by a solution of the equations for this residual, in single precision. Two solutions reach the tolerance.
            self.equations.set_active_set(&self.contact, &loads, &gap);
            let size = self.equations.residual_rms();
            self.equations.solve(ADJOINT_TOLERANCE.sqrt() * size, 0.0)?;
            self.equations.copy_pressure_to(&mut loads);
        }
        Err(BemError::ContactNotConverged {
            iterations: self.equations.applications,
            residual: before / first.unwrap_or(before),
            tolerance: ADJOINT_TOLERANCE,
        })
    }
}

/// A unit pressure on the first of `n` elements.
pub(super) fn unit_pressure(n: usize) -> Vec<f64> {
    let mut pressure = vec![0.0; n];
    pressure[0] = 1.0;
    pressure
}

/// Coefficients of the second difference of a field along an axis at the first element: its value less the mean of its periodic
/// neighbours.
fn second_difference(shape: [usize; 2], axis: usize) -> Vec<f64> {
    let [rows, columns] = shape;
    let (next, last) = match axis {
        0 => (columns % (rows * columns), (rows - 1) * columns),
        _ => (1 % columns, columns - 1),
    };
    let mut coefficients = unit_pressure(rows * columns);
    coefficients[next] -= 0.5;
    coefficients[last] -= 0.5;
    coefficients
}

/// A row-major field reversed along x: the adjoint contact slides the other way.
fn reversed(field: &[f64], grid: &Grid) -> Vec<f64> {
    let rows = field.chunks_exact(grid.shape()[1]);
    rows.rev().flatten().copied().collect()
}

/// Cross-spectrum of two fields by rows of the transform: for each q_x the sum over q_y of conj(left) right, over the number of rows.
///
/// If each row of the transform of `right` is multiplied by a factor, the scalar product of both fields is the sum of the products
/// of these values and the factors (Parseval).
fn cross_spectrum(left: &[f64], right: &[f64], grid: &Grid) -> Vec<Complex<f64>> {
    let [rows, columns] = grid.shape();
    let transform = f64::forward(rows);
    let mut scratch = vec![Complex::default(); transform.get_inplace_scratch_len()];
    let mut sums = vec![Complex::default(); rows];
    // This closure transforms one column of a field along x.
    let mut column = |field: &[f64], index: usize| {
        let values = field[index..].iter().step_by(columns);
        let mut values: Vec<Complex<f64>> = values.map(|value| Complex::from(*value)).collect();
        transform.process_with_scratch(&mut values, &mut scratch);
        values
    };
    // Sum the products of both transforms over all columns, which is the sum over q_y (Parseval).
    for index in 0..columns {
        let pairs = column(left, index).into_iter().zip(column(right, index));
        for (sum, (left, right)) in sums.iter_mut().zip(pairs) {
            *sum += left.conj() * right / rows as f64;
        }
    }
    sums
}
