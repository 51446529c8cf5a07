//! Sliding of a sum of waves with error bars, from finer and finer grids of the same surface.

use std::cell::RefCell;

use indenters::rough::PeriodicSurface;
use numerics::{Estimate, between_zero_and_one, not_negative, positive};

use crate::periodic::depth::{at_depth, check_depth};
use crate::periodic::kernel::Sliding;
use crate::periodic::march::{Way, slide_along};
use crate::periodic::search::Problem;
use crate::periodic::{
    PeriodicLoad, PeriodicOptions, PeriodicSliding, PeriodicTransient, check_surface, solve_from,
};
use crate::{BemError, ContactOptions, Elastomer, Grid, PressureField, Reached};

/// Elements per shortest wave along an axis on the first grid, and fewest elements along an edge that is not level.
const FIRST: usize = 4;
const FEWEST: usize = 32;
/// The error of the stationary friction is at most what the last refinement changed, or what the one before leaves of its
/// change at the second order; that of all others twice as much, at the first order. The factor is for which elements
/// touch, which jumps from grid to grid: of 160 random surfaces, loads and solids two frictions and eight areas erred by
/// more.
const FRICTION: Fall = Fall {
    safety: 1.0,
    left: 0.25,
};
const OTHERS: Fall = Fall {
    safety: 2.0,
    left: 0.5,
};
/// Fewest elements in contact on the coarsest of the three grids of which the bars are made: with fewer, their number may jump
/// to the same one, and the friction with it.
const FEWEST_IN_CONTACT: usize = 30;
/// Fewest steps of a march on the first grid.
const FEWEST_STEPS: f64 = 4.0;
/// Tolerance of the contact on the first grid, which is halved on each of the next, whatever error is asked for; ten residuals are
/// added to the bars.
const TOLERANCE: f64 = 1e-5;
const RESIDUALS: f64 = 10.0;
/// Rounding of what is known in closed form.
const ROUNDING: f64 = 1e-12;
/// Tolerance of a depth that is given, as a part of the root mean square of the heights, over that of the contact.
const DEPTH_TOLERANCE: f64 = 3.0;
/// Elements times steps of a march that are not exceeded: about half an hour of one thread.
const MOST_STEPS: f64 = 2e9;

/// Sliding of a periodic surface, with error bars for the surface that is given: waves that it lacks may change everything.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct PeriodicEstimate<S> {
    /// Friction coefficient; of a stationary state from slopes or from the dissipated power, whichever the last refinement
    /// changed less. Each bar reaches to that of the other.
    pub friction_coefficient: Estimate,
    /// That of a stationary state from the dissipated power alone; none on the way there.
    pub friction_from_dissipation: Option<Estimate>,
    /// Part of the period in contact.
    pub area_fraction: Estimate,
    /// Mean pressure, \[Pa]; without an error where it is given.
    pub mean_pressure: Estimate,
    /// Depth of the mean plane, \[m]; without an error where it is given.
    pub mean_depth: Estimate,
    /// What was found on the finest grid.
    pub finest: S,
}

/// Solves the stationary sliding of a sum of waves to a relative error of the friction, and of the area where nothing rubs.
///
/// # Errors
/// [`BemError::NotReached`] with the best that was reached where grids of at most `max_elements` are too coarse, or the contact is
/// so small that they have too few elements in it;
/// [`BemError::GridTooLarge`] where not even three grids have so few; and those of
/// [`steady_periodic_on_grid`](crate::steady_periodic_on_grid).
pub fn steady_periodic(
    surface: &PeriodicSurface,
    elastomer: &(impl Elastomer + ?Sized),
    load: &PeriodicLoad,
    relative_error: f64,
    max_elements: usize,
) -> Result<PeriodicEstimate<PeriodicSliding>, BemError> {
    let sliding = Sliding::new(elastomer, load.velocity)?;
    let held = Held::Pressure(load.mean_pressure);
    let goal = Goal::stationary(held, relative_error, max_elements);
    solve(surface, &sliding, &goal)
}

