//! Bad input gives a typed error that names the parameter and its value.

use bem_halfspace::indent::{IndentStep, indent_history_on_grid};
use bem_halfspace::{
    BemError, ContactOptions, ContactProblem, ContactState, Control, Convolution, Footprint, Grid,
    GridOptions, slide_on_grid, solve_contact,
};
use indenters::{FlatPunch, Surface};

use crate::support::Scene;

const BAD: [f64; 5] = [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY];

/// Refuses to slide over so many contact lengths.
fn refused(options: &GridOptions, lengths: f64) -> BemError {
    let scene = Scene::unit(2.0);
    match slide_on_grid(
        &scene.body,
        &scene.material,
        &scene.load_over(lengths),
        options,
    ) {
        Err(error) => error,
        Ok(_) => panic!("accepted {options:?}"),
    }
}

#[test]
fn slide_refuses_options_out_of_range() {
    let good = Scene::unit(2.0).options(4.0);
    for value in BAD {
        for options in [
            GridOptions {
                spacing: [value, good.spacing[1]],
                ..good
            },
            GridOptions {
                spacing: [good.spacing[0], value],
                ..good
            },
            GridOptions {
                footprint: Footprint {
                    x: [-1.0, value],
                    ..good.footprint
                },
                ..good
            },
            GridOptions {
                footprint: Footprint {
                    y: [-value, 1.0],
                    ..good.footprint
                },
                ..good
            },
            GridOptions {
                contact: ContactOptions {
                    tolerance: value,
                    ..good.contact
                },
                ..good
            },
        ] {
            let error = refused(&options, 1.0);
            assert!(
                matches!(error, BemError::InvalidParameter { .. }),
                "{options:?} gave {error}"
            );
        }
    }
}

#[test]
fn a_grid_beyond_memory_is_refused_before_it_is_made() {
    let good = Scene::unit(2.0).options(4.0);
    for spacing in [1e-7, 1e-200, f64::MIN_POSITIVE] {
        let error = refused(
            &GridOptions {
                spacing: [spacing, spacing],
                ..good
            },
            1.0,
        );
        assert!(
            matches!(error, BemError::GridTooLarge { .. }),
            "spacing {spacing} gave {error}"
        );
    }
}

#[test]
fn a_contact_that_leaves_the_footprint_is_an_error() {
    let good = Scene::unit(2.0).options(8.0);
    let length = Scene::unit(2.0).contact_length();
    let error = refused(
        &GridOptions {
            footprint: Footprint::square(0.7 * length),
            ..good
        },
        4.0,
    );
    assert!(
        matches!(error, BemError::ContactReachesBoundary { .. }),
        "{error}"
    );
}

#[test]
fn a_grid_too_coarse_for_the_contact_is_an_error() {
    let error = refused(&Scene::unit(2.0).options(1.0), 8.0);
    assert!(
        matches!(error, BemError::GridTooCoarse { needed: 3, .. }),
        "{error}"
    );
}

#[test]
fn an_exhausted_iteration_says_what_it_reached() {
    let good = Scene::unit(2.0).options(8.0);
    let contact = ContactOptions {
        max_iterations: 1,
        ..good.contact
    };
    match refused(&GridOptions { contact, ..good }, 1.0) {
        BemError::ContactNotConverged {
            iterations: 1,
            residual,
            tolerance,
        } => {
            assert!(
                residual > tolerance && residual.is_finite(),
                "residual {residual}"
            );
        }
        other => panic!("{other}"),
    }
}

/// A surface with one bad height.
struct Broken(f64);

impl Surface for Broken {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        if x > 0.1 { self.0 } else { x * x + y * y }
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [2.0 * x, 2.0 * y]
    }
}

#[test]
fn a_surface_without_numbers_is_refused() {
    let scene = Scene::unit(2.0);
    let options = scene.options(8.0);
    let steps = IndentStep::constant(Control::NormalForce(1.0), &[1.0]);
    for value in [f64::NAN, f64::NEG_INFINITY] {
        let body = Broken(value);
        let slid =
            slide_on_grid(&body, &scene.material, &scene.load_over(1.0), &options).map(|_| ());
        assert!(
            matches!(slid, Err(BemError::InvalidHeight { .. })),
            "{value}: {slid:?}"
        );
        let pressed = indent_history_on_grid(&body, &scene.material, &steps, &options).map(|_| ());
        assert!(
            matches!(pressed, Err(BemError::InvalidHeight { .. })),
            "{value}: {pressed:?}"
        );
    }
}

