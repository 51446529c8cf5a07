//! What a method answers, and how it is printed.

use std::time::Duration;

use anyhow::{Result, bail};
use bem_halfspace::slide::PressureField;
use comfy_table::Table;
use serde::Serialize;

use super::error_parts::ErrorParts;
use super::omission::Omission;
use crate::scene_file::{Method, Model};

/// One result, all SI; what a method does not know is left out.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Answer {
    pub(crate) method: Method,
    /// What the elastomer was taken to be.
    pub(crate) model: Model,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) friction_coefficient: Option<f64>,
    /// Absolute.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) friction_coefficient_error: Option<f64>,
    pub(crate) normal_force: f64,
    /// Absolute; of a force that is given there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) normal_force_error: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) tangential_force: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) indentation_depth: Option<f64>,
    /// Absolute.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) indentation_depth_error: Option<f64>,
    /// Of the friction coefficient; where nothing slides of the depth, or of the force where the depth is given.
    #[serde(skip_serializing_if = "ErrorParts::is_none")]
    pub(crate) error_parts: ErrorParts,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) contact_area: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) peak_pressure: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) contact_box: Option<ContactBox>,
    /// Unknown pressures, elements or polynomials at the same time; none in a closed form.
    pub(crate) unknowns: usize,
    /// Iterations or time steps on the finest resolution.
    pub(crate) iterations: usize,
    pub(crate) seconds: f64,
    /// Whether forces and areas are per length along y.
    #[serde(skip)]
    pub(crate) is_per_length: bool,
    /// Parts of the method that the scene did not need.
    pub(crate) left_out: Vec<Omission>,
    #[serde(skip)]
    pub(crate) grid: Option<Grid>,
    #[serde(skip)]
    pub(crate) fields: Fields,
}

/// The rectangle around the contact, relative to the lowest point, \[m]; a line has no sides.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct ContactBox {
    pub(crate) x_min: f64,
    pub(crate) x_max: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) y_min: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) y_max: Option<f64>,
}

/// The finest boundary elements behind an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grid {
    /// Length of an element, \[m].
    pub(crate) spacing: f64,
    /// Whether the stationary contact was factorised.
    pub(crate) factorised: bool,
}

/// What only files hold.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Fields {
    /// Pressure on the half space.
    pub(crate) pressure: Option<PressureField>,
    /// Position \[m] and load per length \[N/m] along the contact of a line.
    pub(crate) line_load: Vec<[f64; 2]>,
    /// Position \[m] and pressure \[Pa] across a line contact.
    pub(crate) line_pressure: Vec<[f64; 2]>,
    /// From first touch to the state that was asked for.
    pub(crate) history: Vec<HistoryRow>,
}

/// One step of sliding.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct HistoryRow {
    pub(crate) sliding_distance_m: f64,
    pub(crate) time_s: f64,
    pub(crate) indentation_depth_m: f64,
    pub(crate) friction_coefficient: f64,
}

impl Answer {
    /// An answer that knows nothing yet but the force.
    pub(super) const fn new(method: Method, model: Model, normal_force: f64) -> Self {
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
            peak_pressure: None,
            contact_box: None,
            unknowns: 0,
            iterations: 0,
            seconds: 0.0,
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
    pub(super) fn with_friction(self, friction: f64, error: f64) -> Self {
        Self {
            friction_coefficient: Some(friction),
            friction_coefficient_error: Some(error),
            tangential_force: Some(friction * self.normal_force),
            ..self
        }
    }

    /// With what the error bar consists of.
    pub(super) fn with_parts(self, parts: ErrorParts) -> Self {
        Self {
            error_parts: parts,
            ..self
        }
    }

    /// With the time it took.
    pub(super) fn after(self, time: Duration) -> Self {
        Self {
            seconds: time.as_secs_f64(),
            ..self
        }
    }

    /// The quantities by their names in JSON and CSV.
    pub(crate) fn numbers(&self) -> [(&'static str, Option<f64>); 17] {
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
            ("peak_pressure", self.peak_pressure),
            ("x_min", edges.map(|edges| edges.x_min)),
            ("x_max", edges.map(|edges| edges.x_max)),
            ("y_min", edges.and_then(|edges| edges.y_min)),
            ("y_max", edges.and_then(|edges| edges.y_max)),
        ]
    }

    /// Refuses a quantity that overflows although what it follows from does not, such as an area from a length.
    pub(super) fn finite(self) -> Result<Self> {
        let numbers = self.numbers().into_iter();
        let mut known = numbers.filter_map(|(name, value)| Some((name, value?)));
        match known.find(|(_, value)| !value.is_finite()) {
            None => Ok(self),
            Some((name, value)) => bail!("{name} is {value} in units of SI: no number is as large"),
        }
    }

    /// The model in words.
    pub(super) const fn model_name(&self) -> &'static str {
        match self.model {
            Model::Line => "one-dimensional model",
            Model::HalfSpace => "half space",
        }
    }

    /// For a person.
    pub(super) fn table(&self) -> Table {
        let mut table = Table::new();
        table.load_style(comfy_table::presets::ASCII_MARKDOWN);
        table.set_header(["quantity", "value", "error", "unit"]);
        let [force, area] = if self.is_per_length {
            ["N/m", "m²/m"]
        } else {
            ["N", "m²"]
        };
        let rows = [
            (
                "friction coefficient",
                self.friction_coefficient,
                self.friction_coefficient_error,
                "",
            ),
            (
                "normal force",
                Some(self.normal_force),
                self.normal_force_error,
                force,
            ),
            ("tangential force", self.tangential_force, None, force),
            (
                "indentation depth",
                self.indentation_depth,
                self.indentation_depth_error,
                "m",
            ),
            ("contact area", self.contact_area, None, area),
            ("peak pressure", self.peak_pressure, None, "Pa"),
        ];
        for (name, value, error, unit) in rows {
            if let Some(value) = value {
                let error = error.map_or(String::new(), |error| format!("{error:.1e}"));
                table.add_row([name.to_owned(), short(value), error, unit.to_owned()]);
            }
        }
        table
    }
}

/// Nine digits; the JSON has all of them.
fn short(value: f64) -> String {
    if value == 0.0 || (1e-3..1e5).contains(&value.abs()) {
        return format!("{value:.9}");
    }
    format!("{value:.8e}")
}

impl ContactBox {
    /// Of a line.
    pub(super) const fn along([x_min, x_max]: [f64; 2]) -> Self {
        Self {
            x_min,
            x_max,
            y_min: None,
            y_max: None,
        }
    }

    /// Of an area.
    pub(super) const fn around(x: [f64; 2], [y_min, y_max]: [f64; 2]) -> Self {
        Self {
            y_min: Some(y_min),
            y_max: Some(y_max),
            ..Self::along(x)
        }
    }
}