/// Solves the stationary sliding of a sum of waves whose mean plane is held at a depth \[m], with a velocity ≥ 0 \[m/s], to a
/// relative error of the friction and of the mean pressure.
///
/// On a half space the depth is below the mean of the deformed surface, and hence between minus the height of the mean plane
/// above the lowest point, at touch, and 0, at which all gaps are closed under any pressure.
///
/// # Errors
/// [`BemError::InvalidParameter`] for a depth at which nothing touches, or all of a half space; and those of
/// [`steady_periodic`].
pub fn steady_periodic_at_depth(
    surface: &PeriodicSurface,
    elastomer: &(impl Elastomer + ?Sized),
    [mean_depth, velocity]: [f64; 2],
    relative_error: f64,
    max_elements: usize,
) -> Result<PeriodicEstimate<PeriodicSliding>, BemError> {
    let sliding = Sliding::new(elastomer, not_negative("velocity", velocity)?)?;
    let goal = Goal::stationary(Held::Depth(mean_depth), relative_error, max_elements);
    solve(surface, &sliding, &goal)
}

/// Presses a sum of waves into a material with a mean pressure > 0 \[Pa] that is held for a time > 0 \[s]: the area, to a
/// relative error, and the depth.
///
/// The contact grows everywhere, so that it is that of a spring of the compliance J(t) (Lee & Radok 1960); so is the pressure
/// of [`finest`](PeriodicEstimate::finest), which on a material that creeps is not its own.
///
/// # Errors
/// As of [`steady_periodic`].
pub fn press_periodic(
    surface: &PeriodicSurface,
    elastomer: &(impl Elastomer + ?Sized),
    [mean_pressure, time]: [f64; 2],
    relative_error: f64,
    max_elements: usize,
) -> Result<PeriodicEstimate<PeriodicSliding>, BemError> {
    let spring = Sliding::at_rest(elastomer, positive("time", time)?)?;
    let held = Held::Pressure(positive("mean_pressure", mean_pressure)?);
    let goal = Goal::stationary(held, relative_error, max_elements);
    solve(surface, &spring, &goal)
}

/// What is held constant.
#[derive(Clone, Copy)]
enum Held {
    Pressure(f64),
    Depth(f64),
}

fn solve(
    surface: &PeriodicSurface,
    sliding: &Sliding,
    goal: &Goal,
) -> Result<PeriodicEstimate<PeriodicSliding>, BemError> {
    let guess = RefCell::new(Vec::new());
    let mut pressure_before = None;
    refine(surface, goal, |grid, heights, tolerance| {
        let under = |mean_pressure| {
            let problem = Problem {
                sliding,
                grid,
                heights,
                mean_pressure,
                tolerance,
                max_products: PeriodicOptions::default().max_products,
            };
            solve_from(&mut guess.borrow_mut(), problem)
        };
        let (mean_pressure, state, missed) = match goal.held {
            Held::Pressure(pressure) => (pressure, under(pressure)?, 0.0),
            Held::Depth(depth) => {
                let roughness = check_depth(depth, heights, sliding)?;
                let start = match pressure_before {
                    Some(pressure) => pressure,
                    None => sliding.pressure_of(surface.period()[0], roughness)?,
                };
                at_depth(
                    [depth, roughness, DEPTH_TOLERANCE * tolerance],
                    start,
                    under,
                )?
            }
        };
        pressure_before = Some(mean_pressure);
        let found = Found {
            friction: state.friction_coefficient,
            from_dissipation: Some(state.friction_from_dissipation),
            area_fraction: state.area_fraction,
            in_contact: in_contact(&state.pressure),
            mean_pressure,
            mean_depth: state.mean_depth,
            residual: state.residual.max(missed),
        };
        Ok((found, state))
    })
}

/// Slides a sum of waves from rest over a distance \[m], to a relative error of the friction at its end.
///
/// The error is of the first order in the edge of an element, and the work grows with its third power: less than some per
/// cent take long.
///
/// # Errors
/// Those of [`slide_periodic_on_grid`](crate::slide_periodic_on_grid) and, as of [`steady_periodic`], [`BemError::NotReached`] and
/// [`BemError::GridTooLarge`]: also where a march that is fine enough would take longer than about half an hour.
pub fn slide_periodic(
    surface: &PeriodicSurface,
    elastomer: &(impl Elastomer + ?Sized),
    (load, sliding_distance): (&PeriodicLoad, f64),
    relative_error: f64,
    max_elements: usize,
) -> Result<PeriodicEstimate<PeriodicTransient>, BemError> {
    let distance = positive("sliding distance", sliding_distance)?;
    let period = surface.period()[0];
    let edge = period / first_shape(surface)[0] as f64;
    let way = Way {
        distance,
        // The steps are halved with the elements, so that the bars see their errors too.
        steps_per_element: (FEWEST_STEPS * edge / distance).ceil(),
    };
    let held = Held::Pressure(load.mean_pressure);
    let goal = Goal {
        friction: OTHERS,
        steps_per_row: Some(distance / period * way.steps_per_element),
        ..Goal::stationary(held, relative_error, max_elements)
    };
    refine(surface, &goal, |grid, heights, tolerance| {
        let options = ContactOptions {
            tolerance,
            ..ContactOptions::default()
        };
        let state = slide_along(grid, heights, elastomer, (load, way), &options)?;
        let last = state.rows[state.rows.len() - 1];
        let found = Found {
            friction: last.friction_coefficient,
            from_dissipation: None,
            area_fraction: last.area_fraction,
            in_contact: in_contact(&state.pressure),
            mean_pressure: load.mean_pressure,
            mean_depth: last.mean_depth,
            residual: tolerance,
        };
        Ok((found, state))
    })
}

