//! Errors of this crate.

use indenters::MotionView;
use indenters::{IndenterError, Moved};
use numerics::{Estimate, InvalidParameter, MessageNumber, NotReached, Rounded};
use rheology::RheologyError;
use thiserror::Error;

use crate::{CurvePoint, Sliding, SlidingStep, SteadySliding};

/// Why a problem is refused, or has no solution.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MdrError {
    /// A parameter is not a number, or outside the range it may take.
    #[error(transparent)]
    InvalidParameter(#[from] InvalidParameter),
    /// A list is empty.
    #[error("{list} must have at least one entry")]
    Empty {
        /// Name of the list.
        list: &'static str,
    },
    /// The line has no usable height where it is needed: not a number, −∞, or no body at its candidate lowest point.
    #[error("the line must have a height at position {position}, but has {value}")]
    InvalidHeight {
        /// Position on the line, \[m].
        position: f64,
        /// The refused height, \[m].
        value: f64,
    },
    /// More elements than allowed lie below the height that the contact may reach: the line does not rise, or the
    /// spacing is too fine for it.
    #[error(
        "more than {allowed} elements of spacing {spacing} lie less than {height} above the lowest point of the line"
    )]
    TooManyElements {
        /// Largest number of elements of a foundation.
        allowed: usize,
        /// Spacing of the elements, \[m].
        spacing: f64,
        /// Height above the lowest point of the line, \[m].
        height: f64,
    },
    /// The contact would reach the edge of the body, or the front end of the line, before it carries the force (Remark 4).
    #[error(
        "the contact would reach the edge at position {} (of a sphere: its equator) under a force, in N, of {}, \
         which is not the normal force {} N: lower the force, or check the unit of the modulus or viscosity",
        Rounded(*position), Rounded(*carried_force), MessageNumber(*normal_force)
    )]
    ForceBeyondEdge {
        /// Position of the end of the line, \[m].
        position: f64,
        /// Height of the end of the line above its lowest point, \[m].
        available: f64,
        /// An upper bound of the force that is carried up to there, \[N].
        carried_force: f64,
        /// Normal force asked for, \[N].
        normal_force: f64,
    },
    /// The contact would reach the edge of the body, or the front end of the line, before the depth.
    #[error(
        "the contact would reach the edge at position {} (of a sphere: its equator), where the line is {} m \
         above its lowest point, at a depth less than {} m",
        Rounded(*position), Rounded(*available), MessageNumber(*indentation_depth)
    )]
    DepthBeyondEdge {
        /// Position of the end of the line, \[m].
        position: f64,
        /// Height of the end of the line above its lowest point, \[m].
        available: f64,
        /// Depth asked for, \[m].
        indentation_depth: f64,
    },
    /// An endless line does not rise above its contact.
    #[error("the line does not rise without limit on one side of position {}", Rounded(*position))]
    NotRising {
        /// Position from which the line was followed, \[m].
        position: f64,
    },
    /// The line touches more often, or has more detail, than can be followed.
    #[error("more than {allowed} {parts} are needed, those at position {} among them", Rounded(*position))]
    TooMuchDetail {
        /// Name of the parts that are too many: contact intervals, or polynomials of the line.
        parts: &'static str,
        /// Largest number of these parts.
        allowed: usize,
        /// Position on the line at which the largest number is exceeded, \[m].
        position: f64,
    },
    /// The friction of a parallel dashpot diverges at a cusp or kink (16), or converges too slowly to be summed.
    #[error(
        "the friction integral does not converge at position {}, where the line is too steep for a dashpot",
        Rounded(*position)
    )]
    FrictionDiverges {
        /// Position at which the line is too steep, \[m].
        position: f64,
    },
    /// The friction coefficient of a stationary state, or the force or depth of a static one, has a larger error than asked
    /// for.
    #[error(
        "the {quantity} was not reached to the relative error {relative_error:e}: it is {}",
        Estimate::new(*value, *error)
    )]
    NotConverged {
        /// Name of the quantity, and its unit.
        quantity: &'static str,
        /// Value reached, in the unit of the quantity.
        value: f64,
        /// Estimated absolute error of the value.
        error: f64,
        /// Relative error asked for.
        relative_error: f64,
        /// Whole result with its errors; in a static state that on springs.
        reached: Box<SteadySliding>,
    },
    /// The work along a history has a larger error than asked for with the shortest parts allowed.
    #[error("the work along the history {0}")]
    WorkNotReached(NotReached),
    /// The depth along a history has a larger error than asked for with the shortest parts allowed.
    #[error(
        "the largest indentation depth of the history was not reached to the relative error {:e} with {} parts between two of its \
         points: it is {}",
        missed.relative_error,
        missed.elements,
        Estimate::new(missed.value, missed.error)
    )]
    HistoryNotReached {
        /// Quantity that misses its error, with value and error.
        missed: NotReached,
        /// The result, with its errors.
        reached: Vec<CurvePoint>,
    },
    /// The friction coefficient of sliding has a larger error than asked for on the finest resolution allowed.
    #[error("the friction coefficient {missed}")]
    SlidingNotReached {
        /// Quantity that misses its error, with value and error.
        missed: NotReached,
        /// The result, with its errors.
        reached: Box<Sliding>,
    },
    /// A quantity of a motion has a larger error than asked for on the finest resolution allowed.
    #[error("the {} {missed}", MotionView::quantity_name(missed.quantity))]
    MotionNotReached {
        /// Quantity that misses its error, with value and error.
        missed: NotReached,
        /// The result, with its errors.
        reached: Box<Moved>,
    },
    /// A material that flows has no limit cycle in a reciprocating motion, and no periodic state on a track.
    #[error(
        "a material that flows gives way further in every cycle or pass, and none is like the one before: give it an \
         equilibrium modulus, or a motion through points"
    )]
    NoCycle,
    /// The limit cycle, or the periodic state on a track, is not reached.
    #[error(
        "after {cycles} cycles of the motion, or passes of the track, the relative change that may be left is {change:.1e}, and the tolerance \
         {tolerance:.1e}: the material remembers too many cycles"
    )]
    NotPeriodic {
        /// Number of cycles, or of passes of the track, that were followed.
        cycles: usize,
        /// Upper bound of the relative change that remains.
        change: f64,
        /// Largest relative change that counts as periodic.
        tolerance: f64,
    },
    /// The body is longer than the track.
    #[error(
        "the track must be longer than the body is where it is below the surface, {} m, but is {} m",
        Rounded(*needed), MessageNumber(*track)
    )]
    TrackTooShort {
        /// Length of the track, \[m].
        track: f64,
        /// Length of the line below the surface, \[m].
        needed: f64,
    },
    /// A material that flows has no contact at rest.
    #[error(
        "under a constant load a material that flows never comes to rest: press it for a duration"
    )]
    NoEquilibrium,
    /// The contact has reached the last element of the line.
    #[error(
        "the contact reached the edge at position {} (of a sphere: its equator) at depth {} m and time {} s: lower the force, or check \
         the unit of the modulus or viscosity",
        Rounded(*position), Rounded(*indentation_depth), Rounded(*time)
    )]
    ContactReachesEdge {
        /// Position of the last element on the line, \[m].
        position: f64,
        /// Indentation depth at that instant, \[m].
        indentation_depth: f64,
        /// Time since first contact, \[s].
        time: f64,
    },
    /// The contact is not a disc after pressing again, so that the one-dimensional model is not exact.
    #[error(
        "at time {} s the surface has recovered in such a way that a part of the contact opens inside it, or closes \
         outside: press again later, or less",
        Rounded(*time)
    )]
    NotADisc {
        /// Time at which it ceases to be a disc, \[s].
        time: f64,
    },
    /// Separated elements come into contact again, and the profile is that of a surface whose elements are not independent.
    #[error(
        "at time {} s the contact grows again after it has shrunk, and only on a half space its force is that of springs \
         side by side: follow it with boundary elements",
        Rounded(*time)
    )]
    TouchedAgain {
        /// Time at which the contact grows again, \[s].
        time: f64,
    },
    /// Too few elements are in contact at the end for a meaningful result.
    #[error(
        "at least {needed} elements must be in contact at spacing {} m, but only {n_contact} are",
        Rounded(*spacing)
    )]
    TooCoarse {
        /// Number of elements in contact.
        n_contact: usize,
        /// Smallest number of elements in contact that is allowed.
        needed: usize,
        /// Spacing of the elements, \[m].
        spacing: f64,
    },
    /// The sliding distance allowed was used up before the drift fell below its tolerance.
    #[error(
        "after sliding over {} m the relative drift of the friction coefficient is {drift:.1e}, and the tolerance {drift_tolerance:.1e}",
        Rounded(*sliding_distance)
    )]
    NotStationary {
        /// Relative change over the last contact length; 1 while the body has not slid over one.
        drift: f64,
        /// Largest drift that counts as stationary.
        drift_tolerance: f64,
        /// Distance slid, \[m].
        sliding_distance: f64,
        /// Steps up to that distance.
        steps: Vec<SlidingStep>,
    },
    /// A quantity left the range of floating-point numbers.
    #[error("{quantity} became {} at time {} s", MessageNumber(*value), Rounded(*time))]
    NonFinite {
        /// Name of the quantity.
        quantity: &'static str,
        /// Value that is not finite, in the unit of the quantity.
        value: f64,
        /// Time since first contact, \[s].
        time: f64,
    },
    /// The load or the body is not one that the method can treat.
    #[error(transparent)]
    Indenter(#[from] IndenterError),
    /// The material refuses a step in time.
    #[error(transparent)]
    Material(#[from] RheologyError),
}

/// Smallest number of elements that the last contact must have. Derived: one at either end, which is loaded as a whole or not at
/// all, and one between them.
const MIN_CONTACT_ELEMENTS: usize = 3;

/// Refuses a contact of fewer than [`MIN_CONTACT_ELEMENTS`] elements of a `spacing` \[m] as [`MdrError::TooCoarse`].
pub(crate) fn enough_elements(n_contact: usize, spacing: f64) -> Result<(), MdrError> {
    if n_contact >= MIN_CONTACT_ELEMENTS {
        return Ok(());
    }
    Err(MdrError::TooCoarse {
        n_contact,
        needed: MIN_CONTACT_ELEMENTS,
        spacing,
    })
}

/// Returns a computed `value`, or [`MdrError::NonFinite`] with its `quantity` and `time` \[s] if it is infinite or not a number.
pub(crate) fn finite(quantity: &'static str, value: f64, time: f64) -> Result<f64, MdrError> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(non_finite(quantity, value, time))
}

/// The error [`MdrError::NonFinite`] for a value at a `time` \[s] that is not a number, or out of the range of a quantity.
pub(crate) const fn non_finite(quantity: &'static str, value: f64, time: f64) -> MdrError {
    MdrError::NonFinite {
        quantity,
        value,
        time,
    }
}
