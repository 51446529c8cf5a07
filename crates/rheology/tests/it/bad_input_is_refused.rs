use proptest::prelude::*;
use rheology::{RheologyError, StandardSolid, Viscous};

use crate::support::{fixed_cases, parameters, solid};

fn refused_parameter<T: std::fmt::Debug>(result: Result<T, RheologyError>) -> &'static str {
    match result {
        Err(RheologyError::InvalidParameter { parameter, .. }) => parameter,
        Ok(value) => panic!("{value:?} instead of an error"),
    }
}

#[test]
fn moduli_and_viscosities_outside_their_range_are_named() {
    for case in casebook::group("EXT-01") {
        let tail = case.id().trim_start_matches("EXT-01/");
        match tail.split(' ').next() {
            Some("01" | "02" | "03") => {
                let bad = case.input("G1");
                let first = StandardSolid::new(parameters([bad, 1.0, 1.0]));
                assert_eq!(
                    refused_parameter(first),
                    "equilibrium_modulus",
                    "{}",
                    case.id()
                );
                let second = StandardSolid::new(parameters([1.0, bad, 1.0]));
                assert_eq!(
                    refused_parameter(second),
                    "maxwell_modulus",
                    "{}",
                    case.id()
                );
            }
            // The relaxation time is η/G₂, so a bad one is a bad viscosity.
            Some("04" | "05") => {
                let result = StandardSolid::new(parameters([1.0, 1.0, case.input("tau")]));
                assert_eq!(refused_parameter(result), "viscosity", "{}", case.id());
            }
            Some("08") => {
                for eta in [case.input("eta"), -0.0, f64::NAN, f64::INFINITY] {
                    assert_eq!(
                        refused_parameter(Viscous::new(eta)),
                        "viscosity",
                        "η = {eta}"
                    );
                }
            }
            _ => {}
        }
    }
}

#[test]
fn negative_and_undefined_frequencies_are_refused() {
    let (solid, viscous) = (solid([1.0, 2.0, 3.0]), Viscous::new(3.0).unwrap());
    for omega in [-1.0, -1e-300, f64::NAN, f64::INFINITY] {
        let refused = [
            solid.storage_modulus(omega),
            solid.loss_modulus(omega),
            solid.loss_tangent(omega),
            viscous.loss_modulus(omega),
        ];
        for result in refused {
            assert_eq!(
                refused_parameter(result),
                "angular_frequency",
                "ω = {omega}"
            );
        }
    }
}

#[test]
fn numbers_too_far_apart_for_their_quotients_are_refused() {
    for (numbers, name) in [
        ([1e300, 1e-300, 1.0], "stiffness_ratio"),
        ([1e-200, 1e200, 1.0], "stiffness_ratio"),
        ([1e-200, 1e-200, 1e200], "relaxation_time"),
        ([1e-200, 1.0, 1e200], "retardation_time"),
        ([f64::MAX, f64::MAX, 1.0], "glass_modulus"),
    ] {
        let result = StandardSolid::new(parameters(numbers));
        assert_eq!(refused_parameter(result), name, "{numbers:?}");
    }
}

#[test]
fn the_message_names_parameter_value_and_range() {
    let error = Viscous::new(-2.0).unwrap_err();
    assert_eq!(
        error.to_string(),
        "viscosity must be finite and greater than 0, but is -2",
        "message of {error:?}"
    );
}

proptest! {
    #![proptest_config(fixed_cases())]

    /// Whatever is accepted answers with numbers.
    #[test]
    fn accepted_materials_never_answer_nan(
        logs in prop::array::uniform3(-320.0_f64..320.0),
        log_omega in -320.0_f64..320.0,
    ) {
        if let Ok(solid) = StandardSolid::new(parameters(logs.map(|log| 10_f64.powf(log)))) {
            let omega = 10_f64.powf(log_omega).min(f64::MAX);
            let peak = solid.loss_peak();
            let answers = [
                solid.storage_modulus(omega).unwrap(),
                solid.loss_modulus(omega).unwrap(),
                solid.loss_tangent(omega).unwrap(),
                solid.storage_modulus(0.0).unwrap(),
                solid.loss_modulus(0.0).unwrap(),
                solid.loss_tangent(0.0).unwrap(),
                solid.relaxation_modulus(omega),
                peak.angular_frequency,
                peak.loss_tangent,
            ];
            prop_assert!(answers.iter().all(|x| !x.is_nan()), "{:?}: {:?}", solid, answers);
            prop_assert!(!solid.creep_compliance(omega).is_nan(), "J of {:?} at {}", solid, omega);
        }
    }
}
