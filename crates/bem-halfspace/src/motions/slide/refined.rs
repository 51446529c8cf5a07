//! Sliding from first touch on with an error bar of every quantity: over a distance, or until the state is stationary.

use indenters::{Control, SlidingLoad, Surface};
use numerics::{Accuracy, ErrorParts, Estimate, FIRST_ELEMENTS, Goal, Request};
use rheology::{CreepSpectrum, Material as _};

use crate::estimate::bars::{self, ContactEstimate, OnGrid, Resolution, Target, peak_has_limit};
use crate::estimate::plan::GridPlan;
use crate::estimate::quantities::Quantities;
use crate::motions::slide::stationary_limit::slide_until_stationary;
use crate::motions::slide::{
    March, PressureField, SlideRow, StationaryOptions, Transient, follow_march,
};
use crate::stepping::{BYTES_PER_FOLLOWED_ELEMENT, BYTES_PER_STEP, MARCH_WORK_EXPONENT};
use crate::{BemError, ContactOptions, Elastomer, GridOptions};

/// Elements along the contact after which a march in time gives up; it takes about a minute.
const MAX_ELEMENTS_OF_SLIDE: usize = 32;
/// Order of the error under a smooth body, that of a step in time.
const ORDER_OF_SLIDE: f64 = 1.0;
/// Contact lengths of the one-dimensional model until the state counts as stationary where nothing but flow is slow.
const FLOW_CONTACT_LENGTHS: f64 = 24.0;
const MAX_DRIFT: f64 = 0.05;
/// Distances v λ of the slowest element until a solid counts as stationary.
const MAX_DISTANCE_OVER_MEMORY: f64 = 12.0;
/// Of a contact: over a shorter distance elements are not made as short as a step.
const MIN_DISTANCE_FOR_WHOLE_ELEMENTS: f64 = 2.0 / 3.0;
/// Contact lengths after which a march to the stationary state is not begun.
const MAX_CONTACT_LENGTHS: f64 = 500.0;
/// Change of the friction by which a solid counts as stationary, relative to the error asked for.
const CHANGE_OVER_ERROR: f64 = 0.1;

/// The end of a march with its error bars: after the sliding distance, or in the stationary state.
pub type SlideEstimate = ContactEstimate<Transient, GridOptions>;

/// Slides `surface` over a linear viscoelastic half space from first touch on, in time, under a force or at a depth: over
/// the sliding distance of the load, or without one until the state is stationary.
///
/// ```
/// use bem_halfspace::indenters::PowerProfile;
/// use bem_halfspace::{SlidingLoad, rheology::Viscous, slide};
///
/// let (cone, fluid) = (PowerProfile::cone(0.1)?, Viscous::new(1e4)?);
/// let load = SlidingLoad::new(1.0, 0.01)?.after(5e-3)?;
/// let slid = slide(&cone, &fluid, &load, 0.2)?;
/// // From no friction at first touch.
/// let rows = &slid.finest.rows;
/// assert!(rows[0].friction_coefficient < slid.friction_coefficient.value);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BemError::NotReached`] with what was reached on the finest grid allowed; [`BemError::SlidingDistanceMissing`] at a
/// depth; [`BemError::MemoryTooLong`]; [`BemError::NotStationary`]; and the errors of
/// [`slide_on_grid`](super::slide_on_grid).
pub fn slide<'w>(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    request: impl Into<Request<'w>>,
) -> Result<SlideEstimate, BemError> {
    PlannedSlide::new(surface, elastomer, load, request.into())?.solve()
}

/// Memory that [`slide`] takes at most for a number of elements along the contact, \[bytes].
///
/// # Errors
/// As for [`slide`], before anything is solved.
pub fn slide_memory(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    elements: usize,
) -> Result<f64, BemError> {
    let problem = PlannedSlide::new(
        surface,
        elastomer,
        load,
        Accuracy::Elements(elements).into(),
    )?;
    let options = problem.options(elements);
    let (spacing, footprint) = (options.spacing, options.footprint);
    let n_fields = problem.creep.elements().len() + usize::from(problem.creep.fluidity() > 0.0);
    let PlannedDistance { distance, step, .. } = problem.distance;
    let steps = distance / step * elements as f64;
    // A material without memory needs no more elements than the footprint has.
    let behind = if n_fields > 0 {
        distance / spacing[0]
    } else {
        0.0
    };
    let across = (footprint.y[1] - footprint.y[0]) / spacing[1];
    let followed = if surface.mirrors()[1] { 0.5 } else { 1.0 };
    let n_elements = followed * (footprint.n_elements(spacing) + behind * across);
    let per_element = BYTES_PER_FOLLOWED_ELEMENT + (n_fields * size_of::<f64>()) as f64;
    Ok(per_element * n_elements + BYTES_PER_STEP * steps)
}

/// One march, the friction at its end, and the error of its extrapolation to the stationary state, where that is asked for.
type End = (Transient, f64, Option<f64>);

