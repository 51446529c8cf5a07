//! Whether a curve is what its columns say.

use indenters::{Axisymmetric, contact_radius};

use super::IndentationCurve;
use super::depth::{self, ends};
use super::flag::Flag;
use super::means::Measured;
use super::start::{FEWEST, Start};

/// A gap, relative to the steps around it.
const GAP: f64 = 20.0;
/// Equal largest forces in a row, and the speed that the body has at least, relative to before.
const RUN: usize = 5;
const GOES_ON: f64 = 0.3;
/// Standard deviations that are more than noise.
pub(super) const SIGNIFICANT: f64 = 6.0;
/// Ratio of the width of a contact to its depth, or the reverse, beyond which no experiment is.
const SCALE: f64 = 1e9;
/// Part of the depth range by which a body must be pulled back, and pressed again, to be more than noise.
const AGAIN: f64 = 0.05;
/// The curve in means with a smooth depth, and without the retraction where that is asked for.
pub(super) fn usable(curve: &IndentationCurve, before_retraction: bool) -> Result<Measured, Flag> {
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
    let [low, high] = ends(&curve.depth);
    if low >= high {
        return Err(Flag::ConstantDepth(low));
    }
    saturation(curve)?;
    let mut curve = curve.clone();
    if before_retraction {
        let ones = vec![1.0; curve.time.len()];
        let jitter = 4.0 * depth::noise(&curve.time, &curve.depth, &ones);
        let deep = high - jitter.max(1e-3 * (high - low));
        let last = curve.depth.iter().rposition(|depth| *depth >= deep);
        curve = curve.first(last.map_or(0, |last| last + 1));
    }
    if curve.time.len() < FEWEST {
        return Err(Flag::TooFew(curve.time.len()));
    }
    Ok(Measured::new(&curve))
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

/// Whether the body would have a contact of any sensible shape at the depths of the curve.
pub(super) fn scale(body: &dyn Axisymmetric, curve: &IndentationCurve) -> Result<(), Flag> {
    let [low, high] = ends(&curve.depth);
    // A body that ends above the whole range is refused later, where the contact point is known.
    let radius = contact_radius(body, high - low).unwrap_or(body.max_radius());
    let ratio = radius / (high - low);
    let holds = ratio > SCALE.recip() && ratio < SCALE;
    if holds {
        Ok(())
    } else {
        Err(Flag::OutOfScale(ratio.clamp(f64::MIN_POSITIVE, f64::MAX)))
    }
}

/// What makes a fit useless, by the elastic start.
pub(super) fn before(measured: &Measured, begin: &Start) -> Result<(), Flag> {
    let Measured { curve, counts, .. } = measured;
    let noise = depth::noise(&curve.time, &curve.force, counts).max(0.5 * begin.residual);
    if begin.peak.abs() <= SIGNIFICANT * noise {
        return Err(Flag::NoContact(noise));
    }
    if begin.peak < 0.0 {
        return Err(Flag::WrongSign);
    }
    Ok(())
}

/// Whether the body goes down again after it was pulled back, by more than the noise of a dwell.
pub(super) fn presses_again(curve: &IndentationCurve) -> bool {
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
