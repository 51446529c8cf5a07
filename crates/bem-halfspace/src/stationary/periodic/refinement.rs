//! Refinement of one periodic surface, with error bars from the last three grids.
//!
//! Theory: docs/theory/stationary-half-space.md, "Periodic surfaces"; how often the bars hold is in docs/theory/rough-surfaces.md.

use std::borrow::Cow;

use indenters::rough::PeriodicSurface;
use numerics::{
    Estimate, Level, LevelForecast, NotReached, Request, SUMMATION_ERROR, between_zero_and_one,
    in_range, refine_levels,
};

use crate::elements::grid::MAX_ELEMENTS;
use crate::estimate::bars::reached_or_error;
use crate::stationary::COARSE_GRID_TOLERANCE;
use crate::stationary::periodic::grid_sizes::{FINEST_OVER_COARSEST, MAX_USUAL_GRID, first_shape};
use crate::stationary::periodic::subgrid_gaps::SubgridGapBound;
use crate::stationary::periodic::{PeriodicControl, PeriodicEstimate, check_surface};
use crate::{BemError, Grid, Reached};

/// Assumed convergence of the stationary friction, from slopes or from dissipation. The error bar is the last change, or 0.15 of the
/// change before it if the last one is small by chance.
///
/// Chosen on rough contacts, whose active set jumps from grid to grid; docs/theory/rough-surfaces.md has how often the bars hold.
pub(super) const FRICTION_RATE: ConvergenceRate = ConvergenceRate {
    safety: 1.0,
    min_reduction: 0.15,
    expected_reduction: 0.25,
};
/// Assumed convergence of the stationary area, as [`FRICTION_RATE`] with 0.3 in place of 0.15 of the change before the last one.
/// Chosen on rough contacts; docs/theory/rough-surfaces.md has how often the bars hold.
pub(super) const AREA_RATE: ConvergenceRate = ConvergenceRate {
    min_reduction: 0.3,
    ..FRICTION_RATE
};
/// Assumed convergence of all other quantities. Chosen as the first order, so that changes halve and the error equals the last
/// change; the safety factor of 2 doubles it.
pub(super) const FIRST_ORDER_RATE: ConvergenceRate = ConvergenceRate {
    safety: 2.0,
    min_reduction: 0.5,
    expected_reduction: 0.5,
};
/// Smallest ratio of the error bar of the mean friction to the difference of the frictions from slopes and from dissipation. It
/// applies if the friction from slopes has the smaller bar. Chosen (case of `evidence tuning`).
///
/// Of 1135 results the worst erred by 4.2 bars without this bound, and by 2.6 bars with it.
const MIN_ERROR_OVER_DIFFERENCE: f64 = 0.25;
/// Number of the shortest waves along both edges of the period below which a surface has few contacts to average over. The bar of its
/// friction is then at least [`ERROR_OVER_DIFFERENCE_OF_FEW_WAVES`] of the difference of both frictions. Measured: of 150 surfaces with 4 and
/// 6 waves 134 were within their bars without it and 149 with it, with 1.1 times the work; with 8 and more waves it takes up to five times
/// the work, and bars hold without it.
const FEW_WAVES: usize = 8;
/// Smallest ratio of the error bar of the mean friction to the difference of both frictions for few waves. Derived: both are within the bar
/// of a mean with equal weights. With other weights the smaller bar may be small by chance.
const ERROR_OVER_DIFFERENCE_OF_FEW_WAVES: f64 = 0.5;
/// Smallest number of elements in contact, on the coarsest grid of an error estimate, for bars to hold. With fewer, the active
/// set decides the friction, and two grids may agree by chance. Chosen; from 0 to 30 no digit of an answer changes (case of
/// `evidence tuning`).
pub(crate) const MIN_CONTACT_ELEMENTS: usize = 30;
/// Largest product of the number of elements and the number of steps of a march, about half an hour of one thread. Chosen to
/// limit the time: a larger march fails with [`BemError::GridTooLarge`].
const MAX_ELEMENT_STEPS: f64 = 2e9;

