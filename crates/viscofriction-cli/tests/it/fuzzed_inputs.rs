//! Mutated files of every kind that the commands read: each is accepted, or refused with its place, and none panics.
//!
//! Nothing is solved. `FUZZ_CASES=100000 FUZZ_SEED=7 cargo nextest run fuzzed_inputs` tries more files, and others. What it finds is
//! written beside the tests and belongs into `tests/corpus`, which is tried in every run. `fuzz/` asks the same without end, guided by
//! the branches that are taken.

use std::cell::Cell;
use std::env;
use std::fs;
use std::ops::{Range, RangeInclusive};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use casebook::fixed_cases;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};
use proptest::test_runner::{Config, RngSeed, TestCaseError, TestRunner};
use viscofriction_cli::{InputKind, check_input};

use crate::support::{Folder, example, measured, npy};

#[path = "../../../../fuzz/src/lib.rs"]
#[expect(unreachable_pub, reason = "the library of the fuzz targets")]
mod oracle;

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
    // All lines, and where one of them stands.
    let lines = || {
        let lines: Vec<&[u8]> = text.split_inclusive(|byte| *byte == b'\n').collect();
        let line = at.index(lines.len());
        let start: usize = lines[..line].iter().map(|line| line.len()).sum();
        let end = start + lines[line].len();
        (lines, start..end)
    };
    let one_of = |texts: &'static str, end: char| {
        let texts: Vec<&str> = texts.split(end).collect();
        texts[other.index(texts.len())].as_bytes()
    };
    let flipped = [text[place] ^ (1 << other.index(8))];
    let (part, by): (Range<usize>, &[u8]) = match mutation {
        "flip" => (place..place + 1, &flipped),
        "insert" => (place..place, one_of(INSERTS, '|')),
        "replace" => (number_at(text, place), one_of(VALUES, ',')),
        "delete" => (lines().1, &[]),
        "repeat" => {
            let (lines, line) = lines();
            (line.start..line.start, lines[other.index(lines.len())])
        }
        "cut" => {
            let (_, line) = lines();
            (line.start + other.index(line.len())..line.end, &[])
        }
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

/// Number of files of a kind that are mutated: that in the environment variable `FUZZ_CASES`, or else `otherwise`.
fn cases(otherwise: u32) -> u32 {
    let given = env::var("FUZZ_CASES").ok();
    given.map_or(otherwise, |cases| {
        cases.parse().expect("FUZZ_CASES is a number")
    })
}

/// Configuration with the same cases in every run, unless the environment variable `FUZZ_SEED` asks for others.
fn config(cases: u32) -> Config {
    let fixed = fixed_cases(cases);
    let seed = env::var("FUZZ_SEED").ok();
    let seed = seed.map(|seed| RngSeed::Fixed(seed.parse().expect("FUZZ_SEED is a number")));
    Config {
        rng_seed: seed.unwrap_or(fixed.rng_seed),
        ..fixed
    }
}

/// Checks files with one to four mutations each, and which part of them is accepted.
fn fuzz(
    name: &str,
    files: &[(PathBuf, Vec<u8>)],
    cases: u32,
    expected: RangeInclusive<f64>,
    check: impl Fn(&Path, &[u8]) -> Result<bool, String>,
) {
    let accepted = Cell::new(0);
    let mut runner = TestRunner::new(config(cases));
    let mutation = (select(&MUTATIONS[..]), any::<Index>(), any::<Index>());
    let strategy = (any::<Index>(), vec(mutation, 1..5));
    let findings = Folder::new(&format!("findings of {name}"));
    let outcome = runner.run(&strategy, |(file, mutations)| {
        let (path, text) = file.get(files);
        let mutations = mutations.into_iter();
        let contents = mutations.fold(text.clone(), |text, mutation| mutated(&text, mutation));
        let checked = catch_unwind(AssertUnwindSafe(|| check(path, &contents)));
        let wrong = match checked {
            Ok(Ok(is_accepted)) => {
                accepted.set(accepted.get() + u32::from(is_accepted));
                return Ok(());
            }
            Ok(Err(message)) => message,
            Err(_) => "a panic".to_owned(),
        };
        let file = path.file_name().expect("a name").to_string_lossy();
        // The last one that is written has the fewest mutations.
        findings.write(&file, &contents);
        let place = findings.path(&file);
        let place = place.display();
        Err(TestCaseError::fail(format!(
            "{wrong}; {place} belongs into tests/corpus"
        )))
    });
    if let Err(failure) = outcome {
        panic!("{name}: {failure}");
    }
    let part = f64::from(accepted.get()) / f64::from(cases);
    let is_usual = expected.contains(&part);
    assert!(is_usual, "{name}: {part} of {cases} were accepted");
}

fn read(path: PathBuf) -> (PathBuf, Vec<u8>) {
    let contents = fs::read(&path).expect("a committed file");
    (path, contents)
}

#[test]
fn mutated_scenes_are_accepted_or_refused_with_file_and_line() {
    let folder = fs::read_dir(example("")).expect("the scenes are there");
    let paths = folder.map(|entry| entry.expect("an entry").path());
    let is_scene = |path: &PathBuf| path.extension().is_some_and(|end| end == "toml");
    let mut scenes: Vec<_> = paths.filter(is_scene).map(read).collect();
    scenes.sort();
    // Comments, and numbers that are right too.
    fuzz(
        "scenes",
        &scenes,
        cases(5_000),
        0.05..=0.6,
        |file, contents| oracle::check(InputKind::Scene, file, contents),
    );
}

#[test]
fn mutated_tables_are_accepted_or_refused_with_file_and_line() {
    let rows = "sweep,point,points,load.velocity,failure\n5ca1ab1e,1,2,0.5,\n5ca1ab1e,2,2,0.7,\"no, \"\"never\"\"\"\n";
    let moduli = ["frequency_master", "frequency_raw", "time_master"].map(|name| {
        let (path, contents) = read(measured(&format!("pyvisco_{name}.csv")));
        (path, first_lines(&contents, 24))
    });
    let [curve, friction] = ["brain.csv", "friction.csv"].map(|name| {
        let (path, contents) = read(example("../data").join(name));
        (path, first_lines(&contents, 40))
    });
    let rows = ("rows.csv".into(), rows.into());
    let [profile, map] = ["profile.csv", "tread.csv"].map(|name| read(example(name)));
    let texts = texts_of_heights().map(|(name, text)| (PathBuf::from(name), text.into_bytes()));
    for (kind, files, usual) in [
        (InputKind::Profile, &[profile][..], 0.03..=0.9),
        (InputKind::HeightMap, &[map], 0.08..=0.9),
        (InputKind::HeightMap, &texts, 0.05..=0.95),
        (InputKind::SweepRows, &[rows], 0.08..=0.9),
        (InputKind::Moduli, &moduli, 0.06..=0.9),
        (InputKind::Curve, &[curve], 0.03..=0.9),
        (InputKind::Friction, &[friction], 0.06..=0.9),
    ] {
        let check = |file: &Path, contents: &[u8]| oracle::check(kind, file, contents);
        fuzz(&format!("{kind:?}"), files, cases(1_000), usual, check);
    }
}

fn first_lines(contents: &[u8], count: usize) -> Vec<u8> {
    let lines = contents.split_inclusive(|byte| *byte == b'\n').take(count);
    lines.collect::<Vec<_>>().concat()
}

#[test]
fn mutated_surfaces_are_accepted_or_refused_with_their_file() {
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (12, 16), }";
    let heights = (0..192).flat_map(|index| f64::from(index).to_le_bytes());
    let array = npy(header, &heights.collect::<Vec<_>>());
    let field = "Gwyddion Simple Field 1.0\nXRes = 3\nYRes = 2\nXReal = 3e-6\nYReal = 2e-6\nZUnits = m\n\0\0";
    let single = (0_u8..6).flat_map(|index| (1e-9 * f32::from(index)).to_le_bytes());
    let field = field.bytes().chain(single).collect();
    let grid = "ncols 3\nnrows 2\ncellsize 1e-6\nNODATA_value -9999\n1 2 3\n4 -9999 6\n";
    let points = "0 0 1\n1 0 2\n0 1 3\n1 1 4\n";
    let (_, road) = read(example("../data/road.x3p"));
    let files = [
        ("map.npy", array, 0.01..=0.9),
        ("map.gsf", field, 0.02..=0.9),
        ("map.sur", digital_surf(), 0.1..=0.9),
        ("map.asc", grid.into(), 0.01..=0.9),
        ("map.xyz", points.into(), 0.01..=0.9),
        // Its checksums leave next to nothing that may change.
        ("road.x3p", road, 0.0..=0.1),
    ];
    for (file, contents, usual) in files {
        // Whatever changes more than a bit of a binary format changes its length, too.
        let check =
            |file: &Path, contents: &[u8]| oracle::check(InputKind::HeightMap, file, contents);
        fuzz(file, &[(file.into(), contents)], cases(1_000), usual, check);
    }
}

