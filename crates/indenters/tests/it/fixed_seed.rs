//! Property tests that draw the same examples on every machine.

use proptest::test_runner::{Config, RngSeed};

pub(crate) fn fixed_seed() -> Config {
    Config {
        cases: 256,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(2014),
        ..Config::default()
    }
}
