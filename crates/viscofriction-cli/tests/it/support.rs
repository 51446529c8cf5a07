//! Folders in which the program runs, scenes, and the numbers of results.

use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use serde_json::Value;
use viscofriction::Estimate;

/// Cases of the tests.
const TABLES: [&str; 3] = [
    include_str!("../data/answers.txt"),
    include_str!("../data/cases.txt"),
    include_str!("../data/malformed.txt"),
];

/// The scene of `body; material; load; solution`, of which the first two may be names.
#[track_caller]
pub(crate) fn scene(parts: &str) -> String {
    let parts: Vec<&str> = parts.split("; ").collect();
    let known = table("bodies and materials");
    let known = |name: &str| {
        let found = known.iter().find(|[known, _]| known == name);
        found.map_or(name, |[_, table]| table).to_owned()
    };
    let [body, material] = [parts[0], parts[1]].map(known);
    let [load, solve] = [parts[2], parts[3]];
    format!("load = {{ {load} }}\nsolve = {{ {solve} }}\n{body}\n{material}\n")
}

/// The rows below the line `== name: columns` of a file of tables, without those that begin with `#`, in cells, of which
/// those at the end may be left out. A row that ends with ` |` has its last cell in the lines below it, indented by four
/// blanks.
#[track_caller]
pub(crate) fn table<const N: usize>(name: &str) -> Vec<[String; N]> {
    let mut all = TABLES.iter().flat_map(|file| file.split("\n== ").skip(1));
    let found = all.find_map(|table| table.strip_prefix(name)?.strip_prefix(": "));
    let found = found.unwrap_or_else(|| panic!("no table {name}"));
    let lines = found.lines().skip(1).filter(|line| !line.starts_with('#'));
    let table = lines.collect::<Vec<_>>().join("\n");
    let table = table.replace(" |\n    ", " | ").replace("\n    ", "\\n");
    let row = |line: &str| {
        let mut cells = line.splitn(N, " | ");
        [(); N].map(|()| cells.next().unwrap_or_default().replace("\\n", "\n"))
    };
    table.lines().map(row).collect()
}

/// A committed scene, or a file that one names.
pub(crate) fn example(name: &str) -> PathBuf {
    PathBuf::from(argument(&format!("IN/{name}")))
}

/// A committed table of measured moduli.
pub(crate) fn measured(name: &str) -> PathBuf {
    PathBuf::from(argument(&format!("DATA/{name}")))
}

/// What a run of the program says.
#[derive(Debug)]
pub(crate) struct Said {
    pub(crate) status: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

/// A folder in which the program runs.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    /// An empty folder of this name.
    pub(crate) fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        fs::remove_dir_all(&folder).ok();
        fs::create_dir_all(&folder).expect("the folder can be made");
        Self(folder)
    }

    /// A folder with a committed scene, in which some texts are replaced by others, as `scene.toml`.
    #[track_caller]
    pub(crate) fn with(name: &str, scene: &str, replaced: &[(&str, &str)]) -> Self {
        let folder = Self::new(name);
        let mut text = fs::read_to_string(example(scene)).expect("a committed scene");
        for (old, new) in replaced {
            assert!(text.contains(old), "no {old} in {scene}");
            text = text.replace(old, new);
        }
        folder.write("scene.toml", text);
        folder
    }

    pub(crate) fn path(&self, file: &str) -> PathBuf {
        self.0.join(file)
    }

    pub(crate) fn write(&self, file: &str, contents: impl AsRef<[u8]>) {
        fs::write(self.path(file), contents).expect("the file can be written");
    }

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

    /// The result of a [`scene`] of these parts.
    #[track_caller]
    pub(crate) fn answer(&self, parts: &str) -> Value {
        self.write("scene.toml", scene(parts));
        self.json("scene.toml")
    }

    /// Begins to run the program, and kills it as soon as this holds; whether it had not ended before.
    pub(crate) fn kill_when(&self, line: &str, holds: impl Fn() -> bool) -> bool {
        let child = self.command(line).stdout(Stdio::null()).spawn();
        let mut child = child.expect("the command runs");
        let mut runs = true;
        while runs && !holds() {
            runs = child.try_wait().expect("a state").is_none();
            std::thread::sleep(Duration::from_millis(1));
        }
        child.kill().ok();
        child.wait().expect("it ends");
        runs
    }
}

/// A word of a line with paths in their places.
pub(crate) fn argument(word: &str) -> String {
    let crates = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    let word = word.replace("IN/", &format!("{crates}/../examples/scenes/"));
    word.replace("DATA/", &format!("{crates}/rheology/tests/data/"))
}

/// What a command says.
pub(crate) fn said(command: &mut Command) -> Said {
    let output = command.output().expect("the command runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Said {
        status: output.status.code(),
        stdout: text(&output.stdout),
        stderr: text(&output.stderr),
    }
}

/// A quantity of a result.
#[track_caller]
pub(crate) fn number(result: &Value, field: &str) -> f64 {
    let value = result[field].as_f64();
    value.unwrap_or_else(|| panic!("{field} is missing in {result}"))
}

/// A quantity with its error.
#[track_caller]
pub(crate) fn estimate(result: &Value, field: &str) -> Estimate {
    Estimate::new(
        number(result, field),
        number(result, &format!("{field}_error")),
    )
}

/// Requires that two values differ by their errors at most, which together are less than a part of the second one, or of
/// one where that is zero, and zero only of a part of zero.
#[track_caller]
pub(crate) fn assert_agree(what: impl Display, one: Estimate, other: Estimate, part: f64) {
    let error = one.error + other.error;
    let is_zero = other.value == 0.0;
    let scale = if is_zero { 1.0 } else { other.value.abs() };
    let is_small = (error > 0.0 && error < part * scale) || (error == 0.0 && part == 0.0);
    let agree = (one.value - other.value).abs() <= error;
    assert!(agree && is_small, "{what}: {one:?} and {other:?}");
}

/// Requires a value that is off by a part of what is expected at most.
#[track_caller]
pub(crate) fn assert_close(what: impl Display, value: f64, expected: f64, part: f64) {
    let off = (value / expected - 1.0).abs();
    let said = format!("{what}: {value} instead of {expected}");
    assert!(off < part, "{said}, off by {off:e}");
}

/// A file as `numpy.save` of NumPy 2.4.6 writes it in the format 1.0, of a header and numbers.
pub(crate) fn npy(header: &str, numbers: &[u8]) -> Vec<u8> {
    // Up to a line feed in front of a multiple of 64 bytes.
    let length = (10 + header.len() + 1).next_multiple_of(64) - 10;
    let counted = u16::try_from(length).expect("a short header");
    let line = format!("{header:<padded$}\n", padded = length - 1);
    let start = b"\x93NUMPY\x01\x00";
    [start, &counted.to_le_bytes()[..], line.as_bytes(), numbers].concat()
}
