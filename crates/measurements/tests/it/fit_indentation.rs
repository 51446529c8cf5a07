//! From measured curves of force over depth to the material behind them.

use std::fmt::Write as _;

use indenters::{Axisymmetric, FlatPunch, PowerProfile, Sphere};
use measurements::Finding;
use measurements::indentation::{
    FitOptions, Flag, IndentationCurve, Note, Rheology, fit_indentation,
};
use rayon::prelude::*;

use crate::support::{Normal, assert_close};
use crate::synthetic::{
    CONTACT_POINT, Case, NOISES, TILT, change, n_curves, peak, sphere, thin, write_table,
};

fn cases() -> [Case; 5] {
    let cone = PowerProfile::cone(0.7).expect("a cone");
    let pyramid = PowerProfile::pyramid(1.4).expect("a pyramid");
    let punch = FlatPunch::new(1e-6).expect("a punch");
    [
        sphere(&[1e3, 2e3, 0.3]),
        Case::new("cone, relaxes nearly to nothing", cone, &[200.0, 5e3, 0.15]),
        Case::new("punch, relaxes slowly", punch, &[4e3, 3e3, 1.0]),
        sphere(&[1.5e3, 0.2]),
        Case::new("pyramid, power law", pyramid, &[2e3, 0.45]),
    ]
}

/// Noise in parts of the peak force.
const LEVELS: [f64; 3] = [0.003, 0.01, 0.03];

fn holds((finding, truth): (&Finding, &f64)) -> bool {
    let [lower, upper] = finding.interval;
    lower.is_none_or(|end| end <= *truth) && upper.is_none_or(|end| end >= *truth)
}

#[test]
fn intervals_hold_the_truth_in_95_of_100_curves_of_any_noise_and_few_are_flagged() {
    intervals_hold(&cases(), 120, "intervals.txt");
}

#[test]
fn intervals_hold_on_thin_samples() {
    intervals_hold(&[thin()], 40, "intervals-thin.txt");
}

fn intervals_hold(cases: &[Case], few: usize, file: &str) {
    let n_curves = n_curves(few);
    let each = n_curves / cases.len() / NOISES.len();
    let mut table = String::new();
    let mut parts = Vec::new();
    let mut all_flagged = 0;
    for (noise, case) in NOISES
        .iter()
        .flat_map(|noise| cases.iter().map(move |case| (noise, case)))
    {
        let first = table.lines().count() * each;
        let fits = (0..each).into_par_iter().map(|seed| {
            let level = LEVELS[seed % LEVELS.len()];
            let curve = case.noisy_curve(400, level, noise, 1 + 1_000_003 * (first + seed) as u64);
            let fit = case.fit(&curve).ok()?;
            let hits: Vec<bool> = fit.findings.iter().zip(&case.truth).map(holds).collect();
            Some((hits, !fit.flags.is_empty()))
        });
        let fits: Vec<Option<(Vec<bool>, bool)>> = fits.collect();
        let fitted: Vec<_> = fits.iter().flatten().collect();
        let flagged = each - fitted.iter().filter(|(_, flagged)| !flagged).count();
        all_flagged += flagged;
        write!(table, "{}, {}:", noise.name, case.name).expect("text");
        for parameter in 0..case.truth.len() {
            let inside = fitted.iter().filter(|(hits, _)| hits[parameter]).count();
            parts.push(inside as f64 / fitted.len() as f64);
            write!(table, " {:.1} %", 100.0 * parts[parts.len() - 1]).expect("text");
        }
        writeln!(
            table,
            "; flagged {:.1} %",
            100.0 * flagged as f64 / each as f64
        )
        .expect("text");
    }
    write_table(file, &table);
    let is_few = all_flagged as f64 <= (0.02 * n_curves as f64).max(3.0);
    assert!(is_few, "{all_flagged} of {n_curves} flagged\n{table}");
    let mean = parts.iter().sum::<f64>() / parts.len() as f64;
    // As if the parameters of a curve were one trial; each of them may be off by four standard deviations.
    let spread = |part: f64, n: usize| (part * (1.0 - part) / n as f64).sqrt();
    let allowed = 0.01 + 2.0 * spread(0.95, n_curves);
    assert!((mean - 0.95).abs() < allowed, "{mean}\n{table}");
    // A curve is only four times as long as noise of the correlation 0.99 lasts.
    let off = parts.into_iter().map(|part| (part - 0.95).abs());
    let worst = off.fold(0.0, f64::max);
    assert!(worst < 0.06 + 4.0 * spread(0.95, each), "{worst}\n{table}");
}

