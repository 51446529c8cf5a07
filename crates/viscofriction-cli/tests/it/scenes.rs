//! Every committed scene is answered, and answers agree across methods.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::support::{argument, bar, example, folder, number, run_json, text, viscofriction};

#[test]
fn every_committed_scene_is_answered() {
    let folder = fs::read_dir(example("")).expect("the scenes are there");
    let mut n_scenes = 0;
    for entry in folder {
        let path = entry.expect("an entry").path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            let result = run_json(&[argument(&path)]);
            assert!(number(&result, "normal_force") > 0.0, "{path:?}: {result}");
            let answered = ["friction_coefficient", "indentation_depth", "contact_area"];
            assert!(
                answered.iter().any(|field| result[*field].is_number()),
                "{path:?}: {result}"
            );
            assert_bar_is_its_parts(&result);
            n_scenes += 1;
        }
    }
    assert!(n_scenes >= 12, "only {n_scenes} scenes");
}

/// Besides the parts there is rounding, of 1e-11 of the value at most.
fn assert_bar_is_its_parts(result: &Value) {
    let bars = ["friction_coefficient", "indentation_depth", "normal_force"];
    let bar = bars.iter().find_map(|field| {
        let error = result[format!("{field}_error")].as_f64()?;
        Some([error, number(result, field)])
    });
    let Some([error, value]) = bar else {
        let depth = &result["indentation_depth"];
        assert!(
            depth.is_null(),
            "only a line contact has nothing with a bar: {result}"
        );
        return;
    };
    let Some(parts) = result["error_parts"].as_object() else {
        assert_eq!(
            result["method"], "analytic",
            "only closed forms have no parts: {result}"
        );
        return;
    };
    let sum: f64 = parts
        .keys()
        .map(|part| number(&result["error_parts"], part))
        .sum();
    let rounding = error - sum;
    assert!(
        rounding >= -1e-12 * error && rounding <= 1.1e-11 * value.abs(),
        "the parts add up to {sum:e}, and the bar is {error:e}: {result}"
    );
}

#[test]
fn each_method_names_the_parts_that_it_has() {
    let maxwell = folder("parts").join("maxwell.toml");
    let text = fs::read_to_string(example("maxwell-paraboloid.toml")).expect("a scene");
    fs::write(&maxwell, text + "\n[solve]\nelements = 64\n").expect("a scene");
    let parts = |scene: &Path, method: &str| {
        let result = run_json(&[argument(scene), "--method", method]);
        assert_bar_is_its_parts(&result);
        let parts = result["error_parts"].as_object().cloned();
        let names = parts.map(|parts| parts.keys().cloned().collect::<Vec<String>>());
        names.unwrap_or_default().join(" ")
    };
    let names = parts(&maxwell, "mdr-transient");
    assert_eq!(names, "discretisation time_stepping truncation", "a memory");
    for (scene, method, expected) in [
        ("cone-viscous", "analytic", ""),
        ("cone-viscous", "mdr-steady", "discretisation"),
        ("cone-viscous", "mdr-transient", "discretisation truncation"),
        ("cone-half-space", "bem-steady", "discretisation iteration"),
        (
            "half-space-run-in",
            "bem-transient",
            "discretisation iteration",
        ),
        ("hertz", "mdr-transient", "discretisation"),
        ("hertz", "bem-transient", "discretisation iteration"),
    ] {
        let names = parts(&example(&format!("{scene}.toml")), method);
        assert_eq!(names, expected, "{scene} by {method}");
    }
}

/// A committed scene on the one-dimensional model, in a folder of this name.
fn on_the_line(name: &str, scene: &str) -> PathBuf {
    let path = folder(name).join(scene);
    fs::copy(example("profile.csv"), path.with_file_name("profile.csv")).expect("a profile");
    let text = fs::read_to_string(example(scene)).expect("a scene");
    let text = text.replace("method = \"bem-transient\"", "method = \"mdr-transient\"");
    let table = if text.contains("[solve]") {
        ""
    } else {
        "\n[solve]"
    };
    let text = (text + table).replace("[solve]", "[solve]\nmodel = \"line\"");
    fs::write(&path, text).expect("a scene");
    path
}

#[test]
fn the_cone_of_the_paper_has_the_friction_of_equation_21() {
    let scene = on_the_line("equation-21", "cone-viscous.toml");
    for method in ["analytic", "mdr-steady", "mdr-transient"] {
        let result = run_json(&[argument(&scene), "--method", method]);
        let [value, error] = bar(&result, "friction_coefficient");
        let expected = 0.05 * std::f64::consts::PI;
        assert!(
            (value - expected).abs() <= error + 1e-15 && error < 1e-3 * expected,
            "{method}: {value} ± {error} instead of {expected}"
        );
        assert_eq!(result["method"], method, "{result}");
        assert_eq!(result["model"], "line", "{result}");
        assert!(
            result["contact_area"].is_null(),
            "a line has no area: {result}"
        );
    }
}

