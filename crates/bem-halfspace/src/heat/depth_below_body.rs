//! Temperature below a body or a line contact, from the waves of a period in whose middle it is.
//!
//! The waves have the temperature of a row of contacts, each of which slides through the heat that the one ahead of it has left. The
//! temperature times e^(ax) has not: with wave numbers q_x + ia along x, what is found a period X ahead is weaker by e^(−aX). At small Péclet
//! numbers, where the rate a ≤ v/(2D) does not suffice, the others heat the contact uniformly, as they heat a Gaussian source in its middle.
//! That is known without them, too:
//!
//! ```text
//! k T/P = 1/(XY) Σ_q e^(−((q_x + ia)² + q_y²)σ²/2)/β                                          on a period
//! k T/P = (1/√π) ∫_0^∞ exp(−(s²/λ)²/(s² + 2σ²)) / (π(s² + 2σ²)) ds                            alone
//! ```
//!
//! for the mean temperature T of a source of the power P in proportion to e^(−r²/σ²), weighted with it, and the wake length λ = 4D/v. On a line
//! the root of the last denominator takes its place.
//!
//! Theory: docs/theory/heat.md, "Temperature in the depth".

use std::f64::consts::{PI, SQRT_2};

use numerics::integrate;
use rustfft::num_complex::Complex;

use crate::heat::bulk::{Plane, wave_steps, waves_of_elements};
use crate::heat::depth::{DepthHeat, HeatWaves, Node, WeightedRise, running_wave};
use crate::heat::periodic_waves::decay_constant;
use crate::{BemError, Grid};

/// Relative error of the mean rise by the rule over the depth and the waves. Measured: the largest of the unit test below is 1.6e-2, of which
/// the independent value has a half.
pub(super) const FREE_DEPTH_ERROR: f64 = 2e-2;

/// Ratio of the period to the surroundings of the contact that are heated. Derived: places at both ends of the surroundings are then at
/// least as far from the next period as from each other.
const PERIOD_OVER_SURROUNDINGS: usize = 2;
/// Largest product of the rate of damping and the period. Derived: the heat of the next period is weaker by e^(−16) = 1e-7, and is left as it
/// is, because that of fast contacts stays at its depth.
const MAX_DAMPING: f64 = 16.0;
/// Lower bound of the ratio of the period to the Péclet length D/v in the Fourier sums: slower contacts are computed at this value. Derived:
/// it changes their temperature by a fraction of this order. The divergence like ln v under a line contact is that of the Gaussian source
/// alone, which is computed at the true v.
const MIN_PERIOD_OVER_PECLET_LENGTH: f64 = 1e-7;
/// Radius σ of the Gaussian source over the length of the contact. Chosen: as wide as a Hertzian pressure.
const GAUSSIAN_RADIUS: f64 = 0.25;
/// Exponent of e of the smallest terms of sum and integral of the Gaussian source. Derived: e^(−40) is 4e-18.
const LARGEST_EXPONENT: f64 = 40.0;
/// Relative tolerance of the temperature of the Gaussian source alone. Chosen far below the error of the waves.
const GAUSSIAN_TOLERANCE: f64 = 1e-8;

/// A contact on a period whose waves are damped.
pub(super) struct FreeHeat {
    /// Elements of the period.
    grid: Grid,
    /// Reciprocal v/D of the Péclet length with which the Fourier sums are computed, \[1/m].
    velocity_over_diffusivity: f64,
    /// Rate a of the damping along x, \[1/m].
    damping: f64,
    /// Area of the period, \[m²]; on a line its length, \[m].
    area: f64,
    /// Difference of k T/P of a source alone and on the period, \[1/m]; on a line without unit.
    without_others: f64,
}

