//! Table of the correction c(ρ) of a point's potential on a substrate, relative to the half space.
//!
//! ```text
//! c(ρ) = ∫_0^∞ [M(s) − 1] J₀(sρ) ds
//! ```
//!
//! ρ is the distance from the point load in thicknesses t, s/t the wave number and M the compliance ratio of the substrate. The
//! potential is 1/r + c(r/t)/t.
//!
//! Near the load the integral is computed by quadrature as it stands. Far from the load only the longest waves count. With
//! u = sρ and any n
//!
//! ```text
//! c(ρ) = [M(0) − 1]/ρ + (1/ρ) ∫_0^∞ [M(u/ρ) − M(0)] exp(−(u/A)^n) J₀(u) du + O(A^−n ρ^−3),
//! ```
//!
//! because odd powers of s have no potential outside the load.
//!
//! Theory: docs/layers.md, "Other substrates".

use std::f64::consts::PI;

use numerics::{LobattoRule, lobatto_rule, whole_part};

use crate::Substrate;
use crate::substrate::base::SINGULARITY_DISTANCE;

/// Influence radius of a load on a layer on a rigid base, in thicknesses: 1/ρ + c(ρ), which decays exponentially, is below 1e-15
/// beyond. On other substrates c is computed from long waves beyond it.
pub(super) const RIGID_BASE_INFLUENCE_RADIUS: f64 = 44.0;
/// Upper limit of the integral over s, without unit. Derived: on a layer on a rigid base 1 − M ∼ s² e^(−2s) is below 1e-15
/// beyond.
pub(super) const MAX_WAVE_NUMBER: f64 = 24.0;
/// Number of panels of the integral over s from 0 to [`MAX_WAVE_NUMBER`]. Derived: up to the influence radius J₀(sρ) has 168
/// waves, 21 on each panel, with 4.6 of the [`POINTS_PER_WAVE_PANEL`] points each.
const NEAR_WAVE_PANELS: u8 = 8;
/// Number of Lobatto points per panel of the integrals over s and u = sρ. Chosen: a panel has up to 21 waves of J₀(sρ), with more
/// than four points each, where the rule needs π.
const POINTS_PER_WAVE_PANEL: usize = 96;
/// Ratio of the length of a long panel of ρ to the distance |ρ ± 2i| from its start to the singularities of c. Chosen: the
/// Bernstein ellipse through the singularities then has half axes whose sum is more than eight times half the panel. A longer
/// panel needs more than [`LONG_PANEL_TERMS`].
const PANEL_OVER_SINGULARITY_DISTANCE: f64 = 0.5;
/// Number of polynomial coefficients on a long panel. Derived: the truncation error is of the order 8⁻¹⁶, or 4e-15, with the
/// ellipse of [`PANEL_OVER_SINGULARITY_DISTANCE`]. The whole correction c(ρ) has an error of 1e-12.
const LONG_PANEL_TERMS: usize = 16;
/// Length of the short panels of ρ below the influence radius, in thicknesses. Chosen as a power of two, so that a panel is found
/// by an exact division, and so short that [`SHORT_PANEL_TERMS`] coefficients are enough.
const SHORT_PANEL_LENGTH: f64 = 0.0625;
/// Number of polynomial coefficients on a short panel. Derived: half a panel is 1/64 of the distance from the singularities ±2i,
/// so that the truncation error is of the order 128⁻⁶, or 2e-13.
const SHORT_PANEL_TERMS: usize = 6;

