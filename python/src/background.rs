//! Computation in background threads: the interpreter stays free, reports progress, and can be interrupted.

use std::ops::ControlFlow;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use std::{mem, process, thread};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use viscofriction::solve::share_memory;

/// Interval between checks for signals and finished results (chosen: below the reaction time of a person).
const LOOK: Duration = Duration::from_millis(50);

/// The results of `work` for 0 to `count` − 1 in order, computed on a pool of `threads` threads, or on that of the process.
///
/// Concurrent computations share the memory as in [`share_memory`].
///
/// `progress` is called with the number of results and `count`. Its exceptions, and those of signal handlers, are passed on.
pub(crate) fn all<T: Send + 'static>(
    py: Python<'_>,
    count: usize,
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl Fn(usize, u64) -> Option<T> + Send + Sync + 'static,
) -> PyResult<Vec<T>> {
    let mut results = Vec::with_capacity(count);
    each(py, count, threads, work, |finished| {
        let is_news = !finished.is_empty();
        results.extend(finished);
        match progress {
            Some(progress) if is_news => progress.call1((results.len(), count)).map(drop),
            _ => Ok(()),
        }
    })?;
    results.sort_unstable_by_key(|(index, _)| *index);
    Ok(results.into_iter().map(|(_, result)| result).collect())
}

/// Passes the results of `work` for 0 to `count` − 1 with their indices to `take`, soon after they are ready and in any order.
///
/// `take` is called at least every 50 ms, without results if none is ready, and stops the work by an exception. After that, or an
/// interruption, no new work starts; running work is discarded.
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
        // Stop starting work when the receiver is gone.
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
        // Check signals first, but pass on the results before raising.
        let looked = py.check_signals();
        taken += finished.len();
        take(finished)?;
        looked?;
        if has_ended {
            return Err(failed("the work has panicked"));
        }
    }
    Ok(())
}

/// The thread pool with the id of its process.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The pool of this process. A forked process does not inherit the threads of its parent and creates a pool of its own.
///
/// The interpreter lock, held here and during a fork, excludes a race between both.
fn pool_of_process(_: Python<'_>) -> PyResult<Arc<ThreadPool>> {
    let mut known = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((process, pool)) = &*known
        && *process == process::id()
    {
        return Ok(pool.clone());
    }
    let pool = Arc::new(pool_of(0)?);
    // Dropping the pool of the parent would wait for threads that do not exist here.
    mem::forget(known.replace((process::id(), pool.clone())));
    Ok(pool)
}

/// Thread pool of `threads` threads; 0 stands for one per core.
fn pool_of(threads: usize) -> PyResult<ThreadPool> {
    let builder = ThreadPoolBuilder::new().num_threads(threads);
    builder.build().map_err(failed)
}

/// Exception `RuntimeError` with a message.
fn failed(why: impl std::fmt::Display) -> PyErr {
    PyRuntimeError::new_err(why.to_string())
}
