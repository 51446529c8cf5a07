//! Measured moduli in the layouts in which instruments export them are read as the same numbers.
//!
//! Each table has the three points of [`POINTS`], in the words, units, order, separators and encodings of one software as it
//! is known from its exports and manuals; the numbers are made up.

use std::f64::consts::TAU;
use std::path::Path;

use viscofriction::moduli::{
    Deformation, MeasuredModuli, Measurements, TableOptions, measured_moduli, shear_per_tension,
};

use crate::support::assert_close;

/// Frequency, \[Hz], storage and loss modulus in shear, \[MPa].
const POINTS: [[f64; 3]; 3] = [[0.1, 1.5, 0.3], [1.0, 2.25, 0.45], [10.0, 4.0, 1.2]];

/// TA Instruments TRIOS, text: steps between lines of metadata, units below the names.
const TRIOS: &str = "Filename\tC:\\data\\rubber.tri\r\nSample name\t\"5 mm\" disc, no. 2\r\n\r\n[step]\r\n\
    Frequency sweep - 1\r\nAngular frequency\tStep time\tTemperature\tStorage modulus\tLoss modulus\tTan(delta)\r\n\
    rad/s\ts\t°C\tPa\tPa\t\r\n0.6283185307179586\t12\t20.01\t1.5e6\t300000\t0.2\r\n\
    6.283185307179586\t24\t20.02\t2.25e6\t450000\t0.2\r\n62.83185307179586\t36\t20.00\t4e6\t1.2e6\t0.3\r\n\r\n\
    [step]\r\nFrequency sweep - 2\r\nAngular frequency\tStep time\tTemperature\tStorage modulus\tLoss modulus\tTan(delta)\r\n\
    rad/s\ts\t°C\tPa\tPa\t\r\n0.6283185307179586\t12\t40.01\t1e6\t300000\t0.3\r\n\
    6.283185307179586\t24\t40.02\t1.5e6\t450000\t0.3\r\n";

/// Anton Paar RheoCompass, CSV in UTF-16: an empty first column, units in brackets, empty lines, a count of points.
const RHEOCOMPASS: &str = "Project:\tRubber\nTest:\tFrequency sweep\n\nInterval and data points:\t1\t3\n\
    Interval data:\tPoint No.\tAngular Frequency\tStorage Modulus\tLoss Modulus\tLoss Factor\tTemperature\n\t\t\t\t\t\n\
    \t\t[rad/s]\t[MPa]\t[MPa]\t[1]\t[°C]\n\t\t\t\t\t\t\n\t1\t62,83185307179586\t4\t1,2\t0,3\t20\n\
    \t2\t6,283185307179586\t2,25\t0,45\t0,2\t20\n\t3\t0,6283185307179586\t1,5\t0,3\t0,2\t20\n";

/// Netzsch Proteus, CSV in Latin-1: metadata in comments, names with units in a comment too.
const PROTEUS: &str = "#EXPORTTYPE:DATA ALL\n#SEPARATOR:SEMICOLON\n#DECIMAL:COMMA\n#SAMPLE:Gummi, für Reifen\n\n\
    ##Temp./°C;Time/min;f/Hz;E'/MPa;E''/MPa;tan d\n20,0;1,0;0,1;4,5;0,9;0,2\n20,1;2,0;1,0;6,75;1,35;0,2\n\
    20,2;3,0;10,0;12,0;3,6;0,3\n";

/// Mettler Toledo STARe, text: columns that are aligned by blanks, units right-aligned below them.
const STARE: &str = "Curve Name:\n  !&rubber\nCurve Values:\n\
    \x20           Index              Ts       Frequency              E'             E''\n\
    \x20                            [°C]            [Hz]           [MPa]           [MPa]\n\
    \x20               0           20.00             0.1            4.50            0.90\n\
    \x20               1           20.00             1.0            6.75            1.35\n\
    \x20               2           20.00            10.0           12.00            3.60\n";

