//! Refinement of a computation until its error is small enough, and the error on a given number of elements.
//!
//! An error C/n^q of n elements differs by (2^q − 1) C/n^q from that of half as many, and by ((4/3)^q − 1) C/n^q from that
//! of three quarters of them; half the elements and three eighths of them differ by 2^q times the latter. Each gives an
//! estimate, and the error is the largest of them after they were weighted: which elements touch jumps from resolution to
//! resolution, so that one or two differences alone may vanish by chance, and those of near resolutions, which are divided
//! by little, carry most of the jumps.

use thiserror::Error;

use crate::progress::{Progress, SilentProgress, WorkProgress};
use crate::{ErrorParts, Estimate};

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

/// How well a result is asked for, and who follows the computation.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    /// A relative error, or a number of elements.
    pub accuracy: Accuracy,
    /// Is told how far it is, and may end it.
    pub watch: &'a dyn Progress,
}

/// Nobody follows.
impl From<Accuracy> for Request<'_> {
    fn from(accuracy: Accuracy) -> Self {
        Self {
            accuracy,
            watch: &SilentProgress,
        }
    }
}

/// A relative error, and nobody follows.
impl From<f64> for Request<'_> {
    fn from(relative_error: f64) -> Self {
        Accuracy::from(relative_error).into()
    }
}

/// What is asked, and how errors fall.
#[derive(Debug, Clone, Copy)]
pub struct Goal<'a> {
    /// A relative error, or a number of elements.
    pub request: Request<'a>,
    /// Elements with which a relative error is first sought; [`FIRST_ELEMENTS`] unless something needs more.
    pub first: usize,
    /// Elements that are not exceeded to reach an error.
    pub largest: usize,
    /// Power q of the elements with which the error falls, at least.
    pub order: f64,
    /// Power of the elements with which the work grows, about.
    pub work: f64,
    /// Work of the other errors, as a part of that on the finest resolution.
    pub others: f64,
    /// Factor ≥ 1 on the errors of the elements where a relative error ends the refinement: where they scatter from resolution
    /// to resolution, those that end it are the ones that are small by chance. Not of quantities with a least error.
    pub selection: f64,
}

/// A number that is refined.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// Its value on one resolution.
    pub value: f64,
    /// What the error asked for is relative to: the size of the value, unless that may vanish.
    pub size: f64,
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
            size: value.abs(),
            rounding: 0.0,
            least: 0.0,
            drives: true,
        }
    }
}

/// The result on the finest resolution, with the error of each quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Refined<T> {
    /// The result.
    pub value: T,
    /// Absolute error of each quantity: the sum of its parts and rounding.
    pub error: Vec<f64>,
    /// Where each error comes from.
    pub parts: Vec<ErrorParts>,
    /// Elements of the finest resolution.
    pub elements: usize,
    /// What is not known well enough on it, although it is the finest one allowed; whoever asked refuses it.
    pub missed: Option<NotReached>,
}

/// A quantity is not known well enough on the finest resolution allowed. The message is a predicate, in front of which whoever
/// knows the quantity puts its name.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "was not reached to the relative error {asked:e} with {elements} elements along the contact: it is {}{}",
    Estimate::new(*value, *error),
    relative_to(*value, *size)
)]
pub struct NotReached {
    /// Which of the quantities.
    pub quantity: usize,
    /// Relative error asked for.
    pub asked: f64,
    /// Value that was reached.
    pub value: f64,
    /// What the error asked for is relative to: the size of the value, or of the largest of its kind.
    pub size: f64,
    /// Its absolute error.
    pub error: f64,
    /// Elements of the finest resolution.
    pub elements: usize,
}

/// What an error is relative to, where that is not the value itself.
fn relative_to(value: f64, size: f64) -> String {
    if size > value.abs() {
        format!(", and the error asked for is relative to {size:.1e}")
    } else {
        String::new()
    }
}

