//! Cusps, flat ends, bodies that are almost flat, and needles.

use anyhow::Result;
use bem_halfspace::steady::{FrictionOptions, steady_friction};
use friction_analytic::{
    FrictionError, StationarySliding, axisymmetric_sliding, half_space_power_friction,
    power_sliding,
};
use indenters::{
    Axisymmetric, EquivalentLine, FlatCone, Hyperboloid, PowerProfile, RoundTippedCone,
    SlidingLoad, Sphere, TruncatedParaboloid,
};
use mdr_core::{MdrError, SteadyOptions, steady};
use rheology::Viscous;

use crate::stability::case::{Family, Outcome, decades, refused};

pub(super) fn families() -> Vec<Family> {
    let mut families = theorems();
    families.extend(bodies_on_line());
    families.extend(on_half_space().map(Family::slow));
    families
}

fn theorems() -> Vec<Family> {
    vec![
        Family::over(
            ("quadrature beside closed form", "p"),
            [
                0.5001, 0.501, 0.51, 0.6, 0.8, 1.0, 1.5, 2.0, 4.0, 16.0, 64.0, 200.0, 1000.0,
            ],
            quadrature,
        ),
        Family::over(
            ("theorem, p → 1/2", "p − 1/2"),
            decades(-14, -1, 1),
            nearly_divergent,
        ),
    ]
}

fn bodies_on_line() -> [Family; 6] {
    let ratios = || decades(-12, 12, 1);
    [
        Family::over(("line, cone with round tip", "tip / m"), ratios(), |tip| {
            both(&RoundTippedCone::new(tip, 1.0)?)
        }),
        Family::over(
            ("line, sphere", "radius/depth"),
            decades(0, 12, 1),
            |radius| both(&Sphere::new(radius)?),
        ),
        Family::over(("line, hyperboloid", "radius/depth"), ratios(), |radius| {
            both(&Hyperboloid::new(radius, 1.0)?)
        }),
        Family::over(
            ("line, cone with flat end", "end / m"),
            decades(-12, 8, 1),
            |end| diverges(&FlatCone::new(end, 1.0)?),
        ),
        Family::over(
            ("line, worn paraboloid", "end / m"),
            decades(-12, 3, 1),
            |end| diverges(&TruncatedParaboloid::new(end, 1.0)?),
        ),
        Family::over(
            ("line, cone, any slope", "slope"),
            decades(-12, 12, 1),
            |slope| both(&PowerProfile::cone(slope)?),
        ),
    ]
}

fn on_half_space() -> [Family; 3] {
    [
        Family::over(
            ("half space, cone, any slope", "slope"),
            decades(-12, 12, 3),
            any_slope,
        ),
        Family::over(
            ("half space, cone with flat end", "end/contact"),
            decades(-12, -4, 1),
            flat_end,
        ),
        Family::over(
            ("half space, cone with round tip", "tip / m"),
            decades(-12, -3, 1).chain(decades(3, 12, 1)),
            round_tip,
        ),
    ]
}

fn load() -> Result<(Viscous, SlidingLoad)> {
    // The depth (12) is 1 m.
    Ok((Viscous::new(1.0)?, SlidingLoad::new(4.0, 1.0)?))
}

fn numbers(got: &StationarySliding, expected: &StationarySliding, tolerance: f64) -> Outcome {
    let pairs = [
        (
            "friction coefficient",
            [got.friction_coefficient, expected.friction_coefficient],
        ),
        (
            "contact length",
            [got.contact_length(), expected.contact_length()],
        ),
    ];
    Outcome::relative(&pairs, tolerance)
}

/// Eq. (16) by quadrature, which counts as known to ten digits.
fn quadrature(exponent: f64) -> Result<Outcome> {
    let (material, load) = load()?;
    let profile = PowerProfile::new(0.4, exponent)?;
    let got = axisymmetric_sliding(&profile, &material, &load)?;
    let expected = power_sliding(&profile, &material, &load)?;
    Ok(numbers(&got, &expected, 1e-10))
}