/// A surface of Digital Surf with 3 × 2 points of 16 bits.
fn digital_surf() -> Vec<u8> {
    let mut surface = vec![0; 512 + 12];
    let mut set = |at: usize, bytes: &[u8]| surface[at..at + bytes.len()].copy_from_slice(bytes);
    set(0, b"DIGITAL SURF");
    set(18, &2_u16.to_le_bytes());
    set(98, &16_u16.to_le_bytes());
    set(108, &3_u32.to_le_bytes());
    set(112, &2_u32.to_le_bytes());
    for (at, number) in [(120, 1e-6_f32), (124, 1e-6), (128, 1e-9)] {
        set(at, &number.to_le_bytes());
    }
    for at in [180, 196, 212] {
        set(at, b"m");
    }
    for index in 0..6_u8 {
        set(
            512 + 2 * usize::from(index),
            &u16::from(index).to_le_bytes(),
        );
    }
    surface
}

/// Files that a scene names, each in a scene of its own.
const NAMED: [[&str; 3]; 4] = [
    [
        "history.csv",
        "load.history_file = \"history.csv\"\nindenter.sphere.radius = 5e-3\nmaterial.elastic.shear_modulus = 1e6\n",
        "time_s,indentation_depth_m\n0,0\n0.5,1e-6\n1,2e-6\n2,0\n",
    ],
    [
        "motion.csv",
        "load.motion_file = \"motion.csv\"\nindenter.sphere.radius = 5e-3\nmaterial.viscous.viscosity = 1e6\nsolve.model = \"line\"\n",
        "time_s,position_m,normal_force_n\n0,0,1\n0.5,1e-3,1\n1,2e-3,2\n2,0,1\n",
    ],
    [
        "spectrum.csv",
        "load = { mean_pressure = 1e5, velocity = 1e-3 }\nmaterial.elastic.shear_modulus = 1e6\n[indenter.spectrum]\nfile = \"spectrum.csv\"\n\
         period = [1e-3, 1e-3]\nseed = 1\n",
        "wave_number,density\n6e3,1e-18\n1e4,2e-19\n3e4,1e-20\n",
    ],
    [
        "material.toml",
        "load = { normal_force = 1.0, velocity = 1e-3 }\nindenter.sphere.radius = 5e-3\nmaterial.file = { path = \"material.toml\", temperature = 30 }\n",
        "[material.prony]\nequilibrium_modulus = 1e6\nbranches = [{ modulus = 1e6, relaxation_time = 1e-3 }]\n\
         valid_frequencies = [1e-2, 1e3]\nshift = { temperature = 20.0, temperature_range = [0.0, 40.0], law = { wlf = [17.4, 51.6] } }\n\
         covariance = { method = \"scatter\", relative = [[1e-4, 0.0], [0.0, 1e-4]] }\n",
    ],
];

