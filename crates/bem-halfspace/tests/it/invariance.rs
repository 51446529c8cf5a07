//! Neither units nor footprints nor mirrors matter, nor how the equations of a contact are solved.

use bem_halfspace::Footprint;
use bem_halfspace::steady::{
    SteadyBody::Line, SteadyOptions, SteadySliding, steady, steady_on_grid,
};
use indenters::{Cylinder, Unmirrored};
use rheology::Material;

use crate::support::{
    Formula, Scene, after, assert_all_close, assert_close, assert_refused, at_depth, power, prony,
    slid, squares, three_elements, under_force, viscous,
};

/// Units of length \[m], stress \[Pa] and time \[s].
type Units = [f64; 3];

/// Dimensionless results of a scene in some units.
type Solver<'a> = dyn Fn(Units) -> Vec<f64> + 'a;

const SI: Units = [1.0; 3];
const UNITS: [Units; 11] = [
    [1e-12, 1.0, 1.0],
    [1e12, 1.0, 1.0],
    [1.0, 1e-12, 1.0],
    [1.0, 1e12, 1.0],
    [1.0, 1.0, 1e-12],
    [1.0, 1.0, 1e12],
    [1e-3, 1e12, 1.0],
    [1e-12, 1e33, 1e3],
    [1e3, 1e-18, 1e12],
    [1e9, 1e-6, 1e-12],
    [1e-6, 1e3, 1e-12],
];

/// h ∼ r^1.5 with a force and a speed of order one.
fn scene<M: Material>(material: M, [length, stress, time]: Units) -> Scene<M> {
    let load = under_force(0.5 * stress * length * length, 0.7 * length / time);
    Scene::new(power(0.3 * length.powf(-0.5), 1.5), material, load)
}

/// Every row of a march from first touch on, in the units.
fn march<M: Material>(scene: &Scene<M>, [length, _, time]: Units) -> Vec<f64> {
    let load = after(scene.load, 2.0 * length);
    let options = squares(0.1 * length, length);
    let rows = slid(&scene.body, &scene.material, &load, &options).rows;
    let numbers = rows.iter().flat_map(|row| {
        let [depth, area] = [row.indentation_depth, row.contact_area / length];
        [
            row.friction_coefficient,
            depth / length,
            area / length,
            row.time / time,
        ]
    });
    numbers.collect()
}

fn stationary<M: Material>(scene: &Scene<M>, [length, stress, _]: Units) -> Vec<f64> {
    let state = scene.steady_on(&scene.steady_options(7.0));
    vec![
        state.friction_coefficient,
        state.contact_x[1] / length,
        state.contact_area / length / length,
        state.depth.reference_depth / length,
        state.normal_force / stress / length / length,
    ]
}

fn line([length, stress, time]: Units) -> Vec<f64> {
    let material = three_elements(0.1 * stress, stress, time);
    let load = under_force(stress * length, length / time);
    let cylinder = Cylinder::new(length).expect("a cylinder");
    let solved = steady(Line(&cylinder), &material, &load, 1e-2).expect("a friction");
    vec![solved.friction_coefficient.value]
}

#[test]
fn results_are_invariant_under_a_change_of_units() {
    let dashpot = |units: Units| scene(viscous(2.0 * units[1] * units[2]), units);
    let solid = |[length, stress, time]: Units| {
        let solid = three_elements(0.1 * stress, stress, 0.5 * time);
        scene(solid, [length, stress, time])
    };
    let solvers: [(_, &Solver); 6] = [
        ("march on a dashpot", &|units| march(&dashpot(units), units)),
        ("march on a solid", &|units| march(&solid(units), units)),
        ("dashpot", &|units| stationary(&dashpot(units), units)),
        ("solid", &|units| stationary(&solid(units), units)),
        ("at a depth", &|units| {
            let load = at_depth(0.2 * units[0], 0.7 * units[0] / units[2]);
            let solid = solid(units);
            stationary(&Scene { load, ..solid }, units)
        }),
        ("plane strain", &line),
    ];
    for (name, solve) in solvers {
        let expected = solve(SI);
        for units in UNITS {
            for (actual, expected) in solve(units).into_iter().zip(&expected) {
                assert_close((name, units), actual, *expected, 1e-9);
            }
        }
    }
}