#[test]
fn a_vertical_wall_in_contact_is_an_error() {
    let scene = Scene::unit(2.0);
    let options = scene.options(8.0);
    let punch = FlatPunch::new(0.5 * scene.contact_length()).expect("a punch");
    let slid = slide_on_grid(&punch, &scene.material, &scene.load_over(1.0), &options).map(|_| ());
    assert!(
        matches!(slid, Err(BemError::VerticalWall { .. })),
        "{slid:?}"
    );
}

#[test]
fn indentation_refuses_forces_and_times_out_of_range() {
    let scene = Scene::unit(2.0);
    let options = scene.options(8.0);
    let refused = |force: f64, times: &[f64]| {
        let steps = IndentStep::constant(Control::NormalForce(force), times);
        let result = indent_history_on_grid(&scene.body, &scene.material, &steps, &options);
        assert!(
            matches!(result, Err(BemError::InvalidParameter { .. })),
            "{force}, {times:?}: {result:?}"
        );
    };
    for value in BAD {
        refused(1.0, &[value]);
    }
    for value in [-1.0, f64::NAN, f64::INFINITY] {
        refused(value, &[1.0]);
    }
    refused(1.0, &[]);
    refused(1.0, &[1e-3, 1e-3]);
    refused(1.0, &[2e-3, 1e-3]);
}

#[test]
fn fields_of_the_wrong_length_and_bad_controls_are_refused() {
    let grid = Grid::new([3, 2], [1.0, 1.0]).expect("a valid grid");
    let convolution = Convolution::new(&grid);
    let solve = |separation: &[f64], compliance: f64, control: Control| {
        let mut state = ContactState::new(&convolution);
        let problem = ContactProblem {
            convolution: &convolution,
            separation,
            compliance,
            control,
        };
        solve_contact(&problem, &mut state, &ContactOptions::default())
    };
    let short = solve(&[0.0; 5], 1.0, Control::NormalForce(1.0));
    assert!(
        matches!(
            short,
            Err(BemError::LengthMismatch {
                length: 5,
                elements: 6,
                ..
            })
        ),
        "{short:?}"
    );
    let nowhere = solve(&[f64::INFINITY; 6], 1.0, Control::NormalForce(1.0));
    assert!(
        matches!(
            nowhere,
            Err(BemError::InvalidParameter {
                parameter: "separation",
                ..
            })
        ),
        "{nowhere:?}"
    );
    for (compliance, control) in [
        (0.0, Control::NormalForce(1.0)),
        (f64::NAN, Control::NormalForce(1.0)),
        (1.0, Control::NormalForce(-1.0)),
        (1.0, Control::NormalForce(f64::NAN)),
        (1.0, Control::IndentationDepth(f64::INFINITY)),
    ] {
        let result = solve(&[0.0; 6], compliance, control);
        assert!(
            matches!(result, Err(BemError::InvalidParameter { .. })),
            "{control:?}: {result:?}"
        );
    }
}

#[test]
fn empty_and_huge_grids_are_refused() {
    assert!(
        matches!(
            Grid::new([0, 4], [1.0, 1.0]),
            Err(BemError::InvalidParameter { .. })
        ),
        "no elements"
    );
    assert!(
        matches!(
            Grid::new([1 << 20, 1 << 20], [1.0; 2]),
            Err(BemError::GridTooLarge { .. })
        ),
        "2^40 elements"
    );
    for value in BAD {
        assert!(
            matches!(
                Grid::new([4, 4], [1.0, value]),
                Err(BemError::InvalidParameter { .. })
            ),
            "{value}"
        );
    }
}

#[test]
fn an_overflow_is_an_error_and_not_a_number() {
    let scene = Scene::unit(2.0);
    let options = scene.options(8.0);
    let steps = IndentStep::constant(Control::NormalForce(1.0), &[1e300]);
    let result = indent_history_on_grid(&scene.body, &scene.material, &steps, &options);
    assert!(result.is_err(), "{result:?}");
}
