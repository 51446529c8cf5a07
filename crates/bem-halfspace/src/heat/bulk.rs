//! Power that a stationary contact dissipates below the surface, and the strain where it is dissipated.
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
//! which is computed at some depths on the surface, and integrated over the depth. The strain deviator is `ê = ŝ/(2 G*(ω))`, and the
//! equivalent (von Mises) strain `ε² = (2/3) e : e`.
//!
//! Theory: docs/theory/heat.md, "Dissipation below the surface", and docs/theory/strain.md.

use std::f64::consts::{PI, SQRT_2};
use std::sync::Arc;

use nalgebra::{DMatrix, SymmetricEigen};
use numerics::transforms::Real as _;
use rheology::{ComplexModulus, Material, ModulusFactors};
use rustfft::Fft;
use rustfft::num_complex::Complex;

use crate::parallel::row_blocks::{copies, for_each_row};
use crate::transform::plane_transform::ZERO;
use crate::transform::plane_transform::complex_product::signed_offset;
use crate::{BemError, Grid, PressureField, WaveShift};

/// Trapezoidal rule in ln z over the depths z at which fields are computed.
#[derive(Debug, Clone, Copy)]
pub(super) struct DepthRule {
    /// Step of ln z.
    pub(super) log_step: f64,
    /// Product of the smallest depth and the largest wave number.
    pub(super) smallest: f64,
    /// True if the strain is computed in addition to the power.
    pub(super) with_strain: bool,
    /// Fraction of the power that filters with little dissipation may have together, to be left out. The others are scaled to the whole
    /// power, so that only the difference of the distributions is neglected.
    pub(super) negligible_share: f64,
}

/// Quadrature over the depth z for the dissipated power: the trapezoidal rule in ln z. A pressure wave of the wave number q dissipates
/// a power ∝ (qz)³ e^(−2qz) per ln z.
///
/// Derived, but for the negligible share, which is chosen: the relative error is 2 |Γ(3 + 2πi/0.6)|/Γ(3) = 7e-5. Between the surface
/// and the smallest depth lies 1.2e-3 of the power of the shortest wave, and less of that of longer ones.
pub(super) const POWER_DEPTH_RULE: DepthRule = DepthRule {
    log_step: 0.6,
    smallest: 0.1,
    with_strain: false,
    negligible_share: 0.01,
};
/// Quadrature over the depth z for the mean squared strain, weighted with the dissipated power: the trapezoidal rule in ln z. The
/// product of power and squared strain of a pressure wave of the wave number q is ∝ (qz)⁵ e^(−4qz) per ln z.
///
/// Derived, but for the negligible share, which is chosen: the relative error is 2 |Γ(5 + 2πi/0.3)|/Γ(5) = 1e-9. Between the surface
/// and the smallest depth lies 3e-6 of the integral of the shortest wave of the grid.
pub(super) const STRAIN_DEPTH_RULE: DepthRule = DepthRule {
    log_step: 0.3,
    smallest: 0.05,
    with_strain: true,
    negligible_share: 1e-3,
};
/// Product of the largest depth and the smallest wave number. Derived: below that depth lies 5e-7 of the power of the longest wave.
const MAX_DEPTH: f64 = 10.0;
/// Largest product of depth and wave number of the waves that are computed at a depth. Derived: the stress of shorter ones is below
/// 12 e^(−12) = 7e-5 of the pressure.
const MAX_STRESS_DEPTH: f64 = 12.0;
/// Ratio of the period of filters with a limited reach to the period of the contact. Derived: the memory of a material that is longer is
/// a constant there, as far as it is not within the reach.
const PERIODS_OF_FILTER: usize = 64;
/// Smallest number of elements of a period along an axis on which a depth is computed. Chosen.
const MIN_ELEMENTS: usize = 8;

/// Power dissipated at several depths below the elements of a period.
pub(super) struct BulkHeat {
    /// Elements of the period.
    shape: [usize; 2],
    /// Step of ln z from depth to depth.
    log_step: f64,
    /// The depths, from the surface downwards.
    planes: Vec<Plane>,
    /// Power per area of all waves, \[W/m²], integrated over the depth in closed form.
    power: f64,
}

