//! Every malformed scene ends with status 2 and one line that names file, line and key.

use std::fs;

use crate::support::{argument, complaint, folder, text, viscofriction};

/// A scene that is right; the numbers on the left are the lines.
const SCENE: [&str; 13] = [
    /* 1 */ "[indenter.power]",
    /* 2 */ "coefficient = 0.5",
    /* 3 */ "exponent = 1.5",
    /* 4 */ "",
    /* 5 */ "[material.viscous]",
    /* 6 */ "viscosity = 1.0e4",
    /* 7 */ "",
    /* 8 */ "[load]",
    /* 9 */ "normal_force = 1.0",
    /* 10 */ "velocity = 0.01",
    /* 11 */ "",
    /* 12 */ "[solve]",
    /* 13 */ "relative_error = 1e-3",
];

/// The line that is replaced, what it is replaced with, the line that is named, and what is said.
const ONE_LINE: [(usize, &str, usize, &str); 46] = [
    (
        2,
        "coefficient = -0.5",
        2,
        "indenter.power.coefficient must be finite and greater than 0, but is -0.5",
    ),
    (
        2,
        "coefficient = 0",
        2,
        "indenter.power.coefficient must be finite and greater than 0, but is 0",
    ),
    (
        2,
        "coefficient = nan",
        2,
        "indenter.power.coefficient must be finite and greater than 0, but is NaN",
    ),
    (
        2,
        "coefficient = inf",
        2,
        "indenter.power.coefficient must be finite and greater than 0, but is inf",
    ),
    (2, "coefficient = 1e400", 2, ""),
    (2, "coefficient = \"0.5\"", 2, "indenter.power.coefficient"),
    (2, "coefficient = true", 2, "indenter.power.coefficient"),
    (2, "coefficient = [0.5]", 2, "indenter.power.coefficient"),
    (
        2,
        "coefficient = 2020-01-01",
        2,
        "indenter.power.coefficient",
    ),
    (
        2,
        "coefficent = 0.5",
        2,
        "indenter.power.coefficent: unknown field",
    ),
    (2, "", 1, "indenter.power.coefficient: missing field"),
    (2, "coefficient = ", 2, ""),
    (2, "coefficient 0.5", 2, ""),
    (2, "coefficient = 0.5 0.6", 2, ""),
    (
        3,
        "exponent = 0.0",
        3,
        "indenter.power.exponent must be finite and greater than 0, but is 0",
    ),
    (3, "exponent = -1", 3, "indenter.power.exponent"),
    (3, "coefficient = 2.0", 3, "duplicate key"),
    (
        3,
        "exponent = 1.5\nradius = 1.0",
        4,
        "indenter.power.radius: unknown field `radius`, expected `coefficient` or `exponent`",
    ),
    (1, "[indenter.pwoer]", 1, "indenter.pwoer: unknown variant"),
    (1, "[indentor.power]", 1, "indentor: unknown field"),
    (
        1,
        "[indenter]",
        1,
        "indenter: exactly one kind is needed, as in [indenter.kind], but there are 2: coefficient, exponent",
    ),
    (1, "[indenter.power", 1, ""),
    (1, "indenter.power]", 1, ""),
    (
        1,
        "[indenter.sphere]\nradius = 1.0\n[indenter.power]",
        1,
        "indenter: exactly one kind is needed",
    ),
    (
        5,
        "[material.viscos]",
        5,
        "material.viscos: unknown variant",
    ),
    (5, "[materials.viscous]", 5, "materials: unknown field"),
    (
        6,
        "viscosity = 0.0",
        6,
        "material.viscous.viscosity must be finite and greater than 0, but is 0",
    ),
    (6, "viscosity = -1.0e4", 6, "material.viscous.viscosity"),
    (6, "viscosity = inf", 6, "material.viscous.viscosity"),
    (
        6,
        "viscosity = 1.0e4\npoisson_ratio = 0.6",
        7,
        "material.viscous.poisson_ratio must be greater than -1 and at most 0.5, but is 0.6",
    ),
    (
        6,
        "viscosity = 1.0e4\npoisson_ratio = -1",
        7,
        "material.viscous.poisson_ratio",
    ),
    (
        6,
        "viscosity = 1.0e4\npoisson_ratio = nan",
        7,
        "material.viscous.poisson_ratio",
    ),
    (
        6,
        "shear_modulus = 1.0e4",
        6,
        "material.viscous.shear_modulus: unknown field",
    ),
    (8, "[loads]", 8, "loads: unknown field"),
    (
        9,
        "normal_force = 0.0",
        9,
        "load.normal_force must be finite and greater than 0, but is 0",
    ),
    (9, "normal_force = -1.0", 9, "load.normal_force"),
    (
        9,
        "indentation_depth = -1.0",
        9,
        "load.indentation_depth must be finite and greater than 0, but is -1",
    ),
    (
        9,
        "normal_force = 1.0\nindentation_depth = 1.0",
        10,
        "load.indentation_depth: either normal_force or indentation_depth",
    ),
    (
        9,
        "",
        8,
        "load.normal_force: normal_force or indentation_depth is missing",
    ),
    (
        10,
        "velocity = -0.01",
        10,
        "load.velocity must be finite and at least 0, but is -0.01",
    ),
    (
        10,
        "velocity = nan",
        10,
        "load.velocity must be finite and at least 0, but is NaN",
    ),
    (
        10,
        "velocity = 0.0",
        10,
        "load.velocity: a velocity of 0 is pure indentation, which needs solve.duration",
    ),
    (10, "", 8, "load.velocity: missing field"),
    (10, "speed = 0.01", 10, "load.speed: unknown field"),
    (12, "[solver]", 12, "solver: unknown field"),
    (
        12,
        "[[solve]]",
        12,
        "solve: a table is needed, and not a value of type array",
    ),
];

