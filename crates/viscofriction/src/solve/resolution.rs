//! An error bar from four resolutions, of few elements from three, and doubling until it is small enough.

use super::error::{Result, bail};

use super::error_parts::ErrorParts;
use crate::scene::Accuracy;

/// The finest result, and how those with three quarters, half and, of 16 elements and more, three eighths of them differ.
///
/// An error C/n^q differs by (2^q − 1) C/n^q from half the elements and by ((4/3)^q − 1) C/n^q from three quarters; what
/// half the elements differ by from three eighths is the same 2^q times. The largest error of the three, tripled, because
/// which elements touch jumps from resolution to resolution, and one or two differences alone may vanish by chance.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Resolved<T, const N: usize> {
    pub(crate) value: T,
    /// Absolute, of each quantity: the sum of its parts and rounding.
    pub(crate) error: [f64; N],
    pub(crate) parts: [ErrorParts; N],
    pub(crate) elements: usize,
}

/// What is asked, and how errors fall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Goal {
    pub(crate) accuracy: Accuracy,
    /// Elements along the contact that are not exceeded to reach an error.
    pub(crate) largest: usize,
    /// Power q of the elements with which the error falls, at least.
    pub(crate) order: f64,
}

/// The number that is resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Quantity {
    pub(crate) value: f64,
    /// Absolute error by rounding; no resolution is finer.
    pub(crate) rounding: f64,
    /// Error of the elements at least, where all resolutions may agree.
    pub(crate) least: f64,
}

impl From<f64> for Quantity {
    /// A number of which rounding is that of sums.
    fn from(value: f64) -> Self {
        Self {
            value,
            rounding: 0.0,
            least: 0.0,
        }
    }
}

/// Nothing is the same on all resolutions.
#[expect(
    clippy::unnecessary_wraps,
    reason = "stands where marches are asked, which may fail"
)]
pub(crate) fn nothing_else<T, const N: usize>(_: usize, _: &T) -> Result<[ErrorParts; N]> {
    Ok([ErrorParts::NONE; N])
}

const FIRST: usize = 16;
/// Fewer are too few for three eighths of them.
const FEWEST_FOR_EIGHTHS: usize = 16;
/// See [`Resolved`].
const SAFETY: f64 = 3.0;
/// Of the many sums behind a value.
const ROUNDING: f64 = 1e-12;
/// Orders of friction: smooth bodies are better than the first, which their outline on the elements makes safe to
/// assume; below the smallest one nothing converges.
const ORDERS: [f64; 2] = [0.1, 1.0];

/// The order 2p − 1 of the friction under an apex h ∼ r^p, or the first where that is slower.
pub(crate) fn order_of_apex(exponent: f64) -> f64 {
    (2.0 * exponent - 1.0).clamp(ORDERS[0], ORDERS[1])
}

/// Solves with the elements asked for, or with more and more until all quantities have the relative error.
///
/// `others` are the parts of the error that the resolutions do not show, because they are alike on all of them; they
/// are asked for where the rest is small enough.
pub(crate) fn resolve<T, const N: usize>(
    goal: &Goal,
    solve: impl Fn(usize) -> Result<T>,
    quantities: impl Fn(&T) -> [Quantity; N],
    others: impl Fn(usize, &T) -> Result<[ErrorParts; N]>,
) -> Result<Resolved<T, N>> {
    let (mut elements, asked) = match goal.accuracy {
        Accuracy::Elements(elements) => (elements, None),
        Accuracy::RelativeError(error) => (FIRST, Some(error)),
    };
    let mut half = quantities(&solve(elements.div_ceil(2))?);
    let mut three_eighths = None;
    if elements >= FEWEST_FOR_EIGHTHS {
        three_eighths = Some(quantities(&solve((3 * elements).div_ceil(8))?));
    }
    loop {
        let three_quarters = quantities(&solve((3 * elements).div_ceil(4))?);
        let value = solve(elements)?;
        let fine = quantities(&value);
        let changes = std::array::from_fn(|quantity| {
            let value = |values: &[Quantity; N]| values[quantity].value;
            Changes {
                fine: value(&fine),
                three_quarters: value(&three_quarters),
                half: value(&half),
                three_eighths: three_eighths.as_ref().map(value),
            }
            .error(goal.order)
            .max(fine[quantity].least)
        });
        let is_last = elements >= goal.largest;
        let mut outcome = Outcome::new(&fine, changes);
        if is_last || outcome.missed(asked).is_none() {
            outcome.add(others(elements, &value)?);
        }
        match outcome.missed(asked) {
            None => return Ok(outcome.resolved(value, elements)),
            Some(missed) if is_last => bail!("{}", missed.in_words(elements)),
            Some(_) => {}
        }
        elements *= 2;
        half = fine;
        three_eighths = Some(three_quarters);
    }
}

