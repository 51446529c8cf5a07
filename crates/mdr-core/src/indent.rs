//! Normal indentation at constant force, without sliding.
//!
//! ```text
//! ∫ F dt = 4 η Σ (d − h_i)⁺ Δx               while the contact grows
//! ```
//! The compressions of an element over all steps add up to d − h_i. So the depth at a given time does not depend on the
//! steps that lead there, and the singular start d ∼ t^(p/(p+1)) costs nothing: only the spacing matters.

use indenters::RigidLine;
use rheology::Viscous;

use crate::MdrError;
use crate::contact::{Element, Instant};
use crate::element_heights::{ElementHeights, MAX_ELEMENTS};
use crate::error::{finite, positive};
use crate::slide::MIN_CONTACT;

/// Numerics of normal indentation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct IndentOptions {
    /// Spacing Δx of the elements, \[m].
    pub spacing: f64,
}

/// The state at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct IndentRow {
    /// Time since first touch, \[s].
    pub time: f64,
    /// Indentation depth d, \[m].
    pub indentation_depth: f64,
    /// Positions of the rearmost and the foremost element in contact on the line, \[m].
    pub contact: [f64; 2],
    /// Number of elements in contact.
    pub n_contact: usize,
    /// Length of the elements in contact, `n_contact` Δx, \[m].
    pub contact_length: f64,
}

/// Presses a line into an undeformed viscous chain with a constant `normal_force` > 0 \[N], and records the `times`
/// \[s], one step each.
///
/// The lowest point of the line must lie inside its domain.
///
/// # Errors
/// [`MdrError::ContactReachesBoundary`] when the contact reaches an end of the domain; [`MdrError::TooCoarse`] when
/// fewer than three elements are in contact at the last time; [`MdrError::TooManyElements`] when the chain would be too
/// long; [`MdrError::InvalidParameter`] when the times do not increase from above zero, or for another parameter;
/// [`MdrError::InvalidHeight`], [`MdrError::Empty`], [`MdrError::NonFinite`].
pub fn indent(
    line: &(impl RigidLine + ?Sized),
    material: &Viscous,
    normal_force: f64,
    times: &[f64],
    options: &IndentOptions,
) -> Result<Vec<IndentRow>, MdrError> {
    positive("normal_force", normal_force)?;
    positive("spacing", options.spacing)?;
    let duration = *times.last().ok_or(MdrError::Empty { list: "times" })?;
    positive("time", duration)?;
    // w = f/(4 Δx) summed over the chain, times α, is the area that the line displaces.
    let area = 0.25 * normal_force * material.step_compliance(duration);
    let sampled = sample_for_area(line, options.spacing, positive("area", area)?)?;
    let mut press = Press {
        displacements: vec![0.0; sampled.heights.len()],
        line: sampled,
        spacing: options.spacing,
        time: 0.0,
        depth: 0.0,
    };
    let mut rows = Vec::with_capacity(times.len());
    for &time in times {
        let time_step = positive("time_step", time - press.time)?;
        let element = Element::new(options.spacing, material.step_compliance(time_step))?;
        rows.push(press.advance(element, normal_force, time)?);
    }
    match rows.last() {
        Some(row) if row.n_contact < MIN_CONTACT => Err(MdrError::TooCoarse {
            n_contact: row.n_contact,
            needed: MIN_CONTACT,
            spacing: options.spacing,
        }),
        _ => Ok(rows),
    }
}

/// A line being pressed into a chain.
struct Press {
    line: ElementHeights,
    displacements: Vec<f64>,
    spacing: f64,
    time: f64,
    depth: f64,
}

impl Press {
    fn advance(
        &mut self,
        element: Element,
        normal_force: f64,
        time: f64,
    ) -> Result<IndentRow, MdrError> {
        let instant = Instant::unchecked(&self.line.heights, &self.displacements, element);
        let depth = instant.solve(normal_force, self.depth).indentation_depth;
        (self.depth, self.time) = (finite("indentation depth", depth, time)?, time);
        for (displacement, height) in self.displacements.iter_mut().zip(&self.line.heights) {
            *displacement = displacement.max(depth - height);
        }
        self.row()
    }

    fn row(&self) -> Result<IndentRow, MdrError> {
        let last = self.line.heights.len() - 1;
        let (mut rear, mut front, mut n_contact) = (last, 0, 0);
        for (element, height) in self.line.heights.iter().enumerate() {
            if *height < self.depth {
                rear = rear.min(element);
                front = element;
                n_contact += 1;
            }
        }
        for end in [rear, front] {
            if end == 0 || end == last {
                return Err(MdrError::ContactReachesBoundary {
                    position: self.line.position(end),
                    indentation_depth: self.depth,
                    time: self.time,
                });
            }
        }
        Ok(IndentRow {
            time: self.time,
            indentation_depth: self.depth,
            contact: [rear, front].map(|element| self.line.position(element)),
            n_contact,
            contact_length: n_contact as f64 * self.spacing,
        })
    }
}

/// Samples the line so far up that an `area` \[m²] can be displaced below, or to the ends of a finite domain.
fn sample_for_area(
    line: &(impl RigidLine + ?Sized),
    spacing: f64,
    area: f64,
) -> Result<ElementHeights, MdrError> {
    let mut sampled = ElementHeights::below(line, spacing, 0.0)?;
    let mut reach = 1;
    while reach < MAX_ELEMENTS {
        reach *= 2;
        let level = sampled.rise_within(line, reach);
        sampled = ElementHeights::below(line, spacing, level)?;
        if level.is_infinite() || sampled.area_below(level) >= area {
            return Ok(sampled);
        }
    }
    Err(MdrError::TooManyElements {
        allowed: MAX_ELEMENTS,
        spacing,
        height: sampled.rise_within(line, reach),
    })
}
