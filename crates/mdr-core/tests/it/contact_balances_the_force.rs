//! One instant: the forces are compressive, act only on touched elements, and balance the normal force to rounding.

use mdr_core::{Element, Instant, MdrError};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn element() -> Element {
    Element::new(0.1, 1.0).expect("an element")
}

#[test]
fn single_element_is_four_times_modulus_and_spacing() {
    let cases = casebook::group("EXT-02");
    let find = |name: &str| {
        let case = cases.iter().find(|case| case.id().contains(name));
        case.unwrap_or_else(|| panic!("no row {name}"))
    };
    let case = find("MDR single element");
    let element = Element::new(case.input("dx"), 1.0 / case.input("G")).expect("an element");
    let instant = Instant::new(&[0.0], &[0.0], element).expect("an instant");
    let contact = instant
        .contact_at_depth(case.input("d"))
        .expect("a contact");
    case.check("F", contact.normal_force);
    let back = instant
        .contact_at_force(contact.normal_force)
        .expect("a contact");
    assert!(
        (back.indentation_depth - case.input("d")).abs() < 1e-15,
        "{back:?} instead of depth 1"
    );
    let case = find("force exactly zero");
    let contact = instant
        .contact_at_force(case.input("F"))
        .expect("a contact");
    case.check("d", contact.indentation_depth);
    case.check("contact_cells", contact.n_contact as f64);
}

#[test]
fn holes_are_never_in_contact() {
    let heights = [f64::INFINITY, 0.0, f64::INFINITY, 0.5];
    let instant = Instant::new(&heights, &[0.0; 4], element()).expect("an instant");
    // 0.4 N per metre of compression: 1 N compress the two elements by 2.5 in sum.
    let contact = instant.contact_at_force(1.0).expect("a contact");
    assert!(
        (contact.indentation_depth - 1.5).abs() < 1e-15 && contact.n_contact == 2,
        "{contact:?} instead of depth 1.5 on two elements"
    );
    let forces: Vec<f64> = instant.forces(contact.indentation_depth).collect();
    assert!(
        forces[0].abs() + forces[2].abs() < f64::MIN_POSITIVE,
        "holes carry {forces:?}"
    );
}

fn refusal(heights: &[f64], displacements: &[f64]) -> MdrError {
    Instant::new(heights, displacements, element()).expect_err("bad elements")
}

#[test]
fn bad_elements_are_named() {
    for (heights, displacements, expected) in [
        ([0.0, f64::NAN], [0.0; 2], ("height", 1)),
        ([f64::NEG_INFINITY, 0.0], [0.0; 2], ("height", 0)),
        ([f64::INFINITY; 2], [0.0; 2], ("height", 0)),
        ([0.0; 2], [0.0, f64::INFINITY], ("displacement", 1)),
    ] {
        match refusal(&heights, &displacements) {
            MdrError::InvalidElement {
                quantity, element, ..
            } => assert_eq!(
                (quantity, element),
                expected,
                "{heights:?}, {displacements:?}"
            ),
            other => panic!("{heights:?}, {displacements:?}: {other:?}"),
        }
    }
}

#[test]
fn lists_that_do_not_fit_are_refused() {
    let different = MdrError::LengthMismatch {
        first: "heights",
        first_length: 2,
        second: "displacements",
        second_length: 1,
    };
    assert_eq!(refusal(&[0.0, 1.0], &[0.0]), different, "lengths 2 and 1");
    let empty = MdrError::Empty { list: "heights" };
    assert_eq!(refusal(&[], &[]), empty, "no elements");
}

/// The depth by sorting: the first k elements in the order of touch carry the load when the next is not reached.
fn depth_by_sorting(touch_depths: &[f64], needed: f64) -> f64 {
    let mut sorted = touch_depths.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mut sum = 0.0;
    for (index, touch) in sorted.iter().enumerate() {
        sum += touch;
        let depth = (needed + sum) / (index + 1) as f64;
        if sorted.get(index + 1).is_none_or(|next| depth <= *next) {
            return depth;
        }
    }
    f64::NAN
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 512,
        rng_seed: RngSeed::Fixed(2014),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn any_chain_is_in_balance(
        elements in prop::collection::vec((0.0..1.0_f64, -0.5..0.5_f64), 1..200),
        exponents in (-6.0..3.0_f64, 0.0..60.0_f64),
    ) {
        // Touch depths over many decades make the contacts of Newton's steps shrink slowly.
        let spread = |x: f64| 2.0_f64.powf(-exponents.1 * x);
        let heights: Vec<f64> = elements.iter().map(|(height, _)| spread(*height)).collect();
        let displacements: Vec<f64> = elements.iter().map(|(_, u)| 1e-3 * u).collect();
        let touch: Vec<f64> = heights.iter().zip(&displacements).map(|(h, u)| h + u).collect();
        let force = 10.0_f64.powf(exponents.0);
        let instant = Instant::new(&heights, &displacements, element()).expect("an instant");
        let contact = instant.contact_at_force(force).expect("a contact");
        let depth = contact.indentation_depth;
        let n_contact = touch.iter().filter(|t| **t < depth).count();
        prop_assert_eq!(contact.n_contact, n_contact, "complementarity: loaded below the depth");

        // The depth is a number with ε relative rounding, times the stiffness of the contact.
        let n = n_contact as f64;
        let scale = touch.iter().fold(depth.abs(), |a, t| a.max(if *t < depth { t.abs() } else { 0.0 }));
        let rounding = element().force(2.0 * n * f64::EPSILON * scale) + 2.0 * f64::EPSILON * force;
        let sum: f64 = instant.forces(depth).sum();
        prop_assert!((contact.normal_force - force).abs() <= rounding, "{contact:?} for {force}");
        prop_assert!((sum - force).abs() <= rounding * (1.0 + n), "sum {sum} for {force}");
        prop_assert!(instant.forces(depth).all(|f| f >= 0.0), "tension");

        let expected = depth_by_sorting(&touch, element().compression(force));
        // The sum of n sorted numbers by the oracle rounds n times.
        prop_assert!(
            (depth - expected).abs() <= 4.0 * n * f64::EPSILON * scale.max(expected.abs()),
            "depth {depth} instead of {expected}"
        );
    }
}
