//! One step of sliding after the other.

use std::f64::consts::{FRAC_1_PI, PI};
use std::ops::Range;

use indenters::{SlidingLoad, Surface};
use rheology::Viscous;

use crate::bounds::Bounds;
use crate::contact::{ContactBox, Outcome};
use crate::error::positive;
use crate::footprint::depth_scale;
use crate::grid::elements_along;
use crate::slide::sampled_indenter::SampledIndenter;
use crate::slide::{MIN_CONTACT_ELEMENTS, PressureField, SlideOptions, SlideRow, Transient};
use crate::{BemError, Control, Convolution, ConvolutionWorkspace, Grid};

/// The simulation between two steps. Heights are in units of the depth scale, lengths in units of Δx.
pub(super) struct March {
    options: SlideOptions,
    load: SlidingLoad,
    depth_scale: f64,
    /// Number of elements of the footprint, and the one under the lowest point.
    shape: [usize; 2],
    apex: [usize; 2],
    indenter: SampledIndenter,
    contact_box: ContactBox,
    /// Convolution and fields over all elements that the footprint ever passes.
    track: Convolution,
    workspace: ConvolutionWorkspace,
    track_pressure: Vec<f64>,
    increment: Vec<f64>,
    displacement: Vec<f64>,
    steps_done: usize,
}

impl March {
    pub(super) fn new(
        surface: &impl Surface,
        material: &Viscous,
        load: &SlidingLoad,
        options: &SlideOptions,
    ) -> Result<Self, BemError> {
        let [dx, dy] = options.spacing;
        positive("spacing along x", dx)?;
        positive("spacing along y", dy)?;
        options.contact.validate()?;
        let counts = options.footprint.elements(options.spacing)?;
        let shape = counts.map(|[before, after]| before + after + 1);
        let apex = counts.map(|[before, _]| before);
        let n_steps = elements_along(positive("sliding_distance", options.sliding_distance)?, dx)?;
        let depth_scale = positive("F_N / (4 η v)", depth_scale(material, load))?;
        let track_grid = Grid::new([shape[0] + n_steps, shape[1]], [1.0, dy / dx])?;
        let indenter = SampledIndenter::new(surface, options.spacing, (shape, apex), depth_scale)?;
        let track = Convolution::new(&track_grid);
        let first_bounds = Bounds::around(indenter.lowest(shape[1])).with_margin(shape);
        Ok(Self {
            options: *options,
            load: *load,
            depth_scale,
            shape,
            apex,
            indenter,
            contact_box: ContactBox::new(first_bounds, [1.0, dy / dx])?,
            workspace: track.workspace(),
            track_pressure: vec![0.0; track_grid.n_elements()],
            increment: vec![0.0; track_grid.n_elements()],
            displacement: vec![0.0; track_grid.n_elements()],
            track,
            steps_done: 0,
        })
    }

    pub(super) fn n_steps(&self) -> usize {
        self.track.grid().shape()[0] - self.shape[0]
    }

    /// Advances the indenter by one element and solves the contact at its new position.
    pub(super) fn step(&mut self) -> Result<SlideRow, BemError> {
        self.steps_done += 1;
        loop {
            self.set_separation();
            let contact = self.solve_box()?;
            self.find_increment();
            let mut bounds = self.contact_bounds();
            if self.include_penetration(&mut bounds, contact.indentation_depth) {
                self.contact_box = self.contact_box.moved_to(bounds.with_margin(self.shape))?;
                continue;
            }
            self.check_footprint(&bounds)?;
            for (displacement, increment) in self.displacement.iter_mut().zip(&self.increment) {
                *displacement += increment;
            }
            return self.record(&contact, &bounds);
        }
    }

    /// Solves the step in the box. With x = α P / (4π) in units of D/Δx and lengths in Δx the total load is
    /// Δx/(πΔy), whatever the scene.
    fn solve_box(&mut self) -> Result<Outcome, BemError> {
        let [dx, dy] = self.options.spacing;
        let control = Control::NormalForce(FRAC_1_PI * dx / dy);
        self.contact_box.solve(control, &self.options.contact)
    }