/// GABO Eplexor, text: from the highest frequency down, a modulus that is not read.
const EPLEXOR: &str = "Eplexor 500 N;Zug\nf [Hz];|E*| [MPa];E' [MPa];E'' [MPa];tan delta;F stat [N]\n\
    10;12,53;12;3,6;0,3;5\n1;6,88;6,75;1,35;0,2;5\n0,1;4,59;4,5;0,9;0,2;5\n";

/// Malvern rSpace for Kinexus, CSV with a byte-order mark: quotes, and words for the moduli.
const RSPACE: &str = "\u{feff}\"Action Name\",\"Frequency(Hz)\",\"Temperature(°C)\",\
    \"Shear modulus (elastic component)(Pa)\",\"Shear modulus (viscous component)(Pa)\",\"Phase angle(°)\"\n\
    \"Sweep, 1\",\"0.1\",\"20\",\"1500000\",\"300000\",\"11.3\"\n\"Sweep, 1\",\"1\",\"20\",\"2250000\",\"450000\",\"11.3\"\n\
    \"Sweep, 1\",\"10\",\"20\",\"4000000\",\"1200000\",\"16.7\"\n";

/// PerkinElmer DMA 8000, text: a loss factor instead of a loss modulus.
const PYRIS: &str = "Time / min\tFrequency / Hz\tStorage Modulus / Pa\tTan Delta\n1\t0.1\t4.5E+06\t0.2\n\
    2\t1\t6.75E+06\t0.2\n3\t10\t1.2E+07\t0.3\n";

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
fn seven_layouts_of_instruments_have_the_same_points() {
    let utf16 = ["\u{feff}", RHEOCOMPASS].concat();
    let utf16: Vec<u8> = utf16.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let latin1 = PROTEUS.chars().map(u8::try_from);
    let latin1: Vec<u8> = latin1.collect::<Result<_, _>>().expect("Latin-1");
    let [tension, shear] = [Deformation::Tension, Deformation::Shear].map(Some);
    for (software, contents, deformation) in [
        ("TRIOS", TRIOS.as_bytes(), shear),
        ("RheoCompass", &utf16, shear),
        ("Proteus", &latin1, None),
        ("STARe", STARE.as_bytes(), None),
        ("Eplexor", EPLEXOR.as_bytes(), None),
        ("rSpace", RSPACE.as_bytes(), None),
        ("Pyris", PYRIS.as_bytes(), tension),
    ] {
        let isotherms = isotherms(read(contents, deformation));
        let expected = if software == "TRIOS" { 2 } else { 1 };
        assert_eq!(isotherms.len(), expected, "{software}: {isotherms:?}");
        let points = &isotherms[0].1;
        assert_eq!(points.len(), POINTS.len(), "{software}: {points:?}");
        for (read, written) in points.iter().flatten().zip(POINTS.iter().flatten()) {
            assert_close(software, *read, *written, 1e-12);
        }
    }
}

/// One frequency after the other over the temperature, and a temperature that comes back.
#[test]
fn isotherms_are_found_in_temperature_sweeps_of_any_order() {
    let sweep = "f / Hz,T / K,G' / MPa,G'' / MPa\n10,293.2,2,1\n10,313,3,1\n10,303,4,1\n\n% 1 Hz\n1,303.3,5,1\n1,293,6,1\n\
        1,313.1,7,1\n1,293.1,8,1\n";
    let read = read(sweep.as_bytes(), None);
    assert!(!read.celsius, "K");
    let isotherms = isotherms(read);
    let storage = isotherms.iter().map(|(_, points)| {
        let storage = points.iter().map(|point| point[1].round());
        storage.collect::<Vec<_>>()
    });
    let storage: Vec<_> = storage.collect();
    let expected = [vec![6.0, 2.0], vec![7.0, 3.0], vec![5.0, 4.0], vec![8.0]];
    assert_eq!(storage, expected, "{isotherms:?}");
    assert_close("mean temperature", isotherms[0].0, 293.1, 1e-12);
}
