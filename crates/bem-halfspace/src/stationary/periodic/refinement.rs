//! Finer and finer grids of one periodic surface, and the error bars from the last three.

use std::borrow::Cow;

use indenters::rough::PeriodicSurface;
use numerics::{Accuracy, Estimate, Request, WorkProgress, between_zero_and_one};

use crate::stationary::periodic::equations::{
    BASIS_FLOATS_PER_ELEMENT_ON_SMALL_GRID, MAX_BASIS_FLOATS_ON_SMALL_GRID,
};
use crate::stationary::periodic::subgrid_gaps::SubgridGapBound;
use crate::stationary::periodic::{PeriodicControl, PeriodicEstimate, check_surface};
use crate::transform::fast_length::fast_length;
use crate::{BemError, Grid, Reached};

/// Elements per shortest wave along an axis on the first grid, and fewest elements along an edge that is not level.
const FIRST: usize = 4;
const FEWEST: usize = 32;
/// Where three grids from there on have more elements than this, the first has one per shortest wave instead, in a fast multiple of
/// this many, and only the waves that it tells; docs/rough-surfaces.md says how well the bars hold on four elements per wave.
const USUAL_GRID: f64 = 4_194_304.0;
const MULTIPLE: usize = 8;
/// The error of each stationary friction, and of the area, is at most what the last refinement changed, or a part of what the one
/// before did, which counts where the last one changed little by chance; that of all others twice as much, at the first order. The
/// factor is for which elements touch, which jumps from grid to grid: docs/rough-surfaces.md says how often bars hold.
pub(super) const FRICTION_RATE: ConvergenceRate = ConvergenceRate {
    safety: 1.0,
    min_reduction: 0.15,
    expected_reduction: 0.25,
};
pub(super) const AREA_RATE: ConvergenceRate = ConvergenceRate {
    min_reduction: 0.3,
    ..FRICTION_RATE
};
pub(super) const FIRST_ORDER_RATE: ConvergenceRate = ConvergenceRate {
    safety: 2.0,
    min_reduction: 0.5,
    expected_reduction: 0.5,
};
/// The least error of a friction that is mostly that from slopes, as a part of what both are apart: of 1135 results the worst
/// erred by 4.2 bars without it, and by 2.6 with it.
const PART_OF_DIFFERENCE: f64 = 0.25;
/// Fewest elements in contact on the coarsest of the three grids of which the bars are made: with fewer, their number may jump
/// to the same one, and the friction with it.
const FEWEST_IN_CONTACT: usize = 30;
/// Tolerance of the contact on the first grid, which is halved on each of the next, whatever error is asked for; ten residuals are
/// added to the bars.
pub(super) const FIRST_TOLERANCE: f64 = 1e-5;
const RESIDUALS: f64 = 10.0;
/// Rounding of what is known in closed form.
const ROUNDING: f64 = 1e-12;
/// Elements times steps of a march that are not exceeded: about half an hour of one thread.
const MOST_STEPS: f64 = 2e9;

/// Elements of the largest grid at all, and memory that one of them takes at most, \[bytes].
const LARGEST_GRID: f64 = 268_435_456.0;
const BYTES_PER_ELEMENT: f64 = 186.0;
/// What directions take besides, so much for each element; no less than elimination may take, and no more than is kept on a small
/// grid, \[bytes].
const BYTES_OF_FEW: f64 = (size_of::<f32>() * BASIS_FLOATS_PER_ELEMENT_ON_SMALL_GRID) as f64;
const BYTES_BESIDE: [f64; 2] = [
    33_554_432.0,
    (size_of::<f32>() * MAX_BASIS_FLOATS_ON_SMALL_GRID) as f64,
];
/// The bars are made of three grids, of which the last has so many times the elements of the first along an edge.
const THREE_GRIDS: usize = 4;

/// How an error falls from grid to grid.
#[derive(Clone, Copy)]
pub(super) struct ConvergenceRate {
    safety: f64,
    /// Part of a change that the next one is at least.
    min_reduction: f64,
    /// Part of an error that the next grid leaves as a rule.
    expected_reduction: f64,
}

/// What is asked, and how errors fall.
pub(super) struct RefinementGoal<'w> {
    pub(super) request: Request<'w>,
    pub(super) control: PeriodicControl,
    pub(super) friction: ConvergenceRate,
    pub(super) area: ConvergenceRate,
    /// Steps of a march for each row of the grid.
    pub(super) steps_per_row: Option<f64>,
}

