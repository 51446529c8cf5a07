//! The parameters of least squares, from several starts on few points to all points with the loss.

use indenters::Axisymmetric;
use numerics::least_squares::{Linearised, Range, minimise};

use super::depth::median;
use super::model::{Kind, Model};
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
    pub(super) parameters: Vec<f64>,
    /// Noise by the residuals, \[N].
    pub(super) scale: f64,
    pub(super) ranges: Vec<Range>,
    /// Sum of squares.
    squares: f64,
}

pub(super) fn search<'a>(
    body: &'a dyn Axisymmetric,
    curve: &'a IndentationCurve,
    options: &FitOptions,
    begin: &Start,
) -> Result<Found<'a>, IndentationError> {
    let few = curve.decimated(FEW);
    let of_kind = |kind| fit(Model::new(body, curve, kind, options), &few, begin);
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
fn fit<'a>(model: Model<'a>, few: &IndentationCurve, begin: &Start) -> Option<Found<'a>> {
    let ranges = ranges(&model, begin);
    let coarse = Model {
        curve: few,
        ..model.clone()
    };
    let peak = begin.peak.abs();
    let descend = |model: &Model, start, threshold: f64, scale: f64, sufficient: f64| {
        let sum = |parameters: &[f64]| linearise(model, parameters, threshold, scale);
        minimise(sum, start, &ranges, sufficient)
    };
    let starts = starts(&model, begin).into_iter();
    let coarsely = starts.filter_map(|start| descend(&coarse, start, f64::INFINITY, peak, 1e-3));
    let best = coarsely.min_by(|one, other| one.linearised.sum.total_cmp(&other.linearised.sum))?;
    let mut found = descend(&model, best.parameters, f64::INFINITY, peak, 1e-4)?;
    let squares = found.linearised.sum;
    let mut parameters = in_order(model.kind, found.parameters);
    let mut scale = peak;
    for sufficient in [1e-3, 1e-6] {
        scale = spread(&model, &parameters)?.max(1e-12 * peak);
        found = descend(&model, parameters, HUBER, scale, sufficient)?;
        parameters = found.parameters;
    }
    Some(Found {
        model,
        parameters,
        scale,
        ranges,
        squares,
    })
}

impl Found<'_> {
    /// Schwarz's information criterion (1978, DOI 10.1214/aos/1176344136), the less the better.
    fn criterion(&self) -> f64 {
        let n = self.model.curve.time.len() as f64;
        n * (self.squares / n).ln() + self.model.n_parameters() as f64 * n.ln()
    }

    /// The sum of the loss, with its model.
    pub(super) fn linearised(&self, parameters: &[f64]) -> Option<Linearised> {
        linearise(&self.model, parameters, HUBER, self.scale)
    }
}

/// Standard deviation of the residuals by their median.
fn spread(model: &Model, parameters: &[f64]) -> Option<f64> {
    let residuals = model.forces(parameters).ok()?.residuals;
    let sizes = residuals.into_iter().map(f64::abs);
    Some(1.4826 * median(sizes.collect()))
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

/// Squares of residuals in units of a scale; linear beyond a threshold.
fn linearise(model: &Model, parameters: &[f64], threshold: f64, scale: f64) -> Option<Linearised> {
    let forces = model.forces(parameters).ok()?;
    let residuals = forces.residuals.iter();
    let residuals: Vec<f64> = residuals.map(|residual| residual / scale).collect();
    let loss = |residual: &f64| {
        let inside = residual.abs().min(threshold);
        inside * (2.0 * residual.abs() - inside)
    };
    let weight = |residual: &f64| (threshold / residual.abs()).min(1.0) / scale;
    let weights: Vec<f64> = residuals.iter().map(weight).collect();
    let n = forces.rows.len();
    let mut matrix = vec![0.0; n * n];
    let mut descent = vec![0.0; n];
    for (j, row) in forces.rows.iter().enumerate() {
        let weighted = row.iter().zip(&weights);
        let weighted: Vec<f64> = weighted.map(|(slope, weight)| weight * slope).collect();
        let dot = |other: &[f64]| weighted.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
        descent[j] = dot(&residuals);
        for (k, other) in forces.rows[..=j].iter().enumerate() {
            matrix[j * n + k] = dot(other) / scale;
            matrix[k * n + j] = matrix[j * n + k];
        }
    }
    let sum = residuals.iter().map(loss).sum();
    Some(Linearised {
        sum,
        matrix,
        descent,
    })
}
