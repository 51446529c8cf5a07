//! What a method answers, and how it is printed.

use super::error::{Result, bail};
use bem_halfspace::GridOptions;
use bem_halfspace::slide::PressureField;
use bem_halfspace::steady::SteadyOptions;
use serde::Serialize;

use super::omission::Omission;
use crate::scene::{Method, Model};
use numerics::{ErrorParts, Estimate};

/// One result, all SI; what a method does not know is left out.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Answer {
    pub method: Method,
    /// What the elastomer was taken to be.
    pub model: Model,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_coefficient: Option<f64>,
    /// Absolute.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_coefficient_error: Option<f64>,
    pub normal_force: f64,
    /// Absolute; of a force that is given there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal_force_error: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tangential_force: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub indentation_depth: Option<f64>,
    /// Absolute.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub indentation_depth_error: Option<f64>,
    /// Of the friction coefficient; where nothing slides of the depth, or of the force where the depth is given.
    #[serde(skip_serializing_if = "ErrorParts::is_none")]
    pub error_parts: ErrorParts,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_area: Option<f64>,
    /// Absolute; an area in closed form has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_area_error: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_pressure: Option<f64>,
    /// Absolute; a pressure in closed form has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_pressure_error: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_box: Option<ContactBox>,
    /// Absolute, of each edge; edges in closed form have none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_box_error: Option<f64>,
    /// Unknown pressures, elements or polynomials at the same time; none in a closed form.
    pub unknowns: usize,
    /// Iterations or time steps on the finest resolution.
    pub iterations: usize,
    /// Whether forces and areas are per length along y.
    #[serde(skip)]
    pub is_per_length: bool,
    /// Parts of the method that the scene did not need.
    pub left_out: Vec<Omission>,
    #[serde(skip)]
    pub grid: Option<Grid>,
    #[serde(skip)]
    pub fields: Fields,
}

/// The rectangle around the contact, relative to the lowest point, \[m]; a line has no sides.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContactBox {
    pub x_min: f64,
    pub x_max: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_min: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_max: Option<f64>,
}

/// The finest boundary elements behind an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Grid {
    /// Of the stationary state.
    Stationary {
        /// The grid.
        options: SteadyOptions,
        /// Whether the contact was factorised.
        factorised: bool,
    },
    /// Of pressing, and of sliding in time.
    March(GridOptions),
}

/// What only files hold.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Fields {
    /// Pressure on the half space.
    pub pressure: Option<PressureField>,
    /// Position \[m] and load per length \[N/m] along the contact of a line.
    pub line_load: Vec<[f64; 2]>,
    /// Position \[m] and pressure \[Pa] across a line contact.
    pub line_pressure: Vec<[f64; 2]>,
    /// From first touch to the state that was asked for.
    pub history: Vec<HistoryRow>,
}

/// One step of sliding.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct HistoryRow {
    pub sliding_distance_m: f64,
    pub time_s: f64,
    pub indentation_depth_m: f64,
    pub friction_coefficient: f64,
}

impl Answer {
    /// An answer that knows nothing yet but the force.
    pub(crate) const fn new(method: Method, model: Model, normal_force: f64) -> Self {
        Self {
            method,
            model,
            friction_coefficient: None,
            friction_coefficient_error: None,
            normal_force,
            normal_force_error: None,
            tangential_force: None,
            indentation_depth: None,
            indentation_depth_error: None,
            error_parts: ErrorParts::NONE,
            contact_area: None,
            contact_area_error: None,
            peak_pressure: None,
            peak_pressure_error: None,
            contact_box: None,
            contact_box_error: None,
            unknowns: 0,
            iterations: 0,
            is_per_length: false,
            left_out: Vec::new(),
            grid: None,
            fields: Fields {
                pressure: None,
                line_load: Vec::new(),
                line_pressure: Vec::new(),
                history: Vec::new(),
            },
        }
    }

    /// With a friction coefficient and its absolute error.
    pub(crate) fn with_friction(self, friction: f64, error: f64) -> Self {
        Self {
            friction_coefficient: Some(friction),
            friction_coefficient_error: Some(error),
            tangential_force: Some(friction * self.normal_force),
            ..self
        }
    }

    /// With what the error bar consists of.
    pub(crate) fn with_parts(self, parts: ErrorParts) -> Self {
        Self {
            error_parts: parts,
            ..self
        }
    }

    /// With the area of the contact, and the largest pressure where it has a limit.
    pub(crate) fn with_contact(self, area: Estimate, peak: Option<Estimate>) -> Self {
        Self {
            contact_area: Some(area.value),
            contact_area_error: Some(area.error),
            peak_pressure: peak.map(|peak| peak.value),
            peak_pressure_error: peak.map(|peak| peak.error),
            ..self
        }
    }

    /// The quantities by their names in JSON and CSV.
    #[must_use]
    pub fn numbers(&self) -> [(&'static str, Option<f64>); 20] {
        let edges = self.contact_box;
        let parts = self.error_parts;
        [
            ("friction_coefficient", self.friction_coefficient),
            (
                "friction_coefficient_error",
                self.friction_coefficient_error,
            ),
            ("normal_force", Some(self.normal_force)),
            ("normal_force_error", self.normal_force_error),
            ("tangential_force", self.tangential_force),
            ("indentation_depth", self.indentation_depth),
            ("indentation_depth_error", self.indentation_depth_error),
            ("error_discretisation", parts.discretisation),
            ("error_iteration", parts.iteration),
            ("error_time_stepping", parts.time_stepping),
            ("error_truncation", parts.truncation),
            ("contact_area", self.contact_area),
            ("contact_area_error", self.contact_area_error),
            ("peak_pressure", self.peak_pressure),
            ("peak_pressure_error", self.peak_pressure_error),
            ("x_min", edges.map(|edges| edges.x_min)),
            ("x_max", edges.map(|edges| edges.x_max)),
            ("y_min", edges.and_then(|edges| edges.y_min)),
            ("y_max", edges.and_then(|edges| edges.y_max)),
            ("contact_box_error", self.contact_box_error),
        ]
    }

    /// Refuses a quantity that overflows although what it follows from does not, such as an area from a length.
    pub(crate) fn finite(self) -> Result<Self> {
        let numbers = self.numbers().into_iter();
        let mut known = numbers.filter_map(|(name, value)| Some((name, value?)));
        match known.find(|(_, value)| !value.is_finite()) {
            None => Ok(self),
            Some((name, value)) => bail!("{name} is {value} in units of SI: no number is as large"),
        }
    }
}

impl ContactBox {
    /// Of a line.
    pub(crate) const fn along([x_min, x_max]: [f64; 2]) -> Self {
        Self {
            x_min,
            x_max,
            y_min: None,
            y_max: None,
        }
    }

    /// Of an area.
    pub(crate) const fn around(x: [f64; 2], [y_min, y_max]: [f64; 2]) -> Self {
        Self {
            y_min: Some(y_min),
            y_max: Some(y_max),
            ..Self::along(x)
        }
    }
}
