//! Work away from the interpreter, which stays free for other threads, shows progress, and can be interrupted.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::prelude::*;

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
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = threads.map(pool).transpose().map_err(failed)?;
    let compute = move || {
        let every = || (0..count).into_par_iter().map(counted).collect();
        let results = match pool {
            Some(pool) => pool.install(every),
            None => every(),
        };
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