#[test]
fn noiseless_curves_give_the_material_itself() {
    for case in cases().into_iter().chain([thin()]) {
        let curve = case.curve(1000, 0.0, 1);
        let fit = case.fit(&curve).expect("a fit");
        // Of a power law the series in the fit is good to 1e-4 of its modulus, of which a tilt is a small part.
        let of_tilt = 1e-4 * peak(&curve.force) / (1.5e-6 * TILT.abs());
        for (finding, truth) in fit.findings.iter().zip(&case.truth) {
            let value = finding.estimate.expect("it is determined").value;
            let what = format!("{}, {}", case.name, finding.name);
            let is_tilt = finding.name == "tilt";
            assert_close(what, value, *truth, if is_tilt { of_tilt } else { 1e-3 });
        }
        assert_eq!(fit.flags, [], "{}", case.name);
        // Three seconds in 999 steps.
        let expected = [1.0 / 3.0, 333.0];
        for (found, expected) in fit.valid_frequencies.into_iter().zip(expected) {
            assert_close("an end of the window", found, expected, 1e-9);
        }
    }
}

/// What is done to a curve of 600 points with a peak.
type Damage = fn(&mut IndentationCurve, f64);

/// How the reasons begin, and what has them.
const REASONS: [(&str, Damage); 9] = [
    ("the depth does not change: it is 1e-7 m", |c, _| {
        change(&mut c.depth, |_| 1e-7);
    }),
    ("point 71 has no number", |c, _| c.force[70] = f64::NAN),
    ("at point 301 the time", |c, _| {
        add(&mut c.time[300..], -1.5);
    }),
    ("points are missing after", |c, _| {
        add(&mut c.time[250..], 0.5);
    }),
    ("the force is cut off at", |c, peak| {
        change(&mut c.force, |force| force.min(0.6 * peak));
    }),
    ("the force falls while", |c, _| {
        change(&mut c.force, |force| -force);
    }),
    ("there is no contact", |c, _| {
        let mut normal = Normal(5);
        change(&mut c.force, |_| 1e-10 * normal.draw());
    }),
    ("the body jumps into contact", |c, peak| {
        add(&mut c.force[45..56], -0.15 * peak);
    }),
    ("on the way back the body sticks", |c, peak| {
        add(&mut c.force[500..540], -0.3 * peak);
    }),
];

fn add(numbers: &mut [f64], by: f64) {
    change(numbers, |number| number + by);
}

#[test]
fn damaged_curves_are_refused_with_a_reason_and_sound_ones_never() {
    for case in cases().into_iter().chain([thin()]) {
        for seed in 0..8 {
            let flags = case.fit(&case.curve(600, 0.01, seed)).expect("a fit").flags;
            assert_eq!(flags, [], "{}, seed {seed}", case.name);
        }
        for (reason, damage) in REASONS {
            let mut curve = case.curve(600, 0.005, 7);
            let peak = peak(&curve.force);
            damage(&mut curve, peak);
            let error = case.fit(&curve).expect_err(reason);
            let is_right = error.starts_with(reason);
            assert!(is_right, "{}, {reason}: {error}", case.name);
        }
        let IndentationCurve { time, depth, force } = case.curve(600, 0.005, 7);
        let (depth, force) = (force, depth);
        let exchanged = case.fit(&IndentationCurve { time, depth, force });
        let is_fitted = exchanged.is_ok_and(|fit| fit.findings[0].estimate.is_some());
        assert!(!is_fitted, "{}: depth and force exchanged", case.name);
        let mut curve = case.curve(600, 0.005, 7);
        let rate = 0.05 * peak(&curve.force);
        let drift = curve.force.iter_mut().zip(&curve.time);
        drift.for_each(|(force, time)| *force += rate * time);
        let flags = case.fit(&curve).expect("a fit").flags;
        let is_drift = flags.iter().any(|flag| matches!(flag, Flag::Drift(_)));
        assert!(is_drift, "{}, drift: {flags:?}", case.name);
    }
}

