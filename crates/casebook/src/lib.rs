//! Exact reference numbers that the tests of the workspace compare with, and contacts that are timed and measured.
//!
//! The table `casebook.json` was computed with 40-digit arithmetic outside this workspace, every number in two
//! independent ways. Each case has inputs, expected values and the relative tolerance that a good f64 implementation
//! reaches. What the tests need and do not find is a panic, so that they fail.
#![expect(clippy::missing_panics_doc, reason = "said once, above")]
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

mod assertions;
mod bodies;
mod contacts;
mod materials;
mod rough;

pub use assertions::{NEGATIVE, NOT_POSITIVE, refused, refuses};
pub use bodies::{Formula, GaussianDip, superposition};
pub use contacts::{COMPLIANCE, HERTZ_DEPTH, HERTZ_FORCE, deviation, hertz_heights};
pub use materials::{model, prony, standard_solid};
pub use rough::{RoughCase, rough_cases};

// Only for their features: see Cargo.toml.
use {
    approx as _, bitflags as _, bytemuck as _, either as _, libc as _, matrixmultiply as _,
    memchr as _, num_complex as _, num_integer as _, num_traits as _, once_cell as _, serde as _,
    serde_core as _, zerocopy as _,
};

use proptest::strategy::Strategy;
use proptest::test_runner::{Config, RngSeed};
use serde_json::Value;

/// Configuration of `cases` random cases, the same in every run, without a file of failed cases.
pub fn fixed_cases(cases: u32) -> Config {
    Config {
        cases,
        rng_seed: RngSeed::Fixed(2014),
        failure_persistence: None,
        ..Config::default()
    }
}

/// Numbers between 10^-n and 10^n, alike in every decade.
pub fn decades(n: f64) -> impl Strategy<Value = f64> {
    (-n..n).prop_map(|exponent| 10.0_f64.powf(exponent))
}

/// Rows of numbers that blanks separate, in lines or between commas.
pub fn numbers<const N: usize>(rows: &str) -> Vec<[f64; N]> {
    let rows = rows.split([',', '\n']).filter(|row| !row.trim().is_empty());
    let row = |row: &str| {
        let cells = row.split_whitespace().map(str::parse);
        let cells: Vec<f64> = cells.collect::<Result<_, _>>().expect("numbers");
        cells.try_into().expect("so many numbers in a row")
    };
    rows.map(row).collect()
}

/// One row of the casebook.
#[derive(Debug, Clone)]
pub struct Case(Value);

/// The cases of one group, for example `"FRI-01"`; a panic without any: a test that checks nothing must fail.
pub fn group(name: &str) -> Vec<Case> {
    let book: Value =
        serde_json::from_str(include_str!("../casebook.json")).expect("the casebook is valid JSON");
    let all = book["cases"]
        .as_array()
        .expect("the casebook has a list of cases");
    let is_member = |case: &&Value| {
        let id = case["id"].as_str().unwrap_or_default();
        id.split('/').next() == Some(name)
    };
    let cases: Vec<Case> = all.iter().filter(is_member).cloned().map(Case).collect();
    assert!(!cases.is_empty(), "the casebook has no group {name}");
    cases
}

impl Case {
    /// Full name, `group/case`.
    pub fn id(&self) -> &str {
        self.0["id"].as_str().unwrap_or_default()
    }

    /// Whether an input of this name exists.
    pub fn has_input(&self, name: &str) -> bool {
        !self.0["inputs"][name].is_null()
    }

    /// A numeric input.
    pub fn input(&self, name: &str) -> f64 {
        number(&self.0["inputs"][name])
            .unwrap_or_else(|| panic!("{} has no number {name}", self.id()))
    }

    /// A list of numbers among the inputs.
    pub fn input_list(&self, name: &str) -> Vec<f64> {
        list(&self.0["inputs"][name]).unwrap_or_else(|| panic!("{} has no list {name}", self.id()))
    }

    /// A text among the inputs, empty when absent.
    pub fn input_text(&self, name: &str) -> &str {
        self.0["inputs"][name].as_str().unwrap_or_default()
    }

    /// A number among the expected values.
    pub fn expected(&self, name: &str) -> Option<f64> {
        number(&self.0["expected"][name])
    }

    /// Names of the numbers among the expected values.
    pub fn expected_names(&self) -> impl Iterator<Item = &str> {
        let values = self.0["expected"].as_object().into_iter().flatten();
        let numbers = values.filter(|(_, value)| number(value).is_some());
        numbers.map(|(name, _)| name.as_str())
    }

    /// A list of numbers among the expected values.
    pub fn expected_list(&self, name: &str) -> Option<Vec<f64>> {
        list(&self.0["expected"][name])
    }

    /// The name of the error that a program must return, when the case asks for one.
    pub fn expected_error(&self) -> Option<&str> {
        self.0["expected"]["error"].as_str()
    }

    /// Relative tolerance of the case.
    pub fn relative_tolerance(&self) -> f64 {
        number(&self.0["rel_tol"]).unwrap_or(1e-12)
    }

    /// Asserts that `actual` is the expected number `name` within the tolerance of the case.
    pub fn check(&self, name: &str, actual: f64) {
        self.check_within(name, actual, self.relative_tolerance());
    }

    /// Like [`Case::check`] with a tolerance of the caller's.
    pub fn check_within(&self, name: &str, actual: f64, relative_tolerance: f64) {
        let id = self.id();
        let expected = self
            .expected(name)
            .unwrap_or_else(|| panic!("{id} expects no number {name}"));
        let absolute_tolerance = number(&self.0["abs_tol"]).unwrap_or(0.0);
        let allowed = relative_tolerance * expected.abs() + absolute_tolerance;
        let difference = (actual - expected).abs();
        // A difference of exactly zero is allowed when the expected value is zero; NaN never passes.
        assert!(
            difference <= allowed,
            "{id}: {name} = {actual:e}, expected {expected:e}, off by {difference:e}, allowed {allowed:e}; inputs {}",
            self.0["inputs"]
        );
    }
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::String(text) => match text.as_str() {
            "inf" => Some(f64::INFINITY),
            "-inf" => Some(f64::NEG_INFINITY),
            "nan" => Some(f64::NAN),
            _ => None,
        },
        other => other.as_f64(),
    }
}

fn list(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(number).collect()
}