/// What is known from one grid.
pub(super) struct GridResult {
    pub(super) friction: f64,
    pub(super) from_dissipation: Option<f64>,
    /// With what its outline leaves unknown.
    pub(super) area_fraction: Estimate,
    /// Number of elements.
    pub(super) in_contact: usize,
    /// Whether the grid tells all waves of the surface.
    pub(super) has_all_waves: bool,
    /// What is between elements that are all in contact.
    pub(super) subgrid_gaps: SubgridGapBound,
    pub(super) mean_pressure: f64,
    pub(super) mean_depth: f64,
    /// Of the contact.
    pub(super) residual: f64,
}

/// The shape of the first grid.
pub(super) fn first_shape(
    surface: &PeriodicSurface,
    request: &Request,
) -> Result<[usize; 2], BemError> {
    let usual = surface.largest_numbers().map(first_elements);
    let along = |first: [usize; 2]| THREE_GRIDS * first[0].max(first[1]);
    let fits = match request.accuracy {
        Accuracy::RelativeError(_) => {
            last_elements(usual) <= USUAL_GRID && request.watch.may_refine(along(usual))
        }
        Accuracy::Elements(elements) => elements >= along(usual),
    };
    let first = if fits { usual } else { coarsest(surface) };
    let Accuracy::Elements(elements) = request.accuracy else {
        return Ok(first);
    };
    let needed = along(first);
    if elements < needed {
        return Err(BemError::PeriodTooCoarse { elements, needed });
    }
    // In proportion; what is too large to be multiplied is too large for a grid.
    Ok(first.map(|edge| edge.saturating_mul(elements).div_ceil(needed)))
}

fn first_elements(number: usize) -> usize {
    match number {
        0 => 2,
        _ => (FIRST * number).next_power_of_two().max(FEWEST),
    }
}

/// The first grid whose double tells all waves, or that double where it has no wave itself.
fn coarsest(surface: &PeriodicSurface) -> [usize; 2] {
    let first = surface.largest_numbers().map(|number| match number {
        0 => 2,
        _ => (MULTIPLE * fast_length((number + 1).div_ceil(MULTIPLE))).max(FEWEST),
    });
    match surface.told_by(first) {
        Some(_) => first,
        None => first.map(|edge| 2 * edge),
    }
}

/// Elements of the last of the three grids without which there are no error bars.
pub fn elements_for_bars(surface: &PeriodicSurface) -> f64 {
    last_elements(coarsest(surface))
}

/// Elements of a grid without which no surface with waves of these largest numbers along x and y is solved.
pub fn fewest_elements(largest_numbers: [usize; 2]) -> f64 {
    last_elements(largest_numbers.map(|number| number.max(1)))
}

fn last_elements(first: [usize; 2]) -> f64 {
    let edges = first.map(|edge| (THREE_GRIDS * edge) as f64);
    edges[0] * edges[1]
}

/// Elements of the largest grid that a memory \[bytes] allows; without it of the largest one at all.
pub fn largest_grid(memory: Option<f64>) -> f64 {
    memory.map_or(LARGEST_GRID, |bytes| {
        let beside = BYTES_BESIDE.map(|beside| (bytes - beside) / BYTES_PER_ELEMENT);
        let all = bytes / (BYTES_PER_ELEMENT + BYTES_OF_FEW);
        all.max(beside[1])
            .min(beside[0])
            .floor()
            .clamp(0.0, LARGEST_GRID)
    })
}

/// Memory that a grid of so many elements takes at most, \[bytes].
fn bytes_on(elements: f64) -> f64 {
    let beside = (BYTES_OF_FEW * elements).clamp(BYTES_BESIDE[0], BYTES_BESIDE[1]);
    beside + BYTES_PER_ELEMENT * elements
}

/// Memory that [`steady`](super::steady), [`indent`](super::indent) and [`slide`](super::slide) take at most on a grid with so
/// many elements along the edge that has more of them, \[bytes].
///
/// # Errors
/// [`BemError::PeriodTooCoarse`].
pub fn memory(surface: &PeriodicSurface, elements: usize) -> Result<f64, BemError> {
    let first = first_shape(surface, &Accuracy::Elements(elements).into())?;
    Ok(bytes_on(last_elements(first)))
}

