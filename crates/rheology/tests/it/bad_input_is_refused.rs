use proptest::prelude::*;
use rheology::{
    Compressible, CreepSpectrum, Elastic, ExponentialStep, KelvinVoigt, Material, Maxwell,
    RelaxationBranch, RelaxationSpectrum, RetardationElement, RheologyError, StandardSolid,
    Viscous,
};

use crate::support::{assert_same, fixed_cases, parameters, solid};

fn refused_parameter<T: std::fmt::Debug>(result: Result<T, RheologyError>) -> &'static str {
    match result {
        Err(
            RheologyError::InvalidParameter { parameter, .. }
            | RheologyError::InvalidElement { parameter, .. },
        ) => parameter,
        Err(other) => panic!("{other} instead of a bad parameter"),
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

const MODULUS: [&str; 2] = ["shear_modulus", "compliance"];
const VISCOSITY: [&str; 2] = ["viscosity", "fluidity"];
const NAMES: [[&str; 2]; 5] = [MODULUS, MODULUS, VISCOSITY, MODULUS, VISCOSITY];

#[test]
fn elementary_materials_refuse_what_is_not_positive() {
    for bad in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, 1e-320] {
        let refused = [
            refused_parameter(Elastic::new(bad)),
            refused_parameter(Maxwell::new(bad, 1.0)),
            refused_parameter(Maxwell::new(1.0, bad)),
            refused_parameter(KelvinVoigt::new(bad, 1.0)),
            refused_parameter(KelvinVoigt::new(1.0, bad)),
        ];
        for (parameter, [name, inverse]) in refused.into_iter().zip(NAMES) {
            assert!(
                parameter == name || parameter == inverse,
                "{parameter} for {name} = {bad}"
            );
        }
    }
    let too_far = Maxwell::new(1e-300, 1e300);
    assert_eq!(refused_parameter(too_far), "relaxation_time", "1e600 s");
}

#[test]
fn poisson_ratios_outside_the_stable_range_are_refused() {
    let elastic = Elastic::new(1.0).unwrap();
    for bad in [-1.0, -2.0, 0.500_001, f64::NAN, f64::INFINITY] {
        let result = Compressible::new(&elastic, bad);
        assert_eq!(refused_parameter(result), "poisson_ratio", "ν = {bad}");
    }
    for (ratio, factor) in [(0.5, 1.0), (0.25, 1.5), (0.0, 2.0), (-0.5, 3.0)] {
        let material = Compressible::new(&elastic, ratio).unwrap();
        assert_same(
            &format!("ν = {ratio}"),
            material.half_space_factor(),
            factor,
        );
    }
}

fn branch(modulus: f64, relaxation_time: f64) -> RelaxationBranch {
    RelaxationBranch {
        modulus,
        relaxation_time,
    }
}

#[test]
fn spectra_name_the_list_and_the_place_of_a_bad_number() {
    let good = branch(1.0, 1.0);
    for (bad, expected) in [
        (branch(-1.0, 1.0), "modulus"),
        (branch(f64::NAN, 1.0), "modulus"),
        (branch(1.0, 0.0), "relaxation_time"),
        (branch(1.0, -1.0), "relaxation_time"),
        (branch(1.0, f64::INFINITY), "relaxation_time"),
    ] {
        let error = RelaxationSpectrum::new(0.0, 0.0, vec![good, bad]).unwrap_err();
        let message = error.to_string();
        let start = format!("{expected} of branches[1] must be finite");
        assert!(message.starts_with(&start), "{message}, for {bad:?}");
        let element = RetardationElement {
            compliance: bad.modulus,
            retardation_time: bad.relaxation_time,
        };
        let error = CreepSpectrum::new(0.0, 0.0, vec![element]).unwrap_err();
        let message = error.to_string();
        assert!(message.contains("of elements[0]"), "{message}, for {bad:?}");
    }
}

#[test]
fn spectra_name_a_bad_spring_or_dashpot() {
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let error = RelaxationSpectrum::new(bad, 0.0, vec![branch(1.0, 1.0)]);
        assert_eq!(refused_parameter(error), "equilibrium_modulus", "{bad}");
        let error = RelaxationSpectrum::new(0.0, bad, vec![branch(1.0, 1.0)]);
        assert_eq!(refused_parameter(error), "viscosity", "{bad}");
        let error = CreepSpectrum::new(bad, 0.0, Vec::new());
        assert_eq!(
            refused_parameter(error),
            "instantaneous_compliance",
            "{bad}"
        );
        let error = CreepSpectrum::new(0.0, bad, Vec::new());
        assert_eq!(refused_parameter(error), "fluidity", "{bad}");
    }
}

#[test]
fn a_material_of_nothing_is_refused() {
    let empty = RelaxationSpectrum::new(0.0, 0.0, vec![branch(0.0, 1.0)]);
    assert_eq!(empty, Err(RheologyError::NoStiffness), "no stiffness");
    let rigid = CreepSpectrum::new(0.0, 0.0, Vec::new());
    assert_eq!(rigid, Err(RheologyError::NoCompliance), "no compliance");
}

#[test]
fn times_and_time_steps_that_do_not_advance_are_refused() {
    let material = Maxwell::new(1.0, 1.0).unwrap();
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let creep = ExponentialStep::creep(&material.creep(), bad);
        let relaxation = ExponentialStep::relaxation(&material.relaxation(), bad);
        for step in [creep, relaxation] {
            assert_eq!(refused_parameter(step), "time_step", "Δt = {bad}");
        }
    }
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        for result in [
            material.creep_compliance(bad),
            material.relaxation_modulus(bad),
        ] {
            assert_eq!(refused_parameter(result), "time", "t = {bad}");
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
                solid.relaxation_modulus(omega).unwrap(),
                peak.angular_frequency,
                peak.loss_tangent,
            ];
            prop_assert!(answers.iter().all(|x| !x.is_nan()), "{:?}: {:?}", solid, answers);
            prop_assert!(!solid.creep_compliance(omega).unwrap().is_nan(), "J of {:?} at {}", solid, omega);
        }
    }
}
