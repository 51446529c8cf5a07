//! `[indenter.…]`: the rigid body.

use std::f64::consts::TAU;
use std::path::PathBuf;

use indenters::{
    FlatCone, FlatPunch, Hyperboloid, PowerProfile, PowerTerm, RoundTippedCone, Sphere, Spheroid,
    Superposition, TruncatedParaboloid,
};
use numerics::{MessageNumber, in_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use strum::{EnumDiscriminants, EnumIter, IntoStaticStr};

use super::SceneError;
use super::height_map::HeightMapTable;
use super::revolution::Revolution;
use super::schema::check_ranges;

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
    /// Half a spheroid: h = height (1 − √(1 − r²/radius²)).
    Spheroid {
        /// Semi-axis across > 0, \[m].
        radius: f64,
        /// Semi-axis along z > 0, \[m].
        height: f64,
    },
    /// A sum of powers.
    Superposition {
        /// The terms; that of the lowest exponent has a positive coefficient. If that of the highest has a negative one, the body ends at
        /// its outermost crest.
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
    /// A body of revolution from a table of radii and heights, linear between its rows.
    Table {
        /// CSV file with the columns radius_m and height_m, in the folder of the scene; both begin with 0, radii increase.
        file: PathBuf,
    },
    /// A surface from a grid of heights: bilinear between them, or periodic, the sum of waves through them.
    HeightMap(HeightMapTable),
    /// A random self-affine surface that is periodic along x and y; it takes load.mean_pressure.
    SelfAffine(SelfAffineSurface),
    /// A random surface of a power spectrum, which is periodic along x and y; it takes load.mean_pressure.
    Spectrum(SpectrumSurface),
}

/// What is beyond a grid of heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Edges {
    /// The body ends with a wall.
    #[default]
    Wall,
    /// The grid repeats itself without limit; it takes load.mean_pressure.
    Periodic,
    /// The grid and its mirror images repeat themselves: no height jumps at an edge. The periods are twice as long.
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
    /// Longest wavelength > 0, \[m].
    pub longest_wavelength: f64,
    /// Shortest wavelength > 0, \[m].
    pub shortest_wavelength: f64,
    /// Wavelength > 0 above which the spectrum is constant, \[m]; without it no roll-off.
    pub roll_off_wavelength: Option<f64>,
    /// Another seed draws another surface.
    pub seed: u64,
    /// Number of surfaces, with this seed and the next ones, from 1 to 1000: the answer is their mean; without it 1, or with
    /// `standard_error` at most 1000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub realisations: Option<u64>,
    /// Relative standard error of the mean at which no more surfaces are drawn, between 0 and 1; `realisations` is then their largest
    /// number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub standard_error: Option<f64>,
}

/// A random surface of an isotropic power spectrum C, whose waves are drawn by the seed.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpectrumSurface {
    /// CSV file with the columns wave_number q = 2π/λ, \[1/m], and density C, \[m⁴], in the folder of the scene; wave numbers increase,
    /// and ln C is linear in ln q between the rows. The spectrum.csv of `viscofriction surface` is one.
    pub file: PathBuf,
    /// What the densities are.
    #[serde(default)]
    pub convention: SpectrumConvention,
    /// Periods along x and y, > 0, \[m].
    pub period: [f64; 2],
    /// Wavelength > 0 below which waves are left out, \[m]; without it all waves of the table are kept.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shortest_wavelength: Option<f64>,
    /// Another seed draws another surface.
    pub seed: u64,
    /// Number of surfaces, with this seed and the next ones, from 1 to 1000: the answer is their mean; without it 1, or with
    /// `standard_error` at most 1000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub realisations: Option<u64>,
    /// Relative standard error of the mean at which no more surfaces are drawn, between 0 and 1; `realisations` is then their largest
    /// number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub standard_error: Option<f64>,
}

/// What the densities of a power spectrum are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SpectrumConvention {
    /// ⟨h²⟩ = 2π ∫ q C dq (Persson 2001).
    #[default]
    Persson,
    /// ⟨h²⟩ = ∫ q C dq/(2π), 4π² times as much (`SurfaceTopography`, Jacobs, Junge & Pastewka 2017).
    SurfaceTopography,
}

impl SpectrumConvention {
    /// Factor by which densities are multiplied to follow the convention of Persson, ⟨h²⟩ = 2π ∫ q C dq.
    pub(crate) fn factor(self) -> f64 {
        match self {
            Self::Persson => 1.0,
            Self::SurfaceTopography => (TAU * TAU).recip(),
        }
    }
}

