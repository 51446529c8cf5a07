//! A sweep can be interrupted, taken up again, and divided.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::{Duration, Instant};

use crate::support::{argument, command, example, folder, text, viscofriction};

const VARY: [&str; 4] = [
    "--vary",
    "indenter.cone.slope=0.05:0.2:4",
    "--vary",
    "load.velocity=1e-3:1:5:log",
];

/// A sweep of a scene into a file, with more options.
fn arguments<'a>(scene: &'a Path, out: &'a Path, more: &[&'a str]) -> Vec<&'a str> {
    [
        &["sweep", argument(scene), "--out", argument(out)],
        &VARY[..],
        more,
    ]
    .concat()
}

fn finished(scene: &Path, out: &Path, more: &[&str]) -> String {
    let output = viscofriction(&arguments(scene, out, more));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    fs::read_to_string(out).expect("the file is there")
}

fn whole(scene: &Path, name: &str) -> String {
    finished(scene, &folder(name).join("whole.csv"), &[])
}

/// Takes some milliseconds per point, so that a kill finds it at work.
fn slow_scene(name: &str) -> PathBuf {
    let path = folder(name).join("scene.toml");
    let scene = fs::read_to_string(example("cone-half-space.toml")).expect("the scene");
    fs::write(
        &path,
        scene.replace("relative_error = 1e-2", "elements = 10"),
    )
    .expect("a scene");
    path
}

/// Delays that are the same in every run of the tests, between 0 and 1: the fractional parts of multiples of the golden
/// section lie everywhere and far from each other.
fn scattered(n: usize) -> impl Iterator<Item = f64> {
    (1..=n).map(|k| (k as f64 * 0.618_033_988_749_894_9).fract())
}

/// Starts or resumes a sweep and kills it after a delay; returns what is in its file then.
fn killed(scene: &Path, out: &Path, delay: Duration) -> String {
    let mut child = command(&arguments(scene, out, &["--resume"]))
        .stdout(Stdio::null())
        .spawn()
        .expect("the command runs");
    std::thread::sleep(delay);
    child.kill().ok();
    child.wait().expect("it ended");
    fs::read_to_string(out).unwrap_or_default()
}

#[test]
fn a_sweep_killed_at_any_moment_goes_on_to_the_same_rows() {
    let scene = slow_scene("kill-scene");
    let started = Instant::now();
    let expected = whole(&scene, "kill-whole");
    let duration = started.elapsed();
    let mut n_partial = 0;
    for (round, moment) in scattered(4).enumerate() {
        let folder = folder("kill");
        let out = folder.join("killed.csv");
        // Twice in each round: from the beginning, and from where the first one was killed.
        for part in [moment, 0.5 * moment] {
            let text = killed(&scene, &out, duration.mul_f64(part));
            // Threads finish their points in any order.
            for line in text.split_inclusive('\n') {
                assert!(expected.contains(line), "round {round} left {line}");
            }
            n_partial += usize::from(!text.is_empty() && text.len() < expected.len());
        }
        let resumed = finished(&scene, &out, &["--resume"]);
        assert_eq!(resumed, expected, "round {round}");
        let left = fs::read_dir(&folder).expect("the folder").count();
        assert_eq!(left, 3, "round {round}: rows and their picture are left");
    }
    assert!(
        n_partial >= 3,
        "only {n_partial} of 8 kills came between beginning and end"
    );
}

/// A kill between writing a file and giving it its name leaves a part; it is too rare to wait for.
#[test]
fn a_part_that_a_kill_left_is_cleared_away() {
    let scene = example("cone-viscous.toml");
    let folder = folder("part");
    let [out, part, other] = [
        "sweep.csv",
        ".sweep.csv.viscofriction-4711.part",
        ".sweep.csv.old.part",
    ]
    .map(|name| folder.join(name));
    for file in [&part, &other] {
        fs::write(file, "sweep,po").expect("a file");
    }
    finished(&scene, &out, &["--resume"]);
    assert!(!part.exists(), "the part of a killed run");
    assert!(other.exists(), "a file that no run has written");
}

#[test]
fn a_line_cut_anywhere_is_computed_again() {
    let scene = example("cone-viscous.toml");
    let expected = whole(&scene, "cut-whole");
    let out = folder("cut").join("cut.csv");
    let step = expected.len() / 23;
    for length in (0..expected.len()).step_by(step) {
        fs::write(&out, &expected[..length]).expect("a file");
        let resumed = finished(&scene, &out, &["--resume"]);
        assert_eq!(resumed, expected, "cut after {length} bytes");
    }
}

