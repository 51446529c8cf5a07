//! Results do not depend on the number of threads, to the last bit.

use bem_halfspace::steady::SteadyOptions;
use bem_halfspace::{ContactOptions, Control, Convolution, Grid};

use crate::support::{
    Pressing, Scene, after, on_threads, paraboloid, slid, squares, three_elements, under_force,
};

#[test]
fn one_to_four_threads_find_the_same_contact() {
    let grid = Grid::new([200; 2], [1.0; 2]).expect("a valid grid");
    // The second problem has mirrors.
    let middles = [[90.3, 110.8], [99.5; 2]];
    let kinds = [Convolution::new, Convolution::periodic].into_iter();
    for (new, middle) in kinds.flat_map(|new| middles.map(|middle| (new, middle))) {
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
        let one = on_threads(1, solve);
        for threads in 2..=4 {
            assert_eq!(one, on_threads(threads, solve), "{threads} threads");
        }
        let (left, right) = on_threads(2, || rayon::join(solve, solve));
        assert_eq!([&one; 2], [&left, &right], "two contacts at once");
        assert_eq!(one, solve(), "the same contact outside a pool");
    }
}

#[test]
fn marches_and_stationary_states_are_the_same_on_one_and_three_threads() {
    let scene = Scene::unit(2.0);
    let options = SteadyOptions {
        phase: [0.1, 0.3],
        tolerance: 1e-8,
        ..scene.steady_options(80.0)
    };
    let [one, three] = [1, 3].map(|threads| on_threads(threads, || scene.steady_on(&options)));
    assert_eq!(one, three, "the same pressure on one and three threads");
    let (body, material) = (paraboloid(0.5), three_elements(0.1, 1.0, 1.0));
    // More than the 2^13 elements for which a second thread is taken.
    let load = after(under_force(1.5, 0.3), 0.4);
    let run = || slid(&body, &material, &load, &squares(0.025, 1.8));
    let [one, three] = [1, 3].map(|threads| on_threads(threads, run));
    assert!(one.n_elements > 8192, "{} elements", one.n_elements);
    assert_eq!(one, three, "the same slide on one and three threads");
}
