//! No file of the user is deleted, no result is left incomplete, and no endless input is read.
#![cfg(unix)]

use std::fs::{self, File, Permissions, hard_link};
use std::os::unix::fs::{PermissionsExt as _, symlink};
use std::process::{Command, Stdio};
use std::time::Instant;

use viscofriction_cli::{InputKind, check_input};

use crate::support::{Folder, argument, example, first_to_end, measured, npy, said, scene, table};

/// A folder with rows of a sweep in it, and an empty one for the output.
fn prepared(name: &str) -> Folder {
    let folder = Folder::new(name);
    let moduli = measured("pyvisco_frequency_master.csv");
    fs::copy(moduli, folder.path("moduli.csv")).expect("a copy");
    let sweep = "sweep IN/hertz.toml --vary load.normal_force=1,2 --out rows.csv";
    folder.done(sweep);
    fs::create_dir(folder.path("out")).expect("a folder");
    folder
}

#[test]
fn what_is_there_is_replaced_only_when_asked_for_and_keeps_link_and_permissions() {
    for [line, written] in table("writing") {
        let folder = prepared("existing");
        let file = folder.path("out").join(&written);
        folder.write("target", "mine");
        // More than the umask leaves to a new file.
        let permissions = Permissions::from_mode(0o666);
        fs::set_permissions(folder.path("target"), permissions).expect("permissions");
        symlink("../target", &file).expect("a link");
        let there = "the file is there already; --overwrite replaces it";
        folder.ends(&line, 2, there);
        assert_eq!(folder.text("target"), "mine", "{line}");
        folder.done(format!("{line} --overwrite"));
        assert!(file.is_symlink(), "{line} cut the link");
        assert_ne!(folder.text("target"), "mine", "{line}");
        let mode = fs::metadata(&file).expect("the file").permissions().mode();
        assert_eq!(mode & 0o777, 0o666, "{line}");
        folder.ends(&line, 2, there);
    }
}

#[test]
fn no_option_replaces_what_its_own_command_reads() {
    for [line, input, written] in table("inputs") {
        let folder = prepared("inputs");
        let map = "indenter.height-map = { file = \"map.csv\", spacing = [1, 1] }";
        let parts = format!("{map}; elastic; normal_force = 1, velocity = 0; duration = 1");
        folder.write("scene.toml", scene(&parts));
        folder.write("map.csv", "1,2,1\n2,3,2\n1,2,0\n");
        folder.write("curve.csv", "t (s),d (m),F (N)\n0,0,0\n");
        let before = folder.text(&input);
        let [link, written] = [folder.path(&input), folder.path("out").join(&written)];
        let links: [fn(_, _) -> _; 2] = [hard_link::<_, &_>, symlink];
        for make in links {
            make(link.clone(), &written).expect("a link");
            for more in ["", " --overwrite", " --resume"] {
                if more != " --resume" || line.contains("--vary") {
                    let mut command = folder.command(&format!("{line}{more}"));
                    let scene = File::open(folder.path("scene.toml")).expect("a scene");
                    let said = said(command.stdin(scene));
                    let needed = "this command reads that file, and replaces none that it reads";
                    let refused = said.status == Some(2) && said.stderr.contains(needed);
                    assert!(refused, "{line}{more}: {said:?}");
                    assert_eq!(folder.text(&input), before, "{line}{more}");
                }
            }
            fs::remove_file(&written).expect("a link");
        }
    }
}

#[test]
fn the_picture_of_another_is_not_replaced() {
    let folder = prepared("foreign-picture");
    folder.write("out/s.svg", "<svg/>");
    for more in ["", " --resume"] {
        let sweep = "sweep IN/hertz.toml --vary load.normal_force=1,2 --out out/s.csv";
        let line = format!("{sweep}{more}");
        folder.ends(&line, 2, "s.svg: the file is there already");
    }
    assert_eq!(folder.names("out"), ["s.svg"], "rows without their picture");
}

fn pipe(folder: &Folder, name: &str) {
    let made = Command::new("mkfifo").arg(folder.path(name)).status();
    assert!(made.expect("mkfifo").success(), "a pipe with a name");
}

#[test]
fn only_regular_files_are_written() {
    for [line, written] in table("writing") {
        let folder = prepared("no-file");
        let file = format!("out/{written}");
        pipe(&folder, &file);
        let needed = "only a regular file is written";
        folder.ends(&line, 2, needed);
        folder.ends(&format!("{line} --overwrite"), 2, needed);
        fs::remove_file(folder.path(&file)).expect("the pipe");
        symlink("/dev/null", folder.path(&file)).expect("a link");
        folder.ends(&line, 2, needed);
    }
}

