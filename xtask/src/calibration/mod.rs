//! `calibrate`: do the error bars of every method hold on random scenes?

mod draw;
mod judged;
mod picture;
mod reference;
mod table;
mod ways;

use std::path::PathBuf;

use crate::random::Random;
use anyhow::Result;
use clap::Args;
use rayon::prelude::*;

use crate::output::{WrongInput, print_line, write_figure, write_table};
use crate::progress;
use judged::{Examination, Judged};
use ways::{FULL, QUICK};

/// Arguments of the command.
#[derive(Debug, Args)]
pub(crate) struct Calibrate {
    /// Where tables and the picture are written.
    #[arg(long, default_value = "target/calibration")]
    out: PathBuf,
    /// Number of scenes, from 1 to 100000 [default: 300, quick 40].
    #[arg(long, value_name = "N")]
    scenes: Option<usize>,
    /// Which scenes; the same seed gives the same ones.
    #[arg(long, default_value_t = 2014)]
    seed: u64,
    /// Fewer scenes, and larger errors and fewer elements on the half space.
    #[arg(long)]
    quick: bool,
}

const SCENES: usize = 300;
const QUICK_SCENES: usize = 40;
const MOST_SCENES: usize = 100_000;

/// Judges the bars of every method on random scenes, writes tables and the picture, and prints what they say.
pub(crate) fn calibrate(options: &Calibrate) -> Result<()> {
    let out = &options.out;
    std::fs::create_dir_all(out)
        .map_err(|error| WrongInput(format!("--out {} cannot be made: {error}", out.display())))?;
    let judged = judge(&examinations(options)?)?;
    write_table(&out.join("calibration.csv"), &judged.rows)?;
    write_table(&out.join("calibration_refused.csv"), &judged.refusals)?;
    write_figure(out, "calibration", &picture::figure(&judged.rows))?;
    print_line(&table::table(&judged))?;
    print_line(&table::left_out(&judged.left_out))
}

fn examinations(options: &Calibrate) -> Result<Vec<Examination>> {
    let (usual, extent) = if options.quick {
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
    let bar = progress::bar("calibration", examinations.len());
    let parts: Vec<Judged> = examinations
        .par_iter()
        .map(|examination| {
            let judged = examination.judge();
            bar.inc(1);
            judged
        })
        .collect::<Result<_>>()?;
    bar.finish_and_clear();
    let mut judged = Judged::default();
    for part in parts {
        judged.rows.extend(part.rows);
        judged.refusals.extend(part.refusals);
        judged.left_out.extend(part.left_out);
    }
    Ok(judged)
}
