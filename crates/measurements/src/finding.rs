//! Estimates of parameters with confidence intervals.

use numerics::Estimate;

/// Estimate of one quantity from measurements.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Finding {
    /// Name of the quantity, such as G_inf.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// Value with its standard error; `None` if the measurements do not determine it.
    pub estimate: Option<Estimate>,
    /// Ends of the 95 % confidence interval; `None` for a side without a bound.
    pub interval: [Option<f64>; 2],
}
