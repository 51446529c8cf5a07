//! A contact that grows once and shrinks once on a layer is answered by theory, any other one by boundary elements.

use viscofriction::numerics::SilentProgress;
use viscofriction::scene::Method;
use viscofriction::solve::{Answer, plan};
use viscofriction::{Problem, Scene};

/// A ball on a layer; the history goes through `values` every half second.
fn scene(poisson_ratio: f64, thickness: f64, quantity: &str, values: &[f64]) -> Scene {
    let points = values.iter().enumerate();
    let points =
        points.map(|(k, value)| format!("{{ time = {}, {quantity} = {value:e} }}", 0.5 * k as f64));
    let history = points.collect::<Vec<_>>().join(", ");
    let text = format!(
        "[indenter.paraboloid]\ncurvature = 1e5\n[material.standard-solid]\nequilibrium_modulus = 1e3\nmaxwell_modulus = 3e3\n\
         viscosity = 1e3\npoisson_ratio = {poisson_ratio}\n[layer]\nthickness = {thickness:e}\n[load]\nhistory = [{history}]\n\
         [solve]\nrelative_error = 5e-3"
    );
    text.parse().expect("a scene")
}

fn solved(scene: &Scene, method: Option<Method>) -> Answer {
    let mut scene = scene.clone();
    scene.solve.method = method;
    let problem = Problem::try_from(&scene).expect("a problem");
    let plan = plan(&problem).expect("a plan");
    plan.solve(&SilentProgress).expect("an answer")
}

/// Both methods share the factor M(s) and no solution.
#[test]
fn theory_and_elements_agree_on_the_way_in_and_back() {
    let depths = [0.0, 0.6e-6, 1e-6, 1e-6, 0.7e-6, 0.2e-6, -1e-6];
    let forces = [0.0, 1e-9, 2e-9, 2e-9, 1e-9, 0.0];
    let by_depth = ("indentation_depth", &depths[..]);
    let by_force = ("normal_force", &forces[..]);
    for (nu, thickness, histories) in [
        (0.3, 1e-6, &[by_depth][..]),
        (0.45, 1e-5, &[by_force]),
        (0.5, 3e-6, &[by_depth, by_force]),
    ] {
        for &(quantity, values) in histories {
            let scene = scene(nu, thickness, quantity, values);
            let theory = solved(&scene, None);
            assert_eq!(theory.method, Method::Analytic, "{quantity}");
            let elements = solved(&scene, Some(Method::BemTransient));
            for name in ["normal_force", "indentation_depth"] {
                let [one, other] = [&theory, &elements]
                    .map(|answer| answer.fields.curve.column(name).expect("a column"));
                let allowed = one.error() + other.error();
                for (one, other) in one.values.iter().zip(&other.values) {
                    let off = (one.value - other.value).abs();
                    assert!(
                        off <= allowed,
                        "{name}: {one:?} and {other:?}, ν = {nu}, t = {thickness}"
                    );
                }
                assert!(one.error() <= 1.01 * 5e-3 * one.largest(), "{name}");
            }
        }
    }
}

/// At 4e-4 elements are within 1e-4 of the largest force, on the way in, where the depth is held, and on the way back.
#[test]
fn theory_is_what_fine_elements_tend_to() {
    let depths = [0.0, 1e-6, 1e-6, 0.6e-6];
    let mut scene = scene(0.3, 2e-6, "indentation_depth", &depths);
    scene.solve.relative_error = Some(4e-4);
    let [theory, elements] = [Method::Analytic, Method::BemTransient].map(|method| {
        let answer = solved(&scene, Some(method));
        let force = answer.fields.curve.column("normal_force");
        force.cloned().expect("a column")
    });
    let allowed = 1e-4 * theory.largest();
    for (one, other) in theory.values.iter().zip(&elements.values) {
        let off = (one.value - other.value).abs();
        assert!(off <= allowed, "{one:?} and {other:?}");
    }
}

#[test]
fn what_presses_again_is_left_to_elements() {
    for (quantity, values) in [
        ("indentation_depth", [0.0, 1e-6, 0.5e-6, 1e-6]),
        ("indentation_depth", [0.0, 1e-6, 0.5e-6, 0.5e-6]),
        ("normal_force", [0.0, 4e-9, 1e-9, 1e-9]),
    ] {
        let scene = scene(0.5, 3e-6, quantity, &values);
        let problem = Problem::try_from(&scene).expect("a problem");
        let method = plan(&problem).expect("a plan").method();
        assert_eq!(method, Method::BemTransient, "{values:?}");
        let mut named = scene.clone();
        named.solve.method = Some(Method::Analytic);
        let problem = Problem::try_from(&named).expect("a problem");
        let refused = plan(&problem).expect_err("it is refused").to_string();
        assert!(refused.contains("grows once and shrinks once"), "{refused}");
    }
}

/// A layer of a million contacts is the half space.
#[test]
fn a_thick_layer_is_the_half_space() {
    let on = |thickness| scene(0.3, thickness, "indentation_depth", &[0.0, 1e-6, 0.9e-6]);
    let mut half_space = on(1.0);
    half_space.layer = None;
    let [one, other] = [on(3.0), half_space].map(|scene| solved(&scene, None));
    for name in ["normal_force", "contact_radius"] {
        let [one, other] =
            [&one, &other].map(|answer| answer.fields.curve.column(name).expect("a column"));
        for (one, other) in one.values.iter().zip(&other.values) {
            let allowed = 2e-6 * other.value;
            assert!(
                (one.value - other.value).abs() <= allowed,
                "{name}: {one:?} and {other:?}"
            );
        }
    }
}

/// Relaxation times over six decades within the one interval of a history, in which errors by the steps in time fall more slowly
/// than their order says; scene 36 of `cargo xtask evidence agreement --seed 20261213`.
#[test]
fn the_bar_of_a_springpot_holds_on_few_steps() {
    let text = "indenter.cone.slope = 0.029189057825337362\n\
        layer.thickness = 140730742.01693648\nsolve.relative_error = 0.1\n\
        [material.springpot]\ncoefficient = 1.760994856448425e-15\nexponent = 0.38212923088485745\n\
        equilibrium_modulus = 8.391053445477731e-17\ntime_range = [548.8869871669446, 548886987.1669445]\n\
        poisson_ratio = -0.11694634620543654\n\
        [load]\nhistory = [{ time = 0.0, indentation_depth = 0.0 }, { time = 329939.44005375425, indentation_depth = 1847119.4930112348 }]";
    let scene: Scene = text.parse().expect("a scene");
    let [theory, elements] =
        [None, Some(Method::BemTransient)].map(|method| solved(&scene, method).normal_force);
    let off = (theory.value - elements.value).abs();
    assert!(
        off <= theory.error + elements.error,
        "{theory:?} and {elements:?}"
    );
}