/// End of the table, in thicknesses. Derived: the remainder of c beyond [M(0) − 1]/ρ falls like ρ^−3, and is of the order 1e-15
/// from here on.
const TABLE_END: f64 = 1e5;
/// Width A of the window exp(−(u/A)^n) in the integral over u. Derived: with it the term O(A^−n ρ^−3) of the head of this file
/// and the transform of the window are below 1e-12.
const WINDOW_WAVE_NUMBER: f64 = 120.0;
/// Power n of the window exp(−(u/A)^n) in the integral over u. Chosen: A⁻⁶ is 3e-13 with [`WINDOW_WAVE_NUMBER`]; a smaller power
/// needs a wider window.
const WINDOW_POWER: i32 = 6;
/// Number of panels of the integral over u from 0 to [`FAR_MAX_WAVE_NUMBER`]. Chosen: J₀(u) has 35 waves there, with more than
/// twenty of the [`POINTS_PER_WAVE_PANEL`] points of the panels each. The substrate may add variation of its own.
const FAR_WAVE_PANELS: u8 = 9;
/// Upper limit of the integral over u. Derived: beyond it the exponent of the window exp(−(u/A)^n) is above (220/120)^6 = 38, so
/// that the window is below rounding.
const FAR_MAX_WAVE_NUMBER: f64 = 220.0;

/// Correction c(ρ) as piecewise polynomials: short panels of equal length up to the influence radius of a rigid base, then panels
/// that grow with ρ, and the limit [M(0) − 1]/ρ beyond.
#[derive(Debug)]
pub(super) struct Correction {
    /// Panels of c(ρ) up to the influence radius of a rigid base.
    near: Vec<Panel<SHORT_PANEL_TERMS>>,
    /// Panels of c(ρ) − [M(0) − 1]/ρ beyond; empty if the substrate has no influence there.
    far: Vec<Panel<LONG_PANEL_TERMS>>,
    /// Limit M(0) − 1: excess of the compliance ratio for long waves.
    limit: f64,
}

impl Correction {
    /// Tabulates c(ρ) for a substrate under a material with a Poisson ratio.
    pub(super) fn new(substrate: &dyn Substrate, poisson_ratio: f64) -> Self {
        // Set up the quadrature of the integral over s: points, and weights times the excess M(s) − 1.
        let waves: Vec<[f64; 2]> = wave_rule(NEAR_WAVE_PANELS, MAX_WAVE_NUMBER)
            .map(|[s, weight]| [s, weight * substrate.compliance_excess(s, poisson_ratio)])
            .collect();
        let integral = |rho: f64| -> f64 {
            waves
                .iter()
                .map(|[s, weight]| weight * libm::j0(s * rho))
                .sum()
        };
        // Compute the integral on few long panels. From these follow short panels, which are cheap to evaluate and found by a
        // division.
        let panels = growing_panels([0.0, RIGID_BASE_INFLUENCE_RADIUS], integral);
        let value = |rho: f64| {
            let panel = panels.partition_point(|panel| panel.start <= rho);
            panels[panel.max(1) - 1].value(rho)
        };
        let starts = (0..)
            .map(|index| SHORT_PANEL_LENGTH * f64::from(index))
            .take_while(|start| *start < RIGID_BASE_INFLUENCE_RADIUS);
        Self {
            near: starts
                .map(|start| Panel::new(start, SHORT_PANEL_LENGTH, value))
                .collect(),
            far: far_panels(substrate, poisson_ratio),
            limit: substrate.compliance_excess(0.0, poisson_ratio),
        }
    }

    /// Value of the correction c(ρ) of the potential at a distance `rho` ≥ 0 in thicknesses, without unit.
    pub(super) fn value(&self, rho: f64) -> f64 {
        if let Some(panel) = self.near.get(whole_part(rho / SHORT_PANEL_LENGTH)) {
            return panel.value(rho);
        }
        let panel = self.far.partition_point(|panel| panel.start <= rho);
        let far_correction = match panel.checked_sub(1).map(|index| &self.far[index]) {
            Some(panel) if rho < TABLE_END => panel.value(rho),
            _ => 0.0,
        };
        rho.recip() * self.limit + far_correction
    }
}

