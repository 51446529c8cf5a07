//! The smallest contacts, bodies with holes, and the load that vanishes.

use bem_halfspace::{Contact, ContactState, Control};
use casebook::{Case, group};

use crate::support::Pressing;

fn case(name: &str) -> Case {
    let id = format!("EXT-02/{name}");
    let mut cases = group("EXT-02").into_iter();
    cases
        .find(|case| case.id() == id)
        .expect("a case of this name")
}

fn contact(shape: [usize; 2], heights: &[f64], control: Control) -> (Contact, ContactState) {
    Pressing::on_unit_elements(shape, heights).solve(control)
}

#[test]
fn one_element_has_the_stiffness_of_its_self_influence() {
    let (at_depth, _) = contact([1, 1], &[0.0], Control::IndentationDepth(1.0));
    case("BEM single cell h=1 G=1 d=1").check("F", at_depth.normal_force);
    let force = Control::NormalForce(at_depth.normal_force);
    let (at_force, _) = contact([1, 1], &[0.0], force);
    let error = (at_force.indentation_depth - 1.0).abs();
    assert!(error < 1e-14, "{at_force:?}");
}

/// Where there is no body (height +∞) there is no contact.
#[test]
fn two_isolated_elements_share_the_load() {
    let mut heights = [f64::INFINITY; 6];
    (heights[0], heights[5]) = (0.0, 0.0);
    let (pressed, state) = contact([6, 1], &heights, Control::IndentationDepth(1.0));
    let case = case("two equal isolated cells at distance 5h, h=1 G=1 d=1");
    case.check("F_total", pressed.normal_force);
    assert_eq!(state.contact(), [0, 5], "only elements with a body");
}

#[test]
fn no_force_means_no_contact() {
    let (unloaded, state) = contact([3, 1], &[0.3, 0.0, 0.2], Control::NormalForce(0.0));
    assert_eq!(unloaded.n_contact, 0, "{unloaded:?}");
    let depth = unloaded.indentation_depth.abs();
    assert!(depth < f64::MIN_POSITIVE, "the body touches: {unloaded:?}");
    let pressure = state.pressure();
    assert!(pressure.iter().all(|value| *value == 0.0), "{pressure:?}");
}

#[test]
fn a_body_held_above_the_surface_carries_nothing() {
    let control = Control::IndentationDepth(-0.1);
    let (held, _) = contact([1, 3], &[0.3, 0.0, 0.2], control);
    assert_eq!((held.n_contact, held.normal_force), (0, 0.0), "{held:?}");
}
