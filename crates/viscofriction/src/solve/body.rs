//! The rigid body of a scene.

use std::ops::Deref;
use std::path::Path;

use indenters::rough::{PeriodicSurface, SelfAffine};
#[cfg(feature = "topography")]
use indenters::topography::Topography;
use indenters::{
    Axisymmetric, Cylinder, FlatCone, FlatPunch, HeightMap, Hyperboloid, IndenterError,
    PowerProfile, PowerTerm, RoundTippedCone, Sphere, Superposition, Surface, TruncatedParaboloid,
};
use numerics::{in_range, positive};

use crate::scene::{
    Edges, Indenter, SceneError, SelfAffineSurface, Term, height_map, measured, profile,
};
use crate::text::{ReadFile, WrongInput};

/// The rigid body, by what the methods tell apart.
#[derive(Debug)]
pub enum Body {
    /// A body of revolution.
    Revolution(Revolution),
    /// Infinite along y.
    Cylinder(Cylinder),
    /// A grid of heights.
    HeightMap(HeightMap),
    /// Repeats itself along x and y.
    Periodic(PeriodicSurface),
}

impl Body {
    /// Its surface; none of a cylinder and of a periodic surface, which have no end.
    pub(crate) fn surface(&self) -> Option<&dyn Surface> {
        match self {
            Self::Revolution(body) => Some(body.surface()),
            Self::HeightMap(map) => Some(map),
            Self::Cylinder(_) | Self::Periodic(_) => None,
        }
    }

    /// Area of one period, \[m²]; none of a body that does not repeat itself.
    pub(crate) fn period_area(&self) -> Option<f64> {
        match self {
            Self::Periodic(surface) => Some(surface.period().iter().product()),
            _ => None,
        }
    }
}

/// A body of revolution.
pub enum Revolution {
    /// h = c r^p.
    Power(PowerProfile),
    /// A sum of powers.
    Sum(Superposition),
    /// The exact sphere.
    Sphere(Sphere),
    /// Any other.
    Other(Box<dyn Axisymmetric>),
}

impl std::fmt::Debug for Revolution {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let exponent = self.profile_exponent();
        write!(formatter, "Revolution of the exponent {exponent}")
    }
}

/// A body of revolution is the shape that it holds.
impl Deref for Revolution {
    type Target = dyn Axisymmetric;

    fn deref(&self) -> &Self::Target {
        match self {
            Self::Power(profile) => profile,
            Self::Sum(profile) => profile,
            Self::Sphere(sphere) => sphere,
            Self::Other(shape) => &**shape,
        }
    }
}

impl Revolution {
    pub(crate) fn surface(&self) -> &dyn Surface {
        match self {
            Self::Power(profile) => profile,
            Self::Sum(profile) => profile,
            Self::Sphere(sphere) => sphere,
            Self::Other(shape) => shape,
        }
    }
}

/// The body of a table of the scene file.
///
/// # Errors
/// [`SceneError`] for the first number that is out of range.
pub fn body(indenter: &Indenter, folder: &Path, read: ReadFile) -> Result<Body, SceneError> {
    let power = |profile| Body::Revolution(Revolution::Power(profile));
    let sphere = |sphere| Body::Revolution(Revolution::Sphere(sphere));
    let body = match indenter {
        &Indenter::Power {
            coefficient,
            exponent,
        } => PowerProfile::new(coefficient, exponent).map(power),
        &Indenter::Cone { slope } => PowerProfile::cone(slope).map(power),
        &Indenter::Paraboloid { curvature } => PowerProfile::paraboloid(curvature).map(power),
        &Indenter::Sphere { radius } => Sphere::new(radius).map(sphere),
        &Indenter::FlatPunch { radius } => FlatPunch::new(radius).map(other),
        &Indenter::FlatCone { radius, slope } => FlatCone::new(radius, slope).map(other),
        &Indenter::RoundTippedCone { radius, slope } => {
            RoundTippedCone::new(radius, slope).map(other)
        }
        &Indenter::Hyperboloid { radius, slope } => Hyperboloid::new(radius, slope).map(other),
        &Indenter::TruncatedParaboloid { radius, curvature } => {
            TruncatedParaboloid::new(radius, curvature).map(other)
        }
        Indenter::Superposition { terms } => Ok(Body::Revolution(Revolution::Sum(sum(terms)?))),
        Indenter::Table { file } => Ok(table_profile(&folder.join(file), read)?),
        &Indenter::Cylinder { radius } => Cylinder::new(radius).map(Body::Cylinder),
        Indenter::HeightMap {
            file,
            spacing,
            fill_missing,
            level,
            edges,
            shortest_wavelength,
        } => {
            let file = folder.join(file);
            let map = map(&file, *spacing, [*fill_missing, *level], read)?;
            return with_edges(map, *edges, *shortest_wavelength).map_err(|(key, problem)| {
                SceneError::at(format!("indenter.height-map.{key}"), problem)
            });
        }
        Indenter::SelfAffine(surface) => self_affine(surface).surface().map(Body::Periodic),
    };
    body.map_err(|error| refused(&indenter.key(), error))
}

