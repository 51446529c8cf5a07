//! The parameters of least squares, from several starts on few points to all points with the loss.

use indenters::Axisymmetric;
use numerics::least_squares::{Linearised, Range, minimise};

use super::depth::median;
use super::means::Measured;
use super::model::{Kind, Model};
use super::noise::{Linear, Noise, normal_matrix};
use super::start::Start;
use super::{FitOptions, IndentationCurve, IndentationError, Rheology};

/// More are never told apart by one curve.
pub(super) const MAX_BRANCHES: usize = 6;
/// Points of the first search.
const FEW: usize = 200;
/// Relaxation times are sought from a third of the shortest time step to thirty times the length of the curve.
const SHORTEST: f64 = 1.0 / 3.0;
const LONGEST: f64 = 30.0;

/// A minimum.
pub(super) struct Found<'a> {
    pub(super) model: Model<'a>,
    pub(super) measured: &'a Measured,
    pub(super) parameters: Vec<f64>,
    pub(super) loss: Loss<'a>,
    /// The model about them.
    pub(super) linear: Linear<'a>,
    /// Kinds of noise with their probabilities, the most likely one first.
    pub(super) noises: Vec<(Noise, f64)>,
    pub(super) ranges: Vec<Range>,
}

pub(super) fn search<'a>(
    body: &'a dyn Axisymmetric,
    measured: &'a Measured,
    options: &FitOptions,
    begin: &Start,
) -> Result<Found<'a>, IndentationError> {
    let curve = &measured.curve;
    let few = curve.decimated(FEW);
    let of_kind = |kind| {
        fit(
            Model::new(body, curve, kind, options),
            measured,
            &few,
            begin,
        )
    };
    let found = match (options.rheology, options.branches) {
        (Rheology::PowerLaw, _) => of_kind(Kind::PowerLaw),
        (Rheology::StandardSolid, _) => of_kind(Kind::Branches(1)),
        (Rheology::Prony, Some(n)) => of_kind(Kind::Branches(n)),
        (Rheology::Prony, None) => {
            let mut best = of_kind(Kind::Branches(1));
            for n in 2..=MAX_BRANCHES {
                let next = of_kind(Kind::Branches(n));
                let criterion = |found: &Option<Found>| found.as_ref().map(Found::criterion);
                // None is less than any number.
                if criterion(&next).is_none() || criterion(&next) >= criterion(&best) {
                    break;
                }
                best = next;
            }
            best
        }
    };
    found.ok_or_else(|| {
        // Nearly always the whole depth is too large for the body.
        let elastic = Model::new(body, curve, Kind::Branches(0), options);
        let refused = elastic.forces(&[0.0, curve.depth[0], 0.0, 0.0]).err();
        refused.map_or(IndentationError::NotConverged, IndentationError::Model)
    })
}

/// The best of several starts on few points, and from there with all points: with squares, and then with Huber's loss.
fn fit<'a>(
    model: Model<'a>,
    measured: &'a Measured,
    few: &IndentationCurve,
    begin: &Start,
) -> Option<Found<'a>> {
    let ranges = ranges(&model, begin);
    let coarse = Model {
        curve: few,
        ..model.clone()
    };
    let peak = begin.peak.abs();
    let ones = vec![1.0; few.time.len()];
    let mut loss = Loss {
        counts: &measured.counts,
        threshold: f64::INFINITY,
        scale: peak,
    };
    let coarsely = Loss {
        counts: &ones,
        ..loss
    };
    let descend = |model: &Model, loss: &Loss, start, sufficient: f64| {
        let sum = |parameters: &[f64]| loss.linearised(model, parameters);
        minimise(sum, start, &ranges, sufficient)
    };
    let starts = starts(&model, begin).into_iter();
    let found = starts.filter_map(|start| descend(&coarse, &coarsely, start, 1e-3));
    let best = found.min_by(|one, other| one.linearised.sum.total_cmp(&other.linearised.sum))?;
    let found = descend(&model, &loss, best.parameters, 1e-4)?;
    let mut parameters = in_order(model.kind, found.parameters);
    loss.threshold = HUBER;
    for sufficient in [1e-3, 1e-6] {
        loss.scale = loss.spread(&model, &parameters)?.max(1e-12 * peak);
        parameters = descend(&model, &loss, parameters, sufficient)?.parameters;
    }
    let linear = linear(&model, measured, &parameters, loss.scale)?;
    Some(Found {
        noises: Noise::likely(&linear),
        linear,
        model,
        measured,
        parameters,
        loss,
        ranges,
    })
}

