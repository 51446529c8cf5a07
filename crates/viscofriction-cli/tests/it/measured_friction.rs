//! Measured friction beside that of a sweep.

use std::fs;

use crate::fit_friction::{SCENE, points};
use crate::support::{Folder, assert_close};

/// Speeds of a sweep from 1 mm/s to 1 m/s.
fn speeds(count: usize) -> String {
    format!("--vary load.velocity=1e-3:1:{count}:log")
}

/// A table of friction in mm/s, with standard errors.
fn table(points: &[[f64; 2]]) -> String {
    let row = |[velocity, friction]: &[f64; 2]| {
        format!("{},{friction},{}\n", 1e3 * velocity, 0.01 * friction)
    };
    let rows: String = points.iter().map(row).collect();
    format!("v (mm/s),mu,standard error\n{rows}")
}

/// The cells of a CSV file without its names.
fn cells(folder: &Folder, file: &str) -> Vec<Vec<String>> {
    let text = folder.text(file);
    let row = |line: &str| line.split(',').map(str::to_owned).collect();
    text.lines().skip(1).map(row).collect()
}

/// Measured values are exact answers: at computed speeds no residual is left, between them at most the error of interpolation.
#[test]
fn residuals_of_exact_friction_are_within_their_bars() {
    let folder = Folder::new("measured-friction");
    // Speeds between those of the sweep, and one beyond.
    let mut measured = points(&folder, 29);
    measured.push([10.0, 0.02]);
    folder.write("friction.csv", table(&measured));
    let line = format!("sweep true.toml {} --out rows.csv", speeds(15));
    let said = folder.done(format!("{line} --measured friction.csv"));
    let summary =
        "29 of 30 measured points are within the computed speeds: root mean square residual";
    assert!(said.stderr.contains(summary), "{said:?}");
    let names =
        "load.velocity,friction_coefficient,standard_error,computed,computed_error,residual\n";
    assert!(folder.text("rows.measured.csv").starts_with(names));
    let rows = cells(&folder, "rows.measured.csv");
    assert_eq!(rows.len(), 30);
    for (place, (row, [velocity, friction])) in rows.iter().zip(&measured).enumerate() {
        if place == 29 {
            assert_eq!(row[3..], ["", "", ""], "beyond the computed speeds");
            continue;
        }
        let number = |cell: usize| row[cell].parse::<f64>().expect("a number");
        assert_close("speed", number(0), *velocity, 1e-12);
        assert_close("measured", number(1), *friction, 1e-15);
        assert_close("standard error", number(2), 0.01 * friction, 1e-12);
        let [computed, error, residual] = [3, 4, 5].map(number);
        assert_close("residual", computed + residual, *friction, 1e-12);
        let allowed = if place % 2 == 0 { 1e-9 } else { 0.1 };
        assert!(
            residual.abs() <= error && error <= allowed * friction,
            "{residual} within {error} at {velocity} m/s"
        );
    }
    let svg = folder.text("rows.svg");
    assert!(
        svg.contains("measured") && svg.contains("computed"),
        "{svg}"
    );
    // Rows and their picture are resumed with another table, and joined.
    folder.write("friction.csv", table(&measured[..3]));
    folder.done(format!("{line} --measured friction.csv --resume"));
    assert_eq!(cells(&folder, "rows.measured.csv").len(), 3);
    folder.done("sweep --merge rows.csv --out all.csv --measured friction.csv");
    let [resumed, joined] =
        ["rows", "all"].map(|name| folder.text(&format!("{name}.measured.csv")));
    assert_eq!(resumed, joined, "residuals of the joined rows");
    assert!(fs::exists(folder.path("all.svg")).expect("a folder"));
}

