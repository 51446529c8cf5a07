//! What a user types, and what comes back; one binary, one module per claim.

mod answers_agree;
mod documented_commands;
mod explained_omissions;
mod files;
mod fit_indentation;
mod fit_material;
mod fuzzed_inputs;
mod height_maps_of_numpy;
mod histories;
mod layers;
mod malformed;
mod rough_scenes;
mod scenes;
mod support;
mod surfaces;
mod sweeps;
mod windows;
