//! Measured moduli in the layouts in which instruments export them are read as the same numbers.
//!
//! Each table of moduli has the three points of [`POINTS`], in the words, units, order, separators and encodings of one software as it
//! is known from its exports and manuals; the numbers are made up.

use std::f64::consts::TAU;
use std::path::Path;

use encoding_rs::{GB18030, SHIFT_JIS, UTF_8, WINDOWS_1252};
use measurements::indentation::{CurveOptions, indentation_curve};
use measurements::moduli::{
    Deformation, MeasuredModuli, Measurements, TableOptions, measured_moduli, shear_per_tension,
};
use measurements::shear::shear_strength_rows;
use rheology::ShearStrengthPoint;

use crate::support::assert_close;

/// Frequency, \[Hz], storage and loss modulus in shear, \[MPa].
const POINTS: [[f64; 3]; 3] = [[0.1, 1.5, 0.3], [1.0, 2.25, 0.45], [10.0, 4.0, 1.2]];

/// What is read when storage modulus alone is one of this kind.
#[track_caller]
fn read(contents: &[u8], deformation: Option<Deformation>) -> MeasuredModuli {
    let options = TableOptions {
        shear_per_tension: shear_per_tension(0.5).expect("a Poisson ratio"),
        deformation,
    };
    let read = measured_moduli(Path::new("moduli.txt"), contents, &options);
    read.unwrap_or_else(|error| panic!("{error}"))
}

/// Temperature and points, \[Hz] and \[MPa], of every isotherm.
#[track_caller]
fn isotherms(read: MeasuredModuli) -> Vec<(f64, Vec<[f64; 3]>)> {
    let Measurements::Oscillation(isotherms) = read.measurements else {
        panic!("{read:?} is no oscillation")
    };
    let point = |point: &rheology::fit::ModulusPoint| {
        let moduli = [point.storage, point.loss].map(|modulus| 1e-6 * modulus);
        [point.angular_frequency / TAU, moduli[0], moduli[1]]
    };
    let isotherms = isotherms.iter();
    isotherms
        .map(|one| (one.temperature, one.points.iter().map(point).collect()))
        .collect()
}

#[test]
fn names_in_six_languages_are_those_of_the_same_quantities() {
    for names in include_str!("../data/names_of_moduli.txt").lines() {
        let above = "Sample;SBR 1502\nInstrument;Eplexor\nDatum;12.03.2024\n\n";
        let text = format!("{above}{names}\n0,1;20;1,5;0,3\n1;20;2,25;0,45\n10;20;4;1,2\n");
        let is_european = names.chars().all(|letter| letter < '\u{100}');
        for encoding in [UTF_8, WINDOWS_1252, GB18030, SHIFT_JIS] {
            let (contents, _, is_foreign) = encoding.encode(&text);
            if is_foreign || (is_european && ![UTF_8, WINDOWS_1252].contains(&encoding)) {
                continue;
            }
            let what = format!("{names}, {}", encoding.name());
            let isotherms = isotherms(read(&contents, Some(Deformation::Shear)));
            let points = isotherms[0].1.as_flattened();
            assert_eq!(points.len(), 9, "{what}: {isotherms:?}");
            for (read, written) in points.iter().zip(POINTS.as_flattened()) {
                assert_close(&what, *read, *written, 1e-12);
            }
        }
    }
}

/// Force and depth of six points, \[nN] and \[nm], a quarter of a second apart.
const CURVE: [[f64; 2]; 6] = [
    [0.0, 0.0],
    [1.0, 100.0],
    [2.0, 200.0],
    [2.0, 190.0],
    [1.0, 90.0],
    [0.0, -10.0],
];

#[test]
fn curves_of_three_makers_and_in_any_unit_have_the_same_points() {
    type Give = fn(&mut CurveOptions);
    let given: [(&str, Give); 3] = [
        ("spring_constant", |of| of.spring_constant = Some(0.1)),
        ("sensitivity", |of| of.sensitivity = Some(5e-8)),
        ("ramp_rate", |of| of.ramp_rate = Some(0.5 / 0.75)),
    ];
    let exports = include_str!("../data/curves.txt").split("\n== ").skip(1);
    for export in exports {
        let (title, text) = export.split_once('\n').expect("a title");
        let read = |options: &CurveOptions| {
            let curve = indentation_curve(Path::new("curve.txt"), text.as_bytes(), options);
            curve
                .map(|file| file.curve)
                .map_err(|error| error.to_string())
        };
        // All options that change something.
        let mut options = CurveOptions::default();
        for (name, give) in given {
            let mut only = CurveOptions::default();
            give(&mut only);
            let without_effect = format!("{name} has no effect, because there is '");
            if read(&only)
                .err()
                .is_none_or(|error| !error.contains(&without_effect))
            {
                give(&mut options);
            }
        }
        let curve = read(&options).unwrap_or_else(|error| panic!("{title}: {error}"));
        assert_eq!(curve.time.len(), CURVE.len(), "{title}: {curve:?}");
        for (i, [force, depth]) in CURVE.into_iter().enumerate() {
            let close = |of: &str, read: f64, written: f64, least: f64| {
                let is_close = (read - written).abs() <= 1e-9 * least;
                assert!(is_close, "{title}, {of} {i}: {read}, not {written}");
            };
            close("time", curve.time[i], 0.25 * i as f64, 1.0);
            close("depth", curve.depth[i], 1e-9 * depth, 1e-7);
            close("force", curve.force[i], 1e-9 * force, 1e-9);
        }
        let needed = title.split_once("; ").map(|(_, option)| option);
        let reason = read(&CurveOptions::default()).err();
        let is_named = needed.is_none_or(|needed| reason.iter().any(|one| one.contains(needed)));
        let is_right = is_named && reason.is_some() == needed.is_some();
        assert!(is_right, "{title}: {reason:?}");
    }
}

