//! The part of a point's potential that a substrate adds to that of the half space.
//!
//! ```text
//! c(ρ) = ∫_0^∞ [M(s) − 1] J₀(sρ) ds
//! ```
//!
//! Near the load by quadrature as it stands. Far from it only the longest waves count, and with u = sρ and any n
//!
//! ```text
//! c(ρ) = [M(0) − 1]/ρ + (1/ρ) ∫_0^∞ [M(u/ρ) − M(0)] exp(−(u/A)^n) J₀(u) du + O(A^−n ρ^−3),
//! ```
//!
//! because odd powers of s have no potential beside the load.

use std::f64::consts::PI;

use numerics::{LobattoRule, lobatto_rule, whole_part};

use crate::Substrate;
use crate::substrate::base::SINGULARITY_DISTANCE;

/// Where 1/ρ + c of a layer on a rigid base is below 1e-15 of 1; from here on c is found from long waves.
pub(super) const RIGID_BASE_INFLUENCE_RADIUS: f64 = 44.0;
/// Where 1 − M is.
pub(super) const MAX_WAVE_NUMBER: f64 = 24.0;
/// Panels and points of the integral over s: as many as follow J₀(sρ) up to the reach.
const NEAR_WAVE_PANELS: u8 = 8;
const POINTS_PER_WAVE_PANEL: usize = 96;
/// Length in distances to the singularities of the panels of ρ on which c is integrated, and of those on which it is kept;
/// with as many coefficients as give 1e-12.
const PANEL_OVER_SINGULARITY_DISTANCE: f64 = 0.5;
const LONG_PANEL_TERMS: usize = 16;
const SHORT_PANEL_LENGTH: f64 = 0.0625;
const SHORT_PANEL_TERMS: usize = 6;

/// Where the rest of c, like ρ^−3, is below rounding.
const TABLE_END: f64 = 1e5;
/// A and n, with which the last term and the transform of the window itself are below 1e-12, and the panels of u with [`POINTS_PER_WAVE_PANEL`] points each up to where the factor is below rounding.
const WINDOW_WAVE_NUMBER: f64 = 120.0;
const WINDOW_POWER: i32 = 6;
const FAR_WAVE_PANELS: u8 = 9;
const FAR_MAX_WAVE_NUMBER: f64 = 220.0;

/// c(ρ): on short panels of the same length up to the reach, then on longer and longer ones, and by its limit beyond.
#[derive(Debug)]
pub(super) struct Correction {
    near: Vec<Panel<SHORT_PANEL_TERMS>>,
    far: Vec<Panel<LONG_PANEL_TERMS>>,
    /// M(0) − 1.
    limit: f64,
}

impl Correction {
    pub(super) fn new(substrate: &dyn Substrate, poisson_ratio: f64) -> Self {
        let waves: Vec<[f64; 2]> = wave_rule(NEAR_WAVE_PANELS, MAX_WAVE_NUMBER)
            .map(|[s, weight]| [s, weight * substrate.compliance_excess(s, poisson_ratio)])
            .collect();
        let integral = |rho: f64| -> f64 {
            let waves = waves.iter().map(|[s, weight]| weight * libm::j0(s * rho));
            waves.sum()
        };
        let panels = growing_panels([0.0, RIGID_BASE_INFLUENCE_RADIUS], integral);
        let value = |rho: f64| {
            let panel = panels.partition_point(|panel| panel.start <= rho);
            panels[panel.max(1) - 1].at(rho)
        };
        let starts = (0..).map(|index| SHORT_PANEL_LENGTH * f64::from(index));
        let starts = starts.take_while(|start| *start < RIGID_BASE_INFLUENCE_RADIUS);
        Self {
            near: starts
                .map(|start| Panel::new([start, SHORT_PANEL_LENGTH], value))
                .collect(),
            far: far_panels(substrate, poisson_ratio),
            limit: substrate.compliance_excess(0.0, poisson_ratio),
        }
    }

    pub(super) fn at(&self, rho: f64) -> f64 {
        if let Some(panel) = self.near.get(whole_part(rho / SHORT_PANEL_LENGTH)) {
            return panel.at(rho);
        }
        let panel = self.far.partition_point(|panel| panel.start <= rho);
        let rest = match panel.checked_sub(1).map(|index| &self.far[index]) {
            Some(panel) if rho < TABLE_END => panel.at(rho),
            _ => 0.0,
        };
        rho.recip() * self.limit + rest
    }
}

