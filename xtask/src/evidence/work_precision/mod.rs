//! `work-precision`: error against run time of every method on every benchmark scene.

mod asked;
mod contacts;
mod fit;
mod measured;
mod picture;
mod rough;
mod scenes;
mod series;
mod table;

use anyhow::Result;

use super::{Report, Table};
use crate::progress;
use fit::{Fit, fit};
use measured::{Row, Timing};
use scenes::{QUICK_SCENES, SCENES, Scene};
use series::{Plan, Refusal, Series};

/// How much is measured.
#[derive(Debug)]
struct Extent {
    scenes: &'static [Scene],
    /// Runs of each method, from the coarsest on.
    runs: usize,
    timing: Timing,
    /// Elements along the edges of the grids of the Hertz contact, and of the rough surface.
    edges: &'static [usize],
    rough_edge: usize,
}

const FULL: Extent = Extent {
    scenes: &SCENES,
    runs: usize::MAX,
    timing: Timing::Median,
    edges: &[128, 256, 512, 1024, 2048],
    rough_edge: 512,
};

const QUICK: Extent = Extent {
    scenes: &QUICK_SCENES,
    runs: 3,
    timing: Timing::Once,
    edges: &[32, 64, 128],
    rough_edge: 64,
};

/// All that was measured.
#[derive(Debug, Default)]
struct Measured {
    series: Vec<(Vec<Row>, Fit)>,
    refusals: Vec<Refusal>,
}

/// Measures on one thread; a quick run takes a few scenes at coarse resolutions only, each timed once.
pub(super) fn report(quick: bool) -> Result<Report> {
    let extent = if quick { QUICK } else { FULL };
    let plan = plan(&extent)?;
    // On one thread processor time is the time on an idle machine.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let Measured { series, refusals } = pool.install(|| carry_out(plan, extent.timing));
    let rows: Vec<&Row> = series.iter().flat_map(|(rows, _)| rows).collect();
    let fits: Vec<&Fit> = series.iter().map(|(_, fit)| fit).collect();
    let (sliding, at_rest): (Vec<&Row>, Vec<&Row>) = rows.iter().partition(|row| row.slides());
    let refused = refusals.iter().map(|refusal| {
        let Refusal {
            scene,
            what,
            reason,
        } = refusal;
        format!("\nrefused: {scene}, {what}: {reason}")
    });
    Ok(Report {
        name: "work_precision",
        tables: vec![
            Table::new("work_precision", &rows)?,
            Table::new("work_precision_orders", &fits)?,
        ],
        pictures: vec![
            ("work_precision_sliding", picture::figure(&sliding)),
            ("work_precision_at_rest", picture::figure(&at_rest)),
        ],
        summary: format!("{}{}", table::table(&series), refused.collect::<String>()),
        failure: None,
    })
}

/// All series, with their references.
fn plan(extent: &Extent) -> Result<Plan> {
    let bar = progress::bar("references", extent.scenes.len() + 1);
    let mut plan = Plan::default();
    for scene in extent.scenes {
        let Plan { series, refusals } = asked::plan(scene, extent.runs)?;
        plan.series.extend(series);
        plan.refusals.extend(refusals);
        bar.inc(1);
    }
    plan.series.push(contacts::hertz(extent.edges));
    plan.series.push(contacts::rough(extent.rough_edge)?);
    bar.finish_and_clear();
    Ok(plan)
}

fn carry_out(plan: Plan, timing: Timing) -> Measured {
    let runs = plan.series.iter().map(|series| series.attempts.len());
    let bar = progress::bar("work and precision", runs.sum());
    let mut measured = Measured {
        refusals: plan.refusals,
        ..Measured::default()
    };
    for series in plan.series {
        add(&mut measured, &series, timing, &|| bar.inc(1));
    }
    bar.finish_and_clear();
    measured
}

fn add(measured: &mut Measured, series: &Series, timing: Timing, advance: &dyn Fn()) {
    let (rows, refusals) = measured::rows(series, timing, advance);
    measured.refusals.extend(refusals);
    if let Some(fit) = fit(&rows) {
        measured.series.push((rows, fit));
    }
}