/// A contact whose bulk is heated: its pressure on one period, and the material that passes below it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pressed<'a> {
    /// Pressure on the period.
    pub(super) pressure: &'a PressureField,
    /// True for a periodic contact, whose material has passed under all periods. False for a single one: then the response is cut off
    /// at half a period from the pressure.
    pub(super) is_periodic: bool,
    /// Material of the half space at small strains.
    pub(super) material: &'a dyn Material,
    /// Factors of its moduli.
    pub(super) factors: ModulusFactors,
    /// Shift of its times and moduli by the wavelength, on a period; `None` for the same material under all waves.
    pub(super) wave_shift: Option<&'a WaveShift>,
    /// Velocity along +x, \[m/s].
    pub(super) velocity: f64,
}

/// Fourier coefficients of a field on a period, `[wave along y][wave along x]`.
pub(super) type Coefficients = Vec<Complex<f64>>;

/// Filter from stress to the root of the dissipated power per volume of a branch, or to the strain: one number for each wave number along
/// x, or for each wave as in [`Coefficients`] if the material depends on the wavelength.
type Filter = Vec<Complex<f64>>;

/// Coefficients of the power dissipated at one depth.
#[derive(Default)]
pub(super) struct Plane {
    /// Depth z, \[m].
    depth: f64,
    /// Elements of the period on which it is computed.
    shape: [usize; 2],
    power: Coefficients,
    /// Mean product of the power per volume and the squared equivalent strain; 0 if the strain is not wanted.
    power_times_strain: f64,
}

impl BulkHeat {
    /// Heat of a contact, at the depths of a rule.
    pub(super) fn of(contact: Pressed<'_>, rule: DepthRule) -> Result<Self, BemError> {
        let shape = contact.pressure.grid.shape();
        let plans = PlanePlans::new(shape);
        let steps = wave_steps(&contact.pressure.grid);
        // All depths share one transform of the pressure; stresses decay like qz e^(−qz).
        let mut waves: Coefficients = contact
            .pressure
            .pressure
            .iter()
            .map(|p| Complex::from(*p))
            .collect();
        plans.forward(&mut waves);
        let mut filters = Filters::new(&contact, &waves, steps, rule)?;
        filters.strain = filters.strain.filter(|_| rule.with_strain);
        // Compute the power at each depth of the trapezoidal rule over ln z, in parallel.
        let largest = [0, 1].map(|axis| steps[axis] * (shape[axis] / 2) as f64);
        let smallest = (0..2)
            .filter(|axis| shape[*axis] > 1)
            .map(|axis| steps[axis]);
        let ends = [
            rule.smallest / largest[0].hypot(largest[1]),
            MAX_DEPTH / smallest.fold(f64::INFINITY, f64::min),
        ];
        let count = 1.0 + (ends[1] / ends[0]).ln() / rule.log_step;
        let mut planes: Vec<Plane> = (0..numerics::whole_part(count))
            .map(|index| Plane {
                depth: ends[0] * (rule.log_step * index as f64).exp(),
                ..Plane::default()
            })
            .collect();
        for_each_row(&mut planes, 1, |_, plane| {
            for plane in plane {
                plane.compute(shape, &waves, steps, &filters);
            }
        });
        Ok(Self {
            shape,
            log_step: rule.log_step,
            planes,
            power: filters.power,
        })
    }

    /// Elements of the period.
    pub(super) const fn shape(&self) -> [usize; 2] {
        self.shape
    }

    /// Step of ln z from depth to depth.
    pub(super) const fn log_step(&self) -> f64 {
        self.log_step
    }

    /// The planes with the waves of their power, from the surface downwards.
    pub(super) fn spectra(&self) -> &[Plane] {
        &self.planes
    }

    /// Power per area, \[W/m²], and the same with each part multiplied by the squared equivalent strain where it is dissipated.
    pub(super) fn power_and_weighted_strain(&self) -> [f64; 2] {
        let weighted = |plane: &Plane| plane.depth * self.log_step * plane.power_times_strain;
        [self.power, self.planes.iter().map(weighted).sum()]
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
                waves[to] += power * (plane.depth * self.log_step);
            }
            plans.inverse(&mut waves);
            (plane.depth, waves.iter().map(|value| value.re).collect())
        })
    }
}

/// Wave numbers of the longest waves along x and y of the period that a grid covers, \[rad/m].
pub(super) fn wave_steps(grid: &Grid) -> [f64; 2] {
    let (shape, spacing) = (grid.shape(), grid.spacing());
    [0, 1].map(|axis| 2.0 * PI / (shape[axis] as f64 * spacing[axis]))
}

/// Waves that have one filter coefficient, and the material under them.
struct FilteredWave {
    /// Wave number along x, \[rad/m].
    q_x: f64,
    /// Factor of all times.
    time_factor: f64,
    /// Factor of all moduli.
    modulus_factor: f64,
}

