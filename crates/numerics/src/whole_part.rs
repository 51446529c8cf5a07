//! Conversion of a number to a count or an index.

/// The integer part of a number, as a count or an index.
///
/// It is 0 for negative numbers and NaN, and `usize::MAX` for larger numbers.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "what the function is for"
)]
pub const fn whole_part(number: f64) -> usize {
    number as usize
}
