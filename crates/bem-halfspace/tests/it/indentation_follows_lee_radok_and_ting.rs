//! Pressing by a given force or depth, and letting go, on any material (casebook VIS-02).

use std::f64::consts::PI;

use bem_halfspace::indent::{HistoryOptions, IndentCurve, indent_along, indent_history};
use bem_halfspace::{BemError, Control, GridOptions, HistoryPoint};
use casebook::{Case, group};
use numerics::Accuracy;
use rheology::Material;

use crate::support::{
    assert_close, assert_near, assert_refused, cone, elastic, every_kind_of_material, paraboloid,
    power, pressed, pressed_by, prony, squares, three_elements, tight,
};

const TIMES: [f64; 5] = [1e-6, 0.05, 0.2, 0.9, 3.0];

/// Grid with a number of elements along a radius, and a margin around the contact.
fn options(radius: f64, elements: f64) -> GridOptions {
    squares(radius / elements, 1.3 * radius)
}

/// Compliance after a time over that of an incompressible half space of modulus 1.
fn yielded(material: &dyn Material, time: f64) -> f64 {
    material.half_space_factor() * material.creep_compliance(time).expect("a compliance")
}

/// w is linear in the history of elastic contacts, also on a grid and in steps: with a constant force only J(t) counts.
#[test]
fn a_constant_force_makes_the_depth_of_the_elastic_body_of_compliance_j() {
    let (body, force, options) = (power(0.4, 1.5), 0.6, tight(options(1.6, 9.0)));
    for (name, material) in every_kind_of_material() {
        for row in pressed(&body, &*material, pressed_by(force, &TIMES[2..]), &options) {
            let solid = elastic(1.0 / yielded(&*material, row.time));
            let expected = pressed(&body, &solid, pressed_by(force, &[1.0]), &options)[0];
            let [depth, expected_depth] = [row, expected].map(|row| row.indentation_depth);
            assert_close(name, depth, expected_depth, 1e-10);
            assert_eq!(row.n_contact, expected.n_contact, "{name}: {row:?}");
        }
    }
}

/// Under a rising depth the discrete elastic contacts give the force: F_e(d_n) = Σ [J(t_n − t_(k−1)) − J(t_n − t_k)] F_k, in any steps, on any grid.
#[test]
fn a_rising_depth_has_the_force_that_its_elastic_contacts_make() {
    let body = cone(0.5);
    let depths = [0.3, 0.5, 0.6, 0.65, 0.9].map(Control::IndentationDepth);
    let options = tight(options(1.2, 9.0));
    let elastic_forces =
        depths.map(|depth| pressed(&body, &elastic(1.0), [(1.0, depth)], &options)[0].normal_force);
    let start = |k: usize| if k == 0 { 0.0 } else { TIMES[k - 1] };
    for (name, material) in every_kind_of_material() {
        let rows = pressed(&body, &*material, TIMES.into_iter().zip(depths), &options);
        let mut forces: Vec<f64> = Vec::new();
        for (n, row) in rows.iter().enumerate() {
            let since = |time: f64| yielded(&*material, TIMES[n] - time);
            let past = forces.iter().enumerate();
            let past = past.map(|(k, force)| (since(start(k)) - since(TIMES[k])) * force);
            let expected = (elastic_forces[n] - past.sum::<f64>()) / since(start(n));
            forces.push(expected);
            assert_close((name, n), row.normal_force, expected, 1e-8);
        }
    }
}

/// A depth that rises with the speed V up to the time `turn` and falls again, until `end`.
fn triangle(case: &Case, name: &str, [turn, end]: [f64; 2]) -> IndentCurve {
    let body = match name {
        "cone" => cone(case.input("tan_theta")),
        _ => paraboloid(0.5 / case.input("R")),
    };
    let point = |time: f64| HistoryPoint {
        time,
        control: Control::IndentationDepth(case.input("V") * (turn - (time - turn).abs())),
    };
    let history = [0.0, turn, end].map(point);
    indent_along(&body, &case.material(), &history, Accuracy::Elements(32)).expect("a history")
}

