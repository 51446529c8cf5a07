//! One step of a march.

/// The state at the end of one step.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SlideRow {
    /// Distance slid since first touch, \[m].
    pub sliding_distance: f64,
    /// Time since first touch, \[s].
    pub time: f64,
    /// Indentation depth d, \[m].
    pub indentation_depth: f64,
    /// Friction coefficient of the step, with the mean slope that each element meets during the step.
    ///
    /// The force of a step belongs to the motion during the step. This is second order in the spacing once stationary.
    /// In the transient it is a mean over the step and belongs to its middle.
    pub friction_coefficient: f64,
    /// Friction coefficient with the slope at the end of the step, as a plain reading of the paper suggests; only
    /// first order in the spacing.
    ///
    /// `None` where a loaded element ends the step at an infinite slope (the cusp of a power p < 1).
    pub friction_coefficient_end_of_step: Option<f64>,
    /// Mean sinking velocity over the step, \[m/s].
    pub sinking_velocity: f64,
    /// Positions of the rearmost and the foremost loaded element on the line, \[m].
    pub contact: [f64; 2],
    /// Number of loaded elements; one that is touched and not compressed may count or not, by rounding.
    pub n_contact: usize,
    /// Length of the loaded elements, `n_contact` Δx, \[m]; gaps between several contacts do not count.
    pub contact_length: f64,
}
