//! `run --explain` measures everything that a scene did not need, and nothing of it changes the answer.

use std::fs;

use crate::support::{Folder, example, rows, said, scene};

/// Scene | parts that it does not need | how many of them, at first, are the same discrete problem, whose answer does not
/// change | what is said about the others. The tread is not its own mirror image. A depth of 0.1 mm in eight steps takes the
/// same impulse as in one. On an elastic half space friction is what rounding leaves, and no change of it means anything.
const EXPLAINED: &str = r#"
paraboloid; viscous; normal_force = 1.0, velocity = 0.01; method = "bem-steady", elements = 8 | mirror half, transforms, time steps | 2 | error bars
cone; viscous; normal_force = 1.0, velocity = 0.01; method = "bem-steady", elements = 8 | mirror half, outside contact, time steps | 2 | error bars
paraboloid; viscous; indentation_depth = 1e-4, velocity = 0.01; method = "bem-transient", sliding_distance = 5.0e-3, elements = 12 | mirror half, outside contact, rows behind | 3
paraboloid; prony; normal_force = 1.0, velocity = 0.0; method = "bem-transient", duration = 0.5, elements = 24 | time steps, mirror half, gradients, history fields | 4
cone; maxwell; indentation_depth = 1e-4, velocity = 0.0; method = "bem-transient", duration = 1.0e-3, elements = 24 | time steps, mirror half, gradients | 3
cone; viscous; normal_force = 1.0, velocity = 0.01; model = "line" | numerical solution, time steps | 0 | error bars
paraboloid; elastic; normal_force = 1.0, velocity = 0.01; method = "bem-steady", elements = 12 | mirror half, outside contact, time steps | 2 | cannot be told from 0
scene.toml | outside contact, time steps | 1 | error bars
IN/half-space-run-in.toml | mirror half, outside contact, rows behind | 3
IN/hertz.toml | half space | 0 | error bars
"#;

/// The rows of the printed table of a scene, each as its cells.
fn explained(folder: &Folder, scene: &str) -> Vec<Vec<String>> {
    let printed = folder.done(format!("run --explain {scene}")).stdout;
    let table = printed.split("left out:\n").nth(1);
    let table = table.unwrap_or_else(|| panic!("no table of what is left out in\n{printed}"));
    let cells = |line: &str| line.split('|').map(|cell| cell.trim().to_owned()).collect();
    table.lines().skip(2).map(cells).collect()
}

#[test]
fn what_a_scene_does_not_need_is_done_all_the_same_and_changes_nothing() {
    let elements = [("relative_error = 2e-2", "elements = 16")];
    let folder = Folder::with("explained", "tread.toml", &elements);
    fs::copy(example("tread.csv"), folder.path("tread.csv")).expect("a map");
    for [parts, names, n_same, others] in rows(EXPLAINED) {
        let file = if parts.contains("; ") {
            folder.write("parts.toml", scene(&parts));
            "parts.toml"
        } else {
            &parts
        };
        let n_same: usize = n_same.parse().expect("a number");
        let rows = explained(&folder, file);
        let found: Vec<&str> = rows.iter().map(|row| row[1].as_str()).collect();
        assert_eq!(found.join(", "), names + ", files", "{parts}");
        for (index, row) in rows.iter().enumerate() {
            let number = |cell: &str| cell.split(' ').next().and_then(|cell| cell.parse().ok());
            let is_positive = |cell: &String| number(cell).is_some_and(|number: f64| number > 0.0);
            let is_not_compared = others.starts_with("cannot") && row[7].contains(&others);
            let is_measured = is_positive(&row[4]) && is_positive(&row[6]);
            assert!(is_measured || is_not_compared, "{parts}: {row:?}");
            if index < n_same {
                let change = number(&row[7]).is_some_and(|change| change <= 1e-10);
                assert!(change, "{parts}: the answer changes: {row:?}");
            } else if index + 1 < rows.len() {
                assert!(row[7].contains(&others), "{parts}: another method: {row:?}");
            }
        }
    }
}

#[test]
fn files_that_are_written_to_be_measured_do_not_stay() {
    let folder = Folder::new("explained-files");
    let mut command = folder.command("run --explain IN/cone-viscous.toml");
    let said = said(command.env("TMPDIR", &folder.0));
    assert_eq!(said.status, Some(0), "{said:?}");
    assert!(folder.names("").is_empty(), "{:?} stayed", folder.names(""));
}
