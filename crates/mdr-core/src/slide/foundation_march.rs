//! Marching of the elements under a sliding line and their history variables.
//!
//! ```text
//! u_new = α w + history,   f = 4 Δx w        over one step of compliance α, w held
//! ```
//! There is one history variable per element and retardation element of the material, one more for free flow, and none for
//! an elastic material ([`rheology::ExponentialStep`]). A Poisson ratio ν multiplies both parts of u by 2 (1 − ν).
//!
//! Theory: docs/theory/line-viscoelastic.md, "Step by step".

use indenters::{RigidLine, SlidingLoad};
use numerics::positive;
use rheology::{CreepSpectrum, ExponentialStep, Material, check_spectra};

use super::on_grid::SlideRow;
use super::subgrid::{LastStep, StepScaleModuli, SubgridForces};
use crate::MdrError;
use crate::error::{enough_elements, finite};
use crate::line::ElementHeights;
use crate::march::{CompensatedSum, ForceBalance};

/// A line that slides over a Winkler foundation. All lists run from the rear to the front of the line.
pub(super) struct FoundationMarch {
    line: ElementHeights,
    /// Mean slope of the line over each element during the step to which its force belongs.
    mean_slopes: Vec<f64>,
    /// Slope h̃'(x) at the end of a step.
    end_slopes: Vec<f64>,
    creep: CreepSpectrum,
    half_space_factor: f64,
    step: ExponentialStep,
    /// History variables, one field over all elements after the other.
    state: Vec<f64>,
    /// Displacement without load \[m] of each element within a step, load potential w \[Pa] after it.
    element_values: Vec<f64>,
    /// Depth after the last step, \[m].
    depth: f64,
    /// Compliance α of a step, [1/Pa].
    compliance: f64,
    /// Sum of the compressions of all elements that carries the normal force, \[m].
    compression: f64,
    moduli: StepScaleModuli,
    normal_force: f64,
    time_step: f64,
    n_steps: usize,
}

/// The state at the end of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct MarchStep {
    pub(super) row: SlideRow,
    /// Number of elements from the rearmost to the foremost loaded one.
    pub(super) span: usize,
    /// Friction coefficient with the moduli of all slopes, to which rounding is relative.
    pub(super) steepness: f64,
}

/// Sums over the loaded elements of a step: fractions of the force times slopes.
#[derive(Debug, Clone, Copy, Default)]
struct MarchSums {
    /// With the mean slope over an element during the step.
    mean_slope: CompensatedSum,
    /// With the modulus of the mean slope.
    steepness: f64,
    /// With the slope of the line at the end of the step.
    end_slope: CompensatedSum,
    /// The rearmost and the foremost loaded element.
    ends: Option<[usize; 2]>,
}

impl FoundationMarch {
    /// An undeformed foundation, touched by the lowest point of the line.
    pub(super) fn from_first_touch(
        line: &dyn RigidLine,
        sampled: ElementHeights,
        material: &dyn Material,
        load: &SlidingLoad,
    ) -> Result<Self, MdrError> {
        load.require_fresh_ground()?;
        check_spectra(material)?;
        let (n_elements, spacing) = (sampled.heights.len(), sampled.spacing);
        let (time_step, creep) = (spacing / load.velocity(), material.creep());
        let step = ExponentialStep::creep(&creep, time_step)?;
        let half_space_factor = material.half_space_factor();
        let compliance = positive("compliance", half_space_factor * step.response())?;
        let normal_force = load.require_normal_force()?;
        // In this order forces whose square is no number stay in range.
        let compression = 0.25 * normal_force / spacing * compliance;
        let pairs = sampled.heights.windows(2);
        let slopes: Vec<f64> = pairs.map(|h| (h[1] - h[0]) / spacing).collect();
        let positions = (0..n_elements).map(|element| sampled.position(element));
        let end_slopes = positions.map(|x| line.slope(x)).collect();
        // Instantaneous part of the compliance of a step.
        let elastic_share = creep.instantaneous_compliance() / step.response();
        let mut mean_slopes = mean_slopes(&slopes, elastic_share);
        // The last element never carries load: see `advance`.
        mean_slopes.push(f64::INFINITY);
        Ok(Self {
            line: sampled,
            mean_slopes,
            end_slopes,
            state: vec![0.0; step.n_fields() * n_elements],
            element_values: vec![0.0; n_elements],
            depth: 0.0,
            compliance,
            compression: positive("compression", compression)?,
            moduli: StepScaleModuli::new(material, load.velocity(), spacing),
            creep,
            half_space_factor,
            step,
            normal_force,
            time_step,
            n_steps: 0,
        })
    }

    /// Sub-grid errors of the `last` step: of the friction coefficient, and of the depth \[m].
    pub(super) fn subgrid_errors(&self, line: &dyn RigidLine, last: &SlideRow) -> [f64; 2] {
        if self.creep.is_elastic() {
            return [0.0; 2];
        }
        let step = LastStep {
            elements: &self.line,
            loads: &self.element_values,
            depth: self.depth,
            normal_force: self.normal_force,
            moduli: &self.moduli,
        };
        let SubgridForces { tangential, normal } = step.relative_errors(line);
        // The force grows with the depth at least in proportion, and a change of the depth moves the friction again.
        let friction = tangential + 2.0 * last.friction_coefficient.abs() * normal;
        [friction, normal * self.depth]
    }

