//! `run --explain` measures everything that a scene did not need, and nothing of it changes the answer.

use crate::support::{Folder, argument, rows, scene};

/// The rows of the printed table of a scene, each as its cells.
fn explained(folder: &Folder, scene: &str) -> Vec<Vec<String>> {
    let printed = folder.ends(&format!("run --explain {scene}"), 0, "").stdout;
    let table = printed.split("left out:\n").nth(1);
    let table = table.unwrap_or_else(|| panic!("no table of what is left out in\n{printed}"));
    let cells = |line: &str| line.split('|').map(|cell| cell.trim().to_owned()).collect();
    table.lines().skip(2).map(cells).collect()
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
    for (index, row) in rows.iter().enumerate() {
        for done in [&row[4], &row[6]] {
            let number = done
                .split(' ')
                .next()
                .and_then(|number| number.parse().ok());
            let measured = number.is_some_and(|number: f64| number > 0.0);
            assert!(measured, "time and memory of what is left out: {row:?}");
        }
        if index < n_same {
            let change: f64 = row[7].parse().expect("a number");
            assert!(change <= 1e-10, "the answer changes: {row:?}");
        } else if index + 1 < rows.len() {
            assert!(row[7].contains("error bars"), "another method: {row:?}");
        }
    }
}

/// Scene | parts that it does not need | how many of them are the same discrete problem.
const EXPLAINED: &str = r#"
paraboloid; viscous; normal_force = 1.0, velocity = 0.01; method = "bem-steady", elements = 8 | mirror half, transforms, time steps | 2
cone; viscous; normal_force = 1.0, velocity = 0.01; method = "bem-steady", elements = 8 | mirror half, outside contact, time steps | 2
paraboloid; viscous; indentation_depth = 1e-4, velocity = 0.01; method = "bem-transient", sliding_distance = 5.0e-3, elements = 12 | mirror half, outside contact, rows behind | 3
paraboloid; prony; normal_force = 1.0, velocity = 0.0; method = "bem-transient", duration = 0.5, elements = 24 | time steps, mirror half, gradients, history fields | 4
cone; maxwell; indentation_depth = 1e-4, velocity = 0.0; method = "bem-transient", duration = 1.0e-3, elements = 24 | time steps, mirror half, gradients | 3
cone; viscous; normal_force = 1.0, velocity = 0.01; model = "line" | numerical solution, time steps | 0
"#;

#[test]
fn what_a_scene_does_not_need_is_done_all_the_same_and_changes_nothing() {
    let folder = Folder::new("explained");
    for [parts, names, n_same] in rows(EXPLAINED) {
        folder.write("scene.toml", scene(&parts));
        let n_same = n_same.parse().expect("a number");
        assert_explains(&explained(&folder, "scene.toml"), &names, n_same);
    }
    // The tread is not its own mirror image.
    let map = argument("IN/tread.csv");
    let elements = ("relative_error = 2e-2", "elements = 16");
    let folder = Folder::with("explained", "tread.toml", &[("tread.csv", &map), elements]);
    let march = "mirror half, outside contact, rows behind";
    for (scene, names, n_same) in [
        ("scene.toml", "outside contact, time steps", 1),
        ("IN/half-space-run-in.toml", march, 3),
        ("IN/hertz.toml", "numerical solution, half space", 0),
    ] {
        assert_explains(&explained(&folder, scene), names, n_same);
    }
}

/// On an elastic half space friction is what rounding leaves, and no change of it means anything.
#[test]
fn friction_that_cannot_be_told_from_zero_is_not_compared() {
    let folder = Folder::new("explained-elastic");
    let elastic = "paraboloid; elastic; normal_force = 1.0, velocity = 0.01";
    let solve = "method = \"bem-steady\", elements = 12";
    folder.write("scene.toml", scene(&format!("{elastic}; {solve}")));
    let rows = explained(&folder, "scene.toml");
    let time = rows.iter().find(|row| row[1] == "time steps");
    let time = time.unwrap_or_else(|| panic!("no time steps in {rows:#?}"));
    assert!(time[7].contains("cannot be told from 0"), "{time:?}");
}

#[test]
fn files_that_are_written_to_be_measured_do_not_stay() {
    let folder = Folder::new("explained-files");
    let mut command = folder.command("run --explain IN/cone-viscous.toml");
    let status = command
        .env("TMPDIR", &folder.0)
        .stdout(std::process::Stdio::null())
        .status();
    assert!(status.expect("the command runs").success(), "--explain");
    assert!(folder.names("").is_empty(), "{:?} stayed", folder.names(""));
}
