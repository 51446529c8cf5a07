use casebook::{assert_close, assert_matches};
use friction_analytic::{FrictionError, power_sliding, stationary_depth};
use indenters::{PowerProfile, stretch};
use proptest::prelude::*;

use crate::support::{fixed_cases, material_and_load, sliding, with_depth};

#[test]
fn power_profiles_slide_in_closed_form() {
    for case in casebook::group("FRI-01") {
        let profile = PowerProfile::new(case.input("c"), case.input("p")).unwrap();
        let (material, load) = sliding(&case);
        case.check("d", stationary_depth(&material, &load));
        match power_sliding(&profile, &material, &load) {
            Ok(state) => {
                case.check("d", state.indentation_depth);
                case.check("x_d", state.contact_length());
                case.check("mu", state.friction_coefficient);
                // The estimate of the rounding is honest. The table was made for the decimal p, whose last place
                // weighs 1/(2p − 1).
                let mu = state.friction_coefficient;
                let decimal = f64::EPSILON / (2.0 * case.input("p") - 1.0);
                case.check_within("mu", mu, state.error / mu + decimal);
            }
            Err(FrictionError::FrictionDiverges {
                indentation_depth,
                contact_length,
                ..
            }) => {
                assert_eq!(
                    case.expected_error(),
                    Some("FrictionDiverges"),
                    "{}",
                    case.id()
                );
                case.check("d", indentation_depth);
                case.check("x_d", contact_length);
            }
            Err(other) => panic!("{}: {other}", case.id()),
        }
    }
}

#[test]
fn exponents_from_just_above_one_half_to_a_billion_are_answered() {
    for case in casebook::group("EXT-03") {
        let p = case.input("p");
        let profile = PowerProfile::new(case.input("c"), p).unwrap();
        let (material, load) = with_depth(case.input("D"));
        let state = power_sliding(&profile, &material, &load).unwrap();
        if case.expected("mu").is_some() {
            case.check("mu", state.friction_coefficient);
            case.check("x_d", state.contact_length());
        } else {
            case.check(
                "mu_times_2p_minus_1",
                state.friction_coefficient * (2.0 * p - 1.0),
            );
        }
    }
}

#[test]
fn the_unit_system_does_not_matter() {
    for case in casebook::group("EXT-06") {
        let profile = PowerProfile::paraboloid(case.input("c")).unwrap();
        let (material, load) = sliding(&case);
        let state = power_sliding(&profile, &material, &load).unwrap();
        case.check("mu", state.friction_coefficient);
        case.check("d", state.indentation_depth);
    }
}

#[test]
fn friction_collapses_onto_one_number_per_exponent() {
    for case in casebook::group("BEM-07") {
        if case.expected("mu_mdr").is_none() {
            continue;
        }
        let (c, p) = (case.input("c"), case.input("p"));
        let (material, load) = sliding(&case);
        let state = power_sliding(&PowerProfile::new(c, p).unwrap(), &material, &load).unwrap();
        case.check("mu_mdr", state.friction_coefficient);
        let load_length =
            load.normal_force().expect("a force") / (material.viscosity() * load.velocity());
        let unit = c.powf(p.recip()) * load_length.powf(1.0 - p.recip());
        case.check("collapsed", state.friction_coefficient / unit);
    }
}

/// (21) and (22) as the paper prints them.
#[test]
fn cone_and_paraboloid_follow_equations_21_and_22() {
    use std::f64::consts::{FRAC_PI_2, PI};
    let (force, eta, v, c) = (2.0, 50.0, 0.1, 0.4);
    let (material, load) = material_and_load([force, eta, v]);
    let cone = power_sliding(&PowerProfile::cone(c).unwrap(), &material, &load).unwrap();
    assert_close!(cone.friction_coefficient => FRAC_PI_2 * c, within 1e-15);
    let front = force / (2.0 * PI * c * eta * v);
    assert_close!(cone.contact_line[0][1] => front, within 2e-15);
    let paraboloid = PowerProfile::paraboloid(c).unwrap();
    let state = power_sliding(&paraboloid, &material, &load).unwrap();
    let mu = 2.0 / 3.0 * (2.0 * c * force / (eta * v)).sqrt();
    assert_close!(state.friction_coefficient => mu, within 2e-15);
    let front = (force / (8.0 * c * eta * v)).sqrt();
    assert_close!(state.contact_line[0][1] => front, within 2e-15);
}

#[test]
fn no_intermediate_product_overflows() {
    for [force, eta, v] in [
        [1e-200, 1e200, 1e-200],
        [1e-200, 1e-200, 1e200],
        [1e200, 1e-200, 1e200],
        [1e200, 1e200, 1e-200],
        [1e300, 1e300, 1e300],
    ] {
        let (material, load) = material_and_load([force, eta, v]);
        let depth = stationary_depth(&material, &load);
        let logarithm = force.log10() - eta.log10() - v.log10() - 4_f64.log10();
        // The logarithm is rounded in its last place, that is to 1e-13.
        assert!(
            (depth.log10() - logarithm).abs() < 1e-12,
            "F = {force:e}, η = {eta:e}, v = {v:e}: d = {depth:e} instead of 1e{logarithm}"
        );
    }
}

#[test]
fn what_leaves_the_range_of_numbers_is_an_error() {
    let cone = PowerProfile::cone(1.0).unwrap();
    for numbers in [[1e300, 1e-300, 1.0], [1e-300, 1e300, 1.0]] {
        let (material, load) = material_and_load(numbers);
        let result = power_sliding(&cone, &material, &load);
        assert_matches!(
            result,
            Err(FrictionError::OutOfRange {
                quantity: "indentation depth",
                ..
            }),
            "{numbers:?}"
        );
    }
    let sharp = PowerProfile::new(1e-300, 0.6).unwrap();
    let (material, load) = with_depth(1.0);
    let result = power_sliding(&sharp, &material, &load);
    assert_matches!(
        result,
        Err(FrictionError::OutOfRange {
            quantity: "contact length",
            ..
        })
    );
}

proptest! {
    #![proptest_config(fixed_cases(256))]

    /// μ = C_p c^(1/p) (F/(η v))^(1 − 1/p) over 20 decades of each of the four, and never below d/x_d, which is the
    /// inequality of Cauchy and Schwarz.
    #[test]
    fn similarity_holds_over_twenty_decades(
        logs in prop::array::uniform4(-10.0_f64..10.0),
        p in 0.55_f64..20.0,
    ) {
        let [force, eta, v, c] = logs.map(|log| 10_f64.powf(log));
        let (material, load) = material_and_load([force, eta, v]);
        let state = power_sliding(&PowerProfile::new(c, p).unwrap(), &material, &load).unwrap();
        let inverse = p.recip();
        let number = p * p / (2.0 * p - 1.0) * stretch(p).unwrap().powf(inverse) * 4_f64.powf(inverse - 1.0);
        let unit = c.powf(inverse) * (force / (eta * v)).powf(1.0 - inverse);
        assert_close!(state.friction_coefficient => number * unit, within 1e-12);
        let smallest = state.indentation_depth / state.contact_length();
        prop_assert!(
            state.friction_coefficient >= smallest * (1.0 - 1e-12),
            "μ = {} is below d/x_d = {smallest} for p = {p}", state.friction_coefficient
        );
    }
}