impl FreeHeat {
    /// The period of the heat of a contact.
    pub(super) fn new(
        heat: &DepthHeat<'_>,
        contact_length: f64,
        is_line: bool,
    ) -> Result<Self, BemError> {
        // Lengthen the period along x, and damp what is found a period ahead by e^(−aX).
        let ([rows, columns], spacing) = (heat.grid.shape(), heat.grid.spacing());
        let grid = Grid::new([PERIOD_OVER_SURROUNDINGS * rows, columns], spacing)?;
        let period = grid.shape()[0] as f64 * spacing[0];
        let velocity_over_diffusivity = heat
            .velocity_over_diffusivity
            .max(MIN_PERIOD_OVER_PECLET_LENGTH / period);
        let width = if is_line {
            1.0
        } else {
            columns as f64 * spacing[1]
        };
        let free = Self {
            grid,
            velocity_over_diffusivity,
            damping: (0.5 * velocity_over_diffusivity).min(MAX_DAMPING / period),
            area: period * width,
            without_others: 0.0,
        };
        // For a fast contact, damping alone suppresses the heat of the other contacts.
        if 0.5 * velocity_over_diffusivity * period >= MAX_DAMPING {
            return Ok(free);
        }
        // Otherwise that heat is nearly uniform, and is found from a Gaussian source in the middle.
        let radius = GAUSSIAN_RADIUS * contact_length;
        let alone = gaussian_alone(radius, heat.velocity_over_diffusivity, is_line);
        Ok(Self {
            without_others: alone - free.gaussian_on_period(radius),
            ..free
        })
    }

    /// For each plane the mean over the surroundings of its power times its temperatures.
    pub(super) fn weighted_rises(&self, heat: &DepthHeat<'_>, nodes: &[Node]) -> Vec<WeightedRise> {
        // Multiply the sources with e^(ax), and the weights of the temperature with e^(−ax).
        let [_, columns] = self.grid.shape();
        let surroundings = heat.grid.shape()[0] as f64 * heat.grid.spacing()[0];
        let exponent = self.damping * surroundings;
        let planes = heat.bulk.spectra();
        let with_factor = |sign: f64| -> Vec<Plane> {
            let factor = |x: f64| (sign * exponent * x).exp();
            let lengthened = |plane: &Plane| plane.lengthened(PERIOD_OVER_SURROUNDINGS, factor);
            planes.iter().map(lengthened).collect()
        };
        let mut flux = heat.surface_flux.to_vec();
        let rows = flux.len() / columns;
        for (row, values) in flux.chunks_exact_mut(columns).enumerate() {
            let factor = (exponent * (row as f64 / rows as f64 - 0.5)).exp();
            values.iter_mut().for_each(|value| *value *= factor);
        }
        flux.resize(self.grid.n_elements(), 0.0);
        let (sources, weights) = (with_factor(1.0), with_factor(-1.0));
        let waves = HeatWaves {
            shape: self.grid.shape(),
            steps: wave_steps(&self.grid),
            sources: &sources,
            weights: &weights,
            surface_flux: &waves_of_elements(&self.grid, &flux),
        };
        // Compute the temperatures with the wave numbers q_x + ia of the damped field.
        let mut sums = waves.weighted_rises(nodes, |q, powers| {
            let beta = decay_constant(q, self.velocity_over_diffusivity, self.damping);
            running_wave(beta, nodes, powers)
        });
        // Leave out the heat of the other contacts, which is that of the whole power.
        let powers = planes.iter().zip(nodes);
        let powers: Vec<f64> = powers
            .map(|(plane, node)| plane.mean_power() * node.power_of_unit)
            .collect();
        let of_interface: f64 = heat.surface_flux.iter().sum();
        let mean_flux = of_interface / heat.surface_flux.len() as f64;
        let area = self.area / PERIOD_OVER_SURROUNDINGS as f64;
        let additional =
            [powers.iter().sum::<f64>(), mean_flux].map(|heat| heat * area * self.without_others);
        for (sum, power) in sums.iter_mut().zip(powers) {
            let with_others = [sum.by_bulk, sum.by_interface];
            let [by_bulk, by_interface] = [0, 1].map(|part| {
                with_others[part] * PERIOD_OVER_SURROUNDINGS as f64 + power * additional[part]
            });
            *sum = WeightedRise {
                by_bulk,
                by_interface,
            };
        }
        sums
    }

