//! Friction depends only on the dimensionless groups, and respects the symmetries of the scene.

use bem_halfspace::slide_on_grid;
use casebook::group;

use crate::support::{Scene, Skewed};

/// μ / (c^(1/p) (F/(ηv))^(1−1/p)) for random scenes over many decades (casebook BEM-07).
#[test]
fn friction_collapses_under_the_similarity_law() {
    let cases = group("BEM-07");
    for exponent in [1.0, 2.0, 3.0] {
        let rows = cases
            .iter()
            .filter(|case| case.has_input("p") && (case.input("p") - exponent).abs() < 0.1);
        let collapsed: Vec<f64> = rows
            .map(|case| {
                let load = [case.input("F"), case.input("v")];
                let scene = Scene::new([case.input("c"), exponent], case.input("eta"), load);
                let group = load[0] / case.input("eta") / load[1];
                let scale = case.input("c").powf(1.0 / exponent) * group.powf(1.0 - 1.0 / exponent);
                scene.slide(6.0, 2.0).last().friction_coefficient / scale
            })
            .collect();
        for value in &collapsed {
            let error = (value / collapsed[0] - 1.0).abs();
            assert!(error < 1e-9, "p = {exponent}: {collapsed:?}");
        }
    }
}

/// Metre, newton and second scaled over 24 decades.
#[test]
fn results_are_invariant_under_a_change_of_units() {
    let reference = Scene::unit(1.5).slide(6.0, 3.0);
    for (metre, newton, second) in [
        (1e12, 1.0, 1.0),
        (1e-6, 1.0, 1.0),
        (1e-3, 1e6, 1.0),
        (1e-12, 1e9, 1e3),
        (1e3, 1e-12, 1e12),
        (1e9, 1e12, 1e-12),
    ] {
        let coefficient = 0.3 * f64::powf(metre, -0.5);
        let viscosity = 2.0 * newton * second / metre / metre;
        let scene = Scene::new(
            [coefficient, 1.5],
            viscosity,
            [0.5 * newton, 0.7 * metre / second],
        );
        let transient = scene.slide(6.0, 3.0);
        for (actual, expected) in transient.rows.iter().zip(&reference.rows) {
            let ratios = [
                actual.friction_coefficient / expected.friction_coefficient,
                actual.indentation_depth / metre / expected.indentation_depth,
                actual.contact_area / metre / metre / expected.contact_area,
                actual.time / second / expected.time,
            ];
            for ratio in ratios {
                assert!(
                    (ratio - 1.0).abs() < 1e-9,
                    "units {metre}, {newton}, {second}: ratio {ratio}"
                );
            }
        }
    }
}

#[test]
fn pressure_is_mirror_symmetric_and_balances_the_force() {
    let scene = Scene::unit(2.0);
    let transient = scene.slide(8.0, 3.0);
    let field = &transient.pressure;
    let [rows, columns] = field.grid.shape();
    let largest = field
        .pressure
        .iter()
        .fold(0.0, |largest: f64, value| largest.max(*value));
    for row in 0..rows {
        for column in 0..columns {
            let [here, mirrored] =
                [column, columns - 1 - column].map(|k| field.pressure[row * columns + k]);
            // The solver stops at a relative residual of 1e-9 of the displacement.
            assert!(
                (here - mirrored).abs() < 1e-6 * largest,
                "row {row}, column {column}: {here}, {mirrored}"
            );
        }
    }
    let force = field.pressure.iter().sum::<f64>() * field.grid.element_area();
    let expected = scene.load.require_normal_force().expect("a force");
    assert!(
        (force / expected - 1.0).abs() < 1e-12,
        "force {force} instead of {expected}"
    );
}

#[test]
fn mirror_images_have_the_same_friction() {
    let scene = Scene::unit(2.0);
    let [right, left] = [1.0, -1.0].map(|handedness| {
        let body = Skewed {
            body: scene.body,
            handedness,
        };
        let options = scene.options(6.0);
        slide_on_grid(&body, &scene.material, &scene.load_over(3.0), &options)
            .expect("a transient")
            .last()
            .clone()
    });
    let ratio = right.friction_coefficient / left.friction_coefficient;
    assert!((ratio - 1.0).abs() < 1e-7, "{right:?} and {left:?}");
    assert!(
        (right.contact_y[0] + left.contact_y[1]).abs() < 1e-12,
        "{right:?} and {left:?}"
    );
}

#[test]
fn two_runs_agree_to_the_last_bit() {
    let scene = Scene::unit(1.0);
    assert_eq!(
        scene.slide(6.0, 2.0),
        scene.slide(6.0, 2.0),
        "the same scene twice"
    );
}
