//! Sliding from first touch with an error bar of every quantity, over a distance or until the state is stationary.
//!
//! The march is repeated on finer and finer grids; elements and steps are refined together. Without a sliding distance the friction
//! coefficient at the end is extrapolated on a half space that flows, and on other materials the march goes on until it is settled.
//!
//! Theory: docs/theory/transient-half-space.md, "Finite sliding distance" and "Grid".

use indenters::{Control, SlidingLoad, Surface};
use numerics::{Accuracy, ErrorParts, ITERATION_SHARE, Request};
use rheology::{CreepSpectrum, Material as _};

use crate::estimate::bars::{self, ContactEstimate, OnGrid, Resolution, Target, peak_has_limit};
use crate::estimate::plan::GridPlan;
use crate::estimate::quantities::Quantities;
use crate::estimate::refinement_limits::{MARCH_ORDER, SLIDE};
use crate::march::{MarchExtent, largest_retardation_time, n_history_variables};
use crate::motions::slide::stationary_limit::slide_until_stationary;
use crate::motions::slide::{
    March, PressureField, SlideRow, StationaryOptions, Transient, follow_march,
};
use crate::{BemError, ContactOptions, Elastomer, GridOptions};

/// Longest sliding distance to the stationary state, in contact lengths of the one-dimensional model, if flow alone is slow. A
/// memory of the material adds to it ([`MAX_DISTANCE_OVER_MEMORY`]). Chosen; with half of it a bar is nine times as wide, with
/// twice as many a march takes 2.8 times as long (case of `evidence tuning`).
const FLOW_CONTACT_LENGTHS: f64 = 24.0;
/// Largest relative change of the friction coefficient over the second half of a march that is extrapolated to the stationary
/// state. Also the relative error that is assumed where a number of elements is asked for. Chosen; with 0.01 a march is refused,
/// from 0.05 to 1 only times change (case of `evidence tuning`).
const MAX_DRIFT: f64 = 0.05;
/// Number of memory lengths v λ that [`FLOW_CONTACT_LENGTHS`] is extended by, for the velocity v and the largest retardation time
/// λ. A march ends earlier if the friction has settled, and fails with [`BemError::NotStationary`] otherwise. Chosen; from 1.2 to
/// 120 no answer changes by more than 1e-13 of its bar (case of `evidence tuning`).
const MAX_DISTANCE_OVER_MEMORY: f64 = 12.0;
/// Smallest sliding distance, in contact lengths, to which the elements are fitted so that it is a whole number of them. Over a
/// shorter distance the elements keep their length and the steps are shorter. Chosen: the fit changes their length by a factor of
/// 2/3 to 3/2. With a smaller distance it would make contacts of fewer elements.
const MIN_DISTANCE_FOR_WHOLE_ELEMENTS: f64 = 2.0 / 3.0;
/// Longest march to the stationary state, in contact lengths. Chosen to limit the time, which grows in proportion to it: a longer
/// march is refused with [`BemError::MemoryTooLong`].
const MAX_CONTACT_LENGTHS: f64 = 500.0;

/// State at the end of a march with error bars: after the sliding distance, or in the stationary state.
pub type SlideEstimate = ContactEstimate<Transient, GridOptions>;

/// Slides `surface` over a linear viscoelastic half space or layer in time, from first touch under a force or at a depth.
///
/// The motion ends after the sliding distance of the load, or without one when the state is stationary.
///
/// ```
/// use bem_halfspace::indenters::PowerProfile;
/// use bem_halfspace::{SlidingLoad, rheology::Viscous, slide};
///
/// let (cone, fluid) = (PowerProfile::cone(0.1)?, Viscous::new(1e4)?);
/// let load = SlidingLoad::new(1.0, 0.01)?.after(5e-3)?;
/// let slid = slide(&cone, &fluid, &load, 0.2)?;
/// // Friction grows from zero at first touch.
/// let rows = &slid.finest.rows;
/// assert!(rows[0].friction_coefficient < slid.friction_coefficient.value);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BemError::NotReached`] with the result on the finest grid allowed; [`BemError::SlidingDistanceMissing`] at a
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

/// Upper bound of the memory of [`slide`] for a number of elements along the contact, \[bytes].
///
/// # Errors
/// As for [`slide`], without the errors of the solution.
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
    let n_fields = n_history_variables(&problem.creep);
    let PlannedDistance { distance, step, .. } = problem.planned;
    let extent = MarchExtent {
        // Without history variables the elements of the footprint are enough.
        passed_length: if n_fields > 0 { distance } else { 0.0 },
        numbers_per_element: n_fields,
        n_steps: distance / step * elements as f64,
    };
    Ok(extent.memory(surface, &problem.options(elements)))
}

/// Result of one march.
struct MarchEnd {
    /// Transient up to the end of the march.
    transient: Transient,
    /// Friction coefficient at the end, or in the stationary state.
    friction: f64,
    /// Absolute error of `friction` by the finite sliding distance; `None` if a distance is asked for.
    truncation: Option<f64>,
}

