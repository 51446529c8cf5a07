//! Histories of depth and force, in a scene and in a file, against casebook-2.json (11 and 14 digits), and those of what is
//! held.

use std::f64::consts::PI;

use serde_json::Value;

use crate::support::{Folder, assert_close, number};

/// A ball of 1 m on a solid of G∞ = 1 Pa with one branch of 4 Pa and 1 s.
const BALL: &str = "indenter.paraboloid.curvature = 0.5
material.standard-solid = { equilibrium_modulus = 1.0, maxwell_modulus = 4.0, viscosity = 4.0 }";

fn scene(load: &str, more: &str) -> String {
    format!("load = {{ {load} }}\n{BALL}\n{more}\n")
}

/// One quantity at all points.
fn column(result: &Value, name: &str) -> Vec<f64> {
    let rows = result["history"].as_array().expect("a history");
    rows.iter().map(|row| number(row, name)).collect()
}

/// Boundary elements follow a history to one part in a thousand of its largest value.
fn assert_elements_agree(folder: &Folder, scene: &str, name: &str, expected: &[f64]) {
    let largest = expected.iter().copied().fold(0.0, f64::max);
    let elements = folder.json(&format!("{scene} --method bem-transient"));
    let bar = number(&elements["history_error"], name);
    assert!(bar <= 1e-3 * largest, "bar {bar:e} of {name}");
    for (found, expected) in column(&elements, name).iter().zip(expected) {
        let off = (found - expected).abs();
        assert!(off <= bar, "{name} {found} is off by {off:e}, bar {bar:e}");
    }
}

const TABLE: &str = "time_s,indentation_depth_m\n0,0\n1,0.01\n1.15,0.0085\n1.3,0.007\n1.5,0.009\n2.1,0.015\n2.3,0.013\n";

#[test]
fn a_surface_that_has_not_recovered_is_pressed_again() {
    let folder = Folder::new("histories");
    let file = scene("history_file = \"table.csv\"", "");
    folder.write("table.csv", TABLE);
    folder.write("file.toml", &file);
    let points = TABLE.lines().skip(1).map(|row| {
        let (time, depth) = row.split_once(',').expect("two columns");
        format!("{{ time = {time}, indentation_depth = {depth} }}")
    });
    let points: Vec<String> = points.collect();
    let inline = format!("history = [{}]", points.join(", "));
    folder.write("inline.toml", scene(&inline, "solve.model = \"line\""));
    let expected = [
        0.0,
        0.020114789112124724,
        0.012640425201550915,
        0.006649398554322738,
        0.012478303405807521,
        0.03011547928571352,
        0.01772452165822294,
    ];
    let [of_file, of_scene] = ["file.toml", "inline.toml"].map(|scene| folder.json(scene));
    let forces = column(&of_file, "normal_force");
    assert_eq!(forces, column(&of_scene, "normal_force"), "both ways");
    for (force, expected) in forces.iter().zip(expected) {
        let off = (force - expected).abs();
        assert!(off <= 1e-11 * 0.03, "{force}, expected {expected}");
    }
    let radius = column(&of_file, "contact_radius")[4];
    assert_close("contact radius", radius, 0.0944593877313644, 1e-11);
    let last = number(&of_file, "normal_force");
    assert_close("last force", last, expected[6], 1e-11);
    assert_elements_agree(&folder, "file.toml", "normal_force", &expected);
    let bars = &of_file["history_error"];
    let bar = number(bars, "normal_force");
    assert!(bar > 0.0 && bar < 1e-12, "bar {bar:e}");
    assert_eq!(bars["indentation_depth"], 0.0, "the depth is given");
}

#[test]
fn a_force_that_rises_gives_the_depth_of_theory() {
    let folder = Folder::new("force-histories");
    // The force jumps at 2 s.
    let history = [[0, 1], [1, 1], [2, 1], [2, 2], [20, 2]]
        .map(|[time, force]| format!("{{ time = {time}, normal_force = 0.0{force} }}"))
        .join(", ");
    folder.write("force.toml", scene(&format!("history = [{history}]"), ""));
    let depths = column(&folder.json("force.toml"), "indentation_depth");
    for (place, expected) in [(1, 0.007479854782350828), (4, 0.023842571351249137)] {
        assert_close("depth", depths[place], expected, 1e-11);
    }
    assert_elements_agree(&folder, "force.toml", "indentation_depth", &depths);
}

/// F = 16/3 G d^(3/2) (Hertz), with 1/J(t) or G(t) as the modulus G.
#[test]
fn what_is_held_has_the_history_and_the_pressure_of_hertz() {
    let folder = Folder::new("held");
    let depth = |time: f64| (3.0 / 16.0 * 0.01 * (1.0 - 0.8 * (-time / 5.0).exp())).powf(2.0 / 3.0);
    let force = |time: f64| 16.0 / 3.0 * (1.0 + 4.0 * (-time).exp()) * 0.001;
    let held: [(_, _, &dyn Fn(f64) -> f64); 2] = [
        ("normal_force", "indentation_depth", &depth),
        ("indentation_depth", "normal_force", &force),
    ];
    for (given, found, expected) in held {
        let load = format!("{given} = 0.01, velocity = 0");
        folder.write("held.toml", scene(&load, "solve.duration = 4.0"));
        let result = folder.json("held.toml");
        let [times, values] = ["time", found].map(|name| column(&result, name));
        let ends = (times.first(), times.last());
        assert_eq!(ends, (Some(&0.0), Some(&4.0)), "touch and duration");
        let end = number(&result, found);
        assert_eq!(values.last(), Some(&end), "{found} at the end");
        let bar = number(&result["history_error"], found);
        assert!(bar < 1e-9 * end, "bar {bar:e} of {found}");
        for (time, value) in times.into_iter().zip(values) {
            let off = (value - expected(time)).abs();
            assert!(off <= bar, "{found} {value} at {time} is off by {off:e}");
        }
    }
    let pressure = folder.solved("held.toml").answer.fields.line_pressure;
    assert_eq!(pressure.len(), 202, "places of the pressure");
    let peak = 1.5 * force(4.0) / (PI * 0.01);
    for [radius, pressure] in pressure {
        let root = (1.0 - radius * radius / 0.01).max(0.0).sqrt();
        let off = (pressure - peak * root).abs();
        // At the rim the root has half of the digits.
        assert!(
            off < 1e-7 * peak,
            "{pressure} at {radius} is off by {off:e}"
        );
    }
}
