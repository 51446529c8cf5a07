use std::f64::consts::{FRAC_PI_2, PI};

use indenters::stretch;

#[test]
fn stretch_agrees_with_the_casebook() {
    for case in casebook::group("IND-01") {
        if !case.has_input("p") {
            let [one, two, three] = [1.0, 2.0, 3.0].map(|p| stretch(p).unwrap());
            case.check("kappa1", one);
            case.check("kappa2", two);
            case.check("kappa3", three);
            case.check("kappa4", stretch(4.0).unwrap());
            case.check("kappa6", stretch(6.0).unwrap());
            continue;
        }
        case.check("kappa", stretch(case.input("p")).unwrap());
    }
}

#[test]
fn neighbouring_stretches_multiply_to_a_straight_line() {
    // κ(p) κ(p+1) = π (p+1) / 2; each factor carries the rounding of two gamma functions, a few ulps each.
    for p in [1e-9, 0.3, 1.0, 7.5, 62.5, 63.5, 64.0, 1e3, 1e8, 1e15] {
        let actual = stretch(p).unwrap() * stretch(p + 1.0).unwrap();
        let expected = FRAC_PI_2 * (p + 1.0);
        assert!(
            (actual / expected - 1.0).abs() < 1e-14,
            "p = {p}: product {actual}, expected {expected}"
        );
    }
}

#[test]
fn stretch_does_not_jump_where_its_formula_changes() {
    // From one p to the next ulp κ changes by half an ulp; the two formulas may differ by their rounding.
    let [below, above] = [64.0_f64.next_down(), 64.0].map(|p| stretch(p).unwrap());
    assert!(
        (above / below - 1.0).abs() < 4e-15,
        "κ jumps from {below} to {above} at p = 64"
    );
    let asymptote = (0.5 * PI * 1e15_f64).sqrt();
    let actual = stretch(1e15).unwrap();
    assert!(
        (actual / asymptote - 1.0).abs() < 1e-15,
        "κ(1e15) = {actual}, expected {asymptote}"
    );
}
