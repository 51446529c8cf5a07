//! Wrong input, and what was reached when a solution was not.

use indenters::IndenterError;
use numerics::{Estimate, InWords, InvalidParameter, Rounded};
use rheology::RheologyError;
use thiserror::Error;

use crate::{Footprint, Reached};

/// Why there is no solution.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum BemError {
    /// A parameter is not a number, or outside the range it may take.
    #[error(transparent)]
    InvalidParameter(#[from] InvalidParameter),
    /// A field does not have one value per element.
    #[error("{field} has {length} values, but the grid has {elements} elements")]
    LengthMismatch {
        /// Name of the field.
        field: &'static str,
        /// Its length.
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
    #[error("the grid would have {elements:.1e} elements, but at most {limit:e} are allowed")]
    GridTooLarge {
        /// Number of elements asked for.
        elements: f64,
        /// The largest number allowed.
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
    /// So few elements were asked for that a patch of the contact covers too few of them on one of the grids that make the error bar.
    #[error(
        "with {elements} elements along the contact a patch of it is {across} elements wide on one of the grids that make \
         the error bar, but at least {least} are needed: ask for {needed} elements or more"
    )]
    ElementsTooFew {
        /// Number of elements asked for.
        elements: usize,
        /// Elements of the patch along x or across it.
        across: usize,
        /// The smallest number allowed.
        least: usize,
        /// Number of elements along the contact, at least, with which it is wide enough.
        needed: usize,
    },
    /// The period has too few elements for its shortest waves.
    #[error(
        "the period has {elements} elements along the edge that has more of them, but at least {needed} are needed, so that the \
         coarsest of the grids that make its error bar tells the shortest waves"
    )]
    PeriodTooCoarse {
        /// Number of elements asked for.
        elements: usize,
        /// The smallest number allowed.
        needed: usize,
    },
    /// The contact reaches the boundary of the footprint in which it was allowed.
    #[error(
        "after sliding {} m the contact reaches the boundary of the footprint x {}..{}, y {}..{} m",
        Rounded(*sliding_distance), Rounded(.footprint.x[0]), Rounded(.footprint.x[1]), Rounded(.footprint.y[0]),
        Rounded(.footprint.y[1])
    )]
    ContactReachesBoundary {
        /// Sliding distance at which it happened, \[m]; 0 without sliding.
        sliding_distance: f64,
        /// Footprint.
        footprint: Footprint,
    },
    /// A vertical wall of the indenter is in contact: its slope, and with it the friction, is infinite.
    #[error(
        "at x = {} m, y = {} m from its lowest point a vertical wall of the indenter is in contact",
        Rounded(*x), Rounded(*y)
    )]
    VerticalWall {
        /// Position of the wall ahead of the lowest point, \[m].
        x: f64,
        /// Position of the wall beside the lowest point, \[m].
        y: f64,
    },
    /// The body rises too much over one element in contact for its mean slope to mean anything.
    #[error(
        "the body rises by {} m over one element in contact, more than the depth scale {} m",
        Rounded(*rise), Rounded(*depth_scale)
    )]
    SlopeNotResolved {
        /// Rise over the element, \[m].
        rise: f64,
        /// Depth scale F_N J(L/v) / (4 L) of a contact of length L, F_N / (4 η v) on a dashpot, \[m].
        depth_scale: f64,
    },
    /// The contact conditions were not satisfied to the tolerance within the iterations allowed.
    #[error(
        "the contact was not solved: after {iterations} iterations the residual is {:.1e}, \
         the tolerance {tolerance:.1e}",
        InWords(*residual)
    )]
    ContactNotConverged {
        /// Iterations made.
        iterations: usize,
        /// Residual reached; see `ContactOptions`.
        residual: f64,
        /// Tolerance asked for.
        tolerance: f64,
    },
    /// The equations of a contact that was tried have no solution in finite numbers.
    #[error("the equations of a contact of {elements} elements are singular to rounding")]
    SingularContact {
        /// Number of elements in contact.
        elements: usize,
    },
    /// The elements do not bear the force below their largest pressure.
    #[error(
        "the grid bears less than {} N below the largest pressure, but the normal force is {} N",
        Rounded(*limit), InWords(*normal_force)
    )]
    ForceNotBorne {
        /// Force asked for, \[N].
        normal_force: f64,
        /// The largest pressure times the area of all elements with a body, \[N].
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
        /// Relative change of the friction coefficient over the second half of the distance, or the distance asked for.
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
        /// Steps made between two rows.
        steps: usize,
        /// Relative error reached.
        error: f64,
        /// Relative error asked for.
        relative_error: f64,
    },
    /// A quantity was not reached to the error asked for.
    #[error(
        "the {quantity} was not reached to the relative error {relative_error:e}: it is {}",
        Estimate::new(*value, *error)
    )]
    NotReached {
        /// Name of the quantity, and its unit.
        quantity: &'static str,
        /// Best value reached.
        value: f64,
        /// Its absolute error.
        error: f64,
        /// Relative error asked for.
        relative_error: f64,
        /// Everything else that was found.
        reached: Box<Reached>,
    },
    /// The load has no sliding distance where one is needed.
    #[error("a sliding distance is needed: {why}")]
    SlidingDistanceMissing {
        /// The reason.
        why: &'static str,
    },
    /// A periodic surface is followed from rest under a mean pressure only.
    #[error("from rest a periodic surface slides under a mean pressure, not at a depth")]
    DepthFromRest,
    /// A march would take too long.
    #[error("the march would have {steps:.1e} steps, but at most {limit:e} are allowed")]
    TooManySteps {
        /// Steps of one element.
        steps: f64,
        /// The largest number allowed.
        limit: f64,
    },
    /// The slowest retardation of the material outlasts any march to the stationary state.
    #[error(
        "a march to the stationary state is longer than {limit} contact lengths: the slowest retardation takes {memory:.1e} m \
         of sliding, and the contact is about {contact_length:.1e} m long"
    )]
    MemoryTooLong {
        /// Distance in which the slowest element forgets, \[m].
        memory: f64,
        /// Contact length, \[m].
        contact_length: f64,
        /// Contact lengths of the longest march.
        limit: f64,
    },
    /// A material that flows gives way to and fro, or pass after pass on a track, without end.
    #[error(
        "a material that flows gives way further in every cycle or pass, and none is like the one before: give it an \
         equilibrium modulus, or a motion through points"
    )]
    NoCycle,
    /// Of a track only what is ahead of the body or behind it by less than half its length acts on the contact.
    #[error(
        "the track must be twice as long as the part of it on which contact may occur, {} m, but is {} m",
        Rounded(*needed), InWords(*track)
    )]
    TrackTooShort {
        /// Length of the track, \[m].
        track: f64,
        /// Twice the length on which contact may occur, \[m].
        needed: f64,
    },
    /// Cycle after cycle still changes.
    #[error(
        "after {cycles} cycles of the motion the relative change that may be left is {change:.1e}, and the tolerance \
         {tolerance:.1e}: the material remembers too many cycles"
    )]
    NotPeriodic {
        /// Cycles that were followed.
        cycles: usize,
        /// Relative change that may be left.
        change: f64,
        /// The tolerance.
        tolerance: f64,
    },
    /// The change of the material by one cycle is lost in the rounding of numbers.
    #[error(
        "a cycle takes {period:e} s, and the material remembers {slowest:.1e} s: what one cycle changes is lost in rounding"
    )]
    CycleTooShort {
        /// Duration of a cycle, \[s].
        period: f64,
        /// The slowest retardation time, \[s].
        slowest: f64,
    },
    /// A material that flows has no state long after it was pressed.
    #[error("a material that flows never comes to rest under a load: press it for a duration")]
    NoEquilibrium,
    /// A material that flows creeps under a periodic surface without limit.
    #[error(
        "a material that flows never reaches a stationary state under a periodic surface: waves with crests along the motion \
         sink until the contact is full; give the material an equilibrium modulus"
    )]
    FlowsUnderWaves,
    /// The rigid body refuses.
    #[error(transparent)]
    Indenter(#[from] IndenterError),
    /// The material refuses.
    #[error(transparent)]
    Material(#[from] RheologyError),
}

/// Checks that a contact covers enough elements, along x or across it, whichever are fewer, for a meaningful friction.
pub(crate) const fn check_contact_elements(elements: usize) -> Result<(), BemError> {
    let needed = 3;
    if elements >= needed {
        return Ok(());
    }
    Err(BemError::GridTooCoarse { elements, needed })
}
