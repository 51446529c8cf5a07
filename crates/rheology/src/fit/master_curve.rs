//! One curve over many decades from isotherms over a few.

use super::curve::{MeasuredCurve, ModulusPoint};
use crate::RheologyError;

/// Moduli over frequency at one temperature.
#[derive(Debug, Clone, PartialEq)]
pub struct Isotherm {
    /// Temperature, in the unit of the reference temperature.
    pub temperature: f64,
    /// Points at increasing frequencies.
    pub points: Vec<ModulusPoint>,
}

/// Isotherms shifted to the reference temperature.
#[derive(Debug, Clone, PartialEq)]
pub struct MasterCurve {
    /// All points at increasing reduced frequencies a_T ω.
    pub curve: MeasuredCurve,
    /// The same points, \[rad/s] and \[Pa].
    pub points: Vec<ModulusPoint>,
    /// Pairs of temperature and log₁₀ a_T, in the order of the isotherms.
    pub log10_factors: Vec<[f64; 2]>,
}

/// The master curve with log₁₀ a_T given as a function of temperature.
///
/// # Errors
/// Those of `log10_factor`, and of [`MeasuredCurve::oscillation`].
pub fn shifted_master_curve(
    isotherms: &[Isotherm],
    log10_factor: impl Fn(f64) -> Result<f64, RheologyError>,
) -> Result<MasterCurve, RheologyError> {
    let factors = isotherms.iter().map(|isotherm| {
        let log = log10_factor(isotherm.temperature)?;
        Ok([isotherm.temperature, log])
    });
    joined(isotherms, factors.collect::<Result<_, RheologyError>>()?)
}

/// The master curve with every isotherm shifted horizontally onto its neighbour, so that storage and loss moduli of
/// both lie on one line where they overlap.
///
/// The isotherm nearest to the reference temperature stays where it is.
///
/// # Errors
/// [`RheologyError::NoOverlap`] when two neighbours stay farther apart than a quarter of their moduli; [`RheologyError::TooFewPoints`]
/// when there is no isotherm, or one with less than two points; those of [`MeasuredCurve::oscillation`].
pub fn automatic_master_curve(
    isotherms: &[Isotherm],
    reference_temperature: f64,
) -> Result<MasterCurve, RheologyError> {
    let mut order: Vec<usize> = (0..isotherms.len()).collect();
    order.sort_by(|&a, &b| {
        isotherms[a]
            .temperature
            .total_cmp(&isotherms[b].temperature)
    });
    let distance = |&index: &usize| (isotherms[index].temperature - reference_temperature).abs();
    let nearest =
        (0..order.len()).min_by(|&a, &b| distance(&order[a]).total_cmp(&distance(&order[b])));
    let Some(nearest) = nearest else {
        return Err(RheologyError::TooFewPoints {
            needed: 1,
            given: 0,
        });
    };
    for isotherm in isotherms {
        MeasuredCurve::oscillation(isotherm.points.clone())?;
    }
    let mut logs = vec![0.0; isotherms.len()];
    for place in nearest + 1..order.len() {
        let [known, new] = [order[place - 1], order[place]];
        logs[new] = logs[known] + shift_onto(&isotherms[known], &isotherms[new])?;
    }
    for place in (0..nearest).rev() {
        let [known, new] = [order[place + 1], order[place]];
        logs[new] = logs[known] + shift_onto(&isotherms[known], &isotherms[new])?;
    }
    let factors = isotherms.iter().zip(logs);
    joined(
        isotherms,
        factors
            .map(|(isotherm, log)| [isotherm.temperature, log])
            .collect(),
    )
}

fn joined(
    isotherms: &[Isotherm],
    log10_factors: Vec<[f64; 2]>,
) -> Result<MasterCurve, RheologyError> {
    let shifted = isotherms
        .iter()
        .zip(&log10_factors)
        .flat_map(|(isotherm, [_, log])| {
            let factor = 10_f64.powf(*log);
            isotherm.points.iter().map(move |point| ModulusPoint {
                angular_frequency: point.angular_frequency * factor,
                ..*point
            })
        });
    let mut points: Vec<ModulusPoint> = shifted.collect();
    points.sort_by(|a, b| a.angular_frequency.total_cmp(&b.angular_frequency));
    // Two isotherms may meet at one reduced frequency: there the mean of both is the measurement.
    points.dedup_by(|next, kept| {
        let same = next.angular_frequency <= kept.angular_frequency;
        if same {
            kept.storage = 0.5 * (kept.storage + next.storage);
            kept.loss = 0.5 * (kept.loss + next.loss);
        }
        same
    });
    Ok(MasterCurve {
        curve: MeasuredCurve::oscillation(points.clone())?,
        points,
        log10_factors,
    })
}

