//! The friction to a requested error: its bar holds, and the march in time arrives at the same value.

use bem_halfspace::BemError;
use bem_halfspace::steady::{FrictionEstimate, FrictionOptions, steady_friction};
use indenters::{PowerProfile, SlidingLoad};
use rheology::Viscous;

use crate::support::Scene;

fn friction(scene: &Scene, relative_error: f64) -> FrictionEstimate {
    let options = FrictionOptions {
        relative_error,
        ..FrictionOptions::default()
    };
    steady_friction(&scene.body, &scene.material, &scene.load, &options)
        .expect("a friction coefficient")
}

#[test]
fn error_bars_hold_against_finer_solutions() {
    for (exponent, coarse, fine) in [
        (1.0, 1e-3, 1e-4),
        (1.5, 1e-3, 5e-5),
        (2.0, 1e-3, 8e-5),
        (3.0, 4e-3, 1e-3),
    ] {
        let scene = Scene::unit(exponent);
        let [coarse, fine] = [coarse, fine].map(|error| friction(&scene, error));
        let deviation = (coarse.friction_coefficient - fine.friction_coefficient).abs();
        assert!(
            deviation <= coarse.error + fine.error,
            "p = {exponent}: {coarse:?} and {fine:?}"
        );
        assert!(
            fine.refinements.len() > coarse.refinements.len(),
            "p = {exponent}: nothing was refined"
        );
    }
}

#[test]
fn the_march_in_time_arrives_at_the_stationary_solution() {
    for exponent in [1.0, 2.0] {
        let scene = Scene::unit(exponent);
        let direct = friction(&scene, 1e-3);
        let march = scene
            .slide(12.0, 32.0)
            .stationary(0.02)
            .expect("a stationary state");
        let deviation = (march.friction_coefficient - direct.friction_coefficient).abs();
        // The march adds the error of one grid of twelve elements, less than 1e-3 of the friction coefficient.
        let allowed = direct.error + march.distance_error + 1e-3 * direct.friction_coefficient;
        assert!(
            deviation <= allowed,
            "p = {exponent}: {march:?} and {direct:?}"
        );
    }
}

#[test]
fn an_error_out_of_reach_says_what_was_reached() {
    let Scene {
        body,
        material,
        load,
    } = Scene::unit(0.6);
    let options = FrictionOptions {
        relative_error: 1e-3,
        max_unknowns: 150,
        ..FrictionOptions::default()
    };
    match steady_friction(&body, &material, &load, &options) {
        Err(BemError::FrictionNotReached {
            friction_coefficient,
            error,
            relative_error,
        }) => {
            assert!(
                friction_coefficient.is_finite() && error > relative_error * friction_coefficient,
                "{error}"
            );
        }
        other => panic!("{other:?} of a cusp next to p = 1/2"),
    }
}

/// At its rim r^1000 rises within a thousandth of its radius; grids that resolve it are far larger than allowed, and none
/// of them is tried.
#[test]
fn a_body_too_steep_for_the_unknowns_allowed_is_refused() {
    let body = PowerProfile::new(0.4, 1000.0).expect("a body");
    let (material, load) = (
        Viscous::new(50.0).expect("a material"),
        SlidingLoad::new(2.0, 0.1).expect("a load"),
    );
    let options = FrictionOptions {
        max_unknowns: 500,
        ..FrictionOptions::default()
    };
    let got = steady_friction(&body, &material, &load, &options);
    assert!(
        matches!(got, Err(BemError::SlopeNotResolved { .. })),
        "expected SlopeNotResolved, got {got:?}"
    );
}
