//! The temperature of the contact at which material and shear strength are those that cause it.
//!
//! Material and shear strength have one temperature T. At T the contact dissipates a power that heats it, weighted with the dissipated
//! power, to g(T), and the state is that of the fixed point T = g(T). It is searched by coarse solutions, from the temperature of the
//! surroundings upwards, and where heating increases friction, also from the highest known temperature downwards: there may be two. The
//! answer is the colder one, which is reached from rest, and a warning names the other.
//!
//! Theory: docs/theory/heat.md, "Back on the material".

use bem_halfspace::periodic;
use numerics::{ErrorParts, Estimate, Progress};

use super::answer::{Answer, Fields};
use super::body::Body;
use super::error::{Result, SolveError};
use super::plan::Plan;
use super::problem::Problem;
use super::shear::{self, plan_again};
use super::warning::Warning;
use crate::quantity::QUANTITIES;
use crate::scene::{Accuracy, Method};

/// Smallest relative error that is requested of the solutions by which the fixed point of a body is searched. Chosen: the temperature is
/// then known to a twentieth of its rise. Periodic surfaces are solved on their coarsest grids with an error bar.
const SEARCH_ERROR: f64 = 0.05;
/// Fraction of the rise to which the search determines the temperature. Chosen: below the error of its solutions.
const RISE_TOLERANCE: f64 = 0.03;
/// Largest number of solutions of the search in one direction. Derived: every other one halves the bracket at least, to a thousandth of
/// the first rise.
const MAX_SEARCH_SOLUTIONS: usize = 20;
/// Largest ratio of successive rises before the fixed point is bracketed. Chosen.
const MAX_RISE_RATIO: f64 = 4.0;
/// Rise above the surroundings from which a second state is looked for if the laws have no highest temperature, \[K]. Chosen: elastomers
/// decompose at smaller ones.
const MAX_RISE: f64 = 500.0;
/// Number of temperatures above the fixed point at which a second one is looked for. Chosen: the friction of a rubber has half its
/// maximum over twenty kelvin and more.
const SCANNED_TEMPERATURES: u32 = 7;
/// Difference of assumed and caused temperature that counts as none, \[K]. Chosen: no shift law is known so well.
const NEGLIGIBLE_EXCESS: f64 = 1e-3;
/// Smallest distance of two temperatures, as a fraction of the rise, between which slopes are taken. Chosen: over smaller ones the errors
/// of the solutions of the search would be taken for slopes.
const SLOPE_DISTANCE: f64 = 0.1;
/// Factor of safety of the slopes of quantities over the temperature, by which its error widens their bars. Chosen: slopes are those of
/// coarse solutions over a part of the rise.
const SLOPE_SAFETY_FACTOR: f64 = 2.0;
/// Largest number of solutions at the requested accuracy, each at a corrected temperature or with a smaller requested error. Derived:
/// a correction leaves [`RISE_TOLERANCE`] of the one before, and three requests fall by a factor of a hundred.
const MAX_SOLUTIONS: usize = 8;
/// Fraction of the allowed error that the next request aims at, because errors on successive grids scatter about their trend. Chosen, as
/// for shear.
const AIMED_SHARE: f64 = 0.7;
/// Smallest ratio of successive requests. Chosen: errors of the temperature need not fall with the request, and a solution with a far
/// smaller one may be in vain.
const MIN_REQUEST_RATIO: f64 = 0.2;
/// Ratio of the error of a solution to the least one before, above which its smaller request was in vain. Chosen.
const MIN_PROGRESS: f64 = 0.9;
/// Number of requests in vain after which smaller ones are given up. Chosen: one may have led to the grid of the request before, and
/// others to a temperature that was not yet known well.
const MAX_STALLED: usize = 3;

/// The solution with material and shear strength at one temperature.
struct State {
    /// Temperature of material and shear strength, \[°C].
    temperature: f64,
    /// Temperature to which the contact is heated, \[°C].
    caused: f64,
    /// The answer.
    answer: Answer,
    /// Reason why the answer misses the request; `None` if it does not.
    missed: Option<Box<SolveError>>,
}

