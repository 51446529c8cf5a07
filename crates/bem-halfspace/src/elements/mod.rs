//! Elements of the surface: grids, boxes of elements, mirror planes, contact area and boundary, pressure fields.

pub(crate) mod area;
pub(crate) mod bounds;
pub(crate) mod contact_boundary;
pub(crate) mod footprint;
pub(crate) mod gap_field;
pub(crate) mod grid;
pub(crate) mod mirror;
pub(crate) mod pressure_field;
pub(crate) mod resolution;