/// The problem of a body that slides from first touch, which can be solved on any number of elements.
struct PlannedSlide<'a> {
    /// Body that slides.
    surface: &'a dyn Surface,
    /// Half space or layer under it.
    elastomer: &'a dyn Elastomer,
    /// Load and sliding distance.
    load: &'a SlidingLoad,
    /// Creep spectrum of the material in shear.
    creep: CreepSpectrum,
    /// Footprint and approximate contact length.
    plan: GridPlan,
    /// Sliding distance and lengths of elements and steps.
    planned: PlannedDistance,
    /// Requested accuracy, and the receiver of the progress.
    request: Request<'a>,
}

/// Sliding distance with the lengths of elements and steps, of which it is a whole number on all grids.
#[derive(Clone, Copy)]
struct PlannedDistance {
    /// Sliding distance, \[m]; for a stationary state the longest one.
    distance: f64,
    /// Length of an element times the number of elements along the contact, \[m].
    length: f64,
    /// Length of a step times the number of elements along the contact, \[m]; less than `length` over a distance shorter than the
    /// contact.
    step: f64,
}

impl PlannedDistance {
    /// Sliding distance of a load; without one, the longest distance to the stationary state, for the memory length \[m] of the
    /// material.
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
        // Divide the distance evenly into parts of about a contact length; elements follow unless the distance is short.
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
    /// Plans grid and distance of a slide from first touch. Fails for a load on a track, on which the body meets its own trace.
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
            planned: PlannedDistance::new(&plan, load, memory_length(elastomer, load)),
            plan,
            creep,
            surface,
            elastomer,
            load,
            request,
        })
    }

    /// Solves on finer and finer grids until the friction coefficient, or without friction the depth, has the error asked for; or
    /// on the one grid asked for.
    fn solve(&self) -> Result<SlideEstimate, BemError> {
        let order = bars::order_of_friction(self.plan.apex_exponent, MARCH_ORDER);
        let resolution = Resolution {
            goal: SLIDE.goal(self.request, order),
            control: self.load.control(),
            // An elastic half space has no friction to refine by; its depth takes that place.
            target: if self.creep.is_elastic() {
                Target::Depth
            } else {
                Target::Friction
            },
            has_peak: peak_has_limit(self.surface, self.elastomer),
        };
        let march = |elements, report: &dyn Fn(f64)| self.march(elements, report);
        bars::resolve(&resolution, march, |mut estimate: SlideEstimate| {
            if self.creep.is_elastic() {
                estimate.remove_friction();
            }
            if self.load.sliding_distance().is_none() {
                self.widen_by_remaining_change(&mut estimate);
            }
            Ok(estimate)
        })
    }

    /// Widens the bars of depth, area and contact box by their remaining change: they become stationary more slowly than friction,
    /// by which the march ends.
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
        // A material that flows has no stationary depth, so that no depth is returned.
        estimate.indentation_depth = estimate
            .indentation_depth
            .filter(|_| self.creep.fluidity() <= 0.0)
            .map(|known| known.widened(depth));
        estimate.contact_area = estimate.contact_area.widened(area);
        estimate.contact_box_error += ends[0].max(ends[1]);
    }

    /// Grid of square elements, `elements` of them along the contact. At a given depth the body reaches the boundary of its footprint,
    /// which is therefore widened.
    fn options(&self, elements: usize) -> GridOptions {
        let spacing = self.planned.length / elements as f64;
        let footprint = match self.load.control() {
            Control::NormalForce(_) => self.plan.footprint,
            Control::IndentationDepth(_) => self.plan.footprint.widened(spacing),
        };
        GridOptions::new([spacing; 2], footprint)
    }

    /// Marches to the end of the motion on a number of elements along the contact; `report` receives the fraction that is done.
    fn march(
        &self,
        elements: usize,
        report: &dyn Fn(f64),
    ) -> Result<OnGrid<Transient, GridOptions>, BemError> {
        let options = self.options(elements);
        let (control, distance) = (self.load.control(), self.load.sliding_distance());
        let march = |load| {
            let step = self.planned.step / elements as f64;
            March::sliding_in_steps(self.surface, self.elastomer, load, &options, step)
        };
        // Under a force without a sliding distance, march to the stationary state; otherwise march over the sliding distance.
        let end = match (control, distance) {
            (Control::NormalForce(_), None) => {
                self.check_memory_length()?;
                let load = self.load.after(self.planned.distance)?;
                self.march_to_stationary(march(&load)?, &load, report)?
            }
            _ => slide_over_distance(march(self.load)?, self.load, report)?,
        };
        let transient = end.transient;
        let last = transient.last();
        let quantities = Quantities {
            friction_coefficient: end.friction,
            normal_force: last.normal_force,
            indentation_depth: last.indentation_depth,
            contact_area: last.contact_area,
            peak_pressure: transient.pressure.largest(),
        };
        // A residual disturbs the friction, except on an elastic material, whose friction is exactly 0.
        let iteration = || iteration_error(self.surface, &transient.pressure);
        Ok(OnGrid {
            quantities,
            common_error: ErrorParts {
                iteration: (!self.creep.is_elastic()).then(iteration),
                truncation: end.truncation,
                ..ErrorParts::NONE
            },
            target_uncertainty: if self.creep.is_elastic() {
                0.0
            } else {
                transient.pressure.friction_uncertainty(self.surface)
            },
            area_uncertainty: last.contact_area_uncertainty,
            area_order: None,
            spacing: options.spacing[0],
            state: transient,
            options,
        })
    }

    /// Fails with [`BemError::MemoryTooLong`] if the march to the stationary state is longer than [`MAX_CONTACT_LENGTHS`].
    fn check_memory_length(&self) -> Result<(), BemError> {
        let contact_length = self.plan.length();
        if self.planned.distance <= MAX_CONTACT_LENGTHS * contact_length {
            return Ok(());
        }
        Err(BemError::MemoryTooLong {
            memory: memory_length(self.elastomer, self.load),
            contact_length,
            limit: MAX_CONTACT_LENGTHS,
        })
    }

    /// Marches to the stationary state, and estimates the error by the finite distance. `report` receives the fraction of the longest
    /// distance.
    fn march_to_stationary(
        &self,
        march: March<'_>,
        load: &SlidingLoad,
        report: &dyn Fn(f64),
    ) -> Result<MarchEnd, BemError> {
        let memory = memory_length(self.elastomer, load);
        if memory <= 0.0 {
            // If the material is elastic or flow alone is slow, march over the whole distance S. On a half space that flows,
            // extrapolate to 1/S = 0.
            let end = slide_over_distance(march, load, report)?;
            if self.creep.is_elastic() {
                return Ok(end);
            }
            let state = end.transient.stationary(MAX_DRIFT)?;
            return Ok(MarchEnd {
                friction: state.friction_coefficient,
                truncation: Some(state.distance_error),
                ..end
            });
        }
        // Otherwise march until the friction has settled over a distance that is longer than contact and memory.
        let accuracy = self.request.accuracy;
        let stationary = StationaryOptions {
            tolerance: ITERATION_SHARE * accuracy.relative_error().unwrap_or(MAX_DRIFT),
            over_distance: 2.0 * self.plan.length() + memory,
        };
        let end = slide_until_stationary(march, load, &stationary, report)?;
        Ok(MarchEnd {
            transient: end.transient,
            friction: end.friction_coefficient,
            truncation: Some(end.truncation_error * end.friction_coefficient.abs()),
        })
    }
}

