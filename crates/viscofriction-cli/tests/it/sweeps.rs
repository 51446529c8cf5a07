//! A sweep can be interrupted, taken up again, and divided.

use std::fs;
use std::path::Path;

use crate::support::{Folder, assert_close, said, table};

const VARY: &str = "--vary indenter.cone.slope=0.05:0.2:4 --vary load.velocity=1e-3:1:5:log";

/// The rows of a sweep into a file, with more options.
#[track_caller]
fn swept(folder: &Folder, out: &str, more: &str) -> String {
    let line = format!("sweep scene.toml {VARY} --out {out} {more}");
    folder.done(line);
    folder.text(out)
}

fn quick(name: &str) -> Folder {
    Folder::with(name, "cone-viscous.toml", &[])
}

/// Takes some milliseconds per point, so that a kill finds it at work.
fn slow(name: &str) -> Folder {
    let replaced = [("relative_error = 1e-2", "elements = 10")];
    Folder::with(name, "cone-half-space.toml", &replaced)
}

#[test]
fn a_sweep_killed_at_any_moment_keeps_its_rows_and_goes_on_to_the_same() {
    let folder = slow("killed-with-rows");
    let expected = swept(&folder, "whole.csv", "");
    let line = format!("sweep scene.toml {VARY} --out out/rows.csv --resume");
    let rows = || fs::read_to_string(folder.path("out/rows.csv")).unwrap_or_default();
    // The first line has the names.
    for n_rows in [0, 1, 6, 13] {
        let is_killed = folder.kill_when(&line, || rows().matches('\n').count() > n_rows);
        assert!(is_killed, "the sweep ended before");
        let left = rows();
        assert!(left.matches('\n').count() > n_rows, "{left} are left");
        // Threads finish their points in any order.
        let whole = left.split_inclusive('\n').all(|row| expected.contains(row));
        assert!(whole, "{left} is not of {expected}");
    }
    // As if it had been killed while it wrote a picture.
    folder.write("out/.rows.png.viscofriction-0.part", "");
    assert_eq!(swept(&folder, "out/rows.csv", "--resume"), expected);
    let left = folder.names("out").join(" ");
    assert_eq!(left, "rows.csv rows.html rows.png rows.svg", "what is left");
}

/// The page of a sweep shows a number as the table of its scene does.
#[test]
fn the_page_of_a_sweep_has_no_digit_beyond_the_second_of_an_error() {
    let folder = Folder::new("page-of-sweep");
    folder.done("sweep IN/cone-viscous.toml --vary load.velocity=0.01,0.02 --out rows.csv");
    let page = folder.text("rows.html");
    for cell in [
        "<th>friction coefficient μ</th><th>normal force F [N]</th>",
        "<td>0.01</td><td>0.0891298 ± 0.0000073</td><td>1</td>",
    ] {
        assert!(page.contains(cell), "no {cell} in {page}");
    }
}

#[test]
fn a_sweep_killed_while_it_overwrites_goes_on() {
    let folder = slow("killed-overwriting");
    let expected = swept(&folder, "whole.csv", "");
    let line = format!("sweep scene.toml {VARY} --out rows.csv --overwrite");
    for pictures in [&["rows.svg", "rows.png"][..], &["rows.png"]] {
        // Of another sweep, and of somebody else.
        folder.done("sweep IN/hertz.toml --vary load.normal_force=1,2 --out rows.csv --overwrite");
        for name in ["rows.svg", "rows.png"] {
            fs::remove_file(folder.path(name)).expect("a picture");
        }
        for name in pictures {
            folder.write(name, "mine");
        }
        let begins = || folder.text("rows.csv").contains("cone.slope");
        assert!(folder.kill_when(&line, begins), "the sweep ended before");
        assert_eq!(swept(&folder, "rows.csv", "--resume"), expected);
        let svg = folder.text("rows.svg");
        assert!(svg.contains("friction coefficient"), "{svg}");
    }
}

