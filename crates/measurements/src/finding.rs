//! What measurements say about one quantity.

use numerics::Estimate;

/// What measurements say about one quantity.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Finding {
    /// Name, as G_inf.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// The value with its standard error, where the measurements determine it.
    pub estimate: Option<Estimate>,
    /// Ends of the 95 % interval; none where the measurements set no bound on that side.
    pub interval: [Option<f64>; 2],
}
