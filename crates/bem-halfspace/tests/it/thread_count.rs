//! Results do not depend on the number of threads, to the last bit.

use bem_halfspace::steady::SteadyOptions;
use bem_halfspace::{
    ContactOptions, Control, Convolution, Footprint, Grid, GridOptions, slide_on_grid,
    steady_on_grid,
};
use indenters::{PowerProfile, SlidingLoad};
use rayon::ThreadPoolBuilder;

use crate::support::{Pressing, Scene, prony};

#[test]
fn one_two_and_three_threads_agree_to_the_last_bit() {
    let grid = Grid::new([200; 2], [1.0; 2]).expect("a valid grid");
    // The second has mirrors.
    let middles = [[90.3, 110.8], [99.5; 2]];
    let kinds = [Convolution::new, Convolution::periodic];
    for (new, middle) in kinds
        .into_iter()
        .flat_map(|new| middles.map(|middle| (new, middle)))
    {
        let height = |element: [f64; 2]| {
            let [x, y] = [0, 1].map(|axis| element[axis] - middle[axis]);
            0.004 * (x * x + 1.3 * y * y) + (0.3 * x).cos() * (0.2 * y).cos()
        };
        let solve = || {
            let body = Pressing {
                options: ContactOptions::default(),
                ..Pressing::new(new(&grid), height)
            };
            let (contact, state) = body.solve(Control::NormalForce(4000.0));
            (contact, state.pressure().to_vec())
        };
        let [one, two, three] = [1, 2, 3].map(|threads| on_threads(threads, solve));
        assert_eq!(one, two, "the same contact on one and two threads");
        assert_eq!(one, three, "the same contact on one and three threads");
        let (left, right) = on_threads(2, || rayon::join(solve, solve));
        assert_eq!([&one; 2], [&left, &right], "two contacts at once");
        assert_eq!(one, solve(), "the same contact outside a pool");
    }
}

#[test]
fn stationary_sliding_is_the_same_on_one_and_three_threads() {
    let scene = Scene::unit(2.0);
    let spacing = scene.contact_length() / 80.0;
    let options = SteadyOptions {
        phase: [0.1, 0.3],
        tolerance: 1e-8,
        ..SteadyOptions::new([spacing, 0.5 * spacing], scene.options(80.0).footprint)
    };
    let solve =
        || steady_on_grid(&scene.body, &scene.material, &scene.load, &options).expect("a solution");
    let [one, three] = [1, 3].map(|threads| on_threads(threads, solve));
    assert_eq!(one, three, "the same pressure on one and three threads");
}

#[test]
fn a_slide_is_the_same_on_one_and_three_threads() {
    let body = PowerProfile::paraboloid(0.5).expect("a body");
    let material = prony([0.1, 0.0], &[(1.0, 1.0)]);
    let load = SlidingLoad::new(1.5, 0.3).expect("a load");
    // More than the 2^13 elements for which a second thread is taken.
    let load = load.after(0.4).expect("a distance");
    let options = GridOptions::new([0.025; 2], Footprint::square(1.8));
    let run = || slide_on_grid(&body, &material, &load, &options).expect("a transient");
    let [one, three] = [1, 3].map(|threads| on_threads(threads, run));
    assert!(one.n_elements > 8192, "{} elements", one.n_elements);
    assert_eq!(one, three, "the same slide on one and three threads");
}

fn on_threads<T: Send>(threads: usize, work: impl Fn() -> T + Send + Sync) -> T {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("a pool").install(work)
}