#[test]
fn a_file_cut_anywhere_or_with_a_gap_gets_what_it_lacks() {
    let folder = quick("cut-sweep");
    let expected = swept(&folder, "whole.csv", "");
    let lengths = (0..expected.len()).step_by(expected.len() / 23);
    let cut = lengths.map(|length| expected[..length].to_owned());
    let lines: Vec<&str> = expected.split_inclusive('\n').collect();
    let with_gap = [&lines[..4], &lines[7..]].concat().concat();
    for damaged in cut.chain([with_gap]) {
        folder.write("rows.csv", &damaged);
        let resumed = swept(&folder, "rows.csv", "--resume");
        assert_eq!(resumed, expected, "from {damaged}");
    }
}

#[test]
fn shards_join_to_the_whole_and_say_what_is_missing() {
    let folder = quick("shards");
    let expected = swept(&folder, "whole.csv", "");
    for shard in ["1", "2", "3"] {
        swept(&folder, shard, &format!("--shard {shard}/3"));
    }
    folder.done("sweep --out all.csv --merge 3 1 2");
    assert_eq!(folder.text("all.csv"), expected);
    let missing = "no file has the points 2, 5, 8, 11, 14, 17, 20";
    let merge = "sweep --overwrite --out all.csv --merge 3 1";
    folder.ends(merge, 1, missing);
}

#[test]
fn a_row_with_other_parameters_than_those_it_was_computed_for_is_not_joined() {
    let folder = quick("changed-rows");
    let rows = swept(&folder, "rows.csv", "");
    for (was, is) in [
        (",5,20,", ",6,20,"),
        (",20,0.05,", ",30,0.05,"),
        (",0.05,", ",0.06,"),
        (",0.001,", ",0.01,"),
    ] {
        assert!(rows.contains(was), "no {was} in {rows}");
        folder.write("changed.csv", rows.replacen(was, is, 1));
        let merge = "sweep --out all.csv --merge changed.csv";
        folder.ends(merge, 2, "not what was computed");
    }
}

/// What a spreadsheet writes is what was computed as long as its numbers are; a number that is another one is named.
#[test]
fn an_answer_that_was_changed_is_neither_joined_nor_kept() {
    let folder = quick("changed-answers");
    let rows = swept(&folder, "rows.csv", "");
    let sweep = format!("sweep scene.toml {VARY} --out changed.csv --resume");
    let place = rows
        .split(',')
        .position(|name| name == "friction_coefficient");
    let place = place.expect("a column");
    let line = rows.lines().nth(3).expect("a row");
    let friction = line.split(',').nth(place).expect("a friction");
    for found in ["nan", "", "0.5", &friction[..friction.len() - 1]] {
        let changed = line.replacen(&format!(",{friction},"), &format!(",{found},"), 1);
        folder.write("changed.csv", rows.replace(line, &changed));
        let needed = format!(
            "changed.csv:4: column {}, friction_coefficient, is {found:?}",
            place + 1
        );
        folder.ends("sweep --merge changed.csv", 2, &needed);
        folder.ends(&sweep, 2, &needed);
    }
    let scientific = format!("{:E}", friction.parse::<f64>().expect("a number"));
    let same = rows
        .replace(friction, &scientific)
        .replace(",0.0,", ",0,")
        .replace('\n', "\r\n");
    folder.write("changed.csv", format!("\u{feff}{same}"));
    folder.done("sweep --out all.csv --merge changed.csv");
    folder.done(sweep);
    folder.write("changed.csv", rows.replace(',', ";"));
    folder.ends(
        "sweep --merge changed.csv",
        2,
        "changed.csv:1: no row of a sweep: commas are needed",
    );
}

#[test]
fn rows_are_printed_in_the_order_of_their_points() {
    let folder = slow("ordered");
    let expected = swept(&folder, "whole.csv", "");
    for threads in ["1", "3"] {
        let mut command = folder.command(&format!("sweep scene.toml {VARY}"));
        let said = said(command.env("RAYON_NUM_THREADS", threads));
        assert_eq!(said.stdout, expected, "{threads} threads");
    }
}

#[test]
fn a_finished_sweep_that_is_resumed_says_so() {
    let folder = quick("finished");
    let expected = swept(&folder, "rows.csv", "");
    let line = format!("sweep scene.toml {VARY} --out rows.csv --resume");
    let said = folder.done(line).stderr;
    let n_rows = expected.lines().count() - 1;
    let sentence = format!("no point was computed: rows.csv has all {n_rows} already");
    assert!(said.contains(&sentence), "{said}");
    assert_eq!(folder.text("rows.csv"), expected, "the rows");
}

