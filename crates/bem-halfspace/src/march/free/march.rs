//! Constructors of a [`March`] and its public step.
//!
//! Theory: docs/theory/transient-half-space.md, "Motions" and "Friction".

use indenters::{SlidingLoad, Surface};
use numerics::positive;

use super::{LoadInterpolation, March, MeanSlopes, Motion, MotionRow, Schedule};
use crate::elements::grid::whole_elements;
use crate::{BemError, Elastomer, GridOptions};

/// Number of steps above which a march, or one cycle of it, is refused; chosen.
pub(crate) const MAX_STEPS: f64 = 1e5;
/// Power of the elements along the contact with which the work of a march grows: elements along x and y, times as many steps.
pub(crate) const MARCH_WORK_EXPONENT: f64 = 3.0;
/// Memory per followed element without its history variables, \[bytes].
pub(crate) const BYTES_PER_FOLLOWED_ELEMENT: f64 = 150.0;
/// Memory per step of a march, \[bytes].
pub(crate) const BYTES_PER_STEP: f64 = 600.0;

/// Reason in the error for a load without a sliding distance.
const DISTANCE_NEEDED: &str = "a march over a half space ends after a distance";

impl<'a> March<'a> {
    /// A march through `motions`, from an undeformed half space at time zero, where the lowest point is over the centre
    /// of an element at position zero.
    ///
    /// If surface and footprint are [their own mirror images](Surface::mirrors) about y = 0, only the half y ≥ 0 is followed. If
    /// the indenter never moves, the same holds about x = 0.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for no motions, times that do not increase from above zero, and numbers out of
    /// range; [`BemError::GridTooLarge`]; [`BemError::InvalidHeight`]; [`BemError::Material`].
    pub fn new(
        surface: &'a dyn Surface,
        elastomer: &dyn Elastomer,
        motions: &[Motion],
        options: &GridOptions,
    ) -> Result<Self, BemError> {
        let spacing = positive("spacing along x", options.spacing[0])?;
        // Durations are differences of the times.
        let mut before = 0.0;
        let timed = motions.iter().map(|&motion| {
            let time_step = motion.time - before;
            before = motion.time;
            (motion, time_step)
        });
        let schedule = Schedule::new(timed, spacing)?;
        Self::from_schedule(
            schedule,
            LoadInterpolation::Held,
            surface,
            elastomer,
            options,
        )
    }

    /// Fraction of the steps that are done, from 0 to 1.
    pub(crate) fn fraction_done(&self) -> f64 {
        self.steps_done as f64 / self.schedule.steps.len() as f64
    }

    /// The march of [`slide_on_grid`](crate::motions::slide::slide_on_grid): over the sliding distance of the load in steps of one
    /// element. The last step ends at that distance and is 0.5 to 1.5 elements long.
    ///
    /// # Errors
    /// [`BemError::SlidingDistanceMissing`]; [`BemError::TooManySteps`]; otherwise like [`new`](Self::new).
    pub fn sliding(
        surface: &'a dyn Surface,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
        options: &GridOptions,
    ) -> Result<Self, BemError> {
        Self::sliding_in_steps(surface, elastomer, load, options, options.spacing[0])
    }

    /// Like [`sliding`](Self::sliding) in steps of a given length \[m].
    pub(crate) fn sliding_in_steps(
        surface: &'a dyn Surface,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
        options: &GridOptions,
        length: f64,
    ) -> Result<Self, BemError> {
        load.require_fresh_ground()?;
        let spacing = positive("spacing along x", options.spacing[0])?;
        let distance = load
            .sliding_distance()
            .ok_or(BemError::SlidingDistanceMissing {
                why: DISTANCE_NEEDED,
            })?;
        // Equal steps, and a last one that ends at the distance.
        let (n_steps, last) = divide_into_steps(distance, length)?;
        let motions = (1..=n_steps).map(|step| {
            let [position, length] = if step == n_steps {
                [distance, last]
            } else {
                [step as f64 * length, length]
            };
            let motion = Motion {
                time: position / load.velocity(),
                position,
                control: load.control(),
            };
            (motion, length / load.velocity())
        });
        let schedule = Schedule::new(motions, spacing)?;
        Self::from_schedule(
            schedule,
            LoadInterpolation::Held,
            surface,
            elastomer,
            options,
        )
    }

