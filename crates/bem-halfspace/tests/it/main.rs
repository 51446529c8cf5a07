//! The claims of the crate, one file each.

mod elastic_contact;
mod influence_coefficients;
mod square_punch;
mod support;
