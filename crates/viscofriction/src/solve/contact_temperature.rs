//! The temperature of the contact at which material and shear strength are those that cause it.
//!
//! Material and shear strength have one temperature T. At T the contact dissipates a power that heats it, weighted with the dissipated
//! power, to g(T), and the state is that of the fixed point T = g(T). Where heating increases friction there may be two; a warning names
//! the hotter one.
//!
//! Theory: docs/theory/heat.md, "Back on the material".

use numerics::{Estimate, Progress};

use super::answer::Answer;
use super::contact_strain;
use super::error::{Result, SolveError};
use super::fixed_point::{Caused, FixedPoint, Found, MAX_INCREASE_RATIO, State};
use super::plan::Plan;
use super::problem::Problem;
use super::warning::Warning;

/// Rise above the surroundings from which a second state is looked for if the laws have no highest temperature, \[K]. Chosen: elastomers
/// decompose at smaller ones.
const MAX_RISE: f64 = 500.0;
/// Difference of assumed and caused temperature that counts as none, \[K]. Chosen: no shift law is known so well.
const NEGLIGIBLE_EXCESS: f64 = 1e-3;

/// Temperature of material and shear strength, \[°C].
struct ContactTemperature<'a> {
    problem: &'a Problem,
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
        return contact_strain::solve(first, watch);
    };
    let temperature = ContactTemperature {
        problem,
        ambient,
        highest: problem.highest_temperature(),
    };
    let fixed_point = FixedPoint {
        problem,
        method,
        watch,
        of: &temperature,
    };
    let mut found = fixed_point.solve()?;
    found.answer.temperature_model_spread = temperature.spread(&found, &fixed_point)?;
    let hottest =
        (found.answer.largest_temperature_rise).map_or(ambient, |rise| ambient + rise.value);
    if hottest > temperature.highest {
        found.answer.warnings.push(Warning::HotterThanLaws {
            temperature: hottest,
            highest: temperature.highest,
        });
    }
    let second = found.second.as_ref().map(|hot| Warning::SecondTemperature {
        temperature: hot.value,
        friction_coefficient: hot.friction_coefficient(),
    });
    found.answer.warnings.extend(second);
    found.into_result()
}

impl Caused for ContactTemperature<'_> {
    /// Temperature of the surroundings.
    fn smallest(&self) -> f64 {
        self.ambient
    }

    fn largest(&self) -> f64 {
        self.highest
    }

    fn farthest(&self, found: f64) -> Option<f64> {
        Some(self.ambient + MAX_RISE.max(MAX_INCREASE_RATIO * (found - self.ambient)))
    }

    fn negligible(&self) -> f64 {
        NEGLIGIBLE_EXCESS
    }

    fn problem_at(&self, value: f64) -> Result<Problem> {
        Ok(self.problem.at_temperature(value)?)
    }

    fn solve(&self, plan: Plan, watch: &dyn Progress) -> Result<Answer> {
        contact_strain::solve(plan, watch)
    }

    /// Temperature of the surroundings and rise weighted with the dissipated power.
    fn caused_by(&self, answer: &Answer) -> Estimate {
        let rise = answer.dissipation_weighted_rise;
        rise.map_or(Estimate::exact(self.ambient), |rise| {
            Estimate::new(self.ambient + rise.value, rise.error)
        })
    }

    fn at_fixed_point(&self, answer: Answer, value: Estimate) -> Answer {
        Answer {
            effective_temperature: Some(value),
            ..answer
        }
    }

    fn too_large(&self, state: &State) -> SolveError {
        SolveError::TooHot {
            highest: self.highest,
            ambient: self.ambient,
            caused: state.caused.value,
            friction_coefficient: state.friction_coefficient(),
        }
    }

    fn not_found(&self, [coldest, hottest]: [f64; 2]) -> SolveError {
        SolveError::NoContactTemperature { coldest, hottest }
    }

    fn not_reached(&self, asked: f64, friction: Estimate, temperature: Estimate) -> SolveError {
        SolveError::HeatNotReached {
            asked,
            friction,
            temperature,
        }
    }
}

impl ContactTemperature<'_> {
    /// Largest difference of the friction coefficients at the temperature of the surroundings, with which the material enters the
    /// contact, and at the largest temperature in the contact from that at the fixed point; `None` if they are not known or outside the
    /// range of the laws.
    fn spread(&self, found: &Found, fixed_point: &FixedPoint<'_>) -> Result<Option<Estimate>> {
        let Some(rise) = found.answer.largest_temperature_rise else {
            return Ok(None);
        };
        let hottest = self.ambient + rise.value;
        if hottest > self.highest {
            return Ok(None);
        }
        let hottest = fixed_point.state(hottest, fixed_point.search_accuracy())?;
        let friction = |state: &State| state.answer.friction_coefficient;
        let (Some(known), Some(cold), Some(hot)) = (
            friction(found.near()),
            friction(&found.states[0]),
            friction(&hottest),
        ) else {
            return Ok(None);
        };
        let difference = |other: Estimate| {
            Estimate::new((other.value - known.value).abs(), other.error + known.error)
        };
        let [cold, hot] = [cold, hot].map(difference);
        Ok(Some(if cold.value > hot.value { cold } else { hot }))
    }
}
