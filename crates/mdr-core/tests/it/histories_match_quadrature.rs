//! Force and contact radius along a path of the depth match quadrature with 40 digits, and both casebooks.

pub(crate) use casebook::numbers;
use indenters::{
    Axisymmetric, Control, FlatCone, FlatPunch, HistoryPoint, Hyperboloid, PowerProfile, Sphere,
};
use mdr_core::{CurvePoint, HistoryOptions, indent_along, work_along};
use numerics::Estimate;
use rheology::{Material, Prony, Springpot};

use crate::support::{assert_agree, history, prony};

/// The materials of tests/data/histories.py.
pub(crate) fn material(name: &str) -> Prony {
    match name {
        "elastic" => prony([2.0, 0.0], &[]),
        "solid" => prony([1.0, 0.0], &[(4.0, 1.0)]),
        "maxwell" => prony([0.0; 2], &[(3.0, 0.7)]),
        "kelvin-voigt" => prony([1.0, 0.2], &[]),
        "three" => prony([0.5, 0.0], &[(20.0, 0.001), (2.0, 0.1), (1.0, 30.0)]),
        _ => prony([0.0, 0.05], &[(1.0, 0.02), (2.0, 5.0)]),
    }
}

/// The bodies of tests/data/histories.py.
pub(crate) fn body(name: &str) -> Box<dyn Axisymmetric> {
    stretched(name, 0.0)
}

/// A body after the logarithm of a stretch, of a sphere of its radius.
pub(crate) fn stretched(name: &str, stretch: f64) -> Box<dyn Axisymmetric> {
    let by = stretch.exp();
    match name {
        "paraboloid" => Box::new(PowerProfile::paraboloid(0.5 * by).expect("a paraboloid")),
        "cone" => Box::new(PowerProfile::cone(0.3 * by).expect("a cone")),
        "power" => Box::new(PowerProfile::new(0.4 * by, 1.5).expect("a power")),
        "sphere" => Box::new(Sphere::new(by).expect("a sphere")),
        "flat-cone" => Box::new(FlatCone::new(0.02, 0.4 * by).expect("a cone")),
        _ => Box::new(Hyperboloid::new(0.05, 0.5 * by).expect("a hyperboloid")),
    }
}

/// Times and depths.
pub(crate) fn knots(name: &str) -> Vec<[f64; 2]> {
    numbers(match name {
        "triangle" => "0 0, 1 0.01, 2 0",
        "dwell" => "0 0, 1 0.01, 2 0.01, 3 0",
        "slow-fast" => "0 0, 0.5 0.002, 1 0.01, 1.1 0.008, 2 0",
        "late" => "0.25 -0.005, 1 0.01, 1.5 0.0125, 1.75 -0.0025",
        "late dwell" => "0.25 -0.005, 1 0.01, 1.5 0.01, 1.9 -0.0025",
        "step" => "0 0.01, 1 0.01, 3 -0.005",
        // Fast away and slowly on, so that the recovering surface catches up with the body, which then outruns it again.
        "catch" => "0 0, 1 0.01, 1.1 0.006, 3 0.0055, 4 0.012, 5 -0.004",
        // Back into a dent, twice.
        "dent" => "0 0, 1 0.01, 1.2 -0.001, 1.4 0.006, 1.6 -0.001, 2.2 0.012, 3 0",
        "relaxed" => "0 -0.001, 1 0.01, 1000 0.01, 2000 0.005, 3000 -0.001",
        _ => "0 0, 1 0.01, 1.3 0.007, 2.1 0.015, 3.6 0",
    })
}

/// The path through its knots and other times.
pub(crate) fn path(knots: &[[f64; 2]], times: &[f64]) -> Vec<HistoryPoint> {
    let mut all: Vec<f64> = knots.iter().map(|knot| knot[0]).collect();
    all.extend(times);
    all.sort_by(f64::total_cmp);
    all.dedup();
    let depth = |time: f64| {
        let after = knots.iter().position(|knot| time <= knot[0]);
        let after = after.expect("inside").max(1);
        let [[t0, d0], [t1, d1]] = [knots[after - 1], knots[after]];
        if time >= t1 {
            d1
        } else {
            d0 + (time - t0) * ((d1 - d0) / (t1 - t0))
        }
    };
    let points = all.iter().map(|time| [*time, depth(*time)]);
    history(points, Control::IndentationDepth)
}