/// Elements with which a relative error is first sought.
pub const FIRST_ELEMENTS: usize = 16;
/// Fewer are too few for three eighths of them.
const FEWEST_FOR_EIGHTHS: usize = 16;
/// Weights of the estimates by half of the elements, three quarters, and three eighths (docs/calibration.md).
const WEIGHTS: [f64; 3] = [1.25, 0.625, 0.85];
/// Of the first two, where there is no third one.
const OF_TWO: f64 = 1.7;
/// Of the many sums behind a value, relative to it.
const ROUNDING: f64 = 1e-12;

/// Solves with the elements asked for, or with more and more until all quantities have the relative error.
///
/// There are as many quantities on all resolutions. `others` gives the parts of their errors that resolutions do not show
/// because they are alike on all of them, for the first of them or for all; it is called where the rest is small enough.
/// Both are given what is to be told of their progress, from 0 to 1.
///
/// # Errors
/// Those of `solve` and `others`.
pub fn refine<T, E>(
    goal: &Goal,
    solve: impl Fn(usize, &dyn Fn(f64)) -> Result<T, E>,
    quantities: impl Fn(&T) -> Vec<Quantity>,
    others: impl Fn(&T, &dyn Fn(f64)) -> Result<Vec<ErrorParts>, E>,
) -> Result<Refined<T>, E> {
    let Request { accuracy, watch } = goal.request;
    let (mut elements, asked) = match accuracy {
        Accuracy::Elements(elements) => (elements, None),
        Accuracy::RelativeError(error) => (goal.first, Some(error)),
    };
    let mut progress = WorkProgress::new(watch, goal.work_before(elements));
    let on = |eighths: usize, elements: usize, progress: &mut WorkProgress| {
        let elements = eighths.saturating_mul(elements).div_ceil(8);
        progress.run(goal.work_on(elements as f64), |tell| solve(elements, tell))
    };
    let mut half = quantities(&on(4, elements, &mut progress)?);
    let mut three_eighths = None;
    if elements >= FEWEST_FOR_EIGHTHS {
        three_eighths = Some(quantities(&on(3, elements, &mut progress)?));
    }
    loop {
        let three_quarters = quantities(&on(6, elements, &mut progress)?);
        let value = on(8, elements, &mut progress)?;
        let fine = quantities(&value);
        let is_last = || elements >= goal.largest || !watch.may_refine(2 * elements);
        let weight = asked.map_or(1.0, |_| goal.selection);
        let grids = [&fine, &three_quarters, &half];
        let eighths = three_eighths.as_deref();
        let mut parts = parts_of_elements([goal.order, weight], grids, eighths);
        if not_reached(asked, &fine, &parts, elements).is_none() || is_last() {
            let work = goal.others * goal.work_on(elements as f64);
            let others = progress.run(work, |tell| others(&value, tell))?;
            for (part, other) in parts.iter_mut().zip(others) {
                *part = part.and(other);
            }
        }
        match not_reached(asked, &fine, &parts, elements) {
            Some(missed) if !is_last() => progress.set_remaining_work(goal.work_after(&missed)),
            missed => {
                return Ok(Refined {
                    error: errors(&fine, &parts),
                    value,
                    parts,
                    elements,
                    missed,
                });
            }
        }
        elements *= 2;
        half = fine;
        three_eighths = Some(three_quarters);
    }
}

impl Goal<'_> {
    fn work_on(&self, elements: f64) -> f64 {
        elements.powf(self.work)
    }

    /// Of the first resolutions, up to these elements.
    fn work_before(&self, elements: usize) -> f64 {
        let work = |part: f64| self.work_on(part * elements as f64);
        work(0.375) + work(0.5) + work(0.75) + (1.0 + self.others) * work(1.0)
    }

    /// Of the resolutions that are still needed, if the error falls with the order.
    fn work_after(&self, missed: &NotReached) -> f64 {
        let ratio = missed.error / (missed.asked * missed.size);
        let mut elements = missed.elements as f64;
        let needed = (elements * ratio.powf(self.order.recip())).min(self.largest as f64);
        let mut work = 0.0;
        loop {
            elements *= 2.0;
            work += self.work_on(elements) + self.work_on(0.75 * elements);
            if elements >= needed {
                return work + self.others * self.work_on(elements);
            }
        }
    }
}

