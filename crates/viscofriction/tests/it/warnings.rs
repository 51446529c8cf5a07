//! An answer has its warnings as numbers, and JSON has their sentences.

use viscofriction::{Answer, Problem, Scene, Warning, solve};

use crate::support::assert_close;

/// The answer to a scene.
fn answer(scene: &str) -> Answer {
    let scene: Scene = scene.parse().expect("a scene");
    solve(&Problem::try_from(&scene).expect("a problem")).expect("an answer")
}

/// The warning of an answer that has one, whose sentence is that of the JSON.
fn only_warning(answer: &Answer) -> &Warning {
    let [warning] = answer.warnings.as_slice() else {
        panic!("one warning is expected: {:?}", answer.warnings);
    };
    let json = serde_json::to_value(answer).expect("JSON");
    let sentences = serde_json::json!([warning.to_string()]);
    assert_eq!(json["warnings"], sentences, "in JSON");
    warning
}

#[test]
fn a_steep_cone_has_a_mean_slope_in_the_warning() {
    let scene = |slope: f64| {
        format!(
            "indenter.cone = {{ slope = {slope} }}\nmaterial.viscous = {{ viscosity = 1e4 }}\nload = {{ normal_force = 1.0, velocity = 0.01 }}"
        )
    };
    assert_eq!(answer(&scene(0.1)).warnings, [], "of a flat cone");
    let steep = answer(&scene(0.8));
    let warning = only_warning(&steep);
    let Warning::SteepContact { mean_slope } = warning else {
        panic!("another warning: {warning:?}");
    };
    // The closed form knows no edge of the contact, and friction is a mean of the slope.
    let friction = steep.friction_coefficient.expect("it slides");
    assert_close("slope", *mean_slope, friction.value, 1e-15);
    let sentence = format!(
        "the mean slope of the surface in contact is {mean_slope:.2}, and linear theory needs a small one: above 0.5 its answers are rough"
    );
    assert_eq!(warning.to_string(), sentence);
}

#[test]
fn a_deep_contact_has_depth_and_radius_or_thickness_in_the_warning() {
    let elastic = "material.elastic = { shear_modulus = 1e6 }\nsolve = { relative_error = 1e-2, duration = 1.0 }";
    let load = "load = { indentation_depth = 4e-4, velocity = 0.0 }";
    let ball = answer(&format!(
        "indenter.sphere = {{ radius = 1e-3 }}\n{elastic}\n{load}"
    ));
    let deep = Warning::DeepForSphere {
        indentation_depth: 4e-4,
        radius: 1e-3,
    };
    assert!(ball.warnings.contains(&deep), "{:?}", ball.warnings);
    let layer = answer(&format!(
        "indenter.sphere = {{ radius = 1e-2 }}\n{elastic}\n{load}\nlayer = {{ thickness = 1e-3 }}"
    ));
    let deep = Warning::DeepForLayer {
        indentation_depth: 4e-4,
        thickness: 1e-3,
    };
    assert_eq!(only_warning(&layer), &deep);
}

#[test]
fn a_friction_that_no_elastomer_has_is_a_sign_of_a_wrong_unit() {
    let ball = |shear_strength: f64| {
        answer(&format!(
            "indenter.sphere = {{ radius = 5e-3 }}\nmaterial.elastic = {{ shear_modulus = 1e6 }}\nload = {{ normal_force = 1.0, velocity = 0.01 \
             }}\nsolve.relative_error = 0.01\ninterface.constant.shear_strength = {shear_strength}"
        ))
    };
    assert_eq!(ball(1e6).warnings, [], "of a strong interface");
    let large = ball(1e9);
    let friction = large.friction_coefficient.expect("it slides").value;
    let warning = only_warning(&large);
    let expected = Warning::LargeFriction {
        friction_coefficient: friction,
    };
    assert_eq!(warning, &expected);
    assert!(warning.to_string().contains("check the units"), "{warning}");
}

#[test]
fn an_activation_energy_that_no_polymer_has_is_a_sign_of_a_wrong_unit() {
    let ball = |energy: f64, of_interface: f64| {
        answer(&format!(
            "indenter.sphere = {{ radius = 5e-3 }}\nload = {{ normal_force = 1.0, velocity = 0.01 }}\nsolve.relative_error = 0.01\n\
             interface.bell = {{ shear_strength = 1e5, velocity = 0.01, activation_energy = {of_interface:?} }}\n\
             [material.prony]\nequilibrium_modulus = 1e6\nbranches = [{{ modulus = 1e6, relaxation_time = 1e-3 }}]\n\
             shift = {{ temperature = 20.0, temperature_range = [0.0, 40.0], law = {{ arrhenius = {energy:?} }} }}"
        ))
    };
    for usual in [1e4, 1e5, 1e6] {
        assert_eq!(ball(usual, usual).warnings, [], "{usual} J/mol");
    }
    for unusual in [1.0, 100.0, 9.9e3, 1.01e6] {
        let answer = ball(unusual, 1e5);
        let expected = Warning::UnusualActivationEnergy {
            key: "shift.law.arrhenius",
            activation_energy: unusual,
        };
        assert_eq!(only_warning(&answer), &expected);
    }
    let answer = ball(1e5, 2e3);
    let warning = only_warning(&answer).to_string();
    assert_eq!(
        warning,
        "interface.bell.activation_energy is 2000 J/mol, and polymers have activation energies from 10000 J/mol to 1000000 J/mol: \
         check its unit"
    );
}

#[test]
fn friction_from_frequencies_that_were_not_measured_has_its_fractions() {
    let answer = answer(
        "indenter.sphere = { radius = 5e-3 }\nload = { normal_force = 2.0, velocity = 0.1 }\nsolve.model = \"line\"\n\
         [material.prony]\nequilibrium_modulus = 1e6\nbranches = [{ modulus = 1e7, relaxation_time = 1e-3 }]\n\
         valid_frequencies = [100.0, 1e4]",
    );
    let warning = only_warning(&answer);
    let Warning::UnmeasuredFrequencies {
        outside,
        outside_window,
        valid_frequencies,
    } = warning
    else {
        panic!("another warning: {warning:?}");
    };
    let [lowest, highest] = *valid_frequencies;
    assert_close("lowest frequency", lowest, 100.0, 1e-15);
    assert_close("highest frequency", highest, 1e4, 1e-15);
    let all = answer.dissipation.outside_window;
    assert_eq!(all, Some(*outside_window), "of the answer");
    assert_close("sum", outside[0] + outside[1], *outside_window, 1e-12);
}
