//! What was found where the error asked for was not reached.

use indenters::Moved;

use crate::motions::indent::{IndentCurve, PressEstimate};
use crate::motions::slide::SlideEstimate;
use crate::stationary::steady::{LineEstimate, SteadyEstimate};
#[cfg(feature = "rough")]
use crate::{PeriodicEstimate, PeriodicSliding, PeriodicTransient};

/// The result that [`BemError::NotReached`](crate::BemError::NotReached) holds, with its bars, by the function that found it.
#[derive(Debug, Clone, PartialEq)]
pub enum Reached {
    /// Of [`steady`](crate::steady()).
    Steady(SteadyEstimate),
    /// Of [`steady_line`](crate::steady_line).
    Line(LineEstimate),
    /// Of [`slide`](crate::slide()).
    Slide(SlideEstimate),
    /// Of [`press`](crate::press) and [`indent`](crate::indent()).
    Press(PressEstimate),
    /// Of [`indent_along`](crate::indent_along).
    Curve(IndentCurve),
    /// Of [`move_along`](crate::move_along).
    Moved(Moved),
    #[cfg(feature = "rough")]
    /// Of [`periodic::steady`](crate::periodic::steady) and [`periodic::indent`](crate::periodic::indent).
    Periodic(PeriodicEstimate<PeriodicSliding>),
    #[cfg(feature = "rough")]
    /// Of [`periodic::slide`](crate::periodic::slide).
    PeriodicTransient(PeriodicEstimate<PeriodicTransient>),
}

macro_rules! found {
    ($($found:ty => $variant:ident,)*) => {
        $(impl From<$found> for Reached {
            fn from(found: $found) -> Self {
                Self::$variant(found)
            }
        })*
    };
}
found! {
    SteadyEstimate => Steady,
    LineEstimate => Line,
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
