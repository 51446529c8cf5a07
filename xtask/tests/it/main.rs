//! What a maintainer types, and what comes back; one binary, one module per claim.

mod calibration;
mod commands;
mod measure_stationary;
mod speed_range;
mod stability;
mod support;
mod work_precision;
