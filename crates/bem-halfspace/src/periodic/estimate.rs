//! Sliding of a sum of waves with error bars, from finer and finer grids of the same surface.

use std::cell::RefCell;

use indenters::rough::PeriodicSurface;
use numerics::{
    Estimate, between_zero_and_one, in_range, not_negative, positive, try_bracketed_root,
};

use crate::grid::elements_along;
use crate::periodic::kernel::Sliding;
use crate::periodic::search::Problem;
use crate::periodic::{
    PeriodicLoad, PeriodicOptions, PeriodicSliding, PeriodicTransient, check_surface,
    slide_periodic_on_grid, solve_from,
};
use crate::{BemError, ContactOptions, Elastomer, Grid};

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
/// Tolerance of the contact, as a part of the relative error asked for and at most; ten residuals are added to the bars.
const TOLERANCE: f64 = 1e-3;
const LARGEST_TOLERANCE: f64 = 1e-5;
const RESIDUALS: f64 = 10.0;
/// Rounding of what is known in closed form.
const ROUNDING: f64 = 1e-12;
/// Tolerance of a depth that is given, as a part of the root mean square of the heights, over that of the contact.
const DEPTH_TOLERANCE: f64 = 3.0;
/// Steps of the logarithm of the pressure until the depth lies between two of them, and the longest of them.
const MOST_STEPS_OF_PRESSURE: usize = 200;
const LONGEST_STEP: f64 = 4.0;
/// Elements times steps of a march that are not exceeded: about half an hour of one thread.
const MOST_STEPS: f64 = 2e9;

/// Sliding of a periodic surface, with error bars for the surface that is given: waves that it lacks may change everything.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct PeriodicEstimate<S> {
    /// Friction coefficient; of a stationary state from slopes or from the dissipated power, whichever the last refinement
    /// changed less.
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
/// [`BemError::NotReached`] with what was reached where grids of at most `max_elements` are too coarse;
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
    let tolerance = goal.tolerance();
    let guess = RefCell::new(Vec::new());
    let mut pressure_before = None;
    refine(surface, goal, |grid, heights| {
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
            mean_pressure,
            mean_depth: state.mean_depth,
            residual: state.residual.max(missed),
        };
        Ok((found, state))
    })
}

/// The root mean square of the heights, if their mean plane can have the depth.
fn check_depth(depth: f64, heights: &[f64], sliding: &Sliding) -> Result<f64, BemError> {
    let n = heights.len() as f64;
    let mean = heights.iter().sum::<f64>() / n;
    let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let deepest = if sliding.is_on_layer() {
        f64::INFINITY
    } else {
        0.0
    };
    let touches = lowest - mean < depth && depth < deepest;
    let allowed = "above minus the height of the mean plane over the lowest point, and on a half space below 0";
    in_range("mean_depth", depth, touches, allowed)?;
    let squares = heights.iter().map(|height| (height - mean).powi(2));
    Ok((squares.sum::<f64>() / n).sqrt())
}

/// The mean pressure under which the mean plane has a depth, the contact, and by which part of the roughness the depth is
/// missed. The pressure grows about like the exponential function of the depth over the roughness (Persson 2007).
fn at_depth(
    [depth, roughness, tolerance]: [f64; 3],
    start: f64,
    under: impl Fn(f64) -> Result<PeriodicSliding, BemError>,
) -> Result<(f64, PeriodicSliding, f64), BemError> {
    let at = |logarithm: f64| -> Result<(f64, PeriodicSliding, f64), BemError> {
        let state = under(logarithm.exp())?;
        let missing = (state.mean_depth - depth) / roughness;
        Ok((logarithm, state, missing))
    };
    let mut first = at(start.ln())?;
    for _ in 0..MOST_STEPS_OF_PRESSURE {
        if first.2.abs() <= tolerance {
            break;
        }
        let step = (2.0 * first.2).clamp(-LONGEST_STEP, LONGEST_STEP);
        let second = at(first.0 - step)?;
        if first.2 * second.2 < 0.0 {
            let ends = [(first.0, first.2), (second.0, second.2)];
            let last = RefCell::new(second);
            let missing = |logarithm: f64| -> Result<f64, BemError> {
                let is_known = |end: &&(f64, f64)| end.0.total_cmp(&logarithm).is_eq();
                if let Some((_, missing)) = ends.iter().find(is_known) {
                    return Ok(*missing);
                }
                let found = at(logarithm)?;
                let missing = found.2;
                *last.borrow_mut() = found;
                Ok(if missing.abs() <= tolerance {
                    0.0
                } else {
                    missing
                })
            };
            try_bracketed_root(missing, ends.map(|end| end.0))?;
            first = last.into_inner();
            break;
        }
        first = second;
    }
    let (logarithm, state, missing) = first;
    Ok((logarithm.exp(), state, missing.abs()))
}