/// Panels of c(ρ) − [M(0) − 1]/ρ beyond the influence radius of a rigid base; empty if the substrate has no larger influence radius.
fn far_panels(substrate: &dyn Substrate, poisson_ratio: f64) -> Vec<Panel<LONG_PANEL_TERMS>> {
    if substrate.influence_radius() <= RIGID_BASE_INFLUENCE_RADIUS {
        return Vec::new();
    }
    let limit = substrate.compliance_excess(0.0, poisson_ratio);
    // Hankel transform of the excess over its limit; a window suppresses the truncation at large u.
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

/// Points and weights [s, w] of a composite Lobatto rule on [0, `end`], with panels of equal length.
fn wave_rule(panels: u8, end: f64) -> impl Iterator<Item = [f64; 2]> {
    let LobattoRule { nodes, weights } = lobatto_rule(POINTS_PER_WAVE_PANEL);
    let half = 0.5 * end / f64::from(panels);
    (0..panels).flat_map(move |panel| {
        let middle = half * f64::from(2 * panel + 1);
        let rule = nodes.clone().into_iter().zip(weights.clone());
        rule.map(move |(t, weight)| [middle + half * t, half * weight])
    })
}

/// Consecutive panels of `function(ρ)` from `start` to at least `end`, whose lengths grow with the distance to the singularities of c.
fn growing_panels(
    [mut start, end]: [f64; 2],
    function: impl Fn(f64) -> f64,
) -> Vec<Panel<LONG_PANEL_TERMS>> {
    let mut panels = Vec::new();
    while start < end {
        let length = PANEL_OVER_SINGULARITY_DISTANCE * f64::hypot(start, SINGULARITY_DISTANCE);
        panels.push(Panel::new(start, length, &function));
        start += length;
    }
    panels
}

/// A polynomial on an interval of ρ.
#[derive(Debug)]
struct Panel<const N: usize> {
    /// Start of the interval, in thicknesses.
    start: f64,
    /// Factor 2/length from ρ to x; see `coefficients`.
    scale: f64,
    /// Coefficients of the powers of x, the distance from the middle in half lengths, in increasing order.
    coefficients: [f64; N],
}

impl<const N: usize> Panel<N> {
    /// The Chebyshev interpolant of a function on [start, start + length], converted to powers by the recurrence of Clenshaw (1955).
    fn new(start: f64, length: f64, function: impl Fn(f64) -> f64) -> Self {
        let angle = |index: usize| PI * (index as f64 + 0.5) / N as f64;
        let value = |index| function(start + 0.5 * length * (1.0 + angle(index).cos()));
        // Evaluate the function at the Chebyshev points, and compute its Chebyshev coefficients from these values.
        let values: [f64; N] = std::array::from_fn(value);
        let coefficient = |order: usize| {
            let terms = values
                .iter()
                .enumerate()
                .map(|(index, value)| value * (order as f64 * angle(index)).cos());
            terms.sum::<f64>() / N as f64
        };
        // Apply Clenshaw's recurrence b_k = c_k + 2 x b_(k+1) − b_(k+2) to polynomials instead of numbers, with the coefficients
        // c_k.
        let [mut last, mut coefficients] = [[0.0; N]; 2];
        for order in (0..N).rev() {
            let factor = if order == 0 { 1.0 } else { 2.0 };
            let next = std::array::from_fn(|power| match power {
                0 => factor * coefficient(order) - last[0],
                _ => factor * coefficients[power - 1] - last[power],
            });
            (last, coefficients) = (coefficients, next);
        }
        Self {
            start,
            scale: 2.0 / length,
            coefficients,
        }
    }

    /// Value at ρ, by Horner's rule.
    fn value(&self, rho: f64) -> f64 {
        let x = self.scale * (rho - self.start) - 1.0;
        let coefficients = self.coefficients.iter().rev();
        coefficients.fold(0.0, |sum, coefficient| sum * x + coefficient)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Layer with M − 1 = (A + B s) e^(−3s), whose potential is A/√(9 + ρ²) + 3 B/(9 + ρ²)^(3/2).
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
                let error = (table.value(rho) - exact).abs() / (a.abs() + b.abs());
                assert!(error < 2e-12, "c({rho}) of {a}, {b} is off by {error:e}");
            }
        }
    }
}
