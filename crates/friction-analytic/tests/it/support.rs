//! Loads, bodies and comparisons for the tests.

use casebook::Case;
use indenters::{Axisymmetric, Kink, PowerProfile, ProfilePoint, SlidingLoad};
use rheology::Viscous;

/// The material and load of a row with inputs `F`, `eta` and `v`.
pub(crate) fn sliding(case: &Case) -> (Viscous, SlidingLoad) {
    material_and_load(["F", "eta", "v"].map(|name| case.input(name)))
}

pub(crate) fn material_and_load([force, eta, v]: [f64; 3]) -> (Viscous, SlidingLoad) {
    let load = SlidingLoad::new(force, v).expect("the load is legal");
    (viscous(eta), load)
}

/// Material and load with 4 η v = 1, whose stationary depth is the force, to the last bit.
pub(crate) fn with_depth(depth: f64) -> (Viscous, SlidingLoad) {
    material_and_load([depth, 0.5, 0.5])
}

pub(crate) fn viscous(eta: f64) -> Viscous {
    Viscous::new(eta).expect("the viscosity is legal")
}

pub(crate) fn power(coefficient: f64, exponent: f64) -> PowerProfile {
    PowerProfile::new(coefficient, exponent).expect("a power")
}

/// Checks those of the numbers that the row expects.
pub(crate) fn check_expected(case: &Case, numbers: &[(&str, f64)]) {
    let is_expected = |(name, _): &&(&str, f64)| case.expected(name).is_some();
    let expected: Vec<_> = numbers.iter().filter(is_expected).collect();
    let name = case.id();
    assert!(!expected.is_empty(), "{name} expects none of {numbers:?}");
    for (name, value) in expected {
        case.check(name, *value);
    }
}

/// A body without the closed form of its line, so that the transform is done by quadrature.
pub(crate) struct Bare<'a, P>(pub(crate) &'a P);

impl<P: Axisymmetric> Axisymmetric for Bare<'_, P> {
    fn profile(&self, radius: f64) -> ProfilePoint {
        self.0.profile(radius)
    }

    fn profile_exponent(&self) -> f64 {
        self.0.profile_exponent()
    }

    fn max_radius(&self) -> f64 {
        self.0.max_radius()
    }

    fn kinks(&self) -> Vec<Kink> {
        self.0.kinks()
    }
}
