//! Rubbers whose moduli change with the absolute temperature, from a table to a scene.

use std::f64::consts::TAU;

use crate::support::{Folder, assert_close, number};

/// log₁₀ a_T by WLF about 20 °C.
fn log_shift(temperature: f64) -> f64 {
    let above = temperature - 20.0;
    -8.86 * above / (101.6 + above)
}

/// Modulus and time of the branches at a temperature; the first is the spring.
fn rubber(temperature: f64, factor: f64) -> Vec<[f64; 2]> {
    let branch = |k: i32| {
        let time = 10_f64.powf(0.5 * f64::from(k));
        let modulus = factor * 3e7 * (time / 1e-8).powf(-0.5);
        [modulus, time * 10_f64.powf(log_shift(temperature))]
    };
    std::iter::once([factor * 1e6, f64::INFINITY])
        .chain((-16..3).map(branch))
        .collect()
}

fn entropic(temperature: f64) -> f64 {
    (temperature + 273.15) / 293.15
}

/// Isotherms from −10 °C to 50 °C, 0.1 to 100 Hz.
fn isotherms(factor: impl Fn(f64) -> f64) -> String {
    let mut table = "f,T,G′,G″\nHz,C,Pa,Pa\n".to_owned();
    for temperature in [-10.0, 0.0, 10.0, 20.0, 30.0, 40.0, 50.0] {
        for k in 0..=18 {
            let hertz = 10_f64.powf(f64::from(k) / 6.0 - 1.0);
            let [mut storage, mut loss] = [0.0; 2];
            for [modulus, time] in rubber(temperature, factor(temperature)) {
                let x = TAU * hertz * time;
                let in_phase = if x.is_finite() {
                    x * x / (1.0 + x * x)
                } else {
                    1.0
                };
                storage += modulus * in_phase;
                loss += modulus * in_phase / x;
            }
            table += &format!("{hertz},{temperature},{storage},{loss}\n");
        }
    }
    table
}

/// The friction of a ball on the material of these lines.
fn friction(folder: &Folder, material: &str) -> f64 {
    let rest = "[indenter.sphere]\nradius = 5e-3\n[load]\nnormal_force = 2.0\nvelocity = 0.1";
    let solve = "[solve]\nrelative_error = 2e-3";
    folder.write("scene.toml", format!("{rest}\n{material}\n{solve}\n"));
    number(&folder.json("scene.toml"), "friction_coefficient")
}

#[test]
fn a_scene_has_the_moduli_of_its_temperature() {
    let folder = Folder::new("entropic");
    folder.write("isotherms.csv", isotherms(entropic));
    let law = "--wlf 8.86 101.6 --reference-temperature 20";
    let elsewhere = format!("{law} --temperature 5");
    for (fit, options) in [
        ("found", "--reference-temperature 20"),
        ("given", law),
        ("elsewhere", &elsewhere),
    ] {
        let said = folder.done(format!("fit-material isotherms.csv {options} --out {fit}"));
        assert!(
            said.stdout
                .contains("b_T = T/T_r, which the isotherms show"),
            "{said:?}"
        );
        let shift = folder.text(&format!("{fit}/material.toml"));
        assert!(shift.contains("vertical = \"entropic\""), "{shift}");
        for temperature in [-4.0, 12.0] {
            let branches = rubber(temperature, entropic(temperature));
            let spring = branches[0][0];
            let branches = branches[1..].iter().map(|[modulus, time]| {
                format!("{{ modulus = {modulus:e}, relaxation_time = {time:e} }}, ")
            });
            let branches: String = branches.collect();
            let exact = format!(
                "[material.prony]\nequilibrium_modulus = {spring:e}\nbranches = [{branches}]"
            );
            let file = format!(
                "[material.file]\npath = \"{fit}/material.toml\"\ntemperature = {temperature:?}"
            );
            let [exact, near] = [&exact, &file].map(|material| friction(&folder, material));
            assert_close(format!("{fit} at {temperature} °C"), near, exact, 0.01);
        }
    }
}

#[test]
fn factors_of_isotherms_are_written_and_read() {
    let folder = Folder::new("factors");
    let factor = |temperature: f64| if temperature > 20.0 { 1.2 } else { 1.0 };
    folder.write("isotherms.csv", isotherms(factor));
    let options = "--reference-temperature 20 --vertical free";
    let said = folder.done(format!("fit-material isotherms.csv {options} --out out"));
    assert!(
        said.stdout
            .contains("by a factor b_T of each isotherm, as --vertical says"),
        "{said:?}"
    );
    let factors = folder.column("out/shifts.csv", 3);
    for (found, temperature) in factors
        .iter()
        .zip([-10.0, 0.0, 10.0, 20.0, 30.0, 40.0, 50.0])
    {
        assert_close(
            format!("b_T at {temperature} °C"),
            *found,
            factor(temperature),
            0.02,
        );
    }
    let file = |temperature: f64| {
        format!("[material.file]\npath = \"out/material.toml\"\ntemperature = {temperature:?}")
    };
    let material = file(40.0);
    assert!(friction(&folder, &material) > 0.0);
    let text = folder.text("out/material.toml");
    folder.write("out/material.toml", text.replace("[0.0, ", "[11.0, "));
    folder.write(
        "scene.toml",
        format!("[indenter.sphere]\nradius = 5e-3\n{material}\n[load]\nnormal_force = 2.0\nvelocity = 0.1\n"),
    );
    folder.ends(
        "run scene.toml",
        2,
        "must be finite and higher than the one before",
    );
}

#[test]
fn isotherms_that_do_not_lie_on_one_curve_are_a_warning() {
    let folder = Folder::new("pattern");
    let table = isotherms(entropic);
    // Those above 10 °C are nearly elastic: without b_T no series fits them at all.
    let warm = |line: &str| {
        [",20,", ",30,", ",40,", ",50,"]
            .iter()
            .any(|one| line.contains(one))
    };
    let cold: Vec<&str> = table.lines().filter(|line| !warm(line)).collect();
    folder.write("isotherms.csv", cold.join("\n"));
    let command = "fit-material isotherms.csv --reference-temperature 0 --vertical none --out out";
    let said = folder.done(command);
    assert!(said.stderr.contains("are not noise"), "{said:?}");
}
