//! What presses the body into the half space: a force, or a depth after a sliding distance.

use std::f64::consts::PI;

use indenters::SlidingLoad;
use rheology::Viscous;

use crate::BemError;
use crate::error::positive;
use crate::footprint::depth_scale;

/// A depth to be reached instead of a force to be carried.
///
/// The surface ahead of a sliding load sinks like ln t, for ever; a depth therefore belongs to a sliding distance, see
/// [`SinkingDepth`](crate::steady::SinkingDepth).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DepthControl {
    /// Depth of the lowest point below the undeformed surface, \[m].
    pub depth: f64,
    /// Distance slid under the load so far, \[m]; longer than the footprint.
    pub sliding_distance: f64,
    /// Sliding speed, \[m/s].
    pub velocity: f64,
}

/// The equation `depth · δ + load · Σ x = right` that controls depth or force in the units of the mesh.
#[derive(Debug, Clone, Copy)]
pub(super) struct Equation {
    pub(super) depth: f64,
    pub(super) load: f64,
    pub(super) right: f64,
}

/// Scales and control of a stationary problem.
#[derive(Debug, Clone, Copy)]
pub(super) struct Loading {
    /// Unit of heights D, \[m].
    pub(super) depth_scale: f64,
    /// 4ηvD, \[N].
    pub(super) force_scale: f64,
    /// Sliding distance of a controlled depth, \[m].
    sliding_distance: Option<f64>,
}

impl Loading {
    /// Under a force, D = F_N/(4ηv).
    pub(super) fn force(material: &Viscous, load: &SlidingLoad) -> Result<Self, BemError> {
        Ok(Self {
            depth_scale: positive("F_N / (4 η v)", depth_scale(material, load))?,
            force_scale: load.normal_force(),
            sliding_distance: None,
        })
    }

    /// At a depth, D is that depth.
    pub(super) fn depth(
        material: &Viscous,
        control: &DepthControl,
        footprint_length: f64,
    ) -> Result<Self, BemError> {
        let DepthControl {
            depth,
            sliding_distance,
            velocity,
        } = *control;
        positive("depth", depth)?;
        positive("velocity", velocity)?;
        positive("sliding_distance", sliding_distance)?;
        if sliding_distance < footprint_length {
            return Err(BemError::InvalidParameter {
                parameter: "sliding_distance",
                value: sliding_distance,
                allowed: "longer than the footprint, because the depth is known only after the contact has become stationary",
            });
        }
        let force_scale = 4.0 * material.viscosity() * velocity * depth;
        Ok(Self {
            depth_scale: depth,
            force_scale: positive("4 η v depth", force_scale)?,
            sliding_distance: Some(sliding_distance),
        })
    }

    /// The equation of the control on a grid.
    pub(super) fn equation(&self, spacing: [f64; 2]) -> Equation {
        let aspect = spacing[1] / spacing[0];
        match self.sliding_distance {
            None => Equation {
                depth: 0.0,
                load: 1.0,
                right: 1.0 / (PI * aspect),
            },
            Some(distance) => Equation {
                depth: 1.0,
                load: aspect * sunken(distance, spacing[0]),
                right: 1.0,
            },
        }
    }

    /// Normal force of the loads of a grid, \[N].
    pub(super) fn force_of(&self, total_load: f64, spacing: [f64; 2]) -> f64 {
        PI * self.force_scale * (spacing[1] / spacing[0]) * total_load
    }

    /// Pressure of the unit load on a grid, \[Pa].
    pub(super) fn pressure_unit(&self, spacing: [f64; 2]) -> f64 {
        PI * self.force_scale / spacing[0] / spacing[0]
    }
}

/// ln(2s/L): how far a load has sunk after the distance s, in units of F_N/(4πηv), when its kernel measures lengths in L.
pub(super) fn sunken(sliding_distance: f64, unit_length: f64) -> f64 {
    (2.0 * (sliding_distance / unit_length)).ln()
}
