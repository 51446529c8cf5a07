//! The work ∫ F dd done on the material along a history.

use indenters::{EquivalentProfile, HistoryPoint};
use numerics::{Estimate, NotReached};
use rheology::Material;

use super::{CurvePoint, HistoryOptions, indent_along};
use crate::MdrError;

/// Nodes on [0, 1] and weights of the Gauss–Legendre rule of three points; the outer nodes are 1/2 ± √0.15.
const GAUSS_RULE: [[f64; 2]; 3] = [
    [0.112_701_665_379_258_3, 5.0 / 18.0],
    [0.5, 8.0 / 18.0],
    [0.887_298_334_620_741_7, 5.0 / 18.0],
];
/// Largest number of parts, added over all segments, on which the work is computed. Chosen, to limit the computing time: where
/// more would be needed, the refinement stops with [`MdrError::WorkNotReached`].
const MAX_PARTS_OF_WORK: usize = 1 << 13;

/// The work ∫ F dd \[J] from the first point of a history to each point.
///
/// Up to the largest depth it is the energy stored and dissipated. At the end of a history without contact it is the energy
/// dissipated, and that still stored in a surface that has not recovered.
///
/// [`indent_along`] computes the force, or the depth, at the nodes of Gauss's rule on parts of each segment. The parts are
/// halved until the work changes by at most [`HistoryOptions::relative_error`] of its largest value; the change is a part of
/// the error.
///
/// # Errors
/// As for [`indent_along`], and [`MdrError::WorkNotReached`].
pub fn work_along(
    body: &dyn EquivalentProfile,
    material: &dyn Material,
    history: &[HistoryPoint],
    options: &HistoryOptions,
) -> Result<Vec<Estimate>, MdrError> {
    let work_on = |parts: usize| {
        let curve = indent_along(body, material, &with_subpoints(history, parts), options)?;
        Ok::<_, MdrError>((cumulative_work(&curve, parts), work_error(&curve)))
    };
    // The parts of all segments are halved until the work at all points changes by no more than the error asked for.
    let mut parts = 1;
    let (mut before, _) = work_on(parts)?;
    loop {
        parts *= 2;
        let (work, curve_error) = work_on(parts)?;
        let pairs = work.iter().zip(&before);
        let changes = pairs.map(|(one, other)| (one - other).abs());
        let change = changes.fold(0.0, f64::max);
        let largest = work.iter().copied().map(f64::abs).fold(0.0, f64::max);
        // The last change estimates the error of the quadrature; add that of the curve.
        if change <= options.relative_error * largest {
            let error = change + curve_error;
            let known = |value| Estimate::new(value, error);
            return Ok(work.into_iter().map(known).collect());
        }
        if 2 * parts * history.len() > MAX_PARTS_OF_WORK {
            return Err(MdrError::WorkNotReached(NotReached {
                quantity: 0,
                relative_error: options.relative_error,
                value: largest,
                scale: largest,
                error: change,
                elements: parts,
            }));
        }
        before = work;
    }
}

/// The history with the nodes of the rule on `parts` parts of each segment.
fn with_subpoints(history: &[HistoryPoint], parts: usize) -> Vec<HistoryPoint> {
    let mut points: Vec<HistoryPoint> = history.iter().take(1).copied().collect();
    for pair in history.windows(2) {
        let [start, end] = [pair[0], pair[1]];
        for part in 0..parts {
            let nodes = GAUSS_RULE.map(|[node, _]| (part as f64 + node) / parts as f64);
            points.extend(nodes.map(|node| between(start, end, node)));
        }
        points.push(end);
    }
    points
}

/// The point at a fraction `part` of the segment between two points.
fn between(start: HistoryPoint, end: HistoryPoint, part: f64) -> HistoryPoint {
    let mean = |from: f64, to: f64| from + part * (to - from);
    HistoryPoint {
        time: mean(start.time, end.time),
        // Points of different kinds are refused by `indent_along`, which sees them at the ends of the segment.
        control: end
            .control
            .with(mean(start.control.value(), end.control.value())),
    }
}

/// Work ∫ F dd = F d − ∫ d dF up to each point of the history \[J], from a curve with the nodes of the rule on `parts` parts of
/// each segment.
fn cumulative_work(curve: &[CurvePoint], parts: usize) -> Vec<f64> {
    let is_force = is_force_given(curve);
    let mut work = 0.0;
    let mut work_at_points = vec![work];
    let length = GAUSS_RULE.len() * parts + 1;
    for segment in curve.windows(length + 1).step_by(length) {
        // Gauss quadrature gives the means of force and depth over the segment.
        let [start, end] = [segment[0], segment[length]].map(values);
        let quadrature_points = segment[1..length].iter().zip(GAUSS_RULE.iter().cycle());
        let weighted = quadrature_points
            .map(|(point, [_, weight])| values(*point).map(|value| weight * value));
        let sums = weighted.fold([0.0; 2], |[force, depth], [more, deeper]| {
            [force + more, depth + deeper]
        });
        let [force, depth] = sums.map(|sum| sum / parts as f64);
        // The work is ∫ F dd. Where the force is given, integration by parts turns it into F d − ∫ d dF.
        work += if is_force {
            end[0] * end[1] - start[0] * start[1] - depth * (end[0] - start[0])
        } else {
            force * (end[1] - start[1])
        };
        work_at_points.push(work);
    }
    work_at_points
}

/// Force \[N] and depth \[m] of a point, in this order.
fn values(point: CurvePoint) -> [f64; 2] {
    [point.normal_force, point.indentation_depth].map(|known| known.value)
}

/// True if the force is prescribed, so that it has no error.
fn is_force_given(curve: &[CurvePoint]) -> bool {
    curve.iter().all(|point| point.normal_force.error == 0.0)
}

/// Bound of the error of the work by the error of the depth, or of the force, \[J]: the largest error times the total variation
/// of the other quantity. For a given force twice its largest value is added to the variation, for the products at both ends.
fn work_error(curve: &[CurvePoint]) -> f64 {
    let largest = |of: fn(&CurvePoint) -> f64| curve.iter().map(of).fold(0.0, f64::max);
    let total_variation = |of: fn(&CurvePoint) -> f64| {
        let step = |pair: &[CurvePoint]| (of(&pair[1]) - of(&pair[0])).abs();
        curve.windows(2).map(step).sum::<f64>()
    };
    if is_force_given(curve) {
        let force = |point: &CurvePoint| point.normal_force.value;
        largest(|point| point.indentation_depth.error)
            * (2.0 * largest(force) + total_variation(force))
    } else {
        let force = largest(|point| point.normal_force.error);
        force * total_variation(|point| point.indentation_depth.value)
    }
}
