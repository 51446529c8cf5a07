//! Refinement of a computation until its error is small enough, and the discretisation error on a given number of elements.
//!
//! An error C/n^q on n elements follows from the difference between two resolutions:
//!
//! ```text
//! error on n = |value(n) − value(n/2)| / (2^q − 1)
//!            = |value(n) − value(3n/4)| / ((4/3)^q − 1)
//!            = |value(n/2) − value(3n/8)| / ((4/3)^q − 1) / 2^q
//! ```
//!
//! The error estimate is the largest of the three after weighting. Which elements touch jumps from resolution to resolution,
//! so that one or two differences alone may vanish by chance. Differences of close resolutions are divided by little, and
//! hence carry most of this scatter. Measured on random scenes: docs/calibration.md, "What was measured".

use std::f64::consts::LN_2;

use thiserror::Error;

use crate::progress::{Progress, SilentProgress, WorkProgress};
use crate::{ErrorParts, Estimate};

/// Requested accuracy of a result.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Accuracy {
    /// Error of every quantity, relative to its value.
    RelativeError(f64),
    /// Number of elements along the length that is resolved.
    Elements(usize),
}

impl Accuracy {
    /// The requested relative error; `None` if a number of elements is requested.
    pub const fn relative_error(self) -> Option<f64> {
        match self {
            Self::RelativeError(error) => Some(error),
            Self::Elements(_) => None,
        }
    }
}

impl From<f64> for Accuracy {
    /// The request of a relative error.
    fn from(relative_error: f64) -> Self {
        Self::RelativeError(relative_error)
    }
}

/// Requested accuracy of a result, and the receiver of the progress.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    /// A relative error, or a number of elements.
    pub accuracy: Accuracy,
    /// Receiver of progress reports, which may stop the refinement.
    pub watch: &'a dyn Progress,
}

/// A request whose progress is not reported.
impl From<Accuracy> for Request<'_> {
    fn from(accuracy: Accuracy) -> Self {
        Self {
            accuracy,
            watch: &SilentProgress,
        }
    }
}

/// A relative error, whose progress is not reported.
impl From<f64> for Request<'_> {
    fn from(relative_error: f64) -> Self {
        Accuracy::from(relative_error).into()
    }
}

/// Request, limits and convergence rates of a refinement.
#[derive(Debug, Clone, Copy)]
pub struct Goal<'a> {
    /// A relative error, or a number of elements, and the receiver of the progress.
    pub request: Request<'a>,
    /// Number of elements on which a relative error is first sought; [`FIRST_ELEMENTS`] unless something needs more.
    pub initial_elements: usize,
    /// Number of elements from which on the refinement stops.
    pub max_elements: usize,
    /// Convergence order q > 0: the error falls at least like the elements to the power −q.
    pub order: f64,
    /// Approximate exponent of the work as a power of the number of elements.
    pub work_exponent: f64,
    /// Work of the other errors, as a fraction of the work on the finest resolution.
    pub extra_work: f64,
    /// Factor ≥ 1 on the discretisation error if a relative error ends the refinement.
    ///
    /// Where errors scatter from resolution to resolution, the refinement ends on one that is small by chance. The factor
    /// does not apply to quantities with an [error floor](Quantity::error_floor).
    pub selection_factor: f64,
}

/// A number whose error the refinement estimates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// Value on one resolution, in the unit of the quantity.
    pub value: f64,
    /// Scale that the requested relative error refers to: the absolute value, unless the value may vanish.
    pub scale: f64,
    /// Absolute rounding error, which no refinement reduces.
    pub rounding_error: f64,
    /// Smallest discretisation error that is stated, absolute; 0 unless all resolutions may agree by chance.
    pub error_floor: f64,
    /// Convergence order q > 0 of this quantity; `None` if it is that of the [goal](Goal::order).
    pub order: Option<f64>,
    /// Order q with which the stated value is extrapolated to n → ∞ from n/2 and n elements, where errors are known to have one sign;
    /// `None` if it is the value on n elements.
    pub extrapolation_order: Option<f64>,
    /// True if the refinement continues until this quantity has the requested error; otherwise its error is only estimated.
    pub controls_refinement: bool,
}

impl From<f64> for Quantity {
    /// A number without a rounding error of its own; [`refine`] adds that of sums, 1e-12 of its value.
    fn from(value: f64) -> Self {
        Self {
            value,
            scale: value.abs(),
            rounding_error: 0.0,
            error_floor: 0.0,
            order: None,
            extrapolation_order: None,
            controls_refinement: true,
        }
    }
}

