//! Every committed scene is answered, with the parts of its error bar, and written into files.

use std::fs;

use serde_json::Value;

use crate::support::{Folder, argument, assert_close, estimate, number, scene, table};

#[test]
fn every_committed_scene_is_answered() {
    let folder = Folder::new("committed");
    let mut scenes = folder.names(&argument("IN/"));
    scenes.retain(|name| name.ends_with(".toml"));
    assert!(scenes.len() >= 12, "only {} scenes", scenes.len());
    for scene in scenes {
        let result = folder.json(&format!("IN/{scene}"));
        assert!(number(&result, "normal_force") > 0.0, "{scene}: {result}");
        let answered = ["friction_coefficient", "indentation_depth", "contact_area"];
        let is_answered = answered.iter().any(|field| result[*field].is_number());
        assert!(is_answered, "{scene}: {result}");
        assert_bar_is_its_parts(&result);
    }
}

/// Besides the parts there is rounding, of 1e-11 of the value at most.
fn assert_bar_is_its_parts(result: &Value) {
    let bars = ["friction_coefficient", "indentation_depth", "normal_force"];
    let error = |field: &str| result[format!("{field}_error")].as_f64();
    // What is given has an error of 0.
    let found = bars.iter().find(|field| error(field) > Some(0.0));
    let Some(field) = found.or(bars.iter().find(|field| error(field).is_some())) else {
        let is_line = result["indentation_depth"].is_null();
        assert!(is_line, "only a line contact has no bar: {result}");
        return;
    };
    let Some(parts) = result["error_parts"].as_object() else {
        let is_closed = result["method"] == "analytic";
        assert!(is_closed, "only closed forms have no parts: {result}");
        return;
    };
    let bar = estimate(result, field);
    let sum: f64 = parts.values().filter_map(Value::as_f64).sum();
    let allowed = -1e-12 * bar.error..=1.1e-11 * bar.value.abs();
    let is_sum = allowed.contains(&(bar.error - sum));
    assert!(is_sum, "the parts add up to {sum:e}: {result}");
}

#[test]
fn each_method_names_the_parts_that_it_has() {
    let folder = Folder::new("parts-of-bars");
    let maxwell = "paraboloid; maxwell; normal_force = 1, velocity = 0.05; elements = 64";
    folder.write("maxwell.toml", scene(maxwell));
    for [line, expected] in table("parts of bars") {
        let result = folder.json(&line);
        assert_bar_is_its_parts(&result);
        let parts = result["error_parts"].as_object();
        let names = parts.map(|parts| parts.keys().cloned().collect::<Vec<_>>());
        assert_eq!(names.unwrap_or_default().join(" "), expected, "{line}");
    }
}

#[test]
fn an_answer_names_what_has_no_part_in_it() {
    let folder = Folder::new("not-modelled");
    for [parts, expected] in table("not modelled") {
        let answer = folder.answer(&parts);
        let words = answer["not_modelled"].as_array().expect("a list");
        let words: Vec<&str> = words.iter().filter_map(Value::as_str).collect();
        assert_eq!(words.join(", "), expected, "{parts}");
        let printed = folder.done("run scene.toml").stdout;
        let line = format!("\nnot modelled: {expected}\n");
        assert!(printed.contains(&line), "{printed}");
    }
}

#[test]
fn a_material_that_is_viscous_by_another_name_is_the_same() {
    let folder = Folder::new("another-name");
    // 2 (1 − ν) = 2 halves the viscosity that the surface feels.
    let prony = "material.prony = { equilibrium_modulus = 0.0, viscosity = 2.0e4, poisson_ratio = 0.0, branches = [] }";
    let [viscous, prony] = ["viscous", prony].map(|material| {
        let scene = "normal_force = 1.0, velocity = 0.01; model = \"line\"";
        folder.answer(&format!("paraboloid; {material}; {scene}"))
    });
    for field in ["friction_coefficient", "indentation_depth"] {
        assert_close(field, number(&prony, field), number(&viscous, field), 1e-14);
    }
}

