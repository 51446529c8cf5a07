//! Least-squares fit of the parameters: several initial values on few points, then all points without outliers.

use numerics::least_squares::{ParameterRange, QuadraticModel, minimise};

use super::depth::{DEVIATION_PER_MEDIAN, median};
use super::means::Measured;
use super::model::{Kind, Model};
use super::noise::{Linear, Noise, normal_matrix};
use super::sample::Sample;
use super::start::Start;
use super::{FitOptions, IndentationCurve, Rheology};
use crate::MeasurementError;

/// Largest number of branches that a fit may have. Chosen: one curve never determines more.
pub(super) const MAX_BRANCHES: usize = 6;
/// Approximate number of points of the first search, in which all initial values are followed. Chosen.
const COARSE_POINTS: usize = 200;
/// Difference of two criteria from which on there is strong evidence for the lower one (Kass and Raftery 1995,
/// DOI 10.1080/01621459.1995.10476572).
const STRONG_EVIDENCE: f64 = 6.0;
/// Ratio of the smallest fitted relaxation time to the shortest time step of the curve. Chosen: faster branches act like a
/// dashpot.
const MIN_TIME_FACTOR: f64 = 1.0 / 3.0;
/// Ratio of the largest fitted relaxation time to the duration of the curve. Chosen: slower branches act like a spring.
const MAX_TIME_FACTOR: f64 = 30.0;

/// A minimum of the sum of squares.
pub(super) struct Found<'a> {
    pub(super) model: Model<'a>,
    pub(super) measured: &'a Measured,
    pub(super) parameters: Vec<f64>,
    pub(super) squares: Squares<'a>,
    /// Model, linearised at the parameters.
    pub(super) linear: Linear<'a>,
    /// Noises with their posterior probabilities, in decreasing order.
    pub(super) noises: Vec<(Noise, f64)>,
    /// Bounds and largest steps of all parameters.
    pub(super) ranges: Vec<ParameterRange>,
}

/// Fits the requested kind of material. The elastic one is kept if it explains the curve about as well; of a Prony series
/// without a given number, branches are added while Schwarz's criterion falls.
pub(super) fn search<'a>(
    sample: &Sample<'a>,
    measured: &'a Measured,
    options: &FitOptions,
    begin: &Start,
) -> Result<Found<'a>, MeasurementError> {
    let curve = &measured.curve;
    let few = curve.decimated(COARSE_POINTS);
    let fit_kind = |kind| {
        fit(
            Model::new(sample, curve, kind, options),
            measured,
            &few,
            begin,
        )
    };
    let elastic = fit_kind(Kind::Branches(0));
    let relaxing = match (options.rheology, options.branches) {
        (Rheology::Elastic, _) => None,
        (Rheology::PowerLaw, _) => fit_kind(Kind::PowerLaw),
        (Rheology::StandardSolid | Rheology::Prony, _) => fit_kind(Kind::Branches(1)),
    };
    // A relaxing material must explain the curve better than the elastic one; else its moduli are an arbitrary split.
    let mut found = select(elastic, relaxing, STRONG_EVIDENCE);
    let relaxes = |found: &Found| found.model.kind != Kind::Branches(0);
    if options.rheology == Rheology::Prony && found.as_ref().is_some_and(relaxes) {
        found = match options.branches {
            Some(1) => found,
            Some(n) => fit_kind(Kind::Branches(n)),
            None => with_branches(found, fit_kind),
        };
    }
    found.ok_or_else(|| {
        // All fits have failed. Compute the forces of an elastic sample to find the reason, most often a depth that is too large
        // for the body.
        let elastic = Model::new(sample, curve, Kind::Branches(0), options);
        let mut parameters = vec![0.0, curve.depth[0], 0.0, 0.0];
        parameters.extend(begin.thickness);
        let refused = elastic.forces(&parameters).err();
        refused.unwrap_or(MeasurementError::NotConverged)
    })
}

/// Selects the second fit if its criterion is lower by more than a margin.
fn select<'a>(
    first: Option<Found<'a>>,
    second: Option<Found<'a>>,
    margin: f64,
) -> Option<Found<'a>> {
    let is_better = match (&first, &second) {
        (Some(first), Some(second)) => second.criterion() < first.criterion() - margin,
        (first, _) => first.is_none(),
    };
    if is_better { second } else { first }
}

/// Adds branches to a fit with one, until another branch does not lower Schwarz's criterion or there are [`MAX_BRANCHES`].
fn with_branches<'a>(
    mut best: Option<Found<'a>>,
    fit_kind: impl Fn(Kind) -> Option<Found<'a>>,
) -> Option<Found<'a>> {
    for n in 2..=MAX_BRANCHES {
        best = select(best, fit_kind(Kind::Branches(n)), 0.0);
        if best
            .as_ref()
            .is_none_or(|best| best.model.kind != Kind::Branches(n))
        {
            break;
        }
    }
    best
}

