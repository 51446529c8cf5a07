//! Tables and curves as they are measured, and what is found in them; one binary, one module per claim.

mod exported_tables;
mod fit_indentation;
mod support;
mod synthetic;
mod thin_samples;
