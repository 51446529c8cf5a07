//! Scenes with a cylinder are answered per length, as in closed form, and refused where a line contact has no answer.

use std::f64::consts::PI;
use std::fs;

use crate::support::{argument, example, folder, number, run_json, text, viscofriction};

/// Hunter's closed form for γ = 0.1 and z = l/(vτ) = 2 (casebook, VIS-04).
const LOAD: f64 = 6.61211679922975;
const FRICTION: f64 = 1.16237190576151;

/// A contact of the half length l = 1 mm under a cylinder of R = 0.1 m, with G₁ = 0.1 MPa and τ = 1 ms.
fn hunter(solve: &str) -> String {
    let force = LOAD * PI * 1e5 * 1e-6 / 0.1;
    format!(
        "[indenter.cylinder]\nradius = 0.1\n\
         [material.standard-solid]\nequilibrium_modulus = 1e5\nmaxwell_modulus = 1e6\nviscosity = 1e3\n\
         [load]\nnormal_force = {force:?}\nvelocity = 0.5\n[solve]\n{solve}"
    )
}

#[test]
fn a_sliding_cylinder_has_the_friction_of_hunter() {
    let path = folder("hunter").join("scene.toml");
    let expected = FRICTION * 1e-3 / 0.1;
    for solve in ["relative_error = 1e-4\n", "elements = 200\n"] {
        fs::write(&path, hunter(solve)).expect("a scene");
        let result = run_json(&[argument(&path)]);
        assert_eq!(result["method"], "bem-steady", "{result}");
        let friction = number(&result, "friction_coefficient");
        let error = number(&result, "friction_coefficient_error");
        assert!(
            (friction - expected).abs() <= error && error < 2e-2 * expected,
            "{solve}: {friction} ± {error} instead of {expected}"
        );
        // One element at either end.
        let width = number(&result, "contact_area");
        assert!((width / 2e-3 - 1.0).abs() < 0.05, "{solve}: {result}");
        assert!(result["indentation_depth"].is_null(), "{result}");
    }
}

/// b = √(4 F' R/(π E*)) and p₀ = 2 F'/(π b) with E* = 2 G/(1 − ν).
#[test]
fn a_pressed_cylinder_is_that_of_hertz() {
    let result = run_json(&[argument(&example("cylinder-hertz.toml"))]);
    let [force, radius, effective] = [2000.0, 0.01, 2e6 / 0.7];
    let half_width = (4.0 * force * radius / (PI * effective)).sqrt();
    for (field, expected) in [
        ("contact_area", 2.0 * half_width),
        ("peak_pressure", 2.0 * force / (PI * half_width)),
        ("normal_force", force),
    ] {
        let value = number(&result, field);
        assert!(
            (value / expected - 1.0).abs() < 1e-14,
            "{field}: {value} instead of {expected}"
        );
    }
}

#[test]
fn units_per_length_are_printed_and_the_pressure_is_written() {
    let out = folder("line-contact").join("out");
    let scene = example("cylinder-solid.toml");
    let output = viscofriction(&["run", argument(&scene), "--out", argument(&out)]);
    let printed = text(&output.stdout);
    assert!(
        printed.contains("N/m") && printed.contains("m²/m"),
        "{printed}"
    );
    let csv = fs::read_to_string(out.join("line_pressure.csv")).expect("a pressure");
    let row = |line: &str| -> Vec<f64> {
        let cells = line.split(',');
        cells.map(|cell| cell.parse().expect("a number")).collect()
    };
    let rows: Vec<Vec<f64>> = csv.lines().skip(1).map(row).collect();
    let spacing = rows[1][0] - rows[0][0];
    let force: f64 = rows.iter().map(|row| row[1] * spacing).sum();
    assert!((force / 2000.0 - 1.0).abs() < 1e-9, "{force} of 2000 N/m");
}