impl FilteredWave {
    /// The waves of all filter coefficients of a contact; `steps` are the wave numbers of the longest waves along x and y.
    fn of(contact: &Pressed<'_>, steps: [f64; 2]) -> Vec<Self> {
        let [rows, columns] = contact.pressure.grid.shape();
        let wave = |q_x: f64, [time_factor, modulus_factor]: [f64; 2]| Self {
            q_x,
            time_factor,
            modulus_factor,
        };
        let Some(shift) = contact.wave_shift else {
            // Filters whose reach is limited are computed on a period that is longer by far.
            let longer = if contact.is_periodic {
                1
            } else {
                PERIODS_OF_FILTER
            };
            let numbers = wave_numbers(longer * rows, steps[0] / longer as f64);
            return numbers.into_iter().map(|q_x| wave(q_x, [1.0; 2])).collect();
        };
        let [along, across] = [
            wave_numbers(rows, steps[0]),
            wave_numbers(columns, steps[1]),
        ];
        let of_column = |q_y: &f64| {
            let shifted = |q_x: &f64| wave(*q_x, shift.factors(q_x.hypot(*q_y)));
            along.iter().map(shifted).collect::<Vec<_>>()
        };
        across.iter().flat_map(of_column).collect()
    }
}

/// Waves of a field that is constant on each element of a period, `[wave along y][wave along x]`, without those that the elements do not
/// resolve.
pub(super) fn waves_of_elements(grid: &Grid, field: &[f64]) -> Coefficients {
    let shape = grid.shape();
    let mut waves: Coefficients = field.iter().map(|value| Complex::from(*value)).collect();
    PlanePlans::new(shape).forward(&mut waves);
    // An element has the transform sin(a)/a with half of the phase across it, along each axis.
    let ratio = |index: usize, n: usize| {
        let half_phase = PI * signed_offset(index, n) as f64 / n as f64;
        if index == 0 {
            1.0
        } else {
            half_phase.sin() / half_phase
        }
    };
    for (index, wave) in waves.iter_mut().enumerate() {
        *wave *= ratio(index % shape[0], shape[0]) * ratio(index / shape[0], shape[1]);
    }
    waves
}

/// Filters from the stress of waves to other fields.
struct Filters {
    /// Whether filters have one number for each wave number along x, and not for each wave.
    is_by_row: bool,
    /// Filters to fields whose squares add up to the power per volume.
    branches: Vec<Filter>,
    /// Power per area of all waves, \[W/m²].
    power: f64,
    /// Equivalent strain; `None` if it is not wanted.
    strain: Option<Filter>,
}

