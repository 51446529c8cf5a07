//! Strain dependence: the moduli are those at the strain that the contact with these moduli has.

use std::f64::consts::PI;

use serde_json::Value;

use crate::support::{Folder, assert_close, number};

const BALL: &str = "[indenter.sphere]\nradius = 5e-3\n";
const CYLINDER: &str = "[indenter.cylinder]\nradius = 5e-3\n";
/// A standard solid that dissipates most at the speed of the scenes.
const RUBBER: &str = "[material.prony]\nequilibrium_modulus = 1e6\nbranches = [{ modulus = 4e6, relaxation_time = 0.02 }]\n";
const KRAUS: &str =
    "[strain.kraus]\ncritical_strain = 0.02\nstorage_ratio = 0.3\nloss_peak_ratio = 1.5\n";

fn slides(force: f64, error: f64) -> String {
    format!("[load]\nnormal_force = {force}\nvelocity = 0.05\n[solve]\nrelative_error = {error}\n")
}

/// Factors of storage and loss modulus of [`KRAUS`] at a strain.
fn factors(strain: f64) -> [f64; 2] {
    let x = (strain / 0.02).powf(0.6);
    [0.3 + 0.7 / (1.0 + x * x), 1.0 + x / (1.0 + x * x)]
}

/// The answer states the factors at its strain, and beside it that of the same scene without strain dependence, to the last bit.
#[test]
fn the_factors_are_those_at_the_strain_of_the_answer() {
    let folder = Folder::new("strain-factors");
    for (body, force) in [(BALL, 2.0), (CYLINDER, 300.0)] {
        let scene = format!("{body}{RUBBER}{}", slides(force, 0.02));
        let answer = folder.answer(format!("{scene}{KRAUS}"));
        let strain = number(&answer, "strain");
        let [storage, loss] = factors(strain);
        assert_close(
            "storage factor",
            number(&answer, "storage_factor"),
            storage,
            1e-12,
        );
        assert_close("loss factor", number(&answer, "loss_factor"), loss, 1e-12);
        assert!(storage < 0.9 && strain < 0.3, "{answer}");
        let linear = folder.answer(scene);
        for key in [
            "friction_coefficient",
            "friction_coefficient_error",
            "contact_area",
        ] {
            assert_eq!(answer["linear"][key], linear[key], "{key}");
        }
        assert!(number(&answer, "contact_area") > number(&linear, "contact_area"));
        let words = answer["not_modelled"].to_string();
        assert!(!words.contains("strain"), "{words}");
    }
}

/// Factors of 1 give the linear answer to the last bit.
#[test]
fn factors_of_one_change_nothing() {
    let folder = Folder::new("strain-none");
    for (body, force) in [(BALL, 2.0), (CYLINDER, 300.0)] {
        let scene = format!("{body}{RUBBER}{}", slides(force, 0.02));
        let none = "[strain.kraus]\ncritical_strain = 0.02\nstorage_ratio = 1.0\n";
        let answer = folder.answer(format!("{scene}{none}"));
        let linear = folder.answer(scene);
        for key in [
            "friction_coefficient",
            "friction_coefficient_error",
            "contact_area",
        ] {
            assert_eq!(answer[key], linear[key], "{key}");
        }
    }
}

