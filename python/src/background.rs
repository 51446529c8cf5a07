//! Work away from the interpreter, which stays free for other threads, shows progress, and can be interrupted.

use std::ops::ControlFlow;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use std::{mem, process, thread};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use viscofriction::solve::share_memory;

/// Ctrl-C and the progress are looked after so often.
const LOOK: Duration = Duration::from_millis(50);

/// The results of `work` for 0 to `count` − 1, on `threads` threads of their own or on those of the process, in order.
///
/// Those that are computed at the same time share the memory, as [`share_memory`] says.
///
/// What `progress`, called with how many are done and how many there are, or a handler of signals raises is passed on.
pub(crate) fn all<T: Send + 'static>(
    py: Python<'_>,
    count: usize,
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl Fn(usize, u64) -> Option<T> + Send + Sync + 'static,
) -> PyResult<Vec<T>> {
    let mut results = Vec::with_capacity(count);
    each(py, count, threads, work, |finished| {
        results.extend(finished);
        if let Some(progress) = progress {
            progress.call1((results.len(), count))?;
        }
        Ok(())
    })?;
    results.sort_unstable_by_key(|(index, _)| *index);
    Ok(results.into_iter().map(|(_, result)| result).collect())
}

/// Hands over the results of `work` for 0 to `count` − 1 with their numbers, soon after they are there and in any order.
///
/// After an interruption what is finished is handed over, and no new work begins; what is under way ends unseen.
pub(crate) fn each<T: Send + 'static>(
    py: Python<'_>,
    count: usize,
    threads: Option<usize>,
    work: impl Fn(usize, u64) -> Option<T> + Send + Sync + 'static,
    mut take: impl FnMut(Vec<(usize, T)>) -> PyResult<()>,
) -> PyResult<()> {
    let pool = match threads {
        Some(threads) => Arc::new(pool_of(threads)?),
        None => pool_of_process(py)?,
    };
    let (sender, mut receiver) = channel();
    let compute = move || {
        // Where nobody takes them any more, none begins.
        let send = |index, result| match sender.send((index, result)) {
            Ok(()) => ControlFlow::Continue(()),
            Err(_) => ControlFlow::Break(()),
        };
        pool.install(|| share_memory((0..count).collect(), &work, send));
    };
    thread::Builder::new().spawn(compute).map_err(failed)?;
    let mut taken = 0;
    while taken < count {
        let (finished, has_ended, back) = py.detach(move || {
            let first = receiver.recv_timeout(LOOK);
            let has_ended = matches!(first, Err(RecvTimeoutError::Disconnected));
            let finished: Vec<(usize, T)> = first.into_iter().chain(receiver.try_iter()).collect();
            (finished, has_ended, receiver)
        });
        receiver = back;
        // An interruption that came meanwhile does not reach what takes the results.
        let looked = py.check_signals();
        taken += finished.len();
        if !finished.is_empty() {
            take(finished)?;
        }
        looked?;
        if has_ended {
            return Err(failed("the work has panicked"));
        }
    }
    Ok(())
}

/// A process and its threads.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The threads of this process: a fork has none of those of its parent, and makes its own.
///
/// The interpreter, which is held here and while a process forks, keeps the two apart.
fn pool_of_process(_: Python<'_>) -> PyResult<Arc<ThreadPool>> {
    let mut known = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((process, pool)) = &*known
        && *process == process::id()
    {
        return Ok(pool.clone());
    }
    let pool = Arc::new(pool_of(0)?);
    // To end threads that are not there would wait for them.
    mem::forget(known.replace((process::id(), pool.clone())));
    Ok(pool)
}

/// So many threads, or with 0 as many as there are cores.
fn pool_of(threads: usize) -> PyResult<ThreadPool> {
    let builder = ThreadPoolBuilder::new().num_threads(threads);
    builder.build().map_err(failed)
}

fn failed(why: impl std::fmt::Display) -> PyErr {
    PyRuntimeError::new_err(why.to_string())
}
