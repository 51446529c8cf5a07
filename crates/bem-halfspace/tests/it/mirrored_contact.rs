//! A contact that is its own mirror image is solved in front of the mirror, and is that of the whole grid.

use bem_halfspace::{
    Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    solve_contact,
};

const OPTIONS: ContactOptions = ContactOptions {
    tolerance: 1e-11,
    max_iterations: 500,
};

struct Scene {
    name: &'static str,
    convolution: Convolution,
    heights: Vec<f64>,
    control: Control,
}

/// Heights over the distances (x, y) from the middle, in elements.
fn field([rows, columns]: [usize; 2], height: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let centre = |index: usize, length: usize| index as f64 - 0.5 * (length as f64 - 1.0);
    let at = |index: usize| {
        height(
            centre(index / columns, rows),
            centre(index % columns, columns),
        )
    };
    (0..rows * columns).map(at).collect()
}

fn scenes(shape: [usize; 2]) -> [Scene; 6] {
    let grid = Grid::new(shape, [1.0, 0.8]).expect("a valid grid");
    let (free, periodic) = (Convolution::new(&grid), Convolution::periodic(&grid));
    let wave = |x: f64, y: f64| (x * 0.5).cos() + (y * 0.4).cos();
    let bowl = |x: f64, y: f64| 0.01 * (x * x + 0.5 * y * y);
    let scene =
        |name, convolution: &Convolution, height: &dyn Fn(f64, f64) -> f64, control| Scene {
            name,
            convolution: convolution.clone(),
            heights: field(shape, height),
            control,
        };
    let [light, heavy] = [300.0, 20_000.0].map(Control::NormalForce);
    let deep = Control::IndentationDepth(3.0);
    [
        scene("a bowl in a box", &free, &bowl, light),
        scene(
            "waves at a depth",
            &free,
            &|x, y| bowl(x, y) + wave(x, y),
            deep,
        ),
        scene(
            "skew along x",
            &free,
            &|x, y| bowl(x, y) + (0.2 * x).sin(),
            light,
        ),
        scene(
            "skew along y",
            &free,
            &|x, y| bowl(x, y) + (0.2 * y).sin(),
            heavy,
        ),
        scene("periodic bowls", &periodic, &bowl, light),
        scene("periodic waves, nearly full", &periodic, &wave, heavy),
    ]
}

fn solve(scene: &Scene, heights: &[f64]) -> (Contact, ContactState) {
    let problem = ContactProblem {
        convolution: &scene.convolution,
        separation: heights,
        compliance: 1.0,
        control: scene.control,
    };
    let mut state = ContactState::new(&scene.convolution);
    let contact = solve_contact(&problem, &mut state, &OPTIONS);
    (contact.expect(scene.name), state)
}

/// The axes along which a field is its own mirror image, to the last bit.
fn mirrors(field: &[f64], columns: usize) -> [bool; 2] {
    let rows = field.chunks_exact(columns);
    let along_x = rows.clone().eq(rows.clone().rev());
    let along_y = rows.into_iter().all(|row| row.iter().eq(row.iter().rev()));
    [along_x, along_y]
}

#[test]
fn the_part_in_front_of_edges_has_the_contact_of_the_whole() {
    for scene in scenes([72, 88]) {
        check_against_whole(&scene);
    }
}

#[test]
fn the_part_in_front_of_centres_has_the_contact_of_the_whole() {
    for shape in [[73, 89], [72, 89], [73, 88]] {
        let [bowl, waves, skew_x, skew_y, ..] = scenes(shape);
        for scene in [bowl, waves, skew_x, skew_y] {
            check_against_whole(&scene);
        }
    }
}

fn check_against_whole(scene: &Scene) {
    let columns = scene.convolution.grid().shape()[1];
    let name = scene.name;
    let (folded, state) = solve(scene, &scene.heights);
    let symmetry = mirrors(&scene.heights, columns);
    assert_ne!(symmetry, [false; 2], "{name} has a mirror");
    for field in [state.pressure(), state.displacement()] {
        assert_eq!(mirrors(field, columns), symmetry, "{name}");
    }
    // In a corner and out of reach, or by less than the tolerance.
    let mut broken = scene.heights.clone();
    broken[0] += 1e-14 * broken[0].abs();
    let (whole, reference) = solve(scene, &broken);
    let of_whole = mirrors(reference.pressure(), columns);
    assert_eq!(of_whole, [false; 2], "{name}: rounding has no mirror");
    assert_eq!(folded.n_contact, whole.n_contact, "{name}");
    for [actual, expected] in [
        [folded.indentation_depth, whole.indentation_depth],
        [folded.normal_force, whole.normal_force],
    ] {
        let error = (actual / expected - 1.0).abs();
        assert!(error < 1e-9, "{name}: {actual} instead of {expected}");
    }
    let largest = reference.pressure().iter().copied().fold(0.0, f64::max);
    for (actual, expected) in state.pressure().iter().zip(reference.pressure()) {
        // Pressure errs by up to twenty times the tolerance; more beside an edge of the contact.
        let error = (actual - expected).abs() / largest;
        assert!(error < 1e-8, "{name}: {actual} instead of {expected}");
    }
}

/// The state serves one problem after the other: mirrors come and go, and so do periods.
#[test]
fn a_kept_state_answers_like_a_new_one() {
    let [bowl, _, skew, _, periodic, _] = scenes([72, 88]);
    let mut state = ContactState::new(&bowl.convolution);
    for scene in [&bowl, &skew, &bowl, &periodic, &bowl] {
        let problem = ContactProblem {
            convolution: &scene.convolution,
            separation: &scene.heights,
            compliance: 1.0,
            control: scene.control,
        };
        let contact = solve_contact(&problem, &mut state, &OPTIONS).expect("a contact");
        let (expected, cold) = solve(scene, &scene.heights);
        let name = scene.name;
        assert_eq!(contact.n_contact, expected.n_contact, "{name}");
        let largest = cold.pressure().iter().copied().fold(0.0, f64::max);
        for (actual, expected) in state.pressure().iter().zip(cold.pressure()) {
            let error = (actual - expected).abs() / largest;
            assert!(error < 1e-8, "{name}: {actual} instead of {expected}");
        }
    }
}
