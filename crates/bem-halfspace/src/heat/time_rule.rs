//! Influence coefficients of moving elements as a sum over the times since the heat was released.
//!
//! Heat that was released the time t ago has spread over the *diffusion length* s = √(4Dt) and moved backwards by vt = s²/λ, with the
//! *wake length* λ = 4D/v. A unit flux on an element with the edges a and b therefore heats the surface at (x, y) from its centre by
//!
//! ```text
//! k T = (1/√π) ∫_0^∞ S(s) X(x + vt, a, s) X(y, b, s) ds,   X(x, a, s) = ½ [erf((x + a/2)/s) − erf((x − a/2)/s)]
//! ```
//!
//! with the ratio S of pulses at the depth of the source to those at the surface; on a line the factor of y is 1. This is the
//! integral of the point source over the element and the depth, without its singularity. The integrand is analytic, and the same
//! nodes hold for all offsets.
//!
//! Theory: docs/theory/heat.md, "Elements".

use std::f64::consts::PI;

use crate::Grid;
use crate::heat::source::SourceDepth;
use crate::parallel::row_blocks::{copies, for_each_row};
use crate::transform::plane_transform::PlaneTransform;
use crate::transform::plane_transform::complex_product::{Spectrum, signed_offset};

/// Step of the trapezoidal rule in w, with the diffusion length s = λ ln(1 + e^w). Measured: the errors of coefficients at
/// rest and on lines are below 8e-9 of their values, or below 1e-12 of the self-influence. With 0.3 they are fifty times as large.
/// The tests of coefficients in tests/it/heat.rs repeat this for 0.25.
const STEP_IN_W: f64 = 0.25;
/// Largest relative error of an influence coefficient, for error bars; see [`STEP_IN_W`].
pub(super) const KERNEL_ERROR: f64 = 1e-8;
/// First node of the time quadrature: ln of the diffusion length s = √(4Dt) over the smaller of the shorter element edge and the wake
/// length λ. Derived: earlier times contribute a fraction of e^(−30), or 1e-13.
const FIRST_LN_LENGTH: f64 = -30.0;
/// Ratio of the largest diffusion length s to the longer edge of the grid. Derived: later heat adds a relative contribution of its reciprocal.
const LAST_NODE_RATIO: f64 = 1e12;
/// Distance in units of the diffusion length s at which heat counts as zero. Derived: erfc(6.2)/2 is 1e-18.
const NEGLIGIBLE_DISTANCE: f64 = 6.2;
/// Edge in units of the diffusion length s below which the share X is integrated by a Gauss rule, because the difference of error
/// functions cancels. Derived: the relative error of five points is then 1e-11.
const NARROW_EDGE: f64 = 0.5;
/// Positive nodes of the Gauss–Legendre rule of five points on [−1, 1] with their weights (NIST DLMF 3.5).
const GAUSS_PAIRS: [(f64, f64); 2] = [
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];
/// Weight of the middle node of the Gauss–Legendre rule of five points.
const GAUSS_MIDDLE: f64 = 128.0 / 225.0;

/// Nodes of the time integral for the elements of one grid.
#[derive(Debug, Clone)]
pub(super) struct TimeRule {
    /// Grid of the elements.
    grid: Grid,
    /// Nodes in the order of time.
    nodes: Vec<TimeNode>,
}

/// A time since the heat was released. Lengths are in the unit of the grid.
#[derive(Debug, Clone)]
struct TimeNode {
    /// Diffusion length s = √(4Dt).
    length: f64,
    /// Distance vt by which the heat has moved backwards.
    shift: f64,
    /// Weight of the integral over s, divided by √π.
    weight: f64,
    /// Factor of y by the number of elements across, up to the last one that is not 0.
    across: Vec<f64>,
}

impl TimeRule {
    /// The rule for bodies: elements with both edges finite. `wake_length` is λ = 4D/v, infinite at rest.
    pub(super) fn of_body(grid: &Grid, wake_length: f64) -> Self {
        let [edge_x, edge_y] = grid.spacing();
        let across = |length| {
            let shares = (0..grid.shape()[1])
                .map(|column| share_of_interval(column as f64 * edge_y, edge_y, length));
            shares.take_while(|share| *share > 0.0).collect()
        };
        let extent = [0, 1].map(|axis| grid.shape()[axis] as f64 * grid.spacing()[axis]);
        let farthest = LAST_NODE_RATIO * extent[0].max(extent[1]);
        Self::new(grid, wake_length, farthest, edge_x.min(edge_y), across)
    }

