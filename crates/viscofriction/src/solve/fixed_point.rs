//! Answers that change the problem which they answer: friction heats the contact and strains the material, and temperature and strain
//! change its moduli.
//!
//! The problem depends on a value x, such as the temperature. At x the contact causes the value g(x), and the state is that of the fixed
//! point x = g(x). It is searched by coarse solutions, from the smallest value upwards, and where g grows with x, also from the largest
//! one downwards: there may be two. The answer is the lower one, which is reached from rest.
//!
//! Theory: docs/theory/heat.md, "Back on the material", and docs/theory/strain.md, "The fixed point".

use numerics::{ErrorParts, Estimate, Progress};

use super::answer::{Answer, Fields};
use super::error::{Result, SolveError};
use super::period_grids::PeriodGrids;
use super::plan::Plan;
use super::problem::Problem;
use super::shear::plan_again;
use super::solved::Solved;
use crate::quantity::QUANTITIES;
use crate::scene::{Accuracy, Method};

/// Smallest relative error that is requested of the solutions by which the fixed point of a body is searched. Chosen: the value is then
/// known to about a twentieth. Periodic surfaces are solved on their coarsest grids with an error bar.
const SEARCH_ERROR: f64 = 0.05;
/// Fraction of the increase above the smallest value to which the search determines the fixed point. Chosen: below the error of its
/// solutions.
const TOLERANCE: f64 = 0.03;
/// Largest number of solutions of the search in one direction. Derived: every other one halves the bracket at least, to a thousandth of
/// the first increase.
const MAX_SEARCH_SOLUTIONS: usize = 20;
/// Largest ratio of successive increases before the fixed point is bracketed. Chosen.
pub(super) const MAX_INCREASE_RATIO: f64 = 4.0;
/// Number of values above the fixed point at which a second one is looked for. Chosen: the friction of a rubber has half its maximum over
/// twenty kelvin and more, and over a decade of strain.
const SCANNED_VALUES: u32 = 7;
/// Ratio of an assumed increase to the one that a faster problem causes, from which there is no fixed point. Chosen: filled rubber softens
/// by a factor of a few.
const SCREENING_RATIO: f64 = 10.0;
/// Smallest distance of two values, as a fraction of the increase, between which slopes are taken. Chosen: over smaller ones the errors
/// of the solutions of the search would be taken for slopes.
const SLOPE_DISTANCE: f64 = 0.1;
/// Largest distance of the states between which slopes are taken, as a fraction of the increase, unless the problem hardly changes between
/// them. Chosen: friction has one maximum over the value, and may be the same at both ends of the increase.
const FARTHEST_NEIGHBOUR: f64 = 0.5;
/// Distance of a state that is solved for slopes alone, as a fraction of the increase. Chosen between [`SLOPE_DISTANCE`] and
/// [`FARTHEST_NEIGHBOUR`].
const NEIGHBOUR_DISTANCE: f64 = 0.2;
/// Factor of safety of the slopes of quantities over the value, by which its error widens their bars. Chosen: slopes are those of coarse
/// solutions over a part of the increase.
const SLOPE_SAFETY_FACTOR: f64 = 2.0;
/// Largest number of solutions at the requested accuracy, each at a corrected value or with a smaller requested error. Derived: a
/// correction leaves [`TOLERANCE`] of the one before, and three requests fall by a factor of a hundred.
const MAX_SOLUTIONS: usize = 8;
/// Fraction of the allowed error that the next request aims at, because errors on successive grids scatter about their trend. Chosen, as
/// for shear.
const AIMED_SHARE: f64 = 0.7;
/// Smallest ratio of successive requests. Chosen: errors of the value need not fall with the request, and a solution with a far smaller
/// one may not improve the value.
const MIN_REQUEST_RATIO: f64 = 0.2;
/// Ratio of the error of a solution to the smallest one before, above which its smaller request made no progress. Chosen.
const MIN_PROGRESS: f64 = 0.9;
/// Number of requests without progress after which smaller ones are given up. Chosen: one may have led to the grid of the request before, and
/// others to a value that was not yet known well.
const MAX_STALLED: usize = 3;

/// A value x on which the problem depends and which its answer determines as g(x), such as the temperature of the contact. The state of the
/// contact is the fixed point x = g(x).
pub(super) trait SelfConsistent {
    /// Lower bound of the value: that of a contact without friction or strain.
    fn lower_bound(&self) -> f64;

