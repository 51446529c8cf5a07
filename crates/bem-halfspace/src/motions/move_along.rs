//! Any motion along the surface with its error bars: starts, stops, dwells, returns, once or to and fro.
//!
//! Steps in time are as long as a third of an element, or grow after a stop, so that both become finer together. Loads are linear over
//! a step, and forces belong to its end, so that steps are of the second order; `docs/theory/transient-half-space.md` has what
//! is different on a material without instantaneous compliance.

use std::cell::Cell;

use indenters::{
    Control, MotionRecord, MotionStep, MotionView, Moved, MovingLoad, MovingStep, PressingLoad,
    SlidingLoad, Surface,
};
use numerics::{
    Accuracy, FixedPoint, Goal, MAX_STORED_STATES, Refined, Request, anderson_fixed_point, refine,
};
use rheology::{CreepSpectrum, Material as _};

use crate::elements::footprint::Footprint;
use crate::estimate::bars::order_of_friction;
use crate::estimate::plan::GridPlan;
use crate::motions::indent::footprint_after;
use crate::motions::slide::{March, Motion, MotionRow};
use crate::stepping::{BYTES_PER_FOLLOWED_ELEMENT, BYTES_PER_STEP, MARCH_WORK_EXPONENT, MAX_STEPS};
use crate::{BemError, Elastomer, GridOptions, Reached};

/// Elements along the contact on which a relative error is first sought. The work grows with the third power of them, and most
/// strokes reach two per cent on these (docs/theory/transient-half-space.md).
const FIRST_ELEMENTS_OF_MOTION: usize = 8;
/// Elements along the contact after which a motion is given up; a cycle takes about a minute.
const MAX_ELEMENTS_OF_MOTION: usize = 48;
/// Order of the error, at least.
pub(crate) const MIN_ORDER_OF_MOTION: f64 = 1.0;
/// Cycles after which the search for the limit cycle is given up.
const MAX_CYCLES: usize = 100;
/// Relative change by a cycle below which rounding hides it: some ten units in the last place, from hundreds of steps.
const CYCLE_ROUNDING: f64 = 1e-14;
/// Part of the error asked for by which two cycles may differ, and that of a motion on given elements.
const CYCLE_TOLERANCE_FRACTION: f64 = 0.1;
const CYCLE_TOLERANCE_ON_ONE_GRID: f64 = 1e-3;
/// Steps in which the body passes an element at its largest speed. With three the errors of steps are about those of elements
/// (docs/theory/transient-half-space.md has both for some strokes).
const STEPS_PER_ELEMENT: usize = 3;
/// Duration of the first touch, at rest, relative to that of the first step.
pub(crate) const TOUCH_DURATION_RATIO: f64 = 1e-3;
/// Times of the slowest element after which a body that is pressed rests.
const REST_OVER_RETARDATION_TIME: f64 = 30.0;
/// Moves `surface` over an undeformed half space or layer: through the points of a motion, or to and fro until two cycles are
/// alike; to an error of the mean friction coefficient relative to its value, or with a number of elements along the contact.
///
/// At the beginning the body is pressed at once. The friction force of a motion through points has the same error, relative to
/// its largest value.
///
/// ```
/// use bem_halfspace::indenters::{Control, MovingLoad, Shape, Sphere, Stroke};
/// use bem_halfspace::move_along;
/// use bem_halfspace::numerics::Accuracy;
/// use bem_halfspace::rheology::{StandardSolid, StandardSolidParameters};
///
/// let rubber = StandardSolid::new(StandardSolidParameters {
///     equilibrium_modulus: 1e6,
///     maxwell_modulus: 1e7,
///     viscosity: 1e5,
/// })?;
/// let ball = Sphere::new(5e-3)?;
/// let stroke = Stroke { length: 2e-3, frequency: 5.0, shape: Shape::Sinusoidal };
/// let load = MovingLoad::reciprocating(Control::NormalForce(1.0), stroke)?;
/// let cycle = move_along(&ball, &rubber, &load, Accuracy::Elements(8))?;
/// assert!(cycle.friction_coefficient.value > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BemError::NotReached`] with what was reached on the finest grid allowed; [`BemError::NoCycle`] to and fro on a material
/// that flows; [`BemError::NotPeriodic`]; otherwise like [`slide_on_grid`](crate::slide_on_grid).
pub fn move_along<'w>(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &MovingLoad,
    request: impl Into<Request<'w>>,
) -> Result<Moved, BemError> {
    let request = request.into();
    let problem = MovingBody::new(surface, elastomer, load, request.accuracy)?;
    let goal = Goal {
        request,
        initial_elements: FIRST_ELEMENTS_OF_MOTION,
        max_elements: MAX_ELEMENTS_OF_MOTION,
        order: order_of_friction(problem.plan.apex_exponent, MIN_ORDER_OF_MOTION),
        work_exponent: MARCH_WORK_EXPONENT,
        extra_work: 0.0,
        selection_factor: 1.0,
    };
    let view = MotionView {
        load,
        is_elastic: problem.creep.is_elastic(),
    };
    let refined = refine(
        &goal,
        |elements, report: &dyn Fn(f64)| problem.solve_on_grid(elements, report),
        |record| view.quantities(record),
        |record, _: &dyn Fn(f64)| Ok::<_, BemError>(view.rests(record)),
    )?;
    moved_if_reached(&view, refined)
}

