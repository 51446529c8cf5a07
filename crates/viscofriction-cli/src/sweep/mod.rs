//! `sweep`: a scene for many values of its keys, one CSV row per point.
//!
//! A row says of which sweep and which point it is, so that an interrupted run goes on where it was and the files of
//! several machines can be joined.

mod file;
mod merge;

use std::path::{Path, PathBuf};
use std::sync::mpsc;

use anyhow::{Result, bail};
use clap::Args;
use rayon::prelude::*;
use viscofriction::WrongInput;
use viscofriction::sweep::{Plan, Row, Shard, Vary, header};

use crate::output::{print_text, read_input};
use crate::progress;
use file::{Existing, SweepFile, line};

/// Arguments of the command.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: viscofriction sweep scene.toml --vary load.velocity=1e-3:1:7:log --out friction.csv"
)]
pub(crate) struct Sweep {
    /// The scene file, or - for the standard input; docs/scenes.md describes it.
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
    #[arg(long, conflicts_with = "merge", requires = "out")]
    resume: bool,
    /// Compute every N-th point only, beginning with the I-th; I counts from 1 to N.
    #[arg(long, value_name = "I/N", conflicts_with = "merge")]
    shard: Option<Shard>,
    /// Join the files of shards.
    #[arg(long, value_name = "FILE", num_args = 1..)]
    merge: Vec<PathBuf>,
    /// The CSV file [default: the standard output].
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
    /// Begin anew if the file is there.
    #[arg(long, requires = "out", conflicts_with = "resume")]
    overwrite: bool,
}

/// Computes the points of a sweep, or joins files.
pub(crate) fn sweep(options: &Sweep) -> Result<()> {
    let Some(scene) = &options.scene else {
        return merge::merge(&options.merge, options.out.as_deref(), options.overwrite);
    };
    let plan = Plan::new(crate::run::source(scene)?, &options.vary, read_input)?;
    let threads = plan.validate()?.unwrap_or(0);
    let existing = match (options.resume, options.overwrite) {
        (true, _) => Existing::GoOn,
        (_, true) => Existing::Replace,
        _ => Existing::Refuse,
    };
    let mut file = match &options.out {
        Some(path) => Some(SweepFile::open(path, &plan, existing)?),
        None => None,
    };
    let mine = |point: &usize| options.shard.is_none_or(|shard| shard.holds(*point));
    let there = |point: &usize| file.as_ref().is_some_and(|file| file.has(*point));
    let missing: Vec<usize> = (0..plan.n_points())
        .filter(mine)
        .filter(|point| !there(point))
        .collect();
    let failures = match &mut file {
        Some(file) => {
            compute(&plan, &missing, threads, |row| file.append(row))?;
            file.finish()?
        }
        None => {
            print_text(&line(&header(&plan))?)?;
            let mut failures = 0;
            compute(&plan, &missing, threads, |row| {
                failures += usize::from(row.failed());
                print_text(&line(&row.fields)?)
            })?;
            failures
        }
    };
    if let Some(file) = &file {
        eprintln!(
            "{} points computed, {} in {}",
            missing.len(),
            file.len(),
            file.path().display()
        );
    }
    if failures > 0 {
        bail!("{failures} points could not be computed; the column `failure` says why");
    }
    Ok(())
}

/// Computes points on several threads, and hands over each row in the order in which it is finished.
fn compute(
    plan: &Plan,
    points: &[usize],
    threads: usize,
    mut take: impl FnMut(&Row) -> Result<()>,
) -> Result<()> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()?;
    let bar = progress::bar("sweep", points.len());
    let (finished, rows) = mpsc::channel();
    let taken = std::thread::scope(|scope| {
        scope.spawn(|| {
            pool.install(|| {
                // One point after the other, so that the file grows nearly in order.
                points
                    .par_iter()
                    .with_max_len(1)
                    .try_for_each_with(finished, |finished, &point| {
                        // Where nobody takes rows any more, nothing is computed any more.
                        finished.send(plan.solve(point)).map_err(|_| ())
                    })
                    .ok();
            });
        });
        let taken = rows.into_iter().try_for_each(|row| {
            take(&row?)?;
            bar.inc(1);
            Ok(())
        });
        taken
    });
    bar.finish_and_clear();
    taken
}

/// Checks what would be a file of rows.
pub(crate) fn check_rows(file: &Path, contents: &[u8]) -> Result<(), WrongInput> {
    file::row_table(file, contents).map(|_| ())
}

/// Wrong input in a file of rows.
fn wrong_row(path: &Path, line: usize, problem: &str) -> WrongInput {
    WrongInput(format!("{}:{line}: {problem}", path.display()))
}