    /// Upper bound of the value, above which the laws of the material are not known; infinite if they are known at all values.
    fn upper_bound(&self) -> f64;

    /// Value up to which a second fixed point above the first one, `found`, is looked for; `None` if there can be no second one.
    fn farthest(&self, found: f64) -> Option<f64>;

    /// This value in a problem that is solved faster; near an answer it causes values that differ by a factor far below [`SCREENING_RATIO`].
    /// `None` if there is none.
    fn faster_near(&self, _answer: &Answer) -> Option<Box<dyn SelfConsistent + '_>> {
        None
    }

    /// Whether the problem changes so little between two values that quantities are taken to be monotone in between.
    fn is_narrow(&self, from: f64, to: f64) -> bool;

    /// Largest difference of assumed and caused value that counts as zero.
    fn negligible(&self) -> f64;

    /// The problem at a value. If that stands for a distribution, it is the one that the answer `near` causes, scaled; without such an
    /// answer it is uniform.
    fn problem_at(&self, value: f64, near: Option<&Answer>) -> Result<Problem>;

    /// Solves the problem at a value for everything else.
    fn solve(&self, plan: Plan, watch: &dyn Progress) -> Result<Answer>;

    /// The value that an answer causes.
    fn caused_by(&self, answer: &Answer) -> Estimate;

    /// Mean difference between the distribution that the answer to a problem causes and the one that the problem assumes, if the value
    /// stands for one.
    fn difference(&self, _answer: &Answer, _problem: &Problem) -> f64 {
        0.0
    }

    /// Errors of the value that a state causes.
    fn errors(&self, state: &State) -> ValueErrors {
        ValueErrors {
            of_material: state.caused.error,
            of_shear: state.caused.error,
        }
    }

    /// The answer at the fixed point, with that value, and its error as it acts on the material.
    fn at_fixed_point(&self, answer: Answer, value: Estimate, error_of_material: f64) -> Answer;

    /// The error for a fixed point above the largest value, with the state at the largest value.
    fn too_large(&self, state: &State) -> SolveError;

    /// The error for a search that ended between two values.
    fn not_found(&self, between: [f64; 2]) -> SolveError;

    /// The error for a friction coefficient that misses the relative error asked for.
    fn not_reached(&self, asked: f64, friction: Estimate, value: Estimate) -> SolveError;
}

/// Errors of a value as they act on the answer.
#[derive(Debug, Clone, Copy)]
pub(super) struct ValueErrors {
    /// Error for quantities that follow the material.
    pub(super) of_material: f64,
    /// Error for the shear strength.
    pub(super) of_shear: f64,
}

/// The solution of the problem at one value.
pub(super) struct State {
    /// The value.
    pub(super) value: f64,
    /// The value that the answer causes; its error contains the difference of distributions.
    pub(super) caused: Estimate,
    /// Mean difference between the caused and the assumed distribution.
    pub(super) difference: f64,
    /// The answer.
    pub(super) answer: Answer,
    /// Reason why the answer misses the request; `None` if it does not.
    missed: Option<Box<SolveError>>,
}

/// A problem that is solved at several values.
pub(super) struct FixedPoint<'a> {
    /// The problem at any value.
    pub(super) problem: &'a Problem,
    /// Method of the solutions.
    pub(super) method: Method,
    /// Progress of all solutions.
    pub(super) watch: &'a dyn Progress,
    /// The value whose fixed point is searched.
    pub(super) of: &'a dyn SelfConsistent,
}

/// The fixed point of a problem.
pub(super) struct Found {
    /// The answer at the fixed point.
    pub(super) answer: Answer,
    /// Reason why the answer misses the request; `None` if it does not.
    missed: Option<Box<SolveError>>,
    /// States of the search, from the smallest value to the fixed point.
    pub(super) states: Vec<State>,
    /// A state near a fixed point at a larger value; `None` if there is none.
    pub(super) second: Option<State>,
}

impl ValueErrors {
    /// The errors of a value with a response to what it causes, and with a correction that is left.
    fn within(self, response: f64, correction: f64) -> Self {
        let [of_material, of_shear] =
            [self.of_material, self.of_shear].map(|error| response * error + correction);
        Self {
            of_material,
            of_shear,
        }
    }
}

