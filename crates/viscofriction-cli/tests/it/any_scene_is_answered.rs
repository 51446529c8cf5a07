//! Random valid scenes over many decades are answered by the cheapest method of the one-dimensional model to the error asked
//! for, and alike in other units.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use viscofriction::Estimate;

use crate::support::{Folder, estimate, number};

/// A number whose unit is m^a Pa^b s^c, in the text of a scene.
fn quantity(value: f64, powers: [f64; 3]) -> String {
    let [a, b, c] = powers;
    format!("<{value:?} {a:?} {b:?} {c:?}>")
}

const LENGTH: [f64; 3] = [1.0, 0.0, 0.0];
const STRESS: [f64; 3] = [0.0, 1.0, 0.0];
const TIME: [f64; 3] = [0.0, 0.0, 1.0];
const VISCOSITY: [f64; 3] = [0.0, 1.0, 1.0];

/// The text in these units.
fn in_units(text: &str, units: [f64; 3]) -> String {
    let number = |word: &str| word.parse::<f64>().expect("a number");
    let mut parts = text.split(['<', '>']);
    let mut scene = parts.next().unwrap_or_default().to_owned();
    while let (Some(quantity), Some(rest)) = (parts.next(), parts.next()) {
        let numbers: Vec<f64> = quantity.split(' ').map(number).collect();
        let powers = units
            .iter()
            .zip(&numbers[1..])
            .map(|(unit, power)| unit.powf(*power));
        scene += &format!("{:?}{rest}", numbers[0] * powers.product::<f64>());
    }
    scene
}

fn decades(n: f64) -> impl Strategy<Value = f64> {
    (-n..n).prop_map(|exponent| 10.0_f64.powf(exponent))
}

/// c r^p with the coefficient 1 m^(1 − p).
fn power(p: f64) -> String {
    let coefficient = quantity(1.0, [1.0 - p, 0.0, 0.0]);
    format!("{{ coefficient = {coefficient}, exponent = {p:?} }}")
}

fn body() -> impl Strategy<Value = String> {
    let with_tip = |kind: &'static str| {
        let length = |tip| quantity(tip, LENGTH);
        decades(1.0)
            .prop_map(move |tip| format!("{kind} = {{ radius = {}, slope = 0.7 }}", length(tip)))
    };
    prop_oneof![
        (0.75..4.0_f64).prop_map(|p| format!("power = {}", power(p))),
        Just("cone.slope = 0.3".to_owned()),
        Just(format!(
            "paraboloid.curvature = {}",
            quantity(1.0, [-1.0, 0.0, 0.0])
        )),
        with_tip("hyperboloid"),
        with_tip("round-tipped-cone"),
        (1.0..2.0_f64, 2.0..4.0_f64).prop_map(|(low, high)| {
            format!("superposition.terms = [{}, {}]", power(low), power(high))
        }),
    ]
}

fn material() -> impl Strategy<Value = String> {
    let modulus = |value| quantity(value, STRESS);
    let viscosity = |value| quantity(value, VISCOSITY);
    let of_two = move |kind: &'static str| {
        let keys = move |tau| {
            format!(
                "shear_modulus = {}, viscosity = {}",
                modulus(1.0),
                viscosity(tau)
            )
        };
        decades(2.0).prop_map(move |tau| format!("{kind} = {{ {}", keys(tau)))
    };
    let branch = (decades(2.0), decades(3.0)).prop_map(move |(value, tau)| {
        let time = quantity(tau, TIME);
        format!(
            "{{ modulus = {}, relaxation_time = {time} }}",
            modulus(value)
        )
    });
    prop_oneof![
        Just(format!("viscous = {{ viscosity = {}", viscosity(1.0))),
        Just(format!("elastic = {{ shear_modulus = {}", modulus(1.0))),
        of_two("kelvin-voigt"),
        of_two("maxwell"),
        (decades(2.0), decades(2.0)).prop_map(move |(spring, tau)| {
            let [equilibrium, maxwell] = [1.0, spring].map(modulus);
            let dashpot = viscosity(spring * tau);
            format!("standard-solid = {{ equilibrium_modulus = {equilibrium}, maxwell_modulus = {maxwell}, viscosity = {dashpot}")
        }),
        prop::collection::vec(branch, 1..4).prop_map(move |branches| {
            let branches = branches.join(", ");
            format!("prony = {{ equilibrium_modulus = {}, branches = [{branches}]", modulus(1.0))
        }),
    ]
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
        let [depth, velocity] = [quantity(depth, LENGTH), quantity(velocity, [1.0, 0.0, -1.0])];
        let body = format!("indenter.{body}");
        let material = format!("material.{material}, poisson_ratio = {poisson_ratio:?} }}");
        let load = format!("indentation_depth = {depth}, velocity = {velocity}");
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