pub(crate) fn follow(
    body: &dyn Axisymmetric,
    material: &dyn Material,
    path: &[HistoryPoint],
) -> Vec<CurvePoint> {
    indent_along(&body, material, path, &HistoryOptions::default()).expect("a disc")
}

/// Every error estimate covers the deviation from the reference, and none is above 1e-10 of the largest value.
///
/// `reference` is the relative error of the reference.
fn assert_bars(curve: &[CurvePoint], expected: &[[f64; 3]], reference: f64, name: &str) {
    assert!(!expected.is_empty(), "{name} has rows");
    for column in [1, 2] {
        let values = expected.iter().map(|row| row[column]);
        let scale = values.fold(0.0, f64::max);
        for row in expected {
            let mut points = curve.iter();
            let point = points.find(|point| (point.time - row[0]).abs() <= 1e-15 * row[0]);
            let point = point.unwrap_or_else(|| panic!("{name}: no point at {}", row[0]));
            let got = [point.normal_force, point.contact_radius][column - 1];
            let expected = Estimate::new(row[column], reference * scale);
            assert_agree([got, expected], &(name, row));
            assert!(got.error <= 1e-10 * scale, "{name} at {row:?}: {got:?}");
        }
    }
}

#[test]
fn one_way_in_and_out() {
    let table = include_str!("../data/histories.csv");
    let rows: Vec<Vec<&str>> = (table.lines().skip(2))
        .map(|line| line.split(',').collect())
        .collect();
    let cases: Vec<_> = rows.chunk_by(|one, next| one[..3] == next[..3]).collect();
    assert_eq!(cases.len(), 15, "histories in the table");
    for case in cases {
        let [material, shape, along] = [0, 1, 2].map(|k| case[0][k]);
        let rows = case.iter().map(|row| row[3..6].join(" "));
        let rows = numbers::<3>(&rows.collect::<Vec<_>>().join(","));
        let times: Vec<f64> = rows.iter().map(|row| row[0]).collect();
        let path = path(&knots(along), &times);
        let curve = follow(&*body(shape), &self::material(material), &path);
        assert_bars(&curve, &rows, 1e-17, &case[0][..3].join(", "));
    }
}

/// Casebook-2.json, reapproach: 11 digits.
#[test]
fn pressing_again_before_the_surface_has_recovered() {
    let expected = numbers::<3>(include_str!("../data/reapproach.txt"));
    let times: Vec<f64> = expected.iter().map(|row| row[0]).collect();
    // The same in many short segments.
    let finer = (0..360).map(|n| 0.01 * f64::from(n)).chain(times.clone());
    for times in [times, finer.collect()] {
        let path = path(&knots("again"), &times);
        let curve = follow(&*body("paraboloid"), &material("solid"), &path);
        assert_bars(&curve, &expected, 1e-11, "again");
    }
}

/// Segments may be divided anywhere: turns of the edge inside them are found, with dashpot or without.
#[test]
fn points_in_between_change_nothing() {
    let times: Vec<f64> = (1..40).map(|n| 0.07 * f64::from(n)).collect();
    for (name, solid) in ["catch", "dent"]
        .iter()
        .flat_map(|name| ["solid", "three", "kelvin-voigt"].map(|solid| (name, solid)))
    {
        let [coarse, fine] = [&[][..], &times].map(|times| {
            let path = path(&knots(name), times);
            follow(&*body("paraboloid"), &material(solid), &path)
        });
        for point in &coarse {
            let mut others = fine.iter();
            let same = others.find(|other| other.time.total_cmp(&point.time).is_eq());
            let value = same.expect("a knot").normal_force.value;
            let force = Estimate::new(point.normal_force.value, 1e-11 * 8e-3);
            assert_agree([force, Estimate::exact(value)], &(name, solid, point));
        }
    }
}

