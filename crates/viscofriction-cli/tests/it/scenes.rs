//! Answers are printed, and written into files.

use std::fs;

use serde_json::Value;
use viscofriction_cli::{InputKind, check_input};

use crate::support::{Folder, assert_close, number, scene, table};

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
    let printed = folder.json("IN/press-hold-pull-press.toml --out curve");
    let rows = printed["history"].as_array().expect("a history");
    let forces: Vec<f64> = rows.iter().map(|row| number(row, "normal_force")).collect();
    assert_eq!(folder.column("curve/history.csv", 1), forces, "forces");
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
        let of_all = ["report.html", "result.json"];
        names.retain(|name| !of_all.contains(&&name[..]));
        assert_eq!(names.join(" "), written, "{line}");
        for name in of_all {
            assert!(folder.path("out").join(name).exists(), "{line}: no {name}");
        }
    }
}

/// What a browser shows of an answer, read as XML.
#[test]
fn a_report_is_one_page_that_needs_no_other_file() {
    let folder = Folder::new("report");
    let command = "IN/sphere-standard-solid.toml --sensitivity --spectral-sensitivity";
    let answer = folder.json(&format!("{command} --out a&b"));
    let page = fs::read_to_string(folder.path("a&b/report.html")).expect("a page");
    let options = roxmltree::ParsingOptions {
        allow_dtd: true,
        ..roxmltree::ParsingOptions::default()
    };
    let page = roxmltree::Document::parse_with_options(&page, options).expect("a page");
    let text: String = page.descendants().filter_map(|node| node.text()).collect();
    let friction = answer["friction_coefficient"].as_f64().expect("a friction");
    for part in [
        "A sphere slides over a standard solid material",
        &format!("{friction:.7} ± "),
        "speed v [m/s]",
        "material.standard-solid.viscosity",
        "adhesion",
        "'a&b'",
    ] {
        assert!(text.contains(part), "{part}");
    }
    let pictures = page
        .descendants()
        .filter(|node| node.has_tag_name("figure"));
    assert_eq!(pictures.count(), 3, "pressure, gap and frequencies");
    // Maps are images inside the page.
    let is_inside = |link: &str| link.starts_with('#') || link.starts_with("data:");
    let mut attributes = page.descendants().flat_map(|node| node.attributes());
    let other =
        attributes.find(|one| ["src", "href"].contains(&one.name()) && !is_inside(one.value()));
    assert!(other.is_none(), "{other:?}");
}

/// Paths of all values of a scene.
fn paths(table: &toml::Table) -> Vec<String> {
    let below = |(key, value): (&String, &toml::Value)| match value.as_table() {
        Some(table) => paths(table)
            .iter()
            .map(|path| format!("{key}.{path}"))
            .collect(),
        None => vec![key.clone()],
    };
    table.iter().flat_map(below).collect()
}

#[test]
fn a_report_has_every_key_of_the_scene() {
    let text = "[indenter.sphere]\nradius = 5e-3\n[material.elastic]\nshear_modulus = 1e6\n[interface.constant]\nshear_strength = \
                1e5\n[heat]\nconductivity = 0.25\ndiffusivity = 1.2e-7\ncounterface = { share = 0.5 }\n[load]\nnormal_force = 1.0\nvelocity = \
                0.1\n[solve]\nrelative_error = 0.1\n[uncertainty]\n\"load.normal_force\" = 0.1\n";
    let folder = Folder::new("keys of a report");
    folder.write("scene.toml", text);
    folder.json("scene.toml --out out");
    let page = fs::read_to_string(folder.path("out/report.html")).expect("a page");
    let scene: toml::Table = text.parse().expect("a scene");
    for path in paths(&scene) {
        assert!(page.contains(&path), "no {path} in the report");
    }
    assert!(page.contains("conductivity [W/m/K]"), "the unit");
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
    let friction = said.stdout.contains("friction coefficient    0.");
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
fn a_line_that_could_not_be_reached_says_how_far_it_came_too() {
    let folder = Folder::new("unreachable-line");
    let sphere = "[indenter.sphere]\nradius = 5e-3\n[load]\nnormal_force = 2.0\nvelocity = 0.1\n";
    let solid = "[material.kelvin-voigt]\nshear_modulus = 1e6\nviscosity = 1e3\n";
    let solve = "[solve]\nmethod = \"mdr-steady\"\nrelative_error = 1e-14\n";
    folder.write("scene.toml", format!("{sphere}{solid}{solve}"));
    let said = folder.ends(
        "run scene.toml --out out",
        1,
        "was not reached to the relative error 1e-14",
    );
    let holds = said.stdout.contains("friction coefficient   0.")
        && said.stdout.contains("\nnot reached: ");
    assert!(
        holds && folder.names("out").join(" ").contains("line_load.csv"),
        "{said:?}"
    );
}

#[test]
fn a_history_that_is_not_reached_is_printed_and_kept_with_its_bars() {
    let folder = Folder::new("unreached-history");
    let text = |solve: &str| {
        format!(
            "load.history = [{{ time = 0, normal_force = 0 }}, {{ time = 1, normal_force = 0.02 }}]
indenter.paraboloid.curvature = 0.5
material.standard-solid = {{ equilibrium_modulus = 1.0, maxwell_modulus = 4.0, viscosity = 4.0 }}\n{solve}\n"
        )
    };
    let limited =
        "solve = { method = \"bem-transient\", relative_error = 1e-4, max_memory = \"4 MiB\" }";
    folder.write("scene.toml", text(limited));
    folder.write("exact.toml", text(""));
    let reason = "the indentation depth [m] was not reached to the relative error 1e-4";
    let said = folder.ends("run scene.toml --out out", 1, reason);
    for printed in [
        "\nindentation depth       0.0",
        &format!("\nnot reached: {reason}"),
    ] {
        assert!(said.stdout.contains(printed), "no {printed} in {said:?}");
    }
    let result: Value = serde_json::from_str(&folder.text("out/result.json")).expect("JSON");
    let bar = number(&result["history_error"], "indentation_depth");
    let written = folder.column("out/history.csv", 3)[1];
    let exact = number(
        &folder.json("exact.toml")["history"][1],
        "indentation_depth",
    );
    let off = (written - exact).abs();
    assert!(
        off <= bar && bar > 1e-4 * exact,
        "{written} and {exact}, bar {bar:e}"
    );
}

#[test]
fn units_per_length_are_printed_and_the_pressure_is_written() {
    let folder = Folder::new("line-contact");
    let said = folder.done("run IN/cylinder-solid.toml --out out");
    for unit in ["N/m", "m²/m"] {
        assert!(said.stdout.contains(unit), "no {unit} in {}", said.stdout);
    }
    let [x, pressure] = [0, 1].map(|column| folder.column("out/line_pressure.csv", column));
    let force = (x[1] - x[0]) * pressure.iter().sum::<f64>();
    assert_close("force of 2000 N/m", force, 2000.0, 1e-9);
}

/// The pressure of an answer as the heights of a body: whatever is written can be read.
#[test]
fn what_is_written_for_numpy_is_a_height_map() {
    let folder = Folder::new("numpy-written");
    folder.json("IN/tread.toml --out .");
    let file = folder.path("pressure.npy");
    let contents = fs::read(&file).expect("a pressure");
    let checked = check_input(InputKind::HeightMap, &file, &contents);
    assert_eq!(checked, Ok(()), "{}", file.display());
}
