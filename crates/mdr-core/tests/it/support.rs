//! Shapes, closed forms and helpers that several claims need.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Debug;

use casebook::Case;
use friction_analytic::{power_sliding, transient_sliding};
use indenters::{
    Axisymmetric, Control, FlatCone, Hyperboloid, PowerProfile, PowerTerm, RigidLine,
    RoundTippedCone, SlidingLoad, Sphere, Superposition, TruncatedParaboloid, stretch,
};
use mdr_core::{
    IndentRow, IndentStep, MdrError, SlideOptions, Transient, indent_history, slide_on_grid,
};
use rheology::{Material, Prony, RelaxationBranch, RelaxationSpectrum, Viscous};

/// The viscosity, force and speed of casebook FRI-01; their stationary depth is 0.1.
pub(crate) const VISCOSITY: f64 = 50.0;
pub(crate) const DEPTH: f64 = 0.1;

/// Relative error asked of stationary states.
pub(crate) const ASKED: f64 = 1e-8;

pub(crate) fn at_depth(indentation_depth: f64, velocity: f64) -> SlidingLoad {
    SlidingLoad::at_depth(indentation_depth, velocity).expect("a positive depth and speed")
}

/// Presses with a constant force up to some times.
pub(crate) fn indent(
    line: &(impl RigidLine + ?Sized),
    material: &(impl Material + ?Sized),
    force: f64,
    times: &[f64],
    spacing: f64,
) -> Result<Vec<IndentRow>, MdrError> {
    let step = |time: &f64| IndentStep {
        time: *time,
        control: Control::NormalForce(force),
    };
    let steps: Vec<IndentStep> = times.iter().map(step).collect();
    indent_history(line, material, &steps, spacing)
}

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
    slide_on_grid(
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

/// A generalised Maxwell material.
pub(crate) fn prony([equilibrium_modulus, viscosity]: [f64; 2], branches: &[(f64, f64)]) -> Prony {
    let branches = branches.iter().map(|(modulus, time)| RelaxationBranch {
        modulus: *modulus,
        relaxation_time: *time,
    });
    let relaxation = RelaxationSpectrum::new(equilibrium_modulus, viscosity, branches.collect())
        .expect("moduli");
    Prony::new(relaxation).expect("a material")
}

/// The materials that the casebook names.
pub(crate) fn model(name: &str) -> Prony {
    match name {
        "elastic" => prony([1e6, 0.0], &[]),
        "viscous" => prony([0.0, 2e4], &[]),
        "KV" => prony([1e6, 2e4], &[]),
        "Maxwell" => prony([0.0, 0.0], &[(1e6, 0.02)]),
        "SLS" => prony([0.1, 0.0], &[(1.0, 1.0)]),
        "W4" => prony([1.0, 0.0], &[(2.0, 10.0), (5.0, 1.0), (10.0, 0.1)]),
        "P3" => prony([1e5, 0.0], &[(5e8, 1e-6), (2e7, 0.01), (3e5, 1e3)]),
        "P10" => {
            let moduli = [3e8, 2.5e8, 1.8e8, 9e7, 3e7, 8e6, 2e6, 6e5, 2e5, 5e4];
            let times = (0..10).map(|k| 10.0_f64.powf(-8.0 + 1.5 * f64::from(k)));
            let branches: Vec<(f64, f64)> = moduli.into_iter().zip(times).collect();
            prony([2e5, 0.0], &branches)
        }
        other => panic!("unknown model {other:?}"),
    }
}

/// A material of twenty branches over twelve decades, a relaxation modulus that falls like a power of time.
pub(crate) fn twenty_branches() -> Prony {
    let branches: Vec<(f64, f64)> = (0..20)
        .map(|k| 12.0 * f64::from(k) / 19.0)
        .map(|decades| {
            (
                1e9 * 10.0_f64.powf(-0.3 * decades),
                1e-9 * 10.0_f64.powf(decades),
            )
        })
        .collect();
    prony([1e5, 0.0], &branches)
}

/// Everything a case says about its body; the line of a power is given by its own coefficient.
pub(crate) fn body_of(case: &Case) -> Box<dyn Axisymmetric> {
    let shape = match case.input_text("shape") {
        "" if case.id().contains("cone") => "cone",
        "" => "paraboloid",
        shape => shape,
    };
    let line_power = |p: f64| PowerProfile::new(0.5 / stretch(p).expect("p"), p).expect("a power");
    match shape {
        "cone" => Box::new(Shape::Cone.body(case.input("s"))),
        "paraboloid" if case.has_input("R") => {
            Box::new(Shape::Paraboloid.body(case.input("R").recip()))
        }
        "paraboloid" => Box::new(Shape::Paraboloid.body(case.input("k"))),
        "sphere" => Box::new(Sphere::new(case.input("R")).expect("a sphere")),
        "round-tipped cone" => {
            let (tip, slope) = (case.input("b"), case.input("tan_theta"));
            Box::new(RoundTippedCone::new(tip, slope).expect("a cone"))
        }
        "hyperboloid" => {
            let tip = case.input("b");
            Box::new(Hyperboloid::new(tip, case.input("L") / tip).expect("a hyperboloid"))
        }
        "polynomial c1 r + c2 r^2 + c4 r^4" => {
            let term = |(name, exponent)| PowerTerm {
                coefficient: case.input(name),
                exponent,
            };
            let terms = [("c1", 1.0), ("c2", 2.0), ("c4", 4.0)].map(term);
            Box::new(Superposition::new(terms.to_vec()).expect("a sum of powers"))
        }
        "power p=0.4" => Box::new(line_power(0.4)),
        "power p=0.5" => Box::new(line_power(0.5)),
        // The group states both in words: t = 0.3, R = 2, b = 0.5.
        "flat-ended cone" => Box::new(FlatCone::new(0.5, 0.3).expect("a flat cone")),
        "truncated paraboloid" => {
            Box::new(TruncatedParaboloid::new(0.5, 0.25).expect("a paraboloid"))
        }
        other => panic!("{}: unknown shape {other:?}", case.id()),
    }
}

/// The foundation of a case of MDR-03 to MDR-08.
pub(crate) fn foundation_of(case: &Case) -> Box<dyn Material> {
    let prony = match case.id().split('/').next() {
        Some("MDR-03") => prony([case.input("G"), case.input("eta")], &[]),
        Some("MDR-04") => prony([0.0; 2], &[(case.input("G"), case.input("tau"))]),
        Some("MDR-05" | "MDR-08" | "EXT-04") => {
            let branch = (case.input("G2"), case.input("tau"));
            prony([case.input("G1"), 0.0], &[branch])
        }
        _ => model(case.input_text("model")),
    };
    Box::new(prony)
}

/// Asserts that two numbers agree relative to the second one or, where that is smaller, to a scale.
pub(crate) fn assert_close(
    [actual, expected]: [f64; 2],
    tolerance: f64,
    scale: f64,
    context: &dyn Debug,
) {
    let difference = (actual - expected).abs();
    assert!(
        difference <= tolerance * expected.abs().max(scale),
        "{actual:e} instead of {expected:e}, off by {difference:e}: {context:?}"
    );
}
