//! The temperature of the contact at which material and shear strength are those that cause it.
//!
//! The material has the temperature of the depth where it dissipates, and the shear strength that of the contact area. One temperature T
//! stands for both, their mean if both depend on the temperature. At T the contact dissipates a power that heats it to g(T), and the state
//! is that of the fixed point T = g(T). Where heating increases friction there may be two; a warning names the hotter one.
//!
//! Theory: docs/theory/heat.md, "Back on the material".

use std::borrow::Cow;

use bem_halfspace::heat::DepthProfile;
use numerics::{Estimate, Progress};
use rheology::ModulusFactors;

use super::answer::Answer;
use super::body::Body;
use super::contact_strain;
use super::error::{Result, SolveError};
use super::fixed_point::{
    FixedPoint, Found, MAX_INCREASE_RATIO, SelfConsistent, State, ValueErrors,
};
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
    problem: Cow<'a, Problem>,
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
    let below = found.answer.temperature_by_depth.as_ref();
    let limited = below.map_or(0.0, |below| match problem.body() {
        Body::Periodic(_) => below.largest(),
        _ => below.contact().max(below.mean().value),
    });
    let hottest = found.answer.hottest_rise();
    if temperature.ambient + hottest > temperature.highest {
        found.answer.warnings.push(Warning::HotterThanLaws {
            temperature: temperature.ambient + hottest,
            highest: temperature.highest,
            is_limited: temperature.ambient + limited > temperature.highest,
        });
    }
    let second = found.second.as_ref().map(|hot| Warning::SecondTemperature {
        temperature: hot.value,
        friction_coefficient: hot.friction_coefficient(),
    });
    found.answer.warnings.extend(second);
    found.into_result()
}

impl SelfConsistent for ContactTemperature<'_> {
    /// Temperature of the surroundings.
    fn lower_bound(&self) -> f64 {
        self.ambient
    }

    fn upper_bound(&self) -> f64 {
        self.highest
    }

    fn farthest(&self, found: f64) -> Option<f64> {
        Some(self.ambient + MAX_RISE.max(MAX_INCREASE_RATIO * (found - self.ambient)))
    }

    /// The moduli have the factors at the strain of the answer, which no further solutions have to find.
    fn faster_near(&self, answer: &Answer) -> Option<Box<dyn SelfConsistent + '_>> {
        let [storage, loss] = [answer.storage_factor?, answer.loss_factor?].map(|of| of.value);
        let factors = ModulusFactors::new(storage, loss).ok()?;
        let problem = self.problem.at_small_strains();
        let problem = Cow::Owned(problem.with_modulus_factors(factors));
        Some(Box::new(Self { problem, ..*self }))
    }

    fn is_narrow(&self, from: f64, to: f64) -> bool {
        (to - from).abs() <= NARROW_RANGE
    }

    fn negligible(&self) -> f64 {
        NEGLIGIBLE_EXCESS
    }

    /// The rise has the distribution over the depth of the answer `near`, with another size.
    fn problem_at(&self, value: f64, near: Option<&Answer>) -> Result<Problem> {
        let uniform = self.problem.at_temperature(value)?;
        let near = near.and_then(|near| {
            let caused = self.rise_of_whole(near)?.value;
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

    /// Temperature of the surroundings and rise of what depends on it.
    fn caused_by(&self, answer: &Answer) -> Estimate {
        self.rise_of_whole(answer)
            .map_or(Estimate::exact(self.ambient), |rise| {
                Estimate::new(self.ambient + rise.value, rise.error)
            })
    }

    fn difference(&self, answer: &Answer, problem: &Problem) -> f64 {
        let (Some(assumed), Some(caused)) = (problem.by_depth(), &answer.temperature_by_depth)
        else {
            return 0.0;
        };
        let share = self.share_of_contact();
        let whole = |profile: &DepthProfile| {
            (1.0 - share) * profile.mean().value + share * profile.contact()
        };
        let scaled = assumed.scaled(whole(caused) / whole(assumed));
        let of_contact = (caused.contact() - scaled.contact()).abs();
        let of_material = match problem.wave_shift() {
            Some(_) => caused.difference_from(&scaled),
            None => (caused.mean().value - scaled.mean().value).abs(),
        };
        (1.0 - share) * of_material + share * of_contact
    }

    /// A relative error of one part of the temperature acts like that of the whole.
    fn errors(&self, state: &State) -> ValueErrors {
        let of_whole = state.caused.error;
        let rise = state.caused.value - self.ambient;
        let of_part = |part: Option<Estimate>| match part {
            Some(part) if part.value > 0.0 => {
                rise.abs() * (part.error + state.difference) / part.value
            }
            _ => of_whole,
        };
        ValueErrors {
            of_material: of_part(state.answer.dissipation_weighted_rise),
            of_shear: of_part(state.answer.mean_temperature_rise),
        }
    }

    fn at_fixed_point(&self, answer: Answer, value: Estimate, error_of_material: f64) -> Answer {
        let of_material = match (
            answer.dissipation_weighted_rise,
            self.rise_of_whole(&answer),
        ) {
            (Some(of_material), Some(whole)) if whole.value > 0.0 => {
                let ratio = of_material.value / whole.value;
                let rise = ratio * (value.value - self.ambient);
                Estimate::new(self.ambient + rise, ratio.abs() * error_of_material)
            }
            _ => value,
        };
        Answer {
            effective_temperature: Some(of_material),
            fixed_point_temperature: Some(value),
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
            problem: Cow::Borrowed(problem),
            ambient,
            highest: problem.highest_temperature(),
        })
    }

    /// Mean rise of what depends on the temperature: material, contact area, or both alike, \[K].
    fn rise_of_whole(&self, answer: &Answer) -> Option<Estimate> {
        let of_material = answer.dissipation_weighted_rise?;
        let of_contact = answer.mean_temperature_rise?;
        let share = self.share_of_contact();
        Some(of_material * (1.0 - share) + of_contact * share)
    }

    /// Weight of the contact area in the temperature of the contact, beside that of the material.
    fn share_of_contact(&self) -> f64 {
        match (
            self.problem.shear_depends_on_temperature(),
            self.problem.shift().is_some(),
        ) {
            (false, _) => 0.0,
            (true, true) => 0.5,
            (true, false) => 1.0,
        }
    }

    /// Largest difference of the friction coefficients at the temperature of the surroundings, with which the material enters the
    /// contact, and at the largest temperature in the contact or below it from that at the fixed point; `None` if they are not known or
    /// outside the range of the laws.
    fn spread(&self, found: &Found, fixed_point: &FixedPoint<'_>) -> Result<Option<Estimate>> {
        let hottest = self.ambient + found.answer.hottest_rise();
        if hottest > self.highest {
            return Ok(None);
        }
        let hottest = fixed_point.state(hottest, None, fixed_point.search_accuracy())?;
        let friction = |state: &State| state.answer.friction_coefficient;
        let (Some(answered), Some(near), Some(cold), Some(hot)) = (
            found.answer.friction_coefficient,
            friction(found.near()),
            friction(&found.states[0]),
            friction(&hottest),
        ) else {
            return Ok(None);
        };
        // The state of the search has the elements of both limits; where the law is steep its friction may not be that of the answer.
        let is_near = (near.value - answered.value).abs() <= near.error + answered.error;
        let known = if is_near { near } else { answered };
        let difference = |other: Estimate| {
            Estimate::new((other.value - known.value).abs(), other.error + known.error)
        };
        let [cold, hot] = [cold, hot].map(difference);
        Ok(Some(if cold.value > hot.value { cold } else { hot }))
    }
}