#[test]
fn a_material_that_is_viscous_by_another_name_is_the_same() {
    let folder = folder("another-name");
    let write = |name: &str, material: &str| {
        let path = folder.join(name);
        let text = format!(
            "[indenter.paraboloid]\ncurvature = 50.0\n{material}\n[load]\nnormal_force = 1.0\nvelocity = 0.01\n\
             [solve]\nmodel = \"line\"\n"
        );
        fs::write(&path, text).expect("a scene");
        run_json(&[argument(&path)])
    };
    let viscous = write("v.toml", "[material.viscous]\nviscosity = 1.0e4");
    // 2 (1 − ν) = 2 halves the viscosity that the surface feels.
    let prony = write(
        "p.toml",
        "[material.prony]\nequilibrium_modulus = 0.0\nviscosity = 2.0e4\npoisson_ratio = 0.0\nbranches = []",
    );
    for field in ["friction_coefficient", "indentation_depth"] {
        let [one, other] = [&viscous, &prony].map(|result| number(result, field));
        assert!(
            (one / other - 1.0).abs() < 1e-14,
            "{field}: {one} and {other}"
        );
    }
}

#[test]
fn error_bars_of_marches_hold_against_closed_forms() {
    for (scene, method, field) in [
        (
            "paraboloid-run-in.toml",
            "mdr-transient",
            "friction_coefficient",
        ),
        (
            "creep-by-elements.toml",
            "bem-transient",
            "indentation_depth",
        ),
        (
            "creep-by-elements.toml",
            "mdr-transient",
            "indentation_depth",
        ),
        (
            "measured-profile.toml",
            "mdr-transient",
            "indentation_depth",
        ),
    ] {
        let path = example(scene);
        let result = run_json(&[argument(&path), "--method", method]);
        let same_model = on_the_line("closed-form", scene);
        let exact = run_json(&[argument(&same_model), "--method", "analytic"]);
        assert_bar_holds(&result, number(&exact, field), (field, 1e-2));
    }
}

#[test]
fn the_bar_of_a_chain_with_memory_holds_against_the_closed_form() {
    let exact = run_json(&[argument(&on_the_line(
        "maxwell-exact",
        "maxwell-paraboloid.toml",
    ))]);
    let coarse = folder("maxwell").join("scene.toml");
    let text = fs::read_to_string(example("maxwell-paraboloid.toml")).expect("a scene");
    fs::write(&coarse, text + "\n[solve]\nelements = 128\n").expect("a scene");
    let result = run_json(&[argument(&coarse), "--method", "mdr-transient"]);
    let field = "friction_coefficient";
    assert_bar_holds(&result, number(&exact, field), (field, 0.1));
}

fn assert_bar_holds(result: &Value, expected: f64, (field, largest): (&str, f64)) {
    let [value, error] = bar(result, field);
    assert!(
        (value - expected).abs() <= error + 1e-10 * expected && error <= largest * expected,
        "{expected} instead of {result}"
    );
}

/// The finest value known of s(1), and of the stationary half space from the march in time.
#[test]
fn both_half_space_methods_and_the_table_agree_within_their_error_bars() {
    let scene = example("cone-half-space.toml");
    let march = folder("march").join("scene.toml");
    let text = fs::read_to_string(&scene).expect("the scene");
    let coarse = text.replace("relative_error = 1e-2", "elements = 12");
    fs::write(&march, coarse.replace("bem-steady", "bem-transient")).expect("a scene");
    let closed = folder("closed").join("scene.toml");
    let by_table = text.replace("method = \"bem-steady\"\n", "");
    fs::write(&closed, by_table).expect("a scene");
    let bars = [&scene, &march, &closed].map(|path| {
        let result = run_json(&[argument(path)]);
        assert_eq!(result["model"], "half-space", "{result}");
        bar(&result, "friction_coefficient")
    });
    for [value, error] in bars {
        let [expected, exact] = bars[2];
        assert!(
            (value - expected).abs() <= error + exact && error < 0.02 * expected,
            "{bars:?}"
        );
    }
}

/// Hertz with R = 10 mm, G = 1 MPa, ν = 0.3, F = 1 N: a³ = 3 F R/(4 E*), d = a²/R, p₀ = 3 F/(2 π a²).
#[test]
fn hertz_comes_out_as_in_the_textbook() {
    let result = run_json(&[argument(&example("hertz.toml"))]);
    let effective: f64 = 2.0 * 1.0e6 / (1.0 - 0.3);
    let radius = (0.75 * 0.01 / effective).cbrt();
    let area = std::f64::consts::PI * radius * radius;
    for (field, expected) in [
        ("indentation_depth", radius * radius / 0.01),
        ("contact_area", area),
        ("peak_pressure", 1.5 / area),
    ] {
        let value = number(&result, field);
        assert!(
            (value / expected - 1.0).abs() < 1e-9,
            "{field}: {value} instead of {expected}"
        );
    }
}

