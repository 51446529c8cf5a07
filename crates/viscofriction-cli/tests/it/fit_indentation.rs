//! Curves of force over depth, and the rows and reasons that the program gives for them.

use std::fs;

use crate::support::{Folder, argument, assert_close};

/// [m/V] of a cantilever of 0.061 N/m whose detector says one volt for a nanonewton.
const SENSITIVITY: f64 = 1e-9 / 0.061;

#[test]
fn a_map_has_a_row_for_each_curve() {
    let folder = Folder::new("map");
    let curve = fs::read_to_string(argument("IN/../data/brain.csv")).expect("a curve");
    folder.write("0.csv", &curve);
    folder.write("2.csv", curve.replace("height", "piezo"));
    folder.write("volts.csv", curve.replace("force (nN)", "deflection (V)"));
    let options = "--sphere 18.6e-6 --spring-constant 0.061";
    folder.done(format!("fit-indentation 0.csv 2.csv {options} --out out"));
    folder.done(format!(
        "fit-indentation volts.csv {options} --sensitivity {SENSITIVITY:?} --out volts"
    ));
    let in_volts = folder.column("volts/findings.csv", 2);
    let table = csv::Reader::from_path(folder.path("out/curves.csv"));
    let rows = table.expect("a table").into_records();
    let rows: Vec<csv::StringRecord> = rows.map(|row| row.expect("a row")).collect();
    let value = |row: usize, column: usize| rows[row][column].parse().expect("a number");
    // As in docs/fit-indentation.md.
    for (column, documented) in [(2, 8.79), (6, 2.75), (10, 0.89)] {
        assert_close("in nN", value(0, column), documented, 1e-2);
        let of_volts = in_volts[(column - 2) / 4];
        assert_close("in volts", of_volts, value(0, column), 1e-6);
    }
    let is_kept = rows[1][1].starts_with("2.csv: the force falls")
        && rows[1].iter().skip(2).all(str::is_empty);
    assert!(is_kept, "{:?}", rows[1]);
    let upside_down = format!("2.csv {options}");
    for (options, wrong) in [
        (&*upside_down, "2.csv: the force falls"),
        ("0.csv --sphere 5e-9 --spring-constant 0.061", "equator"),
        ("0.csv --sphere 18.6e-6", "spring_constant"),
        (
            "0.csv --sphere 1e308 --spring-constant 0.061",
            "times as wide as deep",
        ),
        ("0.csv --cone 90", "--cone must be greater than 0"),
    ] {
        folder.ends(&format!("fit-indentation {options}"), 2, wrong);
    }
}
