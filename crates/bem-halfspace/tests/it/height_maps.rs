//! Surfaces that are no bodies of revolution, and height maps: how far the contact reaches, and how many elements it needs.

use bem_halfspace::{BemError, steady};
use casebook::standard_solid;
use indenters::{HeightMap, Surface};
use numerics::{Accuracy, Estimate};
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

/// Both sides of a ridge across the motion end along rows of elements, which leave or join the contact in one step. Friction is a
/// small difference of its flanks, and several grids agree by chance.
#[test]
fn bars_hold_under_ridges_with_a_top_inside_one_cell() {
    let (n, cell) = (64, 6.35e-5);
    // Apex, slopes behind and ahead of it, and the friction of `steady` to a relative error of 0.08.
    let ridges = [
        ([31.5, 0.1, 0.1], Estimate::new(4.4274e-3, 2.9e-4)),
        ([31.7, 0.1, 0.03], Estimate::new(4.6883e-3, 6.8e-5)),
    ];
    for ([apex, rear, front], fine) in ridges {
        let height = |row: usize| {
            let x = row as f64 - apex;
            cell * if x < 0.0 { -rear * x } else { front * x }
        };
        let heights = (0..n).flat_map(|row| vec![height(row); n]);
        let map = HeightMap::from_gaps([n; 2], [cell; 2], heights.collect()).expect("a map");
        let friction = |elements| {
            let accuracy = Accuracy::Elements(elements);
            let state = steady(&map, &rubber(), &under_force(0.3, 1.0), accuracy);
            state.expect("a state").friction_coefficient
        };
        for elements in [16, 24, 32] {
            let coarse = friction(elements);
            let name = format!("slopes {rear} and {front}, {elements} elements");
            assert_near(&name, coarse.value, fine.value, coarse.error + fine.error);
        }
    }
}

/// Coarse elements average over the cells of a map, whose edges add some per cent to the friction of a material that relaxes within an
/// element.
#[test]
fn bars_contain_the_friction_of_cells_shorter_than_an_element() {
    let (n, cell) = (64, 6.35e-5);
    let from_apex = |index: usize, apex: f64| index as f64 - 31.5 - apex;
    let height = |index: usize| {
        let [row, column] = [from_apex(index / n, 0.3), from_apex(index % n, 0.1)];
        0.004 * cell * (row * row + column * column)
    };
    let heights = (0..n * n).map(height).collect();
    let map = HeightMap::from_gaps([n, n], [cell; 2], heights).expect("a map");
    let fast = standard_solid([1e6, 1e7, 1e2]).expect("a material");
    let friction = |elements| {
        let accuracy = Accuracy::Elements(elements);
        let state = steady(&map, &fast, &under_force(0.3, 1.0), accuracy);
        state.expect("a state").friction_coefficient
    };
    // The friction of `steady` on 96 elements.
    let fine = Estimate::new(0.011_564_6, 8.3e-5);
    for elements in [12, 16, 24] {
        let coarse = friction(elements);
        let bars = coarse.error + fine.error;
        assert_near(
            format!("{elements} elements"),
            coarse.value,
            fine.value,
            bars,
        );
    }
}