impl Found {
    /// The answer, as an error if it misses the request.
    pub(super) fn into_result(self) -> Result<Answer> {
        let Some(why) = self.missed else {
            return Ok(Answer {
                not_reached: None,
                ..self.answer
            });
        };
        let not_reached = Some(why.to_string());
        let answer = Box::new(Answer {
            not_reached,
            ..self.answer
        });
        Err(SolveError::NotReached { answer, why })
    }

    /// The last state of the search, near the fixed point.
    pub(super) fn near(&self) -> &State {
        &self.states[self.states.len() - 1]
    }
}

impl State {
    /// Friction coefficient of the state; `None` if it is not known.
    pub(super) fn friction_coefficient(&self) -> Option<f64> {
        self.answer
            .friction_coefficient
            .map(|friction| friction.value)
    }

    /// SelfConsistent minus assumed value.
    fn excess(&self) -> f64 {
        self.caused.value - self.value
    }

    /// The numbers of the state, without its fields and the reason why it misses a request.
    fn numbers(&self) -> Self {
        Self {
            value: self.value,
            caused: self.caused,
            difference: self.difference,
            answer: Answer {
                fields: Fields::default(),
                ..self.answer.clone()
            },
            missed: None,
        }
    }

    /// Assumed and caused value.
    fn point(&self) -> [f64; 2] {
        [self.value, self.caused.value]
    }

    /// The state without the fields of its answer, of which only numbers are needed.
    fn without_fields(mut self) -> Self {
        self.answer.fields = Fields::default();
        self
    }
}

