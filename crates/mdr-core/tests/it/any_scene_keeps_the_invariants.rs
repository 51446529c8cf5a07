//! Random bodies, materials and loads over many decades: force and depth belong to each other, more force is more depth,
//! and neither units nor the side of a pressed line matter.

use indenters::{
    Axisymmetric, Control, EquivalentLine, Hyperboloid, PowerProfile, RigidLine, RoundTippedCone,
};
use mdr_core::{IndentRow, IndentStep, SteadySliding, indent_history, steady};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use rheology::Prony;

use crate::support::{ASKED, assert_close, at_depth, indent, load, prony};

/// One unit of length \[m], stress \[Pa] and time \[s].
type Units = [f64; 3];

/// A scene in units of its own: depths, moduli and times are of the order of one.
#[derive(Debug, Clone)]
struct Scene {
    body: Body,
    equilibrium_modulus: f64,
    viscosity: f64,
    branches: Vec<(f64, f64)>,
    velocity: f64,
    depth: f64,
}

#[derive(Debug, Clone, Copy)]
enum Body {
    Power(f64),
    Hyperboloid(f64),
    RoundTippedCone(f64),
}

/// A length, modulus or time between 10^-n and 10^n.
fn decades(n: f64) -> impl Strategy<Value = f64> {
    (-n..n).prop_map(|exponent| 10.0_f64.powf(exponent))
}

fn or_nothing(value: impl Strategy<Value = f64>) -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), value]
}

fn body() -> impl Strategy<Value = Body> {
    prop_oneof![
        (0.7..4.0_f64).prop_map(Body::Power),
        (0.2..5.0_f64).prop_map(Body::Hyperboloid),
        (0.2..5.0_f64).prop_map(Body::RoundTippedCone),
    ]
}

fn scene() -> impl Strategy<Value = Scene> {
    let moduli = (or_nothing(decades(2.0)), or_nothing(decades(2.0)));
    let branches = prop::collection::vec((decades(2.0), decades(4.0)), 0..4);
    let motion = (decades(3.0), decades(1.0));
    (body(), moduli, branches, motion)
        .prop_map(
            |(body, (equilibrium_modulus, viscosity), branches, (velocity, depth))| Scene {
                body,
                equilibrium_modulus,
                viscosity,
                branches,
                velocity,
                depth,
            },
        )
        .prop_filter("a material", |scene| {
            scene.equilibrium_modulus + scene.viscosity > 0.0 || !scene.branches.is_empty()
        })
}

fn units() -> impl Strategy<Value = Units> {
    [decades(9.0), decades(9.0), decades(9.0)]
}

impl Scene {
    fn body(&self, length: f64) -> Box<dyn Axisymmetric> {
        match self.body {
            Body::Power(p) => {
                Box::new(PowerProfile::new(length.powf(1.0 - p), p).expect("a power"))
            }
            Body::Hyperboloid(tip) => {
                Box::new(Hyperboloid::new(tip * length, 0.7).expect("a hyperboloid"))
            }
            Body::RoundTippedCone(tip) => {
                Box::new(RoundTippedCone::new(tip * length, 0.7).expect("a cone"))
            }
        }
    }

    fn material(&self, stress: f64, time: f64) -> Prony {
        let branches: Vec<(f64, f64)> = self
            .branches
            .iter()
            .map(|(modulus, tau)| (modulus * stress, tau * time))
            .collect();
        prony(
            [
                self.equilibrium_modulus * stress,
                self.viscosity * stress * time,
            ],
            &branches,
        )
    }

    /// Slides `depth` deep.
    fn at_depth(&self, depth: f64, [length, stress, time]: Units) -> SteadySliding {
        let body = self.body(length);
        let motion = at_depth(depth * length, self.velocity * length / time);
        let material = self.material(stress, time);
        steady(&EquivalentLine(&*body), &material, &motion, ASKED).expect("a stationary state")
    }
}

fn close(actual: f64, expected: f64, tolerance: f64, scene: &Scene) {
    assert_close([actual, expected], tolerance, 0.0, scene);
}

/// A line that rises as a wedge in front and as a parabola behind, or the other way round.
#[derive(Debug, Clone, Copy)]
struct Lopsided {
    slope: f64,
    mirrored: bool,
}

impl RigidLine for Lopsided {
    fn height(&self, x: f64) -> f64 {
        let x = if self.mirrored { -x } else { x };
        if x > 0.0 { self.slope * x } else { x * x }
    }

    fn slope(&self, x: f64) -> f64 {
        let sign = if self.mirrored { -1.0 } else { 1.0 };
        let x = sign * x;
        sign * if x > 0.0 { self.slope } else { 2.0 * x }
    }

