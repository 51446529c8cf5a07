//! The claims of the crate, one file each.

mod allocations;
mod any_material_slides;
mod any_scene_keeps_the_invariants;
mod apex_similarity;
mod arbitrary_motions;
mod axisymmetric_contact;
mod bad_input;
mod bars_of_contacts;
mod contact_identities;
mod convolution_is_the_sum;
mod discrete_contact;
mod indentation_follows_lee_radok_and_ting;
mod interrupted_marches;
mod invariance;
mod kernels;
mod marches_in_front_of_a_mirror;
mod mirrored_contact;
mod nested_grids;
mod omissions;
mod periodic_contact;
mod stationary_state;
mod steady_cylinder;
mod steady_estimate;
mod steady_full_contact;
mod steady_materials;
mod support;
#[cfg(feature = "rayon")]
mod thread_count;
mod transient_and_stationary_agree;