/// The result on the finest resolution, with the error of each quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Refined<T> {
    /// Result on the finest resolution.
    pub value: T,
    /// Value of each quantity: that of the result, or [extrapolated](Quantity::extrapolation_order).
    pub quantities: Vec<f64>,
    /// Absolute error of each quantity: the sum of its parts and rounding.
    pub error: Vec<f64>,
    /// Parts of each error by their sources.
    pub parts: Vec<ErrorParts>,
    /// Number of elements of the finest resolution.
    pub elements: usize,
    /// The first quantity whose error is too large on the finest resolution allowed; `None` if all are small enough, or no
    /// relative error was requested. The caller turns it into an error.
    pub missed: Option<NotReached>,
}

/// A quantity whose error is too large on the finest resolution allowed.
///
/// The message is a predicate; the caller puts the name of the quantity in front.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "was not reached to the relative error {relative_error:e} with {elements} elements along the contact: it is {}{}",
    Estimate::new(*value, *error),
    relative_to(*value, *scale)
)]
pub struct NotReached {
    /// Index of the quantity.
    pub quantity: usize,
    /// Requested relative error.
    pub relative_error: f64,
    /// Value that was reached.
    pub value: f64,
    /// Scale of the relative error: the absolute value, or the largest absolute value of its kind.
    pub scale: f64,
    /// Absolute error of the value.
    pub error: f64,
    /// Number of elements of the finest resolution.
    pub elements: usize,
}

impl NotReached {
    /// A quantity known on a number of elements; `None` if its value has the requested relative error.
    pub fn unless_within(
        relative_error: f64,
        quantity: usize,
        known: Estimate,
        elements: usize,
    ) -> Option<Self> {
        (!known.is_within(relative_error)).then_some(Self {
            quantity,
            relative_error,
            value: known.value,
            scale: known.value.abs(),
            error: known.error,
            elements,
        })
    }

    /// The error over the requested one: the factor by which it is too large.
    pub fn error_ratio(&self) -> f64 {
        self.error / (self.relative_error * self.scale)
    }
}

/// End of the message of [`NotReached`], which names the scale of the relative error if that is not the value itself.
fn relative_to(value: f64, scale: f64) -> String {
    if scale > value.abs() {
        format!(", and the error asked for is relative to {scale:.1e}")
    } else {
        String::new()
    }
}

/// Number of elements on which a relative error is first sought. Chosen; twice or half as many change which
/// resolution reaches the error (case of `evidence tuning`).
pub const FIRST_ELEMENTS: usize = 16;
/// Smallest number n of elements whose error estimate also uses 3n/8 elements. Chosen as the default of the first error estimate,
/// with 6 elements on the coarsest resolution; on fewer, errors need not fall like a power.
const MIN_ELEMENTS_FOR_THREE_EIGHTHS: usize = FIRST_ELEMENTS;
/// Factors on the three error estimates at the head of this file: by n/2, 3n/4 and 3n/8 elements. Chosen on random scenes
/// (docs/calibration.md, "What was measured"; case of `evidence tuning`).
const ESTIMATE_WEIGHTS: [f64; 3] = [1.25, 0.625, 0.85];
/// Factor on the larger of the error estimates by n/2 and 3n/4 elements if there is no third one. Chosen on random scenes
/// (docs/calibration.md, "What was measured").
const WEIGHT_OF_TWO_ESTIMATES: f64 = 1.7;
/// Smallest convergence order that is assumed. Chosen: with it, half of an error takes 2¹⁰ times the elements, which no
/// refinement affords.
pub const MIN_CONVERGENCE_ORDER: f64 = 0.1;
/// Share of the requested relative error that an iteration on each resolution may leave, such as that to a limit cycle.
///
/// Chosen: with shares from 1e-3 to 0.3 no error bar of `evidence tuning` changes by more than a factor of 1.5 in the
/// one-dimensional model. With 0.01 to 0.1 no digit changes on the half space.
pub const ITERATION_SHARE: f64 = 0.05;
/// Rounding error of the many sums behind a value, relative to the value.
///
/// Sums of up to 4·10⁶ terms have a rounding error of at most √n ε = 4e-13 of the sum of their absolute values, if roundings are
/// independent.
pub const SUMMATION_ERROR: f64 = 1e-12;

