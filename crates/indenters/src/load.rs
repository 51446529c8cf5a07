//! How the rigid body is pressed and moved.

use crate::IndenterError;
use crate::error::positive;

/// A constant normal force on a body that slides along x with constant speed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SlidingLoad {
    normal_force: f64,
    velocity: f64,
}

impl SlidingLoad {
    /// Pressed with `normal_force` F_N > 0 \[N], moved with `velocity` v > 0 \[m/s] towards positive x.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when one of them is not finite and greater than zero. A body at rest never
    /// stops sinking into a viscous half space; see the functions for normal indentation.
    pub fn new(normal_force: f64, velocity: f64) -> Result<Self, IndenterError> {
        Ok(Self {
            normal_force: positive("normal_force", normal_force)?,
            velocity: positive("velocity", velocity)?,
        })
    }

    /// Normal force F_N, \[N].
    #[must_use]
    pub const fn normal_force(&self) -> f64 {
        self.normal_force
    }

    /// Sliding speed v, \[m/s].
    #[must_use]
    pub const fn velocity(&self) -> f64 {
        self.velocity
    }
}
