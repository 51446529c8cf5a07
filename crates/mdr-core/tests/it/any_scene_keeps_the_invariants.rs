//! Random bodies, materials and loads over many decades: force and depth belong to each other, more force is more depth,
//! and neither units nor the side of a pressed line matter.

use indenters::{Control, EquivalentLine, PressingLoad};
use mdr_core::{SteadySliding, indent, steady};
use proptest::prelude::*;
use rheology::{Material, Prony};

use crate::support::{
    assert_close, at_depth, body, decades, endless, fixed_cases, load, prony, slid,
};

/// A scene in units of its own: depths, moduli and times are of the order of one.
#[derive(Debug, Clone)]
struct Scene {
    kind: usize,
    size: f64,
    moduli: [f64; 2],
    branches: Vec<(f64, f64)>,
    velocity: f64,
    depth: f64,
}

fn scene() -> impl Strategy<Value = Scene> {
    let or_nothing = || prop_oneof![Just(0.0), decades(2.0)];
    let branches = prop::collection::vec((decades(2.0), decades(4.0)), 0..4);
    let material = ([or_nothing(), or_nothing()], branches);
    let motion = (decades(3.0), decades(1.0));
    // No flat ends, whose friction has no limit on a dashpot, and no equator.
    let parts = (1..4_usize, decades(0.7), material, motion);
    let scene = |(kind, size, (moduli, branches), (velocity, depth))| Scene {
        kind,
        size,
        moduli,
        branches,
        velocity,
        depth,
    };
    parts.prop_map(scene).prop_filter("a material", |scene| {
        scene.moduli.iter().sum::<f64>() > 0.0 || !scene.branches.is_empty()
    })
}

impl Scene {
    fn material(&self, [stress, time]: [f64; 2]) -> Prony {
        let branches = self.branches.iter();
        let branches: Vec<(f64, f64)> = branches.map(|(g, tau)| (g * stress, tau * time)).collect();
        let [spring, dashpot] = self.moduli;
        prony([spring * stress, dashpot * stress * time], &branches)
    }

    /// Slides `depth` deep, in units of length, stress and time.
    fn at_depth(&self, depth: f64, [length, stress, time]: [f64; 3]) -> SteadySliding {
        let body = body(self.kind, self.size, length);
        let motion = at_depth(depth * length, self.velocity * length / time);
        let material = self.material([stress, time]);
        let state = steady(&EquivalentLine(&*body), &material, &motion, 1e-11);
        state.expect("a stationary state")
    }

    /// A force that makes a depth of about that of the scene in the whole time.
    fn pressing_force(&self, time: f64) -> f64 {
        let branches = self.branches.iter();
        let relaxing: f64 = branches.map(|(g, tau)| g * tau.min(time) / time).sum();
        let modulus = self.moduli[0] + self.moduli[1] / time + relaxing;
        4.0 * modulus * self.depth * self.depth.sqrt()
    }
}

/// What is left of force and depth by the relative error 1e-8 of the friction, with a factor of ten, and by 1e-11, between
/// scenes whose polynomials depend on where the range was found.
const STEADY: f64 = 1e-7;
const UNITS: f64 = 1e-10;

proptest! {
    #![proptest_config(fixed_cases(256))]

    /// The force at a depth makes that depth, a deeper line carries more, and units do not matter.
    #[test]
    fn force_and_depth_of_stationary_sliding_belong_to_each_other(
        scene in scene(),
        more in 1.001..2.0_f64,
        units in [decades(9.0), decades(9.0), decades(9.0)],
    ) {
        let state = scene.at_depth(scene.depth, [1.0; 3]);
        let (friction, force) = (state.friction_coefficient.value, state.normal_force.value);
        prop_assert!(friction >= 0.0 && state.contacts.iter().all(|[rear, front]| rear < front), "{state:?}");

        let body = body(scene.kind, scene.size, 1.0);
        let load = load(force, scene.velocity);
        let back = slid(&EquivalentLine(&*body), &scene.material([1.0; 2]), &load);
        assert_close([back.indentation_depth.value, scene.depth], STEADY, 0.0, &scene);
        assert_close([back.normal_force.value, force], STEADY, 0.0, &scene);
        assert_close([back.friction_coefficient.value, friction], STEADY, 0.0, &scene);

        let deeper = scene.at_depth(more * scene.depth, [1.0; 3]).normal_force.value;
        prop_assert!(deeper > force, "{deeper} after {force} at depths of a ratio of {more}");

        let [length, stress, _] = units;
        let other = scene.at_depth(scene.depth, units);
        assert_close([other.friction_coefficient.value, friction], UNITS, 0.0, &scene);
        assert_close([other.normal_force.value / (stress * length * length), force], UNITS, 0.0, &scene);
    }

    /// A force and its depth are one state where nothing relaxes; more force is more depth, and a mirrored line is as deep.
    #[test]
    fn pressing_by_force_and_by_depth_are_the_same(
        scene in scene(),
        slope in 0.1..10.0_f64,
        time in decades(3.0),
        more in 1.001..10.0_f64,
    ) {
        let material = scene.material([1.0; 2]);
        let force = scene.pressing_force(time);
        // A line that rises as a wedge in front and as a parabola behind, or the other way round.
        let press = |side: f64, material: &Prony, control: Control| {
            let line = endless(|x: f64| if side * x > 0.0 { slope * side * x } else { x * x });
            let load = PressingLoad::new(control, time).expect("a load");
            indent(&line, material, &load, 1e-10).expect("an indentation")
        };
        let pressed = press(1.0, &material, Control::NormalForce(force));
        let mirrored = press(-1.0, &material, Control::NormalForce(force));
        let deeper = press(1.0, &material, Control::NormalForce(more * force)).indentation_depth;
        let compliance = material.creep_compliance(time).expect("a compliance");
        let depth = pressed.indentation_depth.value;
        let spring = prony([compliance.recip(), 0.0], &[]);
        let by_depth = press(1.0, &spring, Control::IndentationDepth(depth));
        assert_close([by_depth.normal_force.value, force], 1e-9, 0.0, &scene);
        assert_close([mirrored.indentation_depth.value, depth], 1e-9, 0.0, &scene);
        prop_assert!(deeper.value > depth, "{deeper:?} under {more} times the force of {depth}");
    }
}
