//! The depth that a force needs, along a path of the force.
//!
//! ```text
//! 8/(2 (1 − ν)) ∫₀^a x h̃' dx = ∫ J(t − s) dF        as long as the contact does not shrink (Lee & Radok 1960)
//! ```
//! F is the force, J the creep compliance, a the contact radius, ν the Poisson ratio, and h̃(x) the height of the equivalent
//! line of the body.
//!
//! Once the contact has shrunk, the depth is taken as linear over parts of each segment, at whose ends the force is as given.
//! The parts are halved until the depth changes by less than the tolerance, with Richardson extrapolation in their length.

use indenters::{EquivalentProfile, IndenterError};
use numerics::{Estimate, NotReached, finite, positive, try_bracketed_root};
use rheology::{CreepSpectrum, Material};

use super::contact::Contact;
use super::path::Path;
use super::radius::Radii;
use super::{CurvePoint, HistoryOptions};
use crate::MdrError;
use crate::branches::decay_and_mean;

/// Largest number of parts, added over all segments, into which a history of the force is divided. Chosen, to limit the
/// computing time: where more would be needed, the refinement stops with [`MdrError::HistoryNotReached`].
const MAX_PARTS_UNDER_FORCE: usize = 1 << 14;

/// Relative rounding error of depths and radii that are found as roots of an equation. Chosen as seven times
/// [`SUM_ROUNDING`](super::SUM_ROUNDING) of the sums in the equation. It is part of every error bar, and decides it only where an
/// error near rounding is asked for.
const ROOT_ROUNDING: f64 = 1e-13;

/// Ratio of the tolerance of the quadrature over elements to the relative error asked for. Chosen: it adds a thousandth to the
/// error bar. A larger share widens bars, a smaller one halves more panels.
const QUADRATURE_SHARE: f64 = 1e-3;

/// A body under a history of the force.
pub(super) struct ForceHistory<'a> {
    /// Equivalent line of the body.
    pub(super) body: &'a dyn EquivalentProfile,
    /// Material of the foundation.
    pub(super) material: &'a dyn Material,
    /// Requested error of the depth, and relative error of the moduli of the material.
    pub(super) options: HistoryOptions,
    /// Times \[s] and forces \[N]; the last force of a time holds from there on.
    pub(super) points: Vec<[f64; 2]>,
}

