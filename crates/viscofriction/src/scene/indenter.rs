//! `[indenter.…]`: the rigid body.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The rigid body; its lowest point is the origin, lengths in metres.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Indenter {
    /// h = coefficient r^exponent.
    Power(Power),
    /// h = slope r.
    Cone(Cone),
    /// h = curvature r².
    Paraboloid(Paraboloid),
    /// The exact sphere.
    Sphere(Round),
    /// A sum of powers.
    Superposition(Sum),
    /// A flat end with a vertical wall.
    FlatPunch(Round),
    /// A cone whose tip is cut off.
    FlatCone(RoundAndSlope),
    /// A cone whose tip is part of a sphere.
    RoundTippedCone(RoundAndSlope),
    /// A hyperboloid of revolution: round at the tip, a cone far from it.
    Hyperboloid(RoundAndSlope),
    /// A paraboloid whose tip is cut off.
    TruncatedParaboloid(RoundAndCurvature),
    /// The parabola of a cylinder, infinite along y; loads and areas are per length.
    Cylinder(Round),
    /// A body of revolution from a table of radii and heights, straight between its rows.
    Table(TableFile),
    /// A surface from a grid of heights, bilinear between them; it ends at the edge of the grid.
    HeightMap(HeightMapFile),
}

/// h = coefficient r^exponent.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Power {
    /// Coefficient c > 0, \[m^(1 − p)].
    pub coefficient: f64,
    /// Exponent p > 0.
    pub exponent: f64,
}

/// h = slope r.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cone {
    /// Slope of the flank, > 0.
    pub slope: f64,
}

/// h = curvature r².
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Paraboloid {
    /// Coefficient of r², > 0, \[1/m]; half the inverse of the radius of curvature.
    pub curvature: f64,
}

/// A body that is known by a radius.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Round {
    /// Radius > 0, \[m].
    pub radius: f64,
}

/// A body that is known by the radius of its tip and the slope of its flank.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoundAndSlope {
    /// Radius of the tip > 0, \[m].
    pub radius: f64,
    /// Slope of the flank, > 0.
    pub slope: f64,
}

/// A body that is known by the radius of its flat end and the curvature of its flank.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoundAndCurvature {
    /// Radius of the flat end > 0, \[m].
    pub radius: f64,
    /// Coefficient of r², > 0, \[1/m].
    pub curvature: f64,
}

/// A sum of powers.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sum {
    /// The terms; that of the lowest exponent has a positive coefficient.
    pub terms: Vec<Term>,
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

/// A table of radii and heights.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TableFile {
    /// CSV file with the columns radius_m and height_m, beside the scene file; both begin with 0, radii increase.
    pub file: PathBuf,
}

/// A grid of heights.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeightMapFile {
    /// File beside the scene file: a CSV without names, one line of heights \[m] per x, from rear to front, and one column
    /// per y; or, with the extension npy, an array of NumPy, float64 or float32, with the first index along x.
    pub file: PathBuf,
    /// Distances of neighbouring heights along x and y, > 0, \[m].
    pub spacing: [f64; 2],
}

impl Indenter {
    /// The key of the table.
    #[must_use]
    pub const fn key(&self) -> &'static str {
        match self {
            Self::Power(_) => "indenter.power",
            Self::Cone(_) => "indenter.cone",
            Self::Paraboloid(_) => "indenter.paraboloid",
            Self::Sphere(_) => "indenter.sphere",
            Self::Superposition(_) => "indenter.superposition",
            Self::FlatPunch(_) => "indenter.flat-punch",
            Self::FlatCone(_) => "indenter.flat-cone",
            Self::RoundTippedCone(_) => "indenter.round-tipped-cone",
            Self::Hyperboloid(_) => "indenter.hyperboloid",
            Self::TruncatedParaboloid(_) => "indenter.truncated-paraboloid",
            Self::Cylinder(_) => "indenter.cylinder",
            Self::Table(_) => "indenter.table",
            Self::HeightMap(_) => "indenter.height-map",
        }
    }
}