    /// Positions of the elements from the rearmost loaded one to the foremost \[m], with a free one on each side, and their
    /// loads per length \[N/m].
    pub(super) fn load(&self) -> Vec<[f64; 2]> {
        let is_loaded = |load: &f64| *load > 0.0;
        let rear = self.element_values.iter().position(is_loaded).unwrap_or(0);
        let front = self.element_values.iter().rposition(is_loaded).unwrap_or(0);
        let last = (front + 1).min(self.element_values.len() - 1);
        let elements = rear.saturating_sub(1)..=last;
        let load = |element: usize| {
            [
                self.line.position(element),
                4.0 * self.element_values[element],
            ]
        };
        elements.map(load).collect()
    }

    /// Distance slid at the end of the step to come, \[m].
    pub(super) fn next_sliding_distance(&self) -> f64 {
        (self.n_steps + 1) as f64 * self.line.spacing
    }

    /// One step; `None` if the depth needs more elements than the foundation has.
    pub(super) fn advance(&mut self) -> Result<Option<MarchStep>, MdrError> {
        self.n_steps += 1;
        let time = self.n_steps as f64 * self.time_step;
        // Move the line by one element: in its frame each element moves backwards, and an undeformed one enters in front.
        let n_elements = self.element_values.len();
        for field in self.state.chunks_exact_mut(n_elements) {
            field.copy_within(1.., 0);
            field[n_elements - 1] = 0.0;
        }

        // Find the depth at which the elements carry the normal force.
        let depth_before = self.depth;
        self.step.history(&self.state, &mut self.element_values);
        for value in &mut self.element_values {
            *value *= self.half_space_factor;
        }
        let balance = ForceBalance {
            heights: &self.line.heights,
            displacements: &self.element_values,
        };
        let level = balance.solve(self.compression, depth_before);
        self.depth = finite("indentation depth", level.depth, time)?;

        // Load the elements, and check that the contact lies on the foundation.
        let mut sums = self.load_elements();
        self.step.advance(&self.element_values, &mut self.state);
        if self.depth > self.line.ceiling {
            return Ok(None);
        }
        let Some([rear, front]) = sums.ends else {
            return enough_elements(0, self.line.spacing).map(|()| None);
        };
        if front + 1 == self.line.heights.len() {
            return Err(self.line.reached(front, self.depth, time));
        }
        // On springs the sum of the slopes vanishes if the contact ends inside the line.
        if self.creep.is_elastic() && rear > 0 {
            sums.mean_slope = CompensatedSum::default();
        }
        Ok(Some(MarchStep {
            row: self.row(level.n_below, [rear, front], &sums, depth_before)?,
            span: front + 1 - rear,
            steepness: sums.steepness,
        }))
    }

    /// Loads the elements that penetrate the line, from the rear to the front.
    fn load_elements(&mut self) -> MarchSums {
        let mut sums = MarchSums::default();
        let elements = self.element_values.iter_mut().zip(&self.line.heights);
        for (here, (value, height)) in elements.enumerate() {
            let compression = self.depth - (height + *value);
            if compression <= 0.0 {
                *value = 0.0;
                continue;
            }
            *value = compression / self.compliance;
            // The product of a compression and a slope may be too small for a number where its part of the force is not.
            let part = compression / self.compression;
            sums.mean_slope.add(part * self.mean_slopes[here]);
            sums.steepness += part * self.mean_slopes[here].abs();
            sums.end_slope.add(part * self.end_slopes[here]);
            sums.ends = Some([sums.ends.map_or(here, |[rear, _]| rear), here]);
        }
        sums
    }

    /// The results of a step.
    fn row(
        &self,
        n_contact: usize,
        ends: [usize; 2],
        sums: &MarchSums,
        depth_before: f64,
    ) -> Result<SlideRow, MdrError> {
        let line = &self.line;
        let time = self.n_steps as f64 * self.time_step;
        let friction = sums.mean_slope.value();
        let end_of_step = sums.end_slope.value();
        let depth = self.depth;
        Ok(SlideRow {
            sliding_distance: self.n_steps as f64 * line.spacing,
            time,
            indentation_depth: depth,
            friction_coefficient: finite("friction coefficient", friction, time)?,
            friction_coefficient_end_of_step: end_of_step.is_finite().then_some(end_of_step),
            sinking_velocity: (depth - depth_before) / self.time_step,
            contact: ends.map(|element| line.position(element)),
            n_contact,
            contact_length: n_contact as f64 * line.spacing,
        })
    }
}

/// Slopes [h̃(x + Δx) − h̃(x)]/Δx during a step that ends at x, and for the elastic share those around its end.
///
/// The force of a dashpot belongs to the motion during the step, that of a spring to where the step ends.
fn mean_slopes(slopes: &[f64], elastic_share: f64) -> Vec<f64> {
    let rear = slopes.first().into_iter();
    let before = rear.chain(slopes);
    let mean = |(slope, before): (&f64, &f64)| slope - 0.5 * elastic_share * (slope - before);
    slopes.iter().zip(before).map(mean).collect()
}
