//! Do the standard errors of means over random surfaces hold? Two means over other surfaces of one spectrum are compared.

use anyhow::Result;
use numerics::MaxElements;
use serde::Serialize;
use viscofriction::Quantity;
use viscofriction::quantity::scattered;
use viscofriction::scene::{Indenter, Scene};
use viscofriction::solve::{Answer, Problem, SolveError, plan};

use super::sample::{NumberedScene, Options, Source};
use super::{Outcomes, Report, Share};
use crate::table::markdown_table;
use crate::tasks::in_turn;

/// Number of random spectra of a full run and of a quick one. Chosen: with 200 the fraction within two standard errors has itself
/// a standard deviation of 1.5 %.
const SCENES: [usize; 2] = [200, 3];
/// Largest number of elements along the edge of a period. Chosen, so that the thousands of surfaces of a full run are
/// affordable: a surface that needs more is answered with a wider error bar.
const MAX_ELEMENTS: usize = 512;
/// Relative error requested for each surface. Chosen of the order of the standard errors, so that few surfaces need fine grids.
const RELATIVE_ERROR: f64 = 0.05;
/// Relative standard errors requested of the judged mean and of the mean with which it is compared. Chosen: the second is
/// smaller, so that the standard error of the difference is mainly that of the judged mean.
const STANDARD_ERRORS: [f64; 2] = [0.05, 0.02];
/// First seeds of the two means in scene 0. Chosen so far apart that no scene takes the same surface for both.
const FIRST_SEEDS: [u64; 2] = [1, 1_000_000];
/// Number of seeds reserved for each mean of one scene. Chosen: more than the surfaces that a mean may take.
const SEEDS_PER_SCENE: u64 = 2000;
/// Largest deviation with which a mean holds, in standard errors of the difference. Chosen: 95 % of a normal distribution
/// are within it.
const COVERAGE_FACTOR: f64 = 2.0;
/// Smallest fraction of the means that must hold. Chosen: of a normal distribution 95 % are within two standard errors; fewer,
/// because the standard errors are themselves estimates from few surfaces.
const MIN_COVERAGE: f64 = 0.92;
/// Number of binomial standard deviations by which the observed fraction may fall short of [`MIN_COVERAGE`] before the
/// command fails. Chosen: if exactly [`MIN_COVERAGE`] hold, one of 700 runs falls short of it by more.
const ALLOWED_SCATTER: f64 = 3.0;

/// Two means of one quantity over surfaces of one spectrum. A column without `compared` is of the judged mean.
#[derive(Debug, Serialize)]
struct Row {
    scene: usize,
    quantity: &'static str,
    /// Surfaces of the judged mean; below, those of them that were solved only on a coarse grid.
    surfaces: usize,
    on_coarse_grid: usize,
    /// Surfaces of the mean with which it is compared; below, those of them that were solved only on a coarse grid.
    compared_surfaces: usize,
    compared_on_coarse_grid: usize,
    /// The judged mean, in the unit of the quantity, and its standard error.
    value: f64,
    standard_error: f64,
    /// The judged mean minus the other one.
    deviation: f64,
    /// Ratio of `deviation` to the standard error of the difference of the means.
    relative_deviation: f64,
}

/// A spectrum for which one of the means has no answer.
#[derive(Debug, Serialize)]
struct Refusal {
    /// Number of the scene.
    scene: usize,
    /// Message of the error.
    why: String,
}

/// Compares means over random surfaces of random scenes; fails where their standard errors hold too seldom.
pub(super) fn report(options: &Options, quick: bool) -> Result<Report> {
    let count = options.count(SCENES[usize::from(quick)])?;
    let scenes = Source::new("ensembles")?.scenes(options.seed(), count)?;
    let found = in_turn("ensembles", &scenes, |NumberedScene { number, scene }| {
        let refusal = |why: anyhow::Error| Refusal {
            scene: *number,
            why: why.to_string(),
        };
        Ok(compared(*number, scene).map_err(refusal))
    })?;
    let found: Outcomes<Row, Refusal> = found.into_iter().collect();
    let failures = scattered().filter_map(|quantity| failure(quantity.key, &found.rows));
    let failures: Vec<String> = failures.collect();
    let table = table(&found.rows);
    Ok(Report {
        name: "ensembles",
        summary: format!("{table}\n\nnot solved: {}", found.refusals.len()),
        tables: found.tables(["ensembles", "ensembles_refused"])?,
        failure: (!failures.is_empty()).then(|| failures.join("\n")),
        ..Report::default()
    })
}

