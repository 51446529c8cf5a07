//! Materials for the tests.

use std::fmt::Debug;

use rheology::{
    FractionalMaxwell, FractionalMaxwellParameters, Material, RelaxationSpectrum, RheologyError,
    StandardSolid, StandardSolidParameters,
};

/// The solid of these equilibrium and Maxwell moduli and this viscosity.
pub(crate) fn solid(numbers: [f64; 3]) -> StandardSolid {
    StandardSolid::new(parameters(numbers)).expect("the moduli and the viscosity are legal")
}

pub(crate) fn parameters([g1, g2, eta]: [f64; 3]) -> StandardSolidParameters {
    StandardSolidParameters {
        equilibrium_modulus: g1,
        maxwell_modulus: g2,
        viscosity: eta,
    }
}

/// The element of a modulus, a time and an exponent.
pub(crate) fn fractional_maxwell(
    [shear_modulus, relaxation_time, exponent]: [f64; 3],
) -> Result<FractionalMaxwell, RheologyError> {
    FractionalMaxwell::new(FractionalMaxwellParameters {
        shear_modulus,
        relaxation_time,
        exponent,
    })
}

/// The spectrum of a named casebook model.
pub(crate) fn named_spectrum(name: &str) -> RelaxationSpectrum {
    casebook::model(name).relaxation()
}

/// A relaxation spectrum from lists of moduli and times.
pub(crate) fn spectrum(
    equilibrium: f64,
    viscosity: f64,
    moduli: &[f64],
    times: &[f64],
) -> RelaxationSpectrum {
    let pairs = moduli.iter().copied().zip(times.iter().copied());
    casebook::prony([equilibrium, viscosity], &pairs.collect::<Vec<_>>()).relaxation()
}

/// Asserts that two numbers are the same, to the last bit.
pub(crate) fn assert_same(what: &str, actual: f64, expected: f64) {
    assert_eq!(
        actual.to_bits(),
        expected.to_bits(),
        "{what} is {actual:e}, expected {expected:e}"
    );
}

pub(crate) const NEGATIVE: &[f64] = &[f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -1e-300];
pub(crate) const NOT_POSITIVE: &[f64] = &[f64::NAN, f64::INFINITY, -1.0, -1e-300, -0.0, 0.0];

/// Asserts that an error names the parameter and the range that each number is outside of.
pub(crate) fn refuses<T: Debug>(
    parameter: &str,
    numbers: &[f64],
    attempt: impl Fn(f64) -> Result<T, RheologyError>,
) {
    for number in numbers {
        let message = match attempt(*number) {
            Err(error) => error.to_string(),
            Ok(value) => panic!("{number} as {parameter} gives {value:?}"),
        };
        assert!(
            message.starts_with(&format!("{parameter} must be ")) && message.contains(", but is "),
            "{message}, for {number} as {parameter}"
        );
    }
}
