//! Sliding, one step after the other.

use std::fmt;

use indenters::{SlidingLoad, Surface};
use rheology::Material;

use crate::error::positive;
use crate::grid::elements_along;
use crate::slide::motion::{Motion, MotionRow};
use crate::slide::slopes::{MeanSlopes, Slopes};
use crate::slide::{PressureField, SlideOptions};
use crate::stepping::{HalfSpace, Instant, MarchState, Route, SlideOmission, Stepping};
use crate::{BemError, Control, Grid, Resolution};

/// An indenter on its way over a half space.
pub struct March<'scene, S: ?Sized> {
    surface: &'scene S,
    stepping: Stepping<'scene, S>,
    slopes: Slopes,
    means: MeanSlopes,
}

impl<S: ?Sized> fmt::Debug for March<'_, S> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("March").finish_non_exhaustive()
    }
}

impl<'scene, S: Surface + ?Sized> March<'scene, S> {
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
        surface: &'scene S,
        material: &(impl Material + ?Sized),
        motions: &[Motion],
        resolution: &Resolution,
    ) -> Result<Self, BemError> {
        let ends = motions
            .iter()
            .map(|motion| (motion.time, motion.position, motion.control));
        let spacing = positive("spacing along x", resolution.spacing[0])?;
        let route = Route::through(ends, spacing)?;
        Self::on(route, surface, material, resolution)
    }

    /// The march that [`slide`](crate::slide::slide) makes.
    ///
    /// # Errors
    /// Like [`new`](Self::new).
    pub fn sliding(
        surface: &'scene S,
        material: &(impl Material + ?Sized),
        load: &SlidingLoad,
        options: &SlideOptions,
    ) -> Result<Self, BemError> {
        let spacing = positive("spacing along x", options.spacing[0])?;
        let distance = positive("sliding_distance", options.sliding_distance)?;
        let n_steps = elements_along(distance, spacing)?;
        let even = [false, surface.mirrors()[1]];
        let [rows, columns] = options.resolution().layout(even)?.followed();
        // Refused before so many steps are made.
        Grid::new([rows + n_steps, columns], options.spacing)?;
        let control = Control::NormalForce(load.require_normal_force()?);
        let route = Route::straight(n_steps, [spacing, load.velocity()], control)?;
        Self::on(route, surface, material, &options.resolution())
    }

    fn on(
        route: Route,
        surface: &'scene S,
        material: &(impl Material + ?Sized),
        resolution: &Resolution,
    ) -> Result<Self, BemError> {
        Ok(Self {
            surface,
            stepping: Stepping::new(surface, material, route, resolution)?,
            slopes: Slopes::default(),
            means: MeanSlopes::default(),
        })
    }

    /// Makes the next step; nothing at the end of the way.
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

    /// This march before its first step, but with the work of one `omission` too: the steps are the same up to the
    /// tolerance, and cost more.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] after a step; [`BemError::GridTooLarge`] when all of the footprint is too large
    /// to be solved at once.
    pub fn without_omission(mut self, omission: SlideOmission) -> Result<Self, BemError> {
        self.stepping.keep(omission)?;
        Ok(self)
    }

    /// What is needed to go on from here in a later run.
    #[must_use]
    pub fn state(&self) -> MarchState {
        self.stepping.state()
    }

    /// Goes on from the `state` of a march of the same scene; the steps are the same to the last bit.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] or [`BemError::LengthMismatch`] for a state that does not fit the scene.
    pub fn resume(&mut self, state: &MarchState) -> Result<(), BemError> {
        self.stepping.resume(state)
    }

    /// Number of values that an element remembers: one per retardation element of the material, one more for free
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
        let stepping = &self.stepping;
        let unit = stepping.pressure_per_load();
        let bounds = stepping.contact_bounds();
        let columns = bounds.shape()[1];
        let mut pressure = vec![0.0; bounds.n_elements()];
        for (element, load) in stepping.loaded_elements() {
            for [row, column] in stepping.layout.images_of(element) {
                let index = (row - bounds.lower[0]) * columns + column - bounds.lower[1];
                pressure[index] += load * unit;
            }
        }
        let spacing = stepping.resolution.spacing;
        Ok(PressureField {
            grid: Grid::new(bounds.shape(), spacing)?,
            origin: [
                stepping.along(bounds.lower[0], stepping.offset()) * spacing[0],
                stepping.across(bounds.lower[1]),
            ],
            pressure,
        })
    }

    /// Largest rise of the body over an element in contact, \[m].
    pub(super) fn largest_rise(&self) -> f64 {
        self.means.largest * self.stepping.resolution.spacing[0]
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
        let [dx, dy] = self.stepping.resolution.spacing;
        let half = 0.5;
        let x = |row: usize| (self.stepping.along(row, leg.offset) - half) * dx;
        let y = |column: usize| self.stepping.across(column) - half * dy;
        MotionRow {
            time: leg.time,
            position: leg.position,
            indentation_depth: instant.indentation_depth,
            normal_force: instant.normal_force,
            tangential_force: instant.normal_force * self.means.met,
            tangential_force_end_of_step: instant.normal_force * self.means.end,
            contact_area: instant.n_contact as f64 * dx * dy,
            contact_x: bounds.map(|bounds| [bounds.lower[0], bounds.upper[0]].map(x)),
            contact_y: bounds.map(|bounds| [bounds.lower[1], bounds.upper[1]].map(y)),
            n_contact: instant.n_contact,
            iterations: instant.iterations,
        }
    }
}
