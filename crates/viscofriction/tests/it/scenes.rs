//! Every committed scene is answered, with the parts of its error bar.

use std::fs;

use serde_json::Value;
use viscofriction::sweep::{Varied, Vary};

use crate::support::{Folder, assert_agree, assert_close, estimate, example, number, scene, table};

#[test]
fn every_committed_scene_is_answered() {
    let folder = Folder::new("committed");
    let entries = fs::read_dir(example("")).expect("the committed scenes");
    let mut scenes: Vec<_> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    scenes.retain(|path| path.extension().is_some_and(|end| end == "toml"));
    assert!(scenes.len() >= 12, "only {} scenes", scenes.len());
    for scene in scenes {
        let scene = scene.display().to_string();
        let result = folder.json(&scene);
        assert!(number(&result, "normal_force") > 0.0, "{scene}: {result}");
        let answered = ["friction_coefficient", "indentation_depth", "contact_area"];
        let is_answered = answered.iter().any(|field| result[*field].is_number());
        assert!(is_answered, "{scene}: {result}");
        assert_bar_is_its_parts(&result);
    }
}

/// The pressure of Hertz is p₀ √(1 − r²/a²), whose mean is 2/3 p₀.
#[test]
fn the_mean_contact_pressure_of_hertz_is_two_thirds_of_the_peak() {
    let folder = Folder::new("mean-pressure");
    let hertz = fs::read_to_string(example("hertz.toml")).expect("a scene");
    for (rest, part) in [
        ("", 1e-9),
        ("method = \"bem-transient\"\nrelative_error = 1e-2", 0.1),
    ] {
        let found = folder.answer(format!("{hertz}\n{rest}"));
        let peak = estimate(&found, "peak_pressure") * (2.0 / 3.0);
        assert_agree(rest, estimate(&found, "mean_contact_pressure"), peak, part);
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
    let springpot = "paraboloid; springpot; normal_force = 1, velocity = 0.05; model = \"line\"";
    folder.write("springpot.toml", scene(springpot));
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
        folder.write("scene.toml", scene(&parts));
        let words = folder.solved("scene.toml").answer.not_modelled;
        assert_eq!(words.join(", "), expected, "{parts}");
    }
}

#[test]
fn a_material_that_is_viscous_by_another_name_is_the_same() {
    let folder = Folder::new("another-name");
    // 2 (1 − ν) = 2 halves the viscosity that the surface feels.
    let prony = "material.prony = { equilibrium_modulus = 0.0, viscosity = 2.0e4, poisson_ratio = 0.0, branches = [] }";
    let [viscous, prony] = ["viscous", prony].map(|material| {
        let rest = "normal_force = 1.0, velocity = 0.01; model = \"line\"";
        folder.answer(scene(&format!("paraboloid; {material}; {rest}")))
    });
    for field in ["friction_coefficient", "indentation_depth"] {
        assert_close(field, number(&prony, field), number(&viscous, field), 1e-14);
    }
}

#[test]
fn a_quantity_that_overflows_is_named() {
    let folder = Folder::new("overflow");
    for [parts, needed] in table("overflows") {
        folder.write("scene.toml", scene(&parts));
        folder.ends("scene.toml", 1, &needed);
    }
}

#[test]
fn powers_of_ten_and_lists_are_met_exactly() {
    let values = |vary: &str| -> Vec<String> {
        let vary: Vary = vary.parse().expect("values");
        vary.values.iter().map(Varied::to_string).collect()
    };
    let powers = (-9..7).map(|power| format!("{:?}", format!("1e{power}").parse::<f64>().unwrap()));
    let powers: Vec<String> = powers.collect();
    assert_eq!(values("load.velocity=1e-9:1e6:16:log"), powers);
    let thirds = values("load.velocity=1e-3:1:10:log");
    assert_eq!([&thirds[3], &thirds[6]], ["0.01", "0.1"]);
    assert_eq!(values("load.velocity=0.3, 0.1,2"), ["0.3", "0.1", "2.0"]);
}

/// A sum of powers that turns down slides as long as its crest, at 4 mm, is not in contact: under a force and at the depth of it.
#[test]
fn a_body_that_turns_down_slides_on_its_rising_part() {
    let folder = Folder::new("turns-down");
    let scene = |load: &str| {
        format!(
            "[indenter.superposition]\nterms = [{{ coefficient = 50.0, exponent = 2.0 }}, {{ coefficient = -1.5625e6, exponent = 4.0 \
             }}]\n[material.standard-solid]\nequilibrium_modulus = 1e6\nmaxwell_modulus = 9e6\nviscosity = 9e3\n[load]\n{load}\nvelocity \
             = 0.3\n"
        )
    };
    folder.write("force.toml", scene("normal_force = 8.5"));
    let under_force = folder.solved("force.toml").answer;
    let depth = under_force.indentation_depth.expect("a depth");
    folder.write(
        "depth.toml",
        scene(&format!("indentation_depth = {}", depth.value)),
    );
    let at_depth = folder.solved("depth.toml").answer;
    let force = at_depth.normal_force;
    let stiffness = 1.5 * 8.5 / depth.value;
    let difference = (force.value - 8.5).abs();
    assert!(
        difference <= force.error + stiffness * depth.error,
        "{force} at {depth}"
    );
    folder.write("heavy.toml", scene("normal_force = 12.0"));
    folder.ends("heavy.toml", 1, "vertical wall");
}
