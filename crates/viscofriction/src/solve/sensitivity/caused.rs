//! Derivatives of contacts whose moduli or shear strength depend on the temperature or the strain that they cause.
//!
//! At given temperature and strain x a contact has the quantities q(θ, x), which depend on the number θ of the scene, and causes the
//! temperature and strain g(θ, x). Its state is that of the fixed point x = g, so that by the implicit function theorem
//! ```text
//! dq/dθ = ∂q/∂θ + ∂q/∂x dx/dθ,     dx/dθ = (1 − ∂g/∂x)⁻¹ ∂g/∂θ.
//! ```
//! All partial derivatives are differences of solutions on one number of elements, at the temperature and the strain of the answer. Each
//! number takes two of them, and no search of a fixed point. Errors are the differences from the same derivatives on half as many elements,
//! with twice the steps, and at the upper ends of the error bars of temperature and strain.
//!
//! Theory: docs/theory/sensitivities.md, "Heat and strain".

use bem_halfspace::periodic;
use numerics::{Estimate, SilentProgress, WorkProgress};

use super::adjoint::check_surfaces;
use super::parameters::{Number, Numbers};
use super::{Derivatives, Sensitivity, Source};
use crate::quantity::ByQuantity;
use crate::scene::Accuracy;
use crate::solve::advice::is_too_coarse;
use crate::solve::answer::{Answer, Fields};
use crate::solve::body::Body;
use crate::solve::contact_strain::ContactStrain;
use crate::solve::contact_temperature::ContactTemperature;
use crate::solve::error::{Result, SolveError};
use crate::solve::fixed_point::SelfConsistent;
use crate::solve::problem::Problem;
use crate::solve::shear::plan_again;
use crate::solve::solved::Solved;

/// Number of elements along the contact of a body for the differences. Chosen: solutions for slightly different numbers of a scene have
/// nearly the same errors on a given number of elements, so that their logarithms differ by the right amount within some parts in 1000.
const DIFFERENCE_ELEMENTS: usize = 24;
/// Number of elements along a line contact for the differences. Chosen: one row of elements costs less than a square of them.
const DIFFERENCE_ELEMENTS_OF_LINE: usize = 96;
/// Largest number of elements along the contact of a body whose shape needs more.
const MAX_DIFFERENCE_ELEMENTS: usize = 16 * DIFFERENCE_ELEMENTS;
/// Step of the logarithm of a number, of the shear strength and of the strain. Chosen: solutions whose contact covers other elements
/// scatter by some 1e-4, and friction curves hardly bend over 10 %.
const DIFFERENCE_LOG_STEP: f64 = 0.1;
/// Step of the temperature, \[K]. Chosen: by the universal constants of WLF it changes times by 20 % at 50 K above the glass transition,
/// about as much as a step of the logarithm of the speed.
const DIFFERENCE_TEMPERATURE_STEP: f64 = 1.0;
/// Ratio of the error of a derivative to its difference from that on the coarse elements. Chosen: both may agree by chance. Measured: see
/// docs/theory/sensitivities.md.
const ERROR_OVER_DIFFERENCE: f64 = 2.0;
/// Error of a derivative by rounding. Derived: logarithms of up to 40 have the rounding error 1e-14 over a step of 0.1.
const SLOPE_ROUNDING: f64 = 1e-13;

/// Derivatives of an answer with heat or strain dependence by each number, and by the shear strength if it is uncertain.
///
/// Numbers whose other values are not allowed beside heat and strain, such as a Poisson ratio of 1/2, have no derivatives.
pub(super) fn derivatives(
    (numbers, all): (&Numbers, &[Number]),
    problem: &Problem,
    answer: &Answer,
    mut progress: WorkProgress,
) -> Result<Derivatives> {
    check_surfaces(problem)?;
    let mut elements = elements(problem);
    let [solutions, coarse_solutions] = loop {
        let resolutions = [Resolution::fine(elements), Resolution::coarse(elements)];
        let [fine, coarse] =
            resolutions.map(|one| ContactOnElements::new((numbers, problem), answer, one));
        match (fine, coarse) {
            (Err(SolveError::HalfSpace(error)), _) | (_, Err(SolveError::HalfSpace(error)))
                if is_too_coarse(&error) && elements < MAX_DIFFERENCE_ELEMENTS =>
            {
                elements *= 2;
            }
            (fine, coarse) => break [fine?, coarse?],
        }
    };
    let sensitivity =
        |parameter: String, direction: Direction<'_>| -> Result<Option<Sensitivity>> {
            let (Some(fine), Some(coarse)) = (
                solutions.total_slope(direction)?,
                coarse_solutions.total_slope(direction)?,
            ) else {
                return Ok(None);
            };
            let derivatives = solutions.derivatives([&fine, &coarse], answer);
            Ok(Some(Sensitivity {
                parameter,
                derivatives,
            }))
        };
    let by_number = |number: &Number| {
        let found = sensitivity(number.path.clone(), Direction::Number(number));
        progress.add(1.0);
        found.transpose()
    };
    let by_numbers = all.iter().filter_map(by_number).collect::<Result<_>>()?;
    let by_shear_strength = if problem.shear_strength_uncertainty()? > 0.0 {
        sensitivity(
            Source::ShearTable.name().to_owned(),
            Direction::ShearStrength,
        )?
    } else {
        None
    };
    Ok(Derivatives {
        by_numbers,
        by_shear_strength,
    })
}