/// The allowed memory is not of the sweep: a point that failed for it may be computed where there is more.
#[test]
fn points_that_failed_are_computed_again_when_asked_for() {
    let limit = ("relative_error = 1e-2", "max_memory = \"8 MiB\"");
    let folder = Folder::with("retried", "cone-half-space.toml", &[limit]);
    let vary = "--vary solve.relative_error=0.1,0.05 --out";
    let line = format!("sweep scene.toml {vary} rows.csv");
    folder.ends(&line, 1, "2 of 2 points could not be computed");
    let text = folder.text("scene.toml");
    folder.write("scene.toml", text.replace("8 MiB", "1 GiB"));
    let advice = "2 of them failed in an earlier run, and --retry-failed computes them again";
    folder.ends(&format!("{line} --resume"), 1, advice);
    let said = folder.done(format!("{line} --retry-failed"));
    assert!(
        said.stderr.contains("2 points computed, 2 in rows.csv"),
        "{said:?}"
    );
    folder.done(format!("sweep scene.toml {vary} whole.csv"));
    assert_eq!(folder.text("rows.csv"), folder.text("whole.csv"));
}

#[test]
fn several_threads_and_a_limit_of_memory_write_the_same_rows() {
    let folder = slow("threads");
    let expected = swept(&folder, "whole.csv", "");
    let text = folder.text("scene.toml");
    folder.write("scene.toml", text + "threads = 3\nmax_memory = \"1 GiB\"\n");
    assert_eq!(swept(&folder, "threads.csv", ""), expected);
}

#[test]
fn the_file_of_another_sweep_is_not_continued() {
    let folder = quick("other-sweep");
    swept(&folder, "rows.csv", "");
    let line = format!("sweep IN/cone-half-space.toml {VARY} --out rows.csv --resume");
    folder.ends(&line, 2, "rows.csv:2: the file is of another scene");
}

