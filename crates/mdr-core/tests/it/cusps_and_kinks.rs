//! Shapes at and near the border beyond which the friction on a lone dashpot has no limit (16).

use friction_analytic::power_sliding;
use indenters::{
    Axisymmetric, EquivalentLine, FlatCone, PowerProfile, RigidLine, RoundTippedCone, SlidingLoad,
    TruncatedParaboloid,
};
use mdr_core::{MdrError, SteadySliding, steady};
use rheology::{Elastic, StandardSolid, StandardSolidParameters, Viscous};

use crate::support::ASKED;

fn slid(body: &dyn Axisymmetric) -> Result<SteadySliding, MdrError> {
    let load = SlidingLoad::new(4.0, 1.0).expect("a load");
    let material = Viscous::new(1.0).expect("a material");
    steady(&EquivalentLine(body), &material, &load, ASKED)
}

#[test]
fn a_flat_end_of_any_size_has_no_finite_friction_on_a_dashpot() {
    for exponent in (-12..=3).step_by(3) {
        let radius = 10_f64.powi(exponent);
        let cone = FlatCone::new(radius, 1.0).expect("a body");
        let worn = TruncatedParaboloid::new(radius, 1.0).expect("a body");
        for body in [&cone as &dyn Axisymmetric, &worn] {
            let got = slid(body);
            assert!(
                matches!(got, Err(MdrError::FrictionDiverges { position }) if (position / radius - 1.0).abs() < 1e-12),
                "radius {radius}: expected FrictionDiverges at the kink, got {got:?}"
            );
        }
    }
}

/// The contact reaches beyond the kink by less than the rounding of its position.
#[test]
fn a_flat_end_much_larger_than_the_depth_has_none_either() {
    for radius in [1e4, 1e6, 1e7, 1e8] {
        let got = slid(&FlatCone::new(radius, 1.0).expect("a body"));
        assert!(
            matches!(got, Err(MdrError::FrictionDiverges { .. })),
            "radius {radius}: expected FrictionDiverges, got {got:?}"
        );
    }
}

/// The kink of the curvature is none of the slope, and a solid has finite friction on a flat end as well.
#[test]
fn kinks_that_do_no_harm_are_not_refused() {
    let tip = RoundTippedCone::new(0.1, 1.0).expect("a body");
    let got = slid(&tip);
    assert!(got.is_ok(), "expected friction, got {got:?}");
    let solid = StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus: 1.0,
        maxwell_modulus: 1.0,
        viscosity: 1.0,
    })
    .expect("a solid");
    let cone = FlatCone::new(0.1, 1.0).expect("a body");
    let load = SlidingLoad::new(4.0, 1.0).expect("a load");

    let got = steady(&EquivalentLine(&cone), &solid, &load, 1e-6);
    assert!(got.is_ok(), "expected friction, got {got:?}");
}

/// Near p = 1/2 most of the friction comes from a cusp that no polynomial resolves.
#[test]
fn the_error_of_sharp_cusps_stays_within_its_bar() {
    for exponent in [0.53, 0.54, 0.55, 0.57, 0.6, 0.65, 0.7, 0.8, 0.9] {
        let profile = PowerProfile::new(0.4, exponent).expect("a profile");
        let load = SlidingLoad::new(4.0, 1.0).expect("a load");
        let material = Viscous::new(1.0).expect("a material");
        let expected = power_sliding(&profile, &material, &load).expect("a closed form");
        match slid(&profile) {
            Ok(got) => {
                let deviation = got.friction_coefficient.value - expected.friction_coefficient;
                assert!(
                    deviation.abs() <= got.friction_coefficient.error,
                    "p = {exponent}: off by {deviation:e}, bar {:e}",
                    got.friction_coefficient.error
                );
            }
            // Documented for cusps that are too slow to be summed.
            Err(MdrError::FrictionDiverges { .. }) if exponent < 0.55 => {}
            Err(error) => panic!("p = {exponent}: {error}"),
        }
    }
}

/// Behind a flat end the line is as steep as an inverse root, so that the rounding of positions moves heights by more
/// than the tolerance: halving pieces there gains nothing, and must end.
///
/// Two hundred polynomials are 13 to an octave of the distance from the kink; the contact at the largest radius is so
/// flat that the rounding of its depth is above 1e-10.
#[test]
fn a_flat_end_on_a_solid_takes_few_polynomials_however_exact_it_is_wanted() {
    let solid = StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus: 1.0,
        maxwell_modulus: 1.0,
        viscosity: 1.0,
    })
    .expect("a solid");
    let load = SlidingLoad::new(4.0, 1.0).expect("a load");
    let slid = |body: &dyn Axisymmetric, relative_error: f64| {
        steady(&EquivalentLine(body), &solid, &load, relative_error)
    };
    for exponent in [-6, -3, -1, 0, 1] {
        let radius = 10_f64.powi(exponent);
        let cone = FlatCone::new(radius, 1.0).expect("a body");
        let worn = TruncatedParaboloid::new(radius, 1.0).expect("a body");
        for body in [&cone as &dyn Axisymmetric, &worn] {
            let exact = slid(body, 1e-9).expect("a state");
            for relative_error in [1e-6, 1e-9, 1e-11, 1e-12, 1e-13] {
                let got = match slid(body, relative_error) {
                    Err(MdrError::NotConverged { .. }) if relative_error < 1e-9 => continue,
                    got => got.expect("a state"),
                };
                let deviation =
                    (got.friction_coefficient.value - exact.friction_coefficient.value).abs();
                let bar = got.friction_coefficient.error + exact.friction_coefficient.error;
                assert!(
                    deviation <= bar && got.n_pieces < 200,
                    "radius {radius} to {relative_error:e}: off by {deviation:e} with a bar of {bar:e}, {} polynomials",
                    got.n_pieces
                );
            }
        }
    }
}

#[test]
fn a_flat_end_on_springs_has_no_friction_not_even_by_rounding() {
    let worn = TruncatedParaboloid::new(4.097_316_320_772_535, 0.119_169_830_372_470_1);
    let spring = Elastic::new(2.7).expect("a material");
    let load = SlidingLoad::new(0.3, 1.0).expect("a load");
    let worn = worn.expect("a body");
    let got = steady(&EquivalentLine(&worn), &spring, &load, ASKED);
    let friction = got.expect("a state").friction_coefficient.value;
    assert!(friction.abs() <= 0.0, "{friction:e} instead of 0");
}

/// A line with more waves than can be followed.
struct Corrugated;

impl RigidLine for Corrugated {
    fn height(&self, x: f64) -> f64 {
        0.5 * x * x - 0.1 * (1e6 * x).cos()
    }

    fn slope(&self, x: f64) -> f64 {
        x + 1e5 * (1e6 * x).sin()
    }

    fn domain(&self) -> [f64; 2] {
        [f64::NEG_INFINITY, f64::INFINITY]
    }
}

#[test]
fn a_line_with_too_much_detail_is_refused_with_where_and_how_many() {
    let load = SlidingLoad::new(4.0, 1.0).expect("a load");
    let material = Viscous::new(1.0).expect("a material");
    let got = steady(&Corrugated, &material, &load, ASKED);
    assert!(
        matches!(got, Err(MdrError::TooManyPieces { allowed, position, .. }) if allowed > 1000 && position.is_finite()),
        "expected TooManyPieces, got {got:?}"
    );
}
