//! Nothing that a person has is lost, nothing is left by halves, and nothing is read without end.
#![cfg(unix)]

use std::fs::{self, File, Permissions};
use std::os::unix::fs::{PermissionsExt as _, symlink};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::support::{argument, command, example, folder, measured, text, viscofriction};

/// Commands that write, and the file that they write last; `IN` and `OUT` stand for paths.
const WRITING: [(&str, &str); 4] = [
    ("run IN/hertz.toml --out OUT", "OUT/result.json"),
    (
        "sweep IN/hertz.toml --vary load.normal_force=1,2 --out OUT/s.csv",
        "OUT/s.csv",
    ),
    ("sweep --out OUT/m.csv --merge TMP/rows.csv", "OUT/m.csv"),
    ("fit-material DMA --liquid --out OUT", "OUT/material.toml"),
];

/// The arguments with paths in their places.
fn arguments(line: &str, tmp: &Path) -> Vec<String> {
    let path = |word: &str| {
        word.replace("IN", argument(&example("")).trim_end_matches('/'))
            .replace("OUT", argument(&tmp.join("out")))
            .replace("TMP", argument(tmp))
            .replace("DMA", argument(&measured("pyvisco_frequency_master.csv")))
    };
    line.split(' ').map(path).collect()
}

/// Runs a line; returns its status and what it says.
fn run(line: &str, tmp: &Path) -> (Option<i32>, String) {
    let arguments = arguments(line, tmp);
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let output = viscofriction(&arguments);
    (output.status.code(), text(&output.stderr))
}

/// A folder with rows of a sweep in it, and an empty one for the output.
fn prepared(name: &str) -> PathBuf {
    let tmp = folder(name);
    let (status, message) = run(
        "sweep IN/hertz.toml --vary load.normal_force=1,2 --out TMP/rows.csv",
        &tmp,
    );
    assert_eq!(status, Some(0), "{message}");
    fs::create_dir(tmp.join("out")).expect("a folder");
    tmp
}

fn assert_refused(line: &str, tmp: &Path, needed: &str) {
    let (status, message) = run(line, tmp);
    assert!(
        status == Some(2) && message.contains(needed),
        "{line}: {status:?}, {message}"
    );
}

#[test]
fn what_is_there_is_replaced_only_when_asked_for_and_keeps_link_and_permissions() {
    for (line, written) in WRITING {
        let tmp = prepared("existing");
        let file = PathBuf::from(&arguments(written, &tmp)[0]);
        let target = tmp.join("target");
        fs::write(&target, "mine").expect("a file");
        // More than the umask leaves to a new file.
        fs::set_permissions(&target, Permissions::from_mode(0o666)).expect("permissions");
        symlink("../target", &file).expect("a link");
        assert_refused(
            line,
            &tmp,
            "the file is there already; --overwrite replaces it",
        );
        assert_eq!(fs::read(&target).expect("the file"), b"mine", "{line}");
        let (status, message) = run(&format!("{line} --overwrite"), &tmp);
        assert_eq!(status, Some(0), "{line}: {message}");
        assert!(file.is_symlink(), "{line} cut the link");
        let replaced = fs::metadata(&target).expect("the file");
        assert_ne!(fs::read(&target).expect("the file"), b"mine", "{line}");
        assert_eq!(replaced.permissions().mode() & 0o777, 0o666, "{line}");
    }
}

#[test]
fn a_finished_result_and_the_picture_of_another_are_not_replaced() {
    for (line, _) in WRITING {
        let tmp = prepared("finished");
        let (status, message) = run(line, &tmp);
        assert_eq!(status, Some(0), "{line}: {message}");
        assert_refused(line, &tmp, "--overwrite replaces it");
    }
    let tmp = prepared("foreign-picture");
    fs::write(tmp.join("out/s.svg"), "<svg/>").expect("a picture");
    for more in ["", " --resume"] {
        assert_refused(
            &format!("{}{more}", WRITING[1].0),
            &tmp,
            "s.svg: the file is there already",
        );
    }
    assert!(
        !tmp.join("out/s.csv").exists(),
        "rows without their picture"
    );
}

