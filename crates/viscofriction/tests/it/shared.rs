//! Folders with scenes, tables of cases, and the numbers of results, for the tests of the library and of the program.

use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::TABLES;

/// A folder with scenes and what they name.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    /// An empty folder of this name.
    pub(crate) fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(env!("CARGO_PKG_NAME"));
        let folder = folder.join(name);
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
}

/// The scene of `body; material; load; solution`; the first two may be names.
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

/// Contents of a file, the place in it that is named, and what is said.
pub(crate) type Case = (Vec<u8>, String, String);

/// The cases of a table of places, of what is said, and of contents, which end with a line feed unless there are none.
#[track_caller]
pub(crate) fn cases(name: &str, place: impl Fn(&str) -> String) -> Vec<Case> {
    let contents = |text: &str| match text.strip_suffix("\\xff") {
        Some(start) => [start.as_bytes(), b"\xff\n"].concat(),
        None if text.is_empty() => Vec::new(),
        None => format!("{text}\n").into(),
    };
    let case = |[at, needed, text]: [String; 3]| (contents(&text), place(&at), needed);
    table(name).into_iter().map(case).collect()
}

/// A committed scene, or a file that one names.
pub(crate) fn example(name: &str) -> PathBuf {
    PathBuf::from(argument(&format!("IN/{name}")))
}

/// A word of a line with paths in their places.
pub(crate) fn argument(word: &str) -> String {
    let crates = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    let word = word.replace("IN/", &format!("{crates}/../examples/scenes/"));
    word.replace("DATA/", &format!("{crates}/rheology/tests/data/"))
}

/// A quantity of a result.
#[track_caller]
pub(crate) fn number(result: &Value, field: &str) -> f64 {
    let value = result[field].as_f64();
    value.unwrap_or_else(|| panic!("{field} is missing in {result}"))
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
