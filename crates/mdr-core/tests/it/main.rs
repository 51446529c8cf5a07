//! Claims of the one-dimensional model, one file per claim.

mod any_scene_keeps_the_invariants;
mod bad_input_is_refused;
mod cusps_and_kinks;
mod edges_and_bars;
mod flat_ends_in_motion;
mod force_derivatives_are_exact;
mod friction_converges_to_the_theorem;
mod histories_are_refused;
mod histories_keep_their_answer;
mod histories_match_quadrature;
mod leading_edges_carry_the_load;
mod march_ends_in_the_stationary_state;
mod motions;
mod pressing;
mod stationary_means_converged;
mod stationary_sliding_matches_references;
mod support;
mod tracks;
mod transient_follows_the_exact_solution;
mod units_do_not_matter;
mod waves_of_the_load;
