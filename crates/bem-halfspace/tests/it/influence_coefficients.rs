//! The influence of a rectangle is Love's closed form, near and far.

use approx::assert_relative_eq;
use bem_halfspace::influence;
use casebook::group;

#[test]
fn influence_is_that_of_the_casebook() {
    for case in group("BEM-02") {
        if case.has_input("i") {
            let offset = [case.input("i"), case.input("j")];
            case.check_within("K", influence(offset, [1.0, 1.0]), 1e-13);
        } else if case.has_input("hx") {
            let edges = [case.input("hx"), case.input("hy")];
            case.check_within(
                "K",
                influence([case.input("x"), case.input("y")], edges),
                1e-13,
            );
        } else {
            case.check("K00", influence([0.0, 0.0], [1.0, 1.0]));
            let per_force = influence([0.0, 0.0], [1.0, 1.0]) / (4.0 * std::f64::consts::PI);
            case.check("u_self_per_f_over_Gh", per_force);
        }
    }
}

/// The branches near and far meet: a rectangle is the sum of its quarters at every distance and aspect ratio.
#[test]
fn a_rectangle_is_the_sum_of_its_quarters() {
    for edges in [[1.0, 1.0], [1.0, 1e-4], [1e-4, 1.0], [3e-9, 5e-9]] {
        for (x, y) in [
            (0.0, 0.0),
            (0.4, 0.1),
            (7.9, 0.3),
            (8.1, 0.0),
            (0.2, 7.99),
            (5.0, 6.0),
            (1e5, 3.0),
        ] {
            for scale in [1.0, edges[1] / edges[0]] {
                let [a, b] = edges;
                let offset = [x * a, y * a * scale];
                let whole = influence(offset, edges);
                let quarters: f64 = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)]
                    .iter()
                    .map(|(i, j)| {
                        let centre = [offset[0] + 0.25 * i * a, offset[1] + 0.25 * j * b];
                        influence(centre, [0.5 * a, 0.5 * b])
                    })
                    .sum();
                assert_relative_eq!(whole, quarters, max_relative = 2e-13, epsilon = 0.0);
            }
        }
    }
}
