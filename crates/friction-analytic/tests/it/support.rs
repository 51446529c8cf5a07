//! Loads, materials and bodies for the tests.

use casebook::Case;
use indenters::{PowerProfile, SlidingLoad};
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
