//! Initial values of a fit: an elastic fit of the approach with contact point and baseline.

use super::depth::{median, min_max};
use super::model::{Kind, Model};
use super::noise::correlated_points;
use super::sample::Sample;
use super::{FitOptions, Flag, IndentationCurve};
use crate::MeasurementError;

/// An elastic fit of the approach.
pub(super) struct Start {
    /// Depth of first contact, \[m].
    pub(super) contact_point: f64,
    /// Force without contact, \[N].
    pub(super) baseline: f64,
    /// Shear modulus, \[Pa].
    pub(super) modulus: f64,
    /// Force of the material at the end of the approach, with the sign of the modulus, \[N].
    pub(super) peak: f64,
    /// Root mean square residual, \[N].
    pub(super) residual: f64,
    /// Index of the point at the end of the approach.
    pub(super) turn: usize,
    /// Time in contact until the end of the approach, \[s].
    pub(super) approach_time: f64,
    /// Logarithm of the thickness of the sample; `None` if it is not fitted.
    pub(super) thickness: Option<f64>,
}

/// Number of points of a curve below which it is not fitted. Chosen.
pub(super) const MIN_POINTS: usize = 30;
/// Approximate number of points to which the approach is reduced for the elastic fit. Chosen.
const APPROACH_POINTS: usize = 100;
/// Number of equally spaced candidates of the contact point in the first search. Chosen.
const CONTACT_POINT_CANDIDATES: usize = 24;
/// Number of halvings of the distance between candidates of the contact point around the best one. Chosen.
const CONTACT_POINT_REFINEMENTS: i32 = 6;
/// Fraction of the rise of the force below which the beginning of the contact is searched. Chosen.
const INITIAL_RISE_FRACTION: f64 = 0.3;
/// Exponents that are tried for the force as a power of the depth. Chosen: they extend from a flat punch over blunt to sharp
/// bodies.
const FORCE_EXPONENTS: [f64; 4] = [1.0, 1.5, 2.0, 3.0];
/// Largest rise of the sum of squares above its minimum with which a contact point is admissible, in variances of independent
/// points. Chosen.
const CONTACT_UNCERTAINTY: f64 = 5.0;
/// Fraction of the way from the first to the largest depth at which the approach ends. Chosen.
const APPROACH_END_FRACTION: f64 = 0.98;

/// The elastic fit with the smallest residual over all initial thicknesses; an error if none succeeds.
pub(super) fn start(
    sample: &Sample,
    curve: &IndentationCurve,
    options: &FitOptions,
) -> Result<Start, MeasurementError> {
    let starts = sample.starts().into_iter();
    let found = starts.map(|thickness| start_at(thickness, sample, curve, options));
    let (starts, refused): (Vec<_>, Vec<_>) = found.partition(Result::is_ok);
    let best = |one: &Start, other: &Start| one.residual.total_cmp(&other.residual);
    let found = starts.into_iter().flatten().min_by(best);
    let reason = refused.into_iter().find_map(Result::err);
    found.ok_or_else(|| reason.unwrap_or(MeasurementError::NotConverged))
}

/// Index of the first point near the largest depth.
pub(super) fn approach_end(depth: &[f64]) -> usize {
    let deep = depth[0] + APPROACH_END_FRACTION * (min_max(depth)[1] - depth[0]);
    let end = depth.iter().position(|one| *one >= deep);
    end.unwrap_or(depth.len() - 1)
}

/// The elastic fit of the approach with the best contact point, for one thickness: candidates over the range of depths, then
/// bisection around the best.
fn start_at(
    thickness: Option<f64>,
    sample: &Sample,
    curve: &IndentationCurve,
    options: &FitOptions,
) -> Result<Start, MeasurementError> {
    let IndentationCurve { time, depth, .. } = curve;
    let range = min_max(depth)[1] - depth[0];
    let turn = approach_end(depth);
    let few = curve
        .first((turn + 1).max(MIN_POINTS))
        .decimated(APPROACH_POINTS);
    let model = Model::new(sample, &few, Kind::Branches(0), options);
    if turn == 0 {
        return Err(MeasurementError::Damaged(Flag::WrongSign));
    }
    let fit = |contact_point: f64| {
        let start = fit_elastic(&model, contact_point, thickness).ok()?;
        let first_contact = depth.iter().position(|depth| *depth > contact_point);
        let approach_time = time[turn] - time[first_contact.unwrap_or(0).min(turn - 1)];
        Some(Start {
            turn,
            approach_time,
            ..start
        })
    };
    let best_of = |places: &mut dyn Iterator<Item = f64>| {
        let fits = places.filter_map(fit);
        fits.min_by(|one, other| one.residual.total_cmp(&other.residual))
    };
    let step = 1.2 * range / CONTACT_POINT_CANDIDATES as f64;
    let mut places =
        (0..CONTACT_POINT_CANDIDATES).map(|k| depth[0] - 0.2 * range + step * k as f64);
    let mut best = match best_of(&mut places) {
        Some(best) => best,
        // All candidates fail for the same reason, which is returned.
        None => fit_elastic(&model, depth[0], thickness)?,
    };
    for halvings in 1..=CONTACT_POINT_REFINEMENTS {
        let shift = step * 0.5_f64.powi(halvings);
        let places = [0.0, -shift, shift].map(|shift| best.contact_point + shift);
        best = best_of(&mut places.into_iter()).unwrap_or(best);
    }
    Ok(best)
}

