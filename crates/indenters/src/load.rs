//! Loads: force or depth, and the sliding or the duration of a contact.

use crate::IndenterError;
use numerics::{InvalidParameter, positive};

/// The quantity prescribed normal to the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Control {
    /// Normal force F_N, \[N]; the depth follows.
    NormalForce(f64),
    /// Indentation depth d of the lowest point of the body, \[m]; the normal force follows.
    IndentationDepth(f64),
}

impl Control {
    /// The prescribed force \[N] or depth, \[m].
    pub const fn value(self) -> f64 {
        match self {
            Self::NormalForce(value) | Self::IndentationDepth(value) => value,
        }
    }

    /// Control of the same quantity, force or depth, with another value.
    #[must_use]
    pub const fn with(self, value: f64) -> Self {
        match self {
            Self::NormalForce(_) => Self::NormalForce(value),
            Self::IndentationDepth(_) => Self::IndentationDepth(value),
        }
    }

    /// Refuses a force or depth that is not greater than zero.
    fn checked(self) -> Result<Self, InvalidParameter> {
        match self {
            Self::NormalForce(force) => positive("normal_force", force).map(Self::NormalForce),
            Self::IndentationDepth(depth) => {
                positive("indentation_depth", depth).map(Self::IndentationDepth)
            }
        }
    }
}

/// Force or depth at one time of a history; two points at the same time are a jump.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct HistoryPoint {
    /// Time, \[s].
    pub time: f64,
    /// Force ≥ 0, or depth of the lowest point below the undeformed surface, of either sign.
    pub control: Control,
}

impl HistoryPoint {
    /// A history that holds one force or depth at all of the `times` \[s].
    pub fn held(control: Control, times: &[f64]) -> Vec<Self> {
        let point = |&time: &f64| Self { time, control };
        times.iter().map(point).collect()
    }
}

/// A body that is pressed and slides along x with constant speed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SlidingLoad {
    /// Prescribed force or depth.
    control: Control,
    /// Sliding speed, \[m/s].
    velocity: f64,
    /// Sliding distance since first touch, \[m]; `None` for the stationary state.
    sliding_distance: Option<f64>,
    /// Length of a closed track, \[m]; `None` if a sliding distance is set.
    track: Option<f64>,
}

impl SlidingLoad {
    /// Stationary sliding under `normal_force` F_N > 0 \[N] with `velocity` v > 0 \[m/s] towards positive x.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when one of them is not finite and greater than zero. A body at rest never
    /// stops sinking into a viscous half space; see the functions for normal indentation.
    pub fn new(normal_force: f64, velocity: f64) -> Result<Self, IndenterError> {
        Self::with(Control::NormalForce(normal_force), velocity)
    }

    /// Stationary sliding at `indentation_depth` d > 0 \[m] with `velocity` v > 0 \[m/s] towards positive x.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when one of them is not finite and greater than zero.
    pub fn at_depth(indentation_depth: f64, velocity: f64) -> Result<Self, IndenterError> {
        Self::with(Control::IndentationDepth(indentation_depth), velocity)
    }

    /// Stationary sliding under a prescribed force or depth with `velocity` v > 0 \[m/s] towards positive x.
    ///
    /// # Errors
    /// Like [`SlidingLoad::new`] and [`SlidingLoad::at_depth`].
    pub fn with(control: Control, velocity: f64) -> Result<Self, IndenterError> {
        Ok(Self {
            control: control.checked()?,
            velocity: positive("velocity", velocity)?,
            sliding_distance: None,
            track: None,
        })
    }

    /// The same load after a `sliding_distance` > 0 \[m] since first touch.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when the distance is not finite and greater than zero.
    pub fn after(self, sliding_distance: f64) -> Result<Self, IndenterError> {
        Ok(Self {
            sliding_distance: Some(positive("sliding_distance", sliding_distance)?),
            track: None,
            ..self
        })
    }

    /// The same load on a closed track of length > 0 \[m] after any number of passes, as in a ball-on-disc test.
    ///
    /// The body meets the deformation left by its previous passes. The curvature of the track is neglected.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when the length is not finite and greater than zero.
    pub fn on_track(self, track: f64) -> Result<Self, IndenterError> {
        Ok(Self {
            sliding_distance: None,
            track: Some(positive("track", track)?),
            ..self
        })
    }

    /// Prescribed force or depth.
    pub const fn control(&self) -> Control {
        self.control
    }

    /// Sliding speed v, \[m/s].
    pub const fn velocity(&self) -> f64 {
        self.velocity
    }

    /// Sliding distance since first touch, \[m]; `None` for the stationary state.
    pub const fn sliding_distance(&self) -> Option<f64> {
        self.sliding_distance
    }

    /// Length of the closed track, \[m]; `None` on fresh ground.
    pub const fn track(&self) -> Option<f64> {
        self.track
    }

    /// Refuses a closed track, for methods that cover fresh ground only.
    ///
    /// # Errors
    /// [`IndenterError::NoTrack`] if the load is on a closed track.
    pub const fn require_fresh_ground(&self) -> Result<(), IndenterError> {
        match self.track {
            None => Ok(()),
            Some(track) => Err(IndenterError::NoTrack { track }),
        }
    }

    /// Normal force F_N, \[N]; `None` if the depth is prescribed.
    pub fn normal_force(&self) -> Option<f64> {
        self.require_normal_force().ok()
    }

    /// Normal force F_N \[N], for methods that cannot prescribe the depth.
    ///
    /// # Errors
    /// [`IndenterError::NeedsNormalForce`] if the depth is prescribed.
    pub const fn require_normal_force(&self) -> Result<f64, IndenterError> {
        match self.control {
            Control::NormalForce(force) => Ok(force),
            Control::IndentationDepth(indentation_depth) => {
                Err(IndenterError::NeedsNormalForce { indentation_depth })
            }
        }
    }

    /// Prescribed force or depth, for methods that give the stationary state only.
    ///
    /// # Errors
    /// [`IndenterError::OnlyStationary`] if a sliding distance is prescribed.
    pub const fn require_stationary(&self) -> Result<Control, IndenterError> {
        match self.sliding_distance {
            None => Ok(self.control),
            Some(sliding_distance) => Err(IndenterError::OnlyStationary { sliding_distance }),
        }
    }
}

/// A body that is pressed for a time, without sliding; the control is constant from first touch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PressingLoad {
    /// Prescribed force or depth.
    control: Control,
    /// Time since first touch, \[s].
    duration: f64,
}

impl PressingLoad {
    /// A constant force or depth for a `duration` > 0 \[s].
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when force, depth or duration is not finite and greater than zero.
    pub fn new(control: Control, duration: f64) -> Result<Self, IndenterError> {
        Ok(Self {
            control: control.checked()?,
            duration: positive("duration", duration)?,
        })
    }

    /// Prescribed force or depth.
    pub const fn control(&self) -> Control {
        self.control
    }

    /// Time since first touch, \[s].
    pub const fn duration(&self) -> f64 {
        self.duration
    }
}