/// What the elements do to each quantity, of all elements, three quarters and a half of them, and three eighths.
fn parts_of_elements(
    [order, weight]: [f64; 2],
    resolutions: [&Vec<Quantity>; 3],
    three_eighths: Option<&[Quantity]>,
) -> Vec<ErrorParts> {
    let part = |index: usize| {
        let values = resolutions.map(|quantities| quantities[index].value);
        let three_eighths = three_eighths.map(|quantities| quantities[index].value);
        let least = resolutions[0][index].least;
        // A least error holds what scatters.
        let weight = if least > 0.0 { 1.0 } else { weight };
        let error = weight * error_of_elements(order, values, three_eighths);
        ErrorParts::of_elements(error.max(least))
    };
    (0..resolutions[0].len()).map(part).collect()
}

/// Error on all elements where it falls with this power of them.
fn error_of_elements(
    order: f64,
    [fine, three_quarters, half]: [f64; 3],
    three_eighths: Option<f64>,
) -> f64 {
    // ratio^q − 1, which is small for the sharpest cusps.
    let gain = |ratio: f64| (order * ratio.ln()).exp_m1();
    let of_half = (fine - half).abs() / gain(2.0);
    let of_three_quarters = (fine - three_quarters).abs() / gain(4.0 / 3.0);
    let Some(three_eighths) = three_eighths else {
        return OF_TWO * of_half.max(of_three_quarters);
    };
    let of_three_eighths = (half - three_eighths).abs() / gain(4.0 / 3.0) * (-order).exp2();
    let estimates = [of_half, of_three_quarters, of_three_eighths];
    let weighted = estimates.iter().zip(WEIGHTS);
    weighted.fold(0.0, |largest, (one, weight)| (weight * one).max(largest))
}

fn errors(fine: &[Quantity], parts: &[ErrorParts]) -> Vec<f64> {
    let error = |(fine, parts): (&Quantity, &ErrorParts)| {
        parts.sum() + ROUNDING * fine.value.abs() + fine.rounding
    };
    fine.iter().zip(parts).map(error).collect()
}

