//! Friction to a requested error.
//!
//! The outline of the contact follows the elements. On one grid that scatters the friction around its trend, so each
//! refinement averages over four grids that are shifted by half an element along x and y. The averages converge with
//! the order 3/2, as the singular front edge does, or 2p − 1 where the apex h ∼ r^p is slower, and are extrapolated over
//! a factor of two in the spacing.

use indenters::{Axisymmetric, SlidingLoad, contact_radius};
use rheology::Viscous;

use crate::footprint::depth_scale;
use crate::steady::{SteadyOptions, SteadySliding, steady_from};
use crate::{BemError, Footprint};

/// Elements along the contact length of the one-dimensional model on the coarsest grids; every refinement has √2 times
/// as many, so that two of them are a factor of two.
const COARSEST: f64 = 5.0;
/// Refinements at most; dense factorisations end most ladders before.
const MAX_REFINEMENTS: i32 = 15;
/// Shifts of the grid along x and y that keep the mirror symmetry in y.
const PHASES: [[f64; 2]; 4] = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];
/// Δy/Δx: the outline is steeper across the sliding direction than along it.
const ASPECT: f64 = 0.5;
/// Contact sets tried on one grid.
const MAX_ITERATIONS: usize = 500;

/// What is asked of the friction coefficient, and how much work may be spent on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionOptions {
    /// Relative error asked for.
    pub relative_error: f64,
    /// Refinement stops before a grid that will have more unknown pressures than this, judged by the grid before it;
    /// the time of the dense factorisations grows with their third power.
    pub max_unknowns: usize,
}

impl Default for FrictionOptions {
    /// A relative error of 1e-3, and at most 4000 unknowns, whose factorisation takes some seconds.
    fn default() -> Self {
        Self {
            relative_error: 1e-3,
            max_unknowns: 4000,
        }
    }
}

/// One refinement: the average over shifted grids.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Refinement {
    /// Elements along the contact length of the one-dimensional model.
    pub elements: f64,
    /// Friction coefficient, averaged over the shifts.
    pub friction_coefficient: f64,
    /// Standard deviation over the shifts.
    pub scatter: f64,
    /// Unknown pressures on the largest of the grids.
    pub unknowns: usize,
}

/// A friction coefficient with its error.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct FrictionEstimate {
    /// Friction coefficient μ = F_h/F_N.
    pub friction_coefficient: f64,
    /// Estimated absolute error.
    pub error: f64,
    /// The refinements that led there, from coarse to fine.
    pub refinements: Vec<Refinement>,
}

/// Computes the stationary friction coefficient of a body of revolution to a relative error.
///
/// # Errors
/// [`BemError::FrictionNotReached`] with what was reached on the finest grid allowed;
/// [`BemError::InvalidParameter`] for a relative error that is not finite and positive;
/// [`BemError::Indenter`] when the body is too low for the load; and the errors of [`steady`](crate::steady::steady()).
pub fn steady_friction(
    body: &impl Axisymmetric,
    material: &Viscous,
    load: &SlidingLoad,
    options: &FrictionOptions,
) -> Result<FrictionEstimate, BemError> {
    let relative_error = below_one("relative_error", options.relative_error)?;
    let contact_length = contact_radius(body, depth_scale(material, load))?;
    let order = (2.0 * body.apex_exponent() - 1.0).min(1.5);
    if order <= 0.0 {
        // The friction of the apex alone is infinite, as in the one-dimensional model.
        let [parameter, allowed] = ["apex exponent", "above 1/2"];
        return Err(BemError::InvalidParameter {
            parameter,
            value: body.apex_exponent(),
            allowed,
        });
    }
    let mut refinements: Vec<Refinement> = Vec::new();
    let mut previous = None;
    let mut reached = [0.0, f64::MAX];
    for refinement in 0..MAX_REFINEMENTS {
        let elements = COARSEST * 2.0_f64.powf(0.5 * f64::from(refinement));
        let scene = (material, load, contact_length / elements);
        match refine(body, scene, &mut previous) {
            // A steep body needs a finer grid to begin with.
            Err(BemError::SlopeNotResolved { .. } | BemError::GridTooCoarse { .. })
                if refinements.is_empty() =>
            {
                continue;
            }
            refinement => refinements.push(Refinement {
                elements,
                ..refinement?
            }),
        }
        let [friction_coefficient, error] = extrapolate(&refinements, order);
        if error <= relative_error * friction_coefficient {
            return Ok(FrictionEstimate {
                friction_coefficient,
                error,
                refinements,
            });
        }
        reached = [friction_coefficient, error];
        // The next refinement has twice as many unknowns.
        if refinements
            .last()
            .is_some_and(|refinement| 2 * refinement.unknowns > options.max_unknowns)
        {
            break;
        }
    }
    let [friction_coefficient, error] = reached;
    Err(BemError::FrictionNotReached {
        friction_coefficient,
        error,
        relative_error,
    })
}

/// The average over the shifts, each started from the contact of the one before.
fn refine(
    body: &impl Axisymmetric,
    (material, load, spacing): (&Viscous, &SlidingLoad, f64),
    previous: &mut Option<SteadySliding>,
) -> Result<Refinement, BemError> {
    let mut footprint = Footprint::of_body(body, material, load)?;
    // Room for the elements at the boundary, where a steep body leaves none.
    for ends in [&mut footprint.x, &mut footprint.y] {
        *ends = [ends[0] - 2.0 * spacing, ends[1] + 2.0 * spacing];
    }
    let mut friction = [0.0; PHASES.len()];
    let mut unknowns = 0;
    for (friction, phase) in friction.iter_mut().zip(PHASES) {
        let spacing = [spacing, ASPECT * spacing];
        let options = SteadyOptions {
            spacing,
            phase,
            footprint,
            max_iterations: MAX_ITERATIONS,
        };
        let solution = steady_from(previous.as_ref(), body, (material, load), &options)?;
        *friction = solution.friction_coefficient;
        unknowns = unknowns.max(solution.unknowns);
        *previous = Some(solution);
    }
    let count = PHASES.len() as f64;
    let mean = friction.iter().sum::<f64>() / count;
    let variance = friction
        .iter()
        .map(|value| (value - mean).powi(2))
        .sum::<f64>()
        / (count - 1.0);
    Ok(Refinement {
        elements: 0.0,
        friction_coefficient: mean,
        scatter: variance.sqrt(),
        unknowns,
    })
}

/// Value and error from the last refinements: extrapolation over a factor of two in the spacing, and what that changes
/// against the previous refinement. Before there are three of them, the error is as large as the value.
fn extrapolate(refinements: &[Refinement], order: f64) -> [f64; 2] {
    let friction: Vec<f64> = refinements
        .iter()
        .map(|refinement| refinement.friction_coefficient)
        .collect();
    let from = |fine: f64, coarse: f64| fine + (fine - coarse) / (order.exp2() - 1.0);
    match friction[..] {
        [.., d, c, b, a] => {
            let [value, before] = [from(a, c), from(b, d)];
            [value, (value - before).abs() + 0.25 * (value - a).abs()]
        }
        [.., c, _, a] => [from(a, c), (from(a, c) - a).abs()],
        [.., a] => [a, a],
        [] => [0.0, f64::MAX],
    }
}

/// Checks that a relative error or tolerance lies between 0 and 1.
fn below_one(parameter: &'static str, value: f64) -> Result<f64, BemError> {
    if value > 0.0 && value < 1.0 {
        return Ok(value);
    }
    Err(BemError::InvalidParameter {
        parameter,
        value,
        allowed: "between 0 and 1",
    })
}
