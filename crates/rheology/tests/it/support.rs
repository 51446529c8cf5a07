//! Materials for the tests.

use proptest::test_runner::{Config, RngSeed};
use rheology::{RelaxationBranch, RelaxationSpectrum, StandardSolid, StandardSolidParameters};

/// The solid of these equilibrium and Maxwell moduli and this viscosity.
pub(crate) fn solid([g1, g2, eta]: [f64; 3]) -> StandardSolid {
    StandardSolid::new(parameters([g1, g2, eta])).expect("the moduli and the viscosity are legal")
}

pub(crate) fn parameters([g1, g2, eta]: [f64; 3]) -> StandardSolidParameters {
    StandardSolidParameters {
        equilibrium_modulus: g1,
        maxwell_modulus: g2,
        viscosity: eta,
    }
}

/// The same cases in every run, and no file left behind.
pub(crate) fn fixed_cases() -> Config {
    Config {
        rng_seed: RngSeed::Fixed(2014),
        failure_persistence: None,
        ..Config::default()
    }
}

/// The Prony spectrum of a casebook model: Ge, G and tau.
pub(crate) fn casebook_spectrum(case: &casebook::Case) -> RelaxationSpectrum {
    let (moduli, times) = (case.input_list("G"), case.input_list("tau"));
    spectrum(case.input("Ge"), 0.0, &moduli, &times)
}

/// The spectrum of a named casebook model, for the groups that give its name only.
pub(crate) fn named_spectrum(model: &str) -> RelaxationSpectrum {
    let cases = casebook::group("RHE-04");
    let scalars = cases
        .iter()
        .find(|case| case.id() == format!("RHE-04/{model}/scalars"))
        .expect("the model is in RHE-04");
    casebook_spectrum(scalars)
}

/// A relaxation spectrum from lists of moduli and times.
pub(crate) fn spectrum(
    equilibrium: f64,
    viscosity: f64,
    moduli: &[f64],
    times: &[f64],
) -> RelaxationSpectrum {
    let pairs = moduli.iter().zip(times);
    let branches = pairs.map(|(&modulus, &relaxation_time)| RelaxationBranch {
        modulus,
        relaxation_time,
    });
    RelaxationSpectrum::new(equilibrium, viscosity, branches.collect())
        .expect("the moduli and times are legal")
}

/// Asserts that two numbers are the same, to the last bit.
pub(crate) fn assert_same(what: &str, actual: f64, expected: f64) {
    assert_eq!(
        actual.to_bits(),
        expected.to_bits(),
        "{what} is {actual:e}, expected {expected:e}"
    );
}
