//! How the stationary state is approached, and how friction converges with the grid; the march in time and the direct
//! solution, two methods that share only the elements, arrive at the same friction, outline and depth.

use bem_halfspace::slide::Transient;
use bem_halfspace::steady::{
    RefinementOptions, SteadyOptions, steady, steady_on_grid, steady_refined,
};
use bem_halfspace::{Footprint, GridOptions};
use casebook::group;
use indenters::{SlidingLoad, Surface};
use rheology::Viscous;

use crate::support::{
    Formula, Scene, after, assert_close, assert_ends, assert_near, cone, paraboloid, slid,
    under_force, viscous,
};

/// The surface ahead sinks like ln t, so the depth grows by D/π per unit of ln(distance), without limit.
#[test]
fn depth_drifts_like_the_logarithm_of_the_distance() {
    let mut cases = group("BEM-07").into_iter();
    let case = cases.find(|case| case.id().ends_with("log drift"));
    let scene = Scene::unit(2.0);
    let transient = scene.slide(4.0, 96.0);
    let n = transient.rows.len();
    let depth_scale = 0.5 / (4.0 * scene.material.viscosity() * scene.load.velocity());
    let per_logarithm = |count: usize| {
        let [late, early] = [count, count / 2].map(|count| &transient.rows[count - 1]);
        let deepened = late.indentation_depth - early.indentation_depth;
        deepened / (late.sliding_distance / early.sliding_distance).ln() / depth_scale
    };
    // The next term of the expansion falls like 1/distance; what is left after its elimination is of the second order
    // in (contact length)/(distance) = 1/48, with a factor of order one.
    let drift = 2.0 * per_logarithm(n) - per_logarithm(n / 2);
    case.expect("the log drift")
        .check_within("dd_dln_over_D", drift, 3e-3);
}

#[test]
fn extrapolation_in_the_distance_agrees_with_a_longer_run() {
    for (exponent, elements) in [(1.0, 4.0), (1.0, 5.0), (1.0, 6.0), (2.0, 4.0), (2.0, 5.0)] {
        let what = (exponent, elements);
        let marches = [24.0, 192.0].map(|lengths| Scene::unit(exponent).slide(elements, lengths));
        let [short, long] = [0, 1].map(|index| {
            let state = marches[index].stationary(0.02);
            state.expect("a stationary state")
        });
        let limit = long.friction_coefficient;
        let allowed = short.distance_error + long.distance_error;
        assert_near(what, short.friction_coefficient, limit, allowed);
        let is_small = short.distance_error < 2e-2 * short.friction_coefficient;
        assert!(is_small, "{what:?}: {short:?}");
        // To leading order the drift is the remaining difference from the limit.
        let left = 1.0 - marches[0].last().friction_coefficient / limit;
        assert_near((what, "drift"), left / short.drift, 1.0, 0.35);
    }
}

/// To first order with the slope at the end of a step, and much faster with its mean over the step, to which the pressure
/// of the step belongs.
#[test]
fn the_mean_slope_is_far_more_accurate_than_that_at_the_end_of_a_step() {
    // A higher power is steeper at the front, where the pressure is, and wants a finer grid to begin with.
    for (exponent, elements, gain) in [
        (1.0, 6.0, 8.0),
        (1.5, 6.0, 8.0),
        (2.0, 6.0, 8.0),
        (4.0, 8.0, 3.0),
    ] {
        let [coarse, middle, fine] = [1.0, 2.0, 4.0].map(|refinement| {
            let transient = Scene::unit(exponent).slide(refinement * elements, 2.0);
            transient.last().clone()
        });
        let at_end = [&coarse, &middle, &fine].map(|row| row.friction_coefficient_end_of_step);
        let order = ((at_end[1] - at_end[0]) / (at_end[2] - at_end[1])).log2();
        assert_near((exponent, "order"), order, 1.0, 0.2);
        // Both rules have the same limit; extrapolated from the slow one by its order.
        let limit = 2.0 * at_end[2] - at_end[1];
        assert_close(exponent, fine.friction_coefficient, limit, 5e-3);
        let change = (coarse.friction_coefficient - fine.friction_coefficient).abs();
        let change_at_end = (at_end[0] - at_end[2]).abs();
        let is_better = gain * change < change_at_end;
        assert!(is_better, "p = {exponent}: {change}, {change_at_end}");
    }
}

/// Δy/Δx, as in the direct solution.
const ASPECT: f64 = 0.5;
/// Sliding distances, the second four times the first.
const DISTANCES: [f64; 2] = [16.0, 64.0];
/// Shifts of the body against the grid, in elements. The outline follows the elements, which scatters the friction of
/// one grid by 1e-3; the mean over the shifts has a trend.
const SHIFTS: [[f64; 2]; 4] = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];

/// A surface on the half space on which F_N/(4ηv) is 1, solved by both methods in a square footprint.
struct Twice<'surface> {
    surface: &'surface dyn Surface,
    half_width: f64,
    /// Elements per unit of length of the coarser of the two grids from which the march is extrapolated.
    elements: f64,
}

