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
    folder.write("1.csv", curve.replace("force (nN)", "deflection (V)"));
    folder.write("2.csv", curve.replace("height", "depth"));
    let curves = "0.csv 1.csv 2.csv 3.csv --sphere 18.6e-6 --spring-constant 0.061";
    folder.done(format!(
        "fit-indentation {curves} --sensitivity {SENSITIVITY:?} --out out"
    ));
    let table = csv::Reader::from_path(folder.path("out/curves.csv"));
    let rows = table.expect("a table").into_records();
    let rows: Vec<csv::StringRecord> = rows.map(|row| row.expect("a row")).collect();
    let value = |row: usize, column: usize| rows[row][column].parse().expect("a number");
    // As in docs/fit-indentation.md.
    for (column, documented) in [(2, 8.79), (6, 2.75), (10, 0.89)] {
        assert_close("in nN", value(0, column), documented, 1e-2);
        assert_close("in volts", value(1, column), value(0, column), 1e-6);
    }
    for (row, reason) in [(2, "2.csv: the force falls"), (3, "3.csv: No such file")] {
        let is_kept =
            rows[row][1].starts_with(reason) && rows[row].iter().skip(2).all(str::is_empty);
        assert!(is_kept, "{:?}", rows[row]);
    }
    for (options, wrong) in [
        ("2.csv --sphere 18.6e-6", "2.csv: the force falls"),
        ("0.csv --sphere 5e-9 --spring-constant 0.061", "equator"),
        ("0.csv --sphere 18.6e-6", "spring_constant"),
        ("0.csv --cone 90", "--cone must be greater than 0"),
    ] {
        folder.ends(&format!("fit-indentation {options}"), 2, wrong);
    }
}
