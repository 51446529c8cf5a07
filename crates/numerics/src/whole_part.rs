//! From numbers to counts and indices.

/// The integer part of a number, as a count or an index; 0 for negative numbers and what is no number, the largest integer
/// beyond it.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "what the function is for"
)]
pub const fn whole_part(number: f64) -> usize {
    number as usize
}
