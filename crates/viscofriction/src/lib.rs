//! Friction.

pub mod npy;
pub mod scene;
pub mod solve;
pub mod sweep;
mod text;

pub use bem_halfspace::slide::PressureField;
pub use text::{WrongInput, line_of, line_of_record};
