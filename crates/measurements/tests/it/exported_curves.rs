//! Curves in the layouts of instruments are read with the constants that they state, and every guess is reported.
//!
//! The layouts are those of public examples and manuals; the numbers are made up.

use std::ops::Range;
use std::path::Path;

use measurements::indentation::{CurveFile, CurveOptions, indentation_curve};

use crate::support::assert_close;

/// Depth \[nm] and force \[nN] of six points, a quarter of a second apart.
const CURVE: [[f64; 2]; 6] = [
    [0.0, 0.0],
    [100.0, 1.0],
    [200.0, 2.0],
    [195.0, 1.9],
    [90.0, 1.0],
    [-10.0, 0.0],
];

fn read(text: &str, options: &CurveOptions) -> Result<CurveFile, String> {
    let read = indentation_curve(Path::new("curve.txt"), text.as_bytes(), options);
    read.map_err(|error| error.to_string())
}

/// Requires the points of the curve and all sentences about it.
#[track_caller]
fn assert_read(text: &str, options: &CurveOptions, notes: &[&str]) {
    let CurveFile { curve, notes: said } =
        read(text, options).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(curve.time.len(), CURVE.len(), "{text}\n{curve:?}");
    for (i, [depth, force]) in CURVE.into_iter().enumerate() {
        // No number is 0.
        let pairs = [
            ("time", curve.time[i] + 1.0, 0.25 * i as f64 + 1.0),
            ("depth", 1e9 * curve.depth[i] + 50.0, depth + 50.0),
            ("force", 1e9 * curve.force[i] + 1.0, force + 1.0),
        ];
        for (what, read, written) in pairs {
            assert_close(format!("{what} {i} of\n{text}\n"), read, written, 1e-9);
        }
    }
    let said: Vec<String> = said.iter().map(ToString::to_string).collect();
    assert_eq!(said.len(), notes.len(), "{said:?}");
    for (said, expected) in said.iter().zip(notes) {
        assert!(said.contains(expected), "{said} and not {expected}");
    }
}

fn cantilever() -> CurveOptions {
    CurveOptions {
        spring_constant: Some(0.1),
        ..CurveOptions::default()
    }
}

fn ramp() -> CurveOptions {
    CurveOptions {
        ramp_rate: Some(0.5 / 0.75),
        ..CurveOptions::default()
    }
}

#[test]
fn tables_of_afmformats_are_in_si_and_know_their_spring_constant() {
    let head = "# afmformats 0.18.0\n#\n# BEGIN METADATA\n# {\n#   \"spring constant\": 0.1\n# }\n# END METADATA\n#\n";
    let rows = |columns: [usize; 4]| {
        let rows = CURVE.iter().enumerate().map(|(i, [depth, force])| {
            let numbers = [
                0.25 * i as f64,
                1e-9 * force,
                -1e-9 * (depth + 10.0 * force),
                -1e-9 * depth,
            ];
            let cells = columns.map(|column| format!("{:e}", numbers[column]));
            format!("{}\t{}\n", cells.join("\t"), i / 3)
        });
        rows.collect::<String>()
    };
    let names = "# force\theight (measured)\ttime\ttip position\tsegment\n";
    let all = format!("{head}{names}{}", rows([1, 2, 0, 3]));
    let choice = "and not from 'height (measured) [m]'";
    assert_read(&all, &CurveOptions::default(), &[choice]);
    let names = "# time\tforce\theight (measured)\theight (piezo)\tsegment\n";
    let height = format!("{head}{names}{}", rows([0, 1, 2, 3]));
    let stated = "spring_constant = 0.1 N/m is that of the file";
    assert_read(&height, &CurveOptions::default(), &[stated]);
    let given = CurveOptions {
        spring_constant: Some(0.2),
        ..CurveOptions::default()
    };
    let both = read(&height, &given).expect("a curve").notes;
    let said = both[0].to_string();
    assert!(
        said.contains("0.2 N/m is taken, but the file says 0.1"),
        "{said}"
    );
}

