//! Progress bars on a terminal; silent elsewhere.

use std::fmt;
use std::time::Duration;

use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use viscofriction::Progress;

/// A bar over `steps` steps of a task, with the remaining time.
pub(crate) fn bar(task: &'static str, steps: usize) -> ProgressBar {
    let bar = ProgressBar::new(steps as u64).with_message(task);
    styled(bar, "{msg} {bar:32} {pos}/{len}  {elapsed}{left}")
}

/// Runs a task with a spinner, and with the remaining time if the task reports progress.
pub(crate) fn during<T>(task: String, work: impl FnOnce(&dyn Progress) -> T) -> T {
    let bar = ProgressBar::new(FRACTION_STEPS).with_message(task);
    let bar = TerminalProgress(styled(bar, "{spinner} {msg}  {elapsed}{left}"));
    let value = work(&bar);
    bar.0.finish_and_clear();
    value
}

/// Runs a task that reports a message and the completed fraction.
pub(crate) fn with_message<T>(work: impl FnOnce(&(dyn Fn(String, f64) + Sync)) -> T) -> T {
    let bar = ProgressBar::new(FRACTION_STEPS);
    let told = TerminalProgress(styled(bar, "{spinner} {msg}  {elapsed}{left}"));
    let value = work(&|message, part| {
        told.0.set_message(message);
        told.report(part);
    });
    told.0.finish_and_clear();
    value
}

/// Gives a bar its template, in which `{left}` is the remaining time, and redraws it every 200 ms.
fn styled(bar: ProgressBar, template: &str) -> ProgressBar {
    let left = |state: &ProgressState, text: &mut dyn fmt::Write| {
        let left = remaining(state.elapsed(), state.fraction().into());
        // An error of the terminal is ignored, because progress is no result.
        let _ = text.write_str(&left.unwrap_or_default());
    };
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.with_key("left", left));
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

/// Text with the completed fraction `part` and the remaining time if the pace stays; `None` before any progress.
fn remaining(elapsed: Duration, part: f64) -> Option<String> {
    let rest = elapsed.as_secs_f64() * (part.recip() - 1.0);
    let rest = HumanDuration(Duration::try_from_secs_f64(rest).ok()?);
    Some(format!(", {:.0} %, about {rest} left", 100.0 * part))
}

/// Number of steps of a progress bar for a task that reports fractions. Chosen; it is the resolution of the bar.
const FRACTION_STEPS: u64 = 10_000;

/// A bar that shows the progress of a solution.
#[derive(Debug)]
struct TerminalProgress(ProgressBar);

impl Progress for TerminalProgress {
    fn may_refine(&self, _: usize) -> bool {
        true
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a part is between 0 and 1"
    )]
    fn report(&self, part: f64) {
        self.0.set_position((part * FRACTION_STEPS as f64) as u64);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_that_is_left_is_that_of_the_rest_at_the_same_pace() {
        for (seconds, part, expected) in [
            (10, 0.0, None),
            (10, 0.25, Some(", 25 %, about 30 seconds left")),
            (90, 0.01, Some(", 1 %, about 2 hours left")),
            (10, 1.0, Some(", 100 %, about 0 seconds left")),
        ] {
            let text = remaining(Duration::from_secs(seconds), part);
            assert_eq!(text.as_deref(), expected, "{part} done in {seconds} s");
        }
    }
}
