//! Scaling factor s(p): ratio of the friction of the viscous half space to that of the one-dimensional model.
//!
//! For a power profile h = c r^p it depends neither on force, speed and viscosity nor on c. Kürschner (2014, Sect. 5) gives
//! s(1) ≈ 0.55 and s(2) ≈ 0.67 and leaves the function open. Here it is interpolated in a table of converged values with
//! error bars, computed with boundary elements: docs/theory/stationary-half-space.md, "The function s(p)".

use std::sync::LazyLock;

use indenters::{PowerProfile, SlidingLoad};
use numerics::{Estimate, in_range};
use rheology::Viscous;

use crate::{FrictionError, power_sliding};

/// Exponents p, increasing, and scaling factors s(p) with their errors, as `cargo xtask scaling-table` writes them.
static TABLE: LazyLock<Vec<(f64, Estimate)>> = LazyLock::new(|| {
    let rows = include_str!("scaling_table.csv").lines();
    // The heading has no numbers and is skipped; a test counts the other rows.
    rows.filter_map(|row| {
        let mut cells = row.split(',').map_while(|cell| cell.parse().ok());
        Some((cells.next()?, Estimate::new(cells.next()?, cells.next()?)))
    })
    .collect()
});

/// Number of nodes of one interpolating polynomial of the fifth degree, whose error is below that of the nodes. Chosen; the test
/// `the_nodes_are_dense_enough` predicts every other node from the rest.
const STENCIL_NODES: usize = 6;

/// Scaling factor s(p) of the profile c r^p: ratio of the friction of the viscous half space to that of the one-dimensional
/// model.
///
/// It is a polynomial of the fifth degree in ln(2p − 1) through the nearest nodes of a table. Its error is that of the nodes
/// with their weights: at most about 1e-3 of the value for cusps with p < 0.65, and about 1e-4 for the others.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] for exponents outside the table, from 0.501 to 64. At p = 1/2 the
/// friction of either model is infinite, and their ratio is finite.
pub fn scaling_factor(exponent: f64) -> Result<Estimate, FrictionError> {
    let [first, last] = [TABLE[0].0, TABLE[TABLE.len() - 1].0];
    let is_allowed = (first..=last).contains(&exponent);
    let allowed = "between 0.501 and 64, where s(p) was computed";
    in_range("exponent", exponent, is_allowed, allowed)?;
    let above = TABLE.partition_point(|(node, _)| *node < exponent);
    let start = above
        .saturating_sub(STENCIL_NODES / 2)
        .min(TABLE.len() - STENCIL_NODES);
    Ok(interpolate(&TABLE[start..start + STENCIL_NODES], exponent))
}

/// Friction coefficient of a power profile on a viscous half space: s(p) times that of the one-dimensional model.
///
/// # Errors
/// Those of [`power_sliding`] and [`scaling_factor`].
pub fn half_space_power_friction(
    profile: &PowerProfile,
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<Estimate, FrictionError> {
    let line = power_sliding(profile, material, load)?;
    let factor = scaling_factor(profile.exponent())?;
    let friction = factor * line.friction_coefficient;
    Ok(friction.widened(factor.value * line.error))
}

/// Lagrange's interpolation polynomial in ln(2p − 1) through the nodes.
fn interpolate(nodes: &[(f64, Estimate)], exponent: f64) -> Estimate {
    let abscissa = |exponent: f64| (2.0 * exponent - 1.0).ln();
    let x = abscissa(exponent);
    let term = |(index, &(node, factor)): (usize, &(f64, Estimate))| {
        let other_nodes = nodes[..index].iter().chain(&nodes[index + 1..]);
        let ratios = other_nodes
            .map(|(other, _)| (x - abscissa(*other)) / (abscissa(node) - abscissa(*other)));
        factor * ratios.product::<f64>()
    };
    nodes.iter().enumerate().map(term).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half the nodes interpolate with about 2⁶ times the error, which is still within the error bars.
    #[test]
    fn the_nodes_are_dense_enough() {
        let every_other: Vec<(f64, Estimate)> = TABLE.iter().copied().step_by(2).collect();
        for window in 0..=every_other.len() - STENCIL_NODES {
            let (exponent, factor) = TABLE[2 * window + STENCIL_NODES - 1];
            let interpolated = interpolate(&every_other[window..window + STENCIL_NODES], exponent);
            let deviation = (interpolated.value - factor.value).abs();
            assert!(
                deviation < interpolated.error + factor.error,
                "p = {exponent}: {interpolated:?} instead of {factor}"
            );
        }
    }

    #[test]
    fn every_node_is_as_exact_as_promised() {
        let n_rows = include_str!("scaling_table.csv").lines().skip(1).count();
        assert_eq!(TABLE.len(), n_rows, "a row without three numbers");
        for (exponent, factor) in TABLE.iter() {
            let allowed = match exponent {
                ..0.65 => 1e-3,
                ..10.0 => 1e-4,
                _ => 5e-4,
            };
            assert!(
                factor.error < allowed * factor.value,
                "p = {exponent}: {factor}, allowed {allowed}"
            );
        }
    }

    #[test]
    fn nodes_are_reproduced_and_nothing_is_extrapolated() {
        for (exponent, factor) in TABLE.iter() {
            let found = scaling_factor(*exponent).unwrap();
            assert_eq!(found, *factor, "p = {exponent}");
        }
        casebook::refuses("exponent", &[0.5, 64.1, f64::NAN], scaling_factor);
    }
}
