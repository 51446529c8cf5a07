//! Error bars of the quantities of a contact from several resolutions, shared by all methods.

use indenters::{Control, Surface};
use numerics::{ErrorParts, Estimate, Goal, MIN_CONVERGENCE_ORDER, NotReached, Quantity};

use crate::{BemError, Elastomer, Reached};
use rheology::Material as _;

use crate::estimate::averages::Refinement;
use crate::estimate::quantities::{Name, Quantities};

/// Convergence order that the front of the contact causes (docs/theory/stationary-half-space.md, "Scatter, order, error bar").
pub(crate) const FRONT_ORDER: f64 = 1.5;
/// Error of each end of a contact, in elements. Chosen above one element (case of `evidence tuning`).
///
/// The contact boundary follows the elements, and each outermost element is in contact as a whole or not at all. The test
/// `the_bars_of_an_elastic_contact_hold` compares with known contacts.
const END_ERROR_IN_ELEMENTS: f64 = 1.5;

/// A contact with an error bar for every quantity; an error of 0 means that the quantity is prescribed.
///
/// In plane strain the force and the area are per length along y, \[N/m] and \[m].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct ContactEstimate<S, O> {
    /// Friction coefficient μ = F_h/F_N; 0 without sliding.
    pub friction_coefficient: Estimate,
    /// Parts of the error of the friction coefficient; without sliding those of the depth, or of the force at a given depth.
    pub error_parts: ErrorParts,
    /// Normal force F_N, \[N].
    pub normal_force: Estimate,
    /// Depth of the lowest point below the undeformed surface, \[m].
    ///
    /// `None` on a half space in plane strain, and for a load without sliding distance on a half space that flows: there the
    /// body sinks without limit.
    pub indentation_depth: Option<Estimate>,
    /// Contact area, \[m²].
    pub contact_area: Estimate,
    /// Largest pressure, \[Pa], of smooth bodies of revolution and cylinders on materials with an instantaneous modulus.
    ///
    /// `None` elsewhere, where it grows without limit on refinement or is not known to be bounded, and if the pressure depends
    /// on the history of the contact.
    pub peak_pressure: Option<Estimate>,
    /// Error of the ends of the contact along x and y in [`finest`](Self::finest), \[m].
    pub contact_box_error: f64,
    /// Averages over shifted grids that led to a stationary state with a given relative error, from coarse to fine; else empty.
    pub refinements: Vec<Refinement>,
    /// Result on the finest grid, without errors.
    pub finest: S,
    /// Spacing, footprint and tolerance of the finest grid.
    pub options: O,
}

impl<S, O> ContactEstimate<S, O> {
    /// Replaces the friction by that of an elastic material, which is exactly 0 under any body.
    pub(crate) fn remove_friction(&mut self) {
        self.friction_coefficient = Estimate::exact(0.0);
        self.error_parts = ErrorParts::NONE;
    }
}

/// A contact on one grid, with what an error estimate needs besides the differences between grids.
pub(crate) struct OnGrid<S, O> {
    /// Values of all quantities.
    pub(crate) quantities: Quantities<f64>,
    /// Parts of the error of the target that all grids have in common, so that refinement does not reveal them.
    pub(crate) common_error: ErrorParts,
    /// Lower bound of the discretisation error of the target, in its unit, because grids may agree by chance.
    pub(crate) target_uncertainty: f64,
    /// Lower bound of the discretisation error of the contact area, \[m²].
    pub(crate) area_uncertainty: f64,
    /// Convergence order of the contact area; `None` if it is that of the target.
    pub(crate) area_order: Option<f64>,
    /// Longer edge of an element, \[m].
    pub(crate) spacing: f64,
    /// Solution on the grid, which becomes [`ContactEstimate::finest`].
    pub(crate) state: S,
    /// Grid and stopping criteria of the solution.
    pub(crate) options: O,
}

impl<S, O> OnGrid<S, O> {
    /// The quantities of the grid for the refinement, in the order of [`Name::IN_ORDER`].
    ///
    /// Normal force and the quantity `target` control the refinement: they are refined to the error asked for.
    fn quantities_for(&self, target: Name) -> Vec<Quantity> {
        let quantity = |(name, value): (Name, f64)| Quantity {
            controls_refinement: name == target || name == Name::Force,
            error_floor: match name {
                Name::Area => self.area_uncertainty,
                _ if name == target => self.target_uncertainty,
                _ => 0.0,
            },
            order: self.area_order.filter(|_| name == Name::Area),
            ..Quantity::from(value)
        };
        self.quantities.iter().map(quantity).collect()
    }
}

/// The quantity that is refined to the error asked for, in addition to the normal force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Target {
    /// Friction coefficient.
    Friction,
    /// Depth under a force, or force at a depth: for contacts without sliding or without dissipation.
    Depth,
}

/// Goal of a refinement.
pub(crate) struct Resolution<'w> {
    /// Request, limits and convergence order.
    pub(crate) goal: Goal<'w>,
    /// Prescribed force or depth.
    pub(crate) control: Control,
    /// Quantity that is refined besides the force.
    pub(crate) target: Target,
    /// True if the largest pressure is known to be bounded on refinement, so that it has an estimate.
    pub(crate) has_peak: bool,
}

