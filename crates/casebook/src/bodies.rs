//! The bodies of revolution that rows name, and surfaces of formulas.

use indenters::{
    AnalyticLine, Axisymmetric, FlatCone, FlatPunch, Hyperboloid, PowerProfile, PowerTerm,
    ProfilePoint, RigidLine, RoundTippedCone, Sphere, Superposition, Surface, TruncatedParaboloid,
};

use crate::Case;

/// A paraboloid with a cosine on it; its line is left to the numerical transform.
struct WavyParaboloid {
    radius_of_curvature: f64,
    amplitude: f64,
    wave_number: f64,
}

impl Axisymmetric for WavyParaboloid {
    fn profile(&self, r: f64) -> ProfilePoint {
        let (k, amplitude) = (self.wave_number, self.amplitude);
        ProfilePoint {
            height: 0.5 * r * r / self.radius_of_curvature
                + 2.0 * amplitude * (0.5 * k * r).sin().powi(2),
            slope: r / self.radius_of_curvature + amplitude * k * (k * r).sin(),
            curvature: 1.0 / self.radius_of_curvature + amplitude * k * k * (k * r).cos(),
        }
    }

    fn profile_exponent(&self) -> f64 {
        2.0
    }
}

/// s (1 − exp(−(r/s)²)) with a length s; its line is left to the numerical transform.
#[derive(Debug, Clone, Copy)]
pub struct GaussianDip {
    /// The length s, \[m].
    pub length: f64,
}

impl Axisymmetric for GaussianDip {
    fn profile(&self, r: f64) -> ProfilePoint {
        let y = r / self.length;
        ProfilePoint {
            height: -self.length * (-y * y).exp_m1(),
            slope: 2.0 * y * (-y * y).exp(),
            curvature: (2.0 - 4.0 * y * y) * (-y * y).exp() / self.length,
        }
    }

    fn profile_exponent(&self) -> f64 {
        2.0
    }
}

/// A smooth surface with these mirrors, of which a function of \[x, y] gives the height and its gradient.
#[derive(Debug, Clone, Copy)]
pub struct Formula<F> {
    mirrors: [bool; 2],
    surface: F,
}

impl<F: Fn([f64; 2]) -> (f64, [f64; 2]) + Send + Sync> Formula<F> {
    /// The surface with the heights and gradients of a function.
    pub const fn new(mirrors: [bool; 2], surface: F) -> Self {
        Self { mirrors, surface }
    }
}

impl<F: Fn([f64; 2]) -> (f64, [f64; 2]) + Send + Sync> Surface for Formula<F> {
    fn height(&self, position: [f64; 2]) -> f64 {
        (self.surface)(position).0
    }

    fn gradient(&self, position: [f64; 2]) -> [f64; 2] {
        (self.surface)(position).1
    }

    fn mirrors(&self) -> [bool; 2] {
        self.mirrors
    }

    fn apex_exponent(&self) -> f64 {
        2.0
    }
}

/// The body of revolution Σ c r^p of pairs of coefficient and exponent.
pub fn superposition(terms: &[(f64, f64)]) -> Superposition {
    let powers = terms.iter().map(|&(coefficient, exponent)| PowerTerm {
        coefficient,
        exponent,
    });
    Superposition::new(powers.collect()).expect("a sum of powers")
}

impl Case {
    /// The body of revolution that the input `shape` of the row names.
    pub fn body(&self) -> Box<dyn Axisymmetric> {
        let input = |name| self.input(name);
        let shape = self.input_text("shape");
        let shape = match shape {
            "power" => PowerProfile::new(input("c"), input("p")).map(boxed),
            "sphere" => Sphere::new(input("R")).map(boxed),
            // Some rows name this one in their title only.
            "flat punch" | "" => FlatPunch::new(input("a")).map(boxed),
            "flat-ended cone" => FlatCone::new(input("b"), input("tan_theta")).map(boxed),
            "round-tipped cone" => RoundTippedCone::new(input("b"), input("tan_theta")).map(boxed),
            "truncated paraboloid" => {
                TruncatedParaboloid::new(input("b"), 0.5 / input("R")).map(boxed)
            }
            // L (√(1 + r²/b²) − 1).
            "hyperboloid" => Hyperboloid::new(input("b"), input("L") / input("b")).map(boxed),
            _ => Ok(self.body_in_words(shape)),
        };
        shape.unwrap_or_else(|error| panic!("{}: {error}", self.id()))
    }

    /// The cubic line ε (x³/3 − 3x²/2 + 2x) of group FRI-03 on [0, 3], or the same run through backwards, in a `unit` \[m].
    pub fn cubic(&self, unit: f64) -> impl RigidLine + use<> {
        let (epsilon, reversed) = (self.input("eps"), self.has_input("direction"));
        let turned = move |x: f64| if reversed { 3.0 - x / unit } else { x / unit };
        let height = move |x: f64| {
            let x = turned(x);
            unit * epsilon * x * (x * (x / 3.0 - 1.5) + 2.0)
        };
        let slope = move |x: f64| {
            let slope = epsilon * (turned(x) - 1.0) * (turned(x) - 2.0);
            if reversed { -slope } else { slope }
        };
        AnalyticLine::new(height, slope, [0.0, 3.0 * unit]).expect("a line")
    }

    fn body_in_words(&self, shape: &str) -> Box<dyn Axisymmetric> {
        match shape.split(' ').next() {
            Some("polynomial") => boxed(superposition(&[
                (self.input("c1"), 1.0),
                (self.input("c2"), 2.0),
                (self.input("c4"), 4.0),
            ])),
            Some("wavy") => boxed(WavyParaboloid {
                radius_of_curvature: self.input("R"),
                amplitude: self.input("A"),
                wave_number: self.input("k"),
            }),
            Some("Gaussian") => boxed(GaussianDip { length: 1.0 }),
            _ => panic!("{} names no known shape", self.id()),
        }
    }
}

fn boxed<S: Axisymmetric + 'static>(shape: S) -> Box<dyn Axisymmetric> {
    Box::new(shape)
}