#[test]
fn only_regular_files_and_scenes_with_an_end_are_read() {
    let folder = Folder::new("no-input");
    pipe(&folder, "pipe");
    for input in ["/dev/zero", "pipe"] {
        let map = format!("indenter.height-map = {{ file = {input:?}, spacing = [1, 1] }}");
        let parts = format!("{map}; viscous; normal_force = 1, velocity = 1; ");
        folder.write("map.toml", scene(&parts));
        for line in [
            "run map.toml",
            &format!("run {input}"),
            &format!("sweep {input} --vary load.velocity=1,2"),
            &format!("sweep --merge {input}"),
            &format!("fit-material {input}"),
        ] {
            folder.ends(line, 2, &format!("{input}: a regular file is needed"));
        }
    }
    let endless = File::open("/dev/zero").expect("a device");
    let said = said(folder.command("run -").stdin(endless));
    assert_eq!(said.status, Some(2), "a scene without end");
    assert!(said.stderr.contains("-: there are more than"), "{said:?}");
}

#[test]
fn a_file_that_needs_more_memory_than_the_scene_allows_is_refused() {
    let folder = Folder::new("no-memory");
    let array = npy(
        "{'descr': '<f8', 'fortran_order': False, 'shape': (512, 512), }",
        &[],
    );
    let heights = 512 * 512 * 8;
    let grid = "ncols 512\nnrows 512\ncellsize 1e-6\n".to_owned() + &"0 1 ".repeat(512 * 256);
    let field = "Gwyddion Simple Field 1.0\nXRes = 384\nYRes = 384\nXReal = 1\nYReal = 1\n\0\0\0\0";
    let field = [field.as_bytes(), &[1; 384 * 384 * 4]].concat();
    let long_line = [field[..60].to_vec(), vec![b'9'; 1 << 19]].concat();
    let points = "0 0 0\n1e-6 0 0\n0 1e-2 0\n".to_owned() + &"0 1e-6 1\n".repeat(9000);
    folder.write("map.npy", [array, vec![0; heights]].concat());
    for (name, contents, needed) in [
        ("map.asc", grid.as_bytes(), "262151 heights need"),
        ("map.gsf", &field, "147456 heights need"),
        ("map.gsf", &long_line, "another beginning"),
        ("map.xyz", points.as_bytes(), "heights need"),
    ] {
        folder.write(name, contents);
        let map = format!("indenter.height-map.file = {name:?}");
        let parts = "elastic; normal_force = 1, velocity = 0; duration = 1, max_memory = \"1 MiB\"";
        folder.write("scene.toml", scene(&format!("{map}; {parts}")));
        let said = folder.ends("run scene.toml", 2, needed);
        assert!(said.stderr.len() < 1000, "{name}: {}", said.stderr);
    }
    let map = "indenter.height-map = { file = \"map.npy\", spacing = [1, 1] }";
    let rows = "0,0\n1,1e-6\n2,2e-6\n3,3e-6\n".repeat(2000);
    folder.write("rows.csv", format!("time_s,indentation_depth_m\n{rows}"));
    let solve = "max_memory = \"1 MiB\"";
    for (parts, needed) in [
        (
            format!("{map}; elastic; normal_force = 1, velocity = 0; duration = 1, {solve}"),
            "enough for a file of 1048576 bytes",
        ),
        (
            format!("cone; elastic; history_file = \"rows.csv\"; {solve}"),
            "8001 rows need",
        ),
    ] {
        folder.write("scene.toml", scene(&parts));
        folder.ends("run scene.toml", 2, needed);
    }
}

#[test]
fn a_long_table_is_read_at_once() {
    // Ten times as many rows take ten times as long, and not a hundred times.
    let seconds = [20_000, 200_000].map(|count| {
        let rows = (0..count).map(|row| format!("{row}e-6,{row}e-9\n"));
        let table = format!("radius_m,height_m\n{}", rows.collect::<String>());
        let once = || {
            let begin = Instant::now();
            let read = check_input(InputKind::Profile, "long.csv".as_ref(), table.as_bytes());
            assert_eq!(read, Ok(()));
            begin.elapsed().as_secs_f64()
        };
        (0..3).map(|_| once()).fold(f64::INFINITY, f64::min)
    });
    assert!(seconds[1] < 40.0 * seconds[0], "{seconds:?}");
}