/// Number of elements in contact.
fn in_contact(field: &PressureField) -> usize {
    let pressures = field.pressure.iter();
    pressures.filter(|pressure| **pressure > 0.0).count()
}

/// How an error falls from grid to grid.
#[derive(Clone, Copy)]
struct Fall {
    safety: f64,
    /// Part of a change that the next one is at least.
    left: f64,
}

struct Goal {
    relative_error: f64,
    friction: Fall,
    max_elements: f64,
    held: Held,
    /// Steps of a march for each row of the grid.
    steps_per_row: Option<f64>,
}

/// What is known from one grid.
struct Found {
    friction: f64,
    from_dissipation: Option<f64>,
    area_fraction: f64,
    /// Number of elements.
    in_contact: usize,
    mean_pressure: f64,
    mean_depth: f64,
    /// Of the contact.
    residual: f64,
}

fn first_shape(surface: &PeriodicSurface) -> [usize; 2] {
    surface.largest_numbers().map(first_elements)
}

fn first_elements(number: usize) -> usize {
    match number {
        0 => 2,
        _ => (FIRST * number).next_power_of_two().max(FEWEST),
    }
}

/// Elements of the last of the three grids without which there are no error bars, of a surface with so many waves at most in
/// its periods along x and y.
pub fn elements_for_bars(largest_numbers: [usize; 2]) -> f64 {
    let edges = largest_numbers.map(|number| 4.0 * first_elements(number) as f64);
    edges[0] * edges[1]
}

/// Solves on one grid after the other, each with twice the elements along both axes, to a tolerance of the contact. The grids do not
/// depend on the error asked for, so that a smaller one is answered by what follows on the answer to a larger one.
fn refine<S>(
    surface: &PeriodicSurface,
    goal: &Goal,
    mut solve: impl FnMut(&Grid, &[f64], f64) -> Result<(Found, S), BemError>,
) -> Result<PeriodicEstimate<S>, BemError>
where
    PeriodicEstimate<S>: Into<Reached>,
{
    between_zero_and_one("relative_error", goal.relative_error)?;
    let mut shape = first_shape(surface);
    let (mut grids, mut tolerance) = (Vec::new(), TOLERANCE);
    let mut best: Option<(Known, PeriodicEstimate<S>)> = None;
    loop {
        if let Some(too_large) = goal.too_large(shape, 1.0) {
            return Err(match best {
                Some((known, bars)) => known.missed(goal.relative_error, bars.into()),
                None => too_large,
            });
        }
        goal.check_march(best.as_ref().map(|(known, _)| known), shape)?;
        let spacing = [0, 1].map(|axis| surface.period()[axis] / shape[axis] as f64);
        let (grid, heights) = (Grid::new(shape, spacing)?, surface.heights(shape)?);
        check_surface(&grid, &heights)?;
        let (found, state) = solve(&grid, &heights, tolerance)?;
        grids.push(found);
        if let Some(bars) = goal.bars(&grids, state) {
            let coarse = &grids[grids.len().saturating_sub(3)];
            let bars = if coarse.in_contact < FEWEST_IN_CONTACT {
                bars.unresolved()
            } else {
                bars
            };
            let known = bars.asked();
            if known.estimate.is_within(goal.relative_error) {
                return Ok(bars);
            }
            let better = |(best, _): &(Known, _)| best.relative_error() <= known.relative_error();
            if !best.as_ref().is_some_and(better) {
                best = Some((known, bars));
            }
        }
        shape = shape.map(|n| 2 * n);
        tolerance *= 0.5;
    }
}