/// Assumed convergence of a quantity from grid to grid.
#[derive(Clone, Copy)]
pub(super) struct ConvergenceRate {
    /// Factor from the change to the error bar.
    safety: f64,
    /// Smallest ratio of the last change to the change before it that an error bar uses.
    min_reduction: f64,
    /// Expected ratio of the errors on two successive grids, for the forecast of the work.
    expected_reduction: f64,
}

/// Accuracy asked for, control, and assumed convergence.
pub(super) struct RefinementGoal<'w> {
    /// Accuracy asked for, and the receiver of the progress.
    pub(super) request: Request<'w>,
    /// Prescribed mean pressure or depth.
    pub(super) control: PeriodicControl,
    /// Assumed convergence of the friction.
    pub(super) friction: ConvergenceRate,
    /// Assumed convergence of the area.
    pub(super) area: ConvergenceRate,
    /// Steps of a march per row of the grid; `None` for a stationary state.
    pub(super) steps_per_row: Option<f64>,
}

/// Results on one grid.
pub(super) struct GridResult {
    /// Friction coefficient from slopes.
    pub(super) friction: f64,
    /// Friction coefficient from the dissipated power; `None` for a march.
    pub(super) from_dissipation: Option<f64>,
    /// Area fraction with the error of its perimeter correction.
    pub(super) area_fraction: Estimate,
    /// Number of elements in contact.
    pub(super) in_contact: usize,
    /// True if the grid resolves all waves of the surface.
    pub(super) has_all_waves: bool,
    /// Bounds of the effect of gaps between the centres of elements, if all elements are in contact.
    pub(super) subgrid_gaps: SubgridGapBound,
    /// Mean pressure, \[Pa].
    pub(super) mean_pressure: f64,
    /// Depth of the mean plane, \[m].
    pub(super) mean_depth: f64,
    /// Relative residual of the contact.
    pub(super) residual: f64,
}

/// A periodic surface sampled on one grid, with the waves that the grid resolves.
pub(super) struct SampledSurface {
    /// Grid of one period.
    pub(super) grid: Grid,
    /// Heights of the resolved modes at the centres of the elements, \[m].
    pub(super) heights: Vec<f64>,
    /// True if the grid resolves all waves of the surface.
    pub(super) has_all_waves: bool,
}

impl SampledSurface {
    /// Samples the waves of a surface that a grid of this `shape` resolves; fails if it resolves none.
    pub(super) fn new(surface: &PeriodicSurface, shape: [usize; 2]) -> Result<Self, BemError> {
        let spacing = [0, 1].map(|axis| surface.period()[axis] / shape[axis] as f64);
        let grid = Grid::new(shape, spacing)?;
        let resolved = surface.resolved_on(shape);
        let heights = resolved.as_deref().unwrap_or(surface).heights(shape)?;
        check_surface(&grid, &heights)?;
        Ok(Self {
            grid,
            heights,
            has_all_waves: matches!(resolved, Some(Cow::Borrowed(_))),
        })
    }
}

