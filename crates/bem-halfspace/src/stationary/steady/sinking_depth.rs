//! The depth of a body in stationary sliding, which grows without limit on a material that flows.
//!
//! Theory: docs/theory/stationary-half-space.md, "The depth, which grows without limit".

use crate::BemError;
use crate::stationary::steady::body_contact::Solution;
use crate::stationary::steady::loading::sinking_in_e_folds;
use crate::stationary::steady::mesh::Mesh;
use numerics::{in_range, positive};

/// Depth of the lowest point below the undeformed surface, which grows without limit where the material flows.
///
/// On a solid, whose creep ends, `depth_per_e_fold` is 0, and `reference_depth` is the depth after a sliding time much longer
/// than the retardation times. Now consider a dashpot after the sliding distance s from first touch. A point lies ξ ahead of a
/// point load, y beside it, and at the distance r from it. There the kernel of the march in time is `asinh((ξ + s)/|y|) −
/// asinh(ξ/|y|) → ln(2s) − ln(ξ + r)`. Under the normal force F_N, for the viscosity η and the speed v, the depth is therefore
///
/// ```text
/// d(s) = d_ref + F_N/(4πηv) ln(s / s_ref)
/// ```
///
/// up to terms of the order of (contact length)/s. Other materials with the free flow η differ in `d_ref` only. The reference distance is
/// the length of the contact. It serves to define `d_ref` only: at s = s_ref the contact is not yet stationary.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SinkingDepth {
    /// Depth d_ref at the reference distance, \[m].
    pub reference_depth: f64,
    /// Reference distance s_ref: the length of the contact along x, \[m].
    pub reference_distance: f64,
    /// Increase 2 (1 − ν) F_N/(4πηv) of the depth when the distance grows e-fold, \[m]; 0 on a solid.
    pub depth_per_e_fold: f64,
}

impl SinkingDepth {
    /// Depth of a solution at the reference distance, the length of its contact \[m], and the sinking from there on.
    pub(super) fn new(mesh: &Mesh, solution: &Solution, contact_length: f64) -> Self {
        let spacing = mesh.options.spacing;
        let scale = mesh.loading.depth_scale;
        // The depth grows by F_N/(4πηv) per e-fold of the sliding distance, here in units of the depth scale.
        let aspect = spacing[1] / spacing[0];
        let rate =
            mesh.loading.creep.flow * aspect * mesh.total_load(solution.loads.iter().copied());
        // The depth of the solution belongs to the kernel without its constant. The sinking over the length of the contact adds it.
        Self {
            reference_depth: scale
                * (solution.depth + rate * sinking_in_e_folds(contact_length, spacing[0])),
            reference_distance: contact_length,
            depth_per_e_fold: scale * rate,
        }
    }

    /// Depth after a sliding distance, or the reference depth if `None`, \[m]. On a solid both are equal.
    pub(super) fn at_distance(&self, sliding_distance: Option<f64>) -> f64 {
        match sliding_distance {
            Some(distance) if self.depth_per_e_fold > 0.0 => {
                let e_folds = (distance / self.reference_distance).ln();
                self.reference_depth + self.depth_per_e_fold * e_folds
            }
            _ => self.reference_depth,
        }
    }

    /// Depth after a sliding distance much longer than the contact, \[m].
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for a distance that is shorter than the contact or not finite.
    pub fn after(&self, sliding_distance: f64) -> Result<f64, BemError> {
        positive("sliding_distance", sliding_distance)?;
        let is_allowed = sliding_distance >= self.reference_distance;
        let allowed = "at least the length of the contact";
        in_range("sliding_distance", sliding_distance, is_allowed, allowed)?;
        Ok(self.at_distance(Some(sliding_distance)))
    }
}