/// Power laws over the whole curve, with the error of their expansion in the bar.
#[test]
fn power_laws_come_back_as_theory_says() {
    // Force at parts of the time from the turn to the end of contact, over the peak: casebook-2.json and issue 20.
    let expected = [
        (0.1, [0.802136, 0.522573, 0.305592, 0.074767]),
        (0.3, [0.694786, 0.411157, 0.226806, 0.052176]),
    ];
    for (exponent, forces) in expected {
        let springpot = Springpot::new(1.0, exponent).expect("a springpot");
        let expansion = springpot.expand([1e-4, 1e6], 1e-10).expect("an expansion");
        let error = expansion.relative_error;
        let material = Prony::new(expansion.spectrum).expect("a material");
        // ∫ G ḋ from first touch vanishes: 2 (t − 1)^(1−β) = t^(1−β).
        let end = 1.0 / (1.0 - 0.5_f64.powf(1.0 / (1.0 - exponent)));
        let times = [0.1, 0.3, 0.5, 0.8].map(|part| 1.0 + part * (end - 1.0));
        let path = path(&knots("triangle"), &times);
        let options = HistoryOptions {
            modulus_error: error,
            ..HistoryOptions::default()
        };
        let curve = indent_along(&body("paraboloid"), &material, &path, &options);
        let curve = curve.expect("a disc");
        let peak = curve[1].normal_force;
        for (point, force) in curve[2..].iter().zip(forces) {
            let ratio = point.normal_force.value / peak.value;
            let bar = point.normal_force.error / peak.value;
            assert!(
                (ratio - force).abs() <= 5.1e-7 && bar > error && bar < 1e-9,
                "exponent {exponent}: {ratio} ± {bar:e}, expected {force}"
            );
        }
    }
}

fn under(body: &dyn Axisymmetric, forces: &[[f64; 2]], relative_error: f64) -> Vec<CurvePoint> {
    let history = history(forces.iter().copied(), Control::NormalForce);
    let options = HistoryOptions {
        relative_error,
        ..HistoryOptions::default()
    };
    indent_along(&body, &material("solid"), &history, &options).expect("a depth")
}

/// Casebook-2.json, force_control: 14 digits. Both forces jump.
#[test]
fn depth_under_a_force_that_does_not_fall() {
    let forces = "0 0, 0 0.01, 1 0.01, 2 0.01, 2 0.02, 3 0.02, 6 0.02, 20 0.02";
    let expected = numbers::<2>(include_str!("../data/force_control.txt"));
    let curve = under(&*body("paraboloid"), &numbers(forces), 1e-3);
    for (point, expected) in curve[1..].iter().zip(expected) {
        let got = [point.contact_radius, point.indentation_depth];
        for (got, value) in got.into_iter().zip(expected) {
            assert_agree([got, Estimate::new(value, 1e-14 * value)], point);
            assert!(got.error <= 1e-12 * value, "{point:?}");
        }
    }
}

/// The force of a path of the depth, given back, gives the depth; and a step down makes contact and depth jump.
#[test]
fn depth_and_force_are_inverse() {
    let body = body("paraboloid");
    let times: Vec<f64> = (1..28).map(|n| 0.1 * f64::from(n)).collect();
    let path = path(&knots("again"), &times);
    let curve = follow(&*body, &material("solid"), &path[..27]);
    let forces = curve.iter().map(|p| [p.time, p.normal_force.value]);
    let back = under(&*body, &forces.collect::<Vec<_>>(), 1e-3);
    for (point, given) in back.iter().zip(&curve) {
        let deviation = (point.indentation_depth.value - given.indentation_depth.value).abs();
        // The force is not straight between the points.
        assert!(deviation <= 2e-2 * 0.015, "{point:?}, given {given:?}");
    }
    let step_down = under(&*body, &numbers("0 0, 1 0.02, 1 0.005, 2 0.005"), 1e-4);
    let depths = step_down.iter().map(|point| point.indentation_depth.value);
    let depths: Vec<f64> = depths.collect();
    let jumps = depths[2] < 0.8 * depths[1] && depths[3] > depths[2];
    assert!(jumps, "{depths:?}");
}

/// Error estimates of the depth cover a finer result: under a force that falls, that falls to zero, that jumps, and that rises
/// again. The number of parts grows slowly, because the depths are extrapolated.
#[test]
fn depths_under_a_falling_force_are_within_their_bars() {
    for forces in [
        "0 0, 1 0.02, 2 0",
        "0 0, 1 0.02, 1 0.005, 2 0.005",
        "0 0, 1 0.02, 1.5 0.005, 2.5 0.03",
    ] {
        let under = |error| under(&*body("paraboloid"), &numbers(forces), error);
        for (point, exact) in under(2e-3).iter().zip(&under(1e-4)) {
            let depth = point.indentation_depth;
            assert_agree([depth, exact.indentation_depth], &forces);
            assert!(depth.error <= 2e-3 * 0.016, "{forces}: {depth:?}");
        }
    }
}

