//! What the scene did not need, why, and what leaving it out saves: the work is done once with it and once without, and the
//! answers are compared.

use anyhow::{Context, Result, bail};
use comfy_table::Table;
use cpu_time::ProcessTime;
use viscofriction::Estimate;
use viscofriction::scene::{Accuracy, Method};
use viscofriction::solve::{Answer, Omission, Problem, solve_again, solve_by};

use super::{Timed, files};
use crate::output::{OutputFolder, markdown};

/// Relative change of the answer up to which a discrete problem counts as the same.
const SAME: f64 = 1e-10;
/// An answer that took longer is not computed again, up to twice for each omission, and more tightly \[s].
const LONGEST: f64 = 10.0;
/// Elements along the contact of the marches in time that a stationary answer is compared with.
const CHAIN: usize = 64;
const GRID: usize = 12;
/// Work is repeated until it has taken so much processor time \[s].
const CLOCKED: f64 = 0.1;

const HEADER: &str = "left out | because | time | with it | memory | with it | answer changes by";

/// Work on one thread.
#[derive(Debug, Clone, Copy, Default)]
struct Cost {
    /// Processor time, \[s].
    seconds: f64,
    /// Largest size of all that is allocated at the same time.
    bytes: u64,
}

/// What one omission saves.
#[derive(Debug)]
struct Saving {
    left_out: Cost,
    done: Cost,
    /// Relative change of the answer of the same discrete problem; 0 of another one.
    rounding: f64,
    /// How the answer changes when the work is not left out, in words.
    change: String,
}

/// One row per part that was left out, with the work measured without it and with it, or why that was not possible.
///
/// # Errors
/// When a discrete problem does not stay the same.
pub(super) fn table(problem: &Problem, answer: &Timed<'_>) -> Result<Table> {
    let mut table = markdown(HEADER);
    for &omission in &answer.answer.left_out {
        let name = omission.name();
        let cells = match saving(problem, answer, omission) {
            Ok(Saving { rounding, .. }) if rounding.is_nan() || rounding > SAME => {
                bail!(
                    "the answer changes by {rounding:e} when {name} is not left out, and may by {SAME:e}"
                )
            }
            Ok(saving) => {
                let [left_out, done] = [saving.left_out, saving.done];
                let time = |cost: Cost| format!("{:.2e} s", cost.seconds);
                let memory = |cost: Cost| format!("{:.2e} B", cost.bytes as f64);
                let [before, after] = [left_out, done].map(time);
                [before, after, memory(left_out), memory(done), saving.change]
            }
            Err(error) => ["", "", "", "", &format!("not measured: {error:#}")].map(str::to_owned),
        };
        let names = [name, omission.because().to_owned()];
        table.add_row(names.into_iter().chain(cells));
    }
    Ok(table)
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
        None => on_same_problem(problem, answer, omission),
    }
}

fn of_files(answer: &Timed<'_>) -> Result<Saving> {
    let folder = tempfile::tempdir()?;
    let out = OutputFolder::new(folder.path(), true, files::NAMES)?;
    let ((), done) = metered(|| files::write(answer, &out))?;
    Ok(Saving {
        left_out: Cost::default(),
        done,
        rounding: 0.0,
        change: "nothing".to_owned(),
    })
}

fn on_same_problem(problem: &Problem, answer: &Answer, omission: Omission) -> Result<Saving> {
    let (numbers, left_out) = metered(|| Ok(solve_again(problem, answer, None)?))?;
    let (others, done) = metered(|| Ok(solve_again(problem, answer, Some(omission))?))?;
    let changes = numbers.iter().zip(&others);
    let changes = changes.map(|([number, scale], [other, _])| ((other - number) / scale).abs());
    // NaN counts as the largest.
    let rounding = changes.max_by(f64::total_cmp);
    let rounding = rounding.context("nothing to compare")?;
    Ok(Saving {
        left_out,
        done,
        rounding,
        change: format!("{rounding:.1e}"),
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
    let change = ((other.value - value) / value).abs();
    let [own, others] = [error, other.error].map(|error| error / value.abs());
    let name = method.name();
    Ok(Saving {
        left_out,
        done,
        rounding: 0.0,
        change: format!("{change:.1e}; error bars {own:.1e} and, {name}, {others:.1e}"),
    })
}

/// Does the work on one thread, where the memory of all of it is counted, and again until the clock can tell its time.
fn metered<T: Send>(work: impl Fn() -> Result<T> + Sync) -> Result<(T, Cost)> {
    let counted = || {
        let mut value = None;
        let memory = allocation_counter::measure(|| value = Some(work()));
        anyhow::Ok((value.context("the work was not done")??, memory.bytes_max))
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    pool.install(|| {
        let start = ProcessTime::now();
        let (value, bytes) = counted()?;
        let mut n_runs = 1.0;
        while start.elapsed().as_secs_f64() < CLOCKED {
            counted()?;
            n_runs += 1.0;
        }
        let seconds = start.elapsed().as_secs_f64() / n_runs;
        Ok((value, Cost { seconds, bytes }))
    })
}