/// Curves that are not what they are taken for, though each of them can be fitted.
const DISTORTIONS: [(&str, Damage); 6] = [
    ("a lag of 25 ms", |c, _| {
        let force = c.force.clone();
        (5..600).for_each(|i| c.force[i] = force[i - 5]);
    }),
    ("the piezo taken for the depth", |c, peak| {
        let bent = c.depth.iter_mut().zip(&c.force);
        bent.for_each(|(depth, force)| *depth += 3e-7 * force / peak);
    }),
    ("a thin sample", |c, _| {
        // Dimitriadis et al. (2002), for a sphere of 5 µm on a bonded layer of 4 µm.
        let thicker = c.force.iter_mut().zip(&c.depth);
        thicker.for_each(|(force, depth)| {
            let x = (5e-6 * (depth - CONTACT_POINT).max(0.0)).sqrt() / 4e-6;
            *force *= 1.0 + 1.133 * x + 1.283 * x * x + 0.769 * x.powi(3) + 0.0975 * x.powi(4);
        });
    }),
    ("a drift of 5 %", |c, peak| {
        let drift = c.force.iter_mut().zip(&c.time);
        drift.for_each(|(force, time)| *force += 0.05 * peak * time / 3.0);
    }),
    ("a body that sticks by 4 %", |c, peak| {
        (400..540).for_each(|i| c.force[i] -= 0.04 * peak * (i - 400) as f64 / 140.0);
    }),
    ("a body that sticks to the end", |c, peak| {
        (400..600).for_each(|i| c.force[i] -= 0.25 * peak * (i - 400) as f64 / 200.0);
    }),
];

#[test]
fn curves_that_fit_a_wrong_model_well_are_flagged_or_refused() {
    let flagged = |case: &Case, curve: &IndentationCurve, what: &str| match case.fit(curve) {
        Ok(fit) => assert_ne!(fit.flags, [], "{what}: {:?}", fit.findings),
        Err(reason) => assert!(reason.contains("sticks"), "{what}: {reason}"),
    };
    for case in [sphere(&[1e3, 2e3, 0.3]), sphere(&[1.5e3, 0.2])] {
        for (what, distort) in DISTORTIONS {
            let mut curve = case.curve(600, 0.0, 7);
            let peak = peak(&curve.force);
            distort(&mut curve, peak);
            let mut normal = Normal(3);
            change(&mut curve.force, |force| {
                force + 0.003 * peak * normal.draw()
            });
            flagged(&case, &curve, what);
        }
        let cone = Case {
            body: Box::new(PowerProfile::cone(0.7).expect("a cone")),
            ..sphere(&case.truth[..case.truth.len() - 3])
        };
        flagged(
            &case,
            &cone.curve(600, 0.003, 3),
            "a cone taken for a sphere",
        );
        let large = Sphere::new(5.0).expect("a sphere");
        let small = PowerProfile::paraboloid(1e8).expect("a paraboloid");
        let bodies: [Box<dyn Axisymmetric>; 2] = [Box::new(large), Box::new(small)];
        for (body, name) in bodies.into_iter().zip(["wide as deep", "deep as wide"]) {
            let other = Case {
                body,
                ..sphere(&case.truth[..case.truth.len() - 3])
            };
            let flags = other.fit(&case.curve(600, 0.003, 3)).expect("a fit").flags;
            let mut said = flags.iter().map(ToString::to_string);
            assert!(said.any(|flag| flag.contains(name)), "{name}: {flags:?}");
        }
    }
}