impl FixedPoint<'_> {
    /// The fixed point, with the answer there as finely as requested.
    pub(super) fn solve(&self) -> Result<Found> {
        let accuracy = self.search_accuracy();
        let states = self.with_neighbour(self.search_upwards(accuracy)?, accuracy)?;
        let second = self.second(&states, accuracy)?;
        let found = &states[states.len() - 1];
        let (answer, missed) = self.refined([self.neighbour(&states), found])?;
        Ok(Found {
            answer,
            missed,
            states,
            second,
        })
    }

    /// Accuracy of the solutions of the search.
    pub(super) fn search_accuracy(&self) -> Accuracy {
        match (
            self.problem.accuracy(),
            PeriodGrids::of(self.problem).take(),
        ) {
            (Accuracy::RelativeError(_), Some(coarsest)) => coarsest,
            (Accuracy::RelativeError(asked), None) => {
                Accuracy::RelativeError(asked.max(SEARCH_ERROR))
            }
            (elements @ Accuracy::Elements(_), _) => elements,
        }
    }

    /// Solves at a value to an accuracy, with the distribution of the answer `near` or a uniform one.
    pub(super) fn state(
        &self,
        value: f64,
        near: Option<&Answer>,
        accuracy: Accuracy,
    ) -> Result<State> {
        let problem = self.of.problem_at(value, near)?.with_accuracy(accuracy);
        let plan = plan_again(&problem, self.method)?;
        let Solved { answer, missed } = Solved::of(self.of.solve(plan, self.watch))?;
        let difference = self.of.difference(&answer, &problem);
        Ok(State {
            value,
            caused: self.of.caused_by(&answer).widened(difference),
            difference,
            answer,
            missed,
        })
    }

    /// The states of the search upwards: the first has the smallest value, the last is the fixed point.
    fn search_upwards(&self, accuracy: Accuracy) -> Result<Vec<State>> {
        let [smallest, largest] = [self.of.lower_bound(), self.of.upper_bound()];
        let first = self.state(smallest, None, accuracy)?.without_fields();
        let mut next = first.caused.value.min(largest);
        // Value and excess at both ends of the bracket; there is no upper one before a state causes less than it assumes.
        let mut below = [first.value, first.excess()];
        let mut above: Option<[f64; 2]> = None;
        let mut states = vec![first];
        for solution in 1..=MAX_SEARCH_SOLUTIONS {
            let near = states.last().map(|state| &state.answer);
            let state = self.state(next, near, accuracy)?.without_fields();
            let [value, excess] = [state.value, state.excess()];
            let increase = value - smallest;
            let slope = (state.caused.value - states[0].caused.value) / increase;
            let is_largest = excess > 0.0 && next >= largest;
            let is_too_large = is_largest && excess > self.of.negligible();
            states.push(state);
            if is_too_large {
                return Err(self.of.too_large(&states[states.len() - 1]));
            }
            if excess > 0.0 {
                below = [value, excess];
            } else {
                above = Some([value, excess]);
            }
            // Correct the value along the secant of the bracket, or upwards before there is one.
            let (correction, other) = match above {
                Some(above) => {
                    let along_secant = excess * (above[0] - below[0]) / (below[1] - above[1]);
                    (along_secant, 0.5 * (below[0] + above[0]))
                }
                None if slope < 1.0 => (excess / (1.0 - slope), largest),
                None => (f64::INFINITY, largest),
            };
            // A small correction alone is no proof: where the caused value falls steeply, secants over a wide bracket are far too steep.
            let width = above.map_or(f64::INFINITY, |above| above[0] - below[0]);
            if excess.abs().min(width) <= TOLERANCE * increase || increase <= 0.0 || is_largest {
                return Ok(states);
            }
            // Every other step halves the bracket, which secants of a convex function shrink from one side only.
            let is_halved = above.is_some() && solution.is_multiple_of(2);
            let limited = correction.min((MAX_INCREASE_RATIO - 1.0) * increase);
            next = if is_halved { other } else { value + limited };
            next = next.min(largest);
        }
        Err(self
            .of
            .not_found([below[0], above.map_or(next, |above| above[0])]))
    }

    /// The states of the search with one near the fixed point, unless they have it: between states that are far apart quantities may have
    /// extrema, so that slopes over the value do not follow from them.
    fn with_neighbour(&self, mut states: Vec<State>, accuracy: Accuracy) -> Result<Vec<State>> {
        let found = &states[states.len() - 1];
        let increase = found.value - self.of.lower_bound();
        let neighbour = self.neighbour(&states).value;
        let is_near = (neighbour - found.value).abs() <= FARTHEST_NEIGHBOUR * increase;
        if is_near || self.of.is_narrow(neighbour, found.value) {
            return Ok(states);
        }
        let value = found.value - NEIGHBOUR_DISTANCE * increase;
        let state = self.state(value, Some(&found.answer), accuracy)?;
        states.insert(states.len() - 1, state.without_fields());
        Ok(states)
    }

    /// A state near a fixed point at a larger value than the one found from below; `None` if there is none.
    ///
    /// A second one needs a caused value that grows with the value. It is taken to have one maximum, so that there is no second one if
    /// it falls up to the first one.
    fn second(&self, states: &[State], accuracy: Accuracy) -> Result<Option<State>> {
        let smallest = self.of.lower_bound();
        let [first, found] = [&states[0], &states[states.len() - 1]];
        let increase = found.value - smallest;
        if found.caused.value <= first.caused.value || increase <= 0.0 {
            return Ok(None);
        }
        let Some(farthest) = self.of.farthest(found.value) else {
            return Ok(None);
        };
        // Look from the largest value downwards for one that the contact would exceed, in geometric steps of the increase.
        let largest = self.of.upper_bound().min(farthest);
        let ratio = (increase / (largest - smallest)).powf((f64::from(SCANNED_VALUES)).recip());
        let mut upper = largest;
        let mut lower = None;
        let mut near = found.answer.clone();
        let faster = self.of.faster_near(&near);
        for step in 0..SCANNED_VALUES {
            let increase = (largest - smallest) * ratio.powi(step.cast_signed());
            // The sum may exceed the largest value by rounding.
            let value = (smallest + increase).min(largest);
            if let Some(of) = faster.as_deref() {
                let state = FixedPoint { of, ..*self }.state(value, Some(&near), accuracy)?;
                if SCREENING_RATIO * (state.caused.value - smallest) < increase {
                    upper = value;
                    continue;
                }
            }
            let state = self.state(value, Some(&near), accuracy)?.without_fields();
            if state.excess() >= 0.0 {
                lower = Some(state);
                break;
            }
            upper = value;
            near = state.answer;
        }
        let Some(mut lower) = lower else {
            return Ok(None);
        };
        // Halve the bracket to about the accuracy of the search.
        while upper - lower.value > SLOPE_DISTANCE * (upper - smallest) {
            let middle = 0.5 * (lower.value + upper);
            let state = self
                .state(middle, Some(&lower.answer), accuracy)?
                .without_fields();
            if state.excess() >= 0.0 {
                lower = state;
            } else {
                upper = middle;
            }
        }
        Ok(Some(lower))
    }

    /// The answer at the fixed point as finely as requested, and the reason if it misses the request. `near` are the states of the search
    /// at another value, for slopes, and at the fixed point.
    fn refined(&self, near: [&State; 2]) -> Result<(Answer, Option<Box<SolveError>>)> {
        let [neighbour, found] = near;
        let asked = match self.problem.accuracy() {
            Accuracy::RelativeError(asked) => Some(asked),
            Accuracy::Elements(_) => None,
        };
        // Coarse grids of a periodic surface suffice for a friction that is mostly shear.
        let is_mostly_shear = asked.is_some() && found.answer.is_mostly_shear();
        let mut grids = PeriodGrids::of(self.problem);
        let coarsest = grids.take().filter(|_| is_mostly_shear);
        let mut accuracy = coarsest.unwrap_or(self.problem.accuracy());
        let mut response = response([neighbour.point(), found.point()]);
        let mut value = self.within(found.value + response * found.excess());
        let mut shape = found.answer.clone();
        let mut before: Option<State> = None;
        let mut least = f64::INFINITY;
        let mut stalled = 0;
        let mut solutions = 0;
        loop {
            solutions += 1;
            let state = self.state(value, Some(&shape), accuracy)?;
            // Two solutions at the requested accuracy tell the response better than those of the search.
            let increase = value - self.of.lower_bound();
            let distance = SLOPE_DISTANCE * TOLERANCE * increase;
            // Between states whose distributions differ more than their values, changes are no slopes over the value.
            let is_far = |before: &&State| {
                (before.value - value).abs() > distance.max(before.difference + state.difference)
            };
            let far = before.as_ref().filter(is_far);
            if let Some(before) = far {
                response = self::response([before.point(), state.point()]);
            }
            let correction = response * state.excess();
            let is_settled = correction.abs() <= (TOLERANCE * increase).max(self.of.negligible());
            // Slopes between two such solutions are nearer to the fixed point.
            let numbers = state.numbers();
            let errors = self.of.errors(&state);
            let slopes_from = [far.map_or(near, |before| [before, &numbers]), near];
            let State {
                answer,
                missed,
                caused,
                difference,
                ..
            } = state;
            let known = Estimate::new(value, correction.abs() + response * caused.error);
            let errors = errors.within(response, correction.abs());
            let answer = widened(answer, slopes_from, errors);
            let answer = self.of.at_fixed_point(answer, known, errors.of_material);
            let Some(friction) = answer.friction_coefficient else {
                return Ok((answer, missed));
            };
            let by_correction = largest_slope(slopes_from, |answer| answer.friction_coefficient)
                .map_or(0.0, |slope| slope * correction.abs());
            shape.clone_from(&numbers.answer);
            before = Some(numbers);
            let Some(asked) = asked else {
                // With given elements the value is corrected until that changes little.
                if by_correction <= TOLERANCE * friction.error || solutions == MAX_SOLUTIONS {
                    return Ok((answer, missed));
                }
                value = self.within(value + correction);
                continue;
            };
            let allowed = asked * friction.value.abs();
            if friction.error <= allowed && is_settled {
                return Ok((answer, None));
            }
            // Request a smaller error if the correction of the value alone does not suffice, as long as that helps.
            let others = friction.error - by_correction;
            if others > MIN_PROGRESS * least {
                stalled += 1;
            }
            let is_given_up = stalled == MAX_STALLED && others > allowed;
            if missed.is_some() || solutions == MAX_SOLUTIONS || is_given_up {
                let missed = self.of.not_reached(asked, friction, known);
                return Ok((answer, Some(Box::new(missed))));
            }
            value = self.within(value + correction);
            // A distribution that has not settled is solved for again, and not more finely.
            let is_settling = response * difference > 0.5 * known.error;
            if others <= AIMED_SHARE * allowed || is_settling {
                continue;
            }
            // Changes from grid to grid are no slopes over the value.
            before = None;
            accuracy = match accuracy {
                Accuracy::Elements(_) => {
                    let without_correction = Estimate::new(friction.value, others);
                    grids.leave_out_if_too_coarse(without_correction, allowed);
                    grids.take().unwrap_or(self.problem.accuracy())
                }
                Accuracy::RelativeError(request) => {
                    let is_in_vain = others > MIN_PROGRESS * least;
                    least = least.min(others);
                    let ratio = if is_in_vain {
                        MIN_REQUEST_RATIO
                    } else {
                        (AIMED_SHARE * allowed / others).max(MIN_REQUEST_RATIO)
                    };
                    Accuracy::RelativeError(request * ratio)
                }
            };
        }
    }

    /// The value, or the end of the range from the smallest to the largest one.
    fn within(&self, value: f64) -> f64 {
        value.clamp(self.of.lower_bound(), self.of.upper_bound())
    }

    /// The state next to the last one that is not closer than [`SLOPE_DISTANCE`]; the first one if all are closer.
    fn neighbour<'s>(&self, states: &'s [State]) -> &'s State {
        let found = &states[states.len() - 1];
        let distance = |state: &&State| (state.value - found.value).abs();
        let least = SLOPE_DISTANCE * (found.value - self.of.lower_bound());
        let far = states.iter().filter(|state| distance(state) >= least);
        far.min_by(|left, right| distance(left).total_cmp(&distance(right)))
            .unwrap_or(&states[0])
    }
}