/// Number of elements of the finer solutions: that of the scene, but at least [`DIFFERENCE_ELEMENTS`] or [`DIFFERENCE_ELEMENTS_OF_LINE`],
/// and along a period twice the smallest number with an error bar.
fn elements(problem: &Problem) -> usize {
    let fewest = match problem.body() {
        Body::Periodic(surface) => 2 * periodic::edge_for_bars(surface),
        Body::Cylinder(_) => DIFFERENCE_ELEMENTS_OF_LINE,
        _ => DIFFERENCE_ELEMENTS,
    };
    match problem.accuracy() {
        Accuracy::Elements(given) => given.max(fewest),
        Accuracy::RelativeError(_) => fewest,
    }
}

/// Elements and steps of differences.
#[derive(Debug, Clone, Copy)]
struct Resolution {
    /// Number of elements along the contact or the period.
    elements: usize,
    /// Steps in units of [`DIFFERENCE_LOG_STEP`] and [`DIFFERENCE_TEMPERATURE_STEP`].
    steps: f64,
    /// Place of temperature and strain in their error bars: 0 at their values, 1 at the upper ends.
    place_in_bars: f64,
}

impl Resolution {
    /// Differences whose values are stated.
    const fn fine(elements: usize) -> Self {
        Self {
            elements,
            steps: 1.0,
            place_in_bars: 0.0,
        }
    }

    /// Differences whose deviations from the others are the error.
    const fn coarse(elements: usize) -> Self {
        Self {
            elements: elements / 2,
            steps: 2.0,
            place_in_bars: 1.0,
        }
    }
}

/// What is changed.
#[derive(Debug, Clone, Copy)]
enum Direction<'a> {
    /// The logarithm of a number of the scene, or a temperature of the scene in proportion to its absolute value.
    Number(&'a Number),
    /// The logarithm of the shear strength.
    ShearStrength,
    /// A value that the contact causes.
    Cause(Cause),
}

/// A value that the contact causes and on which its moduli or its shear strength depend.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cause {
    /// Temperature of the contact as a whole, \[°C].
    Temperature,
    /// Logarithm of the strain amplitude.
    LogStrain,
}

impl Cause {
    /// The value of an answer, at a place in its error bar from 0 to 1; `None` if nothing depends on it.
    fn of(self, answer: &Answer, place_in_bar: f64) -> Option<f64> {
        let at = |known: Estimate| known.value + place_in_bar * known.error;
        match self {
            Self::Temperature => answer.fixed_point_temperature.map(at),
            Self::LogStrain => answer.strain.map(|strain| at(strain).ln()),
        }
    }

    /// Step of the value between the middle and an end of a difference.
    const fn step(self) -> f64 {
        match self {
            Self::Temperature => DIFFERENCE_TEMPERATURE_STEP,
            Self::LogStrain => DIFFERENCE_LOG_STEP,
        }
    }

    /// The problem at a value; below a periodic surface the temperature has the distribution of the answer `near`.
    fn problem_at(self, problem: &Problem, value: f64, near: &Answer) -> Result<Problem> {
        match self {
            Self::Temperature => ContactTemperature::of(problem).map_or_else(
                || Ok(problem.clone()),
                |of| of.problem_at(value, Some(near)),
            ),
            Self::LogStrain => ContactStrain::of(problem).map_or_else(
                || Ok(problem.clone()),
                |of| of.problem_at(value.exp(), None),
            ),
        }
    }

    /// The value that the answer to a problem causes.
    fn caused_by(self, problem: &Problem, answer: &Answer) -> f64 {
        let value = |of: &dyn SelfConsistent| of.caused_by(answer).value;
        match self {
            Self::Temperature => ContactTemperature::of(problem).map_or(f64::NAN, |of| value(&of)),
            Self::LogStrain => ContactStrain::of(problem).map_or(f64::NAN, |of| value(&of).ln()),
        }
    }
}

