//! The error type of the crate: refused input, and computations that did not reach what was asked.

use indenters::IndenterError;
use numerics::{Estimate, InvalidParameter, MessageNumber, Rounded};
use rheology::RheologyError;
use thiserror::Error;

use crate::{Footprint, Reached};

/// Reason for which there is no solution.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum BemError {
    /// A parameter is not a number, or outside the range it may take.
    #[error(transparent)]
    InvalidParameter(#[from] InvalidParameter),
    /// A field does not have one value per element.
    #[error("{field} has {length} values, but the grid has {elements} elements")]
    LengthMismatch {
        /// Name of the field whose length is wrong.
        field: &'static str,
        /// Number of values of the field.
        length: usize,
        /// Number of elements of the grid.
        elements: usize,
    },
    /// A height of the indenter is NaN or −∞ (`+∞` means that there is no body).
    #[error(
        "height {value} at element ({row}, {column}): it must be a number, or +inf where there is no body"
    )]
    InvalidHeight {
        /// Index along x.
        row: usize,
        /// Index along y.
        column: usize,
        /// The refused height, \[m].
        value: f64,
    },
    /// The grid would have more elements than can be handled.
    #[error("the grid would have {elements:.3e} elements, but at most {limit:e} are allowed")]
    GridTooLarge {
        /// Number of elements that the grid would have.
        elements: f64,
        /// Largest number of elements that a grid may have.
        limit: f64,
    },
    /// The contact, or a patch of it that carries load, covers too few elements for its friction to mean anything.
    #[error(
        "a patch of the contact is {elements} elements wide along x or across it, but at least {needed} are needed"
    )]
    GridTooCoarse {
        /// Number of elements of the patch along x or across it.
        elements: usize,
        /// The smallest number allowed.
        needed: usize,
    },
    /// On one of the grids behind the error bar a patch of the contact covers too few elements.
    #[error(
        "with {elements} elements along the contact a patch of it is {across} elements wide on one of the grids that make \
         the error bar, but at least {least} are needed: ask for {needed} elements or more"
    )]
    ElementsTooFew {
        /// Number of elements asked for.
        elements: usize,
        /// Elements of the patch along x or across it.
        across: usize,
        /// The smallest number allowed across the patch.
        least: usize,
        /// Smallest number of elements along the contact with which the patch is wide enough.
        needed: usize,
    },
    /// The period has too few elements for its shortest waves.
    #[error(
        "the period has {elements} elements along the edge that has more of them, but at least {needed} are needed, so that the \
         coarsest of the grids that make its error bar resolves the shortest waves"
    )]
    PeriodTooCoarse {
        /// Number of elements asked for.
        elements: usize,
        /// The smallest number allowed.
        needed: usize,
    },
    /// The contact reaches the boundary of the footprint, outside which contact is not computed.
    #[error(
        "after sliding {} m the contact reaches the boundary of the footprint x {}..{}, y {}..{} m",
        Rounded(*sliding_distance), Rounded(.footprint.x[0]), Rounded(.footprint.x[1]), Rounded(.footprint.y[0]),
        Rounded(.footprint.y[1])
    )]
    ContactReachesBoundary {
        /// Sliding distance at which it happened, \[m]; 0 without sliding.
        sliding_distance: f64,
        /// Footprint that was given or planned.
        footprint: Footprint,
    },
    /// A vertical wall of the indenter is in contact, where slope and friction are infinite.
    #[error(
        "at x = {} m, y = {} m from its lowest point a vertical wall of the indenter is in contact",
        Rounded(*x), Rounded(*y)
    )]
    VerticalWall {
        /// Position x of the wall relative to the lowest point, \[m].
        x: f64,
        /// Position y of the wall relative to the lowest point, \[m].
        y: f64,
    },
    /// Elements do not resolve the slope: the body rises over one of them in contact by more than the depth scale.
    #[error(
        "the body rises by {} m over one element in contact, more than the depth scale {} m",
        Rounded(*rise), Rounded(*depth_scale)
    )]
    SlopeNotResolved {
        /// Rise of the body over the element, \[m].
        rise: f64,
        /// Depth scale 2 (1 − ν) F_N J(L/v) / (4 L) of a contact of length L, \[m]; F_N / (4 η v) on an incompressible dashpot.
        depth_scale: f64,
    },
    /// The contact conditions were not satisfied to the tolerance within the iterations allowed.
    #[error(
        "the contact was not solved: after {iterations} iterations the residual is {:.1e}, \
         the tolerance {tolerance:.1e}{}",
        MessageNumber(*residual),
        if residual <= tolerance { ", and the elements in contact still change" } else { "" }
    )]
    ContactNotConverged {
        /// Number of iterations.
        iterations: usize,
        /// Relative residual reached; defined at [`ContactOptions`](crate::ContactOptions).
        residual: f64,
        /// Tolerance asked for.
        tolerance: f64,
    },
    /// The linear equations on an active set are singular to rounding.
    #[error("the equations of a contact of {elements} elements are singular to rounding")]
    SingularContact {
        /// Number of elements of the active set.
        elements: usize,
    },
    /// The normal force exceeds the largest pressure times the area of the grid.
    #[error(
        "the grid bears less than {} N below the largest pressure, but the normal force is {} N",
        Rounded(*limit), MessageNumber(*normal_force)
    )]
    ForceNotBorne {
        /// Force asked for, \[N].
        normal_force: f64,
        /// Largest pressure times the area of all elements over which there is a body, \[N].
        limit: f64,
    },
    /// The friction coefficient still changes at the end of the sliding distance.
    #[error(
        "no stationary state after sliding {} m: the friction coefficient still changes by {drift:.1e} of its value {}, and the \
         tolerance is {tolerance:.1e}",
        Rounded(*sliding_distance), Rounded(*friction_coefficient)
    )]
    NotStationary {
        /// Sliding distance reached, \[m].
        sliding_distance: f64,
        /// Relative change of the friction coefficient over the second half of the distance, or over the distance asked for.
        drift: f64,
        /// Friction coefficient at the end.
        friction_coefficient: f64,
        /// Tolerance asked for.
        tolerance: f64,
    },
    /// The steps in time are too long for the error asked for.
    #[error(
        "with {steps} steps between two rows the error of force and depth by the steps in time is {error:.1e}, \
         not {relative_error:e}"
    )]
    TimeNotResolved {
        /// Steps between two rows.
        steps: usize,
        /// Relative error reached.
        error: f64,
        /// Relative error asked for.
        relative_error: f64,
    },
    /// A quantity misses the error asked for on the finest grid allowed.
    #[error(
        "the {quantity} was not reached to the relative error {relative_error:e}: it is {}",
        Estimate::new(*value, *error)
    )]
    NotReached {
        /// Name of the quantity, and its unit.
        quantity: &'static str,
        /// Value on the finest grid.
        value: f64,
        /// Absolute error of the value.
        error: f64,
        /// Relative error asked for.
        relative_error: f64,
        /// The whole result on the finest grid.
        reached: Box<Reached>,
    },
    /// Heat spreads too slowly for its wake to be resolved at this velocity.
    #[error(
        "at the velocity {} m/s the diffusivity k/(ρc) must be at least {} m²/s, but is {} m²/s",
        MessageNumber(*velocity), Rounded(*least), Rounded(*diffusivity)
    )]
    DiffusivityTooSmall {
        /// Velocity of the source, \[m/s].
        velocity: f64,
        /// Diffusivity that was given, \[m²/s].
        diffusivity: f64,
        /// The smallest diffusivity allowed, \[m²/s].
        least: f64,
    },
    /// The load has no sliding distance where one is needed.
    #[error("a sliding distance is needed: {why}")]
    SlidingDistanceMissing {
        /// Reason why the distance is needed.
        why: &'static str,
    },
    /// A periodic surface slides from rest at a given depth, which is not supported: only a mean pressure is.
    #[error("from rest a periodic surface slides under a mean pressure, not at a depth")]
    DepthFromRest,
    /// A march would have too many steps.
    #[error("the march would have {steps:.1e} steps, but at most {limit:e} are allowed")]
    TooManySteps {
        /// Number of steps.
        steps: f64,
        /// Largest number of steps allowed.
        limit: f64,
    },
    /// The memory length of the material exceeds the longest march to the stationary state.
    #[error(
        "a march to the stationary state is longer than {limit} contact lengths: the slowest retardation takes {memory:.1e} m \
         of sliding, and the contact is about {contact_length:.1e} m long"
    )]
    MemoryTooLong {
        /// Memory length: velocity times the largest retardation time, \[m].
        memory: f64,
        /// Contact length, \[m].
        contact_length: f64,
        /// Longest march, in contact lengths.
        limit: f64,
    },
    /// A material that flows has no limit cycle under a reciprocating motion or on a track.
    #[error(
        "a material that flows gives way further in every cycle or pass, and none is like the one before: give it an \
         equilibrium modulus, or a motion through points"
    )]
    NoCycle,
    /// The track is shorter than twice the length on which contact may occur: a load acts on the contact only from less than half
    /// the track's length ahead or behind.
    #[error(
        "the track must be twice as long as the part of it on which contact may occur, {} m, but is {} m",
        Rounded(*needed), MessageNumber(*track)
    )]
    TrackTooShort {
        /// Length of the track, \[m].
        track: f64,
        /// Twice the length on which contact may occur, \[m].
        needed: f64,
    },
    /// The limit cycle was not found: cycles still change.
    #[error(
        "after {cycles} cycles of the motion the relative change that may be left is {change:.1e}, and the tolerance \
         {tolerance:.1e}: the material remembers too many cycles"
    )]
    NotPeriodic {
        /// Number of cycles.
        cycles: usize,
        /// Estimated remaining relative change.
        change: f64,
        /// Tolerance on the remaining relative change.
        tolerance: f64,
    },
    /// The period is so short, compared with the largest retardation time, that rounding hides the change per cycle.
    #[error(
        "a cycle takes {period:e} s, and the material remembers {slowest:.1e} s: what one cycle changes is lost in rounding"
    )]
    CycleTooShort {
        /// Duration of a cycle, \[s].
        period: f64,
        /// Largest retardation time, \[s].
        slowest: f64,
    },
    /// A material that flows has no static contact: it creeps under a load without limit.
    #[error("a material that flows never comes to rest under a load: press it for a duration")]
    NoEquilibrium,
    /// A material that flows has no stationary state under a periodic surface: waves with crests along the motion sink without limit.
    #[error(
        "a material that flows never reaches a stationary state under a periodic surface: waves with crests along the motion \
         sink until the contact is full; give the material an equilibrium modulus"
    )]
    FlowsUnderWaves,
    /// Moduli with factors outside of stationary sliding, and for derivatives.
    #[error(
        "factors of the moduli at a strain amplitude have a meaning in stationary sliding only, whose derivatives with them are not computed"
    )]
    FactorsWithoutStationaryState,
    /// A shift by the wavelength without stationary waves on a period.
    #[error(
        "a shift of times and moduli by the wavelength has a meaning in stationary sliding of periodic surfaces only, whose derivatives with it \
         are not computed"
    )]
    WaveShiftWithoutPeriod,
    /// Moduli with different factors on a closed track.
    #[error("on a track the moduli may not have different factors at the strain amplitude")]
    FactorsOnTrack,
    /// Error of the rigid body or the load.
    #[error(transparent)]
    Indenter(#[from] IndenterError),
    /// Error of the material.
    #[error(transparent)]
    Material(#[from] RheologyError),
}

/// Smallest number of elements along or across a contact. Derived: one at either end, which is in contact as a whole or not at all, and
/// one between them.
const MIN_CONTACT_ELEMENTS: usize = 3;

/// Refuses a contact of fewer than [`MIN_CONTACT_ELEMENTS`] elements; `elements` is the smaller of the numbers along x and y.
pub(crate) const fn check_contact_elements(elements: usize) -> Result<(), BemError> {
    let needed = MIN_CONTACT_ELEMENTS;
    if elements >= needed {
        return Ok(());
    }
    Err(BemError::GridTooCoarse { elements, needed })
}

/// Checks that a field has one value per element.
pub(crate) fn check_length(
    field: &'static str,
    length: usize,
    elements: usize,
) -> Result<(), BemError> {
    if length == elements {
        return Ok(());
    }
    Err(BemError::LengthMismatch {
        field,
        length,
        elements,
    })
}
