//! A body that is pulled into contact is flagged or refused, and no other.

use std::fmt::Write as _;

use indenters::PowerProfile;
use measurements::MeasurementError;
use measurements::indentation::{FitOptions, Flag, IndentationCurve, Rheology, fit_indentation};
use rayon::prelude::*;

use crate::support::Normal;
use crate::synthetic::{NOISES, n_curves, sphere, write_table};

const RADIUS: f64 = 5e-6;
const YOUNG: f64 = 1e3;
/// Depth at the end of the way in, \[m].
const DEEPEST: f64 = 1e-6;

/// Forces of Johnson, Kendall and Roberts (1971) over depth, from the depth 0 on, where the body jumps into contact:
///
/// ```text
/// F = K a³/R − √(6 π w K a³),   d = a²/R − (2/3) √(6 π w a/K),   K = (4/3) E/(1 − ν²)
/// ```
struct Adhesive {
    /// 6 π w, \[N/m].
    work: f64,
}

impl Adhesive {
    const K: f64 = 4.0 / 3.0 * YOUNG / 0.75;

    fn force(&self, depth: f64) -> f64 {
        if depth < 0.0 {
            return 0.0;
        }
        let [mut low, mut high] = [0.0, RADIUS];
        // On the branch on which the depth grows with the radius.
        low += (self.work * RADIUS * RADIUS / Self::K / 36.0).cbrt();
        for _ in 0..60 {
            let middle: f64 = 0.5 * (low + high);
            let of_middle =
                middle * middle / RADIUS - 2.0 / 3.0 * (self.work * middle / Self::K).sqrt();
            *(if of_middle < depth {
                &mut low
            } else {
                &mut high
            }) = middle;
        }
        Self::K * low.powi(3) / RADIUS - (self.work * Self::K * low.powi(3)).sqrt()
    }

    /// With a fall of the force at the jump, (2/9) 6 π w R, that is a part of the largest force.
    fn with_fall(part: f64) -> Self {
        let [mut low, mut high] = [0.0, 1.0];
        for _ in 0..60 {
            let work = 0.5 * (low + high);
            let adhesive = Self { work };
            let fall = 2.0 / 9.0 * work * RADIUS;
            let is_small = fall < part * adhesive.force(DEEPEST);
            *(if is_small { &mut low } else { &mut high }) = work;
        }
        Self { work: low }
    }
}

fn way_in(
    points: u32,
    above: f64,
    force: impl Fn(f64) -> f64,
    noise: f64,
    seed: u64,
) -> IndentationCurve {
    let mut normal = Normal(seed);
    let time: Vec<f64> = (0..points)
        .map(|i| f64::from(i) / f64::from(points - 1))
        .collect();
    let depth = time.iter().map(|time| (DEEPEST + above) * time - above);
    let depth: Vec<f64> = depth.collect();
    let peak = force(DEEPEST);
    let force = depth
        .iter()
        .map(|depth| force(*depth) + noise * peak * normal.draw());
    IndentationCurve {
        force: force.collect(),
        time,
        depth,
    }
}

#[derive(Debug, PartialEq, Clone, Copy)]
enum Said {
    Nothing,
    Flagged(f64),
    Refused(f64),
}

fn said(curve: &IndentationCurve, rheology: Rheology) -> Said {
    let body = PowerProfile::paraboloid(0.5 / RADIUS).expect("a paraboloid");
    let options = FitOptions {
        rheology,
        ..FitOptions::default()
    };
    match fit_indentation(&body, curve, &options) {
        Err(MeasurementError::Damaged(Flag::JumpToContact { part, .. })) => Said::Refused(part),
        Err(other) => panic!("{other}"),
        Ok(fit) => {
            let mut parts = fit.flags.iter().filter_map(|flag| match flag {
                Flag::JumpToContact { part, .. } => Some(*part),
                _ => None,
            });
            parts.next().map_or(Said::Nothing, Said::Flagged)
        }
    }
}

/// Points, depth of the first one above the surface, \[m], and noise as a part of the largest force.
const WAYS_IN: [(u32, f64, f64); 3] = [
    (500, 0.25e-6, 0.003),
    (400, 1e-6, 0.003),
    (2000, 0.5e-6, 0.01),
];

#[test]
fn every_body_that_is_pulled_in_is_flagged_or_refused() {
    let n = n_curves(4);
    let mut table = String::new();
    for part in [0.02, 0.05, 0.1, 0.3] {
        let adhesive = Adhesive::with_fall(part);
        for (points, above, noise) in WAYS_IN {
            let all = (0..n).into_par_iter().map(|seed| {
                let force = |depth| adhesive.force(depth);
                let curve = way_in(points, above, force, noise, 3 + 77_777 * seed as u64);
                let rheologies = [Rheology::Elastic, Rheology::StandardSolid];
                said(&curve, rheologies[seed % 2])
            });
            let all: Vec<Said> = all.collect();
            let what = format!("{part} of the largest force, {points} points, noise {noise}");
            assert_said(&what, part, &all, &mut table);
        }
    }
    write_table("pull-in.txt", &table);
}

/// Every pull-in is reported; above 5 % all curves are refused, and below none.
#[track_caller]
fn assert_said(what: &str, part: f64, all: &[Said], table: &mut String) {
    let count = |is: fn(&Said) -> bool| all.iter().filter(|one| is(one)).count();
    let silent = count(|one| *one == Said::Nothing);
    let refused = count(|one| matches!(one, Said::Refused(_)));
    let found = all.iter().map(|one| match one {
        Said::Nothing => 0.0,
        Said::Flagged(part) | Said::Refused(part) => *part,
    });
    let mean = found.sum::<f64>() / all.len() as f64;
    writeln!(
        table,
        "{what}: {silent} silent, {refused} refused, {mean:.4} found"
    )
    .expect("text");
    assert_eq!(silent, 0, "{what}: {all:?}");
    let is_right = match part {
        0.06.. => refused == all.len(),
        ..0.04 => refused == 0,
        _ => true,
    };
    assert!(is_right, "{what}: {refused} refused: {all:?}");
}

#[test]
fn a_fall_is_not_made_up() {
    let n = n_curves(4);
    let case = sphere(&[1e3, 2e3, 0.3]);
    let mut table = String::new();
    for kind in &NOISES {
        for level in [0.003, 0.01, 0.03] {
            let all = (0..n).into_par_iter().map(|seed| {
                let curve = case.noisy_curve(400, level, kind, 5 + 1_000_003 * seed as u64);
                let fit = case.fit(&curve);
                fit.map_or_else(
                    |reason| reason.contains("jumps"),
                    |fit| {
                        fit.flags
                            .iter()
                            .any(|flag| matches!(flag, Flag::JumpToContact { .. }))
                    },
                )
            });
            let flagged = all.filter(|is_flagged| *is_flagged).count();
            writeln!(table, "{}, {level}: {flagged} of {n} flagged", kind.name).expect("text");
            // With a correlation of 0.99 the baseline is shorter than its noise lasts.
            let most = if kind.correlation > 0.95 {
                n / 20
            } else {
                n / 200
            };
            assert!(flagged <= most, "{}, {level}: {flagged} of {n}", kind.name);
        }
    }
    write_table("no-pull-in.txt", &table);
}