/// Number of random surfaces at which sampling stops if only a standard error is given; the upper bound of `realisations`.
/// Chosen: it bounds the time; the standard error is then 1/32 of the scatter.
const MAX_REALISATIONS: u64 = 1000;
/// Smallest number of surfaces whose scatter gives a standard error of their mean (chosen: its own relative error is 1/√18, 24 %).
pub(crate) const FEWEST_REALISATIONS: usize = 10;

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
    /// Builds the body of revolution whose numbers the scene gives.
    ///
    /// # Errors
    /// [`SceneError`] for the first number that is out of range, and for a kind that is read from a file or is no body of revolution.
    pub fn revolution(&self) -> Result<Revolution, SceneError> {
        let built = match self {
            &Self::Power {
                coefficient,
                exponent,
            } => PowerProfile::new(coefficient, exponent).map(Revolution::Power),
            &Self::Cone { slope } => PowerProfile::cone(slope).map(Revolution::Power),
            &Self::Paraboloid { curvature } => {
                PowerProfile::paraboloid(curvature).map(Revolution::Power)
            }
            &Self::Sphere { radius } => Sphere::new(radius).map(Revolution::Sphere),
            &Self::Spheroid { radius, height } => {
                Spheroid::new(radius, height).map(Revolution::other)
            }
            Self::Superposition { terms } => Ok(Revolution::Sum(superposition(terms)?)),
            &Self::FlatPunch { radius } => FlatPunch::new(radius).map(Revolution::other),
            &Self::FlatCone { radius, slope } => {
                FlatCone::new(radius, slope).map(Revolution::other)
            }
            &Self::RoundTippedCone { radius, slope } => {
                RoundTippedCone::new(radius, slope).map(Revolution::other)
            }
            &Self::Hyperboloid { radius, slope } => {
                Hyperboloid::new(radius, slope).map(Revolution::other)
            }
            &Self::TruncatedParaboloid { radius, curvature } => {
                TruncatedParaboloid::new(radius, curvature).map(Revolution::other)
            }
            Self::Cylinder { .. }
            | Self::Table { .. }
            | Self::HeightMap(_)
            | Self::SelfAffine(_)
            | Self::Spectrum(_) => {
                let problem = "it is not a body of revolution that is given by numbers";
                return Err(SceneError::at(self.key(), problem));
            }
        };
        built.map_err(|error| SceneError::of_body(&self.key(), error))
    }

    /// True if the surface of the body repeats itself, so that it has no end.
    pub fn is_periodic(&self) -> bool {
        match self {
            Self::SelfAffine(_) | Self::Spectrum(_) => true,
            Self::HeightMap(map) => map.edges != Edges::Wall,
            _ => false,
        }
    }

    /// Path of the table of the body in the scene, such as `indenter.sphere`.
    pub fn key(&self) -> String {
        let name: &str = self.into();
        format!("indenter.{name}")
    }

    /// Checks every number against its range, and the wavelengths of a self-affine surface against one another.
    ///
    /// # Errors
    /// [`SceneError`] for the first number out of range.
    pub fn check(&self) -> Result<(), SceneError> {
        check_ranges("indenter", self)?;
        match self {
            Self::SelfAffine(surface) => check_wavelengths(surface),
            _ => Ok(()),
        }
    }

    /// Largest number of random surfaces, and the relative standard error of the mean at which sampling stops; 1 and `None` for a
    /// body that is not random.
    ///
    /// # Errors
    /// [`SceneError`] for a number out of range.
    pub fn realisations(&self) -> Result<(u64, Option<f64>), SceneError> {
        let (Self::SelfAffine(SelfAffineSurface {
            realisations,
            standard_error,
            ..
        })
        | Self::Spectrum(SpectrumSurface {
            realisations,
            standard_error,
            ..
        })) = self
        else {
            return Ok((1, None));
        };
        self.check()?;
        let count = realisations.unwrap_or(standard_error.map_or(1, |_| MAX_REALISATIONS));
        let holds = standard_error.is_none() || count >= FEWEST_REALISATIONS as u64;
        let allowed = "from 10 to 1000 with a standard_error, which fewer do not tell";
        in_range("realisations", count as f64, holds, allowed)
            .map_err(|refused| SceneError::within(&self.key(), refused))?;
        Ok((count, *standard_error))
    }

    /// One of the random surfaces, counted from 0, with its seed; `None` if the body is not random.
    pub fn realisation(&self, index: u64) -> Option<(Self, u64)> {
        let mut one = self.clone();
        let (Self::SelfAffine(SelfAffineSurface {
            seed,
            realisations,
            standard_error,
            ..
        })
        | Self::Spectrum(SpectrumSurface {
            seed,
            realisations,
            standard_error,
            ..
        })) = &mut one
        else {
            return None;
        };
        (*realisations, *standard_error) = (None, None);
        *seed = seed.wrapping_add(index);
        let seed = *seed;
        Some((one, seed))
    }
}

/// The body of revolution h = Σ cᵢ r^pᵢ.
fn superposition(terms: &[Term]) -> Result<Superposition, SceneError> {
    let term = |term: &Term| PowerTerm {
        coefficient: term.coefficient,
        exponent: term.exponent,
    };
    Superposition::new(terms.iter().map(term).collect())
        .map_err(|error| SceneError::at("indenter.superposition.terms", error.to_string()))
}

/// Rejects a shortest wavelength above the longest.
fn check_wavelengths(surface: &SelfAffineSurface) -> Result<(), SceneError> {
    let [shortest, longest] = [surface.shortest_wavelength, surface.longest_wavelength];
    if shortest > longest {
        let [shortest, longest] = [shortest, longest].map(MessageNumber);
        let problem = format!(
            "it must not be longer than longest_wavelength, {longest} m, but is {shortest} m"
        );
        return Err(SceneError::at(
            "indenter.self-affine.shortest_wavelength",
            problem,
        ));
    }
    Ok(())
}