impl Resolution<'_> {
    /// Name of the quantity that is the target under the prescribed force or depth.
    const fn target_name(&self) -> Name {
        match (self.target, self.control) {
            (Target::Friction, _) => Name::Friction,
            (Target::Depth, Control::NormalForce(_)) => Name::Depth,
            (Target::Depth, Control::IndentationDepth(_)) => Name::Force,
        }
    }
}

/// Convergence order of the friction under an apex h ∼ r^p with p = `apex_exponent`: 2p − 1, at most `smooth`, the order under a smooth
/// body (docs/theory/stationary-half-space.md, "Scatter, order, error bar").
pub(crate) fn order_of_friction(apex_exponent: f64, smooth: f64) -> f64 {
    (2.0 * apex_exponent - 1.0).clamp(MIN_CONVERGENCE_ORDER, smooth)
}

/// Error of the ends of a contact, \[m], on elements whose longer edge is `spacing` \[m].
pub(crate) fn contact_box_error(spacing: f64) -> f64 {
    END_ERROR_IN_ELEMENTS * spacing
}

/// True if a material has an instantaneous compliance, and so a finite instantaneous modulus. Without it the pressure is singular
/// at the front.
pub(crate) fn has_instantaneous_compliance(elastomer: &dyn Elastomer) -> bool {
    elastomer.material().creep().instantaneous_compliance() > 0.0
}

/// True if the largest pressure is known to be bounded: under a smooth body of revolution on a material with an instantaneous
/// modulus.
pub(crate) fn peak_has_limit(surface: &dyn Surface, elastomer: &dyn Elastomer) -> bool {
    let is_smooth = surface.as_axisymmetric().is_some_and(|body| {
        let exponent = body.profile_exponent();
        body.kinks().is_empty() && exponent >= 2.0 && exponent.is_finite()
    });
    is_smooth && has_instantaneous_compliance(elastomer)
}

/// Solves with the number of elements asked for, or on finer and finer grids until normal force and target have the error asked
/// for; returns the values with error bars.
///
/// `solve(elements, report)` solves on one grid with a number of elements along the contact. `finish` turns the estimate into the
/// result, also if the error was not reached.
///
/// # Errors
/// [`BemError::NotReached`] with the result on the finest grid; those of `solve` and `finish`.
pub(crate) fn resolve<S, O, E: Into<Reached>>(
    resolution: &Resolution,
    solve: impl Fn(usize, &dyn Fn(f64)) -> Result<OnGrid<S, O>, BemError>,
    finish: impl FnOnce(ContactEstimate<S, O>) -> Result<E, BemError>,
) -> Result<E, BemError> {
    let (control, target) = (resolution.control, resolution.target_name());
    let quantities = |contact: &OnGrid<S, O>| contact.quantities_for(target);
    let common_errors = |contact: &OnGrid<S, O>, _: &dyn Fn(f64)| {
        let mut errors = vec![ErrorParts::NONE; Name::IN_ORDER.len()];
        errors[target.index()] = contact.common_error;
        Ok(errors)
    };
    // Refine the grid until the error is reached. The errors that all grids share are added to those of the elements.
    let refined = numerics::refine(&resolution.goal, solve, quantities, common_errors)?;
    let errors = &refined.error;
    let values = &refined.value.quantities;
    let known = values.map(|name, value| Estimate::new(value, errors[name.index()]));
    // A prescribed force or depth has no error, and replaces the computed one.
    let [given_force, given_depth] = prescribed_estimates(control);
    let estimate = finish(ContactEstimate {
        friction_coefficient: known.friction_coefficient,
        error_parts: refined.parts[target.index()],
        normal_force: given_force.unwrap_or(known.normal_force),
        indentation_depth: Some(given_depth.unwrap_or(known.indentation_depth)),
        contact_area: known.contact_area,
        peak_pressure: resolution.has_peak.then_some(known.peak_pressure),
        contact_box_error: contact_box_error(refined.value.spacing),
        refinements: Vec::new(),
        finest: refined.value.state,
        options: refined.value.options,
    })?;
    reached_or_error(refined.missed, Name::of_quantity, estimate)
}

/// The result, or [`BemError::NotReached`] with the result inside if a quantity missed the error asked for.
///
/// `name(index)` is the description of a quantity by its index in the refinement.
pub(crate) fn reached_or_error<E: Into<Reached>>(
    missed: Option<NotReached>,
    name: impl FnOnce(usize) -> &'static str,
    found: E,
) -> Result<E, BemError> {
    let Some(missed) = missed else {
        return Ok(found);
    };
    Err(BemError::NotReached {
        quantity: name(missed.quantity),
        value: missed.value,
        error: missed.error,
        relative_error: missed.relative_error,
        reached: Box::new(found.into()),
    })
}

/// Exact estimates of [force, depth]; `None` for the one that is not prescribed.
pub(crate) fn prescribed_estimates(control: Control) -> [Option<Estimate>; 2] {
    match control {
        Control::NormalForce(force) => [Some(Estimate::exact(force)), None],
        Control::IndentationDepth(depth) => [None, Some(Estimate::exact(depth))],
    }
}