/// Solves on one grid after the other, each with twice the elements along both axes, until the error asked for is reached.
///
/// `solve` gets the surface on the grid, the tolerance of the contact, and a function that reports its progress. The grids do not
/// depend on the error asked for, so that a smaller error continues the sequence of a larger one.
pub(super) fn refine<S>(
    surface: &PeriodicSurface,
    goal: &RefinementGoal,
    mut solve: impl FnMut(&SampledSurface, f64, &dyn Fn(f64)) -> Result<(GridResult, S), BemError>,
) -> Result<PeriodicEstimate<S>, BemError>
where
    PeriodicEstimate<S>: Into<Reached>,
{
    let has_few_waves = surface.largest_numbers().into_iter().all(|n| n < FEW_WAVES);
    // Choose the shape of the first grid, and forecast the work of the first three, which an error bar needs.
    let asked = goal.request.accuracy.relative_error();
    if let Some(error) = asked {
        between_zero_and_one("relative_error", error)?;
    }
    let mut shape = first_shape(surface, &goal.request)?;
    goal.check_size(shape, FINEST_OVER_COARSEST as f64)?;
    let initial_work = goal.work_on(shape)
        + goal.work_on(shape.map(|n| 2 * n))
        + goal.work_on(shape.map(|n| 4 * n));
    let (mut results, mut tolerance) = (Vec::new(), COARSE_GRID_TOLERANCE);
    let finest = refine_levels(goal.request.watch, initial_work, |last, progress| {
        // Solve on the next grid. If that does not converge, the result is that of the coarser grids.
        let sampled = SampledSurface::new(surface, shape)?;
        let solved = progress.run(goal.work_on(shape), |tell| solve(&sampled, tolerance, tell));
        let failed = matches!(solved, Err(BemError::ContactNotConverged { .. }));
        if let Some(last) = last.filter(|_| failed) {
            let remaining_work = None;
            return Ok(Some(Level {
                remaining_work,
                ..last
            }));
        }
        let (result, state) = solved?;
        results.push(result);
        shape = shape.map(|n| 2 * n);
        tolerance *= 0.5;
        let Some(found) = goal.estimate(&results, has_few_waves, state) else {
            return Ok(None);
        };

        // End if the next grid is too large, or cannot be expected to reach the error.
        let missed = asked.and_then(|asked| found.missed(asked, shape[0].max(shape[1]) / 2));
        let unfinished = missed.filter(|missed| goal.may_refine_to(shape, missed.error_ratio()));
        if let Some(missed) = unfinished {
            goal.check_march(missed.error_ratio(), shape)?;
        }
        let remaining_work = unfinished.map(|missed| goal.forecast(shape).remaining_work(&missed));
        Ok::<_, BemError>(Some(Level {
            found,
            missed,
            remaining_work,
        }))
    })?;
    reached_or_error(finest.missed, |index| TARGETS[index], finest.found)
}