#[test]
fn files_read_back_to_the_same_numbers() {
    let folder = Folder::new("files-of-run");
    let printed = folder.json("IN/half-space-run-in.toml --out .");
    let file: Value = serde_json::from_str(&folder.text("result.json")).expect("JSON");
    assert_eq!(file, printed, "result.json is what was printed");
    let npy = fs::read(folder.path("pressure.npy")).expect("pressure.npy");
    let header = usize::from(npy[8]) + 256 * usize::from(npy[9]) + 10;
    assert_eq!(header % 64, 0, "the header is padded");
    let (values, rest) = npy[header..].as_chunks();
    let values = values.iter().map(|bytes| f64::from_le_bytes(*bytes));
    assert!(rest.is_empty(), "whole numbers");
    let same = values.eq(folder.column("pressure.csv", 2));
    assert!(same, "NPY and CSV hold the same field");
}

/// Fields, histories and pictures of every method that has them.
#[test]
fn every_method_writes_the_files_of_what_it_knows() {
    for [line, written] in table("written") {
        let folder = Folder::new("files-of-method");
        let closed = "cone; viscous; normal_force = 1.0, velocity = 0.01; model = \"line\"";
        folder.write("line.toml", scene(closed));
        folder.json(&format!("{line} --out out"));
        let mut names = folder.names("out");
        for name in &names {
            let data = fs::metadata(folder.path("out").join(name)).expect("a file");
            assert!(data.len() > 50, "{line}: {name}: {data:?}");
        }
        names.retain(|name| name != "result.json");
        assert_eq!(names.join(" "), written, "{line}");
        assert!(folder.path("out/result.json").exists(), "{line}: no result");
    }
}

#[test]
fn what_could_not_be_reached_ends_with_status_1_and_says_how_far_it_came() {
    // A short way is quick on the finest grid.
    let replaced = [
        ("elements = 12", "relative_error = 1e-6"),
        ("3.0e-2", "2.0e-3"),
    ];
    let folder = Folder::with("unreachable", "half-space-run-in.toml", &replaced);
    let needed = "was not reached to the relative error 1e-6";
    let said = folder.ends("run scene.toml --out out", 1, needed);
    let refused = said.stderr.contains(": it is 0.");
    let friction = said.stdout.contains("| friction coefficient | 0.");
    let says_so = said
        .stdout
        .contains("\nnot reached: the friction coefficient was not reached");
    assert!(refused && friction && says_so, "{said:?}");
    // What was reached has its fields, as an answer has them.
    let written = folder.names("out").join(" ");
    assert!(
        written.contains("history.csv") && written.contains("pressure.csv"),
        "{written}"
    );
    let result: Value = serde_json::from_str(&folder.text("out/result.json")).expect("JSON");
    let [value, error] = ["friction_coefficient", "friction_coefficient_error"];
    let bar = number(&result, error) / number(&result, value);
    assert!((1e-6..1.0).contains(&bar), "{result}");
    assert!(result["not_reached"].is_string(), "{result}");
}

#[test]
fn a_quantity_that_overflows_ends_with_status_1_and_its_name() {
    let folder = Folder::new("overflow");
    for [parts, needed] in table("overflows") {
        folder.write("scene.toml", scene(&parts));
        let said = folder.ends("run --format json scene.toml", 1, &needed);
        assert_eq!(said.stdout, "", "{parts}");
    }
}

#[test]
fn a_line_that_could_not_be_reached_says_how_far_it_came_too() {
    let folder = Folder::new("unreachable-line");
    let sphere = "[indenter.sphere]\nradius = 5e-3\n[load]\nnormal_force = 2.0\nvelocity = 0.1\n";
    let solid = "[material.kelvin-voigt]\nshear_modulus = 1e6\nviscosity = 1e3\n";
    let solve = "[solve]\nmethod = \"mdr-steady\"\nrelative_error = 1e-14\n";
    folder.write("scene.toml", format!("{sphere}{solid}{solve}"));
    let said = folder.ends(
        "run scene.toml --out out",
        1,
        "relative error asked for is 1e-14",
    );
    let holds = said.stdout.contains("| friction coefficient | 0.")
        && said.stdout.contains("\nnot reached: ");
    assert!(
        holds && folder.names("out").join(" ").contains("line_load.csv"),
        "{said:?}"
    );
}