#[test]
fn files_read_back_to_the_same_numbers() {
    let out = folder("run-files");
    let scene = example("half-space-run-in.toml");
    let printed = run_json(&[argument(&scene), "--out", argument(&out)]);
    let file = fs::read_to_string(out.join("result.json")).expect("result.json");
    let file: Value = serde_json::from_str(&file).expect("JSON");
    assert_eq!(file, printed, "result.json is what was printed");
    let mut reader = csv::Reader::from_path(out.join("pressure.csv")).expect("pressure.csv");
    let pressures: Vec<f64> = reader
        .records()
        .map(|row| row.expect("a row")[2].parse().expect("a number"))
        .collect();
    let npy = fs::read(out.join("pressure.npy")).expect("pressure.npy");
    let header = usize::from(npy[8]) + 256 * usize::from(npy[9]) + 10;
    assert_eq!(header % 64, 0, "the header is padded");
    let values = npy[header..].chunks_exact(8);
    let values: Vec<f64> = values
        .map(|bytes| f64::from_le_bytes(bytes.try_into().expect("eight bytes")))
        .collect();
    assert_eq!(values, pressures, "NPY and CSV hold the same field");
}

/// Fields, histories and pictures of every method that has them.
#[test]
fn every_method_writes_the_files_of_what_it_knows() {
    let pressure =
        "pressure.csv pressure.npy pressure.png pressure.svg pressure_x.npy pressure_y.npy";
    let history = "history.csv history.png history.svg";
    let load = "line_load.csv line_load.npy line_load.png line_load.svg";
    let line_pressure = "line_pressure.csv line_pressure.npy line_pressure.png line_pressure.svg";
    for (scene, method, written) in [
        ("cone-half-space", "bem-steady", vec![pressure]),
        (
            "half-space-run-in",
            "bem-transient",
            vec![history, pressure],
        ),
        ("cone-viscous", "mdr-transient", vec![history]),
        ("cylinder-solid", "bem-steady", vec![line_pressure]),
        ("cone-viscous", "analytic", vec![load]),
    ] {
        let out = folder("files-of-method").join("out");
        let path = match method {
            "analytic" => on_the_line("files-of-line", &format!("{scene}.toml")),
            _ => example(&format!("{scene}.toml")),
        };
        run_json(&[argument(&path), "--method", method, "--out", argument(&out)]);
        let files = fs::read_dir(&out)
            .expect("a folder")
            .map(|file| file.expect("a file"));
        let mut names: Vec<String> = files
            .map(|file| {
                let length = file.metadata().expect("a length").len();
                assert!(length > 50, "{:?} has {length} bytes", file.path());
                file.file_name().to_string_lossy().into_owned()
            })
            .collect();
        names.sort();
        let mut expected = written
            .join(" ")
            .split(' ')
            .map(str::to_owned)
            .collect::<Vec<_>>();
        expected.push("result.json".to_owned());
        expected.sort();
        assert_eq!(names, expected, "{scene} by {method}");
    }
}

#[test]
fn the_method_that_was_chosen_is_named() {
    let output = viscofriction(&["run", argument(&example("cone-viscous.toml"))]);
    let printed = text(&output.stdout);
    assert!(
        printed.starts_with("analytic, the cheapest that answers the scene"),
        "{printed}"
    );
}

#[test]
fn what_could_not_be_reached_ends_with_status_1_and_says_how_far_it_came() {
    let path = folder("unreachable").join("scene.toml");
    let text_of = fs::read_to_string(example("half-space-run-in.toml")).expect("the scene");
    fs::write(
        &path,
        text_of.replace("elements = 12", "relative_error = 1e-6"),
    )
    .expect("a scene");
    let scene = fs::read_to_string(&path).expect("the scene");
    // A short way is quick on the finest grid.
    fs::write(&path, scene.replace("3.0e-2", "2.0e-3")).expect("a scene");
    let output = viscofriction(&["run", argument(&path)]);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(
        message.contains("was not reached to the relative error 1e-6"),
        "{message}"
    );
    assert!(message.contains(": it is 0."), "{message}");
}

/// Infinity is no number of a result, and no JSON.
#[test]
fn a_quantity_that_overflows_ends_with_status_1_and_its_name() {
    let file = folder("overflow").join("scene.toml");
    for (body, [material, force], needed) in [
        (
            "paraboloid]\ncurvature = 50",
            ["viscous]\nviscosity = 1e4", "1e308"],
            "tangential_force is inf",
        ),
        (
            "paraboloid]\ncurvature = 1e-290",
            ["elastic]\nshear_modulus = 1e-10", "1e200"],
            "contact_area is inf",
        ),
    ] {
        let sliding = material.starts_with("viscous");
        let load = if sliding {
            "velocity = 0.01"
        } else {
            "velocity = 0\n[solve]\nduration = 1"
        };
        let scene = format!(
            "[indenter.{body}\n[material.{material}\n[load]\nnormal_force = {force}\n{load}\n"
        );
        fs::write(&file, &scene).expect("a scene");
        let output = viscofriction(&["run", "--format", "json", argument(&file)]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{scene}{message}");
        assert!(
            message.contains(needed) && output.stdout.is_empty(),
            "{scene}{message}"
        );
    }
}