/// The motion of the finest resolution, or what was reached of it.
pub(crate) fn moved_if_reached(
    view: &MotionView,
    refined: Refined<MotionRecord>,
) -> Result<Moved, BemError> {
    let found = view.moved(refined.value, &refined.error, refined.parts[0]);
    let Some(missed) = refined.missed else {
        return Ok(found);
    };
    Err(BemError::NotReached {
        quantity: MotionView::in_words(missed.quantity),
        value: missed.value,
        error: missed.error,
        relative_error: missed.relative_error,
        reached: Box::new(Reached::Moved(found)),
    })
}

/// Memory that [`move_along`] takes at most for a number of elements along the contact, \[bytes].
///
/// # Errors
/// As for [`move_along`], before anything is followed.
pub fn move_along_memory(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &MovingLoad,
    elements: usize,
) -> Result<f64, BemError> {
    let problem = MovingBody::new(surface, elastomer, load, Accuracy::Elements(elements))?;
    let options = problem.options(elements);
    let [dx, dy] = options.spacing;
    let (per_contact, length) = steps_of(elements, dx);
    let n_steps = load.n_steps(per_contact, length, MAX_STEPS)?;
    // One field more for the last load.
    let n_fields = problem.creep.elements().len() + usize::from(problem.creep.fluidity() > 0.0) + 1;
    let [rear, front] = load.range();
    let across = (options.footprint.y[1] - options.footprint.y[0]) / dy;
    let followed = if surface.mirrors()[1] { 0.5 } else { 1.0 };
    let passed = (front - rear) / dx * across;
    let n_elements = followed * (options.footprint.n_elements(options.spacing) + passed);
    let copies = if load.is_cycle() {
        MAX_STORED_STATES
    } else {
        1
    };
    let per_element = BYTES_PER_FOLLOWED_ELEMENT + (copies * n_fields * size_of::<f64>()) as f64;
    Ok(per_element * n_elements + BYTES_PER_STEP * n_steps)
}

struct MovingBody<'a> {
    surface: &'a dyn Surface,
    elastomer: &'a dyn Elastomer,
    load: &'a MovingLoad,
    creep: CreepSpectrum,
    plan: GridPlan,
    /// Relative error by which cycles may differ.
    tolerance: f64,
}

/// Steps along the contact, and the longest way \[m] of one, on a number of elements of this spacing \[m].
fn steps_of(elements: usize, spacing: f64) -> (usize, f64) {
    (
        STEPS_PER_ELEMENT * elements,
        spacing / STEPS_PER_ELEMENT as f64,
    )
}

impl<'a> MovingBody<'a> {
    fn new(
        surface: &'a dyn Surface,
        elastomer: &'a dyn Elastomer,
        load: &'a MovingLoad,
        accuracy: Accuracy,
    ) -> Result<Self, BemError> {
        let creep = elastomer.material().creep();
        if load.is_cycle() && creep.fluidity() > 0.0 {
            return Err(BemError::NoCycle);
        }
        let control = load.largest_control();
        let fastest = SlidingLoad::with(control, load.fastest())?;
        let mut plan = GridPlan::sliding(surface, elastomer, &fastest)?;
        if let Control::NormalForce(_) = control {
            let memory = REST_OVER_RETARDATION_TIME * slowest_retardation_time(&creep);
            let pressed = if load.is_cycle() { memory } else { 0.0 };
            let duration = if pressed > 0.0 {
                pressed
            } else {
                load.duration()
            };
            let rest = footprint_after(surface, elastomer, &PressingLoad::new(control, duration)?)?;
            plan.footprint = bounding_footprint(plan.footprint, rest);
        }
        Ok(Self {
            surface,
            elastomer,
            load,
            creep,
            plan,
            tolerance: cycle_tolerance(accuracy),
        })
    }