#[test]
fn where_nothing_can_be_written_nothing_is_computed() {
    let folder = Folder::new("no-folder");
    fs::create_dir(folder.path("file.csv")).expect("a folder");
    let sweep = "sweep IN/hertz.toml --vary load.normal_force=1,2 --out";
    folder.ends(
        &format!("{sweep} file.csv"),
        2,
        "only a regular file is written",
    );
    folder.ends(
        &format!("run IN/hertz.toml --out {}", "y".repeat(256)),
        2,
        "--out",
    );
    if cfg!(target_os = "linux") {
        // Not even for an administrator.
        folder.ends("run IN/hertz.toml --out /proc/self", 2, "--out /proc/self");
    }
    // The names of unfinished files are not longer than those of the files.
    folder.done(format!("{sweep} {}.csv", "z".repeat(250)));
}

#[test]
fn of_two_that_write_the_same_one_is_refused() {
    let sweep = "sweep scene.toml --vary load.velocity=1,2 --out out";
    // Takes longer than the test.
    let march = ("bem-steady", "bem-transient");
    let slow = [march, ("relative_error = 1e-2", "elements = 96")];
    for (line, again) in [
        (sweep, "--resume"),
        (sweep, "--overwrite"),
        ("run scene.toml --out out", "--overwrite"),
    ] {
        let folder = Folder::with("two", "cone-half-space.toml", &slow);
        let mut first = folder.begun(line);
        let mut runs = || first.try_wait().expect("a state").is_none();
        while runs() && !folder.path("out").exists() {
            std::thread::yield_now();
        }
        let said = first_to_end([first, folder.begun(&format!("{line} {again}"))]);
        let is_refused = said.stderr.contains("another viscofriction is writing it");
        assert!(said.status == Some(2) && is_refused, "{line}: {said:?}");
    }
}

#[test]
fn a_run_that_is_killed_leaves_whole_files() {
    let folder = Folder::new("killed-run");
    let line = "run IN/half-space-run-in.toml --out out";
    let started = Instant::now();
    folder.done(line);
    let duration = started.elapsed();
    fs::rename(folder.path("out"), folder.path("whole")).expect("a folder");
    for part in [0.5, 0.7, 0.8, 0.85, 0.9, 0.95] {
        let begin = Instant::now();
        folder.kill_when(line, || begin.elapsed() >= duration.mul_f64(part));
        for name in folder.names("out") {
            if name.ends_with(".part") {
                continue;
            }
            let read = |out| fs::read(folder.path(out).join(&name)).ok();
            let [is, was] = ["out", "whole"].map(read);
            let is_whole = match &name[..] {
                // The result and the page have the time that they took.
                "result.json" => is.is_some_and(|text| text.ends_with(b"}\n")),
                "report.html" => is.is_some_and(|text| text.ends_with(b"</html>\n")),
                _ => is == was,
            };
            assert!(is_whole, "{name} is not whole");
        }
        fs::remove_dir_all(folder.path("out")).ok();
    }
}

/// A kill between writing a file and giving it its name leaves a part; it is too rare to wait for.
#[test]
fn parts_that_a_kill_left_are_cleared_away_and_no_other_files() {
    for [line, written] in table("writing") {
        let folder = prepared("parts");
        let of = ["viscofriction-4711", "viscofriction-0815", "old"];
        let [part, at_work, other] = of.map(|of| format!(".{written}.{of}.part"));
        for name in [&part, &at_work, &other] {
            folder.write(&format!("out/{name}"), "{");
        }
        let open = File::open(folder.path("out").join(&at_work)).expect("a part");
        open.lock().expect("a lock, as of one who writes it");
        folder.done(&line);
        let names = folder.names("out");
        let kept = !names.contains(&part) && names.contains(&at_work) && names.contains(&other);
        assert!(kept, "{line} leaves {names:?}");
    }
}

/// The files of an answer by their names, without those that have the time that it took.
fn answer(folder: &Folder, out: &str) -> Vec<(String, Vec<u8>)> {
    let names = folder.names(out).into_iter();
    let names = names.filter(|name| !["result.json", "report.html"].contains(&&**name));
    let read = |name: String| {
        let contents = fs::read(folder.path(out).join(&name));
        (name, contents.expect("a file"))
    };
    names.map(read).collect()
}

