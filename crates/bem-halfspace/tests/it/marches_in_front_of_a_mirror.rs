//! Motions of mirror symmetric bodies follow one side of the mirror, and know the other.
//!
//! Both are the same discrete problem, solved to 1e-13.

use bem_halfspace::slide::{March, Motion, MotionRow, PressureField};
use bem_halfspace::{Control, Footprint, GridOptions};
use indenters::{HeightMap, Surface, Unmirrored};
use rheology::Material;

use crate::support::{
    Formula, assert_near, cone, difference, every_kind_of_material, motions, prony, three_elements,
    tight,
};

const SQUARE: Footprint = Footprint::square(1.5);

/// Pressed, slid by parts of elements, lifted off, and pressed again where the half space remembers.
const PATH: [(f64, f64, Control); 6] = [
    (0.1, 0.0, Control::NormalForce(0.3)),
    (0.3, 0.2, Control::NormalForce(0.5)),
    (0.4, 0.37, Control::NormalForce(0.5)),
    (0.7, 0.9, Control::NormalForce(0.0)),
    (0.8, 0.5, Control::IndentationDepth(0.3)),
    (0.9, 0.61, Control::NormalForce(0.2)),
];

/// The same without moving.
fn presses() -> Vec<Motion> {
    motions(PATH.map(|(time, _, control)| (time, 0.0, control)))
}

/// Compares all steps with those without mirrors; of the elements that are followed, which are the numbers in front of
/// the mirrors and without them, the first are one of so many parts: those through which a mirror passes count in each.
fn compare(
    surface: &impl Surface,
    material: &dyn Material,
    (motions, footprint): (&[Motion], Footprint),
    parts: usize,
) {
    let options = tight(GridOptions::new([0.11, 0.13], footprint));
    let whole = Unmirrored(surface);
    let mut front = March::new(surface, material, motions, &options).expect("a march");
    let mut all = March::new(&whole, material, motions, &options).expect("a march");
    for motion in motions {
        let [got, expected] =
            [&mut front, &mut all].map(|march| march.step().expect("a step").expect("a row"));
        let outline = |row: &MotionRow| (row.n_contact, row.contact_x, row.contact_y);
        assert_eq!(outline(&got), outline(&expected), "{motion:?}");
        // Numbers of order one.
        for value in [
            |row: &MotionRow| row.indentation_depth,
            |row: &MotionRow| row.normal_force,
            |row: &MotionRow| row.tangential_force,
        ] {
            assert_near(motion, value(&got), value(&expected), 1e-9);
        }
        let [got, expected] = [&front, &all].map(|march| march.pressure().expect("a pressure"));
        let place = |field: &PressureField| (field.grid, field.origin);
        assert_eq!(place(&got), place(&expected), "{motion:?}");
        if expected.largest() > 0.0 {
            let error = difference(&got.pressure, &expected.pressure);
            assert_near(motion, error, 0.0, 1e-8);
        }
    }
    let [front, all] = [front.n_elements(), all.n_elements()];
    assert!(
        parts * front >= all && 9 * parts * front <= 12 * all && (parts == 1) == (front == all),
        "{front} elements of {all}, in one of {parts} parts"
    );
}

#[test]
fn one_half_tells_all_of_a_motion_and_one_quarter_all_of_an_indenter_that_stays() {
    for (_, material) in every_kind_of_material() {
        compare(&cone(0.4), &*material, (&motions(PATH), SQUARE), 2);
        compare(&cone(0.4), &*material, (&presses(), SQUARE), 4);
    }
}

/// The same ahead and behind, but not right and left.
#[test]
fn the_front_tells_all_of_a_keel_until_it_moves() {
    let keel = Formula {
        mirrors: [true, false],
        ..Formula::new(
            |[x, y]: [f64; 2]| x * x + y * y + 0.3 * y * y * y,
            |[x, y]: [f64; 2]| [2.0 * x, 2.0 * y + 0.9 * y * y],
        )
    };
    let material = three_elements(0.1, 2.0, 0.5);
    compare(&keel, &material, (&presses(), SQUARE), 2);
    compare(&keel, &material, (&motions(PATH), SQUARE), 1);
}

#[test]
fn a_height_map_has_the_mirrors_of_its_nodes() {
    let material = prony([0.1, 0.2], &[(2.0, 0.5)]);
    let height = |node: usize| {
        let [x, y] = [node / 33, node % 33].map(|index| (index as f64 - 16.0) * 0.125);
        0.4 * x * x + 0.7 * y * y + 0.05 * (3.0 * x).cos() * y.abs()
    };
    let map = HeightMap::new([33, 33], [0.125; 2], (0..33 * 33).map(height).collect());
    compare(&map.expect("a map"), &material, (&motions(PATH), SQUARE), 2);
}

#[test]
fn a_footprint_that_is_not_symmetric_is_followed_on_both_sides() {
    let footprint = Footprint {
        x: SQUARE.x,
        y: [-1.5, 2.5],
    };
    let material = three_elements(0.1, 2.0, 0.5);
    compare(&cone(0.4), &material, (&motions(PATH), footprint), 1);
}
