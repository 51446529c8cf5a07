//! Stationary sliding of an arbitrary rigid line on a viscous foundation, Theorems 3 and 6 of Kürschner (2014).
//!
//! ```text
//! d = F_N/(4 η v)        (12)        μ = (1/d) Σ_i ∫_{A_i} h̃'(x)² dx,   A_d = ∪ A_i        (11), (16)
//! ```
//! F_N is the normal force, η the viscosity, v the speed, h̃ the height of the line, and A_i are the intervals of the contact.

use indenters::{RigidLine, SlidingLoad, contact_line};
use numerics::Estimate;
use rheology::Viscous;

use crate::axisymmetric::no_stationary_state;
use crate::pieces::{accept_accurate, integrate_pieces};
use crate::stationary::checked_depth;
use crate::{FrictionError, StationarySliding};

/// Stationary depth, contact line and friction coefficient of a rigid line on a finite interval.
///
/// Only the leading edge carries load, so the contact may be several intervals.
///
/// # Errors
/// [`FrictionError::NoStationaryState`] when the leading edge ends below the stationary depth, Remark 4;
/// [`FrictionError::NotConverged`] when the integral is known to less than ten digits, as where it diverges;
/// [`FrictionError::Indenter`] when the line has no finite domain or no finite height.
pub fn line_sliding(
    line: &dyn RigidLine,
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<StationarySliding, FrictionError> {
    let depth = checked_depth(material, load)?;
    // The contact consists of the parts of the leading edge that lie below the stationary depth.
    let contact = contact_line(line, depth).map_err(no_stationary_state)?;
    let energy = squared_slope_integral(line, &contact.intervals)?;
    let intervals = contact.intervals;
    let fronts = intervals.iter().map(|[_, front]| *front);
    let ends = fronts.map(|front| end_sensitivity(line, front)).sum();
    Ok(StationarySliding::from_energy(
        depth, intervals, energy, ends,
    ))
}

/// Change of ∫ h̃'² dx per relative change of the position and of the height of the `front` of a contact interval, which are both
/// rounded, \[m].
fn end_sensitivity(line: &dyn RigidLine, front: f64) -> f64 {
    let slope = line.slope(front).abs();
    slope * (slope * front.abs() + line.height(front).abs())
}

/// Integral ∫ h̃'² dx over the contact intervals (11), \[m], with separate integrals between the kinks of the line.
fn squared_slope_integral(
    line: &dyn RigidLine,
    intervals: &[[f64; 2]],
) -> Result<Estimate, FrictionError> {
    let kinks = line.kinks();
    let square = |x: f64| line.slope(x).powi(2);
    let energy = |&[start, end]: &[f64; 2]| {
        let inside = kinks.iter().copied().filter(|x| start < *x && *x < end);
        let ends: Vec<f64> = [start].into_iter().chain(inside).chain([end]).collect();
        integrate_pieces(square, &ends)
    };
    let energy = intervals.iter().map(energy).sum();
    accept_accurate("integral of the squared slope", energy)
}
