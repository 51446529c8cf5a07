//! Marching from first contact ends in the stationary state of `steady`, for every kind of material, also where elements
//! separate and come into contact again.

use indenters::{EquivalentLine, RigidLine};
use mdr_core::SteadySliding;
use rheology::{Compressible, Material};

use crate::support::{assert_agree, line, line_power, load, march, prony, slid};

/// Every kind of material, with a time in which it relaxes near one.
fn materials() -> Vec<Box<dyn Material>> {
    let branches = [(2.0, 10.0), (5.0, 1.0), (10.0, 0.1)];
    let solid = prony([1.0, 0.0], &branches);
    let compressible = Compressible::new(&solid, 0.3).expect("a Poisson ratio");
    vec![
        Box::new(prony([1.0, 0.0], &[])),
        Box::new(prony([0.0, 1.0], &[])),
        Box::new(prony([1.0, 1.0], &[])),
        Box::new(prony([0.0, 0.0], &[(1.0, 1.0)])),
        Box::new(prony([0.0, 0.5], &branches)),
        Box::new(prony([1.0, 0.5], &branches)),
        Box::new(prony([0.0, 0.0], &branches)),
        Box::new(solid),
        Box::new(compressible),
    ]
}

/// Between two elements the line is straight, an error of second order in the spacing. Several short contacts have some
/// tens of elements each, whose ends lie between elements; bars are claimed of one contact.
fn assert_converges(
    line: &impl RigidLine,
    material: &dyn Material,
    force: f64,
    elements: usize,
) -> SteadySliding {
    let load = load(force, 1.0);
    let direct = slid(line, material, &load);
    let marched = march(line, material, &load, elements);
    let [friction, depth] = [marched.friction_coefficient, marched.indentation_depth];
    let slope = 2.0 * direct.friction_coefficient.value + 0.1 * direct.indentation_depth.value;
    assert!(
        (depth.value / direct.indentation_depth.value - 1.0).abs() < 1.5e-3
            && (friction.value - direct.friction_coefficient.value).abs() < 2.5e-3 * slope,
        "{material:?}: depth {depth}, friction {friction}, directly {direct:?}"
    );
    if direct.contacts.len() == 1 {
        assert_agree([friction, direct.friction_coefficient], &material);
        assert_agree([depth, direct.indentation_depth], &material);
    }
    direct
}

#[test]
fn bodies_of_revolution_end_in_the_stationary_state() {
    for exponent in [1.0, 2.0] {
        let body = line_power(0.5, exponent);
        for material in materials() {
            let direct = assert_converges(&EquivalentLine(&body), &*material, 1.0, 200);
            assert_eq!(direct.contacts.len(), 1, "{material:?}: {direct:?}");
        }
    }
}

/// Bumps that meet, one after the other, a surface that has not recovered. Without the history variables at the second
/// contact, depths would be wrong by up to 1.7 %.
#[test]
fn a_line_with_repeated_contact_ends_in_the_stationary_state() {
    let bumps = line([-8.0, 8.0], |x: f64| 0.02 * x * x - 0.2 * (5.0 * x).cos());
    let mut most_contacts = 0;
    for material in materials() {
        for force in [0.4, 2.0] {
            let direct = assert_converges(&bumps, &*material, force, 400);
            most_contacts = most_contacts.max(direct.contacts.len());
        }
    }
    assert!(most_contacts >= 2, "only {most_contacts} contact intervals");
}