#[test]
fn only_regular_files_are_written_and_read() {
    for (line, written) in WRITING {
        let tmp = prepared("no-file");
        let file = PathBuf::from(&arguments(written, &tmp)[0]);
        let fifo = Command::new("mkfifo").arg(&file).status();
        assert!(fifo.expect("mkfifo").success(), "a pipe with a name");
        for more in ["", " --overwrite"] {
            assert_refused(
                &format!("{line}{more}"),
                &tmp,
                "only a regular file is written",
            );
        }
        fs::remove_file(&file).expect("the pipe");
        symlink("/dev/null", &file).expect("a link");
        assert_refused(line, &tmp, "only a regular file is written");
    }
    let tmp = folder("no-input");
    let fifo = tmp.join("fifo");
    let made = Command::new("mkfifo").arg(&fifo).status();
    assert!(made.expect("mkfifo").success(), "a pipe with a name");
    for input in ["/dev/zero", argument(&fifo)] {
        let map = tmp.join("map.toml");
        let body = format!("[indenter.height-map]\nfile = {input:?}\nspacing = [1, 1]\n");
        let rest = "[material.viscous]\nviscosity = 1\n[load]\nnormal_force = 1\nvelocity = 1\n";
        fs::write(&map, body + rest).expect("a scene");
        let map = argument(&map);
        for line in [
            format!("run {map}"),
            format!("run {input}"),
            format!("sweep {input} --vary load.velocity=1,2"),
            format!("sweep --merge {input}"),
            format!("fit-material {input}"),
        ] {
            assert_refused(&line, &tmp, &format!("{input}: a regular file is needed"));
        }
    }
    let endless = File::open("/dev/zero").expect("a device");
    let output = command(&["run", "-"]).stdin(endless).output();
    let output = output.expect("the command runs");
    assert_eq!(output.status.code(), Some(2), "a scene without end");
    assert!(
        text(&output.stderr).contains("-: there are more than"),
        "{output:?}"
    );
}

/// A computation that takes longer than the test, as soon as it has begun to write.
fn at_work(line: &str, tmp: &Path) -> Child {
    let slow = tmp.join("slow.toml");
    let scene = fs::read_to_string(example("cone-half-space.toml")).expect("a scene");
    let scene = scene.replace("bem-steady", "bem-transient");
    fs::write(
        &slow,
        scene.replace("relative_error = 1e-2", "elements = 96"),
    )
    .expect("a scene");
    let child = command(&[])
        .args(arguments(line, tmp))
        .stdout(Stdio::null())
        .spawn();
    let started = Instant::now();
    while !tmp.join("out").exists() {
        assert!(
            started.elapsed() < Duration::from_secs(20),
            "{line} does not begin"
        );
        std::thread::sleep(Duration::from_millis(5));
    }
    // From the name of the file to the lock on it.
    std::thread::sleep(Duration::from_millis(200));
    child.expect("the command runs")
}

#[test]
fn of_two_that_write_the_same_the_second_is_refused() {
    let sweep = "sweep TMP/slow.toml --vary load.velocity=1,2 --out TMP/out";
    for (line, again) in [
        (sweep, vec!["--resume", "--overwrite"]),
        ("run TMP/slow.toml --out TMP/out", vec!["--overwrite"]),
    ] {
        let tmp = folder("two");
        let mut first = at_work(line, &tmp);
        for option in again {
            let (status, message) = run(&format!("{line} {option}"), &tmp);
            let refused =
                status == Some(2) && message.contains("another viscofriction is writing it");
            assert!(refused, "{line} {option}: {status:?}, {message}");
        }
        first.kill().expect("a kill");
        first.wait().expect("an end");
    }
}

#[test]
fn a_run_that_is_killed_leaves_whole_files_and_the_next_one_clears_its_parts() {
    let tmp = prepared("killed-run");
    let line = "run IN/half-space-run-in.toml --out OUT";
    let started = Instant::now();
    assert_eq!(run(line, &tmp).0, Some(0), "a run");
    let duration = started.elapsed();
    let out = tmp.join("out");
    let whole = tmp.join("whole");
    fs::rename(&out, &whole).expect("a folder");
    for part in [0.5, 0.7, 0.8, 0.85, 0.9, 0.95] {
        let mut child = command(&[])
            .args(arguments(line, &tmp))
            .stdout(Stdio::null())
            .spawn();
        std::thread::sleep(duration.mul_f64(part));
        let child = child.as_mut().expect("the command runs");
        child.kill().ok();
        child.wait().expect("an end");
        for entry in fs::read_dir(&out).into_iter().flatten() {
            let file = entry.expect("a file").path();
            let name = file.file_name().expect("a name");
            // The result has the time that it took.
            if name != "result.json" && file.extension().is_none_or(|end| end != "part") {
                let [is, was] = [&file, &whole.join(name)].map(|file| fs::read(file).ok());
                assert!(is == was, "{} is not whole", file.display());
            }
        }
        fs::remove_dir_all(&out).ok();
    }
    let [part, other] = [
        ".result.json.viscofriction-4711.part",
        ".result.json.old.part",
    ];
    fs::create_dir(&out).expect("a folder");
    for name in [part, other] {
        fs::write(out.join(name), "{").expect("a file");
    }
    assert_eq!(run(line, &tmp).0, Some(0), "a run");
    assert!(!out.join(part).exists(), "the part of a killed run");
    assert!(out.join(other).exists(), "a file that no run has written");
}

