//! Sliding, one step after the other.

use indenters::{Control, SlidingLoad, Surface};
use numerics::positive;

use super::{March, MeanSlopes, Motion, MotionRow, Route};
use crate::grid::elements_along;
use crate::{BemError, Elastomer, Grid, GridOptions};

/// Steps at a depth after which a march is not begun.
const MOST_STEPS: f64 = 1e5;
const MARCH_ENDS: &str = "a march over a half space ends after a distance";

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
        elastomer: &(impl Elastomer + ?Sized),
        motions: &[Motion],
        options: &GridOptions,
    ) -> Result<Self, BemError> {
        let spacing = positive("spacing along x", options.spacing[0])?;
        let route = Route::through(motions.iter().copied(), spacing, None)?;
        Self::on(route, surface, elastomer, options)
    }

    /// Part of the steps that are done.
    pub(crate) fn part_done(&self) -> f64 {
        self.steps_done as f64 / self.route.legs.len() as f64
    }

    /// The march of [`slide_on_grid`](crate::slide::slide_on_grid), over the sliding distance of the load: under a force in
    /// whole elements; at a depth the last step, of a half to one and a half elements, ends at the distance.
    ///
    /// # Errors
    /// [`BemError::SlidingDistanceMissing`]; [`BemError::TooManySteps`]; otherwise like [`new`](Self::new).
    pub fn sliding(
        surface: &'a dyn Surface,
        elastomer: &(impl Elastomer + ?Sized),
        load: &SlidingLoad,
        options: &GridOptions,
    ) -> Result<Self, BemError> {
        let spacing = positive("spacing along x", options.spacing[0])?;
        let distance = load.sliding_distance();
        let distance = distance.ok_or(BemError::SlidingDistanceMissing { why: MARCH_ENDS })?;
        let motion = |position: f64| Motion {
            time: position / load.velocity(),
            position,
            control: load.control(),
        };
        let route = match load.control() {
            Control::NormalForce(_) => {
                let n_steps = elements_along(distance, spacing)?;
                let even = [false, surface.mirrors()[1]];
                let [rows, columns] = options.layout(even)?.followed();
                // Refused before so many steps are made.
                Grid::new([rows + n_steps, columns], options.spacing)?;
                let ends = (1..=n_steps).map(|step| step as f64 * spacing);
                let time_step = Some(spacing / load.velocity());
                Route::through(ends.map(motion), spacing, time_step)?
            }
            Control::IndentationDepth(_) => {
                Route::through(ends_at(distance, spacing)?.map(motion), spacing, None)?
            }
        };
        Self::on(route, surface, elastomer, options)
    }

    /// Makes the next step; none after the last.
    ///
    /// # Errors
    /// [`BemError::ContactReachesBoundary`]; [`BemError::VerticalWall`]; [`BemError::ContactNotConverged`];
    /// [`BemError::InvalidHeight`]; [`BemError::InvalidParameter`] for a slope that is not a number;
    /// [`BemError::Material`].
    pub fn step(&mut self) -> Result<Option<MotionRow>, BemError> {
        let Some(mut row) = self.advance()? else {
            return Ok(None);
        };
        self.means = MeanSlopes::over(self, &self.route.legs[self.steps_done - 1])?;
        row.tangential_force = row.normal_force * self.means.met;
        row.tangential_force_end_of_step = row.normal_force * self.means.end;
        Ok(Some(row))
    }

    /// Largest rise of the body over an element in contact, \[m].
    pub(crate) fn largest_rise(&self) -> f64 {
        self.means.largest * self.options.spacing[0]
    }

    /// Friction coefficient if all slopes were uphill, which says what rounding is.
    pub(crate) fn steepness(&self) -> f64 {
        self.means.steepness
    }
}

/// Ends of steps of one element; the last, of a half to one and a half, ends at the distance.
fn ends_at(distance: f64, spacing: f64) -> Result<impl Iterator<Item = f64>, BemError> {
    if distance > MOST_STEPS * spacing {
        return Err(BemError::TooManySteps {
            steps: distance / spacing,
            limit: MOST_STEPS,
        });
    }
    let ends = (1_u32..).map(move |step| f64::from(step) * spacing);
    let before = ends.take_while(move |position| *position < distance - 0.5 * spacing);
    Ok(before.chain([distance]))
}
