//! From a table of measured moduli to the material of a scene.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// An empty folder of this name.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::remove_dir_all(&folder).ok();
    fs::create_dir_all(&folder).expect("the folder can be made");
    folder
}

fn fit_material(table: &Path, out: &Path, options: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_viscofriction"))
        .arg("fit-material")
        .arg(table)
        .arg("--out")
        .arg(out)
        .args(options)
        .output()
        .expect("the command runs")
}

fn message(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn measured(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    root.join("../crates/rheology/tests/data").join(name)
}

fn material(out: &Path) -> toml::Table {
    let text = fs::read_to_string(out.join("material.toml")).expect("material.toml is there");
    let file: toml::Table = text.parse().expect("valid TOML");
    let prony = file["material"]["prony"].as_table();
    prony.expect("a table [material.prony]").clone()
}

#[test]
fn a_master_curve_becomes_the_material_of_a_scene() {
    let out = folder("master");
    let table = measured("pyvisco_frequency_master.csv");
    let output = fit_material(
        &table,
        &out,
        &["--branches", "20", "--poisson-ratio", "0.4"],
    );
    assert_eq!(output.status.code(), Some(0), "{}", message(&output));
    let prony = material(&out);
    let branches = prony["branches"].as_array().expect("a list");
    assert!(
        (1..=20).contains(&branches.len()),
        "{} branches",
        branches.len()
    );
    let moduli = branches
        .iter()
        .map(|branch| branch["modulus"].as_float().expect("a number"));
    let glass = moduli.sum::<f64>() + prony["equilibrium_modulus"].as_float().expect("a number");
    // The last E' is 9580.5 MPa; the series ends within the 12 % that it is off anywhere.
    let expected = 9580.5e6 / 2.8;
    assert!(
        (glass / expected - 1.0).abs() < 0.12,
        "glass modulus {glass:e}, expected {expected:e}"
    );
    let ratio = prony["poisson_ratio"].as_float().expect("a number");
    assert!((ratio - 0.4).abs() <= 0.0, "Poisson ratio {ratio}");
    for file in ["fit.csv", "fit.svg", "fit.png"] {
        let length = fs::metadata(out.join(file)).map_or(0, |data| data.len());
        assert!(length > 1000, "{file} has {length} bytes");
    }
}

#[test]
fn isotherms_are_shifted_onto_one_curve() {
    let out = folder("isotherms");
    let table = measured("pyvisco_frequency_raw.csv");
    let output = fit_material(&table, &out, &["--reference-temperature", "-5"]);
    assert_eq!(output.status.code(), Some(0), "{}", message(&output));
    let shifts = fs::read_to_string(out.join("shifts.csv")).expect("shifts.csv is there");
    let shifts: Vec<[f64; 2]> = shifts
        .lines()
        .skip(1)
        .map(|line| {
            let mut cells = line.split(',').map(|cell| cell.parse().expect("a number"));
            [(); 2].map(|()| cells.next().expect("two cells"))
        })
        .collect();
    assert_eq!(shifts.len(), 21, "isotherms");
    // pyvisco 2.1.3, `master.get_aT(df_raw, -5)`, which fits power laws to the storage moduli and shifts those. The two
    // coldest isotherms are nearly flat and left out.
    let peers = [
        (2, 7.840),
        (3, 6.095),
        (6, 0.0),
        (10, -6.689),
        (15, -14.511),
        (20, -18.345),
    ];
    for (place, peer) in peers {
        let [temperature, log] = shifts[place];
        assert!(
            (log - peer).abs() < 0.3,
            "log a_T at {temperature} is {log}, by pyvisco {peer}"
        );
    }
    for pair in shifts.windows(2) {
        assert!(pair[1][1] < pair[0][1], "warmer and slower: {pair:?}");
    }
}

#[test]
fn a_liquid_and_a_relaxation_are_fitted_too() {
    let out = folder("liquid");
    let table = out.join("maxwell.csv");
    // G = 3 kPa, τ = 2 s: G' = G Ω²/(1 + Ω²), G'' = G Ω/(1 + Ω²), Ω = 2 ω.
    let rows = [0.01, 0.1, 0.5, 1.0, 10.0_f64].map(|omega| {
        let x = 2.0 * omega;
        let denominator = 1.0 + x * x;
        format!(
            "{omega},{},{}\n",
            3.0 * x * x / denominator,
            3.0 * x / denominator
        )
    });
    fs::write(
        &table,
        format!("ω, G′, G″\nrad/s, kPa, kPa\n{}", rows.concat()),
    )
    .expect("a file");
    let output = fit_material(&table, &out, &["--liquid"]);
    assert_eq!(output.status.code(), Some(0), "{}", message(&output));
    let prony = material(&out);
    let branch = &prony["branches"][0];
    for (name, expected) in [("modulus", 3e3), ("relaxation_time", 2.0)] {
        let number = branch[name].as_float().expect("a number");
        assert!(
            (number / expected - 1.0).abs() < 1e-6,
            "{name} is {number}, expected {expected}"
        );
    }
    let table = measured("pyvisco_time_master.csv");
    let output = fit_material(&table, &out, &["--branches", "10"]);
    assert_eq!(output.status.code(), Some(0), "{}", message(&output));
}

const GOOD: &str = "f,E',E''\nHz,MPa,MPa\n1,10,1\n2,11,1\n";

/// Tables with one wrong cell, and what is said about it.
const WRONG_CELLS: &[(&str, &str)] = &[
    (
        "f,E',E''\nHz,MPa,MPa\n2,10,1\n1,11,1\n",
        "line 4, column 1 (f): expected more than in the line before, 2, but found '1'",
    ),
    (
        "f,E',E''\nHz,MPa,MPa\n1,10,1\n1,11,1\n",
        "line 4, column 1 (f): expected more than in the line before, 1, but found '1'",
    ),
    (
        "f,E',E''\nHz,MPa,MPa\n1,10,1\n2,-11,1\n",
        "line 4, column 2 (E'): expected a number greater than 0, but found '-11'",
    ),
    (
        "f,E',E''\nHz,MPa,MPa\n0,10,1\n2,11,1\n",
        "line 3, column 1 (f): expected a number greater than 0, but found '0'",
    ),
    (
        "f,E',E''\nHz,MPa,MPa\n1,10,nan\n2,11,1\n",
        "line 3, column 3 (E''): expected a finite number, but found 'nan'",
    ),
    (
        "f,E',E''\nHz,MPa,MPa\n1,10,1\n2,11\n",
        "line 4, column 3 (E''): expected a finite number, but found ''",
    ),
    (
        "f,E',E''\nHz,MPa,MPa\n1,ten,1\n2,11,1\n",
        "line 3, column 2 (E'): expected a finite number, but found 'ten'",
    ),
];

/// Tables with a wrong head or too few lines.
const WRONG_HEADS: &[(&str, &str)] = &[
    (
        "f,E',E''\n1,10,1\n2,11,1\n",
        "line 2, column 1 (f): expected the unit of f: Hz, mHz, kHz or rad/s, but found '1'",
    ),
    (
        "f,E',E''\nHz,MPa,psi\n1,10,1\n2,11,1\n",
        "line 2, column 3 (E''): expected the unit of E'': Pa, kPa, MPa or GPa, but found 'psi'",
    ),
    (
        "f,E''\nHz,MPa\n1,1\n2,1\n",
        "line 1: there must be a column E' or G'",
    ),
    (
        "f,E'\nHz,MPa\n1,1\n2,1\n",
        "line 1: there must be a column E'' or G''",
    ),
    (
        "E',E''\nMPa,MPa\n1,1\n2,1\n",
        "line 1: there must be a column f or ω",
    ),
    (
        "f,E',G''\nHz,MPa,MPa\n1,1,1\n2,1,1\n",
        "line 1, column 3 (G''): expected a loss modulus to go with E', but found 'G'''",
    ),
    (
        "f,E',E'',E'\nHz,MPa,MPa,MPa\n1,1,1,1\n2,1,1,1\n",
        "line 1, column 4 (E'): expected a quantity once",
    ),
    (
        "f,E',E''\nHz,MPa,MPa\n1,10,1\n",
        "at least 2 measurements are needed after the lines of names and units, but there are 1",
    ),
    ("", "a line of names and a line of units are needed"),
];

#[test]
fn wrong_tables_name_line_column_and_what_is_expected() {
    let out = folder("wrong");
    for (text, needed) in [WRONG_CELLS, WRONG_HEADS].concat() {
        let table = out.join("wrong.csv");
        fs::write(&table, text).expect("a file");
        let output = fit_material(&table, &out, &[]);
        let said = message(&output);
        assert_eq!(output.status.code(), Some(2), "{text:?}: {said}");
        assert!(
            said.contains("wrong.csv") && said.contains(needed),
            "{text:?} says: {said}"
        );
    }
    assert!(
        !out.join("material.toml").exists(),
        "a material from a wrong table"
    );
}

#[test]
fn wrong_options_end_with_status_2() {
    let out = folder("options");
    let table = out.join("good.csv");
    fs::write(&table, GOOD).expect("a file");
    for (options, needed) in [
        (
            &["--poisson-ratio", "0.6"][..],
            "--poisson-ratio must be greater than -1 and at most 0.5, but is 0.6",
        ),
        (
            &["--branches", "0"],
            "--branches must be from 1 to 200, but is 0",
        ),
        (&["--parsimony", "-1"], "--parsimony"),
        (&["--smoothing", "1"], "--branches"),
        (
            &["--branches", "2", "--parsimony", "0.1"],
            "cannot be used with",
        ),
    ] {
        let output = fit_material(&table, &out, options);
        let said = message(&output);
        assert_eq!(output.status.code(), Some(2), "{options:?}: {said}");
        assert!(said.contains(needed), "{options:?} says: {said}");
    }
    let missing = fit_material(Path::new("no-such-file.csv"), &out, &[]);
    assert_eq!(missing.status.code(), Some(2), "{}", message(&missing));
    assert!(
        message(&missing).contains("no-such-file.csv"),
        "{}",
        message(&missing)
    );
}
