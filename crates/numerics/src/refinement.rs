//! Refinement of a computation until its error is small enough, and the error on a given number of elements.
//!
//! An error C/n^q of n elements differs by (2^q − 1) C/n^q from that of half as many, and by ((4/3)^q − 1) C/n^q from that
//! of three quarters of them; half the elements and three eighths of them differ by 2^q times the latter. The estimated
//! error is the largest of the three, tripled: which elements touch jumps from resolution to resolution, and one or two
//! differences alone may vanish by chance.

use thiserror::Error;

use crate::ErrorParts;

/// How well a result is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Accuracy {
    /// Error of every quantity, relative to its value.
    RelativeError(f64),
    /// Number of elements along the length that is resolved.
    Elements(usize),
}

impl From<f64> for Accuracy {
    /// A relative error.
    fn from(relative_error: f64) -> Self {
        Self::RelativeError(relative_error)
    }
}

/// What is asked, and how errors fall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goal {
    /// A relative error, or a number of elements.
    pub accuracy: Accuracy,
    /// Elements that are not exceeded to reach an error.
    pub largest: usize,
    /// Power q of the elements with which the error falls, at least.
    pub order: f64,
}

/// A number that is refined.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// Its value on one resolution.
    pub value: f64,
    /// Absolute error by rounding; no resolution is finer.
    pub rounding: f64,
    /// Least error of the elements, for values that all resolutions may have in common.
    pub least: f64,
    /// Whether the refinement goes on until it has the error asked for; otherwise its error is only estimated.
    pub drives: bool,
}

impl From<f64> for Quantity {
    /// A number of which rounding is that of sums.
    fn from(value: f64) -> Self {
        Self {
            value,
            rounding: 0.0,
            least: 0.0,
            drives: true,
        }
    }
}

/// The result on the finest resolution, with the error of each quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Refined<T, const N: usize> {
    /// The result.
    pub value: T,
    /// Absolute error of each quantity: the sum of its parts and rounding.
    pub error: [f64; N],
    /// Where each error comes from.
    pub parts: [ErrorParts; N],
    /// Elements of the finest resolution.
    pub elements: usize,
}

/// A quantity is not known well enough on the finest resolution allowed.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "the relative error {asked:e} was not reached with {elements} elements along the contact: the value is {value} with an \
     error of {error:.1e}"
)]
pub struct NotReached {
    /// Which of the quantities.
    pub quantity: usize,
    /// Relative error asked for.
    pub asked: f64,
    /// Value that was reached.
    pub value: f64,
    /// Its absolute error.
    pub error: f64,
    /// Elements of the finest resolution.
    pub elements: usize,
}

/// For [`refine`]: there are no errors but those that resolutions show.
///
/// # Errors
/// None.
pub fn no_other_error<T, E, const N: usize>(_: usize, _: &T) -> Result<[ErrorParts; N], E> {
    Ok([ErrorParts::NONE; N])
}

const FIRST: usize = 16;
/// Fewer are too few for three eighths of them.
const FEWEST_FOR_EIGHTHS: usize = 16;
/// See the module.
const SAFETY: f64 = 3.0;
/// Of the many sums behind a value, relative to it.
const ROUNDING: f64 = 1e-12;

/// Solves with the elements asked for, or with more and more until all quantities have the relative error.
///
/// `others` gives the parts of the error that resolutions do not show because they are alike on all of them; it is called
/// where the rest is small enough.
///
/// # Errors
/// [`NotReached`] on the finest resolution allowed, and those of `solve` and `others`.
pub fn refine<T, E: From<NotReached>, const N: usize>(
    goal: &Goal,
    solve: impl Fn(usize) -> Result<T, E>,
    quantities: impl Fn(&T) -> [Quantity; N],
    others: impl Fn(usize, &T) -> Result<[ErrorParts; N], E>,
) -> Result<Refined<T, N>, E> {
    let (mut elements, asked) = match goal.accuracy {
        Accuracy::Elements(elements) => (elements, None),
        Accuracy::RelativeError(error) => (FIRST, Some(error)),
    };
    let part = |numerator: usize, denominator: usize, elements: usize| {
        solve((numerator * elements).div_ceil(denominator)).map(|value| quantities(&value))
    };
    let mut half = part(1, 2, elements)?;
    let mut three_eighths = (elements >= FEWEST_FOR_EIGHTHS)
        .then(|| part(3, 8, elements))
        .transpose()?;
    loop {
        let three_quarters = part(3, 4, elements)?;
        let value = solve(elements)?;
        let fine = quantities(&value);
        let mut parts = std::array::from_fn(|index| {
            let value = |values: &[Quantity; N]| values[index].value;
            let changes = Changes {
                fine: value(&fine),
                three_quarters: value(&three_quarters),
                half: value(&half),
                three_eighths: three_eighths.as_ref().map(value),
            };
            ErrorParts::of_elements(changes.error(goal.order).max(fine[index].least))
        });
        let is_last = elements >= goal.largest;
        if is_last || not_reached(asked, &fine, &parts, elements).is_none() {
            for (part, other) in parts.iter_mut().zip(others(elements, &value)?) {
                *part = part.and(other);
            }
        }
        match not_reached(asked, &fine, &parts, elements) {
            None => {
                return Ok(Refined {
                    value,
                    error: errors(&fine, &parts),
                    parts,
                    elements,
                });
            }
            Some(missed) if is_last => return Err(missed.into()),
            Some(_) => {}
        }
        elements *= 2;
        half = fine;
        three_eighths = Some(three_quarters);
    }
}

