//! Numbers that a user gives are checked before memory is taken for them, and `max_memory` holds; where a shell can limit the memory
//! for data.
#![cfg(target_os = "linux")]

use std::any::TypeId;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use clap::Arg;
use serde_json::Value as Schema;
use toml::{Table, Value};
use viscofriction::scene::{json_schema, kinds};
use viscofriction_cli::{InputKind, check_input, command_line};

use crate::support::{Folder, Said, argument, example, said, scene, table};

/// Values of every option and key: none, one, and more than can be computed or stored.
const VALUES: [&str; 4] = ["0", "1", "1000000000", "18446744073709551615"];

/// Memory that scenes allow, \[KiB].
const ALLOWED: u64 = 65_536;
/// Memory of the program itself and of what is not estimated, \[KiB].
const BESIDE: u64 = 150_000_000 / 1024;
/// Processor time after which a command is ended, \[s]: by then it computes, and has taken what it takes.
const SECONDS: u64 = 1;

/// A scene of parts that allows 64 MiB.
fn with_memory(parts: &str) -> String {
    scene(&format!("{parts}, max_memory = \"64 MiB\""))
}

/// The program with as much memory for its data, \[KiB], and with limited processor time.
fn limited(folder: &Folder, words: &[String], memory: u64) -> Said {
    within(
        &format!("ulimit -d {memory}; ulimit -t {SECONDS}"),
        folder,
        "1",
        words,
    )
}

