//! The march of a body over a free half space or layer.
//!
//! The elements are fixed in the half space. The footprint follows the indenter by whole elements; the lowest point lies
//! anywhere within the element in its middle. If the indenter is its own mirror image, only the elements of the symmetry-reduced
//! domain are followed, the half on one side of the mirror. Heights are measured in a scale of the scene and lengths in Δx, so that
//! only ratios enter.
//!
//! Theory: docs/theory/transient-half-space.md, "Elements and steps" and "The contact of one step".

mod history;
mod motion;
mod schedule;
mod slopes;
mod step_contact;

use std::f64::consts::PI;
use std::fmt;
use std::ops::Range;

use indenters::{Control, SlidingLoad, Surface, checked_height};
use numerics::{Estimate, positive};
use rheology::{CreepSpectrum, ExponentialStep, Material as _};

use crate::contact::{ContactBox, check_has_body};
use crate::elements::bounds::Bounds;
use crate::elements::gap_field::{GapField, surroundings};
use crate::elements::pressure_field::PressureField;
use crate::elements::resolution::Layout;
use crate::substrate::base::check_unchanged_moduli;
use crate::{BemError, Elastomer, Grid, GridOptions};
use history::MaterialHistory;
pub use motion::{Motion, MotionRow};
use schedule::ScheduledStep;
pub(crate) use schedule::{Schedule, TimedMotion};
use slopes::MeanSlopes;

/// A simulation in time of an indenter that moves over a half space or layer.
pub struct March<'a> {
    /// Surface of the indenter.
    surface: &'a dyn Surface,
    /// Spacing, footprint and tolerance.
    options: GridOptions,
    /// Elements of the footprint, and the mirrors.
    layout: Layout,
    /// Creep spectrum of the material in shear.
    creep: CreepSpectrum,
    /// True on a half space that flows: the depth grows without limit. On a layer that flows it does not.
    pub(crate) sinks_without_limit: bool,
    /// Factor 2 (1 − ν) from α w to the displacement.
    half_space_factor: f64,
    /// All steps, done and to come.
    schedule: Schedule,
    /// Number of steps that are solved already.
    steps_done: usize,
    /// Coefficients of the creep law over a step of the duration `time_step`.
    creep_step: ExponentialStep,
    /// Δt of the present step, \[s].
    time_step: f64,
    /// Heights h of the indenter over the elements of the symmetry-reduced domain, in units of `height_scale`, row-major.
    heights: Vec<f64>,
    /// Offset of the lowest point for which `heights` were sampled, in elements; NaN before the first sampling.
    sampled_offset: f64,
    /// Initial gap h + H, at zero depth and without load, in units of `height_scale`; shape of `heights`.
    initial_gap: Vec<f64>,
    /// Displacement and history variables of the material along the path.
    history: MaterialHistory,
    /// Part of the footprint on which the contact is solved, with the pressure of the last step.
    contact_box: ContactBox,
    /// Unit of heights, \[m].
    height_scale: f64,
    /// Mean slopes of the body, weighted with the pressure of the last step.
    slopes: MeanSlopes,
    /// Depth of the lowest point in the last step, \[m].
    depth: f64,
}

impl fmt::Debug for March<'_> {
    /// Writes the name only, because the state is too large to read.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("March").finish_non_exhaustive()
    }
}

