//! Cusps, flat ends, bodies that are almost flat, and needles.

use anyhow::Result;
use bem_halfspace::steady::{RefinementOptions, steady_refined};
use friction_analytic::{
    FrictionError, axisymmetric_sliding, half_space_power_friction, power_sliding,
};
use indenters::{
    Axisymmetric, EquivalentLine, FlatCone, Hyperboloid, PowerProfile, RoundTippedCone,
    SlidingLoad, Sphere, Surface, TruncatedParaboloid,
};
use mdr_core::{MdrError, steady};
use rheology::Viscous;

use super::case::{Family, Finding, compare, decades, families, refused};

const EXPONENTS: [f64; 13] = [
    0.5001, 0.501, 0.51, 0.6, 0.8, 1.0, 1.5, 2.0, 4.0, 16.0, 64.0, 200.0, 1000.0,
];

pub(super) fn families() -> Vec<Family> {
    let ratios = || decades(-12, 12, 1);
    let tips = || decades(-12, -3, 1).chain(decades(3, 12, 1));
    let mut families = families! {
        "quadrature beside closed form", "p", EXPONENTS => quadrature;
        "theorem, p → 1/2", "p − 1/2", decades(-14, -1, 1) => nearly_divergent;
        "line, cone with round tip", "tip / m", ratios() => |tip| both(&RoundTippedCone::new(tip, 1.0)?);
        "line, sphere", "radius/depth", decades(0, 12, 1) => |radius| both(&Sphere::new(radius)?);
        "line, hyperboloid", "radius/depth", ratios() => |radius| both(&Hyperboloid::new(radius, 1.0)?);
        "line, cone with flat end", "end / m", decades(-12, 8, 1) => |end| diverges(&FlatCone::new(end, 1.0)?);
        "line, worn paraboloid", "end / m", decades(-12, 3, 1) => |end| diverges(&TruncatedParaboloid::new(end, 1.0)?);
        "line, cone, any slope", "slope", ratios() => |slope| both(&PowerProfile::cone(slope)?);
    };
    let half_space = families! {
        "half space, cone, any slope", "slope", decades(-12, 12, 3) => any_slope;
        "half space, cone with flat end", "end/contact", decades(-12, -4, 1) => flat_end;
        "half space, cone with round tip", "tip / m", tips() => round_tip;
    };
    families.extend(half_space.into_iter().map(Family::slow));
    families
}

fn load() -> Result<(Viscous, SlidingLoad)> {
    // The depth (12) is 1 m.
    Ok((Viscous::new(1.0)?, SlidingLoad::new(4.0, 1.0)?))
}

/// Eq. (16) by quadrature, which is known to ten digits.
fn quadrature(exponent: f64) -> Result<Finding> {
    let (material, load) = load()?;
    let profile = PowerProfile::new(0.4, exponent)?;
    let got = axisymmetric_sliding(&profile, &material, &load)?;
    let expected = power_sliding(&profile, &material, &load)?;
    compare!(within 1e-10;
        "friction coefficient" => got.friction_coefficient, expected.friction_coefficient;
        "contact length" => got.contact_length(), expected.contact_length())
}

/// μ (2p − 1) has a limit: with p = 1/2 + ε it is p² d/x_d, and x_d moves with ε by a part of about 4 ε |ln(κ c)|.
fn nearly_divergent(excess: f64) -> Result<Finding> {
    let (material, load) = load()?;
    let exponent = 0.5 + excess;
    let got = power_sliding(&PowerProfile::new(0.4, exponent)?, &material, &load)?;
    // ε as it is after rounding.
    let excess = exponent - 0.5;
    let friction = exponent * exponent / (2.0 * excess) / got.contact_length();
    let length = (1.0 / (0.4 * indenters::stretch(exponent)?)).powf(1.0 / exponent);
    compare!(within 1e-13;
        "friction coefficient" => got.friction_coefficient, friction;
        "contact length" => got.contact_length(), length)
}

/// The stationary solver beside the quadrature of (16): two methods that share only the line itself.
fn both(body: &dyn Axisymmetric) -> Result<Finding> {
    let (material, load) = load()?;
    let expected = axisymmetric_sliding(body, &material, &load)?;
    let got = steady(&EquivalentLine(body), &material, &load, 1e-8)?;
    compare!(within 1e-8;
        "friction coefficient" => got.friction_coefficient.value, expected.friction_coefficient;
        "depth" => got.indentation_depth.value, expected.indentation_depth)
}

/// A kink that rises has infinite friction on a dashpot, however small the flat end; both methods say so.
///
/// Around larger ends the contact is narrower than the rounding of its position.
fn diverges(body: &dyn Axisymmetric) -> Result<Finding> {
    let (material, load) = load()?;
    let by_line = steady(&EquivalentLine(body), &material, &load, 1e-8);
    if let Err(MdrError::FrictionDiverges { .. }) = by_line {
        let theorem = axisymmetric_sliding(body, &material, &load);
        return refused!(theorem => FrictionError::FrictionDiverges { .. });
    }
    refused!(by_line => MdrError::FrictionDiverges { .. })
}

const ASKED: RefinementOptions = RefinementOptions {
    relative_error: 1e-2,
    aspect: 0.5,
    max_unknowns: 40_000,
};

/// Friction beside that of the power profile that the body becomes, from which its shape differs by `part`.
fn nearly_power(
    body: &(impl Axisymmetric + Surface),
    profile: &PowerProfile,
    part: f64,
) -> Result<Finding> {
    let (material, load) = load()?;
    let expected = half_space_power_friction(profile, &material, &load)?;
    let got = steady_refined(body, &material, &load, &ASKED)?;
    let tolerance = ASKED.relative_error + expected.error / expected.value + part;
    compare!(within tolerance; "friction coefficient" => got.friction_coefficient.value, expected.value)
}

fn any_slope(slope: f64) -> Result<Finding> {
    let cone = PowerProfile::cone(slope)?;
    nearly_power(&cone, &cone, 0.0)
}

/// Of the cone a part is missing that is as large as the end.
fn flat_end(end: f64) -> Result<Finding> {
    nearly_power(
        &FlatCone::new(end, 1.0)?,
        &PowerProfile::cone(1.0)?,
        10.0 * end,
    )
}

/// A cone whose tip is much smaller than the contact, or a paraboloid whose cone begins far outside it.
fn round_tip(tip: f64) -> Result<Finding> {
    let body = RoundTippedCone::new(tip, 1.0)?;
    if tip < 1.0 {
        return nearly_power(&body, &PowerProfile::cone(1.0)?, 10.0 * tip);
    }
    nearly_power(&body, &PowerProfile::paraboloid(0.5 / tip)?, 0.0)
}