/// What stands in the table `[solve]` from line 13 on, the line that is named, and what is said.
const SOLVE: [(&str, usize, &str); 18] = [
    (
        "relative_error = 0.0",
        13,
        "solve.relative_error must be greater than 0 and at most 0.1, but is 0",
    ),
    (
        "relative_error = 0.5",
        13,
        "solve.relative_error must be greater than 0 and at most 0.1, but is 0.5",
    ),
    ("relative_error = -1e-3", 13, "solve.relative_error"),
    (
        "relative_error = 1e-3\nelements = 32",
        14,
        "solve.elements: either relative_error or elements",
    ),
    (
        "elements = 7",
        13,
        "solve.elements must be from 8 to 100000, but is 7",
    ),
    ("elements = -8", 13, "solve.elements"),
    ("elements = 32.0", 13, "solve.elements"),
    ("elements = 32", 1, "solve"),
    (
        "threads = 0",
        13,
        "solve.threads must be from 1 to 1024, but is 0",
    ),
    (
        "duration = 1.0\nsliding_distance = 1.0",
        14,
        "solve.sliding_distance: either duration or sliding_distance",
    ),
    (
        "duration = -1.0",
        13,
        "solve.duration must be finite and greater than 0, but is -1",
    ),
    ("sliding_distance = 0.0", 13, "solve.sliding_distance"),
    (
        "method = \"magic\"",
        13,
        "solve.method.magic: unknown variant `magic`, expected one of `analytic`",
    ),
    ("method = 1", 13, "solve.method"),
    (
        "model = \"plane\"",
        13,
        "solve.model.plane: unknown variant",
    ),
    (
        "method = \"analytic\"\nelements = 32",
        13,
        "solve.method: analytic does not answer this scene: closed forms have no elements",
    ),
    (
        "method = \"mdr-steady\"\nsliding_distance = 1.0",
        13,
        "these do: mdr-transient, bem-steady, bem-transient",
    ),
    (
        "method = \"bem-steady\"\nmodel = \"line\"",
        13,
        "these do: analytic, mdr-steady, mdr-transient",
    ),
];