/// After the turn the contact shrinks faster than the depth, and ends before the depth is zero.
#[test]
fn a_falling_depth_has_the_force_of_ting() {
    let mut n_lost = 0;
    let cases = group("VIS-02").into_iter();
    for case in cases.filter(|case| case.has_input("t")) {
        for name in ["paraboloid", "cone"] {
            let curve = triangle(&case, name, [case.input("T"), case.input("t")]);
            let [_, turn, end] = curve.points[..] else {
                panic!("{}: {:?}", case.id(), curve.points);
            };
            let expected = case.expected(&format!("F_{name}")).expect("a force");
            let (got, largest) = (end.normal_force, turn.normal_force.value);
            assert_near((case.id(), name), got.value, expected, got.error);
            assert_near((case.id(), name), got.error, 0.0, 0.02 * largest);
            if let Some(expected) = case.expected(&format!("a_{name}")) {
                let area = end.contact_area;
                assert_near(
                    (case.id(), name),
                    area.value,
                    PI * expected * expected,
                    area.error,
                );
            } else {
                assert_eq!(curve.n_contact, 0, "{}: {end:?}", case.id());
                n_lost += 1;
            }
        }
    }
    assert_eq!(n_lost, 2, "both bodies lose their contact once");
}

/// A second, deeper press after a rest without contact finds the surface where creep has left it.
#[test]
fn a_body_that_is_lifted_and_pressed_again_meets_the_recovered_surface() {
    let (body, material) = (paraboloid(0.5), three_elements(1.0, 4.0, 0.5));
    let options = tight(options(0.8, 10.0));
    let press = |rest: f64| {
        let path = [
            (1.0, Control::NormalForce(1.0)),
            (1.01, Control::IndentationDepth(-1.0)),
            (1.01 + rest, Control::NormalForce(0.0)),
            (1.02 + rest, Control::NormalForce(1.0)),
        ];
        let rows = pressed(&body, &material, path, &options);
        assert_eq!(rows[1].n_contact, 0, "lifted");
        [2, 3].map(|step: usize| rows[step].indentation_depth)
    };
    let ([dent, early], [recovered, again]) = (press(0.1), press(1e3));
    assert!(dent > 1e-2, "a dent of {dent} after a short rest");
    assert_near("a long one", recovered, 0.0, 1e-9);
    // Recovered, it is pressed as for the first time.
    let first = pressed(&body, &material, pressed_by(1.0, &[0.01]), &options)[0];
    assert_close("again", again, first.indentation_depth, 1e-9);
    assert!(early > again, "the dent adds: {early}, {again}");
}

/// Steps in time err by their length, and the estimate covers what the extrapolation leaves.
#[test]
fn the_estimated_error_of_the_steps_holds() {
    let (body, material) = (paraboloid(0.5), three_elements(1.0, 4.0, 0.5));
    let control = |time: f64| Control::NormalForce(1.0 - (time - 1.0).abs());
    let [coarse, fine] = [1e-2, 2e-4].map(|relative_error| {
        let options = HistoryOptions {
            grid: options(0.8, 10.0),
            relative_error,
            max_steps: 512,
        };
        let times = [0.5, 1.0, 1.5, 1.9];
        indent_history(&body, &material, control, &times, &options).expect("a history")
    });
    let steps = [&coarse, &fine].map(|history| history.steps_per_row);
    assert!(steps[1] > steps[0], "{steps:?} steps");
    let largest = fine.rows[1].indentation_depth;
    let allowed = (coarse.time_error + fine.time_error) * largest;
    for (a, b) in coarse.rows.iter().zip(&fine.rows) {
        assert_near(a.time, a.indentation_depth, b.indentation_depth, allowed);
    }
}

/// One step that holds the last force presses a fluid far beyond the footprint; many steps do not. Steps that cannot be
/// short enough are an error.
#[test]
fn steps_that_are_too_long_for_the_footprint_are_halved_as_often_as_allowed() {
    let (body, fluid) = (paraboloid(0.5), prony([0.0, 1.0], &[]));
    // Half of the impulse that a single step would have: a³ = 3 R/16 ∫ F dt.
    let rising = |force: f64| move |time: f64| Control::NormalForce(force * time);
    let radius = (3.0_f64 / 16.0 * 1.5).cbrt();
    let grid = squares(radius / 10.0, 1.15 * radius);
    let options = HistoryOptions::new(grid);
    let history = indent_history(&body, &fluid, rising(3.0), &[1.0], &options);
    let rows = history.expect("a history").rows;
    assert_close("depth", rows[0].indentation_depth, radius * radius, 5e-3);
    let options = HistoryOptions {
        grid: squares(0.8 / 6.0, 1.04),
        relative_error: 1e-9,
        max_steps: 4,
    };
    let maxwell = prony([0.0, 0.0], &[(4.0, 0.5)]);
    let coarse = indent_history(&body, &maxwell, rising(1.0), &[1.0], &options);
    if let Err(BemError::TimeNotResolved { steps, error, .. }) = coarse {
        assert_eq!(steps, 4, "steps");
        assert_near("error", error, 0.0, 0.1);
    }
    assert_refused("four steps", coarse, "TimeNotResolved");
}