impl RefinementGoal<'_> {
    /// Work on a grid of a shape, in elements, or in elements times steps of a march.
    fn work_on(&self, shape: [usize; 2]) -> f64 {
        let [rows, columns] = shape.map(|n| n as f64);
        rows * columns * self.steps_per_row.map_or(1.0, |steps| steps * rows)
    }

    /// Forecast of work and error on the grids from this shape on, if the friction converges as expected.
    fn forecast(&self, shape: [usize; 2]) -> LevelForecast {
        LevelForecast {
            work: self.work_on(shape),
            work_ratio: self.steps_per_row.map_or(4.0, |_| 8.0),
            error_ratio: self.friction.expected_reduction,
            max_levels: f64::INFINITY,
        }
    }

    /// Fails with [`BemError::GridTooLarge`] if a grid with `factor` times the elements of a shape along both axes is too large.
    fn check_size(&self, shape: [usize; 2], factor: f64) -> Result<(), BemError> {
        let [rows, columns] = shape.map(|n| n as f64);
        let elements = factor.powi(2) * rows * columns;
        let limit = match self.steps_per_row {
            None => MAX_ELEMENTS,
            Some(steps) => MAX_USUAL_GRID.min(MAX_ELEMENT_STEPS / (steps * factor * rows)),
        };
        if elements <= limit {
            return Ok(());
        }
        Err(BemError::GridTooLarge { elements, limit })
    }

    /// True if a grid beyond the first three is allowed while the error is too large by the factor `excess`. A large grid is allowed
    /// only if it or the next one can be expected to reach the error.
    fn may_refine_to(&self, shape: [usize; 2], excess: f64) -> bool {
        let is_usual = (shape[0] * shape[1]) as f64 <= MAX_USUAL_GRID;
        let may_reach = is_usual || excess <= self.friction.expected_reduction.powi(-2);
        may_reach
            && self.check_size(shape, 1.0).is_ok()
            && self.request.watch.may_refine(shape[0].max(shape[1]))
    }

    /// Fails if a march that reaches the error, too large by the factor `excess`, would take too long even at the second order,
    /// which no error exceeds.
    fn check_march(&self, excess: f64, shape: [usize; 2]) -> Result<(), BemError> {
        if self.steps_per_row.is_none() {
            return Ok(());
        }
        let factor = 0.5 * excess.sqrt().log2().ceil().max(1.0).exp2();
        self.check_size(shape, factor)
    }

    /// The results on the finest grid with error bars from the last three; `None` with fewer grids.
    fn estimate<S>(
        &self,
        grids: &[GridResult],
        has_few_waves: bool,
        finest: S,
    ) -> Option<PeriodicEstimate<S>> {
        let [.., coarse, middle, fine] = grids else {
            return None;
        };
        // The error of a quantity follows from its changes on the last two refinements, and from the residual of the solver.
        let with_error = |quantity: &dyn Fn(&GridResult) -> f64, rate: ConvergenceRate| {
            let [coarse, middle, value] = [coarse, middle, fine].map(quantity);
            let previous_change = (middle - coarse).abs();
            let change = (value - middle)
                .abs()
                .max(rate.min_reduction * previous_change);
            let solver_error = fine.residual + SUMMATION_ERROR;
            Estimate::new(value, rate.safety * change + solver_error * value.abs())
        };

        // Both frictions are the same quantity, so that the bars are widened until they meet. Without dissipation there is
        // nothing to compare.
        let mut slopes = with_error(&|found| found.friction, self.friction);
        let dissipated = |found: &GridResult| found.from_dissipation.unwrap_or(f64::NAN);
        let mut dissipation = fine
            .from_dissipation
            .map(|_| with_error(&dissipated, self.friction));
        if let Some(dissipation) = &mut dissipation
            && dissipation.value > 0.0
        {
            let difference = (slopes.value - dissipation.value).abs();
            let missing = (difference - slopes.error - dissipation.error).max(0.0);
            slopes = slopes.widened(missing);
            *dissipation = dissipation.widened(missing);
        }
        let friction =
            dissipation.map_or(slopes, |other| weighted_mean(slopes, other, has_few_waves));

        // Newly resolved waves reduce the area more than finer elements do. If the coarsest grid lacks waves, the earlier change
        // does not count.
        let mut area_rate = self.area;
        if !coarse.has_all_waves {
            area_rate.min_reduction = 0.0;
        }
        let area = with_error(&|found| found.area_fraction.value, area_rate);

        // Widen the bars by the bounds of sub-grid gaps, except that of the prescribed quantity. With few elements in contact the
        // active set decides the values, so that the bars reach to 0.
        let gaps = fine.subgrid_gaps;
        let reach = f64::from(u8::from(coarse.in_contact < MIN_CONTACT_ELEMENTS));
        let widened =
            |known: Estimate, gap: f64| known.widened(gap).widened(reach * known.value.abs());
        let pressure = with_error(&|found| found.mean_pressure, FIRST_ORDER_RATE);
        let depth = with_error(&|found| found.mean_depth, FIRST_ORDER_RATE);
        let (mean_pressure, mean_depth) = match self.control {
            PeriodicControl::MeanPressure(given) => {
                (Estimate::exact(given), depth.widened(gaps.mean_depth))
            }
            PeriodicControl::MeanDepth(given) => {
                (pressure.widened(gaps.mean_pressure), Estimate::exact(given))
            }
        };
        Some(PeriodicEstimate {
            friction_coefficient: widened(friction, gaps.friction),
            friction_from_dissipation: dissipation.map(|known| widened(known, gaps.friction)),
            area_fraction: widened(area.widened(fine.area_fraction.error), gaps.area_fraction),
            mean_pressure,
            mean_depth,
            finest,
        })
    }
}