impl ForceHistory<'_> {
    /// Depth and contact radius, with error bars, at all points of a history of the force.
    pub(super) fn curve(&self) -> Result<Vec<CurvePoint>, MdrError> {
        let factor = 8.0 / self.material.half_space_factor();
        let duration = self.points[self.points.len() - 1][0] - self.points[0][0];
        let radii = self.radii_for_force(self.material.creep_compliance(duration)? / factor)?;

        // As long as the contact does not shrink, depth and contact radius have a closed form.
        let grown = self.before_shrinking(&self.points, &radii, factor);
        if grown.len() == self.points.len() {
            return Ok(grown);
        }

        // Each turn of the loop halves the parts of all segments. Row k of the table has been extrapolated k times.
        let mut parts = 1;
        let mut change_before = f64::INFINITY;
        let mut table = vec![self.march(&radii, parts)?];
        loop {
            parts *= 2;
            let coarse = std::mem::replace(&mut table, vec![self.march(&radii, parts)?]);
            for (coarse, order) in coarse.iter().zip(self.orders()) {
                let fine = extrapolated(coarse, &table[table.len() - 1], *order);
                table.push(fine);
            }
            if coarse.len() < table.len() {
                continue;
            }

            // The refinement ends when the best extrapolated depths change by at most the error asked for.
            let [before, better] = [&coarse, &table].map(|rows| &rows[rows.len() - 1]);
            let depth_change =
                largest_change(before, better, |point| point.indentation_depth.value);
            // A quarter of the change before counts too, because one change may be small by chance. The errors are at least of
            // second order, so that a halving divides them by four or more.
            let change =
                depth_change.max(0.25 * std::mem::replace(&mut change_before, depth_change));
            let radius_change = largest_change(before, better, |point| point.contact_radius.value);
            let depths = better.iter().map(|point| point.indentation_depth.value);
            let deepest = depths.fold(0.0, f64::max);
            let asked = self.options.relative_error;
            let is_reached = change <= asked * deepest;
            if !is_reached && 2 * parts * self.points.len() <= MAX_PARTS_UNDER_FORCE {
                continue;
            }
            let rounding = ROOT_ROUNDING + QUADRATURE_SHARE * asked;
            let depth_error = change + rounding * deepest;
            let mut reached = self.with_errors(better, &radii, depth_error, radius_change);
            reached[..grown.len()].copy_from_slice(&grown);
            let missed = NotReached {
                quantity: 0,
                relative_error: asked,
                value: deepest,
                scale: deepest,
                error: change,
                elements: parts,
            };
            return if is_reached {
                Ok(reached)
            } else {
                Err(MdrError::HistoryNotReached { missed, reached })
            };
        }
    }

    /// The curve with error bars. Depths err by `depth_error` \[m] and the relative error of the moduli. Radii err by
    /// `radius_error` \[m], by the error of the depth along the body, and by the rounding of roots.
    fn with_errors(
        &self,
        curve: &[CurvePoint],
        radii: &Radii,
        depth_error: f64,
        radius_error: f64,
    ) -> Vec<CurvePoint> {
        // Extrapolation may put the radius of a lifted body below 0.
        let point = |point: &CurvePoint| {
            let depth = point.indentation_depth.value;
            let radius = point.contact_radius.value.max(0.0);
            let error = depth_error + 2.0 * self.options.modulus_error * depth.abs();
            let by_depth = radii.radius_and_slope([depth.max(0.0); 2])[1].abs() * depth_error;
            CurvePoint {
                indentation_depth: Estimate::new(depth, error),
                contact_radius: Estimate::new(
                    radius,
                    radius_error + by_depth + ROOT_ROUNDING * radius,
                ),
                ..*point
            }
        };
        curve.iter().map(point).collect()
    }

    /// Orders of the errors in the length of the parts: a parallel dashpot adds the first, because its load has the speed of the
    /// whole part at its end.
    fn orders(&self) -> &'static [i32] {
        let has_dashpot = self.material.relaxation().viscosity() > 0.0;
        if has_dashpot { &[1, 2] } else { &[2] }
    }

    /// The radii up to a depth at which ∫ a dd is well above what the largest force needs, or up to the end of the body.
    ///
    /// `compliance` is the creep compliance of the whole history over the factor of the force.
    fn radii_for_force(&self, compliance: f64) -> Result<Radii, MdrError> {
        let forces = self.points.iter().map(|[_, force]| *force);
        let normal_force = forces.fold(0.0, f64::max);
        let area = normal_force * compliance;
        // Start from a length of the problem, and reduce it until ∫ a dd is at most 16 times what the largest force needs.
        let mut deepest = positive("area", finite("area", area)?)?.sqrt();
        let mut radii = radii_up_to(self.body, &mut deepest)?;
        while radii.area() > 16.0 * area {
            deepest *= 0.25;
            radii = radii_up_to(self.body, &mut deepest)?;
        }
        // Increase it until ∫ a dd is at least twice that, or the line ends.
        while radii.area() < 2.0 * area {
            let wanted = 2.0 * deepest;
            deepest = wanted;
            radii = radii_up_to(self.body, &mut deepest)?;
            if deepest < wanted && radii.area() < area {
                return Err(MdrError::ForceBeyondEdge {
                    position: radii.radius_and_slope([deepest; 2])[0],
                    available: deepest,
                    carried_force: normal_force * (radii.area() / area),
                    normal_force,
                });
            }
            if deepest < wanted {
                break;
            }
        }
        Ok(radii)
    }

    /// The curve before the contact shrinks for the first time, in closed form; it does not shrink as long as ∫ J dF grows.
    ///
    /// `factor` is 8/(2 (1 − ν)), by which the force is larger than the sum of the loads.
    fn before_shrinking(&self, points: &[[f64; 2]], radii: &Radii, factor: f64) -> Vec<CurvePoint> {
        let creep = self.material.creep();
        let mut retarded = vec![0.0; creep.elements().len()];
        let mut flowed = 0.0;
        let mut before = [points[0][0], 0.0];
        let mut curve = Vec::new();
        let mut has_fallen = false;
        for point in points {
            let ([time, force], step, rise) = (*point, point[0] - before[0], point[1] - before[1]);

            // A force that has never fallen cannot make the contact shrink.
            has_fallen |= rise < 0.0;
            if has_fallen && shrinks(&creep, &retarded, before[1], step, rise) {
                break;
            }

            // The recoverable and the flowed part add up to ∫ J dF at the end of the step. Divided by the factor of the force
            // it is ∫ a dd, from which the depth follows.
            for (value, element) in retarded.iter_mut().zip(creep.elements()) {
                let x = step / element.retardation_time;
                let [decay, mean] = decay_and_mean(x);
                let held = before[1] * x * mean + rise * (1.0 - mean);
                *value = decay * *value + element.compliance * held;
            }
            flowed += creep.fluidity() * step * (before[1] + 0.5 * rise);
            let recoverable =
                creep.instantaneous_compliance() * force + retarded.iter().sum::<f64>();
            let depth = radii.depth_of_area((recoverable + flowed) / factor);

            // Only a flat end is in contact before it is below the surface.
            let is_flat = self.body.apex_exponent() == f64::INFINITY;
            let touches = depth > 0.0 || (is_flat && force > 0.0);
            let radius = if touches {
                radii.radius_and_slope([depth; 2])[0]
            } else {
                0.0
            };

            // Depth and radius have errors by the polynomials of the radii, by rounding, and by the modulus.
            let depth_error = if depth > 0.0 {
                radii.area_error / radius
            } else {
                0.0
            };
            let relative = ROOT_ROUNDING + 2.0 * self.options.modulus_error;
            let with_error =
                |value: f64, error: f64| Estimate::new(value, relative * value + error);
            curve.push(CurvePoint {
                time,
                indentation_depth: with_error(depth, depth_error),
                normal_force: Estimate::exact(force),
                contact_radius: with_error(
                    radius,
                    radii.radius_and_slope([depth; 2])[1].abs() * depth_error,
                ),
            });
            before = *point;
        }
        curve
    }

    /// The curve at the points of the history, with the depth linear over each of a number of parts per segment; without errors.
    fn march(&self, radii: &Radii, parts: usize) -> Result<Vec<CurvePoint>, MdrError> {
        // The list holds the points of the history, which are returned, and the ends of the parts in between, which are not.
        let mut before = [self.points[0][0], 0.0];
        let mut points = Vec::new();
        for point in &self.points {
            let step = [point[0] - before[0], point[1] - before[1]];
            let n = if step[0] > 0.0 { parts } else { 1 };
            for part in 1..=n {
                // The parts are shorter at both ends of a segment, where the depth changes like a root of the time.
                let uniform = part as f64 / n as f64;
                let share = uniform * uniform * (3.0 - 2.0 * uniform);
                let between = [0, 1].map(|k| before[k] + share * step[k]);
                // Given points are taken as they are, without the rounding of the interpolation.
                points.push(if part == n {
                    (*point, true)
                } else {
                    (between, false)
                });
            }
            before = *point;
        }

        // Up to the first shrinkage the depths have a closed form; afterwards the depth that each force needs is sought point
        // by point.
        let forces: Vec<[f64; 2]> = points.iter().map(|(point, _)| *point).collect();
        let factor = 8.0 / self.material.half_space_factor();
        let largest = forces.iter().map(|[_, force]| *force).fold(0.0, f64::max);
        let grown = self.before_shrinking(&forces, radii, factor);
        let mut path = Path::new(self.material);
        path.push(self.points[0][0], 0.0);
        let mut contact = Contact::new(self.body, path, radii.clone());
        contact.tolerance = QUADRATURE_SHARE * self.options.relative_error;
        let mut curve = Vec::with_capacity(self.points.len());
        // A flat end keeps its disc in contact even without force, so that it never counts as unloaded.
        let can_lift_off = self.body.apex_exponent().is_finite();
        let mut is_loaded = true;
        for (index, ([time, force], is_asked)) in points.into_iter().enumerate() {
            let was_loaded = std::mem::replace(&mut is_loaded, force > 0.0 || !can_lift_off);
            if let Some(point) = grown.get(index) {
                contact.follow(time, point.indentation_depth.value)?;
            } else if !is_loaded && !was_loaded {
                contact.rise_freely(time)?;
            } else if time > contact.path.last()[0] || contact.path.viscosity == 0.0 {
                let (needed, largest) = (force / factor, largest / factor);
                follow_to_load(&mut contact, time, needed, largest, radii.deepest())?;
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

/// Follows the body to the depth at a `time` \[s] at which the sum of the loads is `needed` \[N]; without load the body touches
/// the surface.
///
/// `largest` is the largest such sum of the history, `deepest` the largest depth of the radii, \[m].
fn follow_to_load(
    contact: &mut Contact<'_>,
    time: f64,
    needed: f64,
    largest: f64,
    deepest: f64,
) -> Result<(), MdrError> {
    let load_difference = |depth: f64| {
        let mut trial = contact.clone();
        trial.follow(time, depth)?;
        if trial.radius() > 0.0 {
            return Ok(trial.load()[0] - needed);
        }
        // Out of contact the gap continues the function, so that the search can interpolate. The rounding keeps the function
        // below zero where the gap vanishes, so that the root for a needed load of zero lies in contact.
        let gap = trial.gap(f64::MIN_POSITIVE, trial.path.end()).max(0.0);
        Ok::<f64, MdrError>(-needed - largest * (gap / deepest + ROOT_ROUNDING))
    };
    let depth = try_bracketed_root(load_difference, [-deepest, deepest])?.unwrap_or(deepest);
    contact.follow(time, depth)
}

/// True if ∫ J dF falls anywhere while the force changes linearly by `rise` within a step.
///
/// ```text
/// d/dt ∫ J dF = J₀ Ḟ + φ F + Σ g_k      g_k = J_k Ḟ + (g_k(0) − J_k Ḟ) e^(−t/λ_k)      g_k(0) = (J_k F − D_k)/λ_k
/// ```
fn shrinks(creep: &CreepSpectrum, retarded: &[f64], force: f64, step: f64, rise: f64) -> bool {
    let instantaneous = creep.instantaneous_compliance();
    if step <= 0.0 {
        return instantaneous * rise < 0.0;
    }
    let rate = |part: f64| {
        let mut rate = instantaneous * (rise / step) + creep.fluidity() * (force + part * rise);
        for (retarded, element) in retarded.iter().zip(creep.elements()) {
            let ramp = element.compliance * (rise / step);
            let start = (element.compliance * force - retarded) / element.retardation_time;
            rate += ramp + (start - ramp) * (-part * step / element.retardation_time).exp();
        }
        rate
    };
    // Divide evenly, and ever closer to the beginning, where the fast elements decide.
    let evenly =
        (0..=N_SHRINKING_CHECKS).map(|place| f64::from(place) / f64::from(N_SHRINKING_CHECKS));
    let closer = (1..=2 * N_SHRINKING_CHECKS).map(|halvings| 0.5_f64.powi(halvings));
    evenly.chain(closer).any(|part| rate(part) < 0.0)
}

/// Number of equal intervals of a segment at whose ends the sign of d/dt ∫ J dF is checked. It is also checked at twice as many
/// points, each half as far from the beginning of the segment as the one before. Chosen: the integral changes its sign a few
/// times at most; two changes within one interval are overlooked.
const N_SHRINKING_CHECKS: i32 = 24;

/// The radii up to a depth \[m], or as far as the line of the body rises; `deepest` is then reduced to that.
fn radii_up_to(body: &dyn EquivalentProfile, deepest: &mut f64) -> Result<Radii, MdrError> {
    loop {
        let available = match Radii::new(body, *deepest) {
            Err(MdrError::Indenter(IndenterError::NotHighEnough { available, .. })) => available,
            Err(MdrError::Indenter(IndenterError::NonMonotoneLine { limiting_depth, .. })) => {
                limiting_depth
            }
            // The radii end at a depth a thousandth below that of the vertical edge, well inside it.
            Err(MdrError::DepthBeyondEdge { available, .. }) => 0.999 * available,
            other => return other,
        };
        // A line may reach a depth at which the body touches farther out, so that a second limit follows the first.
        if available >= *deepest {
            return Radii::new(body, available);
        }
        *deepest = available;
    }
}

/// Richardson extrapolation of two curves, the finer one with twice as many parts, for errors of the given order.
fn extrapolated(coarse: &[CurvePoint], fine: &[CurvePoint], order: i32) -> Vec<CurvePoint> {
    let gain = 2.0_f64.powi(order) - 1.0;
    let better = |coarse: Estimate, fine: Estimate| {
        Estimate::exact(fine.value + (fine.value - coarse.value) / gain)
    };
    let point = |(coarse, fine): (&CurvePoint, &CurvePoint)| CurvePoint {
        indentation_depth: better(coarse.indentation_depth, fine.indentation_depth),
        contact_radius: better(coarse.contact_radius, fine.contact_radius),
        ..*fine
    };
    coarse.iter().zip(fine).map(point).collect()
}

/// Largest change of a quantity between two curves with the same times, in the unit of the quantity.
fn largest_change(
    coarse: &[CurvePoint],
    fine: &[CurvePoint],
    quantity: impl Fn(&CurvePoint) -> f64,
) -> f64 {
    let pairs = coarse.iter().zip(fine);
    let changes = pairs.map(|(one, other)| (quantity(one) - quantity(other)).abs());
    changes.fold(0.0, f64::max)
}
