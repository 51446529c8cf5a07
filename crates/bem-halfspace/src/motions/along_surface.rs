//! Any motion along the surface with its error bars: starts, stops, dwells, returns, once or reciprocating.
//!
//! In a step the body moves by at most a third of an element, and after a stop steps grow, so that elements and steps are refined
//! together. Loads are linear over a step and forces belong to its end, so that steps are of second order, except on a
//! material without instantaneous compliance.
//!
//! A reciprocating motion is repeated until its limit cycle is found, by a fixed-point iteration on the history variables.
//!
//! Theory: docs/theory/transient-half-space.md, "Motions" and "Linear loads".

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
use crate::march::{BYTES_PER_FOLLOWED_ELEMENT, BYTES_PER_STEP, MARCH_WORK_EXPONENT, MAX_STEPS};
use crate::motions::indent::footprint_after;
use crate::motions::slide::{March, Motion, MotionRow};
use crate::{BemError, Elastomer, GridOptions, Reached};

/// Elements along the contact on which a relative error is first sought. The work grows with their third power, and most strokes
/// reach 2 % on 8 elements (docs/theory/transient-half-space.md, "Linear loads").
const FIRST_ELEMENTS_OF_MOTION: usize = 8;
/// Largest number of elements along the contact; a cycle on it takes about a minute.
const MAX_ELEMENTS_OF_MOTION: usize = 48;
/// Order of the error in the number of elements that the error bars assume, unless the apex of the body lowers it.
pub(crate) const MIN_ORDER_OF_MOTION: f64 = 1.0;
/// Cycles after which the search for the limit cycle is given up.
const MAX_CYCLES: usize = 100;
/// Relative change per cycle below which rounding hides it: some ten units in the last place, from hundreds of steps.
const CYCLE_ROUNDING: f64 = 1e-14;
/// Remaining change of the limit cycle over the relative error asked for; chosen.
const CYCLE_TOLERANCE_FRACTION: f64 = 0.1;
/// Remaining relative change of the limit cycle if a number of elements is asked for instead of an error; chosen.
const CYCLE_TOLERANCE_ON_ONE_GRID: f64 = 1e-3;
/// Steps in which the body passes an element at its largest speed. With three, the errors of steps and of elements are about equal
/// (docs/theory/transient-half-space.md, "Linear loads").
const STEPS_PER_ELEMENT: usize = 3;
/// Duration of the first touch, during which the body rests, over that of the first step; chosen.
pub(crate) const TOUCH_DURATION_RATIO: f64 = 1e-3;
/// Time after which a pressed body is at rest over the slowest retardation time: e^−30 of the creep remains.
const REST_OVER_RETARDATION_TIME: f64 = 30.0;

/// Moves `surface` over an undeformed half space or layer, through the points of a motion or reciprocating until the limit cycle.
///
/// The request is an error of the mean friction coefficient relative to its value, or a number of elements along the contact. At
/// the beginning the body is pressed suddenly. The friction force of a motion through points has the same error, relative
/// to its largest value.
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
/// [`BemError::NotReached`] with the result on the finest grid allowed; [`BemError::NoCycle`] for a reciprocating motion on a
/// material that flows; [`BemError::NotPeriodic`]; otherwise like [`slide_on_grid`](crate::slide_on_grid).
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

/// Result on the finest resolution.
///
/// # Errors
/// [`BemError::NotReached`] with that result if a quantity misses the error asked for.
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

