//! Progress on a terminal; silent elsewhere.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// A bar over `steps` steps of a task, with the time that is left.
pub(crate) fn bar(task: &'static str, steps: usize) -> ProgressBar {
    let bar = ProgressBar::new(steps as u64).with_message(task);
    styled(bar, "{msg} {bar:32} {pos}/{len}  {elapsed}, {eta} left")
}

/// Does one task without steps, with a sign of life.
pub(crate) fn during<T>(task: String, work: impl FnOnce() -> T) -> T {
    let spinner = ProgressBar::new_spinner().with_message(task);
    let spinner = styled(spinner, "{spinner} {msg}  {elapsed}");
    let value = work();
    spinner.finish_and_clear();
    value
}

fn styled(bar: ProgressBar, template: &str) -> ProgressBar {
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