/// A surface on one of the grids.
pub(super) struct SampledSurface {
    pub(super) grid: Grid,
    /// Of the waves that the grid tells, at the centres of its elements, \[m].
    pub(super) heights: Vec<f64>,
    has_all_waves: bool,
}

impl SampledSurface {
    pub(super) fn of(surface: &PeriodicSurface, shape: [usize; 2]) -> Result<Self, BemError> {
        let spacing = [0, 1].map(|axis| surface.period()[axis] / shape[axis] as f64);
        let grid = Grid::new(shape, spacing)?;
        let told = surface.told_by(shape);
        let heights = told.as_deref().unwrap_or(surface).heights(shape)?;
        check_surface(&grid, &heights)?;
        Ok(Self {
            grid,
            heights,
            has_all_waves: matches!(told, Some(Cow::Borrowed(_))),
        })
    }
}

/// Solves on one grid after the other, each with twice the elements along both axes, to a tolerance of the contact; `solve` is told
/// the grid, its heights, the tolerance, and what is to be told of its progress. The grids do not depend on the error asked for, so
/// that a smaller one is answered by what follows on the answer to a larger one.
pub(super) fn refine<S>(
    surface: &PeriodicSurface,
    goal: &RefinementGoal,
    mut solve: impl FnMut(&Grid, &[f64], f64, &dyn Fn(f64)) -> Result<(GridResult, S), BemError>,
) -> Result<PeriodicEstimate<S>, BemError>
where
    PeriodicEstimate<S>: Into<Reached>,
{
    let asked = match goal.request.accuracy {
        Accuracy::RelativeError(error) => Some(between_zero_and_one("relative_error", error)?),
        Accuracy::Elements(_) => None,
    };
    let mut shape = first_shape(surface, &goal.request)?;
    goal.check_size(shape, THREE_GRIDS as f64)?;
    let first = goal.work_on(shape);
    let all = first + goal.work_on(shape.map(|n| 2 * n)) + goal.work_on(shape.map(|n| 4 * n));
    let mut progress = WorkProgress::new(goal.request.watch, all);
    let (mut grids, mut tolerance) = (Vec::new(), FIRST_TOLERANCE);
    let mut best: Option<(TargetEstimate, PeriodicEstimate<S>)> = None;
    loop {
        let SampledSurface {
            grid,
            heights,
            has_all_waves,
        } = SampledSurface::of(surface, shape)?;
        let solved = progress.run(goal.work_on(shape), |tell| {
            solve(&grid, &heights, tolerance, tell)
        });
        let is_lost = matches!(solved, Err(BemError::ContactNotConverged { .. }));
        if let Some(((known, bars), asked)) = best.take_if(|_| is_lost).zip(asked) {
            return Err(known.missed(asked, bars.into()));
        }
        let (found, state) = solved?;
        grids.push(GridResult {
            has_all_waves,
            ..found
        });
        let finer = shape.map(|n| 2 * n);
        if let Some(bars) = goal.bars(&grids, state) {
            let known = bars.asked();
            let Some(missed) = asked.filter(|asked| !known.estimate.is_within(*asked)) else {
                return Ok(bars);
            };
            let better =
                |(best, _): &(TargetEstimate, _)| best.relative_error() <= known.relative_error();
            if !best.as_ref().is_some_and(better) {
                best = Some((known, bars));
            }
            let excess = known.relative_error() / missed;
            if let Some((known, bars)) = best.take_if(|_| !goal.may_go_on(finer, excess)) {
                return Err(known.missed(missed, bars.into()));
            }
            goal.check_march(excess, finer)?;
            progress.set_remaining_work(goal.work_after(excess, finer));
        }
        shape = finer;
        tolerance *= 0.5;
    }
}

/// What the relative error is of.
#[derive(Clone, Copy)]
struct TargetEstimate {
    quantity: &'static str,
    estimate: Estimate,
}

impl TargetEstimate {
    fn relative_error(&self) -> f64 {
        self.estimate.error / self.estimate.value.abs()
    }

    fn missed(self, relative_error: f64, reached: Reached) -> BemError {
        BemError::NotReached {
            quantity: self.quantity,
            value: self.estimate.value,
            error: self.estimate.error,
            relative_error,
            reached: Box::new(reached),
        }
    }
}