struct PlannedSlide<'a> {
    surface: &'a dyn Surface,
    elastomer: &'a dyn Elastomer,
    load: &'a SlidingLoad,
    creep: CreepSpectrum,
    plan: GridPlan,
    distance: PlannedDistance,
    request: Request<'a>,
}

/// The distance that is slid, and on what elements and steps, so that it is a whole number of both on all grids.
#[derive(Clone, Copy)]
struct PlannedDistance {
    /// \[m], the longest for a stationary state.
    distance: f64,
    /// Length of an element times the elements along the contact, \[m].
    length: f64,
    /// The same of a step: over less than a contact steps are shorter than elements, and become shorter with them.
    step: f64,
}

impl PlannedDistance {
    fn new(plan: &GridPlan, load: &SlidingLoad, memory: f64) -> Self {
        let length = plan.length();
        let Some(distance) = load.sliding_distance() else {
            let lengths =
                FLOW_CONTACT_LENGTHS + (MAX_DISTANCE_OVER_MEMORY * memory / length).ceil();
            return Self {
                distance: lengths * length,
                length,
                step: length,
            };
        };
        let step = distance / (distance / length).round().max(1.0);
        let length = if step < MIN_DISTANCE_FOR_WHOLE_ELEMENTS * length {
            length
        } else {
            step
        };
        Self {
            distance,
            length,
            step,
        }
    }
}

impl<'a> PlannedSlide<'a> {
    fn new(
        surface: &'a dyn Surface,
        elastomer: &'a dyn Elastomer,
        load: &'a SlidingLoad,
        request: Request<'a>,
    ) -> Result<Self, BemError> {
        load.require_fresh_ground()?;
        let plan = GridPlan::sliding(surface, elastomer, load)?;
        let creep = elastomer.material().creep();
        Ok(Self {
            distance: PlannedDistance::new(&plan, load, memory_length(elastomer, load)),
            plan,
            creep,
            surface,
            elastomer,
            load,
            request,
        })
    }

    fn solve(&self) -> Result<SlideEstimate, BemError> {
        let resolution = Resolution {
            goal: Goal {
                request: self.request,
                initial_elements: FIRST_ELEMENTS,
                max_elements: MAX_ELEMENTS_OF_SLIDE,
                order: bars::order_of_friction(self.plan.apex_exponent, ORDER_OF_SLIDE),
                work_exponent: MARCH_WORK_EXPONENT,
                extra_work: 0.0,
                selection_factor: 2.0,
            },
            control: self.load.control(),
            // Nothing is dissipated in an elastic half space, where the depth stands for the friction.
            target: if self.creep.is_elastic() {
                Target::Depth
            } else {
                Target::Friction
            },
            has_peak: peak_has_limit(self.surface, self.elastomer),
            max_dissipation_error_ratio: 0.0,
        };
        let march = |elements, report: &dyn Fn(f64)| self.march(elements, report);
        bars::resolve(&resolution, march, |mut estimate: SlideEstimate| {
            if self.creep.is_elastic() {
                estimate.friction_coefficient = Estimate::exact(0.0);
                estimate.error_parts = ErrorParts::NONE;
            }
            if self.load.sliding_distance().is_none() {
                self.widen_by_remaining_change(&mut estimate);
            }
            Ok(estimate)
        })
    }

    /// Depth, area and ends of the contact come to rest more slowly than friction, by which a march ends.
    fn widen_by_remaining_change(&self, estimate: &mut SlideEstimate) {
        let left = |of: &dyn Fn(&SlideRow) -> f64| remaining_change(&estimate.finest.rows, of);
        let [depth, area] = [
            left(&|row| row.indentation_depth),
            left(&|row| row.contact_area),
        ];
        let ends = [0, 1].map(|end| {
            let along = left(&|row| row.contact_x[end]);
            along.max(left(&|row| row.contact_y[end]))
        });
        let known = estimate.indentation_depth;
        let known = known.filter(|_| self.creep.fluidity() <= 0.0);
        estimate.indentation_depth = known.map(|known| known.widened(depth));
        estimate.contact_area = estimate.contact_area.widened(area);
        estimate.contact_box_error += ends[0].max(ends[1]);
    }

    /// At a depth the body reaches the boundary of its footprint.
    fn options(&self, elements: usize) -> GridOptions {
        let spacing = self.distance.length / elements as f64;
        let footprint = match self.load.control() {
            Control::NormalForce(_) => self.plan.footprint,
            Control::IndentationDepth(_) => self.plan.footprint.widened(spacing),
        };
        GridOptions::new([spacing; 2], footprint)
    }