/// Two answers with other files each; files that the user has added to the first stay.
#[test]
fn a_folder_is_of_one_answer_when_a_run_that_replaces_it_is_killed() {
    let folder = Folder::new("exchanged");
    let [old, new] = ["run IN/hertz.toml", "run IN/cone-viscous.toml"];
    for (line, out) in [(old, "old"), (new, "new"), (old, "out")] {
        folder.done(format!("{line} --out {out}"));
        folder.write(&format!("{out}/notes.txt"), "mine");
    }
    let answers = ["old", "new"].map(|name| answer(&folder, name));
    let is_part = |name: &String| name.starts_with(".out.viscofriction-");
    let part = || folder.names(".").into_iter().find(is_part);
    for written in 0..=answers[1].len() {
        let line = format!("{new} --out out --overwrite");
        let is_written = |part: String| folder.names(&part).len() >= written;
        folder.kill_when(&line, || part().is_some_and(is_written));
        let left = answer(&folder, "out");
        assert!(
            answers.contains(&left),
            "{written} files: {:?}",
            folder.names("out")
        );
        let json = fs::read_to_string(folder.path("out/result.json")).expect("a result");
        let slides = json.contains("tangential_force");
        assert_eq!(slides, left == answers[1], "{written} files: {json}");
        folder.done(format!("{old} --out out --overwrite"));
        assert_eq!(answer(&folder, "out"), answers[0], "{written} files");
        assert_eq!(part(), None, "{written} files: {:?}", folder.names("."));
    }
}

#[test]
fn what_a_person_has_in_the_folder_of_an_answer_stays() {
    let folder = Folder::new("notes");
    let written = [".hidden", "notes.txt", "link", "more/data.csv"];
    for line in [
        "run IN/hertz.toml --out out",
        "run IN/cone-half-space.toml --out out --overwrite",
    ] {
        fs::create_dir_all(folder.path("out/more")).expect("a folder");
        for name in [".hidden", "notes.txt", "more/data.csv"] {
            folder.write(&format!("out/{name}"), "mine");
        }
        symlink("nowhere", folder.path("out/link")).ok();
        folder.done(line);
        for name in written {
            let stays = folder.path("out").join(name).symlink_metadata();
            assert!(stays.is_ok(), "{line}: no {name}");
        }
        assert_eq!(folder.names("."), ["out"], "{line}");
    }
    let names = folder.names("out").join(" ");
    assert!(
        !names.contains("line_pressure"),
        "of the old answer: {names}"
    );
    // A shell would be left in a folder that is gone.
    let mut here = folder.command("run IN/hertz.toml --out . --overwrite");
    let here = said(here.current_dir(folder.path("out")));
    assert_eq!(here.status, Some(2), "{here:?}");
    assert!(
        here.stderr.contains("the one that the command runs in"),
        "{here:?}"
    );
    let mut fresh = folder.command("run IN/hertz.toml --out .");
    let fresh = said(fresh.current_dir(folder.path("out/more")));
    assert_eq!(fresh.status, Some(0), "{fresh:?}");
    assert!(folder.path("out/more/result.json").exists(), "an answer");
}

#[test]
fn an_output_that_nobody_can_read_is_status_3() {
    let folder = Folder::new("no-output");
    for line in [
        "run IN/hertz.toml",
        "sweep IN/hertz.toml --vary load.normal_force=1,2",
        "--help",
    ] {
        let program = env!("CARGO_BIN_EXE_viscofriction");
        for (output, needed) in [(">&-", "it is closed"), (">/dev/full", "No space left")] {
            if output == ">/dev/full" && !cfg!(target_os = "linux") {
                continue;
            }
            let mut shell = Command::new("sh");
            let script = format!("exec \"$0\" \"$@\" {output}");
            let shell = shell.args(["-c", &script, program]);
            let said = said(
                shell
                    .current_dir(&folder.0)
                    .args(line.split(' ').map(argument)),
            );
            assert_eq!(said.status, Some(3), "{line} {output}: {said:?}");
            let needed = format!("error: the standard output was not written: {needed}");
            assert!(said.stderr.contains(&needed), "{line} {output}: {said:?}");
        }
        let mut command = folder.command(line);
        let null = command.stdout(Stdio::null()).status().expect("an end");
        assert!(null.success(), "{line} for nobody: {null}");
    }
}