/// Runs the program on the given number of threads within limits of the shell.
fn within(limits: &str, folder: &Folder, threads: &str, words: &[String]) -> Said {
    let limits = format!("{limits}; exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command
        .current_dir(&folder.0)
        .env("RAYON_NUM_THREADS", threads);
    command.args(["-c", &limits, env!("CARGO_BIN_EXE_viscofriction")]);
    said(command.args(words))
}

/// What is wrong with the end of a command, if it has not ended as it should; one that takes its time is ended without a word.
fn wrong_end(said: &Said) -> Option<String> {
    let mut words = said.stdout.split(['\n', ' ', ',']);
    let is_right = match said.status {
        Some(status) => status <= 2 && words.all(|word| !["NaN", "inf"].contains(&word)),
        None => said.stderr.is_empty(),
    };
    (!is_right).then(|| format!("{said:?}"))
}

/// Commands that take the options; the words that an option replaces are left out.
const COMMANDS: [(&str, &str); 6] = [
    ("run", "run line.toml"),
    ("sweep", "sweep uncertain.toml --vary load.velocity=0.1,0.2"),
    ("road", "road rough.toml"),
    ("fit-material", "fit-material moduli.csv"),
    ("fit-friction", "fit-friction friction.csv line.toml"),
    ("fit-indentation", "fit-indentation curve.csv --sphere 1e-5"),
];

/// Options without a number.
const WITHOUT_NUMBER: [&str; 1] = ["merge"];

/// The words of a command with an option of this value.
fn with_option(command: &str, option: &Arg, value: &str) -> Vec<String> {
    let name = format!("--{}", option.get_long().unwrap_or_default());
    let values = option.get_num_args().map_or(1, |range| range.min_values());
    let given = match option.get_id().as_str() {
        "vary" => vec![format!("load.velocity=0.1:0.2:{value}")],
        "shard" => vec![format!("1/{value}")],
        _ => vec![value.to_owned(); values],
    };
    let body = option.get_id().as_str();
    let is_body = ["paraboloid", "cone", "pyramid", "flat_punch", "sphere"].contains(&body);
    let mut words: Vec<String> = command.split(' ').map(argument).collect();
    if let Some(at) = words
        .iter()
        .position(|word| *word == name || (is_body && word == "--sphere"))
    {
        words.drain(at..at + 2);
    }
    words.push(name);
    words.extend(given);
    words
}

#[test]
fn every_number_of_an_option_is_checked_before_memory_is_taken() {
    let folder = Folder::new("numbers of options");
    folder.write(
        "line.toml",
        scene("paraboloid; solid; normal_force = 1.0, velocity = 0.01; model = \"line\""),
    );
    let load = "normal_force = 1.0, velocity = 0.01";
    folder.write(
        "uncertain.toml",
        format!(
            "uncertainty.\"load.normal_force\" = 0.1\n{}",
            scene(&format!("cone; viscous; {load}; model = \"line\""))
        ),
    );
    folder.write(
        "rough.toml",
        scene("rough; elastic; mean_pressure = 1e5, velocity = 0.01; relative_error = 0.1"),
    );
    folder.write(
        "moduli.csv",
        "f,G',G''\nHz,MPa,MPa\n1,10,1\n2,11,1\n4,12,1\n8,13,1\n",
    );
    folder.write(
        "friction.csv",
        "v (m/s),mu\n0.01,0.1\n0.02,0.12\n0.04,0.13\n",
    );
    folder.write(
        "curve.csv",
        "t (s),force (nN),depth (nm)\n0,0,0\n1,1,100\n2,2.8,200\n3,5.2,300\n",
    );
    folder.write("map.csv", "1,2,3\n2,3,1\n3,1,2\n");
    let mut commands: BTreeMap<&str, &str> = COMMANDS.into();
    commands.insert("surface", "surface map.csv --spacing 1e-6 1e-6");
    let mut wrong = Vec::new();
    for command in command_line().get_subcommands() {
        for option in command
            .get_arguments()
            .filter(|option| takes_number(option))
        {
            let base = commands.get(command.get_name());
            let base = base.unwrap_or_else(|| panic!("no command for {}", command.get_name()));
            for value in VALUES {
                let words = with_option(base, option, value);
                let said = limited(&folder, &words, 2 * BESIDE);
                wrong.extend(wrong_end(&said).map(|why| format!("{words:?}: {why}")));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Options that are no files, and none of a few words.
fn takes_number(option: &Arg) -> bool {
    let parser = option.get_value_parser();
    option.get_action().takes_values()
        && option.get_long().is_some()
        && parser.type_id() != TypeId::of::<PathBuf>()
        && parser.possible_values().is_none()
        && !WITHOUT_NUMBER.contains(&option.get_id().as_str())
}

/// Scenes with numeric keys of everything but the bodies of [`plain_bodies`]; `body; material; load; solution`.
const SCENES: &str = "scenes of all keys";

/// A number that is within the range of every number of a body.
const NUMBER_OF_BODY: f64 = 0.05;

/// A scene of each kind of body that has only numbers, which are all [`NUMBER_OF_BODY`].
fn plain_bodies() -> Vec<String> {
    let mut scenes = Vec::new();
    for kind in kinds("Indenter") {
        if kind.keys.iter().all(|key| key.words["type"] == "number") {
            let numbers: Vec<String> = (kind.keys.iter())
                .map(|key| format!("{} = {NUMBER_OF_BODY}", key.name))
                .collect();
            let body = format!("indenter.{} = {{ {} }}", kind.name, numbers.join(", "));
            let load = "normal_force = 1.0, velocity = 0.01";
            scenes.push(format!("{body}; viscous; {load}; relative_error = 0.1"));
        }
    }
    scenes
}

/// A place of a number in a scene, and its path in the schema, in which all entries of a list are one.
#[derive(Debug, Clone)]
struct Place {
    steps: Vec<Step>,
    path: String,
}

#[derive(Debug, Clone)]
enum Step {
    Key(String),
    Index(usize),
}

/// The numbers of a scene.
fn places(value: &Value, at: &Place, found: &mut Vec<Place>) {
    let inner = |step: Step, name: &str| {
        let mut steps = at.steps.clone();
        steps.push(step);
        let path = format!("{}{name}", at.path);
        Place { steps, path }
    };
    match value {
        Value::Table(table) => {
            for (key, value) in table {
                let is_open = at.path == ".uncertainty";
                let name = if is_open { ".*" } else { &format!(".{key}") };
                places(value, &inner(Step::Key(key.clone()), name), found);
            }
        }
        Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                places(value, &inner(Step::Index(index), "[]"), found);
            }
        }
        Value::Integer(_) | Value::Float(_) => found.push(at.clone()),
        _ => {}
    }
}

/// A scene in which another number stands at a place.
fn with_number(scene: &Table, place: &Place, number: f64) -> String {
    let mut scene = Value::Table(scene.clone());
    let mut at = &mut scene;
    for step in &place.steps {
        at = match step {
            Step::Key(key) => &mut at[key.as_str()],
            Step::Index(index) => &mut at[*index],
        };
    }
    *at = match at {
        // The largest integer of TOML stands for the one that is larger.
        #[expect(clippy::cast_possible_truncation, reason = "it saturates")]
        Value::Integer(_) => Value::Integer(number as i64),
        _ => Value::Float(number),
    };
    toml::to_string(&scene).expect("a scene")
}

/// The paths of all numbers in the schema of scenes.
fn numbers_of_schema(
    node: &Schema,
    path: &str,
    definitions: &Schema,
    found: &mut BTreeSet<String>,
) {
    let mut inner = |node: &Schema, path: &str| numbers_of_schema(node, path, definitions, found);
    if let Some(name) = node["$ref"]
        .as_str()
        .and_then(|name| name.rsplit('/').next())
    {
        inner(&definitions[name], path);
    }
    for choice in ["oneOf", "anyOf", "allOf"] {
        let choices = node[choice].as_array().into_iter().flatten();
        choices.for_each(|node| inner(node, path));
    }
    let keys = node["properties"].as_object().into_iter().flatten();
    keys.for_each(|(key, node)| inner(node, &format!("{path}.{key}")));
    if node["items"].is_object() {
        inner(&node["items"], &format!("{path}[]"));
    }
    let first = node["prefixItems"].as_array().into_iter().flatten();
    first.for_each(|node| inner(node, &format!("{path}[]")));
    if node["additionalProperties"].is_object() {
        inner(&node["additionalProperties"], &format!("{path}.*"));
    }
    let kind = &node["type"];
    let mut kinds = kind.as_array().into_iter().flatten().chain([kind]);
    if kinds.any(|kind| kind == "number" || kind == "integer") {
        found.insert(path.to_owned());
    }
}

#[test]
fn every_number_of_a_scene_is_checked_before_memory_is_taken() {
    let folder = Folder::new("numbers of scenes");
    folder.write(
        "map.csv",
        "0,1e-6,2e-6,1e-6\n1e-6,3e-6,1e-6,0\n2e-6,1e-6,0,1e-6\n1e-6,0,1e-6,2e-6\n",
    );
    folder.write(
        "spectrum.csv",
        "wave_number,density\n6e2,1e-14\n1e4,2e-19\n3e4,1e-20\n",
    );
    folder.write("material.toml", "[material.prony]\nequilibrium_modulus = 1e6\nbranches = [{ modulus = 1e6, relaxation_time = 1e-3 }]\nshift = { temperature = 20.0, temperature_range = [0.0, 40.0], law = { wlf = [17.4, 51.6] }, vertical = { table = [[0.0, 0.95], [40.0, 1.05]] } }\n");
    let mut tried = BTreeSet::new();
    let mut wrong = Vec::new();
    let written = table::<1>(SCENES).into_iter().map(|[parts]| parts);
    for parts in written.chain(plain_bodies()) {
        let scene: Table = with_memory(&parts).parse().expect("TOML");
        let root = Place {
            steps: Vec::new(),
            path: String::new(),
        };
        let mut all = Vec::new();
        places(&Value::Table(scene.clone()), &root, &mut all);
        all.retain(|place| tried.insert(place.path.clone()));
        for place in all {
            for value in VALUES {
                let text = with_number(&scene, &place, value.parse().expect("a number"));
                let file = folder.path("scene.toml");
                if check_input(InputKind::Scene, &file, text.as_bytes()).is_err() {
                    continue;
                }
                folder.write("scene.toml", &text);
                let said = limited(
                    &folder,
                    &["run".to_owned(), "scene.toml".to_owned()],
                    ALLOWED + BESIDE,
                );
                wrong
                    .extend(wrong_end(&said).map(|why| format!("{} = {value}: {why}", place.path)));
            }
        }
    }
    let schema: Schema = serde_json::from_str(&json_schema().expect("a schema")).expect("JSON");
    let mut known = BTreeSet::new();
    numbers_of_schema(&schema, "", &schema["$defs"], &mut known);
    let missing: Vec<_> = known.difference(&tried).collect();
    assert!(missing.is_empty(), "no scene of the test has {missing:?}");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Rows of a table of a scene.
fn rows(names: &str, count: usize, row: impl Fn(f64) -> String) -> String {
    let rows = (0..=count).map(|index| row(index as f64 / count as f64));
    std::iter::once(names.to_owned())
        .chain(rows)
        .collect::<Vec<_>>()
        .join("\n")
}

#[test]
fn no_scene_takes_more_memory_than_it_allows() {
    let folder = Folder::new("memory of scenes");
    let wave = |part: f64| (40.0 * part).sin();
    folder.write(
        "history.csv",
        rows("time_s,indentation_depth_m", 50_000, |time| {
            format!("{time},{}", 1e-5 * (1.0 + wave(time)))
        }),
    );
    folder.write(
        "motion.csv",
        rows("time_s,position_m,normal_force_n", 40_000, |time| {
            format!("{time},{},1", 1e-3 * wave(time))
        }),
    );
    let map = |row: usize| {
        (0..200)
            .map(|column| format!("{:e}", 1e-6 * wave(((row * 37 + column * 91) % 101) as f64)))
            .collect::<Vec<_>>()
            .join(",")
    };
    folder.write("map.csv", (0..200).map(map).collect::<Vec<_>>().join("\n"));
    folder.write(
        "spectrum.csv",
        "wave_number,density\n6e2,1e-14\n1e4,2e-19\n3e8,1e-40\n",
    );
    let cases = table::<2>("memory of scenes");
    assert!(cases.len() >= 30, "{}", cases.len());
    let mut wrong = Vec::new();
    for [options, parts] in cases {
        folder.write("scene.toml", with_memory(&parts));
        let words = format!("{options} scene.toml");
        let words: Vec<String> = words.split_whitespace().map(str::to_owned).collect();
        let said = limited(&folder, &words, ALLOWED + BESIDE);
        wrong.extend(wrong_end(&said).map(|why| format!("{options} {parts}: {why}")));
    }
    for file in fs::read_dir(example(
        "../../crates/viscofriction-cli/tests/corpus/scenes",
    ))
    .expect("the corpus")
    {
        let file = file.expect("an entry").path().display().to_string();
        let said = limited(&folder, &["run".to_owned(), file.clone()], ALLOWED + BESIDE);
        wrong.extend(wrong_end(&said).map(|why| format!("{file}: {why}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Runs a sweep of a rough elastic surface that is pressed, with `allowed` MiB and 64 MiB more.
fn pressed_sweep(folder: &Folder, threads: &str, allowed: u32, parts: [&str; 3]) -> Said {
    let [body, solution, values] = parts;
    let solution = format!("duration = 1.0, {solution}, max_memory = \"{allowed} MiB\"");
    let load = "mean_pressure = 1e4, velocity = 0.0";
    folder.write(
        "scene.toml",
        scene(&format!("{body}; elastic; {load}; {solution}")),
    );
    let words = format!("sweep scene.toml --vary load.mean_pressure={values}");
    let words: Vec<String> = words.split(' ').map(str::to_owned).collect();
    within(
        &format!("ulimit -d {}", 1024 * (allowed + 64)),
        folder,
        threads,
        &words,
    )
}

/// Each takes about 35 MB.
#[test]
fn points_at_the_same_time_share_the_memory() {
    let folder = Folder::new("shared memory");
    let said = pressed_sweep(&folder, "8", 111, ["rough", "elements = 512", "1e4:8e4:8"]);
    assert_eq!(said.status, Some(0), "{said:?}");
}

/// The usual first grid of this body needs more than 80 MiB.
const SHORTER_WAVES: &str = "indenter.self-affine = { period = [2.0, 1.0], hurst_exponent = 0.8, rms_slope = 0.1, longest_wavelength = 1.0, shortest_wavelength = 0.05, seed = 3 }";

#[test]
fn points_whose_grids_depend_on_the_memory_answer_as_alone() {
    let folder = Folder::new("grids by memory");
    let parts = [SHORTER_WAVES, "relative_error = 0.1", "1e4:2e4:2"];
    let [alone, together] = ["1", "2"].map(|threads| pressed_sweep(&folder, threads, 160, parts));
    assert_eq!(alone.status, Some(0), "{alone:?}");
    assert_eq!(together.stdout, alone.stdout, "{together:?}");
}
