//! Motions of mirror symmetric bodies follow one side of the mirror, and know the other.
//!
//! Both are the same discrete problem, solved to 1e-13.

use bem_halfspace::slide::{March, Motion, MotionRow, PressureField};
use bem_halfspace::{Control, Footprint, GridOptions};
use indenters::{HeightMap, PowerProfile, Surface, Unmirrored};
use rheology::Material;

use crate::support::{TIGHT, every_kind_of_material, prony};

const SQUARE: Footprint = Footprint::square(1.5);

fn body() -> PowerProfile {
    PowerProfile::cone(0.4).expect("a body")
}

fn options(footprint: Footprint) -> GridOptions {
    GridOptions {
        contact: TIGHT,
        ..GridOptions::new([0.11, 0.13], footprint)
    }
}

/// Pressed, slid by parts of elements, lifted off, and pressed again where the half space remembers.
fn motions() -> Vec<Motion> {
    let motion = |(time, position, control)| Motion {
        time,
        position,
        control,
    };
    let way = [
        (0.1, 0.0, Control::NormalForce(0.3)),
        (0.3, 0.2, Control::NormalForce(0.5)),
        (0.4, 0.37, Control::NormalForce(0.5)),
        (0.7, 0.9, Control::NormalForce(0.0)),
        (0.8, 0.5, Control::IndentationDepth(0.3)),
        (0.9, 0.61, Control::NormalForce(0.2)),
    ];
    way.map(motion).to_vec()
}

/// Compares numbers of order one.
fn assert_same_row(got: &MotionRow, expected: &MotionRow) {
    let outline = |row: &MotionRow| (row.n_contact, row.contact_x, row.contact_y);
    let name = format!("at {} s", expected.time);
    assert_eq!(outline(got), outline(expected), "contact {name}");
    let numbers = |row: &MotionRow| {
        [
            row.indentation_depth,
            row.normal_force,
            row.tangential_force,
        ]
    };
    for (got, expected) in numbers(got).into_iter().zip(numbers(expected)) {
        assert!(
            (got - expected).abs() < 1e-9,
            "{got} instead of {expected} {name}"
        );
    }
}

fn assert_same_field(got: &PressureField, expected: &PressureField) {
    let place = |field: &PressureField| (field.grid, field.origin);
    assert_eq!(place(got), place(expected), "elements");
    let largest = expected.pressure.iter().copied().fold(0.0, f64::max);
    for (got, expected) in got.pressure.iter().zip(&expected.pressure) {
        assert!(
            (got - expected).abs() <= 1e-8 * largest,
            "pressure {got} instead of {expected}"
        );
    }
}

/// The same without moving.
fn presses() -> Vec<Motion> {
    let still = |motion| Motion {
        position: 0.0,
        ..motion
    };
    motions().into_iter().map(still).collect()
}

/// Compares all steps and returns the number of elements that are followed, in front of the mirrors and without them.
fn compare(
    surface: &impl Surface,
    material: &dyn Material,
    motions: &[Motion],
    footprint: Footprint,
) -> [usize; 2] {
    let options = options(footprint);
    let whole = Unmirrored(surface);
    let mut front = March::new(surface, material, motions, &options).expect("a march");
    let mut all = March::new(&whole, material, motions, &options).expect("a march");
    for _ in motions {
        let got = front.step().expect("a step").expect("a row");
        let expected = all.step().expect("a step").expect("a row");
        assert_same_row(&got, &expected);
        let got = front.pressure().expect("a pressure");
        assert_same_field(&got, &all.pressure().expect("a pressure"));
    }
    [front.n_elements(), all.n_elements()]
}

#[test]
fn one_half_tells_all_of_a_motion() {
    for (name, material) in every_kind_of_material() {
        let [front, all] = compare(&body(), &*material, &motions(), SQUARE);
        // Those through which the mirror passes are followed on either side.
        assert!(
            2 * front > all && front < 5 * all / 9,
            "{name}: {front} elements of {all}"
        );
    }
}

#[test]
fn one_quarter_tells_all_of_an_indenter_that_stays() {
    for (name, material) in every_kind_of_material() {
        let [front, all] = compare(&body(), &*material, &presses(), SQUARE);
        assert!(
            4 * front > all && front < all / 3,
            "{name}: {front} elements of {all}"
        );
    }
}

/// The same ahead and behind, but not right and left.
struct Keel;

impl Surface for Keel {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        x * x + y * y + 0.3 * y * y * y
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [2.0 * x, 2.0 * y + 0.9 * y * y]
    }

    fn mirrors(&self) -> [bool; 2] {
        [true, false]
    }
}

#[test]
fn the_front_tells_all_of_a_keel_until_it_moves() {
    let material = prony([0.1, 0.0], &[(2.0, 0.5)]);
    let [front, all] = compare(&Keel, &material, &presses(), SQUARE);
    assert!(
        2 * front > all && front < 5 * all / 9,
        "{front} elements of {all}"
    );
    let [front, all] = compare(&Keel, &material, &motions(), SQUARE);
    assert_eq!(front, all, "elements");
}

#[test]
fn a_height_map_has_the_mirrors_of_its_nodes() {
    let material = prony([0.1, 0.2], &[(2.0, 0.5)]);
    let height = |node: usize| {
        let [x, y] = [node / 33, node % 33].map(|index| (index as f64 - 16.0) * 0.125);
        0.4 * x * x + 0.7 * y * y + 0.05 * (3.0 * x).cos() * y.abs()
    };
    let map = HeightMap::new([33, 33], [0.125; 2], (0..33 * 33).map(height).collect());
    let [front, all] = compare(&map.expect("a map"), &material, &motions(), SQUARE);
    assert!(
        2 * front > all && front < 5 * all / 9,
        "{front} elements of {all}"
    );
}

#[test]
fn a_footprint_that_is_not_symmetric_is_followed_on_both_sides() {
    let material = prony([0.1, 0.0], &[(2.0, 0.5)]);
    let footprint = Footprint {
        x: SQUARE.x,
        y: [-1.5, 2.5],
    };
    let [front, all] = compare(&body(), &material, &motions(), footprint);
    assert_eq!(front, all, "elements");
}
