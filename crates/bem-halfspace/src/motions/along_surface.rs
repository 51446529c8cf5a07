//! Any motion along the surface with its error bars: starts, stops, dwells, returns, once or reciprocating.
//!
//! In a step the body moves by at most a third of an element, and after a stop steps grow, so that elements and steps are refined
//! together. Loads are linear over a step and forces belong to its end, so that steps are of second order, except on a
//! material without instantaneous compliance.
//!
//! Theory: docs/theory/transient-half-space.md, "Motions" and "Linear loads".

use indenters::{
    Control, MotionRecord, MotionStep, MotionView, Moved, MovingLoad, MovingStep, PressingLoad,
    SlidingLoad, Surface,
};
use numerics::{Accuracy, MAX_STORED_STATES, Request};
use rheology::{CreepSpectrum, Material as _};

use crate::elements::footprint::Footprint;
use crate::estimate::bars::{FRONT_ORDER, order_of_friction};
use crate::estimate::plan::GridPlan;
use crate::estimate::refinement_limits::{MARCH_ORDER, MOTION};
use crate::march::free::{Schedule, TimedMotion};
use crate::march::{MAX_STEPS, MarchExtent, n_history_variables};
use crate::motions::any_motion::{LimitCycle, refine_motion};
use crate::motions::indent::footprint_after;
use crate::motions::slide::{March, Motion, MotionRow};
use crate::{BemError, Elastomer, GridOptions};

/// Number of time steps in which the body passes an element at its largest speed. With three, the errors of steps and of elements
/// are about equal (docs/theory/transient-half-space.md, "Linear loads"; case of `evidence tuning`).
const STEPS_PER_ELEMENT: usize = 3;

/// Moves `surface` over an undeformed half space or layer, through the points of a motion or reciprocating until the limit cycle.
///
/// The request is an error of the mean friction coefficient relative to its value, or a number of elements along the contact. At
/// the beginning the body is pressed instantaneously. The friction force of a motion through points has the same error, relative
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
    let order = order_of_friction(problem.plan.apex_exponent, MARCH_ORDER);
    let goal = MOTION.goal(request, order);
    let is_elastic = problem.creep.is_elastic();
    // Extrapolate only cycles on viscoelastic materials, and not under cusps sharper than a cone, which converge with an order of
    // their own. Measured on 24 strokes: the errors fall with orders from 1.2 to 2. An extrapolation with 1.5 to 2 halves them and
    // removes their common sign (docs/theory/transient-half-space.md, "Linear loads").
    let has_known_order = load.is_cycle() && !is_elastic && order >= MARCH_ORDER;
    let view = MotionView {
        load,
        is_elastic,
        extrapolation_order: has_known_order.then_some(FRONT_ORDER),
    };
    refine_motion(
        &goal,
        &view,
        |elements, report| problem.solve_on_grid(elements, report),
        |record| view.truncation_errors(record),
    )
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
    let max_step_length = options.spacing[0] / STEPS_PER_ELEMENT as f64;
    let [rear, front] = load.range();
    // The fixed-point iteration stores several states of the history variables.
    let copies = if problem.limit_cycle.is_some() {
        MAX_STORED_STATES
    } else {
        1
    };
    let extent = MarchExtent {
        passed_length: front - rear,
        // The last load is stored in addition to the history variables.
        numbers_per_element: copies * (n_history_variables(&problem.creep) + 1),
        n_steps: load.n_steps(STEPS_PER_ELEMENT * elements, max_step_length, MAX_STEPS)?,
    };
    Ok(extent.memory(surface, &options))
}

/// The problem of a moving body, which can be solved on any number of elements.
struct MovingBody<'a> {
    /// Body that moves.
    surface: &'a dyn Surface,
    /// Half space or layer under it.
    elastomer: &'a dyn Elastomer,
    /// Motion and load.
    load: &'a MovingLoad,
    /// Creep spectrum of the material in shear.
    creep: CreepSpectrum,
    /// Footprint in which contact may occur, and approximate contact length.
    plan: GridPlan,
    /// Search for the limit cycle; `None` for a motion through points.
    limit_cycle: Option<LimitCycle>,
}

impl<'a> MovingBody<'a> {
    /// Plans grid and footprint. Fails with [`BemError::NoCycle`] for a cycle on a material that flows.
    fn new(
        surface: &'a dyn Surface,
        elastomer: &'a dyn Elastomer,
        load: &'a MovingLoad,
        accuracy: Accuracy,
    ) -> Result<Self, BemError> {
        let creep = elastomer.material().creep();
        let limit_cycle = LimitCycle::new(load, &creep, accuracy)?;
        // Plan the grid for sliding at the largest load and speed. Under a force the footprint is extended, because the body may
        // sink deeper while it dwells.
        let control = load.largest_control();
        let fastest = SlidingLoad::with(control, load.fastest())?;
        let mut plan = GridPlan::sliding(surface, elastomer, &fastest)?;
        if let Control::NormalForce(_) = control {
            let duration = if limit_cycle.is_some() {
                f64::MAX
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
            limit_cycle,
        })
    }

