//! Random valid scenes over many decades are answered by the cheapest method of the one-dimensional model to the error asked
//! for, and alike in other units.

use casebook::{decades, fixed_cases};
use proptest::prelude::*;
use viscofriction::Estimate;

use crate::support::{Folder, estimate, number};

/// The text of a scene in these units; `<x a b c>` stands for the number x of the unit m^a Pa^b s^c.
fn in_units(text: &str, units: [f64; 3]) -> String {
    let number = |word: &str| word.parse::<f64>().expect("a number");
    let mut parts = text.split(['<', '>']);
    let mut scene = parts.next().unwrap_or_default().to_owned();
    while let (Some(quantity), Some(rest)) = (parts.next(), parts.next()) {
        let numbers: Vec<f64> = quantity.split(' ').map(number).collect();
        let powers = units.iter().zip(&numbers[1..]);
        let factor: f64 = powers.map(|(unit, power)| unit.powf(*power)).product();
        scene += &format!("{:?}{rest}", numbers[0] * factor);
    }
    scene
}

/// c r^p with the coefficient 1 m^(1 − p).
fn power(p: f64) -> String {
    let unit = 1.0 - p;
    format!("{{ coefficient = <1 {unit:?} 0 0>, exponent = {p:?} }}")
}

fn body() -> impl Strategy<Value = String> {
    let with_tip = |kind: &'static str| {
        let keys = move |tip| format!("{kind} = {{ radius = <{tip:?} 1 0 0>, slope = 0.7 }}");
        decades(1.0).prop_map(keys)
    };
    let superposition = |(low, high)| {
        let terms = [low, high].map(power).join(", ");
        format!("superposition.terms = [{terms}]")
    };
    prop_oneof![
        (0.75..4.0_f64).prop_map(|p| format!("power = {}", power(p))),
        Just("cone.slope = 0.3".to_owned()),
        Just("paraboloid.curvature = <1 -1 0 0>".to_owned()),
        with_tip("hyperboloid"),
        with_tip("round-tipped-cone"),
        (1.0..2.0_f64, 2.0..4.0_f64).prop_map(superposition),
    ]
}

/// A material but for its Poisson ratio and what ends it.
fn material() -> impl Strategy<Value = String> {
    let of_two = |kind: &'static str| {
        let dashpot = |tau| format!("shear_modulus = <1 0 1 0>, viscosity = <{tau:?} 0 1 1>");
        decades(2.0).prop_map(move |tau| format!("{kind} = {{ {}", dashpot(tau)))
    };
    let solid = |(modulus, tau): (f64, f64)| {
        let viscosity = modulus * tau;
        let branch =
            format!("maxwell_modulus = <{modulus:?} 0 1 0>, viscosity = <{viscosity:?} 0 1 1>");
        format!("standard-solid = {{ equilibrium_modulus = <1 0 1 0>, {branch}")
    };
    let branch = (decades(2.0), decades(3.0)).prop_map(|(modulus, tau)| {
        format!("{{ modulus = <{modulus:?} 0 1 0>, relaxation_time = <{tau:?} 0 0 1> }}")
    });
    let prony = |branches: Vec<String>| {
        let branches = branches.join(", ");
        format!("prony = {{ equilibrium_modulus = <1 0 1 0>, branches = [{branches}]")
    };
    prop_oneof![
        Just("viscous = { viscosity = <1 0 1 1>".to_owned()),
        Just("elastic = { shear_modulus = <1 0 1 0>".to_owned()),
        of_two("kelvin-voigt"),
        of_two("maxwell"),
        (decades(2.0), decades(2.0)).prop_map(solid),
        prop::collection::vec(branch, 1..4).prop_map(prony),
    ]
}

proptest! {
    #![proptest_config(fixed_cases(100))]

    #[test]
    fn any_scene_is_answered_to_its_error_in_any_units(
        (body, material) in (body(), material()),
        (poisson_ratio, depth, velocity) in (-0.9..=0.5_f64, decades(1.0), decades(2.0)),
        exponent in -6.0..-2.0_f64,
        units in [decades(6.0), decades(6.0), decades(6.0)],
    ) {
        let relative_error = 10.0_f64.powf(exponent);
        let body = format!("indenter.{body}");
        let material = format!("material.{material}, poisson_ratio = {poisson_ratio:?} }}");
        let load = format!("indentation_depth = <{depth:?} 1 0 0>, velocity = <{velocity:?} 1 0 -1>");
        let solve = format!("model = \"line\", relative_error = {relative_error:?}");
        let folder = Folder::new("any-scene");
        let [answer, scaled] = [[1.0; 3], units].map(|units| {
            let [body, material, load] = [&body, &material, &load].map(|text| in_units(text, units));
            folder.answer(&format!("{body}; {material}; {load}; {solve}"))
        });
        let Estimate { value: friction, error } = estimate(&answer, "friction_coefficient");
        prop_assert!(friction >= 0.0 && error <= relative_error * friction, "{answer}");
        let [normal, tangential] = ["normal_force", "tangential_force"].map(|field| number(&answer, field));
        prop_assert!((tangential - friction * normal).abs() <= 4.0 * f64::EPSILON * tangential, "{answer}");
        prop_assert_eq!(&answer["method"], &scaled["method"], "the method depends on the units");
        let same = estimate(&scaled, "friction_coefficient");
        // Both have their error, and the rounding of the units.
        let allowed = 2.0 * error + same.error + 1e-12 * friction;
        prop_assert!((same.value - friction).abs() <= allowed, "{same:?} in units {units:?} instead of {answer}");
    }
}