/// The model about its parameters, with residuals that are not wild.
fn linear<'a>(
    model: &Model<'a>,
    measured: &'a Measured,
    parameters: &[f64],
    residual: f64,
) -> Option<Linear<'a>> {
    let forces = model.forces(parameters).ok()?;
    let scaled = |row: Vec<f64>| {
        let norm = row.iter().map(|slope| slope * slope).sum::<f64>().sqrt();
        let norm = if norm > 0.0 { norm } else { 1.0 };
        row.iter().map(|slope| slope / norm).collect()
    };
    // About neighbours, which slow noise moves as well.
    let tame = |(i, count): (usize, &f64)| {
        let last = forces.residuals.len() - 1;
        let near = &forces.residuals[i.saturating_sub(NEAR)..=(i + NEAR).min(last)];
        let most = WILD * residual / count.sqrt();
        let middle = median(near.to_vec());
        forces.residuals[i].clamp(middle - most, middle + most)
    };
    let tame: Vec<f64> = measured.counts.iter().enumerate().map(tame).collect();
    let mut columns: Vec<Vec<f64>> = forces.rows.into_iter().map(scaled).collect();
    columns.push(tame);
    Some(Linear {
        time: &measured.curve.time,
        counts: &measured.counts,
        columns,
    })
}

impl Found<'_> {
    /// Schwarz's information criterion (1978, DOI 10.1214/aos/1176344136), the less the better.
    fn criterion(&self) -> f64 {
        let residuals = Linear {
            columns: self.linear.columns[self.parameters.len()..].to_vec(),
            ..self.linear
        };
        let n = self.linear.time.len() as f64;
        let deviance = self.noises[0].0.likelihood(&residuals).deviance();
        deviance + self.model.n_parameters() as f64 * n.ln()
    }

    /// The sum of the loss, with its model.
    pub(super) fn linearised(&self, parameters: &[f64]) -> Option<Linearised> {
        self.loss.linearised(&self.model, parameters)
    }
}

fn ranges(model: &Model, begin: &Start) -> Vec<Range> {
    let range = |bounds: [f64; 2], largest_step| Range {
        bounds,
        largest_step,
    };
    let modulus = begin.modulus.abs().ln();
    let moduli = range([modulus - 21.0, modulus + 21.0], 2.0);
    let [step, length] = model.times;
    let times = range([(SHORTEST * step).ln(), (LONGEST * length).ln()], 2.0);
    let mut ranges = match model.kind {
        Kind::Branches(n) => [vec![moduli], [moduli, times].repeat(n)].concat(),
        Kind::PowerLaw => vec![moduli, range([0.011, 0.98], 0.1)],
    };
    let depth = &model.curve.depth;
    let deepest = depth[begin.turn];
    let width = deepest - depth[0];
    ranges.push(range([depth[0] - width, deepest], 0.1 * width));
    let anything = range([f64::NEG_INFINITY, f64::INFINITY], f64::INFINITY);
    ranges.resize(model.n_parameters(), anything);
    ranges
}