#[test]
fn standard_errors_are_what_intervals_say() {
    let case = sphere(&[1e3, 2e3, 0.3]);
    let options = FitOptions {
        branches: Some(2),
        rheology: Rheology::Prony,
        profile: true,
        ..FitOptions::default()
    };
    let curve = case.curve(200, 0.03, 5);
    let fit = fit_indentation(&*case.body, &curve, &options).expect("a fit");
    for finding in fit.findings {
        if let (Some(estimate), [Some(lower), Some(upper)]) = (finding.estimate, finding.interval) {
            assert_close(&finding.name, estimate.error, (upper - lower) / 3.92, 1e-3);
        }
    }
}

/// The means of neighbours say what the points say; where the body turns around, points stay as they are.
#[test]
fn a_curve_of_1e5_points_is_fitted_by_means_of_neighbours() {
    let case = sphere(&[1e3, 2e3, 0.3]);
    let curve = case.curve(100_000, 0.01, 2);
    let fit = case.fit(&curve).expect("a fit");
    assert_found(&fit.findings, &case.truth);
    let relative = fit.findings[0].estimate.expect("it is determined").error / 1e3;
    assert!(relative < 1.5e-3, "{relative}: not that of all points");
    assert!(fit.points.len() < 10_000, "{} points", fit.points.len());
    let deepest = fit.points.iter().map(|point| point[1]).fold(0.0, f64::max);
    assert_close("the end of the approach", deepest, 1.5e-6, 1e-5);
    assert_eq!(fit.flags, [], "flags");
    let mut bent = curve.clone();
    let (what, distort) = DISTORTIONS[1];
    distort(&mut bent, peak(&curve.force));
    assert_ne!(case.fit(&bent).expect("a fit").flags, [], "{what}");
}

#[test]
fn two_branches_are_told_apart_and_a_third_is_not_invented() {
    let case = sphere(&[1e3, 2e3, 0.02, 1.5e3, 0.5]);
    let curve = case.curve(1000, 0.002, 4);
    let options = FitOptions {
        rheology: Rheology::Prony,
        ..FitOptions::default()
    };
    let fit = fit_indentation(&*case.body, &curve, &options).expect("a fit");
    assert_eq!(fit.findings.len(), case.truth.len(), "{:?}", fit.findings);
    assert_found(&fit.findings, &case.truth);
}

#[track_caller]
fn assert_found(findings: &[Finding], truth: &[f64]) {
    for (finding, truth) in findings.iter().zip(truth) {
        let estimate = finding.estimate.expect("it is determined");
        let off = (estimate.value - truth).abs();
        assert!(off < 4.0 * estimate.error, "{finding:?} and not {truth}");
    }
}

#[test]
fn a_time_far_beyond_the_curve_is_a_bound_and_not_a_number() {
    let case = sphere(&[1e3, 2e3, 120.0]);
    let fit = case.fit(&case.curve(600, 0.001, 3)).expect("a fit");
    // The curve knows how fast the modulus falls, and not to what.
    for finding in &fit.findings[..3] {
        assert_eq!(finding.estimate, None, "{finding:?}");
    }
    let time = &fit.findings[2];
    assert_eq!(time.interval[1], None, "{time:?}");
    let lower = time.interval[0].unwrap_or_default();
    assert!(lower > 3.0, "{time:?}");
    // One that has passed before the second point is none.
    let case = sphere(&[3e3, 1.0, 1e-9]);
    let fit = case.fit(&case.curve(600, 0.001, 3)).expect("a fit");
    assert_eq!(fit.notes, [Note::ElasticInstead]);
    assert_found(&fit.findings[..1], &[3e3]);
}

#[test]
fn a_tenth_of_wild_points_does_not_move_the_result() {
    let case = &cases()[0];
    let mut curve = case.curve(600, 0.01, 9);
    let jump = 0.4 * peak(&curve.force);
    let forces = curve.force.iter_mut().step_by(11);
    forces.for_each(|force| *force += jump);
    let fit = case.fit(&curve).expect("a fit");
    assert_found(&fit.findings[..3], &case.truth);
}
