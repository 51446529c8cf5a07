//! Scenes with a reciprocating motion, or one through points.

use viscofriction::scene::Scene;
use viscofriction::{Answer, Problem, plan, solve};

use crate::sensitivities::Told;

const BALL: &str = "[indenter.sphere]\nradius = 5e-3\n[material.standard-solid]\nequilibrium_modulus = 1e6\n\
    maxwell_modulus = 1e7\nviscosity = 1e5\n";

fn problem(load: &str, solved: &str) -> Result<Problem, String> {
    let text = format!("{BALL}[load]\n{load}\n[solve]\n{solved}\n");
    let scene: Scene = text.parse().map_err(|error| format!("{error:?}"))?;
    Problem::try_from(&scene).map_err(|error| error.to_string())
}

fn answer(load: &str, solved: &str) -> Result<Answer, String> {
    solve(&problem(load, solved)?).map_err(|error| error.to_string())
}

fn line(load: &str, error: f64) -> Answer {
    let solved = format!("model = \"line\"\nrelative_error = {error}");
    answer(load, &solved).expect("an answer")
}

#[test]
fn a_cycle_has_its_loop_and_its_energy() {
    let answer = line("normal_force = 2.0\nstroke = 5e-3\nfrequency = 2.0", 1e-2);
    let friction = answer.friction_coefficient.expect("friction");
    let energy = answer.dissipated_energy.expect("energy");
    let expected = friction.value * 2.0 * 2.0 * 5e-3;
    let error = (energy.value / expected - 1.0).abs();
    assert!(error < 1e-9, "{energy:?}, expected {expected}");
    let json = serde_json::to_value(&answer).expect("JSON");
    let motion = json["motion"].as_array().expect("a list");
    let loop_area: f64 = motion
        .windows(2)
        .map(|pair| {
            let of = |row: &serde_json::Value, name: &str| row[name].as_f64().expect("a number");
            let force = [0, 1].map(|k| of(&pair[k], "tangential_force"));
            let moved = of(&pair[1], "position") - of(&pair[0], "position");
            0.5 * (force[0] + force[1]) * moved
        })
        .sum();
    assert!(
        (loop_area / energy.value - 1.0).abs() < 0.02,
        "{loop_area} and {energy:?}"
    );
    assert!(
        json["motion_error"]["tangential_force"].as_f64() > Some(0.0),
        "{json}"
    );
}

#[test]
fn the_end_of_a_long_path_is_steady_sliding() {
    let path = "normal_force = 2.0\nmotion = [{ time = 1.0, position = 0.5 }, { time = 1.4, position = 0.54 }]";
    let moved = line(path, 1e-3);
    let steady = line("normal_force = 2.0\nvelocity = 0.1", 1e-6);
    let last = moved
        .fields
        .curve
        .column("tangential_force")
        .expect("forces");
    let last = last.values.last().expect("a point");
    let expected = steady.tangential_force().expect("a force").value;
    assert!(
        (last.value - expected).abs() <= last.error,
        "{last:?}, expected {expected}"
    );
}

#[test]
fn points_with_forces_of_their_own_lift_the_body() {
    let points = "motion = [{ time = 0.0, position = 0.0, indentation_depth = 5e-5 }, \
        { time = 0.1, position = 0.01, indentation_depth = 5e-5 }, \
        { time = 0.2, position = 0.01, indentation_depth = -1e-5 }, \
        { time = 0.3, position = 0.0, indentation_depth = 5e-5 }]";
    let moved = line(points, 1e-2);
    let forces = &moved
        .fields
        .curve
        .column("normal_force")
        .expect("forces")
        .values;
    let lifted = forces.iter().filter(|force| force.value == 0.0).count();
    assert!(lifted > 2, "{forces:?}");
}

/// The one-dimensional model dissipates more than the half space, and both as much as they should.
#[test]
fn the_half_space_follows_motions_too() {
    let load = "normal_force = 2.0\nstroke = 2e-3\nfrequency = 2.0";
    let half_space = answer(load, "elements = 8").expect("an answer");
    let friction = |answer: &Answer| answer.friction_coefficient.expect("friction");
    let [got, on_line] = [friction(&half_space), friction(&line(load, 1e-2))];
    assert!(got.error < 0.1 * got.value, "{got:?}");
    let ratio = on_line.value / got.value;
    assert!((1.0..2.0).contains(&ratio), "{on_line:?} over {got:?}");
    let refused = answer(
        load,
        "relative_error = 1e-3\nmethod = \"mdr-transient\"\nmodel = \"half-space\"",
    );
    assert!(
        refused
            .expect_err("another model")
            .contains("one-dimensional model"),
        "named"
    );
}