/// Upper bound of the memory of [`move_along`] for a number of elements along the contact, \[bytes].
///
/// # Errors
/// As for [`move_along`], without the errors of the solution.
pub fn move_along_memory(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &MovingLoad,
    elements: usize,
) -> Result<f64, BemError> {
    let problem = MovingBody::new(surface, elastomer, load, Accuracy::Elements(elements))?;
    let options = problem.options(elements);
    let [dx, dy] = options.spacing;
    let max_step_length = dx / STEPS_PER_ELEMENT as f64;
    let n_steps = load.n_steps(STEPS_PER_ELEMENT * elements, max_step_length, MAX_STEPS)?;
    // History variables: retardation elements, free flow, and the last load.
    let n_fields = problem.creep.elements().len() + usize::from(problem.creep.fluidity() > 0.0) + 1;
    // Elements of the footprint, and of the rows that it passes.
    let [rear, front] = load.range();
    let across = (options.footprint.y[1] - options.footprint.y[0]) / dy;
    let followed = if surface.mirrors()[1] { 0.5 } else { 1.0 };
    let passed = (front - rear) / dx * across;
    let n_elements = followed * (options.footprint.n_elements(options.spacing) + passed);
    // The fixed-point iteration stores several states of the history variables.
    let copies = if load.is_cycle() {
        MAX_STORED_STATES
    } else {
        1
    };
    let per_element = BYTES_PER_FOLLOWED_ELEMENT + (copies * n_fields * size_of::<f64>()) as f64;
    Ok(per_element * n_elements + BYTES_PER_STEP * n_steps)
}

/// A motion that can be solved on any number of elements.
struct MovingBody<'a> {
    surface: &'a dyn Surface,
    elastomer: &'a dyn Elastomer,
    load: &'a MovingLoad,
    creep: CreepSpectrum,
    plan: GridPlan,
    /// Remaining relative change at which a cycle counts as the limit cycle.
    tolerance: f64,
}

