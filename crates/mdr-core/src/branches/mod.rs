//! One element of a linear viscoelastic foundation: its Maxwell branches while it is loaded, and its modes of recovery while
//! it is free.

mod contact_event;
mod foundation;
mod free_surface;
mod linear_step;
mod polynomial_step;
mod segment_solution;

pub(crate) use contact_event::ContactEvent;
pub(crate) use foundation::{Foundation, Mode};
pub(crate) use free_surface::FreeSurface;
pub(crate) use linear_step::{StepWork, TimeStep, n_history};
pub(crate) use segment_solution::SegmentSolution;
