//! Materials of one's own are series with a known error, which is in the bars of every answer.

use numerics::Estimate;
use rheology::PronyExpansion;
use rheology::fit::{
    Control, IdentifyOptions, MeasuredCurve, ModulusPoint, RelaxationPoint, expand, identify,
};
use viscofriction::{Problem, Scene, SolveError, solve};

/// The times that matter, \[s].
const TIMES: [f64; 2] = [1e-4, 1e3];

/// G(t) = G_∞ + G₁ e^(−(t/τ)^β) (Kohlrausch, Williams and Watts).
fn stretched(time: f64, beta: f64) -> f64 {
    1e6 + 1e7 * (-(time / 1e-2).powf(beta)).exp()
}

fn scene(load: &str, material: &PronyExpansion) -> Scene {
    let text =
        format!("indenter.sphere.radius = 5e-3\nmaterial.elastic.shear_modulus = 1e6\n{load}");
    let mut scene: Scene = text.parse().expect("a scene");
    scene.material = material.into();
    scene
}

/// Friction, or force, depth and area where nothing slides.
fn found(load: &str, material: &PronyExpansion) -> Vec<Estimate> {
    let problem = Problem::try_from(&scene(load, material)).expect("a problem");
    let answer = match solve(&problem) {
        Ok(answer) => answer,
        Err(SolveError::NotReached { answer, .. }) => *answer,
        Err(error) => panic!("{load}: {error}"),
    };
    if let Some(friction) = answer.friction_coefficient {
        return vec![friction];
    }
    let others = [
        Some(answer.normal_force),
        answer.indentation_depth,
        answer.contact_area,
    ];
    others.into_iter().flatten().collect()
}

const LOADS: [&str; 4] = [
    "load = { normal_force = 2.0, velocity = 0.1 }\nsolve = { model = \"line\", relative_error = 0.05 }",
    "load = { normal_force = 2.0, velocity = 0.1 }\nsolve = { elements = 24 }",
    "load = { normal_force = 2.0, velocity = 0.0 }\nsolve = { duration = 1.0, relative_error = 0.05 }",
    "load = { indentation_depth = 1e-5, velocity = 0.0 }\nsolve = { duration = 1.0, relative_error = 0.05 }",
];

/// The law as a function, and as tables of the relaxation modulus and, from a far better series, of the complex one.
fn series(beta: f64) -> [PronyExpansion; 3] {
    let fine = expand(&|time| stretched(time, beta), TIMES, 1e-6).expect("a series");
    let few = IdentifyOptions {
        control: Control::Branches(5),
        ..IdentifyOptions::default()
    };
    let times = (-32..=24).map(|k| 10_f64.powf(0.125 * f64::from(k)));
    let relaxing = times.clone().map(|time| RelaxationPoint {
        time,
        modulus: stretched(time, beta),
    });
    let oscillating = times.map(|angular_frequency| {
        let modulus = fine.spectrum.complex_modulus(angular_frequency);
        let modulus = modulus.expect("a modulus");
        ModulusPoint {
            angular_frequency,
            storage: modulus.storage,
            loss: modulus.loss,
        }
    });
    let curves = [
        MeasuredCurve::relaxation(relaxing.collect()),
        MeasuredCurve::oscillation(oscillating.collect()),
    ];
    let [of_relaxation, of_oscillation] = curves.map(|curve| {
        let found = identify(&curve.expect("a curve"), &few).expect("a series");
        PronyExpansion::from(found)
    });
    let coarse = expand(&|time| stretched(time, beta), TIMES, 1e-2).expect("a series");
    [coarse, of_relaxation, of_oscillation]
}

/// The error of the law is seen in the answers, and is in their bars.
#[test]
fn the_error_of_a_stretched_exponential_is_in_every_bar() {
    for beta in [0.3, 0.8] {
        let fine = expand(&|time| stretched(time, beta), TIMES, 1e-6).expect("a series");
        for coarse in series(beta) {
            let mut seen = 0;
            for load in LOADS {
                let [exact, other] = [&fine, &coarse].map(|material| found(load, material));
                for (exact, other) in exact.iter().zip(&other) {
                    let off = (exact.value - other.value).abs();
                    let said =
                        format!("β = {beta}, {load}: {other:?}, and {exact:?} of {coarse:?}");
                    assert!(off <= exact.error + other.error, "{said}");
                    // What is given has no error.
                    let error = coarse.relative_error * other.value;
                    assert!(other.error == 0.0 || other.error > error, "{said}");
                    seen += u32::from(off > 2.0 * exact.error);
                }
            }
            assert!(seen >= 3, "β = {beta}: the error is seen {seen} times only");
        }
    }
}

#[test]
fn a_stretched_exponential_has_friction_to_one_in_a_thousand() {
    let rubber = expand(&|time| stretched(time, 0.5), TIMES, 5e-5).expect("a series");
    let load = "load = { normal_force = 2.0, velocity = 0.1 }";
    let friction = |material: &PronyExpansion| {
        let problem = Problem::try_from(&scene(load, material)).expect("a problem");
        let answer = solve(&problem).expect("an answer");
        answer.friction_coefficient.expect("a friction")
    };
    let exact = expand(&|time| stretched(time, 0.5), TIMES, 1e-8).expect("a series");
    let [friction, exact] = [&rubber, &exact].map(friction);
    assert!(friction.is_within(1e-3), "{friction:?}");
    let off = (friction.value - exact.value).abs();
    assert!(
        off <= friction.error + exact.error,
        "{friction:?}, {exact:?}"
    );
}

/// The series is known for a range of times, and nothing is said of others.
#[test]
fn answers_beyond_the_range_are_refused() {
    let rubber = expand(&|time| stretched(time, 0.5), [1e-2, 1e3], 1e-5).expect("a series");
    let refused = |load: &str| {
        let problem =
            Problem::try_from(&scene(load, &rubber)).map_err(|error| error.to_string())?;
        solve(&problem).map_err(|error| error.to_string())
    };
    for (load, needed) in [
        ("load = { normal_force = 2.0, velocity = 10.0 }", "widen it"),
        (
            "load = { normal_force = 2.0, velocity = 0.0 }\nsolve.duration = 1e-3",
            "widen it",
        ),
        (
            "load = { indentation_depth = 1e-5, velocity = 0.1 }",
            "times beyond time_range of the material",
        ),
    ] {
        let said = refused(load).expect_err("it is beyond the range");
        assert!(said.contains(needed), "{load}: {said}");
    }
}
