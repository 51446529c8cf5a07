//! The function s(p): what the half space does to the friction of the one-dimensional model.
//!
//! For a power profile h = c r^p the friction of the viscous half space is a fraction s(p) of that of the
//! one-dimensional model, whatever force, speed, viscosity and coefficient are. Kürschner (2014, Sect. 5) gives
//! s(1) ≈ 0.55 and s(2) ≈ 0.67 and leaves the function open. Here it is a table of converged values with error bars,
//! computed with boundary elements, and interpolated.

use std::sync::LazyLock;

use indenters::{PowerProfile, SlidingLoad};
use numerics::{Estimate, in_range};
use rheology::Viscous;

use crate::{FrictionError, power_sliding};

/// Exponent p, scaling factor s(p), absolute error, as `cargo xtask scaling-table` writes them.
static NODES: LazyLock<Vec<[f64; 3]>> = LazyLock::new(|| {
    let rows = include_str!("scaling_table.csv").lines().skip(1);
    let number = |cell: Option<&str>| cell.and_then(|cell| cell.parse().ok());
    rows.map(|row| {
        let mut cells = row.split(',');
        [(); 3].map(|()| number(cells.next()).expect("three numbers"))
    })
    .collect()
});

/// Nodes of one interpolating polynomial.
const STENCIL: usize = 6;

/// The scaling factor s(p) of the profile c r^p between half space and one-dimensional model.
///
/// A polynomial of the fifth degree in ln(2p − 1) through the nearest nodes of a table. Its error is that of the nodes,
/// weighted as they enter: at most about 1e-3 of the value for cusps with p < 0.65, and about 1e-4 for the others.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] for exponents outside the table, from 0.501 to 64. At p = 1/2 both frictions
/// diverge; their ratio does not.
pub fn scaling_factor(exponent: f64) -> Result<Estimate, FrictionError> {
    let [first, last] = [NODES[0][0], NODES[NODES.len() - 1][0]];
    let holds = (first..=last).contains(&exponent);
    let allowed = "between 0.501 and 64, where s(p) was computed";
    in_range("exponent", exponent, holds, allowed)?;
    let above = NODES.partition_point(|[node, ..]| *node < exponent);
    let start = above.saturating_sub(STENCIL / 2).min(NODES.len() - STENCIL);
    Ok(interpolate(&NODES[start..start + STENCIL], exponent))
}

/// Coefficient of friction of a power profile on a viscous half space: s(p) times that of the one-dimensional model.
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

/// Lagrange's polynomial in ln(2p − 1) through the nodes.
fn interpolate(nodes: &[[f64; 3]], exponent: f64) -> Estimate {
    let place = |exponent: f64| (2.0 * exponent - 1.0).ln();
    let at = place(exponent);
    let term = |(index, &[node, value, error]): (usize, &[f64; 3])| {
        let others = nodes[..index].iter().chain(&nodes[index + 1..]);
        let factors =
            others.map(|[other, ..]| (at - place(*other)) / (place(node) - place(*other)));
        Estimate::new(value, error) * factors.product::<f64>()
    };
    nodes.iter().enumerate().map(term).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice as far apart as they are, the nodes would interpolate with sixty-four times the error; even that stays
    /// within the bars.
    #[test]
    fn the_nodes_are_dense_enough() {
        let every_other: Vec<[f64; 3]> = NODES.iter().copied().step_by(2).collect();
        for window in 0..=every_other.len() - STENCIL {
            let [exponent, value, error] = NODES[2 * window + STENCIL - 1];
            let interpolated = interpolate(&every_other[window..window + STENCIL], exponent);
            let deviation = (interpolated.value - value).abs();
            assert!(
                deviation < interpolated.error + error,
                "p = {exponent}: {interpolated:?} instead of {value} ± {error}"
            );
        }
    }

    #[test]
    fn every_node_is_as_exact_as_promised() {
        for &[exponent, value, error] in NODES.iter() {
            let allowed = match exponent {
                ..0.65 => 1e-3,
                ..10.0 => 1e-4,
                _ => 5e-4,
            };
            assert!(
                error < allowed * value,
                "p = {exponent}: {value} ± {error}, allowed {allowed}"
            );
        }
    }

    #[test]
    fn the_table_is_given_back_and_not_continued() {
        for &[exponent, value, error] in NODES.iter() {
            let found = scaling_factor(exponent).unwrap();
            assert_eq!(found, Estimate::new(value, error), "p = {exponent}");
        }
        casebook::refuses("exponent", &[0.5, 64.1, f64::NAN], scaling_factor);
    }
}