/// Change of the value per excess of the caused value by which the excess is removed, from two pairs of assumed and caused values.
fn response([one, other]: [[f64; 2]; 2]) -> f64 {
    let distance = other[0] - one[0];
    let slope = if distance == 0.0 {
        0.0
    } else {
        (other[1] - one[1]) / distance
    };
    1.0 / (1.0 - slope).max(TOLERANCE)
}

/// Bound of the absolute slope of a quantity over the value between two states; `None` if it is not known, and zero for states of the
/// same value.
fn slope_of(
    [one, other]: [&State; 2],
    quantity: impl Fn(&Answer) -> Option<Estimate>,
) -> Option<f64> {
    let change = quantity(&other.answer)?.value - quantity(&one.answer)?.value;
    let distance = (other.value - one.value).abs();
    Some(if distance > 0.0 {
        SLOPE_SAFETY_FACTOR * change.abs() / distance
    } else {
        0.0
    })
}

/// The larger of the slopes of two pairs of states.
fn largest_slope(
    [one, other]: [[&State; 2]; 2],
    quantity: impl Fn(&Answer) -> Option<Estimate>,
) -> Option<f64> {
    Some(slope_of(one, &quantity)?.max(slope_of(other, &quantity)?))
}

/// The answer with the errors of all quantities widened by those of the value; pairs of states give their slopes.
fn widened(mut answer: Answer, states: [[&State; 2]; 2], errors: ValueErrors) -> Answer {
    let slope = |of: fn(&Answer) -> Option<Estimate>| largest_slope(states, of).unwrap_or_default();
    let ratio = |known: Option<Estimate>, to: Option<Estimate>| match (known, to) {
        (Some(known), Some(to)) if to.value != 0.0 => (known.value / to.value).abs(),
        _ => 0.0,
    };
    // Shear follows its strength, and the material as the contact area does; the temperature of the contact follows friction and area.
    let known = answer.clone();
    let of_area = slope(|answer| answer.contact_area) * errors.of_material;
    let of_shear = slope(|answer| answer.friction_from_shear) * errors.of_shear
        + ratio(known.friction_from_shear, known.contact_area) * of_area;
    let of_friction = of_shear + slope(Answer::hysteresis) * errors.of_material;
    for quantity in &QUANTITIES {
        let slope = largest_slope(states, quantity.of);
        if let (Some(field), Some(slope)) = (quantity.field, slope)
            && let Some(value) = field(&mut answer)
        {
            *value = value.widened(match quantity.key {
                "friction_coefficient" => of_friction,
                "friction_from_shear" => of_shear,
                "largest_temperature_rise" | "mean_temperature_rise" => {
                    of_friction * ratio(Some(*value), known.friction_coefficient)
                        + of_area * ratio(Some(*value), known.contact_area)
                }
                _ => slope * errors.of_material,
            });
        }
    }
    answer.error_parts = (answer.error_parts).plus(ErrorParts::discretisation_only(of_friction));
    answer
}