/// A storage modulus is of the given kind without E or G in its name.
#[track_caller]
fn assert_has_the_points(contents: &[u8], deformation: Option<Deformation>, n_isotherms: usize) {
    let isotherms = isotherms(read(contents, deformation));
    assert_eq!(isotherms.len(), n_isotherms, "{isotherms:?}");
    let points = &isotherms[0].1;
    assert_eq!(points.len(), POINTS.len(), "{points:?}");
    for (read, written) in points.iter().flatten().zip(POINTS.iter().flatten()) {
        assert_close("modulus or frequency", *read, *written, 1e-12);
    }
}

#[test]
fn seven_layouts_of_instruments_have_the_same_points() {
    // TA Instruments TRIOS, text with carriage returns: steps between lines of metadata, units below the names.
    assert_has_the_points(
        include_bytes!("../data/exports/trios.txt"),
        Some(Deformation::Shear),
        2,
    );
    // Anton Paar RheoCompass, CSV in UTF-16: an empty first column, units in brackets, empty lines, a count of points.
    assert_has_the_points(
        include_bytes!("../data/exports/rheocompass.csv"),
        Some(Deformation::Shear),
        1,
    );
    // Netzsch Proteus, CSV in Latin-1: metadata in comments, names with units in a comment too.
    assert_has_the_points(include_bytes!("../data/exports/proteus.csv"), None, 1);
    // Mettler Toledo STARe, text: columns that are aligned by blanks, units right-aligned below them.
    assert_has_the_points(include_bytes!("../data/exports/stare.txt"), None, 1);
    // GABO Eplexor, text: from the highest frequency down, a modulus that is not read.
    assert_has_the_points(include_bytes!("../data/exports/eplexor.txt"), None, 1);
    // Malvern rSpace for Kinexus, CSV with a byte-order mark: quotes, and words for the moduli.
    assert_has_the_points(include_bytes!("../data/exports/rspace.csv"), None, 1);
    // PerkinElmer DMA 8000, text: a loss factor instead of a loss modulus.
    assert_has_the_points(
        include_bytes!("../data/exports/pyris.txt"),
        Some(Deformation::Tension),
        1,
    );
}

/// One frequency after the other over the temperature, and a temperature that comes back.
#[test]
fn isotherms_are_found_in_temperature_sweeps_of_any_order() {
    let sweep = "f / Hz,T / K,G' / MPa,G'' / MPa\n10,293.2,2,1\n10,313,3,1\n10,303,4,1\n\n% 1 Hz\n1,303.3,5,1\n1,293,6,1\n\
        1,313.1,7,1\n1,293.1,8,1\n";
    let first = read(sweep.as_bytes(), None);
    assert_eq!(first.celsius, Some(false), "K");
    // Rows that stand in the table twice count once.
    let (_, rows) = sweep.split_once('\n').expect("rows below the names");
    let twice = read(format!("{sweep}{rows}").as_bytes(), None);
    assert_eq!(twice, first, "every row twice");
    let isotherms = isotherms(first);
    let storage = isotherms.iter().map(|(_, points)| {
        let storage = points.iter().map(|point| point[1].round());
        storage.collect::<Vec<_>>()
    });
    let storage: Vec<_> = storage.collect();
    let expected = [vec![6.0, 2.0], vec![7.0, 3.0], vec![5.0, 4.0], vec![8.0]];
    assert_eq!(storage, expected, "{isotherms:?}");
    assert_close("mean temperature", isotherms[0].0, 293.1, 1e-12);
}

