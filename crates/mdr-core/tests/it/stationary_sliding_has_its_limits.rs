//! Where the stationary state has a closed form or none: dashpot, spring, very slow, very fast, too low, too steep.

use casebook::Case;
use friction_analytic::ElasticContact;
use friction_analytic::{
    axisymmetric_sliding, high_speed_friction, line_sliding, low_speed_friction,
};
use indenters::{
    Axisymmetric, EquivalentLine, FlatCone, Hyperboloid, PowerProfile, RigidLine, Sphere,
};
use mdr_core::{MdrError, SteadySliding, steady};
use rheology::{Elastic, KelvinVoigt, Material, StandardSolid, StandardSolidParameters};

use crate::support::{
    ASKED, Cubic, VISCOSITY, assert_close, at_depth, load, load_for_depth, material, power, prony,
    twenty_branches,
};

fn slid(
    line: &impl RigidLine,
    material: &dyn Material,
    [force, velocity]: [f64; 2],
) -> SteadySliding {
    let load = load(force, velocity);
    steady(line, material, &load, ASKED).expect("a stationary state")
}

/// Theorems 3 and 6 hold to rounding and to the error of either side.
#[test]
fn a_dashpot_obeys_the_theorems() {
    let bodies: [Box<dyn Axisymmetric>; 6] = [
        Box::new(power(0.6)),
        Box::new(power(1.0)),
        Box::new(power(2.0)),
        Box::new(power(7.5)),
        Box::new(Sphere::new(2.0).expect("a sphere")),
        Box::new(Hyperboloid::new(0.5, 0.3).expect("a hyperboloid")),
    ];
    for body in bodies {
        for depth in [1e-7, 0.1] {
            let (dashpot, load) = (material(VISCOSITY), load_for_depth(depth));
            let exact = axisymmetric_sliding(body.as_ref(), &dashpot, &load).expect("a theorem");
            let line = EquivalentLine(body.as_ref());
            let state = steady(&line, &dashpot, &load, ASKED).expect("a stationary state");
            assert_close([state.indentation_depth.value, depth], 1e-13, 0.0, &state);
            let error = state.friction_coefficient.error + 1e-12 * exact.friction_coefficient;
            let difference = state.friction_coefficient.value - exact.friction_coefficient;
            assert!(
                difference.abs() <= error,
                "at {depth}: {state:?} instead of {exact:?}"
            );
        }
    }
}

/// Casebook FRI-03: a leading edge of several intervals, the second one behind a dent that does not recover.
#[test]
fn a_dashpot_is_touched_along_the_leading_edge() {
    let mut n_intervals = 0;
    for case in casebook::group("FRI-03") {
        if !case.id().contains("/cubic/") || case.expected_error().is_some() {
            continue;
        }
        let (line, load) = cubic(&case);
        let exact = line_sliding(&line, &material(VISCOSITY), &load).expect("a theorem");
        let state = steady(&line, &material(VISCOSITY), &load, ASKED).expect("a stationary state");
        case.check_within("mu", state.friction_coefficient.value, 1e-9);
        let ends: Vec<f64> = state.contacts.iter().flatten().copied().collect();
        let expected: Vec<f64> = exact.contact_line.iter().flatten().copied().collect();
        assert_eq!(
            ends.len(),
            expected.len(),
            "{}: {ends:?}, {expected:?}",
            case.id()
        );
        for (end, expected) in ends.iter().zip(&expected) {
            // An interval ends where the line is level, so that the rounding of its height counts by the square root.
            assert_close([*end, *expected], 1e-7, 1.0, &case.id());
        }
        n_intervals = n_intervals.max(state.contacts.len());
    }
    assert!(n_intervals >= 2, "only {n_intervals} intervals");
}

fn cubic(case: &Case) -> (Cubic, indenters::SlidingLoad) {
    let scale = case.input("eps");
    let mirrored = case.has_input("direction");
    let depth = scale * case.input("D_over_eps");
    (Cubic { scale, mirrored }, load_for_depth(depth))
}

#[test]
fn a_line_that_is_too_low_has_no_stationary_state() {
    let mut n_refused = 0;
    for case in casebook::group("FRI-03") {
        if !case.id().contains("/cubic/") || case.expected_error().is_none() {
            continue;
        }
        let (line, load) = cubic(&case);
        let result = steady(&line, &material(VISCOSITY), &load, ASKED);
        match result {
            Err(MdrError::ForceBeyondEdge {
                normal_force,
                carried_force,
                ..
            }) => {
                assert!(carried_force < normal_force, "{}: {result:?}", case.id());
                n_refused += 1;
            }
            other => panic!("{}: {other:?}", case.id()),
        }
    }
    assert_eq!(n_refused, 2, "rows of the casebook");
}

/// EXT-05: without relaxation no friction, to the last bit, at any speed.
#[test]
fn a_spring_has_no_friction() {
    let spring = Elastic::new(3.0).expect("a spring");
    for exponent in [0.4, 1.0, 2.0, 5.0] {
        for velocity in [1e-9, 1.0, 1e9] {
            let body = power(exponent);
            let state = slid(&EquivalentLine(&body), &spring, [1e-3, velocity]);
            let front = state.contacts[0][1];
            let half = exponent / (exponent + 1.0) * state.indentation_depth.value * front;
            assert_close([8.0 * 3.0 * half, 1e-3], 1e-8, 0.0, &state);
            assert!(
                state.friction_coefficient.value.to_bits() == 0,
                "p = {exponent}: {state:?}"
            );
        }
    }
}

