//! Any motion of a line over a chain: starts, stops, dwells, returns, once or to and fro.
//!
//! ```text
//! F_t = 4 Σ Δx w h̃'(X − x),   ∫ F_t dx + ∫ F_N dd = stored and lost energy
//! ```
//! Steps in time are as long as elements, or grow after a stop, so that both become finer together; values on several
//! resolutions tell their errors.

mod chain;
mod cycle;
mod event;
mod heights;
mod legs;
mod march;
mod time_step;

use indenters::{Control, MovingLoad, RigidLine, Stage};
use numerics::{Accuracy, ErrorParts, Estimate, Goal, Quantity, Request, positive, refine};
use rheology::Material;

use crate::MdrError;
use crate::steady::LineProblem;
pub use march::MotionStep;
use march::{Marched, Problem};

/// Elements along the contact after which a motion is given up.
const MOST_ELEMENTS: usize = 4096;
/// There are about as many steps as elements.
const WORK: f64 = 2.0;
/// The friction of smooth bodies is of the second order, which their outline on the elements makes unsafe to assume; below
/// the smallest order nothing converges.
const ORDERS: [f64; 2] = [0.1, 1.0];
/// Rows of a motion, about.
const ROWS: usize = 64;
/// Part of the error asked for by which two cycles may differ, and that of a motion on given elements.
const PART_OF_CYCLES: f64 = 0.05;
const TOLERANCE_ON_ELEMENTS: f64 = 1e-5;
/// Rounding of forces times slopes, relative to the mean slope.
const ROUNDING: f64 = 1e-12;
/// Places of friction and its peak among the quantities, and of the others of a row.
const OF_WHOLE: usize = 2;
const OF_ROW: usize = 3;

/// A point of a motion with its errors; an error of 0 says that a quantity is given.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MovedPoint {
    /// Time, \[s].
    pub time: f64,
    /// Position of the lowest point along x, \[m].
    pub position: f64,
    /// Force on the body along −x \[N], on the way to this point.
    pub tangential_force: Estimate,
    /// Normal force F_N, \[N].
    pub normal_force: Estimate,
    /// Indentation depth d of the lowest point, \[m].
    pub indentation_depth: Estimate,
}

/// A motion with its error bars, or the cycle in which one to and fro ends.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct Moved {
    /// Mean friction coefficient ∫ F_t dx / ∫ F_N |dx|.
    pub friction_coefficient: Estimate,
    /// What its error consists of.
    pub error_parts: ErrorParts,
    /// The largest |F_t|/F_N on the way.
    pub peak_friction: Estimate,
    /// Energy ∫ F_t dx that is dissipated in a cycle \[J]; none of a motion that does not come back.
    pub dissipated_energy: Option<Estimate>,
    /// From the beginning to the end, the points of the motion among them.
    pub points: Vec<MovedPoint>,
    /// Rear and front end of the contact at the end, \[m]; none where nothing touches.
    pub ends: Option<[Estimate; 2]>,
    /// The steps on the finest chain.
    pub steps: Vec<MotionStep>,
    /// Cycles that were followed until they were alike.
    pub n_cycles: usize,
    /// Positions of the elements around the last contact \[m] from the rear to the front, and the load per length there
    /// \[N/m].
    pub load: Vec<[f64; 2]>,
}

