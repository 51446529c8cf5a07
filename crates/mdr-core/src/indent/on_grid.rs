//! Normal indentation without sliding on a chain of stated resolution: a constant control, or any history.
//!
//! ```text
//! Σ (d − h_i − u_i)⁺ = α F_N / (4 Δx)        one step of compliance α
//! ∫ F dt = 4 η Σ (d − h_i)⁺ Δx               a dashpot, while the contact grows
//! ```
//! On a dashpot the compressions of an element over all steps add up to d − h_i. So the depth at a given time does not
//! depend on the steps that lead there, and the singular start d ∼ t^(p/(p+1)) costs nothing: only the spacing
//! matters. On an elastic material nothing depends on the steps. On any other the error is of first order in their
//! lengths, because the load of an element is held over a step.

use indenters::{Control, PressingLoad, RigidLine};
use numerics::{not_negative, positive};
use rheology::{ExponentialStep, Material};

use crate::MdrError;
use crate::chain::Chain;
use crate::element_heights::ElementHeights;
use crate::error::{enough_elements, finite};

/// Numerics of normal indentation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct IndentOptions {
    /// Spacing Δx of the elements, \[m].
    pub spacing: f64,
    /// Number of equal steps in time.
    pub n_steps: usize,
}

/// One step of a history; its control holds from the step before, so that a change of force is a jump.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct IndentStep {
    /// Time at the end of the step, since first touch, \[s].
    pub time: f64,
    /// Force ≥ 0, or depth of the lowest point, there.
    pub control: Control,
}

/// The state at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct IndentRow {
    /// Time since first touch, \[s].
    pub time: f64,
    /// Indentation depth d, \[m].
    pub indentation_depth: f64,
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// Positions of the rearmost and the foremost loaded element on the line, \[m]; `None` without contact.
    pub contact: Option<[f64; 2]>,
    /// Number of loaded elements.
    pub n_contact: usize,
    /// Length of the loaded elements, `n_contact` Δx, \[m].
    pub contact_length: f64,
}

/// Presses a line into an undeformed chain with a constant control, in equal steps, and returns the state after each.
///
/// The lowest point of the line must lie inside its domain.
///
/// # Errors
/// [`MdrError::Empty`] without steps; otherwise like [`indent_history`].
pub fn indent_on_grid(
    line: &(impl RigidLine + ?Sized),
    material: &(impl Material + ?Sized),
    load: &PressingLoad,
    options: &IndentOptions,
) -> Result<Vec<IndentRow>, MdrError> {
    let step = |step: usize| IndentStep {
        time: load.duration() * (step as f64 / options.n_steps as f64),
        control: load.control(),
    };
    let steps: Vec<IndentStep> = (1..=options.n_steps).map(step).collect();
    indent_history(line, material, &steps, options.spacing)
}

/// Presses a line into an undeformed chain of elements of the `spacing` \[m] and lets it go again, step by step.
///
/// The lowest point of the line must lie inside its domain. A depth of no contact has no force.
///
/// # Errors
/// [`MdrError::ContactReachesEdge`] when the contact reaches an end of the domain; [`MdrError::TooCoarse`] when
/// no step has three elements in contact; [`MdrError::TooManyElements`] when the chain would be too long;
/// [`MdrError::InvalidParameter`] when the times do not increase from above zero, or for another parameter;
/// [`MdrError::InvalidHeight`], [`MdrError::Empty`], [`MdrError::NonFinite`], [`MdrError::Material`].
pub fn indent_history(
    line: &(impl RigidLine + ?Sized),
    material: &(impl Material + ?Sized),
    steps: &[IndentStep],
    spacing: f64,
) -> Result<Vec<IndentRow>, MdrError> {
    positive("spacing", spacing)?;
    check(steps)?;
    let line = elements(line, material, steps, spacing)?;
    let mut chain = Chain::new(line, material, steps[0].time)?;
    let mut time = 0.0;
    let mut rows = Vec::with_capacity(steps.len());
    for step in steps {
        chain.set_time_step(step.time - time)?;
        time = step.time;
        rows.push(advance(&mut chain, step)?);
    }
    let largest = rows.iter().map(|row| row.n_contact).max().unwrap_or(0);
    enough_elements(largest, spacing)?;
    Ok(rows)
}

fn check(steps: &[IndentStep]) -> Result<(), MdrError> {
    let last = steps.last().ok_or(MdrError::Empty { list: "times" })?;
    positive("time", last.time)?;
    let mut before = 0.0;
    for step in steps {
        positive("time_step", step.time - before)?;
        before = step.time;
        match step.control {
            Control::NormalForce(force) => not_negative("normal_force", force)?,
            Control::IndentationDepth(depth) => finite("indentation depth", depth, before)?,
        };
    }
    Ok(())
}

/// Elements for the largest depth, and for the largest force held all the time.
fn elements(
    line: &(impl RigidLine + ?Sized),
    material: &(impl Material + ?Sized),
    steps: &[IndentStep],
    spacing: f64,
) -> Result<ElementHeights, MdrError> {
    let (mut force, mut depth) = (0.0_f64, 0.0_f64);
    for step in steps {
        match step.control {
            Control::NormalForce(value) => force = force.max(value),
            Control::IndentationDepth(value) => depth = depth.max(value),
        }
    }
    if force == 0.0 {
        return ElementHeights::below(line, spacing, depth);
    }
    // w = f/(4 Δx) summed over the chain, times J(t), is the area that the line displaces.
    let whole = ExponentialStep::creep(&material.creep(), steps[steps.len() - 1].time)?;
    let compliance = material.half_space_factor() * whole.response();
    let area = positive("area", 0.25 * force * compliance)?;
    let sampled = ElementHeights::holding(line, spacing, area)?;
    if sampled.ceiling < depth {
        return ElementHeights::below(line, spacing, depth);
    }
    Ok(sampled)
}

fn advance(chain: &mut Chain, step: &IndentStep) -> Result<IndentRow, MdrError> {
    let contact = chain.press(step.control, step.time, |_, _| ())?;
    let last = chain.line.heights.len() - 1;
    let mut ends = contact.ends.into_iter().flatten();
    if let Some(end) = ends.find(|end| *end == 0 || *end == last) {
        return Err(chain.reaches_edge(end, step.time));
    }
    let position = |end| chain.line.position(end);
    Ok(IndentRow {
        time: step.time,
        indentation_depth: contact.indentation_depth,
        normal_force: contact.normal_force,
        contact: contact.ends.map(|ends| ends.map(position)),
        n_contact: contact.n_contact,
        contact_length: contact.n_contact as f64 * chain.line.spacing,
    })
}
