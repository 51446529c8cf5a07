//! Every malformed scene, and every malformed file that one names, is refused with one line that names the file and the place
//! in it, and says what is needed.

use serde_json::Value;
use viscofriction::numerics::MessageNumber;
use viscofriction::scene::{Key, keys, kinds, number, schema};

use crate::support::{Case, Folder, cases, npy, scene, table};

/// A scene that is right.
const SCENE: &str = include_str!("../data/scene.toml");

/// Solves the scene with every one of the contents of a file, which are wrong at a place that is named.
#[track_caller]
fn assert_refused(folder: &Folder, file: &str, cases: Vec<Case>) {
    for (contents, place, needed) in cases {
        folder.write(file, &contents);
        let said = folder.ends("scene.toml", 2, &needed);
        let contents = String::from_utf8_lossy(&contents);
        assert!(
            said.starts_with(&format!("{place}: ")),
            "{said} of\n{contents}"
        );
    }
}

/// The scene with some lines replaced, `from-to` or a single one, counted from 1.
fn replaced(lines: &str, text: &str) -> String {
    let (first, last) = lines.split_once('-').unwrap_or((lines, lines));
    let [first, last] = [first, last].map(|line| line.parse::<usize>().expect("a line"));
    let scene: Vec<&str> = SCENE.lines().collect();
    let parts = [&scene[..first - 1], &[text], &scene[last..]];
    parts.concat().join("\n")
}

/// Every number of every body and material out of its range, and every other value in its place; every key misspelt and left out.
fn wrong_keys() -> Vec<Case> {
    let mut cases = Vec::new();
    for (table, definition, lines) in [
        ("indenter", "Indenter", "1-3"),
        ("material", "MaterialTable", "5-6"),
    ] {
        for kind in kinds(definition) {
            let first: usize = lines[..1].parse().expect("a line");
            let mut add = |key: Key, line: Option<String>, said: String| {
                let others = required_but(kind.keys.iter().copied(), key.name);
                let text: Vec<String> = line.iter().cloned().chain(others).collect();
                let table = format!("{table}.{}", kind.name);
                let scene = replaced(lines, &format!("[{table}]\n{}", text.join("\n")));
                // A key that is missing is missing in its table.
                let named = format!("scene.toml:{}", first + line.iter().count());
                cases.push((scene.into(), named, format!("{table}.{}{said}", key.name)));
            };
            for &key in &kind.keys {
                let name = key.name;
                for (value, said) in wrong_values(key.words) {
                    add(key, Some(format!("{name} = {value}")), said);
                }
                let unknown = format!("s: unknown field `{name}s`");
                add(key, Some(format!("{name}s = 0.5")), unknown);
                if key.is_required {
                    add(key, None, format!(": missing field `{name}`"));
                }
            }
        }
    }
    cases
}

/// Values of the keys that a table needs, without one of them.
fn required_but(keys: impl Iterator<Item = Key>, name: &str) -> Vec<String> {
    let others = keys.filter(|key| key.is_required && key.name != name);
    let line = |key: Key| format!("{} = {}", key.name, example(key.words));
    others.map(line).collect()
}

/// A value in every range; two numbers that increase.
fn example(words: &'static Value) -> String {
    match words["type"].as_str() {
        Some("number") => "0.5".to_owned(),
        Some("integer") => "1".to_owned(),
        Some("string") => "\"file\"".to_owned(),
        Some("array") if words["minItems"] == 2 => "[0.5, 0.75]".to_owned(),
        Some("array") => format!("[{{ {} }}]", required_but(keys(words), "").join(", ")),
        other => panic!("no example of the type {other:?}"),
    }
}

/// Values that a number, or a number of a list, must not have, and what is said behind the key.
fn wrong_values(words: &'static Value) -> Vec<(String, String)> {
    let mut wrong = Vec::new();
    if let Some(allowed) = words["x-allowed"].as_str() {
        let mut ranges = table("ranges").into_iter();
        let range = ranges.find(|[range, _]| range == allowed);
        let [_, values] = range.unwrap_or_else(|| panic!("no values out of {allowed:?}"));
        for value in values.split(' ') {
            let number = MessageNumber(value.parse().expect("a number"));
            wrong.push((
                value.to_owned(),
                format!(" must be {allowed}, but is {number}"),
            ));
        }
        let types = table("no numbers").into_iter();
        wrong.extend(types.map(|[value, said]| (value, said)));
    }
    if words["minItems"] == 2 {
        let second = |(value, said)| (format!("[0.5, {value}]"), format!("[1]{said}"));
        // A list in a list is refused as one of tables.
        let values = wrong_values(&words["items"]).into_iter();
        let values = values.filter(|(value, _)| !value.starts_with('['));
        wrong.extend(values.map(second));
    } else if words["type"] == "array" {
        for key in keys(words) {
            let others = required_but(keys(words), key.name).join(", ");
            for (value, said) in wrong_values(key.words) {
                let entry = format!("[{{ {} = {value}, {others} }}]", key.name);
                wrong.push((entry, format!("[0].{}{said}", key.name)));
            }
        }
    }
    wrong
}

