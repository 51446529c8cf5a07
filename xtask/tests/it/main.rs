//! What a user types, and what comes back; one binary, one module per command.

mod commands;
mod fit_material;
