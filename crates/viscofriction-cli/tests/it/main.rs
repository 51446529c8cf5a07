//! What a user types, and what comes back; one binary, one module per claim.

mod documented_commands;
mod documented_links;
mod files;
mod fit_friction;
mod fit_indentation;
mod fit_material;
mod fuzzed_inputs;
mod limits;
mod malformed;
mod measured_friction;
mod moduli_change_with_temperature;
mod pictures;
mod scenes;
mod support;
mod surfaces;
mod sweeps;