/// The result on one level of a refinement.
#[derive(Debug)]
pub struct Level<T> {
    /// Result on this resolution.
    pub found: T,
    /// The quantity whose error is too large; `None` if all are small enough, or no relative error was requested.
    pub missed: Option<NotReached>,
    /// Expected work of the levels that are still needed; `None` if none is, or the next one is beyond the limits.
    pub remaining_work: Option<f64>,
}

/// Solves on one level after the other, each finer than the one before, until no more is needed or within the limits.
///
/// `solve_next` receives the result of the level before and solves on the next one. It returns `None` while the levels are too
/// few for an error estimate, which takes the `initial_work`.
///
/// # Errors
/// Those of `solve_next`.
pub fn refine_levels<T, E>(
    watch: &dyn Progress,
    initial_work: f64,
    mut solve_next: impl FnMut(Option<Level<T>>, &mut WorkProgress) -> Result<Option<Level<T>>, E>,
) -> Result<Level<T>, E> {
    let mut progress = WorkProgress::new(watch, initial_work);
    let mut last: Option<Level<T>> = None;
    loop {
        last = solve_next(last, &mut progress)?;
        if let Some(level) = last.take_if(|level| level.remaining_work.is_none()) {
            return Ok(level);
        }
        if let Some(work) = last.as_ref().and_then(|level| level.remaining_work) {
            progress.set_remaining_work(work);
        }
    }
}

/// Expected work and errors of the levels that follow.
#[derive(Debug, Clone, Copy)]
pub struct LevelForecast {
    /// Work of the next level.
    pub work: f64,
    /// Ratio > 1 of the work of one level to that of the level before.
    pub work_ratio: f64,
    /// Ratio < 1 of the error of one level to that of the level before.
    pub error_ratio: f64,
    /// Number of levels within the limits.
    pub max_levels: f64,
}

impl LevelForecast {
    /// Number of levels, at least 1, until the error is small enough or the limits are reached.
    fn levels(&self, missed: &NotReached) -> f64 {
        let needed = missed.error_ratio().ln() / -self.error_ratio.ln();
        needed.min(self.max_levels).ceil().max(1.0)
    }

    /// Work of these levels, a geometric series.
    pub fn remaining_work(&self, missed: &NotReached) -> f64 {
        let growth = self.work_ratio.powf(self.levels(missed));
        self.work * (growth - 1.0) / (self.work_ratio - 1.0)
    }
}

