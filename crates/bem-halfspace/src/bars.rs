//! Error bars that the methods have in common: of the quantities of a contact, from several resolutions.

use indenters::{Control, Surface};
use numerics::{Accuracy, ErrorParts, Estimate, Goal, NotReached, Quantity};
use rheology::Material;

use crate::BemError;

/// Slowest and fastest order in which friction is assumed to converge: smooth bodies are better than the first, which is
/// safe to assume although their outline follows the elements; below the smallest one nothing converges.
const ORDERS: [f64; 2] = [0.1, 1.0];
/// Error of the ends of a contact in elements. Its outline follows the elements, and in the outermost of them the pressure
/// decides whether all of it or nothing counts; `the_bars_of_an_elastic_contact_hold` has the ends of known contacts.
const ELEMENTS_AT_END: f64 = 1.5;

/// One value for each quantity of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Quantities<V> {
    pub(crate) friction_coefficient: V,
    pub(crate) normal_force: V,
    pub(crate) indentation_depth: V,
    pub(crate) contact_area: V,
    pub(crate) peak_pressure: V,
}

/// The quantity that a refinement drives to the error asked for, beside the normal force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Target {
    Friction,
    /// Where nothing slides, or nothing is dissipated.
    Depth,
}

/// What the resolutions lead to.
#[derive(Debug)]
pub(crate) struct Resolved<T> {
    pub(crate) finest: T,
    pub(crate) estimates: Quantities<Estimate>,
    pub(crate) parts: Quantities<ErrorParts>,
}

impl<V: Copy> Quantities<V> {
    pub(crate) const fn all(value: V) -> Self {
        Self {
            friction_coefficient: value,
            normal_force: value,
            indentation_depth: value,
            contact_area: value,
            peak_pressure: value,
        }
    }

    const fn to_array(self) -> [V; 5] {
        [
            self.friction_coefficient,
            self.normal_force,
            self.indentation_depth,
            self.contact_area,
            self.peak_pressure,
        ]
    }

    const fn from_array(values: [V; 5]) -> Self {
        let [
            friction_coefficient,
            normal_force,
            indentation_depth,
            contact_area,
            peak_pressure,
        ] = values;
        Self {
            friction_coefficient,
            normal_force,
            indentation_depth,
            contact_area,
            peak_pressure,
        }
    }
}

/// How a contact is resolved.
pub(crate) struct Resolution {
    pub(crate) accuracy: Accuracy,
    pub(crate) target: Target,
    /// Elements along the contact after which the error asked for is given up.
    pub(crate) largest: usize,
    /// Power of the elements with which the errors fall, at least.
    pub(crate) order: f64,
}

/// The order 2p − 1 of the friction under an apex h ∼ r^p, or the first where that is slower.
pub(crate) fn order_of_friction(apex_exponent: f64) -> f64 {
    (2.0 * apex_exponent - 1.0).clamp(ORDERS[0], ORDERS[1])
}

/// Error of the ends of a contact, \[m].
pub(crate) fn of_box(spacing: [f64; 2]) -> f64 {
    ELEMENTS_AT_END * spacing[0].max(spacing[1])
}

/// Whether a material has an instantaneous modulus. Without one the pressure is singular at the front.
pub(crate) fn reacts_at_once(material: &(impl Material + ?Sized)) -> bool {
    material.creep().instantaneous_compliance() > 0.0
}

/// Whether the largest pressure is known to have a limit: under a smooth body of revolution on a material that reacts at
/// once.
pub(crate) fn peak_has_limit(surface: &dyn Surface, material: &(impl Material + ?Sized)) -> bool {
    let smooth = surface.as_axisymmetric().is_some_and(|body| {
        let exponent = body.profile_exponent();
        body.kinks().is_empty() && exponent >= 2.0 && exponent.is_finite()
    });
    smooth && reacts_at_once(material)
}

/// Solves with the number of elements asked for, or with more and more until normal force and target have the error asked
/// for.
///
/// `others` are the parts of the error that all resolutions have in common, and hence do not show.
pub(crate) fn resolve<T>(
    resolution: &Resolution,
    solve: impl Fn(usize) -> Result<T, BemError>,
    values: impl Fn(&T) -> Quantities<f64>,
    others: impl Fn(usize, &T) -> Quantities<ErrorParts>,
) -> Result<Resolved<T>, BemError> {
    let goal = Goal {
        accuracy: resolution.accuracy,
        largest: resolution.largest,
        order: resolution.order,
    };
    let target = resolution.target;
    let drives = [
        target == Target::Friction,
        true,
        target == Target::Depth,
        false,
        false,
    ];
    let quantities = |state: &T| {
        let values = values(state).to_array();
        std::array::from_fn(|index| Quantity {
            drives: drives[index],
            ..Quantity::from(values[index])
        })
    };
    let others = |elements: usize, state: &T| Ok(others(elements, state).to_array());
    let resolved = numerics::refine(&goal, solve, quantities, others)?;
    let values = values(&resolved.value).to_array();
    Ok(Resolved {
        estimates: Quantities::from_array(std::array::from_fn(|index| Estimate {
            value: values[index],
            error: resolved.error[index],
        })),
        parts: Quantities::from_array(resolved.parts),
        finest: resolved.value,
    })
}

impl From<NotReached> for BemError {
    /// The quantities that drive a refinement, by their place in quantities.
    fn from(reached: NotReached) -> Self {
        let NotReached {
            quantity,
            value,
            error,
            asked: relative_error,
            ..
        } = reached;
        match quantity {
            0 => Self::FrictionNotReached {
                friction_coefficient: value,
                error,
                relative_error,
            },
            1 => Self::ForceNotReached {
                normal_force: value,
                error,
                relative_error,
            },
            _ => Self::DepthNotReached {
                indentation_depth: value,
                error,
                relative_error,
            },
        }
    }
}

/// The force that is given, exactly, or the one that was found.
pub(crate) fn force(control: Control, found: Estimate) -> Estimate {
    match control {
        Control::NormalForce(value) => Estimate { value, error: 0.0 },
        Control::IndentationDepth(_) => found,
    }
}

/// The depth that is given, exactly, or the one that was found.
pub(crate) fn depth(control: Control, found: Estimate) -> Estimate {
    match control {
        Control::NormalForce(_) => found,
        Control::IndentationDepth(value) => Estimate { value, error: 0.0 },
    }
}
