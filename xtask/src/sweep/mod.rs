//! `sweep`: a scene for many values of its parameters, one CSV row per point.
//!
//! A row says of which sweep and which point it is, so that an interrupted run goes on where it was and the files of
//! several machines can be joined.

mod file;
mod merge;
mod plan;
mod row;
mod vary;

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use clap::Args;
use rayon::prelude::*;

use crate::output::{WrongInput, print_line};
use crate::progress;
use crate::scene_file::Source;
use file::SweepFile;
use plan::Plan;
use row::Row;
use vary::{Shard, Vary};

/// Arguments of the command.
#[derive(Debug, Args)]
pub(crate) struct Sweep {
    /// The scene file; docs/scenes.md describes it.
    #[arg(required_unless_present = "merge", conflicts_with = "merge")]
    scene: Option<PathBuf>,
    /// A key of the scene and its values: `load.velocity=1e-3:1:10:log`; with several of them every combination is
    /// computed, the last key fastest.
    #[arg(
        long,
        value_name = "KEY=START:STOP:COUNT[:log]",
        required_unless_present = "merge",
        conflicts_with = "merge"
    )]
    vary: Vec<Vary>,
    /// Compute only what the file does not have yet.
    #[arg(long, conflicts_with = "merge")]
    resume: bool,
    /// Compute every N-th point only, beginning with the I-th; I counts from 1 to N.
    #[arg(long, value_name = "I/N", conflicts_with = "merge")]
    shard: Option<Shard>,
    /// Join the files of shards.
    #[arg(long, value_name = "FILE", num_args = 1..)]
    merge: Vec<PathBuf>,
    /// The CSV file [default: target/sweep/ and the name of the scene].
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Computes the points of a sweep, or joins files.
pub(crate) fn sweep(options: &Sweep) -> Result<()> {
    match &options.scene {
        None => {
            let default = || PathBuf::from("target/sweep/merged.csv");
            let out = options.out.clone().unwrap_or_else(default);
            merge::merge(&options.merge, &out)
        }
        Some(scene) => {
            let plan = Plan::new(Source::read(scene)?, &options.vary)?;
            compute(&plan, options)
        }
    }
}

fn compute(plan: &Plan, options: &Sweep) -> Result<()> {
    let threads = plan.validate()?;
    let path = options
        .out
        .clone()
        .unwrap_or_else(|| default_out(plan, options.shard));
    let mut file = SweepFile::open(&path, plan, options.resume)?;
    let mine = |point: &usize| options.shard.is_none_or(|shard| shard.holds(*point));
    let missing: Vec<usize> = (0..plan.n_points())
        .filter(mine)
        .filter(|point| !file.has(*point))
        .collect();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()?;
    let bar = progress::bar("sweep", missing.len());
    for points in missing.chunks(threads) {
        let rows: Vec<Result<Row>> =
            pool.install(|| points.par_iter().map(|&point| plan.solve(point)).collect());
        for row in rows {
            file.append(&row?)?;
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    let failures = file.finish()?;
    let [computed, there] = [missing.len(), file.len()];
    print_line(&format!(
        "{computed} points computed, {there} in {}",
        path.display()
    ))?;
    if failures > 0 {
        bail!(
            "{failures} of {} points could not be computed; the column `failure` says why",
            file.len()
        );
    }
    Ok(())
}

fn default_out(plan: &Plan, shard: Option<Shard>) -> PathBuf {
    let stem = plan.source().path().file_stem().unwrap_or_default();
    let mut name = stem.to_os_string();
    if let Some(shard) = shard {
        name.push(format!(".{}-of-{}", shard.number, shard.count));
    }
    name.push(".csv");
    PathBuf::from("target/sweep").join(name)
}

/// Checks what would be a file of rows.
pub(crate) fn check_rows(file: &Path, contents: &[u8]) -> Result<(), WrongInput> {
    file::row_table(file, contents).map(|_| ())
}

/// Wrong input in a file of rows.
fn wrong_row(path: &Path, line: usize, problem: &str) -> WrongInput {
    WrongInput(format!("{}:{line}: {problem}", path.display()))
}