    fn domain(&self) -> [f64; 2] {
        [f64::NEG_INFINITY, f64::INFINITY]
    }

    fn kinks(&self) -> Vec<f64> {
        vec![0.0]
    }
}

fn fixed_cases() -> ProptestConfig {
    ProptestConfig {
        cases: 256,
        rng_seed: RngSeed::Fixed(2014),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// What is left of force and depth by the default relative error 1e-8 of the friction, with a factor of ten.
const STEADY: f64 = 1e-7;

proptest! {
    #![proptest_config(fixed_cases())]

    #[test]
    fn the_force_at_a_depth_makes_that_depth(scene in scene()) {
        let units = [1.0; 3];
        let state = scene.at_depth(scene.depth, units);
        let body = scene.body(1.0);
        let material = scene.material(1.0, 1.0);
        let load = load(state.normal_force.value, scene.velocity);
        let back = steady(&EquivalentLine(&*body), &material, &load, ASKED);
        let back = back.expect("a stationary state");
        close(back.indentation_depth.value, scene.depth, STEADY, &scene);
        close(back.normal_force.value, state.normal_force.value, STEADY, &scene);
        close(back.friction_coefficient.value, state.friction_coefficient.value, STEADY, &scene);
        prop_assert!(state.friction_coefficient.value >= 0.0, "{state:?}");
        for [rear, front] in &state.contacts {
            prop_assert!(rear < front, "{state:?}");
        }
    }

    #[test]
    fn a_deeper_line_carries_more(scene in scene(), more in 1.001..2.0_f64) {
        let forces = [1.0, more].map(|factor| scene.at_depth(factor * scene.depth, [1.0; 3]).normal_force.value);
        prop_assert!(forces[1] > forces[0], "{forces:?} at depths of a ratio of {more}");
    }

    #[test]
    fn stationary_sliding_has_no_units(scene in scene(), units in units()) {
        let [length, stress, _] = units;
        let expected = scene.at_depth(scene.depth, [1.0; 3]);
        let actual = scene.at_depth(scene.depth, units);
        close(actual.friction_coefficient.value, expected.friction_coefficient.value, STEADY, &scene);
        close(actual.normal_force.value / (stress * length * length), expected.normal_force.value, STEADY, &scene);
    }

    /// Force by force and depth by depth are one history; more force is more depth, and a mirrored line is as deep.
    #[test]
    fn pressing_by_force_and_by_depth_are_the_same(
        scene in scene(),
        slope in 0.1..10.0_f64,
        steps in prop::collection::vec(decades(3.0), 1..5),
        more in 1.001..10.0_f64,
    ) {
        let material = scene.material(1.0, 1.0);
        let line = Lopsided { slope, mirrored: false };
        let times: Vec<f64> = steps
            .iter()
            .scan(0.0, |time, step| {
                *time += step;
                Some(*time)
            })
            .collect();
        let force = pressing_force(&scene, times[times.len() - 1]);
        let spacing = 0.01 * scene.depth.min(scene.depth.sqrt());
        let press = |line: &Lopsided, force: f64| {
            indent(line, &material, force, &times, spacing).expect("an indentation")
        };
        let rows = press(&line, force);
        let history: Vec<IndentStep> = rows.iter().map(held).collect();
        let by_depth = indent_history(&line, &material, &history, spacing).expect("an indentation");
        let mirrored = press(&Lopsided { slope, mirrored: true }, force);
        let deeper = press(&line, more * force);
        for (index, row) in rows.iter().enumerate() {
            // A sum over at most a few thousand elements, whose creep is exact.
            close(row.normal_force, force, 1e-10, &scene);
            close(by_depth[index].normal_force, force, 1e-8, &scene);
            close(mirrored[index].indentation_depth, row.indentation_depth, 1e-10, &scene);
            prop_assert!(
                deeper[index].indentation_depth > row.indentation_depth,
                "{:?} under {more} times the force of {row:?}", deeper[index]
            );
        }
    }
}

fn held(row: &IndentRow) -> IndentStep {
    IndentStep {
        time: row.time,
        control: Control::IndentationDepth(row.indentation_depth),
    }
}

/// A force that makes a depth of about that of the scene in the whole time.
fn pressing_force(scene: &Scene, time: f64) -> f64 {
    let branches: f64 = scene
        .branches
        .iter()
        .map(|(modulus, tau)| modulus * tau.min(time) / time)
        .sum();
    let modulus = scene.equilibrium_modulus + scene.viscosity / time + branches;
    4.0 * modulus * scene.depth * scene.depth.sqrt()
}
