//! Depth, force, friction and both ends of the stationary contact, for every foundation of the casebook, and
//! for the limits with a closed form: very slow, very fast, full contact.

use std::f64::consts::TAU;

use casebook::Case;
use friction_analytic::{
    ElasticContact, WavyLine, high_speed_friction, low_speed_friction, wavy_sliding,
};
use indenters::{Axisymmetric, EquivalentLine, RigidLine};
use mdr_core::{SteadySliding, steady};
use numerics::Estimate;

use crate::support::{
    ASKED, assert_agree, assert_close, at_depth, body_of, line, line_power, load, material_of,
    model, named, slid,
};

/// As the equilibrium spring vanishes in EXT-04 the solid becomes the Maxwell fluid.
const GROUPS: [&str; 7] = [
    "MDR-03", "MDR-04", "MDR-05", "MDR-06", "MDR-07", "MDR-08", "EXT-04",
];

/// At the force where one is given, else at the depth of the leading edge.
fn solve(case: &Case, relative_error: f64) -> SteadySliding {
    let body = body_of(case);
    let line = EquivalentLine(&*body);
    let velocity = case.input("v");
    let load = if case.has_input("F") {
        load(case.input("F"), velocity)
    } else {
        at_depth(line.height(case.input("x_r")), velocity)
    };
    steady(&line, &*material_of(case), &load, relative_error).expect("a stationary state")
}

/// The rows are known to 1e-11 or better except the extreme speeds, which the casebook states with 1e-7.
#[test]
fn every_foundation_comes_out_within_its_error() {
    for group in GROUPS {
        let rows = casebook::group(group).into_iter();
        // A state, not a maximum over speeds.
        let states = rows.filter(|case| case.has_input("v") && case.expected("mu").is_some());
        let cases: Vec<Case> = states.collect();
        assert!(cases.len() >= 3, "{group}: only {} rows", cases.len());
        for case in cases {
            let state = solve(&case, ASKED);
            let [[rear, front]] = state.contacts[..] else {
                panic!("{}: {state:?}", case.id());
            };
            for (name, estimate) in named(&state) {
                // The ends count relative to the contact: one of them may lie at the apex.
                let is_end = name.starts_with('x');
                let scale = if is_end { front - rear } else { 0.0 };
                if let Some(expected) = case.expected(name) {
                    let tolerance = case.relative_tolerance();
                    assert_close([estimate.value, expected], tolerance, scale, &case.id());
                }
            }
            let value = case.expected("mu").expect("a friction coefficient");
            let expected = Estimate::new(value, 1e-11 * value + 1e-13);
            for relative_error in [1e-2, 1e-4, 1e-6] {
                let friction = solve(&case, relative_error).friction_coefficient;
                assert_agree([friction, expected], &case.id());
                assert!(friction.error <= relative_error * value, "{friction:?}");
            }
        }
    }
}

/// FRI-05: leading terms at both ends, with the remainder of the order v τ/a and a/(v τ).
#[test]
fn slow_and_fast_solids_have_the_friction_of_the_elastic_limits() {
    let cases = casebook::group("FRI-05").into_iter();
    for case in cases.filter(|case| case.expected("mu_fast").is_some()) {
        let body = line_power(case.input("kappa_c"), case.input("p"));
        let solid = material_of(&case);
        let contact_radius = case.input("a");
        for (name, velocity) in [("mu_slow_mdr", "v_slow"), ("mu_fast", "v_fast")] {
            let velocity = case.input(velocity);
            let motion = at_depth(body.line_height(contact_radius), velocity);
            let state = slid(&EquivalentLine(&body), &*solid, &motion);
            case.check_within(name, state.friction_coefficient.value, 1e-6);
            let contact = ElasticContact {
                contact_radius,
                velocity,
            };
            let limit = if name == "mu_fast" {
                high_speed_friction(&body, &*solid, contact)
            } else {
                low_speed_friction(&body, &*solid, contact)
            };
            let force = limit.expect("a limit").normal_force;
            assert_close([state.normal_force.value, force], 1e-6, 0.0, &case.id());
        }
    }
}

/// Friction force \[N] of `n_waves` of amplitude 1 and length 1 behind a runner.
fn wavy_friction(n_waves: f64, mean_depth: f64, velocity: f64) -> f64 {
    let line = line([-n_waves, 1.0], |x: f64| {
        if x > 0.0 {
            1.0 + 40.0 * x * x
        } else {
            (TAU * x).cos()
        }
    });
    // The lowest point lies one amplitude below the mean.
    let load = at_depth(mean_depth + 1.0, velocity);
    let state = steady(&line, &model("W4"), &load, 1e-11).expect("a state");
    assert_eq!(state.contacts.len(), 1, "full contact: {state:?}");
    state.friction_coefficient.value * state.normal_force.value
}

/// FRI-06: in full contact every further wave adds the friction of the loss modulus G''(k v). Forty waves later nothing is
/// left of the front, except from a branch that relaxes over ten waves, e⁻⁴⁰ of it too.
#[test]
fn every_wave_has_the_friction_of_the_loss_modulus() {
    for velocity in [1e-9, 1e-3, 0.01, 0.1] {
        let line = WavyLine {
            amplitude: 1.0,
            wavelength: 1.0,
            velocity,
        };
        let expected = wavy_sliding(line, &model("W4")).expect("full contact");
        let depth = 1.5 * expected.least_depth;
        let [before, after] = [40.0, 41.0].map(|n_waves| wavy_friction(n_waves, depth, velocity));
        // The difference of two sums of forty waves.
        let friction = expected.friction_per_length;
        assert_close([after - before, friction], 1e-8, 0.0, &(velocity, before));
    }
}
