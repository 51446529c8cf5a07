//! Random valid scenes over many decades are answered by the cheapest method of the one-dimensional model to the error asked
//! for, and alike in other units.

use std::fs;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use serde_json::Value;

use crate::support::{argument, bar, folder, number, run_json};

/// A name and a number whose unit is m^a Pa^b s^c.
type Quantity = (&'static str, f64, [f64; 3]);
/// The kind of a table, its numbers, and perhaps the name of a list and its elements.
type Table = (
    &'static str,
    Vec<Quantity>,
    Option<(&'static str, Vec<Vec<Quantity>>)>,
);

const PURE: [f64; 3] = [0.0; 3];
const LENGTH: [f64; 3] = [1.0, 0.0, 0.0];
const STRESS: [f64; 3] = [0.0, 1.0, 0.0];
const TIME: [f64; 3] = [0.0, 0.0, 1.0];
const VISCOSITY: [f64; 3] = [0.0, 1.0, 1.0];

fn decades(n: f64) -> impl Strategy<Value = f64> {
    (-n..n).prop_map(|exponent| 10.0_f64.powf(exponent))
}

/// The keys of c r^p, with the coefficient 1 m^(1 − p).
fn power(p: f64) -> Vec<Quantity> {
    vec![
        ("coefficient", 1.0, [1.0 - p, 0.0, 0.0]),
        ("exponent", p, PURE),
    ]
}

fn body() -> impl Strategy<Value = Table> {
    let with_tip = |kind: &'static str| {
        let keys = |tip| vec![("radius", tip, LENGTH), ("slope", 0.7, PURE)];
        decades(1.0).prop_map(move |tip| (kind, keys(tip), None))
    };
    prop_oneof![
        (0.75..4.0_f64).prop_map(|p| ("power", power(p), None)),
        Just(("cone", vec![("slope", 0.3, PURE)], None)),
        Just((
            "paraboloid",
            vec![("curvature", 1.0, [-1.0, 0.0, 0.0])],
            None
        )),
        with_tip("hyperboloid"),
        with_tip("round-tipped-cone"),
        (1.0..2.0_f64, 2.0..4.0_f64).prop_map(|(low, high)| {
            let terms = vec![power(low), power(high)];
            ("superposition", Vec::new(), Some(("terms", terms)))
        }),
    ]
}

fn material() -> impl Strategy<Value = Table> {
    let of_two = |kind: &'static str| {
        let keys = |tau| {
            vec![
                ("shear_modulus", 1.0, STRESS),
                ("viscosity", tau, VISCOSITY),
            ]
        };
        decades(2.0).prop_map(move |tau| (kind, keys(tau), None))
    };
    let branch = (decades(2.0), decades(3.0)).prop_map(|(modulus, tau)| {
        vec![("modulus", modulus, STRESS), ("relaxation_time", tau, TIME)]
    });
    prop_oneof![
        Just(("viscous", vec![("viscosity", 1.0, VISCOSITY)], None)),
        Just(("elastic", vec![("shear_modulus", 1.0, STRESS)], None)),
        of_two("kelvin-voigt"),
        of_two("maxwell"),
        (decades(2.0), decades(2.0)).prop_map(|(modulus, tau)| {
            let keys = vec![
                ("equilibrium_modulus", 1.0, STRESS),
                ("maxwell_modulus", modulus, STRESS),
                ("viscosity", modulus * tau, VISCOSITY),
            ];
            ("standard-solid", keys, None)
        }),
        prop::collection::vec(branch, 1..4).prop_map(|branches| {
            let spring = vec![("equilibrium_modulus", 1.0, STRESS)];
            ("prony", spring, Some(("branches", branches)))
        }),
    ]
}

/// The line of a quantity in other units.
fn line((key, value, powers): &Quantity, units: [f64; 3]) -> String {
    let factors = units
        .iter()
        .zip(powers)
        .map(|(unit, power)| unit.powf(*power));
    format!("{key} = {:?}", value * factors.product::<f64>())
}

fn toml((kind, keys, list): &Table, units: [f64; 3]) -> String {
    let lines = |keys: &[Quantity]| keys.iter().map(|key| line(key, units)).collect::<Vec<_>>();
    let list = list.iter().map(|(name, elements)| {
        let elements = elements
            .iter()
            .map(|keys| format!("{{ {} }}", lines(keys).join(", ")));
        format!("\n{name} = [{}]", elements.collect::<Vec<_>>().join(", "))
    });
    format!(
        "{kind}]\n{}{}\n",
        lines(keys).join("\n"),
        list.collect::<String>()
    )
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 100,
        rng_seed: RngSeed::Fixed(2014),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn any_scene_is_answered_to_its_error_in_any_units(
        (body, material) in (body(), material()),
        (poisson_ratio, depth, velocity) in (-0.9..=0.5_f64, decades(1.0), decades(2.0)),
        exponent in -6.0..-2.0_f64,
        units in [decades(6.0), decades(6.0), decades(6.0)],
    ) {
        let relative_error = 10.0_f64.powf(exponent);
        let file = folder("any-scene").join("scene.toml");
        let answer = |units: [f64; 3]| -> Value {
            let [depth, velocity] = [
                ("indentation_depth", depth, LENGTH),
                ("velocity", velocity, [1.0, 0.0, -1.0]),
            ].map(|quantity| line(&quantity, units));
            fs::write(&file, format!(
                "[indenter.{}[material.{}poisson_ratio = {poisson_ratio:?}\n[load]\n{depth}\n{velocity}\n\
                 [solve]\nmodel = \"line\"\nrelative_error = {relative_error:?}\n",
                toml(&body, units), toml(&material, units),
            )).expect("a scene");
            run_json(&[argument(&file)])
        };
        let [answer, scaled] = [[1.0; 3], units].map(answer);
        let [friction, error] = bar(&answer, "friction_coefficient");
        prop_assert!(friction >= 0.0 && error <= relative_error * friction, "{answer}");
        let [normal, tangential] = ["normal_force", "tangential_force"].map(|field| number(&answer, field));
        prop_assert!((tangential - friction * normal).abs() <= 4.0 * f64::EPSILON * tangential, "{answer}");
        prop_assert_eq!(&answer["method"], &scaled["method"], "the method depends on the units");
        let [same, other_error] = bar(&scaled, "friction_coefficient");
        // Both have their error, and the rounding of the units.
        let allowed = 2.0 * error + other_error + 1e-12 * friction;
        prop_assert!((same - friction).abs() <= allowed, "{same} in units {units:?} instead of {answer}");
    }
}
