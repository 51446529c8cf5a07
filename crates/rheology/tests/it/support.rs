//! Materials for the tests.

use proptest::test_runner::{Config, RngSeed};
use rheology::{StandardSolid, StandardSolidParameters};

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

/// Asserts that two numbers agree within a relative tolerance.
pub(crate) fn assert_close(what: &str, actual: f64, expected: f64, tolerance: f64) {
    assert!(
        (actual - expected).abs() <= tolerance * expected.abs(),
        "{what} is {actual:e}, expected {expected:e} within {tolerance:e}"
    );
}

/// The same cases in every run, and no file left behind.
pub(crate) fn fixed_cases() -> Config {
    Config {
        rng_seed: RngSeed::Fixed(2014),
        failure_persistence: None,
        ..Config::default()
    }
}
