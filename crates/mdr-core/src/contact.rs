//! One instant of the chain.
//!
//! ```text
//! f = 4 η Δx du/dt                                   (10)
//! f_i = (4 Δx / α) max(0, d − h_i − u_i)              over one implicit step of compliance α
//! Σ f_i = F_N
//! ```
//! The load potential of an element under the force f is w = f/(4 Δx), and a step moves it by α w. The force is a
//! convex, increasing, piecewise-linear function of the depth, so that Newton's method ends at the solution itself.

use crate::MdrError;
use crate::compensated::CompensatedSum;
use crate::error::{not_negative, positive};

/// What one element does in one step.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Element {
    spacing: f64,
    compliance: f64,
}

impl Element {
    /// An element of a chain with the given `spacing` Δx > 0 \[m], over a step of compliance α > 0 \[1/Pa].
    ///
    /// # Errors
    /// [`MdrError::InvalidParameter`] when one of them is not finite and greater than zero.
    pub fn new(spacing: f64, compliance: f64) -> Result<Self, MdrError> {
        Ok(Self {
            spacing: positive("spacing", spacing)?,
            compliance: positive("compliance", compliance)?,
        })
    }

    /// Force on the element when it is compressed by `compression` \[m] in the step: f = 4 Δx · compression/α, \[N].
    #[must_use]
    pub fn force(&self, compression: f64) -> f64 {
        4.0 * self.spacing * (compression / self.compliance)
    }

    /// The compression \[m] of one element under a `force` \[N].
    #[must_use]
    pub fn compression(&self, force: f64) -> f64 {
        // In this order forces whose square is no number stay in range.
        0.25 * force / self.spacing * self.compliance
    }
}

/// A rigid line over a chain, before the depth of the instant is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instant<'a> {
    heights: &'a [f64],
    displacements: &'a [f64],
    element: Element,
}

/// A solved instant.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Contact {
    /// Indentation depth d, \[m].
    pub indentation_depth: f64,
    /// Normal force, \[N].
    pub normal_force: f64,
    /// Number of elements that carry force.
    pub n_contact: usize,
}

impl<'a> Instant<'a> {
    /// The `heights` h_i \[m] of the line over each element, above its lowest point, and the `displacements` u_i \[m]
    /// that the elements would have at the end of the step without load (for a dashpot, those before the step).
    ///
    /// A height of `+∞` says that there is no body over the element.
    ///
    /// # Errors
    /// [`MdrError::Empty`], [`MdrError::LengthMismatch`]; [`MdrError::InvalidElement`] when a height is `−∞` or not a
    /// number, a displacement is not finite, or no element lies under the body.
    pub fn new(
        heights: &'a [f64],
        displacements: &'a [f64],
        element: Element,
    ) -> Result<Self, MdrError> {
        if heights.is_empty() {
            return Err(MdrError::Empty { list: "heights" });
        }
        if heights.len() != displacements.len() {
            return Err(MdrError::LengthMismatch {
                first: "heights",
                first_length: heights.len(),
                second: "displacements",
                second_length: displacements.len(),
            });
        }
        check_elements(heights, displacements)?;
        Ok(Self::unchecked(heights, displacements, element))
    }

    /// Like [`Instant::new`], for lists that are known to be good.
    pub(crate) fn unchecked(
        heights: &'a [f64],
        displacements: &'a [f64],
        element: Element,
    ) -> Self {
        debug_assert_eq!(
            heights.len(),
            displacements.len(),
            "one displacement per height"
        );
        Self {
            heights,
            displacements,
            element,
        }
    }

    /// The contact that carries `normal_force` ≥ 0 \[N]. Without force the line touches the first element.
    ///
    /// # Errors
    /// [`MdrError::InvalidParameter`] when the force is negative or not finite.
    pub fn contact_at_force(&self, normal_force: f64) -> Result<Contact, MdrError> {
        not_negative("normal_force", normal_force)?;
        Ok(self.solve(normal_force, f64::NEG_INFINITY))
    }

