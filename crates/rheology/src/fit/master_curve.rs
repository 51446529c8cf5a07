//! One curve over many decades from isotherms over a few.

use std::f64::consts::LN_10;

use super::curve::{JoinedIsotherms, MeasuredCurve, ModulusPoint};
use crate::RheologyError;
use numerics::golden_section;

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
    /// Temperature that the curve belongs to.
    pub reference_temperature: f64,
    /// Pairs of temperature and log₁₀ a_T, in the order of the isotherms.
    pub log10_factors: Vec<[f64; 2]>,
}

impl MasterCurve {
    /// The same at another temperature, at which all times are `10^log10_factor` of those at this one.
    ///
    /// # Errors
    /// Those of [`MeasuredCurve::oscillation`], where a frequency leaves the range of `f64`.
    pub fn about(mut self, temperature: f64, log10_factor: f64) -> Result<Self, RheologyError> {
        let factor = 10_f64.powf(log10_factor);
        for point in &mut self.points {
            point.angular_frequency /= factor;
        }
        for [_, log] in &mut self.log10_factors {
            *log -= log10_factor;
        }
        let mut curve = MeasuredCurve::oscillation(self.points.clone())?;
        if let Some(joined) = self.curve.joined.take() {
            curve = curve.of_isotherms(&self.curve.places(), joined);
        }
        Ok(Self {
            curve,
            reference_temperature: temperature,
            ..self
        })
    }
}

/// The master curve at a reference temperature with log₁₀ a_T given as a function of temperature.
///
/// # Errors
/// Those of `log10_factor`, and of [`MeasuredCurve::oscillation`].
pub fn shifted_master_curve(
    isotherms: &[Isotherm],
    reference_temperature: f64,
    log10_factor: impl Fn(f64) -> Result<f64, RheologyError>,
) -> Result<MasterCurve, RheologyError> {
    let factors = isotherms.iter().map(|isotherm| {
        let log = log10_factor(isotherm.temperature)?;
        Ok([isotherm.temperature, log])
    });
    let factors = factors.collect::<Result<_, RheologyError>>()?;
    joined(isotherms, reference_temperature, factors, Vec::new())
}

