//! The strain amplitude of the contact at which the moduli are those that cause it.
//!
//! The moduli of a filled rubber have factors f(ε) and g(ε) at one strain amplitude ε, that of the contact weighted with the dissipated
//! power. A softer material is strained more, so that ε is the fixed point of the strain that the contact at ε causes.
//!
//! Theory: docs/theory/strain.md.

use numerics::{Estimate, Progress};

use super::answer::{Answer, Fields};
use super::contact_temperature;
use super::error::{Result, SolveError};
use super::fixed_point::{FixedPoint, MAX_INCREASE_RATIO, SelfConsistent, State};
use super::plan::Plan;
use super::problem::Problem;
use super::shear::{self, plan_again};
use super::solved::Solved;
use super::warning::Warning;
use rheology::StrainDependence;

/// Strain up to which a second state is looked for. Chosen: linear theory ends far below it.
const MAX_STRAIN: f64 = 1.0;
/// Logarithm of the ratio of the factors of two strains up to which they differ little. Chosen: the factor of the loss modulus has a maximum
/// over the strain, whose height is no less.
const NARROW_LOG_RATIO: f64 = 0.2;
/// Difference of assumed and caused strain that counts as none. Chosen: far below the strains of about 0.001 at which filled rubber begins
/// to soften.
const NEGLIGIBLE_STRAIN: f64 = 1e-6;

/// Amplitude of the equivalent strain in the contact.
pub(super) struct ContactStrain<'a> {
    problem: &'a Problem,
    law: &'a StrainDependence,
}

/// Solves at the strain that the answer causes; without strain dependence, once.
pub(super) fn solve(first: Plan, watch: &dyn Progress) -> Result<Answer> {
    let (problem, method) = (first.problem, first.method);
    let Some(strain) = ContactStrain::of(problem) else {
        return shear::solve(first, watch);
    };
    let fixed_point = FixedPoint {
        problem,
        method,
        watch,
        of: &strain,
    };
    let mut found = fixed_point.solve()?;
    if let (Some(amplitude), Some([_, largest])) =
        (found.answer.strain, strain.law.measured_range())
        && amplitude.value > largest
    {
        found.answer.warnings.push(Warning::UnmeasuredStrain {
            strain: amplitude.value,
            largest,
        });
    }
    let second = found.second.as_ref().map(|second| Warning::SecondStrain {
        strain: second.value,
        friction_coefficient: second.friction_coefficient(),
    });
    found.answer.warnings.extend(second);
    found.into_result()
}

/// Solves at the temperature and the strain that the answer causes; with strain dependence also with the moduli of small strains, whose
/// answer stands beside.
pub(super) fn beside_linear(first: Plan, watch: &dyn Progress) -> Result<Answer> {
    if first.problem.strain_dependence().is_none() {
        return contact_temperature::solve(first, watch);
    }
    let small = first.problem.at_small_strains();
    let linear = contact_temperature::solve(plan_again(&small, first.method)?, watch);
    let linear = Answer {
        fields: Fields::default(),
        ..Solved::of(linear)?.answer
    };
    let mut solved = Solved::of(contact_temperature::solve(first, watch))?;
    solved.answer.linear = Some(Box::new(linear));
    solved.into_result()
}

impl<'a> ContactStrain<'a> {
    /// The strain of a problem with strain dependence; `None` without.
    pub(super) fn of(problem: &'a Problem) -> Option<Self> {
        let law = problem.strain_dependence()?;
        Some(Self { problem, law })
    }
}

impl SelfConsistent for ContactStrain<'_> {
    fn lower_bound(&self) -> f64 {
        0.0
    }

    fn upper_bound(&self) -> f64 {
        f64::INFINITY
    }

    /// The strain of a contact under a force grows at most in inverse proportion to the modulus, so that there is no second state unless
    /// the modulus falls faster than that.
    fn farthest(&self, found: f64) -> Option<f64> {
        let is_steep = self.law.steepness() >= 1.0;
        is_steep.then_some(MAX_STRAIN.max(MAX_INCREASE_RATIO * found))
    }

    fn is_narrow(&self, from: f64, to: f64) -> bool {
        let [from, to] = [from, to].map(|strain| self.law.factors(strain));
        let ratios = [from.storage() / to.storage(), from.loss() / to.loss()];
        ratios
            .iter()
            .all(|ratio| ratio.ln().abs() <= NARROW_LOG_RATIO)
    }

    fn negligible(&self) -> f64 {
        NEGLIGIBLE_STRAIN
    }

    fn problem_at(&self, value: f64, _: Option<&Answer>) -> Result<Problem> {
        Ok(self.problem.with_modulus_factors(self.law.factors(value)))
    }

    fn solve(&self, plan: Plan, watch: &dyn Progress) -> Result<Answer> {
        shear::solve(plan, watch)
    }

    fn caused_by(&self, answer: &Answer) -> Estimate {
        answer.strain.unwrap_or(Estimate::exact(0.0))
    }

    /// The answer with the strain, and the factors that the moduli have there.
    fn at_fixed_point(&self, answer: Answer, value: Estimate, _: f64) -> Answer {
        let factors = self.law.factors(value.value);
        let ends = [value.value - value.error, value.value + value.error]
            .map(|end| self.law.factors(end.max(0.0)));
        let within = |at: f64, ends: [f64; 2]| {
            let error = ends.into_iter().map(|end| (end - at).abs());
            Estimate::new(at, error.fold(0.0, f64::max))
        };
        Answer {
            strain: Some(value),
            storage_factor: Some(within(factors.storage(), ends.map(|of| of.storage()))),
            loss_factor: Some(within(factors.loss(), ends.map(|of| of.loss()))),
            ..answer
        }
    }

    fn too_large(&self, state: &State) -> SolveError {
        self.not_found([state.value, f64::INFINITY])
    }

    fn not_found(&self, [smallest, largest]: [f64; 2]) -> SolveError {
        SolveError::NoContactStrain { smallest, largest }
    }

    fn not_reached(&self, asked: f64, friction: Estimate, strain: Estimate) -> SolveError {
        SolveError::StrainNotReached {
            asked,
            friction,
            strain,
        }
    }
}
