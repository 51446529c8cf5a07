//! The rigid body of a scene.

use std::ops::Deref;
use std::path::Path;

use indenters::{
    Axisymmetric, Cylinder, FlatCone, FlatPunch, HeightMap, Hyperboloid, IndenterError,
    PowerProfile, PowerTerm, RoundTippedCone, Sphere, Superposition, TruncatedParaboloid,
};

use super::problem::ReadFile;
use crate::scene::{
    HeightMapFile, Indenter, SceneError, Term, height_map, in_range, positive, profile,
};
use crate::text::WrongInput;

/// The rigid body, by what the methods tell apart.
#[derive(Debug)]
pub enum Body {
    /// A body of revolution.
    Revolution(Revolution),
    /// Infinite along y.
    Cylinder(Cylinder),
    /// A grid of heights.
    HeightMap(HeightMap),
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
        match self {
            Self::Power(profile) => profile.fmt(formatter),
            Self::Sum(profile) => profile.fmt(formatter),
            Self::Sphere(sphere) => sphere.fmt(formatter),
            Self::Other(_) => formatter.write_str("Other"),
        }
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

/// The body of a table of the scene file.
///
/// # Errors
/// [`SceneError`] for the first number that is out of range.
pub(crate) fn body(indenter: &Indenter, folder: &Path, read: ReadFile) -> Result<Body, SceneError> {
    let key = indenter.key();
    match indenter {
        Indenter::Power(table) => power(key, PowerProfile::new(table.coefficient, table.exponent)),
        Indenter::Cone(table) => power(key, PowerProfile::cone(table.slope)),
        Indenter::Paraboloid(table) => power(key, PowerProfile::paraboloid(table.curvature)),
        Indenter::Superposition(table) => sum(&table.terms),
        Indenter::Sphere(table) => {
            let sphere = Sphere::new(table.radius).map_err(|error| refused(key, error))?;
            Ok(Body::Revolution(Revolution::Sphere(sphere)))
        }
        Indenter::FlatPunch(table) => other(key, FlatPunch::new(table.radius)),
        Indenter::FlatCone(table) => other(key, FlatCone::new(table.radius, table.slope)),
        Indenter::RoundTippedCone(table) => {
            other(key, RoundTippedCone::new(table.radius, table.slope))
        }
        Indenter::Hyperboloid(table) => other(key, Hyperboloid::new(table.radius, table.slope)),
        Indenter::TruncatedParaboloid(table) => {
            other(key, TruncatedParaboloid::new(table.radius, table.curvature))
        }
        Indenter::Table(table) => table_profile(&folder.join(&table.file), read),
        Indenter::Cylinder(table) => {
            let cylinder = Cylinder::new(table.radius);
            Ok(Body::Cylinder(
                cylinder.map_err(|error| refused(key, error))?,
            ))
        }
        Indenter::HeightMap(table) => map(table, &folder.join(&table.file), read),
    }
}

fn power(key: &str, profile: Result<PowerProfile, IndenterError>) -> Result<Body, SceneError> {
    let profile = profile.map_err(|error| refused(key, error))?;
    Ok(Body::Revolution(Revolution::Power(profile)))
}

fn other<S>(key: &str, shape: Result<S, IndenterError>) -> Result<Body, SceneError>
where
    S: Axisymmetric + 'static,
{
    let shape = shape.map_err(|error| refused(key, error))?;
    Ok(Body::Revolution(Revolution::Other(Box::new(shape))))
}

fn sum(terms: &[Term]) -> Result<Body, SceneError> {
    for (index, term) in terms.iter().enumerate() {
        let key = |name: &str| format!("indenter.superposition.terms[{index}].{name}");
        let coefficient = term.coefficient;
        let holds = coefficient.abs() > 0.0;
        in_range(&key("coefficient"), coefficient, holds, "finite and not 0")?;
        positive(&key("exponent"), term.exponent)?;
    }
    let term = |term: &Term| PowerTerm {
        coefficient: term.coefficient,
        exponent: term.exponent,
    };
    let terms = terms.iter().map(term).collect();
    let key = "indenter.superposition.terms";
    let profile =
        Superposition::new(terms).map_err(|error| SceneError::together(key, error.to_string()))?;
    Ok(Body::Revolution(Revolution::Sum(profile)))
}

fn table_profile(file: &Path, read: ReadFile) -> Result<Body, SceneError> {
    let wrong = |problem| SceneError::together("indenter.table.file", problem);
    let contents = read(file).map_err(|WrongInput(problem)| wrong(problem))?;
    let profile = profile(file, &contents).map_err(wrong)?;
    Ok(Body::Revolution(Revolution::Other(Box::new(profile))))
}

fn map(table: &HeightMapFile, file: &Path, read: ReadFile) -> Result<Body, SceneError> {
    for (index, spacing) in table.spacing.into_iter().enumerate() {
        positive(&format!("indenter.height-map.spacing[{index}]"), spacing)?;
    }
    let wrong = |problem| SceneError::together("indenter.height-map.file", problem);
    let contents = read(file).map_err(|WrongInput(problem)| wrong(problem))?;
    let map = height_map(file, &contents, table.spacing).map_err(wrong)?;
    if map.extent().into_iter().flatten().any(|end| end == 0.0) {
        return Err(wrong(format!(
            "{}: the lowest height lies on the edge of the map, where the contact would end with it",
            file.display()
        )));
    }
    Ok(Body::HeightMap(map))
}

/// The number that the library refuses, with its key.
fn refused(table: &str, error: IndenterError) -> SceneError {
    match error {
        IndenterError::InvalidParameter {
            parameter,
            value,
            allowed,
        } => SceneError::Value {
            key: format!("{table}.{parameter}"),
            value,
            allowed,
        },
        other => SceneError::together(table, other.to_string()),
    }
}
