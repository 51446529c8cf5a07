//! Whether a curve is what its columns say.

use super::IndentationCurve;
use super::depth::{self, ends, median};
use super::flag::Flag;
use super::intervals::Statistics;
use super::model::Forces;
use super::search::Found;
use super::start::{FEWEST, Start};

/// A gap, relative to the steps around it.
const GAP: f64 = 20.0;
/// Equal largest forces in a row, and the speed that the body has at least, relative to before.
const RUN: usize = 5;
const GOES_ON: f64 = 0.3;
/// Standard deviations that are more than noise.
const SIGNIFICANT: f64 = 6.0;
/// Adhesion and drift above these parts of the peak make a fit useless, or doubtful.
const SPOILT: f64 = 0.05;
const DOUBTFUL: f64 = 0.01;
/// Part of the depth range by which a body must be pulled back, and pressed again, to be more than noise.
const AGAIN: f64 = 0.05;
/// Residuals that are so many times the noise.
const MISFIT: f64 = 2.0;
/// And more than ten times the error of a power law as a Prony series.
const MISFIT_OF_PEAK: f64 = 1e-3;

/// The curve with a smooth depth, and without the retraction where that is asked for.
pub(super) fn usable(
    curve: &IndentationCurve,
    before_retraction: bool,
) -> Result<IndentationCurve, Flag> {
    let time = &curve.time;
    if time.len() < FEWEST {
        return Err(Flag::TooFew(time.len()));
    }
    let is_bad = |i: &usize| !(time[*i] + curve.depth[*i] + curve.force[*i]).is_finite();
    if let Some(bad) = (0..time.len()).find(is_bad) {
        return Err(Flag::NotANumber(bad + 1));
    }
    if let Some(place) = time.windows(2).position(|pair| pair[1] <= pair[0]) {
        return Err(Flag::TimeGoesBack(place + 2));
    }
    let is_gap = |t: &[f64]| t[2] - t[1] > GAP * (t[1] - t[0]).max(t[3] - t[2]);
    if let Some(place) = time.windows(4).position(is_gap) {
        return Err(Flag::Gap(time[place + 1]));
    }
    saturation(curve)?;
    let mut curve = curve.clone();
    if before_retraction {
        let [low, high] = ends(&curve.depth);
        let jitter = 4.0 * depth::noise(&curve.time, &curve.depth);
        let deep = high - jitter.max(1e-3 * (high - low));
        let last = curve.depth.iter().rposition(|depth| *depth >= deep);
        curve = curve.first(last.map_or(0, |last| last + 1));
    }
    if curve.time.len() < FEWEST {
        return Err(Flag::TooFew(curve.time.len()));
    }
    curve.depth = depth::smoothed(&curve.time, &curve.depth);
    Ok(curve)
}

/// Whether the largest force stays the same over some points while the body goes on.
fn saturation(IndentationCurve { time, depth, force }: &IndentationCurve) -> Result<(), Flag> {
    let [_, largest] = ends(force);
    let speed = |from: usize, to: usize| (depth[to] - depth[from]).abs() / (time[to] - time[from]);
    let goes_on = |start: usize| {
        let run = &force[start..start + RUN];
        let is_run = run.iter().all(|force| *force >= largest);
        let begins = is_run && force[start - 1] < largest;
        begins && speed(start, start + RUN - 1) > GOES_ON * speed(start - RUN, start)
    };
    if (RUN..force.len() + 1 - RUN).any(goes_on) {
        return Err(Flag::Saturated(largest));
    }
    Ok(())
}

/// What makes a fit useless, by the elastic start.
pub(super) fn before(curve: &IndentationCurve, begin: &Start) -> Result<(), Flag> {
    let noise = depth::noise(&curve.time, &curve.force).max(0.5 * begin.residual);
    if begin.peak.abs() <= SIGNIFICANT * noise {
        return Err(Flag::NoContact(noise));
    }
    if begin.peak < 0.0 {
        return Err(Flag::WrongSign);
    }
    dips(curve, begin, SPOILT).map_or(Ok(()), Err)
}

/// Adhesion by more than the noise and a part of the peak.
fn dips(curve: &IndentationCurve, begin: &Start, part: f64) -> Option<Flag> {
    let noise = depth::noise(&curve.time, &curve.force);
    let n = curve.force.len();
    let after = median(curve.force[n - n / 20 - 1..].to_vec());
    let reference = begin.baseline.min(after);
    let mean = |three: &[f64]| (three[0] + three[1] + three[2]) / 3.0;
    let dip = |forces: &[f64]| {
        let means = forces.windows(3).map(mean);
        let dip = reference - means.fold(f64::INFINITY, f64::min);
        (dip > (SIGNIFICANT * noise).max(part * begin.peak)).then_some(dip)
    };
    let (way_in, way_back) = curve.force.split_at(begin.turn);
    let jump = dip(way_in).map(Flag::JumpToContact);
    jump.or_else(|| dip(way_back).map(Flag::Sticks))
}

/// Residuals before and after the contact.
fn without_contact(statistics: &Statistics) -> [&[f64]; 2] {
    let Forces {
        residuals, contact, ..
    } = &statistics.forces;
    let n = residuals.len();
    let first = contact.iter().position(|force| *force > 0.0);
    let last = contact.iter().rposition(|force| *force > 0.0);
    let behind = last.map_or(n, |last| last + 1);
    [&residuals[..first.unwrap_or(n)], &residuals[behind..]]
}

/// Noise before the contact, where there are points enough.
pub(super) fn noise(statistics: &Statistics) -> Option<f64> {
    let [before, _] = without_contact(statistics);
    let middle = median(before.to_vec());
    let off = before.iter().map(|residual| (residual - middle).abs());
    (before.len() >= 10).then(|| 1.4826 * median(off.collect()))
}

/// What is doubtful about a fit.
pub(super) fn after(found: &Found, begin: &Start, statistics: &Statistics) -> Vec<Flag> {
    let curve = found.model.curve;
    let mut flags = Vec::from_iter(dips(curve, begin, DOUBTFUL));
    match noise(statistics) {
        None => flags.push(Flag::NoBaseline),
        Some(noise) if found.scale > (MISFIT * noise).max(MISFIT_OF_PEAK * begin.peak) => {
            flags.push(Flag::Misfit(found.scale / noise));
        }
        Some(_) => {}
    }
    let noise = depth::noise(&curve.time, &curve.force);
    let mut sides = without_contact(statistics).into_iter();
    flags.extend(sides.find_map(|residuals| {
        let n = residuals.len() as f64;
        let mean = residuals.iter().sum::<f64>() / n;
        let least = (SIGNIFICANT * noise / n.sqrt()).max(DOUBTFUL * begin.peak);
        (n >= 10.0 && mean.abs() > least).then_some(Flag::Drift(mean))
    }));
    if presses_again(curve) {
        flags.push(Flag::PressedAgain);
    }
    flags
}

/// Whether the body goes down again after it was pulled back, by more than the noise of a dwell.
fn presses_again(curve: &IndentationCurve) -> bool {
    let [low, high] = ends(&curve.depth);
    let [mut deepest, mut left] = [low, f64::INFINITY];
    curve.depth.iter().any(|&depth| {
        deepest = deepest.max(depth);
        if deepest - depth > AGAIN * (high - low) {
            left = left.min(depth);
        }
        depth - left > AGAIN * (high - low)
    })
}
