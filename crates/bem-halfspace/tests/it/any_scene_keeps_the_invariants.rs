//! Random surfaces, materials and loads over many decades: forces balance, pressure and gap exclude each other, more force
//! is more depth, and neither units (of presses) nor the mirror image matter.

use std::f64::consts::PI;

use bem_halfspace::slide::Transient;
use bem_halfspace::steady::SteadyOptions;
use bem_halfspace::{Control, Convolution, Grid, influence};
use casebook::fixed_cases;
use indenters::Surface;
use proptest::prelude::*;
use rheology::Compressible;

use crate::support::{
    Formula, Pressing, Scene, TIGHT, after, assert_close, assert_near, carried, difference, power,
    prony, slid, squares, under_force,
};

/// One unit of length \[m] and stress \[Pa].
type Units = [f64; 2];

fn decades(n: f64) -> impl Strategy<Value = f64> {
    (-n..n).prop_map(|exponent| 10.0_f64.powf(exponent))
}

fn units() -> impl Strategy<Value = Units> {
    [decades(12.0), decades(12.0)]
}

/// A rough bowl on a grid, in units of its own.
#[derive(Debug, Clone)]
struct Rough {
    shape: [usize; 2],
    aspect: f64,
    heights: Vec<f64>,
    force: f64,
    periodic: bool,
}

fn rough() -> impl Strategy<Value = Rough> {
    let surface = (6..24_usize, 6..24_usize).prop_flat_map(|(rows, columns)| {
        let roughness = prop::collection::vec(0.0..1.0_f64, rows * columns);
        let summit = [0.0..1.0_f64, 0.0..1.0_f64];
        (Just([rows, columns]), roughness, summit)
    });
    let load = (0.5..2.0_f64, decades(3.0), 0.0..2.0_f64, any::<bool>());
    (surface, load).prop_map(
        |((shape, roughness, summit), (aspect, force, rough, periodic))| {
            let height = |(index, noise): (usize, &f64)| {
                let place = [index / shape[1], index % shape[1]];
                let [x, y] =
                    [0, 1].map(|axis| place[axis] as f64 - summit[axis] * shape[axis] as f64);
                0.05 * (x * x + y * y) + rough * noise
            };
            let heights = roughness.iter().enumerate().map(height).collect();
            Rough {
                shape,
                aspect,
                heights,
                force,
                periodic,
            }
        },
    )
}

/// What a residual of 1e-13 leaves of the depth and the pressure on these small grids.
const SAME: f64 = 1e-11;

impl Rough {
    fn body(&self, [length, stress]: Units) -> Pressing {
        let grid = Grid::new(self.shape, [length, self.aspect * length]).expect("a grid");
        let convolution = if self.periodic {
            Convolution::periodic(&grid)
        } else {
            Convolution::new(&grid)
        };
        Pressing {
            convolution,
            heights: self.heights.iter().map(|height| height * length).collect(),
            compliance: 1.0 / stress,
            options: TIGHT,
        }
    }

    /// A field from the other side along x or y.
    fn mirrored(&self, field: &[f64], along_y: bool) -> Vec<f64> {
        let rows = field.chunks(self.shape[1]);
        if along_y {
            rows.flat_map(|row| row.iter().rev()).copied().collect()
        } else {
            rows.rev().flatten().copied().collect()
        }
    }
}

fn largest(values: &[f64]) -> f64 {
    values
        .iter()
        .fold(0.0, |top: f64, value| top.max(value.abs()))
}

proptest! {
    #![proptest_config(fixed_cases(256))]

    #[test]
    fn pressure_balances_the_force_and_excludes_a_gap(scene in rough()) {
        let (contact, state) = scene.body([1.0; 2]).solve(Control::NormalForce(scene.force));
        let sum = state.pressure().iter().sum::<f64>() * scene.aspect;
        assert_close("sum of the pressure", sum, scene.force, 1e-12);
        // What a pressure causes at its own element; a periodic half space moves as much, less the mean.
        let own = influence([0.0, 0.0], [1.0, scene.aspect]) / (4.0 * PI);
        let own = own * largest(state.pressure());
        let allowed = TIGHT.tolerance * largest(state.displacement()).max(own);
        let depth = contact.indentation_depth;
        for (index, (pressure, displacement)) in
            state.pressure().iter().zip(state.displacement()).enumerate()
        {
            let gap = scene.heights[index] + displacement - depth;
            // Rounding of the three terms.
            let allowed = allowed + 8.0 * f64::EPSILON * depth.abs().max(scene.heights[index]);
            prop_assert!(*pressure >= 0.0, "tension {pressure} in element {index}");
            let touches = *pressure > 0.0;
            prop_assert!(
                gap >= -allowed && (!touches || gap <= allowed),
                "gap {gap:e} under pressure {pressure:e} in element {index}, allowed {allowed:e}"
            );
        }
    }

    #[test]
    fn more_force_is_more_depth_from_any_first_guess(scene in rough(), more in 1.01..100.0_f64) {
        let body = scene.body([1.0; 2]);
        let (contact, _) = body.solve(Control::NormalForce(scene.force));
        let (deeper, mut state) = body.solve(Control::NormalForce(more * scene.force));
        let depths = [contact, deeper].map(|contact| contact.indentation_depth);
        prop_assert!(depths[1] > depths[0], "{depths:?} under {more} times the force");
        let again = body.solve_from(&mut state, Control::NormalForce(scene.force));
        let scale = largest(&scene.heights).max(depths[0].abs());
        let depth = again.expect("a contact").indentation_depth;
        assert_near("from above", depth, depths[0], SAME * scale);
    }

    #[test]
    fn contacts_have_neither_units_nor_a_preferred_side(
        scene in rough(), units in units(), along_y in any::<bool>(),
    ) {
        let [length, stress] = units;
        let (contact, state) = scene.body([1.0; 2]).solve(Control::NormalForce(scene.force));
        let force = scene.force * stress * length * length;
        let (other, scaled) = scene.body(units).solve(Control::NormalForce(force));
        let heights = scene.mirrored(&scene.heights, along_y);
        let behind = Rough { heights, ..scene.clone() }.body([1.0; 2]);
        let (from_behind, mirrored) = behind.solve(Control::NormalForce(scene.force));
        let scale = largest(&scene.heights).max(contact.indentation_depth.abs());
        for depth in [other.indentation_depth / length, from_behind.indentation_depth] {
            assert_near("depth", depth, contact.indentation_depth, SAME * scale);
        }
        let in_units: Vec<f64> = scaled.pressure().iter().map(|p| p / stress).collect();
        for same in [in_units, scene.mirrored(mirrored.pressure(), along_y)] {
            let error = difference(&same, state.pressure());
            prop_assert!(error <= SAME, "pressures differ by {error:e}");
        }
    }
}