    /// Rows of the track under the footprint.
    fn rows(&self) -> Range<usize> {
        self.steps_done..self.steps_done + self.shape[0]
    }

    /// Index into the track of an element of the footprint.
    const fn on_track(&self, [row, column]: [usize; 2]) -> usize {
        (row + self.steps_done) * self.shape[1] + column
    }

    fn set_separation(&mut self) {
        let Bounds { lower, upper } = self.contact_box.bounds;
        let mut separation = std::mem::take(&mut self.contact_box.separation);
        separation.clear();
        for row in lower[0]..upper[0] {
            let heights = &self.indenter.height[row * self.shape[1]..][lower[1]..upper[1]];
            let displacements = &self.displacement[self.on_track([row, lower[1]])..];
            separation.extend(heights.iter().zip(displacements).map(|(h, u)| h + u));
        }
        self.contact_box.separation = separation;
    }

    /// Displacement of the step in and ahead of the footprint; what lies behind is never touched again.
    fn find_increment(&mut self) {
        let loaded = self.contact_box.bounds.lower[0]..self.contact_box.bounds.upper[0];
        let loaded = loaded.start + self.steps_done..loaded.end + self.steps_done;
        self.track_pressure[loaded.start * self.shape[1]..loaded.end * self.shape[1]].fill(0.0);
        for (element, pressure) in self.contact_box.loaded_elements() {
            self.track_pressure[(element[0] + self.steps_done) * self.shape[1] + element[1]] =
                pressure;
        }
        let wanted = self.rows().start..self.track.grid().shape()[0];
        self.track.apply(
            &mut self.workspace,
            (&self.track_pressure, loaded),
            (&mut self.increment, wanted),
        );
    }

    fn contact_bounds(&self) -> Bounds {
        let elements = self.contact_box.loaded_elements();
        Bounds::of(elements.map(|(element, _)| element)).unwrap_or(Bounds::around(self.apex))
    }

    /// Extends the bounds to all elements outside the box that the indenter penetrates.
    fn include_penetration(&self, bounds: &mut Bounds, depth: f64) -> bool {
        let deflection = self.increment[self.rows().start * self.shape[1]..]
            .iter()
            .fold(0.0, |largest: f64, increment| largest.max(*increment));
        // The box and the track round differently, so the box's own tolerance would be too sharp here.
        let allowed = -2.0 * self.options.contact.tolerance * deflection;
        let mut found = false;
        for row in 0..self.shape[0] {
            for column in 0..self.shape[1] {
                let index = self.on_track([row, column]);
                let surface = self.displacement[index] + self.increment[index];
                let gap = self.indenter.height[row * self.shape[1] + column] + surface - depth;
                if gap < allowed && !self.contact_box.bounds.contains([row, column]) {
                    bounds.include([row, column]);
                    found = true;
                }
            }
        }
        found
    }

    fn check_footprint(&self, bounds: &Bounds) -> Result<(), BemError> {
        let inside =
            (0..2).all(|axis| bounds.lower[axis] > 0 && bounds.upper[axis] < self.shape[axis]);
        if inside {
            return Ok(());
        }
        Err(self
            .options
            .footprint
            .boundary_reached(self.steps_done as f64 * self.options.spacing[0]))
    }

