//! Sliding from first contact on a Winkler foundation of stated spacing.
//!
//! In every step the line moves on by one element and sinks until the elements carry the normal force. The elements
//! stay where they are in the material, so that the shift is exact. They enter at the front undeformed (on a line
//! nothing sinks ahead of the contact) and leave at the rear, where they recover and may come into contact again.
//!
//! ```text
//! Σ (d − h_i − u_i)⁺ = α F_N / (4 Δx)        one step of compliance α, Δt = Δx / v
//! d = F_N / (4 η v)                          (12), a dashpot: reached exactly at any spacing
//! μ = (4 η v / F_N) ∫ h̃'² dx                 (16), reached to second order
//! ```
//! On a dashpot the sum telescopes along the leading edge, so that the depth never exceeds (12). For the depth of another
//! material a foundation may turn out too low; the march then begins anew on one that is twice as high.
//!
//! Theory: docs/theory/line-viscoelastic.md, "Step by step".

use indenters::{RigidLine, SlidingLoad};
use numerics::{between_zero_and_one, in_range, positive};
use rheology::{ExponentialStep, Material};

use super::foundation_march::{FoundationMarch, MarchStep};
use crate::MdrError;
use crate::error::{enough_elements, finite};
use crate::line::{ElementHeights, MAX_ELEMENTS, checked_height};
use crate::refinement::FOUNDATION_PER_CONTACT;
use crate::steady::LineProblem;

/// Resolution and stopping rule of a march.
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
    /// Options with a number of `elements` along the stationary contact, a drift tolerance of 1e-9, and 100 contact lengths
    /// of sliding, of which about 20 are needed; where the load has a sliding distance, it is a whole number of steps, and of
    /// at least as many as `elements`.
    ///
    /// # Errors
    /// [`MdrError::InvalidParameter`] for a lone dashpot under an apex h ∼ r^p with p ≤ 1/2, whose friction diverges;
    /// [`MdrError::TooCoarse`] for fewer than three elements; otherwise like [`steady`](crate::steady()).
    pub fn with_elements(
        elements: usize,
        line: &dyn RigidLine,
        material: &dyn Material,
        load: &SlidingLoad,
    ) -> Result<Self, MdrError> {
        let value = line.apex_exponent();
        // At any spacing the friction is finite, but it grows without limit on refinement.
        let diverges = value <= 0.5 && material.relaxation().viscosity() > 0.0;
        let allowed = "above 1/2, where the friction integral (16) converges";
        in_range("apex exponent", value, !diverges, allowed)?;
        let problem = LineProblem::new(line, material, load.velocity())?;
        let length = problem.contact_span(load.control())?;
        // A whole part of the distance, and no more than the distance itself, so that resolutions have steps in proportion.
        let whole = |distance: f64| distance / (distance / length).ceil().max(1.0);
        let spacing = load.sliding_distance().map_or(length, whole) / elements.max(1) as f64;
        enough_elements(elements, spacing)?;
        Ok(Self {
            spacing,
            drift_tolerance: 1e-9,
            max_sliding_distance: 100.0 * length,
        })
    }

    fn check(&self) -> Result<(), MdrError> {
        positive("spacing", self.spacing)?;
        between_zero_and_one("drift_tolerance", self.drift_tolerance)?;
        positive("max_sliding_distance", self.max_sliding_distance)?;
        Ok(())
    }
}

/// The state at the end of one step.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SlideRow {
    /// Distance slid since first contact, \[m].
    pub sliding_distance: f64,
    /// Time since first contact, \[s].
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
    /// Number of loaded elements; whether an element without compression counts is decided by rounding.
    pub n_contact: usize,
    /// Length of the loaded elements, `n_contact` Δx, \[m]; gaps between several contacts do not count.
    pub contact_length: f64,
}