impl State {
    /// Caused minus assumed temperature, \[K].
    fn excess(&self) -> f64 {
        self.caused - self.temperature
    }
}

/// A problem to be solved at several temperatures.
struct Heated<'a> {
    problem: &'a Problem,
    method: Method,
    watch: &'a dyn Progress,
    /// Temperature far from the contact, \[°C].
    ambient: f64,
    /// Highest temperature at which material and shear strength are known, \[°C].
    highest: f64,
}

/// Solves at the temperature that the answer causes; without heat, and if nothing depends on the temperature, once.
pub(super) fn solve(first: Plan, watch: &dyn Progress) -> Result<Answer> {
    let (problem, method) = (first.problem, first.method);
    let ambient = problem.heating().and_then(|heating| heating.ambient);
    let Some(ambient) = ambient.filter(|_| problem.depends_on_temperature()) else {
        return shear::solve(first, watch);
    };
    let heated = Heated {
        problem,
        method,
        watch,
        ambient,
        highest: problem.highest_temperature(),
    };
    // Search the fixed point by coarse solutions, from both sides.
    let accuracy = match (problem.accuracy(), problem.body()) {
        (Accuracy::RelativeError(_), Body::Periodic(surface)) => {
            Accuracy::Elements(periodic::edge_for_bars(surface))
        }
        (Accuracy::RelativeError(asked), _) => Accuracy::RelativeError(asked.max(SEARCH_ERROR)),
        (elements @ Accuracy::Elements(_), _) => elements,
    };
    let states = heated.search_upwards(accuracy)?;
    let found = &states[states.len() - 1];
    let hot = heated.hotter(&states, accuracy)?;
    // Solve as finely as requested, and complete the answer.
    let (answer, missed) = heated.refined([neighbour(&states, ambient), found])?;
    let spread = heated.spread(&answer, [&states[0], found], accuracy)?;
    let mut answer = Answer {
        temperature_model_spread: spread,
        ..answer
    };
    let hottest = (answer.largest_temperature_rise).map_or(ambient, |rise| ambient + rise.value);
    if hottest > heated.highest {
        answer.warnings.push(Warning::HotterThanLaws {
            temperature: hottest,
            highest: heated.highest,
        });
    }
    answer.warnings.extend(hot.map(|hot| {
        Warning::SecondTemperature {
            temperature: hot.temperature,
            friction_coefficient: hot
                .answer
                .friction_coefficient
                .map(|friction| friction.value),
        }
    }));
    let Some(why) = missed else {
        return Ok(answer);
    };
    answer.not_reached = Some(why.to_string());
    let answer = Box::new(answer);
    Err(SolveError::NotReached { answer, why })
}

