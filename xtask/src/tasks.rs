//! Runs one task for many items, with a progress bar if standard error is a terminal.

use std::borrow::Cow;
use std::time::Duration;

use anyhow::Result;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;

/// Results of `run` for every item, computed on all threads, in the order of the items; or the error of one that failed.
/// `task` is the label of the progress bar.
pub(crate) fn in_parallel<T: Sync, R: Send>(
    task: impl Into<Cow<'static, str>>,
    items: &[T],
    run: impl Fn(&T) -> Result<R> + Sync + Send,
) -> Result<Vec<R>> {
    let bar = bar(task, items.len());
    let results = items
        .par_iter()
        .with_max_len(1)
        .map(run)
        .inspect(|_| bar.inc(1))
        .collect();
    bar.finish_and_clear();
    results
}

/// Runs one item after the other, unlike [`in_parallel`], so that each can be timed; stops at the first error.
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

/// A progress bar of `steps` steps with the text `task`, redrawn five times a second.
fn bar(task: impl Into<Cow<'static, str>>, steps: usize) -> ProgressBar {
    let bar = ProgressBar::new(steps as u64).with_message(task);
    let template = "{msg:24} {bar:32} {pos}/{len}  {elapsed}, {eta} left";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