#[test]
fn mutated_files_of_scenes_are_accepted_or_refused_with_both_places() {
    let folder = Folder::new("mutated files of scenes");
    for [file, scene, contents] in NAMED {
        folder.write("scene.toml", scene);
        let whole = check_named(&folder, file, contents.as_bytes());
        assert_eq!(whole, Ok(true), "{file}");
        let check = |_: &Path, contents: &[u8]| check_named(&folder, file, contents);
        fuzz(
            file,
            &[(file.into(), contents.into())],
            cases(500),
            0.02..=0.9,
            check,
        );
    }
}

/// Checks the scene of a folder, which names a file of these contents.
fn check_named(folder: &Folder, file: &str, contents: &[u8]) -> Result<bool, String> {
    folder.write(file, contents);
    let scene = folder.path("scene.toml");
    let Err(error) = check_input(
        InputKind::Scene,
        &scene,
        folder.text("scene.toml").as_bytes(),
    ) else {
        return Ok(true);
    };
    let message = error.to_string();
    let is_named = message.starts_with(&format!("{}:", scene.display()));
    if is_named && !message.contains(['\n', '\r']) {
        Ok(false)
    } else {
        Err(message)
    }
}

/// Files that were found by a search, by the name of their kind.
#[test]
fn files_of_the_corpus_are_accepted_or_refused_with_their_place() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus");
    for (folder, kind) in [
        ("scenes", InputKind::Scene),
        ("profiles", InputKind::Profile),
        ("height-maps", InputKind::HeightMap),
        ("moduli", InputKind::Moduli),
        ("curves", InputKind::Curve),
        ("friction", InputKind::Friction),
        ("sweep-rows", InputKind::SweepRows),
    ] {
        let files = fs::read_dir(corpus.join(folder)).into_iter().flatten();
        for file in files {
            let (path, contents) = read(file.expect("an entry").path());
            let checked = oracle::check(kind, &path, &contents);
            checked.unwrap_or_else(|message| panic!("{}: {message}", path.display()));
        }
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
        let checked = oracle::check(InputKind::Scene, file, text.as_bytes());
        assert_eq!(checked, Ok(false), "{}…", &text[..20]);
    }
}