/// Whole other tables: what replaces the indenter or the material, the line that is named, and what is said.
const TABLES: [(&str, usize, &str); 26] = [
    (
        "[indenter.cone]\nslope = 0",
        2,
        "indenter.cone.slope must be finite and greater than 0, but is 0",
    ),
    (
        "[indenter.paraboloid]\ncurvature = -1",
        2,
        "indenter.paraboloid.curvature",
    ),
    (
        "[indenter.sphere]\nradius = nan",
        2,
        "indenter.sphere.radius",
    ),
    (
        "[indenter.sphere]\ndiameter = 1",
        2,
        "indenter.sphere.diameter: unknown field",
    ),
    (
        "[indenter.flat-punch]\nradius = 0",
        2,
        "indenter.flat-punch.radius",
    ),
    (
        "[indenter.flat-cone]\nradius = 1.0\nslope = -1",
        3,
        "indenter.flat-cone.slope",
    ),
    (
        "[indenter.flat_cone]\nradius = 1.0\nslope = 1",
        1,
        "indenter.flat_cone: unknown variant",
    ),
    (
        "[indenter.round-tipped-cone]\nradius = -1.0\nslope = 1",
        2,
        "indenter.round-tipped-cone.radius",
    ),
    (
        "[indenter.hyperboloid]\nradius = 1.0\nslope = inf",
        3,
        "indenter.hyperboloid.slope",
    ),
    (
        "[indenter.truncated-paraboloid]\nradius = 1.0\ncurvature = 0",
        3,
        "indenter.truncated-paraboloid.curvature",
    ),
    (
        "[indenter.superposition]\nterms = []",
        2,
        "indenter.superposition.terms",
    ),
    (
        "[indenter.superposition]\nterms = [\n{ coefficient = 1.0, exponent = 1.0 },\n{ coefficient = 0.0, exponent = 2.0 },\n]",
        4,
        "indenter.superposition.terms[1].coefficient must be finite and not 0, but is 0",
    ),
    (
        "[indenter.superposition]\nterms = [{ coefficient = 1.0 }]",
        2,
        "missing field `exponent`",
    ),
    (
        "[indenter.table]\nfile = \"is-not-there.csv\"",
        2,
        "is-not-there.csv",
    ),
    (
        "[indenter.cylinder]\nradius = 0.01",
        1,
        "no method answers this scene yet",
    ),
    (
        "[indenter.height-map]\nfile = \"h.csv\"\nspacing = 0",
        3,
        "indenter.height-map.spacing",
    ),
    (
        "[indenter.height-map]\nfile = \"h.csv\"\nspacing = [1, 0]",
        3,
        "indenter.height-map.spacing[1] must be finite and greater than 0, but is 0",
    ),
    (
        "[indenter.height-map]\nfile = \"h.csv\"\nspacing = [1, 1, 1]",
        3,
        "indenter.height-map.spacing",
    ),
    (
        "[indenter.height-map]\nfile = \"is-not-there.csv\"\nspacing = [1, 1]",
        2,
        "is-not-there.csv",
    ),
    (
        "[indenter.height-map]\nfile = \"h.csv\"",
        1,
        "indenter.height-map.spacing: missing field",
    ),
    (
        "[material.elastic]\nshear_modulus = 0",
        2,
        "material.elastic.shear_modulus",
    ),
    (
        "[material.kelvin-voigt]\nshear_modulus = 1e6\nviscosity = 0",
        3,
        "material.kelvin-voigt.viscosity",
    ),
    (
        "[material.maxwell]\nshear_modulus = -1e6\nviscosity = 1e4",
        2,
        "material.maxwell.shear_modulus",
    ),
    (
        "[material.standard-solid]\nequilibrium_modulus = 1e6\nmaxwell_modulus = 0\nviscosity = 1e4",
        3,
        "material.standard-solid.maxwell_modulus",
    ),
    (
        "[material.prony]\nequilibrium_modulus = 1e6\nbranches = [\n{ modulus = 1e6, relaxation_time = 1 },\n{ modulus = 1e6, relaxation_time = 0 },\n]",
        5,
        "material.prony.branches[1].relaxation_time must be finite and greater than 0, but is 0",
    ),
    (
        "[material.prony]\nequilibrium_modulus = 0\nbranches = []",
        1,
        "material.prony: a material needs",
    ),
];

/// Text, line and what is said, of all of them.
fn corpus() -> Vec<(String, usize, &'static str)> {
    let mut corpus = Vec::new();
    for (line, replacement, named, needed) in ONE_LINE {
        let mut lines = SCENE;
        lines[line - 1] = replacement;
        corpus.push((lines.join("\n"), named, needed));
    }
    for (solve, named, needed) in SOLVE {
        // The error of the fixed resolution belongs to a scene that no method answers at a depth.
        let mut lines = SCENE;
        if needed == "solve" {
            lines[8] = "indentation_depth = 1.0e-3";
        }
        lines[12] = solve;
        let needed = if needed == "solve" {
            "no method answers"
        } else {
            needed
        };
        corpus.push((lines.join("\n"), named, needed));
    }
    let [indenter, material] = [SCENE[..3].join("\n"), SCENE[4..6].join("\n")];
    let rest = SCENE[7..].join("\n");
    for (table, named, needed) in TABLES {
        let other = if table.starts_with("[indenter") {
            &material
        } else {
            &indenter
        };
        corpus.push((format!("{table}\n{other}\n{rest}"), named, needed));
    }
    let list = "[indenter]\ncone = [0.1]".to_owned();
    corpus.push((
        format!("{list}\n{material}\n{rest}"),
        2,
        "indenter.cone[0]: a table is needed",
    ));
    let list = "[indenter.superposition]\nterms = [[1.0, 2.0]]".to_owned();
    corpus.push((
        format!("{list}\n{material}\n{rest}"),
        2,
        "indenter.superposition.terms[0]: a table is needed",
    ));
    corpus.push((String::new(), 1, "indenter: missing field"));
    corpus.push((SCENE[..6].join("\n"), 1, "load: missing field"));
    corpus.push(("\u{0}".to_owned(), 1, ""));
    corpus
}

#[test]
fn every_malformed_scene_ends_with_status_2_and_names_file_line_and_key() {
    let path = folder("malformed").join("scene.toml");
    let corpus = corpus();
    assert!(corpus.len() >= 60, "only {} scenes", corpus.len());
    let mut wrong = Vec::new();
    for (scene, line, needed) in corpus {
        fs::write(&path, &scene).expect("a scene");
        let place = format!("{}:{line}", path.display());
        let complaint = complaint(&["run", argument(&path)], &place, needed);
        wrong.extend(complaint.map(|complaint| format!("{scene}\n--- {complaint}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn the_scene_behind_the_malformed_ones_is_right() {
    let path = folder("wellformed").join("scene.toml");
    fs::write(&path, SCENE.join("\n")).expect("a scene");
    let output = viscofriction(&["run", argument(&path)]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let output = viscofriction(&["run", "is/not/there.toml"]);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(message.contains("is/not/there.toml"), "{message}");
}