/// Rows of an earlier motion are not those of the present one.
#[test]
fn a_sweep_whose_motion_file_has_changed_is_not_continued() {
    let folder = Folder::new("other-motion");
    folder.write(
        "scene.toml",
        "indenter.sphere.radius = 5e-3
material.kelvin-voigt = { shear_modulus = 1e6, viscosity = 1e3 }
load = { normal_force = 2.0, motion_file = \"path.csv\" }
solve = { model = \"line\", elements = 16 }\n",
    );
    let path = |end: &str| format!("time_s,position_m\n0,0\n1,{end}\n");
    folder.write("path.csv", path("1e-3"));
    let line = "sweep scene.toml --vary load.normal_force=1,2 --out rows.csv";
    folder.done(line);
    folder.write("path.csv", path("2e-3"));
    let resumed = format!("{line} --resume");
    folder.ends(&resumed, 2, "rows.csv:2: the file is of another scene");
}

#[test]
fn a_point_that_cannot_be_computed_is_a_row_and_status_1() {
    let method = ("mdr-transient", "analytic");
    let closed = [method, ("elements = 64", "model = \"line\"")];
    let folder = Folder::with("failing-sweep", "power-law.toml", &closed);
    let line = "sweep scene.toml --vary indenter.power.exponent=0.5:1.5:3 --out rows.csv";
    folder.ends(line, 1, "1 of 3 points could not be computed");
    let rows = folder.text("rows.csv");
    let answered = ",analytic,line,";
    let rows: Vec<&str> = rows.lines().skip(1).collect();
    let infinite = "friction of the one-dimensional model is infinite";
    for (index, needed) in [infinite, answered, answered].iter().enumerate() {
        let row = rows[index];
        assert!(row.contains(needed), "no {needed} in {row}");
    }
}

/// Marching has no derivatives, and its answers are as good without.
#[test]
fn a_point_without_derivatives_keeps_its_answer_and_says_why() {
    let folder = quick("no-derivatives");
    let scene = format!("solve.elements = 16\n{}", folder.text("scene.toml"));
    folder.write("scene.toml", scene);
    let vary = "--vary solve.method=bem-steady,mdr-transient";
    let line = format!("sweep scene.toml --sensitivity {vary} --out rows.csv");
    let said = folder.done(line).stderr;
    let why = "mdr-transient knows no derivatives of this answer";
    assert!(
        said.contains(why) && said.contains("(at 1 of 2 points)"),
        "{said}"
    );
    let rows = folder.text("rows.csv");
    let place = rows
        .split(',')
        .position(|name| name == "friction_coefficient");
    let friction = folder.column("rows.csv", place.expect("a friction"));
    assert!(
        friction.len() == 2 && friction.iter().all(|friction| *friction > 0.0),
        "{rows}"
    );
}

#[test]
fn files_and_words_of_a_scene_vary() {
    let folder = Folder::new("varied-texts");
    let material = |modulus: f64| format!("material.elastic.shear_modulus = {modulus:e}\n");
    folder.write("soft.toml", material(1e6));
    folder.write("hard.toml", material(8e6));
    let load = "load = { normal_force = 1.0, velocity = 0.0 }\n";
    let body = "indenter.paraboloid.curvature = 50.0\nmaterial.file.path = \"soft.toml\"\n";
    folder.write("scene.toml", [load, body].concat());
    let vary = "--vary solve.duration=1,2 --vary material.file.path=soft.toml,hard.toml";
    let line = format!("sweep scene.toml {vary} --out rows.csv");
    folder.done(&line);
    let rows = folder.text("rows.csv");
    let place = rows.split(',').position(|name| name == "indentation_depth");
    let depths = folder.column("rows.csv", place.expect("a depth"));
    // The depth of a paraboloid falls with the power 2/3 of the modulus.
    assert_close("depth", depths[0], 4.0 * depths[1], 1e-12);
    assert!(rows.contains(",2.0,hard.toml,"), "{rows}");
    folder.write("hard.toml", material(9e6));
    let line = format!("{line} --resume");
    folder.ends(
        &line,
        2,
        "from before a file that the scene names was changed",
    );
}

#[test]
fn warnings_are_a_column_and_are_said_once() {
    let steep = [("slope = 0.1", "slope = 0.7")];
    let folder = Folder::with("warned", "cone-viscous.toml", &steep);
    let line = "sweep scene.toml --vary indenter.cone.slope=0.1,0.7,0.8 --out rows.csv";
    let said = folder.done(line).stderr;
    let warnings: Vec<&str> = said
        .lines()
        .filter(|line| line.starts_with("warning"))
        .collect();
    let [warning] = warnings[..] else {
        panic!("{said}");
    };
    assert!(
        warning.ends_with("(at 2 of 3 points, with the numbers of the first)"),
        "{warning}"
    );
    // Below the warnings stands the page that explains them.
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/numbers.md");
    let page = fs::read_to_string(page).expect("the page");
    let explained = "the mean slope of the surface in contact is";
    assert!(
        warning.contains(explained) && page.contains(explained),
        "{warning}"
    );
    for said in [said, folder.done("run scene.toml").stdout] {
        assert!(said.contains("about warnings: docs/numbers.md\n"), "{said}");
    }
    let rows = folder.text("rows.csv");
    let rows: Vec<&str> = rows.lines().collect();
    assert!(rows[0].ends_with(",warnings,failure"), "{}", rows[0]);
    assert!(rows[1].ends_with(",,"), "{}", rows[1]);
    let [steep, steeper] = [rows[2], rows[3]].map(|row| row.contains("the mean slope"));
    assert!(steep && steeper, "{rows:?}");
}

#[test]
fn a_sweep_is_drawn_over_what_varies() {
    let depth = ("normal_force = 1.0", "indentation_depth = 1e-5");
    let folder = Folder::with("drawn-sweeps", "hertz.toml", &[depth]);
    fs::rename(folder.path("scene.toml"), folder.path("held.toml")).expect("a scene");
    for [sweep, labels] in table("drawn") {
        let said = folder.done(format!("sweep {sweep} --out rows.csv --overwrite"));
        assert!(!said.stderr.contains("no picture"), "{sweep}: {said:?}");
        let svg = folder.text("rows.svg");
        for label in labels.split(" | ") {
            assert!(svg.contains(label), "{sweep}: no {label} in {svg}");
        }
        let png = fs::read(folder.path("rows.png")).expect("a picture");
        assert_eq!(png[1..4], *b"PNG", "{sweep}");
    }
}