/// Sliding from first contact on.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct Transient {
    /// One row per step.
    pub rows: Vec<SlideRow>,
    /// The state at the end of the march.
    pub last: SlideRow,
    /// Larger of the relative changes of depth and friction coefficient over the last contact length.
    pub drift: f64,
    /// Positions of the elements around the last contact \[m] from the rear to the front, and the load per length there
    /// \[N/m].
    pub load: Vec<[f64; 2]>,
    /// Sub-grid errors of the friction coefficient, and of the depth \[m].
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) subgrid_errors: [f64; 2],
}

/// Memory of an element besides its history variables, about and at most, \[bytes].
const SLIDE_BYTES_PER_ELEMENT: f64 = 80.0;

/// Memory that [`slide`](super::slide) takes at most for a number of elements along the contact, or along the sliding distance where
/// that is shorter, \[bytes].
///
/// # Errors
/// As for [`SlideOptions::with_elements`].
pub fn slide_memory(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &SlidingLoad,
    elements: usize,
) -> Result<f64, MdrError> {
    let options = SlideOptions::with_elements(elements, line, material, load)?;
    let distance = load.sliding_distance();
    let steps = distance.unwrap_or(options.max_sliding_distance) / options.spacing;
    // Lists grow by doubling, and their rows are taken out of them.
    let per_step = 3 * size_of::<MarchStep>() + 2 * size_of::<SlideRow>();
    let length = LineProblem::new(line, material, load.velocity())?.contact_span(load.control())?;
    let n_elements =
        (FOUNDATION_PER_CONTACT * length / options.spacing).min(2.0 * MAX_ELEMENTS as f64);
    let n_fields = material.creep().elements().len() + 1;
    let per_element = SLIDE_BYTES_PER_ELEMENT + (n_fields * size_of::<f64>()) as f64;
    Ok(steps * per_step as f64 + n_elements * per_element)
}

/// Slides a line over an undeformed Winkler foundation until the state is stationary, or over the sliding distance of the
/// load, to half a step. A march that becomes stationary before ends there.
///
/// # Errors
/// - [`MdrError::ForceBeyondEdge`] when the material flows and the leading edge is too low for it (Remark 4).
/// - [`MdrError::NotStationary`], with the transient, when `max_sliding_distance` was too short.
/// - [`MdrError::ContactReachesEdge`] when the contact reaches the last element in front. The rear end of the line
///   may carry load: elements that pass it are free.
/// - [`MdrError::TooCoarse`] when fewer than three elements are in the stationary contact,
///   [`MdrError::TooManyElements`] when the foundation would be too long.
/// - [`MdrError::Indenter`] when the load prescribes the depth.
/// - [`MdrError::InvalidParameter`], [`MdrError::InvalidHeight`], [`MdrError::NonFinite`], [`MdrError::Material`].
pub fn slide_on_grid(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &SlidingLoad,
    options: &SlideOptions,
) -> Result<Transient, MdrError> {
    march(line, material, load, options, &|_| ())
}

/// Tells which part of the march is done, about.
pub(super) fn march(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &SlidingLoad,
    options: &SlideOptions,
    report: &dyn Fn(f64),
) -> Result<Transient, MdrError> {
    options.check()?;
    let mut elements = first_elements(line, material, load, options.spacing)?;
    loop {
        let ceiling = elements.ceiling;
        let mut march = FoundationMarch::from_first_touch(line, elements, material, load)?;
        match march_to_end(&mut march, load, options, report)? {
            Some(transient) => {
                let subgrid_errors = march.subgrid_errors(line, &transient.last);
                return Ok(Transient {
                    subgrid_errors,
                    load: march.load(),
                    ..transient
                });
            }
            None => elements = ElementHeights::below(line, options.spacing, 2.0 * ceiling)?,
        }
    }
}