    /// The contact at an `indentation_depth` \[m].
    ///
    /// # Errors
    /// [`MdrError::InvalidParameter`] when the depth is not finite.
    pub fn contact_at_depth(&self, indentation_depth: f64) -> Result<Contact, MdrError> {
        if !indentation_depth.is_finite() {
            return Err(MdrError::InvalidParameter {
                parameter: "indentation_depth",
                value: indentation_depth,
                allowed: "finite",
            });
        }
        Ok(self.contact(indentation_depth))
    }

    /// Force on each element \[N] at an `indentation_depth` \[m], from the rear to the front.
    pub fn forces(&self, indentation_depth: f64) -> impl Iterator<Item = f64> {
        self.touch_depths()
            .map(move |touch| self.element.force((indentation_depth - touch).max(0.0)))
    }

    /// The contact at `normal_force`, starting from the depth `guess`; `−∞` for no guess.
    ///
    /// From the first step on Newton's method comes down to the solution from above, and its contacts are nested;
    /// when the contact has not lost an element, the equation is linear between the last two depths and solved. If f is
    /// the excess of force and g the number of elements, convexity gives f'/f + g'/g ≤ 1 from step to step, so that
    /// f g falls by a factor of four or more: the number of passes is logarithmic, with a guess two or three.
    pub(crate) fn solve(&self, normal_force: f64, guess: f64) -> Contact {
        let needed = self.element.compression(normal_force);
        let mut level = self.level(guess);
        let mut depth = if level.n_below == 0 {
            self.lowest_touch() + needed
        } else {
            level.newton(guess, needed)
        };
        level = self.level(depth);
        while level.n_below > 0 {
            let (before, n_before) = (depth, level.n_below);
            depth = level.newton(before, needed);
            level = self.level(depth);
            // A step from far above carries the rounding of the larger depth; it is then repeated from here.
            if level.n_below >= n_before && before.abs() <= 2.0 * depth.abs() {
                break;
            }
        }
        self.contact_of(depth, level)
    }

    fn contact(&self, depth: f64) -> Contact {
        self.contact_of(depth, self.level(depth))
    }

    fn contact_of(&self, depth: f64, level: Level) -> Contact {
        Contact {
            indentation_depth: depth,
            normal_force: self.element.force(level.compression),
            n_contact: level.n_below,
        }
    }

    /// Depth at which the line touches each element.
    fn touch_depths(&self) -> impl Iterator<Item = f64> {
        self.heights
            .iter()
            .zip(self.displacements)
            .map(|(height, displacement)| height + displacement)
    }

    fn lowest_touch(&self) -> f64 {
        self.touch_depths().fold(f64::INFINITY, f64::min)
    }

    fn level(&self, depth: f64) -> Level {
        let mut n_below = 0;
        let mut compression = CompensatedSum::default();
        for touch in self.touch_depths() {
            if touch < depth {
                n_below += 1;
                compression.add(depth - touch);
            }
        }
        Level {
            n_below,
            compression: compression.value(),
        }
    }
}

/// The elements below a depth, and the sum of their compressions.
#[derive(Debug, Clone, Copy)]
struct Level {
    n_below: usize,
    compression: f64,
}

impl Level {
    /// The depth at which the same elements are compressed by `needed` in sum.
    fn newton(self, depth: f64, needed: f64) -> f64 {
        depth + (needed - self.compression) / self.n_below as f64
    }
}

fn check_elements(heights: &[f64], displacements: &[f64]) -> Result<(), MdrError> {
    let refuse = |quantity, element, value, allowed| {
        Err(MdrError::InvalidElement {
            quantity,
            element,
            value,
            allowed,
        })
    };
    let bad = |height: &f64| height.is_nan() || *height == f64::NEG_INFINITY;
    if let Some(element) = heights.iter().position(bad) {
        return refuse("height", element, heights[element], "a number or +inf");
    }
    if let Some(element) = displacements.iter().position(|u| !u.is_finite()) {
        return refuse("displacement", element, displacements[element], "finite");
    }
    if heights.iter().all(|height| height.is_infinite()) {
        return refuse("height", 0, heights[0], "finite for at least one element");
    }
    Ok(())
}