/// Number of points before the contact: the last point at which the force may begin to rise as a power of the depth.
///
/// The first third of the force is used. The exponent is free, so that a wrong body or depth has no effect.
pub(super) fn free_points(curve: &IndentationCurve, turn: usize) -> usize {
    let force = &curve.force[..=turn];
    // Take up to `APPROACH_POINTS` points of the first part of the rise, above the median of the first 5 %.
    let first = median(force[..=turn / 20].to_vec());
    let high = first + INITIAL_RISE_FRACTION * (min_max(force)[1] - first);
    let last = force
        .iter()
        .rposition(|force| *force < high)
        .map_or(0, |last| last + 1);
    let step = last.div_ceil(APPROACH_POINTS).max(1);
    let few: Vec<usize> = (0..last).step_by(step).collect();
    let measured: Vec<f64> = few.iter().map(|&i| force[i]).collect();
    // At each candidate for the contact point, fit the force by a constant plus a power of the depth beyond it.
    let residuals = |place: usize, power: f64| {
        let contact_depth = curve.depth[place];
        let rises = few
            .iter()
            .map(|&i| (curve.depth[i] - contact_depth).max(0.0).powf(power));
        regression_residuals(&rises.collect::<Vec<_>>(), &measured)
    };
    let best_of = |place: usize| {
        let all = FORCE_EXPONENTS.map(|power| residuals(place, power));
        let squares = all.map(|one| (one.iter().map(|off| off * off).sum::<f64>(), one));
        let best = squares
            .into_iter()
            .min_by(|one, other| one.0.total_cmp(&other.0));
        best.map(|(squares, residuals)| (place, squares, residuals))
    };
    let candidates: Vec<(usize, f64, Vec<f64>)> =
        few.iter().filter_map(|&place| best_of(place)).collect();
    let Some((_, least, residuals)) = candidates
        .iter()
        .min_by(|one, other| one.1.total_cmp(&other.1))
    else {
        return 0;
    };
    // Take the last candidate whose sum of squares is not significantly larger than the least one: correlated residuals count
    // as fewer points.
    let uncertain = CONTACT_UNCERTAINTY * correlated_points(residuals) / few.len() as f64;
    let is_good = |one: &&(usize, f64, Vec<f64>)| one.1 <= least * (1.0 + uncertain);
    candidates
        .iter()
        .rfind(is_good)
        .map_or(0, |(place, ..)| *place)
}

/// Residuals of the linear regression of `values` on `over`.
fn regression_residuals(over: &[f64], values: &[f64]) -> Vec<f64> {
    let n = over.len() as f64;
    let mean = |values: &[f64]| values.iter().sum::<f64>() / n;
    let [middle, value] = [over, values].map(mean);
    let products = over
        .iter()
        .zip(values)
        .map(|(x, y)| (x - middle) * (y - value));
    let product: f64 = products.sum();
    let square: f64 = over.iter().map(|x| (x - middle).powi(2)).sum();
    let slope = if square > 0.0 { product / square } else { 0.0 };
    let pairs = over.iter().zip(values);
    pairs
        .map(|(x, y)| y - value - slope * (x - middle))
        .collect()
}

/// Elastic fit of baseline and modulus by linear least squares, for a given contact point and thickness.
fn fit_elastic(
    model: &Model,
    contact_point: f64,
    thickness: Option<f64>,
) -> Result<Start, MeasurementError> {
    let mut parameters = vec![0.0, contact_point];
    parameters.resize(model.n_parameters(), 0.0);
    if let (Some(place), Some(thickness)) = (model.thickness(), thickness) {
        parameters[place] = thickness;
    }
    let unit = model.forces(&parameters)?.contact;
    let n = unit.len() as f64;
    let mean = |values: &[f64]| values.iter().sum::<f64>() / n;
    let [unit_mean, force_mean] = [mean(&unit), mean(&model.curve.force)];
    let pairs = || unit.iter().zip(&model.curve.force);
    let products = pairs().map(|(u, f)| (u - unit_mean) * (f - force_mean));
    let product: f64 = products.sum();
    let square: f64 = unit.iter().map(|u| (u - unit_mean).powi(2)).sum();
    let modulus = if square > 0.0 { product / square } else { 0.0 };
    let baseline = force_mean - modulus * unit_mean;
    let squares = pairs().map(|(u, f)| (f - baseline - modulus * u).powi(2));
    Ok(Start {
        contact_point,
        baseline,
        modulus,
        peak: modulus * unit.iter().copied().fold(0.0, f64::max),
        residual: (squares.sum::<f64>() / n).sqrt(),
        turn: 0,
        approach_time: 0.0,
        thickness,
    })
}
