//! Materials, loads, lines, marches and comparisons that several claims need.

use std::fmt::Debug;

use casebook::{Case, standard_solid};
pub(crate) use casebook::{decades, fixed_cases, prony};
use friction_analytic::power_sliding;
use indenters::{
    Axisymmetric, Control, FlatCone, HistoryPoint, Hyperboloid, PowerProfile, RigidLine,
    RoundTippedCone, SlidingLoad, Sphere, TruncatedParaboloid, stretch,
};
use mdr_core::{MdrError, Sliding, SlidingStep, SteadySliding, slide, steady};
use numerics::{Accuracy, Estimate};
use rheology::{Material, Prony, Viscous};

/// The viscosity, force and speed of casebook FRI-01; their stationary depth is 0.1.
pub(crate) const VISCOSITY: f64 = 50.0;
pub(crate) const DEPTH: f64 = 0.1;

/// Relative error asked of stationary states.
pub(crate) const ASKED: f64 = 1e-8;

pub(crate) fn load(normal_force: f64, velocity: f64) -> SlidingLoad {
    SlidingLoad::new(normal_force, velocity).expect("a positive force and speed")
}

pub(crate) fn at_depth(indentation_depth: f64, velocity: f64) -> SlidingLoad {
    SlidingLoad::at_depth(indentation_depth, velocity).expect("a positive depth and speed")
}

/// The load that gives a line the stationary depth (12) on [`VISCOSITY`].
pub(crate) fn load_for_depth(depth: f64) -> SlidingLoad {
    load(4.0 * VISCOSITY * 0.1 * depth, 0.1)
}

pub(crate) fn material(viscosity: f64) -> Viscous {
    Viscous::new(viscosity).expect("a positive viscosity")
}

pub(crate) fn power(exponent: f64) -> PowerProfile {
    PowerProfile::new(0.4, exponent).expect("a power profile")
}

/// The power profile whose equivalent line is `coefficient` |x|^p.
pub(crate) fn line_power(coefficient: f64, exponent: f64) -> PowerProfile {
    let stretch = stretch(exponent).expect("an exponent");
    PowerProfile::new(coefficient / stretch, exponent).expect("a power profile")
}

/// A history of times and forces, or depths.
pub(crate) fn history(
    points: impl IntoIterator<Item = [f64; 2]>,
    control: fn(f64) -> Control,
) -> Vec<HistoryPoint> {
    let point = |[time, value]: [f64; 2]| HistoryPoint {
        time,
        control: control(value),
    };
    points.into_iter().map(point).collect()
}

/// Bodies of six kinds; the last two have a flat end, and so has no other one friction without limit on a dashpot.
pub(crate) fn body(kind: usize, size: f64, unit: f64) -> Box<dyn Axisymmetric> {
    let radius = size * unit;
    match kind {
        0 => Box::new(Sphere::new((1.0 + size) * unit).expect("a sphere")),
        1 => {
            let exponent = 0.7 + 3.3 * size / (1.0 + size);
            Box::new(PowerProfile::new(unit.powf(1.0 - exponent), exponent).expect("a power"))
        }
        2 => Box::new(Hyperboloid::new(radius, 0.7).expect("a hyperboloid")),
        3 => Box::new(RoundTippedCone::new(radius, 0.7).expect("a cone")),
        4 => Box::new(FlatCone::new(radius, 0.7).expect("a cone")),
        _ => Box::new(TruncatedParaboloid::new(radius, 0.7 / unit).expect("a paraboloid")),
    }
}

/// A line given by its heights alone: what is claimed of it does not depend on its slope.
pub(crate) struct Line<H> {
    pub(crate) height: H,
    pub(crate) domain: [f64; 2],
    pub(crate) kinks: Vec<f64>,
}

/// A line without kinks.
pub(crate) fn line<H: Fn(f64) -> f64>(domain: [f64; 2], height: H) -> Line<H> {
    Line {
        height,
        domain,
        kinks: Vec::new(),
    }
}

/// An infinite line.
pub(crate) fn endless<H: Fn(f64) -> f64>(height: H) -> Line<H> {
    line([f64::NEG_INFINITY, f64::INFINITY], height)
}

impl<H: Fn(f64) -> f64> RigidLine for Line<H> {
    fn height(&self, x: f64) -> f64 {
        let [rear, front] = self.domain;
        if x < rear || x > front {
            return f64::INFINITY;
        }
        (self.height)(x)
    }

    fn slope(&self, _x: f64) -> f64 {
        0.0
    }

    fn domain(&self) -> [f64; 2] {
        self.domain
    }

    fn kinks(&self) -> Vec<f64> {
        self.kinks.clone()
    }
}

