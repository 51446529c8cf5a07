//! Bad input is refused with its name and value, before anything is computed (casebook EXT-01).

use std::fmt::Debug;

use indenters::{Control, EquivalentLine, IndenterError, PressingLoad, RigidLine, SlidingLoad};
use mdr_core::{
    Element, IndentStep, MdrError, SlideOptions, indent_history, slide_on_grid, steady,
};

use crate::support::{ASKED, Cubic, DEPTH, VISCOSITY, indent, load_for_depth, material, power};

const BAD: [f64; 6] = [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

const GOOD: SlideOptions = SlideOptions {
    spacing: 0.01,
    drift_tolerance: 1e-6,
    max_sliding_distance: 10.0,
};

fn slide(line: &impl RigidLine, options: &SlideOptions) -> Result<(), MdrError> {
    let load = load_for_depth(DEPTH);
    slide_on_grid(line, &material(VISCOSITY), &load, options).map(drop)
}

fn slide_with(options: &SlideOptions) -> Result<(), MdrError> {
    slide(&EquivalentLine(&power(2.0)), options)
}

fn press(force: f64, times: &[f64], spacing: f64) -> Result<(), MdrError> {
    let line = EquivalentLine(&power(2.0));
    indent(&line, &material(VISCOSITY), force, times, spacing).map(drop)
}

fn assert_refused<T: Debug>(result: Result<T, MdrError>, name: &str, bad: f64) {
    match result {
        Err(MdrError::InvalidParameter {
            parameter, value, ..
        }) => assert_eq!(
            (parameter, value.to_bits()),
            (name, bad.to_bits()),
            "name and value of the refused {name} = {bad}"
        ),
        other => panic!("{name} = {bad}: {other:?}"),
    }
}

macro_rules! assert_error {
    ($result:expr, $pattern:pat $(if $guard:expr)?) => {{
        let result = $result;
        assert!(
            matches!(result, Err($pattern) $(if $guard)?),
            "{result:?} instead of {}",
            stringify!($pattern)
        );
    }};
}

#[test]
fn the_good_options_are_accepted() {
    assert_eq!(slide_with(&GOOD), Ok(()), "nothing is wrong with them");
}

/// Rows 16 and 21: the spacing is the grid and, through the speed, the time step.
#[test]
fn numerics_are_checked() {
    let line = EquivalentLine(&power(2.0));
    for bad in BAD {
        let spacing = SlideOptions {
            spacing: bad,
            ..GOOD
        };
        let drift_tolerance = SlideOptions {
            drift_tolerance: bad,
            ..GOOD
        };
        let max_sliding_distance = SlideOptions {
            max_sliding_distance: bad,
            ..GOOD
        };
        assert_refused(slide_with(&spacing), "spacing", bad);
        assert_refused(slide_with(&drift_tolerance), "drift_tolerance", bad);
        assert_refused(
            slide_with(&max_sliding_distance),
            "max_sliding_distance",
            bad,
        );
        assert_refused(Element::new(bad, 1.0), "spacing", bad);
        assert_refused(Element::new(1.0, bad), "compliance", bad);
        assert_refused(press(1.0, &[1.0], bad), "spacing", bad);
        assert_refused(press(1.0, &[bad], 0.01), "time", bad);
        let state = steady(&line, &material(VISCOSITY), &load_for_depth(DEPTH), bad);
        assert_refused(state, "relative_error", bad);
    }
    let drift_tolerance = 2.0;
    let options = SlideOptions {
        drift_tolerance,
        ..GOOD
    };
    assert_refused(slide_with(&options), "drift_tolerance", drift_tolerance);
    let message = slide_with(&SlideOptions {
        spacing: -2.0,
        ..GOOD
    });
    assert_eq!(
        message.expect_err("a negative spacing").to_string(),
        "spacing must be finite and greater than 0, but is -2",
        "messages name numbers"
    );
}

/// Rows 12 to 15: force, depth and speed are refused where they are made.
#[test]
fn loads_are_checked_on_construction() {
    let pressing = |control, duration| PressingLoad::new(control, duration).err();
    for bad in BAD {
        let (force, depth) = (Control::NormalForce(bad), Control::IndentationDepth(bad));
        for (name, error) in [
            ("normal_force", SlidingLoad::new(bad, 1.0).err()),
            ("velocity", SlidingLoad::new(1.0, bad).err()),
            ("indentation_depth", SlidingLoad::at_depth(bad, 1.0).err()),
            ("velocity", SlidingLoad::at_depth(0.1, bad).err()),
            ("normal_force", pressing(force, 1.0)),
            ("indentation_depth", pressing(depth, 1.0)),
            ("duration", pressing(Control::NormalForce(1.0), bad)),
        ] {
            let refused = matches!(
                error,
                Some(IndenterError::InvalidParameter { parameter, .. }) if parameter == name
            );
            assert!(refused, "{name} = {bad}: {error:?}");
        }
    }
}

#[test]
fn indentation_is_checked() {
    assert_refused(press(1.0, &[1.0, 1.0], 0.01), "time_step", 0.0);
    assert_refused(press(1.0, &[2.0, 1.0], 0.01), "time_step", -1.0);
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        assert_refused(press(bad, &[1.0], 0.01), "normal_force", bad);
    }
    let none = MdrError::Empty { list: "times" };
    assert_eq!(press(1.0, &[], 0.01), Err(none), "no times");
    assert_error!(
        press(1.0, &[1.0], 10.0),
        MdrError::TooCoarse {
            n_contact: 1,
            needed: 3,
            ..
        }
    );
    let history = |controls: &[Control]| {
        let step = |(k, control): (usize, &Control)| IndentStep {
            time: 1.0 + k as f64,
            control: *control,
        };
        let steps: Vec<IndentStep> = controls.iter().enumerate().map(step).collect();
        let line = EquivalentLine(&power(2.0));
        indent_history(&line, &material(VISCOSITY), &steps, 0.01)
    };
    assert_error!(
        history(&[Control::IndentationDepth(f64::NAN)]),
        MdrError::NonFinite {
            quantity: "indentation depth",
            ..
        }
    );
    assert_error!(
        history(&[Control::IndentationDepth(-1.0), Control::NormalForce(0.0)]),
        MdrError::TooCoarse { n_contact: 0, .. }
    );
    // The lowest point of the cubic line is the end of its domain.
    let line = Cubic {
        scale: 1.0,
        mirrored: false,
    };
    assert_error!(
        indent(&line, &material(VISCOSITY), 1.0, &[1.0], 0.01),
        MdrError::ContactReachesEdge { position, .. } if position.abs() < 1e-12
    );
}

