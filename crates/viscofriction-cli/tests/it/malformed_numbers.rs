//! Every number of every table of a scene that must be positive refuses everything else, with status 2 and one line that
//! names file, line and key.

use std::fs;

use crate::support::{argument, complaint, folder};

/// Tables and their keys, each of which must be a positive number.
const TABLES: [(&str, &[&str]); 15] = [
    ("indenter.power", &["coefficient", "exponent"]),
    ("indenter.cone", &["slope"]),
    ("indenter.paraboloid", &["curvature"]),
    ("indenter.sphere", &["radius"]),
    ("indenter.flat-punch", &["radius"]),
    ("indenter.flat-cone", &["radius", "slope"]),
    ("indenter.round-tipped-cone", &["radius", "slope"]),
    ("indenter.hyperboloid", &["radius", "slope"]),
    ("indenter.truncated-paraboloid", &["radius", "curvature"]),
    ("indenter.cylinder", &["radius"]),
    ("material.viscous", &["viscosity"]),
    ("material.elastic", &["shear_modulus"]),
    ("material.kelvin-voigt", &["shear_modulus", "viscosity"]),
    ("material.maxwell", &["shear_modulus", "viscosity"]),
    (
        "material.standard-solid",
        &["equilibrium_modulus", "maxwell_modulus", "viscosity"],
    ),
];

/// What stands in the place of a number, and what is said about it.
const REFUSED: [(&str, &str); 7] = [
    ("0", "must be finite and greater than 0, but is 0"),
    ("-1", "must be finite and greater than 0, but is -1"),
    ("nan", "must be finite and greater than 0, but is NaN"),
    ("-inf", "must be finite and greater than 0, but is -inf"),
    ("\"one\"", "invalid type: string"),
    ("false", "invalid type: boolean"),
    ("[0.5]", "invalid type: sequence"),
];

/// The table with one line replaced, and what completes it to a scene.
fn scene(table: &str, keys: &[&str], (wrong, line): (usize, &str)) -> String {
    let other = if table.starts_with("indenter") {
        "[material.viscous]\nviscosity = 0.5"
    } else {
        "[indenter.cone]\nslope = 0.5"
    };
    let mut lines = vec![format!("[{table}]")];
    lines.extend(keys.iter().map(|key| format!("{key} = 0.5")));
    line.clone_into(&mut lines[wrong]);
    format!(
        "{}\n{other}\n[load]\nnormal_force = 1\nvelocity = 1\n",
        lines.join("\n")
    )
}

/// Text, line and what is said.
fn corpus() -> Vec<(String, usize, String)> {
    let mut corpus = Vec::new();
    for (table, keys) in TABLES {
        for (index, key) in keys.iter().enumerate() {
            let line = index + 1;
            for (value, why) in REFUSED {
                let text = scene(table, keys, (line, &format!("{key} = {value}")));
                let separator = if why.starts_with("must") { "" } else { ":" };
                corpus.push((text, line + 1, format!("{table}.{key}{separator} {why}")));
            }
            let missing = format!("{table}.{key}: missing field `{key}`");
            corpus.push((scene(table, keys, (line, "")), 1, missing));
            let misspelt = scene(table, keys, (line, &format!("{key}s = 0.5")));
            corpus.push((
                misspelt,
                line + 1,
                format!("{table}.{key}s: unknown field `{key}s`"),
            ));
        }
    }
    corpus
}

#[test]
fn every_positive_number_of_a_scene_refuses_everything_else() {
    let path = folder("malformed-numbers").join("scene.toml");
    let corpus = corpus();
    assert!(corpus.len() >= 200, "only {} scenes", corpus.len());
    let mut wrong = Vec::new();
    for (scene, line, needed) in corpus {
        fs::write(&path, &scene).expect("a scene");
        let place = format!("{}:{line}", path.display());
        let complaint = complaint(&["run", argument(&path)], &place, &needed);
        wrong.extend(complaint.map(|complaint| format!("{scene}--- {complaint}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}