impl Filters {
    /// Filters of a contact whose pressure has the coefficients `waves`.
    fn new(
        contact: &Pressed<'_>,
        waves: &[Complex<f64>],
        steps: [f64; 2],
        rule: DepthRule,
    ) -> Result<Self, BemError> {
        let spectrum = contact.material.relaxation();
        let shape = contact.pressure.grid.shape();
        let of_filters = FilteredWave::of(contact, steps);
        let modulus = |wave: &FilteredWave| -> Result<Complex<f64>, BemError> {
            let frequency = wave.q_x.abs() * contact.velocity * wave.time_factor;
            let small = spectrum.complex_modulus(frequency)?;
            let ComplexModulus { storage, loss } = contact.factors.on(small);
            Ok(Complex::new(storage, -wave.q_x.signum() * loss) * wave.modulus_factor)
        };
        let moduli: Vec<Complex<f64>> = of_filters.iter().map(modulus).collect::<Result<_, _>>()?;
        // Power per area of each wave number along x, or of each wave, up to the square of the filter: the squares of the components of
        // the stress add up to 4 (qz)² e^(−2qz), whose integral over the depth is 1/q.
        let is_by_row = contact.wave_shift.is_none();
        let rows = wave_numbers(shape[0], steps[0]);
        let mut powers = vec![0.0; if is_by_row { rows.len() } else { waves.len() }];
        for (column, waves) in waves.chunks_exact(rows.len()).enumerate() {
            let q_y = signed_offset(column, shape[1]) as f64 * steps[1];
            let first = if is_by_row { 0 } else { column * rows.len() };
            let of_rows = powers[first..].iter_mut().zip(waves).zip(&rows);
            for (row, ((power, wave), q_x)) in of_rows.enumerate() {
                let q = q_x.hypot(q_y);
                if q > 0.0 && is_resolved([row, column], shape) {
                    *power += wave.norm_sqr() / q;
                }
            }
        }
        // Around a single contact, cut the response off at half a period, where it would wrap.
        let within_reach = |filter: Filter| {
            if contact.is_periodic {
                filter
            } else {
                within_half_a_period(filter, shape[0])
            }
        };
        // A material that flows also dissipates under waves that do not move along x: then iω/G*(ω) is the inverse of its viscosity.
        let rate_over_modulus_at_rest = if spectrum.equilibrium_modulus() > 0.0 {
            0.0
        } else {
            (contact.factors.loss() * spectrum.zero_shear_viscosity()).recip()
        };
        // A dashpot in parallel is a branch whose relaxation time vanishes.
        let branches =
            (spectrum.branches().iter()).map(|branch| [branch.viscosity(), branch.relaxation_time]);
        let dashpot = [spectrum.viscosity(), 0.0];
        let filter = |[viscosity, time]: [f64; 2]| -> Filter {
            let of_wave = |(wave, modulus): (&FilteredWave, &Complex<f64>)| {
                let omega = -wave.q_x * contact.velocity;
                let time = time * wave.time_factor;
                let viscosity = viscosity * wave.time_factor * wave.modulus_factor;
                let ratio = if omega == 0.0 {
                    Complex::from(rate_over_modulus_at_rest)
                } else {
                    Complex::new(0.0, omega) / Complex::new(1.0, omega * time) / modulus
                };
                // The factor of the loss modulus is one of the dissipated power.
                ratio * (0.5 * contact.factors.loss() * viscosity).sqrt()
            };
            within_reach(of_filters.iter().zip(&moduli).map(of_wave).collect())
        };
        let branches: Vec<Filter> = branches.chain([dashpot]).map(filter).collect();
        let power_of = |filter: &Filter| -> f64 {
            let terms = filter.iter().zip(&powers);
            terms.map(|(value, power)| value.norm_sqr() * power).sum()
        };
        let strain = |modulus: &Complex<f64>| modulus.inv() * (0.5 * (2.0_f64 / 3.0).sqrt());
        Ok(Self {
            is_by_row,
            power: branches.iter().map(power_of).sum(),
            branches: combined(&branches, &powers, rule.negligible_share),
            strain: Some(within_reach(moduli.iter().map(strain).collect())),
        })
    }
}

/// The fewest filters whose outputs have nearly the same sum of squares as those of all branches: principal components of the outputs,
/// for the `powers` of the waves. Those with the smallest powers are left out as long as their sum is at most `negligible_share` of the
/// whole, to which the others are scaled.
fn combined(branches: &[Filter], powers: &[f64], negligible_share: f64) -> Vec<Filter> {
    // Eigenvalues of the Gram matrix of all outputs are the powers of the principal components.
    let n = branches.len();
    let product = |one: usize, other: usize| -> f64 {
        let values = branches[one].iter().zip(&branches[other]);
        let terms = values.zip(powers);
        terms
            .map(|((one, other), power)| power * (one * other.conj()).re)
            .sum()
    };
    let components = SymmetricEigen::new(DMatrix::from_fn(n, n, product));
    // Drop components in increasing order of power, up to the negligible share.
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|one, other| {
        let [one, other] = [one, other].map(|index| components.eigenvalues[*index]);
        one.total_cmp(&other)
    });
    let total: f64 = components.eigenvalues.iter().sum();
    let mut left_out = 0.0;
    order.retain(|index| {
        left_out += components.eigenvalues[*index];
        left_out > negligible_share * total
    });
    // Scale the kept components to the whole power.
    let kept: f64 = order
        .iter()
        .map(|index| components.eigenvalues[*index])
        .sum();
    let scale = (total / kept).sqrt();
    let component = |index: usize| -> Filter {
        let weights = components.eigenvectors.column(index);
        let value = |wave: usize| {
            let terms = branches.iter().zip(weights.iter());
            let sum: Complex<f64> = terms.map(|(filter, weight)| filter[wave] * *weight).sum();
            sum * scale
        };
        (0..powers.len()).map(value).collect()
    };
    order.into_iter().map(component).collect()
}

/// Whether a wave is below the limit of resolution of a grid, where it has a direction. Its numbers are those of the transform, or without
/// their signs.
fn is_resolved(numbers: [usize; 2], shape: [usize; 2]) -> bool {
    (0..2).all(|axis| 2 * numbers[axis] != shape[axis] || shape[axis] == 1)
}

