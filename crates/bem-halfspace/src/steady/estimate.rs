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
use crate::steady::loading::{DepthControl, Loading};
use crate::steady::{Reuse, SinkingDepth, SteadyOptions, SteadySliding, solve};
use crate::{BemError, Footprint};

/// Elements along the contact length of the one-dimensional model on the coarsest grids; every refinement has √2 times
/// as many.
const COARSEST: f64 = 5.0;
/// Height that is left of a steep flank one element further in, at least, on the coarsest grids.
const RESOLVED: f64 = 0.3;
/// Refinements at most; the limit of unknowns ends most ladders before.
const MAX_REFINEMENTS: i32 = 24;
/// Shifts of the grid along x and y that keep the mirror symmetry in y; the first of them along x only.
const PHASES: [[f64; 2]; 4] = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];
const PHASES_OF_STRIP: usize = 2;
/// Order of the error that the singular front leaves.
const FRONT_ORDER: f64 = 1.5;
/// Refinements of which an error bar can come, at least.
const FEWEST: i32 = 5;
/// Elements of the footprint for each unknown pressure that is allowed: a steep body touches with a thin crescent.
const ELEMENTS_PER_UNKNOWN: f64 = 50.0;
/// Elements that hardly cost anything.
const ALWAYS_ALLOWED: f64 = 1e5;
/// Contact sets tried on one grid.
const MAX_ITERATIONS: usize = 100;
/// At the edge of a contact elements may change sides for ever. Grids that are so much finer are as good, and help.
const OTHER_GRIDS: [f64; 2] = [0.99, 0.98];
/// Gaps left on one grid, relative to the error asked for as a part of the mean slope, and what rounding allows.
const GAP_SHARE: f64 = 1e-4;
const SMALLEST_GAP: f64 = 1e-12;
/// The same part under a strip: the potential of its whole length, which is absorbed in the depth, leaves more rounding.
const GAP_SHARE_OF_STRIP: f64 = 1e-2;
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
    /// whose footprint has more than 50 times as many elements, and more than 1e5.
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
    /// Normal force, averaged over the shifts, \[N].
    pub normal_force: f64,
    /// Standard deviation of the normal force over the shifts, \[N].
    pub force_scatter: f64,
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
    /// The part of it that comes from the gaps that the solver leaves in the contact.
    pub gap_error: f64,
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// Estimated absolute error of the normal force, 0 where it is given, \[N].
    pub normal_force_error: f64,
    /// Depth on the last grid.
    pub depth: SinkingDepth,
    /// The refinements that led there, from coarse to fine.
    pub refinements: Vec<Refinement>,
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
        let depth = depth_scale_of_body(body, material, load)?;
        Self::on(body, Footprint::of_body(body, material, load)?, depth)
    }

    /// The refinements for a body of revolution at a depth of its lowest point, \[m].
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] and [`BemError::Indenter`] when the body has no radius that could be found for
    /// this depth.
    pub fn of_body_at_depth(
        body: &(impl Axisymmetric + ?Sized),
        depth: f64,
    ) -> Result<Self, BemError> {
        Self::on(body, Footprint::of_body_at_depth(body, depth)?, depth)
    }

    fn on(
        body: &(impl Axisymmetric + ?Sized),
        footprint: Footprint,
        depth: f64,
    ) -> Result<Self, BemError> {
        let mut ladder = Self {
            footprint,
            coarsest_spacing: contact_radius(body, depth)? / COARSEST,
            apex_exponent: body.profile_exponent(),
        };
        // Where a steep flank is as long as an element, elements stand for nothing, and their contact is hard to find.
        let [_, radius] = ladder.footprint.x;
        let flank_is_resolved = |refinement: &i32| {
            let inside = (radius - ladder.spacing(*refinement)).max(0.0);
            body.profile_height(inside) >= RESOLVED * body.profile_height(radius)
        };
        if let Some(first) = (0..MAX_REFINEMENTS).find(flank_is_resolved) {
            ladder.coarsest_spacing = ladder.spacing(first);
        }
        Ok(ladder)
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
    body: &(impl Axisymmetric + Surface),
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
/// [`BemError::GridTooLarge`] where a body is so steep that no error bar can come of the grids allowed;
/// [`BemError::InvalidParameter`] for a relative error that is not between 0 and 1 or an apex as sharp as √r, whose
/// friction is infinite; and the errors of [`steady`](crate::steady::steady()).
pub fn steady_friction_of_surface(
    surface: &impl Surface,
    (material, load): (&(impl Material + ?Sized), &SlidingLoad),
    ladder: &Ladder,
    options: &FrictionOptions,
) -> Result<FrictionEstimate, BemError> {
    let loading = Loading::force(surface, (material, load), &ladder.footprint)?;
    climb(surface, loading, ladder, options)
}

/// Computes the stationary friction coefficient and the normal force of any surface at a depth, both to a relative error.
///
/// # Errors
/// Those of [`steady_friction_of_surface`]; [`BemError::ForceNotReached`]; and [`BemError::InvalidParameter`] for a
/// depth, a speed or a sliding distance out of range.
pub fn steady_friction_at_depth(
    surface: &impl Surface,
    (material, control): (&(impl Material + ?Sized), &DepthControl),
    ladder: &Ladder,
    options: &FrictionOptions,
) -> Result<FrictionEstimate, BemError> {
    let [rear, front] = ladder.footprint.x;
    let loading = Loading::depth(material, control, front - rear)?;
    climb(surface, loading, ladder, options)
}

pub(super) fn climb(
    surface: &impl Surface,
    loading: Loading,
    ladder: &Ladder,
    options: &FrictionOptions,
) -> Result<FrictionEstimate, BemError> {
    let relative_error = below_one("relative_error", options.relative_error)?;
    positive("aspect", options.aspect)?;
    let order = ladder.order()?;
    let question = Question {
        surface,
        loading,
        ladder,
        options,
    };
    let mut reuse = Reuse::default();
    let (mut index, first) = question.coarsest(&mut reuse)?;
    let mut refinements = vec![first];
    loop {
        let friction = question.friction(&refinements, order);
        let force = question.force(&refinements, order);
        if let Some(last) = &reuse.solution {
            let rounding = ROUNDING * last.mean_slope;
            let is_known = friction.holds(relative_error) || friction.error <= rounding;
            if is_known && force.holds(relative_error) {
                let gap_error = error_of_gaps(last);
                return Ok(FrictionEstimate {
                    friction_coefficient: friction.value,
                    error: friction.error + gap_error,
                    gap_error,
                    normal_force: force.value,
                    normal_force_error: force.error,
                    depth: last.depth,
                    refinements,
                });
            }
        }
        index += 1;
        if refinements
            .last()
            .is_some_and(|last| !question.allows(index, last))
        {
            return Err(not_reached(friction, force, relative_error));
        }
        refinements.push(question.refine(index, &mut reuse)?);
    }
}

fn not_reached(friction: Limit, force: Limit, relative_error: f64) -> BemError {
    if force.holds(relative_error) {
        return BemError::FrictionNotReached {
            friction_coefficient: friction.value,
            error: friction.error,
            relative_error,
        };
    }
    BemError::ForceNotReached {
        normal_force: force.value,
        error: force.error,
        relative_error,
    }
}

/// What is asked of the ladder.
struct Question<'a, S> {
    surface: &'a S,
    loading: Loading,
    ladder: &'a Ladder,
    options: &'a FrictionOptions,
}

