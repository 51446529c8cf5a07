use std::f64::consts::{FRAC_PI_2, PI};

use casebook::assert_close;

fn stretch(exponent: f64) -> f64 {
    indenters::stretch(exponent).unwrap()
}

#[test]
fn stretch_agrees_with_the_casebook() {
    for case in casebook::group("IND-01") {
        if case.has_input("p") {
            case.check("kappa", stretch(case.input("p")));
            continue;
        }
        for p in [1.0, 2.0, 3.0, 4.0, 6.0] {
            case.check(&format!("kappa{p}"), stretch(p));
        }
    }
}

#[test]
fn neighbouring_stretches_multiply_to_a_straight_line() {
    // κ(p) κ(p+1) = π (p+1) / 2; each factor carries the rounding of two gamma functions, a few ulps each.
    for p in [1e-9, 0.3, 1.0, 7.5, 62.5, 63.5, 64.0, 1e3, 1e8, 1e15] {
        let product = stretch(p) * stretch(p + 1.0);
        assert_close!(product => FRAC_PI_2 * (p + 1.0), within 1e-14; "p = {p}");
    }
}

#[test]
fn stretch_does_not_jump_where_its_formula_changes() {
    // From one p to the next ulp κ changes by half an ulp; the two formulas may differ by their rounding.
    assert_close!(stretch(64.0) => stretch(64.0_f64.next_down()), within 4e-15);
    assert_close!(stretch(1e15) => (0.5 * PI * 1e15_f64).sqrt(), within 1e-15);
}