#[test]
fn links_that_name_nothing_or_each_other_are_followed_or_refused() {
    let folder = Folder::new("dangling");
    for (link, target) in [("out", "real"), ("s.csv", "rows"), ("a", "b"), ("b", "a")] {
        symlink(target, folder.path(link)).expect("a link");
    }
    let sweep = "sweep IN/hertz.toml --vary load.normal_force=1,2 --out";
    folder.done("run IN/hertz.toml --out out");
    folder.done(format!("{sweep} s.csv"));
    for (link, written) in [("out", "real/result.json"), ("s.csv", "rows")] {
        assert!(folder.path(link).is_symlink(), "{link}");
        assert!(folder.path(written).is_file(), "{written}");
    }
    for line in ["run IN/hertz.toml --out a", &format!("{sweep} a")] {
        folder.ends(line, 2, "--out a: Too many levels of symbolic links");
    }
}

/// Whatever its name, and with no older picture beside other rows.
#[test]
fn the_table_of_a_road_is_no_picture_of_it() {
    let folder = Folder::new("road-picture");
    let line = "road IN/rough-road.toml --cut-offs 1 --out r.svg";
    for more in ["", " --overwrite"] {
        folder.done(format!("{line}{more}"));
        assert_eq!(folder.names("."), ["r.svg", "r.svg.png", "r.svg.svg"]);
        let rows = folder.text("r.svg");
        assert!(rows.starts_with("shortest_wavelength,"), "{rows}");
    }
}

/// A limit of the size of files stands for a disk without room.
#[test]
fn where_there_is_no_room_no_part_and_no_half_row_is_left() {
    let folder = Folder::new("no-room");
    folder.done("sweep IN/hertz.toml --vary load.normal_force=1:2:40 --out rows.csv");
    for line in [
        "run IN/half-space-run-in.toml --out out",
        "sweep IN/hertz.toml --vary load.normal_force=1:2:40 --out out/s.csv",
        "sweep --out out/m.csv --merge rows.csv",
    ] {
        let program = env!("CARGO_BIN_EXE_viscofriction");
        let script = "trap '' XFSZ; ulimit -f 8; exec \"$0\" \"$@\"";
        let shell = &mut Command::new("sh");
        let shell = shell.current_dir(&folder.0).args(["-c", script, program]);
        let said = said(shell.args(line.split(' ').map(argument)));
        assert_eq!(said.status, Some(3), "{line}: {said:?}");
        for needed in [" was not written: ", "File too large"] {
            assert!(said.stderr.contains(needed), "{line}: {said:?}");
        }
        // An empty folder does not stay either.
        let left = folder.names("out");
        let clean = left.iter().all(|name| !name.ends_with(".part"));
        assert!(clean, "{line}: {left:?} are left");
    }
    let beside = folder.names(".").join(" ");
    assert!(!beside.contains(".part"), "{beside}");
    let rows = folder.text("out/s.csv");
    let whole = rows.lines().count() > 2 && rows.ends_with('\n');
    assert!(whole, "a half row in {rows}");
}

#[test]
fn a_closed_pipe_ends_every_command_quietly() {
    let folder = prepared("closed-pipe");
    for [line] in table("what is printed") {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let mut command = folder.command(&line);
        let child = command.stdout(writer).stderr(Stdio::piped()).spawn();
        let output = child.expect("the command runs").wait_with_output();
        let output = output.expect("an end");
        let message = String::from_utf8_lossy(&output.stderr);
        let quiet = !message.contains("panicked") && !message.contains("error: ");
        assert!(output.status.success() && quiet, "{line}: {message}");
    }
    let written = folder.path("out/result.json").exists();
    assert!(written, "files are written before they are announced");
}

#[test]
fn a_file_that_the_scene_names_and_that_has_changed_makes_another_sweep() {
    let folder = Folder::with("changed", "measured-profile.toml", &[]);
    let profile = fs::read_to_string(example("profile.csv")).expect("a profile");
    folder.write("profile.csv", &profile);
    let sweep = "sweep scene.toml --vary load.normal_force=0.5,0.6 --out";
    folder.done(format!("{sweep} a.csv --shard 1/2"));
    // One more digit of the last height.
    folder.write("profile.csv", format!("{}1\n", profile.trim_end()));
    let resumed = format!("{sweep} a.csv --resume");
    folder.ends(&resumed, 2, "a file that the scene names");
    folder.done(format!("{sweep} b.csv --shard 2/2"));
    let merge = "sweep --out c.csv --merge a.csv b.csv";
    folder.ends(merge, 2, "the row is of another sweep");
}
