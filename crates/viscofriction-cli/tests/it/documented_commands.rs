//! The commands in the console blocks of all pages print what the pages say.
//!
//! A block of TOML below a line that ends with the name of a file in backticks and a colon is that file. A command without output in
//! its block is only required to succeed. Sweeps of many points are run with fewer of them, see [`FEWER_POINTS`].

use std::fs;
use std::path::Path;

use crate::support::{Folder, repository};

/// Pages with console blocks, each run by a test of this name, and files that their commands need and the page only describes: the
/// name, the file of the page or of the repository that it is made of, and what is replaced in that.
macro_rules! pages {
    ($($test:ident: $page:literal, $files:expr;)*) => {
        const PAGES: &[&str] = &[$($page),*];

        mod commands_print_what_is_said_on {
            $(
                #[test]
                fn $test() {
                    super::assert_prints($page, $files);
                }
            )*
        }
    };
}

pages! {
    the_first_page: "README.md", &[];
    fits_of_friction: "docs/fit-friction.md", &[];
    layers: "docs/layers.md", &[];
    methods: "docs/methods.md", &[];
    roads: "docs/road.md", &[(
        "finest.toml",
        "road.toml",
        ["shortest_wavelength = 3.2e-4", "shortest_wavelength = 1.6e-4"],
    )];
    output: "docs/output.md", &[(
        "scene.toml",
        "examples/scenes/cone-viscous.toml",
        ["velocity = 0.01 ", "velocity = -0.01 "],
    )];
    numbers: "docs/numbers.md", &[];
    scenes: "docs/scenes.md", &[];
    sweeps: "docs/sweeps.md", &[("measured.csv", "examples/data/tread-rubber.csv", ["", ""])];
    the_tutorial: "docs/tutorial.md", &[];
}