/// μ (2p − 1) has a limit: with p = 1/2 + ε it is p² d/x_d, and x_d moves with ε by a part of about 4 ε |ln(κ c)|.
fn nearly_divergent(excess: f64) -> Result<Outcome> {
    let (material, load) = load()?;
    let exponent = 0.5 + excess;
    let got = power_sliding(&PowerProfile::new(0.4, exponent)?, &material, &load)?;
    // ε as it is after rounding.
    let excess = exponent - 0.5;
    let expected = exponent * exponent / (2.0 * excess) / got.contact_length();
    let stretch = indenters::stretch(exponent)?;
    let contact = (1.0 / (0.4 * stretch)).powf(1.0 / exponent);
    let pairs = [
        ("friction coefficient", [got.friction_coefficient, expected]),
        ("contact length", [got.contact_length(), contact]),
    ];
    Ok(Outcome::relative(&pairs, 1e-13))
}

/// The stationary solver beside the quadrature of (16): two methods that share only the line itself.
fn both(body: &dyn Axisymmetric) -> Result<Outcome> {
    let (material, load) = load()?;
    let expected = axisymmetric_sliding(body, &material, &load)?;
    let options = SteadyOptions::default();
    let got = steady(&EquivalentLine(body), &material, &load, &options)?;
    let pairs = [
        (
            "friction coefficient",
            [got.friction_coefficient, expected.friction_coefficient],
        ),
        ("depth", [got.indentation_depth, expected.indentation_depth]),
    ];
    Ok(Outcome::relative(&pairs, options.relative_error))
}

/// A kink that rises has infinite friction on a dashpot, however small the flat end; both methods say so.
///
/// Around larger ends the contact is narrower than the rounding of its position.
fn diverges(body: &dyn Axisymmetric) -> Result<Outcome> {
    let (material, load) = load()?;
    let options = SteadyOptions::default();
    let by_line = steady(&EquivalentLine(body), &material, &load, &options);
    if let Err(MdrError::FrictionDiverges { .. }) = by_line {
        let theorem = axisymmetric_sliding(body, &material, &load);
        return Ok(refused!(theorem, FrictionError::FrictionDiverges { .. }));
    }
    Ok(refused!(by_line, MdrError::FrictionDiverges { .. }))
}

const ASKED: FrictionOptions = FrictionOptions {
    relative_error: 1e-2,
    aspect: 0.5,
    max_unknowns: 40_000,
};

/// Friction beside that of the power profile that the body becomes, from which its shape differs by `part`.
fn nearly_power(body: &impl Axisymmetric, profile: &PowerProfile, part: f64) -> Result<Outcome> {
    let (material, load) = load()?;
    let expected = half_space_power_friction(profile, &material, &load)?;
    let got = steady_friction(body, &material, &load, &ASKED)?;
    let pairs = [(
        "friction coefficient",
        [got.friction_coefficient, expected.value],
    )];
    let tolerance = ASKED.relative_error + expected.error / expected.value + part;
    Ok(Outcome::relative(&pairs, tolerance))
}

fn any_slope(slope: f64) -> Result<Outcome> {
    let cone = PowerProfile::cone(slope)?;
    nearly_power(&cone, &cone, 0.0)
}

/// Of the cone a part is missing that is as large as the end.
fn flat_end(end: f64) -> Result<Outcome> {
    nearly_power(
        &FlatCone::new(end, 1.0)?,
        &PowerProfile::cone(1.0)?,
        10.0 * end,
    )
}

/// A cone whose tip is much smaller than the contact, or a paraboloid whose cone begins far outside it.
fn round_tip(tip: f64) -> Result<Outcome> {
    let body = RoundTippedCone::new(tip, 1.0)?;
    if tip < 1.0 {
        return nearly_power(&body, &PowerProfile::cone(1.0)?, 10.0 * tip);
    }
    let paraboloid = PowerProfile::paraboloid(0.5 / tip)?;
    nearly_power(&body, &paraboloid, 0.0)
}
