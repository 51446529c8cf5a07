//! Power that a stationary contact dissipates below the surface.
//!
//! The deviatoric stress below a pressure wave p̂ of the wave vector q on an incompressible half space does not depend on the material
//! (Johnson 1985, Contact Mechanics, § 3.2 for ν = 1/2):
//!
//! ```text
//! ŝ = q z e^(−qz) p̂ [ n n − e_z e_z + i (n e_z + e_z n) ],   n = q/|q|
//! ```
//!
//! A Maxwell branch of the modulus G_b and the viscosity η_b has the part `ŝ_b = iωη_b/(1 + iωη_b/G_b) ŝ/G*(ω)` of it, at the frequency
//! ω = −q_x v of a material that the pressure passes along +x, and dissipates `s_b : s_b/(2η_b)` per volume. This is a product of fields,
//! which is computed at some depths on the surface, and integrated over the depth.
//!
//! Theory: docs/theory/heat.md, "Dissipation below the surface".

use std::f64::consts::{PI, SQRT_2};
use std::sync::Arc;

use numerics::transforms::Real as _;
use rheology::{ComplexModulus, Material};
use rustfft::Fft;
use rustfft::num_complex::Complex;

use crate::parallel::row_blocks::{copies, for_each_row};
use crate::transform::plane_transform::ZERO;
use crate::transform::plane_transform::complex_product::signed_offset;
use crate::{BemError, PressureField};

/// Step of ln z in the integral over the depth z. Derived: the trapezoidal rule of (qz)³ e^(−2qz) over ln z has the relative error
/// 2 |Γ(3 + 2πi/0.6)|/Γ(3) = 7e-5.
const LOG_DEPTH_STEP: f64 = 0.6;
/// Depths from this product with the largest wave number on. Derived: above it lies 1.2e-3 of the power of that wave, and less of that
/// of longer ones.
const MIN_DEPTH: f64 = 0.1;
/// Depths up to this product with the smallest wave number. Derived: below it lie 5e-7 of the power of the longest wave.
const MAX_DEPTH: f64 = 10.0;
/// Product of depth and wave number beyond which waves are left out. Derived: their stress is below 12 e^(−12) = 7e-5 of the pressure.
const MAX_STRESS_DEPTH: f64 = 12.0;
/// Fraction of the power that branches with little dissipation may have together, to be left out. Chosen: the others are scaled to the
/// whole power, so that only the difference of the distributions is lost.
const NEGLIGIBLE_SHARE: f64 = 0.01;
/// Smallest number of elements of a period along an axis on which a depth is computed. Chosen.
const MIN_ELEMENTS: usize = 8;

/// Power dissipated at several depths below the elements of a period.
pub(super) struct BulkHeat {
    /// Elements of the period.
    shape: [usize; 2],
    /// The depths, from the surface downwards.
    planes: Vec<Plane>,
}

/// Fourier coefficients of a field on a period, `[wave along y][wave along x]`.
type Coefficients = Vec<Complex<f64>>;

/// Filter from stress to the root of the dissipated power per volume of a branch, by the wave number along x.
type Filter = Vec<Complex<f64>>;

/// Coefficients of the power dissipated at one depth.
#[derive(Default)]
struct Plane {
    /// Depth z, \[m].
    depth: f64,
    /// Elements of the period on which it is computed.
    shape: [usize; 2],
    power: Coefficients,
}

impl BulkHeat {
    /// Heat of a pressure on one period that passes over a material along +x at a `velocity` \[m/s].
    pub(super) fn of(
        pressure: &PressureField,
        material: &dyn Material,
        velocity: f64,
    ) -> Result<Self, BemError> {
        let shape = pressure.grid.shape();
        let plans = PlanePlans::new(shape);
        let steps = wave_steps(pressure);
        let mut waves: Coefficients = pressure
            .pressure
            .iter()
            .map(|p| Complex::from(*p))
            .collect();
        plans.forward(&mut waves);
        let filters = filters(shape, &waves, steps, material, velocity)?;
        // Compute the power at each depth of the trapezoidal rule over ln z, in parallel.
        let largest = [0, 1].map(|axis| steps[axis] * (shape[axis] / 2) as f64);
        let smallest = (0..2)
            .filter(|axis| shape[*axis] > 1)
            .map(|axis| steps[axis]);
        let ends = [
            MIN_DEPTH / largest[0].hypot(largest[1]),
            MAX_DEPTH / smallest.fold(f64::INFINITY, f64::min),
        ];
        let count = 1.0 + (ends[1] / ends[0]).ln() / LOG_DEPTH_STEP;
        let mut planes: Vec<Plane> = (0..numerics::whole_part(count))
            .map(|index| Plane {
                depth: ends[0] * (LOG_DEPTH_STEP * index as f64).exp(),
                ..Plane::default()
            })
            .collect();
        for_each_row(&mut planes, 1, |_, plane| {
            for plane in plane {
                plane.compute((shape, &waves), steps, &filters);
            }
        });
        Ok(Self { shape, planes })
    }

