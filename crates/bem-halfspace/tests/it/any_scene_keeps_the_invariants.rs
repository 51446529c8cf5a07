//! Random surfaces, materials and loads over many decades: forces balance, pressure and gap exclude each other, more force
//! is more depth, and neither units (of presses) nor the mirror image matter.

use std::f64::consts::PI;

use bem_halfspace::slide::Transient;
use bem_halfspace::steady::SteadyOptions;
use bem_halfspace::{ContactOptions, Control, Convolution, Grid, influence};
use casebook::{decades, fixed_cases};
use indenters::Surface;
use proptest::prelude::*;
use rheology::Compressible;

use crate::support::{
    Formula, Pressing, Scene, TIGHT, after, assert_close, assert_near, carried, difference, power,
    prony, slid, squares, under_force,
};

/// One unit of length \[m] and stress \[Pa].
type Units = [f64; 2];

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
    (surface, load).prop_map(|(surface, (aspect, force, rough, periodic))| {
        let (shape, roughness, summit) = surface;
        let height = |(index, noise): (usize, &f64)| {
            let x = (index / shape[1]) as f64 - summit[0] * shape[0] as f64;
            let y = (index % shape[1]) as f64 - summit[1] * shape[1] as f64;
            0.05 * (x * x + y * y) + rough * noise
        };
        Rough {
            shape,
            aspect,
            heights: roughness.iter().enumerate().map(height).collect(),
            force,
            periodic,
        }
    })
}

/// Relative error of depth and pressure by a residual of 1e-13 on these small grids.
const RELATIVE_ERROR: f64 = 1e-11;

impl Rough {
    fn body(&self, [length, stress]: Units) -> Pressing {
        let grid = Grid::new(self.shape, [length, self.aspect * length]).expect("a grid");
        let kinds = [Convolution::new, Convolution::periodic];
        Pressing {
            convolution: kinds[usize::from(self.periodic)](&grid),
            heights: self.heights.iter().map(|height| height * length).collect(),
            largest_pressure: f64::INFINITY,
            compliance: 1.0 / stress,
            options: TIGHT,
        }
    }

    /// A field reversed along x or y.
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
    values.iter().fold(0.0, |top, value| value.abs().max(top))
}

/// The pressure satisfies the control and is nowhere tensile; the gap is zero under it and nowhere negative.
#[track_caller]
fn assert_solved(body: &Pressing, control: Control) {
    let (contact, state) = body.solve(control);
    let (grid, depth) = (body.convolution.grid(), contact.indentation_depth);
    let sum = state.pressure().iter().sum::<f64>() * grid.element_area();
    assert_close("sum of the pressure", sum, contact.normal_force, 1e-12);
    let (got, asked) = match control {
        Control::NormalForce(force) => (contact.normal_force, force),
        Control::IndentationDepth(asked) => (depth, asked),
    };
    assert_close(control, got, asked, 1e-12);
    // Diagonal coefficient; on a periodic half space the same less the mean.
    let own = influence([0.0, 0.0], grid.spacing()) / (4.0 * PI);
    let own = body.compliance * own * largest(state.pressure());
    let allowed = body.options.tolerance * largest(state.displacement()).max(own);
    let fields = state.pressure().iter().zip(state.displacement());
    for (height, (pressure, displacement)) in body.heights.iter().zip(fields) {
        let gap = height + displacement - depth;
        // Rounding of the three terms.
        let allowed = allowed + 8.0 * f64::EPSILON * depth.abs().max(*height);
        // No tension.
        let free_or_touched = *pressure == 0.0 || gap <= allowed;
        let holds = *pressure >= 0.0 && gap >= -allowed && free_or_touched;
        assert!(holds, "{control:?}: gap {gap:e}, {pressure:e}, {allowed:e}");
    }
}

/// A body over `n` × `n` elements of edges 1 and `aspect`, solved as by default.
fn over(n: usize, aspect: f64, height: impl Fn([f64; 2]) -> f64) -> Pressing {
    let grid = Grid::new([n; 2], [1.0, aspect]).expect("a grid");
    Pressing {
        options: ContactOptions::default(),
        ..Pressing::new(Convolution::new(&grid), height)
    }
}

/// Squared distance from the middle of `n` × `n` elements, in elements.
fn bowl(n: usize) -> impl Fn([f64; 2]) -> f64 {
    let middle = 0.5 * (n as f64 - 1.0);
    move |element| {
        let [x, y] = element.map(|index| index - middle);
        x * x + y * y
    }
}

