//! From a table of measured moduli to the material of a scene.

use std::fs;
use std::path::Path;
use std::process::Output;

use crate::support::{argument, folder, measured, text, viscofriction};

fn fit_material(table: &Path, out: &Path, options: &[&str]) -> Output {
    let arguments = ["fit-material", argument(table), "--out", argument(out)];
    viscofriction(&[&arguments[..], options].concat())
}

fn fitted(table: &Path, out: &Path, options: &[&str]) {
    let output = fit_material(table, out, options);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
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
    fitted(
        &table,
        &out,
        &["--branches", "20", "--poisson-ratio", "0.4"],
    );
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
    fitted(&table, &out, &["--reference-temperature", "-5"]);
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
    fitted(&table, &out, &["--liquid"]);
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
    fitted(&table, &out, &["--branches", "10", "--overwrite"]);
}

const GOOD: &str = "f,E',E''\nHz,MPa,MPa\n1,10,1\n2,11,1\n";

#[test]
fn wrong_options_end_with_status_2() {
    let out = folder("options");
    let table = out.join("good.csv");
    fs::write(&table, GOOD).expect("a file");
    let [good, missing] = [&table, Path::new("no-such-file.csv")];
    for (table, options, needed) in [
        (
            good,
            "--poisson-ratio 0.6",
            "--poisson-ratio must be greater than -1 and at most 0.5, but is 0.6",
        ),
        (
            good,
            "--branches 0",
            "--branches must be from 1 to 200, but is 0",
        ),
        (good, "--parsimony -1", "--parsimony"),
        (good, "--smoothing 1", "--branches"),
        (good, "--branches 2 --parsimony 0.1", "cannot be used with"),
        (missing, "--branches 2", "no-such-file.csv"),
    ] {
        let options: Vec<&str> = options.split(' ').collect();
        let output = fit_material(table, &out, &options);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{options:?}: {said}");
        assert!(said.contains(needed), "{options:?} says: {said}");
    }
}

/// As they are, no positive branches come closer than a fifth to them.
#[test]
fn swapped_columns_are_refused_and_nothing_is_written() {
    let folder = folder("swapped");
    let [table, out] = ["swapped.csv", "out"].map(|name| folder.join(name));
    let moduli = fs::read_to_string(measured("pyvisco_frequency_master.csv")).expect("a table");
    let (names, rest) = moduli.split_once('\n').expect("a line of names");
    let is_storage = |name: &str| name.contains("stor") || name.trim() == "E'";
    let swapped: Vec<&str> = names
        .split(',')
        .map(|name| match name.trim() {
            name if is_storage(name) => "E''",
            "E''" | "E_loss" => "E'",
            _ => name,
        })
        .collect();
    fs::write(&table, format!("{}\n{rest}", swapped.join(","))).expect("a table");
    for options in [&[][..], &["--branches", "20"]] {
        let output = fit_material(&table, &out, options);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(
            message.contains("storage and loss modulus seem to be swapped"),
            "{message}"
        );
        assert!(!out.exists(), "a material from swapped columns");
    }
}