/// The mean of both frictions, whose errors have different causes, weighted by the inverse of their bars.
///
/// If one bar is much smaller, the mean is nearly that friction; if both are equal, the bar of the mean is half of them. A negative
/// friction from slopes is ignored.
fn weighted_mean(slopes: Estimate, dissipation: Estimate, has_few_waves: bool) -> Estimate {
    if slopes.value < 0.0 || dissipation.error == 0.0 {
        return dissipation;
    }
    let weight = dissipation.error / (slopes.error + dissipation.error);
    let difference = slopes.value - dissipation.value;
    // Two grids agree by chance in the slopes more often than in the power, which is the more accurate one in nearly elastic contacts.
    let smallest_ratio = match slopes.error < dissipation.error {
        _ if has_few_waves => ERROR_OVER_DIFFERENCE_OF_FEW_WAVES,
        true => MIN_ERROR_OVER_DIFFERENCE,
        false => 0.0,
    };
    let floor = smallest_ratio * difference.abs();
    Estimate::new(
        dissipation.value + weight * difference,
        (weight * slopes.error).max(floor),
    )
}

/// Names of the quantities whose relative error is asked for, with their units.
const TARGETS: [&str; 3] = [
    "friction coefficient",
    "area fraction",
    "mean pressure [Pa]",
];

impl<S> PeriodicEstimate<S> {
    /// The quantity of [`TARGETS`] whose relative error exceeds `relative_error`, on a grid with a number of `elements`; `None` if
    /// there is none. It is the friction, or the area without friction, or the mean pressure if its relative error is larger.
    fn missed(&self, relative_error: f64, elements: usize) -> Option<NotReached> {
        let (friction, pressure) = (self.friction_coefficient, self.mean_pressure);
        let has_friction = friction.value != 0.0;
        let contact = if has_friction {
            friction
        } else {
            self.area_fraction
        };
        if pressure.relative_error() > contact.relative_error() {
            return NotReached::unless_within(relative_error, 2, pressure, elements);
        }
        NotReached::unless_within(
            relative_error,
            usize::from(!has_friction),
            contact,
            elements,
        )
    }
}

/// Largest relative difference of two periods that count as equal. Chosen above the rounding 5e-10 of numbers of ten digits in a
/// file; it only decides whether a surface is refused.
const PERIOD_TOLERANCE: f64 = 1e-9;