#[test]
fn on_a_track_the_body_meets_what_it_has_left() {
    let straight = line("normal_force = 2.0\nvelocity = 0.1", 1e-3);
    let depth = |answer: &Answer| answer.indentation_depth.expect("a depth").value;
    let mut before = depth(&straight);
    for track in [0.03, 0.01, 3e-3] {
        let load = format!("normal_force = 2.0\nvelocity = 0.1\ntrack = {track}");
        let again = depth(&line(&load, 1e-3));
        assert!(again > before, "{track}: {again} after {before}");
        before = again;
    }
    let load = "normal_force = 2.0\nvelocity = 0.1\ntrack = 0.03";
    for (load, solved, said) in [
        (
            load,
            "method = \"bem-transient\"",
            "mdr-steady and bem-steady do",
        ),
        (
            load,
            "model = \"line\"\nmethod = \"mdr-transient\"",
            "mdr-steady and bem-steady do",
        ),
        (
            "normal_force = 2.0\nvelocity = 0.1\ntrack = 1e-3",
            "model = \"line\"",
            "give a longer load.track",
        ),
        (
            "normal_force = 2.0\nvelocity = 0.1\ntrack = 5e-3",
            "relative_error = 0.01",
            "give a longer load.track",
        ),
        (
            load,
            "model = \"line\"\nsliding_distance = 1.0",
            "load.track",
        ),
    ] {
        let refused = answer(load, solved).expect_err(load);
        assert!(refused.contains(said), "{load} with {solved}: {refused}");
    }
}

#[test]
fn what_no_motion_serves_is_refused_by_name() {
    let stroke = "normal_force = 2.0\nstroke = 5e-3\nfrequency = 2.0";
    for (load, solved, said) in [
        (stroke, "method = \"bem-steady\"", "any"),
        (stroke, "method = \"mdr-steady\"", "constant speed"),
        (
            "normal_force = 2.0\nstroke = 5e4\nfrequency = 2.0",
            "model = \"line\"",
            "shorten its path",
        ),
    ] {
        let refused = answer(load, solved).expect_err(load);
        assert!(refused.contains(said), "{load} with {solved}: {refused}");
    }
}

/// Body and material of a rough surface with another load.
fn rough_answer(load: &str, solved: &str) -> Result<Answer, String> {
    let road = include_str!("../../../../examples/scenes/rough-road.toml");
    let (body, _) = road.split_once("[load]").expect("a load");
    let scene = format!("{body}[load]\n{load}\n{solved}\n");
    let scene: Scene = scene.parse().map_err(|error| format!("{error:?}"))?;
    let problem = Problem::try_from(&scene).map_err(|error| error.to_string())?;
    solve(&problem).map_err(|error| error.to_string())
}

/// All gaps are closed.
const CLOSED: &str = "mean_pressure = 1e8\nstroke = 5e-3\nfrequency = 2.0";

#[test]
fn periodic_surfaces_move_too() {
    let full = rough_answer(CLOSED, "[solve]\nrelative_error = 1e-6").expect("a cycle");
    let friction = full.friction_coefficient.expect("friction").value;
    let energy = full.dissipated_energy.expect("energy").value;
    assert!(
        (energy / (friction * 1e4 * 1e-2) - 1.0).abs() < 1e-12,
        "{energy}"
    );
    assert!(
        full.indentation_depth.is_none(),
        "{:?}",
        full.indentation_depth
    );
    let layer = "[layer]\nthickness = 1e-3\n[solve]\nrelative_error = 1e-6";
    let layer = rough_answer(CLOSED, layer)
        .expect("a cycle")
        .indentation_depth;
    assert!(layer.is_some_and(|depth| depth.value >= 0.0), "{layer:?}");
}

#[test]
fn what_no_motion_of_a_periodic_surface_serves_is_refused_by_name() {
    for (load, solved, said) in [
        (
            "normal_force = 2.0\nstroke = 5e-3\nfrequency = 2.0",
            "",
            "takes a mean_pressure",
        ),
        (CLOSED, "[solve]\nmethod = \"bem-steady\"", "any"),
        (
            CLOSED,
            "[solve]\nmethod = \"mdr-transient\"",
            "body of revolution",
        ),
        (CLOSED, "[solve]\nelements = 16", "at least"),
        (
            "motion = [{ time = 0.0, position = 0.0, normal_force = 1.0 }, { time = 1.0, position = 1e-3, normal_force = 1.0 }]",
            "",
            "load.motion: a periodic surface is pressed by load.mean_pressure",
        ),
        (
            "mean_pressure = 1e5\nstroke = 5e3\nfrequency = 2.0",
            "",
            "shortest waves of a periodic surface",
        ),
    ] {
        let refused = rough_answer(load, solved).expect_err(load);
        assert!(refused.contains(said), "{load} with {solved}: {refused}");
    }
}

/// A cycle takes up to a minute, and may be one of a hundred.
#[test]
fn steps_of_a_cycle_tell_how_far_it_is() {
    let load = "normal_force = 2.0\nstroke = 2e-3\nfrequency = 2.0";
    let problem = problem(load, "method = \"bem-transient\"\nelements = 8").expect("a problem");
    let told = Told::default();
    let solved = plan(&problem).expect("a plan").solve(&told);
    assert!(solved.is_ok(), "{solved:?}");
    let n_told = told.0.into_inner().expect("parts").len();
    assert!(n_told > 100, "{n_told} parts are told");
}
