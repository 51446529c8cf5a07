//! Whether the band that the covariance of a fitted material gives a friction coefficient holds the friction of the true
//! material.

mod experiment;

use anyhow::Result;
use serde::Serialize;

use super::{Report, Share};
use crate::table::{Table, group_by};
use crate::tasks::in_parallel;
use experiment::{Experiments, Found};

/// 95 % of a normal distribution are within this number of standard deviations from its mean.
const OF_95_PERCENT: f64 = 1.96;
/// Smallest and largest fraction of the true frictions that may be inside the band of 95 %. Chosen: 95 % within the scatter
/// of the number of experiments.
const ALLOWED_COVERAGE: [f64; 2] = [0.92, 0.98];
/// Number of binomial standard deviations by which this fraction may be outside [`ALLOWED_COVERAGE`] in a quick run. Chosen:
/// if the coverage is exactly at a limit, one of 700 runs is outside by more.
const ALLOWED_SCATTER: f64 = 3.0;

/// Experiments that have something in common.
#[derive(Debug, Serialize)]
struct Group {
    /// What the experiments of the group have in common.
    experiments: String,
    /// Number of experiments in the group.
    number: usize,
    /// Fraction of them whose true friction is within 1.96 standard uncertainties of the found one; then within one.
    inside_95_percent_band: f64,
    inside_68_percent_band: f64,
    /// Standard uncertainty by the material over friction.
    median_relative_material_error: f64,
    /// Fraction of them that warn beyond the measured window.
    warns_outside: f64,
}

/// Simulates all experiments, fits a material to each measurement, and compares the friction of a ball on it with that on
/// the true material; a quick run has a few experiments.
pub(super) fn report(quick: bool) -> Result<Report> {
    let experiments: Experiments = toml::from_str(include_str!("experiments.toml"))?;
    let numbers: Vec<u32> = (0..experiments.count[usize::from(quick)]).collect();
    let found = in_parallel("fitted materials", &numbers, |number| {
        experiments.run(*number)
    })?;
    let groups = groups(&found);
    let table = Table::new("material_groups", &groups)?;
    let columns = "experiments number inside_95_percent_band inside_68_percent_band \
                   median_relative_material_error warns_outside";
    let all = &groups[0];
    let chance = ALLOWED_SCATTER * (0.05 * 0.95 / all.number as f64).sqrt();
    let chance = if quick { chance } else { 0.0 };
    let share = all.inside_95_percent_band;
    let holds = share >= ALLOWED_COVERAGE[0] - chance
        && share <= ALLOWED_COVERAGE[1] + chance
        && all.warns_outside >= 1.0;
    let [lowest, highest] = ALLOWED_COVERAGE.map(|share| 100.0 * share);
    let verdict = if holds { "as asked" } else { "NOT as asked" };
    let summary = format!(
        "{:.1} % of {} true frictions are inside the 95 % band ({lowest} to {highest} % asked): {verdict}\n{}",
        100.0 * share,
        all.number,
        table.markdown(columns)?
    );
    let failure =
        (!holds).then(|| "the material error of fitted materials is not as asked".to_owned());
    Ok(Report {
        name: "material",
        tables: vec![table, Table::new("material", &found)?],
        summary,
        failure,
        ..Report::default()
    })
}

/// All experiments, those of each material, those of each number of isotherms, and those with b_T = 1 and b_T = T/T_r; the
/// first is all.
fn groups(found: &[Found]) -> Vec<Group> {
    let kinds: [fn(&&Found) -> String; 4] = [
        |_| "all".to_owned(),
        |one| one.material.clone(),
        |one| format!("{} isotherms", one.isotherms),
        |one| ["b_T = 1", "b_T = T/T_r"][usize::from(one.is_entropic)].to_owned(),
    ];
    let groups = kinds.into_iter().flat_map(|kind| group_by(found, kind));
    groups
        .map(|(name, found)| Group::of(name, &found))
        .collect()
}

impl Group {
    /// Fractions and median of some experiments, which have `experiments` in common; at least one.
    fn of(experiments: String, found: &[&Found]) -> Self {
        let share = |is: fn(&Found) -> bool| {
            let share: Share = found.iter().map(|one| is(one)).collect();
            share.fraction()
        };
        let mut errors: Vec<f64> = found.iter().map(|one| one.relative_error()).collect();
        errors.sort_by(f64::total_cmp);
        Self {
            experiments,
            number: found.len(),
            inside_95_percent_band: share(|one| one.deviation.abs() <= OF_95_PERCENT),
            inside_68_percent_band: share(|one| one.deviation.abs() <= 1.0),
            median_relative_material_error: errors[errors.len() / 2],
            warns_outside: share(|one| one.warns_outside),
        }
    }
}