/// The first quantity that is not known well enough; none where no relative error is asked.
fn not_reached(
    asked: Option<f64>,
    fine: &[Quantity],
    parts: &[ErrorParts],
    elements: usize,
) -> Option<NotReached> {
    let asked = asked?;
    let errors = errors(fine, parts);
    let allowed = |fine: &Quantity| (asked * fine.size).max(2.0 * fine.rounding);
    let missed = |quantity: &usize| errors[*quantity] > allowed(&fine[*quantity]);
    let quantity = (0..fine.len()).find(|quantity| fine[*quantity].drives && missed(quantity))?;
    Some(NotReached {
        quantity,
        asked,
        value: fine[quantity].value,
        size: fine[quantity].size,
        error: errors[quantity],
        elements,
    })
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;
    use approx::assert_relative_eq;

    const ROUNDED: f64 = 0.5;

    fn resolved(order: f64, values: impl Fn(f64) -> f64) -> Refined<f64> {
        let goal = Goal {
            request: Accuracy::Elements(64).into(),
            first: FIRST_ELEMENTS,
            largest: 128,
            order,
            work: 0.0,
            others: 0.0,
            selection: 1.0,
        };
        let quantities = |value: &f64| {
            vec![Quantity {
                rounding: ROUNDED,
                ..Quantity::from(*value)
            }]
        };
        let solve = |elements, _: &dyn Fn(f64)| Ok::<f64, NotReached>(values(elements as f64));
        refine(&goal, solve, quantities, |_, _| Ok(Vec::new())).expect("a value")
    }

    #[test]
    fn the_bar_of_a_known_order_is_the_error_times_its_largest_weight() {
        for order in [0.1, 0.2, 0.5, 1.0] {
            let got = resolved(order, |n| 3.0 + n.powf(-order));
            let bar_over_error = (got.error[0] - ROUNDED) / (got.value - 3.0);
            assert_relative_eq!(bar_over_error, 1.25, epsilon = 1e-9);
        }
    }

    #[test]
    fn differences_that_vanish_by_chance_do_not_make_the_bar_small() {
        // Three eighths of the elements differ from half of them by 0.1, as of 24 elements, 18 and 12, and of 9, with which
        // a cone was once marched; or half of them from three quarters.
        for (jump_at, expected) in [(30.0, 0.1275), (40.0, 0.125)] {
            let got = resolved(1.0, |n| if n > jump_at { 3.1 } else { 3.2 });
            assert_relative_eq!(got.error[0], expected + ROUNDED, epsilon = 1e-9);
        }
    }

    /// Remembers what it is told, and allows so many elements.
    #[derive(Debug)]
    struct Recorder(Mutex<Vec<f64>>, usize);

    impl Progress for Recorder {
        fn may_refine(&self, elements: usize) -> bool {
            elements <= self.1
        }

        fn report(&self, fraction: f64) {
            self.0.lock().expect("one thread").push(fraction);
        }
    }

    /// Refines 4 + 4/n and its other error, each with half of its work told on the way.
    fn watched(accuracy: Accuracy, watch: &Recorder) -> Result<Refined<f64>, NotReached> {
        let goal = Goal {
            request: Request { accuracy, watch },
            first: FIRST_ELEMENTS,
            largest: 1 << 20,
            order: 1.0,
            work: 1.0,
            others: 0.5,
            selection: 1.0,
        };
        let solve = |elements: usize, tell: &dyn Fn(f64)| {
            tell(0.5);
            Ok(4.0 + 4.0 / elements as f64)
        };
        let others = |_: &f64, tell: &dyn Fn(f64)| {
            tell(0.5);
            Ok(Vec::new())
        };
        refine(&goal, solve, |value| vec![Quantity::from(*value)], others)
    }

    #[test]
    fn the_work_of_all_resolutions_is_told() {
        let watch = Recorder(Mutex::default(), usize::MAX);
        watched(Accuracy::Elements(16), &watch).expect("a value");
        // Of 8, 6, 12 and 16 elements and half as much again.
        let done = [4, 8, 11, 14, 20, 26, 34, 42, 46, 50].map(|work| f64::from(work) / 50.0);
        assert_eq!(watch.0.into_inner().expect("one thread"), done);
    }

    #[test]
    fn expected_work_is_that_of_the_resolutions_that_the_order_needs() {
        // The bar is 1.25/n of the value, so that 512 elements have the error; from the first 16 on, all of them are expected.
        let watch = Recorder(Mutex::default(), 512);
        let got = watched(Accuracy::RelativeError(1.25 / 500.0), &watch).expect("a value");
        assert_eq!(got.elements, 512, "{got:?}");
        let told = watch.0.into_inner().expect("one thread");
        let before = f64::from(8 + 6 + 12 + 16);
        let whole = before + 1.75 * f64::from(32 + 64 + 128 + 256 + 512) + 256.0;
        assert_relative_eq!(told[8], (before + 12.0) / whole, max_relative = 1e-9);
        assert_relative_eq!(told[told.len() - 1], 1.0, max_relative = 1e-9);
    }

    #[test]
    fn a_resolution_that_is_not_allowed_is_not_begun() {
        let watch = Recorder(Mutex::default(), 100);
        let refined = watched(Accuracy::RelativeError(1e-3), &watch).expect("a value");
        let missed = refined.missed.expect("too coarse");
        assert_eq!(missed.elements, 64, "{missed}");
        assert_relative_eq!(missed.error, 5.0 / 64.0, max_relative = 1e-6);
        assert_relative_eq!(refined.value, 4.0 + 4.0 / 64.0);
    }

    #[test]
    fn a_value_of_zero_on_given_elements_needs_no_more_elements() {
        let got = resolved(1.0, |n| if n > 60.0 { 0.0 } else { 0.1 });
        let expected = 0.625 * 0.1 / (4.0_f64 / 3.0 - 1.0);
        assert_eq!(got.elements, 64, "elements asked for and used: {got:?}");
        assert_relative_eq!(got.error[0], expected + ROUNDED, max_relative = 1e-9);
    }
}
