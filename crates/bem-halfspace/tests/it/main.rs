//! The claims of the crate, one file each.

mod allocations;
mod any_material_slides;
mod any_scene_keeps_the_invariants;
mod apex_similarity;
mod arbitrary_motions;
mod bad_input;
mod contacts;
mod cylinders;
mod dissipated_energy;
mod ends_of_the_speed_range;
mod error_bars;
mod gaps;
mod hardness;
mod heat;
mod heat_of_contacts;
mod height_maps;
mod indentation_follows_lee_radok_and_ting;
mod invariance;
mod kernels;
mod layers;
mod memory;
mod mirrors;
mod motions;
mod nested_grids;
mod periodic_contact;
#[cfg(feature = "rough")]
mod periodic_gaps;
mod periodic_march;
#[cfg(feature = "rough")]
mod periodic_motions;
#[cfg(feature = "rough")]
mod periodic_sensitivity;
mod periodic_sliding;
mod pressure_spectrum;
#[cfg(feature = "rough")]
mod small_friction;
mod soft_waves;
mod stationary_state;
mod strain_amplitude;
mod substrates;
mod support;
#[cfg(feature = "rayon")]
mod thread_count;
mod tracks;
mod wave_shift;
