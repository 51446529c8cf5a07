//! What a user types, and what comes back; one binary, one module per claim.

mod commands;
mod documented_commands;
mod fit_material;
mod malformed_scenes;
mod measure_stationary;
mod scenes;
mod speed_range;
mod stability;
mod support;
mod sweeps;
