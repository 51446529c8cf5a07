//! `calibrate`: do the error bars of every method hold on random scenes?

mod draw;
mod judged;
mod picture;
mod reference;
mod table;
mod ways;

use crate::random::Random;
use anyhow::Result;
use clap::Args;

use super::{Report, Table};
use crate::output::WrongInput;
use crate::tasks::in_parallel;
use judged::{Examination, Judged};
use ways::{FULL, QUICK};

/// Which scenes.
#[derive(Debug, Args)]
pub(super) struct Options {
    /// Number of scenes, from 1 to 100000 [default: 300, quick 40].
    #[arg(long, value_name = "N")]
    scenes: Option<usize>,
    /// Which scenes; the same seed gives the same ones.
    #[arg(long, default_value_t = SEED)]
    seed: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            scenes: None,
            seed: SEED,
        }
    }
}

const SEED: u64 = 2014;
const SCENES: usize = 300;
const QUICK_SCENES: usize = 40;
const MOST_SCENES: usize = 100_000;

/// Judges the bars of every method on random scenes; a quick run takes fewer, with larger errors and fewer elements on
/// the half space.
pub(super) fn report(options: &Options, quick: bool) -> Result<Report> {
    let judged = judge(&examinations(options, quick)?)?;
    Ok(Report {
        name: "calibration",
        tables: vec![
            Table::new("calibration", &judged.rows)?,
            Table::new("calibration_refused", &judged.refusals)?,
        ],
        pictures: vec![("calibration", picture::figure(&judged.rows))],
        summary: format!(
            "{}\n{}",
            table::table(&judged),
            table::left_out(&judged.left_out)
        ),
        failure: None,
    })
}

fn examinations(options: &Options, quick: bool) -> Result<Vec<Examination>> {
    let (usual, extent) = if quick {
        (QUICK_SCENES, QUICK)
    } else {
        (SCENES, FULL)
    };
    let count = options.scenes.unwrap_or(usual);
    if !(1..=MOST_SCENES).contains(&count) {
        let problem = format!("--scenes {count} is not from 1 to {MOST_SCENES}");
        return Err(WrongInput(problem).into());
    }
    let mut random = Random::new(options.seed);
    (1..=count)
        .map(|number| Examination::new(&mut random, number, &extent))
        .collect()
}

/// All scenes at the same time, in the order of their numbers.
fn judge(examinations: &[Examination]) -> Result<Judged> {
    let parts: Result<Vec<Judged>> = in_parallel("calibration", examinations, Examination::judge);
    let mut judged = Judged::default();
    for part in parts? {
        judged.rows.extend(part.rows);
        judged.refusals.extend(part.refusals);
        judged.left_out.extend(part.left_out);
    }
    Ok(judged)
}