/// What the relative error is of.
#[derive(Clone, Copy)]
struct Known {
    quantity: &'static str,
    estimate: Estimate,
}

impl Known {
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

impl Goal {
    const fn stationary(held: Held, relative_error: f64, max_elements: usize) -> Self {
        Self {
            relative_error,
            friction: FRICTION,
            max_elements: max_elements as f64,
            held,
            steps_per_row: None,
        }
    }

    /// Why a grid that is finer by a factor has no solution.
    fn too_large(&self, shape: [usize; 2], finer: f64) -> Option<BemError> {
        let [rows, columns] = shape.map(|n| n as f64);
        let elements = finer.powi(2) * rows * columns;
        let steps = self.steps_per_row.map_or(1.0, |steps| steps * finer * rows);
        let limit = self.max_elements.min(MOST_STEPS / steps);
        (elements > limit).then_some(BemError::GridTooLarge { elements, limit })
    }

    /// Half an hour is not spent on a march in vain: no error falls faster than with the second order.
    fn check_march(&self, best: Option<&Known>, shape: [usize; 2]) -> Result<(), BemError> {
        let (Some(best), Some(_)) = (best, self.steps_per_row) else {
            return Ok(());
        };
        let excess = best.relative_error() / self.relative_error;
        let finer = 0.5 * excess.sqrt().log2().ceil().max(1.0).exp2();
        self.too_large(shape, finer).map_or(Ok(()), Err)
    }

    /// From three grids or more.
    fn bars<S>(&self, grids: &[Found], finest: S) -> Option<PeriodicEstimate<S>> {
        let [.., coarse, middle, fine] = grids else {
            return None;
        };
        let of = |quantity: &dyn Fn(&Found) -> f64, Fall { safety, left }: Fall| {
            let [coarse, middle, value] = [coarse, middle, fine].map(quantity);
            let change = (value - middle).abs().max(left * (middle - coarse).abs());
            let solved = RESIDUALS * fine.residual + ROUNDING;
            Estimate::new(value, safety * change + solved * value.abs())
        };
        let mut slopes = of(&|found| found.friction, self.friction);
        let dissipated = |found: &Found| found.from_dissipation.unwrap_or(f64::NAN);
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
        let is_better =
            |dissipation: &Estimate| dissipation.error <= slopes.error || slopes.value < 0.0;
        let better = dissipation.filter(is_better);
        Some(PeriodicEstimate {
            friction_coefficient: better.unwrap_or(slopes),
            friction_from_dissipation: dissipation,
            area_fraction: of(&|found| found.area_fraction, OTHERS),
            mean_pressure: match self.held {
                Held::Pressure(pressure) => Estimate::exact(pressure),
                Held::Depth(_) => of(&|found| found.mean_pressure, OTHERS),
            },
            mean_depth: match self.held {
                Held::Pressure(_) => of(&|found| found.mean_depth, OTHERS),
                Held::Depth(depth) => Estimate::exact(depth),
            },
            finest,
        })
    }
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

    /// What the relative error is of.
    fn asked(&self) -> Known {
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
        Known { quantity, estimate }
    }
}

#[cfg(test)]
mod tests {
    use super::{Found, Goal, Held};

    /// Frictions that both changed little and yet differ: on a finer grid they are 0.0592.
    #[test]
    fn the_bars_of_both_frictions_reach_each_other() {
        let found = |(friction, dissipated)| Found {
            friction,
            from_dissipation: Some(dissipated),
            area_fraction: 0.05,
            in_contact: 100,
            mean_pressure: 1.0,
            mean_depth: 0.0,
            residual: 1e-7,
        };
        let frictions = [
            (0.059_064, 0.059_039),
            (0.058_969, 0.059_598),
            (0.058_847, 0.059_891),
        ];
        let goal = Goal::stationary(Held::Pressure(1.0), 0.01, 1000);
        let bars = goal.bars(&frictions.map(found), ()).expect("three grids");
        let slopes = bars.friction_coefficient;
        let dissipated = bars.friction_from_dissipation.expect("both frictions");
        let apart = (slopes.value - dissipated.value).abs();
        let reach = (slopes.error + dissipated.error) * (1.0 + 1e-12);
        assert!(apart <= reach, "{slopes:?}, {dissipated:?}");
        assert!((slopes.value - 0.0592).abs() <= slopes.error, "{slopes:?}");
    }
}