/// Friction coefficient (16) of a power profile at the stationary depth (12).
pub(crate) fn power_friction(body: &PowerProfile, depth: f64) -> f64 {
    let stationary = power_sliding(body, &material(VISCOSITY), &load_for_depth(depth));
    stationary.expect("a closed form").friction_coefficient
}

/// Sliding from first touch on [`VISCOSITY`] to the depth (12), with a number of elements along the contact.
pub(crate) fn slide_to(
    line: &dyn RigidLine,
    depth: f64,
    elements: usize,
) -> Result<Sliding, MdrError> {
    let (dashpot, load) = (material(VISCOSITY), load_for_depth(depth));
    slide(line, &dashpot, &load, Accuracy::Elements(elements))
}

/// Sliding from first touch into the stationary state, with a number of elements along the contact.
pub(crate) fn march(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &SlidingLoad,
    elements: usize,
) -> Sliding {
    slide(line, material, load, Accuracy::Elements(elements)).expect("a stationary state")
}

/// The last step of a motion.
pub(crate) fn last(sliding: &Sliding) -> SlidingStep {
    *sliding.steps.last().expect("a step")
}

/// The stationary state, directly.
pub(crate) fn slid(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &SlidingLoad,
) -> SteadySliding {
    steady(line, material, load, ASKED).expect("a stationary state")
}

/// Asserts that errors at halved spacings fall with a power of the spacing, from each to the next.
pub(crate) fn assert_order(errors: &[f64], expected: f64, context: &dyn Debug) {
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).abs().log2();
        assert!(
            (order - expected).abs() < 0.15,
            "order {order} instead of {expected}, errors {errors:?}: {context:?}"
        );
    }
}

/// Asserts that two numbers agree relative to the second one or, where that is smaller, to a scale.
pub(crate) fn assert_close(
    [actual, expected]: [f64; 2],
    tolerance: f64,
    scale: f64,
    context: &dyn Debug,
) {
    let expected = Estimate::new(expected, tolerance * expected.abs().max(scale));
    assert_agree([Estimate::exact(actual), expected], context);
}

/// Asserts that two numbers agree within the sum of their errors.
pub(crate) fn assert_agree([actual, expected]: [Estimate; 2], context: &dyn Debug) {
    let difference = (actual.value - expected.value).abs();
    assert!(
        difference <= actual.error + expected.error,
        "{actual:?} instead of {expected:?}, off by {difference:e}: {context:?}"
    );
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
        other => casebook::model(other),
    }
}

/// The material of a case: a model by its name, a spring, a dashpot and branches, or what is known of its group.
pub(crate) fn material_of(case: &Case) -> Box<dyn Material> {
    Box::new(match case.id().split('/').next() {
        Some("MDR-03") => prony([case.input("G"), case.input("eta")], &[]),
        Some("MDR-04") => prony([0.0; 2], &[(case.input("G"), case.input("tau"))]),
        _ if case.has_input("G2") => {
            let [spring, branch, time] = ["G1", "G2", "tau"].map(|name| case.input(name));
            let solid = standard_solid([spring, branch, branch * time]);
            return Box::new(solid.expect("a solid"));
        }
        _ if case.has_input("Ge") => case.material(),
        _ => model(case.input_text("model")),
    })
}

/// Everything a case says about its body; the line of a power is given by its own coefficient.
pub(crate) fn body_of(case: &Case) -> Box<dyn Axisymmetric> {
    let input = |name| case.input(name);
    match case.input_text("shape") {
        "cone" => Box::new(line_power(input("s"), 1.0)),
        "" if case.has_input("s") => Box::new(line_power(input("s"), 1.0)),
        "" | "paraboloid" if case.has_input("R") => Box::new(line_power(input("R").recip(), 2.0)),
        "" | "paraboloid" => Box::new(line_power(input("k"), 2.0)),
        "power p=0.4" => Box::new(line_power(0.5, 0.4)),
        "power p=0.5" => Box::new(line_power(0.5, 0.5)),
        // The groups state both in words: t = 0.3, R = 2, b = 0.5.
        "flat-ended cone" => Box::new(FlatCone::new(0.5, 0.3).expect("a flat cone")),
        "truncated paraboloid" => {
            Box::new(TruncatedParaboloid::new(0.5, 0.25).expect("a paraboloid"))
        }
        _ => case.body(),
    }
}

/// The friction, force and ends of a state, each with its name.
pub(crate) fn named(state: &SteadySliding) -> [(&'static str, Estimate); 5] {
    [
        ("mu", state.friction_coefficient),
        ("d", state.indentation_depth),
        ("F", state.normal_force),
        ("x_l", state.ends[0]),
        ("x_r", state.ends[1]),
    ]
}