/// Marches to the end; `None` if the foundation was not high enough.
fn march_to_end(
    march: &mut FoundationMarch,
    load: &SlidingLoad,
    options: &SlideOptions,
    report: &dyn Fn(f64),
) -> Result<Option<Transient>, MdrError> {
    let mut steps: Vec<MarchStep> = Vec::new();
    let mut drift = 1.0;
    // Half a step more than the distance, so that rounding does not omit the last step.
    let given = load.sliding_distance();
    let beyond = given.map(|distance| distance + 0.5 * options.spacing);
    let farthest = beyond.unwrap_or(options.max_sliding_distance);
    while march.next_sliding_distance() <= farthest {
        let Some(step) = march.advance()? else {
            return Ok(None);
        };
        steps.push(step);
        drift = relative_change(&steps);
        // Towards the stationary state the changes fall exponentially.
        let settled_part = drift.ln() / options.drift_tolerance.ln();
        let travelled = march.next_sliding_distance() / farthest;
        report(travelled.max(settled_part).clamp(0.0, 1.0));
        if drift <= options.drift_tolerance {
            enough_elements(step.row.n_contact, options.spacing)?;
            break;
        }
    }
    let rows: Vec<SlideRow> = steps.iter().map(|step| step.row).collect();
    match rows.last() {
        Some(last) if given.is_some() || drift <= options.drift_tolerance => Ok(Some(Transient {
            last: *last,
            load: Vec::new(),
            subgrid_errors: [0.0; 2],
            drift,
            rows,
        })),
        last => Err(MdrError::NotStationary {
            drift,
            drift_tolerance: options.drift_tolerance,
            sliding_distance: last.map_or(0.0, |row| row.sliding_distance),
            rows,
        }),
    }
}

/// Elements up to the least stationary depth of a flowing material, or up to the depth that the first step needs.
fn first_elements(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &SlidingLoad,
    spacing: f64,
) -> Result<ElementHeights, MdrError> {
    let creep = material.creep();
    let quarter = 0.25 * load.require_normal_force()? * material.half_space_factor();
    if creep.fluidity() > 0.0 {
        let depth = quarter * creep.fluidity() / load.velocity();
        let depth = positive("stationary depth", finite("stationary depth", depth, 0.0)?)?;
        let sampled = ElementHeights::below(line, spacing, depth)?;
        check_leading_edge(line, sampled.lowest_height, depth, load)?;
        return Ok(sampled);
    }
    let step = ExponentialStep::creep(&creep, spacing / load.velocity())?;
    ElementHeights::holding(line, spacing, positive("area", quarter * step.response())?)
}

/// A line that ends in front must end above the least depth: its last point belongs to the leading edge.
fn check_leading_edge(
    line: &dyn RigidLine,
    lowest_height: f64,
    least_depth: f64,
    load: &SlidingLoad,
) -> Result<(), MdrError> {
    let front = line.domain()[1];
    if front.is_infinite() {
        return Ok(());
    }
    let available = checked_height(line, front)? - lowest_height;
    if available >= least_depth {
        return Ok(());
    }
    let normal_force = load.require_normal_force()?;
    Err(MdrError::ForceBeyondEdge {
        position: front,
        available,
        carried_force: normal_force * (available / least_depth),
        normal_force,
    })
}

/// Relative change of depth and friction over the last contact length; 1 if the distance is shorter.
fn relative_change(steps: &[MarchStep]) -> f64 {
    let n_steps = steps.len();
    let span = steps[n_steps - 1].span;
    if n_steps <= span {
        return 1.0;
    }
    let (now, before) = (&steps[n_steps - 1], &steps[n_steps - 1 - span]);
    let change = |now: f64, before: f64, noise: f64| {
        let difference = (now - before).abs();
        if difference > noise {
            difference / now.abs().max(before.abs())
        } else {
            0.0
        }
    };
    let depths = [now, before].map(|step| step.row.indentation_depth);
    let frictions = [now, before].map(|step| step.row.friction_coefficient);
    // On an elastic foundation the friction is only the rounding of the positive and negative slopes.
    let noise = FRICTION_SUM_ROUNDING * now.steepness;
    change(depths[0], depths[1], 0.0).max(change(frictions[0], frictions[1], noise))
}

/// Rounding of a sum of forces times rises, relative to the sum of their moduli: 64 units in the last place.
const FRICTION_SUM_ROUNDING: f64 = 64.0 * f64::EPSILON;
