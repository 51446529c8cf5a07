//! What the materials promise, against exact numbers.

mod bad_input_is_refused;
mod creep_survives_a_vanishing_spring;
mod limits_are_the_simpler_materials;
mod moduli_match_equation_2;
mod support;
mod viscous_window_closes;
