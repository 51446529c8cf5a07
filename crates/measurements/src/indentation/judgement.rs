//! Whether what a fit leaves is noise.
//!
//! Noise is what the points before the contact show: how large it is, and how long it lasts. Residuals that are larger, or go
//! up and down together where those points do not, come from a model that is wrong, however well the curves look.

use std::f64::consts::SQRT_2;
use std::ops::Range;

use super::IndentationCurve;
use super::checks::{SIGNIFICANT, presses_again};
use super::depth::{BY_MEDIAN, ends, median};
use super::flag::Flag;
use super::intervals::Statistics;
use super::model::Model;
use super::noise::{Likelihood, Noise};
use super::search::Found;
use super::start::{FEWEST, Start, free_points};

/// Adhesion and drift above these parts of the peak make a fit useless, or doubtful.
pub(super) const SPOILT: f64 = 0.05;
pub(super) const DOUBTFUL: f64 = 0.01;
/// Points without contact that say what noise is.
const BASELINE: usize = 10;
/// Rise of minus twice the logarithm of the likelihood when the points before the contact and all others have to have one
/// noise, above which they have not: hardly one of 100 curves has more by chance.
const MISFIT: f64 = 12.0;
/// Points that one independent point stands for, above which the residuals go up and down together.
const LASTING: f64 = 4.0;
/// Residuals that matter, as part of the peak: three times the error of a power law as a Prony series.
const MISFIT_OF_PEAK: f64 = 3e-4;
/// And in units of what the error of a smoothed depth explains, beside half of the variance before the contact, which few
/// points know.
const MISFIT_OF_PATH: f64 = 5.0;

/// Width of a contact over its depth, above which no body is meant: a sphere has R/d = 10⁵.
const BLUNT: f64 = 300.0;
/// And depth over width under a body with a round tip.
const SHARP: f64 = 3.0;

/// What the points without contact say.
pub(super) struct Judgement<'a> {
    found: &'a Found<'a>,
    begin: &'a Start,
    statistics: &'a Statistics,
    before: Range<usize>,
    behind: Range<usize>,
    /// Standard deviation of a measured point before the contact, by the median, where there are points enough, \[N].
    pub(super) noise: Option<f64>,
    /// The noise of all points, or of those before the contact where the others are something else; its variance.
    process: Option<(Noise, f64)>,
    is_misfit: bool,
}

impl<'a> Judgement<'a> {
    pub(super) fn new(found: &'a Found, begin: &'a Start, statistics: &'a Statistics) -> Self {
        let contact = &statistics.forces.contact;
        let n = contact.len();
        let first = contact.iter().position(|force| *force > 0.0).unwrap_or(n);
        let last = contact.iter().rposition(|force| *force > 0.0);
        let free = free_points(found.model.curve, begin.turn);
        // At least half of the points before the contact of the fit, which a wrong model moves by less.
        let before = 0..first.min(free.max(first / 2));
        let residuals = &statistics.forces.residuals[before.clone()];
        let middle = median(residuals.to_vec());
        let off = residuals.iter().zip(&found.measured.counts);
        let off = off.map(|(residual, count)| (residual - middle).abs() * count.sqrt());
        let is_known = before.len() >= BASELINE && before.len() + FEWEST <= n;
        let mut judgement = Self {
            found,
            begin,
            statistics,
            behind: last.map_or(n, |last| last + 1)..n,
            noise: is_known.then(|| BY_MEDIAN * median(off.collect())),
            process: None,
            is_misfit: statistics.correlated_points > LASTING,
            before,
        };
        if is_known {
            judgement.compare();
        }
        judgement
    }

    /// The points before the contact with all others.
    fn compare(&mut self) {
        let linear = &self.found.linear;
        let others = self.before.end..linear.time.len();
        let [before, others] = [self.before.clone(), others].map(|range| linear.part(range));
        let candidates = Noise::candidates(linear.time).into_iter();
        let tried = candidates.map(|noise| {
            let [before, others] = [&before, &others].map(|linear| noise.likelihood(linear));
            (noise, [before, others, before.with(others)])
        });
        let tried: Vec<(Noise, [Likelihood; 3])> = tried.collect();
        let best = |which: usize| {
            let pairs = tried.iter().map(|(noise, all)| (*noise, all[which]));
            let least = |one: &(Noise, Likelihood), other: &(Noise, Likelihood)| {
                one.1.deviance().total_cmp(&other.1.deviance())
            };
            pairs
                .min_by(least)
                .unwrap_or((tried[0].0, tried[0].1[which]))
        };
        let [alone, without, all] = [0, 1, 2].map(best);
        let variance = all.1.variance();
        let white = Noise::WHITE.likelihood(&before).deviance();
        // Points before the contact that white noise explains better do not show the noise that the others need.
        let shown = white - all.0.likelihood(&before).deviance_at(variance);
        let rise = all.1.deviance() - alone.1.deviance() - without.1.deviance();
        self.is_misfit = rise > MISFIT || self.is_misfit && shown < 0.0;
        self.process = Some(if self.is_misfit {
            (alone.0, alone.1.variance().min(variance))
        } else {
            (all.0, variance)
        });
    }

