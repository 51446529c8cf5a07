//! Errors of materials and of their identification.

use numerics::{InvalidParameter, MessageNumber};
use thiserror::Error;

/// The reason for which a material, or an argument of one of its functions, is refused.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RheologyError {
    /// A parameter is not a number, or outside the range it may take.
    #[error(transparent)]
    InvalidParameter(#[from] InvalidParameter),
    /// A parameter of one member of a list is not a number, or outside the range it may take.
    #[error(
        "{} of {list}[{index}] must be {}, but is {}",
        refused.parameter, refused.allowed, MessageNumber(refused.value)
    )]
    InvalidElement {
        /// Name of the list.
        list: &'static str,
        /// Position in the list, from 0.
        index: usize,
        /// The refused parameter.
        refused: InvalidParameter,
    },
    /// A relaxation spectrum without stiffness and viscosity.
    #[error(
        "a material needs an equilibrium modulus, a viscosity or a branch with a modulus greater than 0"
    )]
    NoStiffness,
    /// A creep spectrum without compliance and fluidity.
    #[error(
        "a material needs an instantaneous compliance, a fluidity or an element with a compliance greater than 0"
    )]
    NoCompliance,
    /// A temperature at which the WLF law has no meaning.
    #[error("the temperature must be above {}, the pole of the WLF law, but is {}", MessageNumber(*pole), MessageNumber(*temperature))]
    BelowWlfPole {
        /// The refused temperature, in the unit of the law.
        temperature: f64,
        /// Temperature T_r − C₂ at which the shift factor becomes infinite, in the same unit.
        pole: f64,
    },
    /// A temperature outside the measured range of a shift law.
    #[error(
        "the temperature must be from {} °C to {} °C, the range of the shift law, but is {} °C",
        MessageNumber(*lowest), MessageNumber(*highest), MessageNumber(*temperature)
    )]
    OutsideShiftLaw {
        /// The refused temperature, \[°C].
        temperature: f64,
        /// Lowest temperature of the range, \[°C].
        lowest: f64,
        /// Highest temperature of the range, \[°C].
        highest: f64,
    },
    /// A velocity or temperature outside a table of shear strengths.
    #[error(
        "the {name} must be from {} to {}, the range of the table of shear strengths, but is {}",
        MessageNumber(*lowest), MessageNumber(*highest), MessageNumber(*value)
    )]
    OutsideShearTable {
        /// Name of the quantity, with its unit.
        name: &'static str,
        /// The refused value; not a number if it is missing.
        value: f64,
        /// Lowest value of the table.
        lowest: f64,
        /// Highest value of the table.
        highest: f64,
    },
    /// Shifts that neither the law of Williams, Landel and Ferry nor that of Arrhenius describes.
    #[error(
        "no shift law leads from the nearest isotherm, at {}, to the reference temperature {}: a law needs isotherms \
         of several temperatures, the warmer the faster; ask for the temperature of an isotherm",
        MessageNumber(*nearest), MessageNumber(*temperature)
    )]
    NoShiftLaw {
        /// Reference temperature asked for, in the unit of the table of isotherms.
        temperature: f64,
        /// Temperature of the nearest isotherm, in the same unit.
        nearest: f64,
    },
    /// Too few measurements.
    #[error("at least {needed} points are needed, but there are {given}")]
    TooFewPoints {
        /// Number of points needed.
        needed: usize,
        /// Number of points given.
        given: usize,
    },
    /// Isotherms that overlap with no other, because they have one frequency.
    #[cfg(feature = "fit")]
    #[error(
        "{count} of {given} isotherms have one frequency only, the first of them at {temperature}, and no shift follows from that: give \
         the shift law of a ramp of temperature (--wlf or --arrhenius); where the temperature drifts by more than 1 K within an isotherm, \
         number the isotherms in a column Set"
    )]
    OneFrequency {
        /// Number of isotherms with one frequency.
        count: usize,
        /// Number of isotherms.
        given: usize,
        /// Temperature of the first isotherm with one frequency.
        temperature: f64,
    },
    /// Two isotherms that cannot be shifted onto each other.
    #[cfg(feature = "fit")]
    #[error(
        "the isotherms at {} and {} have no moduli in common: no shift brings them together",
        MessageNumber(*first), MessageNumber(*second)
    )]
    NoOverlap {
        /// Temperature of one isotherm.
        first: f64,
        /// Temperature of the other isotherm.
        second: f64,
    },
    /// Storage and loss moduli that are those of a relaxing material only when they are exchanged.
    #[cfg(feature = "fit")]
    #[error(
        "storage and loss modulus seem to be swapped: as they are, the best fit is off by {:.0} %, and {:.0} % the \
         other way round",
        100.0 * given,
        100.0 * swapped
    )]
    SwappedModuli {
        /// Root mean square relative error of the best series for the moduli as given.
        given: f64,
        /// Root mean square relative error of the best series for the exchanged moduli.
        swapped: f64,
    },
    /// Moduli whose trend contradicts every relaxing material.
    #[cfg(feature = "fit")]
    #[error("these are the moduli of no relaxing material: {what}")]
    WrongTrend {
        /// Description of the trend.
        what: &'static str,
    },
    /// Moduli that no Prony series approximates.
    #[cfg(feature = "fit")]
    #[error(
        "these are the moduli of no relaxing material: the best series is off by {:.0} % in the storage (or relaxation) modulus \
         and {:.0} % in the loss modulus",
        100.0 * storage,
        100.0 * loss
    )]
    NoMaterial {
        /// Root mean square relative error of G' or of G(t).
        storage: f64,
        /// Root mean square relative error of G''.
        loss: f64,
    },
    /// The active set of the nonnegative least squares did not converge.
    #[cfg(feature = "fit")]
    #[error("the moduli did not settle in {changes} changes of their signs")]
    FitNotConverged {
        /// Number of changes of the active set.
        changes: usize,
    },
    /// No Prony series approximates a continuous spectrum to the error asked for.
    #[error(
        "a Prony series with a relative error of {asked:e} was asked for, {reached:e} was reached"
    )]
    ExpansionNotReached {
        /// Relative error asked for.
        asked: f64,
        /// Smallest relative error reached.
        reached: f64,
    },
}

/// Converts the error of a member of a list into one with the name of the list and the index of the member.
pub(crate) fn with_list_index(
    list: &'static str,
    index: usize,
) -> impl Fn(InvalidParameter) -> RheologyError {
    move |refused| RheologyError::InvalidElement {
        list,
        index,
        refused,
    }
}
