//! The rigid body of a scene.

use std::ops::Deref;
use std::path::Path;

use indenters::{
    Axisymmetric, Cylinder, FlatCone, FlatPunch, HeightMap, Hyperboloid, IndenterError,
    PowerProfile, PowerTerm, RoundTippedCone, Sphere, Superposition, TruncatedParaboloid,
};

use crate::scene::{Indenter, SceneError, Term, height_map, in_range, positive, profile};
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

/// The body of a table of the scene file.
///
/// # Errors
/// [`SceneError`] for the first number that is out of range.
pub(crate) fn body(indenter: &Indenter, folder: &Path, read: ReadFile) -> Result<Body, SceneError> {
    let of = Revolution::Power;
    let shape = match indenter {
        &Indenter::Power {
            coefficient,
            exponent,
        } => PowerProfile::new(coefficient, exponent).map(of),
        &Indenter::Cone { slope } => PowerProfile::cone(slope).map(of),
        &Indenter::Paraboloid { curvature } => PowerProfile::paraboloid(curvature).map(of),
        &Indenter::Sphere { radius } => Sphere::new(radius).map(Revolution::Sphere),
        &Indenter::FlatPunch { radius } => FlatPunch::new(radius).map(other),
        &Indenter::FlatCone { radius, slope } => FlatCone::new(radius, slope).map(other),
        &Indenter::RoundTippedCone { radius, slope } => {
            RoundTippedCone::new(radius, slope).map(other)
        }
        &Indenter::Hyperboloid { radius, slope } => Hyperboloid::new(radius, slope).map(other),
        &Indenter::TruncatedParaboloid { radius, curvature } => {
            TruncatedParaboloid::new(radius, curvature).map(other)
        }
        Indenter::Superposition { terms } => Ok(Revolution::Sum(sum(terms)?)),
        Indenter::Table { file } => Ok(table_profile(&folder.join(file), read)?),
        &Indenter::Cylinder { radius } => {
            let cylinder = Cylinder::new(radius).map(Body::Cylinder);
            return cylinder.map_err(|error| refused(&indenter.key(), error));
        }
        Indenter::HeightMap { file, spacing } => {
            return map(&folder.join(file), *spacing, read).map(Body::HeightMap);
        }
    };
    let shape = shape.map_err(|error| refused(&indenter.key(), error))?;
    Ok(Body::Revolution(shape))
}

fn other(shape: impl Axisymmetric + 'static) -> Revolution {
    Revolution::Other(Box::new(shape))
}

fn sum(terms: &[Term]) -> Result<Superposition, SceneError> {
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
    let key = "indenter.superposition.terms";
    Superposition::new(terms.iter().map(term).collect())
        .map_err(|error| SceneError::at(key, error.to_string()))
}

fn table_profile(file: &Path, read: ReadFile) -> Result<Revolution, SceneError> {
    let profile = read(file).and_then(|contents| profile(file, &contents).map_err(WrongInput));
    let wrong = |WrongInput(problem)| SceneError::at("indenter.table.file", problem);
    profile.map(other).map_err(wrong)
}

fn map(file: &Path, spacing: [f64; 2], read: ReadFile) -> Result<HeightMap, SceneError> {
    for (index, spacing) in spacing.into_iter().enumerate() {
        positive(&format!("indenter.height-map.spacing[{index}]"), spacing)?;
    }
    let read_map = || {
        let map = height_map(file, &read(file)?, spacing).map_err(WrongInput)?;
        if map.extent().into_iter().flatten().any(|end| end == 0.0) {
            return Err(WrongInput(format!(
                "{}: the lowest height lies on the edge of the map, where the contact would end with it",
                file.display()
            )));
        }
        Ok(map)
    };
    read_map().map_err(|WrongInput(problem)| SceneError::at("indenter.height-map.file", problem))
}

/// The number that the library refuses, with its key.
fn refused(table: &str, error: IndenterError) -> SceneError {
    match error {
        IndenterError::InvalidParameter(refused) => SceneError::Value {
            key: format!("{table}.{}", refused.parameter),
            value: refused.value,
            allowed: refused.allowed,
        },
        other => SceneError::at(table, other.to_string()),
    }
}