/// A limit of the size of files stands for a disk without room.
#[test]
fn where_there_is_no_room_no_part_and_no_half_row_is_left() {
    let tmp = folder("no-room");
    let program = env!("CARGO_BIN_EXE_viscofriction");
    for line in [
        "run IN/half-space-run-in.toml --out OUT",
        "sweep IN/hertz.toml --vary load.normal_force=1:2:40 --out OUT/s.csv",
    ] {
        let script = format!("trap '' XFSZ; ulimit -f 4; exec {program} \"$@\"");
        let output = Command::new("sh")
            .args(["-c", &script, "sh"])
            .args(arguments(line, &tmp))
            .output();
        let output = output.expect("the command runs");
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{line}: {message}");
        assert!(
            message.contains("writing ") && message.contains("File too large"),
            "{line}: {message}"
        );
        // An empty folder does not stay either.
        for entry in fs::read_dir(tmp.join("out")).into_iter().flatten() {
            let file = entry.expect("a file").path();
            assert!(
                file.extension().is_some_and(|end| end != "part"),
                "{} is left",
                file.display()
            );
        }
    }
    let rows = fs::read_to_string(tmp.join("out/s.csv")).expect("rows");
    assert!(
        rows.lines().count() > 2 && rows.ends_with('\n'),
        "a half row in {rows}"
    );
}

#[test]
fn a_closed_pipe_ends_every_command_quietly() {
    let tmp = prepared("closed-pipe");
    for line in [
        "run IN/hertz.toml",
        "run IN/hertz.toml --format json --explain",
        "run IN/hertz.toml --out OUT",
        "sweep IN/hertz.toml --vary load.normal_force=1:2:40",
        "sweep --merge TMP/rows.csv",
        "fit-material DMA",
        "scene-schema",
        "completions zsh",
        "--help",
        "--version",
    ] {
        let child = command(&[])
            .args(arguments(line, &tmp))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn();
        let mut child = child.expect("the command runs");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("an end");
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{line}: {message}");
        assert!(
            !message.contains("panicked") && !message.contains("error"),
            "{line}: {message}"
        );
    }
    assert!(
        tmp.join("out/result.json").exists(),
        "files are written before they are announced"
    );
}

#[test]
fn a_file_that_the_scene_names_and_that_has_changed_makes_another_sweep() {
    let tmp = folder("changed");
    let [scene, profile] = ["measured-profile.toml", "profile.csv"].map(|name| tmp.join(name));
    for file in [&scene, &profile] {
        fs::copy(
            example(argument(Path::new(file.file_name().expect("a name")))),
            file,
        )
        .expect("a copy");
    }
    let sweep = "sweep TMP/measured-profile.toml --vary load.normal_force=0.5,0.6 --out TMP/";
    let (status, message) = run(&format!("{sweep}a.csv --shard 1/2"), &tmp);
    assert_eq!(status, Some(0), "{message}");
    let heights = fs::read_to_string(&profile).expect("a profile");
    let last = heights.trim_end().rsplit(',').next().expect("a height");
    let changed = heights.trim_end().strip_suffix(last).expect("a height");
    fs::write(&profile, format!("{changed}{last}1\n")).expect("a profile");
    assert_refused(
        &format!("{sweep}a.csv --resume"),
        &tmp,
        "a file that the scene names",
    );
    let (status, message) = run(&format!("{sweep}b.csv --shard 2/2"), &tmp);
    assert_eq!(status, Some(0), "{message}");
    let merge = "sweep --out TMP/c.csv --merge TMP/a.csv TMP/b.csv";
    assert_refused(merge, &tmp, "the row is of another sweep");
}
