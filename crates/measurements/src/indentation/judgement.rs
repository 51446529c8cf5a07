//! Tests of the residuals of a fit against the noise before the contact.
//!
//! The points before the contact determine size and correlation time of the noise. Larger residuals, or residuals that are
//! correlated over longer times, show a misfit of the model.

use std::f64::consts::SQRT_2;
use std::ops::Range;

use super::IndentationCurve;
use super::checks::{NOISE_DEVIATIONS, presses_again};
use super::depth::{DEVIATION_PER_MEDIAN, median, min_max};
use super::flag::Flag;
use super::intervals::Statistics;
use super::model::Model;
use super::noise::{Likelihood, Noise};
use super::search::Found;
use super::start::{MIN_POINTS, Start, free_points};

/// Ratio of the force of adhesion to the peak force, above which a fit is refused. Chosen: moduli are proportional to the
/// force and change by 5 % or more, since the fitted models have no adhesion.
pub(super) const MAX_FORCE_DEFECT: f64 = 0.05;
/// Ratio of the force of adhesion, or of the drift of the force, to the peak force, above which a fit is flagged. Chosen:
/// moduli are proportional to the force, so that a smaller one changes them by the order of 1 %.
pub(super) const MIN_FORCE_DEFECT: f64 = 0.01;
/// Smallest number of points without contact from which the noise is determined. Chosen: a standard deviation from the
/// median absolute deviation of 10 points has a relative error of 1.17/√10, 37 %.
const MIN_BASELINE_POINTS: usize = 10;
/// Rise of the deviance, if the points before the contact and all others share one noise, above which a misfit is reported.
/// Chosen: fewer than one in 100 curves exceed it by chance.
const MAX_DEVIANCE_RISE: f64 = 12.0;
/// Number of correlated residuals that carry the information of an independent one, above which a misfit is reported.
/// Chosen: filters of instruments correlate a few neighbouring points, a misfit all points of a part of the curve.
const MAX_CORRELATED_POINTS: f64 = 4.0;
/// Ratio of the rms residual to the peak force up to which there is no misfit. Derived: 3 times the error of a power law as a
/// Prony series.
const MIN_MISFIT_OF_PEAK: f64 = 3e-4;
/// Ratio of the rms residual to the force error of a smoothed depth up to which there is no misfit. Chosen: above 1 by a
/// margin, because the force error of the depth is itself an estimate.
const MIN_MISFIT_OF_PATH: f64 = 5.0;

/// Ratio of width to depth of a contact above which a fit is flagged. Chosen: for a sphere it means R/d = 10⁵, with the radius R
/// and the depth d.
const MAX_WIDTH_RATIO: f64 = 300.0;
/// Ratio of depth to width of a contact with a round tip, above which a fit is flagged. Chosen: for a paraboloid of tip
/// radius R it means d = 9 R with the depth d, where slopes are not small.
const MAX_DEPTH_RATIO: f64 = 3.0;

/// Assessment of a fit by the points without contact.
pub(super) struct Judgement<'a> {
    found: &'a Found<'a>,
    /// The elastic initial fit.
    begin: &'a Start,
    statistics: &'a Statistics,
    /// Points before the contact.
    before: Range<usize>,
    /// Points after the contact.
    after: Range<usize>,
    /// Standard deviation of a measured point before the contact, from the median, \[N]; `None` for too few points.
    pub(super) noise: Option<f64>,
    /// Noise with its variance: of all points, or for a misfit of those before the contact.
    noise_model: Option<(Noise, f64)>,
    /// True if residuals in contact are not the noise before it.
    is_misfit: bool,
}

impl<'a> Judgement<'a> {
    /// Finds the points without contact, and compares their noise with that of the residuals in contact.
    pub(super) fn new(found: &'a Found, begin: &'a Start, statistics: &'a Statistics) -> Self {
        let contact = &statistics.forces.contact;
        let n = contact.len();
        let first = contact.iter().position(|force| *force > 0.0).unwrap_or(n);
        let last = contact.iter().rposition(|force| *force > 0.0);
        let free = free_points(found.model.curve, begin.turn);
        // Use at least half of the points before the fitted contact, because a wrong model shifts the contact point.
        let before = 0..first.min(free.max(first / 2));
        let residuals = &statistics.forces.residuals[before.clone()];
        let middle = median(residuals.to_vec());
        let off = residuals
            .iter()
            .zip(&found.measured.counts)
            .map(|(residual, count)| (residual - middle).abs() * count.sqrt());
        let is_known = before.len() >= MIN_BASELINE_POINTS && before.len() + MIN_POINTS <= n;
        let mut judgement = Self {
            found,
            begin,
            statistics,
            after: last.map_or(n, |last| last + 1)..n,
            noise: is_known.then(|| DEVIATION_PER_MEDIAN * median(off.collect())),
            noise_model: None,
            is_misfit: statistics.correlated_points > MAX_CORRELATED_POINTS,
            before,
        };
        if is_known {
            judgement.compare_noise();
        }
        judgement
    }

