//! How far one parameter may go while all others follow it: ends of intervals of the profile likelihood.

use super::{Linearised, Minimum, Range, inverse, minimise_below};

/// A side of one parameter of a minimum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Profile {
    /// The parameter that is held.
    pub parameter: usize,
    /// −1 or 1.
    pub side: f64,
    /// By how much the sum has risen at the end.
    pub rise: f64,
    /// Where the end is sought first.
    pub first_step: f64,
    /// Part of the distance by which the root of the rise may be off; the end is then interpolated.
    pub close: f64,
}

/// Steps of the search.
const STEPS: usize = 20;
/// Places at which the sum is computed on one step; where these are not enough, what the model of the last one leaves is the sum,
/// which is too small rather than too large in a curved valley: the interval becomes wider.
const MOST_PLACES: usize = 12;
/// Part of the rise that the model may be trusted with, over the closeness asked for.
const BY_MODEL: f64 = 0.3;

/// Where the least sum with the parameter held has risen as much, over all others within their ranges; none up to the bound of
/// its range.
pub fn profile_end(
    mut linearise: impl FnMut(&[f64]) -> Option<Linearised>,
    best: &Minimum,
    ranges: &[Range],
    profile: Profile,
) -> Option<f64> {
    let Profile {
        parameter, side, ..
    } = profile;
    let place = |step: f64| best.parameters[parameter] + side * step;
    let tangent = tangent(best, parameter);
    let range = ranges[parameter];
    let end = range.bounds[usize::from(side > 0.0)];
    let room = side * (end - best.parameters[parameter]);
    let mut at = |step: f64| {
        // At the bound it only matters whether the sum has risen enough.
        let below = if step < room {
            f64::NEG_INFINITY
        } else {
            best.linearised.sum + profile.rise
        };
        held(
            &mut linearise,
            (best, &tangent),
            ranges,
            (profile, step, below),
        )
    };
    let [mut inner, mut outer] = [[0.0; 2], [f64::INFINITY; 2]];
    // Where no end is expected within the range, its bound comes first.
    let mut step = if profile.first_step < room {
        profile.first_step.min(range.largest_step)
    } else {
        room
    };
    for _ in 0..STEPS {
        let found = at(step);
        if found < 1.0 && step >= room {
            return None;
        }
        let is_close = (found - 1.0).abs() < profile.close;
        let between = |[near, low]: [f64; 2], [far, high]: [f64; 2]| {
            near + ((1.0 - low) / (high - low)).clamp(0.02, 0.98) * (far - near)
        };
        let last = [inner, outer];
        *(if found < 1.0 { &mut inner } else { &mut outer }) = [step, found];
        step = match is_close {
            true if found >= 1.0 => return Some(place(between(inner, outer))),
            true => match beyond(inner, last) {
                end if end < room => return Some(place(end)),
                _ => room,
            },
            false if outer[0].is_infinite() => (2.0 * step).min(room),
            false if outer[1].is_infinite() => 0.5 * (inner[0] + outer[0]),
            false => between(inner, outer),
        };
    }
    // The nearest place where the sum has certainly risen enough.
    Some(place(outer[0])).filter(|end| end.is_finite())
}

/// The root of the rise of the least sum over that at the end, with the parameter held a step beside the minimum: nearly linear
/// in the step. Where there is no sum, or nothing may rise, it is infinite, because the end is before.
fn held(
    linearise: impl FnMut(&[f64]) -> Option<Linearised>,
    (best, tangent): (&Minimum, &[f64]),
    ranges: &[Range],
    (profile, step, below): (Profile, f64, f64),
) -> f64 {
    let Profile {
        parameter,
        side,
        rise,
        close,
        ..
    } = profile;
    let mut ranges = ranges.to_vec();
    ranges[parameter].bounds = [best.parameters[parameter] + side * step; 2];
    // Not from where another place has led, which may be another minimum.
    let start = best.parameters.iter().zip(tangent).zip(&ranges);
    let start = start.map(|((value, slope), range)| {
        let [lowest, highest] = range.bounds;
        (value + side * step * slope).clamp(lowest, highest)
    });
    let ending = ([BY_MODEL * close * rise, below], MOST_PLACES);
    let held = minimise_below(linearise, start.collect(), &ranges, ending);
    let sum = held.map_or(f64::INFINITY, |held| held.linearised.sum);
    let part = (sum - best.linearised.sum).max(0.0) / rise;
    if part.is_nan() {
        f64::INFINITY
    } else {
        part.sqrt()
    }
}

/// The end behind a place that is close to it: on the line to the nearest place beyond, or on that from the place before.
fn beyond([step, found]: [f64; 2], [before, after]: [[f64; 2]; 2]) -> f64 {
    let [other, value] = if after[1].is_finite() { after } else { before };
    step + (1.0 - found) * (other - step) / (value - found)
}

/// How the others follow a parameter by the model of the minimum.
fn tangent(best: &Minimum, parameter: usize) -> Vec<f64> {
    let n = best.parameters.len();
    let alone = || (0..n).map(|k| if k == parameter { 1.0 } else { 0.0 });
    match inverse(&best.linearised.matrix, n) {
        Some(inverse) => {
            let column = (0..n).map(|k| inverse[k * n + parameter]);
            let diagonal = inverse[parameter * (n + 1)];
            column.map(|entry| entry / diagonal).collect()
        }
        None => alone().collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::minimise;
    use super::*;

    /// Residuals x + y − 1 and (y − 2)/2, which are linear: up to the bound of x the profile is (x + 1)²/5, and 9/5 there.
    #[test]
    fn ends_are_those_of_a_parabola_or_none() {
        let linearise = |p: &[f64]| {
            let residuals = [p[0] + p[1] - 1.0, 0.5 * (p[1] - 2.0)];
            Some(Linearised {
                sum: residuals.iter().map(|r| r * r).sum(),
                matrix: vec![1.0, 1.0, 1.0, 1.25],
                descent: vec![-residuals[0], -residuals[0] - 0.5 * residuals[1]],
            })
        };
        let ranges = [Range {
            bounds: [-10.0, 2.0],
            largest_step: 1.0,
        }; 2];
        let best = minimise(linearise, vec![0.0, 0.0], &ranges, 1e-14).expect("a minimum");
        let end = |side, first_step| {
            let profile = Profile {
                parameter: 0,
                side,
                rise: 4.0,
                first_step,
                close: 0.01,
            };
            profile_end(linearise, &best, &ranges, profile)
        };
        for first_step in [0.1, 0.9] {
            // y stays below 2, which is where it is best, so that only the first residual rises beyond.
            let found = end(-1.0, first_step).expect("an end");
            assert!(
                (found + 3.0).abs() < 0.01 * 2.0,
                "{found}, and −3 is the end"
            );
            assert_eq!(end(1.0, first_step), None, "up to the bound");
        }
    }
}
