//! Ten thousand mutilated scenes and as many tables: each is accepted, or refused with file and line, and none panics.
//!
//! Nothing is solved. `fuzz/` asks the same without end, guided by the branches that are taken.

use std::cell::Cell;
use std::fs;
use std::ops::{Range, RangeInclusive};
use std::path::{Path, PathBuf};

use casebook::fixed_cases;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};
use proptest::test_runner::TestRunner;
use viscofriction_cli::{InputKind, check_input};

use crate::support::{example, measured, npy};

/// What happens to a file, as often as it is named: a bit is flipped, something put in, a number replaced by another
/// value, a line deleted, put once more before another one (keys that are there twice, or in the table of others) or
/// without its end, and the file without its end.
const MUTATIONS: [&str; 9] = [
    "flip", "insert", "replace", "replace", "replace", "delete", "repeat", "cut", "truncate",
];

/// Values in the place of a number, each between commas.
const VALUES: &str = "0,-0.0,-1,nan,-nan,inf,-inf,1e308,-1e308,1e400,1e-308,5e-324,1e-400,0.5000000000000001,\
    9223372036854775807,-9223372036854775808,18446744073709551616,0x10,1_000,1e,\"1\",[],{},";
/// What is put somewhere, each between bars.
const INSERTS: &str = "[|]|[[|{|}|=|.|,|\"|'|\"\"\"|#|\n|\r|\0|\u{feff}|é| |[solve]\n|[indenter.sphere]\n|a.b.c = 1\n|\
    x = [[[[[[[[1]]]]]]]]\n|nan,nan\n|1,2,3,4,5,6,7\n";

/// A mutation of two places that are chosen: a part of the text is replaced by another one.
fn mutated(text: &[u8], (mutation, at, other): (&str, Index, Index)) -> Vec<u8> {
    if text.is_empty() {
        return Vec::new();
    }
    let place = at.index(text.len());
    let lines: Vec<&[u8]> = text.split_inclusive(|byte| *byte == b'\n').collect();
    let line = at.index(lines.len());
    let start: usize = lines[..line].iter().map(|line| line.len()).sum();
    let end = start + lines[line].len();
    let one_of = |texts: &'static str, end: char| {
        let texts: Vec<&str> = texts.split(end).collect();
        texts[other.index(texts.len())].as_bytes()
    };
    let flipped = [text[place] ^ (1 << other.index(8))];
    let (part, by): (Range<usize>, &[u8]) = match mutation {
        "flip" => (place..place + 1, &flipped),
        "insert" => (place..place, one_of(INSERTS, '|')),
        "replace" => (number_at(text, place), one_of(VALUES, ',')),
        "delete" => (start..end, &[]),
        "repeat" => (start..start, lines[other.index(lines.len())]),
        "cut" => (start + other.index(lines[line].len())..end, &[]),
        _ => (place..text.len(), &[]),
    };
    [&text[..part.start], by, &text[part.end..]].concat()
}

/// Where a number stands at a place or behind it, or else the end.
fn number_at(text: &[u8], place: usize) -> Range<usize> {
    let is_part = |byte: &u8| byte.is_ascii_digit() || b".+-eE".contains(byte);
    let digit = text[place..].iter().position(u8::is_ascii_digit);
    let digit = digit.map_or(text.len(), |digit| place + digit);
    let before = text[..digit].iter().rev().take_while(|byte| is_part(byte));
    let behind = text[digit..].iter().take_while(|byte| is_part(byte));
    digit - before.count()..digit + behind.count()
}

/// What a refusal must say first: the file and a line that it has, or the one behind its end; of an array the file.
fn names_place(message: &str, file: &Path, contents: &[u8]) -> bool {
    let lines = 1 + contents.split(|byte| *byte == b'\n').count();
    let names_line = |rest: &str| {
        let rest = rest.strip_prefix(':').or(rest.strip_prefix(", line "))?;
        let (line, why) = rest.split_once([':', ',', ' '])?;
        let line: usize = line.parse().ok()?;
        ((1..=lines).contains(&line) && !why.trim_matches([':', ',', ' ']).is_empty()).then_some(())
    };
    let is_array = file.extension().is_some_and(|extension| extension == "npy");
    let rest = message.strip_prefix(&file.display().to_string());
    let is_named = |rest: &str| is_array && rest.starts_with(": ") || names_line(rest).is_some();
    rest.is_some_and(is_named) && !message.contains(['\n', '\r'])
}