/// c(ρ) − [M(0) − 1]/ρ beyond the reach; nothing where the substrate has an end to its reach.
fn far_panels(substrate: &dyn Substrate, poisson_ratio: f64) -> Vec<Panel<LONG_PANEL_TERMS>> {
    if substrate.influence_radius() <= RIGID_BASE_INFLUENCE_RADIUS {
        return Vec::new();
    }
    let limit = substrate.compliance_excess(0.0, poisson_ratio);
    let waves: Vec<[f64; 2]> = wave_rule(FAR_WAVE_PANELS, FAR_MAX_WAVE_NUMBER)
        .map(|[u, weight]| {
            let window = (-(u / WINDOW_WAVE_NUMBER).powi(WINDOW_POWER)).exp();
            [u, weight * window * libm::j0(u)]
        })
        .collect();
    growing_panels([RIGID_BASE_INFLUENCE_RADIUS, TABLE_END], |rho| {
        let wave = |&[u, weight]: &[f64; 2]| {
            weight * (substrate.compliance_excess(u / rho, poisson_ratio) - limit)
        };
        waves.iter().map(wave).sum::<f64>() / rho
    })
}

/// Points and weights of an integral from 0 to an end, in panels.
fn wave_rule(panels: u8, end: f64) -> impl Iterator<Item = [f64; 2]> {
    let LobattoRule { nodes, weights } = lobatto_rule(POINTS_PER_WAVE_PANEL);
    let half = 0.5 * end / f64::from(panels);
    (0..panels).flat_map(move |panel| {
        let middle = half * f64::from(2 * panel + 1);
        let rule = nodes.clone().into_iter().zip(weights.clone());
        rule.map(move |(t, weight)| [middle + half * t, half * weight])
    })
}

/// Panels that are a part of the distance to the singularities of c long.
fn growing_panels(
    [mut start, end]: [f64; 2],
    function: impl Fn(f64) -> f64,
) -> Vec<Panel<LONG_PANEL_TERMS>> {
    let mut panels = Vec::new();
    while start < end {
        let length = PANEL_OVER_SINGULARITY_DISTANCE * f64::hypot(start, SINGULARITY_DISTANCE);
        panels.push(Panel::new([start, length], &function));
        start += length;
    }
    panels
}

/// A polynomial on a part of the line.
#[derive(Debug)]
struct Panel<const N: usize> {
    start: f64,
    /// 2 over its length.
    scale: f64,
    /// Of the powers of the distance from its middle in half lengths.
    coefficients: [f64; N],
}

impl<const N: usize> Panel<N> {
    /// The Chebyshev series of a function, as powers by the recurrence of Clenshaw (1955).
    fn new([start, length]: [f64; 2], function: impl Fn(f64) -> f64) -> Self {
        let angle = |index: usize| PI * (index as f64 + 0.5) / N as f64;
        let value = |index| function(start + 0.5 * length * (1.0 + angle(index).cos()));
        let values: [f64; N] = std::array::from_fn(value);
        let coefficient = |order: usize| {
            let terms = values.iter().enumerate();
            let terms = terms.map(|(index, value)| value * (order as f64 * angle(index)).cos());
            terms.sum::<f64>() / N as f64
        };
        let [mut last, mut coefficients] = [[0.0; N]; 2];
        for order in (0..N).rev() {
            let twice = if order == 0 { 1.0 } else { 2.0 };
            let next = std::array::from_fn(|power| match power {
                0 => twice * coefficient(order) - last[0],
                _ => twice * coefficients[power - 1] - last[power],
            });
            (last, coefficients) = (coefficients, next);
        }
        Self {
            start,
            scale: 2.0 / length,
            coefficients,
        }
    }

    fn at(&self, rho: f64) -> f64 {
        let x = self.scale * (rho - self.start) - 1.0;
        let coefficients = self.coefficients.iter().rev();
        coefficients.fold(0.0, |sum, coefficient| sum * x + coefficient)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// M − 1 = (A + B s) e^(−3s), whose potential is A/√(9 + ρ²) + 3 B/(9 + ρ²)^(3/2).
    #[derive(Debug)]
    struct Images(f64, f64);

    impl Substrate for Images {
        fn thickness(&self) -> f64 {
            1.0
        }

        fn compliance_ratio(&self, s: f64, _: f64) -> f64 {
            1.0 + (self.0 + self.1 * s) * (-3.0 * s).exp()
        }
    }

    #[test]
    fn the_potential_is_exact_at_any_distance() {
        for (a, b) in [(1.0, 0.0), (-0.9, 2.0), (30.0, -7.0)] {
            let table = Correction::new(&Images(a, b), 0.5);
            for step in 0..400 {
                let rho = 1e-3 * (0.06 * f64::from(step)).exp();
                let root = rho.hypot(3.0);
                let exact = a / root + 3.0 * b / root.powi(3);
                let error = (table.at(rho) - exact).abs() / (a.abs() + b.abs());
                assert!(error < 2e-12, "c({rho}) of {a}, {b} is off by {error:e}");
            }
        }
    }
}
