//! Bad input is refused with its name and value, before anything is computed (casebook EXT-01).

use casebook::{NOT_POSITIVE, assert_close, assert_matches, refuses};
use indenters::{EquivalentLine, RigidLine, SlidingLoad};
use mdr_core::{MdrError, SteadySliding, slide, steady};
use rheology::{CreepSpectrum, Elastic, Material, Maxwell, RelaxationSpectrum};

use crate::support::{
    ASKED, DEPTH, Line, VISCOSITY, endless, load, load_for_depth, material, power, slide_to,
};

fn slide_steadily(line: &impl RigidLine, relative_error: f64) -> Result<SteadySliding, MdrError> {
    let load = load_for_depth(DEPTH);
    steady(line, &material(VISCOSITY), &load, relative_error)
}

/// Rows 16 and 21: the number of elements is the grid and, through the speed, the time step.
#[test]
fn numbers_are_checked() {
    let good = slide_to(&EquivalentLine(&power(2.0)), DEPTH, 100).expect("nothing is wrong");
    assert_close!(good.indentation_depth.value => DEPTH, within 1e-6; "on a dashpot (12) holds");
    for elements in [0, 1, 2] {
        assert_matches!(
            slide_to(&EquivalentLine(&power(2.0)), DEPTH, elements),
            Err(MdrError::TooCoarse { n_contact, needed: 3, .. }) if n_contact <= elements
        );
    }
    refuses("apex exponent", &[0.2, 0.5], |p| {
        slide_to(&EquivalentLine(&power(p)), DEPTH, 100)
    });
    refuses("relative_error", NOT_POSITIVE, |x| {
        slide_steadily(&EquivalentLine(&power(2.0)), x)
    });
}

/// Asserts that a march and the stationary state refuse lines of these heights.
fn assert_refused(heights: [fn(f64) -> f64; 3], is_refusal: fn(&MdrError) -> bool) {
    for line in heights.map(endless) {
        let result = slide_to(&line, DEPTH, 100);
        assert!(result.as_ref().is_err_and(is_refusal), "{result:?}");
        let result = slide_steadily(&line, ASKED);
        assert!(result.as_ref().is_err_and(is_refusal), "{result:?}");
    }
}

/// A wavy line never rises above the stationary depth: its leading edge is empty.
#[test]
fn lines_that_are_no_lines_or_never_rise_are_refused() {
    let infinite = |x: f64| {
        if x < -0.005 {
            f64::NEG_INFINITY
        } else {
            x.abs()
        }
    };
    let no_number = |x: f64| if x > 0.005 { f64::NAN } else { x.abs() };
    let no_height = |error: &MdrError| matches!(error, MdrError::InvalidHeight { .. });
    assert_refused([no_number, infinite, |_| f64::INFINITY], no_height);
    assert_refused(
        [|_| 0.0, |x| 0.01 * x.sin(), |x| x.min(0.0).abs()],
        |error| matches!(error, MdrError::NotRising { .. }),
    );
}

#[test]
fn a_line_with_too_much_detail_is_refused_with_where_and_how_many() {
    let corrugated = endless(|x: f64| 0.5 * x * x - 0.1 * (1e6 * x).cos());
    assert_matches!(
        slide_steadily(&corrugated, ASKED),
        Err(MdrError::TooMuchDetail { allowed, position, .. })
            if allowed > 1000 && position.is_finite()
    );
}

#[test]
fn a_spacing_that_rounds_away_is_refused() {
    let far = Line {
        kinks: vec![1e9],
        ..endless(|x: f64| (x - 1e9).abs())
    };
    assert_matches!(
        slide_to(&far, DEPTH, 100_000_000),
        Err(MdrError::InvalidParameter(invalid)) if invalid.parameter == "spacing"
    );
}

/// What one method cannot answer is said by the load: a march has no depth, a stationary state no distance.
#[test]
fn loads_of_another_method_are_refused() {
    let line = EquivalentLine(&power(2.0));
    let held = SlidingLoad::at_depth(DEPTH, 1.0).expect("a load");
    let result = slide(&line, &material(VISCOSITY), &held, 1e-2);
    assert_matches!(result, Err(MdrError::Indenter(_)));
    let short = load(1.0, 1.0).after(1.0).expect("a load");
    let result = steady(&line, &material(VISCOSITY), &short, ASKED);
    assert_matches!(result, Err(MdrError::Indenter(_)));
}

/// A material that relaxes as a fluid and creeps as a spring.
#[derive(Debug)]
struct Contradictory;

impl Material for Contradictory {
    fn relaxation(&self) -> RelaxationSpectrum {
        Maxwell::new(1.0, 1.0).expect("a fluid").relaxation()
    }

    fn creep(&self) -> CreepSpectrum {
        Elastic::new(1.0).expect("a spring").creep()
    }
}

#[test]
fn materials_with_contradictory_spectra_are_refused() {
    let (body, load) = (power(2.0), load_for_depth(DEPTH));
    let line = EquivalentLine(&body);
    let refused = [
        steady(&line, &Contradictory, &load, 1e-2).expect_err("stationary"),
        slide(&line, &Contradictory, &load, 1e-2).expect_err("a march"),
    ];
    for refused in refused.map(|refused| refused.to_string()) {
        assert!(refused.contains("relaxation() and creep()"), "{refused}");
    }
}
