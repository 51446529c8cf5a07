//! Rubbers whose isotherms are laid onto one curve: with and without a modulus that changes with temperature, on rubbery and glassy
//! plateaus, and with neighbours that hardly overlap.

use std::f64::consts::LN_10;

use rheology::fit::{
    IdentifyOptions, Isotherm, MasterCurve, ModulusPoint, SuperpositionOptions, VerticalChoice,
    VerticalShift, automatic_master_curve, identify, shifted_master_curve,
};
use rheology::{KELVIN_AT_ZERO_CELSIUS, RelaxationBranch, RelaxationSpectrum, WlfShift};

use casebook::assert_close;

use crate::experiments::{Random, dissipation, uncertainty};

/// Temperature of the spectrum, \[°C].
const MIDDLE: f64 = 20.0;

/// From 1 MPa to 1 GPa, with a plateau on both sides.
fn rubber() -> RelaxationSpectrum {
    let branch = |k: i32| {
        let time = 10_f64.powf(0.25 * f64::from(k) - 9.0);
        RelaxationBranch::new(3e5 * (time / 1e-3).powf(-0.55), time)
    };
    RelaxationSpectrum::new(1e6, 0.0, (0..=28).map(branch).collect()).expect("a rubber")
}

fn law() -> WlfShift {
    WlfShift::new(8.86, 101.6, MIDDLE).expect("a law")
}

/// What the moduli of isotherms are multiplied by.
#[derive(Clone, Copy, PartialEq)]
enum Factor {
    One,
    Entropic,
    /// Up to 10 %, and another one for each isotherm.
    Own,
}

/// Isotherms that are measured.
struct Kind {
    temperatures: &'static [f64],
    factor: Factor,
}

impl Factor {
    fn at(self, temperature: f64) -> f64 {
        match self {
            Self::One => 1.0,
            Self::Entropic => {
                (temperature + KELVIN_AT_ZERO_CELSIUS) / (MIDDLE + KELVIN_AT_ZERO_CELSIUS)
            }
            Self::Own => 1.0 + 0.1 * (temperature - MIDDLE).sin(),
        }
    }
}

const KINDS: [Kind; 6] = [
    Kind {
        temperatures: &[-20.0, -10.0, 0.0, 10.0, 20.0, 30.0, 40.0],
        factor: Factor::One,
    },
    Kind {
        temperatures: &[-20.0, -10.0, 0.0, 10.0, 20.0, 30.0, 40.0],
        factor: Factor::Entropic,
    },
    // On the rubbery plateau.
    Kind {
        temperatures: &[0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0],
        factor: Factor::Entropic,
    },
    // On the glassy one, where the coldest isotherms are three decades apart, as long as they are.
    Kind {
        temperatures: &[-30.0, -20.0, -10.0, 0.0, 10.0, 20.0],
        factor: Factor::One,
    },
    // The second coldest is missing.
    Kind {
        temperatures: &[-30.0, -10.0, 0.0, 10.0, 20.0, 30.0, 40.0],
        factor: Factor::Entropic,
    },
    Kind {
        temperatures: &[-10.0, 0.0, 10.0, 20.0, 30.0, 40.0],
        factor: Factor::Own,
    },
];

/// Three decades of frequency with noise of so much, and with temperatures \[K] and factors of isotherms that scatter.
fn measured(kind: &Kind, seed: u64, [noise, kelvins, factors]: [f64; 3]) -> Vec<Isotherm> {
    let truth = rubber();
    let mut random = Random(seed.wrapping_mul(0x1234_5678_9abc_def1));
    let isotherm = |temperature: &f64| {
        let own = temperature + kelvins * random.normal();
        let shift = (LN_10 * law().log10_factor(own).expect("a factor")).exp();
        let factor = kind.factor.at(*temperature) * (1.0 + factors * random.normal());
        let mut error = || factor * (1.0 + noise * random.normal());
        let points = (0..=15).map(|k| {
            let omega = 10_f64.powf(0.2 * f64::from(k) - 0.2);
            let modulus = truth.complex_modulus(shift * omega).expect("moduli");
            ModulusPoint {
                angular_frequency: omega,
                storage: modulus.storage * error(),
                loss: modulus.loss * error(),
            }
        });
        Isotherm {
            temperature: *temperature,
            points: points.collect(),
        }
    };
    kind.temperatures.iter().map(isotherm).collect()
}