/// Solves with the requested number of elements, or doubles them until all quantities have the requested relative error.
///
/// - `solve` computes the result on a number of elements.
/// - `quantities` extracts the numbers that are refined, equally many on every resolution.
/// - `other_errors` returns the error parts that are equal on all resolutions and hence invisible in their differences. It may
///   return those of the first quantities only. It is called once the discretisation error is small enough, and on the last
///   resolution.
///
/// `solve` and `other_errors` receive a function that reports their completed fraction, from 0 to 1.
///
/// # Errors
/// Those of `solve` and `other_errors`.
pub fn refine<T, E>(
    goal: &Goal,
    solve: impl Fn(usize, &dyn Fn(f64)) -> Result<T, E>,
    quantities: impl Fn(&T) -> Vec<Quantity>,
    other_errors: impl Fn(&T, &dyn Fn(f64)) -> Result<Vec<ErrorParts>, E>,
) -> Result<Refined<T>, E> {
    let Request { accuracy, watch } = goal.request;
    let (mut elements, relative_error, selection_factor) = match accuracy {
        Accuracy::Elements(elements) => (elements, None, 1.0),
        Accuracy::RelativeError(error) => {
            (goal.initial_elements, Some(error), goal.selection_factor)
        }
    };
    let solve_on = |eighths: usize, elements: usize, progress: &mut WorkProgress| {
        let elements = eighths.saturating_mul(elements).div_ceil(8);
        progress.run(goal.work_on(elements as f64), |report| {
            solve(elements, report)
        })
    };
    // `half` and `three_eighths` hold the quantities on half and on three eighths of the elements. From the second level on
    // they are known from the level before.
    let (mut half, mut three_eighths) = (Vec::new(), None);
    let level = refine_levels(watch, goal.initial_work(elements), |last, progress| {
        if last.is_none() {
            half = quantities(&solve_on(4, elements, progress)?);
            if elements >= MIN_ELEMENTS_FOR_THREE_EIGHTHS {
                three_eighths = Some(quantities(&solve_on(3, elements, progress)?));
            }
        }

        // Solve on this resolution and on three quarters of it.
        let three_quarters = quantities(&solve_on(6, elements, progress)?);
        let value = solve_on(8, elements, progress)?;
        let fine = quantities(&value);

        // Estimate the discretisation error from the differences between resolutions.
        let part = |index: usize| {
            let value_on = |quantities: &[Quantity]| quantities[index].value;
            let values = ResolutionValues {
                fine: value_on(&fine),
                three_quarters: value_on(&three_quarters),
                half: value_on(&half),
                three_eighths: three_eighths.as_deref().map(value_on),
            };
            let floor = fine[index].error_floor;
            // An error floor already covers the scatter between resolutions.
            let factor = if floor > 0.0 { 1.0 } else { selection_factor };
            let error = factor * values.error(fine[index].order.unwrap_or(goal.order));
            ErrorParts::discretisation_only(error.max(floor))
        };
        let mut parts: Vec<ErrorParts> = (0..fine.len()).map(part).collect();

        // Add the other errors where the result may be final.
        let is_last = || elements >= goal.max_elements || !watch.may_refine(2 * elements);
        if not_reached(relative_error, &fine, &parts, elements).is_none() || is_last() {
            let work = goal.extra_work * goal.work_on(elements as f64);
            let other_parts = progress.run(work, |report| other_errors(&value, report))?;
            for (part, other) in parts.iter_mut().zip(other_parts) {
                *part = part.plus(other);
            }
        }

        // Where the order is known, the stated value is improved by Richardson extrapolation from n/2 and n elements.
        let extrapolated = fine.iter().zip(&half).map(|(fine, half)| {
            let gain = fine
                .extrapolation_order
                .map(|order| (order * LN_2).exp_m1());
            gain.map_or(fine.value, |gain| {
                fine.value + (fine.value - half.value) / gain
            })
        });
        let stated: Vec<f64> = extrapolated.collect();

        // Double the elements; their half and three eighths are known then.
        let missed =
            not_reached(relative_error, &fine, &parts, elements).map(|missed| NotReached {
                value: stated[missed.quantity],
                ..missed
            });
        let unfinished = missed.filter(|_| !is_last());
        let level = Level {
            found: Refined {
                error: errors(&fine, &parts),
                quantities: stated,
                value,
                parts,
                elements,
                missed,
            },
            missed,
            remaining_work: unfinished.map(|missed| goal.work_after(&missed)),
        };
        elements *= 2;
        half = fine;
        three_eighths = Some(three_quarters);
        Ok(Some(level))
    })?;
    Ok(level.found)
}

impl Goal<'_> {
    /// Work of one resolution of a number of elements, in units of the work on one element: its power
    /// [`work_exponent`](Self::work_exponent).
    fn work_on(&self, elements: f64) -> f64 {
        elements.powf(self.work_exponent)
    }

    /// Work of the first error estimate on n `elements`: the solutions on 3n/8, n/2, 3n/4 and n elements, and the other errors. The
    /// first solution is counted even if n is too small for it.
    fn initial_work(&self, elements: usize) -> f64 {
        let work = |part: f64| self.work_on(part * elements as f64);
        work(0.375) + work(0.5) + work(0.75) + (1.0 + self.extra_work) * work(1.0)
    }

    /// Work of the doublings that are still needed if the error falls with the convergence order.
    fn work_after(&self, missed: &NotReached) -> f64 {
        let elements = missed.elements as f64;
        // Each doubling solves on all and on three quarters of the new elements.
        let forecast = LevelForecast {
            work: self.work_on(2.0 * elements) + self.work_on(1.5 * elements),
            work_ratio: self.work_exponent.exp2(),
            error_ratio: (-self.order).exp2(),
            max_levels: (self.max_elements as f64 / elements).log2(),
        };
        let finest = elements * forecast.levels(missed).exp2();
        forecast.remaining_work(missed) + self.extra_work * self.work_on(finest)
    }
}

/// Values of one quantity on n, 3n/4, n/2 and 3n/8 elements.
struct ResolutionValues {
    /// Value on n elements.
    fine: f64,
    /// Value on 3n/4 elements.
    three_quarters: f64,
    /// Value on n/2 elements.
    half: f64,
    /// Value on 3n/8 elements; `None` if n is too small for them.
    three_eighths: Option<f64>,
}

