//! What a maintainer types, and what comes back; one binary, one module per claim.

mod agreement;
mod bars;
mod calibration;
mod commands;
mod pages;
mod rough;
mod speed_range;
mod stability;
mod stationary;
mod support;
mod work_precision;
