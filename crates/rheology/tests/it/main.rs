//! What the materials promise, against exact numbers.

mod bad_input_is_refused;
mod conversion_is_exact;
mod conversion_round_trip;
mod creep_survives_a_vanishing_spring;
#[cfg(feature = "fit")]
mod fit_recovers_materials;
mod fractional_elements_expand;
mod limits_are_the_simpler_materials;
mod materials_match_the_textbook;
mod moduli_match_equation_2;
mod steps_are_exact;
mod support;
mod temperature_shifts_curves;
mod viscous_window_closes;
