//! Error bars that the methods have in common: of the quantities of a contact, from several resolutions.

use indenters::{Control, Surface};
use numerics::{ErrorParts, Estimate, Goal, NotReached, Quantity};

use crate::{BemError, Elastomer, Reached};
use rheology::Material as _;

use crate::estimate::averages::Refinement;
use crate::estimate::quantities::{Name, Quantities};

/// The place of the friction from the dissipated power in lists of quantities, after those that have names.
const DISSIPATED: usize = Name::ALL.len();
/// Slowest order in which friction is assumed to converge, below which nothing does.
const SLOWEST: f64 = 0.1;
/// Error of the ends of a contact in elements. Its outline follows the elements, and in the outermost of them the pressure
/// decides whether all of it or nothing counts; `the_bars_of_an_elastic_contact_hold` has the ends of known contacts.
const ELEMENTS_AT_END: f64 = 1.5;

/// A contact with the error bar of every quantity; an error of 0 says that the quantity is given.
///
/// In plane strain the force and the area are per length along y, \[N/m] and \[m].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct ContactEstimate<S, O> {
    /// Friction coefficient μ = F_h/F_N; 0 where nothing slides.
    pub friction_coefficient: Estimate,
    /// What the error of the friction coefficient consists of; where nothing slides that of the depth, or of the force where
    /// the depth is given.
    pub error_parts: ErrorParts,
    /// Normal force F_N, \[N].
    pub normal_force: Estimate,
    /// Depth of the lowest point below the undeformed surface, \[m]; none on a half space in plane strain, and where it flows
    /// and the load has no sliding distance, because the body sinks without limit.
    pub indentation_depth: Option<Estimate>,
    /// Contact area, \[m²].
    pub contact_area: Estimate,
    /// Largest pressure \[Pa], of smooth bodies of revolution, and cylinders, on materials that react at once; everywhere else
    /// it grows without limit on refinement, or is not known to have one. None too where the pressure depends on how the
    /// contact has grown.
    pub peak_pressure: Option<Estimate>,
    /// Error of the ends of the contact along x and y in [`finest`](Self::finest), \[m].
    pub contact_box_error: f64,
    /// The averages over shifted grids that led to a stationary state of a relative error, from coarse to fine; none
    /// elsewhere.
    pub refinements: Vec<Refinement>,
    /// The contact on the finest grid.
    pub finest: S,
    /// The finest grid.
    pub options: O,
}

/// A contact on one grid.
pub(crate) struct OnGrid<S, O> {
    pub(crate) quantities: Quantities<f64>,
    /// Friction coefficient from the dissipated power, of stationary states.
    pub(crate) dissipated: Option<f64>,
    /// Parts of the error of the target that all grids have in common, and hence do not show.
    pub(crate) common_error: ErrorParts,
    /// Least error of the elements for the target, relative, which some grids have in common by chance.
    pub(crate) min_relative_error: f64,
    /// Edge of an element, the longer one of two, \[m].
    pub(crate) spacing: f64,
    pub(crate) state: S,
    pub(crate) options: O,
}

impl<S, O> OnGrid<S, O> {
    /// Its quantities, of which normal force and the one with the name drive the refinement.
    fn driven_by(&self, driven: Name) -> Vec<Quantity> {
        let quantity = |(name, value): (Name, f64)| Quantity {
            controls_refinement: name == driven || name == Name::Force,
            error_floor: if name == driven {
                self.min_relative_error * value.abs()
            } else {
                0.0
            },
            ..Quantity::from(value)
        };
        let dissipated = self.dissipated.map(|value| Quantity {
            controls_refinement: false,
            ..Quantity::from(value)
        });
        self.quantities
            .list()
            .map(quantity)
            .chain(dissipated)
            .collect()
    }
}

/// The quantity that a refinement drives to the error asked for, beside the normal force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Target {
    Friction,
    /// Where nothing slides, or nothing is dissipated.
    Depth,
}

/// How a contact is resolved.
pub(crate) struct Resolution<'w> {
    pub(crate) goal: Goal<'w>,
    pub(crate) control: Control,
    pub(crate) target: Target,
    /// Whether the largest pressure is known to have a limit.
    pub(crate) has_peak: bool,
    /// Part of the error of the friction from slopes that the error of that from dissipation must be below, to be taken.
    pub(crate) max_dissipation_error_ratio: f64,
}

