//! Many items of one task, with a bar on a terminal; silent elsewhere.

use std::borrow::Cow;
use std::time::Duration;

use anyhow::Result;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;

/// Runs a task for every item on all threads; results are in the order of the items.
pub(crate) fn in_parallel<T: Sync, R: Send>(
    task: impl Into<Cow<'static, str>>,
    items: &[T],
    run: impl Fn(&T) -> Result<R> + Sync + Send,
) -> Result<Vec<R>> {
    let bar = bar(task, items.len());
    let results = items.par_iter().with_max_len(1).map(run);
    let results = results.inspect(|_| bar.inc(1)).collect();
    bar.finish_and_clear();
    results
}

/// Runs a task for one item after the other, so that each can be timed.
pub(crate) fn in_turn<T, R>(
    task: impl Into<Cow<'static, str>>,
    items: &[T],
    run: impl FnMut(&T) -> Result<R>,
) -> Result<Vec<R>> {
    let bar = bar(task, items.len());
    let results = items.iter().map(run).inspect(|_| bar.inc(1)).collect();
    bar.finish_and_clear();
    results
}

/// A bar over so many steps.
fn bar(task: impl Into<Cow<'static, str>>, steps: usize) -> ProgressBar {
    let bar = ProgressBar::new(steps as u64).with_message(task);
    let template = "{msg:24} {bar:32} {pos}/{len}  {elapsed}, {eta} left";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
