//! Random valid scenes over many decades are answered by the cheapest method to the error asked for, and alike in other
//! units.

use std::fs;
use std::path::Path;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use serde_json::Value;

use crate::support::{argument, folder, run_json};

/// One unit of length \[m], stress \[Pa] and time \[s].
type Units = [f64; 3];

/// A scene in units of its own.
#[derive(Debug, Clone)]
struct Scene {
    body: Body,
    material: Material,
    poisson_ratio: f64,
    depth: f64,
    velocity: f64,
    relative_error: f64,
}

#[derive(Debug, Clone)]
enum Body {
    Power(f64),
    Cone,
    Paraboloid,
    Hyperboloid(f64),
    RoundTippedCone(f64),
    Superposition(f64, f64),
}

#[derive(Debug, Clone)]
enum Material {
    Viscous,
    Elastic,
    KelvinVoigt(f64),
    Maxwell(f64),
    StandardSolid(f64, f64),
    Prony(Vec<(f64, f64)>),
}

fn decades(n: f64) -> impl Strategy<Value = f64> {
    (-n..n).prop_map(|exponent| 10.0_f64.powf(exponent))
}

fn body() -> impl Strategy<Value = Body> {
    prop_oneof![
        (0.75..4.0_f64).prop_map(Body::Power),
        Just(Body::Cone),
        Just(Body::Paraboloid),
        decades(1.0).prop_map(Body::Hyperboloid),
        decades(1.0).prop_map(Body::RoundTippedCone),
        (1.0..2.0_f64, 2.0..4.0_f64).prop_map(|(low, high)| Body::Superposition(low, high)),
    ]
}

fn material() -> impl Strategy<Value = Material> {
    prop_oneof![
        Just(Material::Viscous),
        Just(Material::Elastic),
        decades(2.0).prop_map(Material::KelvinVoigt),
        decades(2.0).prop_map(Material::Maxwell),
        (decades(2.0), decades(2.0))
            .prop_map(|(modulus, tau)| Material::StandardSolid(modulus, tau)),
        prop::collection::vec((decades(2.0), decades(3.0)), 1..4).prop_map(Material::Prony),
    ]
}

fn scene() -> impl Strategy<Value = Scene> {
    let numbers = (-0.9..=0.5_f64, decades(1.0), decades(2.0), -6.0..-2.0_f64);
    (body(), material(), numbers).prop_map(|(body, material, numbers)| Scene {
        body,
        material,
        poisson_ratio: numbers.0,
        depth: numbers.1,
        velocity: numbers.2,
        relative_error: 10.0_f64.powf(numbers.3),
    })
}

impl Body {
    fn toml(&self, length: f64) -> String {
        let coefficient = |p: f64| length.powf(1.0 - p);
        match self {
            Self::Power(p) => format!(
                "power]\ncoefficient = {:?}\nexponent = {p:?}",
                coefficient(*p)
            ),
            Self::Cone => "cone]\nslope = 0.3".to_owned(),
            Self::Paraboloid => format!("paraboloid]\ncurvature = {:?}", 1.0 / length),
            Self::Hyperboloid(tip) => {
                format!("hyperboloid]\nradius = {:?}\nslope = 0.7", tip * length)
            }
            Self::RoundTippedCone(tip) => {
                format!(
                    "round-tipped-cone]\nradius = {:?}\nslope = 0.7",
                    tip * length
                )
            }
            Self::Superposition(low, high) => {
                let term =
                    |p: f64| format!("{{ coefficient = {:?}, exponent = {p:?} }}", coefficient(p));
                format!("superposition]\nterms = [{}, {}]", term(*low), term(*high))
            }
        }
    }
}

impl Material {
    fn toml(&self, stress: f64, time: f64) -> String {
        let modulus = format!("shear_modulus = {stress:?}");
        let viscosity = |tau: f64| format!("viscosity = {:?}", tau * stress * time);
        match self {
            Self::Viscous => format!("viscous]\n{}", viscosity(1.0)),
            Self::Elastic => format!("elastic]\n{modulus}"),
            Self::KelvinVoigt(tau) => format!("kelvin-voigt]\n{modulus}\n{}", viscosity(*tau)),
            Self::Maxwell(tau) => format!("maxwell]\n{modulus}\n{}", viscosity(*tau)),
            Self::StandardSolid(glassy, tau) => format!(
                "standard-solid]\nequilibrium_modulus = {stress:?}\nmaxwell_modulus = {:?}\n{}",
                glassy * stress,
                viscosity(glassy * tau)
            ),
            Self::Prony(branches) => {
                let branch = |(modulus, tau): &(f64, f64)| {
                    let [modulus, tau] = [modulus * stress, tau * time];
                    format!("{{ modulus = {modulus:?}, relaxation_time = {tau:?} }}")
                };
                let branches: Vec<String> = branches.iter().map(branch).collect();
                format!(
                    "prony]\nequilibrium_modulus = {stress:?}\nbranches = [{}]",
                    branches.join(", ")
                )
            }
        }
    }
}

impl Scene {
    fn toml(&self, [length, stress, time]: Units) -> String {
        let Self {
            poisson_ratio,
            relative_error,
            ..
        } = self;
        format!(
            "[indenter.{}\n[material.{}\npoisson_ratio = {poisson_ratio:?}\n[load]\nindentation_depth = {:?}\n\
             velocity = {:?}\n[solve]\nrelative_error = {relative_error:?}\n",
            self.body.toml(length),
            self.material.toml(stress, time),
            self.depth * length,
            self.velocity * length / time,
        )
    }

    fn answer(&self, file: &Path, units: Units) -> Value {
        fs::write(file, self.toml(units)).expect("a scene");
        run_json(&[argument(file)])
    }
}

fn number(answer: &Value, field: &str) -> f64 {
    let value = answer[field].as_f64().filter(|value| value.is_finite());
    value.unwrap_or_else(|| panic!("{field} of {answer}"))
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
        scene in scene(), units in [decades(6.0), decades(6.0), decades(6.0)],
    ) {
        let file = folder("any-scene").join("scene.toml");
        let [answer, scaled] = [[1.0; 3], units].map(|units| scene.answer(&file, units));
        let friction = number(&answer, "friction_coefficient");
        let error = number(&answer, "friction_coefficient_error");
        prop_assert!(friction >= 0.0 && error <= scene.relative_error * friction, "{answer}");
        let [normal, tangential] = ["normal_force", "tangential_force"].map(|field| number(&answer, field));
        prop_assert!((tangential - friction * normal).abs() <= 4.0 * f64::EPSILON * tangential, "{answer}");
        prop_assert_eq!(&answer["method"], &scaled["method"], "the method depends on the units");
        let same = number(&scaled, "friction_coefficient");
        // Both have their error, and the rounding of the units.
        let allowed = 2.0 * error + number(&scaled, "friction_coefficient_error") + 1e-12 * friction;
        prop_assert!((same - friction).abs() <= allowed, "{same} in units {units:?} instead of {answer}");
    }
}