/// A quantity that is not known well enough.
struct Missed {
    asked: f64,
    value: f64,
    error: f64,
}

impl Missed {
    fn in_words(&self, elements: usize) -> String {
        let Self {
            asked,
            value,
            error,
        } = self;
        format!(
            "the relative error {asked:e} was not reached with {elements} elements along the contact: the value is \
             {value} with an error of {error:.1e}"
        )
    }
}

/// What one resolution and those before it say.
struct Outcome<'a, const N: usize> {
    fine: &'a [Quantity; N],
    parts: [ErrorParts; N],
}

impl<'a, const N: usize> Outcome<'a, N> {
    fn new(fine: &'a [Quantity; N], changes: [f64; N]) -> Self {
        Self {
            fine,
            parts: changes.map(ErrorParts::of_elements),
        }
    }

    fn add(&mut self, others: [ErrorParts; N]) {
        for (part, other) in self.parts.iter_mut().zip(others) {
            *part = part.and(other);
        }
    }

    fn errors(&self) -> [f64; N] {
        std::array::from_fn(|quantity| {
            let Quantity {
                value, rounding, ..
            } = self.fine[quantity];
            self.parts[quantity].sum() + ROUNDING * value.abs() + rounding
        })
    }

    /// The first quantity that is not known well enough; none where no relative error is asked.
    fn missed(&self, asked: Option<f64>) -> Option<Missed> {
        let asked = asked?;
        let errors = self.errors().into_iter();
        let mut known = self.fine.iter().zip(errors);
        let (quantity, error) = known.find(|(quantity, error)| {
            *error > (asked * quantity.value.abs()).max(2.0 * quantity.rounding)
        })?;
        Some(Missed {
            asked,
            value: quantity.value,
            error,
        })
    }

    fn resolved<T>(self, value: T, elements: usize) -> Resolved<T, N> {
        Resolved {
            value,
            error: self.errors(),
            parts: self.parts,
            elements,
        }
    }
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

    fn resolved(order: f64, values: impl Fn(f64) -> f64) -> Resolved<f64, 1> {
        let goal = Goal {
            accuracy: Accuracy::Elements(64),
            largest: 128,
            order,
        };
        let quantities = |value: &f64| [Quantity::from(*value)];
        let solve = |elements: usize| Ok(values(elements as f64));
        resolve(&goal, solve, quantities, nothing_else).expect("a value")
    }

    #[test]
    fn the_bar_of_a_known_order_is_the_error_times_the_safety() {
        for order in [0.1, 0.2, 0.5, 1.0] {
            let got = resolved(order, |n| 3.0 + n.powf(-order));
            let bar_over_error = got.error[0] / (got.value - 3.0);
            assert!(
                (bar_over_error - SAFETY).abs() < 1e-9,
                "order {order}: {bar_over_error} instead of {SAFETY}, {got:?}"
            );
        }
    }

    #[test]
    fn two_differences_that_vanish_by_chance_do_not_make_the_bar_small() {
        // As of 24 elements, 18 and 12, and of 9, with which a cone was once marched.
        let got = resolved(1.0, |n| if n > 30.0 { 3.1 } else { 3.2 });
        assert!(
            (got.error[0] - SAFETY * 0.15).abs() < 1e-9,
            "three eighths of the elements differ from half of them by 0.1: {got:?}"
        );
    }

    #[test]
    fn one_difference_that_vanishes_by_chance_does_not_make_the_bar_small() {
        let got = resolved(1.0, |n| if n > 40.0 { 3.1 } else { 3.2 });
        assert!(
            (got.error[0] - SAFETY * 0.1).abs() < 1e-9,
            "half of the elements differ by 0.1: {got:?}"
        );
    }
    #[test]
    fn a_value_of_zero_on_given_elements_needs_no_more_elements() {
        let got = resolved(1.0, |n| if n > 60.0 { 0.0 } else { 0.1 });
        let expected = SAFETY * 0.1 / (4.0_f64 / 3.0 - 1.0);
        assert_eq!(got.elements, 64, "elements asked for and used: {got:?}");
        assert!(
            (got.error[0] - expected).abs() < 1e-9 * expected,
            "a bar of {expected} was expected: {got:?}"
        );
    }
}
