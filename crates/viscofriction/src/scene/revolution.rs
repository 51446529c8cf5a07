//! A body of revolution, by the closed forms that its shape has.

use std::ops::Deref;

use indenters::{Axisymmetric, PowerProfile, Sphere, Superposition, Surface};

/// A body of revolution.
pub enum Revolution {
    /// h = c r^p.
    Power(PowerProfile),
    /// A sum of powers.
    Sum(Superposition),
    /// The exact sphere.
    Sphere(Sphere),
    /// Any other body of revolution.
    Other(Box<dyn Axisymmetric>),
}

impl std::fmt::Debug for Revolution {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let exponent = self.profile_exponent();
        write!(formatter, "Revolution of the exponent {exponent}")
    }
}

/// Gives access to the methods of the shape.
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
    /// A body of revolution without closed forms of its own.
    pub(crate) fn other(shape: impl Axisymmetric + 'static) -> Self {
        Self::Other(Box::new(shape))
    }

    /// The body as a surface h(x, y), for the half-space methods.
    pub(crate) fn surface(&self) -> &dyn Surface {
        match self {
            Self::Power(profile) => profile,
            Self::Sum(profile) => profile,
            Self::Sphere(sphere) => sphere,
            Self::Other(shape) => shape,
        }
    }
}
