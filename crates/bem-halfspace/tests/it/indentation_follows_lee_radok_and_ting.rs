//! Pressing by a given force or depth, and letting go, on any material (casebook VIS-01, VIS-02).

use bem_halfspace::indent::{
    ControlHistory, HistoryOptions, IndentRow, IndentStep, PiecewiseLinear, indent_history,
    indent_history_on_grid,
};
use bem_halfspace::{BemError, Control, Footprint, GridOptions};
use casebook::{Case, group};
use indenters::PowerProfile;
use rheology::Elastic;

use crate::support::{TIGHT, every_kind_of_material, material_of, pressed, prony};

const TIMES: [f64; 5] = [1e-6, 0.05, 0.2, 0.9, 3.0];

fn options(radius: f64, elements: f64) -> GridOptions {
    GridOptions::new([radius / elements; 2], Footprint::square(1.3 * radius))
}

fn tight(radius: f64, elements: f64) -> GridOptions {
    GridOptions {
        contact: TIGHT,
        ..options(radius, elements)
    }
}

/// A depth history in one step on a half space of modulus 1 for each depth, and its forces.
fn elastic_forces(body: &PowerProfile, depths: &[f64], options: &GridOptions) -> Vec<f64> {
    let unit = Elastic::new(1.0).expect("a material");
    let force = |&depth: &f64| {
        let step = IndentStep {
            time: 1.0,
            control: Control::IndentationDepth(depth),
        };
        let rows =
            indent_history_on_grid(body, &unit, &[step], options).expect("an elastic contact");
        rows[0].normal_force
    };
    depths.iter().map(force).collect()
}

/// w is linear in the history of elastic contacts, also on a grid and in steps: with a constant force only J(t) counts.
#[test]
fn a_constant_force_makes_the_depth_of_the_elastic_body_of_compliance_j() {
    let body = PowerProfile::new(0.4, 1.5).expect("a body");
    let force = 0.6;
    for (name, material) in every_kind_of_material() {
        let options = tight(1.6, 9.0);
        let rows = pressed(&body, &*material, (force, &TIMES[2..]), &options);
        for row in rows {
            let compliance =
                material.half_space_factor() * material.creep_compliance(row.time).expect("J");
            let solid = Elastic::new(1.0 / compliance).expect("a material");
            let expected = pressed(&body, &solid, (force, &[1.0]), &options)[0];
            let ratio = row.indentation_depth / expected.indentation_depth;
            assert!(
                (ratio - 1.0).abs() < 1e-10 && row.n_contact == expected.n_contact,
                "{name}: {row:?} instead of {expected:?}"
            );
        }
    }
}

/// The same with a rising depth: F_e(d_n) = Σ [J(t_n − t_(k−1)) − J(t_n − t_k)] F_k, in any steps, on any grid.
#[test]
fn a_rising_depth_has_the_force_that_its_elastic_contacts_make() {
    let body = PowerProfile::new(0.5, 1.0).expect("a body");
    let depths = [0.3, 0.5, 0.6, 0.65, 0.9];
    let options = tight(1.2, 9.0);
    let elastic = elastic_forces(&body, &depths, &options);
    for (name, material) in every_kind_of_material() {
        let step = |(&time, &depth): (&f64, &f64)| IndentStep {
            time,
            control: Control::IndentationDepth(depth),
        };
        let steps: Vec<IndentStep> = TIMES.iter().zip(&depths).map(step).collect();
        let rows = indent_history_on_grid(&body, &*material, &steps, &options).expect("rows");
        let yielded = |time: f64| {
            let compliance = material.creep_compliance(time).expect("a compliance");
            material.half_space_factor() * compliance
        };
        let mut forces: Vec<f64> = Vec::new();
        for (n, row) in rows.iter().enumerate() {
            let start = |k: usize| if k == 0 { 0.0 } else { TIMES[k - 1] };
            let past: f64 = (0..n)
                .map(|k| yielded(TIMES[n] - start(k)) - yielded(TIMES[n] - TIMES[k]))
                .zip(&forces)
                .map(|(yielded, force)| yielded * force)
                .sum();
            let expected = (elastic[n] - past) / yielded(TIMES[n] - start(n));
            forces.push(expected);
            assert!(
                (row.normal_force / expected - 1.0).abs() < 1e-8,
                "{name}, step {n}: force {} instead of {expected}",
                row.normal_force
            );
        }
    }
}