impl<S: Surface> Question<'_, S> {
    /// What the friction coefficients lead to.
    fn friction(&self, refinements: &[Refinement], order: f64) -> Limit {
        let values: Vec<f64> = refinements.iter().map(|r| r.friction_coefficient).collect();
        let mut limit = extrapolate(&values, order);
        if let (false, Some(last)) = (self.loading.creep.only_flows(), refinements.last()) {
            limit.error += last.scatter;
        }
        limit
    }

    /// The normal force that is given, or what those at the depth lead to.
    fn force(&self, refinements: &[Refinement], order: f64) -> Limit {
        if let Some(value) = self.loading.given_force() {
            return Limit { value, error: 0.0 };
        }
        let values: Vec<f64> = refinements.iter().map(|r| r.normal_force).collect();
        let mut limit = extrapolate(&values, order);
        if let Some(last) = refinements.last() {
            limit.error += last.force_scatter;
        }
        limit
    }

    /// The coarsest refinement on which the body is resolved, if enough of those that follow are within the limits.
    fn coarsest(&self, reuse: &mut Reuse) -> Result<(i32, Refinement), BemError> {
        let mut index = 0;
        loop {
            let elements = self.n_elements(index + FEWEST - 1);
            if elements > self.most_elements() {
                return Err(BemError::GridTooLarge {
                    elements,
                    limit: self.most_elements(),
                });
            }
            match self.refine(index, reuse) {
                Err(BemError::SlopeNotResolved { .. } | BemError::GridTooCoarse { .. }) => {
                    index += 1;
                }
                refinement => return Ok((index, refinement?)),
            }
        }
    }

    /// Whether a refinement is within the limits; it has twice as many unknowns as the one before.
    fn allows(&self, refinement: i32, before: &Refinement) -> bool {
        refinement < MAX_REFINEMENTS
            && self.n_elements(refinement) <= self.most_elements()
            && 2 * before.unknowns <= self.options.max_unknowns
    }

    /// Elements of the footprint.
    fn n_elements(&self, refinement: i32) -> f64 {
        let Footprint { x, y } = self.ladder.footprint;
        let [dx, dy] = self.edges(refinement);
        (x[1] - x[0]) / dx * ((y[1] - y[0]) / dy)
    }

    /// Edges of an element.
    fn edges(&self, refinement: i32) -> [f64; 2] {
        let dx = self.ladder.spacing(refinement);
        let strip = self.loading.strip();
        [dx, strip.unwrap_or(self.options.aspect * dx)]
    }

    fn phases(&self) -> &'static [[f64; 2]] {
        match self.loading.strip() {
            Some(_) => &PHASES[..PHASES_OF_STRIP],
            None => &PHASES,
        }
    }

    fn most_elements(&self) -> f64 {
        (ELEMENTS_PER_UNKNOWN * self.options.max_unknowns as f64).max(ALWAYS_ALLOWED)
    }

    /// The average over the shifts, each started from the contact of the one before.
    fn refine(&self, index: i32, reuse: &mut Reuse) -> Result<Refinement, BemError> {
        let edges = self.edges(index);
        let [spacing, _] = edges;
        let (mut friction, mut force) = (Vec::new(), Vec::new());
        let mut unknowns = 0;
        for &phase in self.phases() {
            let options = SteadyOptions {
                spacing: edges,
                phase,
                footprint: self.ladder.footprint(spacing),
                tolerance: self.tolerance(reuse.solution.as_ref()),
                max_iterations: MAX_ITERATIONS,
            };
            let solution = self.solve_near(&options, reuse)?;
            friction.push(solution.friction_coefficient);
            force.push(solution.normal_force);
            unknowns = unknowns.max(solution.unknowns);
            reuse.solution = Some(solution);
        }
        let [friction_coefficient, scatter] = mean_and_deviation(&friction);
        let [normal_force, force_scatter] = mean_and_deviation(&force);
        Ok(Refinement {
            spacing,
            friction_coefficient,
            scatter,
            normal_force,
            force_scatter,
            unknowns,
        })
    }

    /// The solution on a grid, or on one that hardly differs where no contact set is found.
    fn solve_near(
        &self,
        options: &SteadyOptions,
        reuse: &mut Reuse,
    ) -> Result<SteadySliding, BemError> {
        let mut solution = solve(self.surface, &self.loading, (options, None), reuse);
        for finer in OTHER_GRIDS {
            if !matches!(solution, Err(BemError::ContactNotConverged { .. })) {
                break;
            }
            let other = SteadyOptions {
                spacing: self.loading.scaled(options.spacing, finer),
                ..*options
            };
            solution = solve(self.surface, &self.loading, (&other, None), reuse);
        }
        solution
    }

    /// Gaps that disturb the friction less than is asked: where it is a small difference of large slopes, they are
    /// smaller.
    fn tolerance(&self, last: Option<&SteadySliding>) -> f64 {
        let part = match last {
            Some(last) => last.friction_coefficient.abs() / last.mean_slope,
            None if self.loading.creep.only_flows() => 1.0,
            None => FIRST_PART,
        };
        let share = match self.loading.strip() {
            Some(_) => GAP_SHARE_OF_STRIP,
            None => GAP_SHARE,
        };
        (share * self.options.relative_error * part).max(SMALLEST_GAP)
    }
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
