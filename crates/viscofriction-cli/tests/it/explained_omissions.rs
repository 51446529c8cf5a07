//! `run --explain` says everything that a scene did not need, and what that saves.

use std::fs;

use crate::support::{Folder, example, scene, table};

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
    for [parts, names, savings] in table("explained") {
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
