//! From first touch on, depth and friction follow the exact solution (casebook MDR-02), where (15) would be wrong by up
//! to 40 %.

use indenters::EquivalentLine;
use mdr_core::{SlideOptions, SlideRow, Transient, slide_on_grid};

use crate::support::{DEPTH, Shape, load, material, slide_to};

const REFINEMENTS: [f64; 6] = [20.0, 40.0, 80.0, 160.0, 320.0, 640.0];

/// The depth of each row against the exact one at its time, in units of the stationary depth: the largest error.
fn largest_depth_error(shape: Shape, n: f64) -> f64 {
    let (transient, length) = march(shape, n);
    let error = |row: &SlideRow| {
        let [exact, _] = shape.exact(row.sliding_distance / length);
        (row.indentation_depth / DEPTH - exact).abs()
    };
    transient.rows.iter().map(error).fold(0.0, f64::max)
}

/// Root mean square over the first two contact lengths of the error of the friction coefficient against the exact one
/// at the middle of the step, to which the mean slope belongs.
fn friction_error(shape: Shape, n: f64) -> f64 {
    let (transient, length) = march(shape, n);
    let limit = transient.last.friction_coefficient;
    let squares: Vec<f64> = transient
        .rows
        .iter()
        .map(|row| (row, (row.sliding_distance - 0.5 * length / n) / length))
        .take_while(|(_, distance)| *distance < 2.0)
        .map(|(row, distance)| {
            let [_, exact] = shape.exact(distance);
            (row.friction_coefficient / limit - exact).powi(2)
        })
        .collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

fn march(shape: Shape, n: f64) -> (Transient, f64) {
    let body = shape.body(2.5);
    let length = body.line_position(DEPTH);
    let transient = slide_to(&EquivalentLine(&body), DEPTH, length / n, 1e-8);
    (transient, length)
}

/// Mean order over several halvings: single ones scatter with the place of the contact's ends between the elements.
fn mean_order(errors: &[f64]) -> f64 {
    (errors[0] / errors[errors.len() - 1]).log2() / (errors.len() - 1) as f64
}

/// A contact of n_c elements gives the depth to about 1/n_c². In the first steps d ∼ Δx^(1/2), n_c ∼ Δx^(−1/2) for the
/// cone, and d ∼ Δx^(2/3), n_c ∼ Δx^(−2/3) for the paraboloid: d/n_c² is of the order 3/2 and 2.
#[test]
fn largest_error_of_the_depth_has_the_order_of_the_start() {
    for (shape, expected) in [(Shape::Cone, 1.5), (Shape::Paraboloid, 2.0)] {
        let errors = REFINEMENTS.map(|n| largest_depth_error(shape, n));
        let order = mean_order(&errors);
        assert!(
            (order - expected).abs() < 0.15,
            "{shape:?}: order {order} instead of {expected}, errors {errors:?}"
        );
    }
}

/// In the transient the trailing end lifts off in the middle of steps, which costs one order against the stationary
/// state.
#[test]
fn friction_of_the_transient_is_first_order() {
    for shape in [Shape::Cone, Shape::Paraboloid] {
        let errors = REFINEMENTS.map(|n| friction_error(shape, n));
        let order = mean_order(&errors);
        assert!(
            (order - 1.0).abs() < 0.15,
            "{shape:?}: order {order} instead of 1, errors {errors:?}"
        );
    }
}

/// Every row of the casebook, with 320 elements along the stationary contact: the depth to 1/n_c², the friction to the
/// half step by which its mean lags plus one element of the contact, the trailing end to one element and one step.
#[test]
fn casebook_rows_come_out() {
    const N: usize = 320;
    for case in casebook::group("MDR-02") {
        if !case.has_input("t") {
            continue;
        }
        let shape = Shape::of(&case);
        let body = shape.body(case.input(if shape == Shape::Cone { "s" } else { "k" }));
        let (material, load) = (
            material(case.input("eta")),
            load(case.input("F"), case.input("v")),
        );
        let options = SlideOptions::with_elements(N, &EquivalentLine(&body), &material, &load)
            .expect("a contact");
        let transient = slide_on_grid(&EquivalentLine(&body), &material, &load, &options)
            .expect("a stationary state");
        let at_time = |row: &&SlideRow| row.time >= case.input("t") * (1.0 - 1e-9);
        let row = transient
            .rows
            .iter()
            .find(at_time)
            .expect("the row of the time");
        let n_contact = row.n_contact as f64;
        case.check_within("d", row.indentation_depth, n_contact.powi(-2));
        let lag = 0.5 * options.spacing / row.sliding_distance;
        case.check_within("mu", row.friction_coefficient, lag + 1.0 / n_contact);
        let trailing_end = case.expected("x_trail").expect("a trailing end");
        let difference = row.contact[0] - trailing_end;
        assert!(
            difference.abs() <= 2.0 * options.spacing,
            "{}: trailing end {} instead of {trailing_end}",
            case.id(),
            row.contact[0]
        );
    }
}

/// 99 % of the depth is reached after the distance of the casebook, to one step.
#[test]
fn ninety_nine_per_cent_take_the_distance_of_the_casebook() {
    let cases = casebook::group("MDR-02");
    let case = cases
        .iter()
        .find(|case| case.id().ends_with("99 percent distance"))
        .expect("the row of the distance");
    for (shape, name) in [
        (Shape::Cone, "cone_vt_over_xd"),
        (Shape::Paraboloid, "paraboloid_vt_over_xd"),
    ] {
        let n = 160.0;
        let (transient, length) = march(shape, n);
        let reached = |row: &&SlideRow| row.indentation_depth >= 0.99 * DEPTH;
        let row = transient.rows.iter().find(reached).expect("99 %");
        let expected = case.expected(name).expect("a distance");
        let actual = row.sliding_distance / length;
        assert!(
            (actual - expected).abs() <= 1.0 / n,
            "{shape:?}: {actual} instead of {expected}"
        );
    }
}