    /// Grid of square elements, about `elements` of them along the contact.
    fn options(&self, elements: usize) -> GridOptions {
        let spacing = self.plan.length() / elements as f64;
        GridOptions::new([spacing; 2], self.plan.footprint.widened(spacing))
    }

    /// Follows the motion, or finds its limit cycle, on one grid with a number of elements along the contact; `report` receives the
    /// fraction that is done.
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

        // Begin with a first touch at rest, in which the body is pressed only, for as long as the first step takes. The steps of the
        // motion, or of one cycle, follow it.
        let start = self.load.stages()[0].start;
        let touch = steps[0].duration;
        let ends = steps.iter().map(|step| (step.end, step.duration));
        let points = std::iter::once((start, touch)).chain(ends);
        let motions = points.map(|(point, duration)| TimedMotion {
            end: Motion {
                time: point.time,
                position: point.position - start.position,
                control: point.control,
            },
            duration,
        });
        let schedule = Schedule::repeated(motions, spacing)?;
        let mut march = March::from_schedule(self.surface, self.elastomer, schedule, &options)?;
        let Some(limit_cycle) = &self.limit_cycle else {
            return Ok(record(&steps, &march.run(report)?, spacing));
        };

        // Solve the first touch. The first cycle begins with the history variables that it leaves.
        march.step()?;
        let touched = march.history_variables();
        let cycle = |from: &[f64], report: &dyn Fn(f64)| {
            march.restart_with(from);
            let mut rows = march.run(report)?;
            // The limit cycle begins with the state in which it ends, so that the last row is repeated in front of the first one.
            rows.insert(0, rows[rows.len() - 1]);
            Ok((record(&steps, &rows, spacing), march.history_variables()))
        };
        limit_cycle.find(touched, cycle, report)
    }
}

/// Record of a motion on elements of a `spacing` \[m]; `rows` has the states before the first step and after each step.
fn record(steps: &[MovingStep], rows: &[MotionRow], spacing: f64) -> MotionRecord {
    let mut record = MotionRecord {
        spacing,
        ..MotionRecord::default()
    };
    for (step, ends) in steps.iter().zip(rows.windows(2)) {
        // Add the work of the step to the record, and append the state at the end of the step.
        let (before, row) = (&ends[0], &ends[1]);
        add_work(&mut record, step, before, row);
        record.steps.push(MotionStep {
            stage: step.stage,
            time: step.end.time,
            position: step.end.position,
            tangential_force: row.tangential_force,
            normal_force: row.normal_force,
            indentation_depth: row.indentation_depth,
            contact_area: Some(row.divided_area),
            contact: row.contact_x,
            n_contact: row.n_contact,
        });
    }
    record
}

/// Adds the work ∫ F_t dx of a step and ∫ F_N |dx| to the record, \[J], with forces that belong to the time θ Δt before its end.
///
/// `before` and `now` are the states at the beginning and at the end of the step. θ = 0 gives the trapezoidal rule in time, ½ Δt
/// (F_old v_old + F_new v_new), whose errors cancel over a sinusoidal cycle; θ = ½ gives the midpoint rule F_new Δx. In between,
/// both are blended with the weights 1 − 2θ and 2θ.
fn add_work(record: &mut MotionRecord, step: &MovingStep, before: &MotionRow, now: &MotionRow) {
    let time_level = now.time_level;
    let distance = now.position - before.position;
    let mean = |[from, to]: [f64; 2]| to + (0.5 - time_level) * (from - to);
    // This closure returns the values of a quantity at the beginning and at the end of the step.
    let of_both = |of: fn(&MotionRow) -> f64| [before, now].map(of);
    // Compute by how much the distances at the initial and at the final velocity of the step exceed the distance that the body
    // moves, \[m].
    let excess = step
        .velocities
        .map(|velocity| velocity * step.duration - distance);
    let [from, to] = of_both(|row| row.tangential_force);
    let velocity_term = (0.5 - time_level) * (from * excess[0] + to * excess[1]);
    record.work += mean([from, to]) * distance + velocity_term;
    record.normal_work += mean(of_both(|row| row.normal_force)) * distance.abs();
}

/// Bounding rectangle of two footprints.
fn bounding_footprint(a: Footprint, b: Footprint) -> Footprint {
    let both = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
    Footprint {
        x: both(a.x, b.x),
        y: both(a.y, b.y),
    }
}
