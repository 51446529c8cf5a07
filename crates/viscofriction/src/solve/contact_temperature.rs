//! The temperature of the contact at which material and shear strength are those that cause it.
//!
//! Material and shear strength have one temperature T. At T the contact dissipates a power that heats it, weighted with the dissipated
//! power, to g(T), and the state is that of the fixed point T = g(T). Where heating increases friction there may be two; a warning names
//! the hotter one.
//!
//! Theory: docs/theory/heat.md, "Back on the material".

use bem_halfspace::heat::DepthProfile;
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
/// Range of temperatures over which material and shear strength change little, \[K]. Chosen: by the universal constants of WLF 3 K change
/// times by a factor of 1.8 at 50 K above the glass transition.
const NARROW_RANGE: f64 = 3.0;
/// Difference of assumed and caused temperature that counts as none, \[K]. Chosen: no shift law is known so well.
const NEGLIGIBLE_EXCESS: f64 = 1e-3;

/// Temperature of material and shear strength, \[°C].
pub(super) struct ContactTemperature<'a> {
    problem: &'a Problem,
    /// Temperature far from the contact, \[°C].
    ambient: f64,
    /// Highest temperature at which material and shear strength are known, \[°C].
    highest: f64,
}

/// Solves at the temperature that the answer causes; without heat, and if nothing depends on the temperature, once.
pub(super) fn solve(first: Plan, watch: &dyn Progress) -> Result<Answer> {
    let (problem, method) = (first.problem, first.method);
    let Some(temperature) = ContactTemperature::of(problem) else {
        return contact_strain::solve(first, watch);
    };
    let fixed_point = FixedPoint {
        problem,
        method,
        watch,
        of: &temperature,
    };
    let mut found = fixed_point.solve()?;
    found.answer.temperature_model_spread = temperature.spread(&found, &fixed_point)?;
    let of_surface = found
        .answer
        .largest_temperature_rise
        .map_or(0.0, |rise| rise.value);
    let below = found.answer.temperature_by_depth.as_ref();
    let hottest =
        temperature.ambient + below.map_or(of_surface, |below| below.largest().max(of_surface));
    if hottest > temperature.highest {
        found.answer.warnings.push(Warning::HotterThanLaws {
            temperature: hottest,
            highest: temperature.highest,
            is_by_wave: below.is_some(),
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

    fn is_narrow(&self, from: f64, to: f64) -> bool {
        (to - from).abs() <= NARROW_RANGE
    }

    fn negligible(&self) -> f64 {
        NEGLIGIBLE_EXCESS
    }

    /// Below a periodic surface the rise has the distribution over the depth of the answer `near`, with another size.
    fn problem_at(&self, value: f64, near: Option<&Answer>) -> Result<Problem> {
        let uniform = self.problem.at_temperature(value)?;
        let near = near.and_then(|near| {
            let caused = self.effective_rise(near)?.value;
            Some((near.temperature_by_depth.as_ref()?, caused))
        });
        let rise = value - self.ambient;
        match near {
            Some((by_depth, caused)) if caused > 0.0 && rise > 0.0 => {
                Ok(uniform.with_rises(self.ambient, by_depth.scaled(rise / caused))?)
            }
            _ => Ok(uniform),
        }
    }

    fn solve(&self, plan: Plan, watch: &dyn Progress) -> Result<Answer> {
        contact_strain::solve(plan, watch)
    }

    /// Temperature of the surroundings and rise weighted with the dissipated power.
    fn caused_by(&self, answer: &Answer) -> Estimate {
        self.effective_rise(answer)
            .map_or(Estimate::exact(self.ambient), |rise| {
                Estimate::new(self.ambient + rise.value, rise.error)
            })
    }

    fn difference(&self, answer: &Answer, problem: &Problem) -> f64 {
        let (Some(assumed), Some(caused)) = (problem.by_depth(), &answer.temperature_by_depth)
        else {
            return 0.0;
        };
        let of_shear = self.share_of_contact(answer);
        let effective = |profile: &DepthProfile| {
            (1.0 - of_shear) * profile.mean().value + of_shear * profile.contact()
        };
        let scaled = assumed.scaled(effective(caused) / effective(assumed));
        let of_contact = (caused.contact() - scaled.contact()).abs();
        (1.0 - of_shear) * caused.difference_from(&scaled) + of_shear * of_contact
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

impl<'a> ContactTemperature<'a> {
    /// The temperature of a problem with heat; `None` without heat, and if nothing depends on the temperature.
    pub(super) fn of(problem: &'a Problem) -> Option<Self> {
        let ambient = problem.heating()?.ambient?;
        problem.depends_on_temperature().then(|| Self {
            problem,
            ambient,
            highest: problem.highest_temperature(),
        })
    }

    /// Mean rise weighted with the dissipated power, \[K]. Below a periodic surface it is weighted with the power of the bulk, and with that of
    /// the interface if the shear strength depends on the temperature of the contact area: the fixed point is that of what changes the
    /// friction.
    fn effective_rise(&self, answer: &Answer) -> Option<Estimate> {
        let of_bulk = answer.dissipation_weighted_rise?;
        let of_shear = self.share_of_contact(answer);
        match (&answer.temperature_by_depth, answer.mean_temperature_rise) {
            (Some(_), Some(of_contact)) => Some(of_bulk * (1.0 - of_shear) + of_contact * of_shear),
            _ => Some(of_bulk),
        }
    }

    /// Share of the friction that the temperature of the contact area changes: that of the shear, if its strength depends on temperature.
    fn share_of_contact(&self, answer: &Answer) -> f64 {
        match (answer.friction_from_shear, answer.friction_coefficient) {
            (Some(shear), Some(all)) if self.problem.shear_depends_on_temperature() => {
                shear.value / all.value
            }
            _ => 0.0,
        }
    }

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
        let hottest = fixed_point.state(hottest, None, fixed_point.search_accuracy())?;
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
