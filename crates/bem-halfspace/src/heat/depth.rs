//! Temperature below a contact, where its material dissipates.
//!
//! On a period, planes of power at the depths z_i and the interface heat the plane at z_j by
//!
//! ```text
//! k T̂_j = [Σ_i P̂_i (e^(−β|z_j − z_i|) + e^(−β(z_j + z_i))) + 2 F̂ e^(−βz_j)]/(2β),        β² = q² − i q_x v/D,  Re β > 0
//! ```
//!
//! with the power P per area of a plane and the flux F of the interface (Carslaw & Jaeger 1959, § 14.9: the insulated surface mirrors the
//! sources). Waves that do not move over the elastomer grow in time,
//!
//! ```text
//! k T̂_j = (1/√π) ∫_0^√(4Dt) e^(−q²s²/4) [Σ_i P̂_i (e^(−(z_j − z_i)²/s²) + e^(−(z_j + z_i)²/s²))/2 + F̂ e^(−z_j²/s²)] ds.
//! ```
//!
//! The planes are nodes of the trapezoidal rule over ln z, which is exponentially accurate but for the kink of the first exponential at
//! i = j, and for waves and pulses that are narrower than the distance of the planes. There the summand is the one with which the rule is
//! exact on equidistant planes.
//!
//! Theory: docs/theory/heat.md, "Temperature in the depth".

use std::f64::consts::{LN_2, PI};

use numerics::{Estimate, lobatto_rule};
use rustfft::num_complex::Complex;

use crate::heat::bulk::{BulkHeat, Plane, wave_steps, waves_of_elements};
use crate::heat::depth_below_body::FreeHeat;
use crate::heat::periodic_waves::decay_constant;
use crate::parallel::row_blocks::for_each_row;
use crate::transform::plane_transform::ZERO;
use crate::transform::plane_transform::complex_product::signed_offset;
use crate::{BemError, Grid};

/// Product of wave number and mean depth of the power 4 q³ z² e^(−2qz). Derived: ∫ z 4q³z²e^(−2qz) dz = 3/(2q).
const MEAN_DEPTH: f64 = 1.5;
/// Step of the logarithm of the wave number in a table of rises. Chosen: half of the step of ln z of the depths, over which the rise of a
/// wave is a mean.
const TABLE_STEP: f64 = 0.3;

/// Relative error of the mean rise by the rule over the depth. Measured: the largest of the unit test below is 8.6e-3.
pub(super) const DEPTH_ERROR: f64 = 1e-2;

/// Temperature rise below a contact at one depth.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DepthRise {
    /// Depth z, \[m].
    pub depth: f64,
    /// Mean rise at this depth weighted with the power that is dissipated there, \[K].
    pub rise: f64,
    /// Power about this depth per area of a period, or of the computed surroundings of a body, \[W/m²]; per width of those of a line
    /// contact.
    pub power: f64,
}

/// Temperature rise below a contact over the depth.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DepthProfile {
    /// Rises at increasing depths.
    depths: Vec<DepthRise>,
    /// Mean rise over all depths weighted with the power that is dissipated there, \[K].
    mean: Estimate,
    /// Mean rise of the contact area, \[K].
    contact: f64,
}

impl DepthProfile {
    /// Rises at increasing depths, at least one.
    pub fn depths(&self) -> &[DepthRise] {
        &self.depths
    }

    /// Mean rise of the contact area, \[K].
    pub const fn contact(&self) -> f64 {
        self.contact
    }

    /// Mean rise over all depths weighted with the power that is dissipated there, \[K]: that of the material.
    pub const fn mean(&self) -> Estimate {
        self.mean
    }

    /// The profile with another mean, whose error is known.
    pub(super) fn with_mean(self, mean: Estimate) -> Self {
        Self { mean, ..self }
    }

