//! bem
mod contact;
mod convolution;
mod error;
mod fast_length;
mod grid;
mod influence;

pub use contact::{Contact, ContactOptions, ContactProblem, ContactState, Control, solve_contact};
pub use convolution::{Convolution, ConvolutionWorkspace};
pub use error::BemError;
pub use grid::Grid;
pub use influence::influence;
