//! Input and result of one step of a march.

use indenters::Control;
use numerics::Estimate;

/// End of one step of an indenter. The control holds during the whole step, so that a change of it is a jump.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Time at the end of the step, since the first touch, \[s].
    pub time: f64,
    /// Position of the lowest point along x at the end of the step, \[m]; it may change by any amount, stay, or go back.
    pub position: f64,
    /// Force or depth during the step; a force may be zero, a depth negative.
    pub control: Control,
}

/// The state at the end of a step; of [indentation](mod@crate::indent) the position, the time level and the forces along x are 0.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MotionRow {
    /// Time at the end of the step, since the first touch, \[s].
    pub time: f64,
    /// Position of the lowest point along x, \[m].
    pub position: f64,
    /// Depth of the lowest point below the undeformed surface, \[m]; under zero force that of the first touch.
    pub indentation_depth: f64,
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// Time level θ, from 0 to ½: pressure and forces belong to the time θ Δt before the end of the step.
    pub time_level: f64,
    /// Force F_h along −x on the indenter, \[N]: the pressure of the step times the slope at the time level.
    pub tangential_force: f64,
    /// Tangential force with the slope at the end of the step, \[N].
    pub(crate) tangential_force_end_of_step: f64,
    /// [Area](crate::PressureField::contact_area) of the contact, \[m²].
    pub contact_area: f64,
    /// Discretisation error of the contact area, \[m²]: the contact boundary lies anywhere within the elements at the edge.
    pub(crate) contact_area_uncertainty: f64,
    /// Contact area with a boundary that divides elements, \[m²].
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) divided_area: Estimate,
    /// Rear and front of the contact relative to the lowest point, \[m]; `None` without contact.
    pub contact_x: Option<[f64; 2]>,
    /// Sides of the contact relative to the lowest point, \[m]; `None` without contact.
    pub contact_y: Option<[f64; 2]>,
    /// Number of elements in contact.
    pub n_contact: usize,
    /// Iterations of the contact solver.
    pub iterations: usize,
}
