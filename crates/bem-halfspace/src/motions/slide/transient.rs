//! Result of a sliding simulation on one grid.

use indenters::SlidingLoad;

use crate::BemError;
use crate::elements::gap_field::GapField;
use crate::elements::pressure_field::PressureField;
use crate::error::check_contact_elements;
use crate::motions::slide::{March, MotionRow};

/// The state after one step of sliding.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SlideRow {
    /// Sliding distance since first touch, \[m].
    pub sliding_distance: f64,
    /// Time since first touch, \[s].
    pub time: f64,
    /// Depth of the lowest point below the undeformed surface, \[m]. On a half space that flows it grows like the logarithm of the
    /// distance, without limit.
    pub indentation_depth: f64,
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// Friction coefficient with the slope at the time level of the pressure, which on a dashpot is the mean over the step.
    pub friction_coefficient: f64,
    /// Friction coefficient with the slope at the end of the step, as the wording of Kürschner (2014) suggests; on a dashpot it
    /// is low by a first-order term in Δx.
    pub friction_coefficient_end_of_step: f64,
    /// [Area](crate::PressureField::contact_area) of the contact, \[m²].
    pub contact_area: f64,
    /// Discretisation error of the contact area, because its outline lies anywhere within the outermost elements, \[m²].
    pub(crate) contact_area_uncertainty: f64,
    /// Rear and front of the contact relative to the lowest point, \[m].
    pub contact_x: [f64; 2],
    /// Sides of the contact relative to the lowest point, \[m].
    pub contact_y: [f64; 2],
    /// Number of elements in contact.
    pub n_contact: usize,
    /// Iterations of the contact solver.
    pub iterations: usize,
}

impl SlideRow {
    /// The row of a step; `None` without normal force, because there is no friction coefficient then.
    pub(super) fn in_contact(row: &MotionRow) -> Option<Self> {
        let (Some(contact_x), Some(contact_y)) = (row.contact_x, row.contact_y) else {
            return None;
        };
        (row.normal_force > 0.0).then_some(Self {
            sliding_distance: row.position,
            time: row.time,
            indentation_depth: row.indentation_depth,
            normal_force: row.normal_force,
            friction_coefficient: row.tangential_force / row.normal_force,
            friction_coefficient_end_of_step: row.tangential_force_end_of_step / row.normal_force,
            contact_area: row.contact_area,
            contact_area_uncertainty: row.contact_area_uncertainty,
            contact_x,
            contact_y,
            n_contact: row.n_contact,
            iterations: row.iterations,
        })
    }
}

/// A sliding simulation from first touch on.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct Transient {
    /// One row per step with contact, by increasing distance; never empty.
    pub rows: Vec<SlideRow>,
    /// Pressure in the last step.
    pub pressure: PressureField,
    /// Gap around the contact in the last step; `None` if the body does not cover the box of the contact.
    pub gap: Option<GapField>,
    /// Number of elements of the half space whose displacement was followed.
    pub n_elements: usize,
}

impl Transient {
    /// Result of a march under `load` with the given rows.
    ///
    /// # Errors
    /// [`BemError::GridTooCoarse`] or [`BemError::SlopeNotResolved`] if elements do not resolve the last contact.
    pub(super) fn from_march(
        march: &March<'_>,
        load: &SlidingLoad,
        rows: Vec<SlideRow>,
    ) -> Result<Self, BemError> {
        let pressure = march.pressure()?;
        // Refuse a last contact that the elements do not resolve.
        let [length, width] = pressure.grid.shape();
        check_contact_elements(length.min(width))?;
        if let Some(force) = load.normal_force() {
            let contact_length = length as f64 * pressure.grid.spacing()[0];
            let distance = load.sliding_distance().unwrap_or(f64::INFINITY);
            let time = contact_length.min(distance) / load.velocity();
            // An element is under the contact for the time L/v, with the contact length L and the velocity v, but at most for the
            // time of the whole path.
            let depth_scale = march.depth_scale(force, contact_length, time)?;
            let rise = march.largest_rise();
            if rise > depth_scale {
                return Err(BemError::SlopeNotResolved { rise, depth_scale });
            }
        }
        Ok(Self {
            gap: march.gap()?,
            rows,
            pressure,
            n_elements: march.n_elements(),
        })
    }
}