impl Heated<'_> {
    /// Solves with material and shear strength at a temperature \[°C].
    fn state(&self, temperature: f64, accuracy: Accuracy) -> Result<State> {
        let near = self
            .problem
            .at_temperature(temperature)?
            .with_accuracy(accuracy);
        let (answer, missed) = match shear::solve(plan_again(&near, self.method)?, self.watch) {
            Ok(answer) => (answer, None),
            Err(SolveError::NotReached { answer, why }) => (*answer, Some(why)),
            Err(other) => return Err(other),
        };
        let rise = answer
            .dissipation_weighted_rise
            .map_or(0.0, |rise| rise.value);
        Ok(State {
            temperature,
            caused: self.ambient + rise,
            answer,
            missed,
        })
    }

    /// The states of the search from the surroundings upwards: the first has their temperature, the last is the fixed point.
    fn search_upwards(&self, accuracy: Accuracy) -> Result<Vec<State>> {
        let cold = self.state(self.ambient, accuracy)?.without_fields();
        let mut next = cold.caused.min(self.highest);
        // Temperature and excess at both ends of the bracket; there is no upper one before a state is colder than it assumes.
        let mut below = [cold.temperature, cold.excess()];
        let mut above: Option<[f64; 2]> = None;
        let mut states = vec![cold];
        for solution in 1..=MAX_SEARCH_SOLUTIONS {
            let state = self.state(next, accuracy)?.without_fields();
            let [temperature, excess] = [state.temperature, state.excess()];
            let rise = temperature - self.ambient;
            let slope = (state.caused - states[0].caused) / rise;
            let is_highest = excess > 0.0 && next >= self.highest;
            let is_hot = is_highest && excess > NEGLIGIBLE_EXCESS;
            states.push(state);
            if is_hot {
                return Err(self.too_hot(&states[states.len() - 1]));
            }
            if excess > 0.0 {
                below = [temperature, excess];
            } else {
                above = Some([temperature, excess]);
            }
            // Correct the temperature along the secant of the bracket, or upwards before there is one.
            let (correction, other) = match above {
                Some(above) => {
                    let along_secant = excess * (above[0] - below[0]) / (below[1] - above[1]);
                    (along_secant, 0.5 * (below[0] + above[0]))
                }
                None if slope < 1.0 => (excess / (1.0 - slope), self.highest),
                None => (f64::INFINITY, self.highest),
            };
            // A small correction alone is no proof: where friction falls steeply, secants over a wide bracket are far too steep.
            let width = above.map_or(f64::INFINITY, |above| above[0] - below[0]);
            if excess.abs().min(width) <= RISE_TOLERANCE * rise || rise <= 0.0 || is_highest {
                return Ok(states);
            }
            // Every other step halves the bracket, which secants of a convex function shrink from one side only.
            let is_halved = above.is_some() && solution.is_multiple_of(2);
            let limited = correction.min((MAX_RISE_RATIO - 1.0) * rise);
            next = if is_halved {
                other
            } else {
                temperature + limited
            };
            next = next.min(self.highest);
        }
        Err(SolveError::NoContactTemperature {
            coldest: below[0],
            hottest: above.map_or(next, |above| above[0]),
        })
    }

    /// The error for a contact that is heated beyond the highest temperature of the laws.
    fn too_hot(&self, state: &State) -> SolveError {
        SolveError::TooHot {
            highest: self.highest,
            ambient: self.ambient,
            caused: state.caused,
            friction_coefficient: state
                .answer
                .friction_coefficient
                .map(|friction| friction.value),
        }
    }

    /// A state near a fixed point that is hotter than the one found from below; `None` if there is none.
    ///
    /// A second one needs a friction that grows with temperature. Friction has one maximum over it, so that there is none if friction
    /// falls up to the first one.
    fn hotter(&self, states: &[State], accuracy: Accuracy) -> Result<Option<State>> {
        let [cold, found] = [&states[0], &states[states.len() - 1]];
        let rise = found.temperature - self.ambient;
        if found.caused <= cold.caused || rise <= 0.0 {
            return Ok(None);
        }
        // Look from the highest temperature downwards for one that the contact would exceed, in geometric steps of the rise.
        let highest = self
            .highest
            .min(self.ambient + MAX_RISE.max(MAX_RISE_RATIO * rise));
        let ratio =
            (rise / (highest - self.ambient)).powf((f64::from(SCANNED_TEMPERATURES)).recip());
        let mut hotter = highest;
        let mut colder = None;
        for step in 0..SCANNED_TEMPERATURES {
            let rise = (highest - self.ambient) * ratio.powi(step.cast_signed());
            // The sum may exceed the highest temperature by rounding.
            let temperature = (self.ambient + rise).min(highest);
            let state = self.state(temperature, accuracy)?.without_fields();
            if state.excess() >= 0.0 {
                colder = Some(state);
                break;
            }
            hotter = temperature;
        }
        let Some(mut colder) = colder else {
            return Ok(None);
        };
        // Halve the bracket to about the accuracy of the search.
        while hotter - colder.temperature > SLOPE_DISTANCE * (hotter - self.ambient) {
            let middle = 0.5 * (colder.temperature + hotter);
            let state = self.state(middle, accuracy)?.without_fields();
            if state.excess() >= 0.0 {
                colder = state;
            } else {
                hotter = middle;
            }
        }
        Ok(Some(colder))
    }

    /// The answer at the fixed point as finely as requested, and the reason if it misses the request. `near` are the states of the search
    /// at another temperature, for slopes, and at the fixed point.
    fn refined(&self, near: [&State; 2]) -> Result<(Answer, Option<Box<SolveError>>)> {
        let [neighbour, found] = near;
        let asked = match self.problem.accuracy() {
            Accuracy::RelativeError(asked) => Some(asked),
            Accuracy::Elements(_) => None,
        };
        let mut accuracy = self.problem.accuracy();
        let mut response = response([neighbour.point(), found.point()]);
        let mut temperature = self.within(found.temperature + response * found.excess());
        let mut before: Option<State> = None;
        let mut least = f64::INFINITY;
        let mut stalled = 0;
        let mut solutions = 0;
        loop {
            solutions += 1;
            let state = self.state(temperature, accuracy)?;
            // Two solutions at the requested accuracy tell the response better than those of the search.
            let distance = SLOPE_DISTANCE * RISE_TOLERANCE * (temperature - self.ambient);
            let is_far = |before: &&State| (before.temperature - temperature).abs() > distance;
            let far = before.as_ref().filter(is_far);
            if let Some(before) = far {
                response = self::response([before.point(), state.point()]);
            }
            let correction = response * state.excess();
            let allowed_correction = RISE_TOLERANCE * (temperature - self.ambient);
            let is_settled = correction.abs() <= allowed_correction.max(NEGLIGIBLE_EXCESS);
            // Slopes between two such solutions are nearer to the fixed point.
            let numbers = state.numbers();
            let slopes_from = [far.map_or(near, |before| [before, &numbers]), near];
            let State { answer, missed, .. } = state;
            let rise = answer.dissipation_weighted_rise;
            let unknown = response * rise.map_or(0.0, |rise| rise.error);
            let effective = Estimate::new(temperature, correction.abs() + unknown);
            let answer = Answer {
                effective_temperature: Some(effective),
                ..widened(answer, slopes_from, effective.error)
            };
            let Some(friction) = answer.friction_coefficient else {
                return Ok((answer, missed));
            };
            let by_correction = largest_slope(slopes_from, |answer| answer.friction_coefficient)
                .map_or(0.0, |slope| slope * correction.abs());
            before = Some(numbers);
            let Some(asked) = asked else {
                // With given elements the temperature is corrected until that changes little.
                if by_correction <= RISE_TOLERANCE * friction.error || solutions == MAX_SOLUTIONS {
                    return Ok((answer, missed));
                }
                temperature = self.within(temperature + correction);
                continue;
            };
            let allowed = asked * friction.value.abs();
            if friction.error <= allowed && is_settled {
                return Ok((answer, None));
            }
            // Request a smaller error if the correction of the temperature alone does not suffice, as long as that helps.
            let others = friction.error - by_correction;
            if others > MIN_PROGRESS * least {
                stalled += 1;
            }
            let is_given_up = stalled == MAX_STALLED && others > allowed;
            if missed.is_some() || solutions == MAX_SOLUTIONS || is_given_up {
                let missed = SolveError::HeatNotReached {
                    asked,
                    friction,
                    temperature: effective,
                };
                return Ok((answer, Some(Box::new(missed))));
            }
            temperature = self.within(temperature + correction);
            if others > AIMED_SHARE * allowed
                && let Accuracy::RelativeError(request) = accuracy
            {
                let is_in_vain = others > MIN_PROGRESS * least;
                least = least.min(others);
                let ratio = if is_in_vain {
                    MIN_REQUEST_RATIO
                } else {
                    (AIMED_SHARE * allowed / others).max(MIN_REQUEST_RATIO)
                };
                accuracy = Accuracy::RelativeError(request * ratio);
            }
        }
    }

    /// The temperature \[°C], or the end of the range from the surroundings to the highest one.
    const fn within(&self, temperature: f64) -> f64 {
        temperature.clamp(self.ambient, self.highest)
    }

    /// Largest difference of the friction coefficients at the temperature of the surroundings, with which the material enters the
    /// contact, and at the largest temperature in the contact from that at the fixed point; `None` if they are not known or outside the
    /// range of the laws.
    fn spread(
        &self,
        answer: &Answer,
        [cold, found]: [&State; 2],
        accuracy: Accuracy,
    ) -> Result<Option<Estimate>> {
        let Some(rise) = answer.largest_temperature_rise else {
            return Ok(None);
        };
        let hottest = self.ambient + rise.value;
        if hottest > self.highest {
            return Ok(None);
        }
        let hottest = self.state(hottest, accuracy)?;
        let friction = |state: &State| state.answer.friction_coefficient;
        let (Some(known), Some(cold), Some(hot)) =
            (friction(found), friction(cold), friction(&hottest))
        else {
            return Ok(None);
        };
        let difference = |other: Estimate| {
            Estimate::new((other.value - known.value).abs(), other.error + known.error)
        };
        let [cold, hot] = [cold, hot].map(difference);
        Ok(Some(if cold.value > hot.value { cold } else { hot }))
    }
}

