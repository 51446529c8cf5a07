//! `evidence`: how stable, how accurate and how expensive the methods are, measured anew.
//!
//! Every experiment turns cases into tables, pictures and a summary.

mod agreement;
mod calibration;
mod derivatives;
mod ensembles;
mod fit;
mod friction_fit;
mod material;
mod report;
mod request;
mod rough;
mod sample;
mod share;
mod speed_range;
mod stability;
mod stationary;
mod tuning;
mod unit;
mod work_precision;

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Result, ensure};
use clap::{Args, Subcommand};
use strum::{EnumIter, IntoEnumIterator as _};

use crate::output::{make_folder, print_line};
use report::{Outcomes, Report, extent};
use share::Share;

/// Which experiment, how much of it, and where the results go.
#[derive(Debug, Args)]
pub(crate) struct Evidence {
    /// One experiment; without it all of them.
    #[command(subcommand)]
    experiment: Option<Experiment>,
    /// Where tables (CSV), pictures (SVG and PNG) and a page for each experiment (Markdown) are written.
    #[arg(
        long,
        global = true,
        value_name = "DIR",
        default_value = "target/evidence"
    )]
    out: PathBuf,
    /// A few cheap cases only; of `stability` all.
    #[arg(long, global = true)]
    quick: bool,
}

/// In this order, because the first one reports the largest memory that the process has had.
#[derive(Debug, Subcommand, EnumIter)]
enum Experiment {
    /// Measure the stationary solver: its error bars against finer solutions, its growth, its speed.
    Stationary(stationary::Options),
    /// Measure error against run time of every method on every benchmark scene.
    WorkPrecision,
    /// Judge every method on stiff and extreme cases; fails when one is wrong.
    Stability(stability::Options),
    /// Search random scenes for answers that contradict each other; goes on where it was interrupted.
    Agreement(sample::Options),
    /// Compare the error bars of every method with its deviations on random scenes.
    Calibration(sample::Options),
    /// Fit moduli to synthetic friction: do their intervals hold?
    FrictionFit,
    /// Compare derivatives of answers with differences on random scenes; fails when their bars hold too seldom.
    Derivatives(sample::Options),
    /// Compare means over random rough surfaces with means over others; fails when their standard errors hold too seldom.
    Ensembles(sample::Options),
    /// Compute friction over twelve decades of speed on the three-element solid, and where the viscous law holds.
    SpeedRange,
    /// Compare friction and area of random rough surfaces with theories; goes on where it was interrupted.
    Rough,
    /// Fit materials that are known to made-up measurements, and compare their friction with its material error.
    Material,
    /// Change constants of the solvers: in which range does nothing change? Goes on where it was interrupted.
    Tuning(tuning::Options),
}

/// Carries out the experiments asked for; a result that is wrong is written like any other before the command fails.
pub(crate) fn evidence(options: Evidence) -> Result<()> {
    let out = &*options.out;
    make_folder(out)?;
    let experiments = options.experiment.map(|one| vec![one]);
    let mut failures = Vec::new();
    for experiment in experiments.unwrap_or_else(|| Experiment::iter().collect()) {
        let start = Instant::now();
        let report = experiment.run(out, options.quick)?;
        report.write(out)?;
        print_line(&report.summary)?;
        let (page, seconds) = (report.page(out), start.elapsed().as_secs_f64());
        print_line(&format!("{} in {seconds:.1} s", page.display()))?;
        failures.extend(report.failure);
    }
    ensure!(failures.is_empty(), "{}", failures.join("\n"));
    Ok(())
}

impl Experiment {
    /// Carries out one experiment. `out` is where those that go on after an interruption keep their tables; nothing else is
    /// written.
    fn run(&self, out: &Path, quick: bool) -> Result<Report> {
        match self {
            Self::WorkPrecision => work_precision::report(quick),
            Self::Stability(options) => stability::report(options),
            Self::Agreement(options) => agreement::report(options, out, quick),
            Self::Calibration(options) => calibration::report(options, quick),
            Self::FrictionFit => friction_fit::report(quick),
            Self::Derivatives(options) => derivatives::report(options, quick),
            Self::Ensembles(options) => ensembles::report(options, quick),
            Self::SpeedRange => speed_range::report(quick),
            Self::Stationary(options) => stationary::report(options, quick),
            Self::Rough => rough::report(out, quick),
            Self::Material => material::report(quick),
            Self::Tuning(options) => tuning::report(options, out, quick),
        }
    }
}
