//! `sweep`: a scene for many values of its keys, one CSV row per point.
//!
//! Each row identifies its sweep and point, so an interrupted run can be resumed, and files of several machines can be merged.

mod file;
mod measured;
mod merge;
mod picture;
mod report;
mod samples;

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::mpsc;

use anyhow::{Result, bail};
use clap::Args;
use measurements::friction::FrictionTableOptions;
use viscofriction::WrongInput;
use viscofriction::sweep::{Plan, Shard, SweepRow, Vary, each_once, header};

use crate::input::{half_of_free_memory, metres, read_input, read_scene};
use crate::output::{ABOUT_WARNINGS, eprint_line, print_text};
use crate::progress;
pub(crate) use file::TableFile;
use file::{Existing, RowTable, SweepFile, checked, line};
use measured::Measured;
use picture::PictureFiles;
pub(crate) use picture::{beside, labelled, labelled_in};
use samples::Samples;

/// Arguments of the command.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: viscofriction sweep scene.toml --vary load.velocity=1e-3:1:7:log --out friction.csv"
)]
pub(crate) struct Sweep {
    /// The scene file, or - for the standard input; docs/scenes.md describes it.
    #[arg(required_unless_present = "merge", conflicts_with = "merge")]
    scene: Option<PathBuf>,
    /// A key of the scene and its values: `load.velocity=1e-3:1:10:log`, or a list, `load.velocity=1,2,5`, also of texts
    /// and files, `material.file.path=a.toml,b.toml`; with several of them every combination is computed, the last key
    /// fastest.
    #[arg(
        long,
        value_name = "KEY=START:STOP:COUNT[:log]",
        required_unless_present_any = ["merge", "samples"],
        conflicts_with = "merge"
    )]
    vary: Vec<Vary>,
    /// Number of random samples of the uncertain numbers of the scene, from 1 to 999999. The column `sample` counts them; sample 0 is the scene
    /// itself, with its uncertainty to first order. The distribution of the answers is printed and drawn.
    #[arg(long, value_name = "N", conflicts_with = "merge", value_parser = Vary::samples)]
    samples: Option<Vary>,
    /// Also say what the covariance of the material and the uncertainties of the scene make of every point, and draw the band of
    /// the material.
    #[arg(long, conflicts_with = "merge")]
    sensitivity: bool,
    /// Compute only what the file does not have yet.
    #[arg(long, conflicts_with = "merge", requires = "out")]
    resume: bool,
    /// Go on with the file, and compute those of its points again that have no answer.
    #[arg(
        long,
        requires = "out",
        conflicts_with_all = ["merge", "overwrite"]
    )]
    retry_failed: bool,
    /// Compute every N-th point only, beginning with the I-th; I counts from 1 to N.
    #[arg(long, value_name = "I/N", conflicts_with = "merge")]
    shard: Option<Shard>,
    /// Join the files of shards.
    #[arg(long, value_name = "FILE", num_args = 1..)]
    merge: Vec<PathBuf>,
    /// The CSV file; a picture is written into the same folder [default: the standard output].
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
    /// Measured friction over speed, drawn with its error bars over the computed friction; residuals are in FILE.measured.csv
    /// beside the CSV file. A table as of fit-friction: v (or rpm) and mu, and perhaps T, normal force and standard error.
    #[arg(long, value_name = "TABLE.csv", requires = "out")]
    measured: Option<PathBuf>,
    /// Radius of the circular track in m or with a unit, as "30 mm", for rotational speeds in the table without a column of radii.
    #[arg(long, value_name = "RADIUS", value_parser = metres, requires = "measured")]
    track_radius: Option<f64>,
    /// Time in s at the beginning of every run at constant speed that is left out of its mean, for a table over time; 0 for none.
    #[arg(long, value_name = "SECONDS", requires = "measured")]
    run_in: Option<f64>,
    /// Begin anew if the file is there.
    #[arg(long, requires = "out", conflicts_with = "resume")]
    overwrite: bool,
}

