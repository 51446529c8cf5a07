//! The theorems of the paper and the closed forms around them, against exact numbers.

mod bad_input_is_refused;
mod cylinders_slide_in_closed_form;
mod divergence_is_reported;
mod elastic_limits_match;
mod impulse_decides_indentation;
mod layers_of_any_thickness;
mod leading_edge_carries_the_load;
mod other_materials_have_closed_forms;
mod persson_theory;
mod power_profiles_slide_in_closed_form;
mod pressing_has_closed_forms;
mod quadrature_agrees_with_closed_forms;
mod support;
mod transient_reaches_the_stationary_state;