    /// Rise at a depth > 0 \[m], linear in the logarithm of the depth, and constant above the first and below the last one, \[K].
    pub fn at(&self, depth: f64) -> f64 {
        let upper = self.depths.partition_point(|one| one.depth < depth);
        let last = self.depths.len() - 1;
        let [left, right] = [
            self.depths[upper.saturating_sub(1)],
            self.depths[upper.min(last)],
        ];
        if left.depth >= right.depth {
            return left.rise;
        }
        let part = (depth / left.depth).ln() / (right.depth / left.depth).ln();
        left.rise + part * (right.rise - left.rise)
    }

    /// Mean rise over the depth where a pressure wave of the wave number q > 0 \[rad/m] dissipates, 4 q³ z² e^(−2qz) (Persson 2006), \[K].
    pub fn of_wave(&self, wave_number: f64) -> f64 {
        // The weights of the trapezoidal rule over ln z are relative to the largest one, because all may underflow.
        let log_weight = |one: &DepthRise| {
            let exponent = wave_number * one.depth;
            3.0 * exponent.ln() - 2.0 * exponent
        };
        let logs = self.depths.iter().map(log_weight);
        let largest = logs.clone().fold(f64::NEG_INFINITY, f64::max);
        let weighted = self.depths.iter().zip(logs).map(|(one, log)| {
            let weight = (log - largest).exp();
            [weight * one.rise, weight]
        });
        let [sum, weights] = weighted.fold([0.0; 2], |[sum, weights], [rise, weight]| {
            [sum + rise, weights + weight]
        });
        sum / weights
    }

    /// Largest rise of the contact area and at the depths, \[K].
    pub fn largest(&self) -> f64 {
        let depths = self.depths.iter().map(|one| one.rise);
        depths.fold(self.contact, f64::max)
    }

    /// Wave numbers from that of the longest wave whose rise the depths know to that of the shortest one, \[rad/m], for a table of
    /// [`of_wave`](Self::of_wave).
    pub fn wave_numbers(&self) -> Vec<f64> {
        let ends = [self.depths.last(), self.depths.first()];
        let ends = ends.map(|one| one.map_or(f64::NAN, |one| MEAN_DEPTH / one.depth));
        let steps = ((ends[1] / ends[0]).ln() / TABLE_STEP).ceil();
        (0..=numerics::whole_part(steps))
            .map(|index| ends[0] * (TABLE_STEP * index as f64).exp())
            .collect()
    }

    /// The profile with all rises multiplied by a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let scaled = |one: &DepthRise| DepthRise {
            rise: factor * one.rise,
            ..*one
        };
        Self {
            depths: self.depths.iter().map(scaled).collect(),
            mean: self.mean * factor,
            contact: factor * self.contact,
        }
    }

    /// Mean absolute difference of the rise from that of another profile, weighted with the power of the bulk, \[K].
    pub fn difference_from(&self, other: &Self) -> f64 {
        let differences = self.depths.iter().map(|one| DepthRise {
            rise: (one.rise - other.at(one.depth)).abs(),
            ..*one
        });
        power_weighted_mean(&differences.collect::<Vec<_>>())
    }
}

/// Mean rise weighted with the power, \[K].
fn power_weighted_mean(depths: &[DepthRise]) -> f64 {
    let products = depths.iter().map(|one| [one.rise * one.power, one.power]);
    let [sum, power] = products.fold([0.0; 2], |[sum, all], [rise, power]| {
        [sum + rise, all + power]
    });
    sum / power
}

/// Half space around the surroundings of a contact that are computed.
#[derive(Debug, Clone, Copy)]
pub(super) enum Beside {
    /// Other periods.
    Periods {
        /// Diffusion length √(4Dt) of the time t for which the surface has been sliding, \[m].
        mean_length: f64,
    },
    /// An unheated half space, in the stationary state.
    HalfSpace {
        /// Length of the contact, \[m].
        contact_length: f64,
        /// True for a line contact.
        is_line: bool,
    },
}

