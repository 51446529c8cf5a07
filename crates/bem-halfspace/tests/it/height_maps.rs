//! Surfaces that are no bodies of revolution, and height maps: how far the contact reaches, and how many elements it needs.

use bem_halfspace::{BemError, steady};
use casebook::standard_solid;
use indenters::{HeightMap, Surface};
use numerics::Accuracy;
use rheology::StandardSolid;

use crate::support::{Formula, assert_near, assert_refused, under_force, viscous};

/// h = x² + (y/width)².
fn elliptic(width: f64) -> impl Surface {
    Formula::new([true; 2], move |[x, y]| {
        let y = y / width;
        (x * x + y * y, [2.0 * x, 2.0 * y / width])
    })
}

fn rubber() -> StandardSolid {
    standard_solid([1e6, 1e7, 1e4]).expect("a material")
}

/// The front of a contact that is ten times as long as wide lies higher than twice the depth scale.
#[test]
fn the_footprint_of_a_long_body_on_a_dashpot_grows_with_the_contact() {
    let (body, dashpot, load) = (elliptic(0.1), viscous(1.0), under_force(0.1, 1.0));
    let state = steady(&body, &dashpot, &load, 0.02).expect("a state");
    let on_elements = steady(&body, &dashpot, &load, Accuracy::Elements(24)).expect("a state");
    let [got, expected] = [on_elements, state].map(|state| state.friction_coefficient);
    assert_near(
        "24 elements",
        got.value,
        expected.value,
        got.error + expected.error,
    );
}

/// A patch of one element may be much narrower than that, so that the number that is asked for is not always enough.
#[test]
fn a_patch_of_few_elements_is_refused_with_a_larger_number() {
    let (body, solid, load) = (elliptic(0.05), rubber(), under_force(1e3, 1.0));
    let with = |elements| steady(&body, &solid, &load, Accuracy::Elements(elements));
    assert_refused(1, with(1), "ElementsTooFew");
    let mut elements = 8;
    for _ in 0..3 {
        match with(elements) {
            Ok(_) => break,
            Err(BemError::ElementsTooFew { needed, .. }) => elements = needed,
            Err(error) => panic!("{elements} elements: {error}"),
        }
    }
    assert!(elements > 8, "8 elements are not refused");
    assert!(with(elements).is_ok(), "{elements} elements are not enough");
}

/// A ridge with a flat top of one cell: elements shorter than the top see contact on the flanks as one or two of them.
#[test]
fn the_bar_of_a_contact_on_two_cells_holds() {
    let ([along, across], cell) = ([64, 9], 6.35e-5);
    let height = |row: usize| 0.1 * cell * (row as f64 - 31.5).abs();
    let heights = (0..along)
        .flat_map(|row| vec![height(row); across])
        .collect();
    let map = HeightMap::new([along, across], [cell; 2], heights).expect("a map");
    let (solid, load) = (rubber(), under_force(0.04, 1.0));
    let friction = |elements| {
        let state = steady(&map, &solid, &load, Accuracy::Elements(elements));
        state.expect("a state").friction_coefficient
    };
    let [coarse, fine] = [24, 72].map(friction);
    assert_near("24 elements", coarse.value, fine.value, coarse.error);
}
