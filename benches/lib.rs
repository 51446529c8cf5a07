//! What the timings have in common: contacts, and the error of a result, without which its time says little.

#![expect(clippy::print_stdout, reason = "the errors stand beside the times")]

mod contact_scene;

pub use contact_scene::{ContactScene, rough_heights};

/// A line of the memory that this process has, such as `"VmHWM:"`, \[bytes]; known on Linux only.
pub fn memory(line: &str) -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let found = status.lines().find_map(|text| text.strip_prefix(line))?;
    let kibibytes: f64 = found.split_whitespace().next()?.parse().ok()?;
    Some(1024.0 * kibibytes)
}

/// Prints how far the result of the benchmark `name` is from the exact one.
pub fn report_error(name: &str, quantity: &str, [actual, exact]: [f64; 2]) {
    let error = (actual / exact - 1.0).abs();
    println!("{name}: relative error of the {quantity} {error:.1e}");
}
