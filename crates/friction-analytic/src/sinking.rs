//! Sinking velocity of a sliding line, Remark 5 and its correction.
//!
//! ```text
//! v_z = F_N/(4 η a) − (v/a) Σ_i [h̃(β_i) − h̃(α_i)],   a = Σ_i (β_i − α_i)
//! v_z = F_N/(4 η a) − v d/a        (15)
//! ```
//!
//! (15) is the first line with Σ [h̃(β) − h̃(α)] = d. The paper gives it "without the assumption" of a stationary state;
//! it holds only if the contact starts at the lowest point of the line and follows the leading edge. From first touch on
//! the trailing flank carries load too, and (15) sinks too fast.

use indenters::{RigidLine, SlidingLoad, leading_edge};
use rheology::Viscous;

use crate::FrictionError;
use crate::error::{out_of_range, representable};
use crate::stationary::depth_under_force;

/// How far the rise of the contact may differ from the depth, relative to the depth, and be taken as equal: the contact is
/// known from a root search or from the caller's table.
const SAME_HEIGHT: f64 = 1e-9;

/// Velocity v_z \[m/s] at which a sliding line sinks while it touches over the `contact` intervals \[m] of its own frame.
///
/// Negative where the load cannot hold the line at its depth.
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
    let Contact { length, rise } = Contact::of(line, contact)?;
    // F/(4 η) = D v.
    Ok(load.velocity() * ((depth - rise) / length))
}

/// The sinking velocity (15) as the paper gives it \[m/s], for a `contact` it holds for.
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
    let Contact { length, rise } = Contact::of(line, contact)?;
    let front = contact.last().map_or(f64::NAN, |ends| line.height(ends[1]));
    let depth = representable("indentation depth", front - leading_edge(line)?.lowest)?;
    if (rise - depth).abs() > SAME_HEIGHT * depth {
        return Err(FrictionError::NotOneSided { depth, rise });
    }
    if depth > stationary_depth * (1.0 + SAME_HEIGHT) {
        return Err(FrictionError::BeyondStationaryDepth {
            depth,
            stationary_depth,
        });
    }
    Ok(load.velocity() * ((stationary_depth - depth) / length))
}

/// What a contact contributes to the balance of forces.
struct Contact {
    /// Sum of the lengths of its intervals.
    length: f64,
    /// Σ [h̃(β) − h̃(α)].
    rise: f64,
}

impl Contact {
    /// Of intervals that follow one another.
    fn of(line: &dyn RigidLine, contact: &[[f64; 2]]) -> Result<Self, FrictionError> {
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
        let sum = |of: &dyn Fn([f64; 2]) -> f64| contact.iter().map(|ends| of(*ends)).sum();
        let rise = sum(&|[start, end]| line.height(end) - line.height(start));
        if !f64::is_finite(rise) {
            return Err(out_of_range("rise of the contact", rise));
        }
        let length = sum(&|[start, end]| end - start);
        Ok(Self {
            length: representable("contact length", length)?,
            rise,
        })
    }
}