/// Heat of the surroundings of a contact and the elastomer that conducts it.
pub(super) struct DepthHeat<'a> {
    /// Power of the material, in units of `unit_power`.
    pub(super) bulk: &'a BulkHeat,
    /// Power per volume of one unit of the bulk, \[W/m³].
    pub(super) unit_power: f64,
    /// Elements of the bulk.
    pub(super) grid: &'a Grid,
    /// Flux of the interface into the elastomer on them, \[W/m²].
    pub(super) surface_flux: &'a [f64],
    /// Reciprocal v/D > 0 of the Péclet length, \[1/m].
    pub(super) velocity_over_diffusivity: f64,
    /// Conductivity k, \[W/m/K].
    pub(super) conductivity: f64,
    /// Half space around these elements.
    pub(super) beside: Beside,
}

/// Waves of the heat of planes and the interface on a period.
pub(super) struct HeatWaves<'a> {
    /// Elements of the period.
    pub(super) shape: [usize; 2],
    /// Wave numbers of the longest waves along x and y, \[rad/m].
    pub(super) steps: [f64; 2],
    /// Power of the planes that heat others, in the unit of the bulk.
    pub(super) sources: &'a [Plane],
    /// Power of the same planes, with which their temperatures are weighted.
    pub(super) weights: &'a [Plane],
    /// Flux of the interface, \[W/m²].
    pub(super) surface_flux: &'a [Complex<f64>],
}

impl HeatWaves<'_> {
    /// For each plane the mean over the period of its weight times its temperatures, which follow from `rises` by the wave numbers along x and
    /// y and the powers of the planes.
    pub(super) fn weighted_rises(
        &self,
        nodes: &[Node],
        rises: impl Fn([f64; 2], &[Complex<f64>]) -> Vec<WaveRise> + Sync,
    ) -> Vec<WeightedRise> {
        // The waves of the negative half along y are conjugates of the others.
        let [rows, columns] = self.shape;
        let n_columns = columns / 2 + 1;
        let mut sums = vec![WeightedRise::default(); n_columns * nodes.len()];
        for_each_row(&mut sums, nodes.len(), |column, sums| {
            let is_single = column == 0 || 2 * column == columns;
            let count = if is_single { 1.0 } else { 2.0 };
            for row in 0..rows {
                let place = [signed_offset(row, rows), column.cast_signed()];
                let q = [0, 1].map(|axis| self.steps[axis] * place[axis] as f64);
                // Waves of the power; deeper planes have coarser grids and resolve fewer.
                let powers_of = |planes: &[Plane]| -> Vec<Complex<f64>> {
                    let waves = planes.iter().map_while(|plane| plane.wave(place));
                    let powers = waves.zip(nodes);
                    powers
                        .map(|(wave, node)| wave * node.power_of_unit)
                        .collect()
                };
                // Parseval: products of waves add up to the mean of the product.
                let flux = self.surface_flux[column * rows + row];
                let rises = rises(q, &powers_of(self.sources));
                for ((sum, weight), rise) in
                    sums.iter_mut().zip(powers_of(self.weights)).zip(&rises)
                {
                    sum.by_bulk += count * (weight.conj() * rise.by_bulk).re;
                    sum.by_interface += count * (weight.conj() * rise.of_unit_flux * flux).re;
                }
            }
        });
        // Add the columns of waves, which were computed in parallel, for each plane.
        let of_plane = |plane: usize| {
            let mut all = WeightedRise::default();
            for sum in sums.iter().skip(plane).step_by(nodes.len()) {
                all.by_bulk += sum.by_bulk;
                all.by_interface += sum.by_interface;
            }
            all
        };
        (0..nodes.len()).map(of_plane).collect()
    }
}

/// Temperature k T of a plane by a wave.
#[derive(Debug, Clone, Copy)]
pub(super) struct WaveRise {
    /// That by the powers of all planes, \[W/m].
    by_bulk: Complex<f64>,
    /// That by a unit flux of the interface, \[m].
    of_unit_flux: Complex<f64>,
}

/// Mean of the power of a plane times its temperature k T, \[W²/m³].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct WeightedRise {
    /// That by the powers of all planes.
    pub(super) by_bulk: f64,
    /// That by the flux of the interface.
    pub(super) by_interface: f64,
}

/// Temperature over the depth, and the part of its mean by the flux of the interface.
pub(super) struct FoundProfile {
    /// Temperature over the depth.
    pub(super) profile: DepthProfile,
    /// Mean rise by the flux of the interface, weighted with the power of the bulk, \[K].
    pub(super) by_interface: f64,
}