type FileOfPage = (&'static str, &'static str, [&'static str; 2]);

/// Sweeps of which fewer points are run: the beginning of the command, the numbers of points that it has, as the command and its
/// output write them, and those that are run.
const FEWER_POINTS: [(&str, [[&str; 2]; 2]); 4] = [
    (
        "sweep examples/scenes/cone-half-space.toml",
        [[":5:log", ":2:log"], ["15", "6"]],
    ),
    ("sweep road.toml", [[":13:log", ":2:log"], ["39", "6"]]),
    ("sweep ball.toml", [[":11:log", ":2:log"], ["11", "2"]]),
    (
        "sweep examples/scenes/sphere-standard-solid.toml",
        [[":5:log", ":2:log"], ["5", "2"]],
    ),
];

/// Commands and what is printed, from the console blocks of a page.
fn console(page: &str) -> Vec<(String, String)> {
    let mut commands: Vec<(String, String)> = Vec::new();
    for block in page.split("```console\n").skip(1) {
        let block = block.split("```").next().expect("a block ends");
        for line in block.lines() {
            let command = line.strip_prefix("$ ");
            let command = command.map(|line| line.trim_start_matches("cargo "));
            match (
                command.and_then(|line| line.strip_prefix("viscofriction ")),
                commands.last_mut(),
            ) {
                (Some(arguments), _) => commands.push((arguments.to_owned(), String::new())),
                (None, Some((_, printed))) => *printed += &format!("{line}\n"),
                (None, None) => panic!("a block begins with a command: {line}"),
            }
        }
    }
    commands
}

/// Files that the page shows, with their contents.
fn shown_files(page: &str) -> Vec<(String, String)> {
    let blocks = page
        .match_indices("```toml\n")
        .filter_map(|(start, fence)| {
            let before = page[..start].trim_end().strip_suffix("`:")?;
            let name = before.rsplit('`').next()?;
            let contents = page[start + fence.len()..].split("```").next()?;
            Some((name.to_owned(), contents.to_owned()))
        });
    blocks.collect()
}

/// The command and what it prints with fewer points, where the command is one of [`FEWER_POINTS`].
fn with_fewer_points(arguments: &str, expected: &str) -> (String, String) {
    let fewer = FEWER_POINTS
        .iter()
        .find(|(command, _)| arguments.starts_with(command));
    let Some((_, [[values, fewer_values], [points, fewer_points]])) = fewer else {
        return (arguments.to_owned(), expected.to_owned());
    };
    assert!(arguments.contains(values), "{arguments} has other points");
    let counts = [
        ("", " points computed"),
        ("computed, ", " in"),
        ("(at ", " of"),
        (" of ", " points)"),
        (" of ", " points, with"),
    ];
    let expected = counts
        .iter()
        .fold(expected.to_owned(), |text, (before, after)| {
            let count = |points: &str| format!("{before}{points}{after}");
            text.replace(&count(points), &count(fewer_points))
        });
    (arguments.replace(values, fewer_values), expected)
}

/// Times differ from run to run.
fn without_seconds(printed: &str) -> String {
    let lines = printed.lines().map(|line| match line.strip_suffix(" s") {
        Some(timed) => timed.rsplit_once("; ").map_or(timed, |(rest, _)| rest),
        None => line,
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// A folder with the files that the commands of a page read.
fn folder_of(page: &str, text: &str, files: &[FileOfPage]) -> Folder {
    let folder = Folder::new(&format!("documented-{}", page.replace(['/', '.'], "-")));
    for below in [
        "examples/scenes",
        "examples/data",
        "crates/rheology/tests/data",
    ] {
        fs::create_dir_all(folder.path(below)).expect("a folder");
        let entries = fs::read_dir(repository().join(below)).expect("a folder");
        for entry in entries.map(|entry| entry.expect("an entry").path()) {
            if let (true, Some(name)) = (entry.is_file(), entry.file_name()) {
                fs::copy(&entry, folder.path(below).join(name)).expect("a copy");
            }
        }
    }
    for (name, contents) in shown_files(text) {
        folder.write(&name, contents);
    }
    for (name, source, [old, new]) in files {
        let shown = folder.path(source);
        let path = if shown.exists() {
            shown
        } else {
            repository().join(source)
        };
        let contents = fs::read(path).expect("a file");
        let Ok(text) = String::from_utf8(contents.clone()) else {
            folder.write(name, contents);
            continue;
        };
        assert!(text.contains(old), "no {old} in {source}");
        folder.write(
            name,
            if old.is_empty() {
                text
            } else {
                text.replace(old, new)
            },
        );
    }
    folder
}

/// Demands that the commands of a page print what it says.
fn assert_prints(page: &str, files: &[FileOfPage]) {
    let text = fs::read_to_string(repository().join(page)).expect("the page");
    let commands = console(&text);
    assert!(!commands.is_empty(), "no console block on {page}");
    let folder = folder_of(page, &text, files);
    for (arguments, expected) in commands {
        let (arguments, expected) = with_fewer_points(&arguments, &expected);
        let said = folder.run(&arguments);
        if expected.trim().is_empty() {
            assert_eq!(said.status, Some(0), "{page}: {arguments}: {said:?}");
            continue;
        }
        let printed = without_seconds(&(said.stdout + &said.stderr));
        assert_eq!(
            printed,
            without_seconds(expected.trim_end()),
            "{page}: {arguments}"
        );
    }
}

/// A page with a console block is run.
#[test]
fn all_pages_with_commands_are_known() {
    let mut pages = vec![repository().join("README.md")];
    for folder in ["docs", "docs/theory"] {
        let entries = fs::read_dir(repository().join(folder)).expect("a folder");
        pages.extend(entries.map(|entry| entry.expect("an entry").path()));
    }
    for page in pages
        .iter()
        .filter(|page| page.extension().is_some_and(|one| one == "md"))
    {
        let text = fs::read_to_string(page).expect("a page");
        let is_known = PAGES
            .iter()
            .any(|known| *page == repository().join(Path::new(known)));
        assert_eq!(text.contains("```console"), is_known, "{}", page.display());
    }
}
