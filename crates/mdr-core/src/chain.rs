//! The elements of the chain under a line, and what they remember.
//!
//! ```text
//! u_new = α w + history,   f = 4 Δx w        over one step of compliance α, w held
//! ```
//! A chain stores one number per element and retardation element of its material, one for free flow, none for an
//! elastic material ([`rheology::ExponentialStep`]). A Poisson ratio other than 1/2 makes both parts of u larger by
//! 2 (1 − ν).

use indenters::Control;
use rheology::{CreepSpectrum, ExponentialStep, Material};

use crate::MdrError;
use crate::contact::{Element, Instant};
use crate::element_heights::ElementHeights;
use crate::error::finite;

/// Elements of one material side by side, from the rear to the front, and the line that is pressed into them.
#[derive(Debug, Clone)]
pub(crate) struct Chain {
    pub(crate) line: ElementHeights,
    /// Depth after the last step, \[m].
    pub(crate) depth: f64,
    pub(crate) creep: CreepSpectrum,
    /// What one element does in one step.
    pub(crate) element: Element,
    half_space_factor: f64,
    step: ExponentialStep,
    state: Vec<f64>,
    /// Load potentials of the last step.
    values: Vec<f64>,
}

/// The end of a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Contact {
    pub(crate) indentation_depth: f64,
    pub(crate) normal_force: f64,
    pub(crate) n_contact: usize,
    /// The rearmost and the foremost loaded element.
    pub(crate) ends: Option<[usize; 2]>,
}

impl Chain {
    /// A chain at rest under the elements of a line, for steps of `time_step` \[s].
    pub(crate) fn new(
        line: ElementHeights,
        material: &(impl Material + ?Sized),
        time_step: f64,
    ) -> Result<Self, MdrError> {
        let creep = material.creep();
        let step = ExponentialStep::creep(&creep, time_step)?;
        let half_space_factor = material.half_space_factor();
        let n_elements = line.heights.len();
        Ok(Self {
            element: Element::new(line.spacing, half_space_factor * step.response())?,
            state: vec![0.0; step.n_fields() * n_elements],
            values: vec![0.0; n_elements],
            line,
            depth: 0.0,
            creep,
            half_space_factor,
            step,
        })
    }

    /// Part of the compliance of a step that is there at once.
    pub(crate) fn elastic_share(&self) -> f64 {
        self.creep.instantaneous_compliance() / self.step.response()
    }

    /// Forces on the elements, \[N].
    pub(crate) fn forces(&self) -> impl Iterator<Item = f64> {
        self.values
            .iter()
            .map(|value| 4.0 * self.line.spacing * value)
    }

    /// Goes on with steps of another length \[s].
    pub(crate) fn set_time_step(&mut self, time_step: f64) -> Result<(), MdrError> {
        self.step = ExponentialStep::creep(&self.creep, time_step)?;
        let compliance = self.half_space_factor * self.step.response();
        self.element = Element::new(self.line.spacing, compliance)?;
        Ok(())
    }

    /// Moves the line on by one element: each comes under the place behind, and one that is at rest enters in front.
    pub(crate) fn travel(&mut self) {
        let n_elements = self.values.len();
        for field in self.state.chunks_exact_mut(n_elements) {
            field.copy_within(1.., 0);
            field[n_elements - 1] = 0.0;
        }
    }

    /// One step up to a `time` \[s]; `loaded` sees each loaded element and by how much it is compressed, from the rear to
    /// the front.
    pub(crate) fn press(
        &mut self,
        control: Control,
        time: f64,
        mut loaded: impl FnMut(usize, f64),
    ) -> Result<Contact, MdrError> {
        self.step.history(&self.state, &mut self.values);
        for value in &mut self.values {
            *value *= self.half_space_factor;
        }
        let instant = Instant {
            heights: &self.line.heights,
            displacements: &self.values,
            element: self.element,
        };
        let level = match control {
            Control::NormalForce(force) => instant.solve(force, self.depth),
            Control::IndentationDepth(depth) => instant.level(depth),
        };
        let depth = finite("indentation depth", level.depth, time)?;
        self.depth = depth;
        let mut ends: Option<[usize; 2]> = None;
        let elements = self.values.iter_mut().zip(&self.line.heights);
        for (element, (value, height)) in elements.enumerate() {
            let compression = depth - (height + *value);
            if compression > 0.0 {
                loaded(element, compression);
                ends = Some([ends.map_or(element, |[rear, _]| rear), element]);
                *value = compression / self.element.compliance;
            } else {
                *value = 0.0;
            }
        }
        self.step.advance(&self.values, &mut self.state);
        Ok(Contact {
            indentation_depth: depth,
            normal_force: self.element.force(level.compression),
            n_contact: level.n_below,
            ends,
        })
    }

    /// The contact has reached an element beyond which the line is not given.
    pub(crate) fn reaches_edge(&self, element: usize, time: f64) -> MdrError {
        MdrError::ContactReachesEdge {
            position: self.line.position(element),
            indentation_depth: self.depth,
            time,
        }
    }
}

/// Whether nothing of a material depends on time.
pub(crate) fn is_elastic(creep: &CreepSpectrum) -> bool {
    creep.elements().is_empty() && creep.fluidity() == 0.0
}
