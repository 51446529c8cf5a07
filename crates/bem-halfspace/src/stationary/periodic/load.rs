//! How a periodic surface is pressed and moved.

use indenters::IndenterError;
use numerics::{InvalidParameter, in_range, not_negative, positive};

use crate::BemError;

/// What is held while a periodic surface touches.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum PeriodicControl {
    /// Mean pressure over the whole period, \[Pa]; the depth follows.
    MeanPressure(f64),
    /// Depth of the mean plane \[m], as in [`PeriodicSliding::mean_depth`](crate::PeriodicSliding::mean_depth); the mean
    /// pressure follows.
    MeanDepth(f64),
}

/// A periodic surface that is pressed and slides along x.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PeriodicLoad {
    control: PeriodicControl,
    velocity: f64,
    sliding_distance: Option<f64>,
}

impl PeriodicLoad {
    /// A mean pressure > 0 \[Pa] over the whole period, and a velocity ≥ 0 \[m/s] towards positive x, for so long that the state
    /// is stationary.
    ///
    /// # Errors
    /// [`InvalidParameter`] for other numbers.
    pub fn new(mean_pressure: f64, velocity: f64) -> Result<Self, InvalidParameter> {
        let pressure = positive("mean_pressure", mean_pressure)?;
        Self::with(PeriodicControl::MeanPressure(pressure), velocity)
    }

    /// The mean plane held at a depth \[m], and a velocity ≥ 0 \[m/s] towards positive x, for so long that the state is
    /// stationary.
    ///
    /// On a half space the depth is below the mean of the deformed surface, and hence between minus the height of the mean
    /// plane above the lowest point, at touch, and 0, at which all gaps are closed under any pressure.
    ///
    /// # Errors
    /// [`InvalidParameter`] for numbers that are not finite, and a negative velocity.
    pub fn at_depth(mean_depth: f64, velocity: f64) -> Result<Self, InvalidParameter> {
        in_range("mean_depth", mean_depth, mean_depth.is_finite(), "finite")?;
        Self::with(PeriodicControl::MeanDepth(mean_depth), velocity)
    }

    fn with(control: PeriodicControl, velocity: f64) -> Result<Self, InvalidParameter> {
        Ok(Self {
            control,
            velocity: not_negative("velocity", velocity)?,
            sliding_distance: None,
        })
    }

    /// The same load, seen when the surface has slid a distance > 0 \[m] from rest.
    ///
    /// # Errors
    /// [`InvalidParameter`] for another distance.
    pub fn after(self, sliding_distance: f64) -> Result<Self, InvalidParameter> {
        Ok(Self {
            sliding_distance: Some(positive("sliding_distance", sliding_distance)?),
            ..self
        })
    }

    /// Mean pressure or depth.
    pub const fn control(&self) -> PeriodicControl {
        self.control
    }

    /// Sliding speed v, \[m/s].
    pub const fn velocity(&self) -> f64 {
        self.velocity
    }

    /// Sliding distance from rest, \[m]; none for the stationary state.
    pub const fn sliding_distance(&self) -> Option<f64> {
        self.sliding_distance
    }

    /// Mean pressure or depth, of the stationary state.
    pub(super) fn require_stationary(&self) -> Result<PeriodicControl, BemError> {
        let distance = |sliding_distance| IndenterError::OnlyStationary { sliding_distance };
        match self.sliding_distance {
            None => Ok(self.control),
            Some(sliding_distance) => Err(distance(sliding_distance).into()),
        }
    }

    /// Mean pressure and sliding distance, of what is followed from rest.
    pub(super) fn require_march(&self) -> Result<(f64, f64), BemError> {
        let PeriodicControl::MeanPressure(pressure) = self.control else {
            return Err(BemError::DepthFromRest);
        };
        positive("velocity", self.velocity)?;
        let why = "from rest a periodic surface slides over a distance";
        let distance = self.sliding_distance;
        let distance = distance.ok_or(BemError::SlidingDistanceMissing { why })?;
        Ok((pressure, distance))
    }
}
