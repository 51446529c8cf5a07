//! Materials for the tests.

use casebook::standard_solid;
use rheology::{
    FractionalMaxwell, FractionalMaxwellParameters, Material, RelaxationSpectrum, RheologyError,
    StandardSolid,
};

/// The solid of these equilibrium and Maxwell moduli and this viscosity.
pub(crate) fn solid(numbers: [f64; 3]) -> StandardSolid {
    standard_solid(numbers).expect("the moduli and the viscosity are legal")
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
