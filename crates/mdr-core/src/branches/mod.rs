//! One element of a linear viscoelastic foundation: its Maxwell branches while it is loaded, and its modes of recovery while
//! it is free.

mod contact_event;
mod exponentials;
mod foundation;
mod free_surface;
mod linear_step;
mod polynomial_step;
mod segment_solution;

pub(crate) use contact_event::ContactEvent;
pub(crate) use exponentials::{RECIPROCALS, decay, decay_and_mean, decay_from_mean, moments};
pub(crate) use foundation::{Foundation, Mode};
pub(crate) use free_surface::FreeSurface;
pub(crate) use linear_step::{StepWork, TimeStep, n_history};
pub(crate) use segment_solution::SegmentSolution;