fn errors<const N: usize>(fine: &[Quantity; N], parts: &[ErrorParts; N]) -> [f64; N] {
    std::array::from_fn(|index| {
        let Quantity { value, .. } = fine[index];
        parts[index].sum() + ROUNDING * value.abs() + fine[index].rounding
    })
}

/// The first quantity that is not known well enough; none where no relative error is asked.
fn not_reached<const N: usize>(
    asked: Option<f64>,
    fine: &[Quantity; N],
    parts: &[ErrorParts; N],
    elements: usize,
) -> Option<NotReached> {
    let asked = asked?;
    let errors = errors(fine, parts);
    let quantity = (0..N).find(|&quantity| {
        let fine = &fine[quantity];
        let allowed = (asked * fine.value.abs()).max(2.0 * fine.rounding);
        fine.drives && errors[quantity] > allowed
    })?;
    Some(NotReached {
        quantity,
        asked,
        value: fine[quantity].value,
        error: errors[quantity],
        elements,
    })
}

/// The values on all elements and on parts of them.
#[derive(Debug, Clone, Copy)]
struct Changes {
    fine: f64,
    three_quarters: f64,
    half: f64,
    three_eighths: Option<f64>,
}

impl Changes {
    /// Error on all elements where it falls with this power of them.
    fn error(&self, order: f64) -> f64 {
        // ratio^q − 1, which is small for the sharpest cusps.
        let gain = |ratio: f64| (order * ratio.ln()).exp_m1();
        let of_half = (self.fine - self.half).abs() / gain(2.0);
        let of_three_quarters = (self.fine - self.three_quarters).abs() / gain(4.0 / 3.0);
        let of_three_eighths = self.three_eighths.map_or(0.0, |value| {
            (self.half - value).abs() / gain(4.0 / 3.0) * (-order).exp2()
        });
        SAFETY * of_half.max(of_three_quarters).max(of_three_eighths)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn resolved(order: f64, values: impl Fn(f64) -> f64) -> Refined<f64, 1> {
        let goal = Goal {
            accuracy: Accuracy::Elements(64),
            largest: 128,
            order,
        };
        let quantities = |value: &f64| [Quantity::from(*value)];
        let solve = |elements: usize| Ok::<f64, NotReached>(values(elements as f64));
        refine(&goal, solve, quantities, no_other_error).expect("a value")
    }

    #[test]
    fn the_bar_of_a_known_order_is_the_error_times_the_safety() {
        for order in [0.1, 0.2, 0.5, 1.0] {
            let got = resolved(order, |n| 3.0 + n.powf(-order));
            let bar_over_error = got.error[0] / (got.value - 3.0);
            assert_relative_eq!(bar_over_error, SAFETY, epsilon = 1e-9);
        }
    }

    #[test]
    fn differences_that_vanish_by_chance_do_not_make_the_bar_small() {
        // Three eighths of the elements differ from half of them by 0.1, as of 24 elements, 18 and 12, and of 9, with which
        // a cone was once marched; or half of them from three quarters.
        for (jump_at, expected) in [(30.0, 0.15), (40.0, 0.1)] {
            let got = resolved(1.0, |n| if n > jump_at { 3.1 } else { 3.2 });
            assert_relative_eq!(got.error[0], SAFETY * expected, epsilon = 1e-9);
        }
    }

    #[test]
    fn a_value_of_zero_on_given_elements_needs_no_more_elements() {
        let got = resolved(1.0, |n| if n > 60.0 { 0.0 } else { 0.1 });
        let expected = SAFETY * 0.1 / (4.0_f64 / 3.0 - 1.0);
        assert_eq!(got.elements, 64, "elements asked for and used: {got:?}");
        assert_relative_eq!(got.error[0], expected, max_relative = 1e-9);
    }
}
