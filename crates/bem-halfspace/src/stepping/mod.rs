//! One step of contact after the other, on any linear viscoelastic half space.
//!
//! ```text
//! u_new = 2 (1 − ν) α w + history,        w = K P / (4π) held over the step, or linear
//! gap = h + u_new − d ≥ 0,   P ≥ 0,   P · gap = 0
//! ```
//! Every step is an elastic contact of compliance 2 (1 − ν) α under an indenter of height h + history. The elements stay
//! where they are in the half space; the footprint goes with the indenter by whole elements, and the indenter stands
//! anywhere over the element in its middle. Of an indenter that is its own mirror image only the elements in front of the
//! mirror are followed. Inside, heights are measured in a scale of the scene and lengths in Δx, so that only ratios enter.

mod march;
mod material_history;
mod motion;
mod schedule;
mod slopes;
mod step_contact;

use std::f64::consts::PI;
use std::fmt;
use std::ops::Range;

use indenters::{Control, Surface};
use numerics::positive;
use rheology::{CreepSpectrum, ExponentialStep, Material as _, RheologyError, check_spectra};

use crate::contact::{ContactBox, check_heights};
use crate::elements::bounds::Bounds;
use crate::elements::pressure_field::PressureField;
use crate::elements::resolution::Layout;
use crate::{BemError, Elastomer, GridOptions};
pub(crate) use march::{
    BYTES_PER_FOLLOWED_ELEMENT, BYTES_PER_STEP, MARCH_WORK_EXPONENT, MAX_STEPS,
};
use material_history::MaterialHistory;
pub use motion::{Motion, MotionRow};
use schedule::{Schedule, ScheduledStep};
use slopes::MeanSlopes;

/// The load within a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LoadInterpolation {
    /// That of its end from its beginning on.
    Held,
    /// [Linear](ExponentialStep::creep_linear) from that of its beginning, as far as the material lets it.
    Linear,
}

impl LoadInterpolation {
    fn step(self, creep: &CreepSpectrum, time_step: f64) -> Result<ExponentialStep, RheologyError> {
        match self {
            Self::Held => ExponentialStep::creep(creep, time_step),
            Self::Linear => ExponentialStep::creep_linear(creep, time_step),
        }
    }
}

/// An indenter that moves over a half space, step by step.
pub struct March<'a> {
    surface: &'a dyn Surface,
    options: GridOptions,
    layout: Layout,
    creep: CreepSpectrum,
    /// Whether the body sinks_without_limit without limit, as it does not into a layer.
    pub(crate) sinks_without_limit: bool,
    /// 2 (1 − ν).
    half_space_factor: f64,
    schedule: Schedule,
    steps_done: usize,
    interpolation: LoadInterpolation,
    creep_step: ExponentialStep,
    time_step: f64,
    /// Heights of the indenter over the followed elements of the footprint, and the offset for which they were sampled.
    heights: Vec<f64>,
    sampled_offset: f64,
    /// Heights plus displacement without load.
    initial_gap: Vec<f64>,
    history: MaterialHistory,
    contact_box: ContactBox,
    /// Unit of heights, \[m].
    height_scale: f64,
    means: MeanSlopes,
}

impl fmt::Debug for March<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("March").finish_non_exhaustive()
    }
}