/// Magnitude and phase angle, or one modulus and the phase angle, are the same moduli; quotes in quotes are doubled (RFC 4180).
#[test]
fn magnitude_and_phase_are_two_moduli() {
    let degrees = |[_, storage, loss]: [f64; 3]| (loss / storage).atan().to_degrees();
    type Row = Box<dyn Fn([f64; 3]) -> [f64; 2]>;
    let magnitude = |[_, storage, loss]: [f64; 3]| storage.hypot(loss);
    let tables: [(&str, Row); 6] = [
        (
            "|G*| (MPa),Phase angle (deg)",
            Box::new(move |point| [magnitude(point), degrees(point)]),
        ),
        (
            "Complex modulus G* [MPa],δ [rad]",
            Box::new(move |point| [magnitude(point), degrees(point).to_radians()]),
        ),
        (
            "|E*| / MPa,delta / °",
            Box::new(move |point| [3.0 * magnitude(point), degrees(point)]),
        ),
        (
            "G* (MPa),tan(delta)",
            Box::new(move |point| [magnitude(point), point[2] / point[1]]),
        ),
        (
            "G' (MPa),Loss angle (°)",
            Box::new(move |point| [point[1], degrees(point)]),
        ),
        (
            "\"G' (MPa)\",\"G\"\" (MPa)\"",
            Box::new(|point| [point[1], point[2]]),
        ),
    ];
    for (names, row) in tables {
        let rows = POINTS.map(|point| {
            let [first, second] = row(point);
            format!("{},{first},{second}\n", point[0])
        });
        let text = format!("f (Hz),{names}\n{}", rows.concat());
        let isotherms = isotherms(read(text.as_bytes(), None));
        for (found, written) in isotherms[0].1.iter().zip(POINTS) {
            for (found, written) in found.iter().zip(written) {
                assert_close(names, *found, written, 1e-12);
            }
        }
    }
}

/// J(t) = J₀ + J₁ (1 − e^(−t/λ)) in shear, and D = J/3 of an incompressible body.
#[test]
fn creep_is_read_as_relaxation() {
    let [soft, stiff, time] = [1e6, 4e6, 0.3_f64];
    let retardation = time * (soft + stiff) / soft;
    let compliance =
        |t: f64| 1.0 / soft - (1.0 / soft - 1.0 / (soft + stiff)) * (-t / retardation).exp();
    for (name, factor) in [("J(t) (1/MPa)", 1e6), ("D(t) [MPa-1]", 1e6 / 3.0)] {
        let rows = (0..40).map(|k| {
            let t = 10_f64.powf(0.1 * f64::from(k) - 2.0);
            format!("{t},{}\n", factor * compliance(t))
        });
        let text = format!("t (s),{name}\n{}", rows.collect::<String>());
        let Measurements::Relaxation(points) = read(text.as_bytes(), None).measurements else {
            panic!("{name} is no relaxation")
        };
        for point in points {
            let exact = soft + stiff * (-point.time / time).exp();
            assert_close(name, point.modulus, exact, 0.02);
        }
    }
}

/// Shear strengths at 1 and 10 mm/s and 20 °C, in the spellings of a script, an instrument and a spreadsheet.
#[test]
fn shear_strengths_have_names_and_units_of_all_kinds() {
    for text in [
        "velocity_m_per_s,shear_strength_pa,temperature_c,shear_strength_error_pa\n1e-3,1e5,20,1e4\n1e-2,2e5,20,0\n",
        "# of a ball\nv [mm/s]\ttau_MPa\ttemperature [K]\terror_kPa\n1\t0.1\t293.15\t10\n10\t0.2\t293.15\t0\n",
        "Geschwindigkeit;Schubspannung;T;standard error\nmm/s;kPa;°C;Pa\n1;100,0;20;10000\n10;200,0;20;0\n",
    ] {
        let rows = shear_strength_rows(Path::new("shear.csv"), text.as_bytes());
        let rows = rows.unwrap_or_else(|error| panic!("{error}"));
        let numbers = rows.iter().map(|row| {
            let ShearStrengthPoint {
                velocity,
                shear_strength,
                temperature,
            } = row.point;
            [
                Some(velocity),
                Some(shear_strength),
                temperature,
                row.standard_error,
            ]
        });
        let expected = [[1e-3, 1e5, 20.0, 1e4], [1e-2, 2e5, 20.0, 0.0]];
        assert_eq!(rows.len(), expected.len(), "{text}");
        for (found, expected) in numbers.flatten().zip(expected.as_flattened()) {
            let off = found.map_or(f64::NAN, |found| (found - expected).abs());
            assert!(off <= 1e-12 * expected, "{found:?}, not {expected}: {text}");
        }
    }
    for (names, needed) in [
        ("v (mm/s),tau (bar)", "Pa, kPa, MPa, GPa"),
        ("v (rpm),tau (Pa)", "the speed is that along the surface"),
    ] {
        let text = format!("{names}\n1,1\n2,1\n");
        let refused = shear_strength_rows(Path::new("shear.csv"), text.as_bytes());
        let refused = refused.expect_err(names).to_string();
        assert!(refused.contains(needed), "{refused}");
    }
}

/// An unknown word behind an underscore is no unit, so that the column is another one.
#[test]
fn a_word_behind_an_underscore_is_no_unit() {
    let text = "v_m/s,tau_kPa,tau_max,v_2\n1,1,9,9\n2,1,9,9\n";
    let rows = shear_strength_rows(Path::new("shear.csv"), text.as_bytes()).expect("a table");
    let strengths: Vec<f64> = rows.iter().map(|row| row.point.shear_strength).collect();
    assert_eq!(strengths, [1e3, 1e3], "{text}");
}
