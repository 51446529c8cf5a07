//! What the tests of commands share.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// An empty folder of this name.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::remove_dir_all(&folder).ok();
    fs::create_dir_all(&folder).expect("the folder can be made");
    folder
}

/// The command, run with arguments that blanks separate.
pub(crate) fn xtask(line: &str) -> Output {
    run(line.split(' '))
}

/// The command, run.
pub(crate) fn run<'a>(arguments: impl IntoIterator<Item = &'a str>) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_xtask"));
    command.args(arguments).output().expect("the command runs")
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A page of the documentation.
pub(crate) fn page(name: &str) -> String {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    fs::read_to_string(docs.join(name).with_extension("md")).expect("a page")
}

pub(crate) fn argument(path: &Path) -> &str {
    path.to_str().expect("a path in Unicode")
}

/// A row of a table, by the names of its columns.
pub(crate) type Row = HashMap<String, String>;

/// A number that must be there and finite.
pub(crate) fn number(row: &Row, column: &str) -> f64 {
    let value = row[column].parse::<f64>().ok();
    let value = value.filter(|value| value.is_finite());
    value.unwrap_or_else(|| panic!("{column} of {row:?}"))
}

/// What a quick run of an experiment left behind.
pub(crate) struct Evidence {
    pub(crate) folder: PathBuf,
    pub(crate) printed: String,
}

impl Evidence {
    /// Runs an experiment with its options, separated by blanks, into an empty folder of this name.
    pub(crate) fn quick(name: &str, line: &str) -> Self {
        // Tests that share a run may be processes of their own.
        let mut evidence = Self {
            folder: folder(&format!("{name}-{}", std::process::id())),
            printed: String::new(),
        };
        evidence.printed = evidence.again(line);
        evidence
    }

    /// Runs an experiment into what is there; what it prints.
    pub(crate) fn again(&self, line: &str) -> String {
        let common = ["evidence", "--quick", "--out", argument(&self.folder)];
        let output = run(common.into_iter().chain(line.split(' ')));
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{line}: {message}");
        text(&output.stdout)
    }

    /// The rows of one of its tables.
    pub(crate) fn rows(&self, table: &str) -> Vec<Row> {
        let path = self.folder.join(table).with_extension("csv");
        let mut reader = csv::Reader::from_path(path).expect("a table");
        let rows = reader.deserialize().collect::<Result<_, _>>();
        rows.expect("rows of the table")
    }

    /// Demands pictures that are more than a frame.
    pub(crate) fn assert_pictures(&self, names: &[&str]) {
        for name in names {
            for ending in ["svg", "png"] {
                let picture = self.folder.join(name).with_extension(ending);
                let size = fs::metadata(picture);
                assert!(size.is_ok_and(|size| size.len() > 1000), "{name}.{ending}");
            }
        }
    }
}
