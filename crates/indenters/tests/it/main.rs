//! What the crate promises, claim by claim.

mod contact_radius_solves_the_line;
mod height_files;
mod height_maps_are_bilinear;
mod invalid_inputs_are_refused;
mod leading_edge_has_several_intervals;
mod lines_match_their_bodies;
#[cfg(feature = "rough")]
mod rough_surfaces;
#[cfg(feature = "rough")]
mod roughness;
mod stretch_matches_the_paper;
mod support;
mod surfaces_know_their_extent;
mod topographies;