fn self_affine(surface: &SelfAffineSurface) -> SelfAffine {
    let longest_wavelength = surface.longest_wavelength;
    SelfAffine {
        period: surface.period,
        hurst_exponent: surface.hurst_exponent,
        rms_slope: surface.rms_slope,
        longest_wavelength,
        shortest_wavelength: surface.shortest_wavelength,
        roll_off_wavelength: surface.roll_off_wavelength.unwrap_or(longest_wavelength),
        seed: surface.seed,
    }
}

fn other(shape: impl Axisymmetric + 'static) -> Body {
    Body::Revolution(Revolution::Other(Box::new(shape)))
}

fn sum(terms: &[Term]) -> Result<Superposition, SceneError> {
    let table = "indenter.superposition.terms";
    for (index, term) in terms.iter().enumerate() {
        let wrong = |refused| SceneError::within(&format!("{table}[{index}]"), refused);
        let coefficient = term.coefficient;
        let holds = coefficient.is_finite() && coefficient != 0.0;
        in_range("coefficient", coefficient, holds, "finite and not 0").map_err(wrong)?;
        positive("exponent", term.exponent).map_err(wrong)?;
    }
    let term = |term: &Term| PowerTerm {
        coefficient: term.coefficient,
        exponent: term.exponent,
    };
    Superposition::new(terms.iter().map(term).collect())
        .map_err(|error| SceneError::at(table, error.to_string()))
}

fn table_profile(file: &Path, read: ReadFile) -> Result<Body, SceneError> {
    let wrong = |problem: String| SceneError::at("indenter.table.file", problem);
    let contents = read(file).map_err(|WrongInput(problem)| wrong(problem))?;
    profile(file, &contents).map(other).map_err(wrong)
}

/// A grid of heights, which says how far apart they are, or the scene does.
fn map(
    file: &Path,
    spacing: Option<[f64; 2]>,
    change: [bool; 2],
    read: ReadFile,
) -> Result<HeightMap, SceneError> {
    let wrong = |problem: String| SceneError::at("indenter.height-map.file", problem);
    let spaced = |problem: &str| SceneError::at("indenter.height-map.spacing", problem);
    let contents = || read(file).map_err(|WrongInput(problem)| wrong(problem));
    let in_file = |problem: String| wrong(format!("{}: {problem}", file.display()));
    let map = match (measured(file), spacing) {
        (Some(_), Some(_)) => return Err(spaced("a measured surface has its own; leave this out")),
        (None, None) => return Err(spaced("missing field `spacing`")),
        (Some(extension), None) => {
            measured_body(extension, &contents()?, change).map_err(in_file)?
        }
        (None, Some(_)) if change != [false; 2] => {
            let problem = "fill_missing and level are for measured surfaces; leave them out";
            return Err(wrong(problem.to_owned()));
        }
        (None, Some(spacing)) => {
            positive("indenter.height-map.spacing[0]", spacing[0])?;
            positive("indenter.height-map.spacing[1]", spacing[1])?;
            height_map(file, &contents()?, spacing).map_err(wrong)?
        }
    };
    Ok(map)
}

/// A map that ends at its edges or repeats itself; or a key and what is wrong with it.
fn with_edges(
    map: HeightMap,
    edges: Edges,
    shortest_wavelength: Option<f64>,
) -> Result<Body, (&'static str, String)> {
    match (edges, shortest_wavelength) {
        (Edges::Periodic, shortest) => PeriodicSurface::through(&map, shortest.unwrap_or(0.0))
            .map(Body::Periodic)
            .map_err(|error| ("edges", error.to_string())),
        (Edges::Mirrored, shortest) => with_edges(map.mirrored(), Edges::Periodic, shortest),
        (Edges::Wall, Some(_)) => {
            let problem = "only of edges = \"periodic\" or \"mirrored\" waves are left out";
            Err(("shortest_wavelength", problem.to_owned()))
        }
        (Edges::Wall, None) if map.extent().into_iter().flatten().any(|end| end == 0.0) => {
            let problem = "the lowest height lies on the edge of the map, where the contact would end with it; \
                           edges = \"periodic\" repeats the map, and \"mirrored\" its mirror images too";
            Err(("file", problem.to_owned()))
        }
        (Edges::Wall, None) => Ok(Body::HeightMap(map)),
    }
}

/// The body of a measured surface, whose missing heights are filled, and then whose tilt is taken out, where it is asked.
#[cfg(feature = "topography")]
fn measured_body(
    extension: &str,
    contents: &[u8],
    [fill, level]: [bool; 2],
) -> Result<HeightMap, String> {
    let surface = Topography::read(extension, contents).map_err(|error| error.to_string())?;
    let surface = if fill { surface.filled() } else { surface };
    let surface = if level { surface.levelled() } else { surface };
    surface.body().map_err(|error| error.to_string())
}

#[cfg(not(feature = "topography"))]
fn measured_body(extension: &str, _: &[u8], _: [bool; 2]) -> Result<HeightMap, String> {
    let problem = "a reader of this format needs the feature topography of the crate viscofriction";
    Err(format!("{extension}: {problem}"))
}

/// The number that the library refuses, with its key.
fn refused(table: &str, error: IndenterError) -> SceneError {
    match error {
        IndenterError::InvalidParameter(refused) => SceneError::within(table, refused),
        other => SceneError::at(table, other.to_string()),
    }
}