#[test]
fn the_halves_of_a_ramp_are_those_of_afm_workshop() {
    let head = |gain: &str| {
        format!(
            "Force-Distance Curve\nFile Format:\t3\n\nDate:\tWednesday, August 1, 2018\nTime:\t1:07:47 PM\nMode:\tSingle\n\
             Point:\t1\nX, um:\t27.25\nY, um:\t27.25\n{gain}\n"
        )
    };
    let rows = |in_volts: bool, back: [usize; 3]| {
        let cell = |i: usize| {
            let [depth, force] = CURVE[i];
            let load = if in_volts { 0.5 * force } else { force };
            format!("{:?},{load:?}", depth + 10.0 * force)
        };
        let rows = (0..3).map(|i| format!("{},{}\n", cell(i), cell(back[i])));
        rows.collect::<String>()
    };
    let names = "Extend Z-Sense(nm),Extend Force(nN),Retract Z-Sense(nm),Retract Force(nN)\n";
    let options = CurveOptions {
        spring_constant: Some(0.1),
        ..ramp()
    };
    let text = format!("{}{names}{}", head(""), rows(false, [3, 4, 5]));
    assert_read(&text, &options, &[]);
    let text = format!("{}{names}{}", head(""), rows(false, [5, 4, 3]));
    assert_read(&text, &options, &["the rows of the way back"]);
    let names = "Extend Z-Sense(nm),Extend T-B(V),Retract Z-Sense(nm),Retract T-B(V)\n";
    let known = head("Light Lever Gain, mV/nm:\t50\nForce Constant, nN/nm:\t0.1\n");
    let text = format!("{known}{names}{}", rows(true, [3, 4, 5]));
    assert_read(
        &text,
        &ramp(),
        &["spring_constant = 0.1", "sensitivity = 2e-8"],
    );
    let missing = read(&text, &CurveOptions::default()).expect_err("no times");
    assert!(
        missing.contains("--ramp-rate (ramp_rate in Python)"),
        "{missing}"
    );
    // The default of 1 says nothing.
    let unknown = head("Light Lever Gain, mV/nm:\t1\n");
    let text = format!("{unknown}{names}{}", rows(true, [3, 4, 5]));
    let missing = read(&text, &options).expect_err("no sensitivity");
    assert!(missing.contains("--sensitivity"), "{missing}");
    // The way back alone.
    let text = "t (s),Retract Force (nN),Retract depth (nm)\n0,2,200\n1,1,100\n2,0,0\n";
    let alone = read(text, &CurveOptions::default()).expect_err("no way in");
    assert!(alone.contains("only the way back"), "{alone}");
}

/// A table of the curve with these names, and each column times a factor.
fn table(names: &str, columns: &[(&str, f64)]) -> String {
    let rows = CURVE.iter().enumerate().map(|(i, [depth, force])| {
        let cells = columns.iter().map(|(of, factor)| match *of {
            "t" => format!("{:?}", factor * 0.25 * i as f64),
            "d" => format!("{:?}", factor * depth),
            "F" => format!("{:?}", factor * force),
            // A piezo with a cantilever of 0.1 N/m.
            "z" => format!("{:?}", factor * (depth + 10.0 * force)),
            other => other.to_owned(),
        });
        cells.collect::<Vec<_>>().join("\t") + "\n"
    });
    format!("{names}\n{}", rows.collect::<String>())
}

/// Names and columns of a table, and what is said about it.
type Export = (
    &'static str,
    &'static [(&'static str, f64)],
    &'static [&'static str],
);

