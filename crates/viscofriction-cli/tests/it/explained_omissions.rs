//! `run --explain` measures everything that a scene did not need, and nothing of it changes the answer.

use std::fs;
use std::path::Path;

use crate::support::{argument, command, example, folder, text};

/// The rows of the printed table, each as its cells; the command has succeeded.
fn explained(arguments: &[&str]) -> Vec<Vec<String>> {
    explained_in(Path::new(env!("CARGO_TARGET_TMPDIR")), arguments)
}

/// The same of a command that is run in this folder.
fn explained_in(folder: &Path, arguments: &[&str]) -> Vec<Vec<String>> {
    let mut command = command(&[&["run", "--explain"], arguments].concat());
    let output = command.current_dir(folder).output();
    let output = output.expect("the command runs");
    let printed = text(&output.stdout);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {message}");
    let table = printed.split("left out:\n").nth(1);
    let table = table.unwrap_or_else(|| panic!("no table of what is left out in\n{printed}"));
    let cells = |line: &str| line.split('|').map(|cell| cell.trim().to_owned()).collect();
    table.lines().skip(2).map(cells).collect()
}

/// Parts that the table must have, in this order, after which come the files.
fn assert_explains(rows: &[Vec<String>], parts: &[&str]) {
    let names: Vec<&str> = rows.iter().map(|row| row[1].as_str()).collect();
    assert_eq!(names, [parts, &["files"]].concat(), "parts of {rows:#?}");
    for row in rows {
        let done = [&row[4], &row[6]].map(|cell| {
            let number = cell.split(' ').next().unwrap_or_default();
            number.parse::<f64>().unwrap_or(f64::NAN)
        });
        let measured = done.iter().all(|number| *number > 0.0);
        assert!(measured, "time and memory of what is left out: {row:?}");
    }
}

/// Changes of the answer by rounding, which the command refuses to be large.
fn assert_same(rows: &[Vec<String>], parts: &[&str]) {
    for row in rows.iter().filter(|row| parts.contains(&row[1].as_str())) {
        let change: f64 = row[7].parse().expect("a number");
        assert!(change <= 1e-10, "the answer changes: {row:?}");
    }
}

#[test]
fn the_stationary_half_space_needs_no_mirror_half_no_surroundings_and_no_time() {
    let scene = fs::read_to_string(example("cone-half-space.toml")).expect("the scene");
    let paraboloid = scene
        .replace("indenter.cone", "indenter.paraboloid")
        .replace("slope = 0.1", "curvature = 50.0");
    for (body, part) in [(paraboloid, "transforms"), (scene, "outside contact")] {
        let file = folder(&format!("explained-{part}")).join("scene.toml");
        let resolved = body.replace("relative_error = 1e-2", "elements = 8");
        fs::write(&file, resolved).expect("a scene");
        let rows = explained(&[argument(&file)]);
        let parts = ["mirror half", part, "time steps"];
        assert_explains(&rows, &parts);
        assert_same(&rows, &parts[..2]);
        let bars = &rows[2][7];
        assert!(
            bars.contains("error bars") && bars.contains("bem-transient"),
            "{bars}"
        );
    }
}

/// The tread is not its own mirror image.
#[test]
fn under_a_height_map_no_surroundings_and_no_time_are_needed() {
    let file = folder("explained-map").join("scene.toml");
    let scene = fs::read_to_string(example("tread.toml")).expect("the scene");
    let map = example("tread.csv");
    let scene = scene.replace("tread.csv", argument(&map));
    fs::write(
        &file,
        scene.replace("relative_error = 2e-2", "elements = 16"),
    )
    .expect("a scene");
    let rows = explained(&[argument(&file)]);
    let parts = ["outside contact", "time steps"];
    assert_explains(&rows, &parts);
    assert_same(&rows, &parts[..1]);
}

