//! What the chain claims, one file per claim.

mod any_scene_keeps_the_invariants;
mod bad_input_is_refused;
mod contact_balances_the_force;
mod cusps_and_kinks;
mod depth_is_exact_at_every_spacing;
mod edges_and_bars;
mod every_body_of_revolution_slides;
mod friction_converges_to_the_theorem;
mod full_contact_obeys_the_complex_modulus;
mod indentation_follows_lee_radok_and_ting;
mod indentation_obeys_the_impulse_rule;
mod march_ends_in_the_stationary_state;
mod numbers_end_late;
mod several_contact_intervals;
mod stationary_means_converged;
mod stationary_sliding_has_its_limits;
mod stationary_sliding_matches_the_casebook;
mod support;
mod transient_follows_the_exact_solution;
mod units_do_not_matter;