    /// Mean temperature k T/P on the period of a Gaussian source of a radius σ \[m], weighted with the source, \[1/m]; on a line without unit.
    fn gaussian_on_period(&self, radius: f64) -> f64 {
        let steps = wave_steps(&self.grid);
        // Truncate the sum where the Gaussian e^(−q²σ²/2) is below rounding.
        let largest = (2.0 * LARGEST_EXPONENT).sqrt() / radius;
        let count = |axis: usize| match self.grid.shape()[axis] {
            1 => 0,
            _ => numerics::whole_part(largest / steps[axis]).cast_signed(),
        };
        let mut sum = Complex::new(0.0, 0.0);
        for row in -count(0)..=count(0) {
            for column in -count(1)..=count(1) {
                let q = [row as f64 * steps[0], column as f64 * steps[1]];
                let along = Complex::new(q[0], self.damping);
                let exponent = (along * along + q[1] * q[1]) * (0.5 * radius * radius);
                let beta = decay_constant(q, self.velocity_over_diffusivity, self.damping);
                sum += (-exponent).exp() / beta;
            }
        }
        sum.re / self.area
    }
}

/// Mean temperature k T/P of a Gaussian source of a radius σ \[m] on an insulated half space, weighted with the source, \[1/m]; on a line
/// without unit.
fn gaussian_alone(radius: f64, velocity_over_diffusivity: f64, is_line: bool) -> f64 {
    // With s = √2 σ sinh u the integrand falls like a power of e, and faster where the source has moved away.
    let width = SQRT_2 * radius;
    let width_over_wake = 0.25 * velocity_over_diffusivity * width;
    let ratio = LARGEST_EXPONENT.sqrt() / width_over_wake;
    let cosh = 0.5 * (ratio + ratio.hypot(2.0));
    let last = (ratio.sqrt() * cosh.sqrt()).asinh();
    let moved = |u: f64| {
        let moved = width_over_wake * u.sinh() * u.tanh();
        (-moved * moved).exp()
    };
    if is_line {
        integrate(moved, [0.0, last], GAUSSIAN_TOLERANCE).value / PI
    } else {
        let integrand = |u: f64| moved(u) / u.cosh();
        let last = last.min(LARGEST_EXPONENT);
        integrate(integrand, [0.0, last], GAUSSIAN_TOLERANCE).value / (PI * PI.sqrt() * width)
    }
}

#[cfg(test)]
mod tests {
    use rheology::{ModulusFactors, StandardSolid, StandardSolidParameters};

    use super::*;
    use crate::PressureField;
    use crate::heat::bulk::{BulkHeat, DepthRule, POWER_DEPTH_RULE, Pressed};
    use crate::heat::depth::Beside;
    use crate::heat::operator::HeatOperator;
    use crate::heat::{ContactKind, HeatConductor, SourceDepth};

    /// Elements along the contact.
    const ELEMENTS: usize = 6;
    /// Ratio of the surroundings to the contact.
    const SURROUNDINGS: usize = 6;

    /// Pressure of Hertz on a contact of the length 1 in the middle of its surroundings, with one row of elements on a line.
    fn hertz(is_line: bool) -> PressureField {
        let n = SURROUNDINGS * ELEMENTS;
        let shape = if is_line { [n, 1] } else { [n; 2] };
        let edge = 1.0 / ELEMENTS as f64;
        let place = |number: usize| (number as f64 + 0.5) * edge - 0.5 * SURROUNDINGS as f64;
        let pressure = |index: usize| {
            let [x, y] = [index / shape[1], index % shape[1]].map(|number| 2.0 * place(number));
            let y = if is_line { 0.0 } else { y };
            (1.0 - x * x - y * y).max(0.0).sqrt()
        };
        PressureField {
            grid: Grid::new(shape, [edge; 2]).expect("a grid"),
            origin: [place(0), if is_line { 0.0 } else { place(0) }],
            pressure: (0..shape[0] * shape[1]).map(pressure).collect(),
        }
    }

    fn bulk(pressure: &PressureField, rule: DepthRule) -> BulkHeat {
        let material = StandardSolid::new(StandardSolidParameters {
            equilibrium_modulus: 1.0,
            maxwell_modulus: 1.0,
            viscosity: 0.25,
        });
        let contact = Pressed {
            pressure,
            is_periodic: true,
            material: &material.expect("a material"),
            factors: ModulusFactors::NONE,
            wave_shift: None,
            velocity: 1.0,
        };
        BulkHeat::of(contact, rule).expect("heat of the bulk")
    }

