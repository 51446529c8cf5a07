//! The half space at a depth, on any material, and under a height map, against closed forms and from method to method.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::support::{argument, bar, folder, number, run_json};

const PARABOLOID: &str = "[indenter.paraboloid]\ncurvature = 50\n";
const ELASTIC: &str = "[material.elastic]\nshear_modulus = 1e6\npoisson_ratio = 0.3\n";
const SOLID: &str = "[material.standard-solid]\nequilibrium_modulus = 1e6\nmaxwell_modulus = 2e6\nviscosity = 2e3\n";
const VISCOUS: &str = "[material.viscous]\nviscosity = 1e4\n";

/// A scene of its parts, in a folder of this name.
fn scene(name: &str, [body, material, load, solve]: [&str; 4]) -> PathBuf {
    let path = folder(name).join("scene.toml");
    write(&path, [body, material, load, solve]);
    path
}

fn write(path: &Path, [body, material, load, solve]: [&str; 4]) {
    let text = format!("{body}{material}[load]\n{load}[solve]\n{solve}");
    fs::write(path, text).expect("a scene");
}

fn answer(name: &str, parts: [&str; 4]) -> Value {
    run_json(&[argument(&scene(name, parts))])
}

fn agree(name: &str, [one, one_error]: [f64; 2], [other, other_error]: [f64; 2]) {
    assert!(
        (one - other).abs() <= one_error + other_error && one_error + other_error < 0.1 * one.abs(),
        "{name}: {one} ± {one_error} and {other} ± {other_error}"
    );
}

/// F = (4/3) E* √R d^(3/2) with R = 10 mm, G = 1 MPa, ν = 0.3 and d = 0.1 mm (Hertz), pressed and sliding.
#[test]
fn elastic_contact_at_a_depth_has_the_force_of_hertz_and_no_friction() {
    let effective = 2.0 * 1.0e6 / (1.0 - 0.3);
    let depth: f64 = 1e-4;
    let expected = 4.0 / 3.0 * effective * 0.1 * depth.powf(1.5);
    for (load, solve) in [
        (
            "velocity = 0\n",
            "method = \"bem-transient\"\nduration = 3\nrelative_error = 1e-2\n",
        ),
        (
            "velocity = 0.1\n",
            "method = \"bem-steady\"\nrelative_error = 1e-3\n",
        ),
        (
            "velocity = 0.1\n",
            "method = \"bem-steady\"\nelements = 24\n",
        ),
        (
            "velocity = 0.1\n",
            "method = \"bem-transient\"\nelements = 12\nsliding_distance = 1e-3\n",
        ),
    ] {
        let load = format!("indentation_depth = {depth:?}\n{load}");
        let result = answer("hertz-depth", [PARABOLOID, ELASTIC, &load, solve]);
        agree(solve, bar(&result, "normal_force"), [expected, 0.0]);
        if let Some(friction) = result["friction_coefficient"].as_f64() {
            let error = number(&result, "friction_coefficient_error");
            // The slope at the rim is 0.1.
            assert!(
                friction.abs() <= error && error < 1e-6,
                "{solve}: {friction} ± {error}"
            );
        }
    }
}

/// A force that has relaxed: F(t)/F(∞) = G(t)/G(∞), on a solid of which a third of the modulus stays.
#[test]
fn a_depth_that_is_held_relaxes_like_the_modulus() {
    let solve = "method = \"bem-transient\"\nduration = 1e-3\nelements = 16\n";
    let load = "indentation_depth = 1e-4\nvelocity = 0\n";
    let elements = answer("relaxing", [PARABOLOID, SOLID, load, solve]);
    let closed = "method = \"analytic\"\nduration = 1e-3\n";
    let exact = answer("relaxing", [PARABOLOID, SOLID, load, closed]);
    agree(
        "force",
        bar(&elements, "normal_force"),
        [number(&exact, "normal_force"), 0.0],
    );
}