/// log₁₀ of the factor on the frequencies of `moving` that brings it onto `fixed`.
fn shift_onto(fixed: &Isotherm, moving: &Isotherm) -> Result<f64, RheologyError> {
    let [fixed_line, moving_line] = [fixed, moving].map(Line::new);
    // From just touching at one end to just touching at the other.
    let lowest = fixed_line.ends()[0] - moving_line.ends()[1];
    let highest = fixed_line.ends()[1] - moving_line.ends()[0];
    let mismatch = |shift: f64| Mismatch::between(&fixed_line, &moving_line, shift);
    let step = (highest - lowest) / f64::from(N_TRIALS);
    let trials = (1..N_TRIALS).map(|k| lowest + step * f64::from(k));
    let best = trials
        .filter_map(|shift| Some((shift, mismatch(shift)?)))
        .min_by(|a, b| a.1.doubt().total_cmp(&b.1.doubt()));
    let Some((coarse, _)) = best.filter(|(_, best)| best.mean_square <= FAR * FAR) else {
        return Err(RheologyError::NoOverlap {
            first: fixed.temperature,
            second: moving.temperature,
        });
    };
    let cost = |shift: f64| mismatch(shift).map_or(f64::INFINITY, |m| m.mean_square);
    Ok(golden_section(cost, [coarse - step, coarse + step]))
}

const N_TRIALS: u32 = 400;

/// log₁₀ of frequency, storage and loss modulus, straight in between.
struct Line(Vec<[f64; 3]>);

impl Line {
    fn new(isotherm: &Isotherm) -> Self {
        let logs = isotherm
            .points
            .iter()
            .map(|point| [point.angular_frequency, point.storage, point.loss].map(f64::log10));
        // A modulus of zero has no logarithm.
        Self(
            logs.filter(|point| point.iter().all(|x| x.is_finite()))
                .collect(),
        )
    }

    fn ends(&self) -> [f64; 2] {
        [self.0.first(), self.0.last()].map(|point| point.map_or(f64::NAN, |p| p[0]))
    }

    fn at(&self, log_frequency: f64) -> Option<[f64; 2]> {
        let above = self.0.partition_point(|point| point[0] < log_frequency);
        let [below, above] = [self.0.get(above.checked_sub(1)?)?, self.0.get(above)?];
        let part = (log_frequency - below[0]) / (above[0] - below[0]);
        Some([1, 2].map(|k| below[k] + part * (above[k] - below[k])))
    }
}

/// How far two lines are apart where they overlap, in decades of modulus.
struct Mismatch {
    mean_square: f64,
    count: f64,
}

impl Mismatch {
    /// Over the points of both lines that lie within the other; `None` with less than two.
    fn between(fixed: &Line, moving: &Line, shift: f64) -> Option<Self> {
        let mut sum = 0.0;
        let mut count = 0_u32;
        for (points, line, offset) in [(moving, fixed, shift), (fixed, moving, -shift)] {
            for &[log_frequency, storage, loss] in &points.0 {
                if let Some([other_storage, other_loss]) = line.at(log_frequency + offset) {
                    sum += (storage - other_storage).powi(2) + (loss - other_loss).powi(2);
                    count += 1;
                }
            }
        }
        let count = (count >= 2).then(|| f64::from(count))?;
        Some(Self {
            mean_square: sum / count,
            count,
        })
    }

    /// Of two equally close shifts the one with more overlap is right.
    fn doubt(&self) -> f64 {
        (self.mean_square + NOISE * NOISE) / self.count
    }
}

/// Scatter of a good measurement: below it a longer overlap counts more than a closer one.
const NOISE: f64 = 0.01;
/// Lines that are farther apart do not overlap.
const FAR: f64 = 0.1;

/// The minimum of a function with one minimum in the bracket.
fn golden_section(cost: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..60 {
        let inner = golden * (high - low);
        let [left, right] = [high - inner, low + inner];
        if cost(left) <= cost(right) {
            high = right;
        } else {
            low = left;
        }
    }
    0.5 * (low + high)
}
