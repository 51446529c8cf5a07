//! What presses the body into the half space: a force, or a depth after a sliding distance.

use std::f64::consts::{FRAC_PI_4, PI};

use indenters::{SlidingLoad, Surface};
use rheology::Material;

use crate::error::positive;
use crate::steady::contact_scale::{depth_scale, depth_scale_of_profile};
use crate::steady::sliding_creep::{ElementCreep, SlidingCreep};
use crate::{BemError, Footprint};

/// A depth to be reached instead of a force to be carried.
///
/// The surface of a material that flows sinks ahead of a sliding load like ln t, for ever; a depth therefore belongs to
/// a sliding distance, see [`SinkingDepth`](crate::steady::SinkingDepth). On a solid the distance has no effect.
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

/// What presses.
#[derive(Debug, Clone, Copy)]
enum Control {
    /// Normal force, \[N].
    Force(f64),
    /// Depth scale, after a sliding distance, \[m].
    Depth(f64),
}

/// Scale and control of a stationary problem on any grid.
#[derive(Debug, Clone)]
pub(super) struct Loading {
    pub(super) creep: SlidingCreep,
    /// Unit of heights D, \[m].
    pub(super) depth_scale: f64,
    control: Control,
    /// Length along y of a profile that stands for an infinite one, \[m]; none for a body of finite width.
    strip: Option<f64>,
}

/// Length of a strip in lengths of its footprint and its memory. The square of its inverse is what it lacks to an infinite
/// one.
const STRIP: f64 = 1e5;

/// Directions in which the height of a surface is averaged.
const DIRECTIONS: u8 = 8;

impl Loading {
    /// Under a force, D is the depth at which it is about carried.
    pub(super) fn force(
        surface: &impl Surface,
        (material, load): (&(impl Material + ?Sized), &SlidingLoad),
        footprint: &Footprint,
    ) -> Result<Self, BemError> {
        let creep = SlidingCreep::new(material, load.velocity())?;
        let height = |distance: f64| {
            let along = |direction: u8| {
                let (sine, cosine) = (FRAC_PI_4 * f64::from(direction)).sin_cos();
                surface.height([distance * cosine, distance * sine])
            };
            (0..DIRECTIONS).map(along).sum::<f64>() / f64::from(DIRECTIONS)
        };
        let ends = footprint.x.into_iter().chain(footprint.y);
        let largest = ends.map(f64::abs).fold(0.0, f64::max);
        let largest = positive("half width of the footprint", largest)?;
        Ok(Self {
            depth_scale: depth_scale(&creep, load.require_normal_force()?, height, largest)?,
            creep,
            control: Control::Force(load.require_normal_force()?),
            strip: None,
        })
    }

    /// Under a force per length \[N/m] on a profile in plane strain, and the length of the strip, \[m].
    pub(super) fn per_length(
        profile: &impl Surface,
        (material, load): (&(impl Material + ?Sized), &SlidingLoad),
        [rear, front]: [f64; 2],
    ) -> Result<(Self, f64), BemError> {
        let creep = SlidingCreep::new(material, load.velocity())?;
        let [depth_scale, _] = scale_of_profile(profile, &creep, load.require_normal_force()?)?;
        let strip = STRIP * (front - rear + creep.memory());
        let strip = positive("length of a strip", strip)?;
        let force = positive("force on a strip", load.require_normal_force()? * strip)?;
        let loading = Self {
            creep,
            depth_scale,
            control: Control::Force(force),
            strip: Some(strip),
        };
        Ok((loading, strip))
    }

    /// The length of a strip \[m], where the scene is in plane strain.
    pub(super) const fn strip(&self) -> Option<f64> {
        self.strip
    }

    /// Edges of an element that is `factor` times as long; one that is a whole strip stays as wide.
    pub(super) fn scaled(&self, [dx, dy]: [f64; 2], factor: f64) -> [f64; 2] {
        let width = if self.strip.is_some() {
            dy
        } else {
            factor * dy
        };
        [factor * dx, width]
    }

