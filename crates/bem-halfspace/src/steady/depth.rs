//! How deep a body lies that slides for ever.

use std::f64::consts::PI;

use crate::BemError;
use crate::error::positive;
use crate::steady::loading::sunken;
use crate::steady::mesh::Mesh;
use crate::steady::pivoting::Solution;

/// Depth of the lowest point below the undeformed surface, which never stops to grow.
///
/// After the sliding distance s from first touch, the kernel of the march in time is
/// `asinh((ξ + s)/|y|) − asinh(ξ/|y|) → ln(2s) − ln(ξ + r)`, so that
///
/// ```text
/// d(s) = d_ref + F_N/(4πηv) ln(s / s_ref)
/// ```
///
/// up to terms of the order of (contact length)/s. The reference distance is the length of the contact, which carries no
/// meaning beyond fixing `d_ref`: at s = s_ref the contact is not stationary yet.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SinkingDepth {
    /// d_ref, \[m].
    pub reference_depth: f64,
    /// s_ref, the length of the contact along x, \[m].
    pub reference_distance: f64,
    /// F_N/(4πηv), by which the depth grows when the distance grows e-fold, \[m].
    pub depth_per_e_fold: f64,
}

impl SinkingDepth {
    pub(super) fn new(mesh: &Mesh, solution: &Solution, contact_length: f64) -> Self {
        let spacing = mesh.options.spacing;
        let scale = mesh.loading.depth_scale;
        // F_N/(4πηv) in units of D.
        let rate = mesh.loading.force_of(mesh.total_load(solution), spacing)
            / (PI * mesh.loading.force_scale);
        Self {
            reference_depth: scale * (solution.depth + rate * sunken(contact_length, spacing[0])),
            reference_distance: contact_length,
            depth_per_e_fold: scale * rate,
        }
    }

    /// Depth after sliding a distance much longer than the contact, \[m].
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for a distance that is shorter than the contact or not finite.
    pub fn after(&self, sliding_distance: f64) -> Result<f64, BemError> {
        positive("sliding_distance", sliding_distance)?;
        if sliding_distance < self.reference_distance {
            return Err(BemError::InvalidParameter {
                parameter: "sliding_distance",
                value: sliding_distance,
                allowed: "at least the length of the contact",
            });
        }
        let e_folds = (sliding_distance / self.reference_distance).ln();
        Ok(self.reference_depth + self.depth_per_e_fold * e_folds)
    }
}