    /// Power-weighted mean temperature of planes by themselves and by a flux of the interface, from the temperature of the surface by sources
    /// at each distance from a plane and its mirror image.
    fn by_pairs_of_planes(
        pressure: &PressureField,
        flux: &[f64],
        diffusivity: f64,
        is_line: bool,
    ) -> [f64; 2] {
        let fine = DepthRule {
            log_step: 0.3,
            ..POWER_DEPTH_RULE
        };
        let bulk = bulk(pressure, fine);
        let grid = &pressure.grid;
        let kind = if is_line {
            ContactKind::Line
        } else {
            ContactKind::Body
        };
        let conductor = HeatConductor::new(1.0, diffusivity).expect("a conductor");
        let operator = HeatOperator::new(grid, kind, &conductor, 1.0).expect("an operator");
        let planes: Vec<_> = bulk.planes().collect();
        let mut sums = [0.0; 3];
        let temperature = |distance: f64, flux: &[f64]| {
            let mut rise = vec![0.0; flux.len()];
            let depth = SourceDepth::Plane(distance);
            operator.add_temperature(&depth, &mut flux.to_vec(), &mut rise);
            rise
        };
        let product = |one: &[f64], other: &[f64]| -> f64 {
            one.iter().zip(other).map(|(one, other)| one * other).sum()
        };
        for (depth, power) in &planes {
            sums[0] += power.iter().sum::<f64>();
            sums[2] += product(power, &temperature(*depth, flux));
            for (source_depth, source) in &planes {
                let mut at = |distance: f64, part: f64| {
                    sums[1] += 0.5 * part * product(power, &temperature(distance, source));
                };
                at(depth + source_depth, 1.0);
                // Places in two layers of the thickness h at the distance d have the distances d + th with the density 1 − |t|.
                let distance = (depth - source_depth).abs();
                let thickness = fine.log_step * depth.max(*source_depth);
                if distance > 1.5 * thickness {
                    at(distance, 1.0);
                } else {
                    for part in [
                        -0.875_f64, -0.625, -0.375, -0.125, 0.125, 0.375, 0.625, 0.875,
                    ] {
                        let density = 0.25 * (1.0 - part.abs());
                        at((distance + part * thickness).abs(), density);
                    }
                }
            }
        }
        [sums[1] / sums[0], sums[2] / sums[0]]
    }

    /// The waves of a period without the heat of the other contacts have the temperature of a sum over all pairs of planes that are alone,
    /// from slow to fast contacts.
    #[test]
    fn waves_have_the_temperature_of_pairs_of_planes() {
        for is_line in [false, true] {
            let pressure = hertz(is_line);
            let heated = |pressure: &f64| if *pressure > 0.0 { 1.0 } else { 0.0 };
            let flux: Vec<f64> = pressure.pressure.iter().map(heated).collect();
            let bulk = bulk(&pressure, POWER_DEPTH_RULE);
            for peclet_number in [1e-9, 0.3, 3.0, 30.0] {
                let diffusivity: f64 = 0.25 / peclet_number;
                let heat = DepthHeat {
                    bulk: &bulk,
                    unit_power: 1.0,
                    grid: &pressure.grid,
                    surface_flux: &flux,
                    velocity_over_diffusivity: diffusivity.recip(),
                    conductivity: 1.0,
                    beside: Beside::HalfSpace {
                        contact_length: 1.0,
                        is_line,
                    },
                };
                let found = heat.profile(0.0).expect("a profile");
                let found = found.expect("power of the bulk");
                let mean = found.profile.mean().value;
                let found = [mean - found.by_interface, found.by_interface];
                let expected = by_pairs_of_planes(&pressure, &flux, diffusivity, is_line);
                for (found, expected) in found.into_iter().zip(expected) {
                    let off = (found / expected - 1.0).abs();
                    assert!(
                        off < FREE_DEPTH_ERROR,
                        "Pe {peclet_number}: {found}, not {expected}"
                    );
                }
            }
        }
    }
}