/// FRI-05: leading terms at both ends, with the remainder of the order v τ/a and a/(v τ).
#[test]
fn slow_and_fast_solids_have_the_friction_of_the_elastic_limits() {
    for case in casebook::group("FRI-05") {
        if case.expected("mu_fast").is_none() {
            continue;
        }
        let p = case.input("p");
        let stretch = indenters::stretch(p).expect("p");
        let body = PowerProfile::new(case.input("kappa_c") / stretch, p).expect("a power");
        let solid = StandardSolid::new(StandardSolidParameters {
            equilibrium_modulus: case.input("G1"),
            maxwell_modulus: case.input("G2"),
            viscosity: case.input("G2") * case.input("tau"),
        })
        .expect("a solid");
        let contact_radius = case.input("a");
        for (name, velocity) in [("mu_slow_mdr", "v_slow"), ("mu_fast", "v_fast")] {
            let velocity = case.input(velocity);
            let motion = at_depth(body.line_height(contact_radius), velocity);
            let line = EquivalentLine(&body);
            let state = steady(&line, &solid, &motion, ASKED).expect("a stationary state");
            case.check_within(name, state.friction_coefficient.value, 1e-6);
            let contact = ElasticContact {
                contact_radius,
                velocity,
            };
            let limit = if name == "mu_fast" {
                high_speed_friction(&body, &solid, contact)
            } else {
                low_speed_friction(&body, &solid, contact)
            };
            let limit = limit.expect("a limit");
            assert_close(
                [state.normal_force.value, limit.normal_force],
                1e-6,
                0.0,
                &case.id(),
            );
        }
    }
}

/// At 10⁻¹² to 10¹² m/s, and 10⁻¹² to 10¹² lengths of relaxation, the error asked for is kept: a solution of 10⁻¹¹ says so.
#[test]
fn twenty_branches_keep_the_error_over_all_speeds() {
    let material = twenty_branches();
    for body in [power(1.0), power(2.0), power(3.5)] {
        let line = EquivalentLine(&body);
        for decade in -12..=12 {
            let load = load(10.0, 10.0_f64.powi(decade));
            let [state, finer] = [1e-6, 1e-11].map(|relative_error| {
                steady(&line, &material, &load, relative_error).expect("a stationary state")
            });
            let difference = state.friction_coefficient.value - finer.friction_coefficient.value;
            assert!(
                difference.abs() <= state.friction_coefficient.error
                    && state.friction_coefficient.error <= 1e-6 * finer.friction_coefficient.value
                    && finer.friction_coefficient.value > 0.0,
                "{body:?} at 1e{decade}: {state:?}, finer {finer:?}"
            );
        }
    }
}

/// (16) diverges for p ≤ 1/2 and behind a kink that rises; without a lone dashpot it does not.
#[test]
fn a_dashpot_under_a_cusp_or_a_kink_is_refused() {
    let dashpots: [Box<dyn Material>; 2] = [
        Box::new(material(VISCOSITY)),
        Box::new(KelvinVoigt::new(1.0, 1.0).expect("a solid")),
    ];
    let bodies: [Box<dyn Axisymmetric>; 3] = [
        Box::new(power(0.3)),
        Box::new(power(0.5)),
        Box::new(FlatCone::new(0.01, 0.3).expect("a flat cone")),
    ];
    for body in &bodies {
        let line = EquivalentLine(body.as_ref());
        for dashpot in &dashpots {
            let load = load(1.0, 0.1);
            let result = steady(&line, dashpot.as_ref(), &load, ASKED);
            assert!(
                matches!(result, Err(MdrError::FrictionDiverges { position }) if position.abs() < 0.011),
                "{dashpot:?}: {result:?}"
            );
        }
        let branch = prony([0.0, 0.0], &[(1.0, 1.0)]);
        let state = slid(&line, &branch, [1.0, 0.1]);
        assert!(state.friction_coefficient.value > 0.0, "{state:?}");
    }
}

/// A Poisson ratio makes the foundation softer by 2 (1 − ν).
#[test]
fn a_poisson_ratio_is_a_smaller_modulus() {
    let solid = prony([1.0, 0.0], &[(2.0, 0.1), (3.0, 1.0)]);
    let compressible = rheology::Compressible::new(&solid, 0.2).expect("a Poisson ratio");
    let body = power(2.0);
    let line = EquivalentLine(&body);
    let compressed = slid(&line, &compressible, [1.0, 0.3]);
    let incompressible = slid(&line, &solid, [1.6, 0.3]);
    for (actual, expected) in [
        (
            compressed.indentation_depth.value,
            incompressible.indentation_depth.value,
        ),
        (
            compressed.friction_coefficient.value,
            incompressible.friction_coefficient.value,
        ),
    ] {
        assert_close([actual, expected], 1e-12, 0.0, &compressed);
    }
}