/// Solves all steps of a march over its whole distance; the friction coefficient of the result is that of the last step.
fn slide_over_distance(
    march: March<'_>,
    load: &SlidingLoad,
    report: &dyn Fn(f64),
) -> Result<MarchEnd, BemError> {
    let transient = follow_march(march, load, report)?;
    Ok(MarchEnd {
        friction: transient.last().friction_coefficient,
        transient,
        truncation: None,
    })
}

/// Upper bound of the remaining change of a quantity, `of(row)`, to its stationary value: twice its change over the second half of a
/// march.
///
/// The missing part of the track, beyond its beginning, acts in inverse proportion to the distance, so that the remaining change is
/// as large as the last one. On a material that flows the front becomes stationary more slowly, hence the factor 2.
fn remaining_change(rows: &[SlideRow], of: &dyn Fn(&SlideRow) -> f64) -> f64 {
    let [last, half] = [rows.len(), rows.len().div_ceil(2)].map(|count| &rows[count - 1]);
    2.0 * (of(last) - of(half)).abs()
}

/// Memory length v λ_max of the largest retardation time, \[m]. On a layer that flows it is at least the thickness, the distance over
/// which a load displaces the surface. It is 0 on an elastic material and on a half space with flow alone.
fn memory_length(elastomer: &dyn Elastomer, load: &SlidingLoad) -> f64 {
    let creep = elastomer.material().creep();
    let memory = load.velocity() * largest_retardation_time(&creep);
    let base = elastomer.base();
    if creep.fluidity() > 0.0 && base.is_rigid() {
        memory.max(base.thickness())
    } else {
        memory
    }
}

/// Absolute error of the friction coefficient by a residual of the contact of the size of its tolerance.
///
/// A residual ε that alternates from element to element changes the pressure relatively by ε times the number of elements along the
/// contact, and the friction by the same fraction of the mean modulus of the slope.
fn iteration_error(surface: &dyn Surface, field: &PressureField) -> f64 {
    // Compute the mean of |∂h/∂x|, weighted with the pressure, from chords over the elements.
    let weighted = field.pressure.iter().zip(field.slopes(surface));
    let rise: f64 = weighted
        .map(|(pressure, slope)| pressure * slope.abs())
        .sum();
    let load: f64 = field.pressure.iter().sum();
    ContactOptions::default().tolerance * field.grid.shape()[0] as f64 * (rise / load)
}
