use casebook::assert_matches;
use indenters::{AnalyticLine, EquivalentLine, IndenterError, inverse_abel};

use crate::casebook_bodies::body;

#[test]
fn casebook_bodies_come_back_with_their_kinks_named() {
    for case in casebook::group("IND-03") {
        let body = body(&case);
        let height = inverse_abel(&EquivalentLine(&*body), case.input("r"), 1e-12).unwrap();
        // Known kinks leave nothing to search: also the kinked rows reach the smooth tolerance.
        case.check_within("h", height, 1e-9);
    }
}

#[test]
fn casebook_bodies_come_back_without_a_word_about_kinks() {
    for case in casebook::group("IND-03") {
        let body = body(&case);
        let line = AnalyticLine::new(
            |x| body.line_height(x),
            |x| body.line_slope(x),
            [0.0, case.input("r")],
        );
        let tolerance = 0.1 * case.relative_tolerance();
        let height = inverse_abel(&line.unwrap(), case.input("r"), tolerance).unwrap();
        case.check("h", height);
    }
}

#[test]
fn a_line_that_ends_too_early_is_refused() {
    let line = AnalyticLine::new(|x| x, |_| 1.0, [0.0, 1.0]).unwrap();
    assert_eq!(
        inverse_abel(&line, 1.5, 1e-9),
        Err(IndenterError::OutOfDomain {
            position: 1.5,
            lower: 0.0,
            upper: 1.0
        }),
        "the line ends at 1"
    );
}

#[test]
fn an_accuracy_that_is_not_reached_is_not_claimed() {
    // Infinitely many waves towards x = 0, as high there as anywhere.
    let height = |x: f64| if x < 1e-300 { 0.0 } else { x.recip().sin() };
    let line = AnalyticLine::new(height, |_| 0.0, [0.0, 1.0]).unwrap();
    let result = inverse_abel(&line, 0.7, 1e-12);
    assert_matches!(result, Err(IndenterError::NotConverged { reached, .. }) if reached > 1e-12);
}
