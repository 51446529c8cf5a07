//! Elements between spring and dashpot, as Prony series.

mod expansion;
pub(crate) mod fractional_maxwell;
pub(crate) mod springpot;

pub use expansion::PronyExpansion;
#[cfg(feature = "fit")]
pub(crate) use expansion::validate;
