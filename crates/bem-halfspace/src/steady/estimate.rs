//! Friction to a requested error.
//!
//! The outline of the contact follows the elements. On one grid that scatters the friction around its trend, so each
//! refinement averages over four grids that are shifted by half an element along x and y. The averages converge with
//! the order 3/2, as the singular front edge does, or 2p − 1 where the apex h ∼ r^p is slower, and are extrapolated.
//! On materials that recover the outline is closed behind, and what is left of the scatter decides: it widens the error
//! bar.

use indenters::{Axisymmetric, SlidingLoad, Surface, contact_radius};
use rheology::Material;

use crate::error::{below_one, positive};
use crate::steady::contact_scale::depth_scale_of_body;
use crate::steady::extrapolation::{Limit, extrapolate};
use crate::steady::loading::Loading;
use crate::steady::{Reuse, SinkingDepth, SteadyOptions, SteadySliding, solve};
use crate::{BemError, Footprint};

/// Elements along the contact length of the one-dimensional model on the coarsest grids; every refinement has √2 times
/// as many.
const COARSEST: f64 = 5.0;
/// Refinements at most; the limit of unknowns ends most ladders before.
const MAX_REFINEMENTS: i32 = 24;
/// Shifts of the grid along x and y that keep the mirror symmetry in y.
const PHASES: [[f64; 2]; 4] = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];
/// Order of the error that the singular front leaves.
const FRONT_ORDER: f64 = 1.5;
/// Contact sets tried on one grid.
const MAX_ITERATIONS: usize = 100;
/// At the edge of a contact elements may change sides for ever. Grids that are so much finer are as good, and help.
const OTHER_GRIDS: [f64; 2] = [0.99, 0.98];
/// Gaps left on one grid, relative to the error asked for as a part of the mean slope, and what rounding allows.
const GAP_SHARE: f64 = 1e-4;
const SMALLEST_GAP: f64 = 1e-12;
/// Friction as a part of the mean slope on the first grid, where it is not known yet, on materials that recover.
const FIRST_PART: f64 = 1e-3;
/// Friction that is known to this part of the mean slope counts as known: what is left of an elastic body is rounding.
const ROUNDING: f64 = 1e-9;

/// What is asked of the friction coefficient, and how much work may be spent on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionOptions {
    /// Relative error asked for.
    pub relative_error: f64,
    /// Δy/Δx. The outline of the contact is steeper across the sliding direction than along it.
    pub aspect: f64,
    /// Refinement stops before a grid that will have more unknown pressures than this, judged by the grid before it, or
    /// by the contact length where a body is too steep for the grids so far.
    pub max_unknowns: usize,
}

impl Default for FrictionOptions {
    /// A relative error of 1e-3, elements half as wide as long, and at most 40 000 unknowns, which take some seconds.
    fn default() -> Self {
        Self {
            relative_error: 1e-3,
            aspect: 0.5,
            max_unknowns: 40_000,
        }
    }
}

/// Where the refinements of a surface begin, and how they converge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ladder {
    /// Where contact may occur.
    pub footprint: Footprint,
    /// Δx of the coarsest grids, \[m]: about a fifth of the length of the contact.
    pub coarsest_spacing: f64,
    /// p of the sharpest point h ∼ r^p in contact; 2 or more for a smooth surface.
    pub apex_exponent: f64,
}

/// One refinement: the average over shifted grids.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Refinement {
    /// Δx, \[m].
    pub spacing: f64,
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
    /// Depth on the last grid.
    pub depth: SinkingDepth,
    /// The refinements that led there, from coarse to fine.
    pub refinements: Vec<Refinement>,
}

impl FrictionEstimate {
    /// Friction coefficient of each refinement.
    fn sequence(refinements: &[Refinement]) -> Vec<f64> {
        refinements
            .iter()
            .map(|refinement| refinement.friction_coefficient)
            .collect()
    }
}