    /// A march of a motion that may be repeated, with loads linear over each step: `motions` are ends of steps and their durations
    /// \[s], the first of them the first touch, the others the motion or one cycle.
    ///
    /// # Errors
    /// Like [`new`](Self::new).
    pub(crate) fn cyclic(
        surface: &'a dyn Surface,
        elastomer: &dyn Elastomer,
        motions: impl Iterator<Item = (Motion, f64)>,
        options: &GridOptions,
    ) -> Result<Self, BemError> {
        let spacing = positive("spacing along x", options.spacing[0])?;
        let schedule = Schedule::new(motions, spacing)?.repeated();
        Self::from_schedule(
            schedule,
            LoadInterpolation::Linear,
            surface,
            elastomer,
            options,
        )
    }

    /// Returns to the end of the first touch, to follow the next cycle from the present state.
    pub(crate) const fn return_to_first_step(&mut self) {
        self.steps_done = 1;
    }

    /// History variables of all elements.
    pub(crate) fn history_variables_mut(&mut self) -> &mut [f64] {
        self.history.variables_mut()
    }

    /// Solves the next step; `None` after the last one.
    ///
    /// # Errors
    /// [`BemError::ContactReachesBoundary`]; [`BemError::VerticalWall`]; [`BemError::ContactNotConverged`];
    /// [`BemError::InvalidHeight`]; [`BemError::InvalidParameter`] for a slope that is not a number;
    /// [`BemError::Material`].
    pub fn step(&mut self) -> Result<Option<MotionRow>, BemError> {
        let Some(mut row) = self.advance()? else {
            return Ok(None);
        };
        self.means = MeanSlopes::over(self, &self.schedule.steps[self.steps_done - 1])?;
        row.tangential_force = row.normal_force * self.means.met;
        row.tangential_force_end_of_step = row.normal_force * self.means.end;
        Ok(Some(row))
    }

    /// θ: pressure and forces of the last step belong to the time θ Δt before its end; 0 for linear loads.
    pub(crate) const fn time_level(&self) -> f64 {
        self.means.time_level
    }

    /// Largest rise of the body over one element in contact in the last step, \[m].
    pub(crate) fn largest_rise(&self) -> f64 {
        self.means.largest * self.options.spacing[0]
    }

    /// Relative tolerance of the contact of each step.
    pub(crate) const fn tolerance(&self) -> f64 {
        self.options.contact.tolerance
    }

    /// Pressure-weighted mean of |∂h/∂x| in the last step: the friction coefficient if all slopes were uphill, as a scale for rounding.
    pub(crate) fn mean_slope_modulus(&self) -> f64 {
        self.means.mean_slope_modulus
    }
}

/// Number of steps of a `length` over a `distance`, and the length of the last one: 0.5 to 1.5 of the others.
fn divide_into_steps(distance: f64, length: f64) -> Result<(usize, f64), BemError> {
    let steps = distance / length;
    if steps > MAX_STEPS {
        return Err(BemError::TooManySteps {
            steps,
            limit: MAX_STEPS,
        });
    }
    // The last step takes up the remainder of half an element to one and a half.
    let before = (steps - 0.5).ceil().max(1.0) - 1.0;
    let rest = steps - before;
    // A whole step must not become another one by rounding, or results would depend on the unit of length.
    let is_whole = (rest - 1.0).abs() <= 4.0 * f64::EPSILON * steps;
    let last = if is_whole { length } else { rest * length };
    Ok((whole_elements(before)? + 1, last))
}