#[test]
fn one_element_a_full_box_and_slender_contacts_are_solved() {
    for decade in -12..=12 {
        let force = Control::NormalForce(10_f64.powi(decade));
        assert_solved(&over(33, 1.0, bowl(33)), force);
    }
    for decade in -4..=4 {
        let depth = Control::IndentationDepth(300.0);
        assert_solved(&over(48, 10_f64.powi(decade), bowl(48)), depth);
    }
}

/// Summits of different heights on a lattice, all of which touch.
#[test]
fn up_to_4096_patches_are_solved() {
    for along in [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 45.0, 64.0] {
        let waves = PI * along / 128.0;
        let height = |element: [f64; 2]| {
            let [x, y] = element.map(|index| waves * (index + 0.5));
            let uneven = 0.1 * (1.0 + (7.3 * (x / 3.1).floor() + 3.7 * y).sin());
            1.0 - (x.sin() * y.sin()).powi(2) + uneven
        };
        assert_solved(&over(128, 1.0, height), Control::IndentationDepth(0.6));
    }
}

/// Gaps are known up to the rounding of the heights.
#[test]
fn heights_far_above_what_the_pressure_moves_are_solved() {
    for decade in 0..=12 {
        let height = 10_f64.powi(decade);
        let mut body = over(17, 1.0, |element| height + 0.01 * bowl(17)(element));
        body.options.tolerance = (64.0 * f64::EPSILON * height).clamp(1e-9, 1e-2);
        assert_solved(&body, Control::NormalForce(10.0));
    }
}

proptest! {
    #![proptest_config(fixed_cases(256))]

    #[test]
    fn pressure_excludes_a_gap_and_more_force_is_more_depth_from_any_first_guess(
        scene in rough(), more in 1.01..100.0_f64,
    ) {
        let body = scene.body([1.0; 2]);
        assert_solved(&body, Control::NormalForce(scene.force));
        let (contact, _) = body.solve(Control::NormalForce(scene.force));
        let (deeper, mut state) = body.solve(Control::NormalForce(more * scene.force));
        let depths = [contact, deeper].map(|contact| contact.indentation_depth);
        prop_assert!(depths[1] > depths[0], "{depths:?} under {more} times the force");
        let again = body.solve_from(&mut state, Control::NormalForce(scene.force));
        let scale = largest(&scene.heights).max(depths[0].abs());
        let depth = again.expect("a contact").indentation_depth;
        assert_near("from above", depth, depths[0], RELATIVE_ERROR * scale);
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
            assert_near("depth", depth, contact.indentation_depth, RELATIVE_ERROR * scale);
        }
        let in_units: Vec<f64> = scaled.pressure().iter().map(|p| p / stress).collect();
        for same in [in_units, scene.mirrored(mirrored.pressure(), along_y)] {
            let error = difference(&same, state.pressure());
            prop_assert!(error <= RELATIVE_ERROR, "pressures differ by {error:e}");
        }
    }
}

/// A power profile on a viscoelastic material; the contact has a length of about 1.
fn sliding() -> impl Strategy<Value = Scene<Compressible>> {
    let body = (0.9..3.0_f64, decades(2.0));
    let branches = prop::collection::vec((decades(1.0), decades(1.0)), 0..3);
    let moduli = [(); 2].map(|()| prop_oneof![Just(0.0), decades(1.0)]);
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
            let load = under_force(slope * modulus, velocity);
            Scene::new(power(slope, exponent), material.expect("a ratio"), load)
        })
}

/// A few steps from first touch on, of a body without symmetry or its mirror image in y (handedness −1).
fn transient(scene: &Scene<Compressible>, handedness: f64) -> Transient {
    let body = Formula::new([false; 2], |[x, y]| {
        let skewed = [x + 0.4 * handedness * y, 1.3 * handedness * y];
        let [along, across] = scene.body.gradient(skewed);
        let gradient = [along, handedness * (0.4 * along + 1.3 * across)];
        (scene.body.height(skewed), gradient)
    });
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
        let (friction, slope) = (state.friction_coefficient, state.mean_slope);
        let holds = friction > 0.0 && friction <= slope * (1.0 + 1e-12);
        prop_assert!(holds, "{friction} above {slope}");
        let columns = state.pressure.grid.shape()[1];
        for row in state.pressure.pressure.chunks(columns).filter(|_| [0.0, 0.5].contains(&y)) {
            prop_assert!(row.iter().eq(row.iter().rev()), "half stands for both");
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