impl<'a> MovingBody<'a> {
    /// Plans grid and footprint; refuses a cycle on a material that flows.
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
        // The grid of sliding at the largest load and speed; under a force the body may sink deeper while it dwells.
        let control = load.largest_control();
        let fastest = SlidingLoad::with(control, load.fastest())?;
        let mut plan = GridPlan::sliding(surface, elastomer, &fastest)?;
        if let Control::NormalForce(_) = control {
            let creep_time = REST_OVER_RETARDATION_TIME * slowest_retardation_time(&creep);
            let duration = if load.is_cycle() && creep_time > 0.0 {
                creep_time
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

    /// Square elements, `elements` of them along the contact.
    fn options(&self, elements: usize) -> GridOptions {
        let spacing = self.plan.length() / elements as f64;
        GridOptions::new([spacing; 2], self.plan.footprint.widened(spacing))
    }

    /// Follows the motion, or finds its limit cycle, on one grid.
    fn solve_on_grid(
        &self,
        elements: usize,
        report: &dyn Fn(f64),
    ) -> Result<MotionRecord, BemError> {
        let options = self.options(elements);
        let [spacing, _] = options.spacing;
        let max_step_length = spacing / STEPS_PER_ELEMENT as f64;
        let steps = self
            .load
            .steps(STEPS_PER_ELEMENT * elements, max_step_length, MAX_STEPS)?;

        // A first touch at rest, then the steps of the motion or of one cycle.
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

    /// The limit cycle, from the state after the first touch.
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

/// All steps of a motion, or of one cycle of it.
struct MotionPass<'a> {
    steps: &'a [MovingStep],
    /// Length of an element, \[m].
    spacing: f64,
    /// Called with the fraction of the steps that is done.
    report: &'a dyn Fn(f64),
}

impl MotionPass<'_> {
    /// Solves all steps and sums their work; `first` is the state before them, or in a cycle `None`, and their last state is.
    fn run(
        &self,
        march: &mut March<'_>,
        first: Option<&MotionRow>,
    ) -> Result<MotionRecord, BemError> {
        let mut rows = Vec::with_capacity(self.steps.len());
        // Solve all steps.
        while let Some(row) = march.step()? {
            rows.push((row, march.time_level()));
            (self.report)(march.fraction_done());
        }
        // Sum the work from the state before the first step, which in a cycle is that of the last one.
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

/// Adds ∫ F_t dx and ∫ F_N |dx| of a step, whose forces belong to the time θ Δt before its end (θ is the `time_level`).
///
/// θ = 0 gives the trapezoidal rule in time, ½ Δt (F_old v_old + F_new v_new), whose errors cancel over a sinusoidal cycle; θ = ½ gives
/// the midpoint rule F_new Δx. In between, both are blended with the weights 1 − 2θ and 2θ.
fn add_work(
    record: &mut MotionRecord,
    step: &MovingStep,
    [before, now]: [&MotionRow; 2],
    time_level: f64,
) {
    let distance = now.position - before.position;
    let mean = |[from, to]: [f64; 2]| to + (0.5 - time_level) * (from - to);
    let of_both = |of: fn(&MotionRow) -> f64| [before, now].map(of);
    // Distance of the step at the velocity of either end, beyond the actual one.
    let excess = step
        .velocities
        .map(|velocity| velocity * step.duration - distance);
    let [from, to] = of_both(|row| row.tangential_force);
    let velocity_term = (0.5 - time_level) * (from * excess[0] + to * excess[1]);
    record.work += mean([from, to]) * distance + velocity_term;
    record.normal_work += mean(of_both(|row| row.normal_force)) * distance.abs();
}

/// Search for the limit cycle of a repeated motion, and its stopping criterion.
pub(crate) struct LimitCycle {
    /// Duration of a cycle, \[s].
    pub(crate) period: f64,
    /// The slowest retardation time, \[s].
    pub(crate) slowest: f64,
    /// Remaining relative change at which the search stops.
    pub(crate) tolerance: f64,
}

impl LimitCycle {
    /// Finds the limit cycle by a fixed-point iteration on the history variables, beginning with `first`.
    ///
    /// `pass` follows one cycle from given history variables. It returns the record of the cycle and the history variables at its
    /// end, and reports the fraction of the cycle that is done.
    ///
    /// # Errors
    /// [`BemError::CycleTooShort`] if the change per cycle is below rounding; [`BemError::NotPeriodic`] after [`MAX_CYCLES`] cycles;
    /// those of `pass`.
    pub(crate) fn find(
        &self,
        first: Vec<f64>,
        mut pass: impl FnMut(&[f64], &dyn Fn(f64)) -> Result<(MotionRecord, Vec<f64>), BemError>,
        report: &dyn Fn(f64),
    ) -> Result<MotionRecord, BemError> {
        // 1/(1 − e^(−T/λ)): total remaining change over the change by one cycle, for the slowest retardation time λ.
        let slowness = -(-self.period / self.slowest).exp_m1().recip();
        if slowness * CYCLE_ROUNDING > self.tolerance {
            let (period, slowest) = (self.period, self.slowest);
            return Err(BemError::CycleTooShort { period, slowest });
        }
        // Progress is the larger of the fractions of the cycles allowed and of the convergence, in logarithms.
        let (mut n_cycles, convergence) = (0, Cell::new(0.0_f64));
        let pass = |from: &[f64]| {
            let begun = f64::from(n_cycles);
            let cycle = pass(from, &|part| {
                report(convergence.get().max((begun + part) / MAX_CYCLES as f64));
            });
            n_cycles += 1;
            cycle
        };
        let remaining_change = |now: &mut MotionRecord, before: &MotionRecord| {
            let change = now.rest_after(before, slowness);
            let part = (change.ln() / self.tolerance.ln()).clamp(0.0, 1.0);
            convergence.set(convergence.get().max(part));
            change
        };
        match anderson_fixed_point(first, MAX_CYCLES, self.tolerance, pass, remaining_change)? {
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

/// Remaining relative change at which a cycle counts as the limit cycle.
pub(crate) const fn cycle_tolerance(accuracy: Accuracy) -> f64 {
    match accuracy {
        Accuracy::RelativeError(asked) => CYCLE_TOLERANCE_FRACTION * asked,
        Accuracy::Elements(_) => CYCLE_TOLERANCE_ON_ONE_GRID,
    }
}

/// Record of one step: force, depth and contact at its end.
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

/// Largest retardation time of a material, \[s]; 0 if it has none.
pub(crate) fn slowest_retardation_time(creep: &CreepSpectrum) -> f64 {
    let times = creep
        .elements()
        .iter()
        .map(|element| element.retardation_time);
    times.fold(0.0, f64::max)
}

/// Bounding rectangle of two footprints.
fn bounding_footprint(a: Footprint, b: Footprint) -> Footprint {
    let both = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
    Footprint {
        x: both(a.x, b.x),
        y: both(a.y, b.y),
    }
}
