//! A contact that is its own mirror image is solved on the symmetry-reduced domain, with the solution of the whole grid; so are motions of
//! mirror symmetric bodies.

use bem_halfspace::slide::{March, Motion, MotionRow, PressureField};
use bem_halfspace::{Contact, ContactState, Control, Convolution, Footprint, Grid, GridOptions};
use indenters::{HeightMap, Surface, Unmirrored};
use rheology::Material;

use crate::support::{
    Formula, Pressing, assert_all_close, assert_near, cone, difference, every_kind_of_material,
    motions, three_elements, tight,
};

type Scene = (&'static str, Pressing, Control);

/// Bodies with heights over the distances (x, y) from the middle, in elements.
fn scenes(shape: [usize; 2]) -> [Scene; 6] {
    let grid = Grid::new(shape, [1.0, 0.8]).expect("a valid grid");
    let (free, periodic) = (Convolution::new(&grid), Convolution::periodic(&grid));
    let bowl = |x: f64, y: f64| 0.01 * (x * x + 0.5 * y * y);
    let wave = |x: f64, y: f64| (x * 0.5).cos() + (y * 0.4).cos();
    let waves_in_bowl = |x: f64, y: f64| bowl(x, y) + wave(x, y);
    let skew_along_x = |x: f64, y: f64| bowl(x, y) + (0.2 * x).sin();
    let skew_along_y = |x: f64, y: f64| bowl(x, y) + (0.2 * y).sin();
    let [light, heavy] = [300.0, 20_000.0].map(Control::NormalForce);
    let deep = Control::IndentationDepth(3.0);
    let table: [(_, _, &dyn Fn(f64, f64) -> f64, _); 6] = [
        ("a bowl in a box", &free, &bowl, light),
        ("waves at a depth", &free, &waves_in_bowl, deep),
        ("skew along x", &free, &skew_along_x, light),
        ("skew along y", &free, &skew_along_y, heavy),
        ("periodic bowls", &periodic, &bowl, light),
        ("periodic waves, nearly full", &periodic, &wave, heavy),
    ];
    table.map(|(name, convolution, height, control)| {
        let from_middle = |index: f64, length: usize| index - 0.5 * (length as f64 - 1.0);
        let height = |[x, y]: [f64; 2]| height(from_middle(x, shape[0]), from_middle(y, shape[1]));
        (name, Pressing::new(convolution.clone(), height), control)
    })
}

/// The axes along which a field is its own mirror image, to the last bit.
fn mirrors(field: &[f64], columns: usize) -> [bool; 2] {
    let rows = field.chunks_exact(columns);
    let along_x = rows.clone().eq(rows.clone().rev());
    let along_y = rows.into_iter().all(|row| row.iter().eq(row.iter().rev()));
    [along_x, along_y]
}

/// Mirrors lie between elements along axes of an even number of them, and through elements along others.
#[test]
fn the_part_in_front_of_mirrors_has_the_contact_of_the_whole() {
    scenes([72, 88]).iter().for_each(check_against_whole);
    for shape in [[73, 89], [72, 89], [73, 88]] {
        scenes(shape)[..4].iter().for_each(check_against_whole);
    }
}

fn check_against_whole((name, body, control): &Scene) {
    let columns = body.convolution.grid().shape()[1];
    let (folded, state) = body.solve(*control);
    let symmetry = mirrors(&body.heights, columns);
    assert_ne!(symmetry, [false; 2], "{name} has a mirror");
    for field in [state.pressure(), state.displacement()] {
        assert_eq!(mirrors(field, columns), symmetry, "{name}");
    }
    // In a corner and out of reach, or by less than the tolerance.
    let mut broken = body.clone();
    broken.heights[0] += 1e-14 * broken.heights[0].abs();
    let (whole, reference) = broken.solve(*control);
    let of_whole = mirrors(reference.pressure(), columns);
    assert_eq!(of_whole, [false; 2], "{name}: rounding has no mirror");
    assert_eq!(folded.n_contact, whole.n_contact, "{name}");
    let numbers = |contact: Contact| [contact.indentation_depth, contact.normal_force];
    assert_all_close(name, numbers(folded), numbers(whole), 1e-9);
    // Pressure errs by up to twenty times the tolerance; more beside an edge of the contact.
    let error = difference(state.pressure(), reference.pressure());
    assert_near(name, error, 0.0, 1e-8);
}

/// One state is used for one problem after the other: mirrors come and go, and so do periods.
#[test]
fn a_kept_state_finds_the_contact_of_a_new_one() {
    let [bowl, _, skew, _, periodic, _] = scenes([72, 88]);
    let mut state = ContactState::new(&bowl.1.convolution);
    for (name, body, control) in [&bowl, &skew, &bowl, &periodic, &bowl] {
        let contact = body.solve_from(&mut state, *control).expect("a contact");
        let (expected, cold) = body.solve(*control);
        assert_eq!(contact.n_contact, expected.n_contact, "{name}");
        let error = difference(state.pressure(), cold.pressure());
        assert_near(name, error, 0.0, 1e-8);
    }
}

const SQUARE: Footprint = Footprint::square(1.5);

/// Path: pressed, slid by parts of elements, lifted off, and pressed again where the surface has not recovered.
const PATH: [(f64, f64, Control); 6] = [
    (0.1, 0.0, Control::NormalForce(0.3)),
    (0.3, 0.2, Control::NormalForce(0.5)),
    (0.4, 0.37, Control::NormalForce(0.5)),
    (0.7, 0.9, Control::NormalForce(0.0)),
    (0.8, 0.5, Control::IndentationDepth(0.3)),
    (0.9, 0.61, Control::NormalForce(0.2)),
];

/// Compares all steps with those without mirrors. The followed elements are a half or a quarter of all, where elements through which
/// a mirror passes count in each part.
fn compare(
    surface: &impl Surface,
    material: &dyn Material,
    (motions, footprint): (&[Motion], Footprint),
    parts: usize,
) {
    let options = tight(GridOptions::new([0.11, 0.13], footprint));
    let whole = Unmirrored(surface);
    let mut front = March::new(surface, &material, motions, &options).expect("a march");
    let mut all = March::new(&whole, &material, motions, &options).expect("a march");
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
    let is_part = parts * front >= all && 9 * parts * front <= 12 * all;
    assert!(is_part, "{front} of {all}, in one of {parts} parts");
    assert_eq!(parts == 1, front == all, "{front} of {all}");
}

#[test]
fn a_moving_indenter_needs_one_half_and_a_resting_one_a_quarter() {
    let (moving, staying) = (motions(PATH), motions(PATH.map(|(t, _, c)| (t, 0.0, c))));
    for (_, material) in every_kind_of_material() {
        compare(&cone(0.4), &*material, (&moving, SQUARE), 2);
        compare(&cone(0.4), &*material, (&staying, SQUARE), 4);
    }
    let material = three_elements(0.1, 2.0, 0.5);
    // The same ahead and behind, but not right and left.
    let keel = Formula::new([true, false], |[x, y]| {
        let height = x * x + y * y + 0.3 * y * y * y;
        (height, [2.0 * x, 2.0 * y + 0.9 * y * y])
    });
    compare(&keel, &material, (&staying, SQUARE), 2);
    compare(&keel, &material, (&moving, SQUARE), 1);
    // Both sides are followed in a footprint that is not symmetric.
    let mut footprint = SQUARE;
    footprint.y[1] = 2.5;
    compare(&cone(0.4), &material, (&moving, footprint), 1);
    // A height map has the mirrors of its nodes.
    let height = |node: usize| {
        let [x, y] = [node / 33, node % 33].map(|index| (index as f64 - 16.0) * 0.125);
        0.4 * x * x + 0.7 * y * y + 0.05 * (3.0 * x).cos() * y.abs()
    };
    let map = HeightMap::from_gaps([33, 33], [0.125; 2], (0..33 * 33).map(height).collect());
    compare(&map.expect("a map"), &material, (&moving, SQUARE), 2);
}
