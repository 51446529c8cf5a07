//! rheology

mod error;
mod viscous;

pub use error::RheologyError;
pub use viscous::Viscous;