const NANOINDENTERS: [Export; 9] = [
    (
        "Segment\tDisplacement Into Surface\tLoad On Sample\tTime On Sample\tHardness\n\tnm\tmN\ts\tGPa",
        &[
            ("Loading", 0.0),
            ("d", 1.0),
            ("F", 1e-6),
            ("t", 1.0),
            ("0", 0.0),
        ],
        &[],
    ),
    (
        "Depth (nm)\tLoad (µN)\tTime (s)\tDepth (V)\tLoad (V)",
        &[
            ("d", 1.0),
            ("F", 1e-3),
            ("t", 1.0),
            ("0.1", 0.0),
            ("0.2", 0.0),
        ],
        &["and not from 'Depth (V)', 'Load (V)'"],
    ),
    (
        "Device:\tChiaro\nk (N/m)\t0.1\nMax load (µN)\t3\n\nTime (s)\tLoad (uN)\tIndentation (nm)\tCantilever (nm)\tPiezo (nm)",
        &[("t", 1.0), ("F", 1e-3), ("d", 1.0), ("0", 0.0), ("z", 1.0)],
        &["and not from 'Piezo (nm)'"],
    ),
    (
        "Time [s]\tPd [nm]\tFn [mN]",
        &[("t", 1.0), ("d", 1.0), ("F", 1e-6)],
        &[],
    ),
    (
        "t/s\th/µm\tF/mN",
        &[("t", 1.0), ("d", 1e-3), ("F", 1e-6)],
        &[],
    ),
    (
        "Time (s)\tDisplacement (nm)\tLoad (uN)",
        &[("t", 1.0), ("d", 1.0), ("F", 1e-3)],
        &["'Displacement (nm)' is taken for the depth"],
    ),
    (
        "Zeit (s)\tWeg (µm)\tKraft (nN)",
        &[("t", 1.0), ("d", 1e-3), ("F", 1.0)],
        &["'Weg (µm)' is taken for the depth"],
    ),
    (
        "\"Time, s\"\t\"Depth, nm\"\t\"Load, µN\"",
        &[("t", 1.0), ("d", 1.0), ("F", 1e-3)],
        &[],
    ),
    (
        "Time (s)\tExtension (mm)\tLoad (N)",
        &[("t", 1.0), ("d", 1e-6), ("F", 1e-9)],
        &["'Extension (mm)' is taken for the depth"],
    ),
];

#[test]
fn names_of_nanoindenters_are_those_of_depth_and_load() {
    for (names, columns, notes) in NANOINDENTERS {
        assert_read(&table(names, columns), &CurveOptions::default(), notes);
    }
}

#[test]
fn a_displacement_is_a_depth_beside_a_force_and_a_piezo_with_a_cantilever() {
    let piezo = table(
        "Time (s)\tDisplacement (nm)\tLoad (nN)",
        &[("t", 1.0), ("z", 1.0), ("F", 1.0)],
    );
    assert_read(&piezo, &cantilever(), &["taken for the travel of a piezo"]);
    let deflection = table(
        "Time (s)\tDisplacement (nm)\tDeflection (nm)",
        &[("t", 1.0), ("z", 1.0), ("F", 10.0)],
    );
    assert_read(
        &deflection,
        &cantilever(),
        &["taken for the travel of a piezo"],
    );
    let needed = read(&deflection, &CurveOptions::default()).expect_err("no stiffness");
    assert!(needed.contains("'Deflection (nm)' is a length"), "{needed}");
    let piezo = piezo.replace("Displacement", "Z");
    let needed = read(&piezo, &CurveOptions::default()).expect_err("no stiffness");
    let says =
        needed.contains("'Z (nm)' is the place of a piezo") && needed.contains("named depth");
    assert!(says, "{needed}");
    let bare = table(
        "time\tforce\tdepth",
        &[("t", 1.0), ("F", 1e-9), ("d", 1e-9)],
    );
    let needed = read(&bare, &CurveOptions::default()).expect_err("no units");
    let says = "line 1: column 1 (time) has no unit, in brackets behind its name";
    assert!(needed.contains(says), "{needed}");
}

#[test]
fn a_time_that_begins_again_goes_on_where_the_depth_does() {
    let names = "t (s)\tdepth (nm)\tforce (nN)";
    let rows = |range: Range<usize>| {
        let rows = CURVE[range]
            .iter()
            .enumerate()
            .map(|(i, [depth, force])| format!("{:?}\t{depth:?}\t{force:?}\n", 0.25 * i as f64));
        rows.collect::<String>()
    };
    let default = CurveOptions::default();
    let two = format!("{names}\n{}{names}\n{}", rows(0..3), rows(3..6));
    assert_read(
        &two,
        &default,
        &["the time begins again in line 6: it goes on at 0.750000 s"],
    );
    let one = format!("{names}\n{}{}", rows(0..3), rows(3..6));
    assert_read(&one, &default, &["the time begins again in line 5"]);
    // Another way in, and another complete curve.
    let again = format!("{names}\n{}{}", rows(0..3), rows(0..3));
    let complete = format!("{names}\n{0}{names}\n{0}", rows(0..6));
    for text in [again, complete] {
        let refused = read(&text, &default).expect_err("two curves");
        assert!(refused.contains("another curve that begins"), "{refused}");
    }
}
