//! The smallest contacts, bodies with holes, and the load that vanishes.

use bem_halfspace::Control;
use casebook::{Case, group};

use crate::support::elastic_contact;

fn case(name: &str) -> Case {
    let id = format!("EXT-02/{name}");
    group("EXT-02")
        .into_iter()
        .find(|case| case.id() == id)
        .expect("a case of this name")
}

#[test]
fn one_element_has_the_stiffness_of_its_self_influence() {
    let (contact, _) = elastic_contact(&[0.0], [1, 1], Control::IndentationDepth(1.0));
    case("BEM single cell h=1 G=1 d=1").check("F", contact.normal_force);
    let (contact, _) = elastic_contact(&[0.0], [1, 1], Control::NormalForce(contact.normal_force));
    assert!(
        (contact.indentation_depth - 1.0).abs() < 1e-14,
        "depth {}",
        contact.indentation_depth
    );
}

/// Where there is no body (height +∞) there is no contact.
#[test]
fn two_isolated_elements_share_the_load() {
    let mut heights = vec![f64::INFINITY; 6];
    (heights[0], heights[5]) = (0.0, 0.0);
    let (contact, state) = elastic_contact(&heights, [6, 1], Control::IndentationDepth(1.0));
    case("two equal isolated cells at distance 5h, h=1 G=1 d=1")
        .check("F_total", contact.normal_force);
    assert_eq!(
        state.contact(),
        [0, 5],
        "only the two elements with a body carry load"
    );
}

#[test]
fn no_force_means_no_contact() {
    let (contact, state) = elastic_contact(&[0.3, 0.0, 0.2], [3, 1], Control::NormalForce(0.0));
    assert_eq!(contact.n_contact, 0, "{contact:?}");
    assert!(
        contact.indentation_depth.abs() < f64::MIN_POSITIVE,
        "the body touches: {contact:?}"
    );
    assert!(
        state.pressure().iter().all(|pressure| *pressure == 0.0),
        "{:?}",
        state.pressure()
    );
}

#[test]
fn a_body_held_above_the_surface_carries_nothing() {
    let (contact, _) = elastic_contact(&[0.3, 0.0, 0.2], [1, 3], Control::IndentationDepth(-0.1));
    assert_eq!(
        (contact.n_contact, contact.normal_force),
        (0, 0.0),
        "{contact:?}"
    );
}