/// A row for each quantity of the answer that scatters between surfaces of a spectrum, such as friction and area. `scene` is
/// its number. A mean that does not reach the standard error requested of it states the one that it has, and is judged by it.
fn compared(scene: usize, given: &Scene) -> Result<Vec<Row>> {
    let mean = |at: usize| -> Result<Answer> {
        let mut seeded = given.clone();
        seeded.solve.relative_error = Some(RELATIVE_ERROR);
        seeded.solve.max_memory = None;
        if let Indenter::SelfAffine(surface) = &mut seeded.indenter {
            surface.seed = FIRST_SEEDS[at] + SEEDS_PER_SCENE * scene as u64;
            surface.standard_error = Some(STANDARD_ERRORS[at]);
        }
        let problem = Problem::try_from(&seeded)?;
        match plan(&problem)?.solve(&MaxElements(MAX_ELEMENTS)) {
            Err(SolveError::NotReached { answer, .. }) => Ok(*answer),
            found => Ok(found?),
        }
    };
    let [one, other] = [mean(0)?, mean(1)?];
    let counts = |answer: &Answer| {
        let ensemble = answer.ensemble.as_ref();
        ensemble.map_or([0; 2], |all| [all.realisations.len(), all.on_coarse_grid])
    };
    let [counted, compared] = [&one, &other].map(counts);
    let row = |quantity: &Quantity| {
        let of = |answer: &Answer| {
            let scatter = answer.ensemble.as_ref()?.scatter.of(quantity.key)?;
            Some(((quantity.of)(answer)?, scatter))
        };
        let [(value, error), (reference, reference_error)] = [of(&one)?, of(&other)?];
        let deviation = value.value - reference.value;
        let of_both = error.standard_error.hypot(reference_error.standard_error);
        // Judge by the error bars of the answers if all surfaces have the same answer, because then there is no standard error.
        let nothing = deviation.abs() <= value.error + reference.error && of_both == 0.0;
        Some(Row {
            scene,
            quantity: quantity.key,
            surfaces: counted[0],
            on_coarse_grid: counted[1],
            compared_surfaces: compared[0],
            compared_on_coarse_grid: compared[1],
            value: value.value,
            standard_error: error.standard_error,
            deviation,
            relative_deviation: if nothing { 0.0 } else { deviation / of_both },
        })
    };
    Ok(scattered().filter_map(row).collect())
}

/// Rows of the quantity with this name.
fn of<'a>(quantity: &str, rows: &'a [Row]) -> Vec<&'a Row> {
    rows.iter().filter(|row| row.quantity == quantity).collect()
}

/// How many rows deviate by no more than `errors` standard errors of the difference.
fn within(rows: &[&Row], errors: f64) -> Share {
    let within = |row: &&Row| row.relative_deviation.abs() <= errors;
    rows.iter().map(within).collect()
}

/// Why the command fails for a quantity: significantly fewer than [`MIN_COVERAGE`] of its means hold.
fn failure(quantity: &str, rows: &[Row]) -> Option<String> {
    let share = within(&of(quantity, rows), COVERAGE_FACTOR);
    let Share { held, all } = share;
    (!share.may_be(MIN_COVERAGE, ALLOWED_SCATTER)).then(|| {
        format!(
            "ensembles: {held} of {all} of {quantity} are within {COVERAGE_FACTOR} standard errors"
        )
    })
}

/// Two lines for each quantity, of all spectra and of those with surfaces on a coarse grid: how many means are within one,
/// two and three standard errors.
fn table(rows: &[Row]) -> comfy_table::Table {
    let lines = scattered().flat_map(|quantity| {
        let key = quantity.key;
        let all = of(key, rows);
        let coarse = all.iter().copied().filter(|row| row.on_coarse_grid > 0);
        let coarse: Vec<&Row> = coarse.collect();
        let line = |kind: &str, rows: &[&Row]| {
            let part = |errors| within(rows, errors).percentage();
            let [one, two, three] = [1.0, COVERAGE_FACTOR, 3.0].map(part);
            let kind = format!("{}{kind}", key.replace('_', " "));
            [kind, rows.len().to_string(), one, two, three]
        };
        [line("", &all), line(", with a coarse grid", &coarse)]
    });
    let header = "quantity|spectra|within one standard error|two|three";
    markdown_table(header.split('|'), lines)
}
