//! Every malformed scene, and every malformed file that one names, is refused with one line that names the file and the place
//! in it, and says what is needed.

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

/// Every number that must be positive, replaced by all that is none, misspelt and left out.
fn numbers() -> Vec<Case> {
    let mut cases = Vec::new();
    for [section, keys] in table("numbers") {
        let is_body = section.starts_with("indenter");
        let (place, first) = if is_body { ("1-3", 1) } else { ("5-6", 5) };
        let keys: Vec<&str> = keys.split(' ').collect();
        for (index, key) in keys.iter().enumerate() {
            let wrong = table("no numbers").into_iter();
            let wrong = wrong.map(|[value, why]| (format!("{key} = {value}"), why));
            let unknown = (
                format!("{key}s = 0.5"),
                format!("s: unknown field `{key}s`"),
            );
            let missing = (String::new(), format!(": missing field `{key}`"));
            for (line, why) in wrong.chain([unknown, missing]) {
                // A key that is missing is missing in its table.
                let named = if line.is_empty() { 0 } else { 1 + index };
                let right = |key: &&str| format!("{key} = 0.5");
                let mut lines: Vec<String> = keys.iter().map(right).collect();
                lines[index] = line;
                let scene = replaced(place, &format!("[{section}]\n{}", lines.join("\n")));
                let named = format!("scene.toml:{}", first + named);
                cases.push((scene.into(), named, format!("{section}.{key}{why}")));
            }
        }
    }
    cases
}

#[test]
fn a_malformed_scene_is_refused_with_line_and_key() {
    let folder = Folder::new("malformed");
    folder.write("map.csv", "0,0,0\n0,1,0\n0,0,0\n");
    folder.write("hole.csv", "0;0;0\n0;1;\n0;0;0\n");
    folder.write("flat.csv", "1,1,1\n1,1,1\n1,1,1\n");
    folder.write("spectrum.csv", "wave_number,density\n4,1e-6\n25,1e-9\n");
    let mut cases = numbers();
    let place = |line: &str| format!("scene.toml:{line}");
    for [lines, named, needed, text] in table("scenes") {
        let scene = replaced(&lines, &text.replace("\\0", "\0"));
        cases.push((scene.into(), place(&named), needed));
    }
    for [parts, named, needed] in table("unanswered") {
        cases.push((scene(&parts).into(), place(&named), needed));
    }
    assert!(cases.len() >= 280, "only {} scenes", cases.len());
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
