//! What the crate promises, claim by claim.

mod casebook_bodies;
mod contact_radius_solves_the_line;
mod fixed_seed;
mod height_maps_are_bilinear;
mod invalid_inputs_are_refused;
mod inverse_transform_recovers_the_body;
mod leading_edge_has_several_intervals;
mod lines_match_their_bodies;
mod stretch_matches_the_paper;
mod surfaces_know_their_extent;
mod tables_are_transformed_exactly;