impl Ladder {
    /// The refinements for a body of revolution.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] and [`BemError::Indenter`] when the body has no radius that could be found for
    /// this load.
    pub fn of_body(
        body: &(impl Axisymmetric + ?Sized),
        material: &(impl Material + ?Sized),
        load: &SlidingLoad,
    ) -> Result<Self, BemError> {
        let contact_length = contact_radius(body, depth_scale_of_body(body, material, load)?)?;
        Ok(Self {
            footprint: Footprint::of_body(body, material, load)?,
            coarsest_spacing: contact_length / COARSEST,
            apex_exponent: body.apex_exponent(),
        })
    }

    /// Order of the error of the averages.
    fn order(&self) -> Result<f64, BemError> {
        let order = (2.0 * self.apex_exponent - 1.0).min(FRONT_ORDER);
        if order > 0.0 {
            return Ok(order);
        }
        // The friction of the apex alone is infinite, as in the one-dimensional model.
        Err(BemError::InvalidParameter {
            parameter: "apex exponent",
            value: self.apex_exponent,
            allowed: "above 1/2",
        })
    }

    fn spacing(&self, refinement: i32) -> f64 {
        self.coarsest_spacing * 2.0_f64.powf(-0.5 * f64::from(refinement))
    }

    /// The footprint with room for elements at its boundary, where a steep body leaves none.
    fn footprint(&self, spacing: f64) -> Footprint {
        let widened = |[first, last]: [f64; 2]| [first - 2.0 * spacing, last + 2.0 * spacing];
        Footprint {
            x: widened(self.footprint.x),
            y: widened(self.footprint.y),
        }
    }
}

/// Computes the stationary friction coefficient of a body of revolution to a relative error.
///
/// # Errors
/// Those of [`Ladder::of_body`] and [`steady_friction_of_surface`].
pub fn steady_friction(
    body: &impl Axisymmetric,
    material: &(impl Material + ?Sized),
    load: &SlidingLoad,
    options: &FrictionOptions,
) -> Result<FrictionEstimate, BemError> {
    below_one("relative_error", options.relative_error)?;
    let ladder = Ladder::of_body(body, material, load)?;
    steady_friction_of_surface(body, (material, load), &ladder, options)
}

/// Computes the stationary friction coefficient of any surface to a relative error.
///
/// # Errors
/// [`BemError::FrictionNotReached`] with what was reached on the finest grid allowed;
/// [`BemError::InvalidParameter`] for a relative error that is not between 0 and 1 or an apex as sharp as √r, whose
/// friction is infinite; and the errors of [`steady`](crate::steady::steady()).
pub fn steady_friction_of_surface(
    surface: &impl Surface,
    (material, load): (&(impl Material + ?Sized), &SlidingLoad),
    ladder: &Ladder,
    options: &FrictionOptions,
) -> Result<FrictionEstimate, BemError> {
    let relative_error = below_one("relative_error", options.relative_error)?;
    positive("aspect", options.aspect)?;
    let order = ladder.order()?;
    let loading = Loading::force(surface, (material, load), &ladder.footprint)?;
    let mut refinements: Vec<Refinement> = Vec::new();
    let mut reuse = Reuse::default();
    let mut reached = Limit::NONE;
    for index in 0..MAX_REFINEMENTS {
        let spacing = ladder.spacing(index);
        match refine(surface, &loading, (ladder, spacing), options, &mut reuse) {
            // A steep body needs a finer grid to begin with.
            Err(BemError::SlopeNotResolved { .. } | BemError::GridTooCoarse { .. })
                if refinements.is_empty()
                    && about_unknowns(ladder, index + 1, options.aspect)
                        <= options.max_unknowns as f64 =>
            {
                continue;
            }
            refinement => refinements.push(refinement?),
        }
        reached = extrapolate(&FrictionEstimate::sequence(&refinements), order);
        if let (false, Some(last)) = (loading.creep.only_flows(), refinements.last()) {
            reached.error += last.scatter;
        }
        if let Some(last) = &reuse.solution {
            let rounding = ROUNDING * last.mean_slope;
            if reached.holds(relative_error) || reached.error <= rounding {
                return Ok(FrictionEstimate {
                    friction_coefficient: reached.value,
                    error: reached.error + error_of_gaps(last),
                    depth: last.depth,
                    refinements,
                });
            }
        }
        // The next refinement has twice as many unknowns.
        if refinements
            .last()
            .is_some_and(|refinement| 2 * refinement.unknowns > options.max_unknowns)
        {
            break;
        }
    }
    Err(BemError::FrictionNotReached {
        friction_coefficient: reached.value,
        error: reached.error,
        relative_error,
    })
}