impl DepthHeat<'_> {
    /// The temperature over the depth below a contact area with the mean rise `contact` \[K]; `None` if nothing is dissipated there.
    pub(super) fn profile(&self, contact: f64) -> Result<Option<FoundProfile>, BemError> {
        // Find the power-weighted temperature of each plane by all planes and the interface.
        let planes = self.bulk.spectra();
        let nodes: Vec<Node> = planes.iter().map(|plane| self.node(plane)).collect();
        let sums = match self.beside {
            Beside::Periods { mean_length } => {
                let waves = HeatWaves {
                    shape: self.bulk.shape(),
                    steps: wave_steps(self.grid),
                    sources: planes,
                    weights: planes,
                    surface_flux: &waves_of_elements(self.grid, self.surface_flux),
                };
                let standing = StandingWaves::new(&nodes, mean_length);
                waves.weighted_rises(&nodes, |[q_x, q_y], powers| {
                    // Waves with crests along x do not move over the elastomer, and grow in time.
                    if q_x == 0.0 {
                        return standing.rises(q_y, powers);
                    }
                    let beta = decay_constant([q_x, q_y], self.velocity_over_diffusivity, 0.0);
                    running_wave(beta, &nodes, powers)
                })
            }
            Beside::HalfSpace {
                contact_length,
                is_line,
            } => FreeHeat::new(self, contact_length, is_line)?.weighted_rises(self, &nodes),
        };
        // Divide it by the power of the plane; planes without power have no mean.
        let rise_of = |((plane, node), sum): ((&Plane, &Node), &WeightedRise)| {
            let power = plane.mean_power() * node.power_of_unit;
            (power > 0.0).then(|| DepthRise {
                depth: node.depth,
                rise: (sum.by_bulk + sum.by_interface) / power / self.conductivity,
                power,
            })
        };
        let pairs = planes.iter().zip(&nodes).zip(&sums);
        let depths: Vec<DepthRise> = pairs.filter_map(rise_of).collect();
        if depths.is_empty() {
            return Ok(None);
        }
        let power: f64 = depths.iter().map(|one| one.power).sum();
        let by_interface: f64 = sums.iter().map(|sum| sum.by_interface).sum();
        let profile = DepthProfile {
            mean: Estimate::exact(power_weighted_mean(&depths)),
            depths,
            contact,
        };
        Ok(Some(FoundProfile {
            profile,
            by_interface: by_interface / power / self.conductivity,
        }))
    }

    /// The node of a plane in the trapezoidal rule over ln z.
    fn node(&self, plane: &Plane) -> Node {
        let depth = plane.depth();
        let spacing = depth * self.bulk.log_step();
        Node {
            depth,
            spacing,
            power_of_unit: self.unit_power * spacing,
        }
    }
}

/// A node of the trapezoidal rule over the depth.
pub(super) struct Node {
    /// Depth, \[m].
    pub(super) depth: f64,
    /// Distance of the nodes about this depth, \[m].
    spacing: f64,
    /// Power per area of one unit of power of its plane, \[W/m²].
    pub(super) power_of_unit: f64,
}

/// Temperatures of the planes that a running wave reaches.
pub(super) fn running_wave(
    beta: Complex<f64>,
    nodes: &[Node],
    powers: &[Complex<f64>],
) -> Vec<WaveRise> {
    let nodes = &nodes[..powers.len()];
    let decay_from = |index: usize| match index {
        0 => (-beta * nodes[0].depth).exp(),
        _ => (-beta * (nodes[index].depth - nodes[index - 1].depth)).exp(),
    };
    let decays: Vec<Complex<f64>> = (0..nodes.len()).map(decay_from).collect();
    // Collect the sources from below upwards: at each plane those beneath it, and at the surface all of them.
    let mut rises: Vec<Complex<f64>> = nodes
        .iter()
        .zip(powers)
        .map(|(node, power)| power * own_summand(beta * node.spacing))
        .collect();
    let mut from_below = ZERO;
    for (index, rise) in rises.iter_mut().enumerate().rev() {
        *rise += from_below;
        from_below = (from_below + powers[index]) * decays[index];
    }
    // The mirrored sources and the interface act from the surface downwards, the former with the sources above each plane.
    let mut from_above = from_below;
    let mut from_surface = Complex::from(2.0);
    let of_plane = |(index, from_others): (usize, Complex<f64>)| {
        from_above *= decays[index];
        from_surface *= decays[index];
        let rise = WaveRise {
            by_bulk: (from_others + from_above) / (beta * 2.0),
            of_unit_flux: from_surface / (beta * 2.0),
        };
        from_above += powers[index];
        rise
    };
    rises.into_iter().enumerate().map(of_plane).collect()
}

