//! The friction to a requested error: its bar holds, and the march in time arrives at the same value.

use bem_halfspace::steady::{RefinementOptions, SteadyEstimate, steady, steady_refined};
use bem_halfspace::{BemError, SlidingLoad};
use friction_analytic::half_space_power_friction;
use indenters::PowerProfile;
use numerics::Estimate;
use rheology::Elastic;

use crate::support::Scene;

fn solve(scene: &Scene, relative_error: f64) -> SteadyEstimate {
    steady(&scene.body, &scene.material, &scene.load, relative_error)
        .expect("a friction coefficient")
}

/// Whether two bars overlap.
fn agree(one: Estimate, other: Estimate) -> bool {
    (one.value - other.value).abs() <= one.error + other.error
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
        let [coarse, fine] = [coarse, fine].map(|error| solve(&scene, error));
        for (name, coarse, fine) in [
            ("μ", coarse.friction_coefficient, fine.friction_coefficient),
            ("area", coarse.contact_area, fine.contact_area),
        ] {
            assert!(
                agree(coarse, fine),
                "p = {exponent}: {name} {coarse:?} and {fine:?}"
            );
        }
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
        let direct = solve(&scene, 1e-3).friction_coefficient;
        let march = scene
            .slide(12.0, 32.0)
            .stationary(0.02)
            .expect("a stationary state");
        let deviation = (march.friction_coefficient - direct.value).abs();
        // The march adds the error of one grid of twelve elements, less than 1e-3 of the friction coefficient.
        let allowed = direct.error + march.distance_error + 1e-3 * direct.value;
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
    let options = RefinementOptions {
        max_unknowns: 150,
        ..RefinementOptions::default()
    };
    match steady_refined(&body, &material, &load, &options) {
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
    match steady(&body, &material, &load, 1e-3) {
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
    }) = steady_refined(
        &scene.body,
        &scene.material,
        &scene.load,
        &RefinementOptions {
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

/// Hertz: F = (16/3) G √R d^(3/2) on an incompressible half space, with R = 1/(2c), and the area π R d.
#[test]
fn an_elastic_body_at_a_depth_carries_the_force_of_hertz() {
    for units in [1e-9, 1.0, 1e9] {
        let body = PowerProfile::paraboloid(0.5 / units).expect("a body");
        let material = Elastic::new(3.0).expect("a material");
        let depth = 0.01 * units;
        let load = SlidingLoad::at_depth(depth, 2.0 * units).expect("a load");
        let estimate = steady(&body, &material, &load, 5e-3).expect("a force");
        let expected = 16.0 * units.sqrt() * depth.powf(1.5);
        let Estimate { value, error } = estimate.normal_force;
        assert!(
            (value - expected).abs() <= error && error <= 5e-3 * value,
            "{value} ± {error} instead of {expected} in units of {units:e} m"
        );
        let Estimate { value, error } = estimate.friction_coefficient;
        assert!(
            value.abs() <= error && error < 1e-8,
            "{value} ± {error} without dissipation"
        );
    }
}

#[test]
fn the_friction_at_a_depth_is_that_under_its_force() {
    let scene = Scene::unit(2.0);
    let after = |load: SlidingLoad| {
        load.after(1e3 * scene.contact_length())
            .expect("a distance")
    };
    let (body, material) = (&scene.body, &scene.material);
    let pressed = steady(body, material, &after(scene.load), 1e-3).expect("a friction coefficient");
    let depth = pressed.indentation_depth.expect("a depth after a distance");
    let load = SlidingLoad::at_depth(depth.value, scene.load.velocity()).expect("a load");
    let held = steady(body, material, &after(load), 1e-3).expect("a force");
    let expected = scene.load.require_normal_force().expect("a force");
    // The force follows the depth with a power between 1 and 2.
    let allowed = held.normal_force.error + 2.0 * depth.error / depth.value * expected;
    assert!(
        (held.normal_force.value - expected).abs() <= allowed,
        "{} ± {allowed} instead of {expected}",
        held.normal_force.value
    );
    let [held, pressed] = [held, pressed].map(|estimate| estimate.friction_coefficient);
    let deviation = (held.value - pressed.value).abs();
    let allowed = held.error + pressed.error + 1e-3 * pressed.value;
    assert!(deviation <= allowed, "{held:?} and {pressed:?}");
}

#[test]
fn a_force_out_of_reach_says_what_was_reached() {
    let body = PowerProfile::paraboloid(0.5).expect("a body");
    let material = Elastic::new(3.0).expect("a material");
    let load = SlidingLoad::at_depth(0.01, 1.0).expect("a load");
    let options = RefinementOptions {
        relative_error: 1e-6,
        max_unknowns: 400,
        ..RefinementOptions::default()
    };
    match steady_refined(&body, &material, &load, &options) {
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
fn a_depth_without_a_distance_is_refused_where_the_body_sinks() {
    let Scene { body, material, .. } = Scene::unit(2.0);
    let load = SlidingLoad::at_depth(0.1, 1.0).expect("a load");
    let refused = steady(&body, &material, &load, 1e-3).err();
    assert!(
        matches!(refused, Some(BemError::SlidingDistanceMissing { .. })),
        "{refused:?}"
    );
}