/// Refuses a surface whose periods are not those of the grid.
pub(crate) fn check_periods(surface: &PeriodicSurface, grid: &Grid) -> Result<(), BemError> {
    let edges = grid.shape().into_iter().zip(grid.spacing());
    for (period, (edge, spacing)) in surface.period().into_iter().zip(edges) {
        let own = edge as f64 * spacing;
        let is_own = (period - own).abs() <= PERIOD_TOLERANCE * own;
        in_range("period", period, is_own, "that of the grid")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use indenters::rough::Wave;
    use numerics::Accuracy;

    use super::*;
    use crate::{GapField, PeriodicTransient, PressureField};

    fn found((friction, dissipated): (f64, f64)) -> GridResult {
        GridResult {
            friction,
            from_dissipation: Some(dissipated),
            area_fraction: Estimate::exact(0.05),
            in_contact: 100,
            has_all_waves: true,
            subgrid_gaps: SubgridGapBound::default(),
            mean_pressure: 1.0,
            mean_depth: 0.0,
            residual: 1e-7,
        }
    }

    fn goal() -> RefinementGoal<'static> {
        RefinementGoal {
            request: Accuracy::RelativeError(0.01).into(),
            control: PeriodicControl::MeanPressure(1.0),
            friction: FRICTION_RATE,
            area: AREA_RATE,
            steps_per_row: None,
        }
    }

    /// Slopes and dissipation on three grids, and what follows.
    fn bars_of(frictions: [(f64, f64); 3]) -> PeriodicEstimate<()> {
        let estimate = goal().estimate(&frictions.map(found), false, ());
        estimate.expect("three grids")
    }

    /// Dissipation that agrees on three grids by chance, and is not the friction: the slopes are within the bar for few waves.
    #[test]
    fn both_frictions_are_within_the_bar_for_few_waves() {
        let grids = [(1.16, 1.0), (1.04, 1.0), (1.01, 1.0)].map(found);
        let estimate = goal().estimate(&grids, true, ()).expect("three grids");
        let friction = estimate.friction_coefficient;
        assert!((friction.error - 0.005).abs() < 1e-5, "{friction:?}");
    }

    /// What coarser grids know, with its error, where the contact of a finer one is not found.
    #[test]
    fn a_contact_that_is_not_found_leaves_what_was_reached() {
        let wave = Wave {
            numbers: [1, 0],
            amplitude: 1e-3,
            phase: 0.0,
        };
        let surface = PeriodicSurface::new([1.0; 2], vec![wave]).expect("a surface");
        let mut frictions = [(1.3, 1.3), (1.1, 1.1), (1.0, 1.0)].into_iter();
        let refined = refine(&surface, &goal(), |sampled, tolerance, _| {
            let pressure = PressureField {
                grid: sampled.grid,
                origin: [0.0; 2],
                pressure: Vec::new(),
            };
            let gap = GapField {
                grid: sampled.grid,
                origin: [0.0; 2],
                gap: Vec::new(),
            };
            let rows = Vec::new();
            let lost = BemError::ContactNotConverged {
                iterations: 1,
                residual: 1.0,
                tolerance,
            };
            let known = frictions.next().ok_or(lost)?;
            let state = PeriodicTransient {
                rows,
                pressure,
                gap,
            };
            Ok((found(known), state))
        });
        let Err(BemError::NotReached { value, error, .. }) = refined else {
            panic!("{refined:?}");
        };
        assert!((value - 1.0).abs() <= error, "{value} ± {error}");
    }

    /// Frictions that both changed little and yet differ: on a finer grid they are 0.0592.
    #[test]
    fn the_bars_of_both_frictions_reach_each_other() {
        let bars = bars_of([
            (0.059_064, 0.059_039),
            (0.058_969, 0.059_598),
            (0.058_847, 0.059_891),
        ]);
        let friction = bars.friction_coefficient;
        let dissipated = bars.friction_from_dissipation.expect("both frictions");
        let apart = (friction.value - dissipated.value).abs();
        let reach = (friction.error + dissipated.error) * (1.0 + 1e-12);
        assert!(apart <= reach, "{friction:?}, {dissipated:?}");
        assert!(
            (friction.value - 0.0592).abs() <= friction.error,
            "{friction:?}"
        );
    }

    #[test]
    fn opposite_errors_leave_their_mean_and_a_sharp_friction_stays() {
        let opposite = bars_of([(1.16, 0.84), (1.04, 0.96), (1.01, 0.99)]).friction_coefficient;
        assert!((opposite.value - 1.0).abs() < 1e-7, "{opposite:?}");
        assert!((opposite.error - 0.015).abs() < 1e-5, "{opposite:?}");
        let sharp = bars_of([(1.16, 1.0), (1.04, 1.0), (1.01, 1.0)]).friction_coefficient;
        assert!((sharp.value - 1.0).abs() < 1e-5, "{sharp:?}");
        assert!(sharp.error < 1e-5, "{sharp:?}");
        let slopes = bars_of([(1.0, 1.16), (1.0, 1.04), (1.0, 1.01)]).friction_coefficient;
        assert!((slopes.error - 0.0025).abs() < 1e-5, "{slopes:?}");
    }
}
