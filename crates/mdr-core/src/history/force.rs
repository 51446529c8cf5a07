//! The depth that a force needs, along a path of the force.
//!
//! ```text
//! 8/(2 (1 − ν)) ∫₀^a x h̃' dx = ∫ J(t − s) dF        as long as the force does not fall (Lee & Radok 1960)
//! ```
//! After that the depth is taken as straight over parts of each segment, at whose ends the force is as given; the parts are
//! halved until that does not matter, and extrapolated in their length.

use indenters::Axisymmetric;
use numerics::{Estimate, NotReached, try_bracketed_root};
use rheology::Material;

use super::contact::Contact;
use super::path::{Path, mean_exponential};
use super::radius::Radii;
use super::{CurvePoint, Follow};
use crate::MdrError;

/// Parts of all segments together after which the refinement is given up.
const MOST_PARTS: usize = 1 << 14;

/// A body under a force.
pub(super) struct Pressed<'a> {
    pub(super) body: &'a dyn Axisymmetric,
    pub(super) material: &'a dyn Material,
    pub(super) options: Follow,
    /// Times and forces; the last force of a time holds from there on.
    pub(super) points: Vec<[f64; 2]>,
}

impl Pressed<'_> {
    /// Depth and contact radius at all points.
    pub(super) fn curve(&self) -> Result<Vec<CurvePoint>, MdrError> {
        let factor = 8.0 / self.material.half_space_factor();
        let duration = self.points[self.points.len() - 1][0] - self.points[0][0];
        let forces = self.points.iter().map(|[_, force]| *force);
        let largest = forces.fold(0.0, f64::max);
        let area = largest * self.material.creep_compliance(duration)? / factor;
        let radii = reaching(self.body, area)?;
        let grown = self.grown(&self.points, &radii, factor);
        if grown.len() == self.points.len() {
            return Ok(grown);
        }
        let mut parts = 2;
        let mut fine = self.march(&radii, parts)?;
        let mut better = extrapolated(&self.march(&radii, 1)?, &fine);
        loop {
            parts *= 2;
            let coarse = std::mem::replace(&mut fine, self.march(&radii, parts)?);
            let before = std::mem::replace(&mut better, extrapolated(&coarse, &fine));
            let change = changes(&before, &better, |point| point.indentation_depth.value);
            let radius_change = changes(&before, &better, |point| point.contact_radius.value);
            let depths = better.iter().map(|point| point.indentation_depth.value);
            let deepest = depths.fold(0.0, f64::max);
            if change <= self.options.relative_error * deepest {
                for point in &mut better {
                    let depth = &mut point.indentation_depth;
                    let error = change + 2.0 * self.options.modulus_error * depth.value.abs();
                    *depth = Estimate::new(depth.value, error);
                    let radius = &mut point.contact_radius;
                    *radius = Estimate::new(radius.value, radius_change);
                }
                better[..grown.len()].copy_from_slice(&grown);
                return Ok(better);
            }
            if 2 * parts * self.points.len() > MOST_PARTS {
                return Err(MdrError::NotReached(NotReached {
                    quantity: 0,
                    asked: self.options.relative_error,
                    value: deepest,
                    error: change,
                    elements: parts,
                }));
            }
        }
    }

    /// The points before the force falls for the first time.
    fn grown(&self, points: &[[f64; 2]], radii: &Radii, factor: f64) -> Vec<CurvePoint> {
        let creep = self.material.creep();
        let mut delayed = vec![0.0; creep.elements().len()];
        let mut flown = 0.0;
        let mut before = [points[0][0], 0.0];
        let mut curve = Vec::new();
        for point in points {
            let ([time, force], step, rise) = (*point, point[0] - before[0], point[1] - before[1]);
            if rise < 0.0 {
                break;
            }
            for (value, element) in delayed.iter_mut().zip(creep.elements()) {
                let x = step / element.retardation_time;
                let mean = mean_exponential(-x);
                let held = before[1] * x * mean + rise * (1.0 - mean);
                *value = (1.0 - x * mean) * *value + element.compliance * held;
            }
            flown += creep.fluidity() * step * (before[1] + 0.5 * rise);
            let recoverable =
                creep.instantaneous_compliance() * force + delayed.iter().sum::<f64>();
            let depth = radii.depth_of_area((recoverable + flown) / factor);
            let relative = 1e-13 + 2.0 * self.options.modulus_error;
            let bar = |value: f64| Estimate::new(value, relative * value);
            curve.push(CurvePoint {
                time,
                indentation_depth: bar(depth),
                normal_force: Estimate::exact(force),
                contact_radius: bar(radii.at([depth; 2])[0]),
            });
            before = *point;
        }
        curve
    }

    /// The curve with so many parts per segment.
    fn march(&self, radii: &Radii, parts: usize) -> Result<Vec<CurvePoint>, MdrError> {
        let mut before = [self.points[0][0], 0.0];
        let mut points = Vec::new();
        for point in &self.points {
            let step = [point[0] - before[0], point[1] - before[1]];
            let n = if step[0] > 0.0 { parts } else { 1 };
            for part in 1..=n {
                // Shorter parts at both ends, where the depth goes with a root of the time.
                let share = part as f64 / n as f64;
                let share = share * share * (3.0 - 2.0 * share);
                points.push(([0, 1].map(|k| before[k] + share * step[k]), part == n));
            }
            before = *point;
        }
        let forces: Vec<[f64; 2]> = points.iter().map(|(point, _)| *point).collect();
        let factor = 8.0 / self.material.half_space_factor();
        let grown = self.grown(&forces, radii, factor);
        let mut path = Path::new(self.material);
        path.push(self.points[0][0], 0.0);
        let mut contact = Contact::new(self.body, path, radii.clone());
        let mut curve = Vec::with_capacity(self.points.len());
        for (index, ([time, force], is_asked)) in points.into_iter().enumerate() {
            if let Some(point) = grown.get(index) {
                contact.follow(time, point.indentation_depth.value)?;
            } else if time > contact.path.last()[0] || contact.path.viscosity == 0.0 {
                press(&mut contact, time, force / factor, radii.deepest())?;
            }
            if is_asked {
                curve.push(CurvePoint {
                    time,
                    indentation_depth: Estimate::exact(contact.path.last()[1]),
                    normal_force: Estimate::exact(force),
                    contact_radius: Estimate::exact(contact.radius()),
                });
            }
        }
        Ok(curve)
    }
}

