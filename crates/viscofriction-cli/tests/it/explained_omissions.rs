//! `run --explain` measures everything that a scene did not need, and nothing of it changes the answer.

use std::fs;

use crate::support::{argument, command, example, folder, text, viscofriction};

/// Tables of scenes by their letters.
const TABLES: [(char, &str); 9] = [
    ('p', "[indenter.paraboloid]\ncurvature = 50.0\n"),
    ('c', "[indenter.cone]\nslope = 0.1\n"),
    ('v', "[material.viscous]\nviscosity = 1.0e4\n"),
    (
        'm',
        "[material.maxwell]\nshear_modulus = 1.0e6\nviscosity = 1.0e4\n",
    ),
    ('e', "[material.elastic]\nshear_modulus = 1.0e6\n"),
    (
        'b',
        "[material.prony]\nequilibrium_modulus = 1.0e5\nbranches = [\n\
         { modulus = 1.0e6, relaxation_time = 0.01 }, { modulus = 1.0e6, relaxation_time = 1.0 }]\n",
    ),
    ('F', "[load]\nnormal_force = 1.0\n"),
    ('D', "[load]\nindentation_depth = 1.0e-4\n"),
    ('S', "velocity = 0.01\n"),
];

/// The rows of the printed table of a scene, each as its cells.
fn explained(scene: &str) -> Vec<Vec<String>> {
    let output = viscofriction(&["run", "--explain", scene]);
    let printed = text(&output.stdout);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{scene}: {message}");
    let table = printed.split("left out:\n").nth(1);
    let table = table.unwrap_or_else(|| panic!("no table of what is left out in\n{printed}"));
    let cells = |line: &str| line.split('|').map(|cell| cell.trim().to_owned()).collect();
    table.lines().skip(2).map(cells).collect()
}

/// The same of a scene of these tables.
fn explained_scene(tables: &str, solve: &str) -> Vec<Vec<String>> {
    let table = |letter: char| {
        TABLES
            .iter()
            .find(|table| table.0 == letter)
            .map(|table| table.1)
    };
    let pressed = if tables.contains('S') {
        ""
    } else {
        "velocity = 0.0\n"
    };
    let scene = tables.chars().filter_map(table).collect::<String>() + pressed;
    let file = folder("explained").join("scene.toml");
    fs::write(&file, format!("{scene}[solve]\n{solve}\n")).expect("a scene");
    explained(argument(&file))
}

/// Parts that the table must have, in this order, after which come the files; the first of them are the same discrete
/// problem, whose answer does not change.
fn assert_explains(rows: &[Vec<String>], parts: &str, n_same: usize) {
    let names: Vec<&str> = rows.iter().map(|row| row[1].as_str()).collect();
    assert_eq!(
        names.join(", "),
        format!("{parts}, files"),
        "parts of {rows:#?}"
    );
    for row in rows {
        let done = [&row[4], &row[6]].map(|cell| {
            let number = cell.split(' ').next().unwrap_or_default();
            number.parse::<f64>().unwrap_or(f64::NAN)
        });
        let measured = done.iter().all(|number| *number > 0.0);
        assert!(measured, "time and memory of what is left out: {row:?}");
    }
    for row in &rows[..n_same] {
        let change: f64 = row[7].parse().expect("a number");
        assert!(change <= 1e-10, "the answer changes: {row:?}");
    }
    for row in &rows[n_same..rows.len() - 1] {
        assert!(row[7].contains("error bars"), "another method: {row:?}");
    }
}

#[test]
fn what_a_scene_does_not_need_is_done_all_the_same_and_changes_nothing() {
    let steady = "method = \"bem-steady\"\nelements = 8";
    let march = "method = \"bem-transient\"\nsliding_distance = 5.0e-3\nelements = 12";
    let pressed = "method = \"bem-transient\"\nduration = 0.5\nelements = 24";
    // A depth of 0.1 mm in eight steps takes the same impulse as in one.
    let held = "method = \"bem-transient\"\nduration = 1.0e-3\nelements = 24";
    let line = "model = \"line\"";
    for (tables, solve, parts, n_same) in [
        ("pvFS", steady, "mirror half, transforms, time steps", 2),
        (
            "cvFS",
            steady,
            "mirror half, outside contact, time steps",
            2,
        ),
        (
            "pvDS",
            march,
            "mirror half, outside contact, rows behind",
            3,
        ),
        (
            "pbF",
            pressed,
            "time steps, mirror half, gradients, history fields",
            4,
        ),
        ("cmD", held, "time steps, mirror half, gradients", 3),
        ("cvFS", line, "numerical solution, time steps", 0),
    ] {
        assert_explains(&explained_scene(tables, solve), parts, n_same);
    }
    // The tread is not its own mirror image.
    let tread = folder("explained-map").join("scene.toml");
    let scene = fs::read_to_string(example("tread.toml")).expect("the scene");
    let scene = scene.replace("tread.csv", argument(&example("tread.csv")));
    let scene = scene.replace("relative_error = 2e-2", "elements = 16");
    fs::write(&tread, scene).expect("a scene");
    for (scene, parts, n_same) in [
        (tread, "outside contact, time steps", 1),
        (
            example("half-space-run-in.toml"),
            "mirror half, outside contact, rows behind",
            3,
        ),
        (example("hertz.toml"), "numerical solution, half space", 0),
    ] {
        assert_explains(&explained(argument(&scene)), parts, n_same);
    }
}

/// On an elastic half space friction is what rounding leaves, and no change of it means anything.
#[test]
fn friction_that_cannot_be_told_from_zero_is_not_compared() {
    let rows = explained_scene("peFS", "method = \"bem-steady\"\nelements = 12");
    let time = rows.iter().find(|row| row[1] == "time steps");
    let time = time.unwrap_or_else(|| panic!("no time steps in {rows:#?}"));
    assert!(time[7].contains("cannot be told from 0"), "{time:?}");
}

#[test]
fn files_that_are_written_to_be_measured_do_not_stay() {
    let folder = folder("explained-files");
    let scene = example("cone-viscous.toml");
    let mut command = command(&["run", "--explain", argument(&scene)]);
    let output = command.env("TMPDIR", &folder).current_dir(&folder).output();
    assert!(
        output.expect("the command runs").status.success(),
        "--explain"
    );
    let left = fs::read_dir(&folder).expect("the folder").count();
    assert_eq!(left, 0, "{left} files stayed");
}
