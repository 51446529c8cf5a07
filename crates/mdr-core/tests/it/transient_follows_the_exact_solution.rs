//! From first touch on, depth and friction follow the exact solution (casebook MDR-02), where (15) would be wrong by up
//! to 40 %.

use indenters::EquivalentLine;
use mdr_core::SlidingStep;

use crate::support::{DEPTH, assert_close, body_of, line_power, load, march, material, slide_to};

/// Every row of the casebook, with 320 elements along the stationary contact: the depth to 1/n_c², the friction to the
/// half step by which its mean lags plus one element of the contact, the trailing end to one element and one step; and
/// the distance after which 99 % of the depth is reached, to one step.
#[test]
fn casebook_rows_come_out() {
    for case in casebook::group("MDR-02") {
        if !case.has_input("t") {
            for (exponent, name) in [(1.0, "cone_vt_over_xd"), (2.0, "paraboloid_vt_over_xd")] {
                let body = line_power(2.5, exponent);
                let sliding = slide_to(&EquivalentLine(&body), DEPTH, 160).expect("a state");
                let reached = |row: &&SlidingStep| row.indentation_depth >= 0.99 * DEPTH;
                let row = sliding.steps.iter().find(reached).expect("99 %");
                let expected = case.expected(name).expect("a distance");
                let actual = row.sliding_distance / body.line_position(DEPTH);
                assert_close([actual, expected], 1.0 / 160.0 / expected, 0.0, &name);
            }
            continue;
        }
        let (body, dashpot) = (body_of(&case), material(case.input("eta")));
        let load = load(case.input("F"), case.input("v"));
        let sliding = march(&EquivalentLine(&*body), &dashpot, &load, 320);
        let spacing = sliding.spacing;
        let at_time = |row: &&SlidingStep| row.time >= case.input("t") * (1.0 - 1e-9);
        let row = sliding.steps.iter().find(at_time).expect("the row");
        let n_contact = row.n_contact as f64;
        case.check_within("d", row.indentation_depth, n_contact.powi(-2));
        let lag = 0.5 * spacing / row.sliding_distance;
        case.check_within("mu", row.friction_coefficient, lag + 1.0 / n_contact);
        let trailing_end = case.expected("x_trail").expect("a trailing end");
        let off = row.contact[0] - trailing_end;
        assert_close([off, 0.0], 2.0, spacing, &case.id());
    }
}