fn material_and_load() -> (Viscous, SlidingLoad) {
    (viscous(1.0), under_force(4.0, 1.0))
}

impl Twice<'_> {
    fn march(&self, elements: f64, shift: [f64; 2], distance: f64) -> Transient {
        let (material, load) = material_and_load();
        let spacing = [1.0 / elements, ASPECT / elements];
        let surface = Formula::new([false; 2], |position| {
            let at = [0, 1].map(|axis| position[axis] + shift[axis] * spacing[axis]);
            (self.surface.height(at), self.surface.gradient(at))
        });
        let options = GridOptions::new(spacing, Footprint::square(self.half_width));
        slid(&surface, &material, &after(load, distance), &options)
    }

    /// Marches over the first distance on the coarse and on the fine grid, by shift.
    fn marches(&self) -> [[Transient; 4]; 2] {
        [1.0, 2.0].map(|refinement| {
            SHIFTS.map(|shift| self.march(refinement * self.elements, shift, DISTANCES[0]))
        })
    }

    /// Stationary friction of the marches: the grids extrapolated at one distance over a factor of two in the spacing,
    /// and the change from that distance to infinity on the coarse grid.
    fn extrapolated(&self, marches: &[[Transient; 4]; 2]) -> f64 {
        let order = (2.0 * self.surface.apex_exponent() - 1.0).min(1.5);
        let [coarse, fine] = marches.each_ref().map(|by_shift| {
            let values = by_shift.iter();
            let values = values.map(|march| march.last().friction_coefficient);
            0.25 * values.sum::<f64>()
        });
        let far = self.march(self.elements, SHIFTS[0], DISTANCES[1]);
        let near = &far.rows[far.rows.len() / 4 - 1];
        let limit = far.stationary(0.05).expect("a stationary state");
        fine + (fine - coarse) / (order.exp2() - 1.0) + limit.friction_coefficient
            - near.friction_coefficient
    }

    /// Friction; and, of single grids, outline to one element, and depth to terms of the order
    /// (contact length)/(sliding distance).
    fn check(&self, name: &str) {
        let (material, load) = material_and_load();
        let direct = steady(self.surface, &material, &load, 2e-4).expect("a friction coefficient");
        let direct = direct.friction_coefficient.value;
        let marches = self.marches();
        assert_near(name, self.extrapolated(&marches), direct, 5e-4 * direct);
        for (refinement, by_shift) in [1.0, 2.0].into_iter().zip(&marches) {
            let elements = refinement * self.elements;
            let what = (name, elements);
            // In the march the body is half an element further at the end of a step than in its middle.
            let (spacing, footprint) = (1.0 / elements, Footprint::square(self.half_width));
            let options = SteadyOptions {
                phase: [0.5, 0.0],
                ..SteadyOptions::new([spacing, ASPECT * spacing], footprint)
            };
            let direct = steady_on_grid(self.surface, &material, &load, &options);
            let direct = direct.expect("a stationary state");
            let last = by_shift[0].last();
            let contact_x = last.contact_x.map(|end| end + 0.5 * spacing);
            let expected = [direct.contact_x, direct.contact_y];
            assert_ends(what, [contact_x, last.contact_y], expected, 1.01 * spacing);
            let depth = direct.depth.after(last.sliding_distance).expect("a depth");
            let allowed = 2.0 * direct.depth.depth_per_e_fold / last.sliding_distance;
            assert_near(what, last.indentation_depth, depth, allowed);
        }
    }
}

#[test]
fn cones_and_skew_bodies_slide_alike_in_both() {
    // An elliptic paraboloid that slides along none of its axes: no symmetry is left.
    let skew = Formula::new([false; 2], |[x, y]| {
        let height = x * x + 0.6 * x * y + 0.6 * y * y;
        (height, [2.0 * x + 0.6 * y, 0.6 * x + 1.2 * y])
    });
    let table: [(_, &dyn Surface, _, _); 2] = [
        ("cone", &cone(1.0), 1.6, 8.0),
        ("skew paraboloid", &skew, 2.2, 7.0),
    ];
    for (name, surface, half_width, elements) in table {
        let twice = Twice {
            surface,
            half_width,
            elements,
        };
        twice.check(name);
    }
}

/// Their own displacement on a dashpot, which is known up to a constant only, changes its sign between 3 and 10.
#[test]
fn elements_of_any_shape_find_the_same_friction() {
    let body = paraboloid(1.0);
    let friction = |aspect| {
        let options = RefinementOptions {
            relative_error: 1e-2,
            aspect,
            max_unknowns: 4000,
        };
        let state = steady_refined(&body, &viscous(1.0), &under_force(1.0, 1.0), &options);
        state.expect("a state").friction_coefficient
    };
    let square = friction(1.0);
    for aspect in [0.1, 0.3, 3.0, 6.0, 10.0, 30.0] {
        let got = friction(aspect);
        let allowed = got.error + square.error;
        assert_near((aspect, "Δy/Δx"), got.value, square.value, allowed);
    }
}