/// Runs the command: computes the points of a sweep, or merges files.
pub(crate) fn sweep(options: &Sweep) -> Result<()> {
    let read = FrictionTableOptions {
        track_radius: options.track_radius,
        run_in: options.run_in,
    };
    let table = options
        .measured
        .as_deref()
        .map(|path| Measured::new(path, &read))
        .transpose()?;
    let measured = table.as_ref();
    let Some(scene) = &options.scene else {
        let out = options.out.as_deref();
        return merge::merge(&options.merge, out, options.overwrite, measured);
    };
    // Plan the sweep and validate the points of this shard.
    let vary = options.vary.iter().chain(&options.samples);
    let vary: Vec<Vary> = vary.cloned().collect();
    let mut plan = Plan::new(read_scene(scene)?, &vary, read_input)?;
    plan.sensitivity = options.sensitivity || options.samples.is_some();
    plan.max_memory = half_of_free_memory();
    let mine = |point: &usize| options.shard.is_none_or(|shard| shard.holds(*point));
    let points: Vec<usize> = (0..plan.n_points()).filter(mine).collect();
    measured.map_or(Ok(()), |measured| {
        measured.check(&rows_without_results(&plan))
    })?;
    let threads = plan.validate(&points)?.unwrap_or(0);
    // Compute the points, into the file if one is given.
    let Computed {
        rows,
        n_failed_before,
    } = match &options.out {
        Some(out) => compute_into_file(
            &plan,
            points,
            threads,
            Output {
                path: out,
                options,
                measured,
            },
        )?,
        None => compute_and_print(&plan, &points, threads)?,
    };
    // Report warnings, the distribution of samples, and failures.
    eprint_warnings(&rows);
    eprint_samples(&header(&plan), &rows);
    let n_failed = rows.iter().filter(|row| row.failed()).count();
    if n_failed > 0 {
        let before = match n_failed_before {
            0 => String::new(),
            count => format!(
                "; {count} of them failed in an earlier run, and --retry-failed computes them again"
            ),
        };
        let n_points = rows.len();
        bail!(
            "{n_failed} of {n_points} points could not be computed; the column `failure` says why{before}"
        );
    }
    Ok(())
}

/// The output file of a sweep, and what is written beside it.
struct Output<'a> {
    path: &'a Path,
    options: &'a Sweep,
    measured: Option<&'a Measured>,
}

/// The points of a plan as rows without results.
fn rows_without_results(plan: &Plan) -> RowTable {
    let row = |point| SweepRow {
        point,
        fields: plan.identity(point),
    };
    RowTable {
        header: header(plan),
        rows: (0..plan.n_points()).map(row).collect(),
    }
}

/// Prints the distribution of the answers to samples of the uncertain quantities on the standard error.
fn eprint_samples(header: &[String], rows: &[SweepRow]) {
    let table = RowTable {
        header: header.to_vec(),
        rows: rows.to_vec(),
    };
    if let Some(samples) = Samples::of(&table) {
        eprint_line(&samples.table().to_string());
    }
}

/// Reports each warning once; the column `warnings` has all of them.
fn eprint_warnings(rows: &[SweepRow]) {
    let warnings = each_once(rows.iter().map(SweepRow::warnings));
    for warning in &warnings {
        eprint_line(&format!("warning: {warning}"));
    }
    if !warnings.is_empty() {
        eprint_line(ABOUT_WARNINGS);
    }
}

impl Sweep {
    /// Treatment of an existing file by the options.
    const fn existing(&self) -> Existing {
        match (self.resume || self.retry_failed, self.overwrite) {
            (true, _) => Existing::GoOn,
            (_, true) => Existing::Replace,
            _ => Existing::Refuse,
        }
    }
}

/// The result of a sweep.
struct Computed {
    /// Rows in the order of the points.
    rows: Vec<SweepRow>,
    /// Number of failed rows kept from an earlier run.
    n_failed_before: usize,
}

