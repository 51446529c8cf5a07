//! The elements: where they are, boxes of them, their mirrors, their area and the pressure on them.

pub(crate) mod area;
pub(crate) mod bounds;
pub(crate) mod contact_boundary;
pub(crate) mod footprint;
pub(crate) mod grid;
pub(crate) mod mirror;
pub(crate) mod pressure_field;
pub(crate) mod resolution;