/// Moves a line over an undeformed chain: through the points of a motion, or to and fro until two cycles are alike; to an
/// error of the mean friction coefficient relative to its value, or with a number of elements along the contact.
///
/// At the beginning the line is pressed at once. The friction force of a motion through points has the same error, relative
/// to its largest value.
///
/// ```
/// use mdr_core::indenters::{Control, EquivalentLine, MovingLoad, Shape, Sphere, Stroke};
/// use mdr_core::rheology::{StandardSolid, StandardSolidParameters};
/// use mdr_core::move_along;
///
/// let rubber = StandardSolid::new(StandardSolidParameters {
///     equilibrium_modulus: 1e6,
///     maxwell_modulus: 1e7,
///     viscosity: 1e5,
/// })?;
/// let ball = Sphere::new(5e-3)?;
/// let stroke = Stroke { length: 5e-3, frequency: 1.0, shape: Shape::Sinusoidal };
/// let load = MovingLoad::reciprocating(Control::NormalForce(1.0), stroke)?;
/// let cycle = move_along(&EquivalentLine(&ball), &rubber, &load, 1e-2)?;
/// let energy = cycle.dissipated_energy.expect("of a cycle");
/// let expected = cycle.friction_coefficient.value * 1.0 * load.length();
/// assert!((energy.value / expected - 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`MdrError::MotionNotReached`] with what the finest chain gives; [`MdrError::NoCycle`] to and fro on a material that
/// flows; [`MdrError::NotPeriodic`]; [`MdrError::TooManySteps`]; [`MdrError::ContactReachesEdge`];
/// [`MdrError::FrictionDiverges`] for a kink or cusp on a lone dashpot; otherwise like [`slide`](crate::slide()).
pub fn move_along<'w>(
    line: &(impl RigidLine + ?Sized),
    material: &(impl Material + ?Sized),
    load: &MovingLoad,
    request: impl Into<Request<'w>>,
) -> Result<Moved, MdrError> {
    let request = request.into();
    let steady = LineProblem::new(line, material, load.fastest())?;
    steady.check_kinks(load.largest_control())?;
    let length = positive(
        "contact length",
        steady.contact_span(load.largest_control())?,
    )?;
    let tolerance = match request.accuracy {
        Accuracy::RelativeError(asked) => PART_OF_CYCLES * asked,
        Accuracy::Elements(_) => TOLERANCE_ON_ELEMENTS,
    };
    let problem = Problem::new(line, material, load, (length, tolerance))?;
    let goal = Goal {
        request,
        largest: MOST_ELEMENTS,
        order: (2.0 * line.apex_exponent() - 1.0).clamp(ORDERS[0], ORDERS[1]),
        work: WORK,
        others: 0.0,
        selection: 1.0,
    };
    let view = View {
        load,
        is_elastic: material.creep().is_elastic(),
    };
    let refined = refine(
        &goal,
        |elements, tell: &dyn Fn(f64)| problem.on(elements, tell),
        |marched| view.quantities(marched),
        |marched, _: &dyn Fn(f64)| Ok::<_, MdrError>(view.rests(marched)),
    )?;
    let found = view.moved(refined.value, &refined.error, refined.parts[0]);
    match refined.missed {
        None => Ok(found),
        Some(missed) => Err(MdrError::MotionNotReached {
            missed,
            reached: Box::new(found),
        }),
    }
}

/// Memory that [`move_along`] takes at most for a number of elements along the contact, \[bytes].
///
/// # Errors
/// As for [`move_along`], before anything is followed.
pub fn move_memory(
    line: &(impl RigidLine + ?Sized),
    material: &(impl Material + ?Sized),
    load: &MovingLoad,
    elements: usize,
) -> Result<f64, MdrError> {
    let steady = LineProblem::new(line, material, load.fastest())?;
    let length = positive(
        "contact length",
        steady.contact_span(load.largest_control())?,
    )?;
    Problem::new(line, material, load, (length, TOLERANCE_ON_ELEMENTS))?.memory_on(elements)
}

/// What is known at a point: tangential force, normal force, depth.
type Row = [f64; OF_ROW];

/// How a march is looked at.
struct View<'a> {
    load: &'a MovingLoad,
    is_elastic: bool,
}