/// Absolute value of the exponent below which the summand is computed by its series. Derived: the next term of the series is
/// x⁷/604800 = 2e-13, and the closed form loses 1e-16/x by cancellation.
const SERIES_LIMIT: f64 = 0.1;

/// Summand of a node itself in the trapezoidal rule for e^(−|x|) with the spacing x, 2/x − 2/(eˣ − 1), which is 1 for x → 0: the rule is
/// then exact, as the geometric series over all other nodes shows.
fn own_summand(spacing: Complex<f64>) -> Complex<f64> {
    if spacing.norm() > SERIES_LIMIT {
        let decay = (-spacing).exp();
        return spacing.inv() * 2.0 - decay * 2.0 / (-decay + 1.0);
    }
    // −2 Σ B_n xⁿ⁻¹/n! with the Bernoulli numbers B_n for n ≥ 1 (NIST DLMF 24.2.1).
    let square = spacing * spacing;
    -spacing * (square * (square / 15_120.0 - 1.0 / 360.0) + 1.0 / 6.0) + 1.0
}

/// Number of nodes of the quadrature over the diffusion length, in each octave. Chosen: the rule is exact to the degree 13 in its
/// logarithm, over which the integrand changes by a few factors of e.
const NODES_PER_OCTAVE: usize = 8;
/// Ratio of the smallest diffusion length to the smallest distance of planes. Derived: shorter pulses have this fraction of the
/// temperature, of a plane that has 1e-3 of the power.
const SMALLEST_LENGTH: f64 = 1e-3;

/// Temperatures of the waves with crests along x, which grow in time: a quadrature over the diffusion length s = √(4Dt).
struct StandingWaves {
    /// Diffusion lengths with their weights, \[m].
    lengths: Vec<[f64; 2]>,
    /// Pulses of the interface, for each length one at each plane.
    of_surface: Vec<f64>,
    /// Pulses of the planes and their mirror images, for each length a square matrix.
    of_planes: Vec<f64>,
}

impl StandingWaves {
    /// Pulses up to the diffusion length `longest`, \[m].
    fn new(nodes: &[Node], longest: f64) -> Self {
        // Quadrature over ln s by octaves, down to pulses far narrower than the planes' spacing.
        let narrowest = nodes
            .iter()
            .map(|node| node.spacing)
            .fold(longest, f64::min);
        let octaves = (longest / (SMALLEST_LENGTH * narrowest)).log2();
        let octaves = numerics::whole_part(octaves.max(0.0)) + 1;
        let rule = lobatto_rule(NODES_PER_OCTAVE);
        let lengths: Vec<[f64; 2]> = (0..octaves)
            .flat_map(|octave| {
                let of_octave = rule.nodes.iter().zip(&rule.weights);
                of_octave.map(move |(node, weight)| {
                    let length = longest * (LN_2 * (0.5 * (node - 1.0) - octave as f64)).exp();
                    [length, 0.5 * LN_2 * weight * length / PI.sqrt()]
                })
            })
            .filter(|[length, _]| *length > 0.0)
            .collect();
        // Pulses from plane to plane, with the mirror images at the insulated surface.
        let mut of_surface = Vec::with_capacity(lengths.len() * nodes.len());
        let mut of_planes = Vec::with_capacity(of_surface.capacity() * nodes.len());
        for [length, _] in &lengths {
            let pulse = |distance: f64| (-(distance / length).powi(2)).exp();
            for (index, node) in nodes.iter().enumerate() {
                of_surface.push(pulse(node.depth));
                of_planes.extend(nodes.iter().enumerate().map(|(other, source)| {
                    let direct = if other == index {
                        own_pulse(length / node.spacing)
                    } else {
                        pulse(node.depth - source.depth)
                    };
                    0.5 * (direct + pulse(node.depth + source.depth))
                }));
            }
        }
        Self {
            lengths,
            of_surface,
            of_planes,
        }
    }