/// Solutions near an answer with a given number of elements, at given temperature and strain.
struct ContactOnElements<'a> {
    numbers: &'a Numbers<'a>,
    problem: &'a Problem,
    resolution: Resolution,
    /// Values of temperature and strain, as far as anything depends on them.
    causes: Vec<(Cause, f64)>,
    /// An answer whose temperature has the distribution over the depth at which all are solved.
    near: Answer,
    /// The solution without a change.
    here: Solution,
    /// Slopes over each of `causes`, in which those after it follow.
    by_cause: Vec<Slope>,
}

/// Solution of a problem.
#[derive(Clone, Default)]
struct Solution {
    /// What is changed, as a difference from the answer.
    position: f64,
    /// Logarithms of the absolute values of the quantities that are not zero.
    logs: ByQuantity<f64>,
    /// Temperature and strain that it causes.
    caused: Vec<f64>,
    /// Mean difference between the distributions of the temperature that it causes and that it assumes, \[K].
    difference: f64,
}

/// Change of a solution per change of what is changed.
struct Slope {
    /// Changes of the logarithms of the quantities.
    logs: ByQuantity<f64>,
    /// Changes of temperature and strain that are caused.
    caused: Vec<f64>,
    /// Mean change of the distribution of the temperature, \[K].
    difference: f64,
}