impl<'a> March<'a> {
    fn from_schedule(
        (schedule, interpolation): (Schedule, LoadInterpolation),
        surface: &'a dyn Surface,
        elastomer: &dyn Elastomer,
        options: &GridOptions,
    ) -> Result<Self, BemError> {
        let [along_x, along_y] = surface.mirrors();
        let layout = options.layout([along_x && schedule.rests(), along_y])?;
        let [dx, dy] = options.spacing;
        check_spectra(&elastomer.material())?;
        let creep = elastomer.material().creep();
        let time_step = schedule.steps[0].time_step;
        let creep_step = interpolation.step(&creep, time_step)?;
        let schedule = match creep_step.n_fields() {
            0 => schedule.without_memory(),
            _ => schedule,
        };
        let base = elastomer.base().in_units_of(dx)?;
        base.check_flow(creep.fluidity())?;
        let sinks_without_limit = creep.fluidity() > 0.0 && base.is_half_space();
        let n_rows = schedule.rows_from(0, layout.folded_shape()[0]).end;
        let history =
            MaterialHistory::new(n_rows, &layout, dy / dx, (creep_step.n_fields(), base))?;
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
            interpolation,
            creep_step,
            time_step,
            heights: Vec::new(),
            sampled_offset: f64::NAN,
            initial_gap: vec![0.0; layout.folded_shape().iter().product()],
            contact_box: ContactBox::of(&history.convolution, Bounds::single([0; 2]))?,
            history,
            means: MeanSlopes::default(),
        };
        march.height_scale = march.find_height_scale()?;
        march.sample_heights(march.schedule.steps[0].offset)?;
        march.contact_box = march.box_at_lowest_point(&march.heights)?;
        Ok(march)
    }

    /// Number of values in the memory of an element: one per retardation element of the material, one more for free
    /// flow, and one more for the last load where it is linear over a step; none for an elastic material.
    pub const fn n_fields(&self) -> usize {
        self.history.n_fields
    }

    /// Number of elements of the half space that are followed.
    pub fn n_elements(&self) -> usize {
        self.history.convolution.grid().n_elements()
    }

    /// Elements of the footprint in front of the mirrors with load in the last step, and their loads there, of which only
    /// the ratios matter.
    fn loaded_elements(&self) -> impl Iterator<Item = ([usize; 2], f64)> {
        let [first_row, first_column] = self.layout.first();
        let loaded = self.contact_box.loaded_elements();
        loaded.map(move |([row, column], load)| ([first_row + row, first_column + column], load))
    }

    /// The box of the footprint around all loaded elements; the element under the lowest point without any.
    fn contact_bounds(&self) -> Bounds {
        let lowest = Bounds::single(self.layout.apex);
        let loaded = self.loaded_bounds();
        loaded.map_or(lowest, |loaded| self.layout.unfolded(&loaded))
    }

    /// The box around the loaded elements in front of the mirrors, counted from there.
    fn loaded_bounds(&self) -> Option<Bounds> {
        let loaded = self.contact_box.loaded_elements();
        Bounds::enclosing(loaded.map(|(element, _)| element))
    }

    /// Pressure in the last step; a single element without pressure where there is no contact.
    ///
    /// # Errors
    /// None after a step that succeeded.
    pub fn pressure(&self) -> Result<PressureField, BemError> {
        let unit = 4.0 * PI * self.height_scale / self.options.spacing[0] / self.compliance();
        let bounds = self.contact_bounds();
        let spacing = self.options.spacing;
        let origin = [
            self.x_in_elements(bounds.lower[0], self.sampled_offset) * spacing[0],
            self.y_of_column(bounds.lower[1]),
        ];
        let images = |(element, load)| {
            let images = self.layout.images_of(element);
            images.map(move |image| (image, load * unit))
        };
        let loaded = self.loaded_elements().flat_map(images);
        PressureField::from_elements(&bounds, spacing, origin, loaded)
    }

    /// Ends along x and y of the box of the footprint around all loaded elements, relative to the lowest point, \[m].
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

    /// Elements of the contact along x or y, whichever are fewer.
    pub(crate) fn elements_across(&self) -> usize {
        self.loaded_bounds().map_or(0, |_| {
            let [rows, columns] = self.contact_bounds().shape();
            rows.min(columns)
        })
    }

    /// The compliance of the last step, \[1/Pa].
    fn compliance(&self) -> f64 {
        self.half_space_factor * self.creep_step.response()
    }

    /// Goes to the end of the next step, without the forces along x; none after the last.
    pub(crate) fn advance(&mut self) -> Result<Option<MotionRow>, BemError> {
        let step = self.schedule.steps.get(self.steps_done).copied();
        step.map(|step| self.solve_step(&step)).transpose()
    }

    /// Goes to the end of the first step, which every march has.
    pub(crate) fn first(&mut self) -> Result<MotionRow, BemError> {
        let step = self.schedule.steps[0];
        self.solve_step(&step)
    }

    fn solve_step(&mut self, step: &ScheduledStep) -> Result<MotionRow, BemError> {
        self.set_time_step(step.time_step)?;
        self.sample_heights(step.offset)?;
        self.update_initial_gap(step.row);
        let row = match self.depth_without_contact(step.end.control) {
            Some(depth) => self.step_without_contact(step, depth)?,
            None => self.solve_contact(step)?,
        };
        self.history
            .advance(&self.creep_step, self.rows_needed(self.steps_done));
        self.steps_done += 1;
        Ok(row)
    }

    /// The state at the end of a step, but for depth and forces.
    fn motion_row(&self, step: &ScheduledStep) -> MotionRow {
        let [dx, dy] = self.options.spacing;
        let loaded = self.loaded_elements();
        let images = loaded.map(|(element, _)| self.layout.n_images_of(element));
        let n_contact = images.sum();
        let edges = (n_contact > 0).then(|| self.contact_edges());
        MotionRow {
            time: step.end.time,
            position: step.end.position,
            indentation_depth: 0.0,
            normal_force: 0.0,
            tangential_force: 0.0,
            tangential_force_end_of_step: 0.0,
            contact_area: self.contact_box.area(self.layout.mirrors) * dx * dy,
            contact_x: edges.map(|[x, _]| x),
            contact_y: edges.map(|[_, y]| y),
            n_contact,
            iterations: 0,
        }
    }

    fn rows_needed(&self, step: usize) -> Range<usize> {
        self.schedule.rows_from(step, self.layout.folded_shape()[0])
    }

    fn set_time_step(&mut self, time_step: f64) -> Result<(), BemError> {
        if time_step.total_cmp(&self.time_step).is_eq() {
            return Ok(());
        }
        let before = self.creep_step.response();
        self.creep_step = self.interpolation.step(&self.creep, time_step)?;
        self.time_step = time_step;
        // The same pressure is another load now.
        let ratio = self.creep_step.response() / before;
        for load in self.contact_box.state.pressure_mut() {
            *load *= ratio;
        }
        Ok(())
    }

    /// Position of a row of the footprint in the frame of the indenter, in elements.
    fn x_in_elements(&self, row: usize, offset: f64) -> f64 {
        row as f64 - self.layout.apex[0] as f64 - offset
    }

    /// Position of a column of the footprint across, \[m].
    fn y_of_column(&self, column: usize) -> f64 {
        (column as f64 - self.layout.apex[1] as f64) * self.options.spacing[1]
    }

    /// Samples the heights with the lowest point `offset` elements ahead of the centre of its element.
    fn sample_heights(&mut self, offset: f64) -> Result<(), BemError> {
        if offset.total_cmp(&self.sampled_offset).is_eq() {
            return Ok(());
        }
        let ([rows, columns], [first_row, first_column]) = (self.layout.shape, self.layout.first());
        let mut heights = Vec::with_capacity(self.initial_gap.len());
        for row in first_row..rows {
            let x = self.x_in_elements(row, offset) * self.options.spacing[0];
            for column in first_column..columns {
                heights
                    .push(self.surface.height([x, self.y_of_column(column)]) / self.height_scale);
            }
        }
        let field = (&heights[..], columns - first_column);
        check_heights("height of the surface", field, [first_row, first_column])?;
        self.heights = heights;
        self.sampled_offset = offset;
        Ok(())
    }

    fn box_at_lowest_point(&self, heights: &[f64]) -> Result<ContactBox, BemError> {
        let [_, columns] = self.layout.folded_shape();
        let lowest = (0..heights.len()).min_by(|a, b| heights[*a].total_cmp(&heights[*b]));
        let index = lowest.unwrap_or(0);
        let element = Bounds::single([index / columns, index % columns]);
        ContactBox::of(&self.history.convolution, self.with_margin(&element))
    }

    /// With room for a growing contact.
    fn with_margin(&self, bounds: &Bounds) -> Bounds {
        bounds.with_margin(self.layout.folded_shape(), self.layout.mirrors)
    }

    fn update_initial_gap(&mut self, first_row: usize) {
        self.history
            .displacement_without_load(&self.creep_step, first_row, &mut self.initial_gap);
        for (separation, height) in self.initial_gap.iter_mut().zip(&self.heights) {
            *separation += height;
        }
    }

    /// The depth of an indenter that is not pressed, or held above the surface; nothing when there is contact.
    fn depth_without_contact(&self, control: Control) -> Option<f64> {
        let separation = self.initial_gap.iter().copied();
        let lowest = separation.fold(f64::INFINITY, f64::min);
        match control {
            Control::NormalForce(force) => (force == 0.0).then_some(lowest * self.height_scale),
            Control::IndentationDepth(depth) => {
                (depth / self.height_scale <= lowest).then_some(depth)
            }
        }
    }

    fn step_without_contact(
        &mut self,
        step: &ScheduledStep,
        indentation_depth: f64,
    ) -> Result<MotionRow, BemError> {
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

    /// A height that the scene has: F α / (4 Δx), which is F_N/(4ηv) on a dashpot, or a depth that is given.
    fn find_height_scale(&self) -> Result<f64, BemError> {
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

    /// F_N J(L/v) / (4 L), the depth that a force makes in the time L/v in which it passes a contact of length L:
    /// F_N/(4ηv) on a dashpot, \[m].
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