impl ResolutionValues {
    /// Discretisation error of the fine value, if errors fall like the elements to the power −order.
    fn error(&self, order: f64) -> f64 {
        // `gain` is ratio^q − 1, computed without cancellation, because it is small for the sharpest cusps.
        let gain = |ratio: f64| (order * ratio.ln()).exp_m1();
        let from_half = (self.fine - self.half).abs() / gain(2.0);
        let from_three_quarters = (self.fine - self.three_quarters).abs() / gain(4.0 / 3.0);
        let Some(three_eighths) = self.three_eighths else {
            return WEIGHT_OF_TWO_ESTIMATES * from_half.max(from_three_quarters);
        };
        let from_three_eighths =
            (self.half - three_eighths).abs() / gain(4.0 / 3.0) * (-order).exp2();
        let estimates = [from_half, from_three_quarters, from_three_eighths];
        let weighted = estimates.iter().zip(ESTIMATE_WEIGHTS);
        weighted.fold(0.0, |largest, (estimate, weight)| {
            (weight * estimate).max(largest)
        })
    }
}

/// Absolute error of each quantity: the sum of its parts, of the rounding of sums ([`SUMMATION_ERROR`]) and of its own rounding
/// error.
fn errors(fine: &[Quantity], parts: &[ErrorParts]) -> Vec<f64> {
    let error = |(fine, parts): (&Quantity, &ErrorParts)| {
        parts.sum() + SUMMATION_ERROR * fine.value.abs() + fine.rounding_error
    };
    fine.iter().zip(parts).map(error).collect()
}