/// A doc comment that does not state a range as the others do leaves the number without one.
#[test]
fn numbers_of_bodies_and_materials_have_a_range() {
    let of_kinds = ["Indenter", "MaterialTable"]
        .map(kinds)
        .into_iter()
        .flatten();
    let of_lists = ["Term", "Branch", "Approximation"].map(|name| &schema()["$defs"][name]);
    let all = of_kinds
        .flat_map(|kind| kind.keys)
        .chain(of_lists.into_iter().flat_map(keys));
    let numbers = all.filter_map(|key| Some((key.name, number(key.words)?)));
    let without = numbers.filter(|(_, words)| words["x-allowed"].is_null());
    let without: Vec<&str> = without.map(|(name, _)| name).collect();
    assert_eq!(without, ["temperature"], "of any sign");
}

#[test]
fn a_malformed_scene_is_refused_with_line_and_key() {
    let folder = Folder::new("malformed");
    folder.write("map.csv", "0,0,0\n0,1,0\n0,0,0\n");
    folder.write("hole.csv", "0;0;0\n0;1;\n0;0;0\n");
    folder.write("flat.csv", "1,1,1\n1,1,1\n1,1,1\n");
    folder.write("spectrum.csv", "wave_number,density\n4,1e-6\n25,1e-9\n");
    let mut cases = wrong_keys();
    let place = |line: &str| format!("scene.toml:{line}");
    for [lines, named, needed, text] in table("scenes") {
        let scene = replaced(&lines, &text.replace("\\0", "\0"));
        cases.push((scene.into(), place(&named), needed));
    }
    for [parts, named, needed] in table("unanswered") {
        cases.push((scene(&parts).into(), place(&named), needed));
    }
    assert!(cases.len() >= 800, "only {} scenes", cases.len());
    assert_refused(&folder, "scene.toml", cases);
    folder.write("scene.toml", SCENE);
    folder.solved("scene.toml");
}

#[test]
fn what_is_not_reached_says_which_keys_to_change() {
    let folder = Folder::new("unreached");
    folder.write("map.csv", "0,0,0\n0,1,0\n0,0,0\n");
    for [parts, needed] in table("unreached") {
        folder.write("scene.toml", scene(&parts));
        folder.ends("scene.toml", 1, &needed);
    }
}

/// A folder with a scene that names a file, and the beginning of what is said about that.
fn naming(body: &str, file: &str) -> (Folder, String) {
    let folder = Folder::new(&format!("malformed-{file}"));
    let spacing = match body {
        "height-map" => "spacing = [1, 1]",
        "spectrum" => "period = [1, 1]\nseed = 1",
        _ => "",
    };
    let table = format!("[indenter.{body}]\nfile = \"{file}\"\n{spacing}");
    folder.write("scene.toml", replaced("1-3", &table));
    let place = format!("scene.toml:2: indenter.{body}.file: {file}");
    (folder, place)
}

#[test]
fn a_malformed_table_of_a_scene_is_refused_with_both_lines() {
    let (folder, place) = naming("table", "profile.csv");
    let wrong = cases("profiles", |line| format!("{place}:{line}"));
    assert_refused(&folder, "profile.csv", wrong);
    let (folder, place) = naming("spectrum", "spectrum.csv");
    let wrong = cases("spectra", |line| format!("{place}:{line}"));
    assert_refused(&folder, "spectrum.csv", wrong);
    let (folder, place) = naming("height-map", "map.csv");
    let wrong = cases("height maps", |line| match line {
        "" => place.clone(),
        line => format!("{place}:{line}"),
    });
    assert_refused(&folder, "map.csv", wrong);
}

#[test]
fn a_malformed_file_of_a_material_is_refused_with_both_lines() {
    let folder = Folder::new("malformed-material");
    let scene = replaced("5-6", "[material.file]\npath = \"rubber.toml\"");
    folder.write("scene.toml", &scene);
    let place = "scene.toml:6: material.file.path: rubber.toml";
    let wrong = cases("materials", |line| format!("{place}:{line}"));
    assert_refused(&folder, "rubber.toml", wrong);
    folder.write("rubber.toml", "[material.viscous]\nviscosity = 1\n");
    folder.solved("scene.toml");
    let outside = scene.replace("rubber.toml\"", "rubber.toml\"\npoisson_ratio = 0.6");
    let place = "scene.toml:7: material.file.poisson_ratio must be";
    folder.write("scene.toml", outside);
    folder.ends("scene.toml", 2, place);
}

#[test]
fn a_malformed_array_of_heights_is_refused_with_its_file() {
    let (folder, place) = naming("height-map", "map.NPY");
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }";
    let whole = npy(header, &[]);
    let heights = [1.0, 1.0, 0.0, 1.0, 1.0, f64::INFINITY].map(f64::to_le_bytes);
    let no_array = "an array of NumPy in the format 1.0";
    let short = "the header ends after 128 bytes, but the file has 60";
    let infinite = "[2, 1]: a finite height is needed, and not inf";
    let mut cases: Vec<Case> = [
        (Vec::new(), no_array),
        (b"1,0\n0,1\n".to_vec(), no_array),
        (whole[..9].to_vec(), no_array),
        (whole[..60].to_vec(), short),
        (npy(header, &heights.concat()), infinite),
    ]
    .map(|(array, needed)| (array, place.clone(), needed.to_owned()))
    .into();
    for [header, length, needed] in table("arrays") {
        let numbers = vec![0; length.parse().expect("a length")];
        cases.push((npy(&header, &numbers), place.clone(), needed));
    }
    assert_refused(&folder, "map.NPY", cases);
}
