//! What the program says of measured surfaces.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use crate::support::{Folder, assert_close};

/// Two waves of 1e-6 and 5e-7 m on a tilted plane, 40 × 30 points 1e-5 m apart, without the tenth.
fn measured() -> String {
    let mut text = String::new();
    for index in (0..1200).filter(|index| *index != 10) {
        let [x, y] = [f64::from(index / 30), f64::from(index % 30)];
        let along = (TAU * x / 10.0).cos() + 0.5 * (TAU * y / 6.0).sin();
        let height = 1e-6 * (along + 0.2 * x - 0.1 * y);
        writeln!(text, "{} {} {height}", x * 1e-5, y * 1e-5).expect("a text");
    }
    text
}

#[test]
fn a_tidied_copy_has_the_same_numbers() {
    let folder = Folder::new("surface");
    folder.write("plate.xyz", measured());
    let said = folder.done("surface plate.xyz --fill-missing --out first");
    assert!(
        said.stdout
            .contains("missing, filled from their neighbours: 1 of 1200")
    );
    let files = "profiles.csv roughness.csv spectrum.csv surface.png surface.svg tidied.xyz";
    assert_eq!(folder.names("first").join(" "), files);
    let again = folder.done("surface first/tidied.xyz --keep-tilt --out again");
    assert!(!again.stdout.contains("mean slope") && !again.stdout.contains("missing"));
    let [first, again] =
        ["first", "again"].map(|of| folder.column(&format!("{of}/roughness.csv"), 2));
    for (one, other) in first.iter().zip(&again) {
        assert_close("a number", *other, *one, 1e-9);
    }
    // The tilt is 0.02 along x and −0.01 along y, less what the waves at the edges add.
    assert_close("Sq", first[0], 1e-6 * (0.5_f64 + 0.125).sqrt(), 3e-2);
    folder.ends(
        "surface plate.xyz --fill-missing --out first",
        2,
        "--overwrite",
    );
}

/// A map that repeats itself is the sum of its waves.
#[test]
fn a_periodic_map_is_described_by_its_waves() {
    let folder = Folder::new("surface-periodic");
    let height = |index: i32| (TAU * f64::from(index) / 16.0).cos().to_string();
    let line = (0..16).map(height).collect::<Vec<_>>().join(",");
    folder.write("wave.csv", vec![line; 8].join("\n"));
    folder.done("surface wave.csv --spacing 0.25 0.5 --periodic --keep-tilt --out told");
    let numbers = folder.column("told/roughness.csv", 2);
    let q = TAU / 4.0;
    let rms = 0.5_f64.sqrt();
    for (place, expected) in [(0, rms), (7, rms * q), (10, 0.5 * rms * q * q), (11, 1.5)] {
        assert_close("a number", numbers[place], expected, 1e-12);
    }
    let density = folder.column("told/spectrum.csv", 1);
    // One of the four wave vectors of the ring, of which two opposite ones are one.
    assert_close("density", density[0], 0.25 / (q * q) / 4.0, 1e-12);
}

/// The spectrum of a map is one that a scene reads, and distances have a unit.
#[test]
fn the_spectrum_of_a_periodic_map_is_that_of_a_scene() {
    let folder = Folder::new("surface-spectrum");
    let height = |x: i32, y: i32| {
        (TAU * f64::from(3 * x + y) / 16.0).cos() + (TAU * f64::from(6 * x) / 16.0).sin()
    };
    let line = |y: i32| {
        (0..16)
            .map(|x| height(x, y).to_string())
            .collect::<Vec<_>>()
            .join(",")
    };
    folder.write(
        "waves.csv",
        (0..16).map(line).collect::<Vec<_>>().join("\n"),
    );
    let said = folder.done(
        "surface waves.csv --spacing 10um 0.01mm --unit nm --periodic --keep-tilt --out told",
    );
    assert!(
        said.stdout.contains("0.00001 × 0.00001 m apart"),
        "{said:?}"
    );
    let densities = folder.column("told/spectrum.csv", 1);
    assert!(
        densities.contains(&0.0) && densities[0] == 0.0,
        "{densities:?}"
    );
    let scene =
        "indenter.spectrum = { file = \"told/spectrum.csv\", period = [16e-5, 16e-5], seed = 1 }
        material.elastic.shear_modulus = 1e6
        load = { mean_pressure = 1e4, velocity = 0.0 }
        solve.duration = 1.0\n";
    folder.write("scene.toml", scene);
    folder.json("scene.toml");
    folder.ends(
        "surface waves.csv --spacing 1 ohm",
        2,
        "a length is needed, in m or with a unit",
    );
    folder.ends("surface waves.csv", 2, "--spacing: the distances");
}

/// In full contact all frictions are sums over waves, and with them Persson's theory of the waves that are left out.
#[test]
fn a_road_is_solved_octave_by_octave() {
    let folder = Folder::new("road");
    let scene = "indenter.self-affine = { period = [2.0, 1.0], hurst_exponent = 0.8, rms_slope = 0.1, \
        longest_wavelength = 1.0, shortest_wavelength = 0.25, seed = 3 }
        material.standard-solid = { equilibrium_modulus = 0.25, maxwell_modulus = 2.25, viscosity = 2.25 }
        load = { velocity = 0.03, mean_pressure = 100.0 }\n";
    folder.write("scene.toml", scene);
    let said = folder.done("road scene.toml --out road.csv");
    assert_eq!(said.stdout.lines().count(), 5, "{said:?}");
    let column = |file: &str, column: usize| folder.column(file, column);
    let [lengths, frictions] = [0, 2].map(|of| column("road.csv", of));
    for pair in lengths.windows(2) {
        assert_close("an octave", pair[1], 2.0 * pair[0], 1e-12);
    }
    let whole = &folder.json("scene.toml")["friction_coefficient"];
    assert_eq!(whole.as_f64(), Some(frictions[0]), "{said:?}");
    let [theory, missing] = [8, 10].map(|of| column("road.csv", of));
    for (row, friction) in frictions.iter().enumerate() {
        assert_close("theory", theory[row], *friction, 1e-9);
        let expected = frictions[0] - friction;
        assert!((missing[row] - expected).abs() < 1e-9, "{missing:?}");
    }
    for file in ["road.svg", "road.png"] {
        assert!(folder.path(file).exists(), "{file}");
    }
    folder.ends("road scene.toml --out road.csv", 2, "--overwrite");
    folder.ends("road scene.toml --cut-offs 0", 2, "1..=64");
    let two = folder.done("road scene.toml --cut-offs 2 --realisations 3");
    assert_eq!(two.stdout.lines().count(), 4, "{two:?}");
    folder.ends(
        "road scene.toml --realisations 0",
        2,
        "must be from 1 to 1000, but is 0",
    );
    folder.write("cone.toml", "indenter.cone.slope = 0.1\nmaterial.viscous.viscosity = 1e4\nload = { normal_force = 1.0, velocity = 0.01 }\n");
    folder.ends(
        "road cone.toml",
        2,
        "only a surface that repeats itself is a sum of waves",
    );
    folder.ends("road cone.toml --realisations 2", 2, "are drawn by a seed");
}