/// Where all branches have relaxed since contact, no load determines the edge.
#[test]
fn a_contact_that_has_relaxed_carries_nothing() {
    for fluid in ["maxwell", "fluid"] {
        let path = path(&knots("relaxed"), &[2500.0]);
        let curve = follow(&*body("paraboloid"), &material(fluid), &path);
        for point in &curve[2..] {
            assert_agree([point.normal_force, Estimate::exact(0.0)], &(fluid, point));
        }
    }
}

/// Compared with the trapezoidal rule on many points, for a contact whose edge turns and that separates inside segments. An
/// elastic material keeps no energy.
#[test]
fn work_is_the_area_under_the_curve() {
    let body = body("paraboloid");
    let work = |name: &str, solid: &str| {
        let options = HistoryOptions {
            relative_error: 1e-4,
            ..HistoryOptions::default()
        };
        let work = work_along(&body, &material(solid), &path(&knots(name), &[]), &options);
        work.expect("work")
    };
    let times: Vec<f64> = (1..9000).map(|n| 4e-4 * f64::from(n)).collect();
    let curve = follow(&*body, &material("solid"), &path(&knots("again"), &times));
    let (mut area, mut known) = (0.0, work("again", "solid").into_iter().skip(1));
    for pair in curve.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let rise = to.indentation_depth.value - from.indentation_depth.value;
        area += 0.5 * (from.normal_force.value + to.normal_force.value) * rise;
        if knots("again")
            .iter()
            .any(|[time, _]| time.total_cmp(&to.time).is_eq())
        {
            let (value, error) = (area, 1e-11);
            let work = known.next().expect("work");
            assert!(work.error <= 1e-4 * 2e-4, "{work:?}");
            assert_agree([work, Estimate::new(value, error)], &to);
        }
    }
    assert_eq!(known.next(), None, "all knots");
    assert_agree(
        [work("triangle", "elastic")[2], Estimate::exact(0.0)],
        &"a spring",
    );
}

/// F = 8 a ∫ G dd and d = ∫ J dF/(8 a): a punch has its radius at every load.
#[test]
fn a_flat_punch_follows_force_and_depth() {
    let punch = FlatPunch::new(0.01).expect("a punch");
    let path = path(&numbers("0 0, 1 0.02, 2 0.015"), &[]);
    let curve = follow(&punch, &material("solid"), &path);
    let held = 1.0 - f64::exp(-1.0);
    let expected = [
        0.0,
        0.08 * 0.02 * (1.0 + 4.0 * held),
        0.08 * (0.015 + 4.0 * (0.02 * held * f64::exp(-1.0) - 0.005 * held)),
    ];
    for (point, expected) in curve.iter().zip(expected) {
        assert_agree([point.normal_force, Estimate::exact(expected)], point);
    }
    let work = work_along(
        &punch,
        &material("solid"),
        &path,
        &HistoryOptions::default(),
    );
    let loading = Estimate::exact(0.08 * 0.02 * 0.02 * (0.5 + 4.0 * f64::exp(-1.0)));
    assert_agree([work.expect("work")[1], loading], &"work of loading");
    let peak = expected[1];
    let forces = [[0.0, 0.0], [1.0, peak], [2.0, 0.5 * peak]];
    let curve = under(&punch, &forces, HistoryOptions::default().relative_error);
    let rising = history(forces[..2].iter().copied(), Control::NormalForce);
    let work = work_along(
        &punch,
        &material("solid"),
        &rising,
        &HistoryOptions::default(),
    );
    // ∫ F dd with F ∝ t and d as below.
    let creeping = 0.5 - 0.8 * (25.0 - 30.0 * f64::exp(-0.2));
    let loading = Estimate::exact(peak * peak / 0.08 * creeping);
    assert_agree([work.expect("work")[1], loading], &"work under a force");
    // J(t) = 1 − 4/5 e^(−t/5).
    let creep = |step: f64| step - 4.0 * (1.0 - f64::exp(-step / 5.0));
    let depths = [0.0, creep(1.0), creep(2.0) - 1.5 * creep(1.0)];
    for (point, depth) in curve.iter().zip(depths) {
        let expected = Estimate::exact(peak / 0.08 * depth);
        assert_agree([point.indentation_depth, expected], point);
    }
}