/// Prints the rows in the order of the points, each as soon as all preceding ones are done.
fn compute_and_print(plan: &Plan, points: &[usize], threads: usize) -> Result<Computed> {
    print_text(&line(&header(plan))?)?;
    let mut finished = BTreeMap::new();
    let mut rows: Vec<SweepRow> = Vec::new();
    compute(plan, points, threads, |row| {
        finished.insert(row.point, row);
        while let Some(next) = points.get(rows.len())
            && let Some(row) = finished.remove(next)
        {
            print_text(&line(&row.fields)?)?;
            rows.push(row);
        }
        Ok(())
    })?;
    Ok(Computed {
        rows,
        n_failed_before: 0,
    })
}

/// Computes the points that are missing from the output file, sorts the file, and draws all of its rows.
fn compute_into_file(
    plan: &Plan,
    mut points: Vec<usize>,
    threads: usize,
    Output {
        path: out,
        options,
        measured,
    }: Output<'_>,
) -> Result<Computed> {
    let existing = options.existing();
    let path = checked(out, existing)?;
    let open = || SweepFile::open(path.clone(), plan, existing);
    let (mut file, pictures) = match existing {
        // If the file exists, open it first, so that rows of another sweep are reported before their picture.
        Existing::GoOn if path.exists() => {
            let fingerprint = &plan.fingerprint;
            (open()?, PictureFiles::resumed(out, measured, fingerprint)?)
        }
        _ => {
            let pictures = PictureFiles::new(out, measured, existing == Existing::Replace)?;
            (open()?, pictures)
        }
    };
    // Mark rows and pictures as those of this sweep, so that an interrupted run can go on.
    pictures.remove_parts();
    if existing == Existing::Replace {
        pictures.claim(&plan.fingerprint)?;
    }
    file.begin(plan)?;
    // Compute the points whose rows are missing, then sort all rows and draw them.
    let stays = |(_, has_answer): &(usize, bool)| *has_answer || !options.retry_failed;
    let there: BTreeMap<usize, bool> = file.points().filter(stays).collect();
    points.retain(|point| !there.contains_key(point));
    compute(plan, &points, threads, |row| file.append(&row))?;
    let table = file.finish()?;
    pictures.draw(&table, measured, Some(plan.scene_text()))?;
    let n_rows = table.rows.len();
    let (n_computed, path) = (points.len(), path.display());
    eprint_line(&if n_computed == 0 && n_rows > 0 {
        format!("no point was computed: {path} has all {n_rows} already")
    } else {
        format!("{n_computed} points computed, {n_rows} in {path}")
    });
    Ok(Computed {
        rows: table.rows,
        n_failed_before: there.values().filter(|has_answer| !**has_answer).count(),
    })
}

/// Computes points on several threads; `take` receives each row as soon as it is done.
fn compute(
    plan: &Plan,
    points: &[usize],
    threads: usize,
    mut take: impl FnMut(SweepRow) -> Result<()>,
) -> Result<()> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()?;
    let bar = progress::bar("sweep", points.len());
    let (finished, rows) = mpsc::channel();
    // Stop computing when the receiver of the rows is gone, because nothing would keep them.
    let send = move |row| match finished.send(row) {
        Ok(()) => ControlFlow::Continue(()),
        Err(_) => ControlFlow::Break(()),
    };
    let taken = std::thread::scope(|scope| {
        scope.spawn(|| pool.install(|| plan.solve_all(points, send)));
        rows.into_iter().try_for_each(|row| {
            take(row?)?;
            bar.inc(1);
            Ok(())
        })
    });
    bar.finish_and_clear();
    taken
}

/// Invalid input at a line of a file.
fn wrong_row(path: &Path, line: usize, problem: &str) -> WrongInput {
    WrongInput(format!("{}:{line}: {problem}", path.display()))
}
