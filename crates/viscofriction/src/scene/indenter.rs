//! `[indenter.…]`: the rigid body.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use strum::{EnumDiscriminants, EnumIter, IntoStaticStr};

use super::height_map::HeightMapTable;

/// The rigid body; its lowest point is the origin, lengths in metres.
#[derive(
    Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema, IntoStaticStr, EnumDiscriminants,
)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
#[strum(serialize_all = "kebab-case")]
#[strum_discriminants(
    name(IndenterKind),
    derive(EnumIter, IntoStaticStr),
    strum(serialize_all = "kebab-case"),
    doc = "The kinds of bodies, for whoever goes through all of them."
)]
pub enum Indenter {
    /// h = coefficient r^exponent.
    Power {
        /// Coefficient c > 0, \[m^(1 − p)].
        coefficient: f64,
        /// Exponent p > 0.
        exponent: f64,
    },
    /// h = slope r.
    Cone {
        /// Slope of the flank, > 0.
        slope: f64,
    },
    /// h = curvature r².
    Paraboloid {
        /// Coefficient of r², > 0, \[1/m]; half the inverse of the radius of curvature.
        curvature: f64,
    },
    /// The exact sphere.
    Sphere {
        /// Radius > 0, \[m].
        radius: f64,
    },
    /// A sum of powers.
    Superposition {
        /// The terms; that of the lowest exponent has a positive coefficient.
        terms: Vec<Term>,
    },
    /// A flat end with a vertical wall.
    FlatPunch {
        /// Radius > 0, \[m].
        radius: f64,
    },
    /// A cone whose tip is cut off.
    FlatCone {
        /// Radius of the flat end > 0, \[m].
        radius: f64,
        /// Slope of the flank, > 0.
        slope: f64,
    },
    /// A cone whose tip is part of a sphere.
    RoundTippedCone {
        /// Radius of the tip > 0, \[m].
        radius: f64,
        /// Slope of the flank, > 0.
        slope: f64,
    },
    /// A hyperboloid of revolution: round at the tip, a cone far from it.
    Hyperboloid {
        /// Radius of the tip > 0, \[m].
        radius: f64,
        /// Slope of the flank, > 0.
        slope: f64,
    },
    /// A paraboloid whose tip is cut off.
    TruncatedParaboloid {
        /// Radius of the flat end > 0, \[m].
        radius: f64,
        /// Coefficient of r², > 0, \[1/m].
        curvature: f64,
    },
    /// The parabola of a cylinder, infinite along y; loads and areas are per length.
    Cylinder {
        /// Radius > 0, \[m].
        radius: f64,
    },
    /// A body of revolution from a table of radii and heights, straight between its rows.
    Table {
        /// CSV file with the columns radius_m and height_m, beside the scene file; both begin with 0, radii increase.
        file: PathBuf,
    },
    /// A surface from a grid of heights: bilinear between them, or periodic, the sum of waves through them.
    HeightMap(HeightMapTable),
    /// A random self-affine surface that repeats itself along x and y without end; it takes load.mean_pressure.
    SelfAffine(SelfAffineSurface),
}

/// What is beyond a grid of heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Edges {
    /// The body ends with a wall.
    #[default]
    Wall,
    /// The same grid, without end; it takes load.mean_pressure.
    Periodic,
    /// The grid and its mirror images, without end: no height jumps at an edge. The periods are twice as long.
    Mirrored,
}

/// A random self-affine surface, whose waves are drawn by the seed.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SelfAffineSurface {
    /// Periods along x and y, > 0, \[m].
    pub period: [f64; 2],
    /// Hurst exponent, between 0 and 1.
    pub hurst_exponent: f64,
    /// Root mean square of the slope, > 0.
    pub rms_slope: f64,
    /// Longest wave length, \[m].
    pub longest_wavelength: f64,
    /// Shortest wave length, \[m].
    pub shortest_wavelength: f64,
    /// Wave length above which the spectrum is constant, \[m]; without it there is none.
    pub roll_off_wavelength: Option<f64>,
    /// Another seed draws another surface.
    pub seed: u64,
}

/// One term of a sum.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Term {
    /// Coefficient c ≠ 0, \[m^(1 − p)].
    pub coefficient: f64,
    /// Exponent p > 0.
    pub exponent: f64,
}

impl Indenter {
    /// The key of the table.
    pub fn key(&self) -> String {
        let name: &str = self.into();
        format!("indenter.{name}")
    }
}
