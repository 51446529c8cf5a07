//! The rigid line: its heights over the elements of a foundation, and its polynomials.

mod element_heights;
mod height_table;
mod legendre;
mod profile;
mod range;
mod segment;
mod steep_kinks;

pub(crate) use element_heights::{ElementHeights, MAX_ELEMENTS};
pub(crate) use height_table::{HeightRow, HeightTable};
pub(crate) use legendre::{DEGREE, derivative, end_value, square_integral, start_value, value};
pub(crate) use profile::{Piece, Profile, Resolution};
pub(crate) use range::{Range, VerticalEdge, vertical_edge};
pub(crate) use segment::Segment;
pub(crate) use steep_kinks::{SteepKink, has_steep_kinks};
