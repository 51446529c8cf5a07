//! Sliding from first touch into the stationary state.
//!
//! In every step the line moves on by one element and sinks until the elements carry the normal force. The elements
//! stay where they are in the material, so that the shift is exact; they enter at the front undeformed (on a line
//! nothing sinks ahead of the contact) and leave at the rear.
//!
//! ```text
//! Σ (d − h_i − u_i)⁺ = F_N / (4 η v)         one step, Δt = Δx / v
//! d = F_N / (4 η v)                          (12), reached exactly at any spacing
//! μ = (4 η v / F_N) ∫ h̃'² dx                 (16), reached to second order
//! ```
//! Since Σ telescopes along the leading edge, the depth never exceeds (12); this bounds the chain.

use indenters::{Axisymmetric, RigidLine, SlidingLoad, contact_radius};
use rheology::Viscous;

use crate::MdrError;
use crate::error::{finite, positive};
use crate::march::March;

/// The fewest elements that the last contact must have.
pub(crate) const MIN_CONTACT: usize = 3;

/// Numerics of sliding.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SlideOptions {
    /// Spacing Δx of the elements, \[m]; the line moves by as much in one step.
    pub spacing: f64,
    /// The state is stationary when sliding by one contact length changes the depth and the friction coefficient by
    /// no more than this, relative to their values.
    ///
    /// The approach is exponential with the contact length as its length, so that the remaining distance to the limit
    /// is below `drift_tolerance / (e − 1)`, with n elements along the contact (1 + 1/n)ⁿ for e. The contact length is
    /// measured from the rearmost to the foremost loaded element, gaps included.
    pub drift_tolerance: f64,
    /// Sliding distance after which the search for the stationary state is given up, \[m].
    pub max_sliding_distance: f64,
}

impl SlideOptions {
    /// Options with a number of `elements` along the stationary contact of a body of revolution, a drift tolerance of
    /// 1e-9, and 100 contact lengths of sliding; about 20 are needed.
    ///
    /// # Errors
    /// [`MdrError::InvalidParameter`] for an apex h ∼ r^p with p ≤ 1/2, whose friction diverges;
    /// [`MdrError::TooCoarse`] for fewer than three elements; [`MdrError::Indenter`] when the body has no contact
    /// radius at the stationary depth.
    pub fn with_elements(
        elements: usize,
        body: &(impl Axisymmetric + ?Sized),
        material: &Viscous,
        load: &SlidingLoad,
    ) -> Result<Self, MdrError> {
        let value = body.apex_exponent();
        if value <= 0.5 {
            // On any chain the friction is finite, but it grows without limit on refinement.
            let allowed = "above 1/2, where the friction integral (16) converges";
            return Err(MdrError::InvalidParameter {
                parameter: "apex exponent",
                value,
                allowed,
            });
        }
        let length = contact_radius(body, stationary_depth(material, load)?)?;
        let spacing = length / elements.max(1) as f64;
        if elements < MIN_CONTACT {
            return Err(MdrError::TooCoarse {
                n_contact: elements,
                needed: MIN_CONTACT,
                spacing,
            });
        }
        Ok(Self {
            spacing,
            drift_tolerance: 1e-9,
            max_sliding_distance: 100.0 * length,
        })
    }

    fn check(&self) -> Result<(), MdrError> {
        positive("spacing", self.spacing)?;
        let value = positive("drift_tolerance", self.drift_tolerance)?;
        if value >= 1.0 {
            let allowed = "between 0 and 1";
            return Err(MdrError::InvalidParameter {
                parameter: "drift_tolerance",
                value,
                allowed,
            });
        }
        positive("max_sliding_distance", self.max_sliding_distance)?;
        Ok(())
    }
}

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

/// A body's way from first touch into its stationary state.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct Transient {
    /// One row per step.
    pub rows: Vec<SlideRow>,
    /// The state in which the march stopped, because `drift` had fallen to the tolerance.
    pub stationary: SlideRow,
    /// Larger of the relative changes of depth and friction coefficient over the last contact length.
    pub drift: f64,
}

/// Slides a line over an undeformed viscous chain until the state is stationary.
///
/// # Errors
/// - [`MdrError::NoStationaryState`] when the leading edge is lower than the stationary depth (Remark 4).
/// - [`MdrError::NotStationary`], with the transient, when `max_sliding_distance` was too short.
/// - [`MdrError::ContactReachesBoundary`] when the contact reaches the last element in front. The rear end of the line
///   may carry load: elements that pass it are free.
/// - [`MdrError::TooCoarse`] when fewer than three elements are in the stationary contact,
///   [`MdrError::TooManyElements`] when the chain would be too long.
/// - [`MdrError::InvalidParameter`], [`MdrError::InvalidHeight`], [`MdrError::NonFinite`].
pub fn slide(
    line: &(impl RigidLine + ?Sized),
    material: &Viscous,
    load: &SlidingLoad,
    options: &SlideOptions,
) -> Result<Transient, MdrError> {
    options.check()?;
    let depth = stationary_depth(material, load)?;
    let mut march = March::from_first_touch(line, material, load, options.spacing, depth)?;
    let mut rows: Vec<SlideRow> = Vec::new();
    let mut drift = 1.0;
    while march.next_sliding_distance() <= options.max_sliding_distance {
        let (row, span) = march.advance()?;
        rows.push(row);
        drift = relative_change(&rows, span);
        if drift <= options.drift_tolerance {
            return stop(rows, row, drift, options.spacing);
        }
    }
    Err(MdrError::NotStationary {
        drift,
        drift_tolerance: options.drift_tolerance,
        sliding_distance: rows.last().map_or(0.0, |row| row.sliding_distance),
        rows,
    })
}

/// Stationary depth d = F_N / (4 η v), (12).
fn stationary_depth(material: &Viscous, load: &SlidingLoad) -> Result<f64, MdrError> {
    let depth = load.normal_force() / (4.0 * material.viscosity() * load.velocity());
    positive("stationary depth", finite("stationary depth", depth, 0.0)?)
}

/// Change of depth and friction over the last `span` rows; 1, as from nothing, when there are not as many.
fn relative_change(rows: &[SlideRow], span: usize) -> f64 {
    let n_rows = rows.len();
    if n_rows <= span {
        return 1.0;
    }
    let (now, before) = (&rows[n_rows - 1], &rows[n_rows - 1 - span]);
    let change = |now: f64, before: f64| {
        let difference = (now - before).abs();
        if difference > 0.0 {
            difference / now.abs().max(before.abs())
        } else {
            0.0
        }
    };
    let depth = change(now.indentation_depth, before.indentation_depth);
    let friction = change(now.friction_coefficient, before.friction_coefficient);
    depth.max(friction)
}

fn stop(
    rows: Vec<SlideRow>,
    stationary: SlideRow,
    drift: f64,
    spacing: f64,
) -> Result<Transient, MdrError> {
    if stationary.n_contact < MIN_CONTACT {
        return Err(MdrError::TooCoarse {
            n_contact: stationary.n_contact,
            needed: MIN_CONTACT,
            spacing,
        });
    }
    Ok(Transient {
        rows,
        stationary,
        drift,
    })
}
