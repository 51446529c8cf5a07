//! What each omission saves: the work is done once with it and once without, and the answers are compared.

use anyhow::{Context, Result, bail};
use viscofriction::Estimate;
use viscofriction::scene::{Accuracy, Method};
use viscofriction::solve::{Answer, Omission, Problem, SameProblem, solve_by};

use super::{Timed, files};
use crate::meter;
use crate::output::OutputFolder;

/// Relative change of the answer up to which a discrete problem counts as the same.
const SAME: f64 = 1e-10;
/// An answer that took longer is not computed again, up to twice for each omission, and more tightly \[s].
const LONGEST: f64 = 10.0;
/// Elements along the contact of the marches in time that a stationary answer is compared with.
const CHAIN: usize = 64;
const GRID: usize = 12;

/// Work on one thread.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Cost {
    /// Processor time, \[s].
    pub(super) seconds: f64,
    /// Largest size of all that is allocated at the same time.
    pub(super) bytes: u64,
}

/// How the answer changes when the work is not left out, relative to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Change {
    /// Of the same discrete problem.
    Rounding(f64),
    /// Of another method, and the error bars of the answer and of the other one.
    OfMethod {
        method: Method,
        change: f64,
        bars: [f64; 2],
    },
    /// The answer was not computed again.
    None,
}

/// What one omission saves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Saving {
    pub(super) left_out: Cost,
    pub(super) done: Cost,
    pub(super) change: Change,
}

/// One saving for each omission, or why it could not be measured.
///
/// # Errors
/// When a discrete problem does not stay the same.
pub(super) fn savings(
    problem: &Problem,
    answer: &Timed<'_>,
) -> Result<Vec<(Omission, Result<Saving>)>> {
    let mut savings = Vec::new();
    for &omission in &answer.answer.left_out {
        let saving = saving(problem, answer, omission);
        if let Ok(Saving {
            change: Change::Rounding(change),
            ..
        }) = saving
            && (change.is_nan() || change > SAME)
        {
            bail!(
                "the answer changes by {change:e} when {} is not left out, and may by {SAME:e}",
                omission.name()
            );
        }
        savings.push((omission, saving));
    }
    Ok(savings)
}

fn saving(problem: &Problem, answer: &Timed<'_>, omission: Omission) -> Result<Saving> {
    if omission == Omission::Files {
        return of_files(answer);
    }
    if answer.seconds > LONGEST {
        bail!("the answer took longer than {LONGEST} s");
    }
    let answer = answer.answer;
    match omission.done_by(answer.model, problem.motion) {
        Some(method) => by_method(problem, answer, method),
        None => on_same_problem(&SameProblem::of(problem, answer)?, omission),
    }
}

fn of_files(answer: &Timed<'_>) -> Result<Saving> {
    let folder = tempfile::tempdir()?;
    let out = OutputFolder::new(folder.path(), true, &files::NAMES)?;
    let ((), done) = metered(|| files::write(answer, &out))?;
    Ok(Saving {
        left_out: Cost::default(),
        done,
        change: Change::None,
    })
}

fn on_same_problem(problem: &SameProblem, omission: Omission) -> Result<Saving> {
    let (numbers, left_out) = metered(|| Ok(problem.solve(None)?))?;
    let (others, done) = metered(|| Ok(problem.solve(Some(omission))?))?;
    let changes = numbers.iter().zip(&others);
    let changes = changes.map(|([number, scale], [other, _])| ((other - number) / scale).abs());
    // NaN counts as the largest.
    let change = changes
        .max_by(f64::total_cmp)
        .context("nothing to compare")?;
    Ok(Saving {
        left_out,
        done,
        change: Change::Rounding(change),
    })
}

fn by_method(problem: &Problem, answer: &Answer, method: Method) -> Result<Saving> {
    let accuracy = match method {
        Method::MdrTransient => Accuracy::Elements(CHAIN),
        Method::BemTransient => Accuracy::Elements(GRID),
        _ => problem.accuracy,
    };
    let (again, left_out) = metered(|| Ok(solve_by(problem, answer.method, problem.accuracy)?))?;
    let (other, done) = metered(|| Ok(solve_by(problem, method, accuracy)?))?;
    let Estimate { value, error } = again.asked();
    let other = other.asked();
    if value.abs() <= error {
        bail!("the answer, {value:e} with an error of {error:.1e}, cannot be told from 0");
    }
    Ok(Saving {
        left_out,
        done,
        change: Change::OfMethod {
            method,
            change: ((other.value - value) / value).abs(),
            bars: [error, other.error].map(|error| error / value.abs()),
        },
    })
}

/// Does the work on one thread, where the memory of all of it is counted.
fn metered<T: Send>(work: impl Fn() -> Result<T> + Sync) -> Result<(T, Cost)> {
    let counted = || {
        let mut value = None;
        let memory = allocation_counter::measure(|| value = Some(work()));
        let value = value.context("the work was not done")??;
        anyhow::Ok((value, memory.bytes_max))
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let ((value, bytes), seconds) = pool.install(|| meter::measure_median(counted))?;
    Ok((value, Cost { seconds, bytes }))
}
