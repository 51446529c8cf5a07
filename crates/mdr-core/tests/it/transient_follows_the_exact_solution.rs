//! From first touch on, depth and friction follow the exact solution (casebook MDR-02), where (15) would be wrong by up
//! to 40 %.

use friction_analytic::{power_sliding, transient_sliding};
use indenters::EquivalentLine;
use mdr_core::{SlideRow, Transient};

use crate::support::{DEPTH, assert_close, body_of, line_power, load, march, material, slide_to};

const REFINEMENTS: [f64; 6] = [20.0, 40.0, 80.0, 160.0, 320.0, 640.0];

/// Exact [d/D, μ/μ_∞] of a power after sliding over a distance in stationary contact lengths.
fn exact(exponent: f64, distance: f64) -> [f64; 2] {
    // With a depth, a contact length and a speed of one, the time is the distance.
    let (body, material, load) = (line_power(1.0, exponent), material(1.0), load(4.0, 1.0));
    let limit = power_sliding(&body, &material, &load).expect("a stationary state");
    let transient = transient_sliding(&body, &material, &load, distance).expect("a transient");
    [
        transient.indentation_depth / limit.indentation_depth,
        transient.friction_coefficient / limit.friction_coefficient,
    ]
}

/// A march with n elements along the stationary contact, and the length of that.
fn marched(exponent: f64, n: f64) -> (Transient, f64) {
    let body = line_power(2.5, exponent);
    let length = body.line_position(DEPTH);
    let transient = slide_to(&EquivalentLine(&body), DEPTH, length / n, 1e-8);
    (transient.expect("a stationary state"), length)
}

/// The depth of each row against the exact one at its time, in units of the stationary depth: the largest error.
fn largest_depth_error(exponent: f64, n: f64) -> f64 {
    let (transient, length) = marched(exponent, n);
    let error = |row: &SlideRow| {
        let [exact, _] = exact(exponent, row.sliding_distance / length);
        (row.indentation_depth / DEPTH - exact).abs()
    };
    transient.rows.iter().map(error).fold(0.0, f64::max)
}

/// Root mean square over the first two contact lengths of the error of the friction coefficient against the exact one
/// at the middle of the step, to which the mean slope belongs.
fn friction_error(exponent: f64, n: f64) -> f64 {
    let (transient, length) = marched(exponent, n);
    let limit = transient.last.friction_coefficient;
    let middles = transient.rows.iter().map(|row| {
        let distance = (row.sliding_distance - 0.5 * length / n) / length;
        (row.friction_coefficient / limit, distance)
    });
    let squares: Vec<f64> = middles
        .take_while(|(_, distance)| *distance < 2.0)
        .map(|(friction, distance)| (friction - exact(exponent, distance)[1]).powi(2))
        .collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// A contact of n_c elements gives the depth to about 1/n_c². In the first steps d ∼ Δx^(1/2), n_c ∼ Δx^(−1/2) for the
/// cone, and d ∼ Δx^(2/3), n_c ∼ Δx^(−2/3) for the paraboloid: d/n_c² is of the order 3/2 and 2. In the transient the
/// trailing end lifts off in the middle of steps, which costs the friction one order against the stationary state.
#[test]
fn largest_errors_of_depth_and_friction_have_the_order_of_the_start() {
    let of_depth = largest_depth_error as fn(f64, f64) -> f64;
    for (name, error_of, exponent, expected) in [
        ("depth", of_depth, 1.0, 1.5),
        ("depth", of_depth, 2.0, 2.0),
        ("friction", friction_error, 1.0, 1.0),
        ("friction", friction_error, 2.0, 1.0),
    ] {
        let errors = REFINEMENTS.map(|n| error_of(exponent, n));
        // Single halvings scatter with the place of the contact's ends between the elements.
        let order = (errors[0] / errors[5]).log2() / 5.0;
        assert!(
            (order - expected).abs() < 0.15,
            "{name}, p = {exponent}: order {order} instead of {expected}, errors {errors:?}"
        );
    }
}

/// Every row of the casebook, with 320 elements along the stationary contact: the depth to 1/n_c², the friction to the
/// half step by which its mean lags plus one element of the contact, the trailing end to one element and one step; and
/// the distance after which 99 % of the depth is reached, to one step.
#[test]
fn casebook_rows_come_out() {
    for case in casebook::group("MDR-02") {
        if !case.has_input("t") {
            for (exponent, name) in [(1.0, "cone_vt_over_xd"), (2.0, "paraboloid_vt_over_xd")] {
                let (transient, length) = marched(exponent, 160.0);
                let reached = |row: &&SlideRow| row.indentation_depth >= 0.99 * DEPTH;
                let row = transient.rows.iter().find(reached).expect("99 %");
                let expected = case.expected(name).expect("a distance");
                let actual = row.sliding_distance / length;
                assert_close([actual, expected], 1.0 / 160.0 / expected, 0.0, &name);
            }
            continue;
        }
        let (body, dashpot) = (body_of(&case), material(case.input("eta")));
        let load = load(case.input("F"), case.input("v"));
        let transient = march(&EquivalentLine(&*body), &dashpot, &load, 320, 1e-9);
        let spacing = transient.rows[0].sliding_distance;
        let at_time = |row: &&SlideRow| row.time >= case.input("t") * (1.0 - 1e-9);
        let row = transient.rows.iter().find(at_time).expect("the row");
        let n_contact = row.n_contact as f64;
        case.check_within("d", row.indentation_depth, n_contact.powi(-2));
        let lag = 0.5 * spacing / row.sliding_distance;
        case.check_within("mu", row.friction_coefficient, lag + 1.0 / n_contact);
        let trailing_end = case.expected("x_trail").expect("a trailing end");
        let off = row.contact[0] - trailing_end;
        assert_close([off, 0.0], 2.0, spacing, &case.id());
    }
}