/// The first controlling quantity whose error exceeds the requested one, or twice its rounding error if that is larger.
///
/// `None` if there is no such quantity, or no relative error is requested.
fn not_reached(
    requested: Option<f64>,
    fine: &[Quantity],
    parts: &[ErrorParts],
    elements: usize,
) -> Option<NotReached> {
    let relative_error = requested?;
    let errors = errors(fine, parts);
    let allowed = |fine: &Quantity| (relative_error * fine.scale).max(2.0 * fine.rounding_error);
    let missed = |quantity: &usize| errors[*quantity] > allowed(&fine[*quantity]);
    let quantity =
        (0..fine.len()).find(|quantity| fine[*quantity].controls_refinement && missed(quantity))?;
    Some(NotReached {
        quantity,
        relative_error,
        value: fine[quantity].value,
        scale: fine[quantity].scale,
        error: errors[quantity],
        elements,
    })
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;
    use approx::assert_relative_eq;

    const ROUNDING_ERROR: f64 = 0.5;

    fn resolved(order: f64, values: impl Fn(f64) -> f64) -> Refined<f64> {
        let goal = Goal {
            request: Accuracy::Elements(64).into(),
            initial_elements: FIRST_ELEMENTS,
            max_elements: 128,
            order,
            work_exponent: 0.0,
            extra_work: 0.0,
            selection_factor: 1.0,
        };
        let quantities = |value: &f64| {
            vec![Quantity {
                rounding_error: ROUNDING_ERROR,
                ..Quantity::from(*value)
            }]
        };
        let solve = |elements, _: &dyn Fn(f64)| Ok::<f64, NotReached>(values(elements as f64));
        refine(&goal, solve, quantities, |_, _| Ok(Vec::new())).expect("a value")
    }

    #[test]
    fn the_estimate_of_a_known_order_is_the_error_times_its_largest_weight() {
        for order in [0.1, 0.2, 0.5, 1.0] {
            let got = resolved(order, |n| 3.0 + n.powf(-order));
            let estimate_over_error = (got.error[0] - ROUNDING_ERROR) / (got.value - 3.0);
            assert_relative_eq!(estimate_over_error, 1.25, epsilon = 1e-9);
        }
    }

    #[test]
    fn an_extrapolated_value_is_exact_for_its_order_and_keeps_its_bar() {
        let goal = Goal {
            request: Accuracy::Elements(64).into(),
            initial_elements: FIRST_ELEMENTS,
            max_elements: 128,
            order: 1.0,
            work_exponent: 0.0,
            extra_work: 0.0,
            selection_factor: 1.0,
        };
        let extrapolated = |value: &f64| {
            let plain = Quantity::from(*value);
            let extrapolation_order = Some(2.0);
            vec![
                plain,
                Quantity {
                    extrapolation_order,
                    ..plain
                },
            ]
        };
        let solve =
            |elements, _: &dyn Fn(f64)| Ok::<f64, NotReached>(3.0 + (elements as f64).powi(-2));
        let got = refine(&goal, solve, extrapolated, |_, _| Ok(Vec::new())).expect("a value");
        let [plain, best] = [got.quantities[0], got.quantities[1]];
        assert_eq!(plain.to_bits(), got.value.to_bits(), "{got:?}");
        assert_relative_eq!(best, 3.0, epsilon = 1e-15);
        assert_eq!(got.error[0].to_bits(), got.error[1].to_bits(), "{got:?}");
    }

    #[test]
    fn differences_that_vanish_by_chance_do_not_make_the_estimate_small() {
        // Only the values on 3n/8 and n/2 elements differ, as they once did for a cone on 9, 12, 18 and 24 elements; or only
        // those on n/2 and 3n/4 elements.
        for (jump_at, expected) in [(30.0, 0.1275), (40.0, 0.125)] {
            let got = resolved(1.0, |n| if n > jump_at { 3.1 } else { 3.2 });
            assert_relative_eq!(got.error[0], expected + ROUNDING_ERROR, epsilon = 1e-9);
        }
    }

    /// Records the reported fractions, and allows resolutions up to a number of elements.
    #[derive(Debug)]
    struct Recorder {
        reported: Mutex<Vec<f64>>,
        max_elements: usize,
    }

    impl Recorder {
        fn new(max_elements: usize) -> Self {
            let reported = Mutex::default();
            Self {
                reported,
                max_elements,
            }
        }
    }

    impl Progress for Recorder {
        fn may_refine(&self, elements: usize) -> bool {
            elements <= self.max_elements
        }

        fn report(&self, fraction: f64) {
            self.reported.lock().expect("one thread").push(fraction);
        }
    }

    /// Refines 4 + 4/n; the solution and its other error report half of their work on the way.
    fn watched(accuracy: Accuracy, watch: &Recorder) -> Result<Refined<f64>, NotReached> {
        let goal = Goal {
            request: Request { accuracy, watch },
            initial_elements: FIRST_ELEMENTS,
            max_elements: 1 << 20,
            order: 1.0,
            work_exponent: 1.0,
            extra_work: 0.5,
            selection_factor: 1.0,
        };
        let solve = |elements: usize, report: &dyn Fn(f64)| {
            report(0.5);
            Ok(4.0 + 4.0 / elements as f64)
        };
        let others = |_: &f64, report: &dyn Fn(f64)| {
            report(0.5);
            Ok(Vec::new())
        };
        refine(&goal, solve, |value| vec![Quantity::from(*value)], others)
    }

    #[test]
    fn the_work_of_all_resolutions_is_reported() {
        let watch = Recorder::new(usize::MAX);
        watched(Accuracy::Elements(16), &watch).expect("a value");
        // The work is that on 8, 6, 12 and 16 elements, and that of the other error, half of the work on 16.
        let done = [4, 8, 11, 14, 20, 26, 34, 42, 46, 50].map(|work| f64::from(work) / 50.0);
        assert_eq!(watch.reported.into_inner().expect("one thread"), done);
    }

    #[test]
    fn expected_work_is_that_of_the_resolutions_that_the_order_needs() {
        // The estimate is 1.25/n of the value, so that 512 elements have the error; after the first 16 all of them are
        // expected.
        let watch = Recorder::new(512);
        let got = watched(Accuracy::RelativeError(1.25 / 500.0), &watch).expect("a value");
        assert_eq!(got.elements, 512, "{got:?}");
        let reported = watch.reported.into_inner().expect("one thread");
        let before = f64::from(8 + 6 + 12 + 16);
        let whole = before + 1.75 * f64::from(32 + 64 + 128 + 256 + 512) + 256.0;
        assert_relative_eq!(reported[8], (before + 12.0) / whole, max_relative = 1e-9);
        assert_relative_eq!(reported[reported.len() - 1], 1.0, max_relative = 1e-9);
    }

    #[test]
    fn a_resolution_that_is_not_allowed_is_not_begun() {
        let watch = Recorder::new(100);
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
        assert_relative_eq!(got.error[0], expected + ROUNDING_ERROR, max_relative = 1e-9);
    }
}