    /// Temperatures of the planes that a wave of the wave number q along y \[rad/m] reaches.
    fn rises(&self, q: f64, powers: &[Complex<f64>]) -> Vec<WaveRise> {
        let n_planes = self.of_surface.len() / self.lengths.len().max(1);
        let none = WaveRise {
            by_bulk: ZERO,
            of_unit_flux: ZERO,
        };
        let mut rises = vec![none; powers.len()];
        for (index, [length, weight]) in self.lengths.iter().enumerate() {
            let weight = weight * (-(0.5 * q * length).powi(2)).exp();
            for (plane, rise) in rises.iter_mut().enumerate() {
                let of_plane = index * n_planes + plane;
                let pulses = &self.of_planes[of_plane * n_planes..];
                let bulk: Complex<f64> = powers.iter().zip(pulses).map(|(p, g)| p * g).sum();
                rise.by_bulk += bulk * weight;
                rise.of_unit_flux += self.of_surface[of_plane] * weight;
            }
        }
        rises
    }
}

/// Summand of a node itself in the trapezoidal rule for e^(−x²/s²) with the `ratio` of s to the spacing, for which the rule is exact:
/// √π s − 2 Σ e^(−n²/s²), which is 1 for wide pulses. By Poisson's summation it is also 1 − 2 √π s Σ e^(−(πns)²).
fn own_pulse(ratio: f64) -> f64 {
    let area = PI.sqrt() * ratio;
    if ratio < 1.0 {
        area - 2.0 * ((-ratio.powi(-2)).exp() + (-4.0 * ratio.powi(-2)).exp())
    } else {
        1.0 - 2.0 * area * (-(PI * ratio).powi(2)).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nodes of the trapezoidal rule for a source 4 z² e^(−2z) of one wave, with their powers.
    fn nodes_of_one_wave(log_step: f64) -> (Vec<Node>, Vec<Complex<f64>>) {
        let count = numerics::whole_part((1000.0_f64).ln() / log_step) + 1;
        let node = |index: usize| {
            let depth = 0.01 * (log_step * index as f64).exp();
            Node {
                depth,
                spacing: depth * log_step,
                power_of_unit: depth * log_step,
            }
        };
        let nodes: Vec<Node> = (0..count).map(node).collect();
        let power = |node: &Node| {
            let density = 4.0 * node.depth.powi(2) * (-2.0 * node.depth).exp();
            Complex::from(density * node.power_of_unit)
        };
        let powers = nodes.iter().map(power).collect();
        (nodes, powers)
    }

    /// Thickness of the layers of [`quadrature`].
    const LAYER: f64 = 0.004;

    /// Power-weighted mean of the temperature by the source of [`nodes_of_one_wave`] and of that by a flux of 1 at the surface, from the
    /// kernel(z, z') by the midpoint rule on thin layers.
    fn quadrature(kernel: impl Fn(f64, f64) -> Complex<f64>) -> [Complex<f64>; 2] {
        let depths: Vec<f64> = (0..2500)
            .map(|index| LAYER * (f64::from(index) + 0.5))
            .collect();
        let density = |z: f64| 4.0 * z * z * (-2.0 * z).exp() * LAYER;
        let mut sums = [ZERO; 2];
        for z in &depths {
            let by_bulk: Complex<f64> =
                depths.iter().map(|of| kernel(*z, *of) * density(*of)).sum();
            sums[0] += by_bulk * density(*z);
            sums[1] += kernel(*z, 0.0) * density(*z);
        }
        sums
    }

    /// The mean temperature agrees with a quadrature of the point sources, for slow and fast waves, early and late, of a wave that is ten
    /// times as long as the shortest one: by the bulk within the stated error, and by the interface within a tenth of that of the
    /// temperature of the surface.
    #[test]
    fn planes_have_the_temperature_of_their_sources() {
        let (nodes, powers) = nodes_of_one_wave(0.6);
        let means = |rises: Vec<WaveRise>| -> [Complex<f64>; 2] {
            let mean = |of: fn(&WaveRise) -> Complex<f64>| {
                let products = powers.iter().zip(&rises);
                products.map(|(power, rise)| power * of(rise)).sum()
            };
            [mean(|rise| rise.by_bulk), mean(|rise| rise.of_unit_flux)]
        };
        let check = |name: String, exact: [Complex<f64>; 2], found: [Complex<f64>; 2], surface| {
            let [bulk, interface] = [0, 1].map(|index| (found[index] - exact[index]).norm());
            let errors = [bulk / exact[0].norm(), interface / surface];
            assert!(errors[0] < DEPTH_ERROR, "{name}: {errors:?}");
            assert!(errors[1] < 0.1 * DEPTH_ERROR, "{name}: {errors:?}");
        };
        for beta in [[0.1, 0.0], [1.0, -0.5], [10.0, -10.0], [30.0, -30.0]] {
            let beta = Complex::new(beta[0], beta[1]);
            let x = beta * LAYER;
            let exact = quadrature(|z, of| {
                let images = (-beta * (z - of).abs()).exp() + (-beta * (z + of)).exp();
                // The midpoint rule has a kink at its own layer; with this summand it is exact for a uniform density.
                let is_own = (z - of).abs() < 0.5 * LAYER;
                let own = x.inv() * 2.0 - (x.exp() - 1.0).inv() * 2.0 - 1.0;
                (images + if is_own { own } else { ZERO }) / (beta * 2.0)
            });
            let found = means(running_wave(beta, &nodes, &powers));
            check(format!("β = {beta}"), exact, found, beta.norm().recip());
        }
        // Standing waves against the temperature of a plane after the time in which heat diffuses over a length.
        let ierfc = |x: f64| (-x * x).exp() / PI.sqrt() - x * libm::erfc(x);
        for length in [0.1, 1.0, 100.0] {
            let exact = quadrature(|z, of| {
                let sum = ierfc((z - of).abs() / length) + ierfc((z + of) / length);
                Complex::from(0.5 * length * sum)
            });
            let standing = StandingWaves::new(&nodes, length);
            let found = means(standing.rises(0.0, &powers));
            check(format!("length {length}"), exact, found, length / PI.sqrt());
        }
    }

    /// A wave is heated where it dissipates: short ones as the surface, long ones as the depth, and any one in a uniform profile.
    #[test]
    fn the_rise_of_a_wave_is_a_mean_over_the_depth() {
        let profile = |rise: &dyn Fn(f64) -> f64| DepthProfile {
            depths: (0..40)
                .map(|index| {
                    let depth = 1e-6 * (0.3 * f64::from(index)).exp();
                    DepthRise {
                        depth,
                        rise: rise(depth),
                        power: 1.0,
                    }
                })
                .collect(),
            mean: Estimate::exact(0.0),
            contact: 0.0,
        };
        let uniform = profile(&|_| 7.0);
        for q in [1e-9, 1.0, 1e4, 1e12] {
            assert!((uniform.of_wave(q) - 7.0).abs() < 1e-13);
        }
        // The mean depth of the power is 3/(2q).
        let linear = profile(&|depth| depth);
        for q in [1e4, 1e5] {
            assert!(
                (linear.of_wave(q) * q - 1.5).abs() < 3e-3,
                "{}",
                linear.of_wave(q) * q
            );
        }
        assert!((linear.of_wave(1e12) - 1e-6).abs() < 1e-12);
        assert!((linear.at(1e-5) / 1e-5 - 1.0).abs() < 0.02);
    }
}