    /// At a depth, D is that depth.
    pub(super) fn depth(
        material: &(impl Material + ?Sized),
        control: &DepthControl,
        footprint_length: f64,
    ) -> Result<Self, BemError> {
        let DepthControl {
            depth,
            sliding_distance,
            velocity,
        } = *control;
        positive("depth", depth)?;
        positive("sliding_distance", sliding_distance)?;
        if sliding_distance < footprint_length {
            return Err(BemError::InvalidParameter {
                parameter: "sliding_distance",
                value: sliding_distance,
                allowed: "longer than the footprint, because the depth is known only after the contact has become stationary",
            });
        }
        Ok(Self {
            creep: SlidingCreep::new(material, velocity)?,
            depth_scale: depth,
            control: Control::Depth(sliding_distance),
            strip: None,
        })
    }

    /// The normal force, where it is given, \[N].
    pub(super) const fn given_force(&self) -> Option<f64> {
        match self.control {
            Control::Force(force) => Some(force),
            Control::Depth(_) => None,
        }
    }

    /// The problem on a grid.
    pub(super) fn on_grid(&self, spacing: [f64; 2]) -> Result<GridLoading, BemError> {
        let creep = self.creep.over(spacing[0])?;
        let compliance = self.creep.compliance(spacing[0])?;
        let force_scale = 4.0 * self.depth_scale / compliance * spacing[0];
        let force_scale = positive("4 D Δx / (2 (1 - ν) J(Δx/v))", force_scale)?;
        let aspect = spacing[1] / spacing[0];
        let control = match self.control {
            Control::Force(force) => Equation {
                depth: 0.0,
                load: 1.0,
                right: force / force_scale / (PI * aspect),
            },
            Control::Depth(distance) => Equation {
                depth: 1.0,
                load: creep.flow * aspect * sunken(distance, spacing[0]),
                right: 1.0,
            },
        };
        Ok(GridLoading {
            creep,
            control,
            depth_scale: self.depth_scale,
            force_scale,
            spacing,
            is_strip: self.strip.is_some(),
        })
    }
}

/// D of a profile, and the distance from its lowest point at which it is as high, \[m].
///
/// A half space that flows has none: in plane strain a line load sinks the faster the longer it is, without limit.
pub(super) fn scale_of_profile(
    profile: &impl Surface,
    creep: &SlidingCreep,
    force_per_length: f64,
) -> Result<[f64; 2], BemError> {
    if creep.fluidity() > 0.0 {
        return Err(BemError::InvalidParameter {
            parameter: "fluidity",
            value: creep.fluidity(),
            allowed: "0 under a line load: a surface that flows sinks the faster the longer the line is",
        });
    }
    let height = |distance: f64| {
        let [rear, front] = [-distance, distance].map(|x| profile.height([x, 0.0]));
        0.5 * (rear + front)
    };
    depth_scale_of_profile(creep, force_per_length, height)
}

/// Scales and control on one grid, for loads in units of 4π D/(2 (1 − ν) J(Δx/v) Δx).
#[derive(Debug, Clone)]
pub(super) struct GridLoading {
    pub(super) creep: ElementCreep,
    /// Force or depth that is asked for.
    pub(super) control: Equation,
    /// Unit of heights D, \[m].
    pub(super) depth_scale: f64,
    /// 4 D Δx/(2 (1 − ν) J(Δx/v)), which is 4ηvD for the dashpot, \[N].
    force_scale: f64,
    spacing: [f64; 2],
    /// Whether one element along y stands for infinitely many.
    pub(super) is_strip: bool,
}

impl GridLoading {
    /// Normal force of the loads, \[N].
    pub(super) fn force_of(&self, total_load: f64) -> f64 {
        PI * self.force_scale * (self.spacing[1] / self.spacing[0]) * total_load
    }

    /// Pressure of the unit load, \[Pa].
    pub(super) fn pressure_unit(&self) -> f64 {
        PI * self.force_scale / self.spacing[0] / self.spacing[0]
    }
}

/// ln(2s/L): how far a load has sunk after the distance s, in units of F_N/(4πηv), when its kernel measures lengths in L.
pub(super) fn sunken(sliding_distance: f64, unit_length: f64) -> f64 {
    (2.0 * (sliding_distance / unit_length)).ln()
}
