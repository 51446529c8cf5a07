//! Every malformed file that a command reads ends with status 2 and one line that names the file and the place in it, says
//! what is needed, and prints nothing else; tests of the library have those of scenes.

use crate::support::{Case, Folder, cases, table};

/// Runs the command on every one of the contents of the file: it ends with status 2, prints nothing, and says one line
/// that begins with the place.
fn assert_refused(folder: &Folder, file: &str, line: &str, cases: Vec<Case>) {
    let mut wrong = Vec::new();
    for (contents, place, needed) in cases {
        folder.write(file, &contents);
        let said = folder.run(line);
        let message = &said.stderr;
        let helpful =
            message.starts_with(&format!("error: {place}: ")) && message.contains(&needed);
        let brief = message.trim_end().lines().count() == 1 && said.stdout.is_empty();
        if said.status != Some(2) || !helpful || !brief {
            let contents = String::from_utf8_lossy(&contents);
            wrong.push(format!(
                "{contents}\n--- needs {place:?} and {needed:?}, but {said:?}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn malformed_rows_and_moduli_are_refused_with_their_line_and_leave_nothing() {
    let folder = Folder::new("malformed-rows");
    let mut wrong = cases("rows of a sweep", |line| format!("rows.csv:{line}"));
    for (rows, ..) in &mut wrong {
        rows.splice(0..0, *b"sweep,point,points,load.velocity,failure\n");
    }
    let merge = "sweep --out out --merge rows.csv";
    assert_refused(&folder, "rows.csv", merge, wrong);
    let wrong = cases("measured moduli", |place| format!("moduli.csv, {place}"));
    let fit = "fit-material moduli.csv --out out";
    assert_refused(&folder, "moduli.csv", fit, wrong);
    let left = folder.names("").join(" ");
    assert_eq!(left, "moduli.csv rows.csv", "left of wrong files");
}

#[test]
fn wrong_options_are_refused_and_leave_nothing() {
    let folder = Folder::with("options", "cone-viscous.toml", &[]);
    for [file, contents] in table("files of wrong options") {
        folder.write(&file, contents);
    }
    let names = folder.names("");
    for [line, needed] in table("wrong options") {
        folder.ends(&line, 2, &needed);
        assert_eq!(folder.names(""), names, "left by {line}");
    }
}
