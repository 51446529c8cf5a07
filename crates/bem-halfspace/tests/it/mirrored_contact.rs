//! A contact that is its own mirror image is solved in front of the mirror, and is that of the whole grid.

use bem_halfspace::{Contact, ContactOptions, ContactState, Control, Convolution, Grid};

use crate::support::{Pressing, assert_all_close, assert_near, difference};

const OPTIONS: ContactOptions = ContactOptions {
    tolerance: 1e-11,
    max_iterations: 500,
};

struct Scene {
    name: &'static str,
    body: Pressing,
    control: Control,
}

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
        let height = |[row, column]: [f64; 2]| {
            height(from_middle(row, shape[0]), from_middle(column, shape[1]))
        };
        let body = Pressing {
            options: OPTIONS,
            ..Pressing::new(convolution.clone(), height)
        };
        Scene {
            name,
            body,
            control,
        }
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

fn check_against_whole(scene: &Scene) {
    let Scene {
        name,
        body,
        control,
    } = scene;
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
    let mut state = ContactState::new(&bowl.body.convolution);
    for Scene {
        name,
        body,
        control,
    } in [&bowl, &skew, &bowl, &periodic, &bowl]
    {
        let contact = body.solve_from(&mut state, *control).expect("a contact");
        let (expected, cold) = body.solve(*control);
        assert_eq!(contact.n_contact, expected.n_contact, "{name}");
        let error = difference(state.pressure(), cold.pressure());
        assert_near(name, error, 0.0, 1e-8);
    }
}