    fn march(
        &self,
        elements: usize,
        report: &dyn Fn(f64),
    ) -> Result<OnGrid<Transient, GridOptions>, BemError> {
        let options = self.options(elements);
        let (control, distance) = (self.load.control(), self.load.sliding_distance());
        let march = |load| {
            let step = self.distance.step / elements as f64;
            March::sliding_in_steps(self.surface, self.elastomer, load, &options, step)
        };
        let (transient, friction, truncation) = match (control, distance) {
            (Control::NormalForce(_), None) => {
                self.check_memory_length()?;
                let load = self.load.after(self.distance.distance)?;
                self.march_to_stationary(march(&load)?, &load, report)?
            }
            _ => slide_over_distance(march(self.load)?, self.load, report)?,
        };
        let last = transient.last();
        let quantities = Quantities {
            friction_coefficient: friction,
            normal_force: last.normal_force,
            indentation_depth: last.indentation_depth,
            contact_area: last.contact_area,
            peak_pressure: transient.pressure.largest(),
        };
        let iteration = || iteration_error(self.surface, &transient.pressure);
        Ok(OnGrid {
            quantities,
            dissipated: None,
            common_error: ErrorParts {
                iteration: (!self.creep.is_elastic()).then(iteration),
                truncation,
                ..ErrorParts::NONE
            },
            min_relative_error: 0.0,
            spacing: options.spacing[0],
            state: transient,
            options,
        })
    }

    /// Refuses a material that remembers the first touch for too long.
    fn check_memory_length(&self) -> Result<(), BemError> {
        let contact_length = self.plan.length();
        if self.distance.distance <= MAX_CONTACT_LENGTHS * contact_length {
            return Ok(());
        }
        Err(BemError::MemoryTooLong {
            memory: memory_length(self.elastomer, self.load),
            contact_length,
            limit: MAX_CONTACT_LENGTHS,
        })
    }

    fn march_to_stationary(
        &self,
        march: March<'_>,
        load: &SlidingLoad,
        report: &dyn Fn(f64),
    ) -> Result<End, BemError> {
        let memory = memory_length(self.elastomer, load);
        if memory > 0.0 {
            return self.march_until_settled(memory, march, load, report);
        }
        let end = slide_over_distance(march, load, report)?;
        if self.creep.is_elastic() {
            return Ok(end);
        }
        let state = end.0.stationary(MAX_DRIFT)?;
        let (friction, error) = (state.friction_coefficient, state.distance_error);
        Ok((end.0, friction, Some(error)))
    }

    /// Slides until a material that recovers has forgotten the first touch.
    fn march_until_settled(
        &self,
        memory: f64,
        march: March<'_>,
        load: &SlidingLoad,
        report: &dyn Fn(f64),
    ) -> Result<End, BemError> {
        let stationary = StationaryOptions {
            tolerance: match self.request.accuracy {
                Accuracy::RelativeError(error) => CHANGE_OVER_ERROR * error,
                Accuracy::Elements(_) => CHANGE_OVER_ERROR * MAX_DRIFT,
            },
            over_distance: 2.0 * self.plan.length() + memory,
        };
        let end = slide_until_stationary(march, load, &stationary, report)?;
        let friction = end.friction_coefficient;
        Ok((end.transient, friction, Some(end.rest * friction.abs())))
    }
}

fn slide_over_distance(
    march: March<'_>,
    load: &SlidingLoad,
    report: &dyn Fn(f64),
) -> Result<End, BemError> {
    let transient = follow_march(march, load, report)?;
    let friction = transient.last().friction_coefficient;
    Ok((transient, friction, None))
}

/// What is left of a quantity's way to the stationary state, at most: twice its change over the second half of a march. The track
/// behind the body misses what is beyond its beginning, which is felt in inverse proportion to the distance, so that as much
/// is left as has changed; on a material that flows the front comes to rest more slowly.
fn remaining_change(rows: &[SlideRow], of: &dyn Fn(&SlideRow) -> f64) -> f64 {
    let [last, half] = [rows.len(), rows.len().div_ceil(2)].map(|count| &rows[count - 1]);
    2.0 * (of(last) - of(half)).abs()
}

/// Distance in which the slowest element forgets, or on which a layer that flows feels a load that comes, \[m].
fn memory_length(elastomer: &dyn Elastomer, load: &SlidingLoad) -> f64 {
    let creep = elastomer.material().creep();
    let elements = creep.elements().iter();
    let times = elements.map(|element| element.retardation_time);
    let memory = load.velocity() * times.fold(0.0, f64::max);
    let base = elastomer.base();
    if creep.fluidity() > 0.0 && base.is_rigid() {
        memory.max(base.thickness())
    } else {
        memory
    }
}

/// How much a residual of the size of the tolerance changes the friction.
///
/// A residual that alternates from element to element changes the pressure by as many times its part of the displacement
/// as there are elements along the contact, and the friction by as much of the mean modulus of the slope.
fn iteration_error(surface: &dyn Surface, field: &PressureField) -> f64 {
    let ([rows, columns], [dx, dy]) = (field.grid.shape(), field.grid.spacing());
    let [mut load, mut rise] = [0.0; 2];
    for (index, pressure) in field.pressure.iter().enumerate() {
        let x = field.origin[0] + (index / columns) as f64 * dx;
        let y = field.origin[1] + (index % columns) as f64 * dy;
        let difference = surface.height([x + 0.5 * dx, y]) - surface.height([x - 0.5 * dx, y]);
        load += pressure;
        if *pressure > 0.0 {
            rise += pressure * (difference / dx).abs();
        }
    }
    ContactOptions::default().tolerance * rows as f64 * (rise / load)
}