impl View<'_> {
    /// The points at which a motion is asked for: its stage, and the part of it; the first one is its beginning.
    fn stations(&self) -> Vec<(usize, f64)> {
        let n_stages = self.load.stages().len();
        let each = ROWS.div_ceil(n_stages);
        let parts = move |stage| (1..=each).map(move |k| (stage, k as f64 / each as f64));
        let all = (0..n_stages).flat_map(parts);
        std::iter::once((0, 0.0)).chain(all).collect()
    }

    fn quantities(&self, marched: &Marched) -> Vec<Quantity> {
        let friction = marched.friction();
        let peak = peak(&marched.steps);
        let steepness = self.steepness(marched);
        let is_cycle = self.load.is_cycle();
        // What the line does and what the elements lose is the same, but for the work of the normal force.
        let balance = (marched.work - marched.lost) / marched.normal_work;
        let mut quantities = vec![
            Quantity {
                size: if self.is_elastic {
                    steepness
                } else if is_cycle {
                    friction.abs()
                } else {
                    peak
                },
                least: if is_cycle { balance.abs() } else { 0.0 },
                rounding: ROUNDING * steepness,
                ..Quantity::from(friction)
            },
            Quantity {
                drives: false,
                ..Quantity::from(peak)
            },
        ];
        let rows: Vec<(Row, Row)> = self
            .stations()
            .iter()
            .map(|at| row(self.load, &marched.steps, *at))
            .collect();
        let mut sizes = [f64::MIN_POSITIVE; OF_ROW];
        for (values, _) in &rows {
            for (size, value) in sizes.iter_mut().zip(values) {
                *size = value.abs().max(*size);
            }
        }
        sizes[0] = sizes[0].max(if self.is_elastic {
            steepness * sizes[1]
        } else {
            0.0
        });
        for (values, scatter) in rows {
            quantities.extend((0..OF_ROW).map(|k| Quantity {
                size: sizes[k],
                least: scatter[k],
                drives: k == 0 && !is_cycle,
                ..Quantity::from(values[k])
            }));
        }
        quantities
    }

    /// About the mean slope in the contact.
    fn steepness(&self, marched: &Marched) -> f64 {
        let steps = marched.steps.iter();
        let slopes = steps.filter_map(|step| {
            let [rear, front] = step.contact?;
            Some(step.indentation_depth.abs() / (front - rear))
        });
        slopes.filter(|slope| slope.is_finite()).fold(0.0, f64::max)
    }

    /// What is left to the cycle.
    fn rests(&self, marched: &Marched) -> Vec<ErrorParts> {
        if !self.load.is_cycle() {
            return Vec::new();
        }
        let truncated = |rest: f64| ErrorParts {
            truncation: Some(rest),
            ..ErrorParts::NONE
        };
        let [friction, rows @ ..] = marched.rest;
        let whole = [friction, rows[0] / marched.sizes()[2]];
        let rows = self.stations().into_iter().flat_map(|_| rows);
        whole.into_iter().chain(rows).map(truncated).collect()
    }

    fn moved(&self, marched: Marched, error: &[f64], error_parts: ErrorParts) -> Moved {
        let friction = Estimate::new(marched.friction(), error[0]);
        let is_force = matches!(self.load.largest_control(), Control::NormalForce(_));
        let given = |k: usize| (k == 1 && is_force) || (k == 2 && !is_force);
        let points = self.stations().into_iter().enumerate().map(|(index, at)| {
            let place = self.load.stages()[at.0].at(at.1);
            let (values, _) = row(self.load, &marched.steps, at);
            let [tangential_force, normal_force, indentation_depth] = std::array::from_fn(|k| {
                if given(k) {
                    return Estimate::exact(place.control.value());
                }
                Estimate::new(values[k], error[OF_WHOLE + OF_ROW * index + k])
            });
            MovedPoint {
                time: place.time,
                position: place.position,
                tangential_force,
                normal_force,
                indentation_depth,
            }
        });
        let last = marched.steps.last().and_then(|step| step.contact);
        let end = |end: f64| Estimate::new(end, 2.0 * marched.spacing);
        Moved {
            friction_coefficient: friction,
            error_parts,
            peak_friction: Estimate::new(peak(&marched.steps), error[1]),
            dissipated_energy: self.load.is_cycle().then(|| friction * marched.normal_work),
            points: points.collect(),
            ends: last.map(|ends| ends.map(end)),
            n_cycles: marched.n_cycles,
            load: marched.load,
            steps: marched.steps,
        }
    }
}

fn peak(steps: &[MotionStep]) -> f64 {
    let pressed = steps.iter().filter(|step| step.normal_force > 0.0);
    let frictions = pressed.map(|step| (step.tangential_force / step.normal_force).abs());
    frictions.fold(0.0, f64::max)
}

/// The values at a part of a stage, straight through the middles of the two nearest steps of it, and how steps scatter
/// there.
fn row(load: &MovingLoad, steps: &[MotionStep], (stage, part): (usize, f64)) -> (Row, Row) {
    let values = |step: &MotionStep| {
        [
            step.tangential_force,
            step.normal_force,
            step.indentation_depth,
        ]
    };
    let first = steps.partition_point(|step| step.stage < stage);
    let count = steps[first..].partition_point(|step| step.stage == stage);
    let steps = &steps[first..first + count];
    let time = Stage::at(&load.stages()[stage], part).time;
    let after = steps
        .partition_point(|step| step.time < time)
        .clamp(1, count - 1);
    let (before, next) = (&steps[after - 1], &steps[after]);
    let along = (time - before.time) / (next.time - before.time);
    let (from, to) = (values(before), values(next));
    let value = std::array::from_fn(|k| from[k] + along * (to[k] - from[k]));
    let scatter = match steps.get((after + 1).saturating_sub(2).min(count.saturating_sub(3))..) {
        Some([a, b, c, ..]) => {
            let middle = (b.time - a.time) / (c.time - a.time);
            let [a, b, c] = [a, b, c].map(values);
            std::array::from_fn(|k| (a[k] + middle * (c[k] - a[k]) - b[k]).abs())
        }
        _ => [0.0; OF_ROW],
    };
    (value, scatter)
}