/// One wave in full contact: the strain is half the root mean square slope whatever the moduli, and the friction is
/// g G'' q² h²/p̄ with the amplitude h.
#[test]
fn one_wave_in_full_contact_has_its_closed_form() {
    let folder = Folder::new("strain-wave");
    let (n, amplitude, period, pressure) = (32_i32, 2e-6, 1e-3, 1e6);
    let height = |place: i32| -amplitude * (2.0 * PI * f64::from(place) / f64::from(n)).cos();
    let line: Vec<String> = (0..n).map(|place| format!("{:e}", height(place))).collect();
    let rows = vec![line.join(","); 8];
    folder.write("wave.csv", rows.join("\n"));
    let spacing = period / f64::from(n);
    let answer = folder.answer(format!(
        "[indenter.height-map]\nfile = \"wave.csv\"\nspacing = [{spacing}, {spacing}]\nedges = \"periodic\"\n{RUBBER}{KRAUS}[load]\nmean_pressure = \
         {pressure}\nvelocity = 0.05\n"
    ));
    let q = 2.0 * PI / period;
    let strain = amplitude * q / 8.0_f64.sqrt();
    assert_close("strain", number(&answer, "strain"), strain, 1e-8);
    let omega = q * 0.05 * 0.02;
    let loss = 4e6 * omega / (1.0 + omega * omega) * factors(strain)[1];
    let friction = loss * (q * amplitude).powi(2) / pressure;
    assert_close(
        "friction",
        number(&answer, "friction_coefficient"),
        friction,
        1e-8,
    );
    let error = number(&answer, "friction_coefficient_error");
    assert!(error < 0.01 * friction, "{answer}");
}

/// Of random surfaces the linear answer is the mean over all of them, too.
#[test]
fn the_linear_answer_of_an_ensemble_is_its_mean() {
    let folder = Folder::new("strain-ensemble");
    let scene = format!(
        "[indenter.self-affine]\nperiod = [1e-3, 1e-3]\nhurst_exponent = 0.8\nrms_slope = 0.2\nlongest_wavelength = 5e-4\nshortest_wavelength = \
         2.5e-4\nseed = 1\nrealisations = 2\n{RUBBER}[load]\nmean_pressure = 1e5\nvelocity = 0.05\n[solve]\nelements = 128\n"
    );
    let answer = folder.answer(format!("{scene}{KRAUS}"));
    let linear = folder.answer(scene);
    for key in ["friction_coefficient", "area_fraction"] {
        assert_close(
            key,
            number(&answer["linear"], key),
            number(&linear, key),
            1e-12,
        );
    }
}

/// With heat, every temperature has its own strain.
#[test]
fn heat_and_strain_are_found_together() {
    let folder = Folder::new("strain-heat");
    let shift = "shift = { temperature = 20.0, temperature_range = [-20.0, 120.0], law = { wlf = [8.86, 101.6] } }\n";
    let heat = "[heat]\nconductivity = 0.25\ndiffusivity = 1.2e-7\n[interface.constant]\nshear_strength = 3e5\n";
    let scene = format!("{BALL}{RUBBER}{shift}{heat}{KRAUS}{}", slides(2.0, 0.1));
    let answer = folder.answer(scene);
    let [storage, _] = factors(number(&answer, "strain"));
    assert_close(
        "storage factor",
        number(&answer, "storage_factor"),
        storage,
        1e-12,
    );
    assert!(number(&answer, "effective_temperature") > 20.0, "{answer}");
    assert!(
        answer["linear"]["effective_temperature"].is_number(),
        "{answer}"
    );
}

/// A sweep of an instrument is read beside the scene, and a strain beyond its last one is a warning.
#[test]
fn a_strain_sweep_has_its_range() {
    let folder = Folder::new("strain-table");
    let table = "[strain.table]\nfile = \"payne.csv\"\n";
    let scene = format!("{BALL}{RUBBER}{table}{}", slides(2.0, 0.05));
    folder.write(
        "payne.csv",
        "Strain [%];E' [MPa];E'' [MPa]\n0,1;8;2\n1;6;2,4\n",
    );
    let answer = folder.answer(&scene);
    let warnings = answer["warnings"].to_string();
    assert!(
        warnings.contains("the largest of strain.table.file"),
        "{warnings}"
    );
    assert_close(
        "storage factor",
        number(&answer, "storage_factor"),
        0.75,
        1e-12,
    );
    folder.write(
        "payne.csv",
        "Strain [%];E' [MPa];E'' [MPa]\n0,1;8;2\n1;6;2,4\n99;1;1\n",
    );
    let answer = folder.answer(&scene);
    assert_eq!(answer["warnings"], Value::Array(Vec::new()));
}