fn body_of(case: &Case, name: &str) -> PowerProfile {
    if name == "cone" {
        PowerProfile::cone(case.input("tan_theta"))
    } else {
        PowerProfile::paraboloid(0.5 / case.input("R"))
    }
    .expect("a body")
}

/// A depth that rises with the speed V up to the time `turn` and falls again, until `end`.
fn triangle(case: &Case, name: &str, [turn, end]: [f64; 2], n_rows: usize) -> Vec<IndentRow> {
    let body = body_of(case, name);
    let largest = case.input("V") * turn;
    let radius = body.line_position(largest);
    let control = PiecewiseLinear::depth(&[(0.0, 0.0), (turn, largest), (2.0 * turn, 0.0)]);
    let control = control.expect("a history");
    let times: Vec<f64> = (1..=n_rows)
        .map(|k| end * k as f64 / n_rows as f64)
        .collect();
    let history = ControlHistory {
        control: &|time| control.at(time),
        times: &times,
    };
    let options = HistoryOptions {
        relative_error: 5e-3,
        ..HistoryOptions::new(options(radius, ELEMENTS))
    };
    let history = indent_history(&body, &material_of(case), &history, &options);
    let history = history.expect("a history");
    assert!(history.time_error <= 5e-3, "{}: {history:?}", case.id());
    history.rows
}

/// Elements along the radius: the elastic force at a depth errs by the square of their inverse, scattered by the place of
/// the edge, less than 4e-3 at 16 (`depth_converges_to_the_exact_law_with_second_order`).
const ELEMENTS: f64 = 16.0;
const TOLERANCE: f64 = 6e-3;

#[test]
fn a_depth_ramp_has_the_force_of_lee_and_radok() {
    for case in group("VIS-01") {
        if !case.has_input("V") {
            continue;
        }
        for name in ["paraboloid", "cone"] {
            let time = case.input("t");
            let rows = triangle(&case, name, [time, time], 4);
            case.check_within(&format!("F_{name}"), rows[3].normal_force, TOLERANCE);
            let radius = (rows[3].contact_area / std::f64::consts::PI).sqrt();
            // The area of whole elements says the radius to half an element.
            case.check_within(&format!("a_{name}"), radius, 0.5 / ELEMENTS);
        }
    }
}

/// After the turn the contact shrinks faster than the depth, and is lost before the depth is zero.
#[test]
fn a_falling_depth_has_the_force_of_ting() {
    let mut n_lost = 0;
    for case in group("VIS-02") {
        if !case.has_input("t") {
            continue;
        }
        for name in ["paraboloid", "cone"] {
            let [turn, end] = [case.input("T"), case.input("t")];
            // Rows at the turn and, twenty or five times as many steps later, at the end.
            let n_rows = (end / (end - turn)).round();
            let n_rows = if n_rows > 10.0 { 21 } else { 6 };
            let rows = triangle(&case, name, [turn, end], n_rows);
            let row = rows[n_rows - 1];
            let largest = rows.iter().map(|row| row.normal_force).fold(0.0, f64::max);
            let expected = case.expected(&format!("F_{name}")).expect("a force");
            assert!(
                (row.normal_force - expected).abs() < TOLERANCE * largest,
                "{} {name}: force {} instead of {expected}, at most {largest}",
                case.id(),
                row.normal_force
            );
            match case.expected(&format!("a_{name}")) {
                Some(radius) => {
                    let actual = (row.contact_area / std::f64::consts::PI).sqrt();
                    // The radius falls by a part of itself in the last of the steps that were needed.
                    assert!(
                        (actual / radius - 1.0).abs() < 1.0 / ELEMENTS,
                        "{} {name}: radius {actual} instead of {radius}",
                        case.id()
                    );
                }
                None => {
                    assert_eq!(row.n_contact, 0, "{}: {row:?}", case.id());
                    n_lost += 1;
                }
            }
        }
    }
    assert_eq!(n_lost, 2, "both bodies lose their contact once");
}

