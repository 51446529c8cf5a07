//! Progress on a terminal; silent elsewhere.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar over `steps` steps of a task.
pub(crate) fn bar(task: &'static str, steps: usize) -> ProgressBar {
    let bar = ProgressBar::new(steps as u64).with_message(task);
    if let Ok(style) = ProgressStyle::with_template("{msg:24} {bar:32} {pos}/{len}  {elapsed}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(std::time::Duration::from_millis(200));
    bar
}
