//! The commands of docs/scenes.md print what the page says.

use std::fs;
use std::path::Path;

use crate::support::{Folder, example};

/// Commands and what is printed, from the console blocks of a page.
fn console(page: &str) -> Vec<(String, String)> {
    let mut commands: Vec<(String, String)> = Vec::new();
    for block in page.split("```console\n").skip(1) {
        let block = block.split("```").next().expect("a block ends");
        for line in block.lines() {
            match (line.strip_prefix("$ viscofriction "), commands.last_mut()) {
                (Some(arguments), _) => commands.push((arguments.to_owned(), String::new())),
                (None, Some((_, printed))) => *printed += &format!("{line}\n"),
                (None, None) => panic!("a block begins with a command: {line}"),
            }
        }
    }
    commands
}

/// Times differ from run to run.
fn without_seconds(printed: &str) -> String {
    let lines = printed.lines().map(|line| match line.strip_suffix(" s") {
        Some(timed) => timed.rsplit_once("; ").map_or(timed, |(rest, _)| rest),
        None => line,
    });
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn the_commands_of_the_page_print_what_it_says() {
    let wrong = [("velocity = 0.01 ", "velocity = -0.01 ")];
    let folder = Folder::with("documented", "cone-viscous.toml", &wrong);
    let scenes = folder.path("examples/scenes");
    fs::create_dir_all(&scenes).expect("a folder");
    for name in ["cone-viscous.toml", "cone-half-space.toml"] {
        fs::copy(example(name), scenes.join(name)).expect("a scene");
    }
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scenes.md");
    let commands = console(&fs::read_to_string(page).expect("the page"));
    assert!(commands.len() >= 6, "only {} commands", commands.len());
    for (arguments, expected) in commands {
        let said = folder.run(&arguments);
        let printed = without_seconds(&(said.stdout + &said.stderr));
        assert_eq!(printed, without_seconds(&expected), "{arguments}");
    }
}