impl RefinementGoal<'_> {
    /// Elements, or elements times steps.
    fn work_on(&self, shape: [usize; 2]) -> f64 {
        let [rows, columns] = shape.map(|n| n as f64);
        rows * columns * self.steps_per_row.map_or(1.0, |steps| steps * rows)
    }

    /// Of the grids from this one on that are needed if the error is too large by a factor and falls as it is assumed to.
    fn work_after(&self, excess: f64, shape: [usize; 2]) -> f64 {
        let grids = (excess.log2() / -self.friction.expected_reduction.log2())
            .ceil()
            .max(1.0);
        let growth: f64 = if self.steps_per_row.is_some() {
            8.0
        } else {
            4.0
        };
        self.work_on(shape) * (growth.powf(grids) - 1.0) / (growth - 1.0)
    }

    /// Refuses a grid that is finer by a factor and too large.
    fn check_size(&self, shape: [usize; 2], finer: f64) -> Result<(), BemError> {
        let [rows, columns] = shape.map(|n| n as f64);
        let elements = finer.powi(2) * rows * columns;
        let limit = match self.steps_per_row {
            None => LARGEST_GRID,
            Some(steps) => USUAL_GRID.min(MOST_STEPS / (steps * finer * rows)),
        };
        if elements <= limit {
            return Ok(());
        }
        Err(BemError::GridTooLarge { elements, limit })
    }

    /// Whether a grid that is finer than needed for bars may be begun, where the error is too large by a factor: a large one only if
    /// that and the next may be fine enough.
    fn may_go_on(&self, shape: [usize; 2], excess: f64) -> bool {
        let is_usual = (shape[0] * shape[1]) as f64 <= USUAL_GRID;
        let may_reach = is_usual || excess <= self.friction.expected_reduction.powi(-2);
        may_reach
            && self.check_size(shape, 1.0).is_ok()
            && self.request.watch.may_refine(shape[0].max(shape[1]))
    }

    /// Half an hour is not spent on a march in vain: no error falls faster than with the second order.
    fn check_march(&self, excess: f64, shape: [usize; 2]) -> Result<(), BemError> {
        if self.steps_per_row.is_none() {
            return Ok(());
        }
        let finer = 0.5 * excess.sqrt().log2().ceil().max(1.0).exp2();
        self.check_size(shape, finer)
    }

    /// From three grids or more.
    fn bars<S>(&self, grids: &[GridResult], finest: S) -> Option<PeriodicEstimate<S>> {
        let [.., coarse, middle, fine] = grids else {
            return None;
        };
        let of = |quantity: &dyn Fn(&GridResult) -> f64,
                  ConvergenceRate {
                      safety,
                      min_reduction,
                      ..
                  }: ConvergenceRate| {
            let [coarse, middle, value] = [coarse, middle, fine].map(quantity);
            let change = (value - middle)
                .abs()
                .max(min_reduction * (middle - coarse).abs());
            let solved = RESIDUALS * fine.residual + ROUNDING;
            Estimate::new(value, safety * change + solved * value.abs())
        };
        let mut slopes = of(&|found| found.friction, self.friction);
        let dissipated = |found: &GridResult| found.from_dissipation.unwrap_or(f64::NAN);
        let mut dissipation = fine
            .from_dissipation
            .map(|_| of(&dissipated, self.friction));
        if let Some(dissipation) = &mut dissipation
            && dissipation.value > 0.0
        {
            // Both are the same friction; without loss there is none.
            let apart = (slopes.value - dissipation.value).abs();
            let missing = (apart - slopes.error - dissipation.error).max(0.0);
            slopes = slopes.widened(missing);
            *dissipation = dissipation.widened(missing);
        }
        // Shorter waves make a contact smaller by more than finer elements do.
        let min_reduction = if coarse.has_all_waves {
            self.area.min_reduction
        } else {
            0.0
        };
        let area = of(
            &|found| found.area_fraction.value,
            ConvergenceRate {
                min_reduction,
                ..self.area
            },
        );
        let bars = PeriodicEstimate {
            friction_coefficient: dissipation.map_or(slopes, |other| mean_of(slopes, other)),
            friction_from_dissipation: dissipation,
            area_fraction: area.widened(fine.area_fraction.error),
            mean_pressure: match self.control {
                PeriodicControl::MeanPressure(pressure) => Estimate::exact(pressure),
                PeriodicControl::MeanDepth(_) => of(&|found| found.mean_pressure, FIRST_ORDER_RATE),
            },
            mean_depth: match self.control {
                PeriodicControl::MeanPressure(_) => of(&|found| found.mean_depth, FIRST_ORDER_RATE),
                PeriodicControl::MeanDepth(depth) => Estimate::exact(depth),
            },
            finest,
        };
        let bars = bars.with_gaps(fine.subgrid_gaps, self.control);
        let is_resolved = coarse.in_contact >= FEWEST_IN_CONTACT;
        Some(if is_resolved { bars } else { bars.unresolved() })
    }
}

