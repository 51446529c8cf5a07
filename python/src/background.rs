//! Work away from the interpreter, which stays free for other threads, shows progress, and can be interrupted.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use std::{mem, process, thread};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// Ctrl-C and the progress are looked after so often.
const LOOK: Duration = Duration::from_millis(50);

/// The results of `work` for 0 to `count` − 1, on `threads` threads of their own or on those of the process, in order.
///
/// After an interruption no new work begins; what is under way ends unseen. What `progress`, called with how many are done
/// and how many there are, or a handler of signals raises is passed on.
pub(crate) fn all<T: Send + 'static>(
    py: Python<'_>,
    count: usize,
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl Fn(usize) -> T + Send + Sync + 'static,
) -> PyResult<Vec<T>> {
    let (sender, mut receiver) = channel();
    let interrupted = Arc::new(AtomicBool::new(false));
    let done = Arc::new(AtomicUsize::new(0));
    let counted = {
        let (interrupted, done) = (interrupted.clone(), done.clone());
        move |index: usize| {
            let result = (!interrupted.load(Ordering::Relaxed)).then(|| work(index));
            done.fetch_add(1, Ordering::Relaxed);
            result
        }
    };
    let pool = match threads {
        Some(threads) => Arc::new(pool_of(threads)?),
        None => pool_of_process(py)?,
    };
    let compute = move || {
        let results = pool.install(|| (0..count).into_par_iter().map(counted).collect());
        // Nobody waits for it after an interruption.
        drop(sender.send(results));
    };
    thread::Builder::new().spawn(compute).map_err(failed)?;
    let mut shown = None;
    loop {
        let (results, back) = py.detach(move || (receiver.recv_timeout(LOOK), receiver));
        receiver = back;
        let looked = look(
            py,
            progress,
            &mut shown,
            [done.load(Ordering::Relaxed), count],
        );
        if looked.is_err() {
            interrupted.store(true, Ordering::Relaxed);
        }
        looked?;
        match results {
            Ok(results) => {
                let results: Option<Vec<T>> = results;
                return results.ok_or_else(|| failed("the work was interrupted"));
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Err(failed("the work has panicked")),
        }
    }
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

/// Shows the progress where it has changed, and handles signals.
fn look(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    shown: &mut Option<usize>,
    [done, count]: [usize; 2],
) -> PyResult<()> {
    py.check_signals()?;
    if let Some(progress) = progress
        && *shown != Some(done)
    {
        *shown = Some(done);
        progress.call1((done, count))?;
    }
    Ok(())
}

fn failed(why: impl std::fmt::Display) -> PyErr {
    PyRuntimeError::new_err(why.to_string())
}
