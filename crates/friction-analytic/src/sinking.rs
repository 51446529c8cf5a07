//! Sinking velocity of a sliding line, by Remark 5 of Kürschner (2014) and its correction.
//!
//! ```text
//! v_z = F_N/(4 η a) − (v/a) Σ_i [h̃(β_i) − h̃(α_i)],   a = Σ_i (β_i − α_i)
//! v_z = F_N/(4 η a) − v d/a        (15)
//! ```
//! α_i and β_i are the rear and the front of the contact intervals, h̃ the height of the line, d the depth, η the viscosity and
//! v the speed.
//!
//! (15) is the first line with Σ [h̃(β) − h̃(α)] = d. Kürschner (2014) gives (15) "without the assumption" of a stationary
//! state. It holds only if the contact starts at the lowest point of the line and follows the leading edge. From first touch on
//! the trailing flank carries load too, and (15) sinks too fast.

use indenters::{RigidLine, SlidingLoad, leading_edge};
use rheology::Viscous;

use crate::FrictionError;
use crate::error::{out_of_range, representable};
use crate::stationary::depth_under_force;

/// Largest difference between the rise of the contact and the depth, relative to the depth, with which they count as equal.
/// Chosen above the rounding of a contact from a root search, or from a table of the caller with nine digits; it only decides
/// what is refused.
const HEIGHT_TOLERANCE: f64 = 1e-9;

/// Velocity v_z at which a sliding line sinks while it touches over the `contact` intervals \[m] of its own frame, \[m/s].
///
/// It is negative if the load cannot hold the line at its depth.
///
/// # Errors
/// [`FrictionError::InvalidContact`] unless the intervals are in order, without overlap, not empty and at least one;
/// [`FrictionError::OutOfRange`] when the line has no finite height at one of their ends.
pub fn sinking_velocity(
    line: &dyn RigidLine,
    contact: &[[f64; 2]],
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<f64, FrictionError> {
    let depth = depth_under_force(material, load)?;
    let ContactSums { length, rise } = ContactSums::new(line, contact)?;
    // The force enters as F_N/(4 η) = D v, where D is the stationary depth under this force.
    Ok(load.velocity() * ((depth - rise) / length))
}

/// Sinking velocity by (15) as printed in Kürschner (2014), for a `contact` for which it holds, \[m/s].
///
/// # Errors
/// [`FrictionError::NotOneSided`] when the contact does not start at the lowest point, or leaves out a part of the rise
/// up to its front; [`FrictionError::BeyondStationaryDepth`] when the depth exceeds (12); otherwise like
/// [`sinking_velocity`] and [`indenters::leading_edge`].
pub fn one_sided_sinking_velocity(
    line: &dyn RigidLine,
    contact: &[[f64; 2]],
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<f64, FrictionError> {
    let stationary_depth = depth_under_force(material, load)?;
    let ContactSums { length, rise } = ContactSums::new(line, contact)?;
    // The depth follows from the height of the front, and again from the rise of the contact; both must agree.
    let front = contact.last().map_or(f64::NAN, |ends| line.height(ends[1]));
    let depth = representable("indentation depth", front - leading_edge(line)?.lowest)?;
    if (rise - depth).abs() > HEIGHT_TOLERANCE * depth {
        return Err(FrictionError::NotOneSided { depth, rise });
    }
    if depth > stationary_depth * (1.0 + HEIGHT_TOLERANCE) {
        return Err(FrictionError::BeyondStationaryDepth {
            depth,
            stationary_depth,
        });
    }
    Ok(load.velocity() * ((stationary_depth - depth) / length))
}

/// Sums over the intervals of a contact in the balance of forces.
struct ContactSums {
    /// Length a = Σ (β − α) of the contact intervals, \[m].
    length: f64,
    /// Sum Σ [h̃(β) − h̃(α)] of the heights gained, \[m].
    rise: f64,
}

impl ContactSums {
    /// Sums over the contact intervals \[m], which must be in order and not empty.
    fn new(line: &dyn RigidLine, contact: &[[f64; 2]]) -> Result<Self, FrictionError> {
        // Check that the intervals follow one another and are not empty.
        let mut lower = f64::NEG_INFINITY;
        for (index, [start, end]) in contact.iter().copied().enumerate() {
            let in_order = start >= lower && end > start && start.is_finite() && end.is_finite();
            if !in_order {
                return Err(FrictionError::InvalidContact {
                    index,
                    lower,
                    start,
                    end,
                });
            }
            lower = end;
        }
        // The rises and the lengths of all intervals are summed; a rise that is not finite is refused.
        let rise: f64 = contact
            .iter()
            .map(|[start, end]| line.height(*end) - line.height(*start))
            .sum();
        if !rise.is_finite() {
            return Err(out_of_range("rise of the contact", rise));
        }
        let length = contact.iter().map(|[start, end]| end - start).sum();
        Ok(Self {
            length: representable("contact length", length)?,
            rise,
        })
    }
}
