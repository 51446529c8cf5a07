//! The friction to a requested error: its bar holds, and the march in time arrives at the same value.

use bem_halfspace::BemError;
use bem_halfspace::steady::{
    DepthControl, FrictionEstimate, FrictionOptions, Ladder, steady_friction,
    steady_friction_at_depth,
};
use friction_analytic::half_space_power_friction;
use indenters::PowerProfile;
use rheology::Elastic;

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

#[test]
fn a_body_too_steep_for_the_grids_allowed_is_refused_at_once() {
    let Scene {
        body,
        material,
        load,
    } = Scene::unit(1000.0);
    match steady_friction(&body, &material, &load, &FrictionOptions::default()) {
        Err(BemError::GridTooLarge { elements, limit }) => {
            assert!(elements > limit, "{elements} of {limit}");
        }
        other => panic!("{other:?} of a profile like a wall"),
    }
}

#[test]
fn a_steep_body_starts_on_a_grid_that_resolves_its_flank() {
    let scene = Scene::unit(32.0);
    let Err(BemError::FrictionNotReached {
        friction_coefficient,
        error,
        ..
    }) = steady_friction(
        &scene.body,
        &scene.material,
        &scene.load,
        &FrictionOptions {
            relative_error: 1e-6,
            aspect: 1.0,
            max_unknowns: 400,
        },
    )
    else {
        panic!("so few unknowns cannot reach 1e-6");
    };
    // The table was computed on grids more than ten times as fine.
    let expected = half_space_power_friction(&scene.body, &scene.material, &scene.load)
        .expect("an exponent of the table")
        .value;
    assert!(
        (friction_coefficient - expected).abs() <= error && error < 0.05 * expected,
        "{friction_coefficient} ± {error}, expected {expected}"
    );
}

/// Hertz: F = (16/3) G √R d^(3/2) on an incompressible half space, with R = 1/(2c).
#[test]
fn an_elastic_body_at_a_depth_carries_the_force_of_hertz() {
    for units in [1e-9, 1.0, 1e9] {
        let body = PowerProfile::paraboloid(0.5 / units).expect("a body");
        let material = Elastic::new(3.0).expect("a material");
        let depth = 0.01 * units;
        let control = DepthControl {
            depth,
            sliding_distance: 10.0 * units,
            velocity: 2.0 * units,
        };
        let ladder = Ladder::of_body_at_depth(&body, depth).expect("a ladder");
        let options = FrictionOptions {
            relative_error: 5e-3,
            ..FrictionOptions::default()
        };
        let estimate = steady_friction_at_depth(&body, (&material, &control), &ladder, &options)
            .expect("a force");
        let expected = 16.0 * units.sqrt() * depth.powf(1.5);
        let [force, error] = [estimate.normal_force, estimate.normal_force_error];
        assert!(
            (force - expected).abs() <= error && error <= 5e-3 * force,
            "{force} ± {error} instead of {expected} in units of {units:e} m"
        );
        let [friction, error] = [estimate.friction_coefficient, estimate.error];
        assert!(
            friction.abs() <= error && error < 1e-8,
            "{friction} ± {error} without dissipation"
        );
    }
}

#[test]
fn the_friction_at_a_depth_is_that_under_its_force() {
    let scene = Scene::unit(2.0);
    let options = FrictionOptions {
        relative_error: 1e-3,
        ..FrictionOptions::default()
    };
    let pressed = friction(&scene, 1e-3);
    let sliding_distance = 1e3 * scene.contact_length();
    let control = DepthControl {
        depth: pressed.depth.after(sliding_distance).expect("a depth"),
        sliding_distance,
        velocity: scene.load.velocity(),
    };
    let ladder = Ladder::of_body_at_depth(&scene.body, control.depth).expect("a ladder");
    let (body, material) = (&scene.body, &scene.material);
    let held = steady_friction_at_depth(body, (material, &control), &ladder, &options)
        .expect("a force and a friction coefficient");
    // The depth is that of the last grid; it is about as exact as its friction.
    let expected = scene.load.normal_force().expect("a force");
    let allowed = held.normal_force_error + 2e-3 * expected;
    assert!(
        (held.normal_force - expected).abs() <= allowed,
        "{} ± {allowed} instead of {expected}",
        held.normal_force
    );
    let deviation = (held.friction_coefficient - pressed.friction_coefficient).abs();
    let allowed = held.error + pressed.error + 1e-3 * pressed.friction_coefficient;
    assert!(deviation <= allowed, "{held:?} and {pressed:?}");
}

#[test]
fn a_force_out_of_reach_says_what_was_reached() {
    let body = PowerProfile::paraboloid(0.5).expect("a body");
    let material = Elastic::new(3.0).expect("a material");
    let control = DepthControl {
        depth: 0.01,
        sliding_distance: 10.0,
        velocity: 1.0,
    };
    let ladder = Ladder::of_body_at_depth(&body, control.depth).expect("a ladder");
    let options = FrictionOptions {
        relative_error: 1e-6,
        max_unknowns: 400,
        ..FrictionOptions::default()
    };
    match steady_friction_at_depth(&body, (&material, &control), &ladder, &options) {
        Err(BemError::ForceNotReached {
            normal_force,
            error,
            ..
        }) => assert!(
            (normal_force - 0.016).abs() <= error,
            "{normal_force} ± {error} instead of 0.016"
        ),
        other => panic!("{other:?} of so few unknowns"),
    }
}

#[test]
fn depths_without_a_ladder_are_refused() {
    let body = PowerProfile::paraboloid(0.5).expect("a body");
    for depth in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let ladder = Ladder::of_body_at_depth(&body, depth);
        assert!(
            matches!(ladder, Err(BemError::InvalidParameter { .. })),
            "depth {depth}: {ladder:?}"
        );
    }
}
