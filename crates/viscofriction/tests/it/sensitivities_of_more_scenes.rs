//! Derivatives of height maps by their spacing, of slow sliding, and where the cheapest method has none.

use std::path::Path;

use numerics::{Estimate, SilentProgress};
use viscofriction::scene::Method;
use viscofriction::solve::with_sensitivity;
use viscofriction::{Answer, Problem, Scene, WrongInput, solve};

use crate::sensitivities::{answered, no_file, of};

/// Bumps of two sizes, 24 × 24 heights in micrometres; the last row and column are not the first ones.
pub(crate) fn bumps(_: &Path, _: u64) -> Result<Vec<u8>, WrongInput> {
    let wave =
        |index: usize, number: f64| (number * index as f64 * std::f64::consts::TAU / 24.0).sin();
    let height = |row: usize, column: usize| {
        let coarse = wave(row, 1.0) * wave(column + 3, 1.0);
        format!(
            "{:.6}",
            10.0 * coarse + 3.0 * wave(row + 2, 2.0) * wave(column, 3.0)
        )
    };
    let line = |row: usize| {
        (0..24)
            .map(|column| height(row, column))
            .collect::<Vec<_>>()
    };
    let lines: Vec<String> = (0..24).map(|row| line(row).join(",")).collect();
    Ok(lines.join("\n").into())
}