#[test]
fn points_belong_to_the_curve_of_their_normal_force() {
    let folder = Folder::new("measured-forces");
    let row =
        |[velocity, friction]: [f64; 2], force: &str| format!("{velocity},{friction},{force}\n");
    let rows = points(&folder, 8)
        .into_iter()
        .map(|point| row(point, "1.01") + &row(point, "3.0"));
    let rows: String = rows.collect();
    folder.write(
        "friction.csv",
        format!("v (m/s),mu,normal force (N)\n{rows}"),
    );
    let speeds = speeds(8);
    // The first and the second curve of the forces has the points.
    for forces in ["1,2", "0.5,1"] {
        let line = format!("sweep true.toml --vary load.normal_force={forces} {speeds}");
        let said = folder.done(format!(
            "{line} --measured friction.csv --out rows.csv --overwrite"
        ));
        assert!(!said.stderr.contains("no picture"), "{said:?}");
        let svg = folder.text("rows.svg");
        assert!(svg.contains("measured"), "a curve has points: {svg}");
    }
    folder.done(format!(
        "sweep true.toml --vary load.normal_force=1,2 {speeds} --measured friction.csv --out rows.csv --overwrite"
    ));
    let rows = cells(&folder, "rows.measured.csv");
    let forces: Vec<&str> = rows.iter().map(|row| &*row[1]).collect();
    assert_eq!(forces, ["1.0"; 8], "no curve has 3 N");
    // Without forces points belong to both curves.
    let text = folder.text("friction.csv").replace(",3.0\n", ",1.01\n");
    let without: Vec<&str> = text
        .lines()
        .map(|line| &line[..line.rfind(',').expect("a cell")])
        .collect();
    folder.write("friction.csv", without.join("\n"));
    folder.done(format!(
        "sweep true.toml --vary load.normal_force=1,2 {speeds} --measured friction.csv --out rows.csv --overwrite"
    ));
    assert_eq!(cells(&folder, "rows.measured.csv").len(), 32);
}

/// What is wrong with a table is said before anything is computed.
#[test]
fn tables_that_do_not_fit_are_refused() {
    let folder = Folder::new("measured-refused");
    let scene = SCENE.replace("[solve]", "velocity = 1.0\n[solve]");
    folder.write("scene.toml", scene);
    let good = "v (m/s),mu\n0.01,0.1\n0.1,0.2\n";
    let eight = speeds(8);
    let outside = "friction.csv: its speeds, 10.0 to 100.0 m/s, are outside of those of the sweep, 0.001 to 1.0 m/s: is their \
                   unit in the table right? --vary load.velocity=1e1:1e2:20:log covers the table";
    let over = "friction.csv: measured friction is compared over the speed, and load.velocity is not the key with the most numbers";
    let forces = "v,mu,normal force\nm/s,,N\n0.01,0.1,1\n0.1,0.2,3\n";
    let several = "it has several normal forces, 1.0 to 3.0 N, and the sweep only one; vary load.normal_force too";
    let varied = format!("--vary load.normal_force=10,20 {eight}");
    let none =
        "none of its normal forces, 1.0 to 3.0 N, is one of load.normal_force, 10.0 to 20.0 N";
    for (vary, text, needed) in [
        (&*eight, "v (m/s),mu\n10,0.1\n100,0.2\n", outside),
        ("--vary load.normal_force=1,2", good, over),
        (&eight, forces, several),
        (&varied, forces, none),
        (
            &eight,
            "v (m/s),depth (mm)\n0.01,1\n",
            "friction.csv, line 1: a line of names is needed",
        ),
        (
            &eight,
            "v (furlong/s),mu\n0.01,0.1\n",
            "friction.csv, line 1, column 1",
        ),
        (
            &eight,
            "v (m/s),mu\n0.01,70\n0.1,80\n",
            "in per cent the name is",
        ),
    ] {
        folder.write("friction.csv", text);
        folder.ends(
            &format!("sweep scene.toml {vary} --measured friction.csv --out rows.csv"),
            2,
            needed,
        );
        assert!(
            !fs::exists(folder.path("rows.csv")).expect("a folder"),
            "{needed}"
        );
    }
    let line = format!("sweep scene.toml {eight} --measured none.csv --out rows.csv");
    folder.ends(&line, 2, "none.csv: No such file");
}
