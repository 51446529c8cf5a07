//! Tables and curves as they are measured, and what is found in them; one binary, one module per claim.

mod elastic_curves;
mod exported_curves;
mod exported_tables;
mod fit_indentation;
mod pull_in;
mod support;
mod synthetic;
mod thin_samples;