/// The spacing along each axis stretches the waves; the differences are those of answers 5 per cent to both sides.
#[test]
fn derivatives_by_the_spacing_of_a_height_map_are_those_of_answers() {
    const WIDTH: f64 = 0.05;
    for edges in ["periodic", "mirrored"] {
        let scene = |factors: [f64; 2]| -> Scene {
            let [dx, dy] = factors.map(|factor| 1e-4 * factor);
            let text = format!(
                "[indenter.height-map]\nfile = \"map.csv\"\nunit = \"um\"\nspacing = [{dx}, {dy}]\nedges = \"{edges}\"\n\
                 [material.standard-solid]\nequilibrium_modulus = 1e6\nmaxwell_modulus = 9e6\nviscosity = 9e4\n\
                 [load]\nmean_pressure = 4e4\nvelocity = 0.02\n[solve]\nelements = 192"
            );
            text.parse().expect("a scene")
        };
        let problem = |scene: &Scene| Problem::new(scene, Path::new(""), bumps).expect("a problem");
        let solved = |factors: [f64; 2]| solve(&problem(&scene(factors))).expect("an answer");
        let middle = scene([1.0; 2]);
        let files = (Path::new(""), bumps as _);
        let answer = solved([1.0; 2]);
        let known = with_sensitivity(&middle, files, &problem(&middle), answer, &SilentProgress);
        let known = known.expect("derivatives").sensitivity;
        for axis in 0..2 {
            let one = of(&known, &format!("indenter.height-map.spacing[{axis}]"));
            let ends = [-WIDTH, WIDTH].map(|step| {
                let mut factors = [1.0; 2];
                factors[axis] = step.exp();
                solved(factors)
            });
            let friction = |answer: &Answer| answer.friction_coefficient;
            let area = |answer: &Answer| answer.contact_area;
            type Quantity<'a> = &'a dyn Fn(&Answer) -> Option<Estimate>;
            let quantities: [(Option<Estimate>, Quantity<'_>); 2] = [
                (one.derivatives.of("friction_coefficient"), &friction),
                (one.derivatives.of("contact_area"), &area),
            ];
            for (known, quantity) in quantities {
                let known = known.expect("a derivative");
                let [low, high] = ends.each_ref().map(|end| quantity(end).expect("a value"));
                let expected = (high.value / low.value).ln() / (2.0 * WIDTH);
                let of_bars = [low, high].map(|end| end.error / end.value);
                let allowed = known.error + (of_bars[0] + of_bars[1]) / (2.0 * WIDTH);
                let off = (known.value - expected).abs();
                assert!(
                    off <= allowed.min(0.1),
                    "{edges}, axis {axis}: {known:?} and not {expected}, allowed {allowed}"
                );
            }
        }
    }
}

/// Powers of a friction that has no unit add up to nothing in the units of stress, length and time.
#[test]
fn slow_sliding_has_derivatives_of_its_closed_form() {
    let text = "indenter.paraboloid.curvature = 5.0\n\
                material.standard-solid = { equilibrium_modulus = 1e6, maxwell_modulus = 9e6, viscosity = 9e4 }\n\
                load = { normal_force = 2.0, velocity = 1e-5 }";
    let (answer, known) = answered(text);
    assert_eq!(answer.method, Method::Analytic, "{answer:?}");
    let known = known.expect("derivatives");
    let friction = |name: &str| {
        of(&known, name)
            .derivatives
            .of("friction_coefficient")
            .expect("a derivative")
    };
    let [equilibrium, maxwell, viscosity] = ["equilibrium_modulus", "maxwell_modulus", "viscosity"]
        .map(|name| friction(&format!("material.standard-solid.{name}")));
    let [force, velocity] =
        ["normal_force", "velocity"].map(|name| friction(&format!("load.{name}")));
    let curvature = friction("indenter.paraboloid.curvature");
    let sums = [
        (
            "stress",
            equilibrium.value + maxwell.value + viscosity.value + force.value,
        ),
        (
            "length",
            2.0 * force.value + velocity.value - curvature.value,
        ),
        ("time", viscosity.value - velocity.value),
    ];
    for (unit, sum) in sums {
        assert!(
            sum.abs() < 1e-7,
            "powers of the unit of {unit} add up to {sum:e}"
        );
    }
    // To first order the friction is in proportion to the speed, and to second order it falls behind.
    let behind = 1.0 - velocity.value;
    let is_behind = (1e-5..1e-3).contains(&behind) && velocity.error < 0.01 * behind;
    assert!(is_behind, "{velocity:?}");
}

/// The table of s(p) has none, and boundary elements take its place, unless the scene names it.
#[test]
fn a_method_with_derivatives_takes_the_place_of_one_without() {
    let text = "indenter.cone.slope = 0.1\nmaterial.viscous.viscosity = 3e3\n\
                load = { normal_force = 1.0, velocity = 0.1 }\nsolve.relative_error = 1e-2";
    let scene: Scene = text.parse().expect("a scene");
    let problem = Problem::try_from(&scene).expect("a problem");
    let answer = solve(&problem).expect("an answer");
    assert_eq!(answer.method, Method::Analytic, "the cheapest");
    let files = (Path::new(""), no_file as _);
    let known = with_sensitivity(&scene, files, &problem, answer.clone(), &SilentProgress)
        .expect("derivatives");
    assert_eq!(known.method, Method::BemSteady, "one with derivatives");
    let frictions = [answer, known].map(|answer| answer.friction_coefficient.expect("a friction"));
    let off = (frictions[0].value - frictions[1].value).abs();
    assert!(
        off <= frictions[0].error + frictions[1].error,
        "{frictions:?}"
    );
    let (_, named) = answered(&format!("{text}\nsolve.method = \"analytic\""));
    let refused = named.expect_err("it names its method").to_string();
    assert!(
        refused.contains("analytic knows no derivatives"),
        "{refused}"
    );
}

/// Its neighbours, a part in 10⁵ away, are the number itself.
#[test]
fn derivatives_by_a_number_too_small_to_be_changed_are_left_out() {
    let text = "indenter.superposition.terms = [{ coefficient = 5e-324, exponent = 2.0 }, { coefficient = 1e4, exponent = 4.0 }]\n\
                material.prony = { equilibrium_modulus = 1e6, branches = [{ modulus = 4e6, relaxation_time = 1e-3 }] }\n\
                load = { normal_force = 5.0, velocity = 0.02 }\nsolve = { method = \"bem-steady\", elements = 8 }";
    let (_, known) = answered(text);
    let known = known.expect("derivatives");
    let of_smallest = of(&known, "indenter.superposition.terms[0].coefficient");
    assert!(of_smallest.derivatives.is_empty(), "{of_smallest:?}");
}