    /// Depths \[m] with the power per area that is dissipated about each of them, \[W/m²]; the sum of the powers is the integral over
    /// the depth.
    pub(super) fn planes(&self) -> impl Iterator<Item = (f64, Vec<f64>)> {
        let plans = PlanePlans::new(self.shape);
        self.planes.iter().map(move |plane| {
            // Interpolate the field on a coarser grid by its waves.
            let mut waves = copies(ZERO, self.shape[0] * self.shape[1]);
            for (power, [to, _, _]) in plane.power.iter().zip(plane.places(self.shape)) {
                #[expect(clippy::cast_sign_loss, reason = "an index")]
                let to = to as usize;
                waves[to] += power * (plane.depth * LOG_DEPTH_STEP);
            }
            plans.inverse(&mut waves);
            (plane.depth, waves.iter().map(|value| value.re).collect())
        })
    }
}

/// Wave numbers of the longest waves along x and y of the period that a field covers, \[rad/m].
fn wave_steps(field: &PressureField) -> [f64; 2] {
    let (shape, spacing) = (field.grid.shape(), field.grid.spacing());
    [0, 1].map(|axis| 2.0 * PI / (shape[axis] as f64 * spacing[axis]))
}

/// Filters of the branches of a material that dissipate, for the wave numbers along x of a period.
fn filters(
    shape: [usize; 2],
    waves: &[Complex<f64>],
    [step_x, step_y]: [f64; 2],
    material: &dyn Material,
    velocity: f64,
) -> Result<Vec<Filter>, BemError> {
    let spectrum = material.relaxation();
    let rows: Vec<f64> = (0..shape[0])
        .map(|row| signed_offset(row, shape[0]) as f64)
        .collect();
    let modulus = |row: &f64| -> Result<Complex<f64>, BemError> {
        let ComplexModulus { storage, loss } =
            spectrum.complex_modulus(row.abs() * step_x * velocity)?;
        Ok(Complex::new(storage, -row.signum() * loss))
    };
    let moduli: Vec<Complex<f64>> = rows.iter().map(modulus).collect::<Result<_, _>>()?;
    // Power of each wave number along x up to the factor of the filter.
    let mut powers = vec![0.0; shape[0]];
    for (column, waves) in waves.chunks_exact(shape[0]).enumerate() {
        let q_y = signed_offset(column, shape[1]) as f64 * step_y;
        for ((power, wave), row) in powers.iter_mut().zip(waves).zip(&rows) {
            let q = (row * step_x).hypot(q_y);
            if q > 0.0 {
                *power += wave.norm_sqr() / q;
            }
        }
    }
    // A material that flows also dissipates under waves that do not move along x: then iω/G*(ω) is the inverse of its viscosity.
    let rate_over_modulus_at_rest = if spectrum.equilibrium_modulus() > 0.0 {
        0.0
    } else {
        spectrum.zero_shear_viscosity().recip()
    };
    // A dashpot in parallel is a branch whose relaxation time vanishes.
    let branches = spectrum.branches().iter();
    let branches = branches.map(|branch| [branch.viscosity(), branch.relaxation_time]);
    let dashpot = [spectrum.viscosity(), 0.0];
    let filter = |[viscosity, time]: [f64; 2]| -> (f64, Filter) {
        let of_wave = |(row, modulus): (&f64, &Complex<f64>)| {
            let omega = -row * step_x * velocity;
            let ratio = if omega == 0.0 {
                Complex::from(rate_over_modulus_at_rest)
            } else {
                Complex::new(0.0, omega) / Complex::new(1.0, omega * time) / modulus
            };
            ratio * (0.5 * viscosity).sqrt()
        };
        let filter: Filter = rows.iter().zip(&moduli).map(of_wave).collect();
        let power = filter
            .iter()
            .zip(&powers)
            .map(|(value, power)| value.norm_sqr() * power);
        (power.sum(), filter)
    };
    let mut filters: Vec<(f64, Filter)> = branches.chain([dashpot]).map(filter).collect();
    // Leave out the branches with the smallest powers, as long as their sum is negligible.
    filters.sort_by(|left, right| left.0.total_cmp(&right.0));
    let total: f64 = filters.iter().map(|(power, _)| power).sum();
    let mut left_out = 0.0;
    filters.retain(|(power, _)| {
        left_out += power;
        left_out > NEGLIGIBLE_SHARE * total
    });
    let kept: f64 = filters.iter().map(|(power, _)| power).sum();
    let scale = (total / kept).sqrt();
    for (_, filter) in &mut filters {
        filter.iter_mut().for_each(|value| *value *= scale);
    }
    Ok(filters.into_iter().map(|(_, filter)| filter).collect())
}

