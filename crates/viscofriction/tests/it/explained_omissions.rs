//! An answer knows everything that its scene did not need, and what that saves.

use std::fs;

use viscofriction::Omission;

use crate::support::{Folder, Solved, example, scene, table};

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
        let Solved { problem, answer } = folder.solved(file);
        let all = |text: &dyn Fn(Omission) -> String| {
            let texts: Vec<String> = answer.left_out.iter().map(|&one| text(one)).collect();
            texts.join(", ")
        };
        assert_eq!(all(&Omission::name), names, "{parts}");
        let saved = all(&|one| one.saves(&problem, &answer));
        assert!(saved.starts_with(&savings), "{parts}: {saved}");
    }
}