/// Slides a sum of waves from rest over a distance \[m], rounded up to elements of the first grid, to a relative error of the
/// friction at its end.
///
/// The error is of the first order in the edge of an element, and the work grows with its third power: less than some per
/// cent take long.
///
/// # Errors
/// Those of [`slide_periodic_on_grid`] and, as of [`steady_periodic`], [`BemError::NotReached`] and
/// [`BemError::GridTooLarge`]: also where a march would take longer than about half an hour.
pub fn slide_periodic(
    surface: &PeriodicSurface,
    elastomer: &(impl Elastomer + ?Sized),
    (load, sliding_distance): (&PeriodicLoad, f64),
    relative_error: f64,
    max_elements: usize,
) -> Result<PeriodicEstimate<PeriodicTransient>, BemError> {
    let period = surface.period()[0];
    let edge = period / first_shape(surface)[0] as f64;
    let distance = elements_along(sliding_distance, edge)? as f64 * edge;
    let held = Held::Pressure(load.mean_pressure);
    let goal = Goal {
        friction: OTHERS,
        periods: Some(distance / period),
        ..Goal::stationary(held, relative_error, max_elements)
    };
    let options = ContactOptions {
        tolerance: goal.tolerance(),
        ..ContactOptions::default()
    };
    refine(surface, &goal, |grid, heights| {
        let state = slide_periodic_on_grid(grid, heights, elastomer, (load, distance), &options)?;
        let last = state.rows[state.rows.len() - 1];
        let found = Found {
            friction: last.friction_coefficient,
            from_dissipation: None,
            area_fraction: last.area_fraction,
            mean_pressure: load.mean_pressure,
            mean_depth: last.mean_depth,
            residual: options.tolerance,
        };
        Ok((found, state))
    })
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
    /// Length of a march in periods.
    periods: Option<f64>,
}

/// What is known from one grid.
struct Found {
    friction: f64,
    from_dissipation: Option<f64>,
    area_fraction: f64,
    mean_pressure: f64,
    mean_depth: f64,
    /// Of the contact.
    residual: f64,
}

fn first_shape(surface: &PeriodicSurface) -> [usize; 2] {
    surface.largest_numbers().map(|number| match number {
        0 => 2,
        _ => (FIRST * number).next_power_of_two().max(FEWEST),
    })
}

/// Solves on one grid after the other, each with twice the elements along both axes.
fn refine<S>(
    surface: &PeriodicSurface,
    goal: &Goal,
    mut solve: impl FnMut(&Grid, &[f64]) -> Result<(Found, S), BemError>,
) -> Result<PeriodicEstimate<S>, BemError> {
    between_zero_and_one("relative_error", goal.relative_error)?;
    let mut shape = first_shape(surface);
    let mut grids = Vec::new();
    goal.check(&grids, shape, 1.0)?;
    loop {
        let spacing = [0, 1].map(|axis| surface.period()[axis] / shape[axis] as f64);
        let (grid, heights) = (Grid::new(shape, spacing)?, surface.heights(shape)?);
        check_surface(&grid, &heights)?;
        let (found, state) = solve(&grid, &heights)?;
        grids.push(found);
        let mut finer = 2.0;
        if let Some(bars) = goal.bars(&grids, state) {
            let asked = bars.asked().1;
            if asked.is_within(goal.relative_error) {
                return Ok(bars);
            }
            // No error falls faster than with the second order.
            let excess = asked.error / (goal.relative_error * asked.value.abs());
            finer = excess.sqrt().log2().ceil().max(1.0).exp2();
        }
        goal.check(&grids, shape, finer)?;
        shape = shape.map(|n| 2 * n);
    }
}

impl Goal {
    const fn stationary(held: Held, relative_error: f64, max_elements: usize) -> Self {
        Self {
            relative_error,
            friction: FRICTION,
            max_elements: max_elements as f64,
            held,
            periods: None,
        }
    }

    fn tolerance(&self) -> f64 {
        (TOLERANCE * self.relative_error).min(LARGEST_TOLERANCE)
    }

    /// Refuses a grid that is so many times finer than this one and too large; it says what was reached.
    fn check(&self, grids: &[Found], shape: [usize; 2], finer: f64) -> Result<(), BemError> {
        let [rows, columns] = shape.map(|n| n as f64 * finer);
        let steps = self.periods.map_or(1.0, |periods| periods * rows);
        let limit = self.max_elements.min(MOST_STEPS / steps);
        if rows * columns <= limit {
            return Ok(());
        }
        Err(match self.bars(grids, ()) {
            Some(bars) => {
                let (quantity, known) = bars.asked();
                BemError::NotReached {
                    quantity,
                    value: known.value,
                    error: known.error,
                    relative_error: self.relative_error,
                }
            }
            None => BemError::GridTooLarge {
                elements: rows * columns,
                limit,
            },
        })
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
        let slopes = of(&|found| found.friction, self.friction);
        let dissipated = |found: &Found| found.from_dissipation.unwrap_or(f64::NAN);
        let dissipation = fine
            .from_dissipation
            .map(|_| of(&dissipated, self.friction));
        let better = dissipation.filter(|dissipation| dissipation.error <= slopes.error);
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
    /// What the relative error is of.
    fn asked(&self) -> (&'static str, Estimate) {
        let first = if self.friction_coefficient.value == 0.0 {
            ("area fraction", self.area_fraction)
        } else {
            ("friction coefficient", self.friction_coefficient)
        };
        let relative = |known: Estimate| known.error / known.value.abs();
        if relative(self.mean_pressure) > relative(first.1) {
            ("mean pressure [Pa]", self.mean_pressure)
        } else {
            first
        }
    }
}