impl Plane {
    /// Computes the power dissipated at this depth from the pressure waves of a period of `period` elements.
    fn compute(
        &mut self,
        (period, waves): ([usize; 2], &[Complex<f64>]),
        steps: [f64; 2],
        filters: &[Filter],
    ) {
        // Use a coarser grid where the stress of the shortest waves does not reach.
        self.shape = [0, 1].map(|axis| {
            let mut elements = period[axis];
            let shortest_of_half = |elements: usize| 0.25 * steps[axis] * elements as f64;
            while elements.is_multiple_of(4)
                && elements / 2 >= MIN_ELEMENTS
                && shortest_of_half(elements) * self.depth > MAX_STRESS_DEPTH
            {
                elements /= 2;
            }
            elements
        });
        // Stress of each wave at this depth with its direction and its index along x; a wave at the limit of resolution has no direction.
        let is_limit = |axis: usize, index: isize| {
            2 * index.unsigned_abs() == self.shape[axis] && self.shape[axis] > 1
        };
        let at_depth = |[from, row, column]: [isize; 3]| {
            let [x, y] = [steps[0] * row as f64, steps[1] * column as f64];
            let q = (x * x + y * y).sqrt();
            #[expect(clippy::cast_sign_loss, reason = "an index")]
            let wave = waves[from as usize];
            let along = row.rem_euclid(period[0].cast_signed()).unsigned_abs();
            let is_still = q == 0.0 || is_limit(0, row) || is_limit(1, column);
            if is_still {
                return (ZERO, [0.0; 2], along);
            }
            let decay = q * self.depth * (-q * self.depth).exp();
            (wave * decay, [x / q, y / q], along)
        };
        let at_depth: Vec<_> = self.places(period).map(at_depth).collect();
        // Two components of the tensor are the real and the imaginary part of one field; those off the diagonal count twice.
        let components: [fn([f64; 2]) -> Complex<f64>; 3] = [
            |[x, y]| Complex::new(x * x, y * y),
            |[x, y]| Complex::new(-1.0, SQRT_2 * x * y),
            |[x, y]| Complex::new(-SQRT_2 * y, SQRT_2 * x),
        ];
        let plans = PlanePlans::new(self.shape);
        let mut power = copies(0.0, self.shape[0] * self.shape[1]);
        for filter in filters {
            for pair in components {
                let stress = at_depth
                    .iter()
                    .map(|(stress, direction, along)| stress * filter[*along] * pair(*direction));
                let mut stress: Coefficients = stress.collect();
                plans.inverse(&mut stress);
                for (power, stress) in power.iter_mut().zip(&stress) {
                    *power += stress.norm_sqr();
                }
            }
        }
        self.power = power.into_iter().map(Complex::from).collect();
        plans.forward(&mut self.power);
    }

    /// For each wave of this plane, its index among those of a period of `period` elements, and its signed wave numbers along x and y in
    /// units of the longest waves.
    fn places(&self, period: [usize; 2]) -> impl Iterator<Item = [isize; 3]> {
        let [rows, columns] = self.shape;
        (0..columns).flat_map(move |column| {
            (0..rows).map(move |row| {
                let [x, y] = [signed_offset(row, rows), signed_offset(column, columns)];
                let [width, height] = period.map(usize::cast_signed);
                [y.rem_euclid(height) * width + x.rem_euclid(width), x, y]
            })
        })
    }
}

/// Plans of complex transforms of a field `[x][y]` to coefficients `[wave along y][wave along x]` and back.
struct PlanePlans {
    shape: [usize; 2],
    forward: [Arc<dyn Fft<f64>>; 2],
    inverse: [Arc<dyn Fft<f64>>; 2],
}

impl PlanePlans {
    fn new(shape: [usize; 2]) -> Self {
        Self {
            shape,
            forward: shape.map(f64::forward),
            inverse: shape.map(f64::inverse),
        }
    }

    /// Coefficients of a field: means of the field times the conjugate waves.
    fn forward(&self, field: &mut Coefficients) {
        let [rows, columns] = self.shape;
        self.forward[1].process(field);
        *field = transposed(field, rows, columns);
        self.forward[0].process(field);
        let normalisation = (field.len() as f64).recip();
        field.iter_mut().for_each(|value| *value *= normalisation);
    }

    /// The field of coefficients.
    fn inverse(&self, coefficients: &mut Coefficients) {
        let [rows, columns] = self.shape;
        self.inverse[0].process(coefficients);
        *coefficients = transposed(coefficients, columns, rows);
        self.inverse[1].process(coefficients);
    }
}

/// Transpose of a matrix with the given numbers of rows and columns.
fn transposed(values: &[Complex<f64>], rows: usize, columns: usize) -> Coefficients {
    let value = |index: usize| values[(index % rows) * columns + index / rows];
    (0..values.len()).map(value).collect()
}