/// The mean of two frictions that err by different things, each with the weight of the inverse of its bar: where one of them is
/// much sharper, that one, and where both are alike, with half their bar. A friction below 0 says nothing.
fn mean_of(slopes: Estimate, dissipation: Estimate) -> Estimate {
    if slopes.value < 0.0 || dissipation.error == 0.0 {
        return dissipation;
    }
    let part = dissipation.error / (slopes.error + dissipation.error);
    let apart = slopes.value - dissipation.value;
    // Slopes change little by chance more often than the power, which is the better one of a contact that is nearly elastic.
    let least = if slopes.error < dissipation.error {
        PART_OF_DIFFERENCE * apart.abs()
    } else {
        0.0
    };
    Estimate::new(
        dissipation.value + part * apart,
        (part * slopes.error).max(least),
    )
}

impl<S> PeriodicEstimate<S> {
    /// With bars that reach to 0, because so few elements touch that which of them do decides the values.
    fn unresolved(mut self) -> Self {
        let friction = self.friction_from_dissipation.as_mut();
        let known = [&mut self.friction_coefficient, &mut self.area_fraction];
        for known in known.into_iter().chain(friction) {
            *known = known.widened(known.value.abs());
        }
        self
    }

    /// With bars that reach to what gaps between elements may change; what is given keeps none.
    fn with_gaps(mut self, subgrid_gaps: SubgridGapBound, control: PeriodicControl) -> Self {
        let (found, change) = match control {
            PeriodicControl::MeanPressure(_) => (&mut self.mean_depth, subgrid_gaps.mean_depth),
            PeriodicControl::MeanDepth(_) => (&mut self.mean_pressure, subgrid_gaps.mean_pressure),
        };
        *found = found.widened(change);
        let friction = self.friction_from_dissipation.as_mut();
        for friction in friction.into_iter().chain([&mut self.friction_coefficient]) {
            *friction = friction.widened(subgrid_gaps.friction);
        }
        self.area_fraction = self.area_fraction.widened(subgrid_gaps.area_fraction);
        self
    }

    /// What the relative error is of.
    fn asked(&self) -> TargetEstimate {
        let first = if self.friction_coefficient.value == 0.0 {
            ("area fraction", self.area_fraction)
        } else {
            ("friction coefficient", self.friction_coefficient)
        };
        let relative = |known: Estimate| known.error / known.value.abs();
        let (quantity, estimate) = if relative(self.mean_pressure) > relative(first.1) {
            ("mean pressure [Pa]", self.mean_pressure)
        } else {
            first
        };
        TargetEstimate { quantity, estimate }
    }
}

#[cfg(test)]
mod tests {
    use indenters::rough::Wave;

    use super::*;
    use crate::{PeriodicTransient, PressureField};

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
        let bars = goal().bars(&frictions.map(found), ());
        bars.expect("three grids")
    }

    /// The memory of the largest grid that fits is no more than is allowed, and that of the next one is.
    #[test]
    fn the_largest_grid_is_the_one_that_fits() {
        for bytes in [4e7, 5e7, 6e7, 7e7, 7.83e7, 1e8, 1e9] {
            let elements = largest_grid(Some(bytes));
            assert!(bytes_on(elements) <= bytes, "{bytes} bytes, {elements}");
            assert!(
                bytes_on(elements + 1.0) > bytes,
                "{bytes} bytes, {elements}"
            );
        }
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
        let refined = refine(&surface, &goal(), |grid, _, tolerance, _| {
            let pressure = PressureField {
                grid: *grid,
                origin: [0.0; 2],
                pressure: Vec::new(),
            };
            let rows = Vec::new();
            let lost = BemError::ContactNotConverged {
                iterations: 1,
                residual: 1.0,
                tolerance,
            };
            let known = frictions.next().ok_or(lost)?;
            Ok((found(known), PeriodicTransient { rows, pressure }))
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
