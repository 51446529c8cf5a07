//! Ensemble of random surfaces of one spectrum: the mean of their answers and its standard error.
//!
//! The error of the mean is the mean of the errors of the answers, because these may all have the same sign. The standard error
//! is separate: the deviation of the sample mean from the ensemble mean. If a standard error is requested, most surfaces are
//! solved on a coarse grid only; a few answers with error estimates correct its discretisation error.

mod coarse;
mod draw;
mod each;
mod sample;

use numerics::{ErrorParts, Estimate, Progress};
use serde::Serialize;
use serde::ser::SerializeMap;

use super::answer::{Answer, Persson, RoughAnswer};
use super::cut_off::WithoutShortestOctave;
use super::dissipation::Dissipation;
use super::error::{Result, SolveError};
use super::problem::Problem;
use crate::sweep::each_once;
use coarse::Coarse;
use draw::Drawn;
use sample::Sample;
pub use sample::Scatter;

/// The answer of one of the surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Realisation {
    /// Seed of the surface.
    pub seed: u64,
    /// Friction coefficient; `None` if nothing slides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_coefficient: Option<f64>,
    /// Absolute error of the friction coefficient.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_coefficient_error: Option<f64>,
    /// Contact area as a fraction of the period.
    pub area_fraction: f64,
    /// Absolute error of the area fraction.
    pub area_fraction_error: f64,
}

impl Realisation {
    fn of((answer, seed): (&Answer, &u64)) -> Self {
        let area = answer.rough.map(|rough| rough.area_fraction);
        let area = area.unwrap_or(Estimate::exact(0.0));
        Self {
            seed: *seed,
            friction_coefficient: answer.friction_coefficient.map(|known| known.value),
            friction_coefficient_error: answer.friction_coefficient.map(|known| known.error),
            area_fraction: area.value,
            area_fraction_error: area.error,
        }
    }
}

/// The ensemble of random surfaces behind an answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Ensemble {
    /// The surfaces solved with error estimates.
    pub realisations: Vec<Realisation>,
    /// Number of further surfaces, solved on a coarse grid only, without error estimates.
    pub on_coarse_grid: usize,
    /// Scatter of the friction coefficient; `None` if nothing slides or only one surface has an answer.
    pub friction_coefficient: Option<Scatter>,
    /// Scatter of the area fraction; `None` if only one surface has an answer.
    pub area_fraction: Option<Scatter>,
}

