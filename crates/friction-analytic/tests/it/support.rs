//! Loads, bodies and comparisons for the tests.

use casebook::Case;
use indenters::{
    Axisymmetric, FlatCone, FlatPunch, Hyperboloid, Kink, PowerProfile, PowerTerm, RoundTippedCone,
    SlidingLoad, Sphere, Superposition, TruncatedParaboloid,
};
use proptest::test_runner::{Config, RngSeed};
use rheology::Viscous;

/// The material and load of a row with inputs `F`, `eta` and `v`.
pub(crate) fn sliding(case: &Case) -> (Viscous, SlidingLoad) {
    material_and_load(["F", "eta", "v"].map(|name| case.input(name)))
}

pub(crate) fn material_and_load([force, eta, v]: [f64; 3]) -> (Viscous, SlidingLoad) {
    (
        Viscous::new(eta).expect("the viscosity is legal"),
        SlidingLoad::new(force, v).expect("the load is legal"),
    )
}

/// Material and load with 4 η v = 1, whose stationary depth is the force, to the last bit.
pub(crate) fn with_depth(depth: f64) -> (Viscous, SlidingLoad) {
    material_and_load([depth, 0.5, 0.5])
}

/// The same cases in every run, and no file left behind.
pub(crate) fn fixed_cases(cases: u32) -> Config {
    Config {
        cases,
        rng_seed: RngSeed::Fixed(2014),
        failure_persistence: None,
        ..Config::default()
    }
}

/// A body without the closed form of its line, so that the transform is done by quadrature.
pub(crate) struct Bare<'a, P>(pub(crate) &'a P);

impl<P: Axisymmetric> Axisymmetric for Bare<'_, P> {
    fn profile_height(&self, radius: f64) -> f64 {
        self.0.profile_height(radius)
    }

    fn profile_slope(&self, radius: f64) -> f64 {
        self.0.profile_slope(radius)
    }

    fn profile_curvature(&self, radius: f64) -> f64 {
        self.0.profile_curvature(radius)
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

/// r²/(2R) + A (1 − cos k r), a body known only to this test.
struct WavyParaboloid {
    radius: f64,
    amplitude: f64,
    wavenumber: f64,
}

impl Axisymmetric for WavyParaboloid {
    fn profile_height(&self, r: f64) -> f64 {
        r * r / (2.0 * self.radius) + self.amplitude * (1.0 - (self.wavenumber * r).cos())
    }

    fn profile_slope(&self, r: f64) -> f64 {
        r / self.radius + self.amplitude * self.wavenumber * (self.wavenumber * r).sin()
    }

    fn profile_curvature(&self, r: f64) -> f64 {
        self.radius.recip() + self.amplitude * self.wavenumber.powi(2) * (self.wavenumber * r).cos()
    }

    fn profile_exponent(&self) -> f64 {
        2.0
    }
}

/// The body that the input `shape` of a row names.
pub(crate) fn body(case: &Case) -> Box<dyn Axisymmetric> {
    let [a, b] = match case.input_text("shape") {
        "power" => ["c", "p"],
        "sphere" => ["R", "R"],
        "flat-ended cone" | "round-tipped cone" => ["b", "tan_theta"],
        "truncated paraboloid" => ["b", "R"],
        "hyperboloid" => ["b", "L"],
        "flat punch" | "" => ["a", "a"],
        _ => return many_parameter_body(case),
    }
    .map(|name| case.input(name));
    match case.input_text("shape") {
        "power" => Box::new(PowerProfile::new(a, b).unwrap()),
        "sphere" => Box::new(Sphere::new(a).unwrap()),
        "flat-ended cone" => Box::new(FlatCone::new(a, b).unwrap()),
        "round-tipped cone" => Box::new(RoundTippedCone::new(a, b).unwrap()),
        "truncated paraboloid" => Box::new(TruncatedParaboloid::new(a, 0.5 / b).unwrap()),
        // L (√(1 + r²/b²) − 1).
        "hyperboloid" => Box::new(Hyperboloid::new(a, b / a).unwrap()),
        _ => Box::new(FlatPunch::new(a).unwrap()),
    }
}

fn many_parameter_body(case: &Case) -> Box<dyn Axisymmetric> {
    if case.has_input("k") {
        return Box::new(WavyParaboloid {
            radius: case.input("R"),
            amplitude: case.input("A"),
            wavenumber: case.input("k"),
        });
    }
    let terms = [("c1", 1.0), ("c2", 2.0), ("c4", 4.0)].map(|(name, exponent)| PowerTerm {
        coefficient: case.input(name),
        exponent,
    });
    Box::new(Superposition::new(terms.to_vec()).unwrap())
}
