//! The bodies named by the casebook.

use casebook::Case;
use indenters::{
    Axisymmetric, FlatCone, FlatPunch, Hyperboloid, IndenterError, PowerProfile, PowerTerm,
    RoundTippedCone, Sphere, Superposition, TruncatedParaboloid,
};

/// A paraboloid with a cosine on it; its line is left to the numerical transform.
struct WavyParaboloid {
    radius_of_curvature: f64,
    amplitude: f64,
    wave_number: f64,
}

impl Axisymmetric for WavyParaboloid {
    fn profile_height(&self, r: f64) -> f64 {
        let half_phase = 0.5 * self.wave_number * r;
        0.5 * r * r / self.radius_of_curvature + 2.0 * self.amplitude * half_phase.sin().powi(2)
    }

    fn profile_slope(&self, r: f64) -> f64 {
        let k = self.wave_number;
        r / self.radius_of_curvature + self.amplitude * k * (k * r).sin()
    }

    fn profile_curvature(&self, r: f64) -> f64 {
        let k = self.wave_number;
        1.0 / self.radius_of_curvature + self.amplitude * k * k * (k * r).cos()
    }

    fn profile_exponent(&self) -> f64 {
        2.0
    }
}

/// 1 − exp(−(r/s)²) in units of the length s; its line is left to the numerical transform.
pub(crate) struct GaussianDip {
    pub(crate) length: f64,
}

impl Axisymmetric for GaussianDip {
    fn profile_height(&self, r: f64) -> f64 {
        -self.length * (-(r / self.length).powi(2)).exp_m1()
    }

    fn profile_slope(&self, r: f64) -> f64 {
        let y = r / self.length;
        2.0 * y * (-y * y).exp()
    }

    fn profile_curvature(&self, r: f64) -> f64 {
        let y = r / self.length;
        (2.0 - 4.0 * y * y) * (-y * y).exp() / self.length
    }

    fn profile_exponent(&self) -> f64 {
        2.0
    }
}

pub(crate) fn superposition(terms: &[(f64, f64)]) -> Superposition {
    let terms = terms.iter().map(|&(coefficient, exponent)| PowerTerm {
        coefficient,
        exponent,
    });
    Superposition::new(terms.collect()).unwrap()
}

/// A body of which only the surface matters.
pub(crate) fn boxed<S: Axisymmetric + 'static>(
    shape: Result<S, IndenterError>,
) -> Box<dyn Axisymmetric> {
    Box::new(shape.unwrap())
}

/// The body of a row of IND-02, IND-03, IND-05.
pub(crate) fn body(case: &Case) -> Box<dyn Axisymmetric> {
    let input = |name| case.input(name);
    match case.input_text("shape") {
        "power" => boxed(PowerProfile::new(input("c"), input("p"))),
        "sphere" => boxed(Sphere::new(input("R"))),
        // The casebook names this one in the title of its row only.
        "" => boxed(FlatPunch::new(input("a"))),
        "flat-ended cone" => boxed(FlatCone::new(input("b"), input("tan_theta"))),
        "round-tipped cone" => boxed(RoundTippedCone::new(input("b"), input("tan_theta"))),
        "truncated paraboloid" => boxed(TruncatedParaboloid::new(input("b"), 0.5 / input("R"))),
        "hyperboloid" => boxed(Hyperboloid::new(input("b"), input("L") / input("b"))),
        other => unnamed_body(case, other),
    }
}

fn unnamed_body(case: &Case, shape: &str) -> Box<dyn Axisymmetric> {
    match shape.split(' ').next() {
        Some("polynomial") => Box::new(superposition(&[
            (case.input("c1"), 1.0),
            (case.input("c2"), 2.0),
            (case.input("c4"), 4.0),
        ])),
        Some("wavy") => Box::new(WavyParaboloid {
            radius_of_curvature: case.input("R"),
            amplitude: case.input("A"),
            wave_number: case.input("k"),
        }),
        Some("Gaussian") => Box::new(GaussianDip { length: 1.0 }),
        _ => panic!("{} names no known shape", case.id()),
    }
}