/// The depth of a force is the depth at which that force is found.
#[test]
fn force_and_depth_lead_to_each_other() {
    for (name, material, distance) in [
        ("solid", SOLID, ""),
        ("viscous", VISCOUS, "sliding_distance = 1.0\n"),
    ] {
        let solve = format!("method = \"bem-steady\"\nrelative_error = 2e-3\n{distance}");
        let load = "indentation_depth = 1e-4\nvelocity = 0.05\n";
        let held = answer("held", [PARABOLOID, material, load, &solve]);
        let [force, force_error] = bar(&held, "normal_force");
        let load = format!("normal_force = {force:?}\nvelocity = 0.05\n");
        let pressed = answer("pressed", [PARABOLOID, material, &load, &solve]);
        let [of_depth, of_force] =
            [&held, &pressed].map(|result| bar(result, "friction_coefficient"));
        // The friction grows slower than the force.
        let share = of_depth[0] * force_error / force;
        agree(name, of_depth, [of_force[0], of_force[1] + share]);
        // The depth under a force is that of one grid, which is off by less than the force by twice the error asked for.
        let depth = number(&pressed, "indentation_depth");
        assert!(
            (depth / 1e-4 - 1.0).abs() < 1e-2,
            "{name}: {depth} instead of 1e-4"
        );
    }
}

/// μ and F of the stationary state, from first touch on and at once.
#[test]
fn a_march_on_a_solid_arrives_at_its_stationary_state() {
    for (load, way) in [
        ("normal_force = 1.0\nvelocity = 0.5\n", ""),
        (
            "indentation_depth = 1e-4\nvelocity = 0.5\n",
            "sliding_distance = 1e-2\n",
        ),
    ] {
        let march = format!("method = \"bem-transient\"\nelements = 16\n{way}");
        let march = answer("solid-march", [PARABOLOID, SOLID, load, &march]);
        let direct = "method = \"bem-steady\"\nrelative_error = 1e-2\n";
        let direct = answer("solid-direct", [PARABOLOID, SOLID, load, direct]);
        let [march_bar, direct_bar] = [&march, &direct].map(|r| bar(r, "friction_coefficient"));
        agree(load, march_bar, direct_bar);
        let [force, expected] = [&march, &direct].map(|result| number(result, "normal_force"));
        assert!(
            (force / expected - 1.0).abs() < 3e-2,
            "{load}: {force} instead of {expected}"
        );
    }
}

/// Heights of a paraboloid on a grid of 0.4 mm, up to 11 mm from the tip, which lies off the middle.
fn map() -> (PathBuf, String) {
    let folder = folder("map");
    let row = |row: i32| {
        let height = |column: i32| {
            let [x, y] = [row - 30, column - 28].map(|index| 4e-4 * f64::from(index));
            format!("{:?}", 0.3 + 50.0 * (x * x + y * y))
        };
        (0..57).map(height).collect::<Vec<_>>().join(",")
    };
    let rows: Vec<String> = (0..59).map(row).collect();
    fs::write(folder.join("map.csv"), rows.join("\n")).expect("a map");
    let body = "[indenter.height-map]\nfile = \"map.csv\"\nspacing = [4e-4, 4e-4]\n";
    (folder.join("scene.toml"), body.to_owned())
}

/// Bilinear heights lie at most c p²/2 above the paraboloid c r²: relative to the height at the contact radius a, and with
/// it friction, force and depth, by less than (p/a)², which is 1e-2 for a = 4 mm.
#[test]
fn a_map_of_a_paraboloid_is_the_paraboloid() {
    let (path, body) = map();
    let load = "normal_force = 1.0\nvelocity = 0.01\n";
    let run = |parts: [&str; 4]| {
        write(&path, parts);
        run_json(&[argument(&path)])
    };
    let by_table = "model = \"half-space\"\n";
    let exact = run([PARABOLOID, VISCOUS, load, by_table]);
    let [friction, exact_error] = bar(&exact, "friction_coefficient");
    let expected = [friction, exact_error + 1e-2 * friction];
    for solve in [
        "relative_error = 1e-2\n",
        "method = \"bem-steady\"\nelements = 24\n",
        "method = \"bem-transient\"\nelements = 12\n",
    ] {
        let result = run([&body, VISCOUS, load, solve]);
        agree(solve, bar(&result, "friction_coefficient"), expected);
    }
    let soft = "[material.elastic]\nshear_modulus = 5e3\n";
    for (load, field) in [
        ("normal_force = 1.0\nvelocity = 0\n", "indentation_depth"),
        ("indentation_depth = 1e-3\nvelocity = 0\n", "normal_force"),
    ] {
        let exact = run([PARABOLOID, soft, load, "duration = 1\n"]);
        let result = run([&body, soft, load, "duration = 1\nrelative_error = 1e-2\n"]);
        assert_eq!(result["method"], "bem-transient", "{result}");
        let expected = number(&exact, field);
        agree(field, bar(&result, field), [expected, 1e-2 * expected]);
    }
}