/// Wave numbers of a period of `n` elements in the order of a transform; `step` is that of the longest wave, \[rad/m].
fn wave_numbers(n: usize, step: f64) -> Vec<f64> {
    (0..n)
        .map(|index| signed_offset(index, n) as f64 * step)
        .collect()
}

/// The filter on a period of `n` elements that has the effect of a filter on a longer one, up to half the short period in either
/// direction, and none beyond.
fn within_half_a_period(mut filter: Filter, n: usize) -> Filter {
    let long = filter.len();
    f64::inverse(long).process(&mut filter);
    let scale = (long as f64).recip();
    let place = |index: usize| signed_offset(index, n).rem_euclid(long.cast_signed());
    let mut short: Filter = (0..n)
        .map(|index| filter[place(index).unsigned_abs()] * scale)
        .collect();
    f64::forward(n).process(&mut short);
    short
}

impl Plane {
    /// Depth z, \[m].
    pub(super) const fn depth(&self) -> f64 {
        self.depth
    }

    /// Mean power per volume.
    pub(super) fn mean_power(&self) -> f64 {
        self.power[0].re
    }

    /// Wave of the power per volume with the signed wave numbers along x and y in units of the longest waves; `None` beyond the
    /// resolution of the plane.
    pub(super) fn wave(&self, place: [isize; 2]) -> Option<Complex<f64>> {
        let is_resolved = |axis: usize| 2 * place[axis].unsigned_abs() < self.shape[axis];
        if !(is_resolved(0) && is_resolved(1)) {
            return None;
        }
        let [row, column] = [0, 1].map(|axis| {
            place[axis]
                .rem_euclid(self.shape[axis].cast_signed())
                .unsigned_abs()
        });
        Some(self.power[column * self.shape[0] + row])
    }

    /// The plane with `multiple` times the length, where the additional part has no power, and with its power multiplied by a function of the
    /// distance along x from the middle, in units of the length of the plane itself.
    pub(super) fn lengthened(&self, multiple: usize, factor: impl Fn(f64) -> f64) -> Self {
        let [rows, columns] = self.shape;
        let mut power = self.power.clone();
        PlanePlans::new(self.shape).inverse(&mut power);
        for (row, values) in power.chunks_exact_mut(columns).enumerate() {
            let factor = factor(row as f64 / rows as f64 - 0.5);
            values.iter_mut().for_each(|value| *value *= factor);
        }
        let shape = [multiple * rows, columns];
        power.resize(shape[0] * columns, ZERO);
        PlanePlans::new(shape).forward(&mut power);
        Self {
            shape,
            power,
            ..*self
        }
    }

    /// Computes the power dissipated at this depth from the pressure waves of a period of `period` elements.
    fn compute(
        &mut self,
        period: [usize; 2],
        waves: &[Complex<f64>],
        steps: [f64; 2],
        filters: &Filters,
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
        // Stress of each wave at this depth with its direction and the index of its filter coefficient; a wave at the limit of resolution has no direction.
        let at_depth = |[from, row, column]: [isize; 3]| {
            let [x, y] = [steps[0] * row as f64, steps[1] * column as f64];
            let q = (x * x + y * y).sqrt();
            #[expect(clippy::cast_sign_loss, reason = "an index")]
            let index = from as usize;
            let wave = waves[index];
            let along = if filters.is_by_row {
                row.rem_euclid(period[0].cast_signed()).unsigned_abs()
            } else {
                index
            };
            let numbers = [row, column].map(isize::unsigned_abs);
            if q == 0.0 || !is_resolved(numbers, self.shape) {
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
        // Filter the stress of all waves, transform it back, and sum the squares of its components.
        let plans = PlanePlans::new(self.shape);
        let square_of = |filter: &Filter, square: &mut [f64]| {
            for pair in components {
                let stress = at_depth
                    .iter()
                    .map(|(stress, direction, along)| stress * filter[*along] * pair(*direction));
                let mut stress: Coefficients = stress.collect();
                plans.inverse(&mut stress);
                for (square, stress) in square.iter_mut().zip(&stress) {
                    *square += stress.norm_sqr();
                }
            }
        };
        // The dissipated power is the sum of these squares over all branches of the material.
        let mut power = copies(0.0, self.shape[0] * self.shape[1]);
        for filter in &filters.branches {
            square_of(filter, &mut power);
        }
        if let Some(filter) = &filters.strain {
            let mut strain = copies(0.0, power.len());
            square_of(filter, &mut strain);
            let products = power.iter().zip(&strain);
            let sum: f64 = products.map(|(power, strain)| power * strain).sum();
            self.power_times_strain = sum / power.len() as f64;
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
