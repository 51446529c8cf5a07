//! Depth, force, friction and both ends of the stationary contact, for every foundation of the casebook (MDR-03 to
//! MDR-08, EXT-04).

use casebook::Case;
use indenters::{EquivalentLine, RigidLine};
use mdr_core::{SteadySliding, steady};
use rheology::{StandardSolid, StandardSolidParameters};

use crate::support::{ASKED, assert_close, at_depth, body_of, foundation_of, load};

const GROUPS: [&str; 6] = ["MDR-03", "MDR-04", "MDR-05", "MDR-06", "MDR-07", "MDR-08"];

/// The rows that are one state, not a maximum over speeds.
fn states(group: &str) -> impl Iterator<Item = Case> {
    let cases = casebook::group(group).into_iter();
    cases.filter(|case| case.has_input("v") && case.expected("mu").is_some())
}

/// At the force where one is given, else at the depth of the leading edge.
fn solve(case: &Case, relative_error: f64) -> SteadySliding {
    let (body, material) = (body_of(case), foundation_of(case));
    let line = EquivalentLine(body.as_ref());
    let velocity = case.input("v");
    if case.has_input("F") {
        return steady(
            &line,
            material.as_ref(),
            &load(case.input("F"), velocity),
            relative_error,
        )
        .expect("a stationary state");
    }
    let motion = at_depth(line.height(case.input("x_r")), velocity);
    steady(&line, material.as_ref(), &motion, relative_error).expect("a stationary state")
}

/// The ends count relative to the contact: one of them may lie at the apex.
fn check(case: &Case, state: &SteadySliding) {
    for (name, actual) in [
        ("d", state.indentation_depth.value),
        ("F", state.normal_force.value),
        ("mu", state.friction_coefficient.value),
    ] {
        if case.expected(name).is_some() {
            case.check(name, actual);
        }
    }
    let [[rear, front]] = state.contacts[..] else {
        panic!("{}: contacts {:?}", case.id(), state.contacts);
    };
    for (name, actual) in [("x_l", rear), ("x_r", front)] {
        if let Some(expected) = case.expected(name) {
            let scale = front - rear;
            assert_close(
                [actual, expected],
                case.relative_tolerance(),
                scale,
                &case.id(),
            );
        }
    }
}

#[test]
fn every_foundation_comes_out() {
    for group in GROUPS {
        let mut n_rows = 0;
        for case in states(group) {
            check(&case, &solve(&case, ASKED));
            n_rows += 1;
        }
        assert!(n_rows >= 10, "{group}: only {n_rows} rows");
    }
}

/// The rows are known to 1e-11 or better except the extreme speeds, which the casebook states with 1e-7.
#[test]
fn the_error_covers_what_the_casebook_knows_better() {
    for relative_error in [1e-2, 1e-4, 1e-6] {
        for case in GROUPS.iter().flat_map(|group| states(group)) {
            let state = solve(&case, relative_error);
            let expected = case.expected("mu").expect("a friction coefficient");
            let error = (state.friction_coefficient.value - expected).abs();
            let known = 1e-11 * expected + 1e-13;
            assert!(
                error <= state.friction_coefficient.error + known
                    && state.friction_coefficient.error <= relative_error * expected,
                "{}: error {error:e}, estimate {:e} of {expected:e} at {relative_error:e}",
                case.id(),
                state.friction_coefficient.error
            );
        }
    }
}

/// EXT-04: as the lone spring vanishes the solid becomes the Maxwell fluid.
#[test]
fn a_vanishing_spring_leaves_the_fluid() {
    for case in casebook::group("EXT-04") {
        if !case.has_input("G1") {
            continue;
        }
        let state = |material| {
            let k = case.input("k");
            let body = crate::support::Shape::Paraboloid.body(k);
            let motion = at_depth(k * case.input("x_r").powi(2), case.input("v"));
            steady(&EquivalentLine(&body), &material, &motion, ASKED).expect("a stationary state")
        };
        let solid = StandardSolid::new(StandardSolidParameters {
            equilibrium_modulus: case.input("G1"),
            maxwell_modulus: case.input("G2"),
            viscosity: case.input("G2") * case.input("tau"),
        });
        let solid = state(solid.expect("a solid"));
        case.check("F", solid.normal_force.value);
        case.check("mu", solid.friction_coefficient.value);
    }
}