/// About the number of unknown pressures of a refinement, before any has been solved.
///
/// Half of the contact of a body of revolution is about as wide as that of the one-dimensional model is long; other
/// contacts are taken to be as slender as the footprint.
fn about_unknowns(ladder: &Ladder, refinement: i32, aspect: f64) -> f64 {
    let [length, width] = [ladder.footprint.x, ladder.footprint.y].map(|[a, b]| b - a);
    COARSEST * COARSEST * 2.0_f64.powi(refinement) * (width / length / aspect)
}

/// The average over the shifts, each started from the contact of the one before.
fn refine(
    surface: &impl Surface,
    loading: &Loading,
    (ladder, spacing): (&Ladder, f64),
    options: &FrictionOptions,
    reuse: &mut Reuse,
) -> Result<Refinement, BemError> {
    let mut friction = [0.0; PHASES.len()];
    let mut unknowns = 0;
    for (friction, phase) in friction.iter_mut().zip(PHASES) {
        let options = SteadyOptions {
            spacing: [spacing, options.aspect * spacing],
            phase,
            footprint: ladder.footprint(spacing),
            tolerance: tolerance(options.relative_error, loading, reuse.solution.as_ref()),
            max_iterations: MAX_ITERATIONS,
        };
        let solution = solve_near(surface, loading, &options, reuse)?;
        *friction = solution.friction_coefficient;
        unknowns = unknowns.max(solution.unknowns);
        reuse.solution = Some(solution);
    }
    let [friction_coefficient, scatter] = mean_and_deviation(&friction);
    Ok(Refinement {
        spacing,
        friction_coefficient,
        scatter,
        unknowns,
    })
}

/// The solution on a grid, or on one that hardly differs where no contact set is found.
fn solve_near(
    surface: &impl Surface,
    loading: &Loading,
    options: &SteadyOptions,
    reuse: &mut Reuse,
) -> Result<SteadySliding, BemError> {
    let mut solution = solve(surface, loading, options, reuse);
    for finer in OTHER_GRIDS {
        if !matches!(solution, Err(BemError::ContactNotConverged { .. })) {
            break;
        }
        let other = SteadyOptions {
            spacing: options.spacing.map(|edge| finer * edge),
            ..*options
        };
        solution = solve(surface, loading, &other, reuse);
    }
    solution
}

/// Gaps that disturb the friction less than is asked: where it is a small difference of large slopes, they are smaller.
fn tolerance(relative_error: f64, loading: &Loading, last: Option<&SteadySliding>) -> f64 {
    let part = match last {
        Some(last) => last.friction_coefficient.abs() / last.mean_slope,
        None if loading.creep.only_flows() => 1.0,
        None => FIRST_PART,
    };
    (GAP_SHARE * relative_error * part).max(SMALLEST_GAP)
}

/// What the gaps that are left may change.
fn error_of_gaps(last: &SteadySliding) -> f64 {
    if last.friction_coefficient < last.mean_slope {
        last.residual * last.mean_slope
    } else {
        0.0
    }
}

fn mean_and_deviation(values: &[f64]) -> [f64; 2] {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares = values.iter().map(|value| (value - mean).powi(2));
    [mean, (squares.sum::<f64>() / (count - 1.0)).sqrt()]
}
