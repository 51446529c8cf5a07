//! What is measured: series of runs that differ in their resolution only.

use std::sync::Arc;

use anyhow::Result;

use crate::scene_file::{Method, Model};

/// Who answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Solver {
    /// A method of scene files.
    Of(Method),
    /// The half space at one instant, on a given grid.
    Contact,
}

/// How fine a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Resolution {
    /// There is nothing to choose.
    ClosedForm,
    /// Elements along the contact, or along the edge of the grid.
    Elements(usize),
    /// Relative error that is asked for.
    RelativeError(f64),
    /// Tolerance of the contact conditions.
    Tolerance(f64),
}

impl Resolution {
    /// What the number means.
    pub(super) const fn kind(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::Elements(_) => "elements",
            Self::RelativeError(_) => "relative error",
            Self::Tolerance(_) => "tolerance",
        }
    }

    /// The number.
    pub(super) const fn number(self) -> Option<f64> {
        match self {
            Self::ClosedForm => None,
            Self::Elements(elements) => Some(elements as f64),
            Self::RelativeError(number) | Self::Tolerance(number) => Some(number),
        }
    }

    /// A number that falls with refinement, and that errors follow like a power.
    ///
    /// The relative error that is asked for is none: what is reached may be far smaller.
    pub(super) fn fineness(self) -> Option<f64> {
        match self {
            Self::Elements(elements) => Some(1.0 / elements as f64),
            Self::Tolerance(tolerance) => Some(tolerance),
            Self::ClosedForm | Self::RelativeError(_) => None,
        }
    }
}

/// What a run finds.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Outcome {
    /// One number, or a field.
    pub(super) values: Vec<f64>,
    /// Relative error that the method claims.
    pub(super) error_bar: Option<f64>,
    /// Unknown pressures, elements or polynomials; none in a closed form.
    pub(super) unknowns: usize,
}

/// What is taken for the truth.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Reference {
    pub(super) values: Vec<f64>,
    /// Relative; no smaller error can be seen.
    pub(super) error: f64,
    /// Where it comes from.
    pub(super) source: String,
}

/// One run, to be timed.
pub(super) struct Attempt {
    pub(super) resolution: Resolution,
    pub(super) solve: Box<dyn Fn() -> Result<Outcome> + Send>,
}

/// Runs of one solver on one scene, from coarse to fine.
pub(super) struct Series {
    pub(super) scene: &'static str,
    pub(super) model: Model,
    pub(super) quantity: &'static str,
    pub(super) solver: Solver,
    pub(super) reference: Arc<Reference>,
    pub(super) attempts: Vec<Attempt>,
}

/// A run that its method refused, or a scene without a reference.
#[derive(Debug, Clone)]
pub(super) struct Refusal {
    pub(super) scene: &'static str,
    pub(super) what: String,
    pub(super) reason: String,
}

/// What is to be measured, and what cannot be.
#[derive(Default)]
pub(super) struct Plan {
    pub(super) series: Vec<Series>,
    pub(super) refusals: Vec<Refusal>,
}