fn starts(model: &Model, begin: &Start) -> Vec<Vec<f64>> {
    let modulus = begin.modulus.abs();
    let [step, length] = model.times;
    let material: Vec<Vec<f64>> = match model.kind {
        Kind::PowerLaw => {
            let start = |beta| vec![modulus.ln() + beta * (0.5 * begin.approach_time).ln(), beta];
            [0.05, 0.3].map(start).into()
        }
        Kind::Branches(1) => {
            let start = |time: f64| vec![(0.5 * modulus).ln(), modulus.ln(), time.ln()];
            [0.3 * begin.approach_time, 0.3 * length].map(start).into()
        }
        Kind::Branches(n) => {
            let [first, last] = [(3.0 * step).max(1e-3 * length).ln(), (0.5 * length).ln()];
            let each = (modulus / n as f64).ln();
            let time = |k: usize| first + (last - first) * (k as f64 + 0.5) / n as f64;
            let branches = (0..n).flat_map(|k| [each, time(k)]);
            vec![[each].into_iter().chain(branches).collect()]
        }
    };
    let others = [begin.contact_point, begin.baseline, 0.0];
    let n_others = model.n_parameters() - model.kind.n_parameters();
    let complete = |start: Vec<f64>| [&start, &others[..n_others]].concat();
    material.into_iter().map(complete).collect()
}

/// Branches by increasing times.
fn in_order(kind: Kind, parameters: Vec<f64>) -> Vec<f64> {
    let Kind::Branches(n) = kind else {
        return parameters;
    };
    let mut branches: Vec<&[f64]> = parameters[1..=2 * n].chunks(2).collect();
    branches.sort_by(|one, other| one[1].total_cmp(&other[1]));
    let branches = branches.concat();
    [&parameters[..1], &branches, &parameters[2 * n + 1..]].concat()
}

/// Residuals beyond this, in units of the noise, count less than their squares (Huber 1964, DOI 10.1214/aoms/1177703732).
pub(super) const HUBER: f64 = 1.345;
/// Those beyond this say nothing about how long noise lasts: of so many neighbours on each side, off from their median.
const WILD: f64 = 4.0;
const NEAR: usize = 12;

/// Squares of residuals in units of a scale; linear beyond a threshold.
#[derive(Debug, Clone, Copy)]
pub(super) struct Loss<'a> {
    counts: &'a [f64],
    threshold: f64,
    /// Standard deviation of a measured point, \[N].
    pub(super) scale: f64,
}

impl Loss<'_> {
    /// Standard deviation of a measured point by the median of the residuals.
    fn spread(&self, model: &Model, parameters: &[f64]) -> Option<f64> {
        let residuals = model.forces(parameters).ok()?.residuals;
        let pairs = residuals.iter().zip(self.counts);
        let sizes = pairs.map(|(residual, count)| residual.abs() * count.sqrt());
        Some(1.4826 * median(sizes.collect()))
    }

    /// In units of the standard deviation of each point.
    pub(super) fn weighed(&self, column: &[f64]) -> Vec<f64> {
        let pairs = column.iter().zip(self.counts);
        pairs
            .map(|(value, count)| value * count.sqrt() / self.scale)
            .collect()
    }

    fn linearised(&self, model: &Model, parameters: &[f64]) -> Option<Linearised> {
        let forces = model.forces(parameters).ok()?;
        let residuals = self.weighed(&forces.residuals);
        let weight = |residual: &f64| (self.threshold / residual.abs()).min(1.0).sqrt();
        let weights: Vec<f64> = residuals.iter().map(weight).collect();
        let columns = forces.rows.iter().chain([&forces.residuals]);
        let columns = columns.map(|column| {
            let pairs = self.weighed(column).into_iter().zip(&weights);
            pairs.map(|(value, weight)| value * weight).collect()
        });
        let products = normal_matrix(&columns.collect::<Vec<_>>());
        let loss = |residual: &f64| {
            let inside = residual.abs().min(self.threshold);
            inside * (2.0 * residual.abs() - inside)
        };
        let n = forces.rows.len();
        let entries = |row: usize| products[row * (n + 1)..][..n].to_vec();
        Some(Linearised {
            sum: residuals.iter().map(loss).sum(),
            matrix: (0..n).flat_map(entries).collect(),
            descent: entries(n),
        })
    }
}
