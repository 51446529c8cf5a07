//! From a table of measured moduli to the material of a scene.

use std::fs;

use toml::{Table, Value};

use crate::support::{Folder, assert_close, measured};

/// The table `[material.prony]` that a fit has written.
fn prony(folder: &Folder) -> Table {
    let file = folder.text("out/material.toml").parse::<Table>();
    let file = file.expect("valid TOML");
    let prony = file["material"]["prony"].as_table();
    prony.expect("a table [material.prony]").clone()
}

fn float(value: &Value) -> f64 {
    let number = value.as_float();
    number.unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn a_master_curve_becomes_the_material_of_a_scene() {
    let folder = Folder::new("master");
    let table = "DATA/pyvisco_frequency_master.csv --poisson-ratio 0.4";
    folder.done(format!("fit-material {table} --out out --branches 20"));
    let prony = prony(&folder);
    let branches = prony["branches"].as_array().expect("a list");
    let n_branches = branches.len();
    assert!((1..=20).contains(&n_branches), "{n_branches} branches");
    let moduli = branches.iter().map(|branch| float(&branch["modulus"]));
    let glass = moduli.sum::<f64>() + float(&prony["equilibrium_modulus"]);
    // The last E' is 9580.5 MPa; the series ends within the 12 % that it is off anywhere.
    assert_close("glass modulus", glass, 9580.5e6 / 2.8, 0.12);
    assert_eq!(prony["poisson_ratio"], Value::Float(0.4), "Poisson ratio");
    for file in ["fit.csv", "fit.svg", "fit.png"] {
        let length = fs::metadata(folder.path("out").join(file)).map_or(0, |data| data.len());
        assert!(length > 1000, "{file} has {length} bytes");
    }
}

/// Logarithms of some shifts by pyvisco 2.1.3, `master.get_aT(df_raw, -5)`, which fits power laws to the storage moduli and
/// shifts those. The two coldest isotherms are nearly flat and left out.
const PEERS: [f64; 6] = [7.840, 6.095, 0.0, -6.689, -14.511, -18.345];

#[test]
fn isotherms_are_shifted_onto_one_curve() {
    let folder = Folder::new("isotherms");
    let table = "DATA/pyvisco_frequency_raw.csv --reference-temperature -5";
    folder.done(format!("fit-material {table} --out out"));
    let [temperatures, logs] = [0, 1].map(|column| folder.column("out/shifts.csv", column));
    assert_eq!(logs.len(), 21, "isotherms");
    for (place, peer) in [2, 3, 6, 10, 15, 20].into_iter().zip(PEERS) {
        let (temperature, log) = (temperatures[place], logs[place]);
        let is_near = (log - peer).abs() < 0.3;
        assert!(is_near, "log a_T at {temperature}: {log} and not {peer}");
    }
    let slower = logs.windows(2).find(|pair| pair[1] >= pair[0]);
    assert_eq!(slower, None, "warmer and slower");
}

#[test]
fn a_liquid_and_a_relaxation_are_fitted_too() {
    let folder = Folder::new("liquid");
    // G = 3 kPa, τ = 2 s: G' = G Ω²/(1 + Ω²), G'' = G Ω/(1 + Ω²), Ω = 2 ω.
    let rows = [0.01, 0.1, 0.5, 1.0, 10.0_f64].map(|omega| {
        let x = 2.0 * omega;
        let loss = 3.0 * x / (1.0 + x * x);
        format!("{omega},{},{loss}\n", x * loss)
    });
    let table = format!("ω, G′, G″\nrad/s, kPa, kPa\n{}", rows.concat());
    folder.write("maxwell.csv", table);
    folder.done("fit-material maxwell.csv --liquid --out out");
    let branch = &prony(&folder)["branches"][0];
    for (name, expected) in [("modulus", 3e3), ("relaxation_time", 2.0)] {
        assert_close(name, float(&branch[name]), expected, 1e-6);
    }
    let table = "DATA/pyvisco_time_master.csv --branches 10";
    folder.done(format!("fit-material {table} --out out --overwrite"));
}

/// As they are, no positive branches come closer than a fifth to them.
#[test]
fn swapped_columns_are_refused_and_nothing_is_written() {
    let folder = Folder::new("swapped");
    let moduli = fs::read_to_string(measured("pyvisco_frequency_master.csv")).expect("a table");
    let (names, rest) = moduli.split_once('\n').expect("a line of names");
    let [storage, loss] = ["E_stor", "E_loss"];
    assert!(names.contains(storage) && names.contains(loss), "{names}");
    let swapped = names.replace(storage, "E''").replace(loss, "E'");
    folder.write("swapped.csv", format!("{swapped}\n{rest}"));
    for options in ["", "--branches 20"] {
        let line = format!("fit-material swapped.csv --out out {options}");
        folder.ends(&line, 1, "storage and loss modulus seem to be swapped");
    }
    assert_eq!(folder.names(""), ["swapped.csv"], "a material from them");
}

#[test]
fn a_scene_names_the_file_of_a_fit() {
    let folder = Folder::new("named");
    let table = "DATA/pyvisco_frequency_master.csv --poisson-ratio 0.4";
    folder.done(format!("fit-material {table} --out out --branches 5"));
    let parts = |material: &str| {
        format!(
            "[indenter.sphere]\nradius = 5e-3\n{material}\n[load]\nnormal_force = 2\nvelocity = 0.1\n[solve]\nmodel = \"line\"\n"
        )
    };
    let answer = |material: &str| {
        folder.write("scene.toml", parts(material));
        let mut answer = folder.json("scene.toml");
        answer["seconds"] = 0.into();
        answer
    };
    let named = "[material.file]\npath = \"out/material.toml\"";
    let inside = folder.text("out/material.toml");
    assert_eq!(answer(named), answer(&inside), "by name and in the scene");
    let other = inside.replace("poisson_ratio = 0.4", "poisson_ratio = 0.3");
    let named = format!("{named}\npoisson_ratio = 0.3");
    assert_eq!(answer(&named), answer(&other), "with another Poisson ratio");
}