/// A power profile on a material that is not only a spring: the contact is about one long.
fn sliding() -> impl Strategy<Value = Scene<Compressible>> {
    let body = (0.9..3.0_f64, decades(2.0));
    let branches = prop::collection::vec((decades(1.0), decades(1.0)), 0..3);
    let modulus = || prop_oneof![Just(0.0), decades(1.0)];
    let moduli = [modulus(), modulus()];
    (body, moduli, branches, -0.5..=0.5_f64, decades(1.0))
        .prop_filter("not a spring", |(_, [_, viscosity], branches, ..)| {
            *viscosity > 0.0 || !branches.is_empty()
        })
        .prop_map(|((exponent, slope), moduli, branches, ratio, velocity)| {
            let in_branch = |(modulus, tau): &(f64, f64)| {
                let product = tau * velocity;
                modulus * product / (1.0 + product)
            };
            // The modulus at the frequency of a contact of length one.
            let of_branches: f64 = branches.iter().map(in_branch).sum();
            let modulus = moduli[0] + moduli[1] * velocity + of_branches;
            let material = Compressible::new(&prony(moduli, &branches), ratio);
            Scene::new(
                power(slope, exponent),
                material.expect("a Poisson ratio"),
                under_force(slope * modulus, velocity),
            )
        })
}

/// A few steps from first touch on, of a body without symmetry or its mirror image in y (handedness −1).
fn transient(scene: &Scene<Compressible>, handedness: f64) -> Transient {
    let skewed = |[x, y]: [f64; 2]| [x + 0.4 * handedness * y, 1.3 * handedness * y];
    let gradient = |position| {
        let [along, across] = scene.body.gradient(skewed(position));
        [along, handedness * (0.4 * along + 1.3 * across)]
    };
    let body = Formula::new(|position| scene.body.height(skewed(position)), gradient);
    let half_width = scene.footprint().x[1];
    let mut options = squares(half_width / 8.0, 2.0 * half_width);
    options.contact.tolerance = 1e-11;
    let load = after(scene.load, 0.5 * half_width);
    slid(&body, &scene.material, &load, &options)
}

proptest! {
    #![proptest_config(fixed_cases(24))]

    #[test]
    fn stationary_sliding_is_in_balance_and_symmetric(
        scene in sliding(), x in -0.5..0.5_f64,
        y in prop_oneof![Just(0.0), Just(0.5), -0.5..0.5_f64],
    ) {
        let state = scene.steady_on(&SteadyOptions {
            phase: [x, y],
            ..scene.steady_options(8.0 / 3.0_f64.sqrt())
        });
        prop_assert!(state.residual <= 1e-10, "residual {:e}", state.residual);
        let force = scene.load.normal_force().expect("a force");
        assert_close("force", carried(&state.pressure), force, 1e-12);
        // Without a rear part the two are one sum.
        let bound = state.mean_slope * (1.0 + 1e-12);
        prop_assert!(
            state.friction_coefficient > 0.0 && state.friction_coefficient <= bound,
            "{} above {}", state.friction_coefficient, state.mean_slope
        );
        let columns = state.pressure.grid.shape()[1];
        for row in state.pressure.pressure.chunks(columns).filter(|_| [0.0, 0.5].contains(&y)) {
            let mirrored = row.iter().rev();
            prop_assert!(row.iter().eq(mirrored), "half of a symmetric scene stands for both");
        }
    }

    #[test]
    fn a_march_is_in_balance_and_its_mirror_image_has_the_same_friction(scene in sliding()) {
        let force = scene.load.normal_force().expect("a force");
        let [right, left] = [1.0, -1.0].map(|side| transient(&scene, side));
        for march in [&right, &left] {
            assert_close("force", carried(&march.pressure), force, 1e-11);
        }
        let [right, left] = [right.last(), left.last()];
        let friction = right.friction_coefficient;
        assert_close("mirror image", left.friction_coefficient, friction, 1e-7);
        assert_near("side", left.contact_y[1], -right.contact_y[0], 1e-12);
    }
}