impl Answer {
    /// Scatter of friction and area over the surfaces, by their names in JSON; `None` for a single surface.
    pub fn scatters(&self) -> [(&'static str, Option<Scatter>); 2] {
        let known = |of: fn(&Ensemble) -> Option<Scatter>| self.ensemble.as_ref().and_then(of);
        [
            (
                "friction_coefficient",
                known(|all| all.friction_coefficient),
            ),
            ("area_fraction", known(|all| all.area_fraction)),
        ]
    }

    /// Writes the entries that only rough surfaces have.
    pub(super) fn serialize_rough<M: SerializeMap>(&self, map: &mut M) -> Result<(), M::Error> {
        for (name, scatter) in self.scatters() {
            if let Some(scatter) = scatter {
                map.serialize_entry(&format!("{name}_standard_error"), &scatter.standard_error)?;
                map.serialize_entry(&format!("{name}_scatter"), &scatter.standard_deviation)?;
            }
        }
        if let Some(ensemble) = &self.ensemble {
            map.serialize_entry("realisations", &ensemble.realisations)?;
            if ensemble.on_coarse_grid > 0 {
                map.serialize_entry("realisations_on_coarse_grid", &ensemble.on_coarse_grid)?;
            }
        }
        if let Some(persson) = self.rough.and_then(|rough| rough.persson) {
            map.serialize_entry("persson", &persson)?;
        }
        if let Some(without) = self.rough.and_then(|rough| rough.without_shortest_octave) {
            map.serialize_entry("without_shortest_octave", &without)?;
        }
        Ok(())
    }
}

/// The ensemble mean; `first` solves the first surface. Without an ensemble it is the answer itself.
pub(super) fn mean(
    problem: &Problem,
    first: impl FnOnce(&dyn Progress) -> Result<Answer>,
    watch: &dyn Progress,
) -> Result<Answer> {
    if problem.realisations() == 1 {
        return first(watch);
    }
    // Sample and solve the surfaces.
    let mut drawn = Drawn::new(problem, watch, first)?;
    if let Some(asked) = problem.standard_error() {
        drawn.until_known(asked)?;
    }
    let Drawn {
        answers,
        coarse,
        missed,
        ..
    } = drawn;
    // Average the answers, and correct the means by the coarse solutions.
    let mut answer = mean_of(&answers, &problem.seeds());
    answer.count((&answers, &coarse));
    let Some(why) = missed else {
        return Ok(answer);
    };
    answer.not_reached = Some(why.to_string());
    let (answer, why) = (Box::new(answer), Box::new(why));
    Err(SolveError::NotReached { answer, why })
}

/// A quantity that answers and coarse solutions share.
struct Quantity {
    of_answer: fn(&Answer) -> Option<f64>,
    on_coarse_grid: fn(&Coarse) -> f64,
    in_mean: fn(&mut Answer) -> Option<&mut Estimate>,
}

/// The friction coefficient.
const FRICTION: Quantity = Quantity {
    of_answer: |one| one.friction_coefficient.map(|known| known.value),
    on_coarse_grid: |one| one.friction_coefficient,
    in_mean: |mean| mean.friction_coefficient.as_mut(),
};
/// The contact area as a fraction of the period.
const AREA_FRACTION: Quantity = Quantity {
    of_answer: |one| one.rough.map(|rough| rough.area_fraction.value),
    on_coarse_grid: |one| one.area_fraction,
    in_mean: |mean| mean.rough.as_mut().map(|rough| &mut rough.area_fraction),
};
/// All quantities whose mean the coarse solutions correct.
const QUANTITIES: [Quantity; 5] = [
    FRICTION,
    AREA_FRACTION,
    Quantity {
        of_answer: |one| one.contact_area.map(|known| known.value),
        on_coarse_grid: |one| one.contact_area,
        in_mean: |mean| mean.contact_area.as_mut(),
    },
    Quantity {
        of_answer: |one| Some(one.rough?.friction_from_dissipation?.value),
        on_coarse_grid: |one| one.friction_coefficient,
        in_mean: |mean| mean.rough.as_mut()?.friction_from_dissipation.as_mut(),
    },
    Quantity {
        of_answer: |one| one.indentation_depth.map(|known| known.value),
        on_coarse_grid: |one| one.mean_depth,
        in_mean: |mean| mean.indentation_depth.as_mut(),
    },
];

impl Quantity {
    /// A statistic over all surfaces; `None` if an answer lacks the quantity.
    fn over<T>(
        &self,
        (answers, coarse): (&[Answer], &[Coarse]),
        statistic: impl FnOnce(Sample) -> T,
    ) -> Option<T> {
        let fine: Option<Vec<f64>> = answers.iter().map(self.of_answer).collect();
        let fine = fine?;
        let coarse: Vec<f64> = coarse.iter().map(self.on_coarse_grid).collect();
        let coarse = if coarse.is_empty() { &fine } else { &coarse };
        Some(statistic(Sample {
            fine: &fine,
            coarse,
        }))
    }
}

impl Answer {
    /// Adds the surfaces solved on the coarse grid only: scatter, and shifted means. The errors remain those of the answers.
    fn count(&mut self, all @ (answers, coarse): (&[Self], &[Coarse])) {
        let scatter = |of: Quantity| of.over(all, |sample| sample.scatter()).flatten();
        if let Some(ensemble) = &mut self.ensemble {
            ensemble.friction_coefficient = scatter(FRICTION);
            ensemble.area_fraction = scatter(AREA_FRACTION);
            ensemble.on_coarse_grid = coarse.len().saturating_sub(answers.len());
        }
        if coarse.len() <= answers.len() {
            return;
        }
        for quantity in QUANTITIES {
            let shift = quantity.over(all, |sample| sample.shift());
            if let Some((mean, shift)) = (quantity.in_mean)(self).zip(shift) {
                *mean = Estimate::new(mean.value + shift, mean.error);
            }
        }
        if let Some(rough) = &mut self.rough {
            rough.persson = mean_of_theory(coarse);
        }
    }
}

/// Mean of Persson's theory over all surfaces; `None` if it is missing for one.
fn mean_of_theory(surfaces: &[Coarse]) -> Option<Persson> {
    let theories: Option<Vec<Persson>> = surfaces.iter().map(|one| one.persson).collect();
    let theories = theories?;
    let mean =
        |of: fn(&Persson) -> f64| theories.iter().map(of).sum::<f64>() / theories.len() as f64;
    Some(Persson {
        area_fraction: mean(|one| one.area_fraction),
        area_fraction_xu: mean(|one| one.area_fraction_xu),
        friction_coefficient: mean(|one| one.friction_coefficient),
        friction_coefficient_2006: mean(|one| one.friction_coefficient_2006),
    })
}

/// The mean of all answers; fields and histories are those of the first.
fn mean_of(answers: &[Answer], seeds: &[u64]) -> Answer {
    let known = |of: &dyn Fn(&Answer) -> Option<Estimate>| {
        let estimates: Option<Vec<Estimate>> = answers.iter().map(of).collect();
        let estimates = estimates?;
        let mean = |part: fn(&Estimate) -> f64| {
            estimates.iter().map(part).sum::<f64>() / estimates.len() as f64
        };
        Some(Estimate::new(mean(|one| one.value), mean(|one| one.error)))
    };
    let number = |of: &dyn Fn(&Answer) -> Option<f64>| {
        known(&|answer| of(answer).map(Estimate::exact)).map(|mean| mean.value)
    };
    let share = |index: usize| number(&|answer| answer.dissipation.shares()[index].1);
    let warnings = answers.iter();
    let warnings = warnings.map(|one| one.warnings.iter().map(String::as_str).collect());
    let warnings = each_once(warnings).into_iter().map(|one| {
        let [some, all] = [one.answers, one.of];
        format!("{} (of {some} of {all} surfaces)", one.sentence)
    });
    let mut mean = Answer {
        friction_coefficient: known(&|one| one.friction_coefficient),
        indentation_depth: known(&|one| one.indentation_depth),
        contact_area: known(&|one| one.contact_area),
        rough: rough(&known, &number),
        dissipation: Dissipation {
            outside_window: share(0),
            below_window: share(1),
            above_window: share(2),
            shortest_octave: share(3),
        },
        warnings: warnings.collect(),
        ensemble: Some(Ensemble {
            realisations: answers.iter().zip(seeds).map(Realisation::of).collect(),
            on_coarse_grid: 0,
            friction_coefficient: None,
            area_fraction: None,
        }),
        ..answers[0].clone()
    };
    mean.error_parts = ErrorParts::discretisation_only(mean.requested_quantity().error);
    mean
}

/// Mean over the answers of a quantity; `None` if one answer lacks it.
type OfAnswer<'a, T> = &'a dyn Fn(&dyn Fn(&Answer) -> Option<T>) -> Option<T>;

/// Means of the quantities that only rough surfaces have.
fn rough(known: OfAnswer<'_, Estimate>, number: OfAnswer<'_, f64>) -> Option<RoughAnswer> {
    let estimate = |of: &dyn Fn(&RoughAnswer) -> Option<Estimate>| {
        known(&|answer| answer.rough.as_ref().and_then(of))
    };
    let theory = |of: fn(Persson) -> f64| number(&|answer| answer.rough?.persson.map(of));
    let persson = || {
        Some(Persson {
            area_fraction: theory(|one| one.area_fraction)?,
            area_fraction_xu: theory(|one| one.area_fraction_xu)?,
            friction_coefficient: theory(|one| one.friction_coefficient)?,
            friction_coefficient_2006: theory(|one| one.friction_coefficient_2006)?,
        })
    };
    let without = |of: fn(WithoutShortestOctave) -> Option<Estimate>| {
        estimate(&|rough| rough.without_shortest_octave.and_then(of))
    };
    let slope = |answer: &Answer| {
        let without = answer.rough?.without_shortest_octave?;
        Some(without.rms_slope)
    };
    let octave = || {
        Some(WithoutShortestOctave {
            friction_coefficient: without(|one| one.friction_coefficient),
            area_fraction: without(|one| Some(one.area_fraction))?,
            rms_slope: number(&slope)?,
        })
    };
    Some(RoughAnswer {
        mean_pressure: estimate(&|rough| Some(rough.mean_pressure))?,
        area_fraction: estimate(&|rough| Some(rough.area_fraction))?,
        friction_from_dissipation: estimate(&|rough| rough.friction_from_dissipation),
        persson: persson(),
        without_shortest_octave: octave(),
    })
}