/// Goes on to the depth at which the sum of the loads is as needed; without load the body touches.
fn press(contact: &mut Contact<'_>, time: f64, needed: f64, deepest: f64) -> Result<(), MdrError> {
    let excess = |depth: f64| {
        let mut trial = contact.clone();
        trial.follow(time, depth)?;
        let (excess, has_contact) = (trial.load()[0] - needed, trial.radius() > 0.0);
        Ok::<f64, MdrError>(if has_contact { excess } else { -deepest })
    };
    let depth = try_bracketed_root(excess, [-deepest, deepest])?.unwrap_or(deepest);
    contact.follow(time, depth)
}

/// The radii up to a depth at which ∫ a dd is well above an area.
fn reaching(body: &dyn Axisymmetric, area: f64) -> Result<Radii, MdrError> {
    // From 1 m, which stands for "anywhere", in steps that a body of finite height survives; of a body that ends at a
    // vertical edge, as the sphere, from well inside it.
    let end = body.max_radius();
    let whole = body.line_height(end);
    let start = if end.is_finite() && whole == f64::INFINITY {
        body.line_height(0.5 * end)
    } else {
        whole.min(1.0)
    };
    // A line that is flat up to its end says nothing.
    let mut deepest = if start > 0.0 { 0.5 * start } else { 1.0 };
    let mut radii = Radii::new(body, deepest)?;
    while radii.area() > 16.0 * area {
        deepest *= 0.25;
        radii = Radii::new(body, deepest)?;
    }
    while radii.area() < 2.0 * area {
        deepest *= 2.0;
        radii = Radii::new(body, deepest)?;
    }
    Ok(radii)
}

/// From the errors of second order of both, the finer one with twice as many parts.
fn extrapolated(coarse: &[CurvePoint], fine: &[CurvePoint]) -> Vec<CurvePoint> {
    let better = |coarse: Estimate, fine: Estimate| {
        Estimate::exact(fine.value + (fine.value - coarse.value) / 3.0)
    };
    let point = |(coarse, fine): (&CurvePoint, &CurvePoint)| CurvePoint {
        indentation_depth: better(coarse.indentation_depth, fine.indentation_depth),
        contact_radius: better(coarse.contact_radius, fine.contact_radius),
        ..*fine
    };
    coarse.iter().zip(fine).map(point).collect()
}

/// Largest change of a quantity.
fn changes(coarse: &[CurvePoint], fine: &[CurvePoint], of: impl Fn(&CurvePoint) -> f64) -> f64 {
    let pairs = coarse.iter().zip(fine);
    let changes = pairs.map(|(one, other)| (of(one) - of(other)).abs());
    changes.fold(0.0, f64::max)
}