impl Resolution<'_> {
    /// The quantity that is driven.
    const fn driven(&self) -> Name {
        match (self.target, self.control) {
            (Target::Friction, _) => Name::Friction,
            (Target::Depth, Control::NormalForce(_)) => Name::Depth,
            (Target::Depth, Control::IndentationDepth(_)) => Name::Force,
        }
    }
}

/// The order 2p − 1 of the friction under an apex h ∼ r^p, or that of a smooth body where it is slower.
pub(crate) fn order_of_friction(apex_exponent: f64, smooth: f64) -> f64 {
    (2.0 * apex_exponent - 1.0).clamp(SLOWEST, smooth)
}

/// Error of the ends of a contact on elements whose longer edge is `spacing`, \[m].
pub(crate) fn contact_box_error(spacing: f64) -> f64 {
    ELEMENTS_AT_END * spacing
}

/// Whether a material has an instantaneous modulus. Without one the pressure is singular at the front.
pub(crate) fn has_instantaneous_compliance(elastomer: &dyn Elastomer) -> bool {
    elastomer.material().creep().instantaneous_compliance() > 0.0
}

/// Whether the largest pressure is known to have a limit: under a smooth body of revolution on a material that reacts at
/// once.
pub(crate) fn peak_has_limit(surface: &dyn Surface, elastomer: &dyn Elastomer) -> bool {
    let smooth = surface.as_axisymmetric().is_some_and(|body| {
        let exponent = body.profile_exponent();
        body.kinks().is_empty() && exponent >= 2.0 && exponent.is_finite()
    });
    smooth && has_instantaneous_compliance(elastomer)
}

/// Solves with the number of elements asked for, or with more and more until normal force and target have the error asked
/// for; `finish` makes of it what is returned, also where that error was not reached.
pub(crate) fn resolve<S, O, E: Into<Reached>>(
    resolution: &Resolution,
    solve: impl Fn(usize, &dyn Fn(f64)) -> Result<OnGrid<S, O>, BemError>,
    finish: impl FnOnce(ContactEstimate<S, O>) -> Result<E, BemError>,
) -> Result<E, BemError> {
    let (control, driven) = (resolution.control, resolution.driven());
    let quantities = |contact: &OnGrid<S, O>| contact.driven_by(driven);
    let others = |contact: &OnGrid<S, O>, _: &dyn Fn(f64)| {
        let mut others = vec![ErrorParts::NONE; DISSIPATED + 1];
        others[driven.place()] = contact.common_error;
        others[DISSIPATED] = contact.common_error;
        Ok(others)
    };
    let refined = numerics::refine(&resolution.goal, solve, quantities, others)?;
    let errors = &refined.error;
    let known = |name: Name, value| Estimate::new(value, errors[name.place()]);
    let known = refined.value.quantities.map(known);
    let mut friction = known.friction_coefficient;
    let mut error_parts = refined.parts[driven.place()];
    if let Some(dissipated) = refined.value.dissipated {
        let error = errors[DISSIPATED];
        if error < resolution.max_dissipation_error_ratio * friction.error {
            friction = Estimate::new(dissipated, error);
            error_parts = refined.parts[DISSIPATED];
        }
    }
    let [given_force, given_depth] = given(control);
    let estimate = finish(ContactEstimate {
        friction_coefficient: friction,
        error_parts,
        normal_force: given_force.unwrap_or(known.normal_force),
        indentation_depth: Some(given_depth.unwrap_or(known.indentation_depth)),
        contact_area: known.contact_area,
        peak_pressure: resolution.has_peak.then_some(known.peak_pressure),
        contact_box_error: contact_box_error(refined.value.spacing),
        refinements: Vec::new(),
        finest: refined.value.state,
        options: refined.value.options,
    })?;
    reached_or_error(refined.missed, estimate)
}

/// What was found, or the error that holds it where something was missed.
pub(crate) fn reached_or_error<E: Into<Reached>>(
    missed: Option<NotReached>,
    found: E,
) -> Result<E, BemError> {
    let Some(missed) = missed else {
        return Ok(found);
    };
    Err(BemError::NotReached {
        // Of a history the quantities of each row come one after the other.
        quantity: Name::ALL[missed.quantity % Name::ALL.len()].in_words(),
        value: missed.value,
        error: missed.error,
        relative_error: missed.relative_error,
        reached: Box::new(found.into()),
    })
}

/// Force and depth, exactly, as far as they are given.
pub(crate) fn given(control: Control) -> [Option<Estimate>; 2] {
    match control {
        Control::NormalForce(force) => [Some(Estimate::exact(force)), None],
        Control::IndentationDepth(depth) => [None, Some(Estimate::exact(depth))],
    }
}