#[test]
fn bad_numbers_of_elements_and_exponents_are_refused() {
    let with_elements = |elements: usize, exponent: f64| {
        let (load, body) = (load_for_depth(DEPTH), power(exponent));
        SlideOptions::with_elements(
            elements,
            &EquivalentLine(&body),
            &material(VISCOSITY),
            &load,
        )
    };
    for elements in [0, 1, 2] {
        assert_error!(
            with_elements(elements, 2.0),
            MdrError::TooCoarse { n_contact, needed: 3, .. } if n_contact == elements
        );
    }
    for exponent in [0.2, 0.5] {
        assert_error!(
            with_elements(100, exponent),
            MdrError::InvalidParameter {
                parameter: "apex exponent",
                ..
            }
        );
    }
}

/// A line whose height is given by a function, on an infinite domain, with its lowest point at a kink.
struct Line {
    height: fn(f64) -> f64,
    kink: f64,
}

impl RigidLine for Line {
    fn height(&self, x: f64) -> f64 {
        (self.height)(x - self.kink)
    }

    fn slope(&self, _x: f64) -> f64 {
        1.0
    }

    fn domain(&self) -> [f64; 2] {
        [f64::NEG_INFINITY, f64::INFINITY]
    }

    fn kinks(&self) -> Vec<f64> {
        vec![self.kink]
    }
}

fn at_zero(height: fn(f64) -> f64) -> Line {
    Line { height, kink: 0.0 }
}

fn steady_line(height: fn(f64) -> f64) -> Result<(), MdrError> {
    let (material, load) = (material(VISCOSITY), load_for_depth(DEPTH));
    steady(&at_zero(height), &material, &load, ASKED).map(drop)
}

#[test]
fn lines_that_are_no_lines_are_refused() {
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
        assert_error!(
            slide(&at_zero(height), &GOOD),
            MdrError::InvalidHeight { .. }
        );
        assert_error!(steady_line(height), MdrError::InvalidHeight { .. });
    }
}

/// A wavy line never rises above the stationary depth: its leading edge is empty.
#[test]
fn a_line_that_never_rises_is_refused() {
    for height in [
        (|_| 0.0) as fn(f64) -> f64,
        |x| 0.01 * x.sin(),
        |x| x.min(0.0).abs(),
    ] {
        assert_error!(
            slide(&at_zero(height), &GOOD),
            MdrError::TooManyElements { .. }
        );
        assert_error!(steady_line(height), MdrError::NotRising { .. });
    }
}

#[test]
fn a_spacing_that_rounds_away_is_refused() {
    let far = Line {
        height: f64::abs,
        kink: 1e9,
    };
    let options = SlideOptions {
        spacing: 1e-9,
        ..GOOD
    };
    assert_refused(slide(&far, &options), "spacing", 1e-9);
}

/// The stationary depth is a number, and so is the compliance at once, 1e308 1/Pa; what a step compresses is not.
#[test]
fn a_compression_beyond_the_largest_number_is_refused() {
    let load = SlidingLoad::new(1.0, 1.0).expect("a load");
    let options = SlideOptions {
        spacing: 1e-3,
        ..GOOD
    };
    let cone = power(1.0);
    let soft = rheology::Maxwell::new(1e-308, 1.0).expect("a material");
    let result = slide_on_grid(&EquivalentLine(&cone), &soft, &load, &options);
    assert_refused(result, "compression", f64::INFINITY);
}