    fn record(&self, contact: &Outcome, bounds: &Bounds) -> Result<SlideRow, BemError> {
        let [dx, dy] = self.options.spacing;
        let sliding_distance = self.steps_done as f64 * dx;
        let edge = |axis: usize, element: usize| {
            (element as f64 - self.apex[axis] as f64 - 0.5) * self.options.spacing[axis]
        };
        self.check_walls()?;
        let n_contact = self.contact_box.loaded_elements().count();
        Ok(SlideRow {
            sliding_distance,
            time: sliding_distance / self.load.velocity(),
            indentation_depth: contact.indentation_depth * self.depth_scale,
            friction_coefficient: self.weighted_slope(&self.indenter.mean_slope),
            friction_coefficient_end_of_step: self.weighted_slope(&self.indenter.end_slope),
            contact_area: n_contact as f64 * dx * dy,
            contact_x: [edge(0, bounds.lower[0]), edge(0, bounds.upper[0])],
            contact_y: [edge(1, bounds.lower[1]), edge(1, bounds.upper[1])],
            n_contact,
            iterations: contact.iterations,
        })
    }

    /// A wall is a finite height beside an infinite one, so that the mean slope is infinite.
    fn check_walls(&self) -> Result<(), BemError> {
        let infinite = |[row, column]: [usize; 2]| {
            self.indenter.mean_slope[row * self.shape[1] + column].is_infinite()
        };
        let mut loaded = self
            .contact_box
            .loaded_elements()
            .map(|(element, _)| element);
        let Some([row, column]) = loaded.find(|&element| infinite(element)) else {
            return Ok(());
        };
        let position = |axis: usize, index: usize| {
            (index as f64 - self.apex[axis] as f64) * self.options.spacing[axis]
        };
        Err(BemError::VerticalWall {
            x: position(0, row),
            y: position(1, column),
        })
    }

    /// Largest rise of the body over an element in contact, [m].
    fn largest_rise(&self) -> f64 {
        let rise = |[row, column]: [usize; 2]| {
            self.indenter.mean_slope[row * self.shape[1] + column] * self.options.spacing[0]
        };
        self.contact_box
            .loaded_elements()
            .map(|(element, _)| rise(element))
            .fold(0.0, f64::max)
    }

    /// Mean of a slope over the contact, weighted with the pressure: F_h / F_N.
    fn weighted_slope(&self, slope: &[f64]) -> f64 {
        let (mut tangential, mut normal) = (0.0, 0.0);
        for ([row, column], pressure) in self.contact_box.loaded_elements() {
            tangential += pressure * slope[row * self.shape[1] + column];
            normal += pressure;
        }
        tangential / normal
    }

    /// Closes the simulation after its last step.
    pub(super) fn finish(self, rows: Vec<SlideRow>) -> Result<Transient, BemError> {
        let bounds = self.contact_bounds();
        let elements = bounds.shape()[0].min(bounds.shape()[1]);
        if elements < MIN_CONTACT_ELEMENTS {
            return Err(BemError::GridTooCoarse {
                elements,
                needed: MIN_CONTACT_ELEMENTS,
            });
        }
        let (rise, depth_scale) = (self.largest_rise(), self.depth_scale);
        if rise > depth_scale {
            return Err(BemError::SlopeNotResolved { rise, depth_scale });
        }
        let n_elements = self.track.grid().n_elements();
        Ok(Transient {
            rows,
            pressure: self.pressure_field(&bounds)?,
            n_elements,
        })
    }

    fn pressure_field(&self, bounds: &Bounds) -> Result<PressureField, BemError> {
        let [dx, dy] = self.options.spacing;
        let columns = bounds.shape()[1];
        // x = α P / (4π) is measured in D/Δx, with α = Δx/(ηv) and D = F_N/(4ηv).
        let unit = PI * self.load.normal_force() / dx / dx;
        let mut pressure = vec![0.0; columns * bounds.shape()[0]];
        for ([row, column], value) in self.contact_box.loaded_elements() {
            pressure[(row - bounds.lower[0]) * columns + column - bounds.lower[1]] = value * unit;
        }
        let origin = [0, 1].map(|axis| {
            (bounds.lower[axis] as f64 - self.apex[axis] as f64) * self.options.spacing[axis]
        });
        Ok(PressureField {
            grid: Grid::new(bounds.shape(), [dx, dy])?,
            origin,
            pressure,
        })
    }
}
