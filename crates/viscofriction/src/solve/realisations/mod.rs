//! Many random surfaces of one spectrum: the mean of their answers, and how far they scatter.
//!
//! The error of a mean is the mean of the errors of the answers, which may all be off to the same side. How far the mean of so many
//! surfaces may be off from that of all is another thing, the standard error s/√N with the standard deviation s.

use numerics::{ErrorParts, Estimate, Watch};
use serde::Serialize;
use serde::ser::SerializeMap;

use super::answer::{Answer, Persson, RoughAnswer};
use super::cut_off::WithoutShortestOctave;
use super::dissipation::Dissipation;
use super::error::{Result, SolveError};
use super::plan::plan;
use super::problem::Problem;
use crate::sweep::each_once;

/// Surfaces from which a standard error is taken for one.
const FEWEST: usize = 10;

/// What one of the surfaces answers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Realisation {
    /// By which it was drawn.
    pub seed: u64,
    /// None where nothing slides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_coefficient: Option<f64>,
    /// Its absolute error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_coefficient_error: Option<f64>,
    /// Part of the period in contact.
    pub area_fraction: f64,
    /// Its absolute error.
    pub area_fraction_error: f64,
}

/// How far the surfaces differ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// Standard deviation s of one surface.
    pub standard_deviation: f64,
    /// Standard error s/√N of the mean of N.
    pub standard_error: f64,
}

impl Scatter {
    fn of(values: &[f64]) -> Option<Self> {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares = values.iter().map(|value| (value - mean).powi(2));
        let standard_deviation = (squares.sum::<f64>() / (count - 1.0)).sqrt();
        (values.len() > 1).then(|| Self {
            standard_deviation,
            standard_error: standard_deviation / count.sqrt(),
        })
    }
}

/// The standard error of what is asked for over its mean, as much larger as one of few surfaces may be wrong itself (Student's
/// distribution, to the first order in 1/N).
fn relative_standard_error(answers: &[Answer]) -> f64 {
    let values = answers
        .iter()
        .map(|answer| answer.requested_quantity().value);
    let values: Vec<f64> = values.collect();
    let (count, sum) = (values.len() as f64, values.iter().sum::<f64>());
    let scatter = Scatter::of(&values).filter(|_| values.len() >= FEWEST);
    scatter.map_or(f64::INFINITY, |scatter| {
        let wider = 1.0 + 0.5 / (count - 1.0);
        match scatter.standard_error {
            0.0 => 0.0,
            error => wider * error * count / sum.abs(),
        }
    })
}

impl Answer {
    /// How far friction and area of the surfaces differ, by their names in JSON; none where there is one surface.
    pub fn scatters(&self) -> [(&'static str, Option<Scatter>); 2] {
        let frictions = self.realisations.iter();
        let frictions = frictions.filter_map(|one| one.friction_coefficient);
        let areas = self.realisations.iter().map(|one| one.area_fraction);
        [
            ("friction_coefficient", frictions.collect::<Vec<f64>>()),
            ("area_fraction", areas.collect()),
        ]
        .map(|(name, values)| (name, Scatter::of(&values)))
    }

    /// What is said of rough surfaces only.
    pub(super) fn serialize_rough<M: SerializeMap>(&self, map: &mut M) -> Result<(), M::Error> {
        for (name, scatter) in self.scatters() {
            if let Some(scatter) = scatter {
                map.serialize_entry(&format!("{name}_standard_error"), &scatter.standard_error)?;
                map.serialize_entry(&format!("{name}_scatter"), &scatter.standard_deviation)?;
            }
        }
        if !self.realisations.is_empty() {
            map.serialize_entry("realisations", &self.realisations)?;
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

/// The mean of all answers, of which the first is there; the answer itself where there is one surface.
pub(super) fn mean(problem: &Problem, first: Result<Answer>, watch: &dyn Watch) -> Result<Answer> {
    if problem.realisations() == 1 {
        return first;
    }
    let (mut answers, mut seeds, mut missed) = (Vec::new(), Vec::new(), None);
    let mut first = Some(first);
    for (scene, seed) in problem.surfaces() {
        let found = match first.take() {
            Some(first) => first,
            None => plan(&problem.of_surface(&scene)?)?.solve_one(watch),
        };
        let answer = match found {
            Ok(answer) => answer,
            Err(SolveError::NotReached { answer, why }) => {
                missed.get_or_insert(why);
                *answer
            }
            Err(why) => return Err(why),
        };
        answers.push(answer);
        seeds.push(seed);
        let asked = problem.standard_error();
        if asked.is_some_and(|asked| relative_standard_error(&answers) <= asked) {
            break;
        }
    }
    if let Some(asked) = problem.standard_error() {
        let reached = relative_standard_error(&answers);
        let surfaces = answers.len();
        let why = (reached > asked).then_some(SolveError::TooFewSurfaces {
            asked,
            surfaces,
            reached,
        });
        missed = missed.or(why.map(Box::new));
    }
    let mut answer = mean_of(answers, &seeds);
    let Some(why) = missed else {
        return Ok(answer);
    };
    answer.not_reached = Some(why.to_string());
    let answer = Box::new(answer);
    Err(SolveError::NotReached { answer, why })
}

/// Fields are those of the first.
fn mean_of(answers: Vec<Answer>, seeds: &[u64]) -> Answer {
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
    let realisation = |(answer, seed): (&Answer, &u64)| {
        let area = answer
            .rough
            .map_or(Estimate::exact(0.0), |rough| rough.area_fraction);
        Realisation {
            seed: *seed,
            friction_coefficient: answer.friction_coefficient.map(|known| known.value),
            friction_coefficient_error: answer.friction_coefficient.map(|known| known.error),
            area_fraction: area.value,
            area_fraction_error: area.error,
        }
    };
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
        realisations: answers.iter().zip(seeds).map(realisation).collect(),
        ..answers[0].clone()
    };
    mean.error_parts = ErrorParts::of_elements(mean.requested_quantity().error);
    mean
}

type OfAnswer<'a, T> = &'a dyn Fn(&dyn Fn(&Answer) -> Option<T>) -> Option<T>;

fn rough(known: OfAnswer<'_, Estimate>, number: OfAnswer<'_, f64>) -> Option<RoughAnswer> {
    let estimate = |of: &dyn Fn(&RoughAnswer) -> Option<Estimate>| {
        known(&|answer| answer.rough.as_ref().and_then(of))
    };
    let theory = |of: fn(Persson) -> f64| number(&|answer| answer.rough?.persson.map(of));
    let persson = || {
        Some(Persson {
            area_fraction: theory(|one| one.area_fraction)?,
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