#[test]
fn a_row_that_is_missing_in_the_middle_comes_to_its_place() {
    let scene = example("cone-viscous.toml");
    let expected = whole(&scene, "gap-whole");
    let lines: Vec<&str> = expected.lines().collect();
    let with_gap = [&lines[..4], &lines[7..]].concat().join("\n") + "\n";
    let out = folder("gap").join("gap.csv");
    fs::write(&out, with_gap).expect("a file");
    assert_eq!(finished(&scene, &out, &["--resume"]), expected);
}

#[test]
fn shards_join_to_the_whole_and_say_what_is_missing() {
    let scene = example("cone-viscous.toml");
    let expected = whole(&scene, "shard-whole");
    let folder = folder("shards");
    let shards = ["1/3", "2/3", "3/3"].map(|shard| {
        let out = folder.join(shard.replace('/', "-"));
        finished(&scene, &out, &["--shard", shard]);
        out
    });
    let out = folder.join("merged.csv");
    let merge = |files: &[&Path]| {
        let mut arguments = vec!["sweep", "--overwrite", "--out", argument(&out), "--merge"];
        arguments.extend(files.iter().map(|file| argument(file)));
        viscofriction(&arguments)
    };
    let output = merge(&[&shards[2], &shards[0], &shards[1]]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_eq!(fs::read_to_string(&out).expect("merged"), expected);
    let output = merge(&[&shards[2], &shards[0]]);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(
        message.contains("no file has the points 2, 5, 8, 11, 14, 17, 20"),
        "{message}"
    );
}

#[test]
fn several_threads_write_the_same_rows() {
    let scene = slow_scene("threads-scene");
    let expected = whole(&scene, "threads-whole");
    let path = folder("threads").join("scene.toml");
    let text = fs::read_to_string(&scene).expect("the scene");
    fs::write(&path, text + "threads = 3\n").expect("a scene");
    assert_eq!(whole(&path, "threads-out"), expected);
}

#[test]
fn the_file_of_another_sweep_is_not_continued() {
    let out = folder("other").join("sweep.csv");
    finished(&example("cone-viscous.toml"), &out, &[]);
    let output = viscofriction(&arguments(
        &example("cone-half-space.toml"),
        &out,
        &["--resume"],
    ));
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(
        message.contains("sweep.csv:2: the file is of another scene"),
        "{message}"
    );
}

#[test]
fn a_point_that_cannot_be_computed_is_a_row_and_status_1() {
    let path = folder("failing").join("scene.toml");
    let scene = fs::read_to_string(example("power-law.toml")).expect("the scene");
    fs::write(
        &path,
        scene.replace(
            "mdr-transient\"\nelements = 64",
            "analytic\"\nmodel = \"line\"",
        ),
    )
    .expect("a scene");
    let out = folder("failing-out").join("sweep.csv");
    let vary = ["--vary", "indenter.power.exponent=0.5:1.5:3"];
    let base = ["sweep", argument(&path), "--out", argument(&out)];
    let output = viscofriction(&[&base[..], &vary].concat());
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(
        message.contains("1 of 3 points could not be computed"),
        "{message}"
    );
    let rows = fs::read_to_string(&out).expect("the file");
    let lines: Vec<&str> = rows.lines().collect();
    assert!(
        lines[1].contains("friction of the one-dimensional model is infinite"),
        "{rows}"
    );
    assert!(
        lines[2].contains(",analytic,line,") && lines[3].contains(",analytic,line,"),
        "{rows}"
    );
}

#[test]
fn wrong_points_are_refused_before_the_first_is_computed() {
    let scene = example("cone-viscous.toml");
    for (vary, needed) in [
        (
            "load.velocity=1:-1:4",
            "cone-viscous.toml:10: load.velocity must be finite and at least 0",
        ),
        ("load.speed=1:2:2", "load.speed: unknown field"),
        (
            "loads.velocity=1:2:2",
            "loads.velocity: the scene has no such table",
        ),
        ("velocity=1:2:2", "velocity: the scene has no such table"),
        (
            "load.velocity=1:2",
            "KEY=START:STOP:COUNT[:log] or KEY=a,b,c is needed",
        ),
        (
            "load.velocity=1,two",
            "a value must be a number, but is two",
        ),
        ("load.velocity=1:2:0", "COUNT must be a whole number from 1"),
        (
            "load.velocity=0:2:3:log",
            "greater than 0 on a logarithmic scale",
        ),
        ("load.velocity=a:2:3", "START must be a number"),
        ("load.velocity=1:inf:3", "STOP must be finite"),
    ] {
        let out = folder("refused").join("sweep.csv");
        let base = ["sweep", argument(&scene), "--out", argument(&out)];
        let output = viscofriction(&[&base[..], &["--vary", vary]].concat());
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{vary}: {message}");
        assert!(message.contains(needed), "{vary}: {message}");
        assert!(!out.exists(), "{vary} wrote a file");
    }
    for shard in ["0/3", "4/3", "1", "1/0", "a/b"] {
        let out = folder("refused-shard").join("sweep.csv");
        let output = viscofriction(&arguments(&scene, &out, &["--shard", shard]));
        assert_eq!(output.status.code(), Some(2), "{shard}");
    }
}

/// The values in the column of a key.
fn values(vary: &str) -> Vec<String> {
    let scene = example("cone-viscous.toml");
    let output = viscofriction(&["sweep", argument(&scene), "--vary", vary]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let rows = text(&output.stdout);
    let mut cells: Vec<Vec<&str>> = rows
        .lines()
        .skip(1)
        .map(|row| row.split(',').collect())
        .collect();
    cells.sort_by_key(|row| row[1].parse::<usize>().expect("a point"));
    cells.iter().map(|row| row[3].to_owned()).collect()
}

#[test]
fn powers_of_ten_and_lists_are_met_exactly() {
    let powers = values("load.velocity=1e-9:1e6:16:log");
    let expected = (-9..7).map(|power| {
        format!(
            "{:?}",
            format!("1e{power}").parse::<f64>().expect("a number")
        )
    });
    assert_eq!(powers, expected.collect::<Vec<_>>());
    let thirds = values("load.velocity=1e-3:1:10:log");
    assert_eq!([&thirds[3], &thirds[6]], ["0.01", "0.1"]);
    assert_eq!(values("load.velocity=0.3, 0.1,2"), ["0.3", "0.1", "2.0"]);
}

fn hertz_at_a_depth() -> PathBuf {
    let path = folder("held-depth").join("scene.toml");
    let scene = fs::read_to_string(example("hertz.toml")).expect("the scene");
    let at_depth = scene.replace("normal_force = 1.0", "indentation_depth = 1e-5");
    fs::write(&path, at_depth).expect("a scene");
    path
}

#[test]
fn a_sweep_is_drawn_over_what_varies() {
    let scene = example("hertz.toml");
    let sliding = example("cone-half-space.toml");
    let held = hertz_at_a_depth();
    for (scene, vary, labels) in [
        (
            &held,
            vec!["load.indentation_depth=1e-5,2e-5"],
            ["normal force [N]", "load.indentation_depth", "N"],
        ),
        (
            &sliding,
            vec!["load.velocity=1e-3:1:4:log"],
            ["friction coefficient", "load.velocity", "10"],
        ),
        (
            &scene,
            vec!["load.normal_force=1,2,5"],
            ["indentation depth [m]", "load.normal_force", "5"],
        ),
        (
            &scene,
            vec![
                "load.normal_force=1e-3:1:4:log",
                "indenter.paraboloid.curvature=10:50:5",
            ],
            [
                "indentation depth [m]",
                "load.normal_force",
                "indenter.paraboloid.curvature",
            ],
        ),
    ] {
        let out = folder("drawn").join("rows.csv");
        let mut arguments = vec!["sweep", argument(scene), "--out", argument(&out)];
        arguments.extend(vary.iter().flat_map(|vary| ["--vary", vary]));
        let output = viscofriction(&arguments);
        let message = text(&output.stderr);
        assert!(
            output.status.success() && !message.contains("no picture"),
            "{vary:?}: {message}"
        );
        let svg = fs::read_to_string(out.with_extension("svg")).expect("a picture");
        for label in labels {
            assert!(svg.contains(label), "{vary:?}: no {label} in {svg}");
        }
        let png = fs::read(out.with_extension("png")).expect("a picture");
        assert_eq!(png[1..4], *b"PNG", "{vary:?}");
    }
}
