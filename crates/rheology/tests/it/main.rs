//! What the materials promise, against exact numbers.

mod answers_match_the_casebook;
mod bad_input_is_refused;
mod conversion_round_trip;
#[cfg(feature = "fit")]
mod experiments;
#[cfg(feature = "fit")]
mod fit_recovers_materials;
mod fractional_elements_expand;
#[cfg(feature = "fit")]
mod isotherms_of_rubbers;
#[cfg(feature = "fit")]
mod moduli_are_known_as_well_as_said;
#[cfg(feature = "fit")]
mod own_laws_expand;
mod standard_solid_has_its_limits;
mod steps_are_exact;
mod support;
mod temperature_shifts_curves;
