//! indenters

mod axisymmetric;
mod error;
mod line;
mod load;
mod power;
pub mod quadrature;
mod root;
mod stretch;
mod surface;

pub use axisymmetric::{Axisymmetric, Kink, abel_height, abel_slope};
pub use error::IndenterError;
pub use line::{EquivalentLine, RigidLine};
pub use load::SlidingLoad;
pub use power::PowerProfile;
pub use root::bracketed_root;
pub use stretch::stretch;
pub use surface::Surface;
