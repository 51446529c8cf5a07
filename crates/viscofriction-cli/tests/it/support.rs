//! Runs of the program in a folder, with its output.

use std::fs;
use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};

use serde_json::Value;

#[path = "../../../viscofriction/tests/it/shared.rs"]
mod shared;

pub(crate) use shared::*;

/// Cases of the tests.
const TABLES: [&str; 3] = [
    include_str!("../../../viscofriction/tests/data/cases.txt"),
    include_str!("../data/cases.txt"),
    include_str!("../data/malformed.txt"),
];

/// The root of the repository.
pub(crate) fn repository() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// A committed table of measured moduli.
pub(crate) fn measured(name: &str) -> PathBuf {
    PathBuf::from(argument(&format!("DATA/{name}")))
}

/// What a run of the program says.
#[derive(Debug, Default)]
pub(crate) struct Said {
    pub(crate) status: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Folder {
    #[track_caller]
    pub(crate) fn text(&self, file: &str) -> String {
        fs::read_to_string(self.path(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
    }

    /// The numbers in a column of a table with a line of names.
    #[track_caller]
    pub(crate) fn column(&self, file: &str, column: usize) -> Vec<f64> {
        let text = self.text(file);
        let cell = |row: &str| row.split(',').nth(column)?.parse().ok();
        let cells: Option<Vec<f64>> = text.lines().skip(1).map(cell).collect();
        cells.unwrap_or_else(|| panic!("{file}: column {column} of {text}"))
    }

    /// The names of what is in a folder in this one, if that is there.
    pub(crate) fn names(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(folder)).into_iter().flatten();
        let names = entries.map(|entry| entry.expect("an entry").file_name());
        let names = names.map(|name| name.into_string().expect("a name in Unicode"));
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }

    /// The program in this folder; `IN/` stands for the committed scenes, and `DATA/` for the tables of moduli.
    pub(crate) fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_viscofriction"));
        command
            .current_dir(&self.0)
            .args(line.split_whitespace().map(argument));
        command
    }

    /// The program, run.
    pub(crate) fn run(&self, line: &str) -> Said {
        said(&mut self.command(line))
    }

    /// The program, run until it ends with this status and says this beside its output.
    #[track_caller]
    pub(crate) fn ends(&self, line: &str, status: i32, needed: &str) -> Said {
        let said = self.run(line);
        let right = said.status == Some(status) && said.stderr.contains(needed);
        assert!(right, "{line}: needs {status} and {needed:?}, but {said:?}");
        said
    }

    /// The program, run without fault.
    #[track_caller]
    pub(crate) fn done(&self, line: impl AsRef<str>) -> Said {
        self.ends(line.as_ref(), 0, "")
    }

    /// The result of a scene.
    #[track_caller]
    pub(crate) fn json(&self, line: &str) -> Value {
        let said = self.done(format!("run --format json {line}"));
        serde_json::from_str(&said.stdout).expect("JSON")
    }

    /// Begins to run the program, and kills it as soon as this holds; whether it had not ended before.
    pub(crate) fn kill_when(&self, line: &str, holds: impl Fn() -> bool) -> bool {
        let mut child = self.begun(line);
        let mut runs = true;
        while runs && !holds() {
            runs = child.try_wait().expect("a state").is_none();
            std::thread::yield_now();
        }
        child.kill().ok();
        child.wait().expect("it ends");
        runs
    }

    /// The program, which has begun to run.
    pub(crate) fn begun(&self, line: &str) -> Child {
        let mut command = self.command(line);
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        command.spawn().expect("the command runs")
    }
}

/// What the first of two programs that ends says; the other one is killed.
pub(crate) fn first_to_end(mut children: [Child; 2]) -> Said {
    let ended = loop {
        let has_ended = |child: &mut Child| child.try_wait().expect("a state").is_some();
        if let Some(place) = children.iter_mut().position(has_ended) {
            break place;
        }
        std::thread::yield_now();
    };
    children[1 - ended].kill().expect("the other one runs");
    let mut said = children.map(|child| Said::of(&child.wait_with_output().expect("it ends")));
    std::mem::take(&mut said[ended])
}

/// What a command says.
pub(crate) fn said(command: &mut Command) -> Said {
    Said::of(&command.output().expect("the command runs"))
}

impl Said {
    fn of(output: &Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Self {
            status: output.status.code(),
            stdout: text(&output.stdout),
            stderr: text(&output.stderr),
        }
    }
}
