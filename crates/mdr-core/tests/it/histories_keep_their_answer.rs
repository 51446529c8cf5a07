//! A history says the same with more points, in other units, and where a flat end keeps its disc.

use indenters::{
    Axisymmetric, Control, FlatCone, FlatPunch, HistoryPoint, PiecewiseLinearProfile, PowerProfile,
};
use mdr_core::{CurvePoint, HistoryOptions, indent_along};
use numerics::Estimate;
use rheology::{Compressible, Material, Prony};

use Control::{IndentationDepth, NormalForce};

use crate::histories_match_quadrature::{body, material, numbers};
use crate::support::{assert_agree, assert_close, history, prony};

fn follow(
    body: &dyn Axisymmetric,
    material: &dyn Material,
    path: &[HistoryPoint],
) -> Vec<CurvePoint> {
    let options = HistoryOptions {
        relative_error: 0.02,
        ..HistoryOptions::default()
    };
    indent_along(&body, material, path, &options).expect("a curve")
}

/// Two more points in every segment that takes time.
fn divided(knots: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut all = vec![knots[0]];
    for pair in knots.windows(2) {
        let [start, end] = [pair[0], pair[1]];
        let between = |part: f64| [0, 1].map(|k| start[k] + part * (end[k] - start[k]));
        if end[0] > start[0] {
            all.extend([0.3, 0.75].map(between));
        }
        all.push(end);
    }
    all
}

fn assert_same(
    body: &dyn Axisymmetric,
    material: &dyn Material,
    knots: &[[f64; 2]],
    is_force: bool,
) {
    let control = if is_force {
        NormalForce
    } else {
        IndentationDepth
    };
    let on = |knots: &[[f64; 2]]| follow(body, material, &history(knots.iter().copied(), control));
    let [coarse, fine] = [on(knots), on(&divided(knots))];
    let largest = |of: fn(&CurvePoint) -> f64| coarse.iter().map(of).fold(0.0, f64::max);
    let rounding = [
        largest(|point| point.normal_force.value),
        largest(|point| point.indentation_depth.value),
        largest(|point| point.contact_radius.value),
    ]
    .map(|scale| Estimate::new(0.0, 1e-14 * scale));
    let mut others = fine.iter();
    for point in &coarse {
        let same = others.find(|other| {
            let [value, at] = [point, other].map(|p| {
                if is_force {
                    p.normal_force
                } else {
                    p.indentation_depth
                }
            });
            other.time.total_cmp(&point.time).is_eq() && value == at
        });
        let same = same.unwrap_or_else(|| panic!("{is_force} {knots:?}: {point:?} of {fine:?}"));
        for ([got, expected], rounding) in [
            [point.normal_force, same.normal_force],
            [point.indentation_depth, same.indentation_depth],
            [point.contact_radius, same.contact_radius],
        ]
        .into_iter()
        .zip(rounding)
        {
            assert_agree([got + rounding, expected], &(is_force, knots, point));
        }
    }
}

/// Falls, dwells, jumps and pressing again, by depth and by force, on every material.
#[test]
fn points_in_between_change_nothing() {
    let depths = [
        "0 0, 1 0.01, 2 0.01, 3 0.002, 4 0.014",
        "0 0, 0.5 0.012, 0.8 -0.001, 1 0.006, 2 0.002",
        "0 0, 0.2 0.01, 1 0.008, 1.2 0.02, 1.5 0.02, 4 -0.001",
        "0 0, 0.2 0.01, 30 0.01",
    ];
    // Where the contact is pressed on again, only a flat end is fast.
    let falling = numbers("0 0.01, 0.3 0.02, 1.5 0.005, 2 0");
    let resting = numbers("0 0, 1 0.02, 1.5 0, 2.5 0, 3 0.01, 3 0, 4 0");
    let again = [
        "0 0, 1 0.02, 1.5 0.005, 2.5 0.005",
        "0 0.01, 1 0.02, 2 0.002, 2.5 0.03",
        "0 0, 0.3 0.02, 0.3 0.015, 2 0.015, 2.5 0",
    ];
    let punch = FlatPunch::new(0.05).expect("a punch");
    let flat = FlatCone::new(0.02, 0.4).expect("a cone");
    let paraboloid = body("paraboloid");
    let bodies: [&dyn Axisymmetric; 3] = [&*paraboloid, &punch, &flat];
    let mut materials = ["elastic", "solid", "maxwell", "kelvin-voigt"]
        .map(material)
        .to_vec();
    materials.push(prony([0.0, 2.0], &[]));
    for (body, material) in bodies
        .iter()
        .flat_map(|body| materials.iter().map(move |material| (*body, material)))
    {
        for knots in depths {
            assert_same(body, material, &numbers(knots), false);
        }
        assert_same(body, material, &falling, true);
    }
    for material in &materials {
        assert_same(&*paraboloid, material, &resting, true);
    }
    for (knots, material) in again
        .iter()
        .flat_map(|knots| materials.iter().map(move |material| (knots, material)))
    {
        assert_same(&punch, material, &numbers(knots), true);
    }
}

