//! Sliding, one step after the other.

use std::fmt;

use indenters::{Control, SlidingLoad, Surface};
use rheology::Material;

use crate::error::positive;
use crate::grid::elements_along;
use crate::slide::PressureField;
use crate::slide::motion::{Motion, MotionRow};
use crate::slide::slopes::{MeanSlopes, Slopes};
use crate::stepping::{HalfSpace, Instant, MarchState, Route, Stepping};
use crate::{BemError, Grid, GridOptions};

/// Steps at a depth after which a march is not begun.
const MOST_STEPS: f64 = 1e5;
const MARCH_ENDS: &str = "a march over a half space ends after a distance";

/// An indenter that moves over a half space, step by step.
pub struct March<'a> {
    surface: &'a dyn Surface,
    stepping: Stepping<'a>,
    slopes: Slopes,
    means: MeanSlopes,
}

impl fmt::Debug for March<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("March").finish_non_exhaustive()
    }
}

impl<'a> March<'a> {
    /// A march through `motions`, from an undeformed half space at time zero, where the lowest point is over the centre
    /// of an element at position zero.
    ///
    /// Of a surface that is [its own mirror image](Surface::mirrors) about y = 0, over a footprint that is so too, only the
    /// half at y ≥ 0 is followed; where it never moves, about x = 0 too.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for no motions, times that do not increase from above zero, and numbers out of
    /// range; [`BemError::GridTooLarge`]; [`BemError::InvalidHeight`]; [`BemError::Material`].
    pub fn new(
        surface: &'a dyn Surface,
        material: &(impl Material + ?Sized),
        motions: &[Motion],
        options: &GridOptions,
    ) -> Result<Self, BemError> {
        let ends = motions
            .iter()
            .map(|motion| (motion.time, motion.position, motion.control));
        let spacing = positive("spacing along x", options.spacing[0])?;
        let route = Route::through(ends, spacing)?;
        Self::on(route, surface, material, options)
    }

    /// The march of [`slide_on_grid`](crate::slide::slide_on_grid), over the sliding distance of the load: under a force in
    /// whole elements; at a depth the last step, of a half to one and a half elements, ends at the distance.
    ///
    /// # Errors
    /// [`BemError::SlidingDistanceMissing`]; [`BemError::TooManySteps`]; otherwise like [`new`](Self::new).
    pub fn sliding(
        surface: &'a dyn Surface,
        material: &(impl Material + ?Sized),
        load: &SlidingLoad,
        options: &GridOptions,
    ) -> Result<Self, BemError> {
        let spacing = positive("spacing along x", options.spacing[0])?;
        let distance = load.sliding_distance();
        let distance = distance.ok_or(BemError::SlidingDistanceMissing { why: MARCH_ENDS })?;
        if let Control::IndentationDepth(_) = load.control() {
            let motions = motions(load, spacing, distance)?;
            return Self::new(surface, material, &motions, options);
        }
        let n_steps = elements_along(distance, spacing)?;
        let even = [false, surface.mirrors()[1]];
        let [rows, columns] = options.layout(even)?.followed();
        // Refused before so many steps are made.
        Grid::new([rows + n_steps, columns], options.spacing)?;
        let route = Route::straight(n_steps, spacing, load.velocity(), load.control())?;
        Self::on(route, surface, material, options)
    }

    fn on(
        route: Route,
        surface: &'a dyn Surface,
        material: &(impl Material + ?Sized),
        options: &GridOptions,
    ) -> Result<Self, BemError> {
        Ok(Self {
            surface,
            stepping: Stepping::new(surface, material, route, options)?,
            slopes: Slopes::default(),
            means: MeanSlopes::default(),
        })
    }

    /// Makes the next step; none after the last.
    ///
    /// # Errors
    /// [`BemError::ContactReachesBoundary`]; [`BemError::VerticalWall`]; [`BemError::ContactNotConverged`];
    /// [`BemError::InvalidHeight`]; [`BemError::InvalidParameter`] for a slope that is not a number;
    /// [`BemError::Material`].
    pub fn step(&mut self) -> Result<Option<MotionRow>, BemError> {
        let Some(instant) = self.stepping.advance()? else {
            return Ok(None);
        };
        self.means = self.slopes.over(self.surface, &self.stepping, &instant)?;
        Ok(Some(self.row(&instant)))
    }

    /// The state from which a later run can continue.
    #[must_use]
    pub fn state(&self) -> MarchState {
        self.stepping.state()
    }

    /// Continues from the `state` of a march with the same input; the steps are the same to the last bit.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] or [`BemError::LengthMismatch`] for a state that does not fit this march.
    pub fn resume(&mut self, state: &MarchState) -> Result<(), BemError> {
        self.stepping.resume(state)
    }

    /// Number of values in the memory of an element: one per retardation element of the material, one more for free
    /// flow, none for an elastic material.
    #[must_use]
    pub fn n_fields(&self) -> usize {
        self.stepping.n_fields()
    }

    /// Number of elements of the half space that are followed.
    #[must_use]
    pub fn n_elements(&self) -> usize {
        self.stepping.n_elements()
    }

    /// Pressure in the last step; a single element without pressure where there is no contact.
    ///
    /// # Errors
    /// None after a step that succeeded.
    pub fn pressure(&self) -> Result<PressureField, BemError> {
        self.stepping.pressure()
    }

    /// Largest rise of the body over an element in contact, \[m].
    pub(super) fn largest_rise(&self) -> f64 {
        self.means.largest * self.stepping.options.spacing[0]
    }

    /// Friction coefficient if all slopes were uphill, which says what rounding is.
    pub(super) fn steepness(&self) -> f64 {
        self.means.steepness
    }

    pub(super) fn half_space(&self) -> &HalfSpace {
        &self.stepping.material
    }

    fn row(&self, instant: &Instant) -> MotionRow {
        let Instant { leg, bounds, .. } = instant;
        let [dx, dy] = self.stepping.options.spacing;
        let edges = bounds.map(|bounds| self.stepping.edges(&bounds, leg.offset));
        MotionRow {
            time: leg.time,
            position: leg.position,
            indentation_depth: instant.indentation_depth,
            normal_force: instant.normal_force,
            tangential_force: instant.normal_force * self.means.met,
            tangential_force_end_of_step: instant.normal_force * self.means.end,
            contact_area: instant.n_contact as f64 * dx * dy,
            contact_x: edges.map(|[x, _]| x),
            contact_y: edges.map(|[_, y]| y),
            n_contact: instant.n_contact,
            iterations: instant.iterations,
        }
    }
}

/// Steps of one element; the last, of a half to one and a half, ends at the distance.
fn motions(load: &SlidingLoad, spacing: f64, distance: f64) -> Result<Vec<Motion>, BemError> {
    if distance > MOST_STEPS * spacing {
        return Err(BemError::TooManySteps {
            steps: distance / spacing,
            limit: MOST_STEPS,
        });
    }
    let ends = (1_u32..).map(|step| f64::from(step) * spacing);
    let before = ends.take_while(|position| *position < distance - 0.5 * spacing);
    let motion = |position: f64| Motion {
        time: position / load.velocity(),
        position,
        control: load.control(),
    };
    Ok(before.chain([distance]).map(motion).collect())
}
