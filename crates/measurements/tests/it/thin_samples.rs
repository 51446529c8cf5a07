//! Curves of samples whose thickness matters.

use indenters::{FlatPunch, Sphere};
use measurements::indentation::{FitOptions, Flag, Thickness, fit_indentation};

use crate::synthetic::{Case, thin};

/// Taken for a half space, a thin sample has a modulus that is too large.
#[test]
fn a_thin_sample_that_is_taken_for_a_thick_one_is_too_stiff_and_flagged() {
    let case = thin();
    let curve = case.curve(600, 0.003, 3);
    let thick = Case {
        thickness: None,
        ..thin()
    }
    .fit(&curve)
    .expect("a fit");
    let known = case.fit(&curve).expect("a fit");
    let [thick_modulus, modulus] =
        [&thick, &known].map(|fit| fit.findings[0].estimate.expect("it is determined").value);
    assert!(
        thick_modulus > 2.0 * modulus,
        "{thick_modulus} and {modulus}"
    );
    assert_ne!(thick.flags, [], "taken for a half space");
    assert_eq!(known.flags, [], "known thickness");
    let ball = Sphere::new(5e-6).expect("a sphere");
    let deep = Case {
        body: Box::new(ball),
        thickness: Some(2e-6),
        ..thin()
    };
    let flags = deep.fit(&deep.curve(600, 0.003, 3)).expect("a fit").flags;
    let is_deep =
        |flag: &Flag| matches!(flag, Flag::DeepInSample(percent) if (*percent - 53.0).abs() < 1.0);
    assert!(flags.len() == 1 && flags.iter().all(is_deep), "{flags:?}");
}

/// Deep in a thin sample, and not in a thick one, the shape of a curve says how thick it is.
#[test]
fn a_thickness_is_found_or_bounded() {
    let fitted = |case: &Case, seed: u64| {
        let options = FitOptions {
            thickness: Thickness::Fitted,
            profile: true,
            ..FitOptions::default()
        };
        fit_indentation(&*case.body, &case.curve(300, 0.002, seed), &options).expect("a fit")
    };
    let thick = Case {
        thickness: Some(1e-3),
        ..thin()
    };
    for seed in 0..2 {
        let fit = fitted(&thin(), seed);
        let thickness = fit.findings.last().expect("a thickness");
        assert_eq!(thickness.name, "thickness", "{thickness:?}");
        let estimate = thickness.estimate.expect("it is determined");
        assert!(
            (estimate.value - 6e-6).abs() < 4.0 * estimate.error,
            "{thickness:?}"
        );
        assert!(estimate.error < 1.5e-6, "{thickness:?}");
        let fit = fitted(&thick, seed);
        let thickness = fit.findings.last().expect("a thickness");
        assert_eq!(
            (thickness.estimate, thickness.interval[1]),
            (None, None),
            "{thickness:?}"
        );
        assert!(
            thickness.interval[0].is_some_and(|lower| (1.5e-5..1e-3).contains(&lower)),
            "{thickness:?}"
        );
    }
}

/// Under a flat end the contact is as large at any depth, so that modulus and thickness are one number.
#[test]
fn no_thickness_is_found_under_a_flat_end() {
    let punch = FlatPunch::new(5e-6).expect("a punch");
    let case = Case {
        thickness: Some(6e-6),
        ..Case::new("flat punch", punch, &[1e3, 2e3, 0.3])
    };
    let options = FitOptions {
        thickness: Thickness::Fitted,
        ..FitOptions::default()
    };
    for seed in 0..6 {
        let curve = case.curve(150, 0.002, seed);
        let fit = fit_indentation(&*case.body, &curve, &options).expect("a fit");
        let thickness = fit.findings.last().expect("a thickness");
        assert_eq!(thickness.estimate, None, "{seed}: {thickness:?}");
    }
}

#[test]
fn a_thickness_that_is_none_is_refused() {
    let case = thin();
    let curve = case.curve(300, 0.003, 3);
    for (thickness, reason) in [
        (0.0, "thickness must be finite and greater than 0, but is 0"),
        (
            -1e-6,
            "thickness must be finite and greater than 0, but is -1e-6",
        ),
        (
            f64::NAN,
            "thickness must be finite and greater than 0, but is not a number",
        ),
        (
            1e-8,
            "thickness must be at least a hundredth of the radius of the contact, but is 1e-8",
        ),
    ] {
        let refused = Case {
            thickness: Some(thickness),
            ..thin()
        }
        .fit(&curve);
        assert_eq!(refused.err().as_deref(), Some(reason), "{thickness}");
    }
}