#[test]
fn a_march_needs_no_mirror_half_no_surroundings_and_nothing_behind() {
    let at_depth = folder("explained-march").join("scene.toml");
    let scene = "[indenter.paraboloid]\ncurvature = 50.0\n[material.viscous]\nviscosity = 1.0e4\n\
        [load]\nindentation_depth = 1.0e-4\nvelocity = 0.01\n\
        [solve]\nmethod = \"bem-transient\"\nsliding_distance = 5.0e-3\nelements = 12\n";
    fs::write(&at_depth, scene).expect("a scene");
    for scene in [example("half-space-run-in.toml"), at_depth] {
        let rows = explained(&[argument(&scene)]);
        let parts = ["mirror half", "outside contact", "rows behind"];
        assert_explains(&rows, &parts);
        assert_same(&rows, &parts);
    }
}

#[test]
fn a_constant_force_needs_no_steps_no_mirror_half_no_slopes_and_one_field() {
    let file = folder("explained-pressing").join("scene.toml");
    let scene = "[indenter.paraboloid]\ncurvature = 50.0\n\
        [material.prony]\nequilibrium_modulus = 1.0e5\nviscosity = 0.0\nbranches = [\n\
        { modulus = 1.0e6, relaxation_time = 0.01 },\n{ modulus = 1.0e6, relaxation_time = 1.0 }]\n\
        [load]\nnormal_force = 1.0\nvelocity = 0.0\n\
        [solve]\nmethod = \"bem-transient\"\nduration = 0.5\nelements = 24\n";
    fs::write(&file, scene).expect("a scene");
    let rows = explained(&[argument(&file)]);
    let parts = ["time steps", "mirror half", "gradients", "history fields"];
    assert_explains(&rows, &parts);
    assert_same(&rows, &parts);
}

/// A depth of 0.1 mm in eight steps takes the same impulse as in one.
#[test]
fn a_depth_needs_no_steps_no_mirror_half_and_no_slopes() {
    let file = folder("explained-depth").join("scene.toml");
    let scene = "[indenter.cone]\nslope = 0.1\n\
        [material.maxwell]\nshear_modulus = 1.0e6\nviscosity = 1.0e4\n\
        [load]\nindentation_depth = 1.0e-4\nvelocity = 0.0\n\
        [solve]\nmethod = \"bem-transient\"\nduration = 1.0e-3\nelements = 24\n";
    fs::write(&file, scene).expect("a scene");
    let rows = explained(&[argument(&file)]);
    let parts = ["time steps", "mirror half", "gradients"];
    assert_explains(&rows, &parts);
    assert_same(&rows, &parts);
}

/// On an elastic half space friction is what rounding leaves, and no change of it means anything.
#[test]
fn friction_that_cannot_be_told_from_zero_is_not_compared() {
    let file = folder("explained-elastic").join("scene.toml");
    let scene = "[indenter.paraboloid]\ncurvature = 50.0\n[material.elastic]\nshear_modulus = 1.0e6\n\
        [load]\nnormal_force = 1.0\nvelocity = 0.1\n[solve]\nmethod = \"bem-steady\"\nelements = 12\n";
    fs::write(&file, scene).expect("a scene");
    let rows = explained(&[argument(&file)]);
    let time = rows.iter().find(|row| row[1] == "time steps");
    let time = time.unwrap_or_else(|| panic!("no time steps in {rows:#?}"));
    assert!(time[7].contains("cannot be told from 0"), "{time:?}");
}

#[test]
fn a_closed_form_is_compared_with_the_methods_that_it_saves() {
    for (scene, parts) in [
        ("cone-viscous.toml", ["numerical solution", "time steps"]),
        ("hertz.toml", ["numerical solution", "half space"]),
    ] {
        let rows = explained(&[argument(&example(scene))]);
        assert_explains(&rows, &parts);
        for row in &rows[..2] {
            assert!(row[7].contains("error bars"), "{scene}: {row:?}");
        }
    }
}

#[test]
fn files_that_are_written_to_be_measured_do_not_stay() {
    let folder = folder("explained-files");
    let rows = explained_in(&folder, &[argument(&example("cone-viscous.toml"))]);
    assert_explains(&rows, &["numerical solution", "time steps"]);
    let left = fs::read_dir(folder.join("target/explain")).expect("the folder of the files");
    let left: Vec<_> = left.map(|entry| entry.expect("an entry").path()).collect();
    assert!(left.is_empty(), "{left:?} stayed");
}