impl<'a> ContactOnElements<'a> {
    /// Solves at the temperature and the strain of an answer, and near them.
    fn new(
        (numbers, problem): (&'a Numbers<'a>, &'a Problem),
        answer: &Answer,
        resolution: Resolution,
    ) -> Result<Self> {
        let value = |cause: Cause| Some((cause, cause.of(answer, resolution.place_in_bars)?));
        let near = Answer {
            fields: Fields::default(),
            ..answer.clone()
        };
        let mut contact = Self {
            numbers,
            problem,
            resolution,
            causes: [Cause::Temperature, Cause::LogStrain]
                .into_iter()
                .filter_map(value)
                .collect(),
            near,
            here: Solution::default(),
            by_cause: Vec::new(),
        };
        // Take the distribution of the temperature from a solution with the same elements, so that it differs little from the caused one.
        let values: Vec<f64> = contact.causes.iter().map(|(_, value)| *value).collect();
        if contact.near.temperature_by_depth.is_some() {
            contact.near = contact.answer(&contact.problem_at(problem, &values)?)?;
        }
        contact.here = contact.point(&contact.problem_at(problem, &values)?, 0.0)?;
        // Let each value follow the ones before it, from the last to the first.
        let mut by_cause = Vec::new();
        for (index, (cause, _)) in contact.causes.iter().enumerate().rev() {
            let direction = Direction::Cause(*cause);
            let slope = contact.slope(direction)?.ok_or(SolveError::NoSensitivity {
                method: answer.method,
            })?;
            by_cause.insert(0, slope.with_causes_that_follow(index + 1, &by_cause));
        }
        contact.by_cause = by_cause;
        Ok(contact)
    }

    /// Answer to a problem at given temperature and strain.
    fn answer(&self, problem: &Problem) -> Result<Answer> {
        let elements = Accuracy::Elements(self.resolution.elements);
        let problem = problem.clone().with_accuracy(elements);
        let found = plan_again(&problem, self.near.method)?.solve_once(&SilentProgress);
        Ok(Solved::of(found)?.answer)
    }

    /// A problem at these values of temperature and strain.
    fn problem_at(&self, problem: &Problem, values: &[f64]) -> Result<Problem> {
        let mut causes = self.causes.iter().zip(values);
        causes.try_fold(problem.clone(), |problem, ((cause, _), value)| {
            cause.problem_at(&problem, *value, &self.near)
        })
    }

    /// The problem with a change of so many steps, and the change as the difference of what is changed. `None` if it is not allowed.
    fn changed(&self, direction: Direction<'_>, steps: f64) -> Result<Option<(Problem, f64)>> {
        let mut values: Vec<f64> = self.causes.iter().map(|(_, value)| *value).collect();
        let steps = steps * self.resolution.steps;
        let log = steps * DIFFERENCE_LOG_STEP;
        let (problem, position) = match direction {
            Direction::Number(number) => {
                let log = if number.is_temperature() {
                    steps * DIFFERENCE_TEMPERATURE_STEP / number.value
                } else {
                    log
                };
                let value = number.value * log.exp();
                match self.numbers.problem(self.problem, number, value) {
                    Ok(problem) => (problem, log),
                    Err(_) => return Ok(None),
                }
            }
            Direction::ShearStrength => (self.problem.clone().with_shear_factor(log.exp()), log),
            Direction::Cause(changed) => {
                let position = steps * changed.step();
                let causes = self.causes.iter().zip(&mut values);
                for (_, value) in causes.filter(|((cause, _), _)| *cause == changed) {
                    *value += position;
                }
                (self.problem.clone(), position)
            }
        };
        match self.problem_at(&problem, &values) {
            Ok(problem) => Ok(Some((problem, position))),
            // Temperatures end with the range of the laws.
            Err(SolveError::Scene(_)) => Ok(None),
            Err(other) => Err(other),
        }
    }

    /// Solution of a problem in which something is changed by `position`.
    fn point(&self, problem: &Problem, position: f64) -> Result<Solution> {
        let answer = self.answer(problem)?;
        let log = |value: f64| (value != 0.0).then(|| value.abs().ln());
        let causes = self.causes.iter();
        Ok(Solution {
            position,
            logs: ByQuantity::new(|quantity| log((quantity.of)(&answer)?.value)),
            caused: causes
                .map(|(cause, _)| cause.caused_by(problem, &answer))
                .collect(),
            difference: ContactTemperature::of(problem)
                .map_or(0.0, |of| of.difference(&answer, problem)),
        })
    }

    /// Slope over a direction at given temperature and strain: a central difference, or a one-sided one at the end of the allowed range.
    /// `None` if no change is allowed.
    fn slope(&self, direction: Direction<'_>) -> Result<Option<Slope>> {
        let solved = |steps: f64| {
            let changed = self.changed(direction, steps)?;
            let point = changed.map(|(problem, position)| self.point(&problem, position));
            point.transpose()
        };
        let [below, above] = [-1.0, 1.0].map(solved);
        let (below, above) = (below?, above?);
        if below.is_none() && above.is_none() {
            return Ok(None);
        }
        let ends = [below, above].map(|end| end.unwrap_or_else(|| self.here.clone()));
        Ok(Some(Slope::between(ends.each_ref())))
    }

    /// Slope over a direction in which temperature and strain follow.
    fn total_slope(&self, direction: Direction<'_>) -> Result<Option<Slope>> {
        let slope = self.slope(direction)?;
        Ok(slope.map(|slope| slope.with_causes_that_follow(0, &self.by_cause)))
    }

    /// Derivatives of an answer with their errors, from the slopes on these and on the coarse elements.
    fn derivatives(&self, [fine, coarse]: [&Slope; 2], answer: &Answer) -> ByQuantity<Estimate> {
        ByQuantity::new(|quantity| {
            quantity.log_change?;
            (quantity.of)(answer).filter(|known| known.error > 0.0 && known.value != 0.0)?;
            let [fine_log, coarse_log] = [fine, coarse].map(|slope| slope.logs.of(quantity.key));
            let (value, coarse_value) = fine_log.zip(coarse_log)?;
            // The change of the distribution acts on no quantity more than a change of the temperature as a whole.
            let by_distribution = self.by_cause.first().map_or(Some(0.0), |by_temperature| {
                Some(by_temperature.logs.of(quantity.key)?.abs() * fine.difference)
            })?;
            let difference = (value - coarse_value).abs() + SLOPE_ROUNDING;
            let error = ERROR_OVER_DIFFERENCE * difference + by_distribution;
            Some(Estimate::new(value, error))
        })
    }
}

impl Slope {
    /// Slope between two points.
    fn between([from, to]: [&Solution; 2]) -> Self {
        let over = |change: f64| change / (to.position - from.position);
        let caused = from.caused.iter().zip(&to.caused);
        Self {
            logs: ByQuantity::new(|quantity| {
                let key = quantity.key;
                Some(over(to.logs.of(key)? - from.logs.of(key)?))
            }),
            caused: caused.map(|(from, to)| over(to - from)).collect(),
            difference: over(from.difference + to.difference),
        }
    }

    /// The slope in which temperature and strain from the place `first` on follow what they cause; `by_cause` has the slopes over these.
    fn with_causes_that_follow(mut self, first: usize, by_cause: &[Self]) -> Self {
        for (place, of_cause) in by_cause.iter().enumerate().rev() {
            let index = first + place;
            // Beyond a slope of one the contact leaves its state, and nothing has a derivative.
            let response = (1.0 - of_cause.caused[index]).max(0.0).recip();
            self = self.plus(of_cause, self.caused[index] * response);
        }
        self
    }

    /// This slope plus a multiple of another.
    fn plus(&self, other: &Self, factor: f64) -> Self {
        let sum = |one: f64, other: f64| one + factor * other;
        let caused = self.caused.iter().zip(&other.caused);
        Self {
            logs: ByQuantity::new(|quantity| {
                let key = quantity.key;
                Some(sum(self.logs.of(key)?, other.logs.of(key)?))
            }),
            caused: caused.map(|(one, other)| sum(*one, *other)).collect(),
            difference: self.difference + factor.abs() * other.difference,
        }
    }
}
