//! What the timings have in common: the rough surface, and the error of a result, without which its time says little.

#![expect(clippy::print_stdout, reason = "the errors stand beside the times")]

mod contact_scene;
mod random;
mod rough;

use std::error::Error;

pub use contact_scene::{ContactScene, deviation};
pub use random::Random;
pub use rough::self_affine;

/// Prints how far the result of the benchmark `name` is from the exact one.
pub fn report_error(name: &str, quantity: &str, [actual, exact]: [f64; 2]) {
    let error = (actual / exact - 1.0).abs();
    println!("{name}: relative error of the {quantity} {error:.1e}");
}

/// Why there is no timing.
pub type Failure = Box<dyn Error + Send + Sync>;

/// Does the work in a pool of so many threads.
///
/// # Errors
/// When the threads cannot be made; without the feature `rayon` for more than one.
pub fn on_threads<R: Send>(threads: usize, work: impl FnOnce() -> R + Send) -> Result<R, Failure> {
    #[cfg(feature = "rayon")]
    return Ok(rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()?
        .install(work));
    #[cfg(not(feature = "rayon"))]
    if threads == 1 {
        Ok(work())
    } else {
        Err("the feature rayon is off".into())
    }
}