    /// Compares the noise of the points before the contact with that of all others. A misfit is found if one common noise has a
    /// deviance that is larger than that of two separate ones by more than [`MAX_DEVIANCE_RISE`].
    fn compare_noise(&mut self) {
        let linear = &self.found.linear;
        let others = self.before.end..linear.time.len();
        let [before, others] = [self.before.clone(), others].map(|range| linear.part(range));
        let candidates = Noise::candidates(linear.time).into_iter();
        let judged = candidates.map(|noise| {
            let [before, others] = [&before, &others].map(|linear| noise.likelihood(linear));
            (noise, [before, others, before.combine(others)])
        });
        let judged: Vec<(Noise, [Likelihood; 3])> = judged.collect();
        let best = |which: usize| {
            let pairs = judged.iter().map(|(noise, all)| (*noise, all[which]));
            let least = |one: &(Noise, Likelihood), other: &(Noise, Likelihood)| {
                one.1.deviance().total_cmp(&other.1.deviance())
            };
            pairs
                .min_by(least)
                .unwrap_or((judged[0].0, judged[0].1[which]))
        };
        let [alone, without, all] = [0, 1, 2].map(best);
        let variance = all.1.variance();
        let white = Noise::WHITE.likelihood(&before).deviance();
        // Compare the deviances with common and with separate noises. White noise may explain the points before the contact
        // better than the noise of all points.
        let shown = white - all.0.likelihood(&before).deviance_at(variance);
        let rise = all.1.deviance() - alone.1.deviance() - without.1.deviance();
        self.is_misfit = rise > MAX_DEVIANCE_RISE || self.is_misfit && shown < 0.0;
        self.noise_model = Some(if self.is_misfit {
            (alone.0, alone.1.variance().min(variance))
        } else {
            (all.0, variance)
        });
    }

    /// Warnings about the fit.
    ///
    /// # Errors
    /// The flag for which the fit is refused.
    pub(super) fn flags(&self) -> Result<Vec<Flag>, Flag> {
        let mut flags = Vec::new();
        let noise = self
            .noise_model
            .map_or(self.found.squares.scale, |(_, variance)| variance.sqrt());
        // The dip is significant above √2 times the limit of a single force, because it is the difference of two forces.
        let least = (SQRT_2 * NOISE_DEVIATIONS * noise).max(MIN_FORCE_DEFECT * self.begin.peak);
        let dip = dip_on_the_way_back(self.found.model.curve, self.begin);
        if dip > MAX_FORCE_DEFECT * self.begin.peak && dip > least {
            return Err(Flag::Sticks(dip));
        }
        if dip > least {
            flags.push(Flag::Sticks(dip));
        }
        if self.noise.is_none() {
            flags.push(Flag::NoBaseline);
        }
        flags.extend(self.misfit());
        flags.extend(self.drift(&self.before).or_else(|| self.drift(&self.after)));
        flags.extend(out_of_scale(self.found));
        if presses_again(self.found.model.curve) {
            flags.push(Flag::PressedAgain);
        }
        Ok(flags)
    }

    /// Flag for a misfit whose residual is relevant: above fractions of the peak force and of the force error of a smoothed
    /// depth, and above the noise.
    fn misfit(&self) -> Option<Flag> {
        let residuals = &self.statistics.forces.residuals;
        let squares = residuals.iter().map(|one| one * one);
        let square = squares.sum::<f64>() / residuals.len() as f64;
        // Average the inverse numbers of points per mean, because the variance of a mean is that of a point divided by their
        // number.
        let counts = self.found.measured.counts.iter();
        let part = counts.map(|count| count.recip()).sum::<f64>() / residuals.len() as f64;
        let noise = self.noise.unwrap_or_default();
        let path = MIN_MISFIT_OF_PATH * self.statistics.path_error;
        let is_large = square.sqrt() > MIN_MISFIT_OF_PEAK * self.begin.peak
            && square > 0.5 * part * noise * noise + path * path;
        (self.is_misfit && is_large).then_some(Flag::Misfit {
            residual: self.found.squares.scale,
            correlated: self.statistics.correlated_points,
        })
    }

    /// Flag if the mean residual of the points of a side without contact is significant; `None` otherwise, and for too few
    /// points.
    fn drift(&self, side: &Range<usize>) -> Option<Flag> {
        let (noise_model, variance) = self
            .noise_model
            .filter(|_| side.len() >= MIN_BASELINE_POINTS)?;
        let residuals = self.statistics.forces.residuals[side.clone()].to_vec();
        let mut columns = [vec![1.0; side.len()], residuals];
        let linear = &self.found.linear;
        noise_model.whiten(
            &linear.time[side.clone()],
            &linear.counts[side.clone()],
            &mut columns,
        );
        let [ones, residuals] = columns;
        let weight: f64 = ones.iter().map(|one| one * one).sum();
        let products = ones
            .iter()
            .zip(&residuals)
            .map(|(one, residual)| one * residual);
        let mean = products.sum::<f64>() / weight;
        let least =
            (NOISE_DEVIATIONS * (variance / weight).sqrt()).max(MIN_FORCE_DEFECT * self.begin.peak);
        (mean.abs() > least).then_some(Flag::Drift(mean))
    }
}

/// Flag for a curved body that is implausibly large or small for the depth.
fn out_of_scale(found: &Found) -> Option<Flag> {
    let Model { sample, curve, .. } = &found.model;
    let body = sample.body;
    let depth = min_max(&curve.depth)[1] - found.parameters[found.model.contact_point()];
    let is_curved = body.profile_exponent().is_finite();
    let radius = indenters::contact_radius(body, depth)
        .ok()
        .filter(|_| is_curved)?;
    let is_sharp = body.profile_exponent() > 1.0 && depth > MAX_DEPTH_RATIO * radius;
    let sharp = is_sharp.then_some(Flag::Sharp(depth / radius));
    sharp.or((radius > MAX_WIDTH_RATIO * depth).then_some(Flag::Blunt(radius / depth)))
}

/// Fall of the force on the retraction below its value before the contact, \[N].
fn dip_on_the_way_back(curve: &IndentationCurve, begin: &Start) -> f64 {
    let first = median(curve.force[..=curve.force.len() / 20].to_vec());
    let reference = begin.baseline.min(first);
    let lowest_mean = curve.force[begin.turn..]
        .windows(3)
        .map(|three| (three[0] + three[1] + three[2]) / 3.0)
        .fold(f64::INFINITY, f64::min);
    reference - lowest_mean
}
