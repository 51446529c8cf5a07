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

use super::answer::{Answer, Persson};
use super::cut_off::WithoutShortestOctave;
use super::dissipation::Dissipation;
use super::error::Result;
use super::problem::Problem;
use super::solved::Solved;
use super::warning::Warning;
use crate::quantity::{ByQuantity, QUANTITIES, Quantity};
use crate::sweep::each_once;
pub(crate) use coarse::Coarse;
use draw::Drawn;
use sample::Sample;
pub use sample::Scatter;

/// The answer of one of the surfaces.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Realisation {
    /// Seed of the surface.
    pub seed: u64,
    /// The quantities whose scatter is known, with their errors.
    #[serde(flatten)]
    pub quantities: ByQuantity<Estimate>,
}

impl Realisation {
    /// The quantities of an answer that scatter over the ensemble, with the seed of its surface.
    fn of((answer, seed): (&Answer, &u64)) -> Self {
        let scattered = |quantity: &Quantity| quantity.has_scatter.then(|| (quantity.of)(answer));
        Self {
            seed: *seed,
            quantities: ByQuantity::new(|quantity| scattered(quantity).flatten()),
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
    /// Scatter of friction and area fraction; empty if only one surface has an answer.
    pub scatter: ByQuantity<Scatter>,
}

impl Answer {
    /// Writes the entries that only rough surfaces have.
    pub(super) fn serialize_rough<M: SerializeMap>(&self, map: &mut M) -> Result<(), M::Error> {
        if let Some(ensemble) = &self.ensemble {
            for (key, scatter) in ensemble.scatter.iter() {
                map.serialize_entry(&format!("{key}_standard_error"), &scatter.standard_error)?;
                map.serialize_entry(&format!("{key}_scatter"), &scatter.standard_deviation)?;
            }
            map.serialize_entry("realisations", &ensemble.realisations)?;
            if ensemble.on_coarse_grid > 0 {
                map.serialize_entry("realisations_on_coarse_grid", &ensemble.on_coarse_grid)?;
            }
        }
        if let Some(persson) = &self.persson {
            map.serialize_entry("persson", persson)?;
        }
        if let Some(without) = &self.without_shortest_octave {
            map.serialize_entry("without_shortest_octave", without)?;
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
    // Draw surfaces with different seeds and solve them, until the standard error of the mean is as small as requested.
    let mut drawn = Drawn::new(problem, watch, first)?;
    if let Some(asked) = problem.standard_error() {
        drawn.draw_until(asked)?;
    }
    let Drawn {
        answers,
        coarse,
        missed,
        ..
    } = drawn;
    // Average the answers, and correct the means by the coarse solutions.
    let mut answer = mean_of(&answers, &problem.seeds());
    answer.include_coarse((&answers, &coarse));
    Solved { answer, missed }.into_result()
}

/// A statistic of the values of a quantity over all surfaces; `None` if an answer lacks the quantity, or coarse solutions never
/// have it.
fn statistic_of<T>(
    quantity: &Quantity,
    (answers, coarse): (&[Answer], &[Coarse]),
    statistic: impl FnOnce(Sample) -> T,
) -> Option<T> {
    let value = |answer: &Answer| (quantity.of)(answer).map(|known| known.value);
    let fine: Vec<f64> = answers.iter().map(value).collect::<Option<_>>()?;
    let coarse: Vec<f64> = coarse.iter().map(quantity.on_coarse_grid?).collect();
    let coarse = if coarse.is_empty() { &fine } else { &coarse };
    Some(statistic(Sample {
        fine: &fine,
        coarse,
    }))
}

impl Answer {
    /// Adds what the coarse solutions say about a mean of answers: the scatter over all surfaces, and the correction ⟨c⟩_N −
    /// ⟨c⟩ₙ of each mean. The errors remain those of the answers.
    fn include_coarse(&mut self, all @ (answers, coarse): (&[Self], &[Coarse])) {
        if let Some(ensemble) = &mut self.ensemble {
            let scatter =
                |of: &Quantity| statistic_of(of, all, |sample| sample.scatter()).flatten();
            ensemble.scatter =
                ByQuantity::new(|quantity| scatter(quantity).filter(|_| quantity.has_scatter));
            ensemble.on_coarse_grid = coarse.len().saturating_sub(answers.len());
        }
        if coarse.len() <= answers.len() {
            return;
        }
        for quantity in &QUANTITIES {
            let shift = statistic_of(quantity, all, |sample| sample.shift());
            if let Some((field, shift)) = quantity.field.zip(shift)
                && let Some(mean) = field(self)
            {
                *mean = Estimate::new(mean.value + shift, mean.error);
            }
        }
        if self.persson.is_some() {
            self.persson = Persson::mean(coarse.iter().map(|one| one.persson));
        }
    }
}

/// The mean of all answers, quantity by quantity; fields and histories are those of the first. A warning appears once, with the
/// number of surfaces that have it.
fn mean_of(answers: &[Answer], seeds: &[u64]) -> Answer {
    let share = |index: usize| {
        let shares = answers.iter().map(|one| one.dissipation.shares()[index].1);
        mean_estimate(shares.map(|share| share.map(Estimate::exact))).map(|mean| mean.value)
    };
    let warnings = each_once(answers.iter().map(|one| one.warnings.clone()))
        .into_iter()
        .map(|shared| Warning::OfSurfaces {
            warning: Box::new(shared.warning),
            surfaces: shared.answers,
            of: shared.of,
        });
    let linear: Option<Vec<Answer>> = answers
        .iter()
        .map(|one| one.linear.as_deref().cloned())
        .collect();
    let mut mean = Answer {
        linear: linear.map(|linear| Box::new(mean_of(&linear, seeds))),
        persson: Persson::mean(answers.iter().map(|one| one.persson)),
        without_shortest_octave: without_shortest_octave(answers),
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
            scatter: ByQuantity::default(),
        }),
        ..answers[0].clone()
    };
    // Average each quantity over the surfaces; one that some answer lacks has no mean.
    for quantity in &QUANTITIES {
        if let Some(field) = quantity.field {
            *field(&mut mean) = mean_estimate(answers.iter().map(quantity.of));
        }
    }
    mean.error_parts = ErrorParts::discretisation_only(mean.requested_quantity().error);
    mean
}

/// Mean of values and mean of errors; `None` if one is not known.
fn mean_estimate(estimates: impl Iterator<Item = Option<Estimate>>) -> Option<Estimate> {
    let estimates: Vec<Estimate> = estimates.collect::<Option<_>>()?;
    let mean = |part: fn(&Estimate) -> f64| {
        estimates.iter().map(part).sum::<f64>() / estimates.len() as f64
    };
    Some(Estimate::new(mean(|one| one.value), mean(|one| one.error)))
}

/// Mean over an ensemble of the quantities that each answer has without the shortest octave of its waves.
fn without_shortest_octave(answers: &[Answer]) -> Option<WithoutShortestOctave> {
    let mean = |of: fn(WithoutShortestOctave) -> Option<Estimate>| {
        let without = answers.iter().map(|one| one.without_shortest_octave);
        mean_estimate(without.map(|without| without.and_then(of)))
    };
    Some(WithoutShortestOctave {
        friction_coefficient: mean(|one| one.friction_coefficient),
        area_fraction: mean(|one| Some(one.area_fraction))?,
        rms_slope: mean(|one| Some(Estimate::exact(one.rms_slope)))?.value,
    })
}