/// d = 2 (1 − ν)/(8 a) ∫ J dF, also while the force falls: the elements of a flat end are loaded as one.
#[test]
fn a_flat_punch_keeps_its_disc_while_it_is_pressed() {
    let punch = FlatPunch::new(2e-6).expect("a punch");
    let chain = prony([300.0, 0.0], &[(400.0, 0.02), (200.0, 0.5)]);
    let material = Compressible::new(&chain, 0.3).expect("a material");
    let knots = [
        [0.0, 0.0],
        [0.1, 5e-10],
        [0.3, 5e-10],
        [0.5, 1e-10],
        [0.6, 1e-10],
    ];
    let curve = follow(&punch, &material, &history(knots, NormalForce));
    for (point, [time, _]) in curve.iter().zip(knots) {
        let depth = 1.4 / (8.0 * 2e-6) * crept(&chain, &knots, time);
        assert_agree(
            [point.indentation_depth, Estimate::new(depth, 1e-9 * depth)],
            point,
        );
        if depth > 0.0 {
            assert_close([point.contact_radius.value, 2e-6], 1e-9, 0.0, point);
        }
    }
}

/// ∫ J(t − s) dF by the midpoint rule.
fn crept(material: &Prony, knots: &[[f64; 2]], time: f64) -> f64 {
    const STEPS: i32 = 20_000;
    let mut sum = 0.0;
    for pair in knots.windows(2).filter(|pair| pair[1][0] <= time) {
        let [[from, before], [to, after]] = [pair[0], pair[1]];
        for step in 0..STEPS {
            let at = from + (to - from) * (f64::from(step) + 0.5) / f64::from(STEPS);
            let compliance = material.creep_compliance(time - at).expect("a compliance");
            sum += compliance * (after - before) / f64::from(STEPS);
        }
    }
    sum
}

/// A table that ends lower than any depth tried, in units in which another one is; its edge is so steep that it is a punch.
/// On a dashpot the contact grows while a force falls slowly.
#[test]
fn a_table_is_pressed_in_all_units() {
    let knots = [
        [0.0, 466_754_276.2],
        [0.0, 1_433_034_084.9],
        [3.3166, 1_390_402_651.2],
    ];
    let curve = |length: f64, force: f64, time: f64| {
        let radii = [0.0, 0.042_787, 0.075_018, 0.084_498].map(|radius| length * radius);
        let heights = [0.0, 0.0, 0.135_389, 0.135_389].map(|height| length * height);
        let table = PiecewiseLinearProfile::new(radii.to_vec(), heights.to_vec());
        let pressure = force / (length * length);
        let moduli = [1.45e13 * pressure, 1.58e13 * pressure * time];
        let material = Compressible::new(&prony(moduli, &[]), 0.0).expect("a material");
        let knots = knots.map(|[t, f]| [t * time, f * force]);
        follow(
            &table.expect("a table"),
            &material,
            &history(knots, NormalForce),
        )
    };
    let in_si = curve(1.0, 1.0, 1.0);
    let (rate, [_, [_, start], [end, last]]) = (1.45 / 1.58, knots);
    let crept = 1.0 - f64::exp(-rate * end);
    let falling = (last - start) * (1.0 - crept / (rate * end));
    let punch = 2.0 / (8.0 * 0.042_787) * (start * crept + falling) / 1.45e13;
    let depth = in_si[2].indentation_depth.value;
    assert_close([depth, punch], 1e-5, 0.0, &"the table is almost a punch");
    for [length, force, time] in [
        [32.0, 1.0, 1.0],
        [0.0625, 2048.0, 0.5],
        [1024.0, 0.25, 512.0],
    ] {
        let scaled = curve(length, force, time)
            .into_iter()
            .map(|point| CurvePoint {
                time: point.time / time,
                indentation_depth: point.indentation_depth * length.recip(),
                normal_force: point.normal_force * force.recip(),
                contact_radius: point.contact_radius * length.recip(),
            });
        assert_eq!(scaled.collect::<Vec<_>>(), in_si, "{length} {force} {time}");
    }
}

/// What is left of a force after 30 relaxation times is known to its own digits, and every bar is a number.
#[test]
fn little_that_is_left_keeps_its_digits() {
    let cone = PowerProfile::cone(0.3).expect("a cone");
    let knots = [[0.0, 0.0], [1e-3, 0.01], [30.0, 0.01]];
    let curve = |knots: &[[f64; 2]]| {
        let maxwell = prony([0.0; 2], &[(3.0, 1.0)]);
        follow(
            &cone,
            &maxwell,
            &history(knots.iter().copied(), IndentationDepth),
        )
    };
    let [whole, parts] = [curve(&knots), curve(&divided(&knots))]
        .map(|curve| curve.last().expect("a point").normal_force);
    assert_close([whole.value, parts.value], 1e-12, 0.0, &whole);
    let held = history(knots, IndentationDepth);
    for point in follow(&cone, &prony([0.0, 2.0], &[]), &held) {
        let bar = point.contact_radius.error;
        assert!((0.0..1e-9).contains(&bar), "{point:?}");
    }
}