impl State {
    /// The numbers of the state, without its fields and the reason why it misses a request.
    fn numbers(&self) -> Self {
        Self {
            temperature: self.temperature,
            caused: self.caused,
            answer: Answer {
                fields: Fields::default(),
                ..self.answer.clone()
            },
            missed: None,
        }
    }

    /// Assumed and caused temperature, \[°C].
    const fn point(&self) -> [f64; 2] {
        [self.temperature, self.caused]
    }

    /// The state without the fields of its answer, of which only numbers are needed.
    fn without_fields(mut self) -> Self {
        self.answer.fields = Fields::default();
        self
    }
}

/// The state next to the last one that is not closer than [`SLOPE_DISTANCE`]; the first one, at the temperature of the surroundings
/// `ambient` \[°C], if all are closer.
fn neighbour(states: &[State], ambient: f64) -> &State {
    let found = &states[states.len() - 1];
    let distance = |state: &&State| (state.temperature - found.temperature).abs();
    let least = SLOPE_DISTANCE * (found.temperature - ambient);
    let far = states.iter().filter(|state| distance(state) >= least);
    far.min_by(|left, right| distance(left).total_cmp(&distance(right)))
        .unwrap_or(&states[0])
}

/// Change of the temperature per excess of the caused temperature by which the excess is removed, from two pairs of assumed and caused
/// temperatures \[°C].
fn response([one, other]: [[f64; 2]; 2]) -> f64 {
    let distance = other[0] - one[0];
    let slope = if distance == 0.0 {
        0.0
    } else {
        (other[1] - one[1]) / distance
    };
    1.0 / (1.0 - slope).max(RISE_TOLERANCE)
}

/// Bound of the absolute slope of a quantity over the temperature between two states, in the unit of the quantity per K; `None` if it
/// is not known, and zero for states of the same temperature.
fn slope_of(
    [one, other]: [&State; 2],
    quantity: impl Fn(&Answer) -> Option<Estimate>,
) -> Option<f64> {
    let change = quantity(&other.answer)?.value - quantity(&one.answer)?.value;
    let distance = (other.temperature - one.temperature).abs();
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

/// The answer with the errors of all quantities widened by that of the temperature \[K]; pairs of states give their slopes.
fn widened(mut answer: Answer, states: [[&State; 2]; 2], error: f64) -> Answer {
    let of_friction =
        largest_slope(states, |answer| answer.friction_coefficient).unwrap_or_default();
    let part = ErrorParts::discretisation_only(of_friction * error);
    answer.error_parts = answer.error_parts.plus(part);
    for quantity in &QUANTITIES {
        let slope = largest_slope(states, quantity.of);
        if let (Some(field), Some(slope)) = (quantity.field, slope)
            && let Some(known) = field(&mut answer)
        {
            *known = known.widened(slope * error);
        }
    }
    answer
}
