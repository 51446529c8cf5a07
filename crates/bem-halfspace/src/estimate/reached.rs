//! Results of refinements that missed the error asked for.

use indenters::Moved;

use crate::motions::indent::{IndentCurve, PressEstimate};
use crate::motions::slide::SlideEstimate;
use crate::stationary::steady::SteadyEstimate;
#[cfg(feature = "rough")]
use crate::{PeriodicEstimate, PeriodicSliding, PeriodicTransient};

/// The result in [`BemError::NotReached`](crate::BemError::NotReached), with its error bars, by the function that found it.
#[derive(Debug, Clone, PartialEq)]
pub enum Reached {
    /// Result of [`steady`](crate::steady()).
    Steady(SteadyEstimate),
    /// Result of [`slide`](crate::slide()).
    Slide(SlideEstimate),
    /// Result of [`press`](crate::press) and [`indent`](crate::indent()).
    Press(PressEstimate),
    /// Result of [`indent_along`](crate::indent_along).
    Curve(IndentCurve),
    /// Result of [`move_along`](crate::move_along).
    Moved(Moved),
    #[cfg(feature = "rough")]
    /// Result of [`periodic::steady`](crate::periodic::steady).
    Periodic(PeriodicEstimate<PeriodicSliding>),
    #[cfg(feature = "rough")]
    /// Result of [`periodic::slide`](crate::periodic::slide).
    PeriodicTransient(PeriodicEstimate<PeriodicTransient>),
}

/// Conversions of results into the variants of [`Reached`].
macro_rules! found {
    ($($found:ty => $variant:ident,)*) => {
        $(impl From<$found> for Reached {
            /// Wraps the result of a function in its variant.
            fn from(found: $found) -> Self {
                Self::$variant(found)
            }
        })*
    };
}
found! {
    SteadyEstimate => Steady,
    SlideEstimate => Slide,
    PressEstimate => Press,
    IndentCurve => Curve,
    Moved => Moved,
}
#[cfg(feature = "rough")]
found! {
    PeriodicEstimate<PeriodicSliding> => Periodic,
    PeriodicEstimate<PeriodicTransient> => PeriodicTransient,
}