/// Fit of one kind of material: the best of several initial values on few points, then all points, then without outliers.
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
    let coarse_squares = Squares::new(&ones, peak);
    let mut squares = Squares::new(&measured.counts, peak);
    let descend = |model: &Model, squares: &Squares, start, sufficient: f64| {
        let sum = |parameters: &[f64]| squares.linearise(model, parameters);
        minimise(sum, start, &ranges, sufficient)
    };
    let starts = starts(&model, begin).into_iter();
    let found = starts.filter_map(|start| descend(&coarse, &coarse_squares, start, 1e-3));
    let best = found.min_by(|one, other| one.model.sum.total_cmp(&other.model.sum))?;
    let found = descend(&model, &squares, best.parameters, 1e-4)?;
    // Alternate twice between finding the outliers and fitting the parameters, because each depends on the other.
    let mut parameters = sort_branches(model.kind, found.parameters);
    for sufficient in [1e-3, 1e-6] {
        squares.find_outliers(&model, &parameters, 1e-12 * peak)?;
        parameters = descend(&model, &squares, parameters, sufficient)?.parameters;
    }
    let linear = linear(&model, measured, &parameters, &squares)?;
    Some(Found {
        noises: Noise::likely(&linear),
        linear,
        model,
        measured,
        parameters,
        squares,
        ranges,
    })
}

/// The model linearised at the parameters, for the noise: columns of derivatives of unit norm, and the residuals without
/// outliers. `None` if the model has no forces there.
fn linear<'a>(
    model: &Model<'a>,
    measured: &'a Measured,
    parameters: &[f64],
    squares: &Squares,
) -> Option<Linear<'a>> {
    let forces = model.forces(parameters).ok()?;
    let scaled = |row: Vec<f64>| {
        let norm = row.iter().map(|slope| slope * slope).sum::<f64>().sqrt();
        let norm = if norm > 0.0 { norm } else { 1.0 };
        row.iter().map(|slope| slope / norm).collect()
    };
    let mut columns: Vec<Vec<f64>> = forces.rows.into_iter().map(scaled).collect();
    columns.push(squares.without_outliers(&forces.residuals));
    Some(Linear {
        time: &measured.curve.time,
        counts: &measured.counts,
        columns,
    })
}

impl Found<'_> {
    /// Schwarz's information criterion (1978, DOI 10.1214/aos/1176344136); the fit with the lowest value is the best.
    fn criterion(&self) -> f64 {
        let residuals = Linear {
            columns: self.linear.columns[self.parameters.len()..].to_vec(),
            ..self.linear
        };
        let n = self.linear.time.len() as f64;
        let deviance = self.noises[0].0.likelihood(&residuals).deviance();
        deviance + self.model.n_parameters() as f64 * n.ln()
    }

    /// Sum of squares with its quadratic model.
    pub(super) fn linearise(&self, parameters: &[f64]) -> Option<QuadraticModel> {
        self.squares.linearise(&self.model, parameters)
    }
}

/// Bounds and largest steps of all parameters around the elastic initial fit: nine decades either way for moduli,
/// [`MIN_TIME_FACTOR`] to [`MAX_TIME_FACTOR`] for times. Baseline and tilt are unbounded.
fn ranges(model: &Model, begin: &Start) -> Vec<ParameterRange> {
    let range = |bounds: [f64; 2], largest_step| ParameterRange {
        bounds,
        largest_step,
    };
    let modulus = begin.modulus.abs().ln();
    let moduli = range([modulus - 21.0, modulus + 21.0], 2.0);
    let [step, length] = model.times;
    let times = range(
        [
            (MIN_TIME_FACTOR * step).ln(),
            (MAX_TIME_FACTOR * length).ln(),
        ],
        2.0,
    );
    // Collect the ranges of all parameters in their order: material, contact point, baseline, tilt, thickness.
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
    if let (Some(bounds), Some(last)) = (model.sample.range(), ranges.last_mut()) {
        *last = range(bounds, 0.5);
    }
    ranges
}

