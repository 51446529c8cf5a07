//! Bad input is refused with its name and value, before anything is computed (casebook EXT-01).

use indenters::{EquivalentLine, IndenterError, RigidLine, SlidingLoad};
use mdr_core::{
    Element, IndentControl, IndentOptions, IndentStep, MdrError, SlideOptions, SlidingDepth,
    SteadyOptions, indent, indent_history, slide, steady, steady_at_depth,
};

use crate::support::{Cubic, DEPTH, VISCOSITY, load_for_depth, material, power};

const BAD: [f64; 6] = [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

fn good_options() -> SlideOptions {
    SlideOptions {
        spacing: 0.01,
        drift_tolerance: 1e-6,
        max_sliding_distance: 10.0,
    }
}

fn slide_with(options: &SlideOptions) -> Result<(), MdrError> {
    let line = EquivalentLine(&power(2.0));
    slide(&line, &material(VISCOSITY), &load_for_depth(DEPTH), options).map(|_| ())
}

fn assert_refused<T: std::fmt::Debug>(result: Result<T, MdrError>, name: &str, bad: f64) {
    match result {
        Err(MdrError::InvalidParameter {
            parameter, value, ..
        }) => {
            assert_eq!(parameter, name, "name of the refused {bad}");
            assert_eq!(
                value.to_bits(),
                bad.to_bits(),
                "value of the refused {name}"
            );
        }
        other => panic!("{name} = {bad}: {other:?}"),
    }
}

#[test]
fn the_good_options_are_accepted() {
    assert_eq!(
        slide_with(&good_options()),
        Ok(()),
        "nothing is wrong with them"
    );
}

/// Rows 16 and 21: the spacing is the grid and, through the speed, the time step.
#[test]
fn numerics_of_sliding_are_checked() {
    for bad in BAD {
        assert_refused(
            slide_with(&SlideOptions {
                spacing: bad,
                ..good_options()
            }),
            "spacing",
            bad,
        );
        let options = SlideOptions {
            drift_tolerance: bad,
            ..good_options()
        };
        assert_refused(slide_with(&options), "drift_tolerance", bad);
        let options = SlideOptions {
            max_sliding_distance: bad,
            ..good_options()
        };
        assert_refused(slide_with(&options), "max_sliding_distance", bad);
        assert_refused(Element::new(bad, 1.0), "spacing", bad);
        assert_refused(Element::new(1.0, bad), "compliance", bad);
    }
}

/// Rows 12 to 15: force and speed are refused where they are made.
#[test]
fn loads_are_checked_on_construction() {
    for bad in BAD {
        for (name, load) in [
            ("normal_force", SlidingLoad::new(bad, 1.0)),
            ("velocity", SlidingLoad::new(1.0, bad)),
        ] {
            let refused = matches!(
                load,
                Err(IndenterError::InvalidParameter { parameter, .. }) if parameter == name
            );
            assert!(refused, "{name} = {bad}: {load:?}");
        }
    }
}

#[test]
fn indentation_is_checked() {
    let press = |force: f64, times: &[f64], spacing: f64| {
        let line = EquivalentLine(&power(2.0));
        indent(
            &line,
            &material(VISCOSITY),
            force,
            times,
            &IndentOptions { spacing },
        )
    };
    for bad in BAD {
        assert_refused(press(bad, &[1.0], 0.01), "normal_force", bad);
        assert_refused(press(1.0, &[1.0], bad), "spacing", bad);
        assert_refused(press(1.0, &[bad], 0.01), "time", bad);
    }
    assert_refused(press(1.0, &[1.0, 1.0], 0.01), "time_step", 0.0);
    assert_refused(press(1.0, &[2.0, 1.0], 0.01), "time_step", -1.0);
    assert_eq!(
        press(1.0, &[], 0.01),
        Err(MdrError::Empty { list: "times" }),
        "no times"
    );
    let coarse = press(1.0, &[1.0], 10.0);
    assert!(
        matches!(
            coarse,
            Err(MdrError::TooCoarse {
                n_contact: 1,
                needed: 3,
                ..
            })
        ),
        "{coarse:?}"
    );
}

/// The lowest point of the cubic line is the end of its domain.
#[test]
fn indentation_at_the_end_of_a_line_is_refused() {
    let line = Cubic {
        scale: 1.0,
        mirrored: false,
    };
    let result = indent(
        &line,
        &material(VISCOSITY),
        1.0,
        &[1.0],
        &IndentOptions { spacing: 0.01 },
    );
    assert!(
        matches!(result, Err(MdrError::ContactReachesBoundary { position, .. }) if position.abs() < 1e-12),
        "{result:?}"
    );
}

#[test]
fn too_few_elements_along_the_contact_are_refused() {
    for elements in [0, 1, 2] {
        let load = load_for_depth(DEPTH);
        let result =
            SlideOptions::with_elements(elements, &power(2.0), &material(VISCOSITY), &load);
        let refused = matches!(
            result,
            Err(MdrError::TooCoarse { n_contact, needed: 3, .. }) if n_contact == elements
        );
        assert!(refused, "{elements} elements: {result:?}");
    }
}

/// A line whose height is given by a function, on an infinite domain.
struct Line(fn(f64) -> f64);

impl RigidLine for Line {
    fn height(&self, x: f64) -> f64 {
        self.0(x)
    }

    fn slope(&self, _x: f64) -> f64 {
        1.0
    }

    fn domain(&self) -> [f64; 2] {
        [f64::NEG_INFINITY, f64::INFINITY]
    }
}

fn slide_line(height: fn(f64) -> f64) -> MdrError {
    let load = load_for_depth(DEPTH);
    slide(&Line(height), &material(VISCOSITY), &load, &good_options()).expect_err("a bad line")
}

#[test]
fn lines_that_are_no_lines_are_refused() {
    let error = slide_line(|x| if x > 0.005 { f64::NAN } else { x.abs() });
    assert!(
        matches!(error, MdrError::InvalidHeight { value, .. } if value.is_nan()),
        "{error:?}"
    );
    let error = slide_line(|x| {
        if x < -0.005 {
            f64::NEG_INFINITY
        } else {
            x.abs()
        }
    });
    assert!(matches!(error, MdrError::InvalidHeight { .. }), "{error:?}");
    let error = slide_line(|_| f64::INFINITY);
    assert!(matches!(error, MdrError::InvalidHeight { .. }), "{error:?}");
}

/// A wavy line never rises above the stationary depth: its leading edge is empty.
#[test]
fn a_line_that_never_rises_is_refused() {
    for height in [
        (|_| 0.0) as fn(f64) -> f64,
        |x| 0.01 * x.sin(),
        |x| x.min(0.0).abs(),
    ] {
        let error = slide_line(height);
        assert!(
            matches!(error, MdrError::TooManyElements { .. }),
            "{error:?}"
        );
    }
}

#[test]
fn a_spacing_that_rounds_away_is_refused() {
    struct Far;
    impl RigidLine for Far {
        fn height(&self, x: f64) -> f64 {
            (x - 1e9).abs()
        }
        fn slope(&self, x: f64) -> f64 {
            (x - 1e9).signum()
        }
        fn domain(&self) -> [f64; 2] {
            [f64::NEG_INFINITY, f64::INFINITY]
        }
        fn kinks(&self) -> Vec<f64> {
            vec![1e9]
        }
    }
    let options = SlideOptions {
        spacing: 1e-9,
        ..good_options()
    };
    let result = slide(&Far, &material(VISCOSITY), &load_for_depth(DEPTH), &options);
    assert_refused(result, "spacing", 1e-9);
}

/// Errors are sentences with the numbers in them.
#[test]
fn messages_name_numbers() {
    let error = slide_with(&SlideOptions {
        spacing: -2.0,
        ..good_options()
    });
    let message = error.expect_err("a negative spacing").to_string();
    assert_eq!(
        message, "spacing must be finite and greater than 0, but is -2",
        "message"
    );
}

/// The stationary depth is a number, and so is the compliance at once, 1e308 1/Pa; what a step compresses is not.
#[test]
fn a_compression_beyond_the_largest_number_is_refused() {
    let load = SlidingLoad::new(1.0, 1.0).expect("a load");
    let options = SlideOptions {
        spacing: 1e-3,
        ..good_options()
    };
    let cone = power(1.0);
    let soft = rheology::Maxwell::new(1e-308, 1.0).expect("a material");
    let result = slide(&EquivalentLine(&cone), &soft, &load, &options);
    assert_refused(result, "compression", f64::INFINITY);
}

#[test]
fn a_cusp_with_divergent_friction_and_a_meaningless_tolerance_are_refused() {
    for exponent in [0.2, 0.5] {
        let result = SlideOptions::with_elements(
            100,
            &power(exponent),
            &material(VISCOSITY),
            &load_for_depth(DEPTH),
        );
        assert!(
            matches!(
                result,
                Err(MdrError::InvalidParameter {
                    parameter: "apex exponent",
                    ..
                })
            ),
            "p = {exponent}: {result:?}"
        );
    }
    let body = power(2.0);
    let options = SlideOptions {
        spacing: 0.01,
        drift_tolerance: 2.0,
        max_sliding_distance: 1.0,
    };
    let result = slide(
        &EquivalentLine(&body),
        &material(VISCOSITY),
        &load_for_depth(DEPTH),
        &options,
    );
    assert!(
        matches!(
            result,
            Err(MdrError::InvalidParameter {
                parameter: "drift_tolerance",
                ..
            })
        ),
        "{result:?}"
    );
}

/// Rows 14 and 15 for the stationary state: a body at rest never stops sinking, so that no speed of zero is taken.
#[test]
fn numerics_and_motion_of_the_stationary_state_are_checked() {
    let body = power(2.0);
    let line = EquivalentLine(&body);
    let options = SteadyOptions::default();
    let good = SlidingDepth {
        indentation_depth: 0.1,
        velocity: 1.0,
    };
    let slide = |motion| steady_at_depth(&line, &material(VISCOSITY), &motion, &options);
    for bad in BAD {
        let velocity = bad;
        assert_refused(slide(SlidingDepth { velocity, ..good }), "velocity", bad);
        let indentation_depth = bad;
        let motion = SlidingDepth {
            indentation_depth,
            ..good
        };
        assert_refused(slide(motion), "indentation_depth", bad);
        let options = SteadyOptions {
            relative_error: bad,
        };
        let result = steady(
            &line,
            &material(VISCOSITY),
            &load_for_depth(DEPTH),
            &options,
        );
        assert_refused(result, "relative_error", bad);
    }
}

#[test]
fn bad_lines_are_refused_by_the_stationary_state() {
    let solve = |height: fn(f64) -> f64| {
        let options = SteadyOptions::default();
        steady(
            &Line(height),
            &material(VISCOSITY),
            &load_for_depth(DEPTH),
            &options,
        )
    };
    for height in [
        (|x| if x > 0.005 { f64::NAN } else { x.abs() }) as fn(f64) -> f64,
        |x| {
            if x < -0.005 {
                f64::NEG_INFINITY
            } else {
                x.abs()
            }
        },
        |_| f64::INFINITY,
    ] {
        let result = solve(height);
        assert!(
            matches!(result, Err(MdrError::InvalidHeight { .. })),
            "{result:?}"
        );
    }
    for height in [
        (|_| 0.0) as fn(f64) -> f64,
        |x| 0.01 * x.sin(),
        |x| x.min(0.0).abs(),
    ] {
        let result = solve(height);
        assert!(
            matches!(result, Err(MdrError::NotRising { .. })),
            "{result:?}"
        );
    }
}

#[test]
fn histories_are_checked() {
    let body = power(2.0);
    let press = |controls: &[IndentControl]| {
        let step = |(k, control): (usize, &IndentControl)| IndentStep {
            time: 1.0 + k as f64,
            control: *control,
        };
        let steps: Vec<IndentStep> = controls.iter().enumerate().map(step).collect();
        let options = IndentOptions { spacing: 0.01 };
        indent_history(
            &EquivalentLine(&body),
            &material(VISCOSITY),
            &steps,
            &options,
        )
    };
    let good = IndentControl::NormalForce(1.0);
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        assert_refused(
            press(&[good, IndentControl::NormalForce(bad)]),
            "normal_force",
            bad,
        );
    }
    let result = press(&[IndentControl::IndentationDepth(f64::NAN)]);
    assert!(
        matches!(
            result,
            Err(MdrError::NonFinite {
                quantity: "indentation depth",
                ..
            })
        ),
        "{result:?}"
    );
    let result = press(&[
        IndentControl::IndentationDepth(-1.0),
        IndentControl::NormalForce(0.0),
    ]);
    assert!(
        matches!(result, Err(MdrError::TooCoarse { n_contact: 0, .. })),
        "no contact at all: {result:?}"
    );
}
