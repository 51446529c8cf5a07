use casebook::{assert_close, fixed_cases};
use proptest::prelude::*;
use rheology::{RelaxationBranch, RelaxationSpectrum};

use crate::support::spectrum;

/// What surrounds the branches: lone spring and lone dashpot, each absent, weak or strong.
fn frame() -> impl Strategy<Value = (f64, f64)> {
    let absent_or_any = || prop_oneof![Just(0.0), (-6.0_f64..3.0).prop_map(|e| 10_f64.powf(e))];
    (absent_or_any(), absent_or_any())
}

/// One to 100 branches over 15 decades of time, moduli over six; some times repeated, some beside another one.
fn spectra() -> impl Strategy<Value = RelaxationSpectrum> {
    let branch = (-9.0_f64..6.0, -3.0_f64..3.0, 0_u8..4, -15.0_f64..-1.0);
    (frame(), prop::collection::vec(branch, 1..=100)).prop_map(|((spring, dashpot), branches)| {
        let (mut moduli, mut times) = (Vec::new(), Vec::new());
        for (log_time, log_modulus, kind, log_gap) in branches {
            let time = match (kind, times.last()) {
                (0, Some(last)) => *last,
                (1, Some(last)) => last * (1.0 + 10_f64.powf(log_gap)),
                _ => 10_f64.powf(log_time),
            };
            times.push(time);
            moduli.push(10_f64.powf(log_modulus));
        }
        spectrum(spring, dashpot, &moduli, &times)
    })
}

/// Angular frequencies around all times, \[rad/s].
fn frequencies() -> impl Iterator<Item = f64> {
    (-80..=110).map(|k| 10_f64.powf(0.1 * f64::from(k)))
}

/// Each residue is a product of up to 200 factors, each good to two roundings.
const RESPONSE: f64 = 1e-13;

fn scaled(material: &RelaxationSpectrum, modulus: f64, time: f64) -> RelaxationSpectrum {
    let branches = material.branches().iter().map(|b| RelaxationBranch {
        modulus: b.modulus * modulus,
        relaxation_time: b.relaxation_time * time,
    });
    let spring = material.equilibrium_modulus() * modulus;
    let dashpot = material.viscosity() * modulus * time;
    RelaxationSpectrum::new(spring, dashpot, branches.collect()).unwrap()
}

proptest! {
    #![proptest_config(fixed_cases(256))]

    /// G* J* = 1, each evaluated from its own spectrum, in any units.
    #[test]
    fn modulus_and_compliance_are_reciprocal(
        relaxation in spectra(),
        log_modulus in -12.0_f64..12.0,
        log_time in -12.0_f64..12.0,
    ) {
        let [modulus, time] = [log_modulus, log_time].map(|exponent| 10_f64.powf(exponent));
        let relaxation = scaled(&relaxation, modulus, time);
        let creep = relaxation.to_creep().unwrap();
        for omega in frequencies().map(|omega| omega / time) {
            let modulus = relaxation.complex_modulus(omega).unwrap();
            let compliance = creep.complex_compliance(omega).unwrap();
            let real = modulus.storage * compliance.storage + modulus.loss * compliance.loss;
            let imaginary = modulus.loss * compliance.storage - modulus.storage * compliance.loss;
            let error = (real - 1.0).hypot(imaginary);
            prop_assert!(error <= RESPONSE, "G* J* = {real} + {imaginary} i at ω = {omega:e}");
        }
    }

    #[test]
    fn every_response_survives_the_round_trip(before in spectra()) {
        let after = before.to_creep().unwrap().to_relaxation().unwrap();
        let slowest = before.branches().last().map_or(1.0, |b| b.relaxation_time);
        for omega in frequencies() {
            let [old, new] = [&before, &after].map(|m| m.complex_modulus(omega).unwrap());
            assert_close!(new.storage => old.storage, within RESPONSE; "G' at ω = {omega:e}");
            assert_close!(new.loss => old.loss, within RESPONSE; "G'' at ω = {omega:e}");
            let time = omega.recip();
            let [old, new] = [&before, &after].map(|m| m.relaxation_modulus(time).unwrap());
            // A rounded relaxation time changes e^(−t/τ) by t/τ roundings.
            let tolerance = RESPONSE * (1.0 + time / slowest);
            // Denormal numbers have fewer digits.
            if old > 1e-300 {
                assert_close!(new => old, within tolerance; "G at t = {time:e}");
            }
        }
    }
}

/// A single branch, no branch, branches without modulus, and times that differ by a few roundings.
#[test]
fn degenerate_spectra_convert() {
    let with_zero = spectrum(1.0, 0.0, &[2.0, 0.0, 3.0], &[0.1, 1.0, 10.0]);
    let sorted = spectrum(1.0, 0.0, &[3.0, 2.0], &[10.0, 0.1]);
    assert_eq!(with_zero, sorted, "sorted and without zeros");
    let repeated = spectrum(1.0, 0.0, &[1.0, 2.0], &[1.0, 1.0]);
    assert_eq!(repeated, spectrum(1.0, 0.0, &[3.0], &[1.0]), "one branch");
    let close = spectrum(1.0, 0.0, &[1.0, 2.0], &[1.0, 1.0 + 3e-9]);
    assert_eq!(close.branches().len(), 1, "one branch: {close:?}");
    // The mean, weighted with the moduli, keeps the viscosity.
    assert_close!(close.zero_shear_viscosity() => 3.0 + 6e-9, within 1e-15);
    let dashpots = spectrum(0.0, 2.0, &[3.0], &[5.0]).to_creep().unwrap();
    // 1/G* = 1/(2 s + 15 s/(1 + 5 s)): λ = 10/17, 1/η_f = 1/17, J = 1/2 (λ − λ²/5 · …) = 75/289.
    assert_close!(dashpots.fluidity() => 1.0 / 17.0, within 1e-15);
    let element = dashpots.elements()[0];
    assert_close!(element.retardation_time => 10.0 / 17.0, within 1e-15);
    assert_close!(element.compliance => 75.0 / 289.0, within 1e-15);
}

/// Their squares underflow, so that the search for a retardation time once never ended.
#[test]
fn branches_that_relax_at_once_are_converted() {
    for time in [1e-150, 1e-200, 1e-300] {
        for dashpot in [0.0, 100.0] {
            let relaxation = spectrum(1e6, dashpot, &[1e6, 1e6], &[time, 0.01]);
            let creep = relaxation.to_creep().unwrap();
            for frequency in frequencies() {
                let modulus = relaxation.complex_modulus(frequency).unwrap();
                let compliance = creep.complex_compliance(frequency).unwrap();
                let product = modulus.storage * compliance.storage + modulus.loss * compliance.loss;
                assert_close!(product => 1.0, within 1e-12; "{time:e}, {dashpot}, {frequency:e}");
            }
        }
    }
}
