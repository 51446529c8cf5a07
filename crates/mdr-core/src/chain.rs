//! The elements of the chain and what they remember.
//!
//! ```text
//! u_new = α w + history,   f = 4 Δx w        over one step of compliance α, w held
//! ```
//! A chain stores one number per element and retardation element of its material, one for free flow, none for an
//! elastic material ([`rheology::ExponentialStep`]). A Poisson ratio other than 1/2 makes both parts of u larger by
//! 2 (1 − ν).

use rheology::{CreepSpectrum, ExponentialStep, Material};

use crate::MdrError;
use crate::contact::{Element, Instant};

/// Elements of one material side by side, from the rear to the front.
#[derive(Debug, Clone)]
pub(crate) struct Chain {
    creep: CreepSpectrum,
    half_space_factor: f64,
    spacing: f64,
    step: ExponentialStep,
    element: Element,
    state: Vec<f64>,
    /// Displacements at the end of the step without load, \[m]; after [`Chain::load`], the load potentials.
    values: Vec<f64>,
}

impl Chain {
    /// A chain of `n_elements` at rest, for steps of `time_step` \[s].
    pub(crate) fn new(
        material: &(impl Material + ?Sized),
        n_elements: usize,
        spacing: f64,
        time_step: f64,
    ) -> Result<Self, MdrError> {
        let creep = material.creep();
        let step = ExponentialStep::creep(&creep, time_step)?;
        let half_space_factor = material.half_space_factor();
        Ok(Self {
            element: Element::new(spacing, half_space_factor * step.response())?,
            state: vec![0.0; step.n_fields() * n_elements],
            values: vec![0.0; n_elements],
            creep,
            half_space_factor,
            spacing,
            step,
        })
    }

    /// What one element does in one step.
    pub(crate) fn element(&self) -> Element {
        self.element
    }

    /// Part of the compliance of a step that is there at once.
    pub(crate) fn elastic_share(&self) -> f64 {
        self.creep.instantaneous_compliance() / self.step.response()
    }

    /// Whether nothing depends on time.
    pub(crate) fn is_elastic(&self) -> bool {
        self.creep.elements().is_empty() && self.creep.fluidity() == 0.0
    }

    /// Forces on the elements after [`Chain::load`], \[N].
    pub(crate) fn forces(&self) -> impl Iterator<Item = f64> {
        self.values.iter().map(|value| 4.0 * self.spacing * value)
    }

    /// Goes on with steps of another length \[s].
    pub(crate) fn set_time_step(&mut self, time_step: f64) -> Result<(), MdrError> {
        self.step = ExponentialStep::creep(&self.creep, time_step)?;
        let compliance = self.half_space_factor * self.step.response();
        self.element = Element::new(self.spacing, compliance)?;
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

    /// Unloads all elements for the length of a step.
    pub(crate) fn relax(&mut self) {
        self.step.history(&self.state, &mut self.values);
        for value in &mut self.values {
            *value *= self.half_space_factor;
        }
    }

    /// The line with these `heights` \[m] over the chain; after [`Chain::relax`].
    pub(crate) fn instant<'a>(&'a self, heights: &'a [f64]) -> Instant<'a> {
        Instant::unchecked(heights, &self.values, self.element)
    }

    /// Presses the line to a `depth` \[m] and ends the step; `loaded` sees each loaded element and by how much it is
    /// compressed, from the rear to the front.
    pub(crate) fn load(&mut self, heights: &[f64], depth: f64, mut loaded: impl FnMut(usize, f64)) {
        let compliance = self.half_space_factor * self.step.response();
        for (element, (value, height)) in self.values.iter_mut().zip(heights).enumerate() {
            let compression = depth - (height + *value);
            if compression > 0.0 {
                loaded(element, compression);
                *value = compression / compliance;
            } else {
                *value = 0.0;
            }
        }
        self.step.advance(&self.values, &mut self.state);
    }
}