impl<'a> March<'a> {
    /// A march through `motions`, from an undeformed half space at time zero, where the lowest point is over the centre
    /// of an element at position zero.
    ///
    /// If surface and footprint are [their own mirror images](Surface::mirrors) about y = 0, only the half y ≥ 0 is followed. If
    /// the indenter never moves, the same holds about x = 0.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for no motions, times that do not increase from above zero, and numbers out of
    /// range; [`BemError::GridTooLarge`]; [`BemError::Indenter`] for heights that are NaN or −∞;
    /// [`BemError::Material`].
    pub fn new(
        surface: &'a dyn Surface,
        elastomer: &dyn Elastomer,
        motions: &[Motion],
        options: &GridOptions,
    ) -> Result<Self, BemError> {
        let schedule = Schedule::from_motions(motions, options.spacing[0])?;
        Self::from_schedule(surface, elastomer, schedule, options)
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

    /// The march of [`sliding`](Self::sliding), with steps of a given `length` \[m] instead of one element.
    pub(crate) fn sliding_in_steps(
        surface: &'a dyn Surface,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
        options: &GridOptions,
        length: f64,
    ) -> Result<Self, BemError> {
        let schedule = Schedule::sliding(load, length, options.spacing[0])?;
        Self::from_schedule(surface, elastomer, schedule, options)
    }

    /// A march before the first step of `schedule`, over an undeformed surface; errors as for [`new`](Self::new).
    pub(crate) fn from_schedule(
        surface: &'a dyn Surface,
        elastomer: &dyn Elastomer,
        schedule: Schedule,
        options: &GridOptions,
    ) -> Result<Self, BemError> {
        // An indenter that moves along x has no symmetry about x = 0.
        let [along_x, along_y] = surface.mirrors();
        let layout = options.layout([along_x && schedule.is_at_rest(), along_y])?;
        let [dx, dy] = options.spacing;
        // Find the creep spectrum of the material, and the coefficients of its creep law over the first step.
        check_unchanged_moduli(elastomer)?;
        let creep = elastomer.material().creep();
        let time_step = schedule.steps[0].time_step;
        let creep_step = (schedule.step_rule)(&creep, time_step)?;
        // A material without history variables is elastic, so that the elements may move with the indenter.
        let schedule = match creep_step.n_fields() {
            0 => schedule.without_history(),
            _ => schedule,
        };
        // Set up the history of all elements that the footprint passes, the path. Lengths of the base are in units of Δx.
        let base = elastomer.base().in_units_of(dx)?;
        base.check_flow(creep.fluidity())?;
        let sinks_without_limit = creep.fluidity() > 0.0 && base.is_half_space();
        let n_rows = schedule.rows_from(0, layout.folded_shape()[0]).end;
        let history = MaterialHistory::new(n_rows, &layout, dy / dx, creep_step.n_fields(), base)?;
        let mut march = Self {
            surface,
            options: *options,
            layout,
            height_scale: 0.0,
            sinks_without_limit,
            creep,
            half_space_factor: elastomer.material().half_space_factor(),
            schedule,
            steps_done: 0,
            creep_step,
            time_step,
            heights: Vec::new(),
            sampled_offset: f64::NAN,
            initial_gap: vec![0.0; layout.folded_shape().iter().product()],
            contact_box: ContactBox::cut_from(&history.convolution, Bounds::single([0; 2]))?,
            history,
            slopes: MeanSlopes::default(),
            depth: 0.0,
        };
        // Sample the heights of the body in units of the height scale, and place the first contact box around the lowest point.
        march.height_scale = march.find_height_scale()?;
        march.sample_heights(march.schedule.steps[0].offset)?;
        march.contact_box = march.box_at_lowest_point(&march.heights)?;
        Ok(march)
    }

    /// Number of history variables per element: one per retardation element of the material, one for free flow, and one for
    /// the last load if loads are linear over a step; 0 for an elastic material.
    pub const fn n_fields(&self) -> usize {
        self.history.n_fields
    }

    /// Number of elements of the half space that are followed.
    pub fn n_elements(&self) -> usize {
        self.history.convolution.grid().n_elements()
    }

    /// Loaded elements of the symmetry-reduced domain in the last step, as [row, column] of the whole footprint, with their loads
    /// x = 2 (1 − ν) α P/(4π) in units of the height scale over Δx.
    fn loaded_elements(&self) -> impl Iterator<Item = ([usize; 2], f64)> {
        let [first_row, first_column] = self.layout.first();
        let loaded = self.contact_box.loaded_elements();
        loaded.map(move |([row, column], load)| ([first_row + row, first_column + column], load))
    }

    /// Bounding box of all loaded elements and their images in the whole footprint; the element under the lowest point if none is
    /// loaded.
    fn contact_bounds(&self) -> Bounds {
        let lowest = Bounds::single(self.layout.apex);
        let loaded = self.loaded_bounds();
        loaded.map_or(lowest, |loaded| self.layout.unfolded(&loaded))
    }

    /// Bounding box of the loaded elements in the symmetry-reduced domain, in indices of that domain; `None` without contact.
    fn loaded_bounds(&self) -> Option<Bounds> {
        let loaded = self.contact_box.loaded_elements();
        Bounds::enclosing(loaded.map(|(element, _)| element))
    }

    /// Pressure in the last step; a single element of zero pressure if there is no contact.
    ///
    /// # Errors
    /// None after a step that succeeded.
    pub fn pressure(&self) -> Result<PressureField, BemError> {
        // The factor `unit` converts loads 2 (1 − ν) α P/(4π), in units of the height scale over Δx, to pressures.
        let unit = 4.0 * PI * self.height_scale / self.options.spacing[0] / self.compliance();
        let bounds = self.contact_bounds();
        let spacing = self.options.spacing;
        let origin = [
            self.x_in_elements(bounds.lower[0], self.sampled_offset) * spacing[0],
            self.y_of_column(bounds.lower[1]),
        ];
        // Elements behind the mirrors have the pressure of their images.
        let images = |(element, load)| {
            let images = self.layout.images_of(element);
            images.map(move |image| (image, load * unit))
        };
        let loaded = self.loaded_elements().flat_map(images);
        PressureField::from_elements(&bounds, spacing, origin, loaded)
    }

    /// Gap around the contact at the end of the last step, within the footprint. `None` before the first step, and if the body does not
    /// cover the box of the contact.
    ///
    /// # Errors
    /// None after a step that succeeded.
    pub fn gap(&self) -> Result<Option<GapField>, BemError> {
        let Some(step) = self.steps_done.checked_sub(1) else {
            return Ok(None);
        };
        // The gap is the initial gap plus the displacement by the load, which is stored per compliance once the step has been added to
        // the history.
        let first_row = self.schedule.steps[step].row;
        let [rows, columns] = self.layout.folded_shape();
        let increment = self.history.increment(first_row..first_row + rows);
        let per_increment = match self.history.n_fields {
            0 => 1.0,
            _ => self.creep_step.response(),
        };
        let folded_index = |element: [usize; 2]| {
            let [row, column] = self.layout.folded_element(element);
            row * columns + column
        };
        let limits = Bounds {
            lower: [0; 2],
            upper: self.layout.shape,
        };
        let has_body = |element| self.initial_gap[folded_index(element)].is_finite();
        let Some(bounds) = surroundings(&self.contact_bounds(), &limits, has_body) else {
            return Ok(None);
        };
        let elements =
            (bounds.rows()).flat_map(|row| bounds.columns().map(move |column| [row, column]));
        let gap = |element| {
            let index = folded_index(element);
            let displaced = self.initial_gap[index] + per_increment * increment[index];
            displaced * self.height_scale - self.depth
        };
        let spacing = self.options.spacing;
        Ok(Some(GapField {
            grid: Grid::new(bounds.shape(), spacing)?,
            origin: [
                self.x_in_elements(bounds.lower[0], self.sampled_offset) * spacing[0],
                self.y_of_column(bounds.lower[1]),
            ],
            gap: elements.map(gap).collect(),
        }))
    }

    /// Ends [rear, front] and [right, left] of the bounding box of the contact relative to the lowest point, \[m].
    pub(crate) fn contact_edges(&self) -> [[f64; 2]; 2] {
        let bounds = self.contact_bounds();
        let [dx, dy] = self.options.spacing;
        let x = |row: usize| (self.x_in_elements(row, self.sampled_offset) - 0.5) * dx;
        let y = |column: usize| self.y_of_column(column) - 0.5 * dy;
        [
            [bounds.lower[0], bounds.upper[0]].map(x),
            [bounds.lower[1], bounds.upper[1]].map(y),
        ]
    }

    /// Smaller of the numbers of elements of the contact's bounding box along x and y; 0 without contact.
    pub(crate) fn elements_across(&self) -> usize {
        self.loaded_bounds().map_or(0, |_| {
            let [rows, columns] = self.contact_bounds().shape();
            rows.min(columns)
        })
    }

    /// Largest rise of the body over one element in contact in the last step, \[m].
    pub(crate) fn largest_rise(&self) -> f64 {
        self.slopes.largest * self.options.spacing[0]
    }

    /// Relative tolerance of the contact of each step.
    pub(crate) const fn tolerance(&self) -> f64 {
        self.options.contact.tolerance
    }

    /// Pressure-weighted mean of |∂h/∂x| in the last step: the friction coefficient if all slopes were uphill, as a scale for rounding.
    pub(crate) const fn mean_slope_modulus(&self) -> f64 {
        self.slopes.mean_slope_modulus
    }

    /// Measure of the singularity of the pressure at the contact boundary, from 0 to 1. It is 1 under a flat punch, and of the order
    /// 1/a² for a contact radius of a elements where the pressure vanishes like a root.
    pub(crate) fn edge_singularity(&self) -> f64 {
        self.contact_box.edge_singularity(self.layout.mirrors)
    }

    /// Compliance 2 (1 − ν) α of the last step, \[1/Pa].
    fn compliance(&self) -> f64 {
        self.half_space_factor * self.creep_step.response()
    }

    /// Solves the next step; `None` after the last one.
    ///
    /// # Errors
    /// [`BemError::ContactReachesBoundary`]; [`BemError::VerticalWall`]; [`BemError::ContactNotConverged`];
    /// [`BemError::Indenter`] for a height that is NaN or −∞; [`BemError::InvalidParameter`] for a slope that is not a number;
    /// [`BemError::Material`].
    pub fn step(&mut self) -> Result<Option<MotionRow>, BemError> {
        let Some(row) = self.advance()? else {
            return Ok(None);
        };
        self.slopes = MeanSlopes::over(self, &self.schedule.steps[self.steps_done - 1])?;
        Ok(Some(MotionRow {
            time_level: self.slopes.time_level,
            tangential_force: row.normal_force * self.slopes.at_time_level,
            tangential_force_end_of_step: row.normal_force * self.slopes.end_of_step,
            ..row
        }))
    }

    /// Solves all remaining steps and returns their rows; `report` receives the fraction of all steps that is done.
    pub(crate) fn run(&mut self, report: &dyn Fn(f64)) -> Result<Vec<MotionRow>, BemError> {
        let mut rows = Vec::new();
        while let Some(row) = self.step()? {
            rows.push(row);
            report(self.fraction_done());
        }
        Ok(rows)
    }

    /// Fraction of the steps that are done, from 0 to 1.
    pub(crate) fn fraction_done(&self) -> f64 {
        self.steps_done as f64 / self.schedule.steps.len() as f64
    }

    /// Returns to the end of the first step, with given history variables of all elements, so that the later steps are solved again.
    pub(crate) fn restart_with(&mut self, history_variables: &[f64]) {
        self.steps_done = 1;
        self.history.variables.copy_from_slice(history_variables);
    }

    /// Copy of the history variables of all elements, `[row][field][column]`.
    pub(crate) fn history_variables(&self) -> Vec<f64> {
        self.history.variables.clone()
    }

    /// Solves the next step without its friction: time level and tangential forces of the row are 0. `None` after the last step.
    pub(crate) fn advance(&mut self) -> Result<Option<MotionRow>, BemError> {
        let step = self.schedule.steps.get(self.steps_done).copied();
        step.map(|step| self.solve_step(&step)).transpose()
    }

    /// Solves the first step, which every schedule has, without its friction: time level and tangential forces of the row are 0.
    pub(crate) fn solve_first_step(&mut self) -> Result<MotionRow, BemError> {
        let step = self.schedule.steps[0];
        self.solve_step(&step)
    }

    /// Solves one step in time: the contact at its end, then the history variables of the rows that later steps need. Time level and
    /// tangential forces of the row are 0.
    fn solve_step(&mut self, step: &ScheduledStep) -> Result<MotionRow, BemError> {
        // Find the initial gap at the end of the step: the height of the body plus the displacement of the surface without load.
        self.set_time_step(step.time_step)?;
        self.sample_heights(step.offset)?;
        self.update_initial_gap(step.row);
        // Solve the contact of the step, which is that of an elastic half space of the compliance 2 (1 − ν) α on this gap.
        let row = match self.depth_without_contact(step.end.control) {
            Some(depth) => self.step_without_contact(step, depth)?,
            None => self.solve_contact(step)?,
        };
        // Advance the history variables to the end of the step, in the rows that later steps need.
        self.history
            .advance(&self.creep_step, self.rows_needed(self.steps_done));
        self.steps_done += 1;
        self.depth = row.indentation_depth;
        Ok(row)
    }

    /// Row of a step with the extent of the contact, from the contact box; depth, forces and iterations are 0.
    fn motion_row(&self, step: &ScheduledStep) -> MotionRow {
        let [dx, dy] = self.options.spacing;
        // Count the elements in contact, those behind the mirrors included.
        let loaded = self.loaded_elements();
        let images = loaded.map(|(element, _)| self.layout.n_images_of(element));
        let n_contact = images.sum();
        let edges = (n_contact > 0).then(|| self.contact_edges());
        // Forces and depth are filled in by the caller.
        MotionRow {
            time: step.end.time,
            position: step.end.position,
            indentation_depth: 0.0,
            normal_force: 0.0,
            time_level: 0.0,
            tangential_force: 0.0,
            tangential_force_end_of_step: 0.0,
            contact_area: self.contact_box.area(self.layout.mirrors) * dx * dy,
            contact_area_uncertainty: self.contact_box.area_uncertainty(self.layout.mirrors)
                * dx
                * dy,
            divided_area: Estimate::exact(0.0),
            contact_x: edges.map(|[x, _]| x),
            contact_y: edges.map(|[_, y]| y),
            n_contact,
            iterations: 0,
        }
    }

    /// Rows of the path that the footprint covers in step number `step` and all later ones.
    fn rows_needed(&self, step: usize) -> Range<usize> {
        self.schedule.rows_from(step, self.layout.folded_shape()[0])
    }

    /// Sets the coefficients of the creep law for a step of the duration `time_step` \[s]; the first guess keeps its pressure.
    fn set_time_step(&mut self, time_step: f64) -> Result<(), BemError> {
        if time_step.total_cmp(&self.time_step).is_eq() {
            return Ok(());
        }
        let before = self.creep_step.response();
        self.creep_step = (self.schedule.step_rule)(&self.creep, time_step)?;
        self.time_step = time_step;
        // Loads are pressures times the compliance of the step, so that they change with it while the pressure of the first guess
        // stays the same.
        let ratio = self.creep_step.response() / before;
        for load in &mut self.contact_box.state.load {
            *load *= ratio;
        }
        Ok(())
    }

    /// Position x of the centre of a row of the footprint relative to the lowest point, in elements; the lowest point is `offset`
    /// elements ahead of the centre of its row.
    fn x_in_elements(&self, row: usize, offset: f64) -> f64 {
        row as f64 - self.layout.apex[0] as f64 - offset
    }

    /// Position y of the centre of a column of the footprint relative to the lowest point, \[m].
    fn y_of_column(&self, column: usize) -> f64 {
        (column as f64 - self.layout.apex[1] as f64) * self.options.spacing[1]
    }

    /// Samples `heights` with the lowest point `offset` elements ahead of the centre of its element, unless they are sampled so
    /// already.
    ///
    /// # Errors
    /// [`BemError::Indenter`] for a height that is NaN or −∞; [`BemError::InvalidParameter`] if the body covers no element.
    fn sample_heights(&mut self, offset: f64) -> Result<(), BemError> {
        if offset.total_cmp(&self.sampled_offset).is_eq() {
            return Ok(());
        }
        // Sample the height of the surface at the centres of the elements of the symmetry-reduced domain.
        let ([rows, columns], [first_row, first_column]) = (self.layout.shape, self.layout.first());
        let mut heights = Vec::with_capacity(self.initial_gap.len());
        for row in first_row..rows {
            let x = self.x_in_elements(row, offset) * self.options.spacing[0];
            for column in first_column..columns {
                let position = [x, self.y_of_column(column)];
                let height = checked_height(self.surface.height(position), position)?;
                heights.push(height / self.height_scale);
            }
        }
        check_has_body("height of the surface", &heights)?;
        self.heights = heights;
        self.sampled_offset = offset;
        Ok(())
    }

    /// An unloaded contact box around the minimum of `heights`, a field over the symmetry-reduced domain.
    fn box_at_lowest_point(&self, heights: &[f64]) -> Result<ContactBox, BemError> {
        let [_, columns] = self.layout.folded_shape();
        let lowest = (0..heights.len()).min_by(|a, b| heights[*a].total_cmp(&heights[*b]));
        let index = lowest.unwrap_or(0);
        let element = Bounds::single([index / columns, index % columns]);
        ContactBox::cut_from(&self.history.convolution, self.with_margin(&element))
    }

    /// The box `bounds` of the symmetry-reduced domain with a margin into which the contact may grow, within that domain.
    fn with_margin(&self, bounds: &Bounds) -> Bounds {
        bounds.with_margin(self.layout.folded_shape(), self.layout.mirrors)
    }

    /// Sets the initial gap h + H of a footprint that begins at row `first_row` of the path.
    fn update_initial_gap(&mut self, first_row: usize) {
        self.history
            .displacement_without_load(&self.creep_step, first_row, &mut self.initial_gap);
        for (gap, height) in self.initial_gap.iter_mut().zip(&self.heights) {
            *gap += height;
        }
    }

    /// Depth \[m] if the step has no contact: that of the first touch under zero force, or a given depth that does not reach
    /// the surface; `None` if there is contact.
    fn depth_without_contact(&self, control: Control) -> Option<f64> {
        // Without force the body rests at first touch; a depth above the surface does not reach it.
        let gaps = self.initial_gap.iter().copied();
        let lowest = gaps.fold(f64::INFINITY, f64::min);
        match control {
            Control::NormalForce(force) => (force == 0.0).then_some(lowest * self.height_scale),
            Control::IndentationDepth(depth) => {
                (depth / self.height_scale <= lowest).then_some(depth)
            }
        }
    }

    /// A step without load at the depth `indentation_depth` \[m]. If there was contact before, the contact box returns to the lowest
    /// gap.
    fn step_without_contact(
        &mut self,
        step: &ScheduledStep,
        indentation_depth: f64,
    ) -> Result<MotionRow, BemError> {
        // The next contact begins at the lowest gap, not where the last one ended.
        if self.loaded_bounds().is_some() {
            self.contact_box = self.box_at_lowest_point(&self.initial_gap)?;
        }
        self.history
            .clear_increment(self.rows_needed(self.steps_done));
        Ok(MotionRow {
            indentation_depth,
            ..self.motion_row(step)
        })
    }

    /// Unit of heights \[m], the largest scale of all steps. Under a force the scale of a step is 2 (1 − ν) α F_N/(4 Δx), which
    /// is F_N/(4ηv) on an incompressible dashpot that moves by Δx per step. At a given depth it is the modulus of the depth. If
    /// all scales are 0, the unit is Δx.
    fn find_height_scale(&self) -> Result<f64, BemError> {
        // Take the largest scale of all steps, so that no height of the march is large in this unit.
        let spacing = self.options.spacing[0];
        let mut scale = 0.0_f64;
        for step in &self.schedule.steps {
            let height = match step.end.control {
                Control::IndentationDepth(depth) => depth.abs(),
                Control::NormalForce(force) => {
                    let step = ExponentialStep::creep(&self.creep, step.time_step)?;
                    0.25 * force * self.half_space_factor * step.response() / spacing
                }
            };
            scale = scale.max(height);
        }
        if scale == 0.0 {
            return Ok(spacing);
        }
        Ok(positive("height scale F α / (4 Δx)", scale)?)
    }

    /// Depth scale 2 (1 − ν) F_N J(t)/(4 L) of a contact of length L, \[m], with the time t = L/v in which it passes; F_N/(4ηv) on an
    /// incompressible dashpot.
    pub(crate) fn depth_scale(
        &self,
        normal_force: f64,
        length: f64,
        time: f64,
    ) -> Result<f64, BemError> {
        let compliance = self.half_space_factor * self.creep.creep_compliance(time)?;
        Ok(0.25 * normal_force * compliance / length)
    }
}