fn joined(isotherms: &[Isotherm], temperature: f64) -> MasterCurve {
    let master = automatic_master_curve(isotherms, temperature, &SuperpositionOptions::default());
    master.expect("a master curve")
}

/// The material at the temperature of a curve.
fn at(temperature: f64, factor: Factor) -> RelaxationSpectrum {
    let shift = (LN_10 * law().log10_factor(temperature).expect("a factor")).exp();
    let truth = rubber();
    let factor = factor.at(temperature);
    let branches = truth.branches().iter();
    let branches = branches
        .map(|one| RelaxationBranch::new(factor * one.modulus, shift * one.relaxation_time));
    let spring = factor * truth.equilibrium_modulus();
    RelaxationSpectrum::new(spring, 0.0, branches.collect()).expect("a rubber")
}

/// What a friction depends on at four temperatures of each kind: 95 per cent are expected within 1.96 standard errors, and far from all
/// within a third of that.
#[test]
fn bands_hold_the_dissipation_of_rubbers() {
    const SEEDS: u64 = 3;
    let mut deviations = Vec::new();
    for (number, kind) in KINDS.iter().enumerate() {
        for seed in 0..SEEDS {
            let isotherms = measured(kind, seed + 100 * number as u64, [0.02, 0.3, 0.005]);
            for temperature in &kind.temperatures[1..5] {
                let master = joined(&isotherms, *temperature);
                let found = identify(&master.curve, &IdentifyOptions::default()).expect("a series");
                let covariance = found.covariance.as_ref().expect("a covariance");
                let error = uncertainty(&found.spectrum, covariance);
                let expected = dissipation(&at(*temperature, kind.factor));
                deviations.push((dissipation(&found.spectrum) - expected) / error);
            }
        }
    }
    let within = |width: f64| {
        let inside = deviations
            .iter()
            .filter(|deviation| deviation.abs() <= width);
        inside.count() as f64 / deviations.len() as f64
    };
    let [full, third] = [1.96, 0.65].map(within);
    assert!(full >= 0.95, "{full} are within the band");
    assert!(third < 0.85, "{third} are within a third of it");
}

/// Which change of the moduli the data have is found, and shifts are where they belong within their errors.
#[test]
fn factors_of_moduli_are_found_where_there_are_some() {
    let expected = |factor| match factor {
        Factor::One => VerticalShift::None,
        Factor::Entropic => VerticalShift::Entropic,
        Factor::Own => VerticalShift::Free,
    };
    for (number, kind) in KINDS.iter().enumerate() {
        for seed in 0..5 {
            let isotherms = measured(kind, 17 + seed, [0.01, 0.0, 0.0]);
            let master = joined(&isotherms, MIDDLE);
            assert_eq!(
                master.vertical,
                expected(kind.factor),
                "kind {number}, {master:?}"
            );
            assert_eq!(master.vertical_choice, VerticalChoice::FoundInData);
            let found = identify(&master.curve, &IdentifyOptions::default()).expect("a series");
            let errors = found.covariance.expect("a covariance").shift_errors;
            for (shift, [of_shift, of_modulus]) in master.shifts.iter().zip(errors) {
                let off = LN_10
                    * (shift.log10_factor
                        - law().log10_factor(shift.temperature).expect("a factor"));
                let factor = (shift.modulus_factor / kind.factor.at(shift.temperature)).ln();
                assert!(
                    off.abs() <= 4.0 * of_shift + 0.01,
                    "kind {number}: {off} of {of_shift}, {shift:?}"
                );
                assert!(
                    factor.abs() <= 4.0 * of_modulus + 1e-3,
                    "kind {number}: {factor} of {of_modulus}, {shift:?}"
                );
            }
        }
    }
}

/// With the true law given, exact data lie on the true curve.
#[test]
fn a_given_law_leaves_exact_data_exact() {
    for kind in KINDS.iter().take(5) {
        let isotherms = measured(kind, 1, [0.0; 3]);
        let log10_factor = |temperature| law().log10_factor(temperature);
        let options = SuperpositionOptions::default();
        let master = shifted_master_curve(&isotherms, MIDDLE, log10_factor, &options);
        let truth = rubber();
        for point in master.expect("a master curve").points {
            let modulus = truth
                .complex_modulus(point.angular_frequency)
                .expect("moduli");
            assert_close!(point.storage => modulus.storage, within 1e-12);
            assert_close!(point.loss => modulus.loss, within 1e-12);
        }
    }
}