    /// The rule for elements that are infinite along y; `wake_length` is finite.
    pub(super) fn of_line(grid: &Grid, wake_length: f64) -> Self {
        let farthest = f64::INFINITY;
        Self::new(grid, wake_length, farthest, grid.spacing()[0], |_| {
            vec![1.0]
        })
    }

    /// The rule for elements with the shortest edge `edge` and factors `across(s)` of y, up to the diffusion length `farthest`.
    fn new(
        grid: &Grid,
        wake_length: f64,
        farthest: f64,
        edge: f64,
        across: impl Fn(f64) -> Vec<f64>,
    ) -> Self {
        // The substitution is s = edge e^w at rest. It is logarithmic up to s = λ, and linear beyond, where heat leaves an element within
        // a change of s by λ/2.
        let is_moving = wake_length.is_finite();
        let grid_length = grid.shape()[0] as f64 * grid.spacing()[0];
        let start = FIRST_LN_LENGTH + (edge / wake_length).ln().min(0.0);
        let mut nodes = Vec::new();
        for index in 0_u32.. {
            let w = f64::from(index) * STEP_IN_W + if is_moving { start } else { FIRST_LN_LENGTH };
            let (length, slope) = if is_moving {
                let softplus = w.max(0.0) + (-w.abs()).exp().ln_1p();
                (wake_length * softplus, wake_length / (1.0 + (-w).exp()))
            } else {
                (edge * w.exp(), edge * w.exp())
            };
            let shift = length * (length / wake_length);
            let has_left = shift - grid_length > NEGLIGIBLE_DISTANCE * length;
            if has_left || length > farthest {
                break;
            }
            nodes.push(TimeNode {
                length,
                shift,
                weight: STEP_IN_W * slope / PI.sqrt(),
                across: across(length),
            });
        }
        Self { grid: *grid, nodes }
    }

    /// Fourier transform of the influence coefficients k T for sources at a `depth`; `unit` is the length unit of the grid, \[m].
    pub(super) fn spectrum(
        &self,
        transform: &PlaneTransform,
        depth: &SourceDepth,
        unit: f64,
    ) -> Spectrum {
        let ([rows, columns], [edge, _]) = (self.grid.shape(), self.grid.spacing());
        let ratio = |node: &TimeNode| node.weight * depth.pulse_ratio(node.length * unit);
        let weights: Vec<f64> = self.nodes.iter().map(ratio).collect();
        // Offsets along x fill the period of the transform; those that do not occur stay zero.
        let mut influence = copies(0.0, transform.padded[0] * columns);
        for_each_row(&mut influence, columns, |row, values| {
            let offset = signed_offset(row, transform.padded[0]);
            if offset.unsigned_abs() < rows {
                self.add_nodes(offset as f64 * edge, &weights, values);
            }
        });
        let value = |row: usize, column: usize| {
            if column < columns {
                influence[row * columns + column]
            } else {
                0.0
            }
        };
        transform.spectrum(value, |_, _| {})
    }

    /// Adds the weighted nodes at an offset x to the coefficients by the number of elements across.
    fn add_nodes(&self, x: f64, weights: &[f64], values: &mut [f64]) {
        let edge = self.grid.spacing()[0];
        let nodes = self.nodes.iter().zip(weights);
        for (node, weight) in nodes.filter(|(_, weight)| **weight > 0.0) {
            let along = share_of_interval(x + node.shift, edge, node.length);
            if along > 0.0 {
                for (value, across) in values.iter_mut().zip(&node.across) {
                    *value += weight * along * across;
                }
            }
        }
    }
}

/// Share X of heat from an interval of the length `edge` that is found per interval at the distance `x` from its centre, after
/// diffusion over the length s = `length`.
fn share_of_interval(x: f64, edge: f64, length: f64) -> f64 {
    if x.abs() - 0.5 * edge > NEGLIGIBLE_DISTANCE * length {
        return 0.0;
    }
    if edge > NARROW_EDGE * length {
        let at = |x: f64| libm::erf(x / length);
        return 0.5 * (at(x + 0.5 * edge) - at(x - 0.5 * edge));
    }
    let gaussian = |node: f64| (-((x + 0.5 * edge * node) / length).powi(2)).exp();
    let pairs = GAUSS_PAIRS.map(|(node, weight)| weight * (gaussian(node) + gaussian(-node)));
    let sum = GAUSS_MIDDLE * gaussian(0.0) + pairs[0] + pairs[1];
    0.5 * edge / (length * PI.sqrt()) * sum
}