    /// What is doubtful about the fit.
    ///
    /// # Errors
    /// What makes it useless.
    pub(super) fn flags(&self) -> Result<Vec<Flag>, Flag> {
        let mut flags = Vec::new();
        let noise = self
            .process
            .map_or(self.found.squares.scale, |(_, variance)| variance.sqrt());
        // A dip is the difference of two forces.
        let least = (SQRT_2 * SIGNIFICANT * noise).max(DOUBTFUL * self.begin.peak);
        let dip = dip_on_the_way_back(self.found.model.curve, self.begin);
        if dip > SPOILT * self.begin.peak && dip > least {
            return Err(Flag::Sticks(dip));
        }
        if dip > least {
            flags.push(Flag::Sticks(dip));
        }
        if self.noise.is_none() {
            flags.push(Flag::NoBaseline);
        }
        flags.extend(self.misfit());
        flags.extend(
            self.drift(&self.before)
                .or_else(|| self.drift(&self.behind)),
        );
        flags.extend(out_of_scale(self.found));
        if presses_again(self.found.model.curve) {
            flags.push(Flag::PressedAgain);
        }
        Ok(flags)
    }

    fn misfit(&self) -> Option<Flag> {
        let residuals = &self.statistics.forces.residuals;
        let squares = residuals.iter().map(|one| one * one);
        let square = squares.sum::<f64>() / residuals.len() as f64;
        // The noise of a mean is that of a point over the root of their number.
        let counts = self.found.measured.counts.iter();
        let part = counts.map(|count| count.recip()).sum::<f64>() / residuals.len() as f64;
        let noise = self.noise.unwrap_or_default();
        let path = MISFIT_OF_PATH * self.statistics.path_error;
        let is_large = square.sqrt() > MISFIT_OF_PEAK * self.begin.peak
            && square > 0.5 * part * noise * noise + path * path;
        (self.is_misfit && is_large).then_some(Flag::Misfit {
            residual: self.found.squares.scale,
            correlated: self.statistics.correlated_points,
        })
    }

    /// The mean of residuals without contact, where it is off.
    fn drift(&self, side: &Range<usize>) -> Option<Flag> {
        let (process, variance) = self.process.filter(|_| side.len() >= BASELINE)?;
        let residuals = self.statistics.forces.residuals[side.clone()].to_vec();
        let mut columns = [vec![1.0; side.len()], residuals];
        let linear = &self.found.linear;
        process.whiten(
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
        let least = (SIGNIFICANT * (variance / weight).sqrt()).max(DOUBTFUL * self.begin.peak);
        (mean.abs() > least).then_some(Flag::Drift(mean))
    }
}

/// Whether a curved body is far too large or too small for the depth.
fn out_of_scale(found: &Found) -> Option<Flag> {
    let Model { sample, curve, .. } = &found.model;
    let body = sample.body;
    let depth = ends(&curve.depth)[1] - found.parameters[found.model.contact_point()];
    let is_curved = body.profile_exponent().is_finite();
    let radius = indenters::contact_radius(body, depth)
        .ok()
        .filter(|_| is_curved)?;
    let is_sharp = body.profile_exponent() > 1.0 && depth > SHARP * radius;
    let sharp = is_sharp.then_some(Flag::Sharp(depth / radius));
    sharp.or((radius > BLUNT * depth).then_some(Flag::Blunt(radius / depth)))
}

/// How far the force falls on the way back below what it is before the contact, \[N].
fn dip_on_the_way_back(curve: &IndentationCurve, begin: &Start) -> f64 {
    let first = median(curve.force[..=curve.force.len() / 20].to_vec());
    let reference = begin.baseline.min(first);
    let means = curve.force[begin.turn..].windows(3);
    let means = means.map(|three| (three[0] + three[1] + three[2]) / 3.0);
    reference - means.fold(f64::INFINITY, f64::min)
}