/// Checks files with one to four mutations each, and how many of them are accepted.
fn fuzz(kind: InputKind, files: &[(PathBuf, Vec<u8>)], cases: u32, expected: RangeInclusive<u32>) {
    let accepted = Cell::new(0);
    let mut runner = TestRunner::new(fixed_cases(cases));
    let mutation = (select(&MUTATIONS[..]), any::<Index>(), any::<Index>());
    let strategy = (any::<Index>(), vec(mutation, 1..5));
    let outcome = runner.run(&strategy, |(file, mutations)| {
        let (path, text) = file.get(files);
        let mutations = mutations.into_iter();
        let contents = mutations.fold(text.clone(), |text, mutation| mutated(&text, mutation));
        match check_input(kind, path, &contents) {
            Ok(()) => accepted.set(accepted.get() + 1),
            Err(error) => prop_assert!(
                names_place(&error.to_string(), path, &contents),
                "{error}\n--- of\n{}",
                String::from_utf8_lossy(&contents)
            ),
        }
        Ok(())
    });
    if let Err(failure) = outcome {
        panic!("{kind:?}: {failure}");
    }
    let accepted = accepted.get();
    let is_usual = expected.contains(&accepted);
    assert!(is_usual, "{kind:?}: {accepted} of {cases} were accepted");
}

fn read(path: PathBuf) -> (PathBuf, Vec<u8>) {
    let contents = fs::read(&path).expect("a committed file");
    (path, contents)
}

#[test]
fn mutilated_scenes_are_accepted_or_refused_with_file_and_line() {
    let folder = fs::read_dir(example("")).expect("the scenes are there");
    let paths = folder.map(|entry| entry.expect("an entry").path());
    let is_scene = |path: &PathBuf| path.extension().is_some_and(|end| end == "toml");
    let mut scenes: Vec<_> = paths.filter(is_scene).map(read).collect();
    scenes.sort();
    // Comments, and numbers that are right too.
    fuzz(InputKind::Scene, &scenes, 10_000, 500..=6_000);
}

#[test]
fn mutilated_tables_are_accepted_or_refused_with_file_and_line() {
    let rows = "sweep,point,points,load.velocity,failure\n5ca1ab1e,1,2,0.5,\n5ca1ab1e,2,2,0.7,\"no, \"\"never\"\"\"\n";
    let moduli = ["frequency_master", "frequency_raw", "time_master"].map(|name| {
        let (path, contents) = read(measured(&format!("pyvisco_{name}.csv")));
        let lines = contents.split_inclusive(|byte| *byte == b'\n').take(24);
        (path, lines.collect::<Vec<_>>().concat())
    });
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (12, 16), }";
    let heights = (0..192).flat_map(|index| f64::from(index).to_le_bytes());
    let heights: Vec<u8> = heights.collect();
    let array = (PathBuf::from("map.npy"), npy(header, &heights));
    let rows = ("rows.csv".into(), rows.into());
    let [profile, map] = ["profile.csv", "tread.csv"].map(|name| read(example(name)));
    let texts = texts_of_heights().map(|(name, text)| (PathBuf::from(name), text.into_bytes()));
    for (kind, files, most) in [
        (InputKind::Profile, &[profile][..], 3_500),
        (InputKind::HeightMap, &[map], 3_500),
        (InputKind::HeightMap, &texts, 3_500),
        (InputKind::SweepRows, &[rows], 3_500),
        (InputKind::Moduli, &moduli, 3_500),
        // Whatever changes more than a bit changes the length, too.
        (InputKind::HeightMap, &[array], 500),
    ] {
        fuzz(kind, files, 4_000, 100..=most);
    }
}

/// A map of 6 × 5 heights as programs write it in text.
fn texts_of_heights() -> [(&'static str, String); 4] {
    let height = |index: u32| f64::from(index * index * 7 % 31) / 8.0;
    let row = |row: u32, mark: &str| {
        let heights = (0..6).map(|column| height(6 * row + column).to_string());
        heights.collect::<Vec<_>>().join(mark) + "\n"
    };
    let rows = |mark: &str| (0..5).map(|index| row(index, mark)).collect::<String>();
    let points = (0..30).map(|index| {
        format!(
            "{:.2}\t{:.2}\t{}\n",
            f64::from(index % 6) / 3.0,
            f64::from(index / 6) * 0.7,
            height(index)
        )
    });
    let points: String = points.collect();
    [
        (
            "gwyddion.txt",
            format!(
                "# Channel: A\n# Width: 6 µm\n# Height: 5 µm\n# Value units: nm\n{}",
                rows("\t")
            ),
        ),
        ("german.csv", rows(";").replace('.', ",")),
        (
            "grid.asc",
            format!(
                "ncols 6\nnrows 5\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n{}",
                rows(" ")
            ),
        ),
        ("points.xyz", format!("# x [um] y [um] z [nm]\n{points}")),
    ]
}

/// Depth that a reader without limits would follow until its stack ends.
#[test]
fn endless_nesting_is_refused() {
    for [start, open, inside, close] in [
        ["x = ", "[", "1", "]"],
        ["x = ", "{ a = ", "1", " }"],
        ["", "a.", "a = 1", ""],
        ["[", "a.", "a]", ""],
        ["", "[[a]]\n", "", ""],
    ] {
        let [open, close] = [open, close].map(|part| part.repeat(100_000));
        let text = [start, &open, inside, &close].concat();
        let file = Path::new("scene.toml");
        let error = check_input(InputKind::Scene, file, text.as_bytes()).expect_err("no scene");
        let helpful = names_place(&error.to_string(), file, text.as_bytes());
        assert!(helpful, "{}…: {error}", &text[..20]);
    }
}
