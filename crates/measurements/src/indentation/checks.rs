//! Plausibility checks of a measured curve.

use indenters::{Axisymmetric, contact_radius};

use super::IndentationCurve;
use super::depth::{self, min_max};
use super::flag::Flag;
use super::means::Measured;
use super::start::{MIN_POINTS, Start};

/// Ratio of a time step to the longer one of its two neighbours, above which points are missing and the curve is refused.
/// Chosen: it is far above the jitter of a clock and above a tenfold change of the sampling rate.
const MIN_GAP_RATIO: f64 = 20.0;
/// Number of successive points with exactly the largest force from which the sensor counts as saturated, if the body moves
/// on. Chosen: the steps of a digitised force make two or three successive largest values equal.
const SATURATED_POINTS: usize = 5;
/// Ratio of the speed of the body at the largest force to its speed before, above which the body counts as moving on.
/// Chosen: a body that turns is nearly at rest at the largest force, one that moves on keeps its speed.
const MIN_SPEED_RATIO: f64 = 0.3;
/// Smallest deviation that counts as significant, in standard deviations of the noise. Chosen: normal noise reaches it in
/// one of 5·10⁸ points, which no curve has.
pub(super) const NOISE_DEVIATIONS: f64 = 6.0;
/// Largest plausible ratio of width to depth of a contact, and of depth to width. Beyond it the units of the curve are taken
/// for wrong. Chosen: nanometres that are read as metres make a ratio of 1 as large.
const MAX_ASPECT_RATIO: f64 = 1e9;
/// Ratio of a decrease or increase of the depth to its range, above which it is a turn of the body and not noise. A curve that is
/// pressed again after a turn is recognised by it. Chosen, above the noise of a hold.
const REVERSAL_FRACTION: f64 = 0.05;

/// The checked curve as means with a smooth depth, and without the retraction if that is asked for.
pub(super) fn prepare(curve: &IndentationCurve, before_retraction: bool) -> Result<Measured, Flag> {
    let time = &curve.time;
    if time.len() < MIN_POINTS {
        return Err(Flag::TooFew(time.len()));
    }
    let is_bad = |i: &usize| !(time[*i] + curve.depth[*i] + curve.force[*i]).is_finite();
    if let Some(bad) = (0..time.len()).find(is_bad) {
        return Err(Flag::NotANumber(bad + 1));
    }
    if let Some(place) = time.windows(2).position(|pair| pair[1] <= pair[0]) {
        return Err(Flag::TimeGoesBack(place + 2));
    }
    // A gap is a time step much longer than both of its neighbours. A lower sampling rate from some point on is no gap.
    let is_gap = |t: &[f64]| t[2] - t[1] > MIN_GAP_RATIO * (t[1] - t[0]).max(t[3] - t[2]);
    if let Some(place) = time.windows(4).position(is_gap) {
        return Err(Flag::Gap(time[place + 1]));
    }
    let [low, high] = min_max(&curve.depth);
    if low >= high {
        return Err(Flag::ConstantDepth(low));
    }
    check_saturation(curve)?;
    let mut curve = curve.clone();
    if before_retraction {
        // The retraction begins behind the last point that is as deep as the deepest one, up to four standard deviations of the noise.
        let ones = vec![1.0; curve.time.len()];
        let jitter = 4.0 * depth::noise(&curve.time, &curve.depth, &ones);
        let deep = high - jitter.max(1e-3 * (high - low));
        let last = curve.depth.iter().rposition(|depth| *depth >= deep);
        curve = curve.first(last.map_or(0, |last| last + 1));
    }
    if curve.time.len() < MIN_POINTS {
        return Err(Flag::TooFew(curve.time.len()));
    }
    Ok(Measured::new(&curve))
}

/// Refuses a curve whose largest force is constant over several points while the body moves on.
fn check_saturation(
    IndentationCurve { time, depth, force }: &IndentationCurve,
) -> Result<(), Flag> {
    let [_, largest] = min_max(force);
    let speed = |from: usize, to: usize| (depth[to] - depth[from]).abs() / (time[to] - time[from]);
    let goes_on = |start: usize| {
        let run = &force[start..start + SATURATED_POINTS];
        let is_run = run.iter().all(|force| *force >= largest);
        let begins = is_run && force[start - 1] < largest;
        begins
            && speed(start, start + SATURATED_POINTS - 1)
                > MIN_SPEED_RATIO * speed(start - SATURATED_POINTS, start)
    };
    if (SATURATED_POINTS..force.len() + 1 - SATURATED_POINTS).any(goes_on) {
        return Err(Flag::Saturated(largest));
    }
    Ok(())
}

/// Refuses a curve whose contact would be implausibly wide or narrow.
pub(super) fn check_scale(body: &dyn Axisymmetric, curve: &IndentationCurve) -> Result<(), Flag> {
    let [low, high] = min_max(&curve.depth);
    // A body that ends below the whole range is refused later, when the contact point is known.
    let radius = contact_radius(body, high - low).unwrap_or(body.max_radius());
    let ratio = radius / (high - low);
    let holds = ratio > MAX_ASPECT_RATIO.recip() && ratio < MAX_ASPECT_RATIO;
    if holds {
        Ok(())
    } else {
        Err(Flag::OutOfScale(ratio.clamp(f64::MIN_POSITIVE, f64::MAX)))
    }
}

/// Refuses a curve whose force, in the elastic initial fit `begin`, does not rise above [`NOISE_DEVIATIONS`] of its noise, or
/// falls.
pub(super) fn check_contact(measured: &Measured, begin: &Start) -> Result<(), Flag> {
    let Measured { curve, counts, .. } = measured;
    let noise = depth::noise(&curve.time, &curve.force, counts).max(0.5 * begin.residual);
    if begin.peak.abs() <= NOISE_DEVIATIONS * noise {
        return Err(Flag::NoContact(noise));
    }
    if begin.peak < 0.0 {
        return Err(Flag::WrongSign);
    }
    Ok(())
}

/// Whether the body is pressed again after it was pulled back, by more than the noise of a hold.
pub(super) fn presses_again(curve: &IndentationCurve) -> bool {
    let [low, high] = min_max(&curve.depth);
    let [mut deepest, mut left] = [low, f64::INFINITY];
    curve.depth.iter().any(|&depth| {
        deepest = deepest.max(depth);
        if deepest - depth > REVERSAL_FRACTION * (high - low) {
            left = left.min(depth);
        }
        depth - left > REVERSAL_FRACTION * (high - low)
    })
}