/// Initial values of all parameters: those of the elastic fit, with one or several guesses of how the modulus relaxes.
fn starts(model: &Model, begin: &Start) -> Vec<Vec<f64>> {
    let modulus = begin.modulus.abs();
    let [step, length] = model.times;
    let material: Vec<Vec<f64>> = match model.kind {
        Kind::PowerLaw => {
            let start = |beta| vec![modulus.ln() + beta * (0.5 * begin.approach_time).ln(), beta];
            [0.05, 0.3].map(start).into()
        }
        Kind::Branches(0) => vec![vec![modulus.ln()]],
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
    let others = [begin.contact_point, begin.baseline].into_iter();
    let others = others
        .chain(model.tilt.then_some(0.0))
        .chain(begin.thickness);
    let others: Vec<f64> = others.collect();
    let complete = |start: Vec<f64>| [start, others.clone()].concat();
    material.into_iter().map(complete).collect()
}

/// The parameters with branches in increasing order of times.
fn sort_branches(kind: Kind, parameters: Vec<f64>) -> Vec<f64> {
    let Kind::Branches(n) = kind else {
        return parameters;
    };
    let mut branches: Vec<&[f64]> = parameters[1..=2 * n].chunks(2).collect();
    branches.sort_by(|one, other| one[1].total_cmp(&other[1]));
    let sorted = branches.concat();
    [&parameters[..1], &sorted, &parameters[2 * n + 1..]].concat()
}

/// Smallest distance of the residual of an outlier from the median of its neighbours, in their standard deviations. Chosen.
///
/// Outliers are replaced by that median (Hampel 1974, DOI 10.1080/01621459.1974.10482962).
const OUTLIER_DEVIATIONS: f64 = 4.0;
/// Number of neighbours on each side of a point whose residuals form the median for outliers. Chosen.
const OUTLIER_NEIGHBOURS: usize = 12;

/// Scaled residuals, with outliers replaced by the median of their neighbours.
pub(super) struct Squares<'a> {
    /// Numbers of measured points in each mean.
    counts: &'a [f64],
    /// Distances of the outliers from the median of their neighbours, \[N]; 0 for all other points.
    outlier_offsets: Vec<f64>,
    /// Standard deviation of a measured point, \[N].
    pub(super) scale: f64,
}

impl<'a> Squares<'a> {
    /// Weights by the number of measured points `counts` behind each point, standard deviation `scale` \[N], and no outliers
    /// yet.
    fn new(counts: &'a [f64], scale: f64) -> Self {
        Self {
            counts,
            outlier_offsets: vec![0.0; counts.len()],
            scale,
        }
    }

    /// Updates the scale, which is at least `least` \[N], and the outliers.
    ///
    /// Outliers are relative to their neighbours, which slow noise shifts equally.
    fn find_outliers(&mut self, model: &Model, parameters: &[f64], least: f64) -> Option<()> {
        let residuals = model.forces(parameters).ok()?.residuals;
        let last = residuals.len() - 1;
        let near =
            |i: usize| i.saturating_sub(OUTLIER_NEIGHBOURS)..=(i + OUTLIER_NEIGHBOURS).min(last);
        let deviations = |i: usize| residuals[i] - median(residuals[near(i)].to_vec());
        let deviations: Vec<f64> = (0..=last).map(deviations).collect();
        let sizes = |values: &[f64]| -> Vec<f64> {
            let pairs = values.iter().zip(self.counts);
            pairs.map(|(value, n)| value.abs() * n.sqrt()).collect()
        };
        self.scale = (DEVIATION_PER_MEDIAN * median(sizes(&residuals))).max(least);
        let sizes = sizes(&deviations);
        // Noise that increases with the force has its own local scale.
        let usual =
            |i: usize| (DEVIATION_PER_MEDIAN * median(sizes[near(i)].to_vec())).max(self.scale);
        let outlier_offsets = (0..=last).map(|i| {
            let is_outlier = sizes[i] > OUTLIER_DEVIATIONS * usual(i);
            if is_outlier { deviations[i] } else { 0.0 }
        });
        self.outlier_offsets = outlier_offsets.collect();
        Some(())
    }

    /// Residuals with those of outliers replaced by the median of their neighbours.
    pub(super) fn without_outliers(&self, residuals: &[f64]) -> Vec<f64> {
        let pairs = residuals.iter().zip(&self.outlier_offsets);
        pairs.map(|(residual, offset)| residual - offset).collect()
    }

    /// A column, one entry per point \[N], in units of the standard deviation of each point, scale/√count.
    pub(super) fn weighted(&self, column: &[f64]) -> Vec<f64> {
        let pairs = column.iter().zip(self.counts);
        pairs
            .map(|(value, count)| value * count.sqrt() / self.scale)
            .collect()
    }

    /// Weighted sum of squares without outliers, with its Gauss–Newton model; `None` if the model has no forces there.
    fn linearise(&self, model: &Model, parameters: &[f64]) -> Option<QuadraticModel> {
        let forces = model.forces(parameters).ok()?;
        let without_outliers = self.without_outliers(&forces.residuals);
        let columns = forces.rows.iter().chain([&without_outliers]);
        let columns: Vec<Vec<f64>> = columns.map(|column| self.weighted(column)).collect();
        let products = normal_matrix(&columns);
        let n = forces.rows.len();
        let entries = |row: usize| products[row * (n + 1)..][..n].to_vec();
        Some(QuadraticModel {
            sum: products[n * (n + 1) + n],
            matrix: (0..n).flat_map(entries).collect(),
            descent: entries(n),
        })
    }
}
