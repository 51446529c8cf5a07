//! Errors of indenters, loads and geometric problems.

use numerics::{InvalidParameter, Rounded};
use thiserror::Error;

/// The reason for which an indenter, a load or a geometric problem is refused.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum IndenterError {
    /// A parameter is not a number, or outside the range it may take.
    #[error(transparent)]
    InvalidParameter(#[from] InvalidParameter),
    /// Two lists that belong together have different lengths.
    #[error("{first} has {first_length} entries but {second} has {second_length}")]
    LengthMismatch {
        /// Name of the first list.
        first: &'static str,
        /// Length of the first list.
        first_length: usize,
        /// Name of the second list.
        second: &'static str,
        /// Length of the second list.
        second_length: usize,
    },
    /// A list has too few entries.
    #[error("{list} must have at least {needed} entries, but has {length}")]
    TooFew {
        /// Name of the list.
        list: &'static str,
        /// Smallest admissible length.
        needed: usize,
        /// Actual length.
        length: usize,
    },
    /// The positions of a table do not increase from entry to entry.
    #[error("{list} must increase strictly, but entry {index} is {value} after {previous}")]
    NotIncreasing {
        /// Name of the list.
        list: &'static str,
        /// Index of the offending entry, counted from 0.
        index: usize,
        /// The offending entry.
        value: f64,
        /// The entry before the offending one.
        previous: f64,
    },
    /// The path is too long for the contact, or has too many points.
    #[error(
        "the motion needs {steps:e} steps, each at most as long as an element of the contact, and as many between two points as \
         there are elements along the contact, and {allowed:.0} are allowed: shorten its path or stroke, leave out points on a \
         straight way, or take longer elements: press a body harder, or leave out the shortest waves of a periodic surface"
    )]
    TooManySteps {
        /// Number of steps needed.
        steps: f64,
        /// Largest number of steps of a motion, or of one cycle.
        allowed: f64,
    },
    /// The body does not reach as far as the position asked for.
    #[error(
        "position {} lies outside the body, which reaches from {} to {}",
        Rounded(*position), Rounded(*lower), Rounded(*upper)
    )]
    OutOfDomain {
        /// The position asked for, \[m].
        position: f64,
        /// Lower end of the body, \[m].
        lower: f64,
        /// Upper end of the body, \[m].
        upper: f64,
    },
    /// The equivalent line turns downwards before it reaches the depth, or the body touches outside the contact of that depth.
    ///
    /// The contact is then no longer a single circle, and the method of dimensionality reduction does not hold.
    #[error(
        "the contact is one circle only up to radius {} m, at a depth of {} m; a depth of {} m was asked for",
        Rounded(*limiting_radius), Rounded(*limiting_depth), Rounded(*depth)
    )]
    NonMonotoneLine {
        /// Radius at which the equivalent line stops rising, or of the largest contact outside of which the body does not touch, \[m].
        limiting_radius: f64,
        /// Height of the equivalent line at this radius, \[m].
        limiting_depth: f64,
        /// The depth asked for, \[m].
        depth: f64,
    },
    /// The body or its leading edge ends below the depth asked for.
    #[error(
        "the line rises only {} m above its lowest point, but a depth of {} m was asked for",
        Rounded(*available), Rounded(*depth)
    )]
    NotHighEnough {
        /// Height of the leading edge above its lowest point, \[m].
        available: f64,
        /// The depth asked for, \[m].
        depth: f64,
    },
    /// A method needs a force, but the load prescribes a depth.
    #[error(
        "this method needs a normal force, but the load prescribes the indentation depth {indentation_depth}"
    )]
    NeedsNormalForce {
        /// The depth of the load, \[m].
        indentation_depth: f64,
    },
    /// A method gives the stationary state, but the load ends after a sliding distance.
    #[error(
        "this method gives the stationary state only, but the load ends after the sliding distance {sliding_distance}"
    )]
    OnlyStationary {
        /// The sliding distance of the load, \[m].
        sliding_distance: f64,
    },
    /// A method covers fresh ground only, but the load is on a closed track.
    #[error(
        "only bodies on fresh ground are known here, but the load comes back to the same place after {track} m"
    )]
    NoTrack {
        /// Length of the track, \[m].
        track: f64,
    },
    /// A height of a surface is NaN or −∞ (`+∞` means that there is no body).
    #[error(
        "the height of the surface at x = {} m, y = {} m must be a number, or +inf where there is no body, but is {height}",
        Rounded(position[0]), Rounded(position[1])
    )]
    InvalidHeight {
        /// Position [x, y], \[m].
        position: [f64; 2],
        /// The refused height, \[m].
        height: f64,
    },
    /// The height of a surface at the origin is not 0, from which all heights and depths count.
    #[error(
        "the height of the surface at its lowest point, the origin, must be 0, but is {height} m: subtract it from all heights"
    )]
    LowestPointNotZero {
        /// Height at the origin, \[m].
        height: f64,
    },
    /// An integral did not reach the accuracy asked for.
    #[error(
        "the integral {} is known to {reached:.1e} of itself, and {relative_tolerance:.1e} was asked for",
        Rounded(*value)
    )]
    NotConverged {
        /// The value reached.
        value: f64,
        /// Estimated relative error of the value.
        reached: f64,
        /// The relative error asked for.
        relative_tolerance: f64,
    },
}