/// The master curve with every isotherm shifted horizontally onto its neighbour, so that the storage moduli of both lie
/// on one line where they overlap.
///
/// The storage modulus decides alone: it is the one that is measured well, and on a material that is not quite
/// thermorheologically simple the loss moduli would pull the curves apart.
///
/// The isotherm nearest to the temperature asked for stays where it is; the curve belongs to its temperature.
///
/// # Errors
/// [`RheologyError::OneFrequency`] when one of several isotherms has one point; [`RheologyError::NoOverlap`] when two neighbours stay farther apart than a quarter of their moduli;
/// [`RheologyError::TooFewPoints`]
/// when there is no isotherm, or one with less than two points; those of [`MeasuredCurve::oscillation`].
pub fn automatic_master_curve(
    isotherms: &[Isotherm],
    temperature: f64,
) -> Result<MasterCurve, RheologyError> {
    let single = |isotherm: &&Isotherm| isotherm.points.len() == 1;
    if let Some(first) = isotherms.iter().find(single)
        && isotherms.len() > 1
    {
        return Err(RheologyError::OneFrequency {
            count: isotherms.iter().filter(single).count(),
            given: isotherms.len(),
            temperature: first.temperature,
        });
    }
    let mut order: Vec<usize> = (0..isotherms.len()).collect();
    let temperature_of = |place: usize| isotherms[place].temperature;
    order.sort_by(|&a, &b| temperature_of(a).total_cmp(&temperature_of(b)));
    let distance = |place: &usize| (temperature_of(order[*place]) - temperature).abs();
    let nearest = (0..order.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let nearest = nearest.ok_or(RheologyError::TooFewPoints {
        needed: 1,
        given: 0,
    })?;
    for isotherm in isotherms {
        MeasuredCurve::oscillation(isotherm.points.clone())?;
    }
    let mut logs = vec![0.0; isotherms.len()];
    let upwards = (nearest + 1..order.len()).map(|place| [place - 1, place]);
    let downwards = (0..nearest).rev().map(|place| [place + 1, place]);
    let chain = upwards.chain(downwards);
    let chain: Vec<[usize; 2]> = chain.map(|pair| pair.map(|place| order[place])).collect();
    for &[known, new] in &chain {
        logs[new] = logs[known] + shift_onto(&isotherms[known], &isotherms[new])?;
    }
    let factors = isotherms.iter().zip(logs);
    let factors = factors.map(|(isotherm, log)| [isotherm.temperature, log]);
    let reference_temperature = isotherms[order[nearest]].temperature;
    joined(isotherms, reference_temperature, factors.collect(), chain)
}

fn joined(
    isotherms: &[Isotherm],
    reference_temperature: f64,
    log10_factors: Vec<[f64; 2]>,
    chain: Vec<[usize; 2]>,
) -> Result<MasterCurve, RheologyError> {
    let pairs = isotherms.iter().zip(&log10_factors).enumerate();
    let shifted = pairs.flat_map(|(place, (isotherm, [_, log]))| {
        let factor = 10_f64.powf(*log);
        let points = isotherm.points.iter().map(move |point| ModulusPoint {
            angular_frequency: point.angular_frequency * factor,
            ..*point
        });
        points.map(move |point| (place, point))
    });
    let mut shifted: Vec<(usize, ModulusPoint)> = shifted.collect();
    shifted.sort_by(|(_, a), (_, b)| a.angular_frequency.total_cmp(&b.angular_frequency));
    // Two isotherms may meet at one reduced frequency: there the mean of both is the measurement.
    shifted.dedup_by(|(_, next), (_, kept)| {
        let same = next.angular_frequency <= kept.angular_frequency;
        if same {
            kept.storage = 0.5 * (kept.storage + next.storage);
            kept.loss = 0.5 * (kept.loss + next.loss);
        }
        same
    });
    let (places, points): (Vec<usize>, Vec<ModulusPoint>) = shifted.into_iter().unzip();
    let isotherms = JoinedIsotherms {
        temperatures: log10_factors.iter().map(|pair| pair[0]).collect(),
        log_factors: log10_factors.iter().map(|pair| LN_10 * pair[1]).collect(),
        chain,
    };
    Ok(MasterCurve {
        curve: MeasuredCurve::oscillation(points.clone())?.of_isotherms(&places, isotherms),
        points,
        reference_temperature,
        log10_factors,
    })
}

/// log₁₀ of the factor on the frequencies of `moving` that brings it onto `fixed`.
fn shift_onto(fixed: &Isotherm, moving: &Isotherm) -> Result<f64, RheologyError> {
    let [fixed_line, moving_line] = [fixed, moving].map(Line::new);
    // From just touching at one end to just touching at the other.
    let lowest = fixed_line.ends()[0] - moving_line.ends()[1];
    let highest = fixed_line.ends()[1] - moving_line.ends()[0];
    let mismatch = |shift: f64| mean_square(&fixed_line, &moving_line, shift);
    let step = (highest - lowest) / f64::from(N_TRIALS);
    let trials = (1..N_TRIALS).map(|k| lowest + step * f64::from(k));
    let tried = trials.filter_map(|shift| Some((shift, mismatch(shift)?)));
    let best = tried.min_by(|a, b| a.1.total_cmp(&b.1));
    let Some((coarse, _)) = best.filter(|(_, best)| *best <= FAR * FAR) else {
        return Err(RheologyError::NoOverlap {
            first: fixed.temperature,
            second: moving.temperature,
        });
    };
    let cost = |shift: f64| mismatch(shift).unwrap_or(f64::INFINITY);
    Ok(golden_section(cost, [coarse - step, coarse + step]))
}

const N_TRIALS: u32 = 400;

/// log₁₀ of frequency and storage modulus, straight in between.
struct Line(Vec<[f64; 2]>);

impl Line {
    fn new(isotherm: &Isotherm) -> Self {
        let points = isotherm.points.iter();
        let logs = points.map(|point| [point.angular_frequency, point.storage].map(f64::log10));
        // A modulus of zero has no logarithm.
        let logs = logs.filter(|point| point.iter().all(|x| x.is_finite()));
        Self(logs.collect())
    }

    fn ends(&self) -> [f64; 2] {
        [self.0.first(), self.0.last()].map(|point| point.map_or(f64::NAN, |p| p[0]))
    }

    fn at(&self, log_frequency: f64) -> Option<f64> {
        let above = self.0.partition_point(|point| point[0] < log_frequency);
        let [below, above] = [self.0.get(above.checked_sub(1)?)?, self.0.get(above)?];
        let part = (log_frequency - below[0]) / (above[0] - below[0]);
        Some(below[1] + part * (above[1] - below[1]))
    }
}

/// Mean squared distance of the points of each line from the other where they overlap, in decades of modulus; `None`
/// with fewer points than [`LEAST_OVERLAP`].
fn mean_square(fixed: &Line, moving: &Line, shift: f64) -> Option<f64> {
    let mut sum = 0.0;
    let mut count = 0_u32;
    for (points, line, offset) in [(moving, fixed, shift), (fixed, moving, -shift)] {
        for &[log_frequency, log_modulus] in &points.0 {
            if let Some(other) = line.at(log_frequency + offset) {
                sum += (log_modulus - other).powi(2);
                count += 1;
            }
        }
    }
    (count >= LEAST_OVERLAP).then(|| sum / f64::from(count))
}

/// Two points of each line.
const LEAST_OVERLAP: u32 = 4;
/// Lines that are farther apart do not overlap.
const FAR: f64 = 0.1;
