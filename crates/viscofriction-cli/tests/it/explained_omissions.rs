//! `run --explain` says everything that a scene did not need, and what that saves.

use std::fs;

use crate::support::{Folder, example, rows, scene};

/// Scene | parts that it does not need | what leaving out the first of them saves. The tread is not its own mirror image.
const EXPLAINED: &str = r#"
paraboloid; viscous; normal_force = 1.0, velocity = 0.01; method = "bem-steady", elements = 8 | mirror half, transforms, time steps | 84 of 162 elements in contact are unknowns, the equations of 84 unknowns are factorised
cone; viscous; normal_force = 1.0, velocity = 0.01; method = "bem-steady", elements = 8 | mirror half, outside contact, time steps
paraboloid; viscous; indentation_depth = 1e-4, velocity = 0.01; method = "bem-transient", sliding_distance = 5.0e-3, elements = 12 | mirror half, outside contact, rows behind | 780 of 1521 elements of the footprint are followed, 100 of 1521 elements of the footprint are in contact, each of 60 time steps leaves a row of elements behind
paraboloid; prony; normal_force = 1.0, velocity = 0.0; method = "bem-transient", duration = 0.5, elements = 24 | time steps, mirror half, gradients, history fields | one state instead of a march in time, 729 of 2809 elements of the footprint are followed, no slope of an element is computed, 0 values per element instead of 2
cone; maxwell; indentation_depth = 1e-4, velocity = 0.0; method = "bem-transient", duration = 1.0e-3, elements = 24 | time steps, mirror half, gradients
cone; viscous; normal_force = 1.0, velocity = 0.01; model = "line" | numerical solution, time steps
paraboloid; elastic; normal_force = 1.0, velocity = 0.01; method = "bem-steady", elements = 12 | mirror half, outside contact, time steps
scene.toml | outside contact, time steps
IN/half-space-run-in.toml | mirror half, outside contact, rows behind
IN/hertz.toml | half space
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
fn what_a_scene_does_not_need_is_said_and_counted() {
    let elements = [("relative_error = 2e-2", "elements = 16")];
    let folder = Folder::with("explained", "tread.toml", &elements);
    fs::copy(example("tread.csv"), folder.path("tread.csv")).expect("a map");
    for [parts, names, savings] in rows(EXPLAINED) {
        let file = if parts.contains("; ") {
            folder.write("parts.toml", scene(&parts));
            "parts.toml"
        } else {
            &parts
        };
        let rows = explained(&folder, file);
        let [found, saved] = [1, 3].map(|column| {
            let cells: Vec<&str> = rows.iter().map(|row| row[column].as_str()).collect();
            cells.join(", ")
        });
        assert_eq!(found, names + ", files", "{parts}");
        assert!(saved.starts_with(&savings), "{parts}: {saved}");
    }
}
