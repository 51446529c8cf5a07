//! The stationary state to a requested error: every bar holds, at a force and at a depth, and what is out of reach says
//! what was reached.

use bem_halfspace::steady::{RefinementOptions, SteadyEstimate, steady_refined};
use bem_halfspace::{BemError, Control};
use friction_analytic::{half_space_power_friction, impulse_to_depth};
use numerics::{Accuracy, Estimate};
use rheology::Material;

use crate::support::{
    Scene, after, assert_bar, assert_bars_agree, assert_ends, assert_near, at_depth, elastic,
    paraboloid, power, prony, under_force, viscous,
};

/// Compares every quantity and the ends of the contact of two states within their bars.
fn compare(what: (f64, Accuracy), coarse: &SteadyEstimate, fine: &SteadyEstimate) {
    let quantities = |state: &SteadyEstimate| {
        [
            ("friction", Some(state.friction_coefficient)),
            ("area", Some(state.contact_area)),
            ("depth", state.indentation_depth),
            ("peak pressure", state.peak_pressure),
        ]
    };
    for ((name, one), (_, other)) in quantities(coarse).into_iter().zip(quantities(fine)) {
        assert_eq!(one.is_some(), other.is_some(), "{what:?}: {name}");
        if let Some((one, other)) = one.zip(other) {
            assert_bars_agree((what, name), one, other);
        }
    }
    let ends = |state: &SteadyEstimate| [state.finest.contact_x, state.finest.contact_y];
    let allowed = coarse.contact_box_error + fine.contact_box_error;
    assert_ends(what, ends(coarse), ends(fine), allowed);
}

#[test]
fn error_bars_hold_against_finer_solutions() {
    let solid = prony([0.5, 0.0], &[(3.0, 0.4), (1.0, 2.0)]);
    let given = [Accuracy::Elements(12), Accuracy::Elements(30), 1e-2.into()];
    let table: [(f64, f64, f64); 4] = [
        (1.0, 1e-3, 1e-4),
        (1.5, 1e-3, 5e-5),
        (2.0, 1e-3, 8e-5),
        (3.0, 4e-3, 1e-3),
    ];
    for (exponent, coarse, fine) in table {
        let dashpot = Scene::unit(exponent);
        let [coarse_state, fine_state] = [coarse, fine].map(|error| dashpot.steady(error));
        compare((exponent, coarse.into()), &coarse_state, &fine_state);
        assert!(
            fine_state.refinements.len() > coarse_state.refinements.len(),
            "p = {exponent}: nothing was refined"
        );
        let solid = Scene::new(dashpot.body, &solid, dashpot.load);
        let fine_state = solid.steady(5e-4);
        for accuracy in given {
            compare((exponent, accuracy), &solid.steady(accuracy), &fine_state);
        }
    }
}

/// The depth is that of the one-dimensional model, which is exact here: the force is the impulse on a dashpot.
#[test]
fn an_elastic_body_slides_without_friction_at_its_exact_depth() {
    for exponent in [1.0, 2.0, 3.0] {
        let (body, depth) = (power(0.3, exponent), 0.2);
        let force = impulse_to_depth(&body, &viscous(2.0), depth).expect("a force");
        let estimate = Scene::new(body, elastic(2.0), under_force(force, 0.7)).steady(1e-3);
        let friction = estimate.friction_coefficient;
        assert_near(exponent, friction.value, 0.0, friction.error);
        assert_near(exponent, friction.error, 0.0, 1e-8);
        let got = estimate.indentation_depth.expect("a depth");
        assert_near(exponent, got.value, depth, got.error.min(1e-3 * depth));
    }
}

#[test]
fn force_and_depth_control_agree_on_one_grid() {
    let (solid, fluid) = (
        prony([0.1, 0.0], &[(1.0, 1.0)]),
        prony([0.0, 0.0], &[(1.0, 1.0)]),
    );
    for material in [&solid, &fluid] {
        let by_force = Scene::new(paraboloid(1.0), material, under_force(1.0, 0.5));
        let options = by_force.steady_options(8.0);
        let expected = by_force.steady_on(&options);
        let depth = expected.depth.after(1e3).expect("a depth");
        let load = after(at_depth(depth, 0.5), 1e3);
        let actual = Scene { load, ..by_force }.steady_on(&options);
        assert_near(material, actual.normal_force, 1.0, 1e-8);
        let ratio = actual.friction_coefficient / expected.friction_coefficient;
        assert_near(material, ratio, 1.0, 1e-8);
    }
}

#[test]
fn the_friction_at_a_depth_is_that_under_its_force() {
    let scene = Scene::unit(2.0);
    let load = scene.load_over(1e3);
    let pressed = Scene { load, ..scene }.steady(1e-3);
    let depth = pressed.indentation_depth.expect("a depth after a distance");
    let held = at_depth(depth.value, load.velocity());
    let load = after(held, 1e3 * scene.contact_length());
    let held = Scene { load, ..scene }.steady(1e-3);
    // The force follows the depth with a power between 1 and 2.
    let allowed = held.normal_force.error + 2.0 * depth.error / depth.value * 0.5;
    assert_near("force", held.normal_force.value, 0.5, allowed);
    let [held, pressed] = [held, pressed].map(|estimate| estimate.friction_coefficient);
    let allowed = held.error + pressed.error + 1e-3 * pressed.value;
    assert_near("friction", held.value, pressed.value, allowed);
}

/// Refuses to refine beyond some unknowns, and returns what was reached.
fn reached(scene: &Scene<impl Material>, relative_error: f64, max_unknowns: usize) -> Estimate {
    let options = RefinementOptions {
        relative_error,
        max_unknowns,
        aspect: if relative_error < 1e-5 {
            1.0
        } else {
            RefinementOptions::default().aspect
        },
    };
    let result = steady_refined(&scene.body, &scene.material, &scene.load, &options);
    let Err(BemError::NotReached {
        quantity,
        value,
        error,
        ..
    }) = result
    else {
        panic!("{result:?} with {max_unknowns} unknowns");
    };
    let at_depth = matches!(scene.load.control(), Control::IndentationDepth(_));
    assert_eq!(
        quantity == "normal force [N]",
        at_depth,
        "what was not reached"
    );
    assert!(error > relative_error * value, "{value} ± {error}");
    Estimate { value, error }
}

#[test]
fn an_error_out_of_reach_says_what_was_reached() {
    let cusp = reached(
        &Scene::unit(0.6),
        RefinementOptions::default().relative_error,
        150,
    );
    assert!(cusp.value.is_finite(), "{cusp:?} next to p = 1/2");
    // Starts on a grid that resolves its flank. The table was computed on grids more than ten times as fine.
    let steep = Scene::unit(32.0);
    let expected = half_space_power_friction(&steep.body, &steep.material, &steep.load);
    let expected = expected.expect("an exponent of the table").value;
    assert_bar("r^32", reached(&steep, 1e-6, 400), expected, 0.05);
    let held = Scene::new(paraboloid(0.5), elastic(3.0), at_depth(0.01, 1.0));
    assert_bar("force", reached(&held, 1e-6, 400), 0.016, 1.1);
}