/// Half of a symmetric scene and the whole are one discrete problem, also where the half is factorised and the whole solved
/// by iteration: answers differ by what the tolerance leaves open only.
#[test]
fn neither_half_a_scene_nor_a_factorisation_changes_the_contact() {
    let dashpot = viscous(2.0);
    let solid = prony([0.5, 0.0], &[(3.0, 0.4), (1.0, 2.0)]);
    let (force, depth) = (under_force(0.5, 0.7), at_depth(0.2, 0.7));
    let scenes: [(&dyn Material, _, _, _); 4] = [
        (&dashpot, force, 1.0, 6.0),
        (&dashpot, force, 2.0, 6.0),
        (&dashpot, force, 2.0, 16.0),
        (&solid, depth, 2.0, 4.0),
    ];
    for (material, load, exponent, elements) in scenes {
        let scene = Scene::new(power(0.3, exponent), material, load);
        let options = scene.steady_options(elements);
        let phases = [0.0, 0.5].into_iter();
        for y in phases.filter(|y| *y == 0.0 || elements > 5.0) {
            let options = SteadyOptions {
                phase: [0.0, y],
                ..options
            };
            let half = scene.steady_on(&options);
            let body = Unmirrored(&scene.body);
            let whole = steady_on_grid(&body, &material, &load, &options).expect("a solution");
            // Elements on the axis are their own image.
            let [n, of_half] = [whole.unknowns, half.unknowns];
            assert!(2 * n > 3 * of_half && n <= 2 * of_half, "{n}, {of_half}");
            let is_factorised = [&half, &whole].map(SteadySliding::is_factorised);
            let is_either = elements > 5.0 || is_factorised == [true, false];
            assert!(is_either, "half and whole factorised: {is_factorised:?}");
            let numbers = |state: &SteadySliding| {
                let [force, area] = [state.normal_force, state.contact_area];
                [state.friction_coefficient, force, area]
            };
            assert_all_close(options, numbers(&half), numbers(&whole), 1e-9);
        }
    }
}

/// Tight and lopsided footprints, with and without symmetry on the grid: the same friction, or an error.
#[test]
fn no_footprint_breaks_the_symmetry() {
    let scene = Scene::unit(2.0);
    let (length, good) = (scene.contact_length(), scene.steady_options(6.0));
    for phase in [[0.0, 0.0], [0.0, 0.5], [0.5, -0.5]] {
        let solve = |y: [f64; 2]| {
            let mut options = good;
            options.phase = phase;
            options.footprint.y = y.map(|end| end * length);
            steady_on_grid(&scene.body, &scene.material, &scene.load, &options)
        };
        let wide = solve([-1.7, 1.7]).expect("a solution");
        for y in [[-1.5, 4.0], [-4.0, 1.5]] {
            let friction = solve(y).expect("a solution").friction_coefficient;
            assert_close((phase, y), friction, wide.friction_coefficient, 1e-10);
        }
        for y in [[-0.6, 0.6], [-0.6, 4.0], [-4.0, 0.6], [-0.1, 0.1]] {
            assert_refused((phase, y), solve(y), "ContactReachesBoundary");
        }
    }
}

/// Two bumps side by side, the second higher: two separate patches share the load.
#[test]
fn separate_patches_are_found() {
    let body = Formula::new([false; 2], |[x, y]| {
        let [first, second] = [x * x + y * y, x * x + (y - 3.0).powi(2) + 0.05];
        let slope = 2.0 * if first < second { y } else { y - 3.0 };
        (first.min(second), [2.0 * x, slope])
    });
    let (x, y) = ([-1.0, 2.0], [-2.0, 5.0]);
    let options = SteadyOptions {
        tolerance: 1e-10,
        ..SteadyOptions::new([0.1, 0.1], Footprint { x, y })
    };
    let load = under_force(1.5, 1.0);
    let solution = steady_on_grid(&body, &viscous(1.0), &load, &options).expect("a solution");
    let field = &solution.pressure;
    let columns = field.grid.shape()[1];
    let loaded = |column: usize| {
        let mut pressures = field.pressure.iter().skip(column).step_by(columns);
        pressures.any(|pressure| *pressure > 0.0)
    };
    let starts = (0..columns).filter(|&k| loaded(k) && (k == 0 || !loaded(k - 1)));
    assert_eq!(starts.count(), 2, "contact from {:?}", solution.contact_y);
}
