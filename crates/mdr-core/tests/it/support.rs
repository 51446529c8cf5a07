//! Shapes, closed forms and helpers that several claims need.

use std::f64::consts::FRAC_PI_2;

use casebook::Case;
use friction_analytic::{power_sliding, transient_sliding};
use indenters::{PowerProfile, RigidLine, SlidingLoad};
use mdr_core::{SlideOptions, Transient, slide};
use rheology::Viscous;

/// The viscosity, force and speed of casebook FRI-01; their stationary depth is 0.1.
pub(crate) const VISCOSITY: f64 = 50.0;
pub(crate) const DEPTH: f64 = 0.1;

pub(crate) fn material(viscosity: f64) -> Viscous {
    Viscous::new(viscosity).expect("a positive viscosity")
}

pub(crate) fn load(normal_force: f64, velocity: f64) -> SlidingLoad {
    SlidingLoad::new(normal_force, velocity).expect("a positive force and speed")
}

/// The load that gives a line the stationary depth (12) on [`VISCOSITY`].
pub(crate) fn load_for_depth(depth: f64) -> SlidingLoad {
    load(4.0 * VISCOSITY * 0.1 * depth, 0.1)
}

pub(crate) fn power(exponent: f64) -> PowerProfile {
    PowerProfile::new(0.4, exponent).expect("a power profile")
}

/// Friction coefficient (16) of a power profile at the stationary depth (12).
pub(crate) fn power_friction(body: &PowerProfile, depth: f64) -> f64 {
    let stationary = power_sliding(body, &material(VISCOSITY), &load_for_depth(depth));
    stationary
        .expect("a friction coefficient")
        .friction_coefficient
}

pub(crate) fn slide_to(
    line: &(impl RigidLine + ?Sized),
    stationary_depth: f64,
    spacing: f64,
    drift_tolerance: f64,
) -> Transient {
    let options = SlideOptions {
        spacing,
        drift_tolerance,
        max_sliding_distance: 1e5 * spacing,
    };
    slide(
        line,
        &material(VISCOSITY),
        &load_for_depth(stationary_depth),
        &options,
    )
    .expect("a stationary state")
}

/// Orders observed between errors at halved spacings.
pub(crate) fn observed_orders(errors: &[f64]) -> Vec<f64> {
    errors
        .windows(2)
        .map(|pair| (pair[0] / pair[1]).abs().log2())
        .collect()
}

/// A line given at equally spaced nodes, the first at x = 0; between them the nearest node counts.
#[derive(Debug, Clone)]
pub(crate) struct Nodes {
    pub(crate) heights: Vec<f64>,
    pub(crate) spacing: f64,
}

impl RigidLine for Nodes {
    fn height(&self, x: f64) -> f64 {
        let nearest = |k: &usize| (x / self.spacing - *k as f64).abs() <= 0.5;
        let node = (0..self.heights.len()).find(nearest);
        node.map_or(f64::INFINITY, |k| self.heights[k])
    }

    fn slope(&self, _x: f64) -> f64 {
        0.0
    }

    fn domain(&self) -> [f64; 2] {
        [0.0, (self.heights.len() - 1) as f64 * self.spacing]
    }

    fn kinks(&self) -> Vec<f64> {
        let inner = 1..self.heights.len() - 1;
        inner.map(|k| k as f64 * self.spacing).collect()
    }
}

/// The cubic line of casebook FRI-03 on [0, 3], moved towards positive or, mirrored, negative x.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cubic {
    pub(crate) scale: f64,
    pub(crate) mirrored: bool,
}

impl RigidLine for Cubic {
    fn height(&self, x: f64) -> f64 {
        if !(0.0..=3.0).contains(&x) {
            return f64::INFINITY;
        }
        let x = if self.mirrored { 3.0 - x } else { x };
        self.scale * x * (x * x / 3.0 - 1.5 * x + 2.0)
    }

    fn slope(&self, x: f64) -> f64 {
        let (x, sign) = if self.mirrored {
            (3.0 - x, -1.0)
        } else {
            (x, 1.0)
        };
        sign * self.scale * (x - 1.0) * (x - 2.0)
    }

    fn domain(&self) -> [f64; 2] {
        [0.0, 3.0]
    }
}

/// The two bodies of the exact transient, casebook MDR-02.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    Cone,
    Paraboloid,
}

impl Shape {
    pub(crate) fn of(case: &Case) -> Self {
        match case.input_text("shape") {
            "cone" => Self::Cone,
            "paraboloid" => Self::Paraboloid,
            other => panic!("{}: unknown shape {other:?}", case.id()),
        }
    }

    /// The body whose equivalent line is s |x| or k x².
    pub(crate) fn body(self, line_coefficient: f64) -> PowerProfile {
        match self {
            Self::Cone => PowerProfile::cone(line_coefficient / FRAC_PI_2),
            Self::Paraboloid => PowerProfile::paraboloid(0.5 * line_coefficient),
        }
        .expect("a body")
    }

    /// Exact [d/D, μ/μ_∞] after sliding over a distance in stationary contact lengths (MDR-02).
    pub(crate) fn exact(self, distance: f64) -> [f64; 2] {
        // With a depth, a contact length and a speed of one, the time is the distance.
        let (body, material, load) = (self.body(1.0), material(1.0), load(4.0, 1.0));
        let stationary = power_sliding(&body, &material, &load).expect("a stationary state");
        let transient = transient_sliding(&body, &material, &load, distance).expect("a transient");
        [
            transient.indentation_depth / stationary.indentation_depth,
            transient.friction_coefficient / stationary.friction_coefficient,
        ]
    }
}
