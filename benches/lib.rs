//! What the timings have in common: contacts, and the error of a result, without which its time says little.

#![expect(clippy::print_stdout, reason = "the errors stand beside the times")]

mod contact_scene;

use std::error::Error;
use std::fs;
use std::process::Command;

pub use contact_scene::{ContactScene, rough_heights};

/// Why there is no timing.
pub type Failure = Box<dyn Error + Send + Sync>;

/// Every size in a process of its own, whose memory is not that of the size before.
///
/// # Errors
/// [`Failure`] where one of them gives no result.
pub fn report_each(arguments: &[&str], sizes: &[&str]) -> Result<(), Failure> {
    for size in sizes {
        let mut process = Command::new(std::env::current_exe()?);
        if !process.args(arguments).arg(size).status()?.success() {
            return Err(format!("no result for {size}").into());
        }
    }
    Ok(())
}

/// The result of the work, and by how much the memory at its peak is above that before, \[bytes].
///
/// # Errors
/// Those of the work, and a [`Failure`] where the system does not say how much memory the process has.
pub fn with_memory<T>(work: impl FnOnce() -> Result<T, Failure>) -> Result<(T, f64), Failure> {
    let known = |line: &str| memory(line).ok_or(format!("the system does not tell {line}"));
    // Forgets the peak of what was before.
    fs::write("/proc/self/clear_refs", "5")?;
    let before = known("VmRSS:")?;
    let result = work()?;
    Ok((result, known("VmHWM:")? - before))
}

/// A line of the memory that this process has, such as `"VmHWM:"`, \[bytes]; known on Linux only.
pub fn memory(line: &str) -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let found = status.lines().find_map(|text| text.strip_prefix(line))?;
    let kibibytes: f64 = found.split_whitespace().next()?.parse().ok()?;
    Some(1024.0 * kibibytes)
}

/// Prints how far the result of the benchmark `name` is from the exact one.
pub fn report_error(name: &str, quantity: &str, [actual, exact]: [f64; 2]) {
    let error = (actual / exact - 1.0).abs();
    println!("{name}: relative error of the {quantity} {error:.1e}");
}