/// A second, deeper press after a rest without contact finds the surface where creep has left it.
#[test]
fn a_body_that_is_lifted_and_pressed_again_meets_the_recovered_surface() {
    let body = PowerProfile::paraboloid(0.5).expect("a body");
    let material = prony([1.0, 0.0], &[(4.0, 0.5)]);
    let press = |rest: f64| {
        let step = |time: f64, control| IndentStep { time, control };
        let steps = [
            step(1.0, Control::NormalForce(1.0)),
            step(1.01, Control::IndentationDepth(-1.0)),
            step(1.01 + rest, Control::NormalForce(0.0)),
            step(1.02 + rest, Control::NormalForce(1.0)),
        ];
        indent_history_on_grid(&body, &material, &steps, &tight(0.8, 10.0)).expect("rows")
    };
    let (short, long) = (press(0.1), press(1e3));
    assert_eq!(short[1].n_contact, 0, "lifted");
    assert!(
        short[2].indentation_depth > 1e-2 && long[2].indentation_depth.abs() < 1e-9,
        "a dent of {} after a short rest, of {} after a long one",
        short[2].indentation_depth,
        long[2].indentation_depth
    );
    // Recovered, it is pressed as for the first time.
    let first = pressed(&body, &material, (1.0, &[0.01]), &tight(0.8, 10.0))[0];
    let again = long[3].indentation_depth;
    assert!(
        (again / first.indentation_depth - 1.0).abs() < 1e-9,
        "depth {again} instead of {}",
        first.indentation_depth
    );
    assert!(
        short[3].indentation_depth > again,
        "the dent adds to the depth: {} and {again}",
        short[3].indentation_depth
    );
}

/// Steps in time err by their length, and the estimate covers what the extrapolation leaves.
#[test]
fn the_estimated_error_of_the_steps_holds() {
    let body = PowerProfile::paraboloid(0.5).expect("a body");
    let material = prony([1.0, 0.0], &[(4.0, 0.5)]);
    let control = PiecewiseLinear::force(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]).expect("a force");
    let times = [0.5, 1.0, 1.5, 1.9];
    let refined = |relative_error: f64| {
        let history = ControlHistory {
            control: &|time| control.at(time),
            times: &times,
        };
        let options = HistoryOptions {
            grid: options(0.8, 10.0),
            relative_error,
            max_steps: 512,
        };
        indent_history(&body, &material, &history, &options).expect("a history")
    };
    let (coarse, fine) = (refined(1e-2), refined(2e-4));
    assert!(
        fine.steps_per_row > coarse.steps_per_row,
        "{} and {} steps",
        coarse.steps_per_row,
        fine.steps_per_row
    );
    let largest = fine.rows[1].indentation_depth;
    for (a, b) in coarse.rows.iter().zip(&fine.rows) {
        let error = (a.indentation_depth - b.indentation_depth).abs() / largest;
        assert!(
            error <= coarse.time_error + fine.time_error,
            "error {error}, estimated {} and {}: {a:?}, {b:?}",
            coarse.time_error,
            fine.time_error
        );
    }
}

/// One step that holds the last force presses a fluid far beyond the footprint; many steps do not.
#[test]
fn steps_that_are_too_long_for_the_footprint_are_halved() {
    let body = PowerProfile::paraboloid(0.5).expect("a body");
    let fluid = prony([0.0, 1.0], &[]);
    // Half of the impulse that a single step would have: a³ = 3 R/16 ∫ F dt.
    let control = PiecewiseLinear::force(&[(0.0, 0.0), (1.0, 3.0)]).expect("a force");
    let radius = (3.0_f64 / 16.0 * 1.5).cbrt();
    let options = GridOptions {
        footprint: Footprint::square(1.15 * radius),
        ..options(radius, 10.0)
    };
    let history = ControlHistory {
        control: &|time| control.at(time),
        times: &[1.0],
    };
    let history = indent_history(&body, &fluid, &history, &HistoryOptions::new(options));
    let row = history.expect("a history").rows[0];
    let expected = radius * radius;
    assert!(
        (row.indentation_depth / expected - 1.0).abs() < 5e-3,
        "depth {} instead of {expected}",
        row.indentation_depth
    );
}

#[test]
fn steps_that_cannot_be_short_enough_are_an_error() {
    let body = PowerProfile::paraboloid(0.5).expect("a body");
    let material = prony([0.0, 0.0], &[(4.0, 0.5)]);
    let control = PiecewiseLinear::force(&[(0.0, 0.0), (1.0, 1.0)]).expect("a force");
    let history = ControlHistory {
        control: &|time| control.at(time),
        times: &[1.0],
    };
    let options = HistoryOptions {
        grid: options(0.8, 6.0),
        relative_error: 1e-9,
        max_steps: 4,
    };
    match indent_history(&body, &material, &history, &options) {
        Err(BemError::TimeNotResolved {
            steps: 4, error, ..
        }) => {
            assert!(error > 1e-9 && error < 0.1, "error {error}");
        }
        other => panic!("{other:?}"),
    }
}