    fn options(&self, elements: usize) -> GridOptions {
        let spacing = self.plan.length() / elements as f64;
        GridOptions::new([spacing; 2], self.plan.footprint.widened(spacing))
    }

    fn steps(&self, elements: usize, spacing: f64) -> Result<Vec<MovingStep>, BemError> {
        let (per_contact, length) = steps_of(elements, spacing);
        Ok(self.load.steps(per_contact, length, MAX_STEPS)?)
    }

    fn solve_on_grid(
        &self,
        elements: usize,
        report: &dyn Fn(f64),
    ) -> Result<MotionRecord, BemError> {
        let options = self.options(elements);
        let [spacing, _] = options.spacing;
        let steps = self.steps(elements, spacing)?;
        let start = self.load.stages()[0].start;
        let touch = TOUCH_DURATION_RATIO * steps[0].duration;
        let first = (start, touch);
        let all = steps.iter().map(|step| (step.end, step.duration));
        let motions = std::iter::once(first).chain(all).map(|(point, duration)| {
            let motion = Motion {
                time: point.time,
                position: point.position - start.position,
                control: point.control,
            };
            (motion, duration)
        });
        let mut march = March::cyclic(self.surface, self.elastomer, motions, &options)?;
        let touch = march.step()?;
        let pass = MotionPass {
            steps: &steps,
            spacing,
            report,
        };
        if self.load.is_cycle() {
            return self.find_limit_cycle(&mut march, &pass);
        }
        pass.run(&mut march, touch.as_ref())
    }

    /// The cycle that is like the one before.
    fn find_limit_cycle(
        &self,
        march: &mut March<'_>,
        motion: &MotionPass<'_>,
    ) -> Result<MotionRecord, BemError> {
        let first = march.history_variables_mut().to_vec();
        let pass = |from: &[f64], report: &dyn Fn(f64)| {
            march.history_variables_mut().copy_from_slice(from);
            march.return_to_first_step();
            let record = MotionPass { report, ..*motion }.run(march, None)?;
            Ok((record, march.history_variables_mut().to_vec()))
        };
        let limit_cycle = LimitCycle {
            period: self.load.duration(),
            slowest: slowest_retardation_time(&self.creep),
            tolerance: self.tolerance,
        };
        limit_cycle.find(first, pass, motion.report)
    }
}

/// All steps of a motion, or of one cycle.
struct MotionPass<'a> {
    steps: &'a [MovingStep],
    /// Length of an element, \[m].
    spacing: f64,
    report: &'a dyn Fn(f64),
}

impl MotionPass<'_> {
    /// Makes all steps, from the state with `first`, or from that of their end.
    fn run(
        &self,
        march: &mut March<'_>,
        first: Option<&MotionRow>,
    ) -> Result<MotionRecord, BemError> {
        let mut rows = Vec::with_capacity(self.steps.len());
        while let Some(row) = march.step()? {
            rows.push((row, march.time_level()));
            (self.report)(march.fraction_done());
        }
        let mut record = MotionRecord {
            spacing: self.spacing,
            ..MotionRecord::default()
        };
        let Some(mut before) = first.or_else(|| rows.last().map(|(row, _)| row)) else {
            return Ok(record);
        };
        for (step, (row, time_level)) in self.steps.iter().zip(&rows) {
            add_work(&mut record, step, [before, row], *time_level);
            record.steps.push(motion_step(step, row));
            before = row;
        }
        Ok(record)
    }
}

/// Adds ∫ F_t dx and ∫ F_N |dx| of a step whose forces belong before its end by a part of it, from them and those before:
/// by the trapezoidal rule in time where they belong to its end, whose errors cancel over a sinusoidal cycle, and by the
/// midpoint rule where they belong to its middle.
fn add_work(
    record: &mut MotionRecord,
    step: &MovingStep,
    [before, now]: [&MotionRow; 2],
    time_level: f64,
) {
    let distance = now.position - before.position;
    let mean = |[from, to]: [f64; 2]| to + (0.5 - time_level) * (from - to);
    let of_both = |of: fn(&MotionRow) -> f64| [before, now].map(of);
    let ways = step
        .velocities
        .map(|velocity| velocity * step.duration - distance);
    let [from, to] = of_both(|row| row.tangential_force);
    let bend = (0.5 - time_level) * (from * ways[0] + to * ways[1]);
    record.work += mean([from, to]) * distance + bend;
    record.normal_work += mean(of_both(|row| row.normal_force)) * distance.abs();
}

/// When two cycles are alike.
pub(crate) struct LimitCycle {
    /// \[s].
    pub(crate) period: f64,
    /// The slowest retardation time, \[s].
    pub(crate) slowest: f64,
    /// Relative error by which they may differ.
    pub(crate) tolerance: f64,
}

impl LimitCycle {
    /// The cycle that is like the one before, from what elements remember; a pass gives it, and what they remember at its end, and
    /// tells which part of it is done.
    pub(crate) fn find(
        &self,
        first: Vec<f64>,
        mut pass: impl FnMut(&[f64], &dyn Fn(f64)) -> Result<(MotionRecord, Vec<f64>), BemError>,
        report: &dyn Fn(f64),
    ) -> Result<MotionRecord, BemError> {
        let slowness = -(-self.period / self.slowest).exp_m1().recip();
        if slowness * CYCLE_ROUNDING > self.tolerance {
            let (period, slowest) = (self.period, self.slowest);
            return Err(BemError::CycleTooShort { period, slowest });
        }
        // By the cycles that are made, or by how alike they are, whichever is more.
        let (mut n_cycles, similarity) = (0, Cell::new(0.0_f64));
        let pass = |from: &[f64]| {
            let begun = f64::from(n_cycles);
            let cycle = pass(from, &|part| {
                report(similarity.get().max((begun + part) / MAX_CYCLES as f64));
            });
            n_cycles += 1;
            cycle
        };
        let left = |now: &mut MotionRecord, before: &MotionRecord| {
            let left = now.rest_after(before, slowness);
            let part = (left.ln() / self.tolerance.ln()).clamp(0.0, 1.0);
            similarity.set(similarity.get().max(part));
            left
        };
        match anderson_fixed_point(first, MAX_CYCLES, self.tolerance, pass, left)? {
            FixedPoint::Converged {
                result,
                evaluations,
            } => Ok(MotionRecord {
                n_cycles: evaluations,
                ..result
            }),
            FixedPoint::NotConverged {
                remaining_error: change,
            } => Err(BemError::NotPeriodic {
                cycles: MAX_CYCLES,
                change,
                tolerance: self.tolerance,
            }),
        }
    }
}

/// Relative error by which cycles may differ.
pub(crate) const fn cycle_tolerance(accuracy: Accuracy) -> f64 {
    match accuracy {
        Accuracy::RelativeError(asked) => CYCLE_TOLERANCE_FRACTION * asked,
        Accuracy::Elements(_) => CYCLE_TOLERANCE_ON_ONE_GRID,
    }
}

/// Force and depth are those at the end of a step.
fn motion_step(step: &MovingStep, row: &MotionRow) -> MotionStep {
    MotionStep {
        stage: step.stage,
        time: step.end.time,
        position: step.end.position,
        tangential_force: row.tangential_force,
        normal_force: row.normal_force,
        indentation_depth: row.indentation_depth,
        contact: row.contact_x,
        n_contact: row.n_contact,
    }
}

/// The slowest retardation time, \[s]; 0 without any.
pub(crate) fn slowest_retardation_time(creep: &CreepSpectrum) -> f64 {
    let times = creep
        .elements()
        .iter()
        .map(|element| element.retardation_time);
    times.fold(0.0, f64::max)
}

/// The rectangle around two.
fn bounding_footprint(a: Footprint, b: Footprint) -> Footprint {
    let both = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
    Footprint {
        x: both(a.x, b.x),
        y: both(a.y, b.y),
    }
}
